#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A pit in flooded ground, dug out and pumped dry in three stages before an anchored sheet pile. By hand: free earth support with Rankine's pressures, and a head that falls evenly along the wall."""
import os
import numpy as np
from yade import mpm
phi, c, gamma, gammaW, top, depth, foot, head = radians(35), 2e3, 2e4, 1e4, 14, 4.5, 8.5, 1
O.materials.append(MpmMohrCoulombMat(young=3e7, poisson=0.3, density=gamma / 10, cohesion=c, frictionAngle=phi, conductivity=1e-4, label='sand'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (32, 0), (32, top), (0, top)]), grid, 2, 'sand'))
anchor = MpmReinforcement(line=[(18, top - head), (8, top - head), (3, top - head)], axialStiffness=5e7, freeLength=9.5, bond=2e5, bondStiffness=1e8)
wall = MpmBeam(line=[(18, top), (18, top - foot)], axialStiffness=3e9, bendingStiffness=2e8, adhesion=0, fixFoot='y', anchors=[anchor])
water = MpmWater(pressure=lambda x: gammaW * max(0, top - x[1]))  # up to the surface, until it is pumped
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(32, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], water=[water], verbosity=0)
O.engines, O.dt = [solver], 0.25
mpm.geostatic(0.5)
solver.loads = [wall]
for dug in 1.5, 3, depth:
	mpm.stages.excavate(mpm.polygon([(18, top - dug), (32, top - dug), (32, 20), (18, 20)]), steps=4)  # the pit is full of water
	O.run(4, wait=True)
	flow = mpm.seepage([([(18, top), (0, top)], top), ([(32, top - dug), (18, top - dug)], top - dug)], unitWeight=gammaW)
	water.pressure = flow.pressure  # the pit is dry
	O.run(2, wait=True)
	print(f'{dug} m dug: anchor {anchor.axialForces[0] / 1e3:.1f} kN, moment {np.abs(wall.moments).max() / 1e3:.1f} kN m, {1e3 * flow.discharge[1]:.3f} l/s to be pumped')
os.makedirs('out', exist_ok=True)
mpm.diagram(wall, 'moment', mpm.plot('porePressure'), 3).figure.savefig('out/pit_under_water.png')
z, i, K = np.linspace(0, foot, 4001), depth / (2 * foot - depth), np.tan(np.pi / 4 - phi / 2)**2
below, atBack, before = np.maximum(z - depth, 0), gammaW * (1 - i) * z, gammaW * (1 + i) * np.maximum(z - depth, 0)
pushes = np.maximum(0, K * (gamma * z - atBack) - 2 * c * np.sqrt(K)) + atBack - before
holds = ((gamma * below - before) / K + 2 * c / np.sqrt(K)) * (z > depth)
net = pushes - holds * (pushes * (z - head)).sum() / (holds * (z - head)).sum()
force = net.sum() * z[1]
moment = np.abs(np.cumsum(np.cumsum(net) * z[1] - force * (z >= head)) * z[1]).max()
print(f'anchor: {anchor.axialForces[0] / 1e3:.1f} kN, by hand {force / 1e3:.1f} kN')
print(f'pit under water: moment = {np.abs(wall.moments).max() / 1e3:.1f} kNm, by hand {moment / 1e3:.1f} kNm')
