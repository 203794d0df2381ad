// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/parting_sheets.hpp"
#include "core/grid/nearness.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>
#include <map>

namespace gimpm {
namespace {

using Segment = std::array<Vec3, 2>;

/// Beyond an edge, where soil would make it the edge of a cut; to the sides, where there is soil to be parted [cells].
constexpr double aside = 0.5, reachOfSoil = 0.25;

Vec3 normalOf(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).normalized(); }

/// Weights of the corners of a triangle at its closest point to a position; those on its border are 0 there.
Vec3 closestWeights(const std::array<Vec3, 3>& x, const Vec3& position)
{
	const Vec3   ab = x[1] - x[0], ac = x[2] - x[0], normal = ab.cross(ac), from = position - x[0];
	const double area = normal.squaredNorm(), b = from.cross(ac).dot(normal) / area, c = ab.cross(from).dot(normal) / area;
	if (b >= 0 && c >= 0 && b + c <= 1) return { 1 - b - c, b, c };
	Vec3   nearest = Vec3::Zero();
	double least   = std::numeric_limits<double>::infinity();
	for (int i = 0; i < 3; ++i) {
		const int    j    = (i + 1) % 3;
		const Vec3   edge = x[j] - x[i];
		const double part = std::clamp((position - x[i]).dot(edge) / edge.squaredNorm(), 0., 1.), away = (position - x[i] - part * edge).squaredNorm();
		if (away >= least) continue;
		least = away, nearest.setZero(), nearest[i] = 1 - part, nearest[j] = part;
	}
	return nearest;
}

/// Angle of a triangle around a point of it with these weights: at a corner, on an edge, or within.
double angleAt(const std::array<Vec3, 3>& x, const Vec3& weights)
{
	const int zeros = int((weights.array() == 0).count());
	if (zeros < 2) return zeros == 0 ? 2 * M_PI : M_PI;
	int corner;
	weights.maxCoeff(&corner);
	const Vec3 a = (x[(corner + 1) % 3] - x[corner]).normalized(), b = (x[(corner + 2) % 3] - x[corner]).normalized();
	return std::acos(std::clamp(a.dot(b), -1., 1.));
}

/// A sheet with a margin at its border, and where the cut ends in the soil.
struct Cut {
	PartingSheet         sheet;
	std::vector<Segment> rim;
	int                  layer = 0;
};

/// An edge that bounds a sheet, as its facet runs round it.
struct BorderEdge {
	int    from, to;
	Vec3   outwards; ///< in the plane of the facet
	double length;   ///< by which the cut goes on beyond it [m]
	bool   isTip;    ///< there is soil beyond it
};

bool hasSoilBeyond(const Vec3& from, const Vec3& to, const Vec3& outwards, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	std::vector<Vec3>   positions;
	std::vector<double> reach;
	const double        length = (to - from).norm();
	const int           parts  = int(std::min(1e4, std::ceil(length / grid.cellSize)));
	for (int i = 0; i < parts; ++i) {
		const Vec3   on = from + (i + 0.5) / parts * (to - from);
		const double h  = cellSizeAt(grid, on);
		positions.push_back(on + aside * h * outwards);
		reach.push_back(reachOfSoil * h);
	}
	const auto isFar = areFarFromMaterial<3>(positions, reach, cloud, grid);
	return std::any_of(isFar.begin(), isFar.end(), [](std::int64_t is) { return !is; });
}

std::vector<BorderEdge> borderOf(const PartingSheet& sheet, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	constexpr double        beyondEnds = 1.5, beyondTip = 0.99; // [cells]
	std::vector<BorderEdge> border;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f)
		for (int i = 0; i < 3; ++i) {
			if (!sheet.isBorder[f][i]) continue;
			const auto& facet = sheet.facets[f];
			const int   a = facet[i], b = facet[(i + 1) % 3];
			const Vec3 &from = sheet.positions[a], &to = sheet.positions[b];
			const Vec3  outwards = (to - from).cross(normalOf(from, to, sheet.positions[facet[(i + 2) % 3]])).normalized();
			const bool  isTip    = hasSoilBeyond(from, to, outwards, cloud, grid);
			const double h       = std::max(cellSizeAt(grid, from), cellSizeAt(grid, to));
			border.push_back({ a, b, outwards, (isTip ? beyondTip : beyondEnds) * h, isTip });
		}
	return border;
}

/// Way by which a vertex of the border goes outwards, so that it is as far from the lines of both its edges as they ask.
Vec3 shiftAt(const BorderEdge& one, const BorderEdge& other)
{
	constexpr double sharpest = 0.1; // sine squared
	const double     cosine = one.outwards.dot(other.outwards), det = 1 - cosine * cosine;
	if (det < sharpest) return std::max(one.length, other.length) * (one.outwards + other.outwards).normalized();
	return ((one.length - cosine * other.length) * one.outwards + (other.length - cosine * one.length) * other.outwards) / det;
}

/// Extends a sheet beyond its border: out of the cells around it, and where there is soil beyond it to the nodes next
/// to it.
Cut extended(const PartingSheet& sheet, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	Cut                             cut { sheet, {}, 0 };
	const auto                      border = borderOf(sheet, cloud, grid);
	std::map<int, std::vector<int>> at;
	for (std::size_t e = 0; e < border.size(); ++e)
		at[border[e].from].push_back(int(e)), at[border[e].to].push_back(int(e));
	std::map<int, int> beyond;
	for (const auto& [vertex, edges] : at) {
		beyond[vertex] = int(cut.sheet.positions.size());
		cut.sheet.positions.push_back(sheet.positions[vertex] + shiftAt(border[edges.front()], border[edges.back()]));
	}
	for (const BorderEdge& edge : border) {
		const int a = beyond[edge.from], b = beyond[edge.to];
		cut.sheet.facets.push_back({ edge.to, edge.from, a });
		cut.sheet.facets.push_back({ edge.to, a, b });
		if (edge.isTip) cut.rim.push_back({ cut.sheet.positions[a], cut.sheet.positions[b] });
	}
	cut.sheet.prepare();
	return cut;
}

std::array<Vec3, 3> cornersOf(const PartingSheet& sheet, const std::array<int, 3>& facet)
{
	return { sheet.positions[facet[0]], sheet.positions[facet[1]], sheet.positions[facet[2]] };
}

std::pair<Vec3, Vec3> boundsOf(const PartingSheet& sheet, double margin)
{
	Vec3 low = sheet.positions.front(), high = low;
	for (const Vec3& x : sheet.positions)
		low = low.cwiseMin(x), high = high.cwiseMax(x);
	return { low.array() - margin, high.array() + margin };
}

bool isWithin(const Vec3& x, const std::pair<Vec3, Vec3>& box) { return (x - box.first).minCoeff() >= 0 && (box.second - x).minCoeff() >= 0; }

/// True if centres of points are beside a sheet on both of its sides.
bool isBetween(const PartingSheet& sheet, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	constexpr double    onSheet = 0.1; // [cells]
	const double        most    = (aside + reachOfSoil) * largestCell(grid);
	const auto          box     = boundsOf(sheet, most);
	std::array<bool, 2> found {};
	for (std::size_t p = 0; p < cloud.size() && !(found[0] && found[1]); ++p) {
		if (!isWithin(cloud.position[p], box)) continue;
		const FromSheet at = fromSheet(sheet, cloud.position[p], most);
		const double    h  = cellSizeAt(grid, cloud.position[p]);
		if (at.away <= (aside + reachOfSoil) * h && !at.isBeyond && at.away > onSheet * h) found[at.side > 0] = true;
	}
	return found[0] && found[1];
}

/// True if a triangle goes through the cube around a position (separating axes).
bool crosses(const std::array<Vec3, 3>& corners, const Vec3& middle, double half)
{
	const std::array<Vec3, 3> x { corners[0] - middle, corners[1] - middle, corners[2] - middle };
	const auto                isApart = [&](const Vec3& axis) {
                const double a = axis.dot(x[0]), b = axis.dot(x[1]), c = axis.dot(x[2]), reach = half * axis.cwiseAbs().sum();
                return std::min({ a, b, c }) > reach || std::max({ a, b, c }) < -reach;
	};
	for (int a = 0; a < 3; ++a)
		if (isApart(Vec3::Unit(a))) return false;
	if (isApart((x[1] - x[0]).cross(x[2] - x[0]))) return false;
	for (int i = 0; i < 3; ++i)
		for (int a = 0; a < 3; ++a)
			if (isApart((x[(i + 1) % 3] - x[i]).cross(Vec3::Unit(a)))) return false;
	return true;
}

bool crosses(const Segment& segment, const Vec3& middle, double half) { return crosses({ segment[0], segment[1], segment[1] }, middle, half); }

/// The nodes whose cells a sheet cuts in two: those of all levels that do not hang, in layer 0.
std::vector<Key> nodesCut(const Cut& cut, const Grid<3>& grid)
{
	std::vector<Key> nodes;
	for (int level = 0; level <= (grid.refinement ? grid.refinement->largest() : 0); ++level) {
		const double h = grid.size(level), around = (1 - 1e-6) * h;
		for (const auto& facet : cut.sheet.facets) {
			const auto     x    = cornersOf(cut.sheet, facet);
			const Index<3> low  = ((x[0].cwiseMin(x[1]).cwiseMin(x[2]) - grid.origin) / h).array().floor().cast<int>() - 1;
			const Index<3> high = ((x[0].cwiseMax(x[1]).cwiseMax(x[2]) - grid.origin) / h).array().ceil().cast<int>() + 1;
			for (int k = low[2]; k <= high[2]; ++k)
				for (int j = low[1]; j <= high[1]; ++j)
					for (int i = low[0]; i <= high[0]; ++i) {
						const Index<3> node = Index<3>(i, j, k) * (1 << level);
						if (!crosses(x, grid.nodePosition(node), around)) continue;
						if (!grid.refinement || grid.refinement->largestAt(node) == level) nodes.push_back(Grid<3>::key(node, level));
					}
		}
	}
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	const auto isAtRim = [&](Key node) {
		const double around = (1 - 1e-6) * grid.size(Grid<3>::level(node));
		const Vec3   middle = grid.nodePosition(Grid<3>::index(node));
		return std::any_of(cut.rim.begin(), cut.rim.end(), [&](const Segment& rim) { return crosses(rim, middle, around); });
	};
	nodes.erase(std::remove_if(nodes.begin(), nodes.end(), isAtRim), nodes.end());
	return nodes;
}

/// The layer of a position near nodes of their own.
class LayerAt {
public:
	LayerAt(std::vector<Cut> cuts, std::vector<Key> own, const Grid<3>& grid)
	        : cuts_(std::move(cuts)), own_(std::move(own)), origin_(grid.origin), cellSize_(grid.cellSize), largest_(grid.refinement ? grid.refinement->largest() : 0)
	{
		for (const Cut& cut : cuts_)
			boxes_.push_back(boundsOf(cut.sheet, 3 * grid.size(largest_)));
	}
	int operator()(const Vec3& position) const
	{
		for (std::size_t c = 0; c < cuts_.size(); ++c)
			if (isWithin(position, boxes_[c]) && isNearOwn(position, cuts_[c].layer) && fromSheet(cuts_[c].sheet, position).side < 0) return cuts_[c].layer;
		return 0;
	}

private:
	/// True if own nodes are as near as domains reach: one cell and half of one.
	bool isNearOwn(const Vec3& position, int layer) const
	{
		for (int level = 0; level <= largest_; ++level) {
			const Vec3     x   = (position - origin_) / (cellSize_ * (1 << level));
			const Index<3> low = (x.array() - 1.5).ceil().cast<int>(), high = (x.array() + 1.5).floor().cast<int>();
			for (int i = low[0]; i <= high[0]; ++i)
				for (int j = low[1]; j <= high[1]; ++j)
					for (int k = low[2]; k <= high[2]; ++k)
						if (find(own_, Grid<3>::key(Index<3>(i, j, k) * (1 << level), level, layer)) >= 0) return true;
		}
		return false;
	}

	std::vector<Cut>                   cuts_;
	std::vector<std::pair<Vec3, Vec3>> boxes_;
	std::vector<Key>                   own_;
	Vec3                               origin_;
	double                             cellSize_;
	int                                largest_; // level
};

bool areApart(const std::vector<Key>& nodes, const std::vector<Key>& others)
{
	constexpr int near = 3;
	for (const Key node : nodes)
		for (const Key other : others)
			if ((Grid<3>::index(node) - Grid<3>::index(other)).cwiseAbs().maxCoeff() <= near << std::max(Grid<3>::level(node), Grid<3>::level(other)))
				return false;
	return true;
}

} // namespace

void PartingSheet::prepare()
{
	std::map<std::array<int, 2>, int> count;
	const auto                        edge = [](const std::array<int, 3>& facet, int i) {
                return std::array<int, 2> { std::min(facet[i], facet[(i + 1) % 3]), std::max(facet[i], facet[(i + 1) % 3]) };
	};
	for (const auto& facet : facets)
		for (int i = 0; i < 3; ++i)
			++count[edge(facet, i)];
	isBorder.clear(), boxes.clear();
	for (const auto& facet : facets) {
		const auto x = cornersOf(*this, facet);
		isBorder.push_back({ count[edge(facet, 0)] == 1, count[edge(facet, 1)] == 1, count[edge(facet, 2)] == 1 });
		boxes.emplace_back(x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2]));
	}
}

FromSheet fromSheet(const PartingSheet& sheet, const Vec3& position, double reach)
{
	FromSheet at;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
		const auto&  box    = sheet.boxes[f];
		const double offBox = (box.first - position).cwiseMax(position - box.second).cwiseMax(0.).norm();
		const auto   x      = cornersOf(sheet, sheet.facets[f]);
		const double same   = 1e-9 * (x[1] - x[0]).norm();
		if (offBox > std::min(at.away + same, reach)) continue;
		const Vec3   weights = closestWeights(x, position);
		const double away    = (position - weights[0] * x[0] - weights[1] * x[1] - weights[2] * x[2]).norm();
		if (away > at.away + same) continue;
		if (away < at.away - same) at.side = 0, at.isBeyond = false;
		at.side += angleAt(x, weights) * normalOf(x[0], x[1], x[2]).dot(position - x[0]);
		at.away = std::min(at.away, away);
		for (int i = 0; i < 3; ++i)
			at.isBeyond = at.isBeyond || (sheet.isBorder[f][i] && weights[(i + 2) % 3] == 0);
	}
	return at;
}

void lookBetween(const std::vector<PartingSheet*>& sheets, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	for (PartingSheet* sheet : sheets)
		sheet->layer = 0, sheet->isBetween = isBetween(*sheet, cloud, grid);
}

void partSoil(const std::vector<PartingSheet*>& sheets, PointCloud<3>& cloud, Grid<3>& grid)
{
	std::vector<Cut> cuts;
	std::vector<Key> taken, own;
	lookBetween(sheets, cloud, grid);
	for (PartingSheet* sheet : sheets) {
		if (int(cuts.size()) == Grid<3>::mostLayer || !sheet->isBetween) continue;
		Cut        cut   = extended(*sheet, cloud, grid);
		const auto nodes = nodesCut(cut, grid);
		if (nodes.empty() || !areApart(nodes, taken)) continue;
		sheet->layer = cut.layer = int(cuts.size()) + 1;
		for (const Key node : nodes)
			own.push_back(Parting<3>::in(cut.layer, node));
		taken.insert(taken.end(), nodes.begin(), nodes.end());
		cuts.push_back(std::move(cut));
	}
	grid.parting.reset();
	cloud.layer.clear();
	if (cuts.empty()) return;
	std::sort(own.begin(), own.end());
	grid.parting = std::make_shared<Parting<3>>(own, LayerAt(std::move(cuts), own, grid), grid.refinement);
	cloud.layer.resize(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p)
		cloud.layer[p] = grid.parting->layerAt(cloud.position[p]);
}

} // namespace gimpm
