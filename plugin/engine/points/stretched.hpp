// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/kinematics.hpp"
#include "yade_api/types.hpp"

namespace yade {

// Half the size of the domain into which the deformation gradient stretches an initial one; a step limits it to half a
// cell.
inline Vector3r stretched(const Vector3r& halfSize0, const Matrix3r& defGrad)
{
	const Matrix3r change = defGrad - Matrix3r::Identity();
	if (!change.col(2).isZero(0) || !change.row(2).isZero(0)) return halfSize0.cwiseProduct(gimpm::stretchAlongAxes<3>(defGrad));
	const gimpm::Vec<2> stretch = gimpm::stretchAlongAxes<2>(defGrad.topLeftCorner<2, 2>());
	return halfSize0.cwiseProduct(Vector3r(stretch[0], stretch[1], 1));
}

} // namespace yade
