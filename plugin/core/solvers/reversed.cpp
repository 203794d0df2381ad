// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/reversed.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

double diagonalOf(const Csc& K, int c)
{
	const auto end = K.row.begin() + K.start[c + 1], entry = std::lower_bound(K.row.begin() + K.start[c], end, c);
	return entry != end && *entry == c ? K.value[entry - K.row.begin()] : 0;
}

void reverse(const Csc& K, Csc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	reversed.start.resize(n + 1);
	reversed.row.resize(entries);
	std::transform(K.start.rbegin(), K.start.rend(), reversed.start.begin(), [entries](int start) { return entries - start; });
	std::transform(K.row.rbegin(), K.row.rend(), reversed.row.begin(), [n](int row) { return n - 1 - row; });
}
bool isReverse(const Csc& K, const Csc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	return std::equal(K.start.rbegin(), K.start.rend(), reversed.start.begin(), reversed.start.end(), [=](int a, int b) { return a + b == entries; })
	        && std::equal(K.row.rbegin(), K.row.rend(), reversed.row.begin(), reversed.row.end(), [=](int a, int b) { return a + b == n - 1; });
}

namespace {

/// The largest entry of each row of a symmetric matrix, of which one triangle may be stored alone.
Eigen::VectorXd largestOfRows(const Csc& K)
{
	Eigen::VectorXd largest = Eigen::VectorXd::Zero(K.size());
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
			const double size = std::abs(K.value[e]);
			largest[c]        = std::max(largest[c], size);
			largest[K.row[e]] = std::max(largest[K.row[e]], size);
		}
	return largest;
}

} // namespace

Eigen::VectorXd scale(const Csc& K, std::vector<double>& scaled)
{
	const int       n = K.size();
	Eigen::VectorXd largest, factor(n); // largest: only where it is needed
	for (int c = 0; c < n; ++c) {
		const double diagonal = std::abs(diagonalOf(K, c));
		if (!(diagonal > 0) && largest.size() == 0) largest = largestOfRows(K);
		const double size = diagonal > 0 ? diagonal : largest[c];
		factor[c]         = size > 0 && std::isfinite(size) ? std::ldexp(1, -std::ilogb(size) / 2) : 1;
	}
	scaled.resize(K.value.size());
	double* out = scaled.data() + scaled.size();
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			*--out = K.value[e] * factor[c] * factor[K.row[e]];
	return factor;
}

} // namespace gimpm
