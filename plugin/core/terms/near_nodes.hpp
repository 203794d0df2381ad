// SPDX-License-Identifier: GPL-2.0-or-later
// Neighbours on the grid whose fields are coupled, and where their blocks are in a matrix.
#pragma once
#include "core/solvers/couplings.hpp"
#include "core/solvers/node_matrix.hpp"
#include <algorithm>
#include <array>
#include <iterator>

namespace gimpm {

/// For each node those that it is coupled with, by the code of their offset (NodeMatrix::code); symmetric.
template <int Dim> class NearNodes {
public:
	static constexpr int middle = NodeMatrix<Dim>::codes - 1, count = 2 * middle + 1;

	explicit NearNodes(int nodes) : near_(nodes)
	{
		for (auto& row : near_)
			row.fill(-1);
	}
	/// The offset is that from a to b.
	void add(int a, int b, int code) { near_[a][middle + code] = b, near_[b][middle - code] = a; }
	/// All nodes of the grid at most two cells away along each axis.
	void addAll(const std::vector<Key>& nodes, const Grid<Dim>& grid)
	{
		const auto neighbour = NodeMatrix<Dim>::neighboursOf(nodes, grid);
		for (std::size_t i = 0; i < neighbour.size(); ++i)
			if (neighbour[i] >= 0) add(int(i) / NodeMatrix<Dim>::codes, neighbour[i], int(i) % NodeMatrix<Dim>::codes);
	}

	int                           size() const { return int(near_.size()); }
	const std::array<int, count>& operator[](int node) const { return near_[node]; } ///< -1: none

	void mark(NodeMatrix<Dim>& K) const
	{
		for (int a = 0; a < size(); ++a)
			for (int code = 0; code <= middle; ++code)
				if (near_[a][middle + code] >= 0) K.markUsed(a, code);
	}
	void mark(Couplings& K, int field, int other) const
	{
		std::vector<int> rising;
		for (int a = 0; a < size(); ++a) {
			rising.clear();
			std::copy_if(near_[a].begin(), near_[a].end(), std::back_inserter(rising), [](int b) { return b >= 0; });
			if (!std::is_sorted(rising.begin(), rising.end())) std::sort(rising.begin(), rising.end()); // order may differ in a periodic grid
			rising.erase(std::unique(rising.begin(), rising.end()), rising.end());
			K.markRow({ field, a }, other, rising);
		}
	}

private:
	std::vector<std::array<int, count>> near_;
};

/// The blocks of near nodes in two fields, all of which are marked, until another one is.
template <int Dim> class NearBlocks {
public:
	NearBlocks() = default; ///< none
	NearBlocks(const NearNodes<Dim>& near, Couplings& K, int field, int other)
	        : values_(K.values()), begin_(near.size()), offsets_(std::size_t(near.size()) * near.count)
	{
		std::array<std::ptrdiff_t, NearNodes<Dim>::count> ofRow;
		for (int a = 0; a < near.size(); ++a) {
			K.findOffsets({ field, a }, other, near[a].data(), near.count, ofRow.data());
			begin_[a] = *std::max_element(ofRow.begin(), ofRow.end());
			for (const auto offset : ofRow)
				if (offset >= 0) begin_[a] = std::min(begin_[a], offset);
			std::transform(ofRow.begin(), ofRow.end(), offsets_.begin() + std::ptrdiff_t(a) * near.count, [begin = begin_[a]](auto offset) {
				return offset < 0 ? -1 : int(offset - begin);
			});
		}
	}
	/// Values of the block of a node in the first field and its neighbour in the other one, row by row; null: it is
	/// not kept.
	double* at(int node, int code) const
	{
		const int offset = offsets_[std::size_t(node) * NearNodes<Dim>::count + NearNodes<Dim>::middle + code];
		return offset < 0 ? nullptr : values_ + begin_[node] + offset;
	}

private:
	double*                     values_ = nullptr;
	std::vector<std::ptrdiff_t> begin_;   // start of each row
	std::vector<int>            offsets_; // from there
};

} // namespace gimpm
