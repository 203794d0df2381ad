# SPDX-License-Identifier: GPL-2.0-or-later
"""Factor of safety against time, while loads change or water flows."""
import math

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber
from ..base.solver import solverOf
from .safety import strengthReduction

_late = 1e-9  # part of a step by which a time may be missed


def safetyInTime(times, solver=None, tolerance=0.01, factor=1.25):
	"""Run the scene, look for the factor of safety at given times by :func:`strengthReduction`, and print each.

	Makes load steps of ``O.dt`` until the last of the times, as ``O.step()`` does. Each factor is that of the first step that ends at its time or later; pressures of water that flows, suction and loads
	are those of the moment. The points, the loads and the water do not change by it: the scene is as after the same steps without factors, bit for bit, and goes on from there.

	After a factor below one the remaining steps are made without. A static step that finds no equilibrium ends the run::

		found = mpm.safetyInTime([3600 * hour for hour in range(0, 49, 4)])
		print(found['failureTime'])

	:param times: times [s] that grow, none before ``O.time``
	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:param tolerance: width of each bracket [-] over its lower end, > 0 and < 1
	:param factor: > 1, by which F grows or falls from the last one until the next bracket is found
	:return: dict of arrays ``time`` [s], ``lower``, ``upper`` and ``factor``, the middle of the bracket [-]; ``failureTime``: when the factor is one, between two times, or the last time with equilibrium where the run
		ended, otherwise inf; ``end``: why the run ended before the last time, or an empty text
	:raises TypeError: an argument of the wrong kind, or an MpmDynamicEngine.
	:raises ValueError: an argument that is not admitted, or what :func:`strengthReduction` refuses.
	:raises RuntimeError: another engine of the scene fails.
	"""
	solver, times = solverOf('safetyInTime', solver), _admitted(times)
	if isinstance(solver, wrapper.MpmDynamicEngine):
		raise TypeError('safetyInTime: solver is an MpmDynamicEngine, whose body may move; factors of safety are those of equilibrium: give an MpmImplicitEngine')
	scene, rows, end = wrapper.Omega(), [], ''
	try:
		solver._requireStrength()
	except ValueError as error:
		raise ValueError(f'safetyInTime: {error}') from None
	for time in times:
		end = _advance(scene, solver, time)
		if end: break
		if rows and _middle(rows[-1]) < 1: continue
		found = strengthReduction(solver, tolerance, _middle(rows[-1]) if rows else 1., factor)
		rows.append((scene.time, found['lower'], found['upper']))
		print(f'time {scene.time:.6g} s: factor of safety {_middle(rows[-1]):.4g}')
	table = np.array(rows).reshape(-1, 3)
	factors = (table[:, 1] + table[:, 2]) / 2
	if end: print(f'no equilibrium after {solver.loadTime:.6g} s: {end}')
	return dict(time=table[:, 0], lower=table[:, 1], upper=table[:, 2], factor=factors, failureTime=_failure(table[:, 0], factors, solver.loadTime if end else math.inf), end=end)


def _middle(row):
	return (row[1] + row[2]) / 2


def _admitted(times):
	values = list(times) if isinstance(times, (list, tuple, range, np.ndarray)) else []
	if not values or not all(isNumber(time) and math.isfinite(time) for time in values): raise TypeError(f'safetyInTime: times = {brief(times)} must be a list of times [s]')
	if any(b <= a for a, b in zip(values, values[1:])): raise ValueError(f'safetyInTime: times = {brief(times)} must grow')
	scene = wrapper.Omega()
	if not scene.dt > 0: raise ValueError(f'safetyInTime: O.dt = {scene.dt} must be > 0')
	if values[0] < scene.time - _late * scene.dt: raise ValueError(f'safetyInTime: times begin with {values[0]:g} s, and O.time is {scene.time:g} s already: give times from there on')
	return [float(value) for value in values]


def _advance(scene, solver, time):
	"""Makes the steps up to a time; returns why there is no equilibrium, or an empty text."""
	while scene.time < time - _late * scene.dt:
		try:
			scene.step()
		except RuntimeError as error:
			if solver.converged: raise
			return str(error)
	return ''


def _failure(times, factors, ended):
	"""Time when the factor falls to one, between two of the times, or at the end of the run."""
	for i in np.flatnonzero(factors < 1)[:1]:
		if i == 0: return float(times[0])
		part = (factors[i - 1] - 1) / (factors[i - 1] - factors[i])
		return float(times[i - 1] + part * (times[i] - times[i - 1]))
	return float(ended)
