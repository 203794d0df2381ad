// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/walls_in_water.hpp"
#include "core/structures/from_line.hpp"
#include "engine/conditions/structures/reinforcements.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

namespace {
	using Vec2 = gimpm::Vec<2>;

	// Distance [cells] from a wall within which nodes and points are on one of its sides, and beyond its ends.
	constexpr Real nearWall = 2.5, beyondEnds = 1;

	// A line that goes on beyond its ends.
	vector<Vec2> longer(vector<Vec2> line, Real by)
	{
		if (line.front() == line.back()) return line;
		const size_t last = line.size() - 1;
		const Vec2   head = (line[0] - line[1]).normalized(), foot = (line[last] - line[last - 1]).normalized();
		line[0] += by * head, line[last] += by * foot;
		return line;
	}

	Vec2 normalAt(const vector<Vec2>& line, size_t vertex)
	{
		const size_t last   = line.size() - 1;
		const bool   isSeam = line.front() == line.back() && (vertex == 0 || vertex == last);
		const Vec2   t      = isSeam ? Vec2(line[1] - line[last - 1]) : Vec2(line[std::min(vertex + 1, last)] - line[vertex > 0 ? vertex - 1 : 0]);
		return Vec2(-t[1], t[0]).normalized();
	}

	vector<WallInWater::NodeBehind> nodesBehind(const vector<Vec2>& line, Real away, const gimpm::Grid<2>& grid)
	{
		vector<WallInWater::NodeBehind> nodes;
		Vec2                            low = line.front(), high = low;
		for (const Vec2& x : line)
			low = low.cwiseMin(x), high = high.cwiseMax(x);
		const gimpm::Index<2> first = ((low - grid.origin) / grid.cellSize - Vec2::Constant(nearWall)).array().floor().cast<int>();
		const gimpm::Index<2> last  = ((high - grid.origin) / grid.cellSize + Vec2::Constant(nearWall)).array().ceil().cast<int>();
		for (int x = first[0]; x <= last[0]; ++x)
			for (int y = first[1]; y <= last[1]; ++y) {
				const gimpm::Index<2> node(x, y);
				const gimpm::FromLine at = gimpm::fromLine(line, grid.nodePosition(node));
				if (at.isBeyond || std::abs(at.left) > nearWall * grid.cellSize) continue;
				for (const int side : { 0, 1 }) {
					const Vec2 inwards = (side == 0 ? 1 : -1) * at.normal;
					const Real depth   = side == 0 ? -at.left : at.left;
					if (depth < -away) continue; // it is on that side
					nodes.push_back({ gimpm::Grid<2>::key(grid.first(node)), side, at.foot + away * inwards,
					                  at.foot + std::max(depth, away) * inwards });
				}
			}
		return nodes;
	}
}

WallInWater::WallInWater(const shared_ptr<MpmBeam>& beam, const string& name, const gimpm::Grid<2>& grid) : beam(beam)
{
	const Real away = 1e-4 * grid.cellSize;
	const auto line = fineLine<2>(inDimension<2>(placesOf(beam->line)), name, grid);
	for (size_t v = 0; v < line.size(); ++v) {
		const Vec2 n = normalAt(line, v);
		left.push_back(line[v] + away * n), right.push_back(line[v] - away * n);
	}
	behind = nodesBehind(longer(line, beyondEnds * grid.cellSize), away, grid);
}

vector<Vec2> WallInWater::places() const
{
	vector<Vec2> all(left);
	all.insert(all.end(), right.begin(), right.end());
	for (const NodeBehind& node : behind)
		all.push_back(node.beside), all.push_back(node.before);
	return all;
}

vector<WallInWater> wallsInWater(const vector<Listed>& all, const gimpm::Grid<2>& grid)
{
	vector<WallInWater> walls;
	for (const Listed& listed : all)
		if (const auto beam = boost::dynamic_pointer_cast<MpmBeam>(listed.condition)) {
			beam->requireAdmissible();
			walls.emplace_back(beam, listed.name(), grid);
		}
	return walls;
}

SideOfWalls::SideOfWalls(const vector<WallInWater>& walls, Real cellSize) : reach(nearWall * cellSize)
{
	for (const WallInWater& wall : walls) {
		const MpmBeam& beam = *wall.beam;
		lines.push_back(longer(inDimension<2>(beam.vertices.empty() ? placesOf(beam.line) : beam.vertices), beyondEnds * cellSize));
	}
}

int SideOfWalls::operator()(const Vec2& place) const
{
	int  found   = 0;
	Real nearest = reach;
	for (size_t w = 0; w < lines.size(); ++w) {
		const gimpm::FromLine at = gimpm::fromLine(lines[w], place);
		if (at.isBeyond || at.away > nearest) continue;
		nearest = at.away;
		found   = int(2 * w) + (at.side > 0 ? 1 : 2);
	}
	return found;
}

} // namespace yade
