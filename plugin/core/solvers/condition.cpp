// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/condition.hpp"
#include "core/solvers/linear_solver.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <limits>

namespace gimpm {
namespace {

/// A direction that is no eigenvector of anything: the same in every run.
Eigen::VectorXd startVector(int size)
{
	return Eigen::VectorXd::NullaryExpr(size, [](Eigen::Index i) { return 1 + std::sin(double(i * i % 9973) + 1); }).normalized();
}

/// Largest modulus of an eigenvalue of a symmetric operator, from below: Lanczos' method, which keeps all its vectors orthogonal (a few
/// dozen), until the largest Ritz value no longer grows.
template <class Apply> double largestEigenvalue(int size, Apply&& apply)
{
	constexpr int    most    = 60;
	constexpr double settled = 1e-3; // growth in one step
	const int        steps   = std::min(size, most);
	Eigen::MatrixXd  basis(size, steps);
	Eigen::VectorXd  diagonal(steps), beside(steps), next = startVector(size);
	double           largest = 0;
	for (int k = 0; k < steps; ++k) {
		basis.col(k) = next;
		next         = apply(next);
		diagonal[k]  = basis.col(k).dot(next);
		for (int twice = 0; twice < 2; ++twice) // once leaves what cancellation hides
			next -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * next);
		const double                                   before = largest;
		Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
		ritz.computeFromTridiagonal(diagonal.head(k + 1), beside.head(k), Eigen::EigenvaluesOnly);
		largest   = ritz.eigenvalues().cwiseAbs().maxCoeff();
		beside[k] = next.norm();
		if (!std::isfinite(largest) || beside[k] <= 1e-14 * largest || (k > 4 && largest - before < settled * largest)) break;
		next /= beside[k];
	}
	return largest;
}

} // namespace

double conditionNumber(const LinearProblem& K)
{
	Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(K.size(), K.size());
	K.forEntries([&](int row, int column, double value) { dense(row, column) = value; });
	const Eigen::VectorXd size = K.isSymmetric()
	        ? Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs().eval()
	        : Eigen::BDCSVD<Eigen::MatrixXd>(dense).singularValues();
	return size.maxCoeff() / size.minCoeff();
}

double conditionEstimate(const LinearProblem& K)
{
	LinearSolver    solver;
	Eigen::VectorXd x;
	if (solver.solve(K, startVector(K.size()), x) == LinearSolver::Status::singular) return std::numeric_limits<double>::infinity();
	const auto inverse = [&](const Eigen::VectorXd& b, bool transposed) {
		solver.solveAgain(b, x, transposed);
		return x;
	};
	const auto largest = [&](auto&& apply) { return largestEigenvalue(K.size(), apply); };
	if (K.isSymmetric()) {
		const double ofK = largest([&](const Eigen::VectorXd& v) { return K * v; });
		return ofK * largest([&](const Eigen::VectorXd& v) { return inverse(v, false); });
	}
	// singular values: the roots of the eigenvalues of K^T K
	const double ofK = largest([&](const Eigen::VectorXd& v) { return K.general().transposedTimes(K * v); });
	return std::sqrt(ofK) * std::sqrt(largest([&](const Eigen::VectorXd& v) { return inverse(inverse(v, false), true); }));
}

} // namespace gimpm
