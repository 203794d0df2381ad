// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_matrix.hpp"
#include <algorithm>

namespace gimpm {

namespace {
/// Difference between the key of the node at this offset and a node's own key.
template <int Dim> Key keyOffset(int code)
{
	constexpr int centre = (Dim == 2 ? 25 : 125) / 2;
	int           rest   = code + centre;
	Key           k      = 0;
	for (int a = 0; a < Dim; ++a, rest /= 5)
		k += Key(std::int64_t(rest % 5 - 2)) * Grid<Dim>::keyStep(a);
	return k;
}
}

template <int Dim> void NodeMatrix<Dim>::reset(const std::vector<Key>& nodes, bool isSymmetric, const Grid<Dim>& grid)
{
	reset(nodes, isSymmetric, grid, { 0, int(nodes.size()) });
}

template <int Dim> void NodeMatrix<Dim>::reset(const std::vector<Key>& nodes, bool isSymmetric, const Grid<Dim>& grid, const Range& own)
{
	keys_        = nodes;
	isSymmetric_ = isSymmetric;
	isPeriodic_  = grid.isPeriodic();
	kept_        = own;
	if (isPeriodic_) kept_ = { 0, this->nodes() }; // blocks around the grid may be with any node
	else if (own.first < own.second)               // a block is with the lower one of its nodes
		kept_.first = position(nodes, nodes[own.first] - keyOffset<Dim>(codes - 1));
	values_.assign(std::size_t(kept_.second - kept_.first) * codes * block, 0.);
	skew_.assign(isSymmetric ? 0 : values_.size(), 0.);
	used_.assign(nodes.size(), 0);
	neighbour_ = neighboursOf(nodes, grid);
}

template <int Dim> std::vector<int> NodeMatrix<Dim>::neighboursOf(const std::vector<Key>& nodes, const Grid<Dim>& grid)
{
	std::vector<int> neighbour(nodes.size() * codes, -1);
	for (int c = 0; c < codes; ++c) {
		const Key   offset = keyOffset<Dim>(c);
		std::size_t b      = 0; // keys rise together with those of the neighbours: one sweep for each offset
		for (std::size_t a = 0; a < nodes.size(); ++a) {
			const Key there = nodes[a] + (offset << Grid<Dim>::level(nodes[a]));
			while (b < nodes.size() && nodes[b] < there)
				++b;
			if (b < nodes.size() && nodes[b] == there) neighbour[a * codes + c] = int(b);
			else if (grid.isPeriodic())
				neighbour[a * codes + c] = find(nodes, grid.first(there));
		}
	}
	return neighbour;
}

template <int Dim> void NodeMatrix<Dim>::setZero()
{
	std::fill(values_.begin(), values_.end(), 0.);
	std::fill(skew_.begin(), skew_.end(), 0.);
}

template <int Dim> void NodeMatrix<Dim>::multiplyBy(double factor)
{
	for (auto* numbers : { &values_, &skew_ })
		for (double& x : *numbers)
			x *= factor;
}

template <int Dim> void NodeMatrix<Dim>::add(int a, int b, int code, const Mat<Dim>& ab)
{
	if (!keeps(code >= 0 ? a : b)) return;
	if (code >= 0) Eigen::Map<RowMajor>(at(a, code)) += ab;
	if (code == 0 || isSymmetric_) return;
	if (code > 0) Eigen::Map<RowMajor>(skewAt(a, code)) -= ab;
	else
		Eigen::Map<RowMajor>(skewAt(b, -code)) += ab.transpose();
}

template <int Dim> void NodeMatrix<Dim>::multiplyAdd(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	using Block = Eigen::Map<const RowMajor>;
	for (int a = kept_.first; a < kept_.second; ++a)
		for (int c = 0; c < codes; ++c) {
			if (!used(a, c)) continue;
			const Block K(at(a, c));
			const int   b = neighbour(a, c);
			y.segment<Dim>(Dim * a) += K * x.segment<Dim>(Dim * b);
			if (b == a) continue;
			y.segment<Dim>(Dim * b) += K.transpose() * x.segment<Dim>(Dim * a);
			if (!isSymmetric_) y.segment<Dim>(Dim * b) += Block(skewAt(a, c)).transpose() * x.segment<Dim>(Dim * a);
		}
}

template class NodeMatrix<2>;
template class NodeMatrix<3>;

} // namespace gimpm
