#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A deep tunnel in elastic ground, whose lining takes less and less of the stress that was there (below a surface: dug out after mpm.geostatic, by mpm.stages.excavate). By hand: its wall moves in by (1 + nu) / E (p0 - p) R (Kirsch)."""
import numpy as np
from yade import mpm
R, size, E, nu, p0, released, cells = 3, 30, 1e8, 0.3, 5e5, 0.8, 6
arc = [(R * np.cos(a), R * np.sin(a)) for a in np.linspace(np.pi / 2, 0, 33)]
O.materials.append(MpmElasticMat(young=E, poisson=nu, density=2000, label='ground'))
grid = MpmGrid(cellSize=R / cells)
O.bodies.append(mpm.fill(mpm.polygon(arc + [(size, 0), (size, size), (0, size)]), grid, 2, 'ground'))  # a quarter
mpm.assign(stress=[-p0 * np.eye(3)] * len(O.bodies))  # stress before the tunnel was there
lining = MpmTraction(surface=arc, pressure=p0)
low, high = MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')  # symmetry
far = [MpmBoundary(min=(size, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, size, -inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, boundaries=[low, high, *far], loads=[lining], loadCurve=[(0, 1), (1, 1 - released)])
O.engines, O.dt = [solver], 1 / 4
O.run(4, wait=True)
wall = lining.surface
moved = np.linalg.norm(wall.initialVertices, axis=1) - np.linalg.norm(wall.vertices, axis=1)
found, hand = moved.mean(), (1 + nu) / E * released * p0 * R
print(f'tunnel: wall moves in = {1e3 * found:.3f} mm, by hand {1e3 * hand:.3f} mm ({100 * (found / hand - 1):+.2f} %)')
