// SPDX-License-Identifier: GPL-2.0-or-later
// The laws' answers, several points at once. They are compiled once for each kind of processor: into each of the kernels they would take the compiler
// minutes.
#pragma once
#include "core/terms/varying_law.hpp"

namespace gimpm {

/// Response of Lanes::count points to their trial strains, with the values of the variables at the start of the step; of those that are of another
/// material any numbers.
void respondTogether(
        const Material&, const ParameterColumns&, const InternalColumns&, const int* point, const PrincipalValues<Lanes>& trialStrain, LanesOfLaws&);

} // namespace gimpm
