// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/signed_factor.hpp"
#include "core/base/instruction_set.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

// BLAS functions.
extern "C" void dgemm_(
        const char* transposedA, const char* transposedB, const int* rows, const int* columns, const int* inner, const double* alpha, const double* A,
        const int* strideA, const double* B, const int* strideB, const double* beta, double* C, const int* strideC);
extern "C" void dtrsm_(
        const char* side, const char* triangle, const char* transposed, const char* diagonal, const int* rows, const int* columns, const double* alpha,
        const double* A, const int* strideA, double* B, const int* strideB);

namespace gimpm {
namespace {

/// A supernodal factor of CHOLMOD: the columns of a supernode are dense, and have the same rows, first their own.
struct Supernodes {
	int        count;
	const int *columns, *rowsBegin, *valuesBegin, *rows;

	explicit Supernodes(const cholmod_factor& L)
	        : count(int(L.nsuper))
	        , columns(static_cast<const int*>(L.super))
	        , rowsBegin(static_cast<const int*>(L.pi))
	        , valuesBegin(static_cast<const int*>(L.px))
	        , rows(static_cast<const int*>(L.s))
	{
	}
	int        width(int s) const { return columns[s + 1] - columns[s]; }
	int        height(int s) const { return rowsBegin[s + 1] - rowsBegin[s]; }
	const int* rowsOf(int s) const { return rows + rowsBegin[s]; }

	std::vector<int> ofColumns() const
	{
		std::vector<int> of(columns[count]);
		for (int s = 0; s < count; ++s)
			std::fill(of.begin() + columns[s], of.begin() + columns[s + 1], s);
		return of;
	}
};

using Four [[gnu::vector_size(4 * sizeof(double))]] = double; // in one register, or in two

/// Products A S B^T of some rows and columns, a tile at a time in the registers: small ones are faster so than by the
/// BLAS, which copies what it is given.
class Products {
public:
	static constexpr int rows = 8, columns = 6; ///< size of a tile
	struct Tile {
		Four of[columns][2];
	};

	/// B S, of so many rows and columns, which the columns of the product are to be multiplied with.
	void takeRight(const double* b, int stride, int count, int inner, const double* signs)
	{
		inner_ = inner;
		right_.resize(std::size_t((count + columns - 1) / columns) * columns * inner);
		double* __restrict out = right_.data();
		for (int first = 0; first < count; first += columns, b += columns) {
			const double* from = b;
			if (first + columns <= count)
				for (int k = 0; k < inner; ++k, from += stride, out += columns)
					for (int c = 0; c < columns; ++c)
						out[c] = signs[k] * from[c];
			else
				for (int k = 0; k < inner; ++k, from += stride, out += columns)
					for (int c = 0; c < columns; ++c)
						out[c] = first + c < count ? signs[k] * from[c] : 0;
		}
	}
	/// Rows of A, at most those of a tile.
	void takeLeft(const double* a, int stride, int count)
	{
		left_.resize(std::size_t(rows) * inner_);
		double* __restrict out = left_.data();
		if (count == rows)
			for (int k = 0; k < inner_; ++k, a += stride, out += rows)
				std::memcpy(out, a, rows * sizeof(double));
		else
			for (int k = 0; k < inner_; ++k, a += stride, out += rows)
				for (int i = 0; i < rows; ++i)
					out[i] = i < count ? a[i] : 0;
	}
	/// Product of the rows that were taken last and a tile of columns from `first` on.
	void multiply(int first, Tile& product) const
	{
		Four          sum[columns][2] = {};
		const double *a = left_.data(), *b = right_.data() + std::ptrdiff_t(first) * inner_;
		for (int k = 0; k < inner_; ++k, a += rows, b += columns) {
			Four lower, upper;
			std::memcpy(&lower, a, sizeof lower), std::memcpy(&upper, a + rows / 2, sizeof upper);
			for (int c = 0; c < columns; ++c)
				sum[c][0] += lower * b[c], sum[c][1] += upper * b[c];
		}
		std::memcpy(&product, sum, sizeof product);
	}

private:
	int                 inner_ = 0;
	std::vector<double> left_, right_;
};

/// Side below the diagonal, or the one above it, transposed: then it has the same pattern.
struct Side {
	const EntryDestinations& entries;
	double*                  values; // values of the factor
};

/// Factorisation of a symmetric matrix with one side, of another one with two, of which each takes its products with
/// the other one. The diagonal belongs to the first.
class Factorisation {
public:
	Factorisation(const Supernodes& L, std::vector<Side> sides, const std::vector<double>& values, Eigen::VectorXd& signs)
	        : L_(L)
	        , sides_(std::move(sides))
	        , values_(values)
	        , signs_(signs)
	        , supernode_(L.ofColumns())
	        , first_(L.count, -1)
	        , next_(L.count, -1)
	        , taken_(L.count, 0)
	        , slot_(supernode_.size())
	{
	}

	bool run(double smallest)
	{
		for (int s = 0; s < L_.count; ++s) {
			begin(s);
			for (int d = first_[s], after; d >= 0; d = after) {
				after = next_[d];
				takeAway(d, s);
			}
			eliminate(s);
			taken_[s] = L_.width(s);
			passOn(s);
		}
		return least_ > smallest * largest_; // not with NaN
	}

private:
	static constexpr int    atOnce = 24;  ///< columns
	static constexpr double large  = 1e8; ///< products of numbers, as many as the copies of the BLAS are worth

	int     sides() const { return int(sides_.size()); }
	int     otherThan(int side) const { return sides() - 1 - side; }
	double* blockOf(int side, int s) const { return sides_[side].values + L_.valuesBegin[s]; }

	/// Begins a supernode with the entries of the matrix.
	void begin(int s)
	{
		for (int i = 0; i < L_.height(s); ++i)
			slot_[L_.rowsOf(s)[i]] = i;
		for (int side = 0; side < sides(); ++side) {
			const EntryDestinations& entries = sides_[side].entries;
			double*                  block   = blockOf(side, s);
			std::fill_n(block, std::ptrdiff_t(L_.width(s)) * L_.height(s), 0.);
			for (int i = entries.start[s]; i < entries.start[s + 1]; ++i)
				block[entries.entries[i].slot] += values_[entries.entries[i].number];
		}
	}

	/// Subtracts what an earlier supernode d has in the columns of s.
	void takeAway(int d, int s)
	{
		const int  height = L_.height(d), begin = taken_[d];
		const int* rows  = L_.rowsOf(d) + begin;
		const int  below = height - begin, within = int(std::lower_bound(rows, rows + below, L_.columns[s + 1]) - rows);
		into_.resize(below);
		std::transform(rows, rows + below, into_.begin(), [this](int row) { return slot_[row]; });
		for (int side = 0; side < sides(); ++side)
			subtract(
			        side, blockOf(side, d) + begin, blockOf(otherThan(side), d) + begin, height, below, within, L_.width(d),
			        signs_.data() + L_.columns[d], s);
		taken_[d] += within;
		passOn(d);
	}

	/// Takes A S B^T away from a side of a supernode, of rows and columns that go `into_` its own, with B the first
	/// of the same rows of the other side. What is above the diagonal is of no use, and may be left out.
	void subtract(int side, const double* a, const double* b, int stride, int rows, int columns, int inner, const double* signs, int s)
	{
		if (double(rows) * columns * inner > large) return subtractLarge(side, a, b, stride, rows, columns, inner, signs, s);
		products_.takeRight(b, stride, columns, inner, signs);
		Products::Tile product;
		for (int i = 0; i < rows; i += Products::rows) {
			const int  count = std::min(Products::rows, rows - i), slot = into_[i];
			const bool isRun = count == Products::rows && into_[i + count - 1] == slot + count - 1;
			products_.takeLeft(a + i, stride, count);
			for (int j = 0; j < std::min(columns, i + count); j += Products::columns) {
				const int end = std::min(j + Products::columns, columns);
				for (int c = j; c < end; ++c) // it comes while they are multiplied
					for (const int row : { slot, slot + Products::rows - 1 })
						__builtin_prefetch(column(side, s, c) + row, 1);
				products_.multiply(j, product);
				for (int c = j; c < end; ++c)
					if (isRun) takeFrom(column(side, s, c) + slot, product.of[c - j]);
					else
						for (int k = 0; k < count; ++k)
							column(side, s, c)[into_[i + k]] -= product.of[c - j][k / 4][k % 4];
			}
		}
	}
	double* column(int side, int s, int c) const { return blockOf(side, s) + std::ptrdiff_t(into_[c]) * L_.height(s); }

	/// Subtracts by the BLAS, which may have several threads for it.
	void subtractLarge(int side, const double* a, const double* b, int stride, int rows, int columns, int inner, const double* signs, int s)
	{
		constexpr int few = 64; // columns at once
		const double  one = 1, none = 0;
		right_.resize(std::size_t(columns) * inner);
		for (int k = 0; k < inner; ++k)
			for (int c = 0; c < columns; ++c)
				right_[c + std::size_t(k) * columns] = signs[k] * b[c + std::ptrdiff_t(k) * stride];
		update_.resize(std::size_t(rows) * few);
		for (int first = 0; first < columns; first += few) {
			const int count = std::min(few, columns - first), left = rows - first;
			dgemm_("N", "T", &left, &count, &inner, &one, a + first, &stride, right_.data() + first, &columns, &none, update_.data(), &left);
			for (int c = 0; c < count; ++c)
				for (int i = c; i < left; ++i)
					column(side, s, first + c)[into_[first + i]] -= update_[i + std::size_t(c) * left];
		}
	}
	static void takeFrom(double* to, const Four (&run)[2])
	{
		for (int part = 0; part < 2; ++part, to += 4) {
			Four value;
			std::memcpy(&value, to, sizeof value);
			value -= run[part];
			std::memcpy(to, &value, sizeof value);
		}
	}

	/// To the supernode that needs it next.
	void passOn(int d)
	{
		if (taken_[d] == L_.height(d)) return;
		const int s = supernode_[L_.rowsOf(d)[taken_[d]]];
		next_[d]    = first_[s];
		first_[s]   = d;
	}

	/// The columns of a supernode, a few at once. As where each half takes away from the next one, products are of
	/// as many columns as have been done since the later ones were last looked at: 1, 2, 1, 4, 1, 2, 1, 8 ... times
	/// a few.
	void eliminate(int s)
	{
		const int width = L_.width(s), height = L_.height(s);
		for (int begin = 0, done = 1; begin < width; begin += atOnce, ++done) {
			const int end = std::min(begin + atOnce, width), part = atOnce * (done & -done), later = std::min(end + part, width) - end;
			eliminateFew(s, begin, end);
			if (later == 0) return;
			into_.resize(height - end);
			std::iota(into_.begin(), into_.end(), end);
			for (int side = 0; side < sides(); ++side) {
				const std::ptrdiff_t from = end + std::ptrdiff_t(end - part) * height;
				subtract(
				        side, blockOf(side, s) + from, blockOf(otherThan(side), s) + from, height, height - end, later, part,
				        signs_.data() + L_.columns[s] + end - part, s);
			}
		}
	}
	void eliminateFew(int s, int begin, int end)
	{
		const int            height = L_.height(s), count = end - begin, below = height - end;
		const std::ptrdiff_t from  = begin + std::ptrdiff_t(begin) * height;
		double*              signs = signs_.data() + L_.columns[s] + begin;
		factoriseDense(s, from, count, signs);
		if (below == 0) return;
		const double one = 1;
		for (int side = 0; side < sides(); ++side) {
			double* block = blockOf(side, s) + from;
			dtrsm_("R", "L", "T", "N", &below, &count, &one, blockOf(otherThan(side), s) + from, &height, block + count, &height);
			for (int c = 0; c < count; ++c)
				if (signs[c] < 0)
					for (double *x = block + count + std::ptrdiff_t(c) * height, *last = x + below; x < last; ++x)
						*x = -*x;
		}
	}
	void factoriseDense(int s, std::ptrdiff_t from, int count, double* signs)
	{
		const int stride = L_.height(s);
		for (int k = 0; k < count; ++k) {
			const std::ptrdiff_t at = from + std::ptrdiff_t(k) * stride;
			for (int side = 0; side < sides(); ++side) {
				double* column = blockOf(side, s) + at;
				for (int j = 0; j < k; ++j) {
					const std::ptrdiff_t earlier = from + std::ptrdiff_t(j) * stride;
					const double *       before = blockOf(side, s) + earlier, part = signs[j] * blockOf(otherThan(side), s)[earlier + k];
					for (int i = k; i < count; ++i)
						column[i] -= part * before[i];
				}
			}
			const double own = blockOf(0, s)[at + k], pivot = std::abs(own), root = std::sqrt(pivot);
			signs[k] = own < 0 ? -1 : 1;
			least_   = pivot < least_ || std::isnan(pivot) ? pivot : least_;
			largest_ = std::max(largest_, pivot);
			for (int side = 0; side < sides(); ++side) {
				double* column = blockOf(side, s) + at;
				column[k]      = root;
				for (int i = k + 1; i < count; ++i)
					column[i] *= signs[k] / root;
			}
		}
	}

	const Supernodes&          L_;
	const std::vector<Side>    sides_;
	const std::vector<double>& values_;
	Eigen::VectorXd&           signs_;
	std::vector<int>           supernode_;    // supernode of each column
	std::vector<int>           first_, next_; // lists: of each supernode the earlier ones that have rows there
	std::vector<int>           taken_;        // rows of each supernode that are done
	std::vector<int>           slot_;         // position of each row in the supernode at hand
	std::vector<int>           into_;         // position there of each row of an update
	Products                   products_;
	std::vector<double>        right_, update_; // operands of large products, reused
	double                     least_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

} // namespace

EntryDestinations::EntryDestinations(const cholmod_factor& factor, const Csc& K, Part part)
{
	const Supernodes L(factor);
	const int *      order = static_cast<const int*>(factor.Perm), n = K.size();
	std::vector<int> number(n), slot(n);
	for (int i = 0; i < n; ++i)
		number[order[i]] = i;
	const auto supernode  = L.ofColumns();
	const auto forEntries = [&](auto&& f) {
		for (int c = 0; c < n; ++c)
			for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
				const int  row = number[K.row[e]], column = number[c];
				const bool isOfPart = part == Part::triangle ? K.row[e] <= c : part == Part::below ? row >= column : row < column;
				if (isOfPart) f(e, std::min(row, column), std::max(row, column));
			}
	};
	start.assign(L.count + 1, 0);
	forEntries([&](int, int column, int) { ++start[supernode[column] + 1]; });
	std::partial_sum(start.begin(), start.end(), start.begin());
	struct Unsorted {
		int e, column, row;
	};
	std::vector<Unsorted> sorted(start.back());
	std::vector<int>      next(start.begin(), start.end() - 1);
	forEntries([&](int e, int column, int row) { sorted[next[supernode[column]]++] = { e, column, row }; });
	entries.resize(sorted.size());
	for (int s = 0; s < L.count; ++s) {
		for (int i = 0; i < L.height(s); ++i)
			slot[L.rowsOf(s)[i]] = i;
		for (int i = start[s]; i < start[s + 1]; ++i) {
			const int row = slot[sorted[i].row];
			areInPattern  = areInPattern && row < L.height(s) && L.rowsOf(s)[row] == sorted[i].row;
			entries[i]    = { sorted[i].e, (sorted[i].column - L.columns[s]) * L.height(s) + row };
		}
	}
}

namespace {

bool factorise(const Supernodes& L, const std::vector<Side>& sides, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs)
{
	signs.resize(L.columns[L.count]);
	bool hasDone = false;
	callForProcessor([&] { hasDone = Factorisation(L, sides, values, signs).run(smallest); });
	return hasDone;
}

} // namespace

bool factoriseSigned(cholmod_factor& factor, const EntryDestinations& entries, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs)
{
	return factorise(Supernodes(factor), { { entries, static_cast<double*>(factor.x) } }, values, smallest, signs);
}

bool factoriseSigned(
        cholmod_factor& factor, std::vector<double>& upper, const EntryDestinations& below, const EntryDestinations& above, const std::vector<double>& values,
        double smallest, Eigen::VectorXd& signs)
{
	upper.resize(factor.xsize);
	return factorise(Supernodes(factor), { { below, static_cast<double*>(factor.x) }, { above, upper.data() } }, values, smallest, signs);
}

} // namespace gimpm
