# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of strong-motion records: accelerations at equal steps of time, and their unit."""
import re
from types import SimpleNamespace

import numpy as np

from ..base.messages import brief, numbersIn, pathOf
from . import networks

standardGravity = 9.80665  # [m/s2]
unitsOf = {'acceleration': {'g': standardGravity, 'm/s2': 1., 'cm/s2': 0.01}, 'velocity': {'m/s': 1., 'cm/s': 0.01}}
_fewest = 8  # samples that a record must have
_tolerance = 0.02  # largest difference of times from equal steps, as a part of the step: they are written with few digits


def read(source, quantity, unit, channel):
	"""Data of a source: `begin`, the time of the first sample [s], `step` [s], `values` in SI units, the `name` of the source, `unit`, `title` and `isCorrected` as they were found.

	:param source: path of a file, or pairs (time [s], value)
	:raises ValueError: no unit, lines that cannot be read, values that are not finite, steps that differ, too few samples.
	"""
	found = None
	if isinstance(source, (list, tuple, np.ndarray)):
		name, told = 'the array', None
		first, step, values = _equallySpaced(name, *_pairs(source))
	else:
		path = pathOf('record', 'file', source)
		name = repr(path)
		with open(path, encoding='utf-8', errors='replace') as file:
			lines = file.read().splitlines()
		found = networks.series(name, lines, quantity, channel)
		isPeer = any(_heading(line) for line in lines[:8])
		told = found.unit if found else _unitOfHeading(lines[:4]) if isPeer else None
		first, step, values = (0., found.step, found.values) if found else _readPeer(name, lines) if isPeer else _equallySpaced(name, *_columns(name, lines))
	if channel is not None and found is None: raise ValueError(f'record: channel = {brief(channel)}, but {name} has no channels: that is for files of COSMOS and CSMIP')
	unit = _chosenUnit(name, quantity, unit, told)
	if len(values) < _fewest: raise ValueError(f'record: {name} has {len(values)} samples; a record has {_fewest} at least: is it empty, or cut off?')
	if not values.any(): raise ValueError(f'record: all {len(values)} values of {name} are 0: is it the column of another direction?')
	title, isCorrected = (found.title, found.isCorrected) if found else ('', None)
	return SimpleNamespace(begin=first, step=step, values=values * unitsOf[quantity][unit], name=name, unit=unit, title=title, isCorrected=isCorrected)


def _chosenUnit(name, quantity, unit, told):
	known = unitsOf[quantity]
	if told is not None and told not in known: raise ValueError(f'record: {name} says in its heading that it has {told}; of quantity = {quantity!r} are expected {", ".join(known)}')
	if unit is None and told is None:
		raise ValueError(f'record: unit is not given, and {name} does not tell it: one of {", ".join(map(repr, known))} for quantity = {quantity!r}; a wrong one would be off by a factor of 10 to 1000')
	if unit is not None and unit not in known: raise ValueError(f'record: unit = {brief(unit)} is not admitted for quantity = {quantity!r}: expected one of {", ".join(map(repr, known))}')
	if None not in (unit, told) and unit != told: raise ValueError(f'record: unit = {unit!r}, but {name} says in its heading that it has {told}; leave unit out, or correct the heading')
	return unit or told


def _heading(line):
	"""(samples, step [s]) of the line of a PEER file that has them, in its new or its old form; None if this is another line."""
	number = r'([-+0-9.eE]+)'
	new = re.search(rf'NPTS\s*=\s*(\d+)\D*?DT\s*=\s*{number}', line, re.IGNORECASE)
	old = re.match(rf'\s*(\d+)\s+{number}\s+NPTS\s*,\s*DT', line, re.IGNORECASE)
	return (new or old) and (new or old).groups()


def _unitOfHeading(lines):
	"""The unit that a PEER file tells, or the quantity if that is told alone; None if neither is."""
	text = ' '.join(lines).upper()
	found = re.search(r'UNITS?\s+(?:OF|IS|ARE|:|=)\s*(\S+)', text)
	if found: return networks.unitNamed(found[1])
	other = re.search(r'\b(VELOCITY|DISPLACEMENT)\s+TIME\s+(?:HISTORY|SERIES)', text)
	return other and other[1].lower()


def _readPeer(name, lines):
	"""Values in rows of any length after the line with NPTS and DT."""
	row = next(i for i, line in enumerate(lines) if _heading(line))
	samples, step = _heading(lines[row])
	try:
		samples, step = int(samples), float(step)
	except ValueError:
		step = np.nan
	if not step > 0 or not np.isfinite(step): raise ValueError(f'record: {name}, line {row + 1}: DT must be a time step > 0 [s]: {brief(lines[row].strip())}')
	values = []
	for number, line in enumerate(lines[row + 1:], row + 2):
		values += _numbersOf(name, number, line, line.replace(',', ' ').split())
	if len(values) != samples: raise ValueError(f'record: {name} has {len(values)} values, but NPTS = {samples} in line {row + 1}: is the file cut off?')
	return 0., step, np.array(values)


def _columns(name, lines):
	"""Times and values of two columns, separated by blanks, tabs, commas or semicolons; lines before the first numbers are headings."""
	found = []
	for number, line in enumerate(lines, 1):
		words = re.sub(r'[,;\t]', ' ', line.partition('#')[0]).split()
		if not words: continue
		if not found and not _isNumber(words[0]): continue
		if len(words) != 2:
			hint = '; one column has no times: give pairs (time, value), as in zip(step * numpy.arange(n), values)' if len(words) == 1 else '; make a file of the two that are meant'
			raise ValueError(f'record: {name}, line {number}: {brief(line.strip())} has {len(words)} columns, expected are two, time [s] and value{hint}')
		found.append(_numbersOf(name, number, line, words))
	if not found: raise ValueError(f'record: {name} has no numbers: expected is a PEER file (AT2) with NPTS and DT, or lines with time [s] and value')
	return np.array(found).T


def _isNumber(word):
	try:
		float(word)
	except ValueError:
		return False
	return True


def _numbersOf(name, number, line, words):
	try:
		values = [float(word) for word in words]
	except ValueError:
		values = [np.nan]
	if not np.isfinite(values).all(): raise ValueError(f'record: {name}, line {number}: {brief(line.strip())} has what is no finite number')
	return values


def _pairs(source):
	pairs = numbersIn(source)
	if pairs.ndim != 2 or pairs.shape[1] != 2:
		raise TypeError(f'record: file = {brief(source)} must be a path, or pairs (time [s], value), as in zip(times, values) made a list')
	finite = np.isfinite(pairs).all(axis=1)
	if not finite.all(): raise ValueError(f'record: sample {np.flatnonzero(~finite)[0]} of the array, {tuple(pairs[~finite][0].tolist())}, is not finite')
	return pairs.T


def _equallySpaced(name, times, values):
	if len(times) < 2: return 0., 1., values
	steps, step = np.diff(times), (times[-1] - times[0]) / (len(times) - 1)
	late = np.flatnonzero(steps <= 0)
	if len(late): raise ValueError(f'record: {name}: time {times[late[0] + 1]:g} s of sample {late[0] + 1} is not after the one before, {times[late[0]]:g} s')
	off = np.flatnonzero(np.abs(steps - step) > _tolerance * step + 2 * _lastDigit(times))
	if len(off):
		raise ValueError(
		        f'record: {name} has steps of unequal length: {steps[off[0]]:g} s after t = {times[off[0]]:g} s, {step:g} s in the mean; '
		        'samples may be missing there. Interpolate it to equal steps first, as by numpy.interp'
		)
	return times[0], step, values


def _lastDigit(times):
	"""Half of the last digit with which times seem to be written [s], at most a tenth of their mean step: 0.01 for 0, 0.01, 0.01, 0.02 would hide what is missing."""
	step = (times[-1] - times[0]) / (len(times) - 1)
	digits = next((d for d in range(10) if np.allclose(np.round(times, d), times, rtol=0, atol=1e-12 * max(1, np.abs(times).max()))), 10)
	return min(0.5 * 10.**-digits, 0.1 * step)
