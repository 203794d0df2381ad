// SPDX-License-Identifier: GPL-2.0-or-later
// Points whose laws have parameters of their own. The constants of such laws differ from lane to lane, so that each
// answers for itself.
#pragma once
#include "core/materials/law.hpp"

namespace gimpm {

/// Response of any law: the variables are those of the law, and then any numbers.
using LanesOfLaws = ResponseWith<Lanes, LawTraits<PrincipalLaws>::mostVariables>;

/// Response of Lanes::count points, of which those that are of another material may get any numbers.
void respondOneByOne(
        const Material&, const ParameterColumns&, const InternalColumns&, const int* point, const PrincipalValues<Lanes>& trialStrain, LanesOfLaws&);

} // namespace gimpm
