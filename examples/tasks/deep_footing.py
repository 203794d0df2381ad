#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A strip footing at a depth of 1 m in clay: what lies above its base is a load beside it. By hand: (2 + pi) c_u + gamma D (Prandtl)."""
import numpy as np
from yade import mpm
B, cu, above, cells = 2, 25e3, 18e3 * 1.0, 4
h = B / (2 * cells + 1)  # the footing ends in the middle between two nodes
width, depth = 14 * h, 9 * h
O.materials.append(MpmTrescaMat(young=1000 * cu, poisson=0.49, density=1800, undrainedStrength=cu, label='clay'))
grid = MpmGrid(cellSize=h)
clay = mpm.polygon([(0, -depth), (width, -depth), (width, 0), (0, 0)])
O.bodies.append(mpm.fill(clay, grid, 2, 'clay'))
beside = MpmTraction(surface=mpm.surface(clay, min=(0, 0), max=(width, 0)), pressure=above, curve=[(0, 0), (1, 1)])
footing = MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, inf), fix='xy', displacement=(0, -0.03 * B, 0))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=[*sides, footing], loads=[beside], loadCurve=[(1, 0), (2, 1)])
O.engines, O.dt = [solver], 1 / 12
O.run(24, wait=True)
found, hand = -solver.reactions[3][1] / (B / 2) + above, (2 + np.pi) * cu + above  # the load beside goes on below the footing
print(f'deep footing: {found / 1e3:.1f} kPa, by hand {hand / 1e3:.1f} kPa ({100 * (found / hand - 1):+.2f} %)')
