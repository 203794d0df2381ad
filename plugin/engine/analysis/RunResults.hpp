// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Results of the last run of an engine.
#include "core/stepping/report.hpp"
#include "engine/analysis/last_increment.hpp"
#include "yade_api/exposed.hpp"
#include <functional>
#include <map>

namespace yade {

// Sources of a number: begin() as a run begins, take() as a load step of it has been tried.
namespace source {
	// The last load step that was tried.
	template <class F> struct Latest {
		F                       of;
		template <class T> void begin(T&) const { }
		template <class T> void take(T& number, const gimpm::StepReport& report) const { number = std::invoke(of, report); }
	};
	// The last one that the points have taken over.
	template <class F> struct Reached {
		F                       of;
		template <class T> void begin(T&) const { }
		template <class T> void take(T& number, const gimpm::StepReport& report) const
		{
			if (report.converged() || report.accepted) number = std::invoke(of, report);
		}
	};
	// All that were tried in the run.
	template <class F> struct Sum {
		F                       of;
		template <class T> void begin(T& number) const { number = 0; }
		template <class T> void take(T& number, const gimpm::StepReport& report) const { number += std::invoke(of, report); }
	};
	// The engine, which counts in the run.
	struct Counted {
		template <class T> void begin(T& number) const { number = 0; }
		template <class T> void take(T&, const gimpm::StepReport&) const { }
	};
	// The engine, which keeps it from run to run.
	struct Kept {
		template <class T> void begin(T&) const { }
		template <class T> void take(T&, const gimpm::StepReport&) const { }
	};
	template <class F> Latest<F>  latest(F of) { return { of }; }
	template <class F> Reached<F> reached(F of) { return { of }; }
	template <class F> Sum<F>     sum(F of) { return { of }; }
}

struct RunResults {
	bool             converged  = false;
	int              iterations = 0;
	Real             residual   = std::numeric_limits<Real>::quiet_NaN();
	vector<Real>     residuals;
	Real             loadFactor  = 0;
	int              activeCells = 0, boundaryCells = 0, ghostFaces = 0, dofs = 0, clampedDomains = 0;
	int              substeps = 0, cuts = 0, lineSearchTrials = 0, reusedFactors = 0, luSolves = 0, cgIterations = 0, cgFallbacks = 0, amgSetups = 0;
	vector<Real>     lastDisplacements; // displacements of the nodes in the last step, for newton.predictor
	Real             lastLoadIncrement = 0;
	Real             stepPart          = 1;
	vector<Vector3r> reactions;
	Real             wallOverlap  = 0;
	Real             ghostShare   = std::numeric_limits<Real>::quiet_NaN();
	Real             mergedEnergy = 0;

	// Output of a number besides the attribute of its name.
	enum Told { byAttribute, byReport, byReportAndPlot };

	// v(name, member, source, told by, flags, documentation, validator) for each of them. The order is that of
	// saved files.
	template <class V> static void results(V&& v);

	// Not by name, for report(): the last load step that was tried, the number of points, and the times of the run
	// by phase [s].
	gimpm::StepReport      last;
	gimpm::StepReport      lastCut; // the last step that was cut, of any run
	size_t                 pointsOfRun = 0;
	std::map<string, Real> times;

	void begin(size_t points);
	void take(const gimpm::StepReport&, TimingDeltas&);

	// Also for O.timingEnabled.
	void addTime(TimingDeltas&, const char* phase, double seconds);

	// Adds the numbers that are told by this or more.
	void tell(py::dict&, Told) const;
};

template <class V> void RunResults::results(V&& v)
{
	using gimpm::StepReport;
	using R = RunResults;
	using namespace source;
	const AnyValue any;
	const auto     count = atLeast(0);
	v("converged", &R::converged, latest(&StepReport::converged), byReport, readonly, "True if the last step converged.", any);
	v("iterations", &R::iterations, sum(&StepReport::iterations), byReportAndPlot, readonly,
	  "Linear solves of the last run, those of steps that were undone included.", count);
	v("residual", &R::residual, latest(&StepReport::residual), byReportAndPlot, readonly,
	  "Last out-of-balance force over external forces and reactions [-].", any);
	v("residuals", &R::residuals, latest(&StepReport::residuals), byReport, readonly,
	  "The same [-] before the first solve of the last step and after each.", any);
	v("loadFactor", &R::loadFactor, Kept(), byReportAndPlot, readonly, "Load factor [-] of the last converged state.", finite);
	v("activeCells", &R::activeCells, latest(&StepReport::populatedCells), byReport, readonly, "Cells with material in the last step.", count);
	v("boundaryCells", &R::boundaryCells, latest(&StepReport::boundaryCells), byReport, readonly,
	  "Those of them with an empty neighbour (0 without stabilisation).", count);
	v("ghostFaces", &R::ghostFaces, latest(&StepReport::ghostFaces), byReport, readonly, "Faces stabilised in the last step.", count);
	v("dofs", &R::dofs, latest(&StepReport::dofs), byReport, readonly, "Free degrees of freedom of the last step.", count);
	v("substeps", &R::substeps, Counted(), byReport, readonly, "Load steps that converged in the last run: 1 unless steps were cut.", count);
	v("cuts", &R::cuts, Counted(), byReportAndPlot, readonly, "Load steps of the last run that were undone and tried again with half the increment.",
	  count);
	v("lineSearchTrials", &R::lineSearchTrials, sum(&StepReport::lineSearchTrials), byReport, readonly,
	  "Shortened Newton steps that were tried in the last run.", count);
	v("reusedFactors", &R::reusedFactors, sum(&StepReport::reusedFactors), byReport, readonly,
	  "Solves of the last run with the factor of the solve before.", count);
	v("luSolves", &R::luSolves, sum(&StepReport::luSolves), byReport, readonly,
	  "Solves of the last run by LU: the stiffness matrix was not positive definite, or not symmetric.", count);
	v("cgIterations", &R::cgIterations, sum([](const StepReport& r) { return r.conjugateGradients.iterations; }), byReport, readonly,
	  "Iterations of conjugate gradients, or GMRES where the matrix is not symmetric, in the last run (see MpmNewton.linearSolver).", count);
	v("cgFallbacks", &R::cgFallbacks, sum([](const StepReport& r) { return r.conjugateGradients.fallbacks; }), byReport, readonly,
	  "Solves of the last run that the iterative solver left to the direct one.", count);
	v("lastDisplacements", &R::lastDisplacements, Kept(), byAttribute, hidden, "",
	  admitting("of each node three grid coordinates and three components of its displacement [m], all finite", isIncrement));
	v("lastLoadIncrement", &R::lastLoadIncrement, Kept(), byAttribute, hidden, "", finite);
	v("stepPart", &R::stepPart, Kept(), byReport, readonly, "Part of O.dt [-] that the next load step tries, > 0 and <= 1.", part);
	v("reactions", &R::reactions, reached(&StepReport::reactions), byAttribute, readonly,
	  "Sum of the forces [N] of each of *boundaries* on the body at the end of the last converged step; per metre of thickness in plane "
	  "strain.",
	  admitting("forces of finite numbers [N]", [](const auto& forces) { return std::all_of(forces.begin(), forces.end(), finite); }));
	v("clampedDomains", &R::clampedDomains, latest(&StepReport::clampedDomains), byReport, readonly,
	  "Points whose domain was kept at half a cell at the end of the last step.", count);
	v("amgSetups", &R::amgSetups, sum([](const StepReport& r) { return r.conjugateGradients.hierarchies; }), byReport, readonly,
	  "Number of times that algebraic multigrid was set up in the last run (see MpmNewton.linearSolver).", count);
	v("wallOverlap", &R::wallOverlap, latest(&StepReport::largestWallOverlap), byReport, readonly,
	  "Largest length [m] by which a domain reached behind a wall in the last step; nodes there count as constrained.", nonNegative);
	v("ghostShare", &R::ghostShare, reached(&StepReport::ghostShare), byReportAndPlot, readonly,
	  "Part [-] of the work at the edge of the body in the last static step that the ghost stabilisation took up; NaN with inertia or *flow*.", any);
	v("mergedEnergy", &R::mergedEnergy, Kept(), byReportAndPlot, readonly,
	  "Elastic and kinetic energy [J] that halves of points have lost so far as they became one again (MpmAdaptation.merge).", any);
}

} // namespace yade
