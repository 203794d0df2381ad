// SPDX-License-Identifier: GPL-2.0-or-later
// Cuts of lines and surfaces through the soil, and the nodes that are there twice at them.
#pragma once
#include "core/grid/nearness.hpp"
#include "core/grid/parting.hpp"
#include "core/grid/point_cloud.hpp"

namespace gimpm {

/// Beyond the end of a line or surface, where soil would make it the end of a cut; to the sides, where there is soil to
/// be parted [cells].
constexpr double asideOfCut = 0.5, reachBesideCut = 0.25;
/// Lengths by which a cut goes on beyond an end without soil, and with soil [cells].
constexpr double beyondEnds = 1.5, beyondTip = 0.99;

/// Distance within which the end of a thin body is at another one [cells].
constexpr double onOther = 0.5;

/// Sides of other cuts, by their numbers, on which a cut parts soil: 1 left, -1 right.
using Limits = std::vector<std::pair<std::size_t, int>>;

/// Box around positions, wider by a margin.
template <int Dim> struct Bounds {
	Vec<Dim> low, high;

	Bounds(const std::vector<Vec<Dim>>& positions, double margin) : low(positions.front()), high(low)
	{
		for (const Vec<Dim>& x : positions)
			low = low.cwiseMin(x), high = high.cwiseMax(x);
		low.array() -= margin, high.array() += margin;
	}
	bool contain(const Vec<Dim>& x) const { return (x - low).minCoeff() >= 0 && (high - x).minCoeff() >= 0; }
};

template <int Dim> int levelsOf(const Grid<Dim>& grid) { return grid.refinement ? grid.refinement->largest() + 1 : 1; }

/// Calls f(lowest node of each level along each axis) for the nodes of a level in a box.
template <int Dim, class F> void forNodesIn(const Vec<Dim>& low, const Vec<Dim>& high, int level, const Grid<Dim>& grid, F&& f)
{
	const Index<Dim> first = ((low - grid.origin) / grid.size(level)).array().floor().template cast<int>() - 1;
	const Index<Dim> last  = ((high - grid.origin) / grid.size(level)).array().ceil().template cast<int>() + 1;
	for (Index<Dim> i = first;;) {
		f(Index<Dim>(i * (1 << level)));
		int a = Dim - 1;
		while (a >= 0 && ++i[a] > last[a])
			i[a] = first[a], --a;
		if (a < 0) return;
	}
}

/// The nodes whose cells a cut divides in two: those of all levels that do not hang, in layer 0, sorted.
///
/// A cut has `positions`, `pieces()` as corners, crosses(piece, middle, half) with the square or cube around a
/// position, and endsIn(middle, half) if it ends there.
template <int Dim, class Cut> std::vector<Key> nodesCut(const Cut& cut, const Grid<Dim>& grid)
{
	std::vector<Key> nodes;
	for (int level = 0; level < levelsOf(grid); ++level) {
		const double around = (1 - 1e-6) * grid.size(level);
		for (const auto& piece : cut.pieces()) {
			const Bounds<Dim> box(std::vector<Vec<Dim>>(piece.begin(), piece.end()), 0);
			forNodesIn<Dim>(box.low, box.high, level, grid, [&](const Index<Dim>& node) {
				if (cut.crosses(piece, grid.nodePosition(node), around) && (!grid.refinement || grid.refinement->largestAt(node) == level))
					nodes.push_back(Grid<Dim>::key(node, level));
			});
		}
	}
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	const auto isAtEnd = [&](Key node) { return cut.endsIn(grid.nodePosition(Grid<Dim>::index(node)), (1 - 1e-6) * grid.size(Grid<Dim>::level(node))); };
	nodes.erase(std::remove_if(nodes.begin(), nodes.end(), isAtEnd), nodes.end());
	return nodes;
}

/// The layer of a position near nodes of their own, with the bits of cuts with a `layer` of one bit, the side(position)
/// < 0 that has it, and the `limits` within which they part soil.
template <int Dim, class Cut> class LayerByCuts {
public:
	/// `own`: the nodes that are there twice, by cut.
	LayerByCuts(std::vector<Cut> cuts, std::vector<std::vector<Key>> own, const Grid<Dim>& grid)
	        : cuts_(std::move(cuts)), own_(std::move(own)), origin_(grid.origin), cellSize_(grid.cellSize), levels_(levelsOf(grid))
	{
		for (const Cut& cut : cuts_)
			boxes_.emplace_back(cut.positions, 4 * largestCell(grid));
	}
	int operator()(const Vec<Dim>& position, int /*ofBody*/) const
	{
		int layer = 0;
		for (std::size_t c = 0; c < cuts_.size(); ++c)
			if (boxes_[c].contain(position) && isNear(own_[c], position) && cuts_[c].side(position) < 0 && isWithin(cuts_[c], position))
				layer |= cuts_[c].layer;
		return layer;
	}

private:
	/// True if own nodes are as near as domains reach: one cell and half of one.
	bool isNear(const std::vector<Key>& own, const Vec<Dim>& position) const
	{
		for (int level = 0; level < levels_; ++level) {
			const Vec<Dim>   x    = (position - origin_) / (cellSize_ * (1 << level));
			const Index<Dim> low  = (x.array() - 1.5).ceil().template cast<int>(),
			                 size = (x.array() + 1.5).floor().template cast<int>() - low.array() + 1;
			for (int n = 0; n < size.prod(); ++n) {
				Index<Dim> node = low;
				for (int a = 0, rest = n; a < Dim; rest /= size[a], ++a)
					node[a] += rest % size[a];
				if (find(own, Grid<Dim>::key(node * (1 << level), level)) >= 0) return true;
			}
		}
		return false;
	}

	/// True on the side of all other cuts that a cut does not go beyond.
	bool isWithin(const Cut& cut, const Vec<Dim>& position) const
	{
		return std::all_of(cut.limits.begin(), cut.limits.end(), [&](const auto& limit) {
			const auto& [other, side] = limit;
			return !boxes_[other].contain(position) || side * cuts_[other].side(position) >= 0;
		});
	}

	std::vector<Cut>              cuts_;
	std::vector<Bounds<Dim>>      boxes_;
	std::vector<std::vector<Key>> own_;
	Vec<Dim>                      origin_;
	double                        cellSize_;
	int                           levels_;
};

/// True if no two nodes are within three cells, of the larger one's level.
template <int Dim> bool areApart(const std::vector<Key>& nodes, const std::vector<Key>& others)
{
	constexpr int near = 3;
	for (const Key node : nodes)
		for (const Key other : others)
			if ((Grid<Dim>::index(node) - Grid<Dim>::index(other)).cwiseAbs().maxCoeff() <= near
			            << std::max(Grid<Dim>::level(node), Grid<Dim>::level(other)))
				return false;
	return true;
}

/// A layer of one bit that no cut near a new one has, and if there is one no other cut; 0: there is none. `mayBeNear`:
/// false: the new one must be apart from all.
template <int Dim, class Cut>
int freeLayer(const std::vector<Key>& nodes, const std::vector<Cut>& cuts, const std::vector<std::vector<Key>>& own, bool mayBeNear)
{
	int near = 0, taken = 0;
	for (std::size_t c = 0; c < cuts.size(); ++c) {
		taken |= cuts[c].layer;
		if (!areApart<Dim>(nodes, own[c])) near |= cuts[c].layer;
	}
	if (near != 0 && !mayBeNear) return 0;
	for (const int used : { taken, near })
		for (int layer = 1; layer <= Grid<Dim>::mostLayer; layer <<= 1)
			if (!(used & layer)) return layer;
	return 0;
}

/// Sides of other cuts beyond which a cut has no soil to part, as it ends at these.
template <int Dim, class Surface, class Cut> void limitCuts(const std::vector<Surface*>& surfaces, std::vector<Cut>& cuts, const Grid<Dim>& grid)
{
	for (std::size_t c = 0; c < cuts.size(); ++c)
		for (std::size_t other = 0; other < cuts.size(); ++other) {
			const auto ends = endsOf(*surfaces[c]);
			const auto isAt = [&](const Vec<Dim>& x) { return isAtMiddle(*surfaces[other], x, onOther * cellSizeAt(grid, x)); };
			if (c == other || std::none_of(ends.begin(), ends.end(), isAt)) continue;
			bool isOn[2] = {};
			for (const Vec<Dim>& x : middlesOf(*surfaces[c]))
				if (awayFrom(*surfaces[other], x) > onOther * cellSizeAt(grid, x)) isOn[sideFrom(*surfaces[other], x) > 0] = true;
			if (isOn[0] != isOn[1]) cuts[c].limits.push_back({ other, isOn[1] ? 1 : -1 });
		}
}

/// Gives surfaces (or lines) that have soil on both of their sides layers, the grid the nodes there that are there
/// twice, and points their layers; cutOf(surface) makes the cut of each. `mayBeNear`: also those that are not apart.
template <int Dim, class Surface, class CutOf>
void partByCuts(const std::vector<Surface*>& surfaces, PointCloud<Dim>& cloud, Grid<Dim>& grid, bool mayBeNear, CutOf&& cutOf)
{
	std::vector<decltype(cutOf(*surfaces.front()))> cuts;
	std::vector<Surface*>                           parting;
	std::vector<std::vector<Key>>                   nodesOfCuts;
	std::vector<Key>                                own;
	std::vector<LeakyCut<Dim>>                      leaks;
	for (Surface* surface : surfaces) {
		if (!surface->isBetween) continue;
		auto       cut   = cutOf(*surface);
		const auto nodes = nodesCut<Dim>(cut, grid);
		if (nodes.empty()) continue;
		surface->layer = cut.layer = freeLayer<Dim>(nodes, cuts, nodesOfCuts, mayBeNear);
		if (cut.layer == 0) continue;
		for (const Key node : nodes)
			own.push_back(Parting<Dim>::in(cut.layer, node));
		for (auto leak : cut.leaks)
			leak.layer = cut.layer, leaks.push_back(leak);
		parting.push_back(surface), cuts.push_back(std::move(cut)), nodesOfCuts.push_back(nodes);
	}
	grid.parting.reset();
	cloud.layer.clear();
	if (cuts.empty()) return;
	if (mayBeNear) limitCuts<Dim>(parting, cuts, grid);
	using Layers = LayerByCuts<Dim, typename decltype(cuts)::value_type>;
	grid.parting = std::make_shared<Parting<Dim>>(std::move(own), Layers(std::move(cuts), std::move(nodesOfCuts), grid), grid.refinement, std::move(leaks));
	cloud.layer.resize(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p)
		cloud.layer[p] = grid.parting->layerAt(cloud.position[p]);
}

} // namespace gimpm
