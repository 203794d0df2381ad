// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/stepping/load_curve.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

class MpmBaseMotion : public Exposed<MpmBaseMotion, Serializable> {
public:
	gimpm::LoadCurve::Knees history; // must be given
	Vector3r                direction = Vector3r::UnitX();

	YADE_API_NAME(MpmBaseMotion)
	static const char* doc()
	{
		return "History of a velocity, by which nodes that an MpmBoundary constrains move, or of the wave that comes through a MpmAbsorbingBoundary.\n\n"
		       "Set first: *history* of velocities [m/s] over time [s], as read by mpm.readHistory; a record of accelerations has to be integrated before. "
		       "Page: plugin/docs/classes/MpmBaseMotion.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("history", &MpmBaseMotion::history, 0,
		  "Velocity [m/s] as a sequence of (time [s], velocity), times increasing; linear between, zero before the first and after the last. From a file: "
		  "mpm.readHistory. Without default.",
		  admitting("one or more (time, velocity), all finite, with increasing times", gimpm::LoadCurve::isAdmissible));
		v("direction", &MpmBaseMotion::direction, 0, "Factors of the velocity along the axes [-], finite, not zero.",
		  admitting("three finite numbers, not all of them 0", [](const Vector3r& d) { return d.allFinite() && !d.isZero(0); }));
	}

	Vector3r velocityAt(Real time) const { return speedAt(time) * direction; }
	Vector3r displacementBetween(Real begin, Real end) const;

	// A sentence if the history is most likely one of accelerations; `name`: what has it.
	string doubt(const string& name) const;

	// std::invalid_argument, in the name of what has it, for a direction that a grid in the plane does not have.
	void requireInDimension(int dim, const string& name) const;

private:
	Real speedAt(Real time) const;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBaseMotion)
