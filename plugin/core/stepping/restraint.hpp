// SPDX-License-Identifier: GPL-2.0-or-later
// Check that the constrained nodes, the terms and, in a periodic grid, its own images keep every connected part of the
// body from moving as a rigid body.
#pragma once
#include "core/terms/term.hpp"
#include <string>

namespace gimpm {

struct LoosePoints {
	std::vector<int> nodes {};
	int              points = 0;
	std::string      position {}; ///< position of the first, "(1, 2)"
};

struct Restraint {
	int         parts = 0;  ///< parts of the body that share no node
	std::string freeMotion; ///< motion of the first part found that can move freely ("translation along y of the material around (1, 2)"), or empty
	/// Parts that can move, too, but have fewer points than a cell has nodes, beside a part that has more:
	/// freeMotion leaves them out. None where points are divided.
	LoosePoints loose {};
};

template <int Dim> Restraint restraint(const CloudBasis<Dim>&, const Grid<Dim>&, const Boundary<Dim>&, const Terms<Dim>& = {}, const Division& = {});

/// The same with what the terms still hold at displacements d.
template <int Dim>
Restraint restraintAt(const Eigen::VectorXd& d, const CloudBasis<Dim>&, const Grid<Dim>&, const Boundary<Dim>&, const Terms<Dim>&, const Division& = {});

/// Fewer points than a cell has nodes whose cells share no face with those of the others, but a corner or an edge,
/// about which they can turn as they like; with the nodes that only they move. None where points are divided, on
/// periodic grids, and among cells of several sizes.
template <int Dim> LoosePoints hinged(const CloudBasis<Dim>&, const Grid<Dim>&, const Boundary<Dim>&, const Terms<Dim>&, const Division&);

} // namespace gimpm
