#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope of examples/slope, whose soil slides on a weak layer, with small cells where the deformation varies (`MpmGrid.adaptation`, where='error') beside small cells everywhere.

	A _________ crest (10, 12)
	 |         \\             von Mises; gravity grows from 0 to 9.81 m/s2
	o|          \\            rollers left and right, the base is held
	o|===========\\ _______
	o|           toe (15, 7)|o
	 /////////////////////////

Run it with `scripts/run examples/adaptive/slip.py [options]`. Read examples/slope first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A slope with small cells where the deformation varies.',
        cellSize=(0.25, 'h of the smallest cells [m]'),
        halvings=(1, 'times that cells are halved; those of the start are so much larger'),
        steps=(160, 'load steps'))


def slope(halvings):
	"""Points at the end, processor time of the run [s] and unknowns of the last step."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=7.5e3, label='weak'))
	grid = MpmGrid(cellSize=options.cellSize * 2**halvings, adaptation=[MpmAdaptation(halvings=halvings, where='error')] if halvings else [])
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	O.bodies.append(mpm.fill(profile, grid, 2, lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, label='solver')
	O.engines, O.dt = [solver], 1 / options.steps
	began = time.process_time()
	O.run(options.steps, wait=True)
	return mpm.arrays(), time.process_time() - began, solver.dofs


def moved(points, place):
	"""Mean displacement of the soil that was within 0.5 m of a place [m]."""
	near = (np.abs(points['pos0'] - (*place, 0))[:, :2] < 0.5).all(axis=1)
	return np.average((points['pos'] - points['pos0'])[near, :2], axis=0, weights=points['volume'][near])


uniform, longer, most = slope(0)
adapted, shorter, fewer = slope(options.halvings)
print(f'all cells of {options.cellSize:g} m: {most} unknowns, {len(uniform["pos"])} points, {longer:.1f} s; where the deformation varies: {fewer} unknowns, {len(adapted["pos"])} points, {shorter:.1f} s, {shorter / longer:.2f} of the time')
for name, place in ('crest', (10, 12)), ('toe', (15, 7)):
	a, b = moved(adapted, place), moved(uniform, place)
	print(f'{name} moves by ({a[0]:.4f}, {a[1]:.4f}) m, with small cells everywhere by ({b[0]:.4f}, {b[1]:.4f}) m: {100 * np.linalg.norm(a - b) / np.linalg.norm(b):.2f} % off')
	compared(f'displacement of the {name}, cells of {options.cellSize:g} m where the deformation varies', np.linalg.norm(a), np.linalg.norm(b), 'the same cells everywhere')

figure, axes = plt.subplots(figsize=(11, 5))
mpm.plot('plasticStrain', grid=True, loads=False, ax=axes, range=(0, 1))
axes.set(xlim=(0, 30), ylim=(0, 13))
figure.tight_layout()
figure.savefig(os.path.join(options.out, 'slip.png'), dpi=110)
