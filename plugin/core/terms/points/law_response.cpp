// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/law_response.hpp"
#include "core/base/instruction_set.hpp"

namespace gimpm {

void respondByCall(const PrincipalLaw& law, const PrincipalValues<Lanes>& trialStrain, const Lanes* internals, LanesOfLaws& response)
{
	withLaw(law.is, [&](const auto& l) {
		using L = std::decay_t<decltype(l)>;
		if constexpr (!L::isShort) {
			std::array<Lanes, L::variables.size()> own;
			std::copy_n(internals, own.size(), own.begin());
			callForProcessor([&] { response.take(l.template respond<Lanes>(trialStrain, own)); });
		}
	});
}

} // namespace gimpm
