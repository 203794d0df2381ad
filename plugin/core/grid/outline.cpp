// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/parts_of_body.hpp"
#include <array>
#include <map>
#include <unordered_map>

namespace gimpm {
namespace {

/// Covered part of a cube of two spacings around each node of a lattice.
template <int Dim> std::unordered_map<Key, double> coverageOf(const std::vector<DomainBox<Dim>>& boxes, const Vec<Dim>& origin, double spacing)
{
	std::unordered_map<Key, double> covered;
	for (const auto& box : boxes) {
		const Vec<Dim>   low = (box.low - origin) / spacing, high = (box.high - origin) / spacing;
		const Index<Dim> first = (low.array() - 1).floor().template cast<int>(), last = (high.array() + 1).ceil().template cast<int>();
		forIndicesUpTo<Dim>(first, last, [&](const Index<Dim>& node) {
			const Vec<Dim> x    = node.template cast<double>();
			const double   part = ((x.array() + 1).min(high.array()) - (x.array() - 1).max(low.array())).max(0.).prod() / (1 << Dim);
			if (part > 0) covered[Grid<Dim>::key(node)] += part;
		});
	}
	return covered;
}

/// Pieces where the coverage of a lattice crosses a half, in simplices that share faces (Kuhn): so the surface has no
/// gap.
template <int Dim> class Marching {
public:
	Marching(const std::vector<DomainBox<Dim>>& boxes, const Vec<Dim>& origin, double spacing)
	        : covered_(coverageOf(boxes, origin, spacing)), origin_(origin), spacing_(spacing)
	{
	}

	Surface<Dim> surface()
	{
		std::vector<Key> cells;
		for (const auto& [node, part] : covered_)
			for (int corner = 0; corner < 1 << Dim; ++corner)
				cells.push_back(node - Grid<Dim>::keyOffset(corner));
		std::sort(cells.begin(), cells.end());
		cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
		for (const Key cell : cells)
			addCell(cell);
		surface_.vertices0 = surface_.vertices;
		return surface_;
	}

private:
	static constexpr double half = 0.5;
	using Simplex                = std::array<Key, Dim + 1>;
	using Piece                  = typename Surface<Dim>::Piece;

	double coverage(Key node) const
	{
		const auto found = covered_.find(node);
		return found == covered_.end() ? 0 : found->second;
	}
	Vec<Dim> positionOf(Key node) const { return origin_ + spacing_ * Grid<Dim>::index(node).template cast<double>(); }

	/// Simplices by the orders in which axes lead from the lowest to the highest corner.
	void addCell(Key cell)
	{
		std::array<int, Dim> order;
		for (int a = 0; a < Dim; ++a)
			order[a] = a;
		do {
			Simplex corners { cell };
			for (int a = 0; a < Dim; ++a)
				corners[a + 1] = corners[a] + Grid<Dim>::keyStep(order[a]);
			addSimplex(corners);
		} while (std::next_permutation(order.begin(), order.end()));
	}

	void addSimplex(const Simplex& corners)
	{
		std::vector<Key> in, out;
		for (const Key corner : corners)
			(coverage(corner) > half ? in : out).push_back(corner);
		if (in.empty() || out.empty()) return;
		if (in.size() == 2 && out.size() == 2) { // a quadrangle, in space
			addPiece(in, out, { vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[1], out[1]) });
			addPiece(in, out, { vertex(in[0], out[0]), vertex(in[1], out[1]), vertex(in[1], out[0]) });
			return;
		}
		std::vector<int> piece;
		for (const Key i : in)
			for (const Key o : out)
				piece.push_back(vertex(i, o));
		addPiece(in, out, piece);
	}

	/// Adds a piece whose normal leads from the corners inside to those outside.
	void addPiece(const std::vector<Key>& in, const std::vector<Key>& out, const std::vector<int>& numbers)
	{
		const auto mean = [&](const std::vector<Key>& nodes) {
			Vec<Dim> sum = Vec<Dim>::Zero();
			for (const Key node : nodes)
				sum += positionOf(node);
			return Vec<Dim>(sum / double(nodes.size()));
		};
		Piece piece;
		std::copy(numbers.begin(), numbers.end(), piece.begin());
		if (surface_.normal(piece, surface_.vertices).dot(mean(out) - mean(in)) < 0) std::swap(piece[0], piece[1]);
		surface_.pieces.push_back(piece);
	}

	/// The vertex on an edge from a node inside to one outside, off both of them: pieces have a size.
	int vertex(Key in, Key out)
	{
		constexpr double least    = 0.02;
		const auto [found, isNew] = vertices_.emplace(std::pair(in, out), int(surface_.vertices.size()));
		if (!isNew) return found->second;
		const double a = std::min(1., coverage(in)), b = coverage(out), part = std::min(std::max((a - half) / (a - b), least), 1 - least);
		surface_.vertices.push_back((1 - part) * positionOf(in) + part * positionOf(out));
		return found->second;
	}

	const std::unordered_map<Key, double> covered_;
	const Vec<Dim>                        origin_;
	const double                          spacing_;
	Surface<Dim>                          surface_;
	std::map<std::pair<Key, Key>, int>    vertices_;
};

} // namespace

template <int Dim> Surface<Dim> outline(const std::vector<DomainBox<Dim>>& boxes, const Vec<Dim>& origin, double spacing)
{
	return Marching<Dim>(boxes, origin, spacing).surface();
}

template Surface<2> outline(const std::vector<DomainBox<2>>&, const Vec<2>&, double);
template Surface<3> outline(const std::vector<DomainBox<3>>&, const Vec<3>&, double);

} // namespace gimpm
