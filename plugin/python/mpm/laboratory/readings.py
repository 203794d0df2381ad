# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests that somebody has made: kinds, states at first, and readings of curves, as `mpm.calibrate` takes them."""
import math
from types import SimpleNamespace

import numpy as np

from ..base.messages import brief, isNumber
from ..base.naming import didYouMean
from . import tests as laboratory

stresses = ['stress_xx', 'stress_yy', 'stress_zz', 'stress_xy']
# measured quantities of a test: neither those that its kind keeps or prescribes, nor those that are zero in it
measured = {
        'triaxial': ['q', 'p', 'volumetricStrain', 'stress_yy'],
        'biaxial': ['q', 'p', 'volumetricStrain', 'stress_yy', 'stress_zz'],
        'oedometer': ['q', 'p', 'stress_xx', 'stress_yy', 'stress_zz'],
        'undrainedTriaxial': ['q', 'p', 'stress_xx', 'stress_yy', 'stress_zz'],
        'simpleShear': ['q', 'p', 'volumetricStrain', 'stress_xx', 'stress_zz', 'stress_xy'],
}
settings = ['kind', 'confiningPressure', 'initialStress', 'internals', 'weight', 'name']


def testsOf(who, tests, steps):
	"""Tests as `mpm.calibrate` has them, checked, each with its curves, the strains of its steps, and at which of these there are readings."""
	if isinstance(tests, dict) or not isinstance(tests, (list, tuple)): raise TypeError(f'{who}: tests = {brief(tests)} must be a list of dicts, one for each test')
	if not tests: raise ValueError(f'{who}: tests = [] has no curve to fit')
	return [_testOf(f'{who}: tests[{i}]', given, steps) for i, given in enumerate(tests)]


def _testOf(where, given, steps):
	if not isinstance(given, dict): raise TypeError(f"{where} = {brief(given)} must be a dict, as dict(kind='triaxial', axialStrain=..., q=...)")
	kind = given.get('kind')
	driven = laboratory.drivenStrain(where, kind)
	other = ({'axialStrain', 'shearStrain'} - {driven}).pop()
	if other in given: raise ValueError(f'{where}: {other} is that of a curve of another kind; the strain of {kind!r} is {driven}')
	if driven not in given: raise ValueError(f'{where}: {driven} is missing, the strain over which the readings of {kind!r} are')
	names = [name for name in given if name not in settings and name != driven]
	for name in names:
		_requireMeasured(where, kind, driven, name)
	if not names: raise ValueError(f"{where} has no readings; {kind!r} may have {', '.join(measured[kind])}")
	strains = _readings(where, driven, given[driven])
	if np.abs(strains).max() > 10 or not strains.any(): raise ValueError(f'{where}: {driven} = {brief(given[driven])} must have numbers from -10 to 10 that are not all 0')
	weights = _weights(where, given.get('weight', 1), names)
	curves = [_curveOf(where, name, given[name], len(strains), weights[name]) for name in names]
	path, at = _pathThrough(strains, steps)
	first = {name: given[name] for name in ('confiningPressure', 'initialStress') if name in given}
	laboratory.firstStress(where, **{'confiningPressure': 0, 'initialStress': None} | first)
	internals = given.get('internals', {})
	if not isinstance(internals, dict): raise TypeError(f'{where}: internals = {brief(internals)} must be a dict')
	internals = laboratory.internalsOf(where, internals)
	return SimpleNamespace(kind=kind, driven=driven, name=str(given.get('name', _nameOf(kind, given))), strains=strains, curves=curves, path=path, at=at, first=first, internals=internals)


def _nameOf(kind, given):
	pressure = given.get('confiningPressure')
	return f'{kind} at {pressure / 1e3:g} kPa' if isNumber(pressure) else kind


def _requireMeasured(where, kind, driven, name):
	if name in measured[kind]: return
	known = [*settings, driven, *measured[kind]]
	if name not in stresses and name != 'volumetricStrain': raise ValueError(f"{where}: there is no {brief(name)} of a test{didYouMean(name, known) or ';'} it may have {', '.join(known)}")
	raise ValueError(f"{where}: {name} is prescribed in a test of kind {kind!r}, and says nothing of the soil; it measures {', '.join(measured[kind])}")


def _readings(where, name, values):
	array = np.atleast_1d(np.asarray(values))
	if array.dtype.kind not in 'iuf': raise TypeError(f'{where}: {name} = {brief(values)} must be numbers')
	if array.ndim != 1 or not array.size: raise ValueError(f'{where}: {name} = {brief(values)} must be a list of numbers, one for each reading')
	wrong = np.flatnonzero(~np.isfinite(array))
	if wrong.size: raise ValueError(f'{where}: {name}[{wrong[0]}] = {array[wrong[0]]} is not finite ({wrong.size} of {array.size} readings); leave such readings out')
	return array.astype(float)


def _weights(where, weight, names):
	weights = weight if isinstance(weight, dict) else dict.fromkeys(names, weight)
	for name, value in weights.items():
		if name not in names: raise ValueError(f"{where}: weight has {brief(name)}, which is none of its curves {', '.join(names)}")
		if not isNumber(value): raise TypeError(f'{where}: weight = {brief(weight)} must be a number > 0, or a dict of them')
		if not (math.isfinite(value) and value > 0): raise ValueError(f'{where}: weight = {brief(weight)} must be > 0; leave out what is to have none')
	return {name: float(weights.get(name, 1)) for name in names}


def _curveOf(where, name, values, count, weight):
	values = _readings(where, name, values)
	if len(values) != count: raise ValueError(f'{where}: {name} has {len(values)} readings for {count} strains')
	scale = np.abs(values).max()
	if not scale: raise ValueError(f'{where}: {name} is 0 in all readings, which gives its misfit no scale; leave it out')
	return SimpleNamespace(name=name, values=values, scale=scale, factor=weight / (scale * math.sqrt(count)), weight=weight)


def _pathThrough(strains, steps):
	"""Strains from 0 on through all readings in equal parts of at most 1 / steps of their range; and where in them the readings are, 0 being the state at first."""
	longest = np.ptp([0, *strains]) / steps
	path, at, last = [], [], 0.
	for strain in strains:
		parts = math.ceil(abs(strain - last) / longest - 1e-9)
		path += [last + (strain - last) * (i + 1) / parts for i in range(parts - 1)] + [strain] * (parts > 0)
		at.append(len(path))
		last = strain
	return np.array(path), np.array(at)
