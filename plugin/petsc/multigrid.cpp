// SPDX-License-Identifier: GPL-2.0-or-later
// mpm_petsc.so: algebraic multigrid by PETSc's GAMG (smoothed aggregation).
#include "core/solvers/multigrid_module.hpp"
#include "petsc/begin.hpp"
#include "petsc/matrix.hpp"
#include "petsc/talk.hpp"
#include <cstdio>
#include <memory>
#include <petscpc.h>

namespace {

struct Hierarchy {
	gimpm::MultigridMatrix K;
	Mat                    rows = nullptr, product = nullptr;
	PC                     pc = nullptr;
	Vec                    r = nullptr, z = nullptr;

	explicit Hierarchy(const gimpm::MultigridMatrix& K) : K(K) { }
	Hierarchy(const Hierarchy&)            = delete;
	Hierarchy& operator=(const Hierarchy&) = delete;
	MPI_Comm   comm() const { return K.isShared ? ::comm : PETSC_COMM_SELF; }
	~Hierarchy() { PCDestroy(&pc), MatDestroy(&rows), MatDestroy(&product), VecDestroy(&r), VecDestroy(&z); }
};

PetscErrorCode multiply(Mat product, Vec x, Vec y)
{
	void* context;
	PetscCall(MatShellGetContext(product, &context));
	const auto&        K = static_cast<Hierarchy*>(context)->K;
	const PetscScalar* in;
	PetscScalar*       out;
	PetscCall(VecGetArrayRead(x, &in));
	PetscCall(VecGetArrayWrite(y, &out));
	K.multiply(K.product, in, out);
	PetscCall(VecRestoreArrayWrite(y, &out));
	PetscCall(VecRestoreArrayRead(x, &in));
	return 0;
}

PetscErrorCode setMatrix(Hierarchy& h)
{
	const auto&          K = h.K;
	const CompressedRows rows { h.comm(), K.dim, K.rows, K.all, K.start, K.column, K.value };
	PetscCall(makeMatrix(rows, true, &h.rows));
	PetscCall(addRigidMotions(h.rows, rows, K.position));
	PetscCall(MatCreateShell(h.comm(), K.rows, K.rows, K.all, K.all, &h, &h.product));
	PetscCall(MatShellSetOperation(h.product, MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)));
	PetscCall(MatSetOption(h.product, MAT_SYMMETRIC, PETSC_TRUE));
	return MatCreateVecs(h.rows, &h.r, &h.z);
}

/// Smoothed aggregation with Chebyshev's polynomial of the diagonal as smoother. Smoothers that invert blocks fail on
/// coarse levels, where aggregates of one or two nodes have fewer independent motions than unknowns. The first level of
/// aggregates takes neighbours of neighbours: without that, setting up takes longer than the iterations that it saves.
PetscErrorCode setUp(Hierarchy& h)
{
	PetscCall(setMatrix(h));
	PetscCall(PCCreate(h.comm(), &h.pc));
	PetscCall(PCSetOptionsPrefix(h.pc, "mpm_"));
	PetscCall(PCSetType(h.pc, PCGAMG));
	PetscCall(PCGAMGSetAggressiveLevels(h.pc, 1));
	PetscCall(PCSetOperators(h.pc, h.product, h.rows));
	PetscCall(PCSetUseAmat(h.pc, PETSC_TRUE)); // products on the finest level, which take nearly all of the time
	return PCSetUp(h.pc);
}

void* create(const gimpm::MultigridMatrix* K, char* reason, int length)
{
	const Errors errors(reason, length);
	if (begin()) return nullptr;
	auto h = std::make_unique<Hierarchy>(*K);
	PetscOptionsSetValue(nullptr, "-mat_no_inode", "1"); // for matrices that GAMG makes
	const PetscErrorCode code = setUp(*h);
	PetscOptionsClearValue(nullptr, "-mat_no_inode");
	if (code && K->isShared) stop(reason);
	return code ? nullptr : h.release();
}

PetscErrorCode cycle(Hierarchy& h, const double* r, double* z, PCFailedReason* failure)
{
	PetscCall(VecPlaceArray(h.r, r));
	PetscCall(VecPlaceArray(h.z, z));
	PetscCall(PCApply(h.pc, h.r, h.z));
	PetscCall(VecResetArray(h.r));
	PetscCall(VecResetArray(h.z));
	return PCGetFailedReason(h.pc, failure);
}

bool apply(void* hierarchy, const double* r, double* z, char* reason, int length)
{
	const Errors   errors(reason, length);
	auto&          h       = *static_cast<Hierarchy*>(hierarchy);
	PCFailedReason failure = PC_NOERROR;
	const auto     code    = cycle(h, r, z, &failure);
	if (code && h.K.isShared) stop(reason);
	if (code) return false;
	std::int64_t isRight = failure == PC_NOERROR;
	if (h.K.isShared) smallest(&isRight, 1);
	if (!isRight) std::snprintf(reason, length, "a level cannot be solved (reason %d)", int(failure));
	return isRight;
}

void destroy(void* hierarchy)
{
	char         ignored[256];
	const Errors errors(ignored, sizeof ignored); // nothing can be done about them
	delete static_cast<Hierarchy*>(hierarchy);
}

constexpr gimpm::MultigridModule module { gimpm::multigridVersion, &create, &apply, &destroy };

}

extern "C" __attribute__((visibility("default"))) const gimpm::MultigridModule* mpm_multigrid() { return &module; }
