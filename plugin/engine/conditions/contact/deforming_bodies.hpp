// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies that deform with others, which are nodes at their corners: YADE's GridConnection, PFacet and ChainedCylinder.
#include "core/grid/grid.hpp"
#include "core/terms/contact/rigid_body.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// A node, and where it is at the begin and the end of a step.
struct NodePose {
	const Body* body;
	Se3r        begin, end;
};

// Its nodes; none if it is rigid. std::invalid_argument where one is missing. The last cylinder of a chain, which ends
// at
// no other, has none.
vector<shared_ptr<Body>> nodesOf(const Body&, const Scene&);

// True if soil does not touch it, but the bodies beside it: a GridNode, or the last cylinder of a chain.
bool isPartOfNet(const Body&, const Scene&);

// True if others may deform with it.
bool isNodeOfNet(const Body&);

// Takes those out of a list that are the sides of PFacets in it.
void dropSidesOfMembranes(vector<shared_ptr<Body>>&);

// Body of the core; std::invalid_argument where it cannot touch. Its friction and the owners of its nodes are left
// open.
template <int Dim> gimpm::RigidBody<Dim> deformingBody(const Body&, const gimpm::Grid<Dim>&, const vector<NodePose>&);

// Puts it between its nodes.
template <int Dim> void deform(gimpm::RigidBody<Dim>&, const vector<NodePose>&);

} // namespace yade
