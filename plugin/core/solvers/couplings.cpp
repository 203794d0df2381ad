// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/couplings.hpp"
#include <algorithm>

namespace gimpm {

void Couplings::reset(const DofMap& map, bool isSymmetric)
{
	map_         = &map;
	isSymmetric_ = isSymmetric;
	rows_.assign(std::size_t(map.fields()) * map.nodes(), {});
	values_.clear();
}

void Couplings::mark(const FieldNode& row, const FieldNode& column)
{
	markKept(numberOf(row), numberOf(column));
	markKept(numberOf(column), numberOf(row));
}

void Couplings::markRow(const FieldNode& row, int field, const std::vector<int>& nodes)
{
	const int  r       = numberOf(row);
	auto&      entries = rows_[r];
	const auto before  = std::ptrdiff_t(entries.size());
	entries.reserve(entries.size() + nodes.size());
	for (const int node : nodes)
		if (const int c = numberOf({ field, node }); keeps(r, c)) entries.push_back({ c, 0 });
	const auto middle = entries.begin() + before;
	values_.clear();
	if (before == 0 || middle == entries.end() || (middle - 1)->column < middle->column) return;
	std::inplace_merge(entries.begin(), middle, entries.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
	entries.erase(std::unique(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.column == b.column; }), entries.end());
}

/// It has no place among the values yet, nor do the others keep theirs.
void Couplings::markKept(int row, int column)
{
	if (!keeps(row, column)) return;
	const auto at = std::lower_bound(rows_[row].begin(), rows_[row].end(), column);
	if (at != rows_[row].end() && at->column == column) return;
	rows_[row].insert(at, { column, 0 });
	values_.clear();
}

/// Positions are given row by row, as who takes the matrix reads them.
void Couplings::setZero()
{
	std::fill(values_.begin(), values_.end(), 0.);
	if (!values_.empty()) return;
	std::size_t next = 0;
	for (int r = 0; r < int(rows_.size()); ++r)
		for (Entry& entry : rows_[r]) {
			entry.first = next;
			next += std::size_t((*map_)[fieldNodeOf(r).field].width) * (*map_)[fieldNodeOf(entry.column).field].width;
		}
	values_.assign(next, 0);
}

/// First of the values of a block that is kept.
std::size_t Couplings::firstOf(int row, int column) const { return std::lower_bound(rows_[row].begin(), rows_[row].end(), column)->first; }

void Couplings::findOffsets(const FieldNode& row, int field, const int* nodes, int count, std::ptrdiff_t* offsets) const
{
	const int   r       = numberOf(row);
	const auto& entries = rows_[r];
	auto        at      = entries.begin();
	for (int i = 0, c = -1; i < count; ++i) {
		offsets[i] = -1;
		if (nodes[i] < 0) continue;
		const int before = std::exchange(c, numberOf({ field, nodes[i] }));
		if (!keeps(r, c)) continue;
		if (c < before) at = entries.begin();
		while (at->column < c)
			++at;
		offsets[i] = std::ptrdiff_t(at->first);
	}
}

bool Couplings::areWithinDisplacements() const
{
	for (int r = 0; r < map_->nodes(); ++r)
		if (!rows_[r].empty() && rows_[r].front().column < map_->nodes()) return true;
	return false;
}

const double* Couplings::opposite(const FieldNode& row, const FieldNode& column) const
{
	return isSymmetric_ ? nullptr : values_.data() + firstOf(numberOf(column), numberOf(row));
}

void Couplings::multiplyAdd(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
		const int                        rows = (*map_)[row.field].width, columns = (*map_)[column.field].width;
		const int                        i = map_->at(row.field, row.node), j = map_->at(column.field, column.node);
		const Eigen::Map<const RowMajor> K(values, rows, columns);
		y.segment(i, rows) += K * x.segment(j, columns);
		if (!isSymmetric_ || i == j) return;
		const int sign = signOf(row.field) * signOf(column.field);
		y.segment(j, columns) += sign * (K.transpose() * x.segment(i, rows));
	});
}

std::vector<MatrixEntry> freeEntries(const Couplings& K, const FreeDofs& dofs)
{
	const int                width = K.map()[0].width;
	std::vector<MatrixEntry> entries;
	K.forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
		for (int i = width * row.node; i < width * (row.node + 1); ++i)
			for (int j = width * column.node; j < width * (column.node + 1); ++j, ++values) {
				if (dofs.number[i] < 0 || dofs.number[j] < 0) continue;
				entries.push_back({ i, j, *values });
				if (K.isSymmetric() && row.node != column.node) entries.push_back({ j, i, *values });
			}
	});
	return entries;
}

} // namespace gimpm
