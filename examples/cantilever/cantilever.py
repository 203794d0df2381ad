#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Elastic cantilever that a load at its tip bends until the tip points down: large rotations without plasticity.

	 o|                              | P     length L = 10 m, thickness T = 0.5 m
	 >|==============================v       E = 12 MPa, Poisson's ratio 0, weightless
	 o|                                      P L^2 / (E I) grows from 0 to 10, straight down
	  held along x; at half the thickness along y

Published: tip of the elastica, an inextensible beam without shear, by elliptic integrals (K. Mattiasson (1981): Numerical results
from large deflection beam and frame problems analysed by means of elliptic integrals. Int. J. Numer. Meth. Eng. 17(1)).

Run it with `scripts/run examples/cantilever/cantilever.py [options]`, or by yade-batch with the options as columns of a parameter
table. Read examples/column first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Elastic cantilever with large rotations.',
        cells=(4, 'cells over the thickness, an even number'),
        pointsPerCell=(2, 'material points per cell and axis'),
        steps=(40, 'load steps, a multiple of 10'),
        ghostFactor=(1e-2, 'ghost stabilisation'))

L, T, E, end = 10., 0.5, 12e6, 10.
h = T / options.cells
bending = E * T**3 / 12
published = {1: (0.30172, 0.05643), 2: (0.49346, 0.16064), 5: (0.71379, 0.38763), 10: (0.81061, 0.55500)} # load: tip down, tip back, over L

O.materials.append(MpmElasticMat(young=E, poisson=0, density=1, label='beam'))
grid = MpmGrid(cellSize=h)
beam = mpm.polygon([(0, -T / 2), (L, -T / 2), (L, T / 2), (0, T / 2)])
O.bodies.append(mpm.fill(beam, grid, pointsPerCell=options.pointsPerCell, material='beam'))
points = mpm.arrays()
tip = np.flatnonzero(points['pos0'][:, 0] > L - h / options.pointsPerCell) # the last points: they share the load
for i in points['id'][tip]:
	O.bodies[int(i)].state.force = (0, -end * bending / L**2 / len(tip), 0)

O.engines = [
        MpmImplicitEngine(
                grid=grid,
                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(0, 0, -inf), max=(0, 0, inf), fix='y')],
                ghost=MpmGhost(factor=options.ghostFactor),
                label='solver',
        ),
        PyRunner(iterPeriod=1, initRun=True, command='record()'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'cantilever-'), iterPeriod=max(1, options.steps // 10)),
]
O.dt = 1 / options.steps
history = [(0, 0, 0)]


def record():
	"""Load P L^2 / (E I), and how far the middle of the tip has moved down and back, over L."""
	points = mpm.arrays()
	moved = (points['pos0'] - points['pos'])[tip].mean(axis=0) / L
	history.append((solver.loadFactor * end, moved[1], moved[0]))


begin = time.time()
O.run(options.steps, wait=True)
load, down, back = np.array(history).T
print(f'h = T / {options.cells}: {len(O.bodies)} material points, {solver.dofs} unknowns, {O.iter} of {options.steps} load steps in {time.time() - begin:.1f} s')
for k, (w, u) in published.items():
	found = [np.interp(k, load, values) for values in (down, back)]
	print(f'P L^2 / (E I) = {k:2}: tip down {found[0]:.5f} L, elastica {w:.5f} L ({100 * (found[0] / w - 1):+.2f} %); '
	      f'back {found[1]:.5f} L, elastica {u:.5f} L ({100 * (found[1] / u - 1):+.2f} %)')
	compared(f'tip of the beam, down, {options.cells} cells, P L^2 / (E I) = {k}', found[0], w, 'Mattiasson 1981', 'L')
	compared(f'tip of the beam, back, {options.cells} cells, P L^2 / (E I) = {k}', found[1], u, 'Mattiasson 1981', 'L')

figure, (shape, curve) = plt.subplots(1, 2, figsize=(9.5, 4.6), width_ratios=[1, 1.3], layout='constrained')
mpm.plot('stress_xx', ax=shape)
shape.set(title=f'$P L^2 / (E I) = {end:g}$')
for values, row, label, colour in (down, 0, 'down', 'C0'), (back, 1, 'back', 'C1'):
	curve.plot(values, load, color=colour, label=f'tip {label}')
	curve.plot([published[k][row] for k in published], list(published), 'o', color=colour, label=f'elastica, {label}')
curve.set(xlabel='movement of the tip / L [-]', ylabel='load $P L^2 / (E I)$ [-]', xlim=(0, 0.9), ylim=(0, None))
curve.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'cantilever.png'), dpi=130)
print(f'written: {options.out}/cantilever.png, and for ParaView {options.out}/cantilever-points.pvd')
