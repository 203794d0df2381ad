// SPDX-License-Identifier: GPL-2.0-or-later
// The table of constitutive laws: a new law is one header beside this one and one entry here.
//
// A law declares its internal `variables`, their values at first (initialInternals), whether it `mayFail`, that is, has strains without an
// answer; and it answers with young() and respond(), which are given the values of those variables at the start of the step, in this order.
// young() may ask for the elastic volumetric strain too. A law whose tangent is not always symmetric says isSymmetric(); the others need not.
// A law of which strengths or moduli may differ from point to point has them as an array of `Parameters`: parameters() are its own, and with() is
// the same law with others, weakened() what strength reduction makes of them. A law of a few lines may say that it
// isShort, and is compiled into the kernels.
#pragma once
#include "core/materials/cam_clay.hpp"
#include "core/materials/drucker_prager.hpp"
#include "core/materials/hencky.hpp"
#include "core/materials/mohr_coulomb.hpp"
#include "core/materials/von_mises.hpp"
#include <algorithm>
#include <string_view>
#include <variant>

namespace gimpm {

using Law = std::variant<Hencky, VonMises, MohrCoulomb, DruckerPrager, CamClay>;

/// f(the law). Unlike std::visit it is inlined.
template <class F, std::size_t Entry = 0> GIMPM_INLINE auto withLaw(const Law& law, F&& f)
{
	if constexpr (Entry + 1 == std::variant_size_v<Law>) return f(*std::get_if<Entry>(&law));
	else {
		if (const auto* l = std::get_if<Entry>(&law)) return f(*l);
		return withLaw<F, Entry + 1>(law, std::forward<F>(f));
	}
}

template <class Laws> struct LawTraits;
template <class... Laws> struct LawTraits<std::variant<Laws...>> {
	static constexpr bool        mayFail       = (Laws::mayFail || ...);                                  ///< one of them
	static constexpr std::size_t mostVariables = std::max({ std::size_t(0), Laws::variables.size()... }); ///< of one of them

	/// The variables of all laws, each once.
	struct Variables {
		std::array<InternalVariable, (0 + ... + Laws::variables.size())> item {};
		std::size_t                                                      count = 0;

		constexpr auto                    begin() const { return item.begin(); }
		constexpr auto                    end() const { return item.begin() + count; }
		constexpr size_t                  size() const { return count; }
		constexpr const InternalVariable& operator[](std::size_t i) const { return item[i]; }

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

/// The internal variables that there are: column i of InternalColumns has the values of variable i.
inline constexpr auto internalVariables = LawTraits<Law>::variables();

/// Column of the k-th variable of law L.
template <class L> constexpr int columnOf(std::size_t k) { return internalVariables.find(L::variables[k].name); }

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

/// How many parameters of a law may differ from point to point.
template <class L> constexpr auto        countOfParameters(int) -> decltype(typename L::Parameters().size()) { return typename L::Parameters().size(); }
template <class L> constexpr std::size_t countOfParameters(long) { return 0; }

/// Those of the law itself.
inline std::vector<double> parametersOf(const Law& law)
{
	return withLaw(law, [](const auto& l) {
		std::vector<double> values;
		if constexpr (countOfParameters<std::decay_t<decltype(l)>>(0) > 0)
			for (const double value : l.parameters())
				values.push_back(value);
		return values;
	});
}

struct Material {
	Law    law;
	double density;        ///< initial density [kg/m3]
	bool   varies = false; ///< points have parameters of their own

	/// f(the law of a point): that of the material, with the parameters that the point has.
	template <class F> auto withLawOf(const ParameterColumns& parameters, std::size_t point, F&& f) const
	{
		return withLaw(law, [&](const auto& l) {
			using L = std::decay_t<decltype(l)>;
			if constexpr (countOfParameters<L>(0) > 0)
				if (varies) {
					auto values = l.parameters();
					for (std::size_t k = 0; k < std::min(values.size(), parameters.size()); ++k)
						if (!parameters[k].empty()) values[k] = parameters[k][point];
					return f(l.with(values));
				}
			return f(l);
		});
	}

	/// Young's modulus [Pa] of a point with these parameters and internal variables; volumetricStrain() gives its elastic volumetric strain to the laws
	/// that ask for it.
	template <class F> double young(const ParameterColumns& parameters, const InternalColumns& columns, std::size_t point, F&& volumetricStrain) const
	{
		return withLawOf(parameters, point, [&](const auto& l) { return youngOf(l, internalsOf(l, columns, point), volumetricStrain, 0); });
	}
	/// The same without elastic strain, by the parameters of the material.
	double young(const InternalColumns& columns, std::size_t point) const
	{
		return young({}, columns, point, [] { return 0.; });
	}
};

/// Of a law that says so, and of one that does not.
template <class L> auto isSymmetric(const L& law, int) -> decltype(law.isSymmetric()) { return law.isSymmetric(); }
template <class L> bool isSymmetric(const L&, long) { return true; }

/// Whether the laws of all of these points have symmetric tangents, and so a stiffness that is symmetric.
inline bool areSymmetric(const std::vector<Material>& materials, const std::vector<int>& material, const ParameterColumns& parameters)
{
	const auto is
	        = [&](const Material& m, std::size_t point) { return m.withLawOf(parameters, point, [](const auto& law) { return isSymmetric(law, 0); }); };
	for (const Material& m : materials)
		if (!m.varies && !is(m, 0)) return false;
	if (parameters.empty()) return true;
	for (std::size_t p = 0; p < material.size(); ++p)
		if (const Material& m = materials[material[p]]; m.varies && !is(m, p)) return false;
	return true;
}

/// Makes the columns that the laws of these materials have variables for, and that are not there yet, for so many points, of zeros.
inline void provideInternals(InternalColumns& columns, const std::vector<Material>& materials, std::size_t points)
{
	columns.resize(internalVariables.size());
	for (const Material& material : materials)
		withLaw(material.law, [&](const auto& law) {
			using L = std::decay_t<decltype(law)>;
			for (std::size_t k = 0; k < law.variables.size(); ++k)
				columns[columnOf<L>(k)].resize(points);
		});
}

/// Stores the internal variables of a point of this law, of which `values` has at least as many as it has variables.
template <class L, class Values> void storeInternals(const L& law, const Values& values, InternalColumns& columns, std::size_t point)
{
	for (std::size_t k = 0; k < law.variables.size(); ++k)
		columns[columnOf<L>(k)][point] = values[k];
}

} // namespace gimpm
