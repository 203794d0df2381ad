# SPDX-License-Identifier: GPL-2.0-or-later
"""Damping that is asked for, and damping that a scheme in time has of its own."""
from types import SimpleNamespace

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber, numbersIn
from ..base.solver import solverOf
from .records import energyFrequencies
from .shaking import doubtOfVelocity


def rayleigh(damping, frequencies):
	"""Rayleigh damping that has given ratios at given frequencies, for ``MpmDynamicEngine.rayleigh``: a mode of the circular frequency w has the ratio alpha / (2 w) + beta w / 2. ::

		solver.rayleigh = mpm.rayleigh(0.05, (1, 5))     # 5 % at 1 and 5 Hz, 3.7 % at 2.2 Hz between
		solver.rayleigh = mpm.rayleigh(0.05, 3)          # by stiffness alone: 5 % at 3 Hz, in proportion to frequency

	The part alpha resists velocities in space, also those of the ground as a whole, which a base that shakes moves: one frequency is right there.

	:param damping: ratio [-], 0 to below 1, or one for each frequency
	:param frequencies: one frequency or two different ones [Hz] > 0
	:return: (alpha [1/s], beta [s])
	:raises ValueError: numbers that are not admitted, or ratios so different that alpha or beta would be below 0.
	"""
	f, xi = _numbers('frequencies', frequencies), _numbers('damping', damping)
	if f.size not in (1, 2) or (f <= 0).any(): raise ValueError(f'rayleigh: frequencies = {brief(frequencies)} must be one or two numbers > 0 [Hz]')
	if (xi < 0).any() or (xi >= 1).any(): raise ValueError(f'rayleigh: damping = {brief(damping)} is not admitted: expected ratios from 0 to below 1; 5 % is 0.05')
	if xi.size not in (1, f.size): raise ValueError(f'rayleigh: damping = {brief(damping)} must be one ratio, or one for each of {f.size} frequencies')
	w = 2 * np.pi * f
	if f.size == 1: return 0., float(2 * xi[0] / w[0])
	if f[0] == f[1]: raise ValueError(f'rayleigh: frequencies = {brief(frequencies)} are the same; two different ones make a fit, one makes damping by stiffness')
	alpha, beta = np.linalg.solve(np.column_stack([1 / (2 * w), w / 2]), np.broadcast_to(xi, 2))
	if alpha < 0 or beta < 0:
		ratio = xi[1] / xi[0] if xi[0] else np.inf
		raise ValueError(f'rayleigh: damping = {brief(damping)} at {brief(frequencies)} Hz would need alpha = {alpha:.3g}, beta = {beta:.3g}, below 0: the second ratio over the first, {ratio:.3g}, must be between {min(f) / max(f):.3g} and {max(f) / min(f):.3g}')
	return float(alpha), float(beta)


def _numbers(name, value):
	values = np.atleast_1d(numbersIn(value))
	if values.ndim != 1 or not values.size or not np.isfinite(values).all(): raise ValueError(f'rayleigh: {name} = {brief(value)} must be finite numbers')
	return values


def schemeDamping(frequencies, solver=None, step=None):
	"""Damping and longer periods that the time integration of a MpmDynamicEngine gives to free vibrations, and not the ground. Nothing is run.

	By the eigenvalues of one step of an oscillator (T. J. R. Hughes 1987; J. Chung and G. M. Hulbert 1993). Rayleigh damping, and what ghost stabilisation and the
	way to the grid and back take, are not in it.

	:param frequencies: [Hz] > 0, of the vibrations
	:param solver: the engine; may be left out when ``O.engines`` holds one
	:param step: [s] > 0; None: O.dt times *iterPeriod* of the engine, or its *virtPeriod*
	:return: dict of arrays ``frequency`` [Hz], ``damping``, ratio [-] (below 0: it grows), ``period``, over the true one [-]
	:raises TypeError: the engine has no inertia.
	:raises ValueError: numbers that are not admitted.
	"""
	solver = solverOf('schemeDamping', solver)
	if not isinstance(solver, wrapper.MpmDynamicEngine): raise TypeError('schemeDamping: the solver must be a MpmDynamicEngine; steps without inertia have no frequencies')
	f = np.atleast_1d(numbersIn(frequencies))
	if not f.size or f.ndim != 1 or not (np.isfinite(f) & (f > 0)).all(): raise ValueError(f'schemeDamping: frequencies = {brief(frequencies)} must be finite numbers > 0 [Hz]')
	step = stepOf(solver) if step is None else step
	if not isNumber(step) or not np.isfinite(step) or step <= 0: raise ValueError(f'schemeDamping: step = {brief(step)} must be a finite number > 0 [s]')
	damping, period = np.transpose([_ofMode(parametersOf(solver), 2 * np.pi * one * step) for one in f])
	return dict(frequency=f, damping=damping, period=period)


def stepOf(solver):
	"""Time from a run of the engine to the next [s]."""
	return solver.virtPeriod if solver.virtPeriod > 0 else wrapper.Omega().dt * max(1, solver.iterPeriod)


def parametersOf(solver):
	"""(beta, gamma, alphaM, alphaF) of its scheme; the midpoint rule is the trapezoidal one where all is linear."""
	if solver.scheme == 'newmark': return solver.beta, solver.gamma, 0., 0.
	if solver.scheme == 'midpoint': return 0.25, 0.5, 0., 0.
	if solver.scheme == 'explicit': return 0., 0.5, 0., 0.
	r = solver.rhoInfinity
	m, f = (2 * r - 1) / (r + 1), r / (r + 1)
	return (1 - m + f)**2 / 4, 0.5 - m + f, m, f


def _ofMode(parameters, angle):
	"""Damping ratio and period over the true one, of an oscillator that turns by an angle [rad] in a step: roots of its equation of differences."""
	beta, gamma, m, f = parameters
	of = lambda a0, a1: np.array([a1, a0])  # a1 z + a0
	square = np.polymul(of(-1, 1), of(-1, 1))
	way = np.polyadd(of(1 - gamma, gamma), np.polymul(of(0.5 - beta, beta), of(-1, 1)))
	roots = np.roots(np.trim_zeros(np.polyadd(np.polymul(of(m, 1 - m), square), angle**2 * np.polymul(of(f, 1 - f), way)), 'f'))
	turning = roots[roots.imag > 1e-9]
	z = turning[np.abs(turning).argmax()] if len(turning) else roots[np.abs(roots).argmax()] + 0j
	grows, turn = np.log(max(abs(z), 1e-300)), abs(np.angle(z))
	damping = -grows / np.hypot(grows, turn) if (grows or turn) else 0.
	return damping, angle / np.hypot(grows, turn) if turn else np.inf


def adviceOnMotion(solver):
	"""Sentences on the motions of a scene: what the scheme does at their frequencies, and what looks like an acceleration."""
	found = []
	for name, motion in _motions(solver):
		time, velocity = np.array(motion.history).T if len(motion.history) > 2 else (np.zeros(0), np.zeros(0))
		if not velocity.any(): continue
		step = np.diff(time).min()
		if (time[-1] - time[0]) / step > 1e6: continue
		even = np.interp(np.arange(time[0], time[-1] + 0.5 * step, step), time, velocity)
		doubt = doubtOfVelocity(even, step)
		if doubt: found.append(f'{name}.history: it must be a velocity [m/s], but {doubt}. Is it an acceleration? mpm.record integrates it.')
		low, middle, high = energyFrequencies(np.diff(even) / step, step, (0.05, 0.5, 0.95))
		found.append(_onFrequencies(solver, name, (low, middle, high)))
	return found


def _motions(solver):
	for kind in 'boundaries', 'absorbing', 'loads':
		for i, one in enumerate(getattr(solver, kind)):
			if getattr(one, 'motion', None) is not None: yield f'{kind}[{i}].motion', one.motion
	moving = [(i, one) for i, one in enumerate(solver.loads) if isinstance(one, wrapper.MpmFreeField) and len(one.times)]
	for i, one in moving[-1:]:  # motion of the base, or of a side whose first vertex is at the bottom
		speed = np.reshape(one.velocities, (len(one.times), -1, 2))[:, 0, 0]
		yield f'loads[{i}].velocities', SimpleNamespace(history=list(zip(one.times, speed)))


def _onFrequencies(solver, name, frequencies):
	scheme = schemeDamping(np.maximum(frequencies, 1e-6), solver)
	alpha, beta = solver.rayleigh
	w = 2 * np.pi * scheme['frequency']
	asked = alpha / (2 * w) + beta * w / 2
	parts = [
	        f'{f:.3g} Hz: {100 * ofScheme:.2g} % and period {100 * (period - 1):+.2g} %' + (f' (rayleigh {100 * ofRayleigh:.2g} %)' if alpha or beta else '')
	        for f, ofScheme, period, ofRayleigh in zip(scheme['frequency'], scheme['damping'], scheme['period'], asked)
	]
	return f"{name}: 5, 50 and 95 % of its intensity are below these frequencies, where scheme='{solver.scheme}' with steps of {stepOf(solver):.3g} s damps by itself: " + '; '.join(parts) + '.'
