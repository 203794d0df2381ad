// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/distributed_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/petsc_library.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

const DistributedModule& library() { return *PetscLibrary::get().distributed; }

constexpr double smallestPivot = 1e-12; ///< as in one process

/// As in one process: iterations with the diagonal before multigrid is tried, and those that multigrid is given.
constexpr int patience = 300, mostWithMultigrid = 250;

/// Iterations over those of the first solve with which multigrid is given up at once, and with which it is renewed for the next solve.
constexpr double tooMany = 2, worthRenewing = 1.5;

constexpr int few = 5; ///< iterations which say nothing

DistributedRows viewOf(const NodeRows& rows, const std::vector<double>& value)
{
	return { rows.dim,
		 rows.rows(),
		 rows.all,
		 rows.start.data(),
		 rows.column.data(),
		 value.data(),
		 rows.symmetricPart.empty() ? nullptr : rows.symmetricPart.data(),
		 rows.position.empty() ? nullptr : rows.position.data() };
}

/// Why not all processes can go on with their rows; empty if they can.
std::string obstacleOf(const std::optional<NodeRows>& rows, const NodeShare& share)
{
	std::int64_t isFinite[2] = { rows.has_value(), 0 };
	if (rows) isFinite[1] = std::all_of(rows->value.begin(), rows->value.end(), [](double value) { return std::isfinite(value); });
	share.processes.smallest(isFinite, 2);
	if (!isFinite[0]) return "the rows of one process have more entries than can be counted";
	return isFinite[1] ? "" : "the matrix has numbers that are not finite";
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

/// Which part of a vector is whose.
struct DistributedSolver::Spread {
	NodeShare         share;
	std::vector<int>  dof; ///< of the rows of this process
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
		share.complete(all);
		return all;
	}
	/// By the rows of all processes, which nodes have that are not held altogether.
	std::vector<double> ofAllRows(const Eigen::VectorXd& own, const NodeRows& rows) const
	{
		const Eigen::VectorXd byDof = all(own);
		std::vector<double>   byRow;
		for (Eigen::Index i = 0; i < byDof.size(); i += rows.dim)
			if (std::any_of(isFree.begin() + i, isFree.begin() + i + rows.dim, [](bool is) { return is; }))
				byRow.insert(byRow.end(), byDof.data() + i, byDof.data() + i + rows.dim);
		return byRow;
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
	const NodeRows&  rows;
	const Unknowns&  unknowns;
	const Spread&    spread;
	bool             isSymmetric;
	Eigen::VectorXd  b, x; ///< of this process
	double           tolerance;
	SolverTimes&     times;
	IterativeEffort& effort;
	double           error  = 1; ///< |b - K x| / |b|
	bool             goesOn = false, isIndefinite = false;
};

/// As the factor is that of D K D, with ones on the diagonal.
struct DistributedSolver::Factor {
	Spread          spread;
	Eigen::VectorXd scale; ///< D of this process

	bool solve(void* solver, const Eigen::VectorXd& b, Eigen::VectorXd& x) const
	{
		x                           = b;
		const Eigen::VectorXd right = scale.cwiseProduct(spread.own(b));
		Eigen::VectorXd       own(right.size());
		if (!library().substitute(solver, right.data(), own.data())) return false;
		x = spread.whole(scale.cwiseProduct(own));
		return x.allFinite();
	}
};

DistributedSolver::DistributedSolver() : solver_(library().create()) { }
DistributedSolver::~DistributedSolver() { library().destroy(solver_); }

SolverStatus DistributedSolver::solve(
        const NodeProblem& problem, bool isSymmetric, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance, SolverTimes& times,
        IterativeEffort& effort)
{
	const OneBlasThread           guard;
	const NodeShare&              share    = *problem.share();
	const Unknowns                unknowns = problem.unknowns();
	const std::optional<NodeRows> rows     = problem.rows();
	const double                  size     = b.stableNorm(); // its square may vanish or overflow
	x                                      = b;
	factor_.reset();
	if (size == 0) return SolverStatus::iterative;
	if (const std::string obstacle = obstacleOf(rows, share); !obstacle.empty()) return effort.reason = obstacle, SolverStatus::singular;
	const Spread          spread { share, rows->dof, unknowns.isFree };
	const Eigen::VectorXd own = spread.own(b) / size;
	Task                  task { *rows, unknowns, spread, isSymmetric, own, own, tolerance, times, effort };
	if (method != LinearMethod::direct) {
		if (iterate(task, method)) {
			x = size * spread.whole(task.x);
			if (x.allFinite()) return SolverStatus::iterative;
		}
		++effort.fallbacks;
	}
	const SolverStatus status = factorise(task);
	const Stopwatch    watch(times.solve);
	return status != SolverStatus::singular && factor_->solve(solver_, b, x) ? status : SolverStatus::singular;
}

bool DistributedSolver::solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const OneBlasThread guard;
	return factor_->solve(solver_, b, x);
}

bool DistributedSolver::iterate(Task& task, LinearMethod method)
{
	const auto rows = viewOf(task.rows, task.rows.value);
	library().setMatrix(solver_, &rows);
	if (task.isSymmetric && method == LinearMethod::iterative) return run(task, false, mostIterations);
	const bool isTried = task.isSymmetric && method == LinearMethod::automatic && !diagonalFails_;
	if (isTried && run(task, false, patience)) return true;
	if (task.isIndefinite) return false; // which multigrid does not change
	diagonalFails_ = diagonalFails_ || isTried;
	return iterateWithMultigrid(task);
}

bool DistributedSolver::iterateWithMultigrid(Task& task)
{
	if (task.unknowns == unknowns_ && task.spread.share.start == start_) {
		const double expected = perDecade_ * std::log10(task.error / task.tolerance);
		const int    before   = task.effort.iterations;
		if (run(task, true, few + int(tooMany * expected))) {
			if (task.effort.iterations - before > few + worthRenewing * expected) unknowns_ = {};
			return true;
		}
	}
	setUp(task);
	const double error        = task.error;
	const int    before       = task.effort.iterations;
	const bool   hasConverged = run(task, true, mostWithMultigrid);
	perDecade_                = (task.effort.iterations - before) / std::max(std::log10(error / task.error), 1e-3);
	if (!hasConverged) unknowns_ = {};
	return hasConverged;
}

/// So many iterations at most, from where it is. Whether it has converged.
bool DistributedSolver::run(Task& task, bool withMultigrid, int atMost)
{
	const Stopwatch      watch(task.times.solve);
	DistributedIteration iteration { withMultigrid, task.goesOn, task.tolerance, atMost, 0, task.error, false, false };
	library().iterate(solver_, &iteration, task.b.data(), task.x.data());
	task.effort.iterations += iteration.made;
	task.error        = iteration.error;
	task.goesOn       = !iteration.hasBrokenDown && std::isfinite(iteration.error);
	task.isIndefinite = iteration.hasBrokenDown && !withMultigrid;
	if (!iteration.hasConverged)
		task.effort.reason = std::string(withMultigrid ? "multigrid" : "conjugate gradients")
		        + (iteration.hasBrokenDown ? ": the matrix is not positive definite"
		                                   : ": no convergence in " + std::to_string(iteration.made) + " iterations");
	return iteration.hasConverged;
}

void DistributedSolver::setUp(Task& task)
{
	const Stopwatch watch(task.times.factorise);
	library().setUp(solver_);
	++task.effort.hierarchies;
	unknowns_ = task.unknowns;
	start_    = task.spread.share.start;
}

/// D K D with ones on the diagonal, as in one process.
SolverStatus DistributedSolver::factorise(Task& task)
{
	const Stopwatch       watch(task.times.factorise);
	const NodeRows&       rows  = task.rows;
	const Eigen::VectorXd scale = scaleOf(rows);
	const auto            ofAll = task.spread.ofAllRows(scale, rows);
	std::vector<double>   scaled(rows.value);
	for (int r = 0; r < rows.rows(); ++r)
		for (int e = rows.start[r]; e < rows.start[r + 1]; ++e)
			scaled[e] *= scale[r] * ofAll[rows.column[e]];
	const auto view = viewOf(rows, scaled);
	library().setMatrix(solver_, &view);
	int negative = 0;
	if (!library().factorise(solver_, smallestPivot, &negative)) return SolverStatus::singular;
	factor_.reset(new Factor { task.spread, scale });
	return task.isSymmetric && negative == 0 ? SolverStatus::cholesky : SolverStatus::lu;
}

} // namespace gimpm
