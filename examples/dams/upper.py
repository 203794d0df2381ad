#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The Upper San Fernando dam in the earthquake of 1971: how far it moved downstream, predicted from blow counts and three artificial records.

	 lake ~~~~~~~~_/\\_____         drained strength: fill, dikes, alluvium, what lies above the water
	         _/ shell|core|shell\\__   residual strength: shells, by blow counts of their layers (Idriss and Boulanger 2008); core
	      _/dike     |    |    dike \\__
	         alluvium, on rock that moves

Measured: H. B. Seed, K. L. Lee, I. M. Idriss and F. I. Makdisi (1975): The slides in the San Fernando dams during the earthquake of February 9, 1971. J. Geotech. Engrg. Div. 101(7).
"""
import os
import sys
import numpy as np
from yade import mpm
here = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [here, os.path.join(here, '..')]
from options import compared, readOptions
from style import plt
options = readOptions('Upper San Fernando dam in an earthquake.',
        cellSize=(4., 'h [m]'),
        peak=(5., 'acceleration of the rock [m/s2]'),
        seconds=(14., 'of an artificial record'),
        seeds=('1 2 3', 'of artificial records, between blanks'),
        record=('', 'file with velocities of the rock [m/s] every 0.02 s, from its third line on, instead'),
        factor=(1., 'of the residual strength of the shells'),
        water=(3., 'level of the water 70 m behind the crest, where the ground is at 13 m [m]'),
        core=(0.12, 'strength of the core over the vertical effective stress'),
        young=(100e6, 'of the dam [Pa]'))
datum, lake, measured = 340., 28., 1.83  # bottom of the alluvium and level of the lake above it [m]; movement of the dam downstream, 6 ft
outline = [(-120, 0), (132, 0), (132, 6.6), (89, 6.6), (71.7, 13), (56, 16.3), (47.2, 19.8), (32, 26), (2.4, 26.3), (-9.5, 31), (-16.4, 31), (-30.5, 26), (-69, 11), (-120, 11)]
layers = dict(upstream=[(0, 14.1, 19.3), (14.1, 20.4, 14.8), (20.4, 40, 11.6)], downstream=[(0, 13.5, 14.7), (13.5, 20, 13.5), (20, 40, 12.1)])  # heights [m], (N1)60cs


def zone(p):
	"""Name of the material at a place."""
	x, y = p[0], p[1]
	if y < np.interp(x, (-63, -21, 28, 74, 89), (11, 9, 8, 7, 6.6)): return 'alluvium'
	if y > 26: return 'fill'
	if -24.9 + 0.47 * y < x < 33.3 - 0.667 * y: return 'core'
	if x < 0: return 'upstream' if x > -91.2 + 2.567 * y else 'dike'
	return 'downstream' if x < 91.7 - 2.526 * y else 'dike'


def table(x):
	"""Level of the water [m]."""
	return np.interp(x, (-20, 70), (lake, options.water))


def artificial(seed):
	"""Velocities every 0.02 s of noise through an oscillator of 1.5 Hz (K. Kanai, H. Tajimi) that grows and dies away."""
	t = np.arange(0, options.seconds, 0.02)
	noise = np.random.default_rng(seed).standard_normal(t.size) * t / options.seconds * np.exp(-6 * t / options.seconds)
	w = np.fft.rfftfreq(2 * t.size, 0.02) / 1.5
	a = np.fft.irfft(np.fft.rfft(noise, 2 * t.size) * (1 + 1.2j * w) / (1 - w**2 + 1.2j * w), 2 * t.size)[:t.size]
	return mpm.record(list(zip(t, options.peak * a / np.abs(a).max())), unit='m/s2', filter=(0.2, 15))


def shaken(quake):
	"""Movement downstream of the surface from crest to toe [m], over time; its scene stays."""
	O.reset()
	grid = MpmGrid(cellSize=options.cellSize)
	for name, density, angle in ('alluvium', 2140, 37), ('fill', 2090, 35), ('dike', 2140, 37):
		O.materials.append(MpmMohrCoulombMat(label=name, young=options.young * (4 if name == 'alluvium' else 1), poisson=0.3, density=density, cohesion=2e3, frictionAngle=radians(angle), dilationAngle=0))
	for name in 'upstream', 'core', 'downstream': O.materials.append(MpmTrescaMat(label=name, young=options.young, poisson=0.3, density=1990, undrainedStrength=1e9))
	O.bodies.append(mpm.fill(mpm.polygon(outline), grid, 2, zone))
	held = lambda **rock: [MpmBoundary(max=(inf, 0, inf), fix='xy', **rock), MpmBoundary(max=(-120, inf, inf), fix='x', **rock), MpmBoundary(min=(132, -inf, -inf), fix='x', **rock)]
	common = dict(grid=grid, gravity=(0, -9.81, 0), water=[MpmWater(pressure=lambda p: 9810 * max(0, table(p[0]) - p[1]))], fBar=True, verbosity=0)
	O.engines = [MpmImplicitEngine(boundaries=held(), **common)]
	O.dt = 1 / 4
	for _ in range(4): O.step()  # the dam as it stood
	points = mpm.arrays()
	material = np.array([O.bodies[int(i)].material.label for i in points['id']])
	x, y = points['pos'][:, :2].T
	before = np.maximum(-points['stress'][:, 1, 1], 5e3)
	ratio = np.full(len(y), options.core)
	for name, rows in layers.items():
		for low, high, blows in rows:
			here = (material == name) & (low <= y) & (y < high)
			ratio[here] = np.where(y < table(x), options.factor * residual(blows), np.tan(np.radians(35)))[here]
	soft = np.isin(material, ('upstream', 'core', 'downstream'))
	mpm.assign(ids=points['id'][soft], undrainedStrength=(ratio * before)[soft])
	O.engines = [MpmDynamicEngine(boundaries=held(motion=quake.motion(start=2)), gravityCurve=[(0, 1)], loadTime=O.time, rayleigh=mpm.rayleigh(0.05, 2), scheme='generalised-alpha', **common)]
	O.dt = 0.02
	start = points['pos'][:, 0].copy()
	base = np.argmin(y)
	high = (y > np.interp(x, *np.transpose(outline[3:10][::-1])) - options.cellSize) & (x > -10) & (x < 72)
	history = []
	while O.time < 2 + quake.time[-1] + 2:
		O.step()
		now = mpm.arrays()['pos'][:, 0] - start
		history.append((O.time, now[high].mean() - now[base]))
	return np.transpose(history)


def residual(blows):
	"""Strength over the vertical effective stress before (Idriss and Boulanger 2008)."""
	return min(np.exp(blows / 16 + ((blows - 16) / 21.2)**3 - 3), np.tan(np.radians(35)))


if options.record:
	velocity = np.loadtxt(options.record, skiprows=2)
	quakes = {'record': mpm.record([(0.02 * i, v) for i, v in enumerate(velocity[:900])], unit='m/s', quantity='velocity', filter=(0.1, 15))}
else: quakes = {f'seed {seed}': artificial(int(seed)) for seed in options.seeds.split()}
figure, (section, line) = plt.subplots(2, 1, figsize=(10, 5.2), height_ratios=[1, 1.3], layout='constrained')
ways = []
for name, quake in quakes.items():
	t, way = shaken(quake)
	ways.append(way[-1])
	print(f'{name}: rock {np.abs(quake.acceleration).max():.2f} m/s2, {np.abs(quake.velocity).max():.2f} m/s, Arias {quake.arias:.2f} m/s; the dam moves by {way[-1]:.2f} m downstream', flush=True)
	line.plot(t, way, label=name)
print(f'dam: {np.mean(ways):.2f} m, measured {measured:g} m ({100 * (np.mean(ways) / measured - 1):+.0f} %)')
compared('movement of the Upper San Fernando dam' + (', modified Pacoima record' if options.record else f', mean of {len(ways)} records'), np.mean(ways), measured, 'Seed et al. 1975, field', 'm')
mpm.plot('displacement', ax=section)
section.plot(*np.transpose(outline), 'k-', linewidth=0.8)
section.set(title='')
line.axhline(measured, color='k', linestyle='--', label='measured')
line.set(xlabel='time [s]', ylabel='movement downstream [m]', xlim=(0, None))
line.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'upper.png'), dpi=100)
