// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/parting_lines.hpp"
#include "core/grid/surface.hpp"
#include "core/structures/cuts.hpp"
#include "core/structures/from_line.hpp"

namespace gimpm {
namespace {

/// True if a piece of a line goes through the square around a position.
bool passesThrough(const std::array<Vec<2>, 2>& piece, const Vec<2>& middle, double half)
{
	double       begin = 0, end = 1;
	const Vec<2> along = piece[1] - piece[0];
	for (int a = 0; a < 2; ++a) {
		const double low = middle[a] - half - piece[0][a], high = middle[a] + half - piece[0][a];
		if (along[a] == 0) {
			if (low > 0 || high < 0) return false;
			continue;
		}
		begin = std::max(begin, std::min(low / along[a], high / along[a]));
		end   = std::min(end, std::max(low / along[a], high / along[a]));
	}
	return begin < end;
}

/// A line with what it is made longer by [m], and the places around which soil stays whole.
struct LineCut {
	std::vector<Vec<2>>      positions;
	std::vector<Vec<2>>      tips;
	std::vector<LeakyCut<2>> leaks; ///< through the line if it leaks, and ahead of its tips
	int                      layer = 0;
	Limits                   limits {};

	std::vector<std::array<Vec<2>, 2>> pieces() const
	{
		std::vector<std::array<Vec<2>, 2>> all;
		for (std::size_t i = 0; i + 1 < positions.size(); ++i)
			all.push_back({ positions[i], positions[i + 1] });
		return all;
	}
	double side(const Vec<2>& x) const { return fromLine(positions, x).side; }
	bool   crosses(const std::array<Vec<2>, 2>& piece, const Vec<2>& middle, double half) const { return passesThrough(piece, middle, half); }
	bool   endsIn(const Vec<2>& middle, double half) const
	{
		return std::any_of(tips.begin(), tips.end(), [&](const Vec<2>& tip) { return (tip - middle).cwiseAbs().maxCoeff() < half; });
	}
};

bool hasSoil(const Vec<2>& position, double cellSize, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	return !areFarFromMaterial<2>({ position }, { reachBesideCut * cellSize }, cloud, grid)[0];
}

/// True if a position is at another line that may part the soil, off its ends.
bool isAtOther(const std::vector<PartingLine*>& lines, const PartingLine& line, const Vec<2>& position, double cellSize)
{
	return std::any_of(lines.begin(), lines.end(), [&](const PartingLine* other) {
		return other != &line && other->isBetween && isAtMiddle(*other, position, onOther * cellSize);
	});
}

/// Extends a line beyond its open ends: out of the cells around them, so that a cut ends half a cell to one and a half
/// cells beyond a tip that is bonded, and else at the first line of the grid beyond it.
LineCut longer(PartingLine& line, const std::vector<PartingLine*>& others, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	LineCut cut { line.positions, {}, {}, 0, {} };
	for (std::size_t i = 0; line.leakage > 0 && i + 1 < line.positions.size(); ++i)
		cut.leaks.push_back({ { line.positions[i], line.positions[i + 1] }, 0, line.leakage });
	if (line.isClosed) return cut;
	for (const int end : { 1, 0 }) {
		const Vec<2> vertex = end == 0 ? line.positions.front() : line.positions.back(), outwards = line.outwardsAt(end);
		const double h      = cellSizeAt(grid, vertex);
		line.isTip[end]     = hasSoil(vertex + asideOfCut * h * outwards, h, cloud, grid) && !isAtOther(others, line, vertex, h);
		const Vec<2> beyond = vertex + (line.isTip[end] && !line.isBonded ? beyondTip : beyondEnds) * h * outwards;
		cut.positions.insert(end == 0 ? cut.positions.begin() : cut.positions.end(), beyond);
		if (!line.isTip[end]) continue;
		cut.tips.push_back(beyond);
		cut.leaks.push_back({ { vertex, beyond }, 0, LeakyCut<2>::asSoil });
	}
	return cut;
}

/// True if centres of points are beside a line on both of its sides.
bool isBetween(const PartingLine& line, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	constexpr double    onLine = 0.1; // [cells]
	const double        most   = (asideOfCut + reachBesideCut) * largestCell(grid);
	std::array<bool, 2> found {};
	const Bounds<2>     box(line.positions, most);
	for (std::size_t p = 0; p < cloud.size() && !(found[0] && found[1]); ++p) {
		const Vec<2>& x = cloud.position[p];
		if (!box.contain(x)) continue;
		const FromLine at = fromLine(line.positions, x);
		const double   h  = cellSizeAt(grid, x);
		if (at.away <= (asideOfCut + reachBesideCut) * h && !at.isBeyond && std::abs(at.left) > onLine * h) found[at.side > 0] = true;
	}
	return found[0] && found[1];
}

/// The side of a line of vertices that a position within a reach of it is on: 1 left, -1 right; 0: it is not, or beyond
/// an end.
int sideWithin(const PartingLine& line, const Vec<2>& position, double reach)
{
	const FromLine at = fromLine(line.positions, position);
	if (at.away > reach || at.isBeyond || at.side == 0) return 0;
	return at.side > 0 ? 1 : -1;
}

/// True if the way between two positions goes through a line, be it at one of them.
bool isThrough(const std::vector<Vec<2>>& line, const Vec<2>& a, const Vec<2>& b)
{
	Surface<2> surface;
	surface.vertices = line;
	for (int i = 0; i + 1 < int(line.size()); ++i)
		surface.pieces.push_back({ i, i + 1 });
	return surface.isBetween(a, b);
}

/// Tells each line of the others near it that part the soil, too.
void noteOthers(const std::vector<PartingLine*>& lines, const Grid<2>& grid)
{
	constexpr double near = 3; // [cells]
	for (PartingLine* line : lines) {
		const Bounds<2> around(line->positions, near * largestCell(grid));
		for (const PartingLine* other : lines)
			if (other != line && other->layer > 0
			    && std::any_of(other->positions.begin(), other->positions.end(), [&](const Vec<2>& x) { return around.contain(x); }))
				line->others.push_back(other->positions);
	}
}

} // namespace

double awayFrom(const PartingLine& line, const Vec<2>& position) { return fromLine(line.positions, position).away; }
bool   isAtMiddle(const PartingLine& line, const Vec<2>& position, double reach)
{
	const auto ends = endsOf(line);
	return awayFrom(line, position) <= reach && std::all_of(ends.begin(), ends.end(), [&](const Vec<2>& end) { return (end - position).norm() > reach; });
}
std::vector<Vec<2>> middlesOf(const PartingLine& line)
{
	std::vector<Vec<2>> middles;
	for (std::size_t i = 0; i + 1 < line.positions.size(); ++i)
		middles.push_back((line.positions[i] + line.positions[i + 1]) / 2);
	return middles;
}
std::vector<Vec<2>> endsOf(const PartingLine& line)
{
	return line.isClosed ? std::vector<Vec<2>>() : std::vector<Vec<2>> { line.positions.front(), line.positions.back() };
}
double sideFrom(const PartingLine& line, const Vec<2>& position) { return fromLine(line.positions, position).side; }

void lookBetween(const std::vector<PartingLine*>& lines, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	for (PartingLine* line : lines)
		line->layer = 0, line->isTip = {}, line->others.clear(), line->isBetween = isBetween(*line, cloud, grid);
}

BesideLine::BesideLine(const PartingLine& line, int side, const PointCloud<2>& cloud) : line_(line), side_(side), cloud_(cloud) { }

bool BesideLine::operator()(int p) const
{
	const int layer = cloud_.layerOf(p);
	if (layer != 0 && line_.others.empty() && (side_ > 0 || layer != line_.layer)) return false;
	if (side_ > 0 && (layer & line_.layer)) return false;
	const FromLine at = fromLine(line_.positions, cloud_.position[p]);
	return side_ * at.side > 0
	        && std::none_of(line_.others.begin(), line_.others.end(), [&](const auto& other) { return isThrough(other, at.foot, cloud_.position[p]); });
}

std::vector<int> sidesOf(const std::vector<PartingLine*>& lines, const std::vector<Vec<2>>& positions, double cellSize)
{
	std::vector<int> sides(positions.size(), 0);
	for (int l = 0; l < int(lines.size()); ++l) {
		if (lines[l]->layer == 0) continue;
		const Bounds<2> box(lines[l]->positions, cellSize);
		for (std::size_t p = 0; p < positions.size(); ++p)
			if (box.contain(positions[p]))
				if (const int side = sideWithin(*lines[l], positions[p], cellSize); side != 0) sides[p] = -side * (l + 1);
	}
	return sides;
}

void partSoil(const std::vector<PartingLine*>& lines, PointCloud<2>& cloud, Grid<2>& grid, bool mayBeNear)
{
	const std::vector<PartingLine*> none;
	lookBetween(lines, cloud, grid);
	partByCuts<2>(lines, cloud, grid, mayBeNear, [&](PartingLine& line) { return longer(line, mayBeNear ? lines : none, cloud, grid); });
	if (mayBeNear) noteOthers(lines, grid);
}

} // namespace gimpm
