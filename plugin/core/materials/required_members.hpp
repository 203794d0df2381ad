// SPDX-License-Identifier: GPL-2.0-or-later
// Members that every law has to have, whatever its kind. One that is forgotten is named by the compiler.
#pragma once
#include <type_traits>
#include <utility>

namespace gimpm {

struct Weakening;

/// True if the expression e(std::declval<const L&>()) compiles.
template <class L, class E> constexpr bool compiles(E&&) { return std::is_invocable_v<E, const L&>; }

#define GIMPM_HAS(expression) compiles<L>([]([[maybe_unused]] const auto& law) -> decltype((void)(expression)) {})

template <class L> constexpr bool hasRequiredMembers()
{
	static_assert(
	        GIMPM_HAS(law.variables.size()), "the law has no `static constexpr std::array<..., n> variables`: what it remembers of a point, if anything");
	static_assert(GIMPM_HAS(law.initialInternals()), "the law has no `initialInternals() const`: the values of its variables at first");
	static_assert(GIMPM_HAS(law.mayFail ? 0 : 1), "the law has no `static constexpr bool mayFail`: whether there are strains that it has no answer to");
	static_assert(GIMPM_HAS(law.isElastic ? 0 : 1), "the law has no `static constexpr bool isElastic`: whether nothing ever flows");
	static_assert(GIMPM_HAS(law.isLinear ? 0 : 1), "the law has no `static constexpr bool isLinear`: whether stress is linear in the elastic strain");
	static_assert(
	        GIMPM_HAS(law.canBeWeakened ? 0 : 1),
	        "the law has no `static constexpr bool canBeWeakened`: whether a factor of safety can divide its strength");
	static_assert(GIMPM_HAS(law.isSymmetric() ? 0 : 1), "the law has no `bool isSymmetric() const`: whether its tangent is");
	static_assert(
	        GIMPM_HAS(law.parameters().size()),
	        "the law has no `Parameters parameters() const`, with `using Parameters = std::array<double, n>`: what may differ from point to point");
	static_assert(GIMPM_HAS(law.with(law.parameters())), "the law has no `with(const Parameters&) const`: the same law with other parameters");
	static_assert(
	        GIMPM_HAS(law.weakened(std::declval<const Weakening&>()).size()),
	        "the law has no `Parameters weakened(const Weakening&) const`: what strength reduction makes of its parameters");
	return true;
}

} // namespace gimpm
