// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/csc.hpp"
#include <Eigen/SparseCore>

namespace gimpm {
namespace {

auto asEigen(const Csc& K)
{
	return Eigen::Map<const Eigen::SparseMatrix<double>>(K.size(), K.size(), K.row.size(), K.start.data(), K.row.data(), K.value.data());
}

} // namespace

Eigen::VectorXd SymmetricCsc::operator*(const Eigen::VectorXd& x) const { return asEigen(*this).selfadjointView<Eigen::Lower>() * x; }

Eigen::VectorXd GeneralCsc::operator*(const Eigen::VectorXd& x) const { return asEigen(*this) * x; }

Eigen::VectorXd GeneralCsc::transposedTimes(const Eigen::VectorXd& x) const { return asEigen(*this).transpose() * x; }

Eigen::VectorXd timesSymmetric(const Csc& upper, const Eigen::VectorXd& x) { return asEigen(upper).selfadjointView<Eigen::Upper>() * x; }

GeneralCsc bothTriangles(const Csc& K)
{
	const int n = K.size();
	// f(row, column, entry), by rising column of K: so rows rise too in the columns that are filled.
	const auto forBoth = [&](auto&& f) {
		for (int c = 0; c < n; ++c)
			for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
				f(K.row[e], c, e);
				if (K.row[e] != c) f(c, K.row[e], e);
			}
	};
	GeneralCsc full;
	full.start.assign(n + 1, 0);
	forBoth([&](int, int column, int) { ++full.start[column + 1]; });
	for (int c = 0; c < n; ++c)
		full.start[c + 1] += full.start[c];
	full.row.resize(full.start[n]);
	full.value.resize(full.start[n]);
	std::vector<int> next = full.start;
	forBoth([&](int row, int column, int e) {
		full.row[next[column]]     = row;
		full.value[next[column]++] = K.value[e];
	});
	return full;
}

} // namespace gimpm
