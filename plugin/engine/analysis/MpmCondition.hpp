// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/grid.hpp"
#include "engine/analysis/condition.hpp"
#include "engine/analysis/telling.hpp"
#include "yade_api/exposed.hpp"
#include <optional>

namespace yade {

// What a function of Python is asked before a step. It may do anything that a script can, so that the lock of values is
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
		return "What acts on the material points of an MpmImplicitEngine. Base class of MpmBoundary, MpmTraction, MpmWater, MpmContact and "
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

	// What acts in load steps, for all objects of its class.
	virtual std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const;
	virtual std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const;

	// When its history has come to rest.
	virtual Real end(const Analysis&) const { return -std::numeric_limits<Real>::infinity(); }

	// Whether it may change the state for ever, without a history that ends.
	virtual bool goesOn() const { return false; }

	// std::invalid_argument for settings that it does not go with, in the name given.
	virtual void requireFitting(const Analysis&, const string& /*name*/) const { }

	// What about it does not go with cells of several sizes; empty if it does.
	virtual string needsEqualCells(const string& /*name*/) const { return ""; }

	// The same of nodes that are tied to others, as those beside a beam that parts the soil; then it does not.
	virtual string needsUntiedNodes(const string& name) const { return needsEqualCells(name); }

	// Whether bodies of points meet by it, which have nodes of their own; and what about a condition does not go
	// with that, empty if it does.
	virtual bool   partsBodies() const { return false; }
	virtual string needsOneBody(const string& /*name*/) const { return ""; }
	// The body of points that it acts on alone, which has nodes of its own then; empty: all.
	virtual string onlyOn() const { return ""; }
	// Whether it acts by rates, so that O.time counts seconds.
	virtual bool countsSeconds(const Scene&) const { return false; }

	// A surface that it moves, which no other one may move.
	virtual const Serializable* ownSurface() const { return nullptr; }

	// Rigid bodies that it acts by. They are looked at in all processes, and belong to one engine.
	virtual vector<shared_ptr<Body>> rigidBodies(const Scene&) const { return {}; }

	// In an iteration of YADE, with a load step or between two.
	virtual void actOnBodies(Scene&, bool /*isBetween*/) { }

	// Answers of functions hold for one step: before each step they are forgotten.
	virtual void forgetAnswers() { }
	// What functions of Python have to be asked around cells. Answers: what they are called where processes have
	// got different ones.
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

	// What can be meant, but seldom is: sentences, by what they are about. The same ones in all processes.
	virtual std::map<string, string> warnings(const Analysis&, const vector<MaterialPoint>&, const string& /*name*/) const { return {}; }

	// The same, asked once, before the first step of an engine.
	virtual string firstDoubt(const string& /*name*/) const { return ""; }

	// Whether it may hold the soil at this coordinate along the axis, to a distance.
	virtual bool mayHold(int /*axis*/, Real /*place*/, Real /*near*/) const { return false; }

	// Where it acts, if that has limits: lower and upper corner. A sentence, with a blank before it, if it does not
	// hold anything now; `reaches`: there are points.
	virtual std::optional<std::pair<Vector3r, Vector3r>> extent() const { return std::nullopt; }
	virtual string                                       idleness(const string& /*name*/, bool /*reaches*/) const { return ""; }
	virtual bool                                         moves() const { return false; }

	// Where it acts on the soil, which must not be dug out there; whether it may act along an axis.
	virtual vector<Vector3r> places() const { return {}; }
	virtual bool             actsAlong(int /*axis*/) const { return true; }

	// Columns of plotData().
	virtual void tell(Rows&, const Analysis&, const Listed&) const { }

	// Adds its cells to the picture of its kind, which MpmVtkRecorder.recorders and mpm.plot name; null: it has
	// none.
	virtual const char* picture() const { return nullptr; }
	virtual void        draw(Picture&, const Analysis&, const Listed&) const { }
};

// What one condition asks of its functions, the first of all that has something to ask. Asked until nobody has.
template <int Dim> std::unique_ptr<Question> nextQuestion(const vector<Listed>&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells);

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmCondition)
