// SPDX-License-Identifier: GPL-2.0-or-later
// Matrix over the active grid nodes, addressed by node and by the offset to the neighbour.
#pragma once
#include "core/grid/grid.hpp"
#include <array>
#include <utility>
#include <vector>

namespace gimpm {

/// Blocks of Dim x Dim for a node a and the nodes b >= a (in key order) at most two cells away along each axis: GIMP
/// functions and ghost faces reach no further. Block (a, b) is K_ab row by row. In a periodic grid the order is that
/// before nodes are taken as the same, so that b may have the lower number, and on a small one two blocks may belong to
/// the same nodes, and add up. In a grid of several cell sizes there are blocks between nodes of the same level. Of a
/// matrix that is not symmetric, what K_ba^T differs from K_ab by is stored beside: who adds something symmetric need
/// not know of it.
template <int Dim> class NodeMatrix {
public:
	static constexpr int width = 5;                             ///< offsets -2 ... 2 per axis
	static constexpr int codes = (Dim == 2 ? 25 : 125) / 2 + 1; ///< offsets to nodes b >= a
	static constexpr int block = Dim * Dim;

	/// Code of the offset b - a, negative if that points to a lower node; a block is stored with the lower one.
	template <class Offset> static constexpr int code(const Offset& o) { return Dim == 2 ? o[0] + 5 * o[1] : o[0] + 5 * o[1] + 25 * o[2]; }

	/// A range of nodes, as first one and end.
	using Range = std::pair<int, int>;

	/// Sets up a zero matrix for these nodes (sorted). Of one that several processes share only the rows and
	/// columns of the nodes `own` are wanted.
	void reset(const std::vector<Key>& nodes, bool isSymmetric = true, const Grid<Dim>& = {});
	void reset(const std::vector<Key>& nodes, bool isSymmetric, const Grid<Dim>&, const Range& own);
	void setZero();
	void multiplyBy(double factor);

	/// Number of each node's neighbour at each offset to nodes b >= a; -1: there is none.
	static std::vector<int> neighboursOf(const std::vector<Key>& nodes, const Grid<Dim>&);

	/// True if there are blocks of this node, which rows or columns that are wanted may need. Others are neither
	/// read nor written.
	bool keeps(int node) const { return unsigned(node) - unsigned(kept_.first) < unsigned(kept_.second - kept_.first); }

	double*                 at(int node, int code) { return values_.data() + offset(node, code); }
	const double*           at(int node, int code) const { return values_.data() + offset(node, code); }
	void                    markUsed(int node, int code) { used_[node] |= std::uint64_t(1) << code; }
	bool                    used(int node, int code) const { return used_[node] >> code & 1; }
	int                     neighbour(int node, int code) const { return neighbour_[std::size_t(node) * codes + code]; }
	int                     nodes() const { return int(keys_.size()); }
	const std::vector<Key>& keys() const { return keys_; }
	bool                    isSymmetric() const { return isSymmetric_; }
	bool                    isPeriodic() const { return isPeriodic_; }

	/// Block K_ba^T - K_ab, stored like K_ab; only of a matrix that is not symmetric.
	double*       skewAt(int node, int code) { return skew_.data() + offset(node, code); }
	const double* skewAt(int node, int code) const { return skew_.data() + offset(node, code); }

	/// Adds to K_ab, not to K_ba, of two nodes in any order; `code` is that of the offset b - a, negative where b
	/// is the lower one. A symmetric matrix keeps only what is for the lower node's row. Of nodes without blocks
	/// nothing is added.
	void add(int a, int b, int code, const Mat<Dim>& ab);

	/// y += K x, for nodal vectors of Dim components a node; right in the rows that are wanted.
	void multiplyAdd(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

private:
	using RowMajor = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;

	std::size_t offset(int node, int code) const { return (std::size_t(node - kept_.first) * codes + code) * block; }

	std::vector<Key>           keys_;
	Range                      kept_ { 0, 0 };
	std::vector<double>        values_, skew_; // values of the nodes that are kept
	bool                       isSymmetric_ = true, isPeriodic_ = false;
	std::vector<std::uint64_t> used_;
	std::vector<int>           neighbour_; // number of the node at each offset; -1: not active
};

} // namespace gimpm
