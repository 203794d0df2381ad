// SPDX-License-Identifier: GPL-2.0-or-later
#include "petsc/begin.hpp"
#include <cstdio>
#include <cstdlib>

Errors::Errors(char* reason, int length) : reason_(reason), length_(length) { PetscPushErrorHandler(&take, this); }
Errors::~Errors() { PetscPopErrorHandler(); }

PetscErrorCode Errors::take(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type, const char* message, void* self)
{
	const auto& errors = *static_cast<Errors*>(self);
	if (type == PETSC_ERROR_INITIAL) std::snprintf(errors.reason_, errors.length_, "PETSc, %s: %s (error %d)", function, message, int(code));
	return code;
}

PetscErrorCode begin()
{
	PetscBool isReady;
	PetscCall(PetscInitialized(&isReady));
	if (isReady) return 0;
	// Files and variables of the user are meant for other programs.
	PetscCall(PetscOptionsSetValue(nullptr, "-skip_petscrc", "1"));
	PetscCall(PetscOptionsSetValue(nullptr, "-no_signal_handler", "1"));
	PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_MULTIPLE; // mpi4py makes use of it if it comes later
	// without mpirun, OpenMPI would start a process of its own beside this one
	if (!std::getenv("OMPI_COMM_WORLD_RANK")) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
	return PetscInitializeNoArguments();
}
