// SPDX-License-Identifier: GPL-2.0-or-later
// The vertices of a surface, on the body that it moves with.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Attachments of positions, in their order, and why they cannot all be attached, a clause; empty if they can.
template <int Dim> struct AttachedPositions {
	std::vector<Attachment<Dim>> positions;
	std::string                  obstacle {};
	int                          layer = 0; ///< body that they are on; layerOfPosition: each position has its own
};

/// A cell counts as populated by the least of a domain that reaches into it, so positions must be near a domain, too:
/// what acts in a cell whose soil is gone would hang on what is beside it, by round-off or not. Of several bodies it is
/// the one in the layer, or, where none is given, the one that is near all positions. `name`: of what has them.
/// `beside`: positions on the same side of lines that part the body as those; empty: they are that themselves.
template <int Dim>
AttachedPositions<Dim> attachPositions(
        const std::vector<Vec<Dim>>& positions, const StepContext<Dim>&, const std::string& name, int layer = layerOfPosition,
        const std::vector<Vec<Dim>>& beside = {});

/// Attachments of the vertices of a surface, each beside the middles of its pieces: the end of one that meets a wall
/// may have got a little behind it.
template <int Dim> AttachedPositions<Dim> attachVertices(const Surface<Dim>&, const StepContext<Dim>&, const std::string& name, int layer = layerOfPosition);

} // namespace gimpm
