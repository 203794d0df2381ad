// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/internal_variable.hpp"
#include "yade_api/types.hpp"
#include <sstream>

namespace yade {

// Why an internal variable cannot have this value.
inline string refusalOf(const gimpm::InternalVariable& variable, Real value)
{
	std::ostringstream text;
	text << variable.name << " = " << value << " is not admitted: expected a finite number ";
	if (variable.least == gimpm::positive) text << "> 0";
	else if (variable.least > -gimpm::anyNumber)
		text << ">= " << variable.least;
	if (variable.most < gimpm::anyNumber) text << " and <= " << variable.most;
	text << " [" << variable.unit << "].";
	return text.str();
}

} // namespace yade
