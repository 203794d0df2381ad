// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Conditions on the soil, in the load steps of a run, of a study, and of the limit of explicit steps.
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"
#include "core/terms/contact_energy.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <array>
#include <map>

namespace gimpm {
template <int Dim> struct Motion;
}

namespace yade {
class Analysis;
class MpmCondition;

// A condition, and where it stands among the attributes of an engine.
struct Listed {
	shared_ptr<MpmCondition> condition;
	const char*              list;
	size_t                   number, count; // in the list, and of all in it

	string name() const { return string(list) + "[" + std::to_string(number) + "]"; }
};

// State of the scene as a run or a study begins.
template <int Dim> struct Surroundings {
	const Analysis&               analysis;
	const Scene&                  scene;
	const vector<MaterialPoint>&  points;
	const gimpm::PointCloud<Dim>& cloud;
	Real                          begin, target; // load times
};

// The step that comes next.
struct StepTime {
	Real            from, to; // load times
	Real            looked;   // when loads are looked at: at its end, or with the midpoint rule in its middle
	gimpm::StepKind kind   = gimpm::StepKind::quasiStatic;
	Real            energy = 0; // energy that has come in before a time step [J]
};

// A step that has been accepted.
template <int Dim> struct StepOutcome {
	const gimpm::Model<Dim>&     model;
	const gimpm::StepReport&     report;
	const vector<MaterialPoint>& points;
	Real                         from, time; // load times
	vector<Vector3r>&            reactions;  // forces of the boundaries [N], to which conditions may add the forces that they put in their place
	const vector<Vector3r>&      reactionsBefore;
};

// Work in a time step [J], by its part in the balance of energy.
struct Work {
	Real ofLoads = 0, ofBoundaries = 0;
	Real ofContacts = 0, given = 0;       // given: part of that which no body has worked
	Real ofFriction = 0, ofPenalties = 0; // taken by contact with rigid bodies: dissipated, and by its springs

	Work& operator+=(const Work& other)
	{
		ofLoads += other.ofLoads, ofBoundaries += other.ofBoundaries, ofContacts += other.ofContacts, given += other.given;
		ofFriction += other.ofFriction, ofPenalties += other.ofPenalties;
		return *this;
	}
};

inline Work workOf(const gimpm::ContactEnergy& contact)
{
	return { 0, 0, contact.work, std::max(0., contact.energyGain), contact.friction, contact.penalties };
}

// Springs that limit the length of explicit steps: the stiffest, over Young's modulus per cell [-], and what makes it
// smaller.
struct Penalty {
	Real   size = 0;
	string remedy {};
};

// A point whose domain is halved along an axis; its number stays with the lower half.
struct HalvedDomain {
	int                 lower, upper; // ids
	int                 axis, dim;
	std::array<Real, 3> middle, halfSize; // centre and half size of the whole domain [m]
};

// One for each kind of condition that an engine has, made by it (MpmCondition::make). Terms refer to it, so that it
// lives as long as the model.
template <int Dim> class Condition {
public:
	virtual ~Condition() = default;

	// Constrains nodes or sets them free, before there are points.
	virtual void hold(gimpm::Model<Dim>&) { }

	// Makes it act in the steps of the model. std::invalid_argument names what cannot be computed with.
	virtual void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) = 0;

	// The steps are those in time: `motion` lives as long as the model. The first one begins at a load time.
	virtual void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real /*begin*/) { }

	// Gives points layers as a step begins, once the points are at their positions then, and gives the grid what
	// parts them.
	virtual void part(gimpm::PointCloud<Dim>&, gimpm::Model<Dim>&) { }

	// Sets what acts in the next step, and of its load what the condition prescribes.
	virtual void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) { }

	// Before the state of an accepted step is kept: std::invalid_argument where that cannot be gone on with.
	virtual void requireKept() const { }

	// Work on the soil in the accepted step, while the points are still as before it; only in time steps.
	virtual Work work(const StepOutcome<Dim>&) const { return {}; }

	// Writes an accepted state back.
	virtual void reach(const StepOutcome<Dim>&) { }

	virtual Penalty penalty() const { return {}; }

	// Before the first step: a doubt about where it acts, a sentence; empty if there is none.
	virtual string warningOfPlace(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&) const { return ""; }

	// After the steps of a run: doubts, sentences by what they are about.
	virtual std::map<string, string> warnings() const { return {}; }

	// True if the centre of a part of a point, as seen from the centre of the point, is on the same side of it.
	virtual bool areBeside(const gimpm::Vec<Dim>& /*point*/, const gimpm::Vec<Dim>& /*part*/) const { return true; }

	// Memory of points: its value for a point is divided between the halves of the point. It is told of the points
	// of all processes.
	virtual bool remembersPoints() const { return false; }
	virtual void share(const HalvedDomain&) const { }
};

template <int Dim> using Conditions = vector<std::shared_ptr<Condition<Dim>>>;

// Those of an analysis, in the order of their terms.
template <int Dim> Conditions<Dim> conditionsOf(const Analysis&);

} // namespace yade
