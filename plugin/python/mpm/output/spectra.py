# SPDX-License-Identifier: GPL-2.0-or-later
"""Histories over frequency."""
import numpy as np

from ..base.messages import brief, numbersIn
from ..library import engine

_bytes = 2**26  # bytes of the exponentials that are in memory at once


def frequenciesOf(who, frequencies, time):
	"""Frequencies that were given [Hz], or all that these times can tell of: from one over their span to half of one over their longest step."""
	if len(time) < 3: raise ValueError(f'{who}: {len(time)} times are too few for a spectrum; run the scene first')
	if frequencies is None: return np.arange(1, int(np.diff(time).size / 2 * np.diff(time).mean() / np.diff(time).max() + 1e-9) + 1) / (time[-1] - time[0])
	f = np.atleast_1d(numbersIn(frequencies))
	highest = 0.5 / np.diff(time).max()
	if not f.size or f.ndim != 1 or not (np.isfinite(f) & (f > 0)).all(): raise ValueError(f'{who}: frequencies = {brief(frequencies)} must be finite numbers > 0 [Hz]')
	if (f > highest * (1 + 1e-9)).any(): raise ValueError(f'{who}: frequencies: {f.max():g} Hz is beyond {highest:g} Hz, half of one over the longest step of the histories')
	return f


def transform(time, values, frequencies):
	"""Fourier's integral (frequencies, ...) of values (times, ...), by the trapezoidal rule; steps may differ."""
	weights = np.zeros_like(time)
	weights[:-1] += np.diff(time) / 2
	weights[1:] += np.diff(time) / 2
	weighted = (weights * values.T).T
	rows = max(1, _bytes // (16 * len(time)))
	return np.concatenate([np.exp(-2j * np.pi * np.outer(frequencies[i:i + rows], time)) @ weighted for i in range(0, len(frequencies), rows)])


def warnOfMotionLeft(who, time, values):
	"""Warns that frequencies run into each other in a record that is cut off."""
	late = time > time[0] + 0.95 * (time[-1] - time[0])
	largest = np.abs(values).max()
	left = np.abs(values[late]).max(initial=0)
	if left > 0.02 * largest: engine.warn(f'{who}: in the last twentieth of the time there is still {100 * left / largest:.2g} % of the largest value: what is cut off blurs the spectrum. Let the run go on until it is quiet')
