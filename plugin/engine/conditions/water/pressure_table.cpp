// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/pressure_table.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {
	using gimpm::Key;

	vector<Real> answers(const PythonFunction& function, vector<Vector3r> places, const string& name)
	{
		return evaluate(
		        function, std::move(places), name + ": MpmWater.pressure", { "a finite pressure [Pa]", [](Real p) { return std::isfinite(p); } });
	}

	// Nodes of the cells, and those up to `margin` cells around; of a leaf, cells of its size. Nodes are in
	// smallest cells, as a function has the same value for cells of all sizes.
	template <int Dim> vector<Key> nodesAround(const vector<Key>& cells, int margin, const gimpm::Grid<Dim>& grid)
	{
		const int   width = 2 + 2 * margin, count = Dim == 2 ? width * width : width * width * width;
		vector<Key> nodes;
		Key         last = 0;
		for (const Key cell : cells) {
			const Key leaf = grid.refinement ? grid.refinement->leafOf(cell) : cell;
			if (leaf == last && cell != cells.front()) continue;
			last = leaf;
			for (int n = 0; n < count; ++n) {
				gimpm::Index<Dim> node = gimpm::Grid<Dim>::index(leaf);
				for (int a = 0, rest = n; a < Dim; rest /= width, ++a)
					node[a] += (rest % width - margin) * (1 << gimpm::Grid<Dim>::level(leaf));
				nodes.push_back(gimpm::Grid<Dim>::key(grid.first(node)));
			}
		}
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		return nodes;
	}

	using PressureAt = std::map<Key, Real>;

	template <int Dim> PressureAt valuesOf(const vector<Real>& table)
	{
		PressureAt values;
		for (size_t i = 0; i + 3 < table.size(); i += 4) {
			const Vector3r node(table[i], table[i + 1], table[i + 2]);
			values[gimpm::Grid<Dim>::key(node.head<Dim>().template cast<int>())] = table[i + 3];
		}
		return values;
	}

	template <int Dim> vector<Real> tableOf(const PressureAt& values)
	{
		vector<Real> table;
		for (const auto& [key, value] : values) {
			Vector3r node    = Vector3r::Zero();
			node.head<Dim>() = gimpm::Grid<Dim>::index(key).template cast<Real>();
			table.insert(table.end(), { node[0], node[1], node[2], value });
		}
		return table;
	}

	// The same nodes have other values.
	bool differ(const PressureAt& some, const PressureAt& others)
	{
		return std::any_of(some.begin(), some.end(), [&](const auto& node) {
			const auto found = others.find(node.first);
			return found != others.end() && found->second != node.second;
		});
	}

	template <int Dim> vector<Real> numbersOf(const gimpm::Grid<Dim>& grid)
	{
		vector<Real> numbers { grid.cellSize };
		numbers.insert(numbers.end(), grid.origin.data(), grid.origin.data() + Dim);
		return numbers;
	}

	template <int Dim> Vector3r placeOf(Key node, const gimpm::Grid<Dim>& grid)
	{
		Vector3r x    = Vector3r::Zero();
		x.head<Dim>() = grid.nodePosition(gimpm::Grid<Dim>::index(node));
		return x;
	}

	// The first nodes of the period along an axis again, behind its last ones.
	template <int Dim> vector<Key> withFarSide(vector<Key> nodes, const gimpm::Grid<Dim>& grid)
	{
		const size_t first = nodes.size();
		for (size_t i = 0; i < first; ++i)
			for (int a = 0; a < Dim; ++a)
				if (grid.period[a] != 0 && gimpm::Grid<Dim>::index(nodes[i])[a] == 0)
					nodes.push_back(nodes[i] + grid.period[a] * gimpm::Grid<Dim>::keyStep(a));
		return nodes;
	}

	// Gain of the pressure along each axis over a period of the grid: the same in all cells with points, or
	// there is no such state.
	template <int Dim> gimpm::Vec<Dim> fallOf(const PressureAt& values, const vector<Key>& cells, const gimpm::Grid<Dim>& grid, const string& name)
	{
		constexpr Real        roundOff = 1e-9;
		const gimpm::Vec<Dim> none     = gimpm::Vec<Dim>::Zero();
		gimpm::Vec<Dim>       fall     = none;
		if (!grid.isPeriodic()) return none;
		const vector<Key> nodes = nodesAround(cells, 0, grid);
		for (int a = 0; a < Dim; ++a) {
			Key at = 0; // node at which it is known
			for (const Key node : nodes) {
				const auto far = values.find(node + grid.period[a] * gimpm::Grid<Dim>::keyStep(a));
				if (grid.period[a] == 0 || gimpm::Grid<Dim>::index(node)[a] != 0 || far == values.end()) continue;
				const Real near = values.at(node), gain = far->second - near,
				           tolerance = roundOff * std::max(std::abs(near), std::abs(far->second));
				if (at == 0) at = node, fall[a] = std::abs(gain) > tolerance ? gain : 0;
				if (std::abs(gain - fall[a]) <= tolerance) continue;
				throw std::invalid_argument(gimpm::sentence(
				        name, ".pressure gains ", fall[a], " Pa along the period of the grid from (", placeOf(at, grid).transpose(),
				        ") on, but ", gain, " Pa from (", placeOf(node, grid).transpose(),
				        ") on: in a body that repeats itself it must be the same everywhere, as that of flow with one gradient, or 0; is there a water table within the body that falls along the period?"));
			}
		}
		return fall;
	}

	template <int Dim> [[noreturn]] void refuseNode(Key node, const gimpm::Grid<Dim>& grid, const string& name)
	{
		throw std::invalid_argument(
		        name + ": the pressure at " + textOf(placeOf(node, grid))
		        + " is not known: functions are not saved with a scene, only their values near the points that it has. Give MpmWater.pressure again.");
	}

	using Places = PressureInTime<2>::Places;

	Places placesOf(const vector<Real>& table)
	{
		Places places;
		for (size_t i = 0; i + 2 < table.size(); i += 3)
			places[{ table[i], table[i + 1] }] = table[i + 2];
		return places;
	}

	vector<WallInWater::Vec2> missingBeside(const vector<WallInWater>& walls, const Places& known)
	{
		vector<WallInWater::Vec2> missing;
		for (const WallInWater& wall : walls)
			for (const auto& x : wall.places())
				if (known.find({ x[0], x[1] }) == known.end()) missing.push_back(x);
		return missing;
	}

	[[noreturn]] void refusePlace(const WallInWater::Vec2& place, const string& name)
	{
		throw std::invalid_argument(gimpm::sentence(
		        name, ": the pressure beside a beam at (", place.transpose(),
		        ") is not known: functions are not saved with a scene, only their values near the points and beams that it has. Give MpmWater.pressure again."));
	}

	[[noreturn]] void refuseChanges(const string& name)
	{
		throw std::invalid_argument(
		        name
		        + ".pressure has changed from step to step before the scene was saved, and files do not keep functions: give MpmWater.pressure again.");
	}
}

template <int Dim>
std::optional<PressureQuestion<Dim>> PressureQuestion<Dim>::of(
        MpmWater& water, const gimpm::Grid<Dim>& grid, const vector<Key>& cells, const string& name, When when, const vector<WallInWater>& walls)
{
	// Cells that a point may reach in a step, and in the steps after a scene has been loaded.
	constexpr int near = 1, far = 3;
	const bool    isOfGrid = water.tableGrid == numbersOf(grid), isOfFunction = water.pressure && water.evaluated == water.pressure.object.get();
	if (water.pressure && (!isOfGrid || (when == When::now && !isOfFunction))) water.forgetTable();
	if (!water.pressure && !isOfGrid) refuseNode(gimpm::Grid<Dim>::key(gimpm::Index<Dim>::Zero()), grid, name);
	const bool       isNext  = water.pressure && when == When::next;
	const PressureAt values  = valuesOf<Dim>(isNext ? water.next : water.table);
	const auto       missing = [&](const vector<Key>& nodes) {
                vector<Key> found;
                for (const Key node : nodes)
                        if (values.find(node) == values.end()) found.push_back(node);
                return found;
	};
	PressureQuestion  question(water, name, grid, when);
	const vector<Key> nearest = nodesAround(cells, near, grid);
	question.places           = missingBeside(walls, placesOf(isNext ? water.nextBesideWalls : water.besideWalls));
	if (!water.pressure) {
		if (water.changes && when == When::next) refuseChanges(name);
		// Scenes of earlier revisions have no nodes at the far side of a period.
		const vector<Key> unknown = missing(nearest);
		if (!unknown.empty()) refuseNode(unknown[0], grid, name);
		if (!question.places.empty()) refusePlace(question.places[0], name);
		return std::nullopt;
	}
	if (!missing(withFarSide(nearest, grid)).empty()) question.nodes = missing(withFarSide(nodesAround(cells, far, grid), grid));
	if (question.nodes.empty() && question.places.empty()) return std::nullopt;
	return question;
}

template <int Dim> void PressureQuestion<Dim>::ask()
{
	vector<Vector3r> all;
	for (const Key node : nodes)
		all.push_back(placeOf(node, grid));
	for (const auto& x : places)
		all.push_back({ x[0], x[1], 0 });
	found = answers(function, all, name);
}

template <int Dim> void PressureQuestion<Dim>::store() const
{
	const bool isNext  = when == When::next;
	auto&      table   = isNext ? water->next : water->table;
	auto&      besides = isNext ? water->nextBesideWalls : water->besideWalls;
	PressureAt values  = valuesOf<Dim>(table);
	for (size_t i = 0; i < nodes.size(); ++i)
		values[nodes[i]] = found[i];
	table = tableOf<Dim>(values);
	for (size_t i = 0; i < places.size(); ++i)
		besides.insert(besides.end(), { places[i][0], places[i][1], found[nodes.size() + i] });
	const bool isSameFunction = water->evaluated == function.object.get();
	if (isNext) water->changes = isSameFunction && (water->changes || differ(values, valuesOf<Dim>(water->table)));
	water->tableGrid = numbersOf(grid);
	water->evaluated = function.object.get();
}

template <int Dim>
PressureInTime<Dim>::PressureInTime(
        MpmWater& water, const gimpm::Grid<Dim>& grid, const vector<Key>& cells, const string& name, Real begin, Real end, const vector<WallInWater>& walls)
        : grid(grid), begin(begin), end(end)
{
	const When when = end > begin ? When::next : When::now;
	if (auto question = PressureQuestion<Dim>::of(water, grid, cells, name, when, walls)) {
		question->ask();
		question->store();
	}
	const bool       isNext  = when == When::next && water.pressure;
	PressureAt       earlier = valuesOf<Dim>(water.table);
	const PressureAt later   = isNext ? valuesOf<Dim>(water.next) : earlier;
	for (const auto& [key, value] : later) {
		nodes.push_back(key), after.push_back(value);
		before.push_back(earlier.try_emplace(key, value).first->second); // value as the step ends, where it was not known
	}
	fallBefore = fallOf(earlier, cells, grid, name), fallAfter = fallOf(later, cells, grid, name);
	besideBefore = placesOf(water.besideWalls), besideAfter = isNext ? placesOf(water.nextBesideWalls) : besideBefore;
	besideBefore.insert(besideAfter.begin(), besideAfter.end());
}

template <int Dim> vector<Real> PressureInTime<Dim>::valuesAt(Real share) const
{
	vector<Real> values = after;
	for (size_t i = 0; share < 1 && i < values.size(); ++i)
		values[i] += (1 - share) * (before[i] - after[i]);
	return values;
}

template <int Dim> auto PressureInTime<Dim>::tabulated(const vector<Real>& values, Real share) const -> Pressure
{
	return std::make_shared<gimpm::TabulatedWater<Dim>>(grid, nodes, values, fallAfter + (1 - share) * (fallBefore - fallAfter));
}

template <int Dim> auto PressureInTime<Dim>::at(Real time) const -> Pressure
{
	const Real share = shareAt(time);
	return tabulated(valuesAt(share), share);
}

template <int Dim> Real PressureInTime<Dim>::besideAt(const WallInWater::Vec2& place, Real share) const
{
	const std::pair<Real, Real> at(place[0], place[1]);
	const Real                  now = besideAfter.at(at);
	return now + (1 - share) * (besideBefore.at(at) - now);
}

template <int Dim> vector<Real> PressureInTime<Dim>::jumps(const WallInWater& wall, Real time) const
{
	constexpr Real roundOff = 1e-3; // tolerance for a pressure that is continuous across the beam, between positions on its two sides
	const Real     share    = shareAt(time);
	vector<Real>   all;
	Real           largest = 0, most = 0;
	for (size_t v = 0; v < wall.left.size(); ++v) {
		const Real left = besideAt(wall.left[v], share), right = besideAt(wall.right[v], share);
		all.push_back(left - right);
		largest = std::max(largest, std::abs(left - right)), most = std::max({ most, std::abs(left), std::abs(right) });
	}
	for (const auto& behind : wall.behind)
		most = std::max(most, std::abs(besideAt(behind.before, share)));
	return largest > roundOff * most ? all : vector<Real>();
}

template <int Dim> auto PressureInTime<Dim>::beside(const WallInWater& wall, int side, Real time) const -> Pressure
{
	const Real   share  = shareAt(time);
	vector<Real> values = valuesAt(share);
	for (const auto& behind : wall.behind) {
		const int place = behind.side == side ? gimpm::find(nodes, behind.node) : -1;
		if (place >= 0) values[place] = 2 * besideAt(behind.beside, share) - besideAt(behind.before, share);
	}
	return tabulated(values, share);
}

template <int Dim> void PressureInTime<Dim>::keep(MpmWater& water, Real time) const
{
	PressureAt         values;
	const Real         share = shareAt(time);
	const vector<Real> now   = valuesAt(share);
	for (size_t i = 0; i < nodes.size(); ++i)
		values.emplace_hint(values.end(), nodes[i], now[i]);
	water.table = tableOf<Dim>(values);
	water.besideWalls.clear();
	for (const auto& place : besideAfter) {
		const auto& [x, y] = place.first;
		water.besideWalls.insert(water.besideWalls.end(), { x, y, besideAt({ x, y }, share) });
	}
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template class PressureQuestion<Dim>;                                                                                                                  \
	template class PressureInTime<Dim>;
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
