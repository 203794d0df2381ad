// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/waters.hpp"
#include "engine/points/parallel.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/pressure_table.hpp"
#include "yade_api/value_lock.hpp"

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

	gimpm::WaterPlace placeOf(const MpmWater& water)
	{
		if (water.where == "pores") return gimpm::WaterPlace::pores;
		return water.where == "outside" ? gimpm::WaterPlace::outside : gimpm::WaterPlace::everywhere;
	}

	bool hasFunction(const MpmWater& water) { return std::isnan(water.level) && water.levels.empty(); }

	// That a function of one of the waters has to answer still, and the water, which lives on meanwhile.
	template <int Dim>
	std::pair<shared_ptr<MpmWater>, std::optional<PressureQuestion<Dim>>> nextQuestion(
	        const MpmImplicitEngine& engine, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& cells)
	{
		const ValueLock lock;
		for (size_t i = 0; i < engine.water.size(); ++i) {
			const auto& water = engine.water[i];
			if (!hasFunction(*water) || !water->pressure) continue;
			if (auto question = PressureQuestion<Dim>::of(*water, grid, cells, "water[" + std::to_string(i) + "]"))
				return { water, std::move(question) };
		}
		return {};
	}
}

template <int Dim> Waters<Dim>::Waters(const Loads& given, const gimpm::Grid<Dim>& grid, const gimpm::PointCloud<Dim>& cloud, const gimpm::Division& division)
{
	const bool areAsked = std::any_of(given.water.begin(), given.water.end(), [](const auto& water) { return hasFunction(*water); });
	const auto cells    = areAsked ? cellsOf(cloud, grid, division) : vector<gimpm::Key>();
	for (size_t i = 0; i < given.water.size(); ++i) {
		MpmWater&    water = *given.water[i];
		const string name  = "water[" + std::to_string(i) + "]";
		water.requireAdmissible();
		Source source { given.water[i], given.curveOf(water), nullptr, 0, 1 };
		if (hasFunction(water)) source.given = tabulated(water, grid, cells, name);
		else
			std::tie(source.axis, source.up) = upwards(given.gravity, grid, name);
		sources.push_back(source);
		waters.push_back({ placeOf(water) });
	}
}

template <int Dim> bool Waters<Dim>::ask(const MpmImplicitEngine& engine, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& cells)
{
	for (bool isAsked = false;; isAsked = true) {
		auto [water, question] = nextQuestion(engine, grid, cells);
		if (!question) return isAsked;
		question->ask();
		const ValueLock lock;
		question->store();
	}
}

template <int Dim> void Waters<Dim>::join(gimpm::Model<Dim>& model)
{
	for (auto& water : waters) {
		water.shares = model.shares;
		model.terms.push_back([&water](const gimpm::Beginning<Dim>& step) { return std::make_unique<gimpm::WaterForce<Dim>>(water, step); });
	}
}

template <int Dim>
auto Waters<Dim>::around(const gimpm::Vec<Dim>& x, const gimpm::Vec<Dim>& half) const
        -> vector<std::pair<gimpm::WaterPlace, std::optional<gimpm::PressureAround<Dim>>>>
{
	vector<std::pair<gimpm::WaterPlace, std::optional<gimpm::PressureAround<Dim>>>> found;
	for (const auto& water : waters) {
		auto around = water.pressure->around(x, half);
		if (around) around->value *= water.factor, around->gradient *= water.factor;
		found.emplace_back(water.place, around);
	}
	return found;
}

template <int Dim> auto Waters<Dim>::pressureAt(const Source& source, Real time) const -> Pressure
{
	if (source.given) return source.given;
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
}

template <int Dim> void Waters<Dim>::wantWork()
{
	for (auto& water : waters)
		water.wantsWork = true;
}

template <int Dim> Real Waters<Dim>::work() const
{
	Real sum = 0;
	for (const auto& water : waters)
		sum += water.work;
	return sum;
}

template <int Dim> void Waters<Dim>::scatter(const vector<MaterialPoint>& points, const gimpm::Boundary<Dim>& boundary, vector<Vector3r>& reactions) const
{
	const bool areThere = !waters.empty(), hadSome = !points.empty() && !std::isnan(points[0].state->porePressure);
	if (!areThere && !hadSome) return;
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p) {
			Real& sum = points[p].state->porePressure;
			sum       = areThere ? 0 : std::numeric_limits<Real>::quiet_NaN();
			for (const auto& water : waters)
				sum += water.porePressure[p];
		}
	});
	for (size_t i = 0; i < waters.size(); ++i) {
		auto& onBoundaries = sources[i].from->onBoundaries;
		onBoundaries.assign(reactions.size(), Vector3r::Zero());
		for (const auto& [node, force] : waters[i].onWalls)
			for (int a = 0; a < Dim; ++a) {
				const auto*  box = boundary.holder(gimpm::Grid<Dim>::index(node), a);
				const size_t b   = box ? box - boundary.boxes().data() : reactions.size();
				if (b < reactions.size()) onBoundaries[b][a] += force[a]; // the axis of symmetry is none of them
			}
		for (size_t b = 0; b < reactions.size(); ++b)
			reactions[b] += onBoundaries[b];
	}
}

template class Waters<2>;
template class Waters<3>;

} // namespace yade
