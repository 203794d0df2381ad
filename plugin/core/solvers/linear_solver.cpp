// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/linear_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/cholesky.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/gmres.hpp"
#include "core/solvers/lu.hpp"
#include "core/solvers/supernodal_lu.hpp"
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

/// Zero where there is none.
double diagonalOf(const Csc& K, int c)
{
	const auto end = K.row.begin() + K.start[c + 1], entry = std::lower_bound(K.row.begin() + K.start[c], end, c);
	return entry != end && *entry == c ? K.value[entry - K.row.begin()] : 0;
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
	SupernodalLu    supernodalLu;
	Lu              lu;
	GeneralCsc      full; // of a symmetric matrix that Cholesky refused, for LU
	enum class Factor { cholesky, supernodalLu, luOfScaled, luOfFull } factor {};

	void   layOut(); // of LU: only where it is needed, for it takes the memory
	Status factorise(const LinearProblem&);
	bool   solveScaled(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
	{
		switch (factor) {
			case Factor::cholesky: return cholesky.solve(b, x);
			case Factor::supernodalLu: return supernodalLu.solve(b, x, transposed);
			case Factor::luOfScaled: return lu.solve(scaled, b, x, transposed);
			case Factor::luOfFull: return lu.solve(full, b, x, transposed);
		}
		return false;
	}
	bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
	{
		if (!solveScaled(reversed(scale.cwiseProduct(b)), x, transposed)) return false;
		x = reversed(x).cwiseProduct(scale);
		return true;
	}
};

void LinearSolver::Direct::layOut()
{
	if (!supernodalLu.isAnalysed() && cholesky.isAnalysed()) supernodalLu.analyse(scaled, cholesky.pattern());
}

LinearSolver::Status LinearSolver::Direct::factorise(const LinearProblem& K)
{
	lu.forget();
	full                = {};
	scale               = gimpm::scale(K.stored(), scaled.value);
	const auto statusOf = [&](Factor by, bool isRegular) {
		factor = by;
		return isRegular ? Status::lu : Status::singular;
	};
	if (K.isSymmetric()) {
		factor = Factor::cholesky;
		if (cholesky.factorise(scaled)) return cholesky.rcond() < smallestPivot ? Status::singular : Status::cholesky;
		full = bothTriangles(scaled);
		return statusOf(Factor::luOfFull, lu.factorise(full, smallestPivot));
	}
	if (supernodalLu.factorise(scaled, smallestPivot)) return statusOf(Factor::supernodalLu, true);
	return statusOf(Factor::luOfScaled, lu.factorise(scaled, smallestPivot));
}

LinearSolver::LinearSolver() : direct_(new Direct) { }
LinearSolver::~LinearSolver()                                  = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept            = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

LinearSolver::FactorSize LinearSolver::analyse(const LinearProblem& problem)
{
	const FewerThreads guard(0);
	const Csc&         K = problem.stored();
	auto&              d = *direct_;
	if (!d.cholesky.isAnalysed() || !isReverse(K, d.scaled)) {
		const Stopwatch watch(times_.analyse);
		reverse(K, d.scaled);
		d.scaled.value.resize(K.value.size());
		d.cholesky.analyse(d.scaled, !problem.isSymmetric());
		d.supernodalLu.forget();
	}
	const double factors = problem.isSymmetric() ? 1 : 2;
	return { factors * d.cholesky.entries(), factors * d.cholesky.flops() };
}

LinearSolver::Status LinearSolver::solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const FewerThreads guard(analyse(K).flops);
	if (!K.isSymmetric()) {
		const Stopwatch watch(times_.analyse);
		direct_->layOut();
	}
	const Status status = [&] {
		const Stopwatch watch(times_.factorise);
		return direct_->factorise(K);
	}();
	const Stopwatch watch(times_.solve);
	return status != Status::singular && direct_->solve(b, x, false) ? status : Status::singular;
}

bool LinearSolver::prefersIterative(const LinearProblem& K)
{
	const double flops = analyse(K).flops;
	return !direct_->cholesky.isAnalysed() || flops > worthwhileFlops * double(K.stored().row.size()); // no factor: it is too large for CHOLMOD
}

bool LinearSolver::solveIteratively(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance)
{
	const Stopwatch watch(times_.solve);
	return K.isSymmetric() ? conjugateGradients(K.symmetric(), b, tolerance, x, effort_.iterations)
	                       : gmres(K.general(), b, tolerance, x, effort_.iterations);
}

LinearSolver::Status LinearSolver::solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance)
{
	if (isIterative(method, K)) {
		if (solveIteratively(K, b, x, tolerance)) return Status::iterative;
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
