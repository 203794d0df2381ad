// SPDX-License-Identifier: GPL-2.0-or-later
// Contact in a study that leaves the points in their places.
#pragma once
#include "core/terms/contact.hpp"

namespace gimpm {

/// The gaps that carry are those of a penalty: where moduli become larger, they become `scale` of what they were, and
/// press as before. Gaps that are open stay as they are.
template <int Dim> void shrinkGaps(ContactSystem<Dim>&, const PointCloud<Dim>&, double scale);

/// The points are back where they were, and the gaps stay those of the last step.
template <int Dim> void keepGaps(ContactSystem<Dim>&, const PointCloud<Dim>&);

} // namespace gimpm
