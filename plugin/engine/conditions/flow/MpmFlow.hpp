// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/flow/MpmDrain.hpp"

namespace yade {

class MpmFlow : public Exposed<MpmFlow, MpmCondition> {
public:
	Real                         unitWeight          = 9810;
	Real                         bulkModulus         = std::numeric_limits<Real>::infinity();
	Real                         stabilisation       = std::numeric_limits<Real>::quiet_NaN();
	Real                         ghost               = 0.01;
	Real                         pressureTolerance   = std::numeric_limits<Real>::infinity();
	Real                         saturationTolerance = std::numeric_limits<Real>::infinity();
	bool                         total               = false;
	string                       bishop              = "effective saturation";
	vector<shared_ptr<MpmDrain>> drains;
	Real                         waterIn = 0, waterOut = 0, waterStored = 0, work = 0;
	// Hidden: of each node three grid coordinates and the pressure, as the last step has left it
	vector<Real> nodes;
	// Hidden: of the same nodes the growth of the three displacements and the pressure in the last step, and how
	// long that was; empty in steps in time that no tolerance judges
	vector<Real> growth;
	Real         lastDuration = 0;

	YADE_API_NAME(MpmFlow)
	static const char* doc()
	{
		return "Water that flows through the soil while it deforms: consolidation. Its pressure over that of still water (MpmWater), *MpmState.excessPressure*, is solved for "
		       "together with the displacements, step by step in time: O.dt and O.time are seconds. All materials need *conductivity* and *porosity*.\n\n"
		       "The soil is saturated everywhere, unless *total* and *MpmMaterial.retention* are given. *drains* say where water leaves; elsewhere nothing passes.\n\n"
		       "Set first: *drains*, and time steps that grow as what happens slows down. Page: plugin/docs/classes/MpmFlow.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("unitWeight", &MpmFlow::unitWeight, 0, "Weight of water by volume [N/m³] > 0.", positive);
		v("bulkModulus", &MpmFlow::bulkModulus, 0, "Bulk modulus of the water [Pa] > 0; inf, the default: it keeps its volume.",
		  admitting("a number > 0 [Pa], or inf", [](Real value) { return value > 0; }));
		v("stabilisation", &MpmFlow::stabilisation, 0,
		  "Penalty [-] >= 0 on pressures that change from node to node, over the inverse of the constrained modulus; 0: none. NaN, the default: 1, with inertia 0.1.",
		  admitting("a finite number >= 0, or NaN, the default", [](Real value) { return std::isnan(value) || nonNegative(value); }));
		v("ghost", &MpmFlow::ghost, 0, "Penalty [-] >= 0 on jumps of the pressure's gradient at nearly empty cells, as *MpmGhost.factor*.",
		  nonNegative);
		v("pressureTolerance", &MpmFlow::pressureTolerance, 0,
		  "Largest estimated error of pressures in a step [Pa] > 0, with *MpmNewton.stepTolerance*; steps beyond it are cut, and grow again, up to O.dt. inf: not checked.",
		  admitting("a number > 0 [Pa], or inf", [](Real value) { return value > 0; }));
		v("saturationTolerance", &MpmFlow::saturationTolerance, 0,
		  "The same of the degree of saturation [-], with *total* and a retention curve: for steps in which fronts wet dry soil. inf: not checked.",
		  admitting("a number > 0 [-], or inf", [](Real value) { return value > 0; }));
		v("total", &MpmFlow::total, 0,
		  "True: *MpmState.excessPressure* is the whole pressure, over that of the air, and gravity drives the water: for rain, and soil with *MpmMaterial.retention*. There is no still water then.");
		v("bishop", &MpmFlow::bishop, 0, "Factor by which suction acts on the grains, with *total*: 'effective saturation' or 'saturation'.",
		  oneOf("effective saturation", "saturation"));
		v("drains", &MpmFlow::drains, 0, "Drains, through which water leaves or enters (MpmDrain); read as a tuple, so assign a new one to change it.");
		v("waterIn", &MpmFlow::waterIn, readonly,
		  "Volume of water [m³] that has entered by drains since the first step; per metre of thickness in plane strain.");
		v("waterOut", &MpmFlow::waterOut, readonly, "Volume of water [m³] that has left by drains since the first step.");
		v("waterStored", &MpmFlow::waterStored, readonly,
		  "Volume of water [m³] that the soil has taken up since the first step: *waterIn* less *waterOut*.");
		v("work", &MpmFlow::work, readonly, "Work of the pressures in excess on the soil so far [J], of MpmDynamicEngine.", finite);
		v("nodes", &MpmFlow::nodes, hidden, "", AnyValue());
		v("growth", &MpmFlow::growth, hidden, "", AnyValue());
		v("lastDuration", &MpmFlow::lastDuration, hidden, "", AnyValue());
	}

	// The flow of an analysis; null: there is none.
	static shared_ptr<MpmFlow> of(const Analysis&);

	// The attributes must go together, too.
	void requireAdmissible() const override;

	const char*                   list() const override { return "flow"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real end(const Analysis&) const override;
	bool goesOn() const override { return true; }
	bool countsSeconds(const Scene&) const override { return true; }
	void requireFitting(const Analysis&, const string& name) const override;
	void tell(Rows&, const Analysis&, const Listed&) const override;

	std::map<string, string> warnings(const Analysis&, const vector<MaterialPoint>&, const string& name) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmFlow)
