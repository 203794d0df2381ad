// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmPoint : public ExposedIndexed<MpmPoint, Sphere> {
public:
	Vector3r halfSize  = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN()); // must be given
	Vector3r halfSize0 = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN()); // must be given

	YADE_API_NAME(MpmPoint)
	static const char* doc()
	{
		return "Shape of a material point: the box of matter that it stands for in the generalised interpolation material point method (Bardenhagen and "
		       "Kober 2004, used in Coombs 2023). Made by mpm.fill. For display it is a Sphere: *radius* [m] has no influence on results.\n\n"
		       "Page: plugin/docs/classes/MpmPoint.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		const auto sizes = admitting("three finite numbers > 0 [m]; there is no default", positive);
		v("halfSize", &MpmPoint::halfSize, 0,
		  "Half the domain's size along x, y, z [m] > 0; z: half a metre in plane strain, half a ring's circumference. Follows the stretch, to half a cell.",
		  sizes);
		v("halfSize0", &MpmPoint::halfSize0, 0,
		  "Half the initial size of the domain along x, y, z [m] > 0; along z half a metre in plane strain, half the circumference of a ring.", sizes);
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmPoint)
