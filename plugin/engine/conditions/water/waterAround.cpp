// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/waterAround.hpp"
#include "engine/conditions/water/waters.hpp"
#include "engine/points/buffers.hpp"

namespace yade {

namespace {
	py::object bytesOf(const vector<Real>& values)
	{
		const char* begin = reinterpret_cast<const char*>(values.data());
		return py::object(py::handle<>(PyByteArray_FromStringAndSize(begin, values.size() * sizeof(Real))));
	}

	template <int Dim> py::list waterAround(const Analysis& engine, const Column<Real>& places, const Column<Real>& halves)
	{
		const auto             grid = engine.grid->lattice<Dim>();
		gimpm::PointCloud<Dim> cloud;
		for (size_t i = 0; i + 2 < places.size(); i += 3) {
			cloud.position.push_back(Eigen::Map<const Vector3r>(places.data() + i).template head<Dim>());
			cloud.halfSize.push_back(Eigen::Map<const Vector3r>(halves.data() + i)
			                                 .template head<Dim>()
			                                 .cwiseMin(gimpm::largestHalf<Dim>(grid, cloud.position.back())));
		}
		MpmCondition::Group all;
		for (const Listed& listed : engine.conditions())
			if (const auto water = boost::dynamic_pointer_cast<MpmWater>(listed.condition)) {
				if (water->pressure) water->forgetTable(); // its answers may be others now
				all.push_back(listed);
			}
		Waters<Dim> waters(all);
		const Real  now = engine.ownScene()->time;
		waters.take(engine, grid, cloud, {}, now, now, {});
		waters.advance(now, now);
		vector<vector<Real>> pressures(all.size()), gradients(all.size());
		for (size_t p = 0; p < cloud.position.size(); ++p) {
			const auto all = waters.around(cloud.position[p], cloud.halfSize[p]);
			for (size_t i = 0; i < all.size(); ++i) {
				const auto& around = all[i].second.value(); // its nodes have just been asked about
				pressures[i].push_back(around.value);
				gradients[i].insert(gradients[i].end(), around.gradient.data(), around.gradient.data() + Dim);
				if (Dim == 2) gradients[i].push_back(0);
			}
		}
		py::list found;
		for (size_t i = 0; i < pressures.size(); ++i)
			found.append(py::make_tuple(bytesOf(pressures[i]), bytesOf(gradients[i])));
		return found;
	}
}

py::list waterAroundForPython(const Analysis& engine, const py::object& positions, const py::object& halfSizes)
{
	const ValueLock lock;
	engine.requireAttributes();
	engine.grid->requireAdmissible();
	engine.requireConditions();
	const Column<Real> places(positions, "positions"), halves(halfSizes, "halfSizes");
	return engine.grid->dim == 3 ? waterAround<3>(engine, places, halves) : waterAround<2>(engine, places, halves);
}

} // namespace yade
