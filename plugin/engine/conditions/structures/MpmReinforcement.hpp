// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/load_curves.hpp"
#include "engine/conditions/structures/lines.hpp"
#include "engine/materials/angles.hpp"

namespace yade {

class MpmReinforcement : public Exposed<MpmReinforcement, MpmCondition> {
	static constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), inf = std::numeric_limits<Real>::infinity();

public:
	Points                  line;
	Real                    axialStiffness = nan; // must be given
	bool                    tensionOnly    = true;
	Real                    strength       = inf;
	Real                    bond           = inf;
	Real                    friction       = 0;
	Real                    perimeter      = nan;
	Real                    bondStiffness  = inf;
	Real                    freeLength     = 0;
	bool                    headPlate      = false;
	Real                    pull           = 0;
	Real                    pretension     = 0;
	gimpm::LoadCurve::Knees curve; // empty: that of the engine
	// Results, which are also the state from which the next step goes on
	vector<Vector3r> vertices;
	vector<Real>     axialForces, slips, bondForces, lengths, strains;
	bool             isStressed = false;

	YADE_API_NAME(MpmReinforcement)
	static const char* doc()
	{
		return "A bar in the soil that carries forces along itself only: nail, anchor, strip, geotextile. Its vertices move with the soil, and slip "
		       "along the bar where its bond yields. In the plane all forces are per metre of thickness.\n\n"
		       "Set first: *line*, *axialStiffness* [N]; *bond* and *bondStiffness* if it may be pulled out. Read *axialForces*. Page: "
		       "plugin/docs/classes/MpmReinforcement.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using B = MpmReinforcement;
		v("line", &B::line, 0, "Points [m] of the bar as it is put in, from its head on: two or more; without default.",
		  admitting("two or more points, each apart from the one before", isLine));
		v("axialStiffness", &B::axialStiffness, 0, "Force over strain, EA [N] > 0; without default.", positive);
		v("tensionOnly", &B::tensionOnly, 0, "True, the default: slack where it would be compressed.");
		v("strength", &B::strength, 0, "Force [N] > 0 at which it yields; inf, the default: it does not.",
		  admitting("a number > 0 [N], or inf", isPositiveOrInfinite));
		v("bond", &B::bond, 0, "Strength of the bond without normal stress, by length of the bar [N/m] >= 0; inf, the default: it does not slip.",
		  admitting("a number >= 0 [N/m], or inf", isNonNegativeOrInfinite));
		v("friction", &B::friction, 0,
		  "Angle of friction [rad] of bar and soil, from 0 to below pi/2, which adds to *bond* where the soil presses on it.",
		  admitting("an angle from 0 to below pi/2 [rad], as radians(30)", isFrictionAngle));
		v("perimeter", &B::perimeter, 0,
		  "Around the bar [m] > 0, on which friction acts. NaN, the default: in the plane 2, both faces by metre of thickness.",
		  admitting("a number > 0 [m], or NaN", [](Real p) { return std::isnan(p) || (p > 0 && std::isfinite(p)); }));
		v("bondStiffness", &B::bondStiffness, 0,
		  "Force over slip, by length of the bar [N/m²] > 0; inf, the default: it does not slip. To be given with *bond* or *friction*.",
		  admitting("a number > 0 [N/m2], or inf", isPositiveOrInfinite));
		v("freeLength", &B::freeLength, 0, "Length [m] >= 0 behind the head, in the first segment of *line*, without bond.", nonNegative);
		v("headPlate", &B::headPlate, 0, "True: the head is fixed to the soil around it.");
		v("pull", &B::pull, 0, "Force [N] >= 0 on the head at load factor 1, outwards along the bar.", nonNegative);
		v("pretension", &B::pretension, 0,
		  "Force [N] >= 0 to which it is stressed while *curve* changes, as by a jack; then it is locked. In the free length, or without one everywhere.",
		  nonNegative);
		v("curve", &B::curve, 0, "Factor [-] of *pull* and *pretension*, as *MpmImplicitEngine.loadCurve*; empty, the default: that one.",
		  curveOrNothing);
		v("vertices", &B::vertices, readonly, "Positions of its vertices now [m]; empty before the first step.", AnyValue());
		v("axialForces", &B::axialForces, readonly, "Force [N] between each vertex and the next one, tension positive.", AnyValue());
		v("slips", &B::slips, readonly, "Displacement of each vertex against the soil [m], positive away from the head.", AnyValue());
		v("bondForces", &B::bondForces, readonly, "Force [N] of the soil on each vertex that slips, positive towards the head.", AnyValue());
		v("lengths", &B::lengths, hidden, "", AnyValue());
		v("strains", &B::strains, hidden, "", AnyValue());
		v("isStressed", &B::isStressed, hidden, "", AnyValue());
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real             end(const Analysis&) const override;
	void             requireFitting(const Analysis&, const string& name) const override;
	string           needsOneBody(const string&) const override { return "reinforcement"; }
	vector<Vector3r> places() const override { return vertices.empty() ? placesOf(line) : vertices; }
	void             tell(Rows&, const Analysis&, const Listed&) const override;
	const char*      picture() const override { return "loads"; }
	void             draw(Picture&, const Analysis&, const Listed&) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmReinforcement)
