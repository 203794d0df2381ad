# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs with smaller and smaller cells, until a result is as accurate as asked for."""
import math

from ..base.messages import brief, isNumber
from .refinement import errorOfFinest
from .repeated import enginesOf, resultOf


def untilAccurate(run, accuracy, quantity=None, mostSeconds=math.inf):
	"""Run a scene with cells that are halved once more each time, until the estimated error of a result is as small as asked for; print each run.

	At least three runs. The error of the last is estimated from how the changes from run to run shrink, as in :func:`discretisationError`; where they do not yet, one more is made. The number of halvings
	may be that of all cells, or better of those that matter, as in ``MpmAdaptation(halvings=halvings, where='error')``. What the cells have no part in, as load steps, is not seen: let ``O.dt`` go with them. Scenes are lost (``O.reset()``); the last one is left. With *run* as of :func:`discretisationError`::

		found = mpm.untilAccurate(lambda halvings: run(1 / 2**halvings), accuracy=0.03)
		print(found['displacement'], found['error'])

	:param run: function of the number of halvings 0, 1, 2, ... that makes the scene and runs it, and returns a number, a dict of numbers by name, or None for the largest displacement of a point [m]
	:param accuracy: error that is admitted, as a part of the result, > 0 [-]
	:param quantity: name of the result that is asked about; may be left out where there is one
	:param mostSeconds: time [s] > 0 that the runs may take together; no run is begun that would take longer, as the last two grew
	:return: dict of the results of the last run by name, and ``error``, estimated, of the one that was asked about and in its unit, ``halvings``, ``isReached``, ``values`` of all runs, ``seconds`` of each,
		and ``needed`` where it is not reached: seconds that going on would take, inf where changes do not shrink
	:raises TypeError: an argument, or what *run* returns, of the wrong kind.
	:raises ValueError: an argument that is not admitted; a *run* that returns other names than before, or a number that is not finite, or whose unknowns do not become more.
	:raises RuntimeError: *run* fails: the message says with how many halvings, and why.
	"""
	_requireArguments(run, accuracy, mostSeconds)
	values, seconds, unknowns, names = [], [], [], set()
	while True:
		halvings = len(values)
		result, time = resultOf('untilAccurate', run, halvings, f'{halvings} halvings')
		names = names or set(result)
		if set(result) != names: raise ValueError(f'untilAccurate: run({halvings}) returns {sorted(result)}, and run(0) {sorted(names)}: expected the same names')
		name = _nameOf(result, quantity)
		values.append(result[name])
		seconds.append(time)
		unknowns.append(sum(engine.dofs for engine in enginesOf()))
		if halvings and unknowns[-1] <= unknowns[-2] > 0:
			raise ValueError(
			        f'untilAccurate: run({halvings}) has {unknowns[-1]} unknowns, and run({halvings - 1}) {unknowns[-2]}: expected more, as with MpmGrid(cellSize=h / 2**halvings) or MpmAdaptation(halvings=halvings)')
		if halvings < 2: continue
		error, shrinks = errorOfFinest(*values[-3:])
		isReached = error <= accuracy * abs(values[-1]) and shrinks < 1
		needed = 0 if isReached else _secondsToGo(seconds, error, accuracy * abs(values[-1]), shrinks)
		if isReached or sum(seconds) + _next(seconds) > mostSeconds: break
	found = dict(result, error=error, halvings=halvings, isReached=isReached, values=values, seconds=seconds, needed=needed)
	print(_sentence(name, found, accuracy))
	return found


def _requireArguments(run, accuracy, mostSeconds):
	if not callable(run): raise TypeError(f'untilAccurate: run = {brief(run)} must be a function of the number of halvings that makes and runs the scene')
	for name, value, unit in ('accuracy', accuracy, '[-]'), ('mostSeconds', mostSeconds, '[s]'):
		if not isNumber(value): raise TypeError(f'untilAccurate: {name} = {brief(value)} must be a number {unit}')
		if not value > 0: raise ValueError(f'untilAccurate: {name} = {value} is not admitted: expected a number > 0 {unit}')


def _nameOf(result, quantity):
	if quantity is None and len(result) == 1: return next(iter(result))
	if quantity in result: return quantity
	raise ValueError(f'untilAccurate: quantity = {brief(quantity)} is not admitted: expected one of {sorted(result)}, which run returns')


def _next(seconds):
	"""Time of the next run, as the last two grew [s]."""
	return seconds[-1] * max(1, seconds[-1] / max(seconds[-2], 1e-3))


def _secondsToGo(seconds, error, admitted, shrinks):
	if shrinks >= 1 or admitted == 0: return math.inf
	runs, growth = math.ceil(math.log(admitted / error) / math.log(max(shrinks, 0.1))), _next(seconds) / seconds[-1]
	return sum(seconds[-1] * growth**(k + 1) for k in range(max(1, runs)))


def _sentence(name, found, accuracy):
	value, error = found[name], found['error']
	relative = f' ({100 * error / abs(value):.2g} %)' if value else ''
	text = f"{name} = {value:.6g}, wrong by about {error:.2g}{relative} with {found['halvings']} halvings"
	if found['isReached']: return text
	if math.isinf(found['needed']): return text + '; changes do not shrink yet: no time can be told'
	return text + f"; {100 * accuracy:.2g} % would take some {found['needed']:.2g} s more"
