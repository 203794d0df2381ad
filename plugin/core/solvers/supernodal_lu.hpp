// SPDX-License-Identifier: GPL-2.0-or-later
// LU factorisation of a matrix with a symmetric pattern, by dense blocks.
#pragma once
#include "core/solvers/csc.hpp"
#include <cholmod.h>
#include <cstdint>

namespace gimpm {

/// The factors have the pattern of a supernodal Cholesky factor and of its transpose: twice its memory and operations, at its speed (seconds of
/// Cholesky's method, this and UMFPACK: 2D, 33,700 unknowns, 0.15, 0.26 and 0.50; 3D, 28,200, 1.3, 2.7 and 4.5). Rows are exchanged only within
/// supernodes, the columns that have the same rows below them. Where that does not suffice, Lu does.
class SupernodalLu {
public:
	SupernodalLu()                          = default;
	SupernodalLu(SupernodalLu&&)            = default;
	SupernodalLu& operator=(SupernodalLu&&) = default;

	/// Lays out the factors of a pattern that CHOLMOD has analysed. Not for one that is not symmetric, nor for 4e9 numbers.
	void analyse(const Csc& K, const cholmod_factor& pattern);
	bool isAnalysed() const { return !blocks_.empty(); }
	void forget() { *this = SupernodalLu(); }

	/// False if a pivot is below `smallestPivot` of the largest, or if round-off has grown in the factors.
	bool factorise(const Csc& K, double smallestPivot);

	/// K x = b or, transposed, K^T x = b, with the factors of the last factorise().
	bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const;

private:
	/// Columns of L with their rows, from the diagonal block downwards, and the rows of U right of that block, stored as columns.
	struct Block {
		int         first, columns, rows;
		const int*  row;          ///< of the columns of L
		std::size_t lower, upper; ///< places of the values

		int beside() const { return rows - columns; }
		int last() const { return first + columns; }
	};
	using Values = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
	Values diagonal(const Block& b) const { return { value_.data() + b.lower, b.columns, b.columns, Eigen::OuterStride<>(b.rows) }; }
	Values ofL(const Block& b) const { return { value_.data() + b.lower + b.columns, b.beside(), b.columns, Eigen::OuterStride<>(b.rows) }; }
	Values ofU(const Block& b) const { return { value_.data() + b.upper, b.beside(), b.columns, Eigen::OuterStride<>(b.beside()) }; }

	void layOut(const cholmod_factor& pattern);
	bool place(const Csc& K);
	bool factoriseDiagonal(const Block&, double smallestPivot);
	void update(const Block&);
	void forward(const Block&, Eigen::VectorXd& x, bool transposed) const;
	void backward(const Block&, Eigen::VectorXd& x, bool transposed) const;
	bool isExact(const Csc& K) const;

	std::vector<Block>         blocks_;
	std::vector<int>           rows_, order_, blockOf_; // order_: the number in K of each row and column
	std::vector<int>           exchanged_;              // with which row of its block each row was, in turn, counted from 1
	std::vector<std::uint32_t> place_;                  // of each entry of K among the values
	std::vector<double>        value_, product_;
	double                     largestPivot_ = 0, smallestPivot_ = 0;
};

} // namespace gimpm
