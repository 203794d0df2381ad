# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a scene that a function makes, again and again."""
import math
import time

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber
from ..points.data import arrays


def enginesOf():
	return [engine for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine)]


def resultOf(caller, run, argument, what):
	"""Numbers by name that run(argument) returns in an empty scene, and its time [s]; *what* says in print what it is with."""
	wrapper.Omega().reset()
	began = time.time()
	call = f'run({argument:g})'
	try:
		result = run(argument)
	except Exception as error:
		raise RuntimeError(f'{caller}: the run with {what} fails: {type(error).__name__}: {error}') from error
	seconds = time.time() - began
	if result is None: result = dict(displacement=_largestDisplacement(caller, call))
	elif not isinstance(result, dict): result = dict(value=result)
	for name, value in result.items():
		if not isNumber(value): raise TypeError(f'{caller}: {call} returns {name} = {brief(value)}: expected a number, a dict of numbers by name, or None')
		if not math.isfinite(value): raise ValueError(f'{caller}: {call} returns {name} = {value}: expected a finite number')
	if not result: raise ValueError(f'{caller}: {call} returns an empty dict: expected a number for each name')
	print(f'{what}, {seconds:.2g} s: ' + ', '.join(f'{name} = {value:.6g}' for name, value in result.items()))
	return {name: float(value) for name, value in result.items()}, seconds


def _largestDisplacement(caller, call):
	points = arrays()
	if not len(points['id']): raise ValueError(f'{caller}: {call} returns None, and has left no material points whose largest displacement could be taken')
	return np.linalg.norm(points['pos'] - points['pos0'], axis=1).max()
