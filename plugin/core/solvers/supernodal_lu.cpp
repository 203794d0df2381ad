// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/supernodal_lu.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <limits>

// BLAS and LAPACK
extern "C" {
void dgemm_(
        const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*, const double*, const int*, const double*,
        double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*, const int*, double*, const int*);
void dgetrf_(const int*, const int*, double*, const int*, int*, int*);
}

namespace gimpm {
namespace {

/// C = A B^T, of m x k and n x k.
void multiply(int m, int n, int k, const double* A, int rowsOfA, const double* B, int rowsOfB, double* C)
{
	const double one = 1, zero = 0;
	dgemm_("N", "T", &m, &n, &k, &one, A, &rowsOfA, B, &rowsOfB, &zero, C, &m);
}

/// A = A T^-1, of m x n, with a triangle T: lower or upper, transposed or not, with a diagonal of ones or not.
void divide(const char* triangle, const char* transposed, const char* ones, int m, int n, const double* T, int rowsOfT, double* A, int rowsOfA)
{
	const double one = 1;
	if (m > 0) dtrsm_("R", triangle, transposed, ones, &m, &n, &one, T, &rowsOfT, A, &rowsOfA);
}

} // namespace

void SupernodalLu::analyse(const Csc& K, const cholmod_factor& pattern)
{
	forget();
	if (!pattern.is_super) return;
	layOut(pattern);
	if (value_.size() > std::numeric_limits<std::uint32_t>::max() || !place(K)) forget();
}

void SupernodalLu::layOut(const cholmod_factor& pattern)
{
	const auto *first = static_cast<const int*>(pattern.super), *start = static_cast<const int*>(pattern.pi), *row = static_cast<const int*>(pattern.s);
	const auto* order = static_cast<const int*>(pattern.Perm);
	order_.assign(order, order + pattern.n);
	rows_.assign(row, row + pattern.ssize);
	blockOf_.resize(pattern.n);
	exchanged_.resize(pattern.n);
	std::size_t size = 0;
	for (int b = 0; b < int(pattern.nsuper); ++b) {
		Block block { first[b], first[b + 1] - first[b], start[b + 1] - start[b], rows_.data() + start[b], size, 0 };
		block.upper = block.lower + std::size_t(block.rows) * block.columns;
		size        = block.upper + std::size_t(block.beside()) * block.columns;
		std::fill(blockOf_.begin() + block.first, blockOf_.begin() + block.last(), b);
		blocks_.push_back(block);
	}
	value_.resize(size);
}

/// Finds the places of K's entries. False if its pattern is not symmetric.
bool SupernodalLu::place(const Csc& K)
{
	std::vector<int> next(K.start.begin(), K.start.end() - 1), opposite(K.row.size()), number(K.size()), local(K.size());
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) { // rows rise with the columns: those of column K.row[e] are met in their order
			const int at = next[K.row[e]]++;
			if (at >= K.start[K.row[e] + 1] || K.row[at] != c) return false;
			opposite[e] = at;
		}
	for (int i = 0; i < K.size(); ++i)
		number[order_[i]] = i;
	place_.resize(K.row.size());
	for (const Block& b : blocks_) {
		for (int i = 0; i < b.rows; ++i)
			local[b.row[i]] = i;
		for (int j = 0; j < b.columns; ++j) {
			const int c = order_[b.first + j];
			for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
				const int i = number[K.row[e]];
				if (i >= b.first) place_[e] = std::uint32_t(b.lower + std::size_t(j) * b.rows + local[i]);
				if (i >= b.last()) place_[opposite[e]] = std::uint32_t(b.upper + std::size_t(j) * b.beside() + local[i] - b.columns);
			}
		}
	}
	return true;
}

bool SupernodalLu::factorise(const Csc& K, double smallestPivot)
{
	if (!isAnalysed()) return false;
	std::fill(value_.begin(), value_.end(), 0.);
	for (std::size_t e = 0; e < place_.size(); ++e)
		value_[place_[e]] = K.value[e];
	largestPivot_  = 0;
	smallestPivot_ = std::numeric_limits<double>::infinity();
	for (const Block& block : blocks_) {
		if (!factoriseDiagonal(block, smallestPivot)) return false;
		update(block);
	}
	return isExact(K);
}

bool SupernodalLu::factoriseDiagonal(const Block& b, double smallestPivot)
{
	double *  lower = value_.data() + b.lower, *upper = value_.data() + b.upper;
	const int beside = b.beside();
	int       zero   = 0;
	dgetrf_(&b.columns, &b.columns, lower, &b.rows, exchanged_.data() + b.first, &zero);
	for (int j = 0; j < b.columns; ++j) {
		const double pivot = std::abs(lower[j * (std::size_t(b.rows) + 1)]);
		largestPivot_      = std::max(largestPivot_, pivot);
		smallestPivot_     = std::min(smallestPivot_, pivot);
		double *row = upper + std::size_t(j) * beside, *with = upper + std::size_t(exchanged_[b.first + j] - 1) * beside;
		if (with != row) std::swap_ranges(row, row + beside, with);
	}
	if (zero || !(smallestPivot_ > smallestPivot * largestPivot_)) return false;
	divide("U", "N", "N", beside, b.columns, lower, b.rows, lower + b.columns, b.rows);
	divide("L", "T", "U", beside, b.columns, lower, b.rows, upper, beside);
	return true;
}

/// Subtracts L U of a block from the blocks that follow: from those whose columns are among its rows.
void SupernodalLu::update(const Block& b)
{
	const double *   L = value_.data() + b.lower, *U = value_.data() + b.upper - b.columns; // both by the row of L
	std::vector<int> local(b.rows);
	for (int begin = b.columns, end; begin < b.rows; begin = end) {
		const Block& to = blocks_[blockOf_[b.row[begin]]];
		end             = int(std::lower_bound(b.row + begin, b.row + b.rows, to.last()) - b.row);
		for (int i = begin, r = 0; i < b.rows; ++i) {
			while (to.row[r] != b.row[i])
				++r;
			local[i] = r;
		}
		const int  width    = end - begin;
		const auto subtract = [&](const double* A, int rowsOfA, const double* B, int rowsOfB, int from, double* values, int stride) {
			const int rows = b.rows - from;
			if (rows == 0) return;
			product_.resize(std::size_t(rows) * width);
			multiply(rows, width, b.columns, A + from, rowsOfA, B + begin, rowsOfB, product_.data());
			const double* p = product_.data();
			for (int j = begin; j < end; ++j) {
				double* column = values + std::size_t(local[j]) * stride;
				for (int i = from; i < b.rows; ++i)
					column[local[i]] -= *p++;
			}
		};
		subtract(L, b.rows, U, b.beside(), begin, value_.data() + to.lower, to.rows);
		subtract(U, b.beside(), L, b.rows, end, value_.data() + to.upper - to.columns, to.beside());
	}
}

/// With L or, transposed, with U.
void SupernodalLu::forward(const Block& b, Eigen::VectorXd& x, bool transposed) const
{
	auto own = x.segment(b.first, b.columns);
	if (transposed) diagonal(b).transpose().triangularView<Eigen::Lower>().solveInPlace(own);
	else {
		for (int j = 0; j < b.columns; ++j)
			std::swap(own[j], own[exchanged_[b.first + j] - 1]);
		diagonal(b).triangularView<Eigen::UnitLower>().solveInPlace(own);
	}
	const Eigen::VectorXd below = (transposed ? ofU(b) : ofL(b)) * own;
	for (int i = 0; i < b.beside(); ++i)
		x[b.row[b.columns + i]] -= below[i];
}

/// With U or, transposed, with L.
void SupernodalLu::backward(const Block& b, Eigen::VectorXd& x, bool transposed) const
{
	auto own = x.segment(b.first, b.columns);
	own -= (transposed ? ofL(b) : ofU(b)).transpose() * Eigen::VectorXd::NullaryExpr(b.beside(), [&](Eigen::Index i) { return x[b.row[b.columns + i]]; });
	if (!transposed) diagonal(b).triangularView<Eigen::Upper>().solveInPlace(own);
	else {
		diagonal(b).transpose().triangularView<Eigen::UnitUpper>().solveInPlace(own);
		for (int j = b.columns - 1; j >= 0; --j)
			std::swap(own[j], own[exchanged_[b.first + j] - 1]);
	}
}

bool SupernodalLu::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const
{
	Eigen::VectorXd ordered = b(order_);
	for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
		forward(*block, ordered, transposed);
	for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
		backward(*block, ordered, transposed);
	x.resize(b.size());
	x(order_) = ordered;
	return x.allFinite();
}

/// Whether a solution leaves a residual of round-off only: if pivots were too small for what is beside them, it is larger.
bool SupernodalLu::isExact(const Csc& K) const
{
	constexpr double roundOff = 1e-13;
	Eigen::VectorXd  ones = Eigen::VectorXd::Ones(K.size()), sizes = ones, residual = ones, x;
	if (!solve(ones, x, false)) return false;
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
			residual[K.row[e]] -= K.value[e] * x[c];
			sizes[K.row[e]] += std::abs(K.value[e] * x[c]);
		}
	return (residual.array().abs() <= roundOff * sizes.array()).all();
}

} // namespace gimpm
