// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_rows.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

template <int Dim> class Rows {
public:
	Rows(const NodeMatrix<Dim>& K, const FreeDofs& dofs) : K_(K), dofs_(dofs), row_(K.nodes(), -1)
	{
		for (int a = 0; a < K.nodes(); ++a) {
			bool isFree = false;
			for (int i = 0; i < Dim; ++i)
				isFree |= !isHeld(a, i);
			if (!isFree) continue;
			row_[a] = int(nodes_.size());
			nodes_.push_back(a);
		}
		findBlocks();
	}

	std::size_t entries() const { return blocks_.size() * Dim * Dim; }

	NodeRows make()
	{
		NodeRows out { Dim, {}, {}, {}, {}, {}, {} };
		for (int n = 0; n < count(); ++n)
			for (int i = 0; i < Dim; ++i) {
				if (isHeld(nodes_[n], i)) out.held.push_back({ out.rows(), diagonalOf(nodes_[n], i) });
				out.dof.push_back(Dim * nodes_[n] + i);
			}
		startRows(out);
		out.column.resize(out.start.back());
		out.value.assign(out.start.back(), 0.);
#pragma omp parallel for schedule(static)
		for (int n = 0; n < count(); ++n)
			fillRows(n, out);
		if (!K_.isPeriodic()) place(out);
		return out;
	}

private:
	struct Block {
		int           column; ///< number of the node among those with rows
		bool          isTransposed;
		const double* values;
	};

	bool isHeld(int node, int axis) const { return dofs_.number[Dim * node + axis] < 0; }
	int  count() const { return int(nodes_.size()); }

	/// That of a held component is as large as its neighbours', whose unknowns multigrid takes together with it.
	double diagonalOf(int node, int axis) const
	{
		const double diagonal = K_.at(node, 0)[axis * Dim + axis];
		return diagonal > 0 || !isHeld(node, axis) ? diagonal : 1;
	}

	/// Calls f(row, block) for each block of the whole matrix.
	template <class F> void forBlocks(F&& f) const
	{
		for (const int a : nodes_)
			for (int c = 0; c < K_.codes; ++c) {
				if (c > 0 && !K_.used(a, c)) continue;
				const int b = K_.neighbour(a, c);
				if (row_[b] < 0) continue;
				f(row_[a], Block { row_[b], false, K_.at(a, c) });
				if (c > 0) f(row_[b], Block { row_[a], true, K_.at(a, c) });
			}
	}

	void findBlocks()
	{
		first_.assign(count() + 1, 0);
		forBlocks([&](int row, const Block&) { ++first_[row + 1]; });
		for (int n = 0; n < count(); ++n)
			first_[n + 1] += first_[n];
		blocks_.resize(first_.back());
		std::vector<int> next(first_.begin(), first_.end() - 1);
		forBlocks([&](int row, const Block& block) { blocks_[next[row]++] = block; });
		const auto before = [](const Block& a, const Block& b) { return a.column < b.column; };
		for (int n = 0; n < count() && K_.isPeriodic(); ++n) // otherwise they rise, because lower nodes are visited first
			std::stable_sort(blocks_.begin() + first_[n], blocks_.begin() + first_[n + 1], before);
	}

	/// On a small periodic grid two blocks may be for the same nodes.
	bool isSameAsBefore(int n, int block) const { return block > first_[n] && blocks_[block].column == blocks_[block - 1].column; }

	void startRows(NodeRows& out) const
	{
		out.start.push_back(0);
		for (int n = 0; n < count(); ++n) {
			int different = 0;
			for (int e = first_[n]; e < first_[n + 1]; ++e)
				different += !isSameAsBefore(n, e);
			for (int i = 0; i < Dim; ++i)
				out.start.push_back(out.start.back() + Dim * different);
		}
	}

	void fillRows(int n, NodeRows& out) const
	{
		for (int i = 0; i < Dim; ++i) {
			int at = out.start[Dim * n + i] - Dim;
			for (int e = first_[n]; e < first_[n + 1]; ++e) {
				const Block& block = blocks_[e];
				if (!isSameAsBefore(n, e)) at += Dim;
				for (int j = 0; j < Dim; ++j) {
					const bool isDiagonal = block.column == n && i == j, holds = isHeld(nodes_[n], i) || isHeld(nodes_[block.column], j);
					out.column[at + j] = Dim * block.column + j;
					if (isDiagonal) out.value[at + j] = diagonalOf(nodes_[n], i);
					else if (!holds)
						out.value[at + j] += block.values[block.isTransposed ? Dim * j + i : Dim * i + j];
				}
			}
		}
	}

	void place(NodeRows& out) const
	{
		Vec<Dim> mean = Vec<Dim>::Zero();
		for (const int a : nodes_)
			mean += Grid<Dim>::index(K_.keys()[a]).template cast<double>() / double(count());
		for (const int a : nodes_)
			for (int i = 0; i < Dim; ++i)
				out.position.push_back(Grid<Dim>::index(K_.keys()[a])[i] - mean[i]);
	}

	const NodeMatrix<Dim>& K_;
	const FreeDofs&        dofs_;
	std::vector<int>       row_, nodes_; ///< number of each node among those with rows, or -1; and these
	std::vector<int>       first_;       ///< block of each row of blocks
	std::vector<Block>     blocks_;
};

} // namespace

template <int Dim> std::optional<NodeRows> nodeRows(const NodeMatrix<Dim>& K, const FreeDofs& dofs)
{
	Rows<Dim> rows(K, dofs);
	if (rows.entries() > std::size_t(std::numeric_limits<int>::max())) return std::nullopt;
	return rows.make();
}

template std::optional<NodeRows> nodeRows(const NodeMatrix<2>&, const FreeDofs&);
template std::optional<NodeRows> nodeRows(const NodeMatrix<3>&, const FreeDofs&);

} // namespace gimpm
