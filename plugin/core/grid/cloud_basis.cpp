// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/cloud_basis.hpp"
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> Index<Dim> corner(const Index<Dim>& cell, int bits)
{
	Index<Dim> i = cell;
	for (int a = 0; a < Dim; ++a)
		i[a] += bits >> a & 1;
	return i;
}

/// The cell that holds the point's centre. On a face it is the lower cell, unless that lies behind the wall of that face.
template <int Dim> Index<Dim> containingCell(const Vec<Dim>& x, double h, const Boundary<Dim>& boundary)
{
	Index<Dim> cell;
	for (int a = 0; a < Dim; ++a)
		cell[a] = centreCell(x[a], h);
	for (int a = 0; a < Dim; ++a) {
		const Index<Dim> upper = cell + Index<Dim>::Unit(a), beyond = upper + Index<Dim>::Unit(a);
		const bool       onUpperFace = std::abs(x[a] / h - upper[a]) <= faceTolerance;
		if (onUpperFace && boundary.lowerFaceIsWall(upper, a) && boundary.lowerFaceIsWall(cell, a) && !boundary.lowerFaceIsWall(beyond, a))
			cell = upper;
	}
	return cell;
}

/// The cells of a window that can be reached from the cell of the centre through faces which are no walls.
template <int Dim> int reachableCells(const Index<Dim>& lowest, int span, int centre, const Boundary<Dim>& boundary)
{
	int reached = 1 << centre;
	for (int before = 0; before != reached;) {
		before = reached;
		for (int c = 0; c < 1 << Dim; ++c) {
			if (!(reached >> c & 1)) continue;
			for (int a = 0; a < Dim; ++a) {
				const int neighbour = c ^ 1 << a;
				if (!(span >> a & 1) || (reached >> neighbour & 1)) continue;
				if (!boundary.lowerFaceIsWall(corner<Dim>(lowest, c | 1 << a), a)) reached |= 1 << neighbour;
			}
		}
	}
	return reached;
}

/// Where a cell stands in the order of colours, of the tiles of a colour and of the cells of a tile. Domains with the lowest cell in a tile
/// reach the first nodes beyond it, and no others as long as a tile is at least two cells wide: between two tiles of a colour lies another.
template <int Dim> struct TileOrder {
	static constexpr int widthBits = 2; ///< a tile is 2^widthBits cells wide
	static constexpr int bits = Grid<Dim>::keyBits, highBits = bits - widthBits - 1;

	static Key of(Key cell)
	{
		Key colour = 0, tile = 0, inside = 0;
		for (int a = Dim - 1; a >= 0; --a, cell <<= bits) {
			const Key along = low(cell >> bits * (Dim - 1), bits);
			inside          = inside << widthBits | low(along, widthBits);
			colour          = colour << 1 | low(along >> widthBits, 1);
			tile            = tile << highBits | along >> (widthBits + 1);
		}
		return (colour << Dim * highBits | tile) << Dim * widthBits | inside;
	}
	static Key cell(Key place)
	{
		Key       cell    = 0;
		const Key colours = place >> Dim * (bits - 1), tiles = tile(place);
		for (int a = 0; a < Dim; ++a) {
			const Key along = low(tiles >> a * highBits, highBits) << 1 | low(colours >> a, 1);
			cell |= (along << widthBits | low(place >> a * widthBits, widthBits)) << a * bits;
		}
		return cell;
	}
	static Key tile(Key place) { return place >> Dim * widthBits; } ///< with its colour

private:
	static constexpr Key low(Key k, int bits) { return k & ((Key(1) << bits) - 1); }
};

/// What the points are sorted by. It is kept small: the basis functions are computed once the order is known.
template <int Dim> struct Place {
	Key      order; // of the lowest cell
	unsigned kind;  // span and cells
	int      point;

	Place() { } // all are set
	Place(Key cell, int span, int cells, int point)
	        : order(TileOrder<Dim>::of(cell)), kind(unsigned(span) << (1 << Dim) | unsigned(cells)), point(point) { }
	int  span() const { return int(kind >> (1 << Dim)); }
	int  cells() const { return int(kind & ((1 << (1 << Dim)) - 1)); }
	bool samePatch(const Place& o) const { return order == o.order && kind == o.kind; }
	bool operator<(const Place& o) const { return whole() < o.whole(); } // without branches, which could only guess here

private:
	unsigned __int128 whole() const { return (unsigned __int128)order << 64 | Key(kind) << 32 | unsigned(point); }
};

/// How far the domain reaches behind walls, as a length of its own axis: the part on the other side of a face than the centre.
template <int Dim> double hiddenLength(const Place<Dim>& p, const Vec<Dim>& x, const Vec<Dim>& halfSize, double h, const Index<Dim>& lowest, int centre)
{
	double length = 0;
	for (int a = 0; a < Dim; ++a)
		if ((p.span() >> a & 1) && !(p.cells() >> (centre ^ 1 << a) & 1)) length = std::max(length, halfSize[a] - std::abs(x[a] - h * (lowest[a] + 1)));
	return length;
}

template <int Dim> Place<Dim> place(const PointCloud<Dim>& cloud, int point, const Grid<Dim>& grid, Basis basis, const Boundary<Dim>& boundary, double& hidden)
{
	const Vec<Dim>   x = cloud.position[point] - grid.origin, &halfSize = cloud.halfSize[point];
	const Index<Dim> centre = containingCell<Dim>(x, grid.cellSize, boundary);
	Index<Dim>       lowest = centre;
	int              span = 0, centreBits = 0; // which cell of the window holds the centre
	for (int a = 0; basis == Basis::gimp && a < Dim; ++a) {
		const auto cells = AxisCells::reached(x[a], halfSize[a], grid.cellSize);
		lowest[a]        = cells.lowest;
		if (cells.count == 1) continue;
		span |= 1 << a;
		if (centre[a] > lowest[a]) centreBits |= 1 << a;
	}
	const Place<Dim> p(Grid<Dim>::key(grid.first(lowest)), span, reachableCells<Dim>(lowest, span, centreBits, boundary), point);
	hidden = std::max(hidden, hiddenLength<Dim>(p, x, halfSize, grid.cellSize, lowest, centreBits));
	return p;
}

/// Bits of the cells of the window that touch a node given by its position in the window.
inline int cellsAtNode(const int (&n)[3])
{
	constexpr int lower[3] = { 0b01010101, 0b00110011, 0b00001111 }; // the cells below, by axis
	int           cells    = 0b11111111;
	for (int a = 0; a < 3; ++a)
		if (n[a] != 1) cells &= n[a] == 0 ? lower[a] : ~lower[a];
	return cells;
}

/// Calls f(position in patch.node, key, position in a window of three nodes along each axis) for every node of the patch that touches a reached cell.
template <int Dim, class F> void forPatchNodes(const Patch<Dim>& patch, F&& f)
{
	int n[3] = { 0, 0, 0 }, local = 0;
	for (n[2] = 0; n[2] < (Dim == 3 ? patch.nodesAlong(Dim - 1) : 1); ++n[2])
		for (n[1] = 0; n[1] < patch.nodesAlong(1); ++n[1])
			for (n[0] = 0; n[0] < patch.nodesAlong(0); ++n[0], ++local) {
				if (!(cellsAtNode(n) & patch.cells)) continue;
				Key key = patch.cell;
				for (int a = 0; a < Dim; ++a)
					key += n[a] * Grid<Dim>::keyStep(a);
				f(local, key, n[0] + 3 * n[1] + 9 * n[2]);
			}
}

/// From sorted places.
template <int Dim> void makePatches(const std::vector<Place<Dim>>& places, CloudBasis<Dim>& b)
{
	b.order.resize(places.size());
	for (int i = 0; i < int(places.size()); ++i) {
		const auto& place = places[i];
		if (i == 0 || !place.samePatch(places[i - 1])) {
			b.patches.push_back({ TileOrder<Dim>::cell(place.order), place.span(), place.cells(), i, 0, {}, {} });
			b.patches.back().node.fill(-1);
			b.patches.back().reached.fill(-1);
		}
		++b.patches.back().count;
		b.order[i] = place.point;
	}
}

template <int Dim> void fillAxes(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, CloudBasis<Dim>& b)
{
	b.axes.resize(cloud.size());
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(b.patches.size()); ++k) {
		const auto&      patch = b.patches[k];
		const Index<Dim> cell  = Grid<Dim>::index(patch.cell);
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int      p = b.order[i];
			const Vec<Dim> x = cloud.position[p] - grid.origin;
			for (int a = 0; a < Dim; ++a)
				b.axes[i][a].setGimp(
				        grid.imageNear(x[a], cell[a] + 1, a), cloud.halfSize[p][a], grid.cellSize, { cell[a], patch.nodesAlong(a) - 1 });
		}
	}
}

/// a = the union of a and { key + step : key in b }, all sorted.
void unite(std::vector<Key>& a, const std::vector<Key>& b, Key step)
{
	std::vector<Key> shifted(b.size()), both;
	std::transform(b.begin(), b.end(), shifted.begin(), [step](Key key) { return key + step; });
	std::set_union(a.begin(), a.end(), shifted.begin(), shifted.end(), std::back_inserter(both));
	a.swap(both);
}

/// The nodes or cells that stand for these.
template <int Dim> void keepFirst(std::vector<Key>& keys, const Grid<Dim>& grid)
{
	if (!grid.isPeriodic()) return;
	std::transform(keys.begin(), keys.end(), keys.begin(), [&](Key key) { return grid.first(key); });
	std::sort(keys.begin(), keys.end());
	keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

template <int Dim> std::vector<Key> populatedCells(const std::vector<Patch<Dim>>& patches, const Grid<Dim>& grid)
{
	std::vector<std::pair<Key, int>> lowest; // with the cells of the window
	for (const auto& patch : patches)
		if (lowest.empty() || lowest.back().first != patch.cell) lowest.push_back({ patch.cell, patch.cells });
		else
			lowest.back().second |= patch.cells;
	std::sort(lowest.begin(), lowest.end());
	std::vector<Key> cells, those;
	for (int c = 0; c < windowCells<Dim>; ++c, those.clear()) {
		for (const auto& [cell, window] : lowest)
			if (window >> c & 1) those.push_back(cell);
		unite(cells, those, Grid<Dim>::keyOffset(c));
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

/// The active nodes are the corners of the populated cells.
template <int Dim> void numberNodes(CloudBasis<Dim>& b, const Grid<Dim>& grid)
{
	b.cells = b.nodes = populatedCells(b.patches, grid);
	for (int a = 0; a < Dim; ++a)
		unite(b.nodes, std::vector<Key>(b.nodes), Grid<Dim>::keyStep(a));
	keepFirst(b.nodes, grid);
	int lastCell[windowCells<Dim>] = {}, lastNode[27] = {};
	for (auto& patch : b.patches) {
		for (int c = 0; c < windowCells<Dim>; ++c)
			if (patch.cells >> c & 1) patch.reached[c] = positionNear(lastCell[c], b.cells, grid.first(patch.cell + Grid<Dim>::keyOffset(c)));
		forPatchNodes(patch, [&](int local, Key key, int place) { patch.node[local] = positionNear(lastNode[place], b.nodes, grid.first(key)); });
	}
}

/// Along one axis tiles take turns. Where the grid repeats itself, the last of an odd number of tiles meets the first, of its own colour; so does the
/// last but one where the last is a single cell, beyond which its domains reach.
template <int Dim> int colourAlong(int tile, int period)
{
	constexpr int width      = 1 << TileOrder<Dim>::widthBits;
	const int     tiles      = (period + width - 1) / width;
	const bool    meetsFirst = tiles % 2 != 0 ? tile == tiles - 1 : tile == tiles - 2 && period % width == 1;
	return period != 0 && meetsFirst ? 2 : tile & 1;
}

template <int Dim> int colourOf(Key cell, const Grid<Dim>& grid)
{
	const Index<Dim> i      = Grid<Dim>::index(cell);
	int              colour = 0;
	for (int a = Dim - 1; a >= 0; --a)
		colour = (grid.isPeriodic() ? 3 : 2) * colour + colourAlong<Dim>(i[a] >> TileOrder<Dim>::widthBits, grid.period[a]);
	return colour;
}

template <int Dim> void colourPatches(CloudBasis<Dim>& b, const Grid<Dim>& grid)
{
	b.colours.resize(grid.isPeriodic() ? (Dim == 2 ? 9 : 27) : windowCells<Dim>);
	const auto order = [&](int patch) { return TileOrder<Dim>::of(b.patches[patch].cell); };
	for (int first = 0, last = 0; first < int(b.patches.size()); first = last) {
		const Key place = order(first);
		while (last < int(b.patches.size()) && TileOrder<Dim>::tile(order(last)) == TileOrder<Dim>::tile(place))
			++last;
		b.colours[colourOf<Dim>(b.patches[first].cell, grid)].push_back({ first, last });
	}
}

} // namespace

template <int Dim> CloudBasis<Dim> cloudBasis(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, Basis basis, const Boundary<Dim>& boundary)
{
	CloudBasis<Dim>         b;
	std::vector<Place<Dim>> places(cloud.size());
	double                  hidden = 0;
#pragma omp parallel for reduction(max : hidden)
	for (int p = 0; p < int(cloud.size()); ++p)
		places[p] = place(cloud, p, grid, basis, boundary, hidden);
	b.largestWallOverlap = hidden;
	std::sort(places.begin(), places.end());
	makePatches(places, b);
	fillAxes(cloud, grid, b);
	numberNodes(b, grid);
	colourPatches(b, grid);
	return b;
}

template CloudBasis<2> cloudBasis(const PointCloud<2>&, const Grid<2>&, Basis, const Boundary<2>&);
template CloudBasis<3> cloudBasis(const PointCloud<3>&, const Grid<3>&, Basis, const Boundary<3>&);

} // namespace gimpm
