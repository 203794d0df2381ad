#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Three layers of fill on clay, one after the other. By hand: q H / M, with the weight q of the fill and the modulus M of the clay in one direction."""
from yade import mpm
M, density, g = 1e7, 2000, 10
for label in ('clay', 'fill'):
	O.materials.append(MpmElasticMat(young=M, poisson=0, density=density, label=label))
grid = MpmGrid(cellSize=0.5)
block = lambda low, high: mpm.polygon([(0, low), (1, low), (1, high), (0, high)])
O.bodies.append(mpm.fill(block(-5, 0), grid, 2, 'clay'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(1, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -5, inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), gravityCurve=[(0, 1)], boundaries=sides)
O.engines, O.dt = [solver], 1
mpm.geostatic()
top = mpm.arrays()['pos'][:, 1].argmax()
for n in range(3):
	mpm.stages.place(mpm.fill(block(0.5 * n, 0.5 * n + 0.5), grid, 2, 'fill'), steps=2)
	O.run(2, wait=True)
points = mpm.arrays()
found, hand = points['pos0'][top, 1] - points['pos'][top, 1], density * g * 1.5 * (5 - 0.125) / M
print(f'layers: settlement {1e3 * found:.3f} mm, by hand {1e3 * hand:.3f} mm ({100 * (found / hand - 1):+.2f} %)')
