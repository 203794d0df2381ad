// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes in blocks of a size that does not depend on the number of threads.
#pragma once
#include "core/base/instruction_set.hpp"
#include <algorithm>

namespace gimpm {

constexpr int worthwhileNodes = 4000; ///< in threads
constexpr int nodesInBlock    = 2048; ///< smaller blocks make Gauss-Seidel's method take more iterations

/// f(begin, end) for blocks of nodes, which may be done side by side, compiled for the processor.
template <class F> void forBlocks(int nodes, F&& f)
{
	const int blocks = (nodes + nodesInBlock - 1) / nodesInBlock;
#pragma omp parallel for schedule(static) if (nodes > worthwhileNodes)
	for (int i = 0; i < blocks; ++i)
		callForProcessor([&] { f(i * nodesInBlock, std::min(nodes, (i + 1) * nodesInBlock)); });
}

} // namespace gimpm
