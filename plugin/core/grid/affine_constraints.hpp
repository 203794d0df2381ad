// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that move as others prescribe: hanging nodes between cells of two sizes, nodes of small cells within large
// ones, and those beside a line that parts a body which it leaves whole.
#pragma once
#include "core/grid/parting.hpp"

namespace gimpm {

/// u = sum of weight times u of masters, which are tied to none. Empty in a grid of equal cells without parting lines.
struct AffineConstraints {
	std::vector<int>    node;          ///< tied nodes, rising
	std::vector<int>    start = { 0 }; ///< start of the masters of each tied node
	std::vector<int>    master;        ///< nodes
	std::vector<double> weight;        ///< > 0, in sum one

	bool empty() const { return node.empty(); }
	bool contains(int n) const { return std::binary_search(node.begin(), node.end(), n); }

	/// Gives the tied nodes the values that follow from their masters.
	template <int Dim> void distribute(Eigen::VectorXd& values) const
	{
		for (std::size_t t = 0; t < node.size(); ++t) {
			Vec<Dim> sum = Vec<Dim>::Zero();
			for (int m = start[t]; m < start[t + 1]; ++m)
				sum += weight[m] * values.template segment<Dim>(Dim * master[m]);
			values.template segment<Dim>(Dim * node[t]) = sum;
		}
	}

	/// The transpose: forces at tied nodes become forces at their masters.
	template <int Dim> void condense(Eigen::VectorXd& forces) const
	{
		for (std::size_t t = 0; t < node.size(); ++t) {
			const Vec<Dim> force = forces.template segment<Dim>(Dim * node[t]);
			for (int m = start[t]; m < start[t + 1]; ++m)
				forces.template segment<Dim>(Dim * master[m]) += weight[m] * force;
			forces.template segment<Dim>(Dim * node[t]).setZero();
		}
	}
};

/// Ties nodes, to which their masters are added; they stay sorted. In a refined grid a node is tied to the corners of
/// the largest leaf that touches it, and these in turn to theirs; a corner of that leaf itself to the node of the
/// leaf's level there, unless it is that node. So the functions of all levels together are continuous, and in a leaf
/// they are linear along each axis. Where lines part the body, masters in layers above 0 that are not nodes of their
/// own are replaced by those of layer 0 in their places.
template <int Dim> AffineConstraints tieNodes(std::vector<Key>& nodes, const Grid<Dim>&);

} // namespace gimpm
