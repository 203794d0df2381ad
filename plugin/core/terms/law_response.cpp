// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/law_response.hpp"
#include "core/base/instruction_set.hpp"

namespace gimpm {

void respondTogether(
        const Material& material, const ParameterColumns& parameters, const InternalColumns& columns, const int* point,
        const PrincipalValues<Lanes>& trialStrain, LanesOfLaws& response)
{
	if (material.varies) return respondOneByOne(material, parameters, columns, point, trialStrain, response);
	withLaw(material.law, [&](const auto& law) {
		using L = std::decay_t<decltype(law)>;
		std::array<Lanes, L::variables.size()> internals;
		for (std::size_t k = 0; k < internals.size(); ++k) {
			const double* column = columns[columnOf<L>(k)].data();
			internals[k]         = lanes([&](int lane) { return column[point[lane]]; });
		}
		callForProcessor([&] { response.take(law.template respond<Lanes>(trialStrain, internals)); });
	});
}

} // namespace gimpm
