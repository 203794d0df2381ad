// SPDX-License-Identifier: GPL-2.0-or-later
// Ranges with about the same work.
#pragma once
#include <numeric>
#include <vector>

namespace gimpm {

/// A solve goes with the nodes, an assembly with their points, and the solves take longer.
constexpr double solveOverAssembly = 2;

/// Cuts a sequence of elements, given the work of each, into parts of about equal work: first element of each part, and
/// number of elements.
inline std::vector<int> evenParts(const std::vector<double>& work, int parts)
{
	const double     whole  = std::accumulate(work.begin(), work.end(), 0.);
	double           before = 0;
	std::vector<int> start { 0 };
	for (int n = 0; n < int(work.size()); ++n) {
		while (int(start.size()) < parts && before >= whole * double(start.size()) / parts)
			start.push_back(n);
		before += work[n];
	}
	start.resize(parts + 1, int(work.size()));
	return start;
}

} // namespace gimpm
