// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/distributed_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fields/shared_fields.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/petsc_library.hpp"
#include "core/solvers/solver_limits.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

const DistributedModule& library() { return *PetscLibrary::get().distributed; }

/// Without what multigrid needs.
DistributedRows viewOf(const NodeRows& rows, const std::vector<double>& value, bool isSymmetric)
{
	return { int(rows.widths.size()), rows.widths.data(), rows.dim,    rows.rows(), rows.all, rows.start.data(),
		 rows.column.data(),      value.data(),       isSymmetric, nullptr,     nullptr };
}

/// Powers of two, with which the diagonal is about one; where it has nothing the largest entry of the row.
Eigen::VectorXd scaleOf(const NodeRows& rows)
{
	return Eigen::VectorXd::NullaryExpr(rows.rows(), [&](Eigen::Index r) {
		double diagonal = 0, largest = 0;
		for (int e = rows.start[r]; e < rows.start[r + 1]; ++e) {
			largest = std::max(largest, std::abs(rows.value[e]));
			if (rows.column[e] == rows.first + int(r)) diagonal = std::abs(rows.value[e]);
		}
		const double size = diagonal > 0 ? diagonal : largest;
		return size > 0 ? std::ldexp(1, -std::ilogb(size) / 2) : 1.;
	});
}

} // namespace

/// Partition of a vector.
struct DistributedSolver::Partition {
	OwnedNodes        ownedNodes;
	std::vector<int>  dof;    ///< degrees of freedom of the rows of this process
	std::vector<int>  widths; ///< unknowns a node of each field
	std::vector<bool> isFree;

	/// From a vector by free degrees of freedom.
	Eigen::VectorXd own(const Eigen::VectorXd& b) const
	{
		Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(isFree.size()));
		for (Eigen::Index i = 0, number = 0; i < all.size(); ++i)
			if (isFree[i]) all[i] = b[number++];
		return ownOf(all);
	}
	Eigen::VectorXd ownOf(const Eigen::VectorXd& all) const
	{
		return Eigen::VectorXd::NullaryExpr(Eigen::Index(dof.size()), [&](Eigen::Index r) { return all[dof[r]]; });
	}
	Eigen::VectorXd all(const Eigen::VectorXd& own) const
	{
		Eigen::VectorXd all = Eigen::VectorXd::Zero(Eigen::Index(isFree.size()));
		for (std::size_t r = 0; r < dof.size(); ++r)
			all[dof[r]] = own[Eigen::Index(r)];
		complete(ownedNodes, widths, all);
		return all;
	}
	/// The way back.
	Eigen::VectorXd whole(const Eigen::VectorXd& own) const
	{
		Eigen::VectorXd x      = all(own);
		Eigen::Index    number = 0;
		for (Eigen::Index i = 0; i < x.size(); ++i)
			if (isFree[i]) x[number++] = x[i];
		x.conservativeResize(number);
		return x;
	}
};

struct DistributedSolver::Task {
	const NodeProblem&         problem;
	bool                       isSymmetric;
	Eigen::VectorXd            b; ///< on the free degrees of freedom, of size 1
	double                     tolerance;
	SolverTimes&               times;
	IterativeEffort&           effort;
	Eigen::VectorXd            x {};
	double                     error  = 1; ///< |b - K x| / |b|
	bool                       goesOn = false, hasPositions = false;
	std::string                failure {}; ///< message of the iterations
	std::optional<NodeRows>    rows {};    ///< for the library; read when they are needed
	std::unique_ptr<Partition> partition {};

	/// Empty, or why there are none.
	std::string readRows()
	{
		if (rows) return "";
		rows                       = problem.rows();
		const std::string obstacle = obstacleTo(rows, problem.ownedNodes(), hasPositions);
		if (!obstacle.empty()) rows.reset();
		else
			partition.reset(new Partition { problem.ownedNodes(), rows->dof, rows->widths, problem.unknowns().isFree });
		return obstacle;
	}
};

/// Factor of D K D, with ones on the diagonal.
struct DistributedSolver::Factor {
	Partition       partition;
	Eigen::VectorXd scale; ///< D of this process

	bool solve(void* solver, const Eigen::VectorXd& b, Eigen::VectorXd& x) const
	{
		x                           = b;
		const Eigen::VectorXd right = scale.cwiseProduct(partition.own(b));
		Eigen::VectorXd       own(right.size());
		if (!library().substitute(solver, right.data(), own.data())) return false;
		x = partition.whole(scale.cwiseProduct(own));
		return x.allFinite();
	}
};

DistributedSolver::DistributedSolver(bool isShared) : isShared_(isShared), solver_(library().create(isShared)) { }
DistributedSolver::~DistributedSolver() { library().destroy(solver_); }

SolverStatus DistributedSolver::solve(
        const NodeProblem& problem, bool isSymmetric, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance, SolverTimes& times,
        IterativeEffort& effort)
{
	const OneBlasThread guard;
	const double        size = b.stableNorm(); // its square may vanish or overflow
	x                        = b;
	factor_.reset();
	if (size == 0) return SolverStatus::iterative;
	Task task { problem, isSymmetric, b / size, tolerance, times, effort };
	if (method != LinearMethod::direct) {
		if (iterate(task, method) && task.x.allFinite()) return x = size * task.x, SolverStatus::iterative;
		++effort.fallbacks;
		effort.reason = task.failure;
	}
	const SolverStatus status = factorise(task);
	const Stopwatch    watch(times.solve);
	return status != SolverStatus::singular && factor_->solve(solver_, b, x) ? status : SolverStatus::singular;
}

std::string DistributedSolver::solveWithMultigrid(
        const NodeProblem& problem, bool isSymmetric, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, SolverTimes& times,
        IterativeEffort& effort)
{
	const OneBlasThread guard;
	const double        size = b.stableNorm();
	x                        = b;
	factor_.reset();
	if (size == 0) return "";
	Task task { problem, isSymmetric, b / size, tolerance, times, effort };
	if (!iterateWithMultigrid(task)) return task.failure;
	x = size * task.x;
	return x.allFinite() ? "" : "numbers are not finite";
}

bool DistributedSolver::solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const OneBlasThread guard;
	return factor_->solve(solver_, b, x);
}

/// Iterates like one process where K is symmetric and of one field; else an incomplete factor would depend on how the
/// nodes are cut.
bool DistributedSolver::iterate(Task& task, LinearMethod method)
{
	if (!task.isSymmetric || !task.problem.isOfOneField()) return iterateWithMultigrid(task);
	task.failure = overNodes_.solve(task.problem, task.b, task.tolerance, method, task.x, task.times, task.effort);
	return task.failure.empty();
}

bool DistributedSolver::iterateWithMultigrid(Task& task)
{
	if (!giveMatrix(task)) return false;
	if (task.problem.unknowns() == unknowns_ && task.problem.ownedNodes().start == start_) {
		const double expected = perDecade_ * std::log10(task.error / task.tolerance);
		const int    before   = task.effort.iterations;
		if (run(task, few + int(tooMany * expected))) {
			if (task.effort.iterations - before > few + worthRenewing * expected) unknowns_ = {};
			return true;
		}
	}
	setUp(task);
	const double error        = task.error;
	const int    before       = task.effort.iterations;
	const bool   hasConverged = run(task, mostWithMultigrid);
	perDecade_                = (task.effort.iterations - before) / std::max(std::log10(error / task.error), 1e-3);
	if (!hasConverged) unknowns_ = {};
	return hasConverged;
}

/// To the library.
bool DistributedSolver::giveMatrix(Task& task)
{
	const Stopwatch watch(task.times.solve);
	if (std::string obstacle = task.readRows(); !obstacle.empty()) return task.failure = obstacle, false;
	const NodeRows& rows = *task.rows;
	DistributedRows view = viewOf(rows, rows.value, task.isSymmetric);
	view.symmetricPart   = numbersOf(rows.symmetricPart, !task.isSymmetric || !task.problem.isOfOneField());
	view.position        = numbersOf(rows.position, task.hasPositions);
	library().setMatrix(solver_, &view);
	return true;
}

/// So many iterations with multigrid at most, from where it is. Whether it has converged.
bool DistributedSolver::run(Task& task, int atMost)
{
	const Stopwatch       watch(task.times.solve);
	const Eigen::VectorXd b = task.partition->own(task.b);
	Eigen::VectorXd       x = task.goesOn ? task.partition->own(task.x) : b;
	DistributedIteration  iteration { task.goesOn, task.tolerance, atMost, 0, task.error, false, false };
	library().iterate(solver_, &iteration, b.data(), x.data());
	task.x = task.partition->whole(x);
	task.effort.iterations += iteration.made;
	task.error  = iteration.error;
	task.goesOn = !iteration.hasBrokenDown && std::isfinite(iteration.error);
	if (!iteration.hasConverged)
		task.failure = iteration.hasBrokenDown ? "multigrid: GMRES breaks down, or a level cannot be solved"
		                                       : "multigrid: no convergence in " + std::to_string(iteration.made) + " iterations";
	return iteration.hasConverged;
}

void DistributedSolver::setUp(Task& task)
{
	const Stopwatch watch(task.times.factorise);
	library().setUp(solver_);
	++task.effort.hierarchies;
	unknowns_ = task.problem.unknowns();
	start_    = task.problem.ownedNodes().start;
}

/// D K D with ones on the diagonal, as in one process.
SolverStatus DistributedSolver::factorise(Task& task)
{
	const Stopwatch watch(task.times.factorise);
	if (std::string obstacle = task.readRows(); !obstacle.empty()) return task.effort.reason = obstacle, SolverStatus::singular;
	const NodeRows&       rows  = *task.rows;
	const Eigen::VectorXd scale = scaleOf(rows), ofAll = task.partition->all(scale);
	std::vector<double>   scaled(rows.value);
	for (int r = 0; r < rows.rows(); ++r)
		for (int e = rows.start[r]; e < rows.start[r + 1]; ++e)
			scaled[e] *= scale[r] * ofAll[rows.columnDof[rows.column[e]]];
	const auto view = viewOf(rows, scaled, task.isSymmetric);
	library().setMatrix(solver_, &view);
	int negative = 0;
	if (!library().factorise(solver_, smallestPivot, &negative)) return SolverStatus::singular;
	factor_.reset(new Factor { *task.partition, scale });
	return task.isSymmetric && negative == 0 ? SolverStatus::cholesky : SolverStatus::lu;
}

} // namespace gimpm
