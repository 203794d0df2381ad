// SPDX-License-Identifier: GPL-2.0-or-later
// Beams that part the soil on their two sides.
#pragma once
#include "core/grid/parting.hpp"
#include "core/grid/point_cloud.hpp"
#include "core/structures/structure.hpp"

namespace gimpm {

/// Gives points to the right of beams, near these, layers of their own, the grid the nodes there that are there twice,
/// and beams the layer of the soil to their right; 0 where there is soil on one side only, or another beam within three
/// cells that parts it. An end that has soil beyond it is a tip, around which soil is whole: as of the line of the grid
/// that is nearest to it.
void partSoil(const std::vector<Beam*>&, PointCloud<2>&, Grid<2>&);

/// Finds the beams that have soil on both of their sides; no more, where none may part it.
void lookBetween(const std::vector<Beam*>&, const PointCloud<2>&, const Grid<2>&);

/// Points on one side (1 left, -1 right) of a beam that parts the soil, and of its line beyond its ends. Not all points
/// to its right have its layer: those that are far from nodes of their own have the layer of the others.
class BesideBeam {
public:
	BesideBeam(const Beam&, int side, const PointCloud<2>&);
	bool operator()(int p) const;

private:
	const Beam&          beam_;
	int                  side_;
	const PointCloud<2>& cloud_;
};

/// Sides of positions within a cell of a beam that parts the soil, but not beyond its ends: the beam's layer to its
/// right, less than 0 to its left; else 0. A point that changes the sign in a step has gone through the beam.
std::vector<int> sidesOf(const std::vector<Beam*>&, const std::vector<Vec<2>>& positions, double cellSize);

} // namespace gimpm
