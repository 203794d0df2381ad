# SPDX-License-Identifier: GPL-2.0-or-later
"""Records of earthquakes, made into motions of a base."""
import functools

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber
from . import shaking
from .accelerograms import read, standardGravity, unitsOf

_shortestPeriod, _longestPeriod = 0.05, 4.  # periods of the response spectrum in the picture [s]


class record:
	"""A strong-motion record, corrected and integrated. ``r.time`` [s], ``r.acceleration`` [m/s2], ``r.velocity`` [m/s] and ``r.displacement`` [m] are arrays (N,) at equal steps ``r.step`` [s]. ::

		quake = mpm.record('RSN.AT2', filter=(0.1, 25))
		quake.plot('quake.png')
		rigid = MpmBoundary(max=(inf, 0, inf), fix='xy', motion=quake.motion())               # recorded at this base
		compliant = MpmAbsorbingBoundary(max=(inf, 0, inf), motion=quake.incoming())          # recorded on an outcrop of the rock

	In order: to SI units; *baseline*; *filter*; *step*; integration by the trapezoidal rule, of velocities as MpmBaseMotion integrates them. Velocity
	begins and ends with 0, unless *baseline* and *filter* are both None.

	``r.title`` is what the header of a network's file says of event, station and direction, and ``r.isCorrected`` whether that says that the baseline is corrected (None: it says nothing).

	:param file: PEER file (AT2, with NPTS and DT in its heading), a file of ESM (DYNA), K-NET or KiK-net, COSMOS V2, CSMIP V2 (CGS) or SMC (USGS), or text or CSV of two columns, time [s] and value; or pairs (time, value)
	:param unit: ``'g'`` (9.80665 m/s2), ``'m/s2'`` or ``'cm/s2'`` (gal), of velocities ``'m/s'`` or ``'cm/s'``; files of PEER and of networks tell it themselves
	:param quantity: ``'acceleration'``, or ``'velocity'``, which is differentiated first
	:param baseline: polynomial that is taken off the acceleration: ``'constant'``, ``'linear'`` (default), ``'quadratic'`` or None. Of those after which the ground is at rest at the end, the one that leaves the least velocity
	:param filter: (low, high) corner frequencies [Hz], 0 <= low < high, at most half of the samples' rate; None: no filter. Butterworth's, of 2nd order below and of 4th above, forwards and backwards, without shift of phase. A *low* > 0 takes permanent displacement away, and makes the motion longer at both ends, until velocity and displacement are below 0.01 and 0.5 % of their largest values: the first sample of the file is then ``r.before`` [s] behind the beginning
	:param step: step of the result [s]; None: that of the file. Longer than that of the file it needs a filter with high <= 0.4 / step
	:param scale: factor on all values [-], finite and not 0
	:param isSure: take values that look like another quantity or unit
	:param channel: number of the channel in a file of COSMOS or CSMIP that has several, as its header counts them
	:raises TypeError: *file* is neither path nor pairs.
	:raises ValueError: the unit is not told; lines that cannot be read, values that are not finite, unequal steps, next to no samples; a parameter that is not admitted; values that are more likely another quantity: an acceleration handed in as a velocity, or an unlikely unit.
	:raises OSError: the file cannot be read.
	"""

	def __init__(self, file, unit=None, quantity='acceleration', baseline='linear', filter=None, step=None, scale=1, isSure=False, channel=None):
		_requireOptions(quantity, baseline, scale)
		source = read(file, quantity, unit, channel)
		self.step, values, self.name, self.unit, self.title, self.isCorrected = source.step, source.values, source.name, source.unit, source.title, source.isCorrected
		low, high = _corners(filter, self.step)
		_requireStep(step, self.step, high)
		if self.isCorrected is False and baseline is None and not low: self._ask('its header says that its baseline is not corrected, and baseline = None leaves its offset in', isSure, '', " baseline='constant' or a filter takes it off")
		values = values * scale
		if quantity == 'velocity':
			self._ask(shaking.doubtOfVelocity(values, self.step), isSure, "quantity = 'velocity', but ", " Is it an acceleration? Then quantity='acceleration' with its unit integrates it")
			values = np.gradient(values, self.step)
		if baseline is not None: values = shaking.withoutDrift(values, self.step, shaking.degrees[baseline])
		self.before = 0.
		if filter is not None:
			values, before = shaking.filtered(values, self.step, low, high)
			self.before = before * self.step
		if step is not None: values, self.step = self._resampled(values, step), float(step)
		if baseline is not None or low: values = shaking.withoutDrift(values, self.step, 0)
		self.acceleration = values
		self.time = source.begin + self.step * np.arange(len(values))
		self.velocity = shaking.integral(values, self.step)
		self.displacement = shaking.integral(self.velocity, self.step)
		self._ask(shaking.doubtOfAcceleration(self.velocity, self.displacement), isSure, '', ' Look at unit, quantity, baseline and filter')

	def _ask(self, doubt, isSure, before, after):
		if doubt and not isSure: raise ValueError(f'record: {self.name}: {before}{doubt}.{after}; isSure=True takes it as it is')

	def _resampled(self, values, step):
		end = (len(values) - 1) * self.step
		return np.interp(np.arange(0, end + 0.5 * step, step), np.arange(len(values)) * self.step, values)

	@property
	def history(self):
		"""List of (time [s], velocity [m/s]), as MpmBaseMotion.history takes it; it counts in O.time."""
		return list(zip(self.time.tolist(), self.velocity.tolist()))

	def motion(self, direction=(1, 0, 0), start=None):
		"""MpmBaseMotion of this record, for the MpmBoundary of a rigid base, which moves as recorded.

		:param direction: what the velocity is multiplied by [-]
		:param start: O.time [s] at which it begins; None: the time in the file
		"""
		return self._moving(1., direction, start)

	def incoming(self, direction=(1, 0, 0), start=None):
		"""Same as motion(), for the wave that comes up through rock: half of what was recorded on a free outcrop of it. For MpmAbsorbingBoundary.motion."""
		return self._moving(0.5, direction, start)

	def _moving(self, part, direction, start):
		if start is not None and not (isNumber(start) and np.isfinite(start)): raise ValueError(f'record: start = {brief(start)} must be a finite number [s]')
		shift = 0 if start is None else start - self.time[0]
		return wrapper.MpmBaseMotion(history=list(zip((self.time + shift).tolist(), (part * self.velocity).tolist())), direction=direction)

	def responseSpectrum(self, periods=None, damping=0.05):
		"""Response spectrum of oscillators on this ground, exact for accelerations that are linear between samples (N. C. Nigam and P. C. Jennings 1969).

		:param periods: [s] > 0, an array; None: 100 from 0.05 to 4 s
		:param damping: ratio [-], 0 to below 1
		:return: dict of ``period`` [s], ``displacement`` [m], relative to the ground, and ``pseudoAcceleration`` [m/s2], that times (2 pi / period)^2
		"""
		periods = np.geomspace(_shortestPeriod, _longestPeriod, 100) if periods is None else np.atleast_1d(np.asarray(periods, dtype=float))
		if not periods.size or periods.ndim != 1 or not (np.isfinite(periods) & (periods > 0)).all(): raise ValueError(f'record: periods = {brief(periods)} must be finite numbers > 0 [s]')
		if not isNumber(damping) or not 0 <= damping < 1: raise ValueError(f'record: damping = {brief(damping)} is not admitted: expected a ratio from 0 to below 1; 5 % is 0.05')
		largest = shaking.responseSpectrum(self.acceleration, self.step, periods, damping)
		return dict(period=periods, displacement=largest, pseudoAcceleration=largest * (2 * np.pi / periods)**2)

	@property
	def arias(self):
		"""Arias intensity [m/s]."""
		return float(self._husid[-1])

	@property
	def significantDuration(self):
		"""Time [s] in which Arias intensity grows from 5 to 95 %."""
		begin, end = np.interp([0.05, 0.95], self._husid / self._husid[-1], self.time)
		return float(end - begin)

	@functools.cached_property
	def _husid(self):
		return shaking.ariasIntensity(self.acceleration, self.step)

	def frequencies(self, share=(0.05, 0.5, 0.95)):
		"""Frequencies [Hz] below which these shares of Arias intensity are, by its Fourier transform."""
		return energyFrequencies(self.acceleration, self.step, share)

	def plot(self, fileName=None, damping=0.05):
		"""Draw acceleration, velocity, displacement, Arias intensity and response spectrum in one picture; to a file, whole or not at all, if one is named.

		:param damping: ratio of the response spectrum [-]
		:return: the figure
		"""
		from ..output.plotting import write
		if fileName is None:
			import matplotlib.pyplot as pyplot
			figure = pyplot.figure(figsize=(9, 6), layout='constrained')
		else:
			from matplotlib.figure import Figure
			figure = Figure(figsize=(9, 6), layout='constrained')
		left, right = figure.add_gridspec(1, 2, width_ratios=(1.5, 1))
		left, right = left.subgridspec(3, 1), right.subgridspec(2, 1)
		self._drawHistories([figure.add_subplot(place) for place in left])
		self._drawIntensity(figure.add_subplot(right[0]))
		self._drawResponse(figure.add_subplot(right[1]), damping)
		if fileName is not None: write('record.plot', figure, fileName)
		return figure

	def _drawHistories(self, axes):
		for ax, name, unit in zip(axes, ('acceleration', 'velocity', 'displacement'), ('m/s2', 'm/s', 'm')):
			values = getattr(self, name)
			ax.plot(self.time, values, linewidth=0.7, color='#1864ab')
			ax.axhline(0, linewidth=0.5, color='k')
			ax.set_ylabel(f'{name}\n[{unit}]')
			ax.set_title(f'{values[np.abs(values).argmax()]:.3g} {unit} at most', loc='right', fontsize='small', pad=2)
			ax.margins(x=0)
			ax.tick_params(labelbottom=ax is axes[-1])
		axes[-1].set_xlabel('time [s]')

	def _drawIntensity(self, ax):
		ax.plot(self.time, self._husid, color='#d9480f')
		ax.set(xlabel='time [s]', ylabel='Arias intensity [m/s]')
		ax.set_title(f'{self.arias:.3g} m/s; 5 to 95 % in {self.significantDuration:.3g} s', fontsize='medium')
		ax.margins(x=0)

	def _drawResponse(self, ax, damping):
		found = self.responseSpectrum(damping=damping)
		ax.semilogx(found['period'], found['pseudoAcceleration'] / standardGravity, color='#2b8a3e')
		ax.set(xlabel='period [s]', ylabel='pseudo-acceleration [g]')
		ax.set_title(f'response spectrum, damping {100 * damping:g} %', fontsize='medium')
		ax.grid(which='both', linewidth=0.3)


def energyFrequencies(acceleration, step, share):
	"""Frequencies [Hz] below which these shares of the integral of the squared acceleration are."""
	power = np.abs(np.fft.rfft(acceleration, 4 * len(acceleration)))**2
	return np.interp(share, np.cumsum(power) / power.sum(), np.fft.rfftfreq(4 * len(acceleration), step))


def _requireOptions(quantity, baseline, scale):
	if quantity not in unitsOf: raise ValueError(f"record: quantity = {brief(quantity)} is not admitted: expected one of {', '.join(map(repr, unitsOf))}")
	if baseline is not None and baseline not in shaking.degrees: raise ValueError(f"record: baseline = {brief(baseline)} is not admitted: expected one of {', '.join(map(repr, shaking.degrees))} or None")
	if not isNumber(scale) or not np.isfinite(scale) or scale == 0: raise ValueError(f'record: scale = {brief(scale)} is not admitted: expected a finite number other than 0')


def _corners(filter, step):
	"""Limits of the filter [Hz]; (0, inf) without one."""
	if filter is None: return 0., np.inf
	half = 0.5 / step
	try:
		low, high = map(float, filter)
	except (TypeError, ValueError):
		raise ValueError(f'record: filter = {brief(filter)} must be a pair of frequencies [Hz], as in (0.1, 25)') from None
	if not 0 <= low < high: raise ValueError(f'record: filter = {brief(filter)} is not admitted: expected 0 <= low < high [Hz]; are they periods, or swapped?')
	if np.isfinite(high) and high > half: raise ValueError(f'record: filter = {brief(filter)}: the upper frequency must be at most {half:g} Hz, half of one over the step of {step:g} s; inf is no upper limit')
	return low, high


def _requireStep(step, ofFile, high):
	if step is None: return
	if not isNumber(step) or not np.isfinite(step) or step <= 0: raise ValueError(f'record: step = {brief(step)} must be a finite number > 0 [s]')
	if step > ofFile * (1 + 1e-9) and high > 0.4 / step:
		raise ValueError(f'record: step = {step:g} is longer than that of the file, {ofFile:g} s, so that higher frequencies would come back as lower ones; filter=(low, {0.4 / step:g}) takes them off, and less than that is better')
