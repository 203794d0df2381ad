// SPDX-License-Identifier: GPL-2.0-or-later
// Laws with many cases are functions of their own. Compiled into each of the kernels, as the others are, they take the compiler minutes.
#pragma once
#include "core/terms/varying_law.hpp"

namespace gimpm {

/// Whether law L says that it `isLarge`.
template <class L, class = void> inline constexpr bool isLarge                                       = false;
template <class L> inline constexpr bool               isLarge<L, std::void_t<decltype(L::isLarge)>> = L::isLarge;

/// Response of such a law to the trial strains of Lanes::count points, with the values of its variables at the start of the step.
void respondOfLargeLaw(const Law&, const PrincipalValues<Lanes>& trialStrain, const Lanes* internals, LanesOfLaws&);

} // namespace gimpm
