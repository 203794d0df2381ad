// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/poreWater.hpp"
#include "core/terms/water/unsaturated_point.hpp"
#include "engine/materials/parameters.hpp"
#include "engine/points/buffers.hpp"

namespace yade {

gimpm::Bishop bishopOf(const MpmFlow& flow) { return flow.bishop == "saturation" ? gimpm::Bishop::saturation : gimpm::Bishop::effectiveSaturation; }

py::tuple poreWaterForPython(const MpmFlow& flow, const MpmMaterial& ofAll, const py::object& pressures, const py::dict& parameters, Real volumeRatio)
{
	const ValueLock lock;
	flow.requireAdmissible();
	ofAll.requireAdmissible();
	OwnParameters  own;
	const py::list names = parameters.keys();
	for (py::ssize_t i = 0; i < py::len(names); ++i)
		own.emplace_back(py::extract<string>(names[i]), py::extract<Real>(parameters[names[i]]));
	OwnMaterial                           owns;
	const MpmMaterial&                    material = owns.of(ofAll, own);
	const Column<Real>                    all(pressures, "pressures");
	const std::optional<gimpm::Retention> curve = material.retention ? std::optional(material.retention->law(flow.unitWeight)) : std::nullopt;
	gimpm::Pores                          pores;
	pores.retention   = curve ? &*curve : nullptr;
	pores.porosity    = material.porosity;
	const auto bishop = bishopOf(flow);
	const auto column = [&](auto of) {
		py::object  found { py::handle<>(PyByteArray_FromStringAndSize(nullptr, all.size() * sizeof(Real))) };
		Real* const to = reinterpret_cast<Real*>(PyByteArray_AS_STRING(found.ptr()));
		for (size_t i = 0; i < all.size(); ++i)
			to[i] = of(all.data()[i]).value;
		return found;
	};
	return py::make_tuple(
	        column([&](Real p) { return gimpm::saturationOf(pores, p, volumeRatio); }),
	        column([&](Real p) { return gimpm::pressureOnGrains(pores, bishop, p, volumeRatio); }),
	        column([&](Real p) { return gimpm::permeabilityOf(pores, p, volumeRatio); }));
}

} // namespace yade
