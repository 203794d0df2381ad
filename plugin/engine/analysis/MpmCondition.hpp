// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/grid.hpp"
#include "engine/analysis/condition.hpp"
#include "engine/analysis/output_columns.hpp"
#include "yade_api/exposed.hpp"
#include <optional>

namespace yade {

// Question to a function of Python before a step. It may do anything that a script can, so that the lock of values is
// not held meanwhile.
class Question {
public:
	virtual ~Question()        = default;
	virtual void ask()         = 0; // std::invalid_argument for what it returns or raises
	virtual void store() const = 0; // the answers, where the lock is held again
};

class MpmCondition : public Exposed<MpmCondition, Serializable> {
public:
	using Group   = vector<Listed>; // all objects of one class
	using InPlane = std::integral_constant<int, 2>;
	using InSpace = std::integral_constant<int, 3>;

	YADE_API_NAME(MpmCondition)
	static const char* doc()
	{
		return "Action on the material points of an MpmImplicitEngine. Base class of MpmBoundary, MpmTraction, MpmWater, MpmContact and "
		       "MpmAbsorbingBoundary; it does nothing itself.\n\n"
		       "Not to be made itself: begin with MpmBoundary. Page: plugin/docs/classes/MpmImplicitEngine.md.";
	}
	template <class V> static void attributes(V&&) { }
	template <class C> static void python(C& c)
	{
		c.def(
		        "_places", +[](const MpmCondition& condition) { return Conversion<vector<Vector3r>>::toPython(condition.places()); },
		        "For mpm.stages: where it acts, which is not to be dug out.");
		c.def("_actsAlong", &MpmCondition::actsAlong, "For mpm.advise: whether it may act along the axis of this number.");
	}

	// The attribute of the engine that it belongs to.
	virtual const char* list() const { return "loads"; }

	// Makes the part of load steps that acts for all objects of the class.
	virtual std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const;
	virtual std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const;

	// When its history has come to rest.
	virtual Real end(const Analysis&) const { return -std::numeric_limits<Real>::infinity(); }

	// True if it may change the state for ever, without a history that ends.
	virtual bool goesOn() const { return false; }

	// std::invalid_argument for settings that it does not go with, in the name given.
	virtual void requireFitting(const Analysis&, const string& /*name*/) const { }

	// Feature of it that cells of several sizes do not admit; empty: none.
	virtual string needsEqualCells(const string& /*name*/) const { return ""; }

	// The same of nodes that are tied to others, as those beside a beam that parts the soil; then it does not.
	virtual string needsUntiedNodes(const string& name) const { return needsEqualCells(name); }

	// True if it is a contact between bodies of points, which gives them nodes of their own; then the feature of a
	// condition that such contact does not admit, empty if there is none.
	virtual bool   partsBodies() const { return false; }
	virtual string needsOneBody(const string& /*name*/) const { return ""; }
	// True if it is a contact between two bodies of points with these names; with the same name, between its parts.
	virtual bool isBetween(const string& /*one*/, const string& /*other*/) const { return false; }
	// Before a step, where it is between parts of one body: those that have come off it get bodies of their own. A
	// doubt, a sentence; empty if there is none.
	virtual string divideBodies(const Analysis&, const vector<MaterialPoint>&) const { return ""; }
	// The body of points that it acts on alone, which has nodes of its own then; empty: all.
	virtual string onlyOn() const { return ""; }
	// True if it acts by rates, so that O.time counts seconds.
	virtual bool countsSeconds(const Scene&) const { return false; }

	// A surface that it moves, which no other one may move.
	virtual const Serializable* ownSurface() const { return nullptr; }

	// Rigid bodies that it acts by. They are looked at in all processes, and belong to one engine.
	virtual vector<shared_ptr<Body>> rigidBodies(const Scene&) const { return {}; }

	// In an iteration of YADE, with a load step or between two.
	virtual void actOnBodies(Scene&, bool /*isBetween*/) { }

	// Answers of functions hold for one step: before each step they are forgotten.
	virtual void forgetAnswers() { }
	// Questions to functions of Python around cells. Answers: the name of the answers in the message of processes
	// that have got different ones.
	virtual bool                      hasQuestions() const { return false; }
	virtual std::unique_ptr<Question> question(const gimpm::Grid<2>&, const vector<gimpm::Key>&, const string& /*name*/, const vector<Listed>& /*all*/)
	{
		return nullptr;
	}
	virtual std::unique_ptr<Question> question(const gimpm::Grid<3>&, const vector<gimpm::Key>&, const string& /*name*/, const vector<Listed>& /*all*/)
	{
		return nullptr;
	}
	virtual string answers() const { return ""; }

	// Doubts about settings that can be meant, but seldom are: sentences by subject. The same ones in all
	// processes.
	virtual std::map<string, string> warnings(const Analysis&, const vector<MaterialPoint>&, const string& /*name*/) const { return {}; }

	// The same, asked once, before the first step of an engine.
	virtual string firstDoubt(const string& /*name*/) const { return ""; }

	// True if it may constrain the soil at this coordinate along the axis, to a distance.
	virtual bool mayHold(int /*axis*/, Real /*place*/, Real /*near*/) const { return false; }

	// Limits of its region, if it has any: lower and upper corner. A sentence, with a blank before it, if it does
	// not constrain anything now; `reaches`: there are points.
	virtual std::optional<std::pair<Vector3r, Vector3r>> extent() const { return std::nullopt; }
	virtual string                                       idleness(const string& /*name*/, bool /*reaches*/) const { return ""; }
	virtual bool                                         moves() const { return false; }

	// Positions, no farther apart than the spacing, where its action on the soil is singular at the begin or at the
	// end of the coming step: there MpmGrid.adaptation halves cells.
	virtual vector<Vector3r> edges(const Analysis&, const Scene&, Real /*spacing*/) const { return {}; }

	// Positions at which it acts on the soil, which must not be dug out there; true if it may act along an axis.
	virtual vector<Vector3r> places() const { return {}; }
	virtual bool             actsAlong(int /*axis*/) const { return true; }

	// Columns of plotData().
	virtual void tell(Rows&, const Analysis&, const Listed&) const { }

	// Adds its cells to the picture of its kind, which MpmVtkRecorder.recorders and mpm.plot name; null: it has
	// none.
	virtual const char* picture() const { return nullptr; }
	virtual void        draw(Picture&, const Analysis&, const Listed&) const { }
};

// Next question of one condition, the first of all that has something to ask. Asked until nobody has.
template <int Dim> std::unique_ptr<Question> nextQuestion(const vector<Listed>&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells);

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmCondition)
