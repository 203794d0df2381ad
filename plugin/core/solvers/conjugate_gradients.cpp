// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/conjugate_gradients.hpp"
#include <algorithm>
#include <array>

namespace gimpm {
namespace {

constexpr int maxIterations = 2000;

/// Vectors are gone through in parts, side by side in the threads; the parts of a sum are added in their order, whatever the number of threads.
constexpr int partSize = 8192, worthwhileInThreads = 8; ///< the latter parts: see BlockMatrix

template <class F> void forParts(Eigen::Index size, F&& f)
{
	const int parts = int((size + partSize - 1) / partSize);
#pragma omp parallel for schedule(static) if (parts > worthwhileInThreads)
	for (int i = 0; i < parts; ++i) {
		const Eigen::Index begin = Eigen::Index(i) * partSize;
		f(i, begin, std::min<Eigen::Index>(partSize, size - begin));
	}
}

/// Sum over the parts of what f(begin, count) gives for each.
template <class F> double sumOfParts(Eigen::Index size, F&& f)
{
	std::vector<double> sums((size + partSize - 1) / partSize);
	forParts(size, [&](int i, Eigen::Index begin, Eigen::Index count) { sums[i] = f(begin, count); });
	double sum = 0;
	for (const double part : sums)
		sum += part;
	return sum;
}

double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
	return sumOfParts(a.size(), [&](Eigen::Index begin, Eigen::Index count) { return a.segment(begin, count).dot(b.segment(begin, count)); });
}

/// The iteration for a right side of size 1. With an incomplete Cholesky factor instead of the diagonal it takes a third of the iterations, but in
/// 3D computing that factor takes longer than all of them, and may break down.
class Iteration {
public:
	Iteration(const SymmetricOperator& K, const Eigen::VectorXd& b) : K_(K), inverse_(K.diagonal()), residual_(b), x_(Eigen::VectorXd::Zero(b.size()))
	{
		isDefinite_ = (inverse_.array() > 0).all();
		if (!isDefinite_) return;
		inverse_   = inverse_.cwiseInverse().eval();
		direction_ = inverse_.cwiseProduct(residual_);
		gain_      = dot(residual_, direction_);
	}

	/// False where the matrix is not positive definite along the direction.
	bool step()
	{
		K_.multiply(direction_, force_);
		const double curvature = dot(direction_, force_);
		isDefinite_            = curvature > 0;
		if (!isDefinite_) return false;
		const double length = gain_ / curvature, before = gain_;
		gain_               = sumOfParts(x_.size(), [&](Eigen::Index begin, Eigen::Index count) {
                        x_.segment(begin, count) += length * direction_.segment(begin, count);
                        auto residual = residual_.segment(begin, count);
                        residual -= length * force_.segment(begin, count);
                        return residual.dot(inverse_.segment(begin, count).cwiseProduct(residual));
                });
		const double growth = gain_ / before;
		forParts(x_.size(), [&](int, Eigen::Index begin, Eigen::Index count) {
			auto direction = direction_.segment(begin, count);
			direction      = inverse_.segment(begin, count).cwiseProduct(residual_.segment(begin, count)) + growth * direction;
		});
		return true;
	}

	bool                   isDefinite() const { return isDefinite_; }
	double                 error() const { return std::sqrt(dot(residual_, residual_)); }
	const Eigen::VectorXd& x() const { return x_; }

private:
	const SymmetricOperator& K_;
	Eigen::VectorXd          inverse_, residual_, x_, direction_, force_;
	double                   gain_ = 0; ///< residual times preconditioned residual
	bool                     isDefinite_;
};

} // namespace

bool conjugateGradients(const SymmetricOperator& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
{
	x.setZero(b.size());
	const double size = b.stableNorm(); // whose square may vanish or overflow
	if (size == 0) return true;
	Iteration iteration(K, b / size);
	if (!iteration.isDefinite()) return false;
	for (int made = 0; iteration.error() > tolerance; ++made) {
		if (made == maxIterations || !iteration.step()) return false;
		++iterations;
	}
	x = size * iteration.x();
	return x.allFinite();
}

} // namespace gimpm
