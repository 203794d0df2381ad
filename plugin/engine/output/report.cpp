// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/report.hpp"
#include "core/grid/coverage.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/analysis/cells_by_size.hpp"
#include "engine/analysis/kept_columns.hpp"
#include "engine/messages/failures.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/parallel.hpp"
#include "yade_api/value_lock.hpp"

namespace yade {

namespace {
	// A key of the report and what it says. Without a value it is one of RunResults, which has an attribute of its
	// own, and there is more to say of it than there.
	struct Row {
		const char* key;
		const char* meaning;
		py::object (*value)(const Analysis&, const gimpm::Coverage&);
	};

	py::dict secondsByPhase(const Analysis& engine)
	{
		py::dict seconds;
		for (const auto& [phase, time] : engine.times)
			seconds[phase] = time;
		return seconds;
	}

	template <int Dim> gimpm::Coverage coverageIn(const Analysis& engine)
	{
		const auto&                  points = engine.pointsOfLastRun();
		const auto*                  kept   = engine.keptColumns().cloud<Dim>(); // in memory one after the other
		const gimpm::Vec<Dim>        origin = engine.grid->origin.template head<Dim>();
		std::vector<gimpm::Vec<Dim>> centres(points.size()), halfLengths(points.size());
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end; ++p) {
				const gimpm::Vec<Dim> x    = kept ? kept->position[p] : gimpm::Vec<Dim>(points[p].state->pos.template head<Dim>());
				const gimpm::Vec<Dim> half = kept ? kept->halfSize[p] : gimpm::Vec<Dim>(points[p].shape->halfSize.template head<Dim>());
				centres[p]                 = (x - origin) / engine.grid->cellSize;
				halfLengths[p]             = half / engine.grid->cellSize;
			}
		});
		return gimpm::coverage<Dim>(centres, halfLengths);
	}

	py::object numbersOfCells(const Analysis& engine, const gimpm::Coverage& coverage)
	{
		py::dict cells;
		if (engine.grid->refinements.empty() && engine.grid->adapted.empty()) {
			cells[engine.grid->cellSize] = coverage.populated;
			return cells;
		}
		for (const auto& [size, number] : cellsBySize(*engine.grid, engine.pointsOfLastRun()))
			cells[size] = number;
		return cells;
	}

	string axisOf(const Analysis& engine) { return engine.last.worst.axis < 0 ? string() : string(1, "xyz"[engine.last.worst.axis]); }

	using E          = const Analysis&;
	using C          = gimpm::Coverage;
	const Row rows[] = {
		{ "accepted", "True if a step that has not converged was taken over (see MpmNewton.acceptUnconverged).",
		  [](E e, const C&) { return py::object(e.last.accepted); } },
		{ "failure",
		  "'none', 'detached' (a boundary that is to move constrains no soil), 'misplaced' (a load, wall or rigid body), 'unrestrained', 'slides' "
		  "(friction at its limit does not support it), 'penetrated' (by a rigid body), 'refused' (by a condition that does not admit the equilibrium), "
		  "'inaccurate' (MpmDynamicEngine.timeTolerance; beyond newton.stepTolerance steps are cut), 'gainsEnergy' (a time step with spurious energy gain), 'stabilised' (MpmGhost.workTolerance), "
		  "'singular', 'inverted', 'notFinite', 'diverging', 'tooManyIterations', 'stalled' (at round-off), 'apart' (processes in different states) or "
		  "'interrupted'.",
		  [](E e, const C&) { return py::object(nameOf(e.last.failure)); } },
		{ "cause", "The reason, a clause, empty when converged.", [](E e, const C&) { return py::object(e.last.cause); } },
		{ "cutFailure",
		  "Kind of failure for which the last step that was cut was cut, as *failure*, also of an earlier run; 'none' if none was. *stepPart* is what it left.",
		  [](E e, const C&) { return py::object(nameOf(e.lastCut.failure)); } },
		{ "cutCause", "Its reason, a clause, empty if no step was cut.", [](E e, const C&) { return py::object(e.lastCut.cause); } },
		{ "loadTime", "Of the last converged state [s].", [](E e, const C&) { return py::object(e.loadTime); } },
		{ "times",
		  "Of the run by phase [s], a dict: 'check' (of points that are new or were changed), 'gather', 'agree' (several processes, on the points), 'basis', "
		  "'ghost', 'assembly', 'analyse', 'factorise', 'solve', 'update', 'scatter'.",
		  [](E e, const C&) { return py::object(secondsByPhase(e)); } },
		{ "points", "Material points in the run.", [](E e, const C&) { return py::object(e.pointsOfRun); } },
		{ "cells", "Cells in which middles of points lie, by edge length [m], a dict. Of the points of this process.", numbersOfCells },
		{ "nodes", "Grid nodes of the last load step that was tried.", [](E e, const C&) { return py::object(e.last.nodes); } },
		{ "cgFailure", "Why an iterative solve of it was left to the direct solver, or multigrid was not set up; empty if neither was so.",
		  [](E e, const C&) { return py::object(e.last.conjugateGradients.reason); } },
		{ "localResidual",
		  "The largest residual around a node over the forces there, or a bound of it [-], at most 3 newton.tolerance when converged (NaN where it was not "
		  "asked for).",
		  [](E e, const C&) { return py::object(e.last.localResidual); } },
		{ "localError",
		  "The estimated error of the displacements over newton.stepTolerance or timeTolerance [-], 0 where neither is given, or nothing is known of it or "
		  "asked, as in steps of newton.minStep.",
		  [](E e, const C&) { return py::object(e.last.localError); } },
		{ "stiffness",
		  "Kind of the last matrix that was factorised: 'positive definite', 'indefinite' (the equilibrium may not be stable: the body may go on by itself, or have "
		  "another state under the same load) or 'not checked' (it is not symmetric, or none was factorised: an iterative solver, or nothing to solve).",
		  [](E e, const C&) { return py::object(nameOf(e.last.definiteness)); } },
		{ "worstNode", "Position [m] of the largest out-of-balance force, NaN if there is none.",
		  [](E e, const C&) { return py::object(Vector3r(e.last.worst.position)); } },
		{ "worstAxis", "Its direction, 'x', 'y', 'z' or ''.", [](E e, const C&) { return py::object(axisOf(e)); } },
		{ "worstForce", "Its size [N].", [](E e, const C&) { return py::object(e.last.worst.force); } },
		{ "mixedCells",
		  "Cells populated by points of different materials: each point keeps its own law, so the cell's stiffness is the sum, and the interface is resolved to "
		  "one cell.",
		  [](E e, const C&) { return py::object(e.last.mixedCells); } },
		{ "islands",
		  "Parts of the body that share no grid node, 1 for a body in one piece (0 if the step was refused before they were counted): the body may break up as "
		  "long as every part is constrained against rigid motion; a part that is not ends the run as 'unrestrained', with its position, since no equilibrium determines "
		  "where it goes.",
		  [](E e, const C&) { return py::object(e.last.parts); } },
		{ "loosePoints",
		  "Points in parts of the body that a static step has constrained where they are: fewer than a cell has nodes, apart from the rest or connected to it by a corner or an edge of a cell, "
		  "and nothing restrains them. "
		  "Of MpmDynamicEngine see there.",
		  [](E e, const C&) { return py::object(e.last.loosePoints); } },
		{ "looseForce", "The force with which they are constrained, in all [N]; by a node that they share with the rest they may weigh on that, too.",
		  [](E e, const C&) { return py::object(Vector3r(e.last.looseForce)); } },
		{ "clampedDomains",
		  "Points whose domain would outgrow half a cell in the last step: it is kept at half a cell, the rest of the point's volume acts within it (see "
		  "maxSplits).",
		  nullptr },
		{ "domainMismatch",
		  "Mean difference of the covered part of a cell from 1 [-], over the cells within the soil: 0 where the domains of points tile. Beyond 0.05, as after long shear obliquely to the "
		  "grid, soil is too weak there by up to that part: smaller cells, or maxSplits, help. Of the points of this process.",
		  [](E, const C& coverage) { return py::object(coverage.mean); } },
		{ "wallOverlap",
		  "The largest length [m] by which a domain reached behind a wall in the last step: no cell is populated there, and the point's share in nodes behind "
		  "the wall counts as constrained.",
		  nullptr },
	};

	string docstring()
	{
		string text
		        = "report() -> dict\n\nHow the last run of this engine in this process went; empty before the first. What is counted has undone tries in it.\n\n";
		const auto line = [&](const string& key, const string& meaning) { text += "- *" + key + "*: " + meaning + "\n"; };
		const auto hasRow
		        = [](const string& key) { return std::any_of(std::begin(rows), std::end(rows), [&](const Row& row) { return row.key == key; }); };
		for (const Row& row : rows)
			line(row.key, row.meaning);
		RunResults::results([&](const char* key, auto, const auto&, RunResults::Told told, int, const char* meaning, auto&&...) {
			if (told >= RunResults::byReport && !hasRow(key)) line(key, meaning);
		});
		return text + "\nThat of MpmDynamicEngine also has what its plotData() tells of motion and energies.";
	}
}

py::dict report(const Analysis& engine)
{
	const ValueLock lock;
	py::dict        result;
	if (engine.times.empty()) return result;
	engine.tell(result, RunResults::byReport);
	const auto coverage = engine.grid->dim == 2 ? coverageIn<2>(engine) : coverageIn<3>(engine);
	for (const Row& row : rows)
		if (row.value) result[row.key] = row.value(engine, coverage);
	engine.tellMotion(result);
	return result;
}

void addReport(py::object pythonClass, const py::object& function) { py::objects::add_to_namespace(pythonClass, "report", function, docstring().c_str()); }

} // namespace yade
