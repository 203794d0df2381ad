// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/stepping/report.hpp"
#include "core/stepping/model.hpp"
#include "core/grid/point_cloud.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/conditions/MpmBoundary.hpp"
#include "engine/solver/MpmGhost.hpp"
#include "engine/solver/MpmGrid.hpp"
#include "engine/solver/MpmNewton.hpp"
#include "engine/solver/ProgressLine.hpp"
#include "engine/solver/plausibility.hpp"
#include "yade_api/interruption.hpp"
#include "yade_api/yade_api.hpp"
#include <map>

namespace yade {

class MpmImplicitEngine : public Exposed<MpmImplicitEngine, PeriodicEngine> {
public:
	shared_ptr<MpmGrid>             grid;
	string                          basis   = "gimp";
	Vector3r                        gravity = Vector3r::Zero();
	vector<std::pair<Real, Real>>   loadCurve { { 0, 0 }, { 1, 1 } };
	vector<std::pair<Real, Real>>   gravityCurve; // empty: loadCurve
	vector<shared_ptr<MpmBoundary>> boundaries;
	shared_ptr<MpmGhost>            ghost { new MpmGhost };
	shared_ptr<MpmNewton>           newton { new MpmNewton };
	int                             mask     = -1;
	Real                            loadTime = 0;
	int                             verbosity = 1;

	bool         converged  = false;
	int          iterations = 0;
	Real         residual   = std::numeric_limits<Real>::quiet_NaN();
	vector<Real> residuals;
	Real         loadFactor  = 0;
	int          activeCells = 0, boundaryCells = 0, ghostFaces = 0, dofs = 0, clampedDomains = 0;
	int          substeps = 0, cuts = 0, lineSearchTrials = 0, reusedFactors = 0, luSolves = 0, cgIterations = 0, cgFallbacks = 0;
	Real         wallOverlap = 0, stepPart = 1;
	vector<Real> lastDisplacements; // of the nodes in the last step, for newton.predictor
	Real         lastLoadIncrement = 0;

	vector<Vector3r> reactions;

	MpmImplicitEngine();

	YADE_API_NAME(MpmImplicitEngine)
	static const char* doc()
	{
		return "Implicit quasi-static analysis by the ghost-stabilised generalised interpolation material point method (Coombs 2023). Each run advances "
		       "all material points of the scene from the last converged load time to O.time + O.dt by one load step: Newton's method for the "
		       "incremental displacements of the nodes of a background grid that is then reset. A step that does not converge is cut (see MpmNewton), "
		       "at last it raises RuntimeError, and the scene stays at the last converged state. Bodies of other kinds are left alone. Quasi-static analysis uses YADE's time as its load clock; with an "
		       "active TimeStepper in the scene set *iterPeriod* > 1 or *virtPeriod*: the engine then runs in every so many iterations, to O.time + O.dt of that "
		       "iteration, and in the one where the load curves end. Times of steps add up with round-off: ten of 0.1 make a little less than 1. So stop by O.run(n), or "
		       "give O.stopAtTime half a step less.\n\n"
		       "Bodies may be added and erased, and materials changed, between steps: the next step starts from what it finds. A changed modulus acts on the "
		       "elastic strain that is there, a lowered yield stress returns it to the new surface. Several engines, each with its own grid, may share a scene "
		       "if their *mask* gives every material point to one of them at most; none inside a ParallelEngine. A material point cannot be part of a clump. A process that is "
		       "forked from a YADE with several threads (os.fork, multiprocessing) can use one only: set *ompThreads* = 1. While the scene runs in the background, what is read is "
		       "the last converged state, and settings that are assigned act from the next step on; change material points, O.bodies and O.engines after "
		       "O.pause() only. Ctrl-C in O.run(n, wait=True) and O.wait() stops the step within an iteration and raises KeyboardInterrupt; O.run() goes on "
		       "from the last converged state.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("grid", &MpmImplicitEngine::grid, 0, "Background grid (MpmGrid); must be given.", admitting("the MpmGrid that mpm.fill was given, as in grid=MpmGrid(cellSize=1)", notNull));
		v("basis",
		  &MpmImplicitEngine::basis,
		  0,
		  "Basis functions: 'gimp', averaged over the points' domains, or 'mpm', the linear functions of the grid (points that cross cells then disturb "
		  "the solution).",
		  oneOf("gimp", "mpm"));
		v("gravity", &MpmImplicitEngine::gravity, 0, "Acceleration [m/s²] of all material points at load factor 1, finite.", finite);
		v("loadCurve",
		  &MpmImplicitEngine::loadCurve,
		  0,
		  "Load factor [-] as a sequence of (time [s], factor), times increasing; linear between, constant before and after. Gravity (unless *gravityCurve* "
		  "says otherwise), point loads and prescribed displacements are multiplied by it. Default: from 0 to 1 during the first second.",
		  admitting("one or more (time, factor), all finite, with increasing times", isLoadCurve));
		v("gravityCurve",
		  &MpmImplicitEngine::gravityCurve,
		  0,
		  "Factor [-] of gravity, where it shall not go with the other loads: as *loadCurve*, which it goes with if this is empty (the default). "
		  "[(0, 1)]: gravity acts from the beginning, as after mpm.geostatic, while *loadCurve* makes point loads and prescribed displacements grow. "
		  "[(0, 0), (1, 1)] with loadCurve=[(1, 0), (2, 1)]: first the weight, then the loads.",
		  admitting("nothing, or (time, factor), all finite, with increasing times", [](const auto& curve) { return curve.empty() || isLoadCurve(curve); }));
		v("boundaries", &MpmImplicitEngine::boundaries, 0, "Essential boundary conditions (MpmBoundary); read as a tuple, so assign a new one to change it.");
		v("ghost", &MpmImplicitEngine::ghost, 0, "Ghost stabilisation (MpmGhost).", notNull);
		v("newton", &MpmImplicitEngine::newton, 0, "Solution of a load step (MpmNewton).", notNull);
		v("mask",
		  &MpmImplicitEngine::mask,
		  0,
		  "Material points to move: those whose body.groupMask has a bit in common with it; 0 or -1 (the default): all. The others stay as they are. "
		  "ValueError in the step if several engines claim a point.");
		v("loadTime",
		  &MpmImplicitEngine::loadTime,
		  0,
		  "Time [s] of the last converged state, where the next step starts. After O.resetTime() set it to O.time.",
		  finite);
		v("verbosity",
		  &MpmImplicitEngine::verbosity,
		  0,
		  "What is said on stderr while the scene runs. 0: nothing. 1: one line with load factor, step (O.iter) and last step if an end is known, "
		  "elapsed and remaining time [min:s], iterations, cuts, residual and number of points; redrawn in place on a terminal during O.run(), but at "
		  "YADE's prompt and in a log repeated every 10 s and at the end of the run. 2: this line for every step.",
		  oneOf(0, 1, 2));
		v("converged", &MpmImplicitEngine::converged, readonly, "Whether the last step converged.");
		const auto count = atLeast(0);
		v("iterations", &MpmImplicitEngine::iterations, readonly, "Linear solves of the last run, those of steps that were undone included.", count);
		v("residual", &MpmImplicitEngine::residual, readonly, "Last out-of-balance force over external forces and reactions [-].");
		v("residuals", &MpmImplicitEngine::residuals, readonly, "The same [-] before the first solve of the last step and after each.");
		v("loadFactor", &MpmImplicitEngine::loadFactor, readonly, "Load factor [-] of the last converged state.", finite);
		v("activeCells", &MpmImplicitEngine::activeCells, readonly, "Cells that held material in the last step.", count);
		v("boundaryCells", &MpmImplicitEngine::boundaryCells, readonly, "Those of them with an empty neighbour (0 without stabilisation).", count);
		v("ghostFaces", &MpmImplicitEngine::ghostFaces, readonly, "Faces stabilised in the last step.", count);
		v("dofs", &MpmImplicitEngine::dofs, readonly, "Free degrees of freedom of the last step.", count);
		v("substeps", &MpmImplicitEngine::substeps, readonly, "Load steps that converged in the last run: 1 unless steps were cut.", count);
		v("cuts", &MpmImplicitEngine::cuts, readonly, "Load steps of the last run that were undone and tried again with half the increment.", count);
		v("lineSearchTrials", &MpmImplicitEngine::lineSearchTrials, readonly, "Shortened Newton steps that were tried in the last run.", count);
		v("reusedFactors", &MpmImplicitEngine::reusedFactors, readonly, "Solves of the last run with the factor of the solve before.", count);
		v("luSolves", &MpmImplicitEngine::luSolves, readonly, "Solves of the last run whose stiffness matrix was not positive definite.", count);
		v("cgIterations", &MpmImplicitEngine::cgIterations, readonly, "Iterations of conjugate gradients in the last run (see MpmNewton.linearSolver).", count);
		v("cgFallbacks", &MpmImplicitEngine::cgFallbacks, readonly, "Solves of the last run that conjugate gradients left to the direct solver.", count);
		v("lastDisplacements",
		  &MpmImplicitEngine::lastDisplacements,
		  hidden,
		  "",
		  admitting("of each node three grid coordinates and three components of its displacement [m], all finite", isIncrement));
		v("lastLoadIncrement", &MpmImplicitEngine::lastLoadIncrement, hidden, "", finite);
		v("stepPart", &MpmImplicitEngine::stepPart, readonly, "Part of O.dt [-] that the next load step tries, > 0 and <= 1.", part);
		v("reactions",
		  &MpmImplicitEngine::reactions,
		  readonly,
		  "For each of *boundaries*, the sum of the forces [N] along x, y, z with which it held its nodes at the end of the last converged step; per metre "
		  "of thickness in plane strain. A node in several boxes counts for the last one. Their sum balances weight and point loads to *residual*. A domain "
		  "that has outgrown a wall (*wallOverlap*) is held behind it in all directions, so a smooth wall then shows some force along its face: it is the "
		  "error of that. Empty before the first step.",
		  admitting("forces of finite numbers [N]", [](const auto& forces) { return std::all_of(forces.begin(), forces.end(), finite); }));
		v("clampedDomains", &MpmImplicitEngine::clampedDomains, readonly, "Points whose domain was kept at half a cell at the end of the last step.", count);
		v("wallOverlap",
		  &MpmImplicitEngine::wallOverlap,
		  readonly,
		  "Largest length [m] by which a domain reached behind a wall in the last step; nodes there count as held.",
		  nonNegative);
	}
	template <class C> static void python(C& c)
	{
		Interruption::prepare();
		c.def("stiffness",
		      &MpmImplicitEngine::stiffness,
		      "stiffness() -> (rows, columns, values, size)\n\nReduced tangent stiffness K + K_g [N/m] of the current configuration: the free degrees of "
		      "freedom only, both triangles, as NumPy arrays (M,) of int64, int64 and float, and the number of unknowns. Usable before any step. Raises "
		      "ValueError as a step does.");
		c.def("report",
		      &MpmImplicitEngine::report,
		      "report() -> dict\n\nHow the last run of this engine in this process went; empty before the first.\n\n"
		      "Outcome: 'converged'; 'accepted' (see MpmNewton.acceptUnconverged); 'failure', one of 'none', 'detached' (a boundary that is to move has no hold of the soil), 'unrestrained', 'singular', 'inverted', 'noResponse', "
		      "'notFinite', 'diverging', 'tooManyIterations', 'stalled' (at round-off), 'interrupted'; 'cause', a clause, empty when converged; 'loadTime' [s] and 'loadFactor' of the "
		      "last converged state; 'stepPart', part of O.dt that the next step tries.\n\n"
		      "Effort of the run, undone tries included: 'iterations' (linear solves), 'substeps', 'cuts', 'lineSearchTrials', 'reusedFactors', 'luSolves', 'cgIterations', 'cgFallbacks'; 'times' [s], dict "
		      "by phase: 'check' (of points that are new or were changed), 'gather', 'basis', 'ghost', 'assembly', 'analyse', 'factorise', 'solve', 'update', 'scatter'.\n\n"
		      "Of the last load step that was tried: 'residuals', list; 'residual', the last of them [-]; 'localResidual', the largest residual around a node "
		      "over the forces there, or a bound of it [-], at most 3 newton.tolerance when converged (NaN where it was not asked for); 'stiffness' of the last "
		      "matrix that was factorised, 'positive definite', 'indefinite' (the equilibrium may not be stable: the body may go on by itself, or have another "
		      "state under the same load) or 'not checked' (none was factorised: conjugate gradients, or nothing to solve); 'worstNode' (position [m], NaN if none), "
		      "'worstAxis' ('x', 'y', 'z' or '') and 'worstForce' [N] of the largest out-of-balance force; 'points', 'nodes', 'dofs', 'activeCells', "
		      "'boundaryCells', 'ghostFaces'.\n\n"
		      "What deserves a look there, with the rule for it: 'clampedDomains', points whose domain would outgrow half a cell: it is kept at half a cell, "
		      "the rest of the point's volume acts within it. 'wallOverlap' [m], the largest length by which a domain reached behind a wall: no cell is "
		      "populated there, and the point's share in nodes behind the wall counts as held. 'mixedCells', cells populated by points of different materials: each point "
		      "keeps its own law, so the cell's stiffness is the sum, and the interface is resolved to one cell. 'islands', parts of the body that share "
		      "no grid node, 1 for a body in one piece (0 if the step was refused before they were counted): the body may break up as long as every part is held against rigid motion; a part that is not "
		      "ends the run as 'unrestrained', with its place, since no equilibrium determines where it goes.");
		c.def("conditionNumber",
		      &MpmImplicitEngine::conditionNumber,
		      "conditionNumber() -> float\n\nCondition number [-] of stiffness() in the 2-norm, from all eigenvalues of the dense matrix (Coombs 2023, figure "
		      "2). For small scenes: raises ValueError above 4000 unknowns.");
		c.def("workload",
		      &MpmImplicitEngine::workload,
		      "workload() -> dict\n\nSize of a load step from the current state, found by doing its parts, without load, and leaving the scene alone: points, "
		      "nodes, dofs, activeCells, ghostFaces; blockEntries, matrixEntries, factorEntries: numbers that the stiffness matrix takes by blocks, reduced, and "
		      "factorised; factorFlops: operations of a factorisation (both 0 with conjugate gradients, see MpmNewton.linearSolver); secondsPerStep and secondsPerSolve: of what is done once a step, and with each solve. "
		      "A factorisation of more than 2e10 operations is not made: its time is that at 5e9 a second. mpm.advise says it in words. Raises ValueError as "
		      "a step does.");
		c.def("conditionEstimate",
		      &MpmImplicitEngine::conditionEstimate,
		      "conditionEstimate() -> float\n\nEstimate [-] of the same, as a rule a few percent below it, for scenes of any size: Lanczos' method with the "
		      "factor of the stiffness matrix, at the cost of a few Newton iterations. Infinite if the matrix is singular to working precision. Raises "
		      "ValueError as a step does, and for a scene without unknowns.");
		c.def("plotData",
		      &MpmImplicitEngine::plotData,
		      "plotData() -> dict\n\nNumbers of the current state for YADE's plot: plot.addData(**solver.plotData()). They are worked out in the call, NaN "
		      "where there is no such number.\n\n"
		      "step: load steps made; loadFactor [-], iterations, cuts, residual [-]: of the last step; points: their number; settlement: largest displacement "
		      "along gravity [m]; displacement: the largest in any direction [m]; plasticShare: part of the initial volume with plasticStrain > 0 [-]; "
		      "elasticEnergy: strain energy of linear (Hencky) elasticity [J]; gravityPotential: minus weight (times its load factor) times displacement, summed "
		      "over the points [J], zero at the initial positions; reaction_x, reaction_y and, in 3D, reaction_z: sum of the attribute *reactions* [N]; "
		      "reaction0_y: that of boundaries[0], for all directions that a boundary fixes. Energies and forces are per metre of thickness in plane "
		      "strain.\n\nRaises ValueError for a body that is no complete material point.");
	}

	bool isActivated() override;
	void action() override;

	py::tuple stiffness();
	py::dict  report() const;
	Real      conditionNumber();
	Real      conditionEstimate();
	py::dict  workload();
	py::dict  plotData();

	// Of any engine, between taking over the values of the material points and giving them back.
	static bool isStepAtWork();

	static bool isLoadCurve(const vector<std::pair<Real, Real>>&);
	static bool isIncrement(const vector<Real>&); // as lastDisplacements

	// When the last of the loads has come to rest, at the last knee of the curves.
	Real loadsEnd() const;

	// The scene that holds this engine in O.engines: the current one, or the one where it was made or seen last (O.switchScene()). For an
	// engine that neither holds, the current one.
	shared_ptr<Scene> ownScene();

private:
	// Counters of PeriodicEngine, which move on before action() is called: after a failed step the same iteration must run again.
	struct Counters {
		Real virtLast = 0, realLast = 0;
		long iterLast = 0, nDone = 0;
	};

	bool                       isEndOfLoads() const;
	void                       run();
	void                       requireRunnable() const;
	void                       requireOnlyClaim() const;
	Real                       loadFactorAt(Real time) const;
	Real                       gravityFactorAt(Real time) const;
	template <int Dim> gimpm::Load<Dim> loadAt(Real time) const; // at the end of a step from loadTime
	template <int Dim> void    step();
	string                     noPoints() const;
	template <int Dim> void    reach(const gimpm::PointCloud<Dim>&, Real time, Real factor);
	template <class F> void    tellObservers(F) const;
	template <int Dim> void    advance(gimpm::PointCloud<Dim>&, gimpm::Model<Dim>&, Real target);
	void                       take(const gimpm::StepReport&);
	void                       addTime(const char* phase, double seconds);
	void                       warn(const string&);
	void                       warnOfEnd();
	void                       warnOfIdleBoundaries();
	void                       warnOfAccepted(const gimpm::StepReport&, Real time);
	string                     reasonOf(const gimpm::StepReport&, Real time, Real part) const;
	string                     placeOfImbalance(const gimpm::StepReport&) const;
	string                     adviceOn(const gimpm::StepReport&, Real part) const;
	template <class F> auto    onCurrentState(F); // f(cloud, model) with the points and settings of now
	gimpm::SymmetricCsc        reducedStiffness();
	void                       showProgress(size_t points, bool stepIsDone);
	long                       lastIteration() const;

	vector<MaterialPoint> points; // of the step; kept for the next one
	Counters            beforeActivation;
	ProgressLine        progressLine;
	Plausibility        plausibility;
	bool                warnedOfEnd = false; // of the load curve
	boost::weak_ptr<Factorable> home;        // the scene where it was made or seen last
	vector<shared_ptr<MpmBoundary>> lookedAtBoundaries; // whether they reach any point
	gimpm::LinearSolver solver; // keeps the symbolic analysis; results do not depend on it

	// for report(): the last load step that was tried, and the times of the last run by phase [s]
	gimpm::StepReport      last;
	std::map<string, Real> times;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmImplicitEngine)
