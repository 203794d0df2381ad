// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/varying_law.hpp"

namespace gimpm {
namespace {

template <std::size_t Count> void setLane(LanesOfLaws& response, int lane, const ResponseWith<double, Count>& r)
{
	for (int i = 0; i < 3; ++i) {
		response.stress[i].v[lane]        = r.stress[i];
		response.shear[i].v[lane]         = r.shear[i];
		response.elasticStrain[i].v[lane] = r.elasticStrain[i];
		for (int j = 0; j < 3; ++j)
			response.tangent(i, j).v[lane] = r.tangent(i, j);
	}
	response.failed.v[lane] = r.failed;
	for (std::size_t k = 0; k < Count; ++k)
		response.internals[k].v[lane] = r.internals[k];
}

} // namespace

void respondOneByOne(
        const Material& material, const ParameterColumns& parameters, const InternalColumns& columns, const int* point,
        const PrincipalValues<Lanes>& trialStrain, LanesOfLaws& response)
{
	for (int lane = 0; lane < Lanes::count; ++lane)
		withLawOf(material, parameters, point[lane], [&](const auto& law) {
			const Vec3 strain(trialStrain[0][lane], trialStrain[1][lane], trialStrain[2][lane]);
			setLane(response, lane, law.respond(strain, internalsOf(law, columns, point[lane])));
		});
}

} // namespace gimpm
