// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/shaking/MpmBaseMotion.hpp"
#include "engine/grid/box.hpp"

namespace yade {

class MpmAbsorbingBoundary : public Exposed<MpmAbsorbingBoundary, MpmCondition> {
public:
	Vector3r                  min = Vector3r::Constant(-std::numeric_limits<Real>::infinity());
	Vector3r                  max = Vector3r::Constant(std::numeric_limits<Real>::infinity());
	shared_ptr<MpmBaseMotion> motion; // none: no wave comes from beyond
	Vector3r                  reaction = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	bool                      hasBegun = false;
	// Forces that go on acting [N], and their nodes of the grid (integer coordinates).
	vector<Vector3r> nodes, borne;

	YADE_API_NAME(MpmAbsorbingBoundary)
	static const char* doc()
	{
		return "Edge of the body where waves leave it, of MpmDynamicEngine: the faces of cells whose nodes are all inside a box get dashpots (Lysmer and "
		       "Kuhlemeyer 1969), as if the body went on beyond. With *motion* a wave comes from there (Joyner and Chen 1975).\n\n"
		       "Forces by which its nodes are out of balance when it first acts, those of a boundary that constrained them until then, go on acting. Points do "
		       "not reach through it.\n\n"
		       "Set first: a box that contains the outermost row of nodes, as max=(0, inf, inf), and far from what yields. Page: "
		       "plugin/docs/classes/MpmAbsorbingBoundary.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using B = MpmAbsorbingBoundary;
		v("min", &B::min, 0, "Lower corner of the box [m]; -inf, the default, where it has no limit.", notNaN);
		v("max", &B::max, 0, "Upper corner of the box [m]; inf, the default, where it has no limit.", notNaN);
		v("motion", &B::motion, 0,
		  "Velocity of the wave that comes from beyond (MpmBaseMotion), half of that at a free surface of what is beyond; None, the default: no wave.");
		v("reaction", &B::reaction, readonly,
		  "Force [N] on the body in the last converged step; per metre of thickness in plane strain, NaN before the first.");
		v("hasBegun", &B::hasBegun, hidden, "", AnyValue());
		v("nodes", &B::nodes, hidden, "", AnyValue());
		v("borne", &B::borne, hidden, "",
		  admitting("forces of finite numbers [N]", [](const auto& forces) { return std::all_of(forces.begin(), forces.end(), finite); }));
	}

	// Corners that are swapped in the constructor.
	void postLoad() { requireCorners("MpmAbsorbingBoundary", min, max); }

	// The attributes must go together, too.
	void requireAdmissible() const override;

	const char*                   list() const override { return "absorbing"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	void   tell(Rows&, const Analysis&, const Listed&) const override;
	string needsOneBody(const string&) const override { return "an absorbing boundary"; }
	string needsUntiedNodes(const string& name) const override { return name; }
	string firstDoubt(const string& name) const override { return motion ? motion->doubt(name) : ""; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmAbsorbingBoundary)
