// SPDX-License-Identifier: GPL-2.0-or-later
// Cells whose points are too few to tell the velocities of their nodes.
#pragma once
#include "core/parallel/division.hpp"
#include "core/terms/ghost.hpp"

namespace gimpm {

/// A populated leaf: its nodes, the first axis fastest, and the points whose centre is in it with their mass [kg].
template <int Dim> struct LooseCell {
	static constexpr int     corners = 1 << Dim;
	std::array<int, corners> node {};
	double                   mass   = 0;
	int                      points = 0;
	int                      leaf   = -1; ///< number among the populated leaves
};

/// Share of the mass of loose cells that MassMatrix lumps. Its angular momentum is lost in each step, its inverse
/// bounds the condition number (docs/explanation/time-integration.md).
constexpr double usualLooseShare = 1e-6;

/// Loose cells: populated cells whose points do not determine a multilinear field, and which no chain of `reach` ghost
/// faces connects with a cell whose points do, as at a corner of a body (the condition number grows with the fourth
/// power of the way): fewer than 2^Dim points by themselves, or any number of them in a row. There nodal fields exist
/// that no point sees. Masses by point of the cloud [kg]. Where points are divided the cells at the own nodes are
/// right.
template <int Dim>
std::vector<LooseCell<Dim>> looseCells(
        const CloudBasis<Dim>&, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>&, const Grid<Dim>&, int reach = Dim, const Division& = {});

} // namespace gimpm
