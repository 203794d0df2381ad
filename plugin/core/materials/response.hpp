// SPDX-License-Identifier: GPL-2.0-or-later
// Answer of a constitutive law, in the principal axes of the trial elastic strain.
#pragma once
#include "core/base/lanes.hpp"
#include "core/base/types.hpp"
#include <array>

namespace gimpm {

template <class T> using PrincipalValues = Eigen::Matrix<T, 3, 1>;

/// Isotropic law: stress and trial strain share their principal axes, so that a law needs principal values only. T is
/// double, or Lanes for several points at once.
template <class T> struct ResponseOf {
	PrincipalValues<T>     stress;        ///< principal Kirchhoff stresses [Pa]
	Eigen::Matrix<T, 3, 3> tangent;       ///< consistent tangent d stress_i / d trialStrain_j [Pa]; symmetric, as the stiffness is
	PrincipalValues<T>     shear;         ///< G_s of the axis pairs (0,1), (1,2), (2,0): stress_i - stress_j = 2 G_s (trialStrain_i - trialStrain_j)
	PrincipalValues<T>     elasticStrain; ///< principal elastic logarithmic strains after the return
	T                      failed = T(0); ///< 1 where the law, which says that it may fail, has no answer

	/// The numbers of one lane from another response.
	void takeLane(int lane, const ResponseOf& o)
	{
		for (int i = 0; i < 3; ++i) {
			stress[i].v[lane]        = o.stress[i][lane];
			shear[i].v[lane]         = o.shear[i][lane];
			elasticStrain[i].v[lane] = o.elasticStrain[i][lane];
			for (int j = 0; j < 3; ++j)
				tangent(i, j).v[lane] = o.tangent(i, j)[lane];
		}
	}
};
using Response = ResponseOf<double>;

/// The part that a return takes of a trial deviator of which it leaves the part theta. It adds to none: where little
/// flows theta may be above 1 by round-off, and a plastic strain that falls below zero would be refused as the state of
/// the next step.
template <class T> GIMPM_INLINE T partTaken(const T& theta)
{
	const T part = T(1) - theta;
	return select(part > T(0), part, T(0));
}

/// Response with the internal variables of the law after the return mapping.
template <class T, std::size_t Count> struct ResponseWith : ResponseOf<T> {
	std::array<T, Count> internals {};

	/// Takes the response of a law with no more variables.
	template <std::size_t Fewer> GIMPM_INLINE void take(const ResponseWith<T, Fewer>& o)
	{
		static_cast<ResponseOf<T>&>(*this) = o;
		for (std::size_t k = 0; k < Fewer; ++k)
			internals[k] = o.internals[k];
	}
	void takeLane(int lane, const ResponseWith& o)
	{
		ResponseOf<T>::takeLane(lane, o);
		for (std::size_t k = 0; k < Count; ++k)
			internals[k].v[lane] = o.internals[k][lane];
	}
};

} // namespace gimpm
