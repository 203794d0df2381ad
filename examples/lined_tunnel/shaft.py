#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A shaft around its axis: the lining, a shell of revolution, is put into elastic ground at rest, and the ground in it is dug out in stages, down to three quarters of its depth. Far from floor and surface its hoop force is that of a tube in a plane that is pressed by the stress at rest."""
import os
import sys
from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Lined shaft.', cellSize=(0.5, '[m]'), K0=(0.5, 'horizontal over vertical stress at rest'), thickness=(0.4, 'of the lining of concrete [m]'))
h, R, dug, wall, width, base = options.cellSize, 3, 12, 16, 30, 30
young, nu, density, concrete, of = 5e7, 0.3, 2000, 30e9, 0.2
O.materials.append(MpmElasticMat(young=young, poisson=nu, density=density, label='ground'))
grid = MpmGrid(cellSize=h, axisymmetric=True)
O.bodies.append(mpm.fill(mpm.polygon([(0, -base), (width, -base), (width, 0), (0, 0)]), grid, 2, 'ground'))
t = options.thickness
lining = MpmBeam(line=[(R, 0), (R, -wall)], axialStiffness=concrete * t / (1 - of**2), bendingStiffness=concrete * t**3 / 12 / (1 - of**2), poisson=of, adhesion=0, fixFoot='y')
held = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -base, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0)
O.engines, O.dt = [solver], 1
mpm.geostatic(K0=options.K0)
solver.loads = [lining]
O.run(1, wait=True)
mpm.stages.excavate(lambda x, pad=0: x[0] < R and x[1] > -dug, steps=4)
O.run(4, wait=True)
depths, half = -np.array([x[1] for x in lining.vertices]), dug / 2
found = np.interp(half, (depths[1:] + depths[:-1]) / 2, lining.hoopForces)  # force at the centres of the segments
soil, ring = young / (1 + nu) / R, lining.axialStiffness * (1 - of**2) / R**2
expected = -options.K0 * density * 10 * half * R / (1 + soil / ring)
print(f'hoop force at half of what is dug {found / 1e3:.1f} kN/m, of a tube {expected / 1e3:.1f} kN/m ({100 * (found / expected - 1):+.1f} %); largest moment {max(map(abs, lining.moments)) / 1e3:.2f} kN m/m')
compared(f'hoop force at half of what is dug, cells of {h:g} m', found, expected, 'tube in a pressed plane', 'N/m')
figure, axes = plt.subplots(1, 2, figsize=(9, 5), layout='constrained')
for ax, (quantity, title) in zip(axes, dict(hoopForce='hoop force', moment='moment').items()):
	mpm.diagram(lining, quantity, mpm.plot('displacement', ax=ax, loads=False), 1.5).set(xlim=(-7, 10), ylim=(-20, 0.5), title=title)
figure.savefig(f'{options.out}/shaft.png')
