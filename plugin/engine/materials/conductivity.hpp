// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Hydraulic conductivity as an attribute: a number, or one along and one across horizontal layers.
#include "yade_api/conversion.hpp"
#pragma GCC visibility push(default)
#include <boost/serialization/nvp.hpp>
#pragma GCC visibility pop

namespace yade {

struct Conductivity {
	Real horizontal = std::numeric_limits<Real>::quiet_NaN(), vertical = std::numeric_limits<Real>::quiet_NaN(); // [m/s]; vertical NaN: as horizontal

	bool isPair() const { return !std::isnan(vertical); }

	// Vertical over horizontal.
	Real ratio() const { return isPair() && vertical != horizontal ? vertical / horizontal : 1; }
	Real largest() const { return isPair() ? std::max(horizontal, vertical) : horizontal; }
	bool isAdmissible() const
	{
		const auto isPossible = [](Real value) { return std::isfinite(value) && value >= 0; };
		if (isPair()) return (horizontal > 0 && isPossible(horizontal) && isPossible(vertical)) || (horizontal == 0 && vertical == 0);
		return std::isnan(horizontal) || isPossible(horizontal);
	}

	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		archive& boost::serialization::make_nvp("horizontal", horizontal);
		archive& boost::serialization::make_nvp("vertical", vertical);
	}
};

inline string textOf(const Conductivity& value) { return value.isPair() ? textOf(std::pair(value.horizontal, value.vertical)) : textOf(value.horizontal); }

template <> struct Conversion<Conductivity> {
	static string                      expected() { return "a number [m/s], or a pair (horizontal, vertical)"; }
	static std::optional<Conductivity> fromPython(const py::object& value)
	{
		if (const auto both = Conversion<std::pair<Real, Real>>::fromPython(value)) {
			if (std::isnan(both->second)) return std::nullopt;
			return Conductivity { both->first, both->second };
		}
		if (const auto one = Conversion<Real>::fromPython(value)) return Conductivity { *one };
		return std::nullopt;
	}
	static py::object toPython(const Conductivity& value)
	{
		if (value.isPair()) return Conversion<std::pair<Real, Real>>::toPython({ value.horizontal, value.vertical });
		return Conversion<Real>::toPython(value.horizontal);
	}
};

} // namespace yade
