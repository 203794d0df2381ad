// SPDX-License-Identifier: GPL-2.0-or-later
// mpm_petsc.so: several processes, which talk by MPI and solve together by PETSc.
#include "core/solvers/distributed_module.hpp"
#include "petsc/begin.hpp"
#include "petsc/fields.hpp"
#include "petsc/talk.hpp"
#include <algorithm>
#include <petscksp.h>

namespace {

bool beginProcesses(int* rank, int* size, char* reason, int length)
{
	const Errors errors(reason, length);
	if (begin()) return false;
	beginToTalk();
	*rank = rankOf(), *size = sizeOf();
	return true;
}

struct Solver {
	const bool                isShared;
	bool                      hasFailed = false;                ///< local failure since the matrix was given, which is not shared
	Mat                       K = nullptr, symmetric = nullptr; ///< last matrix; the same where it is symmetric
	PC                        multigrid = nullptr;
	KSP                       factor    = nullptr;
	Vec                       b = nullptr, x = nullptr;
	std::vector<BlockOfField> fields; ///< blocks of several fields

	explicit Solver(bool isShared) : isShared(isShared) { }
	Solver(const Solver&)            = delete;
	Solver& operator=(const Solver&) = delete;
	~Solver()
	{
		clear();
		PCDestroy(&multigrid);
	}
	/// All but multigrid, which keeps the matrix that it is of.
	void clear() { MatDestroy(&K), MatDestroy(&symmetric), KSPDestroy(&factor), VecDestroy(&b), VecDestroy(&x); }

	MPI_Comm comm() const { return isShared ? ::comm : PETSC_COMM_SELF; }
};

/// f() of PETSc's. Several processes have no errors after it.
template <class F> void check(Solver& s, F&& f)
{
	char         reason[512] = "PETSc fails";
	const Errors errors(reason, sizeof reason);
	if (!f()) return;
	if (s.isShared) stop(reason);
	s.hasFailed = true;
}

PetscErrorCode takeMatrix(Solver& s, const gimpm::DistributedRows& rows)
{
	s.clear();
	s.fields.clear();
	CompressedRows own { s.comm(), rows.dim, rows.rows, rows.all, rows.start, rows.column, rows.value, true };
	PetscCall(makeMatrix(own, rows.isSymmetric, &s.K));
	s.symmetric = s.K;
	own.value   = rows.symmetricPart;
	if (rows.symmetricPart) PetscCall(makeMatrix(own, rows.isSymmetric || rows.fields == 1, &s.symmetric));
	else
		PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(s.K)));
	if (rows.fields == 1) PetscCall(addRigidMotions(s.symmetric, own, rows.position));
	else
		PetscCall(findBlocks(own, rows.fields, rows.widths, rows.position, s.fields));
	return MatCreateVecs(s.K, &s.x, &s.b);
}

/// Multigrid as in one process (multigrid.cpp).
PetscErrorCode makeMultigrid(Solver& s)
{
	PetscCall(PCDestroy(&s.multigrid));
	PetscCall(PCCreate(s.comm(), &s.multigrid));
	PetscCall(PCSetOptionsPrefix(s.multigrid, "mpm_"));
	PetscCall(PCSetOperators(s.multigrid, s.symmetric, s.symmetric));
	PetscCall(PetscOptionsSetValue(nullptr, "-mat_no_inode", "1")); // for matrices that GAMG makes
	PetscCall(s.fields.empty() ? useMultigrid(s.multigrid) : useMultigridByField(s.multigrid, s.fields));
	return PetscOptionsClearValue(nullptr, "-mat_no_inode");
}

PetscErrorCode copy(Vec to, const double* from)
{
	int     rows;
	double* numbers;
	PetscCall(VecGetLocalSize(to, &rows));
	PetscCall(VecGetArrayWrite(to, &numbers));
	std::copy(from, from + rows, numbers);
	return VecRestoreArrayWrite(to, &numbers);
}

PetscErrorCode copy(double* to, Vec from)
{
	int           rows;
	const double* numbers;
	PetscCall(VecGetLocalSize(from, &rows));
	PetscCall(VecGetArrayRead(from, &numbers));
	std::copy(numbers, numbers + rows, to);
	return VecRestoreArrayRead(from, &numbers);
}

PetscErrorCode makeIteration(Solver& s, const gimpm::DistributedIteration& wanted, KSP* ksp)
{
	PetscCall(KSPCreate(s.comm(), ksp));
	PetscCall(KSPSetOptionsPrefix(*ksp, "mpm_"));
	PetscCall(KSPSetPC(*ksp, s.multigrid));
	PetscCall(KSPSetReusePreconditioner(*ksp, PETSC_TRUE));
	Mat before;
	PetscCall(PCGetOperators(s.multigrid, nullptr, &before)); // the one that it is of
	PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(before)));
	PetscCall(KSPSetOperators(*ksp, s.K, before));
	PetscCall(MatDestroy(&before));
	PetscCall(KSPSetType(*ksp, KSPGMRES));
	PetscCall(KSPGMRESSetRestart(*ksp, 100));
	// Else what it takes for the residual may be less than what there is.
	if (!s.fields.empty()) PetscCall(KSPGMRESSetCGSRefinementType(*ksp, KSP_GMRES_CGS_REFINE_IFNEEDED));
	PetscCall(KSPSetPCSide(*ksp, PC_RIGHT));
	PetscCall(KSPSetNormType(*ksp, KSP_NORM_UNPRECONDITIONED));
	PetscCall(KSPSetTolerances(*ksp, wanted.tolerance, 1e-300, 1e30, wanted.atMost));
	return KSPSetInitialGuessNonzero(*ksp, wanted.goesOn ? PETSC_TRUE : PETSC_FALSE);
}

PetscErrorCode run(Solver& s, gimpm::DistributedIteration& iteration, const double* b, double* x)
{
	KSP                ksp;
	KSPConvergedReason reason;
	PetscCall(makeIteration(s, iteration, &ksp));
	PetscCall(copy(s.b, b));
	if (iteration.goesOn) PetscCall(copy(s.x, x));
	PetscCall(KSPSolve(ksp, s.b, s.x));
	PetscCall(KSPGetIterationNumber(ksp, &iteration.made));
	PetscCall(KSPGetResidualNorm(ksp, &iteration.error));
	PetscCall(KSPGetConvergedReason(ksp, &reason));
	iteration.hasConverged  = reason > 0;
	iteration.hasBrokenDown = reason < 0 && reason != KSP_DIVERGED_ITS;
	PetscCall(copy(x, s.x));
	return KSPDestroy(&ksp);
}

PetscErrorCode makeFactor(Solver& s, double smallestPivot, int moreMemory, PCFailedReason* failure, int* negative)
{
	PC  pc;
	Mat F;
	PetscCall(KSPDestroy(&s.factor));
	PetscCall(KSPCreate(s.comm(), &s.factor));
	PetscCall(KSPSetOptionsPrefix(s.factor, "mpm_"));
	PetscCall(KSPSetOperators(s.factor, s.K, s.K));
	PetscCall(KSPSetType(s.factor, KSPPREONLY));
	PetscCall(KSPGetPC(s.factor, &pc));
	PetscBool isKnown, isSymmetric;
	PetscCall(MatIsSymmetricKnown(s.K, &isKnown, &isSymmetric));
	isSymmetric = PetscBool(isKnown && isSymmetric);
	PetscCall(PCSetType(pc, isSymmetric ? PCCHOLESKY : PCLU)); // for a matrix that is not positive definite, too
	PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
	PetscCall(PCFactorSetUpMatSolverType(pc));
	PetscCall(PCFactorGetMatrix(pc, &F));
	PetscCall(MatMumpsSetIcntl(F, 6, 0)); // the diagonal is there, and about one
	PetscCall(MatMumpsSetIcntl(F, 8, 0));
	PetscCall(MatMumpsSetIcntl(F, 14, moreMemory));
	PetscCall(MatMumpsSetIcntl(F, 24, 1)); // null pivots are counted
	PetscCall(MatMumpsSetCntl(F, 3, smallestPivot));
	PetscCall(PCSetUp(pc));
	PetscCall(PCGetFailedReason(pc, failure));
	int nullPivots = 0;
	PetscCall(MatMumpsGetInfog(F, 28, &nullPivots));
	if (nullPivots > 0 && *failure == PC_NOERROR) *failure = PC_FACTOR_NUMERIC_ZEROPIVOT;
	*negative = 0;
	if (isSymmetric) PetscCall(MatMumpsGetInfog(F, 12, negative));
	return 0;
}

PetscErrorCode substituteIn(Solver& s, const double* b, double* x, bool* hasSolved)
{
	KSPConvergedReason reason;
	PetscCall(copy(s.b, b));
	PetscCall(KSPSolve(s.factor, s.b, s.x));
	PetscCall(KSPGetConvergedReason(s.factor, &reason));
	*hasSolved = reason > 0;
	return copy(x, s.x);
}

void* create(bool isShared)
{
	auto* const s = new Solver(isShared);
	check(*s, [] { return begin(); });
	return s;
}

void destroy(void* solver)
{
	char         ignored[256];
	const Errors errors(ignored, sizeof ignored); // nothing can be done about them
	delete static_cast<Solver*>(solver);
}

void setMatrix(void* solver, const gimpm::DistributedRows* rows)
{
	auto& s     = *static_cast<Solver*>(solver);
	s.hasFailed = false;
	check(s, [&] { return takeMatrix(s, *rows); });
}

void setUp(void* solver)
{
	auto& s = *static_cast<Solver*>(solver);
	if (!s.hasFailed) check(s, [&] { return makeMultigrid(s); });
}

void iterate(void* solver, gimpm::DistributedIteration* iteration, const double* b, double* x)
{
	auto& s = *static_cast<Solver*>(solver);
	if (!s.hasFailed) check(s, [&] { return run(s, *iteration, b, x); });
	if (s.hasFailed) iteration->hasConverged = false, iteration->hasBrokenDown = true;
}

bool factorise(void* solver, double smallestPivot, int* negativePivots)
{
	PCFailedReason failure = PC_NOERROR;
	// Pivots off the diagonal take more memory than the analysis can foresee.
	for (const int percent : { 20, 100, 400 }) {
		auto& s = *static_cast<Solver*>(solver);
		check(s, [&] { return makeFactor(s, smallestPivot, percent, &failure, negativePivots); });
		if (s.hasFailed) return false;
		if (failure != PC_FACTOR_OUTMEMORY) break;
	}
	return failure == PC_NOERROR;
}

bool substitute(void* solver, const double* b, double* x)
{
	bool  hasSolved = false;
	auto& s         = *static_cast<Solver*>(solver);
	check(s, [&] { return substituteIn(s, b, x, &hasSolved); });
	return hasSolved;
}

constexpr gimpm::DistributedModule module { gimpm::distributedVersion,
	                                    &beginProcesses,
	                                    &smallest,
	                                    &gather,
	                                    &exchange,
	                                    &tell,
	                                    &sent,
	                                    &create,
	                                    &destroy,
	                                    &setMatrix,
	                                    &setUp,
	                                    &iterate,
	                                    &factorise,
	                                    &substitute };

}

extern "C" __attribute__((visibility("default"))) const gimpm::DistributedModule* mpm_distributed() { return &module; }
