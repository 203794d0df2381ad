// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/conjugate_gradients.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace gimpm {
namespace {

constexpr const char* notDefinite = "the matrix is not positive definite";

/// Vectors are gone through in parts, side by side in the threads; the parts of a sum are added in their order,
/// whatever the number of threads.
constexpr int partSize = 8192, partsWorthThreads = 8; ///< the latter: see BlockMatrix

template <class F> void forParts(Eigen::Index size, F&& f)
{
	const int parts = int((size + partSize - 1) / partSize);
#pragma omp parallel for schedule(static) if (parts > partsWorthThreads)
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

} // namespace

/// An incomplete Cholesky factor instead of the diagonal takes a third of the iterations, but in 3D computing that
/// factor takes longer than all of them, and may break down.
ConjugateGradients::ConjugateGradients(const SymmetricOperator& K, const Eigen::VectorXd& b, double tolerance)
        : K_(K), size_(K.norm(b)), tolerance_(tolerance), x_(Eigen::VectorXd::Zero(b.size())) // its square may vanish or overflow
{
	error_ = size_;
	if (size_ == 0) return;
	residual_          = b / size_;
	inverse_           = K.diagonal();
	double notPositive = double((!(inverse_.array() > 0)).count());
	K.complete(&notPositive, 1);
	if (notPositive > 0) {
		fail(notDefinite);
		return;
	}
	inverse_ = inverse_.cwiseInverse().eval();
	begin();
}

void ConjugateGradients::precondition(const Preconditioner* preconditioner)
{
	if (preconditioner == preconditioner_) return;
	preconditioner_ = preconditioner;
	if (!fault_.empty()) failure_.clear();
	fault_.clear();
	if (!hasConverged() && failure_.empty()) begin();
}

void ConjugateGradients::begin()
{
	error_ = std::sqrt(product(residual_, residual_));
	if (preconditioner_ && !preconditionResidual()) return;
	direction_ = preconditioner_ ? preconditioned_ : inverse_.cwiseProduct(residual_);
	gain_      = product(residual_, direction_);
}

bool ConjugateGradients::preconditionResidual()
{
	fault_ = preconditioner_->apply(residual_, preconditioned_);
	if (fault_.empty() && !(product(residual_, preconditioned_) >= 0)) fault_ = "the preconditioner is not positive definite";
	failure_ = fault_;
	return fault_.empty();
}

bool ConjugateGradients::iterate(int atMost)
{
	for (int i = 0; i < atMost && !hasConverged() && failure_.empty(); ++i) {
		if (!step()) break;
		++made_;
	}
	return hasConverged() || !failure_.empty();
}

bool ConjugateGradients::step()
{
	K_.multiply(direction_, force_);
	const double curvature = product(direction_, force_);
	if (!(curvature > 0)) return fail(notDefinite), false;
	const double before = gain_, error = improve(gain_ / curvature);
	if (preconditioner_) {
		if (!preconditionResidual()) return false;
		gain_ = product(residual_, preconditioned_);
	}
	const double growth = gain_ / before;
	forParts(x_.size(), [&](int, Eigen::Index begin, Eigen::Index count) {
		auto direction = direction_.segment(begin, count);
		if (preconditioner_) direction = preconditioned_.segment(begin, count) + growth * direction;
		else
			direction = inverse_.segment(begin, count).cwiseProduct(residual_.segment(begin, count)) + growth * direction;
	});
	error_ = error;
	return true;
}

/// A step of this length, and what the diagonal makes of the residual that is left; its size.
double ConjugateGradients::improve(double length)
{
	double sums[2]; // told to other processes at once
	sums[0] = sumOfParts(x_.size(), [&](Eigen::Index begin, Eigen::Index count) {
		x_.segment(begin, count) += length * direction_.segment(begin, count);
		auto residual = residual_.segment(begin, count);
		residual -= length * force_.segment(begin, count);
		return residual.dot(inverse_.segment(begin, count).cwiseProduct(residual));
	});
	sums[1] = dot(residual_, residual_);
	K_.complete(sums, 2);
	gain_ = sums[0];
	return std::sqrt(sums[1]);
}

double ConjugateGradients::product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const
{
	double sum = dot(a, b);
	K_.complete(&sum, 1);
	return sum;
}

std::string ConjugateGradients::take(Eigen::VectorXd& x) const
{
	x = size_ * x_;
	if (!failure_.empty()) return failure_;
	if (!hasConverged()) return "conjugate gradients do not converge in " + std::to_string(made_) + " iterations";
	return x.allFinite() ? "" : "numbers are not finite";
}

} // namespace gimpm
