#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A smooth retaining wall moves away from dry sand until its pressure is that of sand that has yielded. By hand: K_A = (1 - sin phi) / (1 + sin phi) (Rankine)."""
import numpy as np
from yade import mpm
H, L, phi, gamma, cells = 5, 20, np.radians(30), 2e4, 10
h = H / cells
O.materials.append(MpmMohrCoulombMat(young=2e8, poisson=0.3, density=gamma / 10, cohesion=0, frictionAngle=phi, dilationAngle=phi, label='sand'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, 2, 'sand'))
wall = MpmBoundary(max=(0, inf, inf), fix='x', displacement=(-0.4 * h, 0, 0))  # nodes push or pull by half a cell; a Box goes any way
sides = [wall, MpmBoundary(min=(L, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=sides, fBar=True)
O.engines, O.dt = [solver], 1 / 10
mpm.geostatic(K0=1 - np.sin(phi))  # at rest at first
O.run(10, wait=True)
found, hand = abs(solver.reactions[0][0]) / (gamma * H**2 / 2), (1 - np.sin(phi)) / (1 + np.sin(phi))
print(f'retaining wall: K = {found:.3f}, by hand {hand:.3f} ({100 * (found / hand - 1):+.2f} %)')
