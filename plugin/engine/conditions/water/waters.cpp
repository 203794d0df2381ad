// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/waters.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/points/parallel.hpp"

namespace yade {

namespace {
	// Against which direction of the grid gravity acts: axis, and the sign of heights.
	template <int Dim> std::pair<int, Real> upwards(const Vector3r& gravity, const gimpm::Grid<Dim>& grid, const string& name)
	{
		const Eigen::Array<bool, 3, 1> acts = gravity.array() != 0;
		if (acts.count() > 1 || (Dim == 2 && acts[2]))
			throw std::invalid_argument(
			        name + " has a level, but gravity = " + textOf(gravity)
			        + " is not along an axis of the grid: give pressure, a function of the position.");
		int axis = Dim - 1;
		for (int a = 0; a < Dim; ++a)
			if (acts[a]) axis = a;
		if (grid.period[axis] != 0)
			throw std::invalid_argument(name + " has a level, but the grid repeats itself upwards: give pressure, a function of the position.");
		return { axis, gravity[axis] > 0 ? -1 : 1 };
	}

	gimpm::WaterDomain placeOf(const MpmWater& water)
	{
		if (water.where == "pores") return gimpm::WaterDomain::pores;
		return water.where == "outside" ? gimpm::WaterDomain::outside : gimpm::WaterDomain::everywhere;
	}
}

template <int Dim>
void Waters<Dim>::take(
        const Analysis& analysis, const gimpm::Grid<Dim>& grid, const gimpm::PointCloud<Dim>& cloud, const gimpm::Division& division, Real begin, Real end,
        vector<WallInWater> among)
{
	const auto waterOf  = [](const Listed& listed) { return boost::static_pointer_cast<MpmWater>(listed.condition); };
	const bool areAsked = std::any_of(group.begin(), group.end(), [&](const Listed& listed) { return waterOf(listed)->hasFunction(); });
	if (areAsked) walls = std::move(among);
	if (grid.refinement && !walls.empty())
		throw std::invalid_argument(
		        group.front().name()
		        + ".pressure, a function, knows the two sides of beams on equal cells only: leave MpmGrid.refinements and adaptation out, or take MpmFlow.");
	const auto cells = areAsked ? cellsOf(cloud, grid, division) : vector<gimpm::Key>();
	for (const Listed& listed : group) {
		const auto water = waterOf(listed);
		Source     source { water, analysis.curveOfWeight(water->curve), nullptr, 0, 1, grid.cellSize };
		if (water->hasFunction()) source.given = std::make_shared<PressureInTime<Dim>>(*water, grid, cells, listed.name(), begin, end, walls);
		else
			std::tie(source.axis, source.up) = upwards(analysis.gravity, grid, listed.name());
		sources.push_back(source);
		waters.push_back({ placeOf(*water) });
	}
}

template <int Dim> void Waters<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	vector<WallInWater> among;
	if constexpr (Dim == 2) among = wallsInWater(around.analysis.conditions(), model.grid);
	take(around.analysis, model.grid, around.cloud, *model.division, around.begin, around.target, std::move(among));
	for (auto& water : waters) {
		water.shares = model.shares;
		model.terms.push_back([&water](const gimpm::StepContext<Dim>& step) { return std::make_unique<gimpm::WaterForce<Dim>>(water, step); });
	}
}

template <int Dim>
auto Waters<Dim>::around(const gimpm::Vec<Dim>& x, const gimpm::Vec<Dim>& half) const
        -> vector<std::pair<gimpm::WaterDomain, std::optional<gimpm::PressureAround<Dim>>>>
{
	vector<std::pair<gimpm::WaterDomain, std::optional<gimpm::PressureAround<Dim>>>> found;
	for (const auto& water : waters) {
		auto around = water.pressure->around(x, half);
		if (around) around->value *= water.factor, around->gradient *= water.factor;
		found.emplace_back(water.domain, around);
	}
	return found;
}

template <int Dim> auto Waters<Dim>::pressureAt(const Source& source, Real time) const -> Pressure
{
	if (source.given) return source.given->at(time);
	const MpmWater& water = *source.from;
	const Real      level = water.levels.empty() ? water.level : gimpm::LoadCurve(water.levels).valueAt(time);
	return std::make_shared<gimpm::StillWater<Dim>>(source.axis, source.up, level, water.weight);
}

template <int Dim> void Waters<Dim>::advance(Real from, Real to)
{
	for (size_t i = 0; i < waters.size(); ++i) {
		waters[i].before       = pressureAt(sources[i], from);
		waters[i].pressure     = pressureAt(sources[i], to);
		waters[i].factorBefore = sources[i].curve.valueAt(from);
		waters[i].factor       = sources[i].curve.valueAt(to);
	}
	if constexpr (Dim == 2)
		if (!walls.empty()) pressOnWalls(from, to);
}

// Lets beams bear the jump of a function's pressure across them: soil knows that of its own side.
template <int Dim> void Waters<Dim>::pressOnWalls(Real from, Real to)
{
	for (const WallInWater& wall : walls)
		wall.beam->waterPressures.assign(wall.left.size(), 0);
	for (size_t i = 0; i < waters.size(); ++i) {
		auto& water = waters[i];
		water.beside.assign(2 * walls.size(), nullptr), water.besideBefore = water.beside;
		water.sideOf = nullptr;
		for (size_t w = 0; w < walls.size() && sources[i].given; ++w) {
			const auto&        given = *sources[i].given;
			const vector<Real> jumps = given.jumps(walls[w], to);
			if (jumps.empty() && given.jumps(walls[w], from).empty()) continue;
			for (const int side : { 0, 1 }) {
				water.beside[2 * w + side]       = given.beside(walls[w], side, to);
				water.besideBefore[2 * w + side] = given.beside(walls[w], side, from);
			}
			if constexpr (Dim == 2) water.sideOf = SideOfWalls(walls, sources[i].cellSize);
			for (size_t v = 0; v < jumps.size() && water.domain != gimpm::WaterDomain::pores; ++v)
				walls[w].beam->waterPressures[v] += water.factor * jumps[v];
		}
	}
}

template <int Dim> void Waters<Dim>::joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real)
{
	for (auto& water : waters)
		water.wantsWork = true;
}

template <int Dim> Work Waters<Dim>::work(const StepOutcome<Dim>&) const
{
	Work sum;
	for (const auto& water : waters)
		sum.ofLoads += water.work;
	return sum;
}

template <int Dim> void Waters<Dim>::reach(const StepOutcome<Dim>& step)
{
	const auto& points    = step.points;
	const auto& boundary  = step.model.boundary;
	auto&       reactions = step.reactions;

	const PointWriter writer { PointWriter::OfResults() };
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p) {
			Real& sum = writer.state(points[p]).porePressure;
			if (std::isnan(sum)) sum = 0; // else there is water that cannot leave
			for (const auto& water : waters)
				sum += water.porePressure[p];
		}
	});
	for (size_t i = 0; i < waters.size(); ++i) {
		if (sources[i].given) sources[i].given->keep(*sources[i].from, step.time);
		auto& onBoundaries = sources[i].from->onBoundaries;
		onBoundaries.assign(reactions.size(), Vector3r::Zero());
		for (const auto& [node, force] : waters[i].onWalls)
			for (int a = 0; a < Dim; ++a) {
				const auto*  box = boundary.constrainingBox(node, a);
				const size_t b   = box ? box - boundary.boxes().data() : reactions.size();
				// The axis of symmetry is none of them.
				if (b < reactions.size()) onBoundaries[b][a] += force[a];
			}
		for (size_t b = 0; b < reactions.size(); ++b)
			reactions[b] += onBoundaries[b];
	}
}

template class Waters<2>;
template class Waters<3>;

} // namespace yade
