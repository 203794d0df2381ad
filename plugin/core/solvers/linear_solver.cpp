// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/linear_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/cholesky.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/distributed_solver.hpp"
#include "core/solvers/gmres.hpp"
#include "core/solvers/lu.hpp"
#include "core/solvers/multigrid.hpp"
#include "core/solvers/node_solver.hpp"
#include "core/solvers/reversed.hpp"
#include "core/solvers/solver_limits.hpp"

namespace gimpm {
namespace {

/// Operations of the factorisation for each stored entry of K above which an iterative solver is preferred. The number
/// grows with the unknowns in 3D, with their square root in 2D; so does the number of conjugate gradients' iterations,
/// with the cube and the square root. This is well past the number where both take as long, because the direct solver
/// is the one that finds singular matrices and is not slowed down by ill-conditioned ones.
constexpr double worthwhileFlops = 1e4;

/// Margin of an estimate from the positions of the nodes: it may be less than half of what the analysis finds, which
/// takes longer than the decision is worth.
constexpr double safetyFactor = 2;

bool isTooLarge(const LinearProblem& K) { return K.ofAllFields() && K.ofAllFields()->needsMoreFlopsPerEntry(safetyFactor * worthwhileFlops); }

/// Unknowns from which their order is sought by dissection of the grid: there CHOLMOD's own order takes longer to find,
/// and is no better. Without pivoting a pressure shall come after the displacements of its node: no other order sees
/// to that.
constexpr int worthDissecting = 4000;

Order ordering(const LinearProblem& K)
{
	if (K.size() < worthDissecting && !K.hasSigns()) return {};
	Order order = K.ordering();
	for (int& number : order.numbers)
		number = K.size() - 1 - number; // order of the matrix in reverse
	return order;
}

/// K x, or K^T x, of a matrix given by all of its entries.
Eigen::VectorXd timesGeneral(const Csc& K, const Eigen::VectorXd& x, bool transposed)
{
	Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			if (transposed) y[c] += K.value[e] * x[K.row[e]];
			else
				y[K.row[e]] += K.value[e] * x[c];
	return y;
}

/// Compressed, for conjugate gradients.
class InColumns : public SymmetricOperator {
public:
	explicit InColumns(const SymmetricCsc& K) : K_(K) { }
	void            multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override { y = K_ * x; }
	Eigen::VectorXd diagonal() const override
	{
		return Eigen::VectorXd::NullaryExpr(K_.size(), [&](Eigen::Index c) { return diagonalOf(K_, int(c)); });
	}

private:
	const SymmetricCsc& K_;
};

/// Empty, or why it fails. Of displacements in space an incomplete factor gets less far than the diagonal; in the
/// plane, and with pressures beside displacements, it is the other way round.
std::string byGmres(const LinearProblem& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
{
	const bool diagonalFirst = K.overNodes() && K.overNodes()->isInSpace();
	const bool hasConverged  = K.isSymmetric() ? gmres(bothTriangles(K.symmetric()), b, tolerance, x, iterations, diagonalFirst)
	                                           : gmres(K.general(), b, tolerance, x, iterations, diagonalFirst);
	return hasConverged ? "" : "GMRES does not converge";
}

/// Empty, or why it fails.
std::string inColumns(const SymmetricCsc& compressed, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
{
	const InColumns    K(compressed);
	ConjugateGradients iteration(K, b, tolerance);
	iteration.iterate(mostIterations);
	iterations += iteration.made();
	return iteration.take(x);
}

} // namespace

/// The last matrix that was given to a direct solver, and its factor.
struct LinearSolver::Direct {
	Csc             scaled; // rows and columns in the opposite order; its pattern is that of the symbolic analysis
	Eigen::VectorXd scale;  // scale of rows and columns, in their own order
	Cholesky        cholesky;
	Lu              lu;
	GeneralCsc      full;           // symmetric matrix that Cholesky refused, for LU
	const Csc*      ofLu = nullptr; // scaled or full; null: the factor is another one

	// Factor of a matrix that is symmetric by signs of its rows; null: it needs no pivoting, or Cholesky's factor.
	std::unique_ptr<Multifrontal> indefinite;
	bool                          hasSigns      = false; // the factor is L S L^T of such a matrix, or L S U of a general one
	bool                          isGeneral     = false;
	bool                          isForDefinite = true;  // the symbolic analysis
	bool                          needsPivots   = false; // no factor of that pattern would do without them

	bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
	{
		const Eigen::VectorXd right    = reversed(scale.cwiseProduct(b));
		const bool            isSolved = ofLu ? lu.solve(*ofLu, right, x, transposed)
		                   : indefinite       ? indefinite->solve(scaled, right, x, false)
		                   : hasSigns         ? solveSigned(right, x, transposed)
		                                      : cholesky.solve(right, x);
		if (!isSolved) return false;
		x = reversed(x).cwiseProduct(scale);
		return true;
	}
	/// The residual tells whether pivots should have been looked for; they are if it stays large. What is not
	/// symmetric has no sign that its pivots are any good, and has to be as precise as with pivots.
	bool solveSigned(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
	{
		const double    enough = isGeneral ? 1e-14 : 1e-12; // on the diagonal of the matrix there is about one
		constexpr int   most   = 2;
		Eigen::VectorXd more;
		bool            isSolved = cholesky.solveSigned(b, x, transposed);
		for (int refined = 0; isSolved; ++refined) {
			const Eigen::VectorXd residual = b - (isGeneral ? timesGeneral(scaled, x, transposed) : timesSymmetric(scaled, x));
			if (residual.norm() <= enough * (b.norm() + x.norm())) return true;
			isSolved = refined < most && cholesky.solveSigned(residual, more, transposed);
			if (isSolved) x += more;
		}
		if (isGeneral) return factoriseGeneralPivoting() && lu.solve(scaled, b, x, transposed);
		needsPivots = true;
		if (factorisePivoting()) return indefinite->solve(scaled, b, x, false);
		return factoriseFull() && lu.solve(full, b, x, false);
	}
	/// A row of which less is left than the pivoting factor would take is for that one to judge. Each matrix is
	/// tried anew, so that what a solution is does not depend on what was solved before.
	bool factoriseGeneral()
	{
		hasSigns = cholesky.isAnalysed() && cholesky.factoriseGeneral(scaled, smallestPivot / Lu::pivotOfRow);
		return hasSigns || factoriseGeneralPivoting();
	}
	bool factoriseGeneralPivoting()
	{
		hasSigns = false, ofLu = &scaled;
		return lu.factorise(scaled, cholesky.isAnalysed() ? cholesky.ordering() : nullptr, smallestPivot);
	}
	/// Symmetric and scaled; in the order that is good for Cholesky.
	bool factoriseIndefinite()
	{
		hasSigns = !needsPivots && cholesky.isAnalysed() && cholesky.factoriseSigned(scaled, smallestPivot);
		if (hasSigns) return true;
		needsPivots = true;
		return factorisePivoting();
	}
	/// Its diagonal may be anything, so that UMFPACK judges how to order it.
	bool factoriseFull()
	{
		full = bothTriangles(scaled), ofLu = &full;
		return lu.factorise(full, nullptr, smallestPivot);
	}
	bool factorisePivoting()
	{
		hasSigns = false;
		if (!cholesky.isAnalysed()) return false;
		if (!indefinite) indefinite = std::make_unique<Multifrontal>(scaled, Multifrontal::Form::triangle, cholesky.ordering());
		if (indefinite->factorise(scaled, smallestPivot / Lu::pivotOfRow)) return true;
		indefinite.reset();
		return false;
	}
};

LinearSolver::LinearSolver() : direct_(new Direct), overNodes_(new NodeSolver) { }
LinearSolver::~LinearSolver()                                  = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept            = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

LinearSolver::FactorSize LinearSolver::analyse(const LinearProblem& problem)
{
	const FewerThreads guard(0);
	const Csc&         K                                                                                         = problem.stored();
	auto& [scaled, scale, cholesky, lu, full, ofLu, indefinite, hasSigns, isGeneral, isForDefinite, needsPivots] = *direct_;
	const bool isDefinite = problem.isSymmetric() && !problem.hasSigns();
	if (!cholesky.isAnalysed() || isDefinite != isForDefinite || !isReverse(K, scaled)) {
		const Stopwatch watch(times_.analyse);
		reverse(K, scaled);
		scaled.value.resize(K.value.size());
		lu.forget();
		indefinite.reset();
		needsPivots   = false;
		isForDefinite = isDefinite;
		cholesky.analyse(scaled, ordering(problem), isDefinite);
	}
	const double factors = problem.isSymmetric() ? 1 : 2;
	return { factors * cholesky.entries(), factors * cholesky.flops() };
}

LinearSolver::Status LinearSolver::factorise(const LinearProblem& problem)
{
	const Stopwatch watch(times_.factorise);
	auto& [scaled, values, cholesky, lu, full, ofLu, indefinite, hasSigns, isGeneral, isForDefinite, needsPivots] = *direct_;
	lu.forgetFactor();
	full      = {};
	ofLu      = nullptr;
	isGeneral = !problem.isSymmetric();
	values    = scale(problem.stored(), scaled.value);
	if (problem.isSymmetric()) {
		if (problem.hasSigns()) {
			if (direct_->factoriseIndefinite()) return Status::lu;
		} else if (indefinite.reset(), hasSigns = false; cholesky.factorise(scaled))
			return cholesky.rcond() < smallestPivot ? Status::singular : Status::cholesky;
		return direct_->factoriseFull() ? Status::lu : Status::singular;
	}
	indefinite.reset();
	return direct_->factoriseGeneral() ? Status::lu : Status::singular;
}

LinearSolver::Status LinearSolver::solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const FewerThreads guard(analyse(K).flops);
	const Status       status = factorise(K);
	const Stopwatch    watch(times_.solve);
	return status != Status::singular && direct_->solve(b, x, false) ? status : Status::singular;
}

bool LinearSolver::prefersIterative(const LinearProblem& K)
{
	if (isTooLarge(K)) return true;
	const double flops = analyse(K).flops;
	// No factor: it is too large for CHOLMOD.
	return !direct_->cholesky.isAnalysed() || flops > worthwhileFlops * double(K.stored().row.size());
}

bool LinearSolver::solveIteratively(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, LinearMethod method)
{
	std::string failure;
	if (!K.isOfOneField()) failure = solveFields(K, b, x, tolerance, method);
	else if (K.isSymmetric() && K.overNodes())
		failure = overNodes_->solve(*K.overNodes(), b, tolerance, method, x, times_, effort_);
	else {
		const Stopwatch watch(times_.solve);
		failure = K.isSymmetric() ? inColumns(K.symmetric(), b, tolerance, x, effort_.iterations) : byGmres(K, b, tolerance, x, effort_.iterations);
	}
	if (!failure.empty()) effort_.reason = failure;
	return failure.empty();
}

void LinearSolver::openTogether(const OwnedNodes& ownedNodes)
{
	if (!together_ || together_->isShared() == ownedNodes.isWhole()) together_.reset(new DistributedSolver(!ownedNodes.isWhole()));
}

/// Empty, or why it fails. Symmetric matrices of several fields often are not positive definite: what leaves a body of
/// saturated soil is pushed by a pressure that pushes it apart.
std::string LinearSolver::solveFields(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, LinearMethod method)
{
	if (method != LinearMethod::iterative) {
		const std::string absence = Multigrid::absence();
		if (absence.empty()) {
			openTogether(K.ofAllFields()->ownedNodes());
			return together_->solveWithMultigrid(*K.ofAllFields(), K.isSymmetric(), b, x, tolerance, times_, effort_);
		}
		if (method == LinearMethod::multigrid) return "multigrid: " + absence;
	}
	const Stopwatch watch(times_.solve);
	if (K.isSymmetric() && inColumns(K.symmetric(), b, tolerance, x, effort_.iterations).empty()) return "";
	return byGmres(K, b, tolerance, x, effort_.iterations);
}

bool LinearSolver::staysOverNodes(LinearMethod method, const LinearProblem& K)
{
	if (K.isShared()) return true;
	if (!K.isOfOneField()) return method == LinearMethod::multigrid || (method == LinearMethod::automatic && isTooLarge(K));
	return K.overNodes() && K.isSymmetric() && (isAlwaysIterative(method) || (method == LinearMethod::automatic && isTooLarge(K)));
}

LinearSolver::Status LinearSolver::solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance)
{
	if (K.isShared()) return solveTogether(K, b, x, method, tolerance);
	if (isIterative(method, K)) {
		if (solveIteratively(K, b, x, tolerance, method)) return Status::iterative;
		++effort_.fallbacks;
	}
	return solve(K, b, x);
}

/// Solves together. The positions of the nodes decide whether a factor is worthwhile: an analysis would need the whole
/// matrix in one process.
LinearSolver::Status LinearSolver::solveTogether(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance)
{
	openTogether(K.ofAllFields()->ownedNodes());
	if (method == LinearMethod::automatic) {
		// Estimate by the blocks that each of them knows.
		std::int64_t isLarge = K.ofAllFields()->needsMoreFlopsPerEntry(worthwhileFlops);
		K.ofAllFields()->ownedNodes().processes.smallest(&isLarge, 1);
		if (!isLarge) method = LinearMethod::direct;
	}
	return together_->solve(*K.ofAllFields(), K.isSymmetric(), b, x, method, tolerance, times_, effort_);
}

bool LinearSolver::solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
{
	if (together_ && together_->hasFactor()) return together_->solveAgain(b, x);
	const FewerThreads guard(0);
	return direct_->solve(b, x, transposed);
}

} // namespace gimpm
