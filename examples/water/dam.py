#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Seepage through a dam of earth: phreatic line, discharge, and what a drain below it does for its downstream slope.

	        ___                         8 m high, slopes of 1:2, 7 m of water; base impervious
	 ~~~~/  dam \\___
	    /_______======\\                ====: horizontal drain

Against Dupuit's discharge of a rectangular dam, Kozeny's parabola of one with a drain below it, and for the sloping face the solution of potential_plane.py.

Run it with `scripts/run examples/water/dam.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from options import compared, readOptions
from style import plt
from potential_plane import discharge

options = readOptions('Seepage through a dam.',
        cellSize=(0.5, 'size of the cells [m]'),
        tolerance=(0.02, 'width of the bracket of the factor of safety; 1: none is looked for'))
k, g, gammaW, level = 1e-6, 10., 1e4, 7.
dam, upstream, downstream, drain = [(0, 0), (36, 0), (20, 8), (16, 8)], [(16, 8), (0, 0)], [(36, 0), (20, 8)], [(26, 0), (35, 0)]


def body(corners):
	"""Its engine, with sand that lets water through."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=5e7, poisson=0.3, density=2000, cohesion=5e3, frictionAngle=np.radians(28), conductivity=k, porosity=.4, label='fill'))
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon(corners), grid, 2, 'fill'))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], fBar=True, label='solver', verbosity=0)]
	O.dt = .1


def rectangular():
	body([(0, 0), (5, 0), (5, 4), (0, 4)])
	flow = mpm.seepage([([(0, 4), (0, 0)], 4), ([(5, 0), (5, 4)], 1)], unitWeight=gammaW)
	compared('discharge of a rectangular dam', flow.discharge[1] / k, (4**2 - 1) / 2 / 5, 'Dupuit 1863', 'm')
	print(f'rectangular: discharge {flow.discharge[1] / k:.4f} k m, Dupuit {15 / 10:.4f}; water comes out up to {flow.surface[-1][1]:.2f} m, 1 m of water before it')
	body([(0, 0), (16, 0), (16, 6), (0, 6)])
	flow = mpm.seepage([([(0, 6), (0, 0)], 5)], faces=[[(12, 0), (15.5, 0)]], unitWeight=gammaW)
	a = np.sqrt(12**2 + 5**2) - 12
	x, y = np.transpose([place for place in flow.surface if place[0] < 11.5])
	compared('discharge of a dam with a horizontal drain', flow.discharge[1] / k, a, 'Kozeny 1931', 'm')
	print(f'with a drain: discharge {flow.discharge[1] / k:.4f} k m, Kozeny {a:.4f}; the line is within {abs(y - np.sqrt(2 * a * (12 - x) + a * a)).max():.3f} m of the parabola')


def slope(faces):
	"""Phreatic line, and the factor of safety with it. Water stands before the one face only."""
	body(dam)
	flow = mpm.seepage([(upstream, level)], faces=faces, unitWeight=gammaW)
	solver.water = [MpmWater(pressure=flow.pressure, where='pores'), MpmWater(pressure=lambda x: gammaW * max(0, level - x[1]) if x[0] < 18 else 0, where='outside')]
	O.run(10, wait=True)
	F = np.nan
	if options.tolerance < 1:
		found = mpm.strengthReduction(tolerance=options.tolerance)
		F = (found['lower'] + found['upper']) / 2
	return flow, F


begin = time.time()
rectangular()
figure, axes = plt.subplots(2, 1, figsize=(10, 6.4), layout='constrained')
for ax, name, faces in (axes[0], 'without a drain', [downstream]), (axes[1], 'with a drain', [drain, downstream]):
	flow, F = slope(faces)
	mpm.plot('porePressure', ax=ax, range=(0, 70e3))
	ax.plot(*np.transpose(flow.surface), color='crimson', linewidth=1.8, label='free surface')
	ax.legend(loc='upper right', frameon=False)
	ax.set_title(f'{name}: {86.4e6 * sum(flow.discharge[1:]):.0f} l a day and metre, factor of safety {F:.2f}')
	print(f'{name}: discharge {sum(flow.discharge[1:]) / k:.3f} k m, F = {F:.3f}')
exact = discharge(drain[0][0], level, 2)
print(f'with a drain: in the plane of potential and stream function {exact:.3f} k m')
compared('discharge of a dam with a sloping face and a drain', sum(flow.discharge[1:]) / k, exact, 'potential_plane.py', 'm')
figure.savefig(os.path.join(options.out, 'dam.png'), dpi=100)
print(f'{time.time() - begin:.0f} s')
