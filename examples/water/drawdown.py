#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A reservoir that is drawn down in time before a bank, and may rise again: pressures in the soil and the factor of safety as the water takes its time to leave.

	o|_____________
	o|             \\     ~~~~~~~ falls from the crest to the toe         left: rollers, impervious; base held, impervious
	o|      bank     \\
	 //////////////////

The bank is that of water.py (2:1, H = 10 m, phi = 20 degrees, psi = 0) with c = 20 kPa, so that it stands. There pressures are given: those of a level that falls ever so slowly, or those of the full reservoir kept. Here they are
computed with the displacements (MpmFlow): soil that is unloaded expands and draws the water along, and what is left flows out of the slope. How long the drawdown takes is compared with H2 / c_v, in which
the bank consolidates.

Run it with `scripts/run examples/water/drawdown.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A reservoir that is drawn down in time.',
        cells=(10, 'over the height of the slope'),
        durations=('0.01,1,1000', 'of the drawdown, over H2 / c_v'),
        levels=(4, 'parts of the drawdown, after each of which the factor is looked for'),
        steps=(5, 'time steps of each part'),
        tolerance=(0.02, 'width of the bracket of the factor of safety'))
H, run, crest, g, gammaW = 10., 20., 12., 10., 1e4
E, nu, k = 1e8, 0.3, 1e-8
cv = k / gammaW * E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


def full():
	"""The bank under water up to its crest, in equilibrium; nothing flows yet."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=E, poisson=nu, density=2000, cohesion=20e3, frictionAngle=np.radians(20), conductivity=k, porosity=.4, label='soil'))
	grid = MpmGrid(cellSize=H / options.cells)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (crest + run, 0), (crest, H), (0, H)]), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), boundaries=sides, water=[MpmWater(level=H, weight=gammaW)], fBar=True, label='solver', verbosity=0)]
	O.dt = 1 / 10
	O.run(10, wait=True)


def factor(suction):
	"""Factor of safety with the pressures of now; without suction where that is not counted on. The scene is as before after it."""
	kept = os.path.join(options.out, 'drawn.yade.gz')
	O.save(kept)
	points = mpm.arrays()
	if not suction: mpm.assign(excessPressure=points['excessPressure'] - np.minimum(points['porePressure'], 0))
	found = mpm.strengthReduction(tolerance=options.tolerance)
	O.load(kept)
	return (found['lower'] + found['upper']) / 2


def drawn(duration):
	"""Rows of level, mean of the pressures in the soil over those of the full reservoir, and the factor of safety without and with suction."""
	full()
	before, h = mpm.arrays()['porePressure'].mean(), H / options.cells  # a toe so thin is not filled to its end
	begin, whole = O.time, duration * H**2 / cv
	levels = [(begin, H), (begin + whole, 0)]
	solver.water = [MpmWater(level=H, weight=gammaW, where='pores'), MpmWater(levels=levels, weight=gammaW, where='outside')]
	solver.flow = MpmFlow(unitWeight=gammaW, drains=[MpmDrain(surface=[(crest + run - h, h * H / run), (crest, H)], levels=levels)])
	rows = []
	for part in range(options.levels):
		O.dt = whole / options.levels / options.steps
		O.run(options.steps, wait=True)
		level = H * (1 - (part + 1) / options.levels)
		rows.append((level, mpm.arrays()['porePressure'].mean() / before, factor(False), factor(True)))
		print(f'in {duration:g} H2/cv, level {level:.2f} m: pressures {rows[-1][1]:.3f} of the full ones, F = {rows[-1][2]:.3f}, with suction {rows[-1][3]:.3f}; {mpm.arrays()["excessPressure"].min() / 1e3:.0f} kPa')
	return rows


def slow(level):
	"""The factor where pores always have the pressure of the level."""
	full()
	solver.water = [MpmWater(level=level, weight=gammaW)]
	solver.loadCurve = [(0, 0), (1, 1), (2, 1)]
	O.step()
	found = mpm.strengthReduction(tolerance=options.tolerance)
	return (found['lower'] + found['upper']) / 2


begin = time.time()
durations = [float(text) for text in options.durations.split(',')]
figure, axes = plt.subplots(1, 2, figsize=(12, 4.8), layout='constrained', gridspec_kw=dict(width_ratios=(1, 1.3)))
for n, duration in enumerate(durations):
	rows = np.array(drawn(duration))
	axes[0].plot(rows[:, 0] / H, rows[:, 2], 'o-', color=f'C{n}', label=f'in {duration:g} $H^2/c_v$')
	axes[0].plot(rows[:, 0] / H, rows[:, 3], 'x:', color=f'C{n}', markersize=8, zorder=3)
	if n == len(durations) // 2:
		mpm.plot('porePressure', ax=axes[1])
		axes[1].set_title(f'pore pressure, drawn down in {duration:g} $H^2/c_v$')
given = np.array([(level, slow(level)) for level in rows[:, 0]])
for (level, F), (_, _, ours, _) in zip(given, rows):
	print(f'level {level:.2f} m: F = {F:.3f} where the pressure is that of the level')
	if durations[-1] >= 100: compared(f'factor of safety drawn down slowly, level {level:g} m', ours, F, 'MpmWater of that level')
axes[0].plot(given[:, 0] / H, given[:, 1], 'k--', label='pressure of the level')
axes[0].plot([], [], 'x:', color='0.4', label='the same with suction')
axes[0].set(xlabel='water level over height of the bank [-]', ylabel='factor of safety [-]')
axes[0].legend(loc='lower center', bbox_to_anchor=(.5, 1), ncol=2, frameon=False)
figure.savefig(os.path.join(options.out, 'drawdown.png'), dpi=110)
print(f'{time.time() - begin:.0f} s')
