// SPDX-License-Identifier: GPL-2.0-or-later
// The laws' answers, several points at once. Short laws are compiled into the kernels, which then need not call
// anything. The others are compiled once for each kind of processor: into each of the kernels they would take the
// compiler minutes.
#pragma once
#include "core/terms/points/varying_law.hpp"

namespace gimpm {

/// Response of Lanes::count points to their trial strains by a law that is not short, with the values of its variables
/// at the start of the step.
void respondByCall(const PrincipalLaw&, const PrincipalValues<Lanes>& trialStrain, const Lanes* internals, LanesOfLaws&);

/// The same by any law, with the variables of these points; of those that are of another material there are any
/// numbers.
GIMPM_INLINE void respondTogether(
        const Material& material, const ParameterColumns& parameters, const InternalColumns& columns, const int* point,
        const PrincipalValues<Lanes>& trialStrain, LanesOfLaws& response)
{
	if (material.varies) return respondOneByOne(material, parameters, columns, point, trialStrain, response);
	withLaw(material.law, [&](const auto& law) GIMPM_INLINE_LAMBDA {
		using L = std::decay_t<decltype(law)>;
		std::array<Lanes, L::variables.size()> internals;
		for (std::size_t k = 0; k < internals.size(); ++k) {
			const double* column = columns[columnOf<L>(k)].data();
			internals[k]         = lanes([&](int lane) GIMPM_INLINE_LAMBDA { return column[point[lane]]; });
		}
		if constexpr (L::isShort) response.take(law.template respond<Lanes>(trialStrain, internals));
		else
			respondByCall(material.law.principal(), trialStrain, internals.data(), response);
	});
}

} // namespace gimpm
