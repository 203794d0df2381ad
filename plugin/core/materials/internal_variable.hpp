// SPDX-License-Identifier: GPL-2.0-or-later
// Internal variable: what a law remembers of a point besides the elastic strain.
#pragma once
#include <array>
#include <limits>

namespace gimpm {

/// Declared once, by the laws that have it: whatever stores it, checks it, shows it or writes it to a file reads this.
struct InternalVariable {
	const char* name        = "";
	const char* unit        = "-";   ///< SI; "-" of a ratio
	const char* description = "";    ///< a few words, as for the label of a picture
	double      least = 0, most = 0; ///< admitted values, both included

	constexpr bool admits(double value) const { return least <= value && value <= most; }
};

inline constexpr double anyNumber = std::numeric_limits<double>::max(); ///< a bound of variables that have none
inline constexpr double positive  = std::numeric_limits<double>::min(); ///< the least value of those that must not be zero

inline constexpr InternalVariable equivalentPlasticStrain { "plasticStrain", "-", "plastic strain", 0, anyNumber };

} // namespace gimpm
