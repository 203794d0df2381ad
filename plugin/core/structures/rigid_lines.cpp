// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/rigid_lines.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>
#include <optional>

namespace gimpm {
namespace {

struct Piece {
	std::array<Vec<2>, 2> ends;
	int                   body;
};

/// Size of the largest cell along a segment, looked for every half of a cell [m].
double largestAlong(const std::array<Vec<2>, 2>& ends, const Grid<2>& grid)
{
	const Vec<2> along   = ends[1] - ends[0];
	double       largest = cellSizeAt(grid, ends[1]);
	for (double at = 0, h = 0; grid.refinement && at < along.norm(); at += h / 2)
		h = cellSizeAt<2>(grid, ends[0] + at * along.normalized()), largest = std::max(largest, h);
	return largest;
}

std::optional<Piece> pieceOf(const RigidBody<2>& body, int number, const Grid<2>& grid)
{
	const auto& shape = body.shape;
	if (shape.kind == RigidKind::sheet && shape.isTwoSided)
		return Piece { { body.begin.inSpace(shape.corners[0]), body.begin.inSpace(shape.corners[1]) }, number };
	if (shape.kind != RigidKind::block) return std::nullopt;
	int longest;
	shape.halfSize.maxCoeff(&longest);
	const Vec<2> half = shape.halfSize[longest] * Vec<2>::Unit(longest);
	const Piece  piece { { body.begin.inSpace(-half), body.begin.inSpace(half) }, number };
	if (body.thickness() >= largestAlong(piece.ends, grid) * (1 - 1e-9)) return std::nullopt;
	return piece;
}

/// Ends of pieces joined to lines.
class Chains {
public:
	Chains(std::vector<Piece> pieces, double cellSize) : pieces_(std::move(pieces)), isTaken_(pieces_.size(), false), same_(1e-6 * cellSize) { }

	std::vector<RigidLine> lines()
	{
		std::vector<RigidLine> all;
		for (std::size_t i = 0; i < pieces_.size(); ++i) {
			if (isTaken_[i]) continue;
			isTaken_[i] = true;
			RigidLine line;
			line.positions = { pieces_[i].ends[0], pieces_[i].ends[1] }, line.bodies = { pieces_[i].body };
			lengthen(line);
			std::reverse(line.positions.begin(), line.positions.end()), std::reverse(line.bodies.begin(), line.bodies.end());
			lengthen(line);
			line.isClosed = areSame(line.positions.front(), line.positions.back());
			if (line.isClosed) line.positions.back() = line.positions.front();
			all.push_back(std::move(line));
		}
		return all;
	}

private:
	bool areSame(const Vec<2>& a, const Vec<2>& b) const { return (a - b).norm() <= same_; }

	/// Adds pieces at its last vertex, as long as there is one.
	void lengthen(RigidLine& line)
	{
		for (int next; (next = pieceAfter(line)) >= 0;) {
			const auto& ends = pieces_[next].ends;
			isTaken_[next]   = true;
			line.positions.push_back(ends[areSame(ends[0], line.positions.back())]);
			line.bodies.push_back(pieces_[next].body);
		}
	}

	/// The free piece at the last vertex: the only other one there, or one that goes straight on; -1: there is
	/// none.
	int pieceAfter(const RigidLine& line) const
	{
		constexpr double straight = 0.9998; // cosine of a degree
		const Vec<2>&    vertex   = line.positions.back();
		const Vec<2>     along    = (vertex - line.positions[line.positions.size() - 2]).normalized();
		int              count = 0, only = -1, ahead = -1;
		for (std::size_t i = 0; i < pieces_.size(); ++i)
			for (int end = 0; end < 2; ++end) {
				if (!areSame(pieces_[i].ends[end], vertex)) continue;
				++count;
				if (isTaken_[i]) continue;
				only = int(i);
				if ((pieces_[i].ends[1 - end] - vertex).normalized().dot(along) > straight) ahead = int(i);
			}
		return count == 2 ? only : ahead;
	}

	std::vector<Piece> pieces_;
	std::vector<bool>  isTaken_;
	const double       same_;
};

} // namespace

std::vector<RigidLine> linesOf(const std::vector<RigidBody<2>>& bodies, const Grid<2>& grid)
{
	std::vector<Piece> pieces;
	for (int b = 0; b < int(bodies.size()); ++b)
		if (const auto piece = pieceOf(bodies[b], b, grid)) pieces.push_back(*piece);
	return Chains(std::move(pieces), grid.cellSize).lines();
}

} // namespace gimpm
