// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/base/small_matrices.hpp"
#include <cstddef>
#include <limits>
#include <vector>

// LAPACK functions, with the lengths of the texts last.
extern "C" {
void dsyev_(
        const char* job, const char* triangle, const int* size, double* matrix, const int* stride, double* values, double* work, const int* workSize, int* info,
        std::size_t, std::size_t);
void dgesv_(const int* size, const int* sides, double* matrix, const int* stride, int* pivots, double* b, const int* bStride, int* info);
void dpotrf_(const char* triangle, const int* size, double* matrix, const int* stride, int* info, std::size_t);
}

namespace gimpm {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

} // namespace

SymmetricEigen symmetricEigen(Eigen::MatrixXd symmetric)
{
	const int       size = int(symmetric.rows()), workSize = 3 * size;
	Eigen::VectorXd values(size), work(workSize);
	int             info = 0;
	dsyev_("V", "L", &size, symmetric.data(), &size, values.data(), work.data(), &workSize, &info, 1, 1);
	if (info != 0) values.setConstant(none), symmetric.setConstant(none);
	return { std::move(values), std::move(symmetric) };
}

Eigen::MatrixXd solutionOf(Eigen::MatrixXd A, Eigen::MatrixXd B)
{
	const int        size = int(A.rows()), sides = int(B.cols());
	std::vector<int> pivots(size, 0);
	int              info = 0;
	dgesv_(&size, &sides, A.data(), &size, pivots.data(), B.data(), &size, &info);
	if (info != 0) B.setConstant(none);
	return B;
}

bool isPositiveDefinite(Eigen::MatrixXd symmetric)
{
	const int size = int(symmetric.rows());
	int       info = 0;
	dpotrf_("L", &size, symmetric.data(), &size, &info, 1);
	return info == 0 && symmetric.diagonal().allFinite();
}

} // namespace gimpm
