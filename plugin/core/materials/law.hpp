// SPDX-License-Identifier: GPL-2.0-or-later
// The table of principal laws, for the kernels and whoever makes a law: a new one is one header beside this one and one
// entry here. Laws that need more than the principal values of the trial strain are tensor laws
// (core/materials/tensor_law.hpp), which are in no table.
//
// Members that a law must have are in core/materials/required_members.hpp and in hasPrincipalMembers(). It declares its
// internal `variables` and their values at first (initialInternals), and answers with young() and respond(), which are
// given the values of those variables at the start of the step, in this order. young() may ask for the elastic
// volumetric strain too. Strengths or moduli that may differ from point to point are an array of `Parameters`:
// parameters() are its own, and with() is the same law with others, weakened() what strength reduction makes of them. A
// law of a few lines may say that it isShort, and is compiled into the kernels.
#pragma once
#include "core/materials/cam_clay.hpp"
#include "core/materials/drucker_prager.hpp"
#include "core/materials/hencky.hpp"
#include "core/materials/material.hpp"
#include "core/materials/mohr_coulomb.hpp"
#include "core/materials/required_members.hpp"
#include "core/materials/von_mises.hpp"
#include <algorithm>
#include <variant>

namespace gimpm {

using PrincipalLaws = std::variant<Hencky, VonMises, MohrCoulomb, DruckerPrager, CamClay>;

struct PrincipalLaw {
	PrincipalLaws is;
};

/// f(the law). Unlike std::visit it is inlined.
template <class F, std::size_t Entry = 0> GIMPM_INLINE auto withLaw(const PrincipalLaws& law, F&& f)
{
	if constexpr (Entry + 1 == std::variant_size_v<PrincipalLaws>) return f(*std::get_if<Entry>(&law));
	else {
		if (const auto* l = std::get_if<Entry>(&law)) return f(*l);
		return withLaw<F, Entry + 1>(law, std::forward<F>(f));
	}
}
template <class F> GIMPM_INLINE auto withLaw(const Law& law, F&& f) { return withLaw(law.principal().is, std::forward<F>(f)); }

template <class L> constexpr bool hasPrincipalMembers()
{
	static_assert(GIMPM_HAS(law.isShort ? 0 : 1), "the law has no `static constexpr bool isShort`: whether it is compiled into the kernels");
	static_assert(
	        GIMPM_HAS(law.young(law.initialInternals())) || GIMPM_HAS(law.young(law.initialInternals(), 0.)),
	        "the law has no `double young(const std::array<double, n>& internals) const`: Young's modulus of unloading, as it is now");
	static_assert(
	        GIMPM_HAS(law.respond(std::declval<const Vec3&>(), law.initialInternals())),
	        "the law has no `respond(trialStrain, internals) const`, as a template of numbers and for doubles: what it answers");
	if constexpr (!L::isLinear)
		static_assert(
		        GIMPM_HAS(law.strainNear(std::declval<const Vec3&>())),
		        "the law has no `std::optional<Vec3> strainNear(const Vec3& stress) const`, which where stress is not linear in strain finds a first strain");
	return hasRequiredMembers<L>();
}

template <class Laws> struct LawTraits;
template <class... Laws> struct LawTraits<std::variant<Laws...>> {
	static_assert((hasPrincipalMembers<Laws>() && ...));
	/// One of them.
	static constexpr bool mayFail = (Laws::mayFail || ...);
	/// Largest number of variables of one of them.
	static constexpr std::size_t mostVariables = std::max({ std::size_t(0), Laws::variables.size()... });

	/// The variables of all laws, each once.
	struct Variables {
		std::array<InternalVariable, (0 + ... + Laws::variables.size())> item {};
		std::size_t                                                      count = 0;

		constexpr auto begin() const { return item.begin(); }
		constexpr auto end() const { return item.begin() + count; }

		constexpr int find(std::string_view name) const
		{
			for (std::size_t i = 0; i < count; ++i)
				if (item[i].name == name) return int(i);
			return -1;
		}
	};
	static constexpr Variables variables()
	{
		Variables  all;
		const auto add = [&all](const auto& ofLaw) {
			for (const auto& variable : ofLaw)
				if (all.find(variable.name) < 0) all.item[all.count++] = variable;
		};
		(add(Laws::variables), ...);
		return all;
	}
};

/// The internal variables of the principal laws: column i of InternalColumns has the values of variable i.
inline constexpr auto principalVariables = LawTraits<PrincipalLaws>::variables();

/// Column of the k-th variable of law L.
template <class L> constexpr int columnOf(std::size_t k) { return principalVariables.find(L::variables[k].name); }

/// The internal variables of a point of this law.
template <class L> auto internalsOf(const L& law, const InternalColumns& columns, std::size_t point)
{
	auto values = law.initialInternals();
	for (std::size_t k = 0; k < values.size(); ++k)
		if (const std::size_t column = columnOf<L>(k); column < columns.size() && !columns[column].empty()) values[k] = columns[column][point];
	return values;
}

/// Young's modulus by a law that asks for the volumetric strain, or for the internal variables only.
template <class L, class Internals, class F>
auto youngOf(const L& law, const Internals& internals, F&& volumetricStrain, int) -> decltype(law.young(internals, volumetricStrain()))
{
	return law.young(internals, volumetricStrain());
}
template <class L, class Internals, class F> double youngOf(const L& law, const Internals& internals, F&&, long) { return law.young(internals); }

/// Number of parameters of a law that may differ from point to point.
template <class L> inline constexpr std::size_t countOfParameters = typename L::Parameters().size();

/// f(the law of a point with these columns of parameters).
template <class L, class F> auto withParameters(const L& law, const ParameterColumns& parameters, std::size_t point, F&& f)
{
	if (parameters.empty()) return f(law);
	auto values = law.parameters();
	for (std::size_t k = 0; k < std::min(values.size(), parameters.size()); ++k)
		if (!parameters[k].empty()) values[k] = parameters[k][point];
	return f(law.with(values));
}

/// f(the law of a point): that of the material, with the parameters that the point has.
template <class F> auto withLawOf(const Material& material, const ParameterColumns& parameters, std::size_t point, F&& f)
{
	return withLaw(material.law, [&](const auto& law) { return withParameters(law, material.ofPoints(parameters), point, f); });
}

/// Stores the internal variables of a point of this law, of which `values` has at least as many as it has variables.
template <class L, class Values> void storeInternals(const L& law, const Values& values, InternalColumns& columns, std::size_t point)
{
	for (std::size_t k = 0; k < law.variables.size(); ++k)
		columns[columnOf<L>(k)][point] = values[k];
}

std::shared_ptr<const AnyLaw> handleOf(const PrincipalLaws&);

} // namespace gimpm
