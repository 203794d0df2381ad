// SPDX-License-Identifier: GPL-2.0-or-later
// The part of a load step that is done by one of several processes.
#pragma once
#include "core/grid/neighbourhood.hpp"
#include "core/stepping/model.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

/// Each process has a range of the nodes, a slab of the grid, and adds up what the points and ghost faces that touch it
/// contribute: its rows of the forces and the stiffness are complete, without a word from the others, and the points at
/// the borders are looked at twice. The other terms are added up by every process for all nodes: they take little, and
/// some of them need to be whole. Where points are divided among processes, they are not, and what the points add
/// elsewhere is completed.
template <int Dim> class OwnedParts {
public:
	/// All are kept by reference. One process that is alone has all there is.
	OwnedParts(const Processes&, const CloudBasis<Dim>&, const std::vector<GhostFace<Dim>>&, const Division&);
	OwnedParts(const OwnedParts&) = delete;

	const OwnedNodes& nodes() const { return nodes_; }
	/// Around which this process has all points.
	const OwnedNodes& knownNodes() const { return known_; }
	/// Patches that touch the nodes.
	const Colours<Dim>&                colours() const { return nodes_.isWhole() ? basis_.colours : colours_; }
	const std::vector<GhostFace<Dim>>& faces() const { return nodes_.isWhole() ? allFaces_ : faces_; }

	/// Failure of the point with the smallest number, or id where points are divided, wherever it is.
	std::optional<PointFailure> firstOf(const std::optional<PointFailure>&) const;

private:
	static std::vector<int> startsAmong(const Processes&, const CloudBasis<Dim>&, const Division&);

	const CloudBasis<Dim>&             basis_;
	const std::vector<GhostFace<Dim>>& allFaces_;
	const Division&                    division_;
	const OwnedNodes                   nodes_, known_;
	Colours<Dim>                       colours_;
	std::vector<GhostFace<Dim>>        faces_;
};

/// Those that others need to make the step with.
template <int Dim> std::vector<std::vector<int>> pointsForOthers(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	return neededPoints(cloud, *model.division, model.grid, model.basis, model.fBar || model.ghost.factor != 0);
}

/// True if all processes hold the same points, to the last bit.
template <int Dim> bool haveSamePoints(const Processes&, const PointCloud<Dim>&);

} // namespace gimpm
