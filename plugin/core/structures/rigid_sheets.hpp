// SPDX-License-Identifier: GPL-2.0-or-later
// Thin rigid bodies in space as surfaces that part the soil on their two sides.
#pragma once
#include "core/structures/parting_sheets.hpp"
#include "core/terms/contact/rigid_body.hpp"

namespace gimpm {

/// Thin bodies that share edges.
struct RigidSheet : PartingSheet {
	std::vector<int> bodies; ///< numbers, by facet
};

/// Facets, and the middle faces of blocks thinner than the largest cell there, as the step begins. Those that share an
/// edge are one surface; where three and more do, surfaces go straight on or end. Bodies that deform, and surfaces with
/// one side only, are left out.
std::vector<RigidSheet> sheetsOf(const std::vector<RigidBody<3>>&, const Grid<3>&);

} // namespace gimpm
