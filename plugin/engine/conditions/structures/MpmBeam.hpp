// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/conditions/structures/MpmReinforcement.hpp"

namespace yade {

class MpmBeam : public Exposed<MpmBeam, MpmCondition> {
	static constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), inf = std::numeric_limits<Real>::infinity();

public:
	Points                               line;
	Real                                 axialStiffness = nan, bendingStiffness = nan; // must be given
	Real                                 poisson       = 0;
	Real                                 plasticMoment = inf;
	Real                                 weight        = 0;
	Real                                 prestress     = 0;
	Points                               hinges;
	string                               fixHead, fixFoot;
	Vector3r                             headForce    = Vector3r::Zero();
	Real                                 headMoment   = 0;
	Real                                 contraction  = 0;
	Real                                 adhesion     = inf;
	Real                                 friction     = 0;
	Real                                 stiffness    = 10;
	Real                                 permittivity = 0;
	vector<shared_ptr<MpmReinforcement>> anchors;
	gimpm::LoadCurve::Knees              curve; // empty: that of the engine
	// Results, which are also the state from which the next step goes on
	vector<Vector3r> vertices;
	vector<Real>     rotations, axialForces, shearForces, moments, hoopForces, hoopMoments, pressures, leftPressures, rightPressures, waterPressures,
	        leftWaterPressures, rightWaterPressures;
	vector<Real>     lengths, radii, slopes, elongations, bends, gaps, normals, shears, stuck;
	vector<Vector3r> bonds; // state by integration point ahead of the head and the foot: whether it is active, pressure and shear stress [Pa]

	YADE_API_NAME(MpmBeam)
	static const char* doc()
	{
		return "A beam in the plane, by metre of thickness: sheet pile or slurry wall, footing, tunnel lining. With MpmGrid.axisymmetric a shell of "
		       "revolution: round plate, shaft, silo, dome. A line of vertices that move and turn by themselves, pressed against the soil on one or "
		       "both of its sides.\n\n"
		       "Set first: *line*, *axialStiffness* [N], *bendingStiffness* [N m²]. Read *moments*, *shearForces*, *axialForces*. Page: "
		       "plugin/docs/classes/MpmBeam.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using B = MpmBeam;
		v("line", &B::line, 0,
		  "Points [m] of the beam as it is put in, from head to foot: two or more; without default. The last may be the first: a ring.",
		  admitting("two or more points, each apart from the one before", isLine));
		v("axialStiffness", &B::axialStiffness, 0,
		  "EA [N] > 0, by metre of thickness; of a shell E t / (1 - *poisson* ²), t its thickness. Without default.", positive);
		v("bendingStiffness", &B::bendingStiffness, 0, "EI [N m²] > 0, by metre of thickness; of a shell E t³ / 12 (1 - *poisson* ²). Without default.",
		  positive);
		v("poisson", &B::poisson, 0, "Poisson's ratio [-] of a shell of revolution, from 0 to 0.5. A beam in the plane has none.",
		  admitting("a number from 0 to 0.5", [](Real value) { return value >= 0 && value <= 0.5; }));
		v("plasticMoment", &B::plasticMoment, 0, "Largest moment [N m] > 0; inf, the default: it does not yield. Not of a shell.",
		  admitting("a number > 0 [N m], or inf", isPositiveOrInfinite));
		v("weight", &B::weight, 0, "Weight by length [N/m], of a shell by area [N/m²], >= 0: along and with the factor of *MpmImplicitEngine.gravity*.",
		  nonNegative);
		v("prestress", &B::prestress, 0,
		  "Axial force [N] that it has as it is put in, tension positive: of a tendon along it, or of a jack. Not of a shell.", finite);
		v("hinges", &B::hinges, 0, "Hinges are at the vertices that are nearest to these points [m].",
		  admitting("points of two or three numbers, all finite", arePoints));
		v("fixHead", &B::fixHead, 0, "Constrained components of its first vertex: letters out of 'xyr', r for its rotation.",
		  admitting("letters out of 'xyr'", areFixed));
		v("fixFoot", &B::fixFoot, 0, "The same of its last vertex.", admitting("letters out of 'xyr'", areFixed));
		v("headForce", &B::headForce, 0, "Force [N] on the first vertex at load factor 1; on that of a shell the sum around its circle.", finite);
		v("headMoment", &B::headMoment, 0, "Moment [N m] on the first vertex at load factor 1, counterclockwise; of a shell as *headForce*.", finite);
		v("contraction", &B::contraction, 0,
		  "Part [-] of the area in a ring that it loses at load factor 1, from 0 to below 1: the volume loss of a tunnel.",
		  admitting("a number from 0 to below 1, as 0.02 for 2 %", [](Real value) { return value >= 0 && value < 1; }));
		v("adhesion", &B::adhesion, 0, "Strength [Pa] >= 0 of each side along the beam; inf, the default: rough, 0 with friction=0: smooth.",
		  admitting("a number >= 0 [Pa], or inf", isNonNegativeOrInfinite));
		v("friction", &B::friction, 0,
		  "Angle of friction [rad] of beam and soil, from 0 to below pi/2, which adds to *adhesion* where they press on each other.",
		  admitting("an angle from 0 to below pi/2 [rad], as radians(30)", isFrictionAngle));
		v("stiffness", &B::stiffness, 0,
		  "Stiffness of the springs between beam and soil [-] > 0: pressure over displacement, over Young's modulus of the soil by cell.", positive);
		v("permittivity", &B::permittivity, 0,
		  "Permittivity for water that crosses the beam: conductivity over thickness [1/s] >= 0. 0, the default: tight; inf: water passes as if there were no beam.",
		  admitting("a number >= 0 [1/s], or inf", isNonNegativeOrInfinite));
		v("anchors", &B::anchors, 0,
		  "Bars (MpmReinforcement) whose heads are fixed to it, at the vertices nearest to them; not listed in *loads*. Read as a tuple, so assign a new one.");
		v("curve", &B::curve, 0,
		  "Factor [-] of *headForce*, *headMoment*, *contraction*, as *MpmImplicitEngine.loadCurve*; empty, the default: that one.", curveOrNothing);
		v("vertices", &B::vertices, readonly, "Positions of its vertices now [m]; empty before the first step.", AnyValue());
		v("rotations", &B::rotations, readonly, "Rotation of each vertex [rad], counterclockwise.", AnyValue());
		v("axialForces", &B::axialForces, readonly,
		  "N [N] between each vertex and the next one, tension positive; of a shell these are by metre of its circles.", AnyValue());
		v("shearForces", &B::shearForces, readonly, "Q [N] between each vertex and the next one: the slope of *moments* along the line.", AnyValue());
		v("moments", &B::moments, readonly, "M [N m] at each vertex, positive where the line is bent to its left: its right side is stretched.",
		  AnyValue());
		v("hoopForces", &B::hoopForces, readonly,
		  "Force N around the circles of a shell [N/m] in the middle between each vertex and the next one, tension positive.", AnyValue());
		v("hoopMoments", &B::hoopMoments, readonly,
		  "Moment M [N m/m] that bends the circles of a shell, at each vertex, positive where these are bent to the left of the line.", AnyValue());
		v("pressures", &B::pressures, readonly,
		  "Pressure on the soil [Pa] at each vertex, positive to the left of the line: *leftPressures* less *rightPressures*.", AnyValue());
		v("leftPressures", &B::leftPressures, readonly, "Pressure on the soil to the left of the line [Pa], at each vertex.", AnyValue());
		v("rightPressures", &B::rightPressures, readonly, "Pressure on the soil to the right of the line [Pa], at each vertex.", AnyValue());
		v("waterPressures", &B::waterPressures, readonly,
		  "Pressure of the water (MpmWater) to the left of the line less that to its right [Pa], at each vertex: it presses on the beam itself.",
		  AnyValue());
		v("leftWaterPressures", &B::leftWaterPressures, readonly,
		  "Pressure of the water of MpmFlow to the left of the line [Pa], at each vertex; without *total* in excess.", AnyValue());
		v("rightWaterPressures", &B::rightWaterPressures, readonly, "The same to the right of the line [Pa].", AnyValue());
		v("lengths", &B::lengths, hidden, "", AnyValue());
		v("radii", &B::radii, hidden, "", AnyValue());
		v("slopes", &B::slopes, hidden, "", AnyValue());
		v("elongations", &B::elongations, hidden, "", AnyValue());
		v("bends", &B::bends, hidden, "", AnyValue());
		v("gaps", &B::gaps, hidden, "", AnyValue());
		v("normals", &B::normals, hidden, "", AnyValue());
		v("shears", &B::shears, hidden, "", AnyValue());
		v("stuck", &B::stuck, hidden, "", AnyValue());
		v("bonds", &B::bonds, hidden, "", AnyValue());
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;

	Real                                         end(const Analysis&) const override;
	void                                         requireFitting(const Analysis&, const string& name) const override;
	string                                       needsOneBody(const string&) const override { return "a beam"; }
	void                                         requireShell(const string& name) const;
	void                                         tell(Rows&, const Analysis&, const Listed&) const override;
	std::optional<std::pair<Vector3r, Vector3r>> extent() const override;
	string                                       idleness(const string& name, bool reaches) const override;
	const char*                                  picture() const override { return "loads"; }
	void                                         draw(Picture&, const Analysis&, const Listed&) const override;

	// x, y and rotation.
	static std::array<bool, 3> fixed(const string& letters);
	static bool                areFixed(const string& letters) { return letters.find_first_not_of("xyr") == string::npos; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBeam)
