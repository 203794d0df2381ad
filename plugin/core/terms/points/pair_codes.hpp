// SPDX-License-Identifier: GPL-2.0-or-later
// Positions of the blocks of a patch in the matrix.
#pragma once
#include "core/terms/points/point_kernel.hpp"

namespace gimpm {

/// Offset codes of the node pairs of a patch, a <= b; the nodes count x fastest.
template <int Dim, int Span> struct PairCodes {
	static constexpr int N = nodesOfSpan<Dim, Span>();
	int                  code[N][N];
	PairCodes()
	{
		for (int a = 0; a < N; ++a)
			for (int b = 0; b < N; ++b) {
				std::array<int, Dim> offset;
				for (int k = 0; k < Dim; ++k)
					offset[k] = PatchNodes<Dim, Span>::along(b, k) - PatchNodes<Dim, Span>::along(a, k);
				code[a][b] = NodeMatrix<Dim>::code(offset);
			}
	}
	static const PairCodes& get()
	{
		static const PairCodes codes;
		return codes;
	}
};

} // namespace gimpm
