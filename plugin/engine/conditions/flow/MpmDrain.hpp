// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/conditions/load_curves.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"

namespace yade {

class MpmDrain : public Exposed<MpmDrain, Serializable> {
public:
	shared_ptr<MpmSurface>  surface; // must be given
	Real                    pressure = 0;
	Real                    level    = std::numeric_limits<Real>::quiet_NaN();
	gimpm::LoadCurve::Knees levels; // empty: level
	Real                    flux    = std::numeric_limits<Real>::quiet_NaN();
	bool                    seepage = false;
	Real                    rain    = std::numeric_limits<Real>::quiet_NaN();
	Real                    driest  = -1e8;
	gimpm::LoadCurve::Knees curve; // empty: one
	Real                    conductance = 30;
	Real                    discharge   = std::numeric_limits<Real>::quiet_NaN();

	YADE_API_NAME(MpmDrain)
	static const char* doc()
	{
		return "Part of the surface of the body by which water of an MpmFlow leaves or enters; it moves with the body. One of *pressure*, *level*, *flux*, *rain* says how. "
		       "Where there is no drain nothing passes.\n\n"
		       "Water passes as through a thin skin (*conductance*), so that the surface may cut cells anywhere.\n\n"
		       "Set first: *surface* = mpm.surface(region, min=..., max=...). Page: plugin/docs/classes/MpmDrain.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("surface", &MpmDrain::surface, 0, "Surface (MpmSurface, points, triangles or gts.Surface) with the body on its inner side; without default.",
		  admitting("an MpmSurface, points or triangles; there is no default", notNull));
		v("pressure", &MpmDrain::pressure, 0, "Pressure outside [Pa] over that of still water (MpmWater), finite; 0: the drain leads to that water.",
		  finite);
		v("level", &MpmDrain::level, 0,
		  "Height [m] up to which water stands outside; above it water can leave only. Still water (MpmWater) needs a level, too. NaN, the default: see *pressure*.",
		  admitting("a finite height [m], or NaN, the default", [](Real height) { return !std::isinf(height); }));
		v("levels", &MpmDrain::levels, 0,
		  "A level that changes, in place of *level*: a sequence of (time [s], height [m]); empty, the default: it stays.", curveOrNothing);
		v("flux", &MpmDrain::flux, 0, "Volume that leaves by area and time [m/s], whatever the pressure; < 0 enters. NaN, the default: see *pressure*.",
		  admitting("a finite number [m/s], or NaN, the default", [](Real value) { return !std::isinf(value); }));
		v("seepage", &MpmDrain::seepage, 0, "True: water can leave only; where its pressure is below that outside nothing passes.");
		v("rain", &MpmDrain::rain, 0,
		  "Volume that enters by area and time [m/s] until the surface is full, and runs off then; < 0 evaporates, down to *driest*. For *MpmFlow.total*; NaN, the default: see *pressure*.",
		  admitting("a finite number [m/s], or NaN, the default", [](Real value) { return !std::isinf(value); }));
		v("driest", &MpmDrain::driest, 0,
		  "Least pressure [Pa] < 0 of a surface from which water evaporates; -1e8, the default, is that of air of half humidity.",
		  admitting("a finite number < 0 [Pa]", [](Real value) { return std::isfinite(value) && value < 0; }));
		v("curve", &MpmDrain::curve, 0, "Factor [-] of *pressure*, *flux* or *rain* as a sequence of (time [s], factor); empty, the default: 1.",
		  curveOrNothing);
		v("conductance", &MpmDrain::conductance, 0,
		  "Conductance of the skin over the conductivity of the soil by cell [-] > 0: the pressure differs from that outside by what drops in 1/conductance cells.",
		  positive);
		v("discharge", &MpmDrain::discharge, readonly,
		  "Volume of water that leaves by time [m³/s] in the last converged step; per metre of thickness in plane strain, NaN before the first.");
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	bool hasLevel() const { return !std::isnan(level) || !levels.empty(); }
	Real levelAt(Real time) const { return levels.empty() ? level : gimpm::LoadCurve(levels).valueAt(time); }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmDrain)
