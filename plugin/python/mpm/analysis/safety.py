# SPDX-License-Identifier: GPL-2.0-or-later
"""Factor of safety by strength reduction."""
import math

import numpy as np

from ..base.messages import brief, isNumber
from ..base.solver import noPoints, solverOf
from ..points.data import pointsOf
from .slips import leastPlaneSlip

_mostBeyondSlip = 1.1  # factor of safety over that of a plane slip [-], by which cells may be too strong
_criterion = 'no equilibrium, or displacements of more than 3 times the largest elastic strain times the smallest extent of the body'


def strengthReduction(solver=None, tolerance=0.01, first=1.0, factor=1.25):
	"""Look for the factor of safety of the current state by reducing the strength, and print it as a bracket.

	Strengths are divided by a factor F: c' = c / F, tan(phi') = tan(phi) / F, tan(psi') = min(tan(psi), tan(phi')), with tensile strengths as c; undrained strength and
	yield stress likewise (Zienkiewicz et al. 1975; Griffiths and Lane 1999). Points with strengths of their own have those divided. Loads stay as they are at O.time. For each F the
	reduction starts anew from the current state, which must be in equilibrium, as after gravity has acted in full. Points do not move: moduli are scaled up until
	strains are tiny, which changes neither stresses nor what they can carry, and displacements are scaled back. F counts as failed when that finds no equilibrium, though a part of the
	reduction that does not converge is cut down to ``newton.minStep``; or when the body flows: displacements since F = 1 of more than three times the largest elastic strain times the smallest
	extent of the body. Ghost stabilisation, which would support what flows, acts with a hundredth of its factor. F first grows or falls from *first* by *factor*, then the bracket is halved.

	Water that flows (``solver.flow``) keeps the pressures which it has at the moment.

	The result depends on the mesh: it falls with the cells, without a limit where psi is less than phi. So the cell size is part of it. ``fBar=True`` of the engine takes
	away what locking adds.

	Of a dry slope of Mohr-Coulomb or Tresca soil in plane strain that only its weight loads, F is compared with plane slips (Culmann 1875; with c = 0 the infinite slope): cells that carry
	more than 1.1 times the least of them are refused.

	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:param tolerance: width of the bracket [-] over its lower end, > 0 and < 1
	:param first: the factor that is tried first, > 0
	:param factor: > 1, by which it then grows or falls until the bracket is found
	:return: dict of ``lower`` (the largest F that was carried), ``upper`` (the smallest that was not), ``cellSize`` [m], ``criterion``, ``trials`` (a list of dicts with ``F``,
		``carries``, ``iterations``, ``parts``, ``displacement``: the largest one [m], and ``cause``), and of the last state on the way to ``upper``, the slip, small or not:
		``displacement`` (N, 3) [m] and ``plasticStrain`` (N,), what is added to those of the current state, in order of body id. ``mpm.plot(found['plasticStrain'])`` draws it.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a value that is not admitted; materials without a strength that could be divided (elastic ones alone, Cam clay); a state that is not in equilibrium or
		so strong or weak that no bracket is found; cells that carry more than plane slips let stand; or what a load step would refuse.
	"""
	solver = solverOf('strengthReduction', solver)
	for name, value, low, high in ('tolerance', tolerance, 0, 1), ('first', first, 0, math.inf), ('factor', factor, 1, math.inf):
		if not isNumber(value): raise TypeError(f'strengthReduction: {name} = {brief(value)} must be a number')
		if not low < value < high: raise ValueError(f'strengthReduction: {name} = {value} is not admitted: expected a number > {low} and < {high}')
	if not len(pointsOf(solver)[0]['id']): raise ValueError(noPoints('strengthReduction', solver))
	search = _Search(solver)
	lower, upper = search.bracket(first, factor)
	while upper - lower > tolerance * lower:
		middle = (lower + upper) / 2
		if search.carries(middle): lower = middle
		else: upper = middle
	_requireCarried(solver, lower)
	found = dict(lower=lower, upper=upper, cellSize=solver.grid.cellSize, criterion=_criterion, trials=search.trials, **search.slip)
	print(f'factor of safety: {lower:.4g} to {upper:.4g}, with cells of {solver.grid.cellSize:g} m; failed: {_criterion}')
	return found


def _requireCarried(solver, lower):
	"""Refuses a factor that a plane slip does not let stand: the cells are too few to slip, and lock or are supported by the stabilisation."""
	points, materials, number = pointsOf(solver)
	slip = leastPlaneSlip(solver, points, materials, number)
	if slip is None or lower <= _mostBeyondSlip * slip[0]: return
	F, foot, angle = slip
	raise ValueError(
	        f'strengthReduction: cells of {solver.grid.cellSize:g} m carry a strength that is divided by {lower:.3g}, but the plane from ({foot[0]:.4g}, {foot[1]:.4g}) upwards at '
	        f'{math.degrees(angle):.3g} degrees slips at {F:.3g} (upper bound by hand; tan(phi) / tan(beta) of an infinite slope without cohesion), so no factor of safety is given. '
	        'Compare with halved cells, fBar=True and ghost=MpmGhost(where=\'aggregates\', memory=1, workTolerance=0.03).'
	)


class _Search:

	def __init__(self, solver):
		self.solver, self.trials, self.slip = solver, [], {}

	def carries(self, F):
		try:
			found = self.solver.weakened(float(F))
		except ValueError as error:
			raise ValueError(f'strengthReduction: {error}') from None
		displacement = found['displacement'].reshape(-1, 3)
		largest = float(np.linalg.norm(displacement, axis=1).max())
		self.trials.append(dict(F=F, displacement=largest, **{name: found[name] for name in ('carries', 'iterations', 'parts', 'cause')}))
		if not found['carries'] and (not self.slip or F <= min(trial['F'] for trial in self.trials if not trial['carries'])):
			self.slip = dict(displacement=displacement, plasticStrain=found['plasticStrain'])
		return found['carries']

	def bracket(self, F, factor):
		"""Two factors, of which the body carries the first."""
		grows = self.carries(F)
		for _ in range(40):
			last, F = F, F * factor if grows else F / factor
			if self.carries(F) != grows: return (last, F) if grows else (F, last)
		extreme = 'it carries its load however weak it is; does a load act?' if grows else (
		        'it does not carry its load however strong it is: is the current state in equilibrium, with the loads of O.time?')
		raise ValueError(f'strengthReduction: no factor of safety between {min(t["F"] for t in self.trials):.3g} and {max(t["F"] for t in self.trials):.3g}: {extreme}')
