// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/surface_loads.hpp"
#include "engine/solver/surfaces.hpp"

namespace yade {

namespace {
	template <int Dim> void requireFitting(const MpmTraction& load, const string& name)
	{
		requireDimension<Dim>(*load.surface, name);
		if (load.pressure != 0 && load.surface->initialVertices.empty()) load.surface->requireOneSide(name + ".surface");
		if (Dim == 2 && load.traction[2] != 0)
			throw std::invalid_argument(name + ".traction = " + textOf(load.traction) + ": there is no direction z on a grid with dim=2.");
	}
}

template <int Dim> SurfaceLoads<Dim>::SurfaceLoads(const Loads& given, const gimpm::Grid<Dim>& grid)
{
	for (size_t i = 0; i < given.loads.size(); ++i) {
		const auto&  load = given.loads[i];
		const string name = "loads[" + std::to_string(i) + "]";
		load->requireAdmissible();
		requireFitting<Dim>(*load, name);
		for (size_t j = 0; j < i; ++j)
			if (given.loads[j]->surface == load->surface)
				throw std::invalid_argument(
				        "loads[" + std::to_string(j) + "] and " + name
				        + " have the same MpmSurface, which would move twice: give each its own.");
		sources.push_back({ load, given.curveOf(*load) });
		loads.push_back({ coreSurface<Dim>(*load->surface) });
		loads.back().isNew = load->surface->initialVertices.empty();
		loads.back().surface.refine(gimpm::pieceLimit * grid.cellSize);
	}
}

template <int Dim> void SurfaceLoads<Dim>::join(gimpm::Model<Dim>& model)
{
	for (auto& load : loads)
		model.terms.push_back(
		        [&load](const gimpm::Beginning<Dim>& step) { return std::make_unique<gimpm::Traction<Dim>>(load, step.basis, step.grid); });
}

template <int Dim> void SurfaceLoads<Dim>::advanceTo(Real time)
{
	for (size_t i = 0; i < loads.size(); ++i) {
		const Real factor = sources[i].curve.valueAt(time);
		loads[i].pressure = factor * sources[i].from->pressure;
		loads[i].traction = factor * sources[i].from->traction.template head<Dim>();
	}
}

template <int Dim> void SurfaceLoads<Dim>::beginAt(Real time)
{
	advanceTo(time);
	for (auto& load : loads) {
		load.pressureBefore = load.pressure;
		load.tractionBefore = load.traction;
	}
}

template <int Dim> Real SurfaceLoads<Dim>::work() const
{
	Real sum = 0;
	for (const auto& load : loads)
		sum += load.work;
	return sum;
}

template <int Dim> void SurfaceLoads<Dim>::scatter() const
{
	for (size_t i = 0; i < loads.size(); ++i) {
		yade::scatter<Dim>(loads[i].surface, *sources[i].from->surface);
		sources[i].from->resultant.setZero();
		sources[i].from->resultant.template head<Dim>() = loads[i].resultant;
	}
}

template class SurfaceLoads<2>;
template class SurfaceLoads<3>;

} // namespace yade
