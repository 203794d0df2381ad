// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/least_squares.hpp"
#include "core/solvers/blas_threads.hpp"
#include <limits>
#include <vector>

// LAPACK function. Eigen's template for the same took the compiler longer than all else in the files that need it.
extern "C" void dgelsy_(
        const int* rows, const int* columns, const int* sides, double* matrix, const int* stride, double* b, const int* bStride, int* pivots,
        const double* least, int* rank, double* work, const int* workSize, int* info);

namespace gimpm {

Eigen::MatrixXd leastSquares(Eigen::MatrixXd A, const Eigen::MatrixXd& B)
{
	constexpr double    dependent = 1e-11; // a column that others give but for this share of its size is one too many
	const OneBlasThread one;
	const int           rows = int(A.rows()), columns = int(A.cols()), length = std::max(rows, columns), sides = int(B.cols());
	const int           workSize = 4 * (rows + columns) + length + sides; // more than LAPACK's least, without blocks of columns
	std::vector<int>    pivots(columns, 0);
	Eigen::VectorXd     work(workSize);
	Eigen::MatrixXd     X    = Eigen::MatrixXd::Zero(length, sides);
	int                 rank = 0, info = 0;
	X.topRows(rows) = B;
	dgelsy_(&rows, &columns, &sides, A.data(), &rows, X.data(), &length, pivots.data(), &dependent, &rank, work.data(), &workSize, &info);
	if (info != 0) X.setConstant(std::numeric_limits<double>::quiet_NaN());
	return X.topRows(columns);
}

} // namespace gimpm
