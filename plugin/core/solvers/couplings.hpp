// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks of a matrix between any two nodes of any two fields.
#pragma once
#include "core/fields/constraints.hpp"
#include <algorithm>
#include <utility>

namespace gimpm {

/// Begin of a block: a node in one of the fields.
struct FieldNode {
	int field = 0, node = 0;
};

/// Coupling blocks of a matrix besides those of NodeMatrix, which are for displacements of neighbours on the grid:
/// blocks for pairs of fields, and for nodes that are apart. There is memory for those only that have been marked. A
/// symmetric matrix, which it is when the rows of each field have its sign, keeps the blocks above the diagonal:
/// callers that add K_ab and K_ba need not know of it.
class Couplings {
public:
	/// Sets up a matrix without blocks. The map must outlive it.
	void reset(const DofMap&, bool isSymmetric);
	/// And the transposed block: the pattern is symmetric.
	void mark(const FieldNode& row, const FieldNode& column);
	/// The same of blocks in one row, with nodes in one field, which rise; not the transposed ones.
	void markRow(const FieldNode& row, int field, const std::vector<int>& nodes);
	void setZero();

	/// To a block that was marked, after setZero(). Threads may add at the same time in different rows.
	template <class Block> void add(const FieldNode& row, const FieldNode& column, const Block& block)
	{
		const int r = numberOf(row), c = numberOf(column);
		if (keeps(r, c)) Eigen::Map<RowMajor>(values_.data() + firstOf(r, c), block.rows(), block.cols()) += block;
	}
	void add(const FieldNode& row, const FieldNode& column, double value) { add(row, column, Eigen::Matrix<double, 1, 1>(value)); }

	/// Finds the begins of the blocks of one row with `count` nodes in one field among the values, or -1 where they
	/// are not kept; all are marked, those with nodes < 0 left out. Fast where nodes rise. Valid until another
	/// block is marked.
	void    findOffsets(const FieldNode& row, int field, const int* nodes, int count, std::ptrdiff_t* offsets) const;
	double* values() { return values_.data(); }

	bool isSymmetric() const { return isSymmetric_; }
	/// Factor of a row of the field that makes the matrix symmetric; one for a matrix that is not.
	int           signOf(int field) const { return isSymmetric_ ? (*map_)[field].sign : 1; }
	const DofMap& map() const { return *map_; }

	/// Values of the block that is opposite to one that is kept; null: the matrix is symmetric.
	const double* opposite(const FieldNode& row, const FieldNode& column) const;

	/// y += K x
	void multiplyAdd(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

	/// Calls f(row, column, values row by row) for the blocks that are kept, row by row.
	template <class F> void forBlocks(F&& f) const
	{
		for (int r = 0; r < int(rows_.size()); ++r)
			for (const Entry& entry : rows_[r])
				f(fieldNodeOf(r), fieldNodeOf(entry.column), values_.data() + entry.first);
	}
	/// Calls f(column, values row by row) for those in one row.
	template <class F> void forBlocksOf(const FieldNode& row, F&& f) const
	{
		for (const Entry& entry : rows_[numberOf(row)])
			f(fieldNodeOf(entry.column), values_.data() + entry.first);
	}
	/// True if there are any between displacements.
	bool areWithinDisplacements() const;

private:
	using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

	/// A block: its column, and the first of its values.
	struct Entry {
		int         column;
		std::size_t first;
		bool        operator<(int c) const { return column < c; }
	};

	int         numberOf(const FieldNode& fieldNode) const { return fieldNode.field * map_->nodes() + fieldNode.node; }
	FieldNode   fieldNodeOf(int number) const { return { number / map_->nodes(), number % map_->nodes() }; }
	bool        keeps(int row, int column) const { return !isSymmetric_ || row <= column; }
	void        markKept(int row, int column);
	std::size_t firstOf(int row, int column) const;

	const DofMap*                   map_         = nullptr;
	bool                            isSymmetric_ = true;
	std::vector<std::vector<Entry>> rows_; // rows of each node in each field, by rising columns
	std::vector<double>             values_;
};

/// Entry by unknowns.
struct MatrixEntry {
	int    row, column;
	double value;
};

/// Entries of couplings of displacements between free unknowns: both triangles.
std::vector<MatrixEntry> freeEntries(const Couplings&, const FreeDofs&);

} // namespace gimpm
