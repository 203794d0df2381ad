# SPDX-License-Identifier: GPL-2.0-or-later
"""Records of earthquakes: files, corrections, integrals, spectra; damping of the scheme in time, and histories over frequency."""
begin = '''
from scenes import *
import numpy as np
import json

t = np.arange(1001) * 0.01
pulse = lambda t: np.where(t < 4, np.sin(np.pi * t / 2)**3, 0)  # [m/s2], two half waves that leave the ground at rest, elsewhere
pairs = list(zip(t, pulse(t)))

def write(name, text):
	open(name, 'w').write(text)
	return name

def refused(call, expected, kind=(ValueError, TypeError)):
	try:
		call()
	except kind as error:
		assert expected in str(error), (expected, str(error))
	else:
		assert False, 'not refused: ' + expected
'''

files = '''
rows = '\\n'.join(' '.join(f'{a:.8e}' for a in pulse(t[i:i + 5])) for i in range(0, 1001, 5))
heading = 'PEER NGA STRONG MOTION DATABASE RECORD\\nNowhere, 1/1/2000, Station 1, 90\\nACCELERATION TIME SERIES IN UNITS OF G\\n'
new = write('new.AT2', heading + 'NPTS=   1001, DT=   .0100 SEC,\\n' + rows)
old = write('old.AT2', heading + ' 1001   .0100 NPTS, DT\\n' + rows)
columns = write('two.txt', 'time acceleration\\n' + '\\n'.join(f'{x:.2f}  {a:.9e}' for x, a in pairs))
commas = write('two.csv', 'time; acceleration\\n' + '\\n'.join(f'{x:.2f};{100 * a:.9e}' for x, a in pairs))
expected = mpm.record(pairs, unit='m/s2', baseline=None)
for file, unit, factor in (new, None, 9.80665), (old, 'g', 9.80665), (columns, 'm/s2', 1), (columns, 'g', 9.80665), (commas, 'cm/s2', 1):
	found = mpm.record(file, unit=unit, baseline=None, isSure=True)
	assert found.step == expected.step and len(found.time) == 1001 and found.time[0] == 0
	assert np.abs(found.acceleration / factor - expected.acceleration).max() < 1e-7, (file, unit)
assert mpm.record(new, isSure=True).unit == 'g' and np.allclose(mpm.record(pairs, unit='m/s2', scale=-2).velocity, -2 * mpm.record(pairs, unit='m/s2').velocity)
'''

mistakes = '''
nan, n = float('nan'), 1001
for call, message in {
		"mpm.record(columns)": "unit is not given", "mpm.record(columns, unit='ft/s2')": "unit = 'ft/s2'", "mpm.record(pairs, unit='m/s')": "unit = 'm/s'",
		"mpm.record(new, unit='m/s2')": "heading", "mpm.record(write('e', ''), unit='g')": 'no numbers', "mpm.record([], unit='g')": 'pairs',
		"mpm.record(pairs[:3], unit='g')": '3 samples', "mpm.record([(x, 0) for x in t], unit='g')": 'are 0',
		"mpm.record([*pairs[:500], *pairs[501:]], unit='m/s2')": 'unequal length: 0.02 s after t = 4.99', "mpm.record([*pairs, (5, 1)], unit='g')": 'not after the one before',
		"mpm.record([*pairs, (10.01, nan)], unit='g')": 'sample 1001', "mpm.record(write('n', '0 1\\\\n.1 nan\\\\n'), unit='g')": 'line 2',
		"mpm.record(write('w', '0 1\\\\n.1 x\\\\n'), unit='g')": 'line 2', "mpm.record(write('3', '0 1 2\\\\n'), unit='g')": '3 columns', "mpm.record(write('1', '1\\\\n2\\\\n'), unit='g')": '1 columns',
		"mpm.record(write('c', heading + 'NPTS= 1002, DT= .01\\\\n' + rows))": 'cut off', "mpm.record(write('d', heading + 'NPTS= 1001, DT= 0\\\\n' + rows))": 'DT',
		"mpm.record(3, unit='g')": 'path', "mpm.record([1, 2], unit='g')": 'pairs', "mpm.record(pairs, unit='m/s2', quantity='speed')": 'quantity',
		"mpm.record(pairs, unit='m/s2', baseline='cubic')": 'baseline', "mpm.record(pairs, unit='m/s2', filter=(25, .1))": 'swapped', "mpm.record(pairs, unit='m/s2', filter=3)": 'pair',
		"mpm.record(pairs, unit='m/s2', filter=(.1, 60))": '50 Hz', "mpm.record(pairs, unit='m/s2', filter=(nan, 20))": 'low < high', "mpm.record(pairs, unit='m/s2', step=0)": '> 0',
		"mpm.record(pairs, unit='m/s2', step=.02)": 'filter=(low, 20)', "mpm.record(pairs, unit='m/s2', scale=0)": 'scale', "mpm.record(pairs, unit='g', scale=10)": 'unit is wrong',
		"mpm.record(pairs, units='g')": "'units'", "expected.responseSpectrum([0])": '> 0', "expected.responseSpectrum(damping=5)": '0.05', "expected.motion(start=nan)": 'start',
		"mpm.rayleigh(5, 3)": '0.05', "mpm.rayleigh(.05, (3, 3))": 'same', "mpm.rayleigh(.05, 0)": '> 0', "mpm.rayleigh((.01, .9), (1, 2))": 'between 0.5 and 2', "mpm.rayleigh(.05, (1, 2, 3))": 'one or two', "mpm.rayleigh(nan, 1)": 'finite'}.items():
	refused(lambda: eval(call), message)
refused(lambda: mpm.record('missing.AT2'), 'missing.AT2', OSError)
'''


def test_files_are_read_and_what_is_wrong_is_named(yade):
	yade(begin + files + mistakes)


def test_baseline_filter_and_step(yade):
	"""Baseline that was put on the record is taken off; filters and steps leave what their formulas say."""
	yade(begin + '''
from scenes import *
clean = mpm.record(pairs, unit='m/s2', baseline=None)
assert abs(clean.velocity[-1]) < 1e-6 and 0.9 < clean.displacement[-1] < 2
for kind, drift in dict(constant=0.03 + 0 * t, linear=0.03 - 0.01 * t, quadratic=0.02 * (t / 5 - 1)**2).items():
	raw = mpm.record(list(zip(t, pulse(t) + drift)), unit='m/s2', baseline=None, isSure=True)
	for asKind in kind, :
		found, same = (mpm.record(list(zip(t, a)), unit='m/s2', baseline=asKind) for a in (pulse(t) + drift, pulse(t)))
		assert abs(found.velocity[-1]) < 1e-12 and abs(raw.velocity[-1]) > 0.02
		assert np.abs(found.displacement - same.displacement).max() < 2e-3 * np.abs(raw.displacement - clean.displacement).max(), kind
wave = lambda f: np.sin(2 * np.pi * f * t) * np.sin(np.pi * t / 10)**2
for f, gain in (0.5, 1 / (1 + (1 / 0.5)**4)), (3, 1), (10, 0.5), (20, 1 / (1 + 2**8)):
	low, high = (1, np.inf) if f < 1 else (0, 10)
	found = mpm.record(list(zip(t, wave(f))), unit='m/s2', baseline=None, filter=(low, high))
	middle = np.interp(np.arange(4, 6, 0.01), found.time - found.before, found.acceleration)
	assert abs(np.abs(middle).max() / np.abs(wave(f)[400:600]).max() - gain) < 0.04, (f, gain, np.abs(middle).max())
calm = mpm.record(list(zip(t, pulse(t) + 0.05)), unit='m/s2', filter=(0.2, 20))
assert abs(calm.velocity[-1]) < 1e-12 and abs(calm.displacement[-1]) < 0.02 * np.abs(calm.displacement).max() and calm.time[0] == 0 and calm.before > 0, (calm.velocity[-1], calm.displacement[-1], calm.before)
coarse = mpm.record(pairs, unit='m/s2', filter=(0, 10), step=0.04)
fine = mpm.record(pairs, unit='m/s2', step=0.005)
assert coarse.step == 0.04 and fine.step == 0.005
for other in coarse, fine:
	assert np.abs(np.interp(t, other.time, other.displacement) - mpm.record(pairs, unit='m/s2').displacement).max() < 5e-3
''')


def test_spectra_and_intensity_are_those_of_closed_forms(yade):
	yade(begin + '''
xi = 0.05
jump = mpm.record([(x, 1.) for x in t], unit='m/s2', baseline=None, isSure=True).responseSpectrum([0.1, 1, 3], xi)
assert np.abs(jump['pseudoAcceleration'] / (1 + np.exp(-np.pi * xi / (1 - xi**2)**0.5)) - 1).max() < 1e-3
ramp = mpm.record([(x, x) for x in t], unit='m/s2', baseline=None, isSure=True).responseSpectrum([0.05], 0.5)
assert abs(ramp['pseudoAcceleration'][0] / (10 - 2 * 0.5 * 0.05 / (2 * np.pi)) - 1) < 1e-6  # it lags behind by 2 xi / w
long = np.arange(0, 40, 0.005)
sine = mpm.record(list(zip(long, np.sin(4 * np.pi * long))), unit='m/s2', baseline=None)
assert abs(sine.responseSpectrum([0.5], xi)['pseudoAcceleration'][0] * 2 * xi - 1) < 2e-3
assert abs(sine.arias / (np.pi / (2 * 9.80665) * 20) - 1) < 1e-3 and abs(sine.significantDuration - 36) < 0.1
assert abs(sine.frequencies([0.5])[0] - 2) < 0.02
sine.plot('out/sine.png')
import os
assert os.path.getsize('out/sine.png') > 20000
''')


def test_what_is_an_acceleration_is_asked_about(yade):
	"""Handed in as a velocity, with the drift of a raw record and without; and true velocities are taken."""
	yade(begin + '''
noise = np.random.default_rng(3).standard_normal(4001) * np.exp(-((np.arange(4001) - 1500) / 700)**2)
w = np.fft.rfftfreq(4001, 0.005) / 2.5
a = np.fft.irfft(np.fft.rfft(noise) * (1 + 1.2j * w) / (1 - w**2 + 1.2j * w), 4001)
time = 0.005 * np.arange(4001)
for size in 0.3, 3:
	for offset in 0, 0.02:
		raw = [(x, size * (y + offset)) for x, y in zip(time, a / np.abs(a).max())]
		refused(lambda: mpm.record(raw, unit='m/s', quantity='velocity'), 'Is it an acceleration?')
		assert mpm.record(raw, unit='m/s', quantity='velocity', isSure=True).step == 0.005
		quake = mpm.record(raw, unit='m/s2', filter=(0.1, 25))
		again = mpm.record(quake.history, unit='m/s', quantity='velocity')
		assert np.abs(again.velocity - quake.velocity).max() < 0.02 * np.abs(quake.velocity).max()
		O.reset()
		solver = column(8)
		solver = MpmDynamicEngine(grid=solver.grid, boundaries=list(solver.boundaries), verbosity=0, scheme='generalised-alpha', rayleigh=mpm.rayleigh(0.05, 2))
		O.engines, O.dt = [solver], 0.01
		assert not any('.motion' in text for text in mpm.advise()['advice'])
		for history, isDoubted in (raw, True), (quake.history, False):
			solver.boundaries = [*list(solver.boundaries)[:2], MpmBoundary(max=(inf, 0, inf), fix='xy', motion=MpmBaseMotion(history=history))]
			said = [text for text in mpm.advise()['advice'] if '.motion' in text]
			assert any('Is it an acceleration?' in text for text in said) == isDoubted, said
			assert 'damps by itself' in said[-1] and 'rayleigh' in said[-1], said
''')


def test_damping_of_schemes(yade):
	"""Against closed forms: eigenvalues of undamped steps, Newmark's damping (gamma - 1/2) w dt / 2, and what is left of the highest frequencies."""
	yade(begin + '''
f, O.dt = np.array([1, 5, 20]), 0.01
half = np.pi * f * O.dt
engine = lambda **settings: MpmDynamicEngine(grid=MpmGrid(cellSize=1), **settings)
for settings, period in (dict(), half / np.arctan(half)), (dict(scheme='midpoint'), half / np.arctan(half)), (dict(scheme='explicit'), half / np.arcsin(half)):
	found = mpm.schemeDamping(f, engine(**settings))
	assert np.abs(found['damping']).max() < 1e-12 and np.abs(found['period'] / period - 1).max() < 1e-9, settings
low = mpm.schemeDamping([0.5], engine(gamma=0.7, beta=0.36))['damping'][0]
assert abs(low / (0.2 * np.pi * 0.5 * O.dt) - 1) < 1e-3, low
for radius in 0, 0.5, 0.8, 1:
	found = mpm.schemeDamping([1e5], engine(scheme='generalised-alpha', rhoInfinity=radius))['damping'][0]
	left = np.log(max(radius, 1e-3))
	assert abs(found - -left / np.hypot(left, np.pi)) < 0.01 or radius == 0 and found > 0.9, (radius, found)
twice = mpm.schemeDamping(f, engine(scheme='generalised-alpha'), step=0.02)
assert np.allclose(twice['damping'], mpm.schemeDamping(2 * f, engine(scheme='generalised-alpha'))['damping'])
for call, expected in {'mpm.schemeDamping([0], engine())': '> 0', 'mpm.schemeDamping([1], engine(), step=-1)': 'step', 'mpm.schemeDamping([1], MpmImplicitEngine())': 'inertia', 'mpm.schemeDamping([1])': 'O.engines'}.items():
	refused(lambda: eval(call), expected)
alpha, beta = mpm.rayleigh((0.05, 0.08), (1, 6))
for xi, one in (0.05, 1), (0.08, 6): assert abs(alpha / (4 * np.pi * one) + beta * np.pi * one - xi) < 1e-12
assert mpm.rayleigh(0.05, 2) == (0, 0.05 / (2 * np.pi))
''')


def test_histories_over_frequency(yade):
	"""A column that swings by a known pulse of its base, and what is left of it."""
	yade(begin + '''
O.materials.append(MpmElasticMat(young=2e6, poisson=0, density=1000, label='soil'))
grid = MpmGrid(cellSize=1, period=(3, 0, 0))
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (3, 4, 1)), grid, 2, 'soil'))
quake = mpm.record(list(zip(t[:401] / 4, 0.01 * pulse(t[:401]))), unit='m/s2')
O.engines = [MpmDynamicEngine(grid=grid, verbosity=0, rayleigh=(0, 3e-2), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy', motion=quake.motion(start=0.1))])]
h = mpm.histories(mpm.arrays()['id'], record=['displacement', 'velocity', 'acceleration', 'stress'])
refused(lambda: h.spectrum(), 'too few')
for call, expected in {"mpm.peaks('velocity')": 'sequence', "mpm.peaks(['speed'])": 'not known', "mpm.peaks(['stress'])": 'stress_xy', "mpm.peaks(every=0)": '>= 1', "mpm.peaks(label='a b')": 'letters', "mpm.peaks.loaded('none')": 'nothing'}.items():
	refused(lambda: eval(call), expected)
mpm.peaks(['acceleration', 'stress_xy'])
refused(lambda: mpm.peaks(), 'is taken')
O.dt = 0.01
O.run(500, wait=True)
points = mpm.arrays()
top, base = int(points['pos'][:, 1].argmax()), int(points['pos'][:, 1].argmin())
f, ratio = h.amplification(top, base)
assert len(f) == len(h.time) // 2 and abs(f[0] * 5 - 1) < 1e-9
first = np.array([1., 1.5, 1.9, 2.5])
k = 2 * np.pi * first / (1e6 / 1000 * (1 + 2j * np.pi * first * 3e-2))**0.5  # Kelvin and Voigt's solid on a rigid base
exact = np.cos(k * 0.25) / np.cos(k * 3.75)
found = h.amplification(top, base, frequencies=first)[1]
assert np.abs(found / exact - 1).max() < 0.05, (found, exact)
one, same = h.amplification(top, base, frequencies=[f[3]])
assert abs(same[0] - ratio[3]) < 1e-9 * abs(ratio[3])
assert abs(h.amplification(top, top)[1][:9] - 1).max() < 1e-12
assert np.isnan(h.amplification(top, base, floor=0.5)[1]).any()
left = h.permanent(0.5)
assert left.shape == (len(h.ids), 3) and np.abs(left[:, 0] / quake.displacement[-1] - 1).max() < 0.05
largest = h.largest('acceleration')
assert largest.shape == (len(h.ids),) and largest[top] > largest[base] > 0
assert (largest == np.linalg.norm(h['acceleration'], axis=2).max(axis=0)).all() and (h.largest('stress_xy') >= 0).all()
mpm.plot(largest, fileName='largest.png')
kept = mpm.peaks.loaded()
assert (kept.ids == h.ids).all() and (kept['acceleration'] == largest).all() and (kept['stress_xy'] == h.largest('stress_xy')).all()
assert (kept.time['acceleration'] == np.array(h.time)[np.linalg.norm(h['acceleration'], axis=2).argmax(axis=0)]).all()
height, ratio = h.overHeight()
assert (np.diff(height) >= 0).all() and ratio[0] == 1 and ratio[-1] == largest[np.argsort(points['pos0'][:, 1], kind='stable')][-1] / largest[np.argsort(points['pos0'][:, 1], kind='stable')][0] > 1
for call, expected in {
		"h.spectrum('velocity')": 'one component', "h.spectrum(frequencies=[-1])": '> 0', "h.spectrum(frequencies=[60])": '50 Hz', "h.amplification(-1, 0)": 'index in h.ids',
		"h.amplification(0, 1.5)": 'index in h.ids', "h.permanent(100)": '5 s that are recorded', "h.permanent(0)": 'more than 0', "h.largest('stress')": 'one component', "h.overHeight(axis=3)": '0, 1 or 2',
		"h.amplification(top, base, 'velocity_z')": 'is 0 at all times', "h.spectrum('speed')": 'not recorded'}.items():
	refused(lambda: eval(call), expected)
''')
