// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/cloud_basis.hpp"
#include "core/grid/neighbours.hpp"
#include "core/grid/point_order.hpp"
#include "core/grid/tile_order.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Bits of the cells of the window that touch a node given by its position in the window.
inline int cellsAtNode(const int (&n)[3])
{
	constexpr int lower[3] = { 0b01010101, 0b00110011, 0b00001111 }; // the cells below, by axis
	int           cells    = 0b11111111;
	for (int a = 0; a < 3; ++a)
		if (n[a] != 1) cells &= n[a] == 0 ? lower[a] : ~lower[a];
	return cells;
}

/// Calls f(position in patch.node, key, position in a window of three nodes along each axis) for every node of the
/// patch that touches a reached cell.
template <int Dim, class F> void forPatchNodes(const Patch<Dim>& patch, F&& f)
{
	int n[3] = { 0, 0, 0 }, local = 0;
	for (n[2] = 0; n[2] < (Dim == 3 ? patch.nodesAlong(Dim - 1) : 1); ++n[2])
		for (n[1] = 0; n[1] < patch.nodesAlong(1); ++n[1])
			for (n[0] = 0; n[0] < patch.nodesAlong(0); ++n[0], ++local) {
				if (!(cellsAtNode(n) & patch.cells)) continue;
				Key key = patch.cell;
				for (int a = 0; a < Dim; ++a)
					key += n[a] * Grid<Dim>::keyStep(a, Grid<Dim>::level(patch.cell));
				f(local, key, n[0] + 3 * n[1] + 9 * n[2]);
			}
}

/// Makes patches from points in their order.
template <int Dim> void makePatches(const std::vector<PointOrder<Dim>>& orders, CloudBasis<Dim>& b)
{
	b.order.resize(orders.size());
	for (int i = 0; i < int(orders.size()); ++i) {
		const auto& order = orders[i];
		if (i == 0 || !order.samePatch(orders[i - 1])) {
			b.patches.push_back({ TileOrder<Dim>::cell(order.order), order.span(), order.cells(), i, 0, {}, {} });
			b.patches.back().node.fill(-1);
			b.patches.back().reached.fill(-1);
		}
		++b.patches.back().count;
		b.order[i] = order.point;
	}
}

/// Basis functions along the axis x of a point: averages over the ring instead of its section, and the functions of the
/// hoop strain.
template <int Dim> void fillRing(const Grid<Dim>& grid, double r, double l, double h, Basis basis, const AxisCells& cells, AxisBasis& ring, AxisValues& hoop)
{
	const double x = r - grid.origin[0];
	AxisBasis    section;
	section.setGimp(x, l, h, cells);
	for (int n = 0; n < 4; ++n)
		hoop[n] = section.value[n] / r;
	ring.setRing(x, r, basis == Basis::gimp ? l : 0, h, cells);
}

template <int Dim> void fillAxes(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, Basis basis, CloudBasis<Dim>& b)
{
	b.axes.resize(cloud.size());
	b.hoop.resize(grid.axisymmetric ? cloud.size() : 0);
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(b.patches.size()); ++k) {
		const auto&      patch = b.patches[k];
		const int        level = Grid<Dim>::level(patch.cell);
		const double     h     = grid.size(level);
		const Index<Dim> cell  = Grid<Dim>::index(patch.cell) / (1 << level);
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int      p = b.order[i];
			const Vec<Dim> x = cloud.position[p] - grid.origin, half = domainIn(cloud, p, grid, level);
			for (int a = 0; a < Dim; ++a)
				b.axes[i][a].setGimp(grid.imageNear(x[a], cell[a] + 1, a), half[a], h, { cell[a], patch.nodesAlong(a) - 1 });
			if (grid.axisymmetric)
				fillRing(grid, cloud.position[p][0], half[0], h, basis, { cell[0], patch.nodesAlong(0) - 1 }, b.axes[i][0], b.hoop[i]);
		}
	}
}

/// a = the union of a and { key + offset of the key's level : key in b }, all sorted. The offset is that from a cell to
/// the one above it along the axes of the bits.
template <int Dim> void unite(std::vector<Key>& a, const std::vector<Key>& b, int bits)
{
	std::vector<Key> shifted(b.size()), both;
	const Key        offset = Grid<Dim>::keyOffset(bits);
	std::transform(b.begin(), b.end(), shifted.begin(), [offset](Key key) { return key + (offset << Grid<Dim>::level(key)); });
	std::set_union(a.begin(), a.end(), shifted.begin(), shifted.end(), std::back_inserter(both));
	a.swap(both);
}

void sortOut(std::vector<Key>& keys)
{
	std::sort(keys.begin(), keys.end());
	keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// The nodes or cells that stand for these.
template <int Dim> void keepFirst(std::vector<Key>& keys, const Grid<Dim>& grid)
{
	if (!grid.isPeriodic()) return;
	std::transform(keys.begin(), keys.end(), keys.begin(), [&](Key key) { return grid.first(key); });
	sortOut(keys);
}

template <int Dim> std::vector<Key> populatedCells(const std::vector<Patch<Dim>>& patches, const Grid<Dim>& grid)
{
	std::vector<std::pair<Key, int>> lowest; // lowest cells of patches, with the cells of the window
	for (const auto& patch : patches)
		if (lowest.empty() || lowest.back().first != patch.cell) lowest.push_back({ patch.cell, patch.cells });
		else
			lowest.back().second |= patch.cells;
	std::sort(lowest.begin(), lowest.end());
	std::vector<Key> cells, those;
	for (int c = 0; c < windowCells<Dim>; ++c, those.clear()) {
		for (const auto& [cell, window] : lowest)
			if (window >> c & 1) those.push_back(cell);
		unite<Dim>(cells, those, c);
	}
	keepFirst(cells, grid);
	return cells;
}

/// Position among sorted keys of one that is there, often where the last one was, or next to it.
int positionNear(int& last, const std::vector<Key>& sorted, Key key)
{
	for (const int near : { last, last + 1 })
		if (near < int(sorted.size()) && sorted[near] == key) return last = near;
	return last = position(sorted, key);
}

template <int Dim> std::vector<Key> cornersOf(const std::vector<Key>& cells)
{
	std::vector<Key> nodes = cells;
	for (int a = 0; a < Dim; ++a)
		unite<Dim>(nodes, std::vector<Key>(nodes), 1 << a);
	return nodes;
}

/// The leaves of the cells.
template <int Dim> void findLeaves(CloudBasis<Dim>& b, const Refinement<Dim>& refinement)
{
	for (const Key cell : b.cells)
		b.leaves.push_back(refinement.leafOf(cell));
	const std::vector<Key> leafOfCell = b.leaves;
	sortOut(b.leaves);
	for (const Key leaf : leafOfCell)
		b.leafOf.push_back(position(b.leaves, leaf));
}

/// The cells that stand for those of the layers, the leaves, and the nodes with their ties.
template <int Dim> void refineAndPart(CloudBasis<Dim>& b, const Grid<Dim>& grid)
{
	std::vector<Key> cells = b.cells;
	if (grid.parting) {
		std::transform(b.cells.begin(), b.cells.end(), b.cells.begin(), [&](Key cell) { return grid.parting->cellFor(cell); });
		sortOut(b.cells);
		cells.insert(cells.end(), b.cells.begin(), b.cells.end());
	}
	if (grid.refinement) findLeaves(b, *grid.refinement);
	cells.insert(cells.end(), b.leaves.begin(), b.leaves.end());
	for (const Key leaf : b.populatedLeaves())
		for (int a = 0; a < Dim; ++a)
			forCellsAbove(leaf, a, grid, [&](Key above, Key lower) {
				if (find(b.populatedLeaves(), above) < 0) return;
				cells.push_back(lower);
				cells.push_back(lower + Grid<Dim>::keyStep(a, Grid<Dim>::level(lower)));
			});
	sortOut(cells);
	b.nodes             = cornersOf<Dim>(cells);
	b.affineConstraints = tieNodes(b.nodes, grid);
}

/// The numbers of the cells and nodes of each patch; by what cell another one stands for is given.
template <int Dim, class CellFor> void numberPatches(CloudBasis<Dim>& b, const Grid<Dim>& grid, const CellFor& cellFor)
{
	int lastCell[windowCells<Dim>] = {}, lastNode[27] = {};
	for (auto& patch : b.patches) {
		for (int c = 0; c < windowCells<Dim>; ++c)
			if (patch.cells >> c & 1)
				patch.reached[c]
				        = positionNear(lastCell[c], b.cells, cellFor(patch.cell + Grid<Dim>::keyOffset(c, Grid<Dim>::level(patch.cell))));
		forPatchNodes(patch, [&](int local, Key key, int order) { patch.node[local] = positionNear(lastNode[order], b.nodes, grid.first(key)); });
	}
}

/// The active nodes are the corners of the populated cells; in a refined grid also those of their leaves and those
/// beside the faces between leaves of two sizes, beside a line that parts the body those in its layer, with the masters
/// of all.
template <int Dim> void numberNodes(CloudBasis<Dim>& b, const Grid<Dim>& grid, const Division& division)
{
	b.cells = division.united(populatedCells(b.patches, grid));
	if (grid.refinement || grid.parting) refineAndPart(b, grid);
	else
		b.nodes = cornersOf<Dim>(b.cells);
	keepFirst(b.nodes, grid);
	if (grid.parting) numberPatches(b, grid, [&](Key cell) { return grid.parting->cellFor(cell); });
	else
		numberPatches(b, grid, [&](Key cell) { return grid.first(cell); });
}

template <int Dim> void colourPatches(CloudBasis<Dim>& b, const Grid<Dim>& grid)
{
	b.colours.resize(coloursOf(grid));
	const auto order = [&](int patch) { return TileOrder<Dim>::of(b.patches[patch].cell); };
	for (int first = 0, last = 0; first < int(b.patches.size()); first = last) {
		const Key firstOrder = order(first);
		while (last < int(b.patches.size()) && TileOrder<Dim>::tile(order(last)) == TileOrder<Dim>::tile(firstOrder))
			++last;
		b.colours[colourOf(b.patches[first].cell, grid)].push_back({ first, last });
	}
}

} // namespace

template <int Dim>
CloudBasis<Dim> cloudBasis(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, Basis basis, const Boundary<Dim>& boundary, const Division& division)
{
	CloudBasis<Dim>              b;
	std::vector<PointOrder<Dim>> orders(cloud.size());
	double                       hidden = 0;
#pragma omp parallel for reduction(max : hidden)
	for (int p = 0; p < int(cloud.size()); ++p)
		orders[p] = pointOrder(cloud, p, grid, basis, boundary, hidden);
	b.largestWallOverlap = hidden;
	std::sort(orders.begin(), orders.end());
	makePatches(orders, b);
	fillAxes(cloud, grid, basis, b);
	numberNodes(b, grid, division);
	colourPatches(b, grid);
	return b;
}

template CloudBasis<2> cloudBasis(const PointCloud<2>&, const Grid<2>&, Basis, const Boundary<2>&, const Division&);
template CloudBasis<3> cloudBasis(const PointCloud<3>&, const Grid<3>&, Basis, const Boundary<3>&, const Division&);

} // namespace gimpm
