// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/load_curves.hpp"
#include "engine/conditions/shaking/MpmBaseMotion.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"
#include "engine/grid/box.hpp"

namespace yade {

class MpmBoundary : public Exposed<MpmBoundary, MpmCondition> {
public:
	Vector3r                  min = Vector3r::Constant(-std::numeric_limits<Real>::infinity());
	Vector3r                  max = Vector3r::Constant(std::numeric_limits<Real>::infinity());
	string                    fix; // must be given
	Vector3r                  displacement = Vector3r::Zero();
	gimpm::LoadCurve::Knees   curve;   // empty: that of the engine
	shared_ptr<MpmSurface>    surface; // none: the box
	Vector3r                  velocity = Vector3r::Zero();
	Real                      penalty  = 100;
	string                    body;      // empty: all
	shared_ptr<MpmBaseMotion> motion;    // none: it does not move by a history
	vector<Vector3r>          tractions; // tractions of the surface's pieces on the body [Pa]; empty before the first step

	YADE_API_NAME(MpmBoundary)
	static const char* doc()
	{
		return "Essential boundary condition: every grid node inside a box that is fixed in space is constrained, or moved, in the directions *fix*; or, with "
		       "*surface*, the material at a wall that need not be on the lines of the grid.\n\n"
		       "A box that contains no node is an error. A face of a cell whose nodes are all constrained along its normal is a wall, inside of a body too: points "
		       "do not reach through it.\n\n"
		       "Set first: *fix*, and *min* or *max* on a line of the grid, as max=(0, inf, inf), fix='x': rollers at x = 0. Nodes push soil by half a "
		       "cell; farther goes an MpmContact. Page: plugin/docs/classes/MpmBoundary.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("min", &MpmBoundary::min, 0, "Lower corner of the box [m]; -inf, the default, where it has no limit.", notNaN);
		v("max", &MpmBoundary::max, 0, "Upper corner of the box [m]; inf, the default, where it has no limit.", notNaN);
		v("fix", &MpmBoundary::fix, 0,
		  "Constrained directions: one or more of the letters x, y, z, each at most once, or 'n', the normal of *surface*; without default.",
		  admitting("one or more of the letters x, y, z, each at most once, or n", namesDirections));
		v("displacement", &MpmBoundary::displacement, 0,
		  "Displacement [m] of the constrained nodes at load factor 1, along *fix*. They stay where they are: pushed soil follows for half a cell, then the step fails "
		  "('detached').",
		  finite);
		v("curve", &MpmBoundary::curve, 0,
		  "Factor [-] of *displacement* as *MpmImplicitEngine.loadCurve*, where it shall not go with the loads; empty, the default: it does.",
		  curveOrNothing);
		v("motion", &MpmBoundary::motion, 0,
		  "History of the velocity of the constrained nodes (MpmBaseMotion), of MpmDynamicEngine; None, the default: they do not move by one.");
		v("body", &MpmBoundary::body, 0,
		  "Body of points that it constrains alone, as given to mpm.fill(..., body=...), with contact between bodies (MpmBodyContact); empty, the default: all.");
		v("surface", &MpmBoundary::surface, 0,
		  "Wall instead of a box: MpmSurface, points, triangles or gts.Surface; None, the default: the box. Each boundary has its own. It constrains soil on both sides, and "
		  "against pull too.");
		v("velocity", &MpmBoundary::velocity, 0, "Velocity of *surface* and of the soil that it constrains [m per s of O.time], finite.", finite);
		v("penalty", &MpmBoundary::penalty, 0, "Stiffness of *surface* [-] > 0: it gives way by pressure / (penalty young) cells [-].", positive);
		v("tractions", &MpmBoundary::tractions, hidden, "",
		  admitting("tractions of finite numbers [Pa]", [](const auto& all) { return std::all_of(all.begin(), all.end(), finite); }));
	}

	bool fixes(int axis) const { return fix.find("xyz"[axis]) != string::npos; }
	bool fixesNormal() const { return fix == "n"; }
	bool moves() const override { return !displacement.isZero(0) || !velocity.isZero(0) || motion; }

	// Lower and upper corner of the box, or of one around the surface.
	std::optional<std::pair<Vector3r, Vector3r>> extent() const override;

	// Corners that are swapped in the constructor.
	void postLoad() { requireCorners("MpmBoundary", min, max); }

	// The attributes must go together, too.
	void requireAdmissible() const override;

	static bool namesDirections(const string&);

	const char*                   list() const override { return "boundaries"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real   end(const Analysis&) const override;
	bool   goesOn() const override { return !velocity.isZero(0); }
	bool   countsSeconds(const Scene&) const override { return !velocity.isZero(0) || motion; }
	void   requireFitting(const Analysis&, const string& name) const override;
	string needsUntiedNodes(const string& name) const override { return surface ? name + ".surface" : ""; }
	string needsOneBody(const string& name) const override
	{
		return surface && body.empty() ? name + ".surface without the body that it constrains (MpmBoundary.body)" : "";
	}
	string                   onlyOn() const override { return body; }
	const Serializable*      ownSurface() const override { return surface.get(); }
	bool                     mayHold(int axis, Real place, Real near) const override;
	string                   idleness(const string& name, bool reaches) const override;
	std::map<string, string> warnings(const Analysis&, const vector<MaterialPoint>&, const string& name) const override;
	void                     tell(Rows&, const Analysis&, const Listed&) const override;
	string                   firstDoubt(const string& name) const override { return motion ? motion->doubt(name) : ""; }
	const char*              picture() const override { return "walls"; }
	void                     draw(Picture&, const Analysis&, const Listed&) const override;

private:
	string whatContradicts(int axis) const;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBoundary)
