// SPDX-License-Identifier: GPL-2.0-or-later
// Thin rigid bodies in the plane as lines that part the soil on their two sides.
#pragma once
#include "core/structures/parting_lines.hpp"
#include "core/terms/contact/rigid_body.hpp"

namespace gimpm {

/// Thin bodies that share ends, one after the other.
struct RigidLine : PartingLine {
	std::vector<int> bodies; ///< numbers, by piece
};

/// Sheets, and the centre lines of blocks thinner than the largest cell along them, as the step begins. Those that
/// share an end are one line; where three and more do, lines go straight on or end.
std::vector<RigidLine> linesOf(const std::vector<RigidBody<2>>&, const Grid<2>&);

} // namespace gimpm
