// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/flows.hpp"
#include "core/terms/inertia/absorbing.hpp"
#include "core/terms/water/flow.hpp"
#include "core/terms/water/frozen_pressures.hpp"
#include "engine/analysis/last_increment.hpp"
#include "engine/conditions/surface/surfaces.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/materials/retention/curveParameters.hpp"

namespace yade {

namespace {
	[[noreturn]] void refuseMaterial(const MaterialPoint& point, const string& what)
	{
		throw std::invalid_argument("Body #" + std::to_string(point.id) + ": its material '" + point.material->label + "' " + what);
	}

	// Pores of a material as the point has it.
	gimpm::Pores poresOf(const MaterialPoint& point, const MpmMaterial& m, Real unitWeight)
	{
		if (m.undrained)
			refuseMaterial(
			        point,
			        "is undrained = True: no water can leave it, while MpmFlow lets it flow; for soil that lets none through give conductivity=0.");
		if (std::isnan(m.conductivity.horizontal))
			refuseMaterial(point, "has no conductivity [m/s], which MpmFlow needs: 1e-2 (gravel) to 1e-11 (clay), or 0 where nothing passes.");
		if (std::isnan(m.porosity)) refuseMaterial(point, "has no porosity [-], which MpmFlow needs: 0.3 (dense sand) to 0.7 (soft clay).");
		if (point.material->conductivity.isPair() && point.state->parameter("conductivity") && !point.state->parameter("verticalConductivity"))
			refuseMaterial(
			        point,
			        "has conductivity = " + textOf(point.material->conductivity)
			                + ", and the point has one of its own that is a single number: give points verticalConductivity, too (mpm.assign), or the material one number.");
		gimpm::Pores pores { m.conductivity.horizontal / unitWeight, m.porosity };
		pores.verticalRatio = m.conductivity.ratio();
		pores.areRigid      = point.material->isDugOut;
		pores.weightPart    = point.material->share;
		if (m.conductivityLaw == "kozeny-carman") pores.law = gimpm::Pores::Law::kozenyCarman;
		if (m.conductivityLaw == "log") pores.law = gimpm::Pores::Law::logarithmic, pores.index = m.conductivityIndex;
		return pores;
	}

	// Refuses in all processes what is wrong with points that only one of them has.
	template <class F> void refusingTogether(const gimpm::Division& division, F&& take)
	{
		string refusal;
		try {
			take();
		} catch (const std::exception& refused) {
			refusal = refused.what();
		}
		refusal = division.firstSaid(refusal);
		if (!refusal.empty()) throw std::invalid_argument(refusal);
	}

	// The water in the pores that has a level, if it is the only one there; null: there is none.
	shared_ptr<MpmWater> stillWater(const Analysis& analysis)
	{
		vector<shared_ptr<MpmWater>> all;
		for (const Listed& listed : analysis.conditions()) {
			const auto water = boost::dynamic_pointer_cast<MpmWater>(listed.condition);
			if (!water || water->where == "outside") continue;
			if (water->levels.size() > 1)
				throw std::invalid_argument(
				        listed.name()
				        + ".levels: MpmFlow computes the pressure over that of water which stands still, so that its level must stay: give level, and to a "
				          "drain the levels. Water that loads the surface may change: where = 'outside'.");
			if (water->changes)
				throw std::invalid_argument(
				        listed.name()
				        + ".pressure changes with time: MpmFlow computes the pressure over that of water which stands still. Give one that stays, and to a drain "
				          "the levels. Water that loads the surface may change: where = 'outside'.");
			all.push_back(water);
		}
		return all.size() == 1 && !all[0]->hasFunction() ? all[0] : nullptr;
	}

	Real heightOf(const MpmWater& still) { return still.levels.empty() ? still.level : still.levels[0].second; }

	// Above still water pores are taken for full without a pressure of their own.
	void requireBelow(const MpmDrain& drain, const string& name, Real still, Real soil)
	{
		Real most = drain.levels.empty() ? drain.level : drain.levels[0].second;
		for (const auto& [time, level] : drain.levels)
			most = std::max(most, level);
		if (most <= still || soil <= still) return;
		throw std::invalid_argument(
		        name + (drain.levels.empty() ? ".level is " : ".levels reach ") + textOf(most)
		        + " m, above the still water in the pores, whose level is " + textOf(still) + " m, and there is soil up to " + textOf(soil)
		        + " m: give that MpmWater the highest level that there will be.");
	}
}

template <int Dim> void Flows<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	constexpr Real ofSteadySoil = 1, ofSoilThatMoves = 0.1;
	lattice             = model.grid;
	still               = stillWater(around.analysis);
	water.modulus       = from->bulkModulus;
	water.stabilisation = !std::isnan(from->stabilisation) ? from->stabilisation : around.analysis.isDynamic() ? ofSoilThatMoves : ofSteadySoil;
	water.ghost         = from->ghost;
	if (const Vector3r& gravity = around.analysis.gravity; !gravity.isZero(0)) water.vertical = gravity.normalized().template head<Dim>();
	if (const Real tolerance = around.analysis.newton->stepTolerance; tolerance > 0)
		water.displacementTolerance = tolerance, water.pressureTolerance = from->pressureTolerance;
	water.keepsGrowth = !around.analysis.isDynamic() || std::isfinite(water.displacementTolerance);
	if (from->total) beginWhole(around);
	refusingTogether(*model.division, [&] { takePoints(around, *model.division); });
	pressuresAreNew = model.division->largest(pressuresAreNew ? 1 : 0) > 0;
	if (pressuresAreNew) fillNewPoints(around.cloud, *model.division);
	takeNodes();
	takeDrains(model, around);
	const Real modulus = meanModulus(model, around);
	isRamp             = !around.analysis.isDynamic() && around.analysis.loadCurve == gimpm::LoadCurve::Knees { { 0, 0 }, { 1, 1 } };
	model.fields.push_back(gimpm::pressureField(water, *model.division, modulus / model.grid.cellSize));
	model.coupledTerms.push_back([this, materials = model.materials](const gimpm::StepContext<Dim>& step, const gimpm::State& begin) {
		const auto constrained = [&](int p) { return gimpm::waveModuli(materials, step.cloud, p).pressure; };
		return std::make_unique<gimpm::Flow<Dim>>(water, constrained, step, begin);
	});
	model.water  = [this](const gimpm::CloudBasis<Dim>& basis, const Eigen::VectorXd* field) { return pressing(basis, field); };
	model.freeze = [this, field = model.fields.size() - 1, term = model.coupledTerms.size() - 1](gimpm::Model<Dim>& at) {
		at.fields.erase(at.fields.begin() + field);
		at.coupledTerms.erase(at.coupledTerms.begin() + term);
		at.terms.push_back([this](const gimpm::StepContext<Dim>& step) { return frozen(step); });
	};
}

// Constrained modulus; sets the time in which pressures spread over a cell.
template <int Dim> Real Flows<Dim>::meanModulus(const gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	Real       sum = 0, fastest = 0; // sum of constrained moduli; largest coefficient of consolidation
	const Real count = model.division->sum(Real(around.cloud.size()));
	for (size_t p = 0; p < around.cloud.size(); ++p) {
		const Real modulus = gimpm::waveModuli(model.materials, around.cloud, int(p)).pressure;
		sum += modulus / count;
		const gimpm::Pores& pores = water.ownPores.empty() ? water.pores[around.cloud.material[p]] : water.ownPores[p];
		fastest                   = std::max(fastest, modulus * pores.conductivity * pores.largestRatio());
	}
	acrossCell = std::pow(model.grid.cellSize, 2) / model.division->largest(fastest);
	return model.division->sum(sum);
}

// Suction pulls at nothing beside the soil: air gets there.
template <int Dim> Eigen::VectorXd Flows<Dim>::pressing(const gimpm::CloudBasis<Dim>& basis, const Eigen::VectorXd* field) const
{
	Eigen::VectorXd pressures;
	if (field) pressures = *field;
	else {
		pressures = Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size()));
		for (size_t n = 0; n < basis.nodes.size(); ++n)
			if (const auto known = water.atNodes.find(basis.nodes[n]); known != water.atNodes.end()) pressures[n] = known->second;
		basis.affineConstraints.template distribute<1>(pressures);
	}
	return water.whole ? pressures.cwiseMax(0).eval() : pressures;
}

// Takes the own points of each process where they are divided: the copies of others may be of materials that are not
// known here.
template <int Dim> void Flows<Dim>::takePoints(const Surroundings<Dim>& around, const gimpm::Division& division)
{
	const auto& points = around.points;
	const bool  differ = !division.isWhole() || std::any_of(points.begin(), points.end(), [&](const MaterialPoint& point) {
                const auto& own = point.state->parameters;
                return hasOwnCurve(*point.material, own) || std::any_of(parametersOfPores().begin(), parametersOfPores().end(), [&](const auto& known) {
                               return point.state->parameter(known.name);
                       });
        });
	OwnMaterial own;
	for (size_t p = 0; p < points.size(); ++p) {
		const size_t material = around.cloud.material[p];
		if (water.pores.size() <= material) water.pores.resize(material + 1);
		gimpm::Pores&      ofMaterial = water.pores[material];
		const MpmMaterial& asPoint    = differ ? own.of(*points[p].material, points[p].state->parameters) : *points[p].material;
		if (differ) water.ownPores.push_back(poresOf(points[p], asPoint, from->unitWeight));
		else if (std::isnan(ofMaterial.porosity))
			ofMaterial = poresOf(points[p], asPoint, from->unitWeight);
		gimpm::Pores& pores = differ ? water.ownPores.back() : ofMaterial;
		takeCurve(points[p], asPoint, pores);
		if (water.whole) water.whole->saturation.push_back(points[p].state->saturation), pressuresAreNew |= std::isnan(points[p].state->saturation);
		water.pressure.push_back(points[p].state->excessPressure);
		const Real J = around.cloud.volumeRatio(p);
		if (!pores.areOpen(J))
			refuseMaterial(
			        points[p],
			        "has porosity = " + textOf(pores.porosity) + ", and the point has now " + textOf(J)
			                + " of its initial volume: there is no room left for water.");
	}
}

// Pressures that points have been given count, not what the nodes had before.
template <int Dim> void Flows<Dim>::takeNodes()
{
	if (pressuresAreNew) return;
	for (size_t i = 0; i + 3 < from->nodes.size(); i += 4) {
		const auto key = nodeAt<Dim>(&from->nodes[i], lattice);
		if (!key) continue; // cells have changed
		water.atNodes[*key] = from->nodes[i + 3];
		if (water.keepsGrowth && from->growth.size() == from->nodes.size())
			water.growth[*key] << Eigen::Map<const gimpm::Vec<Dim>>(&from->growth[i]), from->growth[i + 3];
	}
	if (!water.growth.empty()) water.lastDuration = from->lastDuration;
}

template <int Dim> void Flows<Dim>::takeDrains(const gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	// Against gravity, which MpmWater.level has checked to be along an axis.
	const Vector3r& gravity = around.analysis.gravity;
	const Vector3r  up      = gravity.isZero(0) ? Vector3r(Vector3r::Unit(Dim - 1)) : Vector3r(-gravity.normalized());
	int             axis    = 0;
	up.cwiseAbs().maxCoeff(&axis);
	Real highest = -std::numeric_limits<Real>::infinity();
	for (const auto& x : around.cloud.position)
		highest = std::max(highest, up[axis] * x[axis]);
	highest = model.division->largest(highest);
	for (size_t i = 0; i < from->drains.size(); ++i) {
		const MpmDrain& drain = *from->drains[i];
		const string    name  = "flow.drains[" + std::to_string(i) + "]";
		requireDimension<Dim>(*drain.surface, name);
		if (!std::isnan(drain.rain) && !from->total)
			throw std::invalid_argument(
			        name + ".rain = " + textOf(drain.rain)
			        + " needs MpmFlow(total=True), by which pressures are those of the water; or give flux.");
		if (drain.hasLevel() && !still && !from->total)
			throw std::invalid_argument(
			        name + (drain.levels.empty() ? ".level = " + textOf(drain.level) : string(".levels"))
			        + " is compared with the level of still water: it needs one MpmWater(level=...) in water, or give pressure.");
		if (drain.hasLevel() && still) requireBelow(drain, name, heightOf(*still), highest);
		gimpm::Drain<Dim> made;
		made.surface = coreSurface<Dim>(*drain.surface);
		made.surface.refine(gimpm::pieceLimit * model.grid.cellSize);
		made.kind        = !std::isnan(drain.flux) ? gimpm::Drain<Dim>::Kind::flux
		               : !std::isnan(drain.rain)   ? gimpm::Drain<Dim>::Kind::rain
		               : drain.seepage             ? gimpm::Drain<Dim>::Kind::seepage
		                                           : gimpm::Drain<Dim>::Kind::pressure;
		made.conductance = drain.conductance;
		made.driest      = drain.driest;
		made.name        = name;
		const Real none  = std::numeric_limits<Real>::quiet_NaN();
		if (drain.hasLevel()) made.level = { drain.levelAt(around.begin), still ? heightOf(*still) : none, from->unitWeight, axis, up[axis] };
		water.drains.push_back(std::move(made));
	}
}

template <int Dim> std::map<string, string> Flows<Dim>::warnings() const
{
	constexpr Real           oscillates = 0.25, hardlyFlows = 1e-3, vacuum = -101e3; // [Pa] below the pressure of the air
	std::map<string, string> found;
	if (water.stabilisation == 0 && shortest < oscillates * acrossCell && !std::isfinite(water.modulus))
		found["flow.stabilisation"] = "flow.stabilisation = 0 with steps of " + textOf(shortest)
		        + " s: below cellSize^2 / (4 c_v) = " + textOf(oscillates * acrossCell)
		        + " s, with the coefficient of consolidation c_v, pressures change from node to node. Leave stabilisation at its default, or take longer steps.";
	if (lowest < vacuum)
		found["cavitation"] = "flow: the pressure of the water has fallen to " + textOf(lowest) + " Pa where pores are always full. Below "
		        + textOf(vacuum)
		        + " Pa water boils and pulls no more, so that soil which dilates before water can come is weaker than here: give a smaller dilationAngle, or "
		          "with total = True materials a retention.";
	if (isRamp && shortest < 1 && shortest < hardlyFlows * acrossCell)
		found["steps of flow"] = "O.dt = " + textOf(shortest)
		        + ": is it a part of the load? With flow it is a time [s], in which pressures would spread over "
		        + textOf(std::sqrt(shortest / acrossCell))
		        + " of a cell, and the default loadCurve lets the loads grow within one second: give a loadCurve in seconds.";
	return found;
}

template <int Dim> void Flows<Dim>::joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real) { water.wantsWork = true; }

template <int Dim> Work Flows<Dim>::work(const StepOutcome<Dim>&) const
{
	Work sum;
	sum.ofLoads = water.work;
	return sum;
}

template <int Dim> void Flows<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>& load)
{
	if (water.whole) water.whole->factor = load.ofGravity.value_or(load.factor).value;
	water.duration = step.to - step.from;
	shortest       = std::min(shortest, water.duration);
	for (size_t i = 0; i < from->drains.size(); ++i) {
		const MpmDrain& drain  = *from->drains[i];
		const Real      factor = drain.curve.empty() ? 1 : gimpm::LoadCurve(drain.curve).valueAt(step.looked);
		water.drains[i].given  = factor * (!std::isnan(drain.rain) ? drain.rain : !std::isnan(drain.flux) ? drain.flux : drain.pressure);
		if (auto& level = water.drains[i].level) level->height = drain.levelAt(step.looked);
	}
}

// Growth is that of the same nodes. Tied ones are left out: theirs follows from others.
template <int Dim> void Flows<Dim>::keepNodes()
{
	from->nodes.assign(4 * water.atNodes.size(), 0);
	Real* place = from->nodes.data();
	for (const auto& [key, pressure] : water.atNodes) {
		putPlace(key, lattice, place);
		place[3] = pressure, place += 4;
	}
	from->growth.clear();
	for (const auto& [key, grown] : water.growth) {
		for (int a = 0; a < 3; ++a)
			from->growth.push_back(a < Dim ? grown[a] : 0);
		from->growth.push_back(grown[Dim]);
	}
	from->lastDuration = water.lastDuration;
}

template <int Dim> void Flows<Dim>::reach(const StepOutcome<Dim>& step)
{
	const PointWriter writer { PointWriter::OfResults() };
	for (size_t p = 0; p < step.points.size(); ++p) {
		MpmState& state      = writer.state(step.points[p]);
		state.excessPressure = water.pressure[p];
		state.porePressure   = (std::isnan(state.porePressure) ? 0 : state.porePressure) + water.pressure[p];
		if (water.whole) state.saturation = water.whole->saturation[p], state.pressureOnGrains = water.whole->push[p];
		if ((still || water.whole) && !step.points[p].material->retention) lowest = std::min(lowest, state.porePressure);
		state.waterFlux.setZero();
		state.waterFlux.template head<Dim>() = water.flux[p];
	}
	keepNodes();
	from->work += water.work;
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
