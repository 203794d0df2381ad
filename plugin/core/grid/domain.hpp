// SPDX-License-Identifier: GPL-2.0-or-later
// Half lengths of the domains of material points as these deform.
#pragma once
#include "core/base/types.hpp"

namespace gimpm {

/// Rule by which a domain, a box along the grid axes, follows the deformation of its point.
enum class DomainRule {
	/// Boxes of the points' volume that tile space as far as boxes can: see tilingDomain().
	tiling,
	/// Initial half lengths times the diagonal of the right stretch tensor U (Coombs 2023). Sheared boxes overlap.
	stretch,
};

/// Diagonal of the right stretch tensor U = sqrt(F^T F) [-].
template <int Dim> Vec<Dim> stretchAlongAxes(const Mat<Dim>& F);

/// Half lengths [m] of boxes for a lattice of points; their product is det(edges). Zero where that is not positive.
///
/// `edges`: deformation gradient times the initial half lengths, column by column; twice these edges span the lattice
/// that the point and its neighbours form where deformation is uniform. A lattice vector parallel to grid axis a means
/// that boxes of its length form rows without gap or overlap; a reciprocal vector parallel to a, layers. So each short
/// vector v of both lattices measures l_a^2 = q J^(2/Dim), with J = det(edges) and the weight m^-2,
///   m = (|v|^2 - v_a^2) J^(-2/Dim) (1 + 4 (q - 1)^2 / q),   q = v_a^2 J^(-2/Dim);
/// of the reciprocal lattice in reciprocal lengths, q inverted. The half lengths are the weighted means by axis, and
/// then the least-squares fit to their logarithms whose sum is ln J. Exact for rotations by multiples of 90 degrees,
/// stretches along the axes, and then simple shear of any size along an axis of the grid, of boxes that are at most
/// three times as long as wide.
template <int Dim> Vec<Dim> tilingDomain(const Mat<Dim>& edges);

/// Half lengths [m] that a rule gives a point with deformation gradient F and initial half lengths.
template <int Dim> Vec<Dim> domainOf(const Mat<Dim>& F, const Vec<Dim>& halfSize0, DomainRule rule)
{
	if (rule == DomainRule::stretch) return halfSize0.cwiseProduct(stretchAlongAxes<Dim>(F));
	return tilingDomain<Dim>(F * halfSize0.asDiagonal());
}

} // namespace gimpm
