#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Half of an analysis, saved; the rest from the file. By hand: nothing changes, to the last bit."""
from yade import mpm
O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)]), grid, 2, 'soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides)], 1 / 8
O.run(4, wait=True)
mpm.save('half.yade.gz')
O.run(4, wait=True)
whole = mpm.arrays()
O.load('half.yade.gz')
O.run(4, wait=True)
again = mpm.arrays()
off = max(abs(whole[name] - again[name]).max() for name in ('pos', 'stress', 'plasticStrain'))
found, hand = again['pos'][:, 1].max(), whole['pos'][:, 1].max()
print(f'restart: height {found:.6f} m, without a stop {hand:.6f} m ({100 * (found / hand - 1):+.2f} %), largest difference {off:g}')
