// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Pairs a class of materials with its constitutive law, in the file that registers the class. No other file of the
// plugin has to know of them: it is enough that they are linked into it.
#include "core/materials/material.hpp"
#include "core/materials/required_members.hpp"
#include "engine/materials/parameters.hpp"
#include <typeindex>

namespace yade {

struct LawOfClass {
	std::function<gimpm::Law(const MpmMaterial&)>              make;
	std::function<shared_ptr<MpmMaterial>(const MpmMaterial&)> copy;
	vector<ParameterOfClass>                                   parameters;
};

// Adds it to those that there are.
void registerLaw(std::type_index, LawOfClass);

// A static object of each class that has a law: make(material of class M) returns the law, or a gimpm::Law where that
// depends on the attributes, and the members are its parameters, in its order; others that it has stay the same.
template <class M> struct RegisteredLaw {
	template <class Make, class... Members> explicit RegisteredLaw(Make make, const std::pair<const char*, Members>&... parameters)
	{
		using Law = decltype(make(std::declval<const M&>()));
		if constexpr (!std::is_same_v<Law, gimpm::Law>) {
			static_assert(gimpm::hasRequiredMembers<Law>());
			static_assert(sizeof...(Members) <= typename Law::Parameters().size());
		}
		[[maybe_unused]] const auto of = [](const auto& parameter) {
			return ParameterOfClass { parameter.first,
				                  [member = parameter.second](MpmMaterial& m) -> Real& { return static_cast<M&>(m).*member; } };
		};
		registerLaw(
		        typeid(M),
		        { [make](const MpmMaterial& m) { return gimpm::Law(make(static_cast<const M&>(m))); },
		          [](const MpmMaterial& m) { return shared_ptr<MpmMaterial>(new M(static_cast<const M&>(m))); },
		          { of(parameters)... } });
	}
};

} // namespace yade
