#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Slope failure of an elasto-plastic soil with a weak layer: section 4.2 of

	W.M. Coombs (2023): A ghost-stabilised material point method for large deformation geotechnical analysis. NUMGE 2023.

	A _________ B            A (0, 12), B (10, 12), C (15, 7), D (30, 7) [m]
	 |         \\             gravity grows from 0 to 9.81 m/s2 in 40/h steps
	o|          \\            rollers left and right, the base is held
	o|===========\\ C_______ D
	o|           weak       |o
	o|                      |o
	 /////////////////////////

Run it with `scripts/run examples/slope/slope.py [options]`, or by yade-batch with the options as columns of a parameter table.
It prints the number of iterations beside those of the paper (table 1) and writes to the folder --out a picture of the deformed
slope and files for ParaView.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Slope failure with a weak layer (Coombs 2023, section 4.2).',
        cellSize=(1., 'h [m]; the load comes in 40/h steps'),
        pointsPerCell=(2, 'material points per cell and axis'),
        ghostFactor=(1e-2, 'ghost stabilisation; 0 switches it off'),
        domains=('stretch', "rule of the points' domains: 'stretch', as in the paper, or 'tiling', the default of the engine"))
h, steps = options.cellSize, round(40 / options.cellSize)

## the soil, as material points
O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=7.5e3, label='weak'))
grid = MpmGrid(cellSize=h)
profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
O.bodies.append(mpm.fill(profile, grid, pointsPerCell=options.pointsPerCell, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))

## gravity in equal steps: O.time is the load factor
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, -9.81, 0),
                boundaries=[
                        MpmBoundary(max=(0, inf, inf), fix='x'),
                        MpmBoundary(min=(30, -inf, -inf), fix='x'),
                        MpmBoundary(max=(inf, 0, inf), fix='xy'),
                ],
                domains=options.domains,
                ghost=MpmGhost(factor=options.ghostFactor),
                newton=MpmNewton(tolerance=1e-6, maxIterations=20, predictor=False, reuseFactor=False),  # same settings as in the paper; with predictor and reuseFactor half the factorisations
                label='solver',
        ),
        PyRunner(iterPeriod=1, initRun=True, command='solves.append(solver.iterations)'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'slope-'), iterPeriod=max(1, steps // 10)),
]
O.dt = 1 / steps
solves = []

film = mpm.view(os.path.join(options.out, 'slope.html'), ['plasticStrain', 'stress_xy'], every=max(1, steps // 10), range={'stress_xy': (-12e3, 12e3), 'plasticStrain': (0, 0.8)})
begin = time.time()
O.run(steps, wait=True)
seconds = time.time() - begin
film.finish()

## numbers beside the paper's (which counts a first pass without solve as an iteration)
published = {(1, 2): '5.50 (7)', (1, 3): '5.48 (6)', (1, 4): '5.53 (7)', (.5, 2): '5.55 (7)', (.5, 3): '5.49 (7)', (.5, 4): '5.48 (7)',
             (.25, 2): '5.94 (8)', (.25, 3): '5.85 (8)', (.25, 4): '5.83 (7)'}
points = mpm.arrays()
displacement = np.linalg.norm(points['pos'] - points['pos0'], axis=1)
print(f'h = {h:g} m, {options.pointsPerCell} x {options.pointsPerCell} points per cell: {len(displacement)} material points, {solver.dofs} unknowns')
print(f'load steps completed: {O.iter} of {steps} in {seconds:.1f} s')
print(f'iterations per step, mean (max): {np.mean(solves) + 1:.2f} ({max(solves) + 1})', end='')
print(f', paper: {published[h, options.pointsPerCell]}' if options.ghostFactor == 1e-2 and (h, options.pointsPerCell) in published else '')
if options.ghostFactor == 1e-2 and (h, options.pointsPerCell) in published:
	compared(f'iterations a step of the slope, h = {h:g} m, {options.pointsPerCell} x {options.pointsPerCell} points', np.mean(solves) + 1, published[h, options.pointsPerCell].split()[0], 'Coombs 2023, table 1')
print(f'largest displacement: {displacement.max():.6f} m')
print(f'crest (0, 12) settles by {-(points["pos"] - points["pos0"])[np.lexsort((points["pos0"][:, 0], -points["pos0"][:, 1]))[0], 1]:.4f} m')

## the deformed domains, coloured by shear stress and, beside it, by the plastic strain, which shows where it slips
figure, (stress, slip) = plt.subplots(2, 1, figsize=(8.4, 7.2), sharex=True, layout='constrained')
mpm.plot('stress_xy', ax=stress, range=(-12e3, 12e3))
mpm.plot('plasticStrain', ax=slip, range=(0, 0.8))
stress.set(title=f'Shear stress in the slope at load factor {solver.loadFactor:g} (gravity 9.81 m/s²)', xlabel='')
slip.set(title='Plastic strain at the same load: where it has slipped')

weak = points['material'] == O.materials.index('weak')
height = points['pos0'][:, 1]
for axes in stress, slip:
	axes.plot([0, 10, 15, 30], [12, 12, 7, 7], 'k--', linewidth=0.8, label='initial surface')
	for row, side in (height[weak].min(), -1), (height[weak].max(), 1):
		edge = np.flatnonzero(weak & (np.abs(height - row) < 1e-6))
		edge = edge[np.argsort(points['pos0'][edge, 0])]
		along = points['pos'] + side * points['defGrad'][:, :, 1] * points['halfSize0'][:, 1:2]  # middle of the upper or lower side of each domain
		axes.plot(*along[edge, :2].T, 'k', linewidth=1.2, label='weak layer' if side == 1 else None)
	axes.legend(frameon=False, loc='upper right')
figure.savefig(os.path.join(options.out, 'slope.png'), dpi=150, bbox_inches='tight')
print(f'written: {options.out}/slope.png, for the browser {options.out}/slope.html, and for ParaView {options.out}/slope-points.pvd')
