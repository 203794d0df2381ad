// SPDX-License-Identifier: GPL-2.0-or-later
// The table of constitutive laws: a new law is one header beside this one and one entry here.
#pragma once
#include "core/materials/hencky.hpp"
#include "core/materials/von_mises.hpp"
#include <variant>

namespace gimpm {

using Law = std::variant<Hencky, VonMises>;

/// f(the law). Unlike std::visit it is inlined.
template <class F, std::size_t Entry = 0> GIMPM_INLINE auto withLaw(const Law& law, F&& f)
{
	if constexpr (Entry + 1 == std::variant_size_v<Law>) return f(*std::get_if<Entry>(&law));
	else {
		if (const auto* l = std::get_if<Entry>(&law)) return f(*l);
		return withLaw<F, Entry + 1>(law, std::forward<F>(f));
	}
}

struct Material {
	Law    law;
	double density; ///< initial density [kg/m3]

	double young() const
	{
		return std::visit([](const auto& l) { return l.young(); }, law);
	}
};

} // namespace gimpm
