// SPDX-License-Identifier: GPL-2.0-or-later
// Lines, as beams and thin rigid bodies, that part the soil on their two sides.
#pragma once
#include "core/grid/parting.hpp"
#include "core/grid/point_cloud.hpp"
#include <array>
#include <vector>

namespace gimpm {

/// A line of vertices in the plane that parts the soil on its two sides, or might.
struct PartingLine {
	std::vector<Vec<2>> positions;        ///< of the vertices, as the step begins [m]
	bool                isClosed = false; ///< the last vertex is the first one
	/// The cut goes on beyond its tips, where bonds keep the soil together (StructureForce); else it ends at the
	/// first line of the grid beyond them.
	bool isBonded = false;
	/// Volume of water that passes by area and time, over the difference of the pressures [m3/(N s)].
	double leakage = 0;

	/// In this step: of the points to its right, where it parts the soil; 0: it does not.
	int layer = 0;
	/// In this step: it has soil on both of its sides, and parts it or does not.
	bool isBetween = false;
	/// In this step: other lines nearby that part the soil.
	std::vector<std::vector<Vec<2>>> others {};
	/// In this step: its first and its last vertex are tips of a cut, with soil beyond them.
	std::array<bool, 2> isTip {};

	/// Outwards from its first (0) or its last (1) vertex.
	Vec<2> outwardsAt(int end) const { return (end == 0 ? -1 : 1) * tangentAt(end == 0 ? 0 : int(positions.size()) - 1); }
	/// Along the line at a vertex, from its first to its last one.
	Vec<2> tangentAt(int vertex) const
	{
		const int last = int(positions.size()) - 1;
		if (isClosed && vertex % last == 0) return (positions[1] - positions[last - 1]).normalized();
		return (positions[std::min(vertex + 1, last)] - positions[std::max(vertex - 1, 0)]).normalized();
	}
};

/// Gives points to the right of lines, near these, layers of their own, the grid the nodes there that are there twice,
/// and lines the layer of the soil to their right, a number with one bit; 0 where there is soil on one side only, as
/// many lines nearby as there are bits, or, unless lines may be near each other, another one within three cells that
/// parts it. An end that has soil beyond it, and is not at another line, is a tip, around which soil is whole: as of
/// the line of the grid that is nearest to it.
void partSoil(const std::vector<PartingLine*>&, PointCloud<2>&, Grid<2>&, bool mayBeNear = false);

/// Distance of a position from a line [m]; the side of it that it is on, > 0 left, < 0 right.
double awayFrom(const PartingLine&, const Vec<2>& position);
double sideFrom(const PartingLine&, const Vec<2>& position);

/// Middles of its pieces, and ends of a line that is not closed; true if a position is within a reach of a line, and
/// not of its ends.
std::vector<Vec<2>> middlesOf(const PartingLine&);
std::vector<Vec<2>> endsOf(const PartingLine&);
bool                isAtMiddle(const PartingLine&, const Vec<2>& position, double reach);

/// Finds the lines that have soil on both of their sides; no more, where none may part it.
void lookBetween(const std::vector<PartingLine*>&, const PointCloud<2>&, const Grid<2>&);

/// Points on one side (1 left, -1 right) of a line that parts the soil, and of its straight continuation beyond its
/// ends, and of other lines nearby. Not all points to its right have its layer: those that are far from nodes of their
/// own have the layer of the others.
class BesideLine {
public:
	BesideLine(const PartingLine&, int side, const PointCloud<2>&);
	bool operator()(int p) const;

private:
	const PartingLine&   line_;
	int                  side_;
	const PointCloud<2>& cloud_;
};

/// Sides of positions within a cell of a line that parts the soil, but not beyond its ends: the line's number, counted
/// from 1, to its right, less than 0 to its left; else 0. A point that changes the sign in a step has gone through the
/// line.
std::vector<int> sidesOf(const std::vector<PartingLine*>&, const std::vector<Vec<2>>& positions, double cellSize);

} // namespace gimpm
