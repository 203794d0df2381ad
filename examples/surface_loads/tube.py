#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Thick elastic tube in plane strain under a pressure on its inner side, a quarter by symmetry, on a grid of squares that its round sides cut anyhow.

Closed form (Lame), at p / E = 1e-3, b = 2 a, Poisson's ratio 0.3: the inner side moves by u(a) = 1.906667e-3 a.

Run it with `scripts/run examples/surface_loads/tube.py [options]`.
"""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('Thick tube under inner pressure.', cells=(16, 'cells over the inner radius'), pointsPerCell=(2, 'material points per cell and axis'))

a, b, E, p, published = 1., 2., 1e6, 1e3, 1.906667e-3


def arc(radius, begin, end):
	return [(radius * np.cos(angle), radius * np.sin(angle)) for angle in np.linspace(begin, end, 101)]


inner, outer = arc(a, np.pi / 2, 0), arc(b, 0, np.pi / 2)  # together counterclockwise around the matter
O.materials.append(MpmElasticMat(young=E, poisson=0.3, density=1, label='tube'))
grid = MpmGrid(cellSize=a / options.cells)
O.bodies.append(mpm.fill(mpm.polygon(inner + outer), grid, options.pointsPerCell, 'tube'))
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')],
                loads=[MpmTraction(surface=inner, pressure=p)],
                newton=MpmNewton(tolerance=1e-8),
                label='solver'
        )
]
O.dt = 1
O.run(1, wait=True)
surface = solver.loads[0].surface
moved = np.linalg.norm(surface.vertices, axis=1) - np.linalg.norm(surface.initialVertices, axis=1)
print(f'h = a / {options.cells}: {len(O.bodies)} material points, {solver.iterations} iterations')
print(f'u(a) / a: {moved.mean() / a:.6e}, Lame {published:.6e} ({100 * (moved.mean() / a / published - 1):+.2f} %), along the side +- {100 * moved.std() / moved.mean():.2f} %')
compared(f'widening of a thick tube cut by the grid, {options.cells} cells', moved.mean() / a, published, 'Lame', 'a')
mpm.plot('displacement', fileName=os.path.join(options.out, 'tube.png'))
print(f'written: {options.out}/tube.png')
