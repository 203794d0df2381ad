// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/pores.hpp"
#include <cmath>

namespace gimpm {

Pores::Conductivity Pores::at(double J) const
{
	const double n0 = porosity, n = 1 - (1 - n0) / J;
	if (law == Law::kozenyCarman) return { conductivity * std::pow(n / n0, 3) * std::pow((1 - n0) / (1 - n), 2), (3 - n) / n };
	if (law == Law::constant) return { conductivity, 0 };
	const double e = n / (1 - n), e0 = n0 / (1 - n0);
	return { conductivity * std::pow(10, (e - e0) / index), std::log(10) * (1 + e) / index };
}

} // namespace gimpm
