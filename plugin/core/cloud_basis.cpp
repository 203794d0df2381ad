// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/cloud_basis.hpp"
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
		if (onUpperFace && boundary.lowerFaceIsWall(upper, a) && boundary.lowerFaceIsWall(cell, a) && !boundary.lowerFaceIsWall(beyond, a)) cell = upper;
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

/// What the points are sorted by. It is kept small: the basis functions are computed again once the order is known, which takes less
/// time than moving them around.
template <int Dim> struct Place {
	Key      cell;
	unsigned kind; // span and cells
	int      point;

	Place() = default;
	Place(Key cell, int span, int cells, int point) : cell(cell), kind(unsigned(span) << (1 << Dim) | unsigned(cells)), point(point) { }
	int  span() const { return int(kind >> (1 << Dim)); }
	int  cells() const { return int(kind & ((1 << (1 << Dim)) - 1)); }
	bool samePatch(const Place& o) const { return cell == o.cell && kind == o.kind; }
	bool operator<(const Place& o) const { return cell != o.cell ? cell < o.cell : kind != o.kind ? kind < o.kind : point < o.point; }
};

template <int Dim> using Axes = std::array<AxisBasis, Dim>;

/// Basis functions of a point at x from the origin of the grid; `cell` holds it if its domain is not looked at.
template <int Dim> void setAxes(Axes<Dim>& axes, const Vec<Dim>& x, const Vec<Dim>& halfSize, double h, Basis basis, const Index<Dim>& cell)
{
	for (int a = 0; a < Dim; ++a)
		if (basis == Basis::gimp) axes[a].setGimp(x[a], halfSize[a], h);
		else
			axes[a].setLinear(x[a], h, cell[a]);
}

/// How far the domain reaches behind walls: its share in hidden cells, as a length of its own axis.
template <int Dim> double hiddenLength(const Place<Dim>& p, const Axes<Dim>& axes, const Vec<Dim>& halfSize, int centre)
{
	double length = 0;
	for (int a = 0; a < Dim; ++a)
		if ((p.span() >> a & 1) && !(p.cells() >> (centre ^ 1 << a) & 1))
			length = std::max(length, 2 * halfSize[a] * axes[a].fraction[1 - (centre >> a & 1)]);
	return length;
}

template <int Dim>
Place<Dim> place(const PointCloud<Dim>& cloud, int point, const Grid<Dim>& grid, Basis basis, const Boundary<Dim>& boundary, double& hidden)
{
	const Vec<Dim>   x      = cloud.position[point] - grid.origin;
	const Index<Dim> centre = containingCell<Dim>(x, grid.cellSize, boundary);
	Axes<Dim>        axes;
	Index<Dim>       lowest;
	int              span = 0, centreBits = 0; // which cell of the window holds the centre
	setAxes<Dim>(axes, x, cloud.halfSize[point], grid.cellSize, basis, centre);
	for (int a = 0; a < Dim; ++a) {
		lowest[a] = axes[a].cell;
		if (axes[a].cells == 1) continue;
		span |= 1 << a;
		if (centre[a] > lowest[a]) centreBits |= 1 << a;
	}
	const Place<Dim> p(Grid<Dim>::key(lowest), span, reachableCells<Dim>(lowest, span, centreBits, boundary), point);
	hidden = std::max(hidden, hiddenLength<Dim>(p, axes, cloud.halfSize[point], centreBits));
	return p;
}

/// Bits of the cells of the window that touch a node given by its position in the window.
inline int cellsAtNode(const int* n, int dim)
{
	int cells = 0;
	for (int c = 0; c < 1 << dim; ++c) {
		bool touches = true;
		for (int a = 0; a < dim; ++a)
			touches &= n[a] == (c >> a & 1) || n[a] == (c >> a & 1) + 1;
		cells |= touches << c;
	}
	return cells;
}

void sortUnique(std::vector<Key>& keys)
{
	std::sort(keys.begin(), keys.end());
	keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// Calls f(position in patch.node, key) for every node of the patch that touches a reached cell.
template <int Dim, class F> void forPatchNodes(const Patch<Dim>& patch, F&& f)
{
	int n[3] = { 0, 0, 0 }, local = 0;
	for (n[2] = 0; n[2] < (Dim == 3 ? patch.nodesAlong(Dim - 1) : 1); ++n[2])
		for (n[1] = 0; n[1] < patch.nodesAlong(1); ++n[1])
			for (n[0] = 0; n[0] < patch.nodesAlong(0); ++n[0], ++local) {
				if (!(cellsAtNode(n, Dim) & patch.cells)) continue;
				Key key = patch.cell;
				for (int a = 0; a < Dim; ++a)
					key += n[a] * Grid<Dim>::keyStep(a);
				f(local, key);
			}
}

/// From sorted places.
template <int Dim> void makePatches(const std::vector<Place<Dim>>& places, CloudBasis<Dim>& b)
{
	b.order.resize(places.size());
	for (int i = 0; i < int(places.size()); ++i) {
		const auto& place = places[i];
		if (i == 0 || !place.samePatch(places[i - 1])) {
			b.patches.push_back({ place.cell, place.span(), place.cells(), i, 0, {} });
			b.patches.back().node.fill(-1);
		}
		++b.patches.back().count;
		b.order[i] = place.point;
	}
}

template <int Dim> void fillAxes(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, Basis basis, CloudBasis<Dim>& b)
{
	b.axes.resize(cloud.size());
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(b.patches.size()); ++k) {
		const auto&      patch = b.patches[k];
		const Index<Dim> cell  = Grid<Dim>::index(patch.cell);
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int p = b.order[i];
			setAxes<Dim>(b.axes[i], cloud.position[p] - grid.origin, cloud.halfSize[p], grid.cellSize, basis, cell);
		}
	}
}

/// The active nodes are the corners of the populated cells.
template <int Dim> void numberNodes(CloudBasis<Dim>& b)
{
	for (const auto& patch : b.patches)
		for (int c = 0; c < 1 << Dim; ++c)
			if (patch.cells >> c & 1) b.cells.push_back(patch.cell + Grid<Dim>::keyOffset(c));
	sortUnique(b.cells);
	for (const Key cell : b.cells)
		for (int c = 0; c < 1 << Dim; ++c)
			b.nodes.push_back(cell + Grid<Dim>::keyOffset(c));
	sortUnique(b.nodes);
	for (auto& patch : b.patches) {
		int next = 0; // nodes of a row follow each other, mostly
		forPatchNodes(patch, [&](int local, Key key) {
			if (next == int(b.nodes.size()) || b.nodes[next] != key) next = position(b.nodes, key);
			patch.node[local] = next++;
		});
	}
}

template <int Dim> void colourPatches(CloudBasis<Dim>& b)
{
	for (int i = 0; i < int(b.patches.size());) {
		int last = i;
		while (last < int(b.patches.size()) && b.patches[last].cell == b.patches[i].cell)
			++last;
		const Index<Dim> cell   = Grid<Dim>::index(b.patches[i].cell);
		int              colour = 0;
		for (int a = Dim - 1; a >= 0; --a)
			colour = 3 * colour + (cell[a] % 3 + 3) % 3;
		b.colours[colour].push_back({ i, last });
		i = last;
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
	fillAxes(cloud, grid, basis, b);
	numberNodes(b);
	colourPatches(b);
	return b;
}

template CloudBasis<2> cloudBasis(const PointCloud<2>&, const Grid<2>&, Basis, const Boundary<2>&);
template CloudBasis<3> cloudBasis(const PointCloud<3>&, const Grid<3>&, Basis, const Boundary<3>&);

} // namespace gimpm
