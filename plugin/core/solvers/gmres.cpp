// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/gmres.hpp"
#include <algorithm>
#include <unsupported/Eigen/IterativeSolvers>

namespace gimpm {
namespace {

/// Directions that are kept before the iteration starts again from where it is; they take a tenth of the memory of a
/// factor where GMRES is preferred. Close to failure fewer do not suffice.
constexpr int kept = 100;

/// Where they do not suffice they have taken as long as a factorisation, and more would hardly: zero-energy modes, as
/// of one point a cell in the middle of it, make the incomplete factor useless.
constexpr int maxIterations = 200;

struct NoPivot { };

/// LU factors of K without the entries that K does not have. With the diagonal alone there are far more iterations, and
/// Eigen's IncompleteLUT takes longer than a factorisation.
class IncompleteLu {
public:
	/// Column c of K is row c of its transpose, of which the factors are: L with a diagonal of ones, left of the
	/// diagonal, and U.
	explicit IncompleteLu(const GeneralCsc& K) : K_(K), value_(K.value), diagonal_(K.size())
	{
		std::vector<int> place(K.size(), -1); // of the entries of row c
		for (int c = 0; c < K.size(); ++c) {
			const int first = K.start[c], last = K.start[c + 1];
			for (int e = first; e < last; ++e)
				place[K.row[e]] = e;
			if (place[c] < 0) throw NoPivot();
			diagonal_[c] = place[c];
			for (int e = first; e < diagonal_[c]; ++e) {
				const int above = K.row[e];
				value_[e] /= value_[diagonal_[above]];
				for (int u = diagonal_[above] + 1; u < K.start[above + 1]; ++u)
					if (const int at = place[K.row[u]]; at >= 0) value_[at] -= value_[e] * value_[u];
			}
			if (value_[diagonal_[c]] == 0 || !std::isfinite(value_[diagonal_[c]])) throw NoPivot();
			for (int e = first; e < last; ++e)
				place[K.row[e]] = -1;
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
	std::vector<int>    diagonal_; // where they are among the values
};

/// K times the preconditioner, whose residuals are those of K.
struct Preconditioned {
	const GeneralCsc&   K;
	const IncompleteLu& lu;

	Eigen::Index    rows() const { return K.size(); }
	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const { return K * lu.solve(x); }
};

} // namespace

bool gmres(const GeneralCsc& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
try {
	x.setZero(b.size());
	const double size = b.stableNorm(); // whose square may vanish or overflow
	if (size == 0) return true;
	const IncompleteLu lu(K);
	Eigen::Index       made  = maxIterations;
	double             error = tolerance;
	// the function behind Eigen::GMRES, which takes an operator of our own without the traits that the class asks
	// for
	Eigen::internal::gmres(Preconditioned { K, lu }, Eigen::VectorXd(b / size), x, Eigen::IdentityPreconditioner(), made, Eigen::Index(kept), error);
	iterations += int(made);
	x = size * lu.solve(x);
	return error <= tolerance && x.allFinite();
} catch (const NoPivot&) {
	return false;
}

} // namespace gimpm
