// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/condition.hpp"
#include <Eigen/Eigenvalues>
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
	constexpr int    most = 60;
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
		const double before = largest;
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

double conditionNumber(const SymmetricCsc& K)
{
	Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(K.size(), K.size());
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			dense(K.row[e], c) = K.value[e];
	const Eigen::VectorXd size = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
	return size.maxCoeff() / size.minCoeff();
}

double conditionEstimate(const SymmetricCsc& K)
{
	LinearSolver    solver;
	Eigen::VectorXd x;
	const auto      status = solver.solve(K, startVector(K.size()), x);
	if (status == LinearSolver::Status::singular) return std::numeric_limits<double>::infinity();
	const auto inverse = [&](const Eigen::VectorXd& b) {
		if (status == LinearSolver::Status::cholesky) solver.solveAgain(b, x);
		else
			solver.solve(K, b, x); // LU keeps no factor; such matrices are rare
		return x;
	};
	return largestEigenvalue(K.size(), [&](const Eigen::VectorXd& v) { return K * v; }) * largestEigenvalue(K.size(), inverse);
}

} // namespace gimpm
