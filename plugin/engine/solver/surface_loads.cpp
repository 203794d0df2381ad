// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/surface_loads.hpp"
#include <algorithm>

namespace yade {

namespace {
	template <int Dim> std::vector<gimpm::Vec<Dim>> inDimension(const vector<Vector3r>& points)
	{
		std::vector<gimpm::Vec<Dim>> result;
		for (const Vector3r& x : points)
			result.push_back(x.head<Dim>());
		return result;
	}

	template <int Dim> vector<Vector3r> inSpace(const std::vector<gimpm::Vec<Dim>>& points, Real z)
	{
		vector<Vector3r> result;
		for (const auto& x : points) {
			result.emplace_back(0, 0, z);
			result.back().template head<Dim>() = x;
		}
		return result;
	}

	template <int Dim> void requireFitting(const MpmTraction& load, const string& name)
	{
		if (load.surface->dim() != Dim)
			throw std::invalid_argument(
			        name + ".surface is made of " + (Dim == 2 ? "triangles" : "segments") + ", but the grid has dim=" + std::to_string(Dim)
			        + ": expected " + (Dim == 2 ? "a line of points." : "triangles."));
		if (Dim == 2 && load.traction[2] != 0)
			throw std::invalid_argument(name + ".traction = " + textOf(load.traction) + ": there is no direction z on a grid with dim=2.");
	}

	template <int Dim> gimpm::Surface<Dim> coreSurface(const MpmSurface& surface)
	{
		gimpm::Surface<Dim> result { inDimension<Dim>(surface.vertices), {}, {} };
		result.vertices0 = surface.initialVertices.empty() ? result.vertices : inDimension<Dim>(surface.initialVertices);
		for (const vector<int>& piece : surface.pieces) {
			result.pieces.emplace_back();
			std::copy(piece.begin(), piece.end(), result.pieces.back().begin());
		}
		return result;
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
		model.terms.push_back([&load](const gimpm::Beginning<Dim>& step) {
			return std::make_unique<gimpm::Traction<Dim>>(load, step.basis, step.grid);
		});
}

template <int Dim> void SurfaceLoads<Dim>::advanceTo(Real time)
{
	for (size_t i = 0; i < loads.size(); ++i) {
		const Real factor = sources[i].curve.valueAt(time);
		loads[i].pressure = factor * sources[i].from->pressure;
		loads[i].traction = factor * sources[i].from->traction.template head<Dim>();
	}
}

template <int Dim> void SurfaceLoads<Dim>::scatter() const
{
	for (size_t i = 0; i < loads.size(); ++i) {
		MpmSurface&                to      = *sources[i].from->surface;
		const gimpm::Surface<Dim>& surface = loads[i].surface;
		const Real                 z       = to.vertices.front()[2];
		to.vertices                        = inSpace<Dim>(surface.vertices, z);
		to.initialVertices                 = inSpace<Dim>(surface.vertices0, z);
		to.pieces.clear();
		for (const auto& piece : surface.pieces)
			to.pieces.emplace_back(piece.begin(), piece.end());
		sources[i].from->resultant.setZero();
		sources[i].from->resultant.template head<Dim>() = loads[i].resultant;
	}
}

template class SurfaceLoads<2>;
template class SurfaceLoads<3>;

} // namespace yade
