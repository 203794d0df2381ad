// SPDX-License-Identifier: GPL-2.0-or-later
// Cells that are hardly filled, and the well-filled ones that hold them.
#pragma once
#include "core/terms/ghost.hpp"

namespace gimpm {

/// Flags of the ghost faces that tie a cell of which less than the threshold is filled to cells that are filled better:
/// only these does the linear system need, and on the others the stabilisation would stiffen soil that yields. Each
/// ill-filled cell is tied to the best filled of the neighbours across its faces (all of them where several are filled
/// alike, so that mirrored bodies have mirrored ties), in rounds from the well-filled cells outwards. Cells that this
/// does not reach, films and points that fly, keep all of their faces. The same idea: aggregated finite elements
/// (Badia, Verdugo and Martin 2018) and ghost penalties within macro elements (Larson and Zahedi 2021).
template <int Dim>
std::vector<char> tiesOfIllFilled(const std::vector<GhostFace<Dim>>&, const CloudBasis<Dim>&, const PointStiffness&, const Grid<Dim>&, double threshold);

/// Lessens the stiffness of all other faces to this part of it.
template <int Dim> void lessenElsewhere(std::vector<GhostFace<Dim>>&, const std::vector<char>& ties, double part);

} // namespace gimpm
