#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A dam of earth through the life of its reservoir: built, filled, with steady seepage, and drawn down in a day; the factor of safety of each stage, and of the time after it.

	               ____           12 m high, slopes of 1:2.5 (--upstream) and 1:2, base impervious
	 ~~~~~~~~~ 10 /    \\
	        /            \\
	 _____/________________\\____

Water stands before one face. Pressures of steady seepage are those of mpm.seepage; from them on they are computed with the displacements (MpmFlow), while the level falls and after it, until the dam is as it was when it was built: its
factor of safety is then that of the beginning.

Run it with `scripts/run examples/water/reservoir.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A dam and its reservoir.',
        cellSize=(1., 'size of the cells [m]'),
        upstream=(2.5, 'run over rise of the face before which the water stands; of 1.75 it governs as the water is drawn down'),
        days=(1., 'in which the reservoir is drawn down'),
        tolerance=(0.02, 'width of the bracket of the factor of safety'))
k, g, gammaW, level, day = 1e-7, 10., 1e4, 10., 86400.
toe = 30 - 12 * options.upstream
upstream, downstream = [(30, 12), (toe, 0)], [(60, 0), (36, 12)]
# a toe so thin is not filled to its end
wet, out = [(30, 12), (toe + .5 * options.upstream, .5)], [(59, .5), (36, 12)]


def onFace(height):
	return lambda x: gammaW * max(0, height - x[1]) if x[0] < 33 else 0


def factor(name):
	"""Factor of safety, without suction, which is not counted on. The scene is as before after it."""
	kept, water = os.path.join(options.out, 'stage.yade.gz'), solver.water
	O.save(kept)
	if solver.flow:
		points = mpm.arrays()
		mpm.assign(excessPressure=points['excessPressure'] - np.minimum(points['porePressure'], 0))
	found = mpm.strengthReduction(tolerance=options.tolerance)
	O.load(kept)
	solver.water = water  # functions are not saved
	F = (found['lower'] + found['upper']) / 2
	print(f'{name}: F = {F:.3f}, crest at {max(b.state.pos[1] for b in O.bodies):.4f} m')
	return F


def build():
	O.materials.append(MpmMohrCoulombMat(young=5e7, poisson=0.3, density=2000, cohesion=1e4, frictionAngle=np.radians(32), conductivity=k, porosity=.4, label='fill'))
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon([(toe, 0), (60, 0), (36, 12), (30, 12)]), grid, 2, 'fill'))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], fBar=True, label='solver', verbosity=0)]
	flow = mpm.seepage([(upstream, level)], faces=[downstream], unitWeight=gammaW)  # through the dam as it is drawn
	O.dt = 1 / 4
	O.run(4, wait=True)
	solver.gravityCurve = solver.loadCurve = [(0, 1)]
	return flow


def fill(flow):
	"""Water presses on the face, and the core is still dry; then it seeps through, as steadily as it ever will."""
	O.dt = 1 / 10
	solver.water = [MpmWater(pressure=onFace(level), where='outside', curve=[(1, 0), (2, 1)])]
	O.run(10, wait=True)
	factors.append(('filled', factor('filled, the core dry')))
	solver.water = [MpmWater(pressure=onFace(level), where='outside', curve=[(0, 1)]), MpmWater(pressure=flow.pressure, where='pores', curve=[(2, 0), (3, 1)])]
	O.run(10, wait=True)
	factors.append(('steady', factor('steady seepage')))


def drawDown(flow):
	"""In time, from given pressures to those over still water, which are the same; then it waits. Curve of times [days] and levels [m], and largest pressure left of the full ones."""
	begin, whole = O.time, options.days * day
	fall = [(begin, level), (begin + whole, 0)]
	points = mpm.arrays()
	pressure = np.array([flow.pressure(x) for x in points['pos'].tolist()])
	solver.water = [MpmWater(level=level, weight=gammaW, where='pores'), MpmWater(pressure=lambda x: onFace(np.interp(O.time + O.dt, *np.transpose(fall)))(x), where='outside')]
	mpm.assign(excessPressure=pressure - gammaW * (level - points['pos'][:, 1]))
	solver.flow = MpmFlow(unitWeight=gammaW, drains=[MpmDrain(surface=wet, levels=fall), MpmDrain(surface=out, level=0)])
	O.dt = whole / 8
	for part in range(2):
		O.run(4, wait=True)
		factors.append((f'level {level * (1 - part) / 2:g} m', factor(f'drawn down to {level * (1 - part) / 2:g} m, {(O.time - begin) / day:.2f} days')))
	mpm.plot('porePressure', ax=axes[1], range=(-60e3, 90e3))
	axes[1].set_title('pore pressure, drawn down within ' + ('a day' if options.days == 1 else f'{options.days:g} days'))
	for days in 9, 90, 2900:
		for dt in np.full(4, days / 4):
			O.dt = dt * day
			O.step()
		factors.append((f'{(O.time - begin) / day:.0f} days', factor(f'{(O.time - begin) / day:.0f} days after it began, pressures up to {mpm.arrays()["porePressure"].max() / 1e3:.1f} kPa')))


begin = time.time()
figure, axes = plt.subplots(3, 1, figsize=(9, 9), layout='constrained')
flow, factors = build(), []
factors.append(('built', factor('built')))
fill(flow)
mpm.plot('porePressure', ax=axes[0], range=(-60e3, 90e3))
axes[0].plot(*np.transpose(flow.surface), color='crimson', linewidth=1.8, label='water table')
axes[0].legend(loc='upper right', frameon=False)
axes[0].set_title(f'pore pressure, steady seepage of {86.4e6 * flow.discharge[1]:.1f} l a day and metre')
drawDown(flow)
compared('factor of safety of a dam long after its reservoir is gone', factors[-1][1], factors[0][1], 'the same dam before there was one')
names, values = zip(*factors)
axes[2].bar(names, values, color='steelblue')
axes[2].bar_label(axes[2].containers[0], fmt='%.2f')
axes[2].set(ylabel='factor of safety [-]', ylim=(0, 1.15 * max(values)))
figure.savefig(os.path.join(options.out, 'reservoir.png'), dpi=100)
print(f'{time.time() - begin:.0f} s')
