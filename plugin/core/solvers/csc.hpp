// SPDX-License-Identifier: GPL-2.0-or-later
// Sparse matrices in compressed columns.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace gimpm {

/// Pattern and values; rows ascend within a column.
struct Csc {
	std::vector<int>    start, row; ///< column c has entries start[c] ... start[c + 1] - 1
	std::vector<double> value;

	int size() const { return int(start.size()) - 1; }
};

/// Lower triangle of a symmetric matrix.
struct SymmetricCsc : Csc {
	Eigen::VectorXd operator*(const Eigen::VectorXd&) const;
};

/// Both triangles of a matrix. Its pattern is symmetric, its values need not be.
struct GeneralCsc : Csc {
	Eigen::VectorXd operator*(const Eigen::VectorXd&) const;
	Eigen::VectorXd transposedTimes(const Eigen::VectorXd&) const;
};

/// K x of a symmetric matrix given by its upper triangle.
Eigen::VectorXd timesSymmetric(const Csc& upper, const Eigen::VectorXd& x);

/// Both triangles of a symmetric matrix given by one of them.
GeneralCsc bothTriangles(const Csc&);

} // namespace gimpm
