// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/facets.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/parting.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

void addPiece(Facets<2>& to, const Surface<2>::Piece& piece, int number, const Grid<2>& grid)
{
	int first = piece[0];
	for (const double s : linesCrossed(to.start[piece[0]], to.start[piece[1]], grid)) {
		to.start.push_back((1 - s) * to.start[piece[0]] + s * to.start[piece[1]]);
		to.pieces.push_back({ first, int(to.start.size()) - 1 });
		to.whole.push_back(number);
		first = int(to.start.size()) - 1;
	}
	to.pieces.push_back({ first, piece[1] });
	to.whole.push_back(number);
}

using Polygon = std::vector<int>;

/// The lowest plane of the grid across an axis that a polygon crosses, in cells. None where it lies between two.
std::optional<double> planeCrossed(const Facets<3>& of, const Polygon& polygon, int axis, const Grid<3>& grid)
{
	constexpr double    same = 1e-6;
	std::vector<double> x;
	for (const int v : polygon)
		x.push_back((of.start[v][axis] - grid.origin[axis]) / grid.cellSize);
	const auto [low, high] = std::minmax_element(x.begin(), x.end());
	const double plane     = std::floor(*low + same) + 1;
	if (plane < *high - same) return plane;
	return std::nullopt;
}

/// The parts of a convex polygon below and above a plane.
std::array<Polygon, 2> split(Facets<3>& of, const Polygon& polygon, int axis, double plane, const Grid<3>& grid)
{
	constexpr double same     = 1e-6;
	const auto       distance = [&](int v) {
                const double away = (of.start[v][axis] - grid.origin[axis]) / grid.cellSize - plane;
                return std::abs(away) < same ? 0. : away;
	};
	std::array<Polygon, 2> sides;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const int    v = polygon[i], next = polygon[(i + 1) % polygon.size()];
		const double own = distance(v), other = distance(next);
		if (own <= 0) sides[0].push_back(v);
		if (own >= 0) sides[1].push_back(v);
		if (own * other >= 0) continue;
		of.start.push_back((other * of.start[v] - own * of.start[next]) / (other - own));
		for (auto& side : sides)
			side.push_back(int(of.start.size()) - 1);
	}
	return sides;
}

/// The first corner of the shorter diagonal of a quadrilateral; none where both are equal.
std::optional<int> shorterDiagonal(const Facets<3>& of, const Polygon& polygon)
{
	constexpr double same   = 1e-6;
	const auto       length = [&](int i) { return (of.start[polygon[i]] - of.start[polygon[i + 2]]).norm(); };
	const double     first = length(0), second = length(1);
	if (std::abs(first - second) <= same * first) return std::nullopt;
	return first < second ? 0 : 1;
}

/// Triangles of a convex polygon, which do not depend on the order of its corners: mirrored bodies have mirrored ones.
std::vector<Facets<3>::Piece> triangles(Facets<3>& of, const Polygon& polygon)
{
	if (polygon.size() == 3) return { { polygon[0], polygon[1], polygon[2] } };
	if (polygon.size() == 4)
		if (const auto i = shorterDiagonal(of, polygon))
			return { { polygon[*i], polygon[*i + 1], polygon[*i + 2] }, { polygon[*i + 2], polygon[(*i + 3) % 4], polygon[*i] } };
	Vec<3> centre = Vec<3>::Zero();
	for (const int v : polygon)
		centre += of.start[v] / double(polygon.size());
	of.start.push_back(centre);
	std::vector<Facets<3>::Piece> parts;
	for (std::size_t i = 0; i < polygon.size(); ++i)
		parts.push_back({ polygon[i], polygon[(i + 1) % polygon.size()], int(of.start.size()) - 1 });
	return parts;
}

void addPiece(Facets<3>& to, const Surface<3>::Piece& piece, int number, const Grid<3>& grid)
{
	std::vector<Polygon> open { { piece.begin(), piece.end() } };
	while (!open.empty()) {
		const Polygon own = std::move(open.back());
		open.pop_back();
		bool isWhole = true;
		for (int a = 0; isWhole && a < 3; ++a)
			if (const auto plane = planeCrossed(to, own, a, grid)) {
				isWhole = false;
				for (Polygon& part : split(to, own, a, *plane, grid))
					if (part.size() > 2) open.push_back(std::move(part));
			}
		if (!isWhole) continue;
		const auto parts = triangles(to, own);
		to.pieces.insert(to.pieces.end(), parts.begin(), parts.end());
		to.whole.resize(to.pieces.size(), number);
	}
}

template <int Dim> std::optional<Attachment<Dim>> attachNear(const Vec<Dim>& position, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	if (auto attached = attach(position, basis, grid, layer)) return attached;
	std::optional<Vec<Dim>> nearest;
	double                  least = std::numeric_limits<double>::infinity();
	const Vec<Dim>          xi    = (position - grid.origin) / grid.cellSize;
	if (!(xi.array().abs() < Grid<Dim>::indexLimit).all()) return std::nullopt;
	const Index<Dim> own = xi.array().floor().template cast<int>();
	for (int i = 0; i < cellsAround<Dim>; ++i) {
		const Index<Dim> cell = own + offsetAround<Dim>(i);
		const Vec<Dim>   low = cell.template cast<double>(), inside = xi.cwiseMax(low).cwiseMin(low + Vec<Dim>::Ones());
		const double     away = (xi - inside).squaredNorm();
		Key              key  = Grid<Dim>::key(grid.first(cell), 0, layer);
		if (grid.parting) key = grid.parting->cellFor(key);
		if (away < least && find(basis.populatedLeaves(), grid.refinement ? grid.refinement->leafOf(key) : key) >= 0)
			least = away, nearest = grid.origin + grid.cellSize * inside;
	}
	return nearest ? attach(*nearest, basis, grid, layer) : std::nullopt;
}

/// Layers of vertices: the highest one of their pieces.
template <int Dim> std::vector<int> layersOf(const Facets<Dim>& facets, int layer, const std::vector<int>& layerOfPiece)
{
	std::vector<int> layers(facets.start.size(), layer);
	for (std::size_t i = 0; i < facets.pieces.size() && !layerOfPiece.empty(); ++i)
		for (const int v : facets.pieces[i])
			layers[v] = std::max(layers[v], layerOfPiece[facets.whole[i]]);
	return layers;
}

} // namespace

template <int Dim>
Facets<Dim>::Facets(const Surface<Dim>& surface, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer, const std::vector<int>& layerOfPiece)
        : start(surface.vertices)
{
	for (std::size_t i = 0; i < surface.pieces.size(); ++i)
		addPiece(*this, surface.pieces[i], int(i), grid);
	const auto    layers = layersOf(*this, layer, layerOfPiece);
	Attacher<Dim> attach(basis, grid, layer);
	for (std::size_t v = 0; v < start.size(); ++v) {
		attach.goTo(layers[v]);
		at.push_back(attach(start[v]));
	}
}

template <int Dim> bool Facets<Dim>::isThere(const Piece& piece) const
{
	return std::all_of(piece.begin(), piece.end(), [&](int v) { return at[v].has_value(); });
}

template <int Dim> std::vector<Vec<Dim>> Facets<Dim>::positionsAt(const Eigen::VectorXd& d) const
{
	Positions positions = start;
	for (std::size_t v = 0; v < positions.size(); ++v)
		if (at[v]) positions[v] += at[v]->displacement(d);
	return positions;
}

template <int Dim> std::optional<Attachment<Dim>> Attacher<Dim>::operator()(const Vec<Dim>& position)
{
	const Vec<Dim> xi       = (position - grid_.origin) / grid_.size(0);
	const auto     isInside = [](const Vec<Dim>& local) { return (local.array() > 0).all() && (local.array() < 1).all(); };
	if (last_) {
		const Vec<Dim> local = xi - last_->cell.template cast<double>();
		if (isInside(local)) {
			last_->weigh(local);
			return last_;
		}
	}
	const auto found = attachNear(position, basis_, grid_, layer_);
	if (found && !grid_.refinement && !grid_.parting && isInside(xi - found->cell.template cast<double>())) last_ = found;
	return found;
}

template struct Facets<2>;
template struct Facets<3>;
template class Attacher<2>;
template class Attacher<3>;

} // namespace gimpm
