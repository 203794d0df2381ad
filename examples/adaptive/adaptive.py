#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A smooth footing on undrained clay, pressed down as a Box of YADE, with small cells at its edge only (`MpmGrid.adaptation`) beside small cells everywhere.

	axis       v                  E = 500 c_u, nu = 0.49, von Mises, plane strain, F-bar
	 |#########|_______________
	 |                         |o    half of the footing, B = 1 m; rollers at 3 B, base at 2.5 B
	 |          clay           |o
	 |_________________________|o    N_c = 2 + pi at a settlement of 0.02 B (L. Prandtl 1921)
	  //////////////////////////

Run it with `scripts/run examples/adaptive/adaptive.py [options]`. Read examples/penetration first.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A footing with small cells at its edge.',
        cells=(4, 'cells over half the width of the footing, before they are halved'),
        halvings=(3, 'most halvings at the edge'),
        uniform=(2, 'times that all cells are halved for comparison'),
        depth=(0.03, 'settlement at the end, as a part of the width'))

B, cu, exact = 1., 1e4, 2 + np.pi


def footing(cells, halvings):
	O.reset()
	grid = MpmGrid(cellSize=B / 2 / cells, adaptation=[MpmAdaptation(halvings=halvings)] if halvings else [])
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.49, density=1800, yieldStress=np.sqrt(2) * cu, label='clay'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -2.5 * B, -1), (3 * B, 0, 1)), grid, 2, 'clay'))
	box = O.bodies[O.bodies.append(utils.box((0, 2 * B, 0), (B / 2, 2 * B, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -options.depth * B, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(3 * B, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -2.5 * B, inf), fix='xy')]
	contact = MpmContact(friction=0)
	solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=sides, contacts=[contact], newton=MpmNewton(minStep=1 / 64), label='solver')
	steps = int(np.ceil(200 * options.depth))
	O.engines, O.dt = [solver], 1 / steps
	began, settlement, N = time.process_time(), [], []
	for _ in range(steps):
		O.step()
		settlement.append(2 * B - box.state.pos[1])
		N.append(2 * contact.forces[0][1] / (B * cu))
	seconds, found = time.process_time() - began, np.interp(0.02 * B, settlement, N)
	print(f'{cells:5d}  {halvings:8d}  {solver.dofs:8d}  {seconds:7.2f}  {found:.3f}  {100 * (found / exact - 1):+.2f} %')
	return seconds, found, solver


print('cells  halvings  unknowns  time/s  N_c    above 2 + pi')
uniform = [footing(options.cells * 2**k, 0)[:2] for k in range(options.uniform + 1)]
runs = [footing(options.cells, halvings) for halvings in range(1, options.halvings + 1)]
compared(f'footing by contact, N_c at 0.02 B, {2 * options.cells} cells over the width, halved {options.halvings} times at the edge', runs[-1][1], exact, 'Prandtl 1921')

figure, (left, right) = plt.subplots(1, 2, figsize=(13, 5.5))
mpm.plot('plasticStrain', grid=True, loads=False, ax=left)
left.plot([0, B / 2, B / 2], [-options.depth * B, -options.depth * B, B], 'k', label='footing')
left.set(xlim=(0, 1.2 * B), ylim=(-0.8 * B, 0.25 * B), title='')
for found, label, marker in (uniform, 'all cells halved', 'o-'), (uniform[:1] + [run[:2] for run in runs], 'cells at the edge halved', 's--'):
	right.loglog([seconds for seconds, _ in found], [100 * (N / exact - 1) for _, N in found], marker, label=label)
ticks = 3, 4, 5, 6, 8, 10
right.set(xlabel='processor time [s]', ylabel='error of the load at 0.02 B [%]', ylim=(2.5, 12), yticks=ticks, yticklabels=ticks)
right.minorticks_off()
right.grid(alpha=0.3)
right.legend()
figure.tight_layout()
figure.savefig(os.path.join(options.out, 'adaptive.png'), dpi=110)
