// SPDX-License-Identifier: GPL-2.0-or-later
// The vertices of a surface, on the body that it moves with.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Attachments of places, in their order, and why they cannot all be attached, a clause; empty if they can.
template <int Dim> struct AttachedPlaces {
	std::vector<Attachment<Dim>> places;
	std::string                  obstacle {};
	int                          layer = 0; ///< of the body that they are on; layerOfPlace: of each place
};

/// A cell counts as populated by the least of a domain that reaches into it, so places must be near a domain, too: what
/// acts in a cell whose soil is gone would hang on what is beside it, by round-off or not. Of several bodies it is the
/// one in the layer, or, where none is given, the one that is near all places. `name`: of what has them.
template <int Dim>
AttachedPlaces<Dim> attachPlaces(const std::vector<Vec<Dim>>& places, const StepContext<Dim>&, const std::string& name, int layer = layerOfPlace);

} // namespace gimpm
