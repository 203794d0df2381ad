// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/load_curves.hpp"
#include "yade_api/python_function.hpp"

namespace yade {

class MpmWater : public Exposed<MpmWater, MpmCondition> {
public:
	Real                    level = std::numeric_limits<Real>::quiet_NaN();
	gimpm::LoadCurve::Knees levels;
	PythonFunction          pressure;
	Real                    weight = 9810;
	gimpm::LoadCurve::Knees curve; // empty: that of gravity
	string                  where = "everywhere";
	vector<Vector3r>        onBoundaries;
	// Hidden: values of the function in the state reached, and at the end of the coming step. Of each node of the
	// grid three grid coordinates and the pressure; cell size and origin of that grid.
	vector<Real> table, next, tableGrid;
	// Hidden: the same beside beams, of each place two coordinates and the pressure.
	vector<Real> besideWalls, nextBesideWalls;
	// Hidden: the function has given another pressure than in the step before.
	bool changes = false;

	YADE_API_NAME(MpmWater)
	static const char* doc()
	{
		return "Water of given pressure in the pores and around the body: laws then know effective stress, *density* is that of the saturated soil where "
		       "there is water. One of *level*, *levels*, *pressure* says how high it is. Waters of one engine add up.\n\n"
		       "The pressure does not depend on the deformation: water that flows in time is MpmFlow, water that cannot leave "
		       "*MpmMaterial.undrained*.\n\n"
		       "Set first: *level* [m]; *where* = 'outside' and 'pores' take the two apart. Page: plugin/docs/classes/MpmWater.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("level", &MpmWater::level, 0, "Height [m], against gravity, up to which water stands still; NaN, the default: see *levels* and *pressure*.",
		  admitting("a finite height [m], or NaN if levels or pressure are given", [](Real height) { return !std::isinf(height); }));
		v("levels", &MpmWater::levels, 0,
		  "The same as it rises and falls: (time [s], level [m]), times increasing, linear between; empty, the default: see *level*.", curveOrNothing);
		v("pressure", &MpmWater::pressure, noSave,
		  "Function of the position that returns the pressure [Pa] at the end of the coming step. Asked before each one at the grid's nodes, linear between; files keep answers.");
		v("weight", &MpmWater::weight, 0, "Weight of water by volume [N/m³] > 0, with *level* and *levels*.", positive);
		v("curve", &MpmWater::curve, 0, "Factor [-] of all pressures as *MpmImplicitEngine.loadCurve*; empty, the default: that of gravity.",
		  curveOrNothing);
		v("where", &MpmWater::where, 0,
		  "'everywhere': in the pores and, with the same pressure, on the body's surface; 'pores': surface dry, as after rapid drawdown; 'outside': no water in the pores.",
		  oneOf("everywhere", "pores", "outside"));
		v("onBoundaries", &MpmWater::onBoundaries, readonly,
		  "Part [N] of the reaction of each of the engine's *boundaries* that is due to the water's pressure in its place.");
		v("table", &MpmWater::table, hidden, "", AnyValue());
		v("next", &MpmWater::next, hidden, "", AnyValue());
		v("tableGrid", &MpmWater::tableGrid, hidden, "", AnyValue());
		v("besideWalls", &MpmWater::besideWalls, hidden, "", AnyValue());
		v("nextBesideWalls", &MpmWater::nextBesideWalls, hidden, "", AnyValue());
		v("changes", &MpmWater::changes, hidden, "", AnyValue());
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	const char*                   list() const override { return "water"; }
	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real                      end(const Analysis&) const override;
	bool                      goesOn() const override { return changes; }
	bool                      hasQuestions() const override { return true; }
	void                      forgetAnswers() override { next.clear(), nextBesideWalls.clear(); }
	std::unique_ptr<Question> question(const gimpm::Grid<2>&, const vector<gimpm::Key>&, const string& name, const vector<Listed>& all) override;
	std::unique_ptr<Question> question(const gimpm::Grid<3>&, const vector<gimpm::Key>&, const string& name, const vector<Listed>& all) override;
	string                    answers() const override { return "pressures of water"; }
	std::map<string, string>  warnings(const Analysis&, const vector<MaterialPoint>&, const string& name) const override;

	// Its pressure is that of a function.
	bool hasFunction() const { return std::isnan(level) && levels.empty(); }
	void forgetTable() { table.clear(), besideWalls.clear(), forgetAnswers(), changes = false, evaluated = nullptr; }

	const void* evaluated = nullptr; // the function whose values the table has; null: one that has not been saved
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmWater)
