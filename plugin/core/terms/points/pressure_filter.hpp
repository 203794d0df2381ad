// SPDX-License-Identifier: GPL-2.0-or-later
// Pressures of points in one cell, which F-bar leaves apart for good.
//
// Mean stresses pi_p of points act, with F-bar (core/terms/points/fbar.hpp), on the nodes by one number a cell c,
//
//   P_c = sum over points of s_pc V_p pi_p,    with V_p the initial volume and s_pc the part of the domain in the cell,
//
// and as the nodes move, those of points grow by combinations of one number a cell, sum over cells of s_pc l_c. So what
// is left of them without the nearest such combination, in the norm sum of V_p pi_p^2, neither acts nor is acted on. It
// stays with the points, comes in where these get from cell to cell, and acts once they part: where soil flows around a
// body it becomes a multiple of what the soil can bear.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/materials/material.hpp"

namespace gimpm {

/// After a step, whose basis and displacement of points these are, takes out of the mean stresses a part of what does
/// not act: all where a point has moved by a quarter of a cell or more, in proportion where by less, so that steps may
/// be of any length and what rests stays as it is. P_c stays, and with it equilibrium, and the sum of V_p pi_p to
/// round-off; elastic energy never grows. Points of each material by themselves. It is for laws
/// whose strength and stiffness do not depend on the mean stress, which is linear in the volumetric strain, and for
/// water that cannot leave; others would have to be brought back to their yield surface.
template <int Dim>
void relaxPressures(PointCloud<Dim>&, const PointCloud<Dim>& before, const std::vector<Material>&, const CloudBasis<Dim>&, const Grid<Dim>&, const Division&);

} // namespace gimpm
