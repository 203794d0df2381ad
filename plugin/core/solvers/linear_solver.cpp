// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/linear_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/cholesky.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/gmres.hpp"
#include "core/solvers/lu.hpp"
#include "core/solvers/node_solver.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// A pivot that is left of a row's diagonal of about one. Below it, round-off of the rows before is what it consists of.
constexpr double smallestPivot = 1e-12;

/// Operations of the factorisation for each stored entry of K above which an iterative solver is preferred. The number grows with the unknowns
/// in 3D, with their square root in 2D; so does the number of conjugate gradients' iterations, with the cube and the square root. Measured on
/// the slope with a weak layer, one thread: unknowns, operations an entry, factor [MB], factorisation [s], conjugate gradients to 1e-2 and
/// 1e-4 [s].
///   3D    3,700     830     5  0.016  0.007  0.012
///        14,200   5,600    47  0.22   0.03   0.06
///        28,100   6,300    91  0.35   0.08   0.14
///       109,200  39,900   784  5.5    0.37   0.58
///   2D   35,000     960    18  0.06   0.12   0.27
///       139,700   2,050    89  0.29   1.5    2.2
/// So 3D changes over between 20,000 and 50,000 unknowns, well past the point where both are equal, because the direct solver is the one
/// that finds singular matrices and is not slowed down by ill-conditioned ones; 2D would at some 3 million.
constexpr double worthwhileFlops = 1e4;

/// What the places of the nodes say of it must be beyond doubt: over 13 matrices of slopes, cubes and beams in 3D it was .4 to .9 of what the analysis finds. That takes
/// longer than the decision is worth: 2.7 to 5.6 s for 170,000 unknowns.
constexpr double beyondDoubt = 2;

bool isTooLarge(const LinearProblem& K) { return K.overNodes() && K.overNodes()->needsMoreFlopsPerEntry(beyondDoubt * worthwhileFlops); }

/// Zero where there is none.
double diagonalOf(const Csc& K, int c)
{
	const auto end = K.row.begin() + K.start[c + 1], entry = std::lower_bound(K.row.begin() + K.start[c], end, c);
	return entry != end && *entry == c ? K.value[entry - K.row.begin()] : 0;
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

/// Empty, or why it fails.
std::string inColumns(const SymmetricCsc& compressed, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
{
	const InColumns    K(compressed);
	ConjugateGradients iteration(K, b, tolerance);
	iteration.iterate(mostIterations);
	iterations += iteration.made();
	return iteration.take(x);
}

Eigen::VectorXd reversed(const Eigen::VectorXd& x) { return x.reverse(); }

/// Pattern of the matrix with rows and columns in the opposite order. A lower triangle has become the upper one, which CHOLMOD factorises with
/// one transposition less.
void reverse(const Csc& K, Csc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	reversed.start.resize(n + 1);
	reversed.row.resize(entries);
	std::transform(K.start.rbegin(), K.start.rend(), reversed.start.begin(), [entries](int start) { return entries - start; });
	std::transform(K.row.rbegin(), K.row.rend(), reversed.row.begin(), [n](int row) { return n - 1 - row; });
}
bool isReverse(const Csc& K, const Csc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	return std::equal(K.start.rbegin(), K.start.rend(), reversed.start.begin(), reversed.start.end(), [=](int a, int b) { return a + b == entries; })
	        && std::equal(K.row.rbegin(), K.row.rend(), reversed.row.begin(), reversed.row.end(), [=](int a, int b) { return a + b == n - 1; });
}

/// Copies the values of K in the opposite order, with rows and columns scaled by powers of two that bring the diagonal close to one, and
/// returns those of K. This is exact, and lets pivots be judged: a node that the body hardly touches has a small diagonal and is not
/// singular for that.
Eigen::VectorXd scale(const Csc& K, std::vector<double>& scaled)
{
	const int       n       = K.size();
	Eigen::VectorXd largest = Eigen::VectorXd::Zero(n), factor(n);
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
			const double size = std::abs(K.value[e]);
			largest[c]        = std::max(largest[c], size);
			largest[K.row[e]] = std::max(largest[K.row[e]], size);
		}
	for (int c = 0; c < n; ++c) {
		const double diagonal = std::abs(diagonalOf(K, c));
		const double size     = diagonal > 0 ? diagonal : largest[c];
		factor[c]             = size > 0 && std::isfinite(size) ? std::ldexp(1, -std::ilogb(size) / 2) : 1;
	}
	scaled.resize(K.value.size());
	double* out = scaled.data() + scaled.size();
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			*--out = K.value[e] * factor[c] * factor[K.row[e]];
	return factor;
}

} // namespace

/// The last matrix that was given to a direct solver, and its factor.
struct LinearSolver::Direct {
	Csc             scaled; // rows and columns in the opposite order; its pattern is that of the symbolic analysis
	Eigen::VectorXd scale;  // of rows and columns, in their own order
	Cholesky        cholesky;
	Lu              lu;
	GeneralCsc      full;           // of a symmetric matrix that Cholesky refused, for LU
	const Csc*      ofLu = nullptr; // scaled or full; null: the factor is Cholesky's

	bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
	{
		const Eigen::VectorXd right = reversed(scale.cwiseProduct(b));
		if (!(ofLu ? lu.solve(*ofLu, right, x, transposed) : cholesky.solve(right, x))) return false;
		x = reversed(x).cwiseProduct(scale);
		return true;
	}
};

LinearSolver::LinearSolver() : direct_(new Direct), overNodes_(new NodeSolver) { }
LinearSolver::~LinearSolver()                                  = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept            = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

LinearSolver::FactorSize LinearSolver::analyse(const LinearProblem& problem)
{
	const FewerThreads guard(0);
	const Csc&         K                            = problem.stored();
	auto& [scaled, scale, cholesky, lu, full, ofLu] = *direct_;
	if (!cholesky.isAnalysed() || !isReverse(K, scaled)) {
		const Stopwatch watch(times_.analyse);
		reverse(K, scaled);
		scaled.value.resize(K.value.size());
		lu.forget();
		cholesky.analyse(scaled);
	}
	const double factors = problem.isSymmetric() ? 1 : 2;
	return { factors * cholesky.entries(), factors * cholesky.flops() };
}

LinearSolver::Status LinearSolver::factorise(const LinearProblem& problem)
{
	const Stopwatch watch(times_.factorise);
	auto& [scaled, values, cholesky, lu, full, ofLu] = *direct_;
	lu.forgetFactor();
	full   = {};
	ofLu   = nullptr;
	values = scale(problem.stored(), scaled.value);
	if (problem.isSymmetric()) {
		if (cholesky.factorise(scaled)) return cholesky.rcond() < smallestPivot ? Status::singular : Status::cholesky;
		full = bothTriangles(scaled);
		ofLu = &full;
		// its diagonal may be anything, so that UMFPACK judges how to order it
		return lu.factorise(full, nullptr, smallestPivot) ? Status::lu : Status::singular;
	}
	ofLu = &scaled;
	return lu.factorise(scaled, cholesky.isAnalysed() ? cholesky.ordering() : nullptr, smallestPivot) ? Status::lu : Status::singular;
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
	return !direct_->cholesky.isAnalysed() || flops > worthwhileFlops * double(K.stored().row.size()); // no factor: it is too large for CHOLMOD
}

bool LinearSolver::solveIteratively(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, LinearMethod method)
{
	std::string failure;
	if (K.isSymmetric() && K.overNodes()) failure = overNodes_->solve(*K.overNodes(), b, tolerance, method, x, times_, effort_);
	else {
		const Stopwatch watch(times_.solve);
		failure = K.isSymmetric()                                         ? inColumns(K.symmetric(), b, tolerance, x, effort_.iterations)
		        : gmres(K.general(), b, tolerance, x, effort_.iterations) ? ""
		                                                                  : "GMRES does not converge";
	}
	if (!failure.empty()) effort_.reason = failure;
	return failure.empty();
}

bool LinearSolver::staysOverNodes(LinearMethod method, const LinearProblem& K)
{
	return K.overNodes() && K.isSymmetric() && (isAlwaysIterative(method) || (method == LinearMethod::automatic && isTooLarge(K)));
}

LinearSolver::Status LinearSolver::solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance)
{
	if (isIterative(method, K)) {
		if (solveIteratively(K, b, x, tolerance, method)) return Status::iterative;
		++effort_.fallbacks;
	}
	return solve(K, b, x);
}

bool LinearSolver::solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
{
	const FewerThreads guard(0);
	return direct_->solve(b, x, transposed);
}

} // namespace gimpm
