# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of an analysis, and settings that it could do without."""
import math

import numpy as np
from yade import wrapper

from ..base.solver import noPoints, solverOf
from ..earthquake.damping import adviceOnMotion
from ..library import engine as _engine
from ..points.data import parameter, pointsOf

# Cost of a load step in solves, elastic and elasto-plastic: small, usual, large (examples/trade). Plastic steps need 2
# to 6 solves as a rule, but also residuals without a solve, and cost more than the one that is measured, because points
# yield and the body spreads over more cells.
_solves = {False: (2, 4, 20), True: (4, 8, 15)}
# Memory that a step needs on top of the bodies, fitted to examples/trade/estimates.py: a part for YADE's threads and
# libraries, one for each point, and four times the bytes of the matrices' entries, which stand for the working space of
# ordering and factorisation too.
_bytes, _bytesOfPoint = 6e5, {2: 1150, 3: 1600}
_bytesOfEntry = {'blockEntries': 32, 'matrixEntries': 96, 'factorEntries': 44}
# Dilation over friction up to which flow counts as keeping the volume. Without F-bar a strip footing, 8 cells wide, on
# weightless soil (friction 35 degrees, cohesion 10 kPa, pressed by a twenty-fifth of its width) bears 35 % more where
# the soil does not dilate, 29 % for 3 degrees, 25 % for a quarter of the friction, 19 % for half of it, 13 % for three
# quarters.
_littleDilation = 0.5
_saidBelow = 'locking', 'firstDoubt'  # subjects of warnings of the first step: fBar, and motions of a base
_manyIterations = 250  # conjugate gradients to 1e-3: as long as multigrid takes with being set up
_bytesOfOutput = 560  # bytes of a point in an MpmVtkRecorder's files


def advise(solver=None):
	"""Print what the analysis will cost and what it could do without; nothing is run, and the scene is left alone.

	The number of unknowns is exact. The parts of one load step are done three times, without load, to see how long they take on this machine: so the
	call takes about as long as a step. How many solves a step will need is not known before; what is printed are the usual number and the range that the
	scenes of ``examples/trade`` needed. Bodies that bend by large angles, and soil that fails, are at its upper end. Memory is on top of the bodies.

	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:return: dict of ``points``, ``dofs`` (unknowns), ``steps`` (load steps that are left), ``memory`` [bytes], ``secondsPerStep`` and its range
		``fastest``, ``slowest``, and ``advice``, a list of the sentences that were printed
	:raises TypeError: *solver* is no MpmImplicitEngine.
	:raises ValueError: none or several of them among O.engines, no material points, or a value that a load step would refuse.
	"""
	solver = solverOf('advise', solver)
	scene = _Scene(solver)
	few, usual, many = _solves[scene.plastic]
	work = scene.work
	seconds = {name: work['secondsPerStep'] + n * work['secondsPerSolve'] for name, n in (('fastest', few), ('secondsPerStep', usual), ('slowest', many))}
	memory = _bytes + scene.points * _bytesOfPoint[scene.dim] + sum(size * work[name] for name, size in _bytesOfEntry.items())
	found = dict(points=scene.points, dofs=work['dofs'], steps=scene.steps, memory=memory, advice=_notNeeded(scene) + _next(scene), **seconds)
	law = 'elasto-plastic' if scene.plastic else 'elastic'
	print(f"{'axisymmetric' if solver.grid.axisymmetric else f'{scene.dim}D'}, {law}, {scene.points} points in {work['activeCells']} cells, {scene.pointsPerCell:.3g} a cell and axis")
	print(f"unknowns: {work['dofs']}; memory: about {memory / 2**20:.0f} MiB on top of the bodies")
	print(
	        f"a load step: about {_time(seconds['secondsPerStep'])} ({_time(seconds['fastest'])} to {_time(seconds['slowest'])}), of which "
	        f"{_time(work['secondsPerSolve'])} a solve; {scene.steps} steps to the end of the load curve: about {_time(scene.steps * seconds['secondsPerStep'])}"
	)
	for sentence in found['advice']:
		print('- ' + sentence)
	return found


class _Scene:
	"""Data of the scene that advice depends on."""

	def __init__(self, solver):
		self.solver, self.work = solver, solver.workload()
		self.dim, self.h = solver.grid.dim, solver.grid.cellSize
		data, self.materials, number = pointsOf(solver)
		self.own = lambda name, material: parameter(name, material, data, number == self.materials.index(material))
		self.points = self.work['points']
		if self.points == 0: raise ValueError(noPoints('advise', solver))
		self.velocity = data['velocity']
		self.low, self.high = data['pos'].min(axis=0) - data['halfSize'].min(axis=0), data['pos'].max(axis=0) + data['halfSize'].min(axis=0)
		self.pointsPerCell = (self.points / self.work['activeCells'])**(1 / self.dim)
		self.plastic = not all(_engine.isElastic(material) for material in self.materials)
		self.left = max(0, solver.loadsEnd() - wrapper.Omega().time)
		self.steps = self.runsOf(solver)
		self.recorders = [e for e in wrapper.Omega().engines if isinstance(e, wrapper.MpmVtkRecorder) and not e.dead and e.solver in ('', solver.label)]

	def runsOf(self, engine):
		"""Number of runs of a PeriodicEngine until the loads have come to rest; 0 if that is not known."""
		periods = [period for period in (engine.iterPeriod * wrapper.Omega().dt, engine.virtPeriod) if period > 0]
		runs = self.left / min(periods) if periods else 0
		return math.ceil(runs - 1e-6) if math.isfinite(runs) else runs

	def cellsAStep(self):
		"""Cells a step of the fastest wave, and of the fastest point as it moves and falls, in a MpmDynamicEngine."""
		solver, scene = self.solver, wrapper.Omega()
		step = scene.dt * max(1, solver.iterPeriod)
		flown = step * self.velocity + step**2 / 2 * np.array(solver.gravity)
		return step * solver.waveSpeed() / self.h, np.linalg.norm(flown, axis=1).max() / self.h

	def neverYield(self):
		"""Labels of materials that the weight of all that could lie above cannot bring to yield."""
		extent = max(self.high[:self.dim] - self.low[:self.dim])
		stress = max(material.density for material in self.materials) * np.linalg.norm(self.solver.gravity) * extent
		return [m.label or 'a material without label' for m in self.materials if stress > 0 and self.difference(m) > stress]

	def difference(self, material):
		"""A difference of principal stresses at which it does not yield yet; 0 of elastic materials and of those whose strength goes with the pressure."""
		if hasattr(material, 'yieldStress'): return np.min(self.own('yieldStress', material))
		return 2 * np.min(self.own('undrainedStrength', material)) if hasattr(material, 'undrainedStrength') else 0

	def keepVolume(self):
		"""Labels of materials that keep their volume, nearly, as a whole or in plastic flow."""

		def keeps(material):
			if material.undrained or hasattr(material, 'yieldStress') or hasattr(material, 'undrainedStrength') or getattr(material, 'poisson', 0) > 0.45: return True
			if not hasattr(material, 'frictionAngle'): return False
			return np.any(self.own('dilationAngle', material) <= _littleDilation * self.own('frictionAngle', material))

		return [m.label or 'a material without label' for m in self.materials if keeps(m)]

	def contrast(self):
		own = [self.own('young', material) for material in self.materials if hasattr(material, 'young')] # the modulus of the others varies
		return max(map(np.max, own)) / min(map(np.min, own)) if own else 1

	def uniformAlongZ(self):
		"""Both ends constrained along z, and nothing acts along it: plane strain."""
		tolerance = 1e-6 * self.h
		ends = [any('z' in b.fix and not b.surface and b.min[2] <= z + tolerance and b.max[2] >= z - tolerance for b in self.solver.boundaries) for z in (self.low[2], self.high[2])]
		return all(ends) and self.solver.gravity[2] == 0 and not self.solver.contacts and not any(load._actsAlong(2) for load in self.solver.loads)


def _notNeeded(scene):
	"""Features that the scene uses and does not need, or lacks; numbers are those of examples/trade and examples/extremes."""
	solver, found = scene.solver, [f'settings: {sentence}' for about, sentence in scene.solver._doubts().items() if about not in _saidBelow]
	if scene.dim == 3 and scene.uniformAlongZ():
		found.append('dim: both ends are constrained along z, where gravity has no part. If the section is the same all along, dim=2 (plane strain) will do.')
	if solver.iterPeriod == 1 and scene.steps > 1e6:
		found.append(f'O.dt: {scene.steps:.3g} steps are more than an analysis may have (1e6); was O.dt forgotten? It is the load time of one step.')
	if isinstance(solver, wrapper.MpmDynamicEngine): found += [_stepInTime(scene)] + adviceOnMotion(solver)
	strong = scene.neverYield()
	if strong: found.append(f'plasticity: the weight cannot bring {strong} to yield; unless other loads do, MpmElasticMat does the same.')
	locking = scene.keepVolume()
	if locking and not solver.fBar:
		found.append(
		        f'fBar: {locking} can keep their volume, and then lock. fBar=True takes limit loads of clay from 9 % too much (strip footing, 17 cells) to -1 %, of a square '
		        'footing from 15 to -7 %, and tips of nearly incompressible beams from half or less to 98 %. On sand (35 degrees, 8 cells) a footing bears 26 % less with it where psi = 0, 22 % for '
		        '3 degrees, 16 % for half of phi. '
		        f"Runs with as many iterations take {'5 %' if scene.dim == 3 else '17 to 25 %'} longer; mechanisms that locking hid take more of them."
		)
	contrast = scene.contrast()
	if contrast >= 10:
		found.append(
		        f'layers: moduli differ by a factor of {contrast:.3g}. Where such layers move through the grid, stresses beside their boundary are off, by 24 % '
		        'for a factor of 10, 76 % for 100.'
		)
	for i, boundary in enumerate(solver.boundaries):
		cells = max(abs(factor) for _, factor in boundary.curve or solver.loadCurve) * max(map(abs, boundary.displacement)) / scene.h
		if cells > 0.5:
			found.append(
			        f'boundaries[{i}]: it moves by {cells:.3g} cells, but its nodes stay where they are: soil that they push away from its surface follows for half a '
			        'cell, then the step ends. Recipes in examples/README.md push deeper.'
			)
	if solver.ghost.factor == 0: found.append('stabilisation: it is off; one point that leaves its row can make a step fail. MpmGhost() costs next to nothing.')
	if solver.ghost.factor > 1: found.append(f'stabilisation: factor={solver.ghost.factor:g} stiffens the edge of the body; 1e-2 is enough.')
	if solver.basis == 'mpm': found.append("basis: 'mpm' has had up to 50 times the error of 'gimp', and saves at best half of the time.")
	if solver.newton.tolerance < 1e-6: found.append(f'tolerance: {solver.newton.tolerance:g} has given the same results as 1e-4 in all our measurements.')
	if solver.newton.tolerance > 1e-3: found.append('tolerance: 1e-1 has changed displacements by up to 45 %, 1e-2 by 1 %, 1e-3 by 0.1 %.')
	found += _multigrid(scene)
	output = sum(_bytesOfOutput * scene.points * min(scene.steps, scene.runsOf(recorder)) for recorder in scene.recorders)
	if output > 2**30: found.append(f'output: the recorders will write about {output / 2**30:.0f} GiB; a larger iterPeriod writes less.')
	return found


def _stepInTime(scene):
	"""Distance that waves and points go in a step, and a better step."""
	solver, ofWave, ofPoint = scene.solver, *scene.cellsAStep()
	text = f'O.dt: in a step the fastest wave goes {ofWave:.3g} cells and the fastest point {ofPoint:.3g}; '
	if solver.scheme == 'explicit': return text + f'scheme=\'explicit\' admits {solver.criticalTimeStep():.3g} s, of which 0.9 are safe.'
	if ofPoint > 0.5: return text + 'that is too far for points, which should move less than half a cell: a smaller O.dt.'
	if ofWave > 0.5: return text + 'waves of some cells are averaged over: for them half a cell a step or less, for slower motion some cells are right.'
	return text + 'that is short enough for waves of some cells; a longer step is cheaper for slower motion.'


def _multigrid(scene):
	"""Advice to use algebraic multigrid where conjugate gradients should have it, and do not."""
	iterations, method = scene.work['iterations'], scene.solver.newton.linearSolver
	if iterations <= _manyIterations or method == 'amg': return []
	text = f'linearSolver: conjugate gradients take {iterations} iterations to 1e-3 here; with algebraic multigrid they would take a tenth of that or less. '
	if _engine.multigridAbsence(): return [text + 'It needs PETSc, which scripts/setup --with-petsc installs, or the package yade-mpm-petsc.']
	return [text + "'auto' takes it when it is needed."] if method == 'iterative' else []


def _next(scene):
	"""Next cheaper and next more accurate setting, by what they gave in examples/trade."""
	cheaper, better = [], []
	if scene.pointsPerCell > 2.6: cheaper.append('pointsPerCell=2: four fifths of the time at about the same error')
	solver = scene.solver
	chosen = solver.newton.stepTolerance > 0
	if scene.steps > 20 and not chosen: cheaper.append(_fewerSteps(scene))
	if scene.steps > 20 and not scene.plastic and scene.work['factorFlops'] > 0 and solver.newton.keepFactor == 0:
		cheaper.append('newton.keepFactor=3: steps that change little go without a factorisation')
	cheaper.append(f"cellSize={2 * scene.h:g}: {'a fourth to a fifth' if scene.dim == 2 else 'a tenth'} of the time, about twice the error")
	if scene.pointsPerCell < 1.5: better.append('pointsPerCell=2: half of the error')
	better.append(f"cellSize={scene.h / 2:g}: half of the error for {'4 to 6' if scene.dim == 2 else '10 or more'} times the time")
	if 0 < scene.steps < 10 and not chosen: better.append('O.dt a fourth of this: 0.6 times the error in an elastic column, for twice the time')
	ofStresses = 'mpm.stressError() tells of the stresses when it has run; ' if not (solver.grid.refinements or solver.grid.adaptation) else ''
	wrong = (
	        f"how wrong it will be: {ofStresses}mpm.discretisationError(run, cellSize={scene.h:g}){' tells' if not ofStresses else ''} of any result, for "
	        f"{'5 to 8' if scene.dim == 2 else '10 or more'} times the time"
	)
	return [f'next cheaper: {cheaper[0]}.', f'next more accurate: {better[0]}.'] + [f'also: {text}.' for text in cheaper[1:] + better[1:]] + [wrong + '.']


def _fewerSteps(scene):
	solver = scene.solver
	period = 'virtPeriod' if solver.virtPeriod > 0 else 'O.dt' if solver.iterPeriod == 1 else 'iterPeriod'
	if scene.steps <= 160:
		return (
		        f'{period} four times as large: {math.ceil(scene.steps / 4)} steps instead of {scene.steps}, less than half of the time; a fourth of 40 steps '
		        'changed displacements of the slope by less than 1 %'
		)
	return f'{period} {scene.steps / 160:.2g} times as large: 160 steps instead of {scene.steps:.7g}, as many as the most accurate runs of examples/trade took'


def _time(seconds):
	if seconds < 0.995: return f'{float(f"{seconds * 1e3:.2g}"):g} ms'
	if seconds < 120: return f'{float(f"{seconds:.2g}"):g} s'
	return f'{seconds / 60:.0f} min' if seconds < 7200 else f'{seconds / 3600:.1f} h'
