// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/signed_factor.hpp"
#include "core/base/instruction_set.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

// Of the BLAS.
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
	double*    values;

	explicit Supernodes(const cholmod_factor& L)
	        : count(int(L.nsuper))
	        , columns(static_cast<const int*>(L.super))
	        , rowsBegin(static_cast<const int*>(L.pi))
	        , valuesBegin(static_cast<const int*>(L.px))
	        , rows(static_cast<const int*>(L.s))
	        , values(static_cast<double*>(L.x))
	{
	}
	int        width(int s) const { return columns[s + 1] - columns[s]; }
	int        height(int s) const { return rowsBegin[s + 1] - rowsBegin[s]; }
	const int* rowsOf(int s) const { return rows + rowsBegin[s]; }
	double*    valuesOf(int s) const { return values + valuesBegin[s]; }

	std::vector<int> ofColumns() const
	{
		std::vector<int> of(columns[count]);
		for (int s = 0; s < count; ++s)
			std::fill(of.begin() + columns[s], of.begin() + columns[s + 1], s);
		return of;
	}
};

class Factorisation {
public:
	Factorisation(const Supernodes& L, Eigen::VectorXd& signs)
	        : L_(L), signs_(signs), supernode_(L.ofColumns()), first_(L.count, -1), next_(L.count, -1), taken_(L.count, 0), place_(supernode_.size())
	{
	}

	bool run(double smallest)
	{
		for (int s = 0; s < L_.count; ++s) {
			for (int i = 0; i < L_.height(s); ++i)
				place_[L_.rowsOf(s)[i]] = i;
			for (int d = first_[s], after; d >= 0; d = after) {
				after = next_[d];
				takeAway(d, s);
			}
			for (int begin = 0; begin < L_.width(s); begin += atOnce)
				eliminate(s, begin, std::min(begin + atOnce, L_.width(s)));
			taken_[s] = L_.width(s);
			passOn(s);
		}
		return least_ > smallest * largest_; // not with NaN
	}

private:
	static constexpr int atOnce = 24, ofUpdate = 64; ///< columns

	/// S L^T of some rows and columns, as rows.
	const double* withSigns(const double* block, int stride, int rows, int columns, const double* signs)
	{
		right_.resize(std::max(right_.size(), std::size_t(rows) * columns));
		double* out = right_.data();
		for (int c = 0; c < columns; ++c, block += stride)
			for (int i = 0; i < rows; ++i)
				*out++ = signs[c] * block[i];
		return right_.data();
	}

	/// What an earlier supernode d has in the columns of s, of which a few are done at once: what is above the
	/// diagonal is not needed.
	void takeAway(int d, int s)
	{
		const int   height = L_.height(d), width = L_.width(d), begin = taken_[d];
		const int*  rows  = L_.rowsOf(d) + begin;
		const auto* end   = std::lower_bound(rows, L_.rowsOf(d) + height, L_.columns[s + 1]);
		const int   below = height - begin, within = int(end - rows);
		double*     block = L_.valuesOf(d) + begin;
		update_.resize(std::max(update_.size(), std::size_t(below) * std::min(within, ofUpdate)));
		into_.resize(below);
		std::transform(rows, rows + below, into_.begin(), [this](int row) { return place_[row]; });
		const double* right = withSigns(block, height, within, width, signs_.data() + L_.columns[d]);
		const double  one = 1, none = 0;
		for (int first = 0; first < within; first += ofUpdate) {
			const int count = std::min(ofUpdate, within - first), left = below - first;
			dgemm_("N", "T", &left, &count, &width, &one, block + first, &height, right + first, &within, &none, update_.data(), &left);
			subtract(first, count, left, s);
		}
		taken_[d] += within;
		passOn(d);
	}
	void subtract(int first, int count, int left, int s)
	{
		const int* into = into_.data() + first;
		runs_.clear(); // of rows that follow each other there, too
		for (int i = 0; i < left; ++i)
			if (i == 0 || into[i] != into[i - 1] + 1) runs_.push_back(i);
		runs_.push_back(left);
		for (int j = 0; j < count; ++j) {
			double*       column = L_.valuesOf(s) + std::ptrdiff_t(into[j]) * L_.height(s);
			const double* values = update_.data() + std::ptrdiff_t(j) * left;
			for (std::size_t run = 0; run + 1 < runs_.size(); ++run) {
				const int begin = std::max(runs_[run], j), end = runs_[run + 1];
				double*   to = column + into[runs_[run]] - runs_[run];
				for (int i = begin; i < end; ++i)
					to[i] -= values[i];
			}
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

	/// Columns [begin, end) of a supernode; what they take away from its later ones.
	void eliminate(int s, int begin, int end)
	{
		const int height = L_.height(s), count = end - begin, below = height - end, later = L_.width(s) - end;
		double *  block = L_.valuesOf(s) + begin + std::ptrdiff_t(begin) * height, *signs = signs_.data() + L_.columns[s] + begin;
		factoriseDense(block, height, count, signs);
		if (below == 0) return;
		const double one = 1, less = -1;
		dtrsm_("R", "L", "T", "N", &below, &count, &one, block, &height, block + count, &height);
		for (int c = 0; c < count; ++c)
			if (signs[c] < 0)
				for (double *x = block + count + std::ptrdiff_t(c) * height, *last = x + below; x < last; ++x)
					*x = -*x;
		if (later == 0) return;
		const double* right = withSigns(block + count, height, later, count, signs);
		for (int first = 0; first < later; first += ofUpdate) {
			const int columns = std::min(ofUpdate, later - first), left = below - first;
			double*   of = block + count + first; // the first of these rows in the first column of the block
			dgemm_("N", "T", &left, &columns, &count, &less, of, &height, right + first, &later, &one, of + std::ptrdiff_t(count + first) * height,
			       &height);
		}
	}
	void factoriseDense(double* block, int stride, int count, double* signs)
	{
		for (int k = 0; k < count; ++k) {
			double* column = block + std::ptrdiff_t(k) * stride;
			for (int j = 0; j < k; ++j) {
				const double *before = block + std::ptrdiff_t(j) * stride, part = signs[j] * before[k];
				for (int i = k; i < count; ++i)
					column[i] -= part * before[i];
			}
			const double pivot = std::abs(column[k]), root = std::sqrt(pivot);
			signs[k]  = column[k] < 0 ? -1 : 1;
			least_    = pivot < least_ || std::isnan(pivot) ? pivot : least_;
			largest_  = std::max(largest_, pivot);
			column[k] = root;
			for (int i = k + 1; i < count; ++i)
				column[i] *= signs[k] / root;
		}
	}

	const Supernodes&   L_;
	Eigen::VectorXd&    signs_;
	std::vector<int>    supernode_;    // of each column
	std::vector<int>    first_, next_; // lists: of each supernode the earlier ones that have rows there
	std::vector<int>    taken_;        // rows of each supernode that are done
	std::vector<int>    place_;        // of each row in the supernode at hand
	std::vector<int>    runs_;
	std::vector<int>    into_;           // of each row of an update, its place there
	std::vector<double> update_, right_; // reused
	double              least_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

} // namespace

std::vector<std::ptrdiff_t> placesIn(const cholmod_factor& factor, const Csc& K)
{
	const Supernodes L(factor);
	const int *      order = static_cast<const int*>(factor.Perm), n = K.size();
	std::vector<int> number(n), place(n);
	for (int i = 0; i < n; ++i)
		number[order[i]] = i;
	const auto       supernode = L.ofColumns();
	std::vector<int> start(L.count + 1, 0); // of the entries of each supernode
	const auto       forEntries = [&](auto&& f) {
                for (int c = 0; c < n; ++c)
                        for (int e = K.start[c]; e < K.start[c + 1] && K.row[e] <= c; ++e)
                                f(e, std::min(number[K.row[e]], number[c]), std::max(number[K.row[e]], number[c]));
	};
	forEntries([&](int, int column, int) { ++start[supernode[column] + 1]; });
	std::partial_sum(start.begin(), start.end(), start.begin());
	struct Entry {
		int e, column, row;
	};
	std::vector<Entry> sorted(start.back());
	std::vector<int>   next(start.begin(), start.end() - 1);
	forEntries([&](int e, int column, int row) { sorted[next[supernode[column]]++] = { e, column, row }; });
	std::vector<std::ptrdiff_t> places(K.row.size(), -1);
	for (int s = 0; s < L.count; ++s) {
		for (int i = 0; i < L.height(s); ++i)
			place[L.rowsOf(s)[i]] = i;
		for (int i = start[s]; i < start[s + 1]; ++i)
			places[sorted[i].e] = L.valuesBegin[s] + std::ptrdiff_t(sorted[i].column - L.columns[s]) * L.height(s) + place[sorted[i].row];
	}
	return places;
}

bool factoriseSigned(
        cholmod_factor& factor, const std::vector<std::ptrdiff_t>& places, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs)
{
	const Supernodes L(factor);
	std::fill(L.values, L.values + factor.xsize, 0.);
	for (std::size_t e = 0; e < places.size(); ++e)
		if (places[e] >= 0) L.values[places[e]] += values[e];
	signs.resize(Eigen::Index(factor.n));
	bool hasDone = false;
	callForProcessor([&] { hasDone = Factorisation(L, signs).run(smallest); });
	return hasDone;
}

} // namespace gimpm
