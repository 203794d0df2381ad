// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/plotData.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/energies.hpp"
#include "yade_api/value_lock.hpp"
#include <numeric>

namespace yade {

namespace {
	constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

	// Over all material points.
	struct Totals {
		Real     points  = 0;
		Real     volume0 = 0, plasticVolume0 = 0, elasticEnergy = 0, largestDisplacement = 0, settlement = -std::numeric_limits<Real>::infinity();
		Vector3r massTimesDisplacement = Vector3r::Zero();
	};

	Totals totals(const vector<MaterialPoint>& points, const Vector3r& gravity)
	{
		Totals         t;
		const Vector3r down = gravity.normalized(); // zero without gravity
		t.points            = Real(points.size());
		for (const MaterialPoint& point : points) {
			const MpmState& state        = *point.state;
			const Vector3r  displacement = state.pos - state.refPos;
			t.volume0 += state.volume0;
			if (state.plasticStrain > 0) t.plasticVolume0 += state.volume0;
			t.elasticEnergy += elasticEnergy(point);
			t.massTimesDisplacement += point.material->density * state.volume0 * displacement;
			t.largestDisplacement = std::max(t.largestDisplacement, displacement.norm());
			t.settlement          = std::max(t.settlement, displacement.dot(down));
		}
		if (!isElasticEnergyKnown(points)) t.elasticEnergy = unknown;
		return t;
	}

	// Totals with the points in other processes.
	Totals ofAll(Totals t, const gimpm::Processes& all)
	{
		vector<Real> sums { t.points, t.volume0, t.plasticVolume0, t.elasticEnergy };
		sums.insert(sums.end(), t.massTimesDisplacement.data(), t.massTimesDisplacement.data() + 3);
		gimpm::addUp(all, sums.data(), int(sums.size()));
		t.points = sums[0], t.volume0 = sums[1], t.plasticVolume0 = sums[2], t.elasticEnergy = sums[3];
		t.massTimesDisplacement = Vector3r(sums[4], sums[5], sums[6]);
		const Real own[2]       = { t.largestDisplacement, t.settlement };
		const auto largest      = gimpm::ofEach(all, own, 2);
		for (size_t i = 0; i < largest.size(); i += 2) {
			t.largestDisplacement = std::max(t.largestDisplacement, largest[i]);
			t.settlement          = std::max(t.settlement, largest[i + 1]);
		}
		return t;
	}
}

py::dict plotData(const Analysis& engine)
{
	const ValueLock lock;
	engine.requireAttributes();
	const auto     points    = materialPoints(*engine.ownScene(), engine.mask);
	const auto&    reactions = engine.reactions;
	const Totals   own       = totals(points, engine.gravity);
	const Totals   t         = ofAll(own, *holdersOf(engine));
	const bool     isKnown   = reactions.size() == engine.countOf("boundaries");
	const Vector3r total     = std::accumulate(reactions.begin(), reactions.end(), Vector3r(Vector3r::Zero()));
	py::dict       data;
	engine.tell(data, RunResults::byReportAndPlot);
	data["step"]             = engine.runs();
	data["points"]           = size_t(t.points);
	data["settlement"]       = t.points == 0 || engine.gravity.isZero(0) ? unknown : t.settlement;
	data["displacement"]     = t.points == 0 ? unknown : t.largestDisplacement;
	data["plasticShare"]     = t.points == 0 ? unknown : t.plasticVolume0 / t.volume0;
	data["elasticEnergy"]    = t.elasticEnergy;
	data["gravityPotential"] = -engine.curveOfGravity().valueAt(engine.loadTime) * engine.gravity.dot(t.massTimesDisplacement);
	for (int axis = 0; axis < engine.grid->dim; ++axis)
		data[string("reaction_") + "xyz"[axis]] = isKnown && !reactions.empty() ? total[axis] : unknown;
	Rows rows(data);
	for (const Listed& listed : engine.conditions())
		listed.condition->tell(rows, engine, listed);
	engine.tellMotion(data);
	return data;
}

void addPlotData(py::object pythonClass, const py::object& function)
{
	py::objects::add_to_namespace(
	        pythonClass, "plotData", function,
	        "plotData() -> dict\n\nNumbers of the current state for YADE's plot: plot.addData(**solver.plotData()). They are worked out in the call, NaN "
	        "where there is no such number.\n\n"
	        "step: load steps made; loadFactor [-], iterations, cuts, residual [-]: of the last step; points: their number; settlement: largest displacement "
	        "along gravity [m]; displacement: the largest in any direction [m]; plasticShare: part of the initial volume with plasticStrain > 0 [-]; ghostShare: the attribute; "
	        "elasticEnergy: strain energy of linear (Hencky) elasticity [J], NaN where a material has another elasticity; gravityPotential: minus weight (times its load factor) times displacement, summed "
	        "over the points [J], zero at the initial positions; reaction_x, reaction_y and, in 3D, reaction_z: sum of the attribute *reactions* [N]; "
	        "reaction0_y: that of boundaries[0], for all directions that a boundary fixes; load0_y: resultant of loads[0], for all directions [N]; contact0_y: force of the soil on all bodies of contacts[0] [N], contact0_touching: corners that touch them; body7_y, body7_torque_z: force [N] and torque [N m] on body 7, if it does not move freely. With *flow* waterIn, waterOut, waterStored: volumes of water since the first step [m³]; drain0: discharge of flow.drains[0] [m³/s].\n\n"
	        "Of a MpmDynamicEngine also absorbing0_y: force of absorbing[0] on the body, for all directions [N]; momentum_x, momentum_y [kg m/s]; angularMomentum_z, about the origin [kg m²/s]; kineticEnergy; loadWork, boundaryWork, "
	        "contactWork, impactWork, ghostWork, gridWork, plasticWork, dampingWork, frictionWork, penaltyWork, loosePoints: its attributes; energyImbalance: kinetic and elastic energy less those before the first step and less what was added "
	        "and taken since, all [J], NaN where elasticEnergy is.\n\nEnergies and forces are per metre of thickness in plane "
	        "strain.\n\nRaises ValueError for a body that is no complete material point.");
}

} // namespace yade
