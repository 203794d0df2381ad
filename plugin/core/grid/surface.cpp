// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/surface.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace gimpm {
namespace {

/// Two vertices, the smaller number first.
using Side = std::pair<int, int>;

template <int Dim> Side side(const std::array<int, Dim>& piece, int i) { return std::minmax({ piece[i], piece[(i + 1) % Dim] }); }

/// Numbers of the vertices that divide sides.
using Middles = std::map<Side, int>;

template <int Dim> int sidesOf() { return Dim == 2 ? 1 : 3; }

/// Divides all sides that are too long, at one of the positions that would divide them into equal parts: parts of a
/// straight line on the grid fit into its cells if the line does.
template <int Dim> Middles divideSides(Surface<Dim>& surface, double limit)
{
	Middles middles;
	for (const auto& piece : surface.pieces)
		for (int i = 0; i < sidesOf<Dim>(); ++i) {
			const Side   s      = side<Dim>(piece, i);
			const double length = (surface.vertices[s.first] - surface.vertices[s.second]).norm();
			const double parts  = std::ceil(length / limit - 1e-9);
			if (parts <= 1 || middles.count(s)) continue;
			middles[s]         = int(surface.vertices.size());
			const double share = std::floor(parts / 2) / parts;
			for (auto* x : { &surface.vertices, &surface.vertices0 })
				x->push_back(((1 - share) * (*x)[s.first] + share * (*x)[s.second]).eval());
		}
	return middles;
}

void divide(const Surface<2>&, const Surface<2>::Piece& piece, const Middles& middles, std::vector<Surface<2>::Piece>& parts)
{
	const auto middle = middles.find(side<2>(piece, 0));
	if (middle == middles.end()) return parts.push_back(piece);
	parts.push_back({ piece[0], middle->second });
	parts.push_back({ middle->second, piece[1] });
}

/// In two at one side, whose ends each keep a part; the parts are divided in turn. At the longest one: parts of others
/// get ever more slender, and ever more of them.
void divide(const Surface<3>& surface, const Surface<3>::Piece& piece, const Middles& middles, std::vector<Surface<3>::Piece>& parts)
{
	int    longest = -1, m = -1;
	double length = 0;
	for (int i = 0; i < 3; ++i) {
		const auto middle = middles.find(side<3>(piece, i));
		if (middle == middles.end()) continue;
		const double squared = (surface.vertices[piece[i]] - surface.vertices[piece[(i + 1) % 3]]).squaredNorm();
		if (squared > length) longest = i, m = middle->second, length = squared;
	}
	if (longest < 0) return parts.push_back(piece);
	const int a = piece[longest], b = piece[(longest + 1) % 3], c = piece[(longest + 2) % 3];
	divide(surface, Surface<3>::Piece { a, m, c }, middles, parts);
	divide(surface, Surface<3>::Piece { m, b, c }, middles, parts);
}

} // namespace

Vec<2> pieceNormal(const Vec<2>& a, const Vec<2>& b)
{
	const Vec<2> along = b - a;
	return { along[1], -along[0] };
}

Vec<3> pieceNormal(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) { return 0.5 * (b - a).cross(c - a); }

std::vector<double> linesCrossed(const Vec<2>& a, const Vec<2>& b, const Grid<2>& grid)
{
	constexpr double    end = 1e-6;
	std::vector<double> parts;
	for (int axis = 0; axis < 2; ++axis) {
		const double from = (a[axis] - grid.origin[axis]) / grid.cellSize, to = (b[axis] - grid.origin[axis]) / grid.cellSize;
		for (double line = std::ceil(std::min(from, to) + end); line < std::max(from, to) - end; ++line)
			parts.push_back((line - from) / (to - from));
	}
	std::sort(parts.begin(), parts.end());
	const auto last = std::unique(parts.begin(), parts.end(), [](double s, double t) { return t - s < end; });
	parts.erase(last, parts.end());
	return parts;
}

template <int Dim> Vec<Dim> Surface<Dim>::normal(const Piece& piece, const std::vector<Vec<Dim>>& x) const
{
	if constexpr (Dim == 2) return pieceNormal(x[piece[0]], x[piece[1]]);
	else
		return pieceNormal(x[piece[0]], x[piece[1]], x[piece[2]]);
}

template <int Dim> bool Surface<Dim>::isClosed() const
{
	std::map<Side, int> uses; // number of pieces at each side, a vertex in the plane
	for (const Piece& piece : pieces)
		for (int i = 0; i < Dim; ++i)
			++uses[Dim == 2 ? Side(piece[i], piece[i]) : side<Dim>(piece, i)];
	return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 2; });
}

template <int Dim> bool Surface<Dim>::cuts(const Piece& piece, const Vec<Dim>& a, const Vec<Dim>& b) const
{
	constexpr double onEdge = 1e-9; // round-off must not let a way through where pieces meet
	Mat<Dim>         sides;         // a + t (b - a) = first vertex + s_i (vertex i - first vertex)
	sides.col(0) = a - b;
	for (int i = 1; i < Dim; ++i)
		sides.col(i) = vertices[piece[i]] - vertices[piece[0]];
	// Not finite where the way is along the piece.
	const Vec<Dim> part = sides.inverse() * (a - vertices[piece[0]]);
	return part.minCoeff() >= -onEdge && part[0] <= 1 + onEdge && part.template tail<Dim - 1>().sum() <= 1 + onEdge;
}

template <int Dim> bool Surface<Dim>::isBetween(const Vec<Dim>& a, const Vec<Dim>& b) const
{
	return std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return cuts(piece, a, b); });
}

template <int Dim> std::vector<int> Surface<Dim>::refine(double limit)
{
	std::vector<int> partOf(pieces.size());
	std::iota(partOf.begin(), partOf.end(), 0);
	for (;;) {
		const Middles middles = divideSides(*this, limit);
		if (middles.empty()) return partOf;
		std::vector<Piece> parts;
		std::vector<int>   wholes;
		for (std::size_t i = 0; i < pieces.size(); ++i) {
			divide(*this, pieces[i], middles, parts);
			wholes.resize(parts.size(), partOf[i]);
		}
		pieces = std::move(parts);
		partOf = std::move(wholes);
	}
}

template struct Surface<2>;
template struct Surface<3>;

} // namespace gimpm
