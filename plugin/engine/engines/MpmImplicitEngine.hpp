// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/analysis.hpp"
#include "engine/analysis/kept_columns.hpp"
#include "engine/conditions/load_curves.hpp"
#include "engine/engines/PeriodicCounters.hpp"
#include "engine/engines/job.hpp"
#include "engine/engines/splitting.hpp"
#include "engine/engines/study.hpp"
#include "engine/grid/newPoints.hpp"
#include "engine/messages/ProgressLine.hpp"
#include "engine/messages/plausibility.hpp"
#include "engine/messages/sticking.hpp"
#include "engine/output/plotData.hpp"
#include "engine/output/report.hpp"
#include "engine/parallel/distribution.hpp"
#include "yade_api/interruption.hpp"

namespace yade {

class Agreement;
class MpmBoundary;
class MpmFlow;
class MpmWater;

class MpmImplicitEngine : public Exposed<MpmImplicitEngine, PeriodicEngine>, public Analysis {
public:
	vector<shared_ptr<MpmCondition>> loads;
	vector<shared_ptr<MpmWater>>     water;
	vector<shared_ptr<MpmBoundary>>  boundaries;
	vector<shared_ptr<MpmCondition>> contacts;
	shared_ptr<MpmFlow>              flow; // none: water does not flow
	int                              verbosity = 1;

	MpmImplicitEngine();

	YADE_API_NAME(MpmImplicitEngine)
	static const char* doc()
	{
		return "Implicit quasi-static analysis by the ghost-stabilised generalised interpolation material point method (Coombs 2023). Each run advances "
		       "the material points of the scene by one load step, from the last converged load time to O.time + O.dt: YADE's time is the load clock. A "
		       "step that does not converge is cut; at last it raises RuntimeError, and the scene stays at the last converged state.\n\n"
		       "Set first: *grid*, *boundaries*, *gravity*, and O.dt = 1/40, that the load acts in 40 steps; *fBar* = True for clay and sand that yields. "
		       "mpm.advise() says what is missing.\n\n"
		       "Settings may be changed between steps. Several engines share a scene by *mask*. Page: plugin/docs/classes/MpmImplicitEngine.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using E = MpmImplicitEngine;
		v("grid", &E::grid, 0, "Background grid (MpmGrid); must be given.",
		  admitting("the MpmGrid that mpm.fill was given, as in grid=MpmGrid(cellSize=1)", notNull));
		v("basis", &E::basis, 0,
		  "Basis functions: 'gimp', averaged over the points' domains, or 'mpm', the linear functions of the grid (points that cross cells then disturb "
		  "the solution).",
		  oneOf("gimp", "mpm"));
		v("domains", &E::domains, 0,
		  "Rule by which boxes of points deform: 'tiling', of the points' volume, or 'stretch', by the diagonal of U (Coombs 2023), which is too weak in "
		  "shear.",
		  oneOf("tiling", "stretch"));
		v("fBar", &E::fBar, 0, "Cure for volumetric locking of materials that keep their volume: one dilation in a cell. Needs ghost stabilisation.");
		v("pressureRelaxation", &E::pressureRelaxation, 0,
		  "Pressure filter with *fBar*: takes out differences of pressures in a cell that do not act, as points move; for soil that flows far around a body.");
		v("nonlocalLength", &E::nonlocalLength, 0,
		  "Length [m] of the soil over which softening is averaged, at least *cellSize*; bands become some five times as wide. 0: it is not.",
		  nonNegative);
		v("gravity", &E::gravity, 0, "Acceleration [m/s²] of all material points at load factor 1, finite.", finite);
		v("loadCurve", &E::loadCurve, 0,
		  "Load factor [-] as a sequence of (time [s], factor), times increasing; linear between, constant before and after. Multiplies gravity (but see "
		  "*gravityCurve*), point loads and prescribed displacements.",
		  admitting("one or more (time, factor), all finite, with increasing times", gimpm::LoadCurve::isAdmissible));
		v("gravityCurve", &E::gravityCurve, 0,
		  "Factor [-] of gravity as *loadCurve*, where it shall not go with the other loads; empty, the default: it does. [(0, 1)]: gravity acts from the "
		  "beginning, as after mpm.geostatic.",
		  curveOrNothing);
		v("loads", &E::loads, 0,
		  "Loads on surfaces (MpmTraction), bars and beams (MpmReinforcement, MpmBeam), and other conditions without a list of their own. Read as a tuple: assign a new one to change it.",
		  admitting(
		          "MpmTractions; an MpmWater belongs into water, an MpmBoundary into boundaries, an MpmContact into contacts, an MpmAbsorbingBoundary into absorbing",
		          areLoads));
		v("water", &E::water, 0,
		  "Water in the pores and around the body (MpmWater); several add up. Read as a tuple, so assign a new one to change it.");
		v("boundaries", &E::boundaries, 0, "Essential boundary conditions (MpmBoundary); read as a tuple, so assign a new one to change it.");
		v("contacts", &E::contacts, 0,
		  "Contact with rigid bodies (MpmContact) and of bodies of points with each other (MpmBodyContact); read as a tuple, so assign a new one to change it.",
		  admitting("MpmContacts and MpmBodyContacts", areContacts));
		v("flow", &E::flow, 0,
		  "Water that flows while the soil deforms (MpmFlow), consolidation; None, the default: it has the pressure of *water*, if any.");
		v("ghost", &E::ghost, 0, "Ghost stabilisation (MpmGhost).", notNull);
		v("newton", &E::newton, 0, "Solution of a load step (MpmNewton).", notNull);
		v("mask", &E::mask, 0,
		  "Material points to move: those whose body.groupMask has a bit in common with it; 0 or -1, the default: all. No two engines may claim the same.");
		v("loadTime", &E::loadTime, 0,
		  "Time [s] of the last converged state, where the next step starts; 0 before the first: O.time as it joins. After O.resetTime() set it to O.time.",
		  finite);
		v("verbosity", &E::verbosity, 0,
		  "Messages of a run on stderr. 0: nothing; 1: one line of progress, redrawn on a terminal, repeated every 10 s in a log; 2: a line each step.",
		  oneOf(0, 1, 2));
		v("maxSplits", &E::maxSplits, 0,
		  "Number of times that a point whose domain outgrows half a cell is split in two, with its halves. 0, the default: never; the domain stays at half a cell.",
		  atLeast(0));
		v("distributed", &E::distributed, 0,
		  "True: several processes (scripts/run -n) divide the material points among them, so that each holds its own in memory. Without effect in one process.");
		results([&](auto name, auto member, const auto&, Told, unsigned flags, auto doc, auto validator) { v(name, member, flags, doc, validator); });
	}
	template <class C> static void python(C& c)
	{
		Interruption::prepare();
		addStudyMethods(c);
		addReport(c, py::make_function(+[](const MpmImplicitEngine& engine) { return yade::report(engine); }));
		addPlotData(c, py::make_function(+[](const MpmImplicitEngine& engine) { return yade::plotData(engine); }));
	}

	bool isActivated() override;
	void action() override;

	vector<Listed>    conditions() const override;
	string            className() const override { return getClassName(); }
	void              requireAttributes() const override { requireAdmissible(); }
	shared_ptr<Scene> ownScene() const override; // for an engine that no scene holds, the current one
	Scene&            sceneOfRun() const override { return *scene; }
	long              period() const override { return iterPeriod; }
	long              runs() const override { return nDone; }

	const vector<MaterialPoint>& pointsOfLastRun() const override { return points; }
	const KeptColumns&           keptColumns() const override { return columns; }

	static bool areContacts(const vector<shared_ptr<MpmCondition>>&);
	static bool areLoads(const vector<shared_ptr<MpmCondition>>&);

	// Puts new points into the scene, of several processes that divide them each its own. The id of the first one,
	// or std::invalid_argument in all of them.
	Body::id_t add(NewPoints&);

	// Warns of points with these ids, which have come in between two steps, if none of them fits into the grid.
	void lookAtPlaced(const vector<Body::id_t>& ids);

protected:
	// Reactions of the step before, where they matter.
	virtual const vector<Vector3r>& formerReactions() const { return reactions; }
	// Between load steps, too, the bodies that YADE moves feel the soil.
	void handOver(bool isBetween);

	virtual void setMoving(Job<2>&, const vector<MaterialPoint>&) { }
	virtual void setMoving(Job<3>&, const vector<MaterialPoint>&) { }

	vector<MaterialPoint> points; // points of the step; kept for the next one

private:
	void                            join();
	string                          warningOfAbsence();
	bool                            isEndOfLoads() const;
	bool                            isTimeForSlips(Real begin);
	template <int Dim> void         step(Agreement&);
	template <int Dim> void         askFunctions(Agreement&);
	template <int Dim> bool         ask(const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells) const;
	void                            adaptCells(double& time);
	void                            lookAtBodies();
	bool                            hasQuestions() const;
	template <int Dim> Job<Dim>     prepare(Agreement&);
	template <int Dim> void         takePoints(Setup<Dim>&, Agreement&);
	template <int Dim> void         warnOf(const Job<Dim>&);
	template <int Dim> bool         splitOutgrown(Job<Dim>&);
	template <int Dim> void         advance(Job<Dim>&);
	template <int Dim> Attempt<Dim> nextIncrement(Job<Dim>&) const;
	template <int Dim> void         reach(Job<Dim>&, const Attempt<Dim>&);
	void                            warn(const string&); // nothing if it is empty
	void                            warnOfPoints(const string&);

	PeriodicCounters                    beforeActivation;
	bool                                hasJoined = false, wasAway = false;
	size_t                              pointsOfSlips = 0;  // at the last search
	long                                seen          = -1; // iteration of YADE in which it was asked to run; -1: in none
	ProgressLine                        progressLine;
	Plausibility                        plausibility;
	Splitting                           splitting;
	Sticking                            sticking;
	Distribution                        distribution;
	KeptColumns                         columns;
	mutable boost::weak_ptr<Factorable> home;   // the scene where it was made or seen last
	gimpm::LinearSolver                 solver; // keeps the symbolic analysis; results do not depend on it
};

// For mpm.add: puts points into the current scene, which has this engine, given as newBodies() is; the id of the first
// one.
Body::id_t addPoints(
        const shared_ptr<MpmImplicitEngine>&, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index,
        const py::dict& parameters, int body);

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmImplicitEngine)
