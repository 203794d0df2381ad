#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A rough square footing on clay in 3D, a quarter of it. Published: 5.86 c_u (Gourvenec, Randolph and Kingsnorth 2006)."""
from yade import mpm
B, cu, cells = 2, 1e4, 3
h = B / 2 / (cells + 0.5)  # the footing ends in the middle between two nodes
width, depth = 9 * h, 6 * h
O.materials.append(MpmTrescaMat(young=1e4 * cu, poisson=0.3, density=2000, undrainedStrength=cu, label='clay'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0), (width, 0, width)), grid, 2, 'clay'))
footing = MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, B / 2), fix='xyz', displacement=(0, -0.008 * B, 0))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(max=(inf, -depth, inf), fix='xyz')]
sides += [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=[*sides, footing])
O.engines, O.dt = [solver], 1 / 8
O.run(8, wait=True)
found, hand = -4 * solver.reactions[-1][1] / (B**2 * cu), 5.86
print(f'square footing: N_c = {found:.3f}, published {hand} ({100 * (found / hand - 1):+.1f} %)')
