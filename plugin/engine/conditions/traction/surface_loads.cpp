// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/traction/surface_loads.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/nearness.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

namespace {
	template <int Dim> void requireFitting(const MpmTraction& load, const string& name)
	{
		requireDimension<Dim>(*load.surface, name);
		if (load.pressure != 0 && load.surface->initialVertices.empty()) load.surface->requireOneSide(name + ".surface");
		if (Dim == 2 && load.traction[2] != 0)
			throw std::invalid_argument(name + ".traction = " + textOf(load.traction) + ": there is no direction z on a grid with dim=2.");
	}

	// The part of a surface that has material on both of its sides, half a cell away, and the middle of the first
	// such piece.
	template <int Dim> struct Inside {
		Real            part = 0;
		gimpm::Vec<Dim> place {};

		Inside(const gimpm::Surface<Dim>& surface, int layer, const gimpm::PointCloud<Dim>& cloud, const gimpm::Grid<Dim>& grid)
		{
			std::vector<gimpm::Vec<Dim>> beside;
			for (const auto& piece : surface.pieces) {
				const gimpm::Vec<Dim> away = 0.5 * grid.cellSize * surface.normal(piece, surface.vertices).normalized();
				beside.push_back(middle(piece, surface) + away);
				beside.push_back(middle(piece, surface) - away);
			}
			const auto isFar = gimpm::areFarFromMaterial<Dim>(beside, std::vector<double>(beside.size(), 0), cloud, grid, layer);
			Real       all   = 0;
			for (size_t i = 0; i < surface.pieces.size(); ++i) {
				const Real size = surface.normal(surface.pieces[i], surface.vertices).norm();
				all += size;
				if (isFar[2 * i] || isFar[2 * i + 1]) continue;
				if (part == 0) place = middle(surface.pieces[i], surface);
				part += size;
			}
			part /= all;
		}

	private:
		static gimpm::Vec<Dim> middle(const typename gimpm::Surface<Dim>::Piece& piece, const gimpm::Surface<Dim>& surface)
		{
			gimpm::Vec<Dim> sum = gimpm::Vec<Dim>::Zero();
			for (const int v : piece)
				sum += surface.vertices[v] / Dim;
			return sum;
		}
	};
}

template <int Dim> void SurfaceLoads<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	for (const Listed& listed : group) {
		const auto load = boost::static_pointer_cast<MpmTraction>(listed.condition);
		requireFitting<Dim>(*load, listed.name());
		sources.push_back({ load, around.analysis.curveOfLoad(load->curve) });
		loads.push_back({ coreSurface<Dim>(*load->surface) });
		loads.back().isNew = load->surface->initialVertices.empty();
		loads.back().name  = listed.name() + (load->body.empty() ? "" : " on body '" + load->body + "'");
		loads.back().layer = layerOf(around.analysis, load->body);
		loads.back().surface.refine(gimpm::pieceLimit * model.grid.cellSize);
	}
	for (auto& load : loads)
		model.terms.push_back([&load](const gimpm::StepContext<Dim>& step) { return std::make_unique<gimpm::Traction<Dim>>(load, step); });
}

template <int Dim> void SurfaceLoads<Dim>::advanceTo(Real time)
{
	for (size_t i = 0; i < loads.size(); ++i) {
		const Real factor = sources[i].curve.valueAt(time);
		loads[i].pressure = factor * sources[i].from->pressure;
		loads[i].traction = factor * sources[i].from->traction.template head<Dim>();
	}
}

template <int Dim> void SurfaceLoads<Dim>::joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin)
{
	advanceTo(begin);
	for (auto& load : loads) {
		load.pressureBefore = load.pressure;
		load.tractionBefore = load.traction;
	}
}

template <int Dim> Work SurfaceLoads<Dim>::work(const StepOutcome<Dim>&) const
{
	Work sum;
	for (const auto& load : loads)
		sum.ofLoads += load.work;
	return sum;
}

template <int Dim> void SurfaceLoads<Dim>::reach(const StepOutcome<Dim>&)
{
	for (size_t i = 0; i < loads.size(); ++i) {
		yade::scatter<Dim>(loads[i].surface, *sources[i].from->surface);
		sources[i].from->resultant.setZero();
		sources[i].from->resultant.template head<Dim>() = loads[i].resultant;
	}
}

template <int Dim> string SurfaceLoads<Dim>::warningOfPlace(const gimpm::PointCloud<Dim>& cloud, const gimpm::Grid<Dim>& grid) const
{
	for (size_t i = 0; i < loads.size(); ++i) {
		const MpmTraction& load = *sources[i].from;
		if (!loads[i].isNew || (load.pressure == 0 && load.traction.isZero(0))) continue;
		const Inside<Dim> inside(loads[i].surface, loads[i].layer, cloud, grid);
		if (inside.part > 0.5)
			return gimpm::sentence(
			        loads[i].name, " acts inside of the body: there is material on both sides of its surface, as at (", inside.place.transpose(),
			        "). Is it the surface of the ground that was meant, as mpm.surface finds it?");
	}
	return "";
}

template class SurfaceLoads<2>;
template class SurfaceLoads<3>;

} // namespace yade
