// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/parting_lines.hpp"
#include "core/grid/nearness.hpp"
#include "core/structures/from_line.hpp"

namespace gimpm {
namespace {

/// A beam with what it is made longer by [m].
struct PartingLine {
	std::vector<Vec<2>> positions;
	bool                isClosed = false;
	std::vector<Vec<2>> tips;
	int                 layer = 0;
};

/// Beyond a vertex, where soil would make it a tip; to the sides, where there is soil to be parted [cells].
constexpr double aside = 0.5, reachOfSoil = 0.25;

bool hasSoil(const Vec<2>& position, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	return !areFarFromMaterial<2>({ position }, { reachOfSoil * grid.cellSize }, cloud, grid)[0];
}

/// Extends a beam beyond its open ends: out of the cells around them, where a cut ends half a cell to one and a half
/// cells beyond a tip.
PartingLine longer(Beam& beam, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	constexpr double beyondEnds = 1.5; // [cells]
	PartingLine      line { beam.positions, beam.isClosed, {}, 0 };
	if (beam.isClosed) return line;
	for (const int end : { 1, 0 }) {
		const Vec<2> vertex = end == 0 ? beam.positions.front() : beam.positions.back(), outwards = beam.outwardsAt(end);
		const bool   isTip  = hasSoil(vertex + aside * grid.cellSize * outwards, cloud, grid);
		const Vec<2> beyond = vertex + beyondEnds * grid.cellSize * outwards;
		line.positions.insert(end == 0 ? line.positions.begin() : line.positions.end(), beyond);
		if (isTip) line.tips.push_back(beyond);
		beam.isTip[end] = isTip;
	}
	return line;
}

/// True if there is soil on both sides of any vertex.
bool isBetween(const Beam& beam, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	std::vector<Vec<2>> positions;
	for (int v = 0; v < int(beam.positions.size()); ++v) {
		const Vec<2> t = beam.tangentAt(v), n(-t[1], t[0]);
		positions.push_back(beam.positions[v] + aside * grid.cellSize * n);
		positions.push_back(beam.positions[v] - aside * grid.cellSize * n);
	}
	const auto isFar = areFarFromMaterial<2>(positions, std::vector<double>(positions.size(), reachOfSoil * grid.cellSize), cloud, grid);
	for (std::size_t i = 0; i < positions.size(); i += 2)
		if (!isFar[i] && !isFar[i + 1]) return true;
	return false;
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

/// The nodes whose four cells a line cuts in two.
std::vector<Index<2>> nodesCut(const PartingLine& line, const Grid<2>& grid)
{
	const double          around = (1 - 1e-6) * grid.cellSize;
	std::vector<Index<2>> nodes;
	for (std::size_t i = 0; i + 1 < line.positions.size(); ++i) {
		const Vec<2>&  from = line.positions[i], &to = line.positions[i + 1];
		const Index<2> low  = ((from.cwiseMin(to) - grid.origin) / grid.cellSize).array().floor().cast<int>() - 1;
		const Index<2> high = ((from.cwiseMax(to) - grid.origin) / grid.cellSize).array().ceil().cast<int>() + 1;
		for (int x = low[0]; x <= high[0]; ++x)
			for (int y = low[1]; y <= high[1]; ++y) {
				const Index<2> node(x, y);
				const Vec<2>   middle = grid.nodePosition(node);
				const auto     ends   = [&](const Vec<2>& tip) { return isWithin(tip, middle, around); };
				if (!crosses(from, to, middle, around) || std::any_of(line.tips.begin(), line.tips.end(), ends)) continue;
				if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
			}
	}
	return nodes;
}

/// The layer of a position near nodes of their own.
class LayerAt {
public:
	LayerAt(std::vector<PartingLine> lines, std::vector<Key> own, const Grid<2>& grid)
	        : lines_(std::move(lines)), own_(std::move(own)), origin_(grid.origin), cellSize_(grid.cellSize)
	{
		low_ = Vec<2>::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
		for (const auto& line : lines_)
			for (const Vec<2>& position : line.positions)
				low_ = low_.cwiseMin(position), high_ = high_.cwiseMax(position);
		low_.array() -= 4 * cellSize_, high_.array() += 4 * cellSize_;
	}
	int operator()(const Vec<2>& position) const
	{
		if ((position - low_).minCoeff() < 0 || (high_ - position).minCoeff() < 0) return 0;
		for (const auto& line : lines_)
			if (isNearOwn(position, line.layer) && fromLine(line.positions, position).side < 0) return line.layer;
		return 0;
	}

private:
	/// True if own cells are as near as domains reach: one cell and half of one.
	bool isNearOwn(const Vec<2>& position, int layer) const
	{
		const Vec<2>   x   = (position - origin_) / cellSize_;
		const Index<2> low = (x.array() - 1.5).ceil().cast<int>(), high = (x.array() + 1.5).floor().cast<int>();
		for (int i = low[0]; i <= high[0]; ++i)
			for (int j = low[1]; j <= high[1]; ++j)
				if (find(own_, Grid<2>::key({ i, j }, 0, layer)) >= 0) return true;
		return false;
	}

	std::vector<PartingLine> lines_;
	std::vector<Key>         own_;
	Vec<2>                   origin_, low_, high_;
	double                   cellSize_;
};

/// The side of a line of vertices that a position within a reach of it is on: 1 left, -1 right; 0: it is not, or beyond
/// an end.
int sideOf(const Beam& beam, const Vec<2>& position, double reach)
{
	const FromLine at = fromLine(beam.positions, position);
	if (at.away > reach || at.isBeyond || at.side == 0) return 0;
	return at.side > 0 ? 1 : -1;
}

bool areApart(const std::vector<Index<2>>& nodes, const std::vector<Index<2>>& others)
{
	constexpr int near = 3;
	for (const auto& node : nodes)
		for (const auto& other : others)
			if ((node - other).cwiseAbs().maxCoeff() <= near) return false;
	return true;
}

} // namespace

void lookBetween(const std::vector<Beam*>& beams, const PointCloud<2>& cloud, const Grid<2>& grid)
{
	for (Beam* beam : beams)
		beam->layer = 0, beam->isTip = {}, beam->isBetween = isBetween(*beam, cloud, grid);
}

BesideBeam::BesideBeam(const Beam& beam, int side, const PointCloud<2>& cloud) : beam_(beam), side_(side), cloud_(cloud) { }

bool BesideBeam::operator()(int p) const
{
	const int layer = cloud_.layerOf(p);
	if (layer != 0 && (side_ > 0 || layer != beam_.layer)) return false;
	return side_ * fromLine(beam_.positions, cloud_.position[p]).side > 0;
}

std::vector<int> sidesOf(const std::vector<Beam*>& beams, const std::vector<Vec<2>>& positions, double cellSize)
{
	std::vector<int> sides(positions.size(), 0);
	for (const Beam* beam : beams) {
		if (beam->layer == 0) continue;
		Vec<2> low = beam->positions.front(), high = low;
		for (const Vec<2>& position : beam->positions)
			low = low.cwiseMin(position), high = high.cwiseMax(position);
		low.array() -= cellSize, high.array() += cellSize;
		for (std::size_t p = 0; p < positions.size(); ++p)
			if ((positions[p] - low).minCoeff() >= 0 && (high - positions[p]).minCoeff() >= 0)
				if (const int side = sideOf(*beam, positions[p], cellSize); side != 0) sides[p] = -side * beam->layer;
	}
	return sides;
}

void partSoil(const std::vector<Beam*>& beams, PointCloud<2>& cloud, Grid<2>& grid)
{
	std::vector<PartingLine> lines;
	std::vector<Index<2>>    taken;
	std::vector<Key>         own;
	lookBetween(beams, cloud, grid);
	for (Beam* beam : beams) {
		if (int(lines.size()) == Grid<2>::mostLayer || !beam->isBetween) continue;
		PartingLine line  = longer(*beam, cloud, grid);
		const auto  nodes = nodesCut(line, grid);
		if (nodes.empty() || !areApart(nodes, taken)) continue;
		beam->layer = line.layer = int(lines.size()) + 1;
		for (const Index<2>& node : nodes)
			own.push_back(Grid<2>::key(node, 0, line.layer));
		taken.insert(taken.end(), nodes.begin(), nodes.end());
		lines.push_back(std::move(line));
	}
	grid.parting.reset();
	cloud.layer.clear();
	if (lines.empty()) return;
	std::sort(own.begin(), own.end());
	grid.parting = std::make_shared<Parting<2>>(own, LayerAt(std::move(lines), own, grid));
	cloud.layer.resize(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p)
		cloud.layer[p] = grid.parting->layerAt(cloud.position[p]);
}

} // namespace gimpm
