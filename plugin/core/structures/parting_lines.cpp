// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/parting_lines.hpp"
#include "core/grid/nearness.hpp"
#include "core/grid/refinement.hpp"
#include "core/structures/from_line.hpp"

namespace gimpm {
namespace {

/// A line with what it is made longer by [m], and the places around which soil stays whole.
struct Cut {
	std::vector<Vec<2>> positions;
	std::vector<Vec<2>> tips;
	int                 layer = 0;
};

/// Beyond a vertex, where soil would make it a tip; to the sides, where there is soil to be parted [cells].
constexpr double aside = 0.5, reachOfSoil = 0.25;

bool hasSoil(const Vec<2>& position, double cellSize, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	return !areFarFromMaterial<2>({ position }, { reachOfSoil * cellSize }, cloud, grid)[0];
}

/// Extends a line beyond its open ends: out of the cells around them, so that a cut ends half a cell to one and a half
/// cells beyond a tip that is bonded, and else at the first line of the grid beyond it.
Cut longer(PartingLine& line, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	constexpr double beyondEnds = 1.5, beyondTip = 0.99; // [cells]
	Cut              cut { line.positions, {}, 0 };
	if (line.isClosed) return cut;
	for (const int end : { 1, 0 }) {
		const Vec<2> vertex = end == 0 ? line.positions.front() : line.positions.back(), outwards = line.outwardsAt(end);
		const double h      = cellSizeAt(grid, vertex);
		line.isTip[end]     = hasSoil(vertex + aside * h * outwards, h, cloud, grid);
		const Vec<2> beyond = vertex + (line.isTip[end] && !line.isBonded ? beyondTip : beyondEnds) * h * outwards;
		cut.positions.insert(end == 0 ? cut.positions.begin() : cut.positions.end(), beyond);
		if (line.isTip[end]) cut.tips.push_back(beyond);
	}
	return cut;
}

/// True if centres of points are beside a line on both of its sides.
bool isBetween(const PartingLine& line, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	constexpr double    onLine = 0.1; // [cells]
	const double        most   = (aside + reachOfSoil) * largestCell(grid);
	std::array<bool, 2> found {};
	Vec<2>              low = line.positions.front(), high = low;
	for (const Vec<2>& position : line.positions)
		low = low.cwiseMin(position), high = high.cwiseMax(position);
	low.array() -= most, high.array() += most;
	for (std::size_t p = 0; p < cloud.size() && !(found[0] && found[1]); ++p) {
		const Vec<2>& x = cloud.position[p];
		if ((x - low).minCoeff() < 0 || (high - x).minCoeff() < 0) continue;
		const FromLine at = fromLine(line.positions, x);
		const double   h  = cellSizeAt(grid, x);
		if (at.away <= (aside + reachOfSoil) * h && !at.isBeyond && std::abs(at.left) > onLine * h) found[at.side > 0] = true;
	}
	return found[0] && found[1];
}

/// True if a piece of a line goes through the square around a position.
bool crosses(const Vec<2>& from, const Vec<2>& to, const Vec<2>& middle, double half)
{
	double       begin = 0, end = 1;
	const Vec<2> along = to - from;
	for (int a = 0; a < 2; ++a) {
		const double low = middle[a] - half - from[a], high = middle[a] + half - from[a];
		if (along[a] == 0) {
			if (low > 0 || high < 0) return false;
			continue;
		}
		begin = std::max(begin, std::min(low / along[a], high / along[a]));
		end   = std::min(end, std::max(low / along[a], high / along[a]));
	}
	return begin < end;
}

bool isWithin(const Vec<2>& position, const Vec<2>& middle, double half) { return (position - middle).cwiseAbs().maxCoeff() < half; }

/// The nodes whose cells a line cuts in two: those of all levels that do not hang, in layer 0.
std::vector<Key> nodesCut(const Cut& line, const Grid<2>& grid)
{
	std::vector<Key> nodes;
	for (int level = 0; level <= (grid.refinement ? grid.refinement->largest() : 0); ++level) {
		const double around = (1 - 1e-6) * grid.size(level);
		const auto   isCut  = [&](const Index<2>& node, const Vec<2>& from, const Vec<2>& to) {
                        const Vec<2> middle = grid.nodePosition(node);
                        const auto   ends   = [&](const Vec<2>& tip) { return isWithin(tip, middle, around); };
                        if (!crosses(from, to, middle, around) || std::any_of(line.tips.begin(), line.tips.end(), ends)) return false;
                        return !grid.refinement || grid.refinement->largestAt(node) == level;
		};
		for (std::size_t i = 0; i + 1 < line.positions.size(); ++i) {
			const Vec<2>&  from = line.positions[i], &to = line.positions[i + 1];
			const Index<2> low  = ((from.cwiseMin(to) - grid.origin) / grid.size(level)).array().floor().cast<int>() - 1;
			const Index<2> high = ((from.cwiseMax(to) - grid.origin) / grid.size(level)).array().ceil().cast<int>() + 1;
			for (int x = low[0]; x <= high[0]; ++x)
				for (int y = low[1]; y <= high[1]; ++y)
					if (const Index<2> node = Index<2>(x, y) * (1 << level); isCut(node, from, to))
						nodes.push_back(Grid<2>::key(node, level));
		}
	}
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	return nodes;
}

/// The layer of a position near nodes of their own.
class LayerAt {
public:
	LayerAt(std::vector<Cut> lines, std::vector<Key> own, const Grid<2>& grid)
	        : lines_(std::move(lines))
	        , own_(std::move(own))
	        , origin_(grid.origin)
	        , cellSize_(grid.cellSize)
	        , largest_(grid.refinement ? grid.refinement->largest() : 0)
	{
		low_ = Vec<2>::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
		for (const auto& line : lines_)
			for (const Vec<2>& position : line.positions)
				low_ = low_.cwiseMin(position), high_ = high_.cwiseMax(position);
		const double margin = 4 * grid.size(largest_);
		low_.array() -= margin, high_.array() += margin;
	}
	int operator()(const Vec<2>& position) const
	{
		if ((position - low_).minCoeff() < 0 || (high_ - position).minCoeff() < 0) return 0;
		for (const auto& line : lines_)
			if (isNearOwn(position, line.layer) && fromLine(line.positions, position).side < 0) return line.layer;
		return 0;
	}

private:
	/// True if own nodes are as near as domains reach: one cell and half of one.
	bool isNearOwn(const Vec<2>& position, int layer) const
	{
		for (int level = 0; level <= largest_; ++level) {
			const Vec<2>   x   = (position - origin_) / (cellSize_ * (1 << level));
			const Index<2> low = (x.array() - 1.5).ceil().cast<int>(), high = (x.array() + 1.5).floor().cast<int>();
			for (int i = low[0]; i <= high[0]; ++i)
				for (int j = low[1]; j <= high[1]; ++j)
					if (find(own_, Grid<2>::key(Index<2>(i, j) * (1 << level), level, layer)) >= 0) return true;
		}
		return false;
	}

	std::vector<Cut> lines_;
	std::vector<Key> own_;
	Vec<2>           origin_, low_, high_;
	double           cellSize_;
	int              largest_; // level
};

/// Where water passes a cut: through the line if it leaks, and ahead of its tips.
void addLeaks(const PartingLine& line, const Cut& cut, std::vector<LeakyCut<2>>& leaks)
{
	const auto add = [&](const Vec<2>& from, const Vec<2>& to, double leakage) { leaks.push_back({ from, to, line.layer, leakage }); };
	for (std::size_t i = 0; line.leakage > 0 && i + 1 < line.positions.size(); ++i)
		add(line.positions[i], line.positions[i + 1], line.leakage);
	if (line.isTip[0]) add(cut.positions[0], cut.positions[1], LeakyCut<2>::asSoil);
	if (line.isTip[1]) add(cut.positions[cut.positions.size() - 2], cut.positions.back(), LeakyCut<2>::asSoil);
}

/// The side of a line of vertices that a position within a reach of it is on: 1 left, -1 right; 0: it is not, or beyond
/// an end.
int sideOf(const PartingLine& line, const Vec<2>& position, double reach)
{
	const FromLine at = fromLine(line.positions, position);
	if (at.away > reach || at.isBeyond || at.side == 0) return 0;
	return at.side > 0 ? 1 : -1;
}

bool areApart(const std::vector<Key>& nodes, const std::vector<Key>& others)
{
	constexpr int near = 3;
	for (const Key node : nodes)
		for (const Key other : others)
			if ((Grid<2>::index(node) - Grid<2>::index(other)).cwiseAbs().maxCoeff() <= near
			            << std::max(Grid<2>::level(node), Grid<2>::level(other)))
				return false;
	return true;
}

} // namespace

void lookBetween(const std::vector<PartingLine*>& lines, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	for (PartingLine* line : lines)
		line->layer = 0, line->isTip = {}, line->isBetween = isBetween(*line, cloud, grid);
}

BesideLine::BesideLine(const PartingLine& line, int side, const PointCloud<2>& cloud) : line_(line), side_(side), cloud_(cloud) { }

bool BesideLine::operator()(int p) const
{
	const int layer = cloud_.layerOf(p);
	if (layer != 0 && (side_ > 0 || layer != line_.layer)) return false;
	return side_ * fromLine(line_.positions, cloud_.position[p]).side > 0;
}

std::vector<int> sidesOf(const std::vector<PartingLine*>& lines, const std::vector<Vec<2>>& positions, double cellSize)
{
	std::vector<int> sides(positions.size(), 0);
	for (const PartingLine* line : lines) {
		if (line->layer == 0) continue;
		Vec<2> low = line->positions.front(), high = low;
		for (const Vec<2>& position : line->positions)
			low = low.cwiseMin(position), high = high.cwiseMax(position);
		low.array() -= cellSize, high.array() += cellSize;
		for (std::size_t p = 0; p < positions.size(); ++p)
			if ((positions[p] - low).minCoeff() >= 0 && (high - positions[p]).minCoeff() >= 0)
				if (const int side = sideOf(*line, positions[p], cellSize); side != 0) sides[p] = -side * line->layer;
	}
	return sides;
}

void partSoil(const std::vector<PartingLine*>& lines, PointCloud<2>& cloud, Grid<2>& grid)
{
	std::vector<Cut>         cuts;
	std::vector<Key>         taken, own;
	std::vector<LeakyCut<2>> leaks;
	lookBetween(lines, cloud, grid);
	for (PartingLine* line : lines) {
		if (int(cuts.size()) == Grid<2>::mostLayer || !line->isBetween) continue;
		Cut        cut   = longer(*line, cloud, grid);
		const auto nodes = nodesCut(cut, grid);
		if (nodes.empty() || !areApart(nodes, taken)) continue;
		line->layer = cut.layer = int(cuts.size()) + 1;
		for (const Key node : nodes)
			own.push_back(Parting<2>::in(cut.layer, node));
		taken.insert(taken.end(), nodes.begin(), nodes.end());
		addLeaks(*line, cut, leaks);
		cuts.push_back(std::move(cut));
	}
	grid.parting.reset();
	cloud.layer.clear();
	if (cuts.empty()) return;
	std::sort(own.begin(), own.end());
	grid.parting = std::make_shared<Parting<2>>(own, LayerAt(std::move(cuts), own, grid), grid.refinement, std::move(leaks));
	cloud.layer.resize(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p)
		cloud.layer[p] = grid.parting->layerAt(cloud.position[p]);
}

} // namespace gimpm
