// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/domain.hpp"
#include "yade_api/types.hpp"

namespace yade {

// Half lengths of the domain [m] that the deformation gradient makes of the initial ones; a step limits them to half a
// cell. In the plane the third one follows its own stretch: 1 in plane strain, around an axis that of the ring.
template <int Dim> Vector3r stretched(const Vector3r& halfSize0, const Matrix3r& defGrad, gimpm::DomainRule rule)
{
	Vector3r half             = halfSize0 * defGrad(2, 2);
	half.template head<Dim>() = gimpm::domainOf<Dim>(defGrad.topLeftCorner<Dim, Dim>(), halfSize0.head<Dim>(), rule);
	return half;
}

} // namespace yade
