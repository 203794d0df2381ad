// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/least_squares.hpp"
#include "core/solvers/blas_threads.hpp"
#include <limits>
#include <vector>

// Of LAPACK. Eigen's template for the same took the compiler longer than all else in the file that needs it.
extern "C" void dgelsy_(
        const int* rows, const int* columns, const int* sides, double* matrix, const int* stride, double* b, const int* bStride, int* pivots,
        const double* least, int* rank, double* work, const int* workSize, int* info);

namespace gimpm {

Eigen::VectorXd leastSquares(Eigen::MatrixXd A, const Eigen::VectorXd& b)
{
	constexpr double    dependent = 1e-12; // a column that others give but for this share of its size is one too many
	const OneBlasThread one;
	const int           rows = int(A.rows()), columns = int(A.cols()), length = std::max(rows, columns), sides = 1;
	const int           workSize = 4 * (rows + columns) + length; // more than LAPACK's least, without blocks of columns
	std::vector<int>    pivots(columns, 0);
	Eigen::VectorXd     x    = Eigen::VectorXd::Zero(length), work(workSize);
	int                 rank = 0, info = 0;
	x.head(rows) = b;
	dgelsy_(&rows, &columns, &sides, A.data(), &rows, x.data(), &length, pivots.data(), &dependent, &rank, work.data(), &workSize, &info);
	if (info != 0) x.setConstant(std::numeric_limits<double>::quiet_NaN());
	return x.head(columns);
}

} // namespace gimpm
