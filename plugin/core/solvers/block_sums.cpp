// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/block_sums.hpp"
#include "core/grid/masters.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Numbers in lists: list l has those from start[l] to start[l + 1] - 1.
struct Lists {
	std::vector<std::size_t> start;
	std::vector<int>         number;

	/// forPairs(f) calls f(list, number), twice the same.
	template <class Pairs> Lists(int count, Pairs&& forPairs) : start(count + 1, 0)
	{
		forPairs([&](int list, int) { ++start[list + 1]; });
		for (int list = 0; list < count; ++list)
			start[list + 1] += start[list];
		number.resize(start.back());
		std::vector<std::size_t> next(start.begin(), start.end() - 1);
		forPairs([&](int list, int entry) { number[next[list]++] = entry; });
	}
	explicit Lists() : start(1, 0) { }

	template <class F> void each(int list, F&& f) const
	{
		for (std::size_t e = start[list]; e < start[list + 1]; ++e)
			f(number[e]);
	}
};

/// A block as it is stored, of two nodes in their fields, which may be tied. Its mirrored entries belong to the
/// opposite block; null: it has none.
struct StoredBlock {
	FieldNode     row, column;
	const double *values, *mirrored;
	double        sign = 1, ofRow = 1, ofColumn = 1; ///< factors of all entries
};

template <int Dim, class F> void forStoredBlocks(const NodeMatrix<Dim>& K, const Couplings* couplings, F&& f)
{
	std::array<double, Dim * Dim> opposite;
	for (int a = 0; a < K.nodes(); ++a)
		for (int c = 0; c < K.codes; ++c) {
			if (!K.used(a, c)) continue;
			const int     b     = K.neighbour(a, c);
			const double *above = K.at(a, c), *skew = K.isSymmetric() ? nullptr : K.skewAt(a, c);
			for (int k = 0; skew && k < Dim * Dim; ++k)
				opposite[k] = above[k] + skew[k];
			f(StoredBlock { { 0, a }, { 0, b }, above, b == a ? nullptr : skew ? opposite.data() : above });
		}
	if (!couplings) return;
	const DofMap& map = couplings->map();
	couplings->forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
		const bool isMirrored = couplings->isSymmetric() && (row.field != column.field || row.node != column.node);
		f(StoredBlock { row, column, values, isMirrored ? values : nullptr, double(couplings->signOf(row.field)), map[row.field].scale,
		                map[column.field].scale });
	});
}

/// Blocks of nodes that are not tied, by columns. Nodes of all fields are numbered one after the other.
template <int Dim> class BlockSums {
public:
	BlockSums(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings* couplings, bool isTriangle)
	        : dofs_(dofs)
	        , map_(couplings ? couplings->map() : DofMap(K.nodes(), { { "", "", Dim } }))
	        , masters_(K.nodes(), dofs.affineConstraints)
	        , isTriangle_(isTriangle)
	{
		findPattern(K, couplings);
		forStoredBlocks(K, couplings, [this](const StoredBlock& block) { add(block); });
	}

	void compress(Csc& out) const
	{
		out.start.assign(1, 0);
		out.row.clear(), out.value.clear();
		out.row.reserve(values_.size()), out.value.reserve(values_.size());
		for (int n = 0; n < size(); ++n)
			for (int j = 0; j < width(n); ++j)
				if (const int column = unknown(n, j); column >= 0) {
					appendColumn(n, j, column, out);
					out.start.push_back(int(out.row.size()));
				}
	}

private:
	int  size() const { return map_.fields() * map_.nodes(); }
	int  numberOf(const FieldNode& at) const { return at.field * map_.nodes() + at.node; }
	int  fieldOf(int n) const { return n / map_.nodes(); }
	int  width(int n) const { return map_[fieldOf(n)].width; }
	int  unknown(int n, int i) const { return dofs_.number[map_.at(fieldOf(n), n % map_.nodes()) + i]; }
	bool isFree(int n) const
	{
		for (int i = 0; i < width(n); ++i)
			if (unknown(n, i) >= 0) return true;
		return false;
	}

	/// Calls f(number, weight) for the masters.
	template <class F> void forMasters(const FieldNode& of, F&& f) const
	{
		masters_.each(of.node, [&](int node, double weight) { f(numberOf({ of.field, node }), weight); });
	}
	template <class F> void forMasters(int n, F&& f) const { forMasters(FieldNode { fieldOf(n), n % map_.nodes() }, f); }

	/// A column has the rows of all masters of nodes that are coupled with those it is a master of.
	void findPattern(const NodeMatrix<Dim>& K, const Couplings* couplings)
	{
		const Lists      rowsOf(size(), [&](auto&& f) {
                        forStoredBlocks(K, couplings, [&](const StoredBlock& block) {
                                f(numberOf(block.column), numberOf(block.row));
                                if (block.mirrored) f(numberOf(block.row), numberOf(block.column));
                        });
                });
		const Lists      tiedTo(size(), [&](auto&& f) {
                        for (int n = 0; n < size(); ++n)
                                forMasters(n, [&](int master, double) { f(master, n); });
                });
		std::vector<int> last(size(), -1);
		for (int n = 0; n < size(); ++n) {
			if (isFree(n))
				tiedTo.each(n, [&](int tied) {
					rowsOf.each(tied, [&](int row) {
						forMasters(row, [&](int m, double) {
							if (std::exchange(last[m], n) != n && (!isTriangle_ || m >= n) && isFree(m)) rows_.number.push_back(m);
						});
					});
				});
			endColumn(n);
		}
		values_.assign(first_.back(), 0);
	}
	void endColumn(int n)
	{
		std::sort(rows_.number.begin() + std::ptrdiff_t(rows_.start.back()), rows_.number.end());
		for (std::size_t e = rows_.start.back(); e < rows_.number.size(); ++e)
			first_.push_back(first_.back() + std::size_t(width(n)) * width(rows_.number[e]));
		rows_.start.push_back(rows_.number.size());
	}

	void add(const StoredBlock& block)
	{
		forMasters(block.row, [&](int m, double ofM) {
			forMasters(block.column, [&](int n, double ofN) {
				const double weight   = ofM * ofN * block.sign * block.ofRow * block.ofColumn;
				double*      own      = find(m, n);
				double*      mirrored = block.mirrored ? find(n, m) : nullptr;
				if (width(m) == Dim && width(n) == Dim) add<Dim>(block, weight, own, mirrored, Dim, Dim);
				else
					add<0>(block, weight, own, mirrored, width(m), width(n));
			});
		});
	}
	/// Adds all entries; with `Size` of a square block whose size is known in advance.
	template <int Size> static void add(const StoredBlock& block, double weight, double* own, double* mirrored, int rows, int columns)
	{
		if (Size > 0) rows = columns = Size;
		for (int i = 0, k = 0; i < rows; ++i)
			for (int j = 0; j < columns; ++j, ++k) {
				if (own) own[j * rows + i] += weight * block.values[k];
				if (mirrored) mirrored[i * columns + j] += weight * block.mirrored[k];
			}
	}
	/// Values of a block column by column; null: it is not kept.
	double* find(int m, int n)
	{
		const auto begin = rows_.number.begin(), end = begin + std::ptrdiff_t(rows_.start[n + 1]);
		const auto found = std::lower_bound(begin + std::ptrdiff_t(rows_.start[n]), end, m);
		return found != end && *found == m ? values_.data() + first_[std::size_t(found - begin)] : nullptr;
	}

	void appendColumn(int n, int j, int column, Csc& out) const
	{
		for (std::size_t e = rows_.start[n]; e < rows_.start[n + 1]; ++e) {
			const int     m = rows_.number[e], rows = width(m);
			const double* values = values_.data() + first_[e] + std::size_t(j) * rows;
			for (int i = 0; i < rows; ++i)
				if (const int row = unknown(m, i); row >= 0 && (row >= column || !isTriangle_)) {
					out.row.push_back(row);
					out.value.push_back(values[i]);
				}
		}
	}

	const FreeDofs&          dofs_;
	const DofMap             map_;
	const MastersOf          masters_;
	const bool               isTriangle_;
	Lists                    rows_;        // of each column
	std::vector<std::size_t> first_ { 0 }; // value of each block
	std::vector<double>      values_;
};

} // namespace

template <int Dim> void addUp(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings* couplings, bool isTriangle, Csc& out)
{
	BlockSums<Dim>(K, dofs, couplings, isTriangle).compress(out);
}

template void addUp(const NodeMatrix<2>&, const FreeDofs&, const Couplings*, bool, Csc&);
template void addUp(const NodeMatrix<3>&, const FreeDofs&, const Couplings*, bool, Csc&);

} // namespace gimpm
