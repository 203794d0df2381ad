// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/structures/beams.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/surface.hpp"
#include "core/structures/parting_lines.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/structures/parting.hpp"
#include "engine/conditions/structures/reinforcements.hpp"
#include "engine/conditions/surface/surfaces.hpp"
#include <numeric>

namespace yade {

namespace {
	using gimpm::Beam;
	using Vec2 = gimpm::Vec<2>;

	int nearestVertex(const Beam& beam, const Vec2& place)
	{
		int nearest = 0;
		for (int v = 1; v < int(beam.positions.size()); ++v)
			if ((beam.positions[v] - place).norm() < (beam.positions[nearest] - place).norm()) nearest = v;
		return nearest;
	}

	void goOn(Beam& beam, const MpmBeam& from)
	{
		beam.positions     = inDimension<2>(from.vertices);
		beam.turns         = from.rotations;
		beam.length0       = from.lengths;
		beam.radius0       = from.radii;
		beam.slope0        = from.slopes;
		beam.elongation    = from.elongations;
		const size_t count = beam.positions.size();
		for (const size_t side : { 0, 1 }) {
			const auto part  = [&](const vector<Real>& all) { return vector<Real>(all.begin() + side * count, all.begin() + (side + 1) * count); };
			beam.sides[side] = { part(from.normals), part(from.gaps), part(from.shears) };
		}
		beam.isStuck.assign(from.stuck.begin(), from.stuck.end());
		for (size_t i = 0; i < from.bonds.size(); ++i)
			beam.bonds[i / gimpm::bondsOfTip][i % gimpm::bondsOfTip] = { from.bonds[i][0] != 0, from.bonds[i][1], from.bonds[i][2] };
		beam.axialForce = from.axialForces;
		beam.shearForce = from.shearForces;
		for (size_t i = 0; i < beam.length0.size(); ++i)
			beam.bend.emplace_back(from.bends[2 * i], from.bends[2 * i + 1]);
		beam.moments.assign(beam.length0.size(), Vec2::Zero());
		beam.isHinge.assign(beam.positions.size(), 0);
	}

	Beam coreBeam(const MpmBeam& from, const string& name, const gimpm::Grid<2>& grid)
	{
		Beam beam;
		beam.name          = name;
		beam.isShell       = grid.axisymmetric;
		beam.section       = { from.axialStiffness, from.bendingStiffness, from.poisson };
		beam.plasticMoment = from.plasticMoment;
		beam.fixedHead     = MpmBeam::fixed(from.fixHead);
		beam.fixedFoot     = MpmBeam::fixed(from.fixFoot);
		beam.stiffness     = from.stiffness;
		beam.adhesion      = from.adhesion;
		beam.friction      = std::tan(from.friction);
		beam.isClosed      = from.line.front() == from.line.back();
		if (from.vertices.empty()) beam.begin(fineLine<2>(inDimension<2>(placesOf(from.line)), name, grid), from.prestress);
		else if (from.stuck.size() != from.vertices.size())
			throw std::invalid_argument(
			        name + " has been saved by an older revision, which knew nothing of the two sides of its soil: run its script again.");
		else if (grid.axisymmetric && from.radii.size() != from.vertices.size())
			throw std::invalid_argument(name + " has made steps in the plane, and MpmGrid.axisymmetric is True now: make a new MpmBeam.");
		else if (!grid.axisymmetric && !from.radii.empty())
			throw std::invalid_argument(name + " has made steps around an axis, and MpmGrid.axisymmetric is False now: make a new MpmBeam.");
		else
			goOn(beam, from);
		for (const Vector3r& hinge : placesOf(from.hinges))
			beam.isHinge[nearestVertex(beam, hinge.head<2>())] = 1;
		return beam;
	}

	// Features that do not go with soil parted by beams; empty: nothing.
	string cannotPart(const Analysis& analysis)
	{
		for (const Listed& listed : analysis.conditions())
			if (string(listed.list) == "contacts") return listed.name();
		if (!analysis.grid->hasEqualCells()) return "cells of several sizes";
		return obstacleToParting(analysis);
	}

	void scatterBeam(const Beam& beam, MpmBeam& to)
	{
		const size_t pieces = beam.length0.size();
		to.vertices         = inSpace<2>(beam.positions, placesOf(to.line).front()[2]);
		to.rotations        = beam.turns;
		to.lengths          = beam.length0;
		to.radii            = beam.radius0;
		to.slopes           = beam.slope0;
		to.elongations      = beam.elongation;
		to.stuck.assign(beam.isStuck.begin(), beam.isStuck.end());
		to.bonds.clear();
		for (const auto& tip : beam.bonds)
			for (const gimpm::TipBond& bond : tip)
				to.bonds.push_back(Vector3r(bond.isActive, bond.pressure, bond.shear));
		to.leftWaterPressures = beam.sides[0].water, to.rightWaterPressures = beam.sides[1].water;
		to.gaps.clear(), to.normals.clear(), to.shears.clear();
		for (const auto& side : beam.sides) {
			to.normals.insert(to.normals.end(), side.normalForce.begin(), side.normalForce.end());
			to.gaps.insert(to.gaps.end(), side.gap.begin(), side.gap.end());
			to.shears.insert(to.shears.end(), side.shearForce.begin(), side.shearForce.end());
		}
		to.axialForces = beam.axialForce;
		to.shearForces = beam.shearForce;
		to.hoopForces  = beam.hoopForce;
		to.bends.clear(), to.moments.clear(), to.hoopMoments.clear();
		to.pressures.clear(), to.leftPressures.clear(), to.rightPressures.clear();
		for (size_t i = 0; i < pieces; ++i) {
			to.bends.push_back(beam.bend[i][0]), to.bends.push_back(beam.bend[i][1]);
			to.moments.push_back(-beam.moments[i][0]);
		}
		to.moments.push_back(beam.moments.back()[1]);
		for (const Vec2& hoop : beam.hoopMoment)
			to.hoopMoments.push_back(hoop[0]);
		if (beam.isShell) to.hoopMoments.push_back(beam.hoopMoment.back()[1]);
		for (size_t v = 0; v <= pieces; ++v) {
			to.leftPressures.push_back(beam.sides[0].normalForce[v] / beam.sizeAt(int(v)));
			to.rightPressures.push_back(beam.sides[1].normalForce[v] / beam.sizeAt(int(v)));
			to.pressures.push_back(to.leftPressures.back() - to.rightPressures.back());
		}
	}

	// The anchor's head is where the vertex of the beam is that it is fixed to.
	gimpm::Reinforcement<2> coreAnchor(const MpmReinforcement& from, const string& name, const Beam& beam, const gimpm::Grid<2>& grid)
	{
		gimpm::Reinforcement<2> bar = coreBar<2>(from, name, grid);
		bar.head                    = gimpm::Reinforcement<2>::Head::joined;
		bar.joint                   = nearestVertex(beam, bar.positions.front());
		const Real away = (bar.positions.front() - beam.positions[bar.joint]).norm(), most = gimpm::lengthOfPieces * grid.cellSize;
		if (from.vertices.empty() && away > most)
			throw std::invalid_argument(
			        name + ".line begins at " + textOf(placesOf(from.line).front()) + ", " + textOf(away)
			        + " m away from the nearest vertex of the beam: at most " + textOf(most) + " m, half a cell, are admitted.");
		if (!from.vertices.empty()) return bar;
		bar.positions.front() = beam.positions[bar.joint];
		bar.length0.front()   = (bar.positions[1] - bar.positions[0]).norm();
		return bar;
	}
}

void Beams::join(gimpm::Model<2>& model, const Surroundings<2>& around)
{
	inItsWay       = cannotPart(around.analysis);
	processesCount = model.processes->size();
	flow           = MpmFlow::of(around.analysis);
	for (const Listed& listed : group) {
		const auto  from = boost::static_pointer_cast<MpmBeam>(listed.condition);
		const auto& down = around.analysis.gravity;
		sources.push_back({ from,
		                    around.analysis.curveOfLoad(from->curve),
		                    around.analysis.curveOfGravity(),
		                    down.isZero(0) ? Vec2(0, 0) : Vec2(down.normalized().head<2>()),
		                    {} });
		if (from->vertices.empty() && from->contraction > 0 && sources.back().curve.valueAt(around.begin) != 0)
			throw std::invalid_argument(gimpm::sentence(
			        listed.name(), ".contraction = ", from->contraction, ": the load factor is ", sources.back().curve.valueAt(around.begin),
			        " as the beam comes in, which has its lengths without stress then and would not contract. Give it a curve that begins at 0 then."));
		structures.emplace_back();
		structures.back().beam = coreBeam(*from, listed.name(), model.grid);
		if (flow) structures.back().beam->leakage = from->permittivity / flow->unitWeight, structures.back().beam->waterPulls = !flow->total;
		for (size_t i = 0; i < from->anchors.size(); ++i) {
			const string name = listed.name() + ".anchors[" + std::to_string(i) + "]";
			structures.back().bars.push_back(coreAnchor(*from->anchors[i], name, *structures.back().beam, model.grid));
			sources.back().ofAnchors.push_back(around.analysis.curveOfLoad(from->anchors[i]->curve));
		}
	}
	for (size_t i = 0; i < structures.size(); ++i) {
		auto& pressures = sources[i].from->waterPressures; // MpmWater sets them
		pressures.assign(structures[i].beam->positions.size(), 0);
		structures[i].beam->waterPressure = &pressures;
		joinStructure<2>(structures[i], model);
	}
}

vector<gimpm::PartingLine*> Beams::lines()
{
	vector<gimpm::PartingLine*> all;
	for (auto& structure : structures)
		all.push_back(&*structure.beam);
	return all;
}

void Beams::requirePermeable() const
{
	for (size_t i = 0; i < structures.size(); ++i) {
		const Beam& beam = *structures[i].beam;
		if (!flow || !beam.isBetween || beam.layer > 0 || std::isinf(sources[i].from->permittivity)) continue;
		throw std::invalid_argument(gimpm::sentence(
		        beam.name, ".permittivity = ", sources[i].from->permittivity, ": the soil on its two sides is one body, because of ",
		        inItsWay.empty() ? "five others near it" : inItsWay,
		        ", and water of MpmFlow passes it as if there were none. Leave that out, or give permittivity = inf."));
	}
}

// Several processes cannot share nodes with affine constraints, without which soil stays one body across a beam.
void Beams::requireWhole() const
{
	for (const auto& structure : structures)
		if (structure.beam->layer > 0)
			throw std::invalid_argument(gimpm::sentence(
			        structure.beam->name, ", an MpmBeam, has soil on both of its sides, which ", processesCount,
			        " processes cannot part as one does, so that its moments would be wrong. Start the script in one process, with more threads "
			        "(scripts/run -j)."));
}

void Beams::part(gimpm::PointCloud<2>& cloud, gimpm::Model<2>& model)
{
	if (!inItsWay.empty()) gimpm::lookBetween(lines(), cloud, model.grid);
	else
		gimpm::partSoil(lines(), cloud, model.grid, true);
	requirePermeable();
	if (processesCount > 1) requireWhole();
	sides = gimpm::sidesOf(lines(), cloud.position, model.grid.cellSize);
}

void Beams::advance(const StepTime& step, gimpm::Model<2>&, gimpm::Load<2>&)
{
	for (size_t i = 0; i < sources.size(); ++i) {
		const MpmBeam& from   = *sources[i].from;
		const Real     factor = sources[i].curve.valueAt(step.to);
		Beam&          beam   = *structures[i].beam;
		const Real     before = sources[i].curve.valueAt(step.from);
		const Vec2     weight = from.weight * sources[i].down;
		beam.headForce        = factor * from.headForce.head<2>();
		beam.headMoment       = factor * from.headMoment;
		beam.weight           = sources[i].ofGravity.valueAt(step.to) * weight;
		beam.before           = { sources[i].ofGravity.valueAt(step.from) * weight, before * from.headForce.head<2>(), before * from.headMoment };
		if (!(from.contraction * factor < 1))
			throw std::invalid_argument(gimpm::sentence(
			        "MpmBeam.contraction = ", from.contraction, " times the load factor ", factor,
			        " is not below 1: nothing of the ring would be left."));
		beam.shrinkage = std::sqrt((1 - from.contraction * factor) / (1 - from.contraction * before));
		for (size_t a = 0; a < from.anchors.size(); ++a)
			loadBar<2>(structures[i].bars[a], *from.anchors[a], sources[i].ofAnchors[a], step);
	}
}

// Halves of a point stay on its side of a beam that parts the soil.
bool Beams::areBeside(const gimpm::Vec<2>& point, const gimpm::Vec<2>& half) const
{
	return std::none_of(structures.begin(), structures.end(), [&](const auto& structure) {
		const Beam&       beam = *structure.beam;
		gimpm::Surface<2> line;
		line.vertices = beam.positions;
		for (int i = 0; i + 1 < int(beam.positions.size()); ++i)
			line.pieces.push_back({ i, i + 1 });
		return beam.layer > 0 && line.isBetween(point, half);
	});
}

Work Beams::work(const StepOutcome<2>&) const
{
	Work sum;
	for (const auto& structure : structures)
		sum.ofLoads += structure.work;
	return sum;
}

namespace {
	// Points that are on the other side of a beam than as the step began.
	vector<size_t> crossedIn(const StepOutcome<2>& step, const vector<gimpm::PartingLine*>& lines, const vector<int>& before)
	{
		vector<gimpm::Vec<2>> places;
		for (const MaterialPoint& point : step.points)
			places.push_back(point.state->pos.head<2>());
		const auto     after = gimpm::sidesOf(lines, places, step.model.grid.cellSize);
		vector<size_t> crossed(lines.size(), 0);
		for (size_t p = 0; p < before.size(); ++p)
			for (size_t b = 0; b < lines.size() && before[p] != 0; ++b)
				crossed[b] += std::abs(before[p]) == int(b) + 1 && after[p] == -before[p];
		return crossed;
	}
}

void Beams::reach(const StepOutcome<2>& step)
{
	if (inItsWay.empty()) {
		const auto now = crossedIn(step, lines(), sides);
		crossed.resize(now.size(), 0);
		std::transform(now.begin(), now.end(), crossed.begin(), crossed.begin(), std::plus<>());
	}
	for (size_t i = 0; i < sources.size(); ++i) {
		scatterBeam(*structures[i].beam, *sources[i].from);
		for (size_t a = 0; a < structures[i].bars.size(); ++a)
			scatterBar<2>(structures[i].bars[a], *sources[i].from->anchors[a]);
	}
}

namespace {
	// Part of the force of the soil on a side of a beam that its vertex at a tip bears alone, if it is larger than
	// that of a linear pressure; else 0. Stricter where the soil is much deeper on the other side, as in a pit.
	Real shareOfTip(const Beam& beam, int end, int side)
	{
		constexpr Real much = 0.25, overLinear = 1.4;
		constexpr int  fewest  = 4;
		const auto     pressed = [&](int of) {
                        const auto& forces = beam.sides[of].normalForce;
                        return int(std::count_if(forces.begin(), forces.end(), [](Real f) { return f > 0; }));
		};
		const auto& forces = beam.sides[side].normalForce;
		const int   count  = pressed(side);
		const Real  sum    = std::accumulate(forces.begin(), forces.end(), Real(0));
		if (count < fewest || !(sum > 0)) return 0;
		const Real share = (end == 0 ? forces.front() : forces.back()) / sum;
		const Real limit = 2 * count <= pressed(1 - side) ? overLinear / (count - 1) : std::max(much, overLinear / count);
		return share > limit ? share : 0;
	}

	// The same of both sides, of a tip in the soil. A vertex that is held bears what it must.
	Real shareOfTip(const Beam& beam, int end)
	{
		const auto&         held  = end == 0 ? beam.fixedHead : beam.fixedFoot;
		const gimpm::Vec<2> along = beam.outwardsAt(end);
		if (beam.layer == 0 || !beam.isTip[end] || held[std::abs(along[0]) > std::abs(along[1]) ? 1 : 0]) return 0;
		return std::max(shareOfTip(beam, end, 0), shareOfTip(beam, end, 1));
	}
}

std::map<string, string> Beams::warnings() const
{
	std::map<string, string> found;
	for (size_t i = 0; i < structures.size(); ++i) {
		const Beam& beam = *structures[i].beam;
		if (beam.isBetween && beam.layer == 0)
			found["beside " + beam.name] = gimpm::sentence(
			        beam.name,
			        " has soil on both of its sides, which stays one body, as rough along the beam as it is itself: beams do not part it beside ",
			        inItsWay.empty() ? "five others near them, nor where they are hardly longer than a cell" : inItsWay,
			        ". Pressures and moments of a wall are too small then.");
		for (const int end : { 0, 1 })
			if (const Real share = shareOfTip(beam, end); share > 0)
				found["tip of " + beam.name] = gimpm::sentence(
				        "the vertex of ", beam.name, " at (", (end == 0 ? beam.positions.front() : beam.positions.back()).transpose(),
				        ") bears ", std::lround(100 * share),
				        " % of the force of the soil on one of its sides. Soil does not slip past a tip within its cell and resists as if the wall were longer, "
				        "by up to two cells, so that it may stand on its tip where limit equilibrium says that it falls: compare with a hand calculation before "
				        "relying on it.");
		if (i < crossed.size() && crossed[i] > 0)
			found["through " + beam.name] = gimpm::sentence(
			        crossed[i], crossed[i] == 1 ? " material point has" : " material points have", " gone through ", beam.name,
			        " in a step and count for the soil on its other side now. Shorter steps, or a larger MpmBeam.stiffness, keep soil on its side.");
	}
	return found;
}

} // namespace yade
