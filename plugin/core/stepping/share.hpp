// SPDX-License-Identifier: GPL-2.0-or-later
// The part of a load step that is done by one of several processes.
#pragma once
#include "core/grid/division.hpp"
#include "core/solvers/node_share.hpp"
#include "core/terms/ghost.hpp"
#include "core/terms/internal_force.hpp"

namespace gimpm {

/// Each process has a range of the nodes, a slab of the grid, and adds up what the points and ghost faces that touch it contribute: its rows of the forces and the
/// stiffness are complete, without a word from the others, and the points at the borders are looked at twice. The other terms are added up by every process for all
/// nodes: they take little, and some of them need to be whole. Where points are divided among processes, they are not, and what the points add elsewhere is completed.
template <int Dim> class Share {
public:
	/// The processes are kept by reference, and so is the division of the points, if there is one.
	Share(const Processes&, const CloudBasis<Dim>&, const std::vector<GhostFace<Dim>>&, const Division* = nullptr);

	const NodeShare&                   nodes() const { return nodes_; }
	const Colours<Dim>&                colours() const { return colours_; } ///< patches that touch them
	const std::vector<GhostFace<Dim>>& faces() const { return faces_; }

	/// That of the point with the smallest number, or id where points are divided, wherever it is.
	std::optional<PointFailure> firstOf(const std::optional<PointFailure>&) const;

private:
	const Division*             division_;
	NodeShare                   nodes_;
	Colours<Dim>                colours_;
	std::vector<GhostFace<Dim>> faces_;
};

/// Whether all processes hold the same points, to the last bit.
template <int Dim> bool haveSamePoints(const Processes&, const PointCloud<Dim>&);

} // namespace gimpm
