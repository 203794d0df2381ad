# SPDX-License-Identifier: GPL-2.0-or-later
"""Processing of accelerations at equal steps: baseline, filter, integrals, response spectrum, Arias intensity. SI units, NumPy alone."""
import numpy as np

orderBelow, orderAbove = 2, 4  # orders of Butterworth's filters, whose gain is applied forwards and backwards
_quietVelocity, _quietDisplacement = 1e-4, 5e-3  # limits as parts of the largest ones: beginning and end below them are cut off
degrees = {'constant': 0, 'linear': 1, 'quadratic': 2}


def integral(values, step):
	"""Integral of values that are linear between samples, from 0 on."""
	return np.concatenate([[0.], np.cumsum((values[1:] + values[:-1]) * step / 2)])


def withoutDrift(acceleration, step, degree):
	"""Less a polynomial of the degree 0, 1 or 2, such that the velocity ends with 0 and has the least squares of all that do."""
	velocity = integral(acceleration, step)
	t = np.linspace(0, 1, len(velocity))
	powers = [t**(k + 1) for k in range(degree + 1)]  # terms of the velocity, which begins with 0
	fitted = velocity[-1] * powers[0]
	bubbles = np.array([power - powers[0] for power in powers[1:]]).T  # functions that are 0 at both ends
	if degree: fitted = fitted + bubbles @ np.linalg.lstsq(bubbles, velocity - fitted, rcond=None)[0]
	left = acceleration - np.gradient(fitted, step)
	return left - integral(left, step)[-1] / (step * (len(left) - 1))  # differences leave this much at the end


def filtered(acceleration, step, low, high):
	"""Between two frequencies [Hz] by Butterworth's gain applied twice, without shift of phase; 0 or inf: no limit. And how many samples it begins earlier.

	With *low* there is rest before and after, 1.5 times order over corner frequency (A. M. Converse and A. G. Brady 1992), in which what the filter spreads out
	dies away. Of that is kept what is not quiet.
	"""
	rest = int(np.ceil(1.5 * 2 * orderBelow / low / step)) if low else 0
	padded = np.pad(acceleration, rest)
	size = 1 << int(np.ceil(np.log2(2 * len(padded))))
	frequency = np.fft.rfftfreq(size, step)
	gain = 1 / (1 + (frequency / high)**(2 * orderAbove))
	if low: gain = gain * np.concatenate([[0.], 1 / (1 + (low / frequency[1:])**(2 * orderBelow))])
	found = np.fft.irfft(np.fft.rfft(padded, size) * gain, size)[:len(padded)]
	if not rest: return found, 0
	velocity = integral(found, step)
	displacement = np.abs(integral(velocity, step))
	moving = np.flatnonzero((np.abs(velocity) > _quietVelocity * np.abs(velocity).max()) | (displacement > _quietDisplacement * displacement.max()))
	begin, end = min(rest, moving[0]), max(rest + len(acceleration), moving[-1] + 2)
	return found[begin:end], rest - begin


def responseSpectrum(acceleration, step, periods, damping):
	"""Largest displacements [m] relative to the ground of oscillators, exact for accelerations that are linear between samples (N. C. Nigam and P. C. Jennings 1969).

	Samples are divided until a twentieth of the shortest period, so that peaks between them are missed by 1.2 % at most.
	"""
	parts = max(1, int(np.ceil(20 * step / periods.min())))
	ground = np.interp(np.arange((len(acceleration) - 1) * parts + 1) / parts, np.arange(len(acceleration)), acceleration)
	w, h = 2 * np.pi / periods, step / parts
	(a11, a12, a21, a22), (b11, b12, b21, b22) = _exactStep(w, damping, h)
	u, v, largest = np.zeros_like(w), np.zeros_like(w), np.zeros_like(w)
	for before, after in zip(ground[:-1], ground[1:]):
		u, v = a11 * u + a12 * v + b11 * before + b12 * after, a21 * u + a22 * v + b21 * before + b22 * after
		np.maximum(largest, np.abs(u), out=largest)
	return largest


def _exactStep(w, xi, h):
	"""Solution of u'' + 2 xi w u' + w^2 u = -a over a step h: (u, v) afterwards by (u, v) before, and by a before and after; by closed forms of a(t) = 1 and a(t) = t / h."""
	wd = w * np.sqrt(1 - xi**2)
	decay, s, c = np.exp(-xi * w * h), np.sin(wd * h), np.cos(wd * h)
	free = decay * (c + xi * w / wd * s), decay * s / wd, -decay * w**2 / wd * s, decay * (c - xi * w / wd * s)
	a11, a12, a21, a22 = free
	# A particular solution of -1 is -1 / w^2, of -t / h is -(t - 2 xi / w) / (w^2 h); the free motion takes off its beginning.
	one = -(1 - a11) / w**2, a21 / w**2
	u0, v0 = 2 * xi / (w**3 * h), -1 / (w**2 * h)
	ramp = u0 + v0 * h - a11 * u0 - a12 * v0, v0 - a21 * u0 - a22 * v0
	return free, (one[0] - ramp[0], ramp[0], one[1] - ramp[1], ramp[1])


def ariasIntensity(acceleration, step):
	"""Pi / (2 g) times the integral of the squared acceleration [m/s], as it grows (A. Arias 1970); of accelerations that are linear between samples."""
	a, b = acceleration[:-1], acceleration[1:]
	return np.pi / (2 * 9.80665) * np.concatenate([[0.], np.cumsum((a * a + a * b + b * b) * step / 3)])


def doubtOfVelocity(velocity, step):
	"""A sentence if these velocities [m/s] are most likely accelerations; else nothing.

	An acceleration changes its sign far more often than a velocity, which is what it is judged by; its drift, if it is a raw one, makes it sure.
	"""
	rate = np.abs(np.diff(velocity)).max(initial=0) / step
	largest = np.abs(velocity).max(initial=0)
	if largest == 0: return ''
	way = integral(velocity, step)
	drift = abs(way[-1]) / np.abs(way).max() if way.any() else 0
	if rate <= 40 * largest and rate <= 50 and not (rate > 10 * largest and drift > 0.3): return ''
	text = f'its accelerations would be up to {rate:.3g} m/s2, {rate / largest:.3g} 1/s times its largest value (velocities of earthquakes: 4 to 30)'
	if drift > 0.3: text += f', and as a velocity it drifts: the displacement ends at {100 * drift:.0f} % of its largest value, {way[-1]:.3g} m'
	return text


def doubtOfAcceleration(velocity, displacement):
	"""A sentence if what was integrated is too large for an earthquake; else nothing."""
	v, d = np.abs(velocity).max(), np.abs(displacement).max()
	if v <= 5 and d <= 10: return ''
	return f'integrated, it moves with up to {v:.3g} m/s and by up to {d:.3g} m, more than any record (5 m/s, 10 m): the unit is wrong, a velocity was handed in as an acceleration, or it drifts'
