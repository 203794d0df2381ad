// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/gmres.hpp"
#include "core/solvers/reversed.hpp"
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>

namespace gimpm {
namespace {

/// Directions that are kept before the iteration starts again from where it is; they take a tenth of the memory of a
/// factor where GMRES is preferred. Close to failure fewer do not suffice.
constexpr int kept = 100;

/// Most iterations: they have then taken as long as a factorisation, and more would hardly suffice: zero-energy modes,
/// as of one point a cell in the centre of it, make the incomplete factor useless.
constexpr int maxIterations = 200;

/// Most iterations with the diagonal, each of which takes less time.
constexpr int mostWithDiagonal = 300;

struct NoPivot { };

/// LU factors of K without the entries that K does not have. With the diagonal alone there are far more iterations, and
/// Eigen's IncompleteLUT takes longer than a factorisation.
class IncompleteLu {
public:
	/// Column c of K is row c of its transpose, of which the factors are: L with a diagonal of ones, left of the
	/// diagonal, and U.
	explicit IncompleteLu(const GeneralCsc& K) : K_(K), value_(K.value), diagonal_(K.size())
	{
		std::vector<int> position(K.size(), -1); // positions of the entries of row c
		for (int c = 0; c < K.size(); ++c) {
			const int first = K.start[c], last = K.start[c + 1];
			for (int e = first; e < last; ++e)
				position[K.row[e]] = e;
			if (position[c] < 0) throw NoPivot();
			diagonal_[c] = position[c];
			for (int e = first; e < diagonal_[c]; ++e) {
				const int above = K.row[e];
				value_[e] /= value_[diagonal_[above]];
				for (int u = diagonal_[above] + 1; u < K.start[above + 1]; ++u)
					if (const int at = position[K.row[u]]; at >= 0) value_[at] -= value_[e] * value_[u];
			}
			if (value_[diagonal_[c]] == 0 || !std::isfinite(value_[diagonal_[c]])) throw NoPivot();
			for (int e = first; e < last; ++e)
				position[K.row[e]] = -1;
		}
	}
	/// U^T L^T x = b, by columns.
	Eigen::VectorXd solve(Eigen::VectorXd x) const
	{
		for (int c = 0; c < K_.size(); ++c) {
			x[c] /= value_[diagonal_[c]];
			for (int e = diagonal_[c] + 1; e < K_.start[c + 1]; ++e)
				x[K_.row[e]] -= value_[e] * x[c];
		}
		for (int c = K_.size() - 1; c >= 0; --c)
			for (int e = K_.start[c]; e < diagonal_[c]; ++e)
				x[K_.row[e]] -= value_[e] * x[c];
		return x;
	}

private:
	const GeneralCsc&   K_;
	std::vector<double> value_;
	std::vector<int>    diagonal_; // positions of the diagonal among the values
};

/// Division by the diagonal, of which all entries must be there.
class Diagonal {
public:
	explicit Diagonal(const GeneralCsc& K) : value_(K.size())
	{
		for (int c = 0; c < K.size(); ++c)
			value_[c] = diagonalOf(K, c);
		if (!value_.allFinite() || (value_.array() == 0).any()) throw NoPivot();
	}
	Eigen::VectorXd solve(const Eigen::VectorXd& x) const { return x.cwiseQuotient(value_); }

private:
	Eigen::VectorXd value_;
};

/// K times the preconditioner, whose residuals are those of K.
template <class M> struct Preconditioned {
	const GeneralCsc& K;
	const M&          preconditioner;

	Eigen::Index    rows() const { return K.size(); }
	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const { return K * preconditioner.solve(x); }
};

/// K x = b with b of size 1, from x on, which has reached |b - K x| = error.
struct Iteration {
	const GeneralCsc&      K;
	const Eigen::VectorXd& b;
	double                 tolerance;
	Eigen::VectorXd        x     = Eigen::VectorXd::Zero(b.size());
	double                 error = 1;
	int                    made  = 0;

	/// Makes at most as many iterations as there are directions. True if it has converged.
	template <class M> bool cycle(const M& preconditioner)
	{
		const Eigen::VectorXd residual   = b - K * x;
		Eigen::VectorXd       y          = Eigen::VectorXd::Zero(b.size());
		Eigen::Index          iterations = kept;
		double                left       = tolerance / error;
		// the function behind Eigen::GMRES, which takes an operator of our own without the traits that the
		// class asks for
		Eigen::internal::gmres(
		        Preconditioned<M> { K, preconditioner }, residual, y, Eigen::IdentityPreconditioner(), iterations, Eigen::Index(kept), left);
		made += int(iterations);
		x += preconditioner.solve(y);
		error = (b - K * x).stableNorm();
		return error <= tolerance;
	}
};

/// Iterates with the diagonal, as long as it gains enough to get there.
bool byDiagonal(Iteration& iteration)
{
	const Diagonal diagonal(iteration.K);
	for (int cycles = mostWithDiagonal / kept; cycles > 0; --cycles) {
		const double before = iteration.error;
		if (iteration.cycle(diagonal)) return true;
		if (!(iteration.error * std::pow(iteration.error / before, cycles - 1) <= iteration.tolerance)) return false;
	}
	return false;
}

bool byIncompleteLu(Iteration& iteration)
{
	const IncompleteLu lu(iteration.K);
	for (int cycles = maxIterations / kept; cycles > 0; --cycles)
		if (iteration.cycle(lu)) return true;
	return false;
}

} // namespace

bool gmres(const GeneralCsc& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations, bool diagonalFirst)
{
	x.setZero(b.size());
	const double size = b.stableNorm(); // norm whose square may vanish or overflow
	if (size == 0) return true;
	const Eigen::VectorXd unit = b / size;
	Iteration             iteration { K, unit, tolerance };
	bool                  hasConverged = false;
	try {
		hasConverged = (diagonalFirst && byDiagonal(iteration)) || byIncompleteLu(iteration);
	} catch (const NoPivot&) {
	}
	iterations += iteration.made;
	x = size * iteration.x;
	return hasConverged && x.allFinite();
}

} // namespace gimpm
