// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/terms/contact/contact_system.hpp"
#include "engine/analysis/MpmCondition.hpp"
#include "engine/materials/angles.hpp"
#include "yade_api/exposed.hpp"
#include <map>

namespace yade {
class Body;
class Scene;

class MpmContact : public Exposed<MpmContact, MpmCondition> {
public:
	int              mask      = -1;
	Real             friction  = std::numeric_limits<Real>::quiet_NaN(); // coefficient of the bodies' materials
	Real             adhesion  = std::numeric_limits<Real>::infinity();
	Real             stiffness = 100;
	bool             implicit  = false;
	vector<int>      bodies;
	vector<Vector3r> forces, torques, impulses;
	vector<int>      touching, slipping;
	// Hidden: of each of the bodies position and orientation of its last exchange (7 numbers), whether YADE moves
	// it freely, the stiffness that is handed over to those (36), and the impulse of that since; what is remembered
	// of places on them (contact_records.hpp); and of Spheres on which these have turned, id and turn (3 x 3)
	vector<Real>     poses, stiffnesses, records, turns;
	vector<int>      areFree;
	vector<Vector3r> impulsesSince;
	// Not saved. Of members of clumps, where they were in these; and the O.dt that has been looked at
	std::map<int, Se3r> ownPoses;
	Real                stableFor = 0;

	YADE_API_NAME(MpmContact)
	static const char* doc()
	{
		return "Contact with bodies of YADE, which soil cannot enter: Sphere, Box, Facet, Wall, their clumps, in 3D GridConnection, PFacet, ChainedCylinder. Without a NewtonIntegrator in "
		       "O.engines the MpmImplicitEngine moves the bodies by their velocities; with one YADE does, and bodies that are free to move get the forces "
		       "of the soil: the engine then stands before the NewtonIntegrator.\n\n"
		       "In plane strain a body acts by its section at z = 0, per metre, around an axis of symmetry by that revolved; with *implicit* it moves freely there, too.\n\n"
		       "Set first: *friction* [rad]; *stiffness*, 100 for flat bodies, 10 to 20 for round ones and free grains; a body that moves by an eighth of "
		       "a cell in a step. Page: plugin/docs/classes/MpmContact.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("mask", &MpmContact::mask, 0,
		  "Bodies that touch the soil: those, but for material points, whose groupMask has a bit in common with it; 0 or -1, the default: all.");
		v("friction", &MpmContact::friction, 0,
		  "Angle of friction [rad], from 0 to below pi/2: radians(30) of 30 degrees. NaN, the default: frictionAngle of each body's FrictMat.",
		  admitting("an angle [rad] from 0 to below pi/2, as radians(30), or NaN for that of the bodies' FrictMat", [](Real angle) {
			  return std::isnan(angle) || isFrictionAngle(angle);
		  }));
		v("adhesion", &MpmContact::adhesion, 0, "Cap of the shear stress [Pa] >= 0, as of undrained clay; inf, the default: none.",
		  admitting("a number >= 0, or inf", [](Real cap) { return cap >= 0; }));
		v("stiffness", &MpmContact::stiffness, 0,
		  "Penalty [-] > 0: a pressure p presses p h / (stiffness E) deep, with cell size h and Young's modulus E of the soil.", positive);
		v("implicit", &MpmContact::implicit, 0,
		  "True: the engine moves free bodies (blockedDOFs not all set) within the equilibrium of its step, whatever O.dt is; False, the default: a NewtonIntegrator does, in 3D.");
		v("bodies", &MpmContact::bodies, readonly, "Ids of the bodies (of clumps, those of the clumps) in the last step.");
		v("forces", &MpmContact::forces, readonly,
		  "Force of the soil [N] on each of *bodies* at the end of the last converged step; per metre of thickness in plane strain.");
		v("torques", &MpmContact::torques, readonly, "The same of the torques [N m] about their positions.");
		v("impulses", &MpmContact::impulses, readonly,
		  "Impulse [N s] that the stiffness handed over to a free body by MpmImplicitEngine has added in the iterations between the last two load steps; MpmDynamicEngine hands none over.");
		v("touching", &MpmContact::touching, readonly, "Number of contact points on each of *bodies*, a quarter of a cell apart, that soil touches.");
		v("slipping", &MpmContact::slipping, readonly, "Number of those at the limit of friction.");
		v("poses", &MpmContact::poses, hidden, "");
		v("stiffnesses", &MpmContact::stiffnesses, hidden, "");
		v("records", &MpmContact::records, hidden, "");
		v("turns", &MpmContact::turns, hidden, "");
		v("areFree", &MpmContact::areFree, hidden, "");
		v("impulsesSince", &MpmContact::impulsesSince, hidden, "");
	}

	// The lists must go together.
	void requireAdmissible() const override;

	// Records of the last load step, body by body.
	void forget();
	void keep(int id, const gimpm::ContactLoad&, const Se3r& pose, bool isFree, const Vector3r& impulse);

	// Records of the contact points on a body, and as such; it is kept if it is one.
	static constexpr int turnWidth = 10;
	Matrix3r             turnOf(int id) const;
	void                 keepTurn(int id, const Matrix3r&);

	// Pose of body number i in the last exchange.
	Se3r poseOf(size_t i) const;

	// std::invalid_argument where YADE's integrator would not be stable with the stiffness. In every iteration the
	// soil itself is asked, or it is handed over to some.
	void requireStable(const Body&, const gimpm::ContactLoad::Stiffness&, Real dt, bool isHandedOver) const;

	const char*                   list() const override { return "contacts"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	// Those that its mask means: neither material points nor clumps, but members of these; and of nets what is
	// between
	// their nodes.
	vector<shared_ptr<Body>> touchingBodies(const Scene&) const;

	// And the nodes of these.
	vector<shared_ptr<Body>> rigidBodies(const Scene&) const override;

	// For the bodies that are free: the force of the last load step, less stiffness times the movement since, for
	// this iteration of YADE, with a load step or between two.
	void actOnBodies(Scene&, bool isBetween) override;

	vector<Vector3r> edges(const Analysis&, const Scene&, Real spacing) const override;

	bool        goesOn() const override { return true; }
	string      needsUntiedNodes(const string& name) const override { return implicit ? name + ".implicit=True" : ""; }
	string      needsOneBody(const string& name) const override { return implicit ? name + ".implicit=True" : ""; }
	bool        countsSeconds(const Scene&) const override; // true where a body moves
	bool        mayHold(int, Real, Real) const override { return true; }
	string      idleness(const string& name, bool reaches) const override;
	void        tell(Rows&, const Analysis&, const Listed&) const override;
	const char* picture() const override { return "contacts"; }
	void        draw(Picture&, const Analysis&, const Listed&) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmContact)
