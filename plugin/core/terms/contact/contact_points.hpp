// SPDX-License-Identifier: GPL-2.0-or-later
// Search of the contact points of a step.
#pragma once
#include "core/terms/contact/contact_system.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Depth to which soil may get into a body in a step, over the cell size; deeper it has not been stopped.
constexpr double deepestInBody = 0.1;

template <int Dim> struct FoundContact {
	std::vector<ContactPoint<Dim>> points; ///< sorted by body
	/// Attachments of contact points that touched and have no soil in front of them any more, as where it leaps
	/// off, with the numbers of their records: in a time step their forces have to be known to begin with, or the
	/// soil keeps half of them for another step, and what a body has got is not what the soil has lost.
	std::vector<std::pair<Attachment<Dim>, std::size_t>> lost;
	std::string                                          obstacle; ///< why the step cannot be made, a clause; empty if it can
};

/// Finds the soil in front of all bodies, and recalls what pressed at the end of the last step. Writes the sides of
/// two-sided bodies that soil is on.
template <int Dim> FoundContact<Dim> findContactPoints(ContactSystem<Dim>&, const StepContext<Dim>&);

} // namespace gimpm
