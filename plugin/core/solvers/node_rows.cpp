// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_rows.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

template <int Dim> class Rows {
public:
	Rows(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings)
	        : K_(K), dofs_(dofs), couplings_(couplings), row_(K.nodes(), -1)
	{
		for (int a = 0; a < K.nodes(); ++a) {
			bool isFree = false;
			for (int i = 0; i < Dim; ++i)
				isFree |= !isConstrained(a, i);
			if (!isFree) continue;
			row_[a] = int(nodes_.size());
			nodes_.push_back(a);
			if (a < ownedNodes.first()) begin_ = int(nodes_.size());
			if (a < ownedNodes.last()) end_ = int(nodes_.size());
		}
		findBlocks();
	}

	std::size_t entries() const { return blocks_.size() * Dim * Dim; }

	NodeRows make()
	{
		NodeRows out { Dim, Dim * int(nodes_.size()), Dim * begin_, {}, {}, {}, {}, {}, {}, {}, {}, { Dim } };
		for (const int node : nodes_)
			for (int i = 0; i < Dim; ++i)
				out.columnDof.push_back(Dim * node + i);
		for (int n = begin_; n < end_; ++n)
			for (int i = 0; i < Dim; ++i) {
				if (isConstrained(nodes_[n], i)) out.held.push_back({ out.rows(), diagonalOf(nodes_[n], i) });
				out.dof.push_back(Dim * nodes_[n] + i);
			}
		startRows(out);
		out.column.resize(out.start.back());
		out.value.assign(out.start.back(), 0.);
		out.symmetricPart.assign(K_.isSymmetric() ? 0 : out.start.back(), 0.);
#pragma omp parallel for schedule(static)
		for (int n = begin_; n < end_; ++n) {
			fillRows(n, out, out.value, 1);
			if (!K_.isSymmetric()) fillRows(n, out, out.symmetricPart, 0.5);
		}
		if (!K_.isPeriodic()) position(out);
		return out;
	}

private:
	struct Block {
		int           column; ///< number of the node among those with rows
		bool          isTransposed;
		const double* values;
		const double* skew;                ///< null: none
		bool          isItself  = false;   ///< block of one node, with the whole of what is not symmetric
		bool          isCoupled = false;   ///< block with couplings, which add to that of neighbours
		const double* opposite  = nullptr; ///< K_ba of couplings that are not symmetric

		/// Entry with this part of the difference between K_ba^T and K_ab, if it is K_ba.
		double at(int i, int j, double part) const
		{
			if (opposite) return part * values[Dim * i + j] + (1 - part) * opposite[Dim * j + i];
			if (isItself) return part * values[Dim * i + j] + (1 - part) * values[Dim * j + i];
			if (!isTransposed) return values[Dim * i + j] + (skew ? (1 - part) * skew[Dim * i + j] : 0);
			return values[Dim * j + i] + (skew ? part * skew[Dim * j + i] : 0);
		}
	};

	bool isConstrained(int node, int axis) const { return dofs_.number[Dim * node + axis] < 0; }
	int  count() const { return end_ - begin_; }
	bool isOwn(int row) const { return row >= begin_ && row < end_; }
	int  firstOf(int n) const { return first_[n - begin_]; }

	/// Diagonal of a component; that of a constrained one is as large as its neighbours', whose unknowns multigrid
	/// takes together with it.
	double diagonalOf(int node, int axis) const
	{
		const double diagonal = K_.at(node, 0)[axis * Dim + axis];
		return diagonal > 0 || !isConstrained(node, axis) ? diagonal : 1;
	}

	/// Calls f(row, block) for each block of the rows.
	template <class F> void forBlocks(F&& f) const
	{
		for (const int a : nodes_)
			for (int c = 0; c < K_.codes; ++c) {
				if (c > 0 && !K_.used(a, c)) continue;
				const int b = K_.neighbour(a, c);
				if (row_[b] < 0) continue;
				if (!isOwn(row_[a]) && !isOwn(row_[b])) continue; // it may not be here
				const double* skew = c == 0 || K_.isSymmetric() ? nullptr : K_.skewAt(a, c);
				if (isOwn(row_[a])) f(row_[a], Block { row_[b], false, K_.at(a, c), skew, c == 0 && !K_.isSymmetric() });
				if (c > 0 && isOwn(row_[b])) f(row_[b], Block { row_[a], true, K_.at(a, c), skew });
			}
		if (couplings_) forCoupledBlocks(f);
	}
	template <class F> void forCoupledBlocks(F&& f) const
	{
		couplings_->forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
			const int a = row_[row.node], b = row_[column.node];
			if (a < 0 || b < 0) return;
			if (isOwn(a)) f(a, Block { b, false, values, nullptr, false, true, couplings_->opposite(row, column) });
			if (K_.isSymmetric() && a != b && isOwn(b)) f(b, Block { a, true, values, nullptr, false, true });
		});
	}
	/// Columns rise, because lower nodes are visited first.
	bool hasOrder() const { return !K_.isPeriodic() && !couplings_; }

	void findBlocks()
	{
		first_.assign(count() + 1, 0);
		forBlocks([&](int row, const Block&) { ++first_[row - begin_ + 1]; });
		for (int n = 0; n < count(); ++n)
			first_[n + 1] += first_[n];
		blocks_.resize(first_.back());
		std::vector<int> next(first_.begin(), first_.end() - 1);
		forBlocks([&](int row, const Block& block) { blocks_[next[row - begin_]++] = block; });
		const auto before = [](const Block& a, const Block& b) { return a.column < b.column; };
		for (int n = 0; n < count() && !hasOrder(); ++n)
			std::stable_sort(blocks_.begin() + first_[n], blocks_.begin() + first_[n + 1], before);
	}

	/// On a small periodic grid two blocks may be for the same nodes, and where there are couplings.
	bool isSameAsBefore(int n, int block) const { return block > firstOf(n) && blocks_[block].column == blocks_[block - 1].column; }

	void startRows(NodeRows& out) const
	{
		out.start.push_back(0);
		for (int n = begin_; n < end_; ++n) {
			int different = 0;
			for (int e = firstOf(n); e < firstOf(n + 1); ++e)
				different += !isSameAsBefore(n, e);
			for (int i = 0; i < Dim; ++i)
				out.start.push_back(out.start.back() + Dim * different);
		}
	}

	void fillRows(int n, NodeRows& out, std::vector<double>& value, double part) const
	{
		for (int i = 0; i < Dim; ++i) {
			int at = out.start[Dim * (n - begin_) + i] - Dim;
			for (int e = firstOf(n); e < firstOf(n + 1); ++e) {
				const Block& block = blocks_[e];
				if (!isSameAsBefore(n, e)) at += Dim;
				for (int j = 0; j < Dim; ++j) {
					const bool isDiagonal = block.column == n && i == j,
					           holds      = isConstrained(nodes_[n], i) || isConstrained(nodes_[block.column], j);
					out.column[at + j]    = Dim * block.column + j;
					if (isDiagonal && !block.isCoupled) value[at + j] = diagonalOf(nodes_[n], i);
					else if (!holds)
						value[at + j] += block.at(i, j, part);
				}
			}
		}
	}

	void position(NodeRows& out) const
	{
		Vec<Dim> mean = Vec<Dim>::Zero();
		for (const int a : nodes_)
			mean += Grid<Dim>::index(K_.keys()[a]).template cast<double>() / double(nodes_.size());
		for (int n = begin_; n < end_; ++n)
			for (int i = 0; i < Dim; ++i)
				out.position.push_back(Grid<Dim>::index(K_.keys()[nodes_[n]])[i] - mean[i]);
	}

	const NodeMatrix<Dim>& K_;
	const FreeDofs&        dofs_;
	const Couplings*       couplings_;           ///< null: there are none
	std::vector<int>       row_, nodes_;         ///< number of each node among those with rows, or -1; and these
	int                    begin_ = 0, end_ = 0; ///< range of these nodes whose rows are wanted
	std::vector<int>       first_;               ///< block of each row of blocks
	std::vector<Block>     blocks_;
};

} // namespace

template <int Dim> std::optional<NodeRows> nodeRows(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings)
{
	Rows<Dim> rows(K, dofs, ownedNodes, couplings);
	if (rows.entries() > std::size_t(std::numeric_limits<int>::max())) return std::nullopt;
	return rows.make();
}

std::string obstacleTo(const std::optional<NodeRows>& rows, const OwnedNodes& ownedNodes, bool& hasPositions)
{
	std::int64_t isThere[3] = { rows.has_value(), 0, !(rows && !rows->position.empty()) };
	if (rows) isThere[1] = std::all_of(rows->value.begin(), rows->value.end(), [](double value) { return std::isfinite(value); });
	ownedNodes.processes.smallest(isThere, 3);
	hasPositions = !isThere[2];
	if (!isThere[0]) return "the matrix has more entries than can be counted";
	return isThere[1] ? "" : "the matrix has numbers that are not finite";
}

template std::optional<NodeRows> nodeRows(const NodeMatrix<2>&, const FreeDofs&, const OwnedNodes&, const Couplings*);
template std::optional<NodeRows> nodeRows(const NodeMatrix<3>&, const FreeDofs&, const OwnedNodes&, const Couplings*);

} // namespace gimpm
