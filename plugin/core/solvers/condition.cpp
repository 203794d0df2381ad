// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/condition.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/linear_solver.hpp"
#include <limits>

// LAPACK functions, with the lengths of the texts last. Eigen's templates for the same took the compiler longer than
// all other solvers together.
extern "C" {
void dsterf_(const int* size, double* diagonal, double* beside, int* info);
void dsyev_(
        const char* vectors, const char* triangle, const int* size, double* matrix, const int* stride, double* values, double* work, const int* workSize,
        int* info, std::size_t, std::size_t);
void dgesvd_(
        const char* left, const char* right, const int* rows, const int* columns, double* matrix, const int* stride, double* values, double* u,
        const int* uStride, double* v, const int* vStride, double* work, const int* workSize, int* info, std::size_t, std::size_t);
}

namespace gimpm {
namespace {

Eigen::VectorXd eigenvaluesOfTridiagonal(Eigen::VectorXd diagonal, Eigen::VectorXd beside)
{
	const int size = int(diagonal.size());
	int       info = 0;
	dsterf_(&size, diagonal.data(), beside.data(), &info);
	return diagonal;
}

/// Moduli of the eigenvalues of a symmetric matrix, or singular values.
Eigen::VectorXd magnitudes(Eigen::MatrixXd matrix, bool isSymmetric)
{
	const OneBlasThread one;
	const int           size = int(matrix.rows()), workSize = 8 * size, none = 1;
	int                 info = 0;
	Eigen::VectorXd     values(size), work(workSize);
	if (isSymmetric) dsyev_("N", "L", &size, matrix.data(), &size, values.data(), work.data(), &workSize, &info, 1, 1);
	else
		dgesvd_("N", "N", &size, &size, matrix.data(), &size, values.data(), nullptr, &none, nullptr, &none, work.data(), &workSize, &info, 1, 1);
	if (info != 0) values.setConstant(std::numeric_limits<double>::quiet_NaN());
	return values.cwiseAbs();
}

/// A direction that is no eigenvector of anything: the same in every run.
Eigen::VectorXd startVector(int size)
{
	return Eigen::VectorXd::NullaryExpr(size, [](Eigen::Index i) { return 1 + std::sin(double(i * i % 9973) + 1); }).normalized();
}

/// Largest modulus of an eigenvalue of a symmetric operator, from below: Lanczos' method, which keeps all its vectors
/// orthogonal (a few dozen), until the largest Ritz value no longer grows.
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
		const double before = largest;
		largest             = eigenvaluesOfTridiagonal(diagonal.head(k + 1), beside.head(k)).cwiseAbs().maxCoeff();
		beside[k]           = next.norm();
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
	const Eigen::VectorXd size = magnitudes(std::move(dense), K.isSymmetric());
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
