// SPDX-License-Identifier: GPL-2.0-or-later
// PETSc in YADE's process: how it begins, and what becomes of its errors.
#pragma once
#include <petscsys.h>

static_assert(sizeof(PetscInt) == sizeof(int) && sizeof(PetscScalar) == sizeof(double), "PETSc for real numbers and 32-bit indices is needed");

/// Takes PETSc's errors, which it would print, for its lifetime.
class Errors {
public:
	Errors(char* reason, int length);
	~Errors();
	Errors(const Errors&)            = delete;
	Errors& operator=(const Errors&) = delete;

private:
	static PetscErrorCode take(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type, const char* message, void* self);

	char* reason_;
	int   length_;
};

/// Once in a process, and never PetscFinalize(): MPI is ended by YADE or mpi4py, which may have begun it.
PetscErrorCode begin();
