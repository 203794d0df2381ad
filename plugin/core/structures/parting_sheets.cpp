// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/parting_sheets.hpp"
#include "core/structures/cuts.hpp"
#include <algorithm>
#include <map>

namespace gimpm {
namespace {

using Triangle = std::array<Vec3, 3>;

Vec3 normalTo(const Triangle& x) { return (x[1] - x[0]).cross(x[2] - x[0]).normalized(); }

/// Weights of the corners of a triangle at its closest point to a position; those on its border are 0 there.
Vec3 closestWeights(const Triangle& x, const Vec3& position)
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
double angleAt(const Triangle& x, const Vec3& weights)
{
	const int zeros = int((weights.array() == 0).count());
	if (zeros < 2) return zeros == 0 ? 2 * M_PI : M_PI;
	int corner;
	weights.maxCoeff(&corner);
	const Vec3 a = (x[(corner + 1) % 3] - x[corner]).normalized(), b = (x[(corner + 2) % 3] - x[corner]).normalized();
	return std::acos(std::clamp(a.dot(b), -1., 1.));
}

/// True if a triangle goes through the cube around a position (separating axes).
bool passesThrough(const Triangle& corners, const Vec3& middle, double half)
{
	const Triangle x { corners[0] - middle, corners[1] - middle, corners[2] - middle };
	const auto     isApart = [&](const Vec3& axis) {
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

Triangle cornersOf(const PartingSheet& sheet, const std::array<int, 3>& facet)
{
	return { sheet.positions[facet[0]], sheet.positions[facet[1]], sheet.positions[facet[2]] };
}

/// A sheet with a margin at its border, and the edges around which soil stays whole.
struct SheetCut : PartingSheet {
	std::vector<LeakyCut<3>> leaks; ///< ahead of its edges
	std::vector<Triangle>    rim;   ///< edges, as triangles without area
	Limits                   limits {};

	std::vector<Triangle> pieces() const
	{
		std::vector<Triangle> all;
		for (const auto& facet : facets)
			all.push_back(cornersOf(*this, facet));
		return all;
	}
	double side(const Vec3& x) const { return sideOf(*this, x); }
	bool   crosses(const Triangle& piece, const Vec3& middle, double half) const { return passesThrough(piece, middle, half); }
	bool   endsIn(const Vec3& middle, double half) const
	{
		return std::any_of(rim.begin(), rim.end(), [&](const Triangle& edge) { return passesThrough(edge, middle, half); });
	}
};

/// Another sheet that may part the soil, at which an edge ends by its middle; null: none.
const PartingSheet* otherAt(const std::vector<PartingSheet*>& sheets, const PartingSheet& sheet, const Vec3& middle, double cellSize)
{
	for (const PartingSheet* other : sheets)
		if (other != &sheet && other->isBetween && isAtMiddle(*other, middle, onOther * cellSize)) return other;
	return nullptr;
}

double fromEdge(const Vec3& from, const Vec3& to, const Vec3& position)
{
	const Vec3 along = to - from;
	return (position - from - std::clamp((position - from).dot(along) / along.squaredNorm(), 0., 1.) * along).norm();
}

/// An edge that bounds a sheet, as its facet runs round it.
struct BorderEdge {
	int    from, to;
	Vec3   outwards; ///< in the plane of the facet
	double length;   ///< by which the cut goes on beyond it [m]
	bool   isTip;    ///< there is soil beyond it
};

/// The edge from a vertex to another one of a facet, by what is beyond it at positions no farther apart than the
/// smallest cells. A cut goes on by the smallest of the cells along an edge where there is soil, so that none ends
/// farther beyond.
BorderEdge borderEdge(
        const PartingSheet& sheet, const std::array<int, 3>& facet, int i, const std::vector<PartingSheet*>& others, const PointCloud<3>& cloud,
        const Grid<3>& grid)
{
	const Triangle      x     = cornersOf(sheet, { facet[i], facet[(i + 1) % 3], facet[(i + 2) % 3] });
	const Vec3          along = x[1] - x[0], outwards = along.cross(normalTo(x)).normalized();
	const int           parts = int(std::min(1e4, std::ceil(along.norm() / grid.cellSize)));
	std::vector<Vec3>   positions;
	std::vector<double> reach, size;
	std::vector<bool>   areAtOther;
	const Vec3          middle = (x[0] + x[1]) / 2;
	const auto*         other  = otherAt(others, sheet, middle, cellSizeAt(grid, middle));
	for (int part = 0; part < parts; ++part) {
		const Vec3 on = x[0] + (part + 0.5) / parts * along;
		areAtOther.push_back(other && awayFrom(*other, on) <= onOther * cellSizeAt(grid, on));
		size.push_back(cellSizeAt(grid, on));
		positions.push_back(on + asideOfCut * size.back() * outwards);
		reach.push_back(reachBesideCut * size.back());
	}
	const auto isFar = areFarFromMaterial<3>(positions, reach, cloud, grid);
	bool       isTip = false;
	for (std::size_t part = 0; part < isFar.size(); ++part)
		isTip = isTip || (!isFar[part] && !areAtOther[part]);
	const auto [smallest, largest] = std::minmax_element(size.begin(), size.end());
	return { facet[i], facet[(i + 1) % 3], outwards, isTip ? beyondTip * *smallest : beyondEnds * *largest, isTip };
}

std::vector<BorderEdge> borderOf(const PartingSheet& sheet, const std::vector<PartingSheet*>& others, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	std::vector<BorderEdge> border;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f)
		for (int i = 0; i < 3; ++i)
			if (sheet.isBorder[f][i]) border.push_back(borderEdge(sheet, sheet.facets[f], i, others, cloud, grid));
	return border;
}

/// Way by which a vertex of the border goes outwards, so that it is as far from the lines of both its edges as they
/// ask.
Vec3 shiftAt(const BorderEdge& one, const BorderEdge& other)
{
	constexpr double sharpest = 0.1; // sine squared
	const double     cosine = one.outwards.dot(other.outwards), det = 1 - cosine * cosine;
	if (det < sharpest) return std::max(one.length, other.length) * (one.outwards + other.outwards).normalized();
	return ((one.length - cosine * other.length) * one.outwards + (other.length - cosine * one.length) * other.outwards) / det;
}

/// Extends a sheet beyond its border: out of the cells around it, and where there is soil beyond it to the nodes next
/// to it.
SheetCut extended(const PartingSheet& sheet, const std::vector<PartingSheet*>& others, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	SheetCut                        cut { sheet, {}, {} };
	const auto                      border = borderOf(sheet, others, cloud, grid);
	std::map<int, std::vector<int>> at;
	for (std::size_t e = 0; e < border.size(); ++e)
		at[border[e].from].push_back(int(e)), at[border[e].to].push_back(int(e));
	std::map<int, int> beyond;
	for (const auto& [vertex, edges] : at) {
		beyond[vertex] = int(cut.positions.size());
		cut.positions.push_back(sheet.positions[vertex] + shiftAt(border[edges.front()], border[edges.back()]));
	}
	for (const BorderEdge& edge : border) {
		const int a = beyond[edge.from], b = beyond[edge.to];
		cut.facets.push_back({ edge.to, edge.from, a });
		cut.facets.push_back({ edge.to, a, b });
		if (!edge.isTip) continue;
		cut.rim.push_back({ cut.positions[a], cut.positions[b], cut.positions[b] });
		for (auto ahead = cut.facets.end() - 2; ahead != cut.facets.end(); ++ahead)
			cut.leaks.push_back({ cornersOf(cut, *ahead), 0, LeakyCut<3>::asSoil });
	}
	cut.prepare();
	return cut;
}

/// Centres of points by the largest cells that they are in.
class PointsByCell {
public:
	PointsByCell(const PointCloud<3>& cloud, const Bounds<3>& box, const Grid<3>& grid) : cloud_(cloud), origin_(grid.origin), size_(largestCell(grid))
	{
		for (int p = 0; p < int(cloud.size()); ++p)
			if (box.contain(cloud.position[p])) points_.emplace_back(Grid<3>::key(cell(cloud.position[p])), p);
		std::sort(points_.begin(), points_.end());
	}

	/// Calls f(position) for the points in a box and some around it, until it is true; then true.
	template <class F> bool anyIn(const Bounds<3>& box, F&& f) const
	{
		const Index<3> low = cell(box.low), high = cell(box.high);
		for (int k = low[2]; k <= high[2]; ++k)
			for (int j = low[1]; j <= high[1]; ++j) { // the cells of a row have keys that follow each other
				const Key last = Grid<3>::key({ high[0], j, k });
				auto      i    = std::lower_bound(points_.begin(), points_.end(), std::pair(Grid<3>::key({ low[0], j, k }), -1));
				for (; i != points_.end() && i->first <= last; ++i)
					if (f(cloud_.position[i->second])) return true;
			}
		return false;
	}

private:
	Index<3> cell(const Vec3& x) const
	{
		constexpr double limit = Grid<3>::indexLimit;
		return ((x - origin_) / size_).array().floor().min(limit).max(-limit).cast<int>();
	}

	const PointCloud<3>&             cloud_;
	const Vec3                       origin_;
	const double                     size_;
	std::vector<std::pair<Key, int>> points_;
};

/// True if centres of points are before facets of a sheet on both of its sides.
bool isBetween(const PartingSheet& sheet, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	constexpr double    onSheet = 0.1; // [cells]
	const double        most    = (asideOfCut + reachBesideCut) * largestCell(grid);
	const PointsByCell  points(cloud, Bounds<3>(sheet.positions, most), grid);
	std::array<bool, 2> found {};
	for (const auto& facet : sheet.facets) {
		const Triangle x      = cornersOf(sheet, facet);
		const Vec3     normal = normalTo(x);
		const auto     look   = [&](const Vec3& position) {
                        const double left = normal.dot(position - x[0]), h = cellSizeAt(grid, position);
                        if (std::abs(left) > (asideOfCut + reachBesideCut) * h || std::abs(left) <= onSheet * h || found[left > 0]) return false;
                        if ((closestWeights(x, position).array() > 0).all()) found[left > 0] = true;
                        return found[0] && found[1];
		};
		if (points.anyIn(Bounds<3>({ x[0], x[1], x[2] }, most), look)) return true;
	}
	return false;
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

double awayFrom(const PartingSheet& sheet, const Vec3& position)
{
	double least = std::numeric_limits<double>::infinity();
	for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
		const auto& box = sheet.boxes[f];
		if ((box.first - position).cwiseMax(position - box.second).cwiseMax(0.).norm() > least) continue;
		const auto x       = cornersOf(sheet, sheet.facets[f]);
		const Vec3 weights = closestWeights(x, position);
		least              = std::min(least, (position - weights[0] * x[0] - weights[1] * x[1] - weights[2] * x[2]).norm());
	}
	return least;
}

bool isAtMiddle(const PartingSheet& sheet, const Vec3& position, double reach)
{
	if (awayFrom(sheet, position) > reach) return false;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f)
		for (int i = 0; i < 3; ++i)
			if (sheet.isBorder[f][i]
			    && fromEdge(sheet.positions[sheet.facets[f][i]], sheet.positions[sheet.facets[f][(i + 1) % 3]], position) <= reach)
				return false;
	return true;
}

std::vector<Vec3> middlesOf(const PartingSheet& sheet)
{
	std::vector<Vec3> middles;
	for (const auto& facet : sheet.facets)
		middles.push_back((sheet.positions[facet[0]] + sheet.positions[facet[1]] + sheet.positions[facet[2]]) / 3);
	return middles;
}

std::vector<Vec3> endsOf(const PartingSheet& sheet)
{
	std::vector<Vec3> middles;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f)
		for (int i = 0; i < 3; ++i)
			if (sheet.isBorder[f][i]) middles.push_back((sheet.positions[sheet.facets[f][i]] + sheet.positions[sheet.facets[f][(i + 1) % 3]]) / 2);
	return middles;
}

double sideFrom(const PartingSheet& sheet, const Vec3& position) { return sideOf(sheet, position); }

double sideOf(const PartingSheet& sheet, const Vec3& position)
{
	double least = std::numeric_limits<double>::infinity(), side = 0;
	for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
		const auto&  box    = sheet.boxes[f];
		const double offBox = (box.first - position).cwiseMax(position - box.second).cwiseMax(0.).norm();
		const auto   x      = cornersOf(sheet, sheet.facets[f]);
		const double same   = 1e-9 * (x[1] - x[0]).norm();
		if (offBox > least + same) continue;
		const Vec3   weights = closestWeights(x, position);
		const double away    = (position - weights[0] * x[0] - weights[1] * x[1] - weights[2] * x[2]).norm();
		if (away > least + same) continue;
		if (away < least - same) side = 0;
		side += angleAt(x, weights) * normalTo(x).dot(position - x[0]);
		least = std::min(least, away);
	}
	return side;
}

void lookBetween(const std::vector<PartingSheet*>& sheets, const PointCloud<3>& cloud, const Grid<3>& grid)
{
	for (PartingSheet* sheet : sheets)
		sheet->layer = 0, sheet->isBetween = isBetween(*sheet, cloud, grid);
}

void partSoil(const std::vector<PartingSheet*>& sheets, PointCloud<3>& cloud, Grid<3>& grid, bool mayBeNear)
{
	const std::vector<PartingSheet*> none;
	lookBetween(sheets, cloud, grid);
	partByCuts<3>(sheets, cloud, grid, mayBeNear, [&](const PartingSheet& sheet) { return extended(sheet, mayBeNear ? sheets : none, cloud, grid); });
}

} // namespace gimpm
