// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/materials/angles.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

class MpmBodyContact : public Exposed<MpmBodyContact, MpmCondition> {
public:
	vector<string>      between;
	Real                friction     = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real                adhesion     = std::numeric_limits<Real>::infinity();
	Real                stiffness    = 10;
	Real                permittivity = std::numeric_limits<Real>::infinity();
	bool                filled = false, folds = false;
	Vector3r            force    = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	Vector3r            moment   = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	int                 touching = 0, slipping = 0;
	int                 slave = -1;
	vector<Real>        pressures;
	vector<Vector3r>    shears;
	vector<vector<int>> pairs;

	YADE_API_NAME(MpmBodyContact)
	static const char* doc()
	{
		return "Contact of two bodies of points, filled with mpm.fill(..., body=...): where they touch they press, rub and part, while bodies without one "
		       "between them stick where they share cells. Each body has nodes of its own.\n\n"
		       "Contact points on the surface of the softer body bear on the surface of the other one; both move with their bodies. A body named twice is "
		       "in contact with itself, where it folds and as parts that it falls into.\n\n"
		       "Set first: *between* = ('slab', 'ground') and *friction* [rad], then a step in which bodies move by a quarter of a cell. Page: "
		       "plugin/docs/classes/MpmBodyContact.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("between", &MpmBodyContact::between, 0,
		  "Names of the two bodies, as given to mpm.fill(..., body=...), or the same name twice, for contact of a body with itself; without default.",
		  admitting("the names of two bodies, as ('slab', 'ground'), or one name twice; there is no default", areTwo));
		v("friction", &MpmBodyContact::friction, 0, "Angle of friction [rad], from 0 to below pi/2: radians(30) of 30 degrees; without default.",
		  admitting("an angle [rad] from 0 to below pi/2, as radians(30); there is no default", isFrictionAngle));
		v("adhesion", &MpmBodyContact::adhesion, 0, "Cap of the shear stress [Pa] >= 0, as of undrained clay; inf, the default: none.",
		  admitting("a number >= 0, or inf", [](Real cap) { return cap >= 0; }));
		v("stiffness", &MpmBodyContact::stiffness, 0,
		  "Penalty [-] > 0: a pressure p presses p h / (stiffness E) deep, with cell size h and the smaller one of Young's moduli E of the two.",
		  positive);
		v("permittivity", &MpmBodyContact::permittivity, 0,
		  "Permittivity for water of MpmFlow where they touch: conductivity over thickness [1/s] >= 0; inf, the default: it passes as in soil; 0: it does not pass.",
		  admitting("a number >= 0 [1/s], or inf", [](Real value) { return value >= 0; }));
		v("filled", &MpmBodyContact::filled, 0,
		  "True: water of MpmFlow fills the joint, up to half a cell wide: it passes, and presses on both faces; contact is of effective stress. Static steps.");
		v("folds", &MpmBodyContact::folds, 0,
		  "True, of a body named twice: where it folds, the sides are in contact, too; else they stick. Implicit steps, one process.");
		v("force", &MpmBodyContact::force, readonly,
		  "Force on the first body [N] at the end of the last converged step; per metre of thickness in plane strain, of a ring around an axis; NaN before it.");
		v("moment", &MpmBodyContact::moment, readonly, "Moment of these forces about the origin [N m], NaN before the first step.");
		v("touching", &MpmBodyContact::touching, readonly,
		  "Number of contact points that touch, two on each segment of a surface, three on each triangle.");
		v("slipping", &MpmBodyContact::slipping, readonly, "Number of those at the limit of friction.");
		v("slave", &MpmBodyContact::slave, readonly,
		  "Body of *between* that has the contact points, 0 or 1: the softer one, of equal ones the first; -1 before the first step.");
		v("pressures", &MpmBodyContact::pressures, readonly,
		  "Pressure >= 0 [Pa] on each of the *pieces* of that body (MpmBody), in their order, at the end of the last converged step; empty before the first.");
		v("shears", &MpmBodyContact::shears, readonly, "Shear stress [Pa] on each of them.");
		v("pairs", &MpmBodyContact::pairs, readonly,
		  "Of bodies that have come apart: numbers in MpmGrid.bodies of the body with contact points and of the other, and how many of *pressures* are theirs; else empty.");
	}

	// Refuses records of segments or facets that do not go together, too.
	void requireAdmissible() const override;

	const char*                   list() const override { return "contacts"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	// There must be bodies of these names, with a surface, and one contact between two of them.
	void requireFitting(const Analysis&, const string& name) const override;
	bool partsBodies() const override { return true; }
	bool isBetween(const string& one, const string& other) const override
	{
		return between.size() == 2 && ((between[0] == one && between[1] == other) || (between[0] == other && between[1] == one));
	}
	string divideBodies(const Analysis&, const vector<MaterialPoint>&) const override;

	// True if it is between the parts of one body.
	bool isOfOne() const { return between.size() == 2 && between[0] == between[1]; }

	bool        goesOn() const override { return true; }
	bool        mayHold(int, Real, Real) const override { return true; }
	void        tell(Rows&, const Analysis&, const Listed&) const override;
	const char* picture() const override { return "contacts"; }
	void        draw(Picture&, const Analysis&, const Listed&) const override;

private:
	static bool areTwo(const vector<string>& names) { return names.size() == 2 && !names[0].empty() && !names[1].empty(); }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBodyContact)
