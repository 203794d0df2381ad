// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/conjugate_gradients.hpp"
#include <Eigen/IterativeLinearSolvers>

namespace gimpm {
namespace {

constexpr int maxIterations = 2000;

struct NotDefinite { };

/// K as Eigen's iteration sees it: an operator that looks at the curvature along each direction, which that iteration does not.
class Stiffness {
public:
	explicit Stiffness(const SymmetricCsc& K) : K_(K) { }
	Eigen::Index    cols() const { return K_.size(); }
	Eigen::VectorXd operator*(const Eigen::VectorXd& direction) const
	{
		Eigen::VectorXd force = K_ * direction;
		if (!(direction.dot(force) > 0) && !direction.isZero(0)) throw NotDefinite();
		return force;
	}

private:
	const SymmetricCsc& K_;
};

/// Division by the diagonal. With an incomplete Cholesky factor instead it takes a third of the iterations, but in 3D computing that factor
/// takes longer than all of them, and may break down.
class DiagonalInverse {
public:
	explicit DiagonalInverse(const SymmetricCsc& K) : inverse_(K.size())
	{
		for (int c = 0; c < K.size(); ++c) {
			const int first = K.start[c];
			if (first == K.start[c + 1] || K.row[first] != c || !(K.value[first] > 0)) throw NotDefinite();
			inverse_[c] = 1 / K.value[first];
		}
	}
	Eigen::VectorXd solve(const Eigen::VectorXd& residual) const { return inverse_.cwiseProduct(residual); }

private:
	Eigen::VectorXd inverse_;
};

} // namespace

bool conjugateGradients(const SymmetricCsc& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations)
try {
	x.setZero(b.size());
	const double size = b.stableNorm(); // whose square may vanish or overflow
	if (size == 0) return true;
	Eigen::Index made  = maxIterations;
	double       error = tolerance;
	// the function behind Eigen::ConjugateGradient, which takes an operator of our own without the traits that the class asks for
	Eigen::internal::conjugate_gradient(Stiffness(K), Eigen::VectorXd(b / size), x, DiagonalInverse(K), made, error);
	iterations += int(made);
	x *= size;
	return error <= tolerance && x.allFinite();
} catch (const NotDefinite&) {
	return false;
}

} // namespace gimpm
