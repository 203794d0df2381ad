// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/flows.hpp"
#include "core/terms/absorbing.hpp"
#include "core/terms/flow.hpp"
#include "engine/conditions/surface/surfaces.hpp"
#include "engine/conditions/water/MpmWater.hpp"

namespace yade {

namespace {
	[[noreturn]] void refuseMaterial(const MaterialPoint& point, const string& what)
	{
		throw std::invalid_argument("Body #" + std::to_string(point.id) + ": its material '" + point.material->label + "' " + what);
	}

	gimpm::Pores poresOf(const MaterialPoint& point, Real unitWeight)
	{
		const MpmMaterial& m = *point.material;
		if (m.undrained)
			refuseMaterial(
			        point,
			        "is undrained = True: no water can leave it, while MpmFlow lets it flow; for soil that lets none through give conductivity=0.");
		if (std::isnan(m.conductivity))
			refuseMaterial(point, "has no conductivity [m/s], which MpmFlow needs: 1e-2 (gravel) to 1e-11 (clay), or 0 where nothing passes.");
		if (std::isnan(m.porosity)) refuseMaterial(point, "has no porosity [-], which MpmFlow needs: 0.3 (dense sand) to 0.7 (soft clay).");
		gimpm::Pores pores { m.conductivity / unitWeight, m.porosity };
		if (m.conductivityLaw == "kozeny-carman") pores.law = gimpm::Pores::Law::kozenyCarman;
		if (m.conductivityLaw == "log") pores.law = gimpm::Pores::Law::logarithmic, pores.index = m.conductivityIndex;
		return pores;
	}

	// Of all waters, if they are one that stands still.
	Real stillLevel(const Analysis& analysis, Real time)
	{
		Real   level = std::numeric_limits<Real>::quiet_NaN();
		size_t count = 0;
		for (const Listed& listed : analysis.conditions())
			if (const auto still = boost::dynamic_pointer_cast<MpmWater>(listed.condition); still && ++count)
				level = still->hasFunction()    ? std::numeric_limits<Real>::quiet_NaN()
				        : still->levels.empty() ? still->level
				                                : gimpm::LoadCurve(still->levels).valueAt(time);
		return count == 1 ? level : std::numeric_limits<Real>::quiet_NaN();
	}

	void requireStill(const Analysis& analysis)
	{
		for (const Listed& listed : analysis.conditions())
			if (const auto still = boost::dynamic_pointer_cast<MpmWater>(listed.condition); still && still->levels.size() > 1)
				throw std::invalid_argument(
				        listed.name()
				        + ".levels: MpmFlow computes the pressure over that of water which stands still, so that its level must stay; give level, and to a drain the pressure that changes.");
	}
}

template <int Dim> void Flows<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	if (model.processes->size() > 1) throw std::invalid_argument("MpmFlow cannot go with several processes yet: start the script with one.");
	requireStill(around.analysis);
	levelOfStillWater   = stillLevel(around.analysis, around.begin);
	water.modulus       = from->bulkModulus;
	water.stabilisation = from->stabilisation;
	water.ghost         = from->ghost;
	takePoints(around);
	takeNodes();
	takeDrains(model, around.analysis.gravity);
	Real sum = 0; // of constrained moduli
	for (size_t p = 0; p < around.cloud.size(); ++p)
		sum += gimpm::waveModuli(model.materials, around.cloud, int(p)).pressure / Real(around.cloud.size());
	model.fields.push_back(gimpm::pressureField(water, sum / model.grid.cellSize));
	model.coupledTerms.push_back([this, materials = model.materials](const gimpm::Beginning<Dim>& step, const gimpm::State&) {
		const auto constrained = [&](int p) { return gimpm::waveModuli(materials, step.cloud, p).pressure; };
		return std::make_unique<gimpm::Flow<Dim>>(water, constrained, step);
	});
}

template <int Dim> void Flows<Dim>::takePoints(const Surroundings<Dim>& around)
{
	for (size_t p = 0; p < around.points.size(); ++p) {
		const size_t material = around.cloud.material[p];
		if (water.pores.size() <= material) water.pores.resize(material + 1);
		auto& pores = water.pores[material];
		if (std::isnan(pores.porosity)) pores = poresOf(around.points[p], from->unitWeight);
		water.pressure.push_back(around.points[p].state->excessPressure);
		const Real J = around.cloud.volumeRatio(p);
		if (!pores.areOpen(J))
			refuseMaterial(
			        around.points[p],
			        "has porosity = " + textOf(pores.porosity) + ", and the point has now " + textOf(J)
			                + " of its initial volume: there is no room left for water.");
	}
}

template <int Dim> void Flows<Dim>::takeNodes()
{
	for (size_t i = 0; i + 3 < from->nodes.size(); i += 4) {
		gimpm::Index<Dim> node;
		for (int a = 0; a < Dim; ++a)
			node[a] = int(from->nodes[i + a]);
		water.atNodes[gimpm::Grid<Dim>::key(node)] = from->nodes[i + 3];
	}
}

template <int Dim> void Flows<Dim>::takeDrains(const gimpm::Model<Dim>& model, const Vector3r& gravity)
{
	// Against gravity, which MpmWater.level has checked to be along an axis.
	const Vector3r up = gravity.isZero(0) ? Vector3r(Vector3r::Unit(Dim - 1)) : Vector3r(-gravity.normalized());
	for (size_t i = 0; i < from->drains.size(); ++i) {
		const MpmDrain& drain = *from->drains[i];
		const string    name  = "flow.drains[" + std::to_string(i) + "]";
		requireDimension<Dim>(*drain.surface, name);
		if (!std::isnan(drain.level) && std::isnan(levelOfStillWater))
			throw std::invalid_argument(
			        name + ".level = " + textOf(drain.level)
			        + " is compared with the level of still water: it needs one MpmWater(level=...) in water, or give pressure.");
		if (!std::isnan(drain.level))
			for (const auto& x : drain.surface->vertices)
				if (up.dot(x) > drain.level + 1e-9 * model.grid.cellSize)
					throw std::invalid_argument(
					        name + ".level = " + textOf(drain.level) + " is below a vertex of its surface, at (" + textOf(x)
					        + "): end the surface there; what is above it may be a drain of its own with seepage=True.");
		gimpm::Drain<Dim> made;
		made.surface = coreSurface<Dim>(*drain.surface);
		made.surface.refine(gimpm::pieceLimit * model.grid.cellSize);
		made.kind        = !std::isnan(drain.flux) ? gimpm::Drain<Dim>::Kind::flux
		               : drain.seepage             ? gimpm::Drain<Dim>::Kind::seepage
		                                           : gimpm::Drain<Dim>::Kind::pressure;
		made.conductance = drain.conductance;
		made.name        = name;
		water.drains.push_back(std::move(made));
	}
}

template <int Dim> void Flows<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&)
{
	water.duration = step.to - step.from;
	for (size_t i = 0; i < from->drains.size(); ++i) {
		const MpmDrain& drain  = *from->drains[i];
		const Real      factor = drain.curve.empty() ? 1 : gimpm::LoadCurve(drain.curve).valueAt(step.looked);
		water.drains[i].given  = !std::isnan(drain.flux) ? factor * drain.flux
		         : !std::isnan(drain.level)              ? from->unitWeight * (drain.level - levelOfStillWater)
		                                                 : factor * drain.pressure;
	}
}

template <int Dim> void Flows<Dim>::reach(const StepOutcome<Dim>& step)
{
	for (size_t p = 0; p < step.points.size(); ++p) {
		MpmState& state      = *step.points[p].state;
		state.excessPressure = water.pressure[p];
		state.porePressure   = (std::isnan(state.porePressure) ? 0 : state.porePressure) + water.pressure[p];
		state.waterFlux.setZero();
		state.waterFlux.template head<Dim>() = water.flux[p];
	}
	from->nodes.clear();
	for (const auto& [key, pressure] : water.atNodes) {
		const auto place = gimpm::Grid<Dim>::index(key);
		for (int a = 0; a < 3; ++a)
			from->nodes.push_back(a < Dim ? place[a] : 0);
		from->nodes.push_back(pressure);
	}
	from->waterStored += water.stored;
	for (size_t i = 0; i < from->drains.size(); ++i) {
		const Real out = water.drains[i].out;
		(out > 0 ? from->waterOut : from->waterIn) += std::abs(out);
		from->drains[i]->discharge = out / water.duration;
		yade::scatter<Dim>(water.drains[i].surface, *from->drains[i]->surface);
	}
}

template class Flows<2>;
template class Flows<3>;

} // namespace yade
