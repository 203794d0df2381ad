// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A condition that the plugin does not know: a bed of springs below the soil, the other ends of which move by a
// history.
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/load_curves.hpp"

namespace yade {

class MpmSpringBed : public Exposed<MpmSpringBed, MpmCondition> {
public:
	Real                    height    = 0;
	Real                    stiffness = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real                    young     = 1e6;
	Vector3r                lift      = Vector3r::Zero();
	gimpm::LoadCurve::Knees curve { { 0, 0 }, { 1, 1 } };
	Vector3r                resultant = Vector3r::Zero();
	Real                    work      = 0;
	int                     halves    = 0;
	vector<Vector3r>        nodes, elongations;

	YADE_API_NAME(MpmSpringBed)
	static const char* doc() { return "Springs between the nodes of the grid at a height and a plate that moves."; }

	template <class V> static void attributes(V&& v)
	{
		using B = MpmSpringBed;
		v("height", &B::height, 0, "Height of the nodes [m], finite.", finite);
		v("stiffness", &B::stiffness, 0, "Stiffness of the spring of each node, along all axes [N/m] > 0; without default.", positive);
		v("young", &B::young, 0, "Young's modulus of the soil [Pa] > 0, for the limit of explicit steps.", positive);
		v("lift", &B::lift, 0, "Displacement of the plate at factor 1 [m], finite.", finite);
		v("curve", &B::curve, 0, "Factor [-] of that, as MpmImplicitEngine.loadCurve.", curveOrNothing);
		v("resultant", &B::resultant, readonly, "Force on the soil in the last converged step [N].", finite);
		v("work", &B::work, readonly, "On the soil in the steps in time so far [J].", finite);
		v("halves", &B::halves, readonly, "Number of points that it has been told to be halved.", AnyValue());
		v("nodes", &B::nodes, hidden, "", AnyValue());
		v("elongations", &B::elongations, hidden, "", AnyValue());
	}

	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real        end(const Analysis&) const override { return gimpm::LoadCurve(curve).end(); }
	void        tell(Rows&, const Analysis&, const Listed&) const override;
	const char* picture() const override { return "loads"; }
	void        draw(Picture&, const Analysis&, const Listed&) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmSpringBed)
