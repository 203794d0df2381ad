// SPDX-License-Identifier: GPL-2.0-or-later
// mpm_petsc.so: algebraic multigrid by PETSc's GAMG (smoothed aggregation) in one process.
#include "core/solvers/multigrid_module.hpp"
#include "petsc/begin.hpp"
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

/// The rigid motions, of which coarse levels are made. Without rotations, bending takes three times as many iterations.
PetscErrorCode addRigidMotions(Hierarchy& h)
{
	if (!h.K.position) return 0;
	Vec          position;
	MatNullSpace motions;
	PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, h.K.dim, h.K.rows, h.K.position, &position));
	PetscCall(MatNullSpaceCreateRigidBody(position, &motions));
	PetscCall(MatSetNearNullSpace(h.rows, motions));
	PetscCall(MatNullSpaceDestroy(&motions));
	PetscCall(VecDestroy(&position));
	return 0;
}

PetscErrorCode setMatrix(Hierarchy& h)
{
	const auto& K = h.K;
	// PETSc only reads them
	PetscCall(MatCreateSeqAIJWithArrays(
	        PETSC_COMM_SELF, K.rows, K.rows, const_cast<int*>(K.start), const_cast<int*>(K.column), const_cast<double*>(K.value), &h.rows));
	PetscCall(MatSetBlockSize(h.rows, K.dim));
	PetscCall(MatSetOption(h.rows, MAT_USE_INODES, PETSC_FALSE)); // whose product takes three times as long
	// Not MAT_SPD: of a matrix that is not, PETSc would look for the largest eigenvalue by conjugate gradients and an iteration without end.
	PetscCall(MatSetOption(h.rows, MAT_SYMMETRIC, PETSC_TRUE));
	PetscCall(addRigidMotions(h));
	PetscCall(MatCreateShell(PETSC_COMM_SELF, K.rows, K.rows, K.rows, K.rows, &h, &h.product));
	PetscCall(MatShellSetOperation(h.product, MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)));
	PetscCall(MatSetOption(h.product, MAT_SYMMETRIC, PETSC_TRUE));
	return MatCreateVecs(h.rows, &h.r, &h.z);
}

/// Smoothed aggregation with Chebyshev's polynomial of the diagonal as smoother. Smoothers that invert blocks fail on coarse levels, where aggregates of one or
/// two nodes have fewer independent motions than unknowns. The first level of aggregates takes neighbours of neighbours: without that, setting up a cantilever
/// of 104,000 unknowns takes three times as long, for two thirds of the iterations.
PetscErrorCode setUp(Hierarchy& h)
{
	PetscCall(setMatrix(h));
	PetscCall(PCCreate(PETSC_COMM_SELF, &h.pc));
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
	PetscOptionsSetValue(nullptr, "-mat_no_inode", "1"); // of matrices that GAMG makes
	const PetscErrorCode code = setUp(*h);
	PetscOptionsClearValue(nullptr, "-mat_no_inode");
	return code ? nullptr : h.release();
}

PetscErrorCode cycle(Hierarchy& h, const double* r, double* z)
{
	PetscCall(VecPlaceArray(h.r, r));
	PetscCall(VecPlaceArray(h.z, z));
	PetscCall(PCApply(h.pc, h.r, h.z));
	PetscCall(VecResetArray(h.r));
	PetscCall(VecResetArray(h.z));
	PCFailedReason failure;
	PetscCall(PCGetFailedReason(h.pc, &failure));
	PetscCheck(failure == PC_NOERROR, PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED, "a level cannot be solved: %s", PCFailedReasons[failure]);
	return 0;
}

bool apply(void* hierarchy, const double* r, double* z, char* reason, int length)
{
	const Errors errors(reason, length);
	return cycle(*static_cast<Hierarchy*>(hierarchy), r, z) == 0;
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
