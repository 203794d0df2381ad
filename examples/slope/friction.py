#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope of slope.py in frictional soil (Mohr-Coulomb) that keeps its volume, psi = 0, so that the stiffness is not symmetric: steps, cuts, iterations.

	soil: c = 4 kPa, phi = 16 degrees; weak layer: c = 1.5 kPa, phi = 8 degrees; E = 10 MPa

Run it with `scripts/run examples/slope/friction.py [options]`, or by yade-batch with friction.table. Read slope.py first.
"""
import os
import sys
import time

from yade import mpm
import matplotlib
matplotlib.use('Agg')
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Slope failure in frictional soil with a weak layer.',
        cellSize=(1., 'h [m]'),
        pointsPerCell=(2, 'material points per cell and axis'),
        ghostFactor=(1e-2, 'ghost stabilisation; 0 switches it off'),
        fBar=(0, '1: with F-bar'),
        steps=(40, 'load steps'))

common = dict(young=1e7, poisson=0.3, density=2400, dilationAngle=0)
O.materials.append(MpmMohrCoulombMat(cohesion=4e3, frictionAngle=np.radians(16), label='soil', **common))
O.materials.append(MpmMohrCoulombMat(cohesion=1.5e3, frictionAngle=np.radians(8), label='weak', **common))
grid = MpmGrid(cellSize=options.cellSize)
profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
O.bodies.append(mpm.fill(profile, grid, pointsPerCell=options.pointsPerCell, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, -9.81, 0),
                boundaries=[
                        MpmBoundary(max=(0, inf, inf), fix='x'),
                        MpmBoundary(min=(30, -inf, -inf), fix='x'),
                        MpmBoundary(max=(inf, 0, inf), fix='xy'),
                ],
                ghost=MpmGhost(factor=options.ghostFactor),
                fBar=bool(options.fBar),
                label='solver',
        ),
]
O.dt = 1 / options.steps
begin = time.time()
iterations = cuts = parts = 0
outcome = 'completes'
try:
	for _ in range(options.steps):
		O.step()
		iterations, cuts, parts = iterations + solver.iterations, cuts + solver.cuts, parts + solver.substeps
except RuntimeError as error:
	iterations, cuts, parts = iterations + solver.iterations, cuts + solver.cuts, parts + solver.substeps
	outcome = f'ends at load factor {solver.loadFactor:.3f}'
	print(error)

points = mpm.arrays()
u = points['pos'] - points['pos0']
crest = np.argmin(np.linalg.norm(points['pos0'][:, :2] - (10, 12), axis=1))
print(f'h = {options.cellSize:g} m, {options.pointsPerCell} x {options.pointsPerCell} points per cell, ghost factor {options.ghostFactor:g}: {len(u)} material points, {solver.dofs} unknowns')
print(f'{outcome}: {O.iter} of {options.steps} steps, {parts} parts after {cuts} cuts, {iterations} iterations, {time.time() - begin:.1f} s')
print(f'crest moves by {np.linalg.norm(u[crest]):.3f} m, settles by {-u[crest, 1]:.3f} m; largest displacement {np.linalg.norm(u, axis=1).max():.3f} m')
mpm.plot('plasticStrain', range=(0, 0.5), fileName=os.path.join(options.out, 'friction.png'))
