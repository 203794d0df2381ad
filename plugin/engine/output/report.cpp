// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/report.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/messages/failures.hpp"
#include "yade_api/value_lock.hpp"

namespace yade {

py::dict report(const Analysis& engine)
{
	const ValueLock lock;
	py::dict        result;
	if (engine.times.empty()) return result;
	const gimpm::StepReport& last = engine.last;
	engine.tell(result, RunResults::byReport);
	result["loadTime"]      = engine.loadTime;
	result["accepted"]      = last.accepted;
	result["failure"]       = nameOf(last.failure);
	result["cause"]         = last.cause;
	result["cgFailure"]     = last.conjugateGradients.reason;
	result["localResidual"] = last.localResidual;
	result["localError"]    = last.localError;
	result["stiffness"]     = nameOf(last.definiteness);
	result["worstNode"]     = Vector3r(last.worst.position);
	result["worstAxis"]     = last.worst.axis < 0 ? string() : string(1, "xyz"[last.worst.axis]);
	result["worstForce"]    = last.worst.force;
	result["points"]        = engine.pointsOfRun;
	result["nodes"]         = last.nodes;
	result["mixedCells"]    = last.mixedCells;
	result["islands"]       = last.parts;
	py::dict seconds;
	for (const auto& [phase, time] : engine.times)
		seconds[phase] = time;
	result["times"] = seconds;
	engine.tellMotion(result);
	return result;
}

void addReport(py::object pythonClass, const py::object& function)
{
	py::objects::add_to_namespace(
	        pythonClass, "report", function,
	        "report() -> dict\n\nHow the last run of this engine in this process went; empty before the first.\n\n"
	        "Outcome: 'converged'; 'accepted' (see MpmNewton.acceptUnconverged); 'failure', one of 'none', 'detached' (a boundary that is to move has no hold of the soil), 'misplaced' (a load, wall or rigid body), 'unrestrained', 'slides' (friction at its limit does not hold it), 'penetrated' (by a rigid body), 'refused' (by a condition that does not admit the equilibrium), 'inaccurate' (MpmDynamicEngine.timeTolerance; beyond newton.stepTolerance steps are cut), 'gainsEnergy' (a step in time makes energy of nothing), 'singular', 'inverted', "
	        "'notFinite', 'diverging', 'tooManyIterations', 'stalled' (at round-off), 'apart' (processes in different states), 'interrupted'; 'cause', a clause, empty when converged; 'loadTime' [s] and 'loadFactor' of the "
	        "last converged state; 'stepPart', part of O.dt that the next step tries.\n\n"
	        "Effort of the run, undone tries included: 'iterations' (linear solves), 'substeps', 'cuts', 'lineSearchTrials', 'reusedFactors', 'luSolves', 'cgIterations', 'cgFallbacks', 'amgSetups'; 'times' [s], dict "
	        "by phase: 'check' (of points that are new or were changed), 'gather', 'agree' (several processes, on the points), 'basis', 'ghost', 'assembly', 'analyse', 'factorise', 'solve', 'update', 'scatter'.\n\n"
	        "Of the last load step that was tried: 'cgFailure', why an iterative solve was left to the direct solver, or multigrid was not set up, empty if neither was so; 'residuals', list; 'residual', the last of them [-]; 'localResidual', the largest residual around a node "
	        "over the forces there, or a bound of it [-], at most 3 newton.tolerance when converged (NaN where it was not asked for); 'localError', the estimated error of the displacements over newton.stepTolerance or timeTolerance [-], 0 where neither is given, or nothing is known of it or asked, as in steps of newton.minStep; 'stiffness' of the last "
	        "matrix that was factorised, 'positive definite', 'indefinite' (the equilibrium may not be stable: the body may go on by itself, or have another "
	        "state under the same load) or 'not checked' (it is not symmetric, or none was factorised: an iterative solver, or nothing to solve); 'worstNode' (position [m], NaN if none), "
	        "'worstAxis' ('x', 'y', 'z' or '') and 'worstForce' [N] of the largest out-of-balance force; 'points', 'nodes', 'dofs', 'activeCells', "
	        "'boundaryCells', 'ghostFaces'.\n\n"
	        "What deserves a look there, with the rule for it: 'clampedDomains', points whose domain would outgrow half a cell: it is kept at half a cell, "
	        "the rest of the point's volume acts within it (see maxSplits). 'wallOverlap' [m], the largest length by which a domain reached behind a wall: no cell is "
	        "populated there, and the point's share in nodes behind the wall counts as held. 'mixedCells', cells populated by points of different materials: each point "
	        "keeps its own law, so the cell's stiffness is the sum, and the interface is resolved to one cell. 'islands', parts of the body that share "
	        "no grid node, 1 for a body in one piece (0 if the step was refused before they were counted): the body may break up as long as every part is held against rigid motion; a part that is not "
	        "ends the run as 'unrestrained', with its place, since no equilibrium determines where it goes.");
}

} // namespace yade
