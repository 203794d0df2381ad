// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/loose_cells.hpp"
#include "core/base/small_matrices.hpp"
#include "core/grid/neighbours.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Least eigenvalue of the second moments of (1, x) (1, y)[ (1, z)] over the points of a cell, with x from -1 to 1,
/// with which they determine a field there. Two points along each axis that fill the cell have 4^-Dim.
template <int Dim> constexpr double leastMoment = Dim == 2 ? 1e-3 : 1e-4;

/// The points of a cell.
template <int Dim> struct Filling {
	static constexpr int corners = LooseCell<Dim>::corners;
	using Moments                = Eigen::Matrix<double, corners, corners>;
	Moments        moments       = Moments::Zero();
	LooseCell<Dim> cell;

	bool determines() const { return cell.mass > 0 && isPositiveDefinite(moments / cell.mass - leastMoment<Dim> * Moments::Identity()); }
};

using CellPairs = std::vector<std::array<int, 2>>;

/// The cells below and above each face, by number.
template <int Dim> CellPairs cellPairs(const std::vector<GhostFace<Dim>>& faces, const CloudBasis<Dim>& basis, const Grid<Dim>& grid)
{
	CellPairs pairs;
	for (const auto& face : faces)
		pairs.push_back(cellsAt(face, basis, grid));
	return pairs;
}

/// True if all neighbours across the faces of a leaf are populated.
template <int Dim> bool isWithin(Key leaf, const std::vector<Key>& leaves, const Grid<Dim>& grid)
{
	bool is = true;
	for (int a = 0; a < Dim && is; ++a)
		for (const bool isAbove : { false, true })
			forNeighbours(leaf, a, isAbove, grid, [&](Key beyond, int) { is = is && find(leaves, beyond) >= 0; });
	return is;
}

/// Leaves at ghost faces, and those that have none but not all neighbours, as by themselves or behind a wall; the
/// others are within the body.
template <int Dim> std::vector<char> atEdge(const std::vector<Key>& leaves, const CellPairs& pairs, const Grid<Dim>& grid)
{
	std::vector<char> isAt(leaves.size(), false);
	for (const auto& [lower, upper] : pairs)
		isAt[lower] = isAt[upper] = true;
	for (std::size_t c = 0; c < isAt.size(); ++c)
		isAt[c] = isAt[c] || !isWithin(leaves[c], leaves, grid);
	return isAt;
}

/// Across so many faces.
void spread(std::vector<char>& isKnown, const CellPairs& pairs, int reach)
{
	std::vector<char> before;
	for (int step = 0; step < reach && before != isKnown; ++step) {
		before = isKnown;
		for (const auto& [lower, upper] : pairs)
			if (before[lower] || before[upper]) isKnown[lower] = isKnown[upper] = true;
	}
}

/// Position in a leaf, from -1 to 1 along each axis, of one in a cell of it.
template <int Dim> Vec<Dim> inLeaf(const Vec<Dim>& position, Key cell, Key leaf)
{
	const int level = Grid<Dim>::level(cell), ofLeaf = Grid<Dim>::level(leaf);
	if (level == ofLeaf) return position;
	const Vec<Dim> apart = (Grid<Dim>::index(cell) - Grid<Dim>::index(leaf)).template cast<double>();
	return ((2 * apart + double(1 << level) * (position + Vec<Dim>::Ones())) / (1 << ofLeaf) - Vec<Dim>::Ones()).eval();
}

/// Adds a point to the leaf of its centre, if that has a slot.
template <int Dim>
void addTo(
        std::vector<Filling<Dim>>& fillings, const std::vector<int>& slot, const CloudBasis<Dim>& basis, const Patch<Dim>& patch, const PointBasis<Dim>& axes,
        double mass)
{
	Vec<Dim> position; // from -1 to 1
	int      number = 0;
	for (int a = 0; a < Dim; ++a) {
		const double x       = axes[a].value[1] + 2 * axes[a].value[2]; // linear fields are exact
		const int    isUpper = (patch.span >> a & 1) && x > 1;
		position[a]          = 2 * (x - isUpper) - 1;
		number |= isUpper << a;
	}
	const int cell = patch.reached[number]; // none beyond a wall
	if (cell < 0 || slot[basis.leaf(cell)] < 0) return;
	const int leaf    = basis.leaf(cell);
	auto&     filling = fillings[slot[leaf]];
	position          = inLeaf<Dim>(position, basis.cells[cell], basis.populatedLeaves()[leaf]);
	Eigen::Matrix<double, Filling<Dim>::corners, 1> field;
	for (int corner = 0; corner < Filling<Dim>::corners; ++corner) {
		field[corner] = 1;
		for (int a = 0; a < Dim; ++a)
			if (corner >> a & 1) field[corner] *= position[a];
	}
	filling.cell.mass += mass;
	++filling.cell.points;
	filling.moments += mass * field * field.transpose();
}

} // namespace

/// Corners of a leaf, the first axis fastest.
template <int Dim> auto cornersOfLeaf(Key leaf, const CloudBasis<Dim>& basis, const Grid<Dim>& grid)
{
	decltype(LooseCell<Dim>::node) node;
	for (int corner = 0; corner < LooseCell<Dim>::corners; ++corner)
		node[corner] = position(basis.nodes, grid.first(leaf + Grid<Dim>::keyOffset(corner, Grid<Dim>::level(leaf))));
	return node;
}

template <int Dim>
std::vector<LooseCell<Dim>> looseCells(
        const CloudBasis<Dim>& basis, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>& faces, const Grid<Dim>& grid, int reach,
        const Division& division)
{
	const auto              pairs  = cellPairs(faces, basis, grid);
	const auto&             leaves = basis.populatedLeaves();
	const std::vector<char> isAt   = atEdge(leaves, pairs, grid);
	std::vector<int>        slot(isAt.size(), -1);
	int                     count = 0;
	for (std::size_t c = 0; c < isAt.size(); ++c)
		if (isAt[c]) slot[c] = count++;
	std::vector<Filling<Dim>> fillings(count);
	for (const auto& patch : basis.patches)
		if (std::any_of(patch.reached.begin(), patch.reached.end(), [&](int c) { return c >= 0 && isAt[basis.leaf(c)]; }))
			for (int i = patch.first; i < patch.first + patch.count; ++i)
				addTo(fillings, slot, basis, patch, basis.axes[i], masses[basis.order[i]]);
	std::vector<char> isKnown(slot.size(), true);
	for (std::size_t c = 0; c < slot.size(); ++c)
		if (isAt[c]) isKnown[c] = fillings[slot[c]].determines();
	division.complete(leaves, isKnown);
	spread(isKnown, pairs, reach);
	std::vector<LooseCell<Dim>> loose;
	for (std::size_t c = 0; c < slot.size(); ++c)
		if (!isKnown[c] && fillings[slot[c]].cell.mass > 0) {
			loose.push_back(fillings[slot[c]].cell);
			loose.back().node = cornersOfLeaf(leaves[c], basis, grid);
			loose.back().leaf = int(c);
		}
	return loose;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<LooseCell<Dim>> looseCells(                                                                                                       \
	        const CloudBasis<Dim>&, const std::vector<double>&, const std::vector<GhostFace<Dim>>&, const Grid<Dim>&, int, const Division&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
