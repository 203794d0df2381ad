#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A shallow tunnel in soft ground: the lining is put in, the ground in it dug out in stages, the lining contracts by the volume loss, and the surface settles. In ground without change of volume the trough has the volume that is lost."""
import os
import sys
from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Lined tunnel.', cellSize=(0.5, '[m]'), volumeLoss=(0.01, 'part of the area of the tunnel'), poisson=(0.495, "Poisson's ratio of the ground"))
h, R, depth, width, base = options.cellSize, 2.5, 7.5, 30, 20
ring = [(R * np.sin(a), R * np.cos(a) - depth) for a in np.linspace(0, np.pi, 49)]  # half of it, from crown to invert
ring[0], ring[-1] = (0, R - depth), (0, -R - depth)
O.materials.append(MpmElasticMat(young=2e7, poisson=options.poisson, density=2000, label='ground'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(mpm.polygon([(0, -base), (width, -base), (width, 0), (0, 0)]), grid, 2, 'ground'))
lining = MpmBeam(line=ring, axialStiffness=1e10, bendingStiffness=5e7, fixHead='xr', fixFoot='xr', contraction=options.volumeLoss, curve=[(0, 0), (5, 0), (9, 1)])
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -base, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0, fBar=True)
O.engines, O.dt = [solver], 1
mpm.geostatic(K0=1)
solver.loads = [lining]
O.run(1, wait=True)
mpm.stages.excavate(lambda x, pad=0: np.hypot(x[0], x[1] + depth) < R, steps=4)
O.run(4, wait=True)
mpm.stages.resetDisplacements()
O.run(4, wait=True)  # contracts
points = mpm.arrays()
row = lambda y: np.flatnonzero(np.abs(points['pos0'][:, 1] + y) < h / 4)
upper, lower = ((points['pos0'] - points['pos'])[row(k * h)][np.argsort(points['pos0'][row(k * h), 0]), 1] for k in (.25, .75))
trough, lost = (1.5 * upper - 0.5 * lower).sum() * h, options.volumeLoss * np.pi * R**2  # volumes of both halves, at the surface
print(f'trough {trough:.4f} m2, volume loss {lost:.4f} m2 ({100 * (trough / lost - 1):+.2f} %); it is {1e3 * upper[0]:.1f} mm deep')
compared(f'volume of the trough, cells of {h:g} m, nu = {options.poisson:g}', trough, lost, 'volume loss', 'm2')
figure, axes = plt.subplots(1, 3, figsize=(14, 5.2), layout='constrained')
for ax, (quantity, title) in zip(axes, dict(axialForce='normal force', shearForce='shear force', moment='moment').items()):
	mpm.diagram(lining, quantity, mpm.plot('displacement', ax=ax, loads=False), 1.5).set(xlim=(-6, 9), ylim=(-12, 0.2), title=title)
figure.savefig(f'{options.out}/lined_tunnel.png')
