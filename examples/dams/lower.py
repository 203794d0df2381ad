#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The slide of the Lower San Fernando dam, 1971, after an earthquake had liquefied its upstream shell: run-out and what was left, predicted from blow counts.

	          fill  __
	 lake ~~~~~~~~_/  \\_          drained strength: fill, dikes, berm, downstream shell
	         _/ shell|core|shell\\__        residual strength: upstream shell, by blow counts of its layers (Idriss and Boulanger 2008); core
	      _/dike     |    |    dike  berm--__
	 ///////////////////////////////////////////   constrained

Measured: H. B. Seed, K. L. Lee, I. M. Idriss and F. I. Makdisi (1975): The slides in the San Fernando dams during the earthquake of February 9, 1971. J. Geotech. Engrg. Div. 101(7).
"""
import os
import sys
import numpy as np
from yade import mpm
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Slide of the Lower San Fernando dam.',
        cellSize=(2., 'h [m]'),
        blows=(0., '(N1)60cs of all of the upstream shell; 0: by layers'),
        factor=(1., 'of the residual strength of the shell'),
        core=(0.12, 'strength of the core over the vertical effective stress'),
        end=(30., 'latest time [s]'))
lake, foot, weight = 30.9, -101.7, 9810.  # height of the reservoir and upstream toe [m], above and along the base; of water [N/m3]
outline = [(foot, 0), (-40, 26), (-32.5, 29), (-4.8, 42), (1.8, 42), (31.5, 29.4), (40, 26), (46, 26), (104.9, 13.5), (168.4, 0)]
top = [-34, -22.2, -9, 9, 22.2, 34], [25.1, 23.2, 22.2, 22.2, 23.2, 25.1]  # of the hydraulic fill
layers = [(0, 3.5, 12.9), (3.5, 7.5, 27.7), (7.5, 10.5, 23.6), (10.5, 13.5, 10.8), (13.5, 30, 16.9)]  # of the shell: heights [m], (N1)60cs


def zone(p):
	"""Name of the material at a place."""
	x, y = p[0], p[1]
	if abs(x) < 20.1 - y / 2 and y < 22.2: return 'core'
	if -93.1 + 2.355 * y < x < 98.2 - 2.56 * y and y < np.interp(x, *top): return 'upstream' if x < 0 else 'downstream'
	if y < 26 and (x < -34 - (25.1 - y) * 2.36 or 34 < x < 108 - 2.63 * y): return 'dike'
	return 'berm' if x > 34 else 'fill'


def water(p):
	"""Pressure [Pa]: the lake and pores below it, and a table that falls through the core."""
	return weight * max(0, np.interp(p[0], (-20, 20, 108), (lake, 8, 0)) - p[1])


def residual(blows):
	"""Strength over the vertical effective stress before (Idriss and Boulanger 2008)."""
	return np.minimum(np.exp(blows / 16 + ((blows - 16) / 21.2)**3 - 3), np.tan(np.radians(35)))


grid = MpmGrid(cellSize=options.cellSize)
for name, density, angle in ('dike', 2140, 37), ('fill', 2090, 35), ('downstream', 1990, 35), ('berm', 2140, 40):
	O.materials.append(MpmMohrCoulombMat(label=name, young=60e6, poisson=0.3, density=density, cohesion=2e3, frictionAngle=radians(angle), dilationAngle=0))
for name in 'upstream', 'core': O.materials.append(MpmTrescaMat(label=name, young=60e6, poisson=0.3, density=1990, undrainedStrength=1e9))
O.bodies.append(mpm.fill(mpm.polygon(outline), grid, 2, zone))
common = dict(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], water=[MpmWater(pressure=water)], fBar=True, verbosity=0)
O.engines = [MpmImplicitEngine(**common)]
O.dt = 1 / 8
for _ in range(8): O.step()  # the dam as it stood

points = mpm.arrays()
material = np.array([O.bodies[int(i)].material.label for i in points['id']])
x, y = points['pos'][:, :2].T
before = np.maximum(-points['stress'][:, 1, 1], 5e3)
blows = np.select([(a <= y) & (y < b) for a, b, _ in layers], [n for *_, n in layers]) if options.blows == 0 else np.full(len(y), options.blows)
strength = np.where(material == 'core', options.core, options.factor * residual(blows)) * before
weak = np.isin(material, ('upstream', 'core'))
mpm.assign(ids=points['id'][weak], undrainedStrength=strength[weak])
print(f"{len(y)} points; residual strength of the shell {strength[material == 'upstream'].mean() / 1e3:.1f} kPa on average, of its layer of {10.8 if options.blows == 0 else options.blows:g} blows {strength[(material == 'upstream') & (10.5 < y) & (y < 13.5)].mean() / 1e3:.1f} kPa")

start = O.time
solver = MpmDynamicEngine(**common, gravityCurve=[(0, 1)], loadTime=O.time)
O.engines, O.dt = [solver], 0.05 * options.cellSize
history = []
while O.time - start < options.end:
	O.step()
	p = mpm.arrays()
	front = foot - (p['pos'] - p['halfSize'])[:, 0].min()
	history.append((O.time - start, front, np.linalg.norm(p['velocity'], axis=1).max(), solver.plotData()['kineticEnergy'], solver.plotData()['loadWork']))
	if len(history) > 50 and history[-1][3] < 5e-4 * history[-1][4]: break
p = mpm.arrays()
freeboard, front = (p['pos'] + p['halfSize'])[:, 1].max() - lake, history[-1][1]
t, fronts, speeds, *_ = np.array(history).T
print(f'slide: at rest after {t[-1]:.0f} s; toe moves by up to {speeds.max():.1f} m/s')
print(f'freeboard that is left: {freeboard:.1f} m, measured 1.5 m')
for what, ours, theirs in ('loss of height', 42 - lake - freeboard, 9.6), ('run-out beyond the toe', front, 61):
	print(f'{what}: {ours:.1f} m, measured {theirs:g} m ({100 * (ours / theirs - 1):+.0f} %)')
	compared(f'{what}, Lower San Fernando dam', ours, theirs, 'Seed et al. 1975, field', 'm')
figure, (section, line) = plt.subplots(2, 1, figsize=(10, 5.2), height_ratios=[1, 1.3], layout='constrained')
mpm.plot('displacement', ax=section)
section.plot(*np.transpose(outline), 'k-', linewidth=0.8, label='before')
section.plot((foot - 61, 20), (0.5, lake + 1.5), 'r^', label='measured: front, height that was left')
section.legend(*zip(*[pair for pair in zip(*section.get_legend_handles_labels()) if 'dots' not in pair[1]]), frameon=False, loc='upper right')
section.set(xlim=(-170, 175), ylim=(0, 45), title='')
line.plot(t, fronts, label='front beyond the toe [m]')
line.plot(t, speeds, label='largest speed [m/s]')
line.set(xlabel='time after the loss of strength [s]', xlim=(0, None), ylim=(0, None))
line.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'lower.png'), dpi=100)
