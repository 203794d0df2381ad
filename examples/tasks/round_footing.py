#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A rough circular footing on clay, as a plane problem around the axis. Published: 6.05 c_u (Cox, Eason and Hopkins 1961)."""
from yade import mpm
R, cu, cells = 1, 1e4, 5
h = R / (cells + 0.5)  # the footing ends in the middle between two nodes
width, depth = 17 * h, 11 * h
O.materials.append(MpmTrescaMat(young=1e4 * cu, poisson=0.3, density=2000, undrainedStrength=cu, label='clay'))
grid = MpmGrid(cellSize=h, axisymmetric=True)
O.bodies.append(mpm.fill(mpm.polygon([(0, -depth), (width, -depth), (width, 0), (0, 0)]), grid, 2, 'clay'))
footing = MpmBoundary(min=(-inf, 0, -inf), max=(R, 0, inf), fix='xy', displacement=(0, -0.004 * R, 0))
sides = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=[*sides, footing])
O.engines, O.dt = [solver], 1 / 12
O.run(12, wait=True)
found, hand = -solver.reactions[2][1] / (pi * R**2 * cu), 6.05
print(f'round footing: N_c = {found:.3f}, published {hand} ({100 * (found / hand - 1):+.1f} %)')
