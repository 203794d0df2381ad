#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Column of soft elastic soil that its own weight compresses to half its height: section 4.1 of

	W.M. Coombs (2023): A ghost-stabilised material point method for large deformation geotechnical analysis. NUMGE 2023.

	o|   |o     height l0 = 50 m, E = 10 kPa, Poisson's ratio 0, unit weight b = 800 N/m3, in 40 load steps
	o|   |o     one cell wide; rollers left and right, and at the base
	o|___|o     exact: sigma_yy = -b (l0 - Y) at the initial height Y
	  o o

Run it with `scripts/run examples/column/column.py [options]`, or by yade-batch with the options as columns of a parameter table.
It prints the error of the stress (eq. 7 of the paper) and the height beside the exact one, and draws stress against depth.
"""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Elastic column under its own weight (Coombs 2023, section 4.1).',
        cells=(16, 'cells over the height'),
        pointsPerCell=(2, 'material points per cell and axis'),
        ghostFactor=(1e-2, 'ghost stabilisation; 0 switches it off'),
        scaling=('mesh-independent', "of the ghost stabilisation: 'mesh-independent' or 'paper'"),
        dim=(2, '2, or 3 for a column of cubes'))

l0, E, b, steps = 50., 1e4, 800., 40
h = l0 / options.cells

O.materials.append(MpmElasticMat(young=E, poisson=0, density=80, label='soil'))
grid = MpmGrid(cellSize=h, dim=options.dim)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (h, l0, h)), grid, pointsPerCell=options.pointsPerCell, material='soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
if options.dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, h), fix='z')]
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, -10, 0),
                boundaries=sides,
                ghost=MpmGhost(factor=options.ghostFactor, scaling=options.scaling),
                newton=MpmNewton(tolerance=1e-9, predictor=False, reuseFactor=False),  # same settings as in the paper; with predictor and reuseFactor half the factorisations
                label='solver',
        ),
        PyRunner(iterPeriod=1, initRun=True, command='solves.append(solver.iterations)'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'column-'), iterPeriod=4),
]
O.dt = 1 / steps
solves = []
O.run(steps, wait=True)

points = mpm.arrays()
depth = l0 - points['pos0'][:, 1]
stress = points['stress'][:, 1, 1]
error = np.mean(np.abs(stress + b * depth)) / (b * l0)  # eq. 7; all points have the same initial volume

## exact height: with s = b l0 / E and Lambert's W(s), W exp(W) = s, it is (l0 / s) (W + W^2 / 2)
s, W = b * l0 / E, 1.
for _ in range(50):
	W -= (W * np.exp(W) - s) / ((1 + W) * np.exp(W))
height = l0 / s * (W + W * W / 2)
top = (points['pos'] + points['halfSize'])[:, 1].max()

reference = {  # results of independent implementations of the same method: cells -> without ghost, paper's scaling, mesh-independent
        8: (1.29408206e-2, 9.64276631e-3, 1.12729015e-2),
        16: (3.65890602e-3, 3.01201409e-3, 3.35234265e-3),
        32: (1.04870581e-3, 9.86432725e-4, 1.01301122e-3),
        64: (4.35723724e-4, 4.01470630e-4, 3.97129009e-4),
}
print(f'{options.cells} cells, {len(depth)} material points, {solver.dofs} unknowns, {O.iter} of {steps} load steps')
print(f'iterations per step, mean (max): {np.mean(solves) + 1:.2f} ({max(solves) + 1})')
print(f'stress error (eq. 7): {error:.8e}', end='')
kind = 0 if options.ghostFactor == 0 else 1 if options.scaling == 'paper' else 2
known = options.cells in reference and options.pointsPerCell == 2 and options.ghostFactor in (0, 1e-2)
print(f', reference: {reference[options.cells][kind]:.8e}' if known else '')
print(f'height: {top:.4f} m, exact: {height:.4f} m')
if known: compared(f'stress error of the column, {options.cells} cells', error, reference[options.cells][kind], 'independent implementations')
compared(f'height of the column, {options.cells} cells', top, height, 'closed form, large strains', 'm')

figure, axes = plt.subplots(figsize=(4.5, 5.5))
order = np.argsort(depth)
axes.plot(-b * depth[order] / 1e3, depth[order], 'k-', linewidth=1, label='exact')
axes.plot(stress / 1e3, depth, '.', markersize=4, label='material points')
axes.set(xlabel='vertical stress $\\sigma_{yy}$ [kPa]', ylabel='initial depth [m]', ylim=(l0, 0), title=f'Column, {options.cells} cells')
axes.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'column.png'), dpi=150, bbox_inches='tight')
print(f'written: {options.out}/column.png, and for ParaView {options.out}/column-points.pvd')
