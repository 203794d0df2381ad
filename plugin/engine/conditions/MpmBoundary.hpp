// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/registration.hpp"

namespace yade {

class MpmBoundary : public Exposed<MpmBoundary, Serializable> {
public:
	Vector3r min = Vector3r::Constant(-std::numeric_limits<Real>::infinity());
	Vector3r max = Vector3r::Constant(std::numeric_limits<Real>::infinity());
	string   fix; // must be given
	Vector3r displacement = Vector3r::Zero();

	YADE_API_NAME(MpmBoundary)
	static const char* doc()
	{
		return "Essential boundary condition: every grid node inside a box that is fixed in space is held, or moved, in the directions *fix*. Faces of "
		       "the box belong to it, with a tolerance of 1e-9 cells. A box that holds no node is an error; one whose nodes carry no soil yet is named in a warning, "
		       "once. A face of a cell whose nodes are all held "
		       "along its normal is a wall, inside of a body too: points do not reach through it. To move a body by nodes inside of it, hold nodes that "
		       "do not make up a face.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("min", &MpmBoundary::min, 0, "Lower corner of the box [m]; -inf, the default, where it has no limit.", notNaN);
		v("max", &MpmBoundary::max, 0, "Upper corner of the box [m]; inf, the default, where it has no limit.", notNaN);
		v("fix",
		  &MpmBoundary::fix,
		  0,
		  "Directions that are held: one or more of the letters x, y, z, each at most once; without default.",
		  admitting("one or more of the letters x, y, z, each at most once", namesDirections));
		v("displacement",
		  &MpmBoundary::displacement,
		  0,
		  "Displacement [m] of the held nodes at load factor 1, along *fix* only. The nodes stay where they are: soil that they push follows for half a "
		  "cell.",
		  finite);
	}

	bool fixes(int axis) const { return fix.find("xyz"[axis]) != string::npos; }

	// The attributes must go together, too.
	void requireAdmissible() const override;

	static bool namesDirections(const string&);
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBoundary)
