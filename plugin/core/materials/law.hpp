// SPDX-License-Identifier: GPL-2.0-or-later
// The table of constitutive laws: a new law is one header beside this one and one entry here.
#pragma once
#include "core/materials/hencky.hpp"
#include "core/materials/von_mises.hpp"
#include <variant>

namespace gimpm {

using Law = std::variant<Hencky, VonMises>;

struct Material {
	Law    law;
	double density; ///< initial density [kg/m3]

	double young() const
	{
		return std::visit([](const auto& l) { return l.young(); }, law);
	}
};

} // namespace gimpm
