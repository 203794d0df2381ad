#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""DEM grains are poured onto ground of material points, in one scene: YADE moves the grains, which touch each other by its laws and the ground by
MpmContact; the ground is in equilibrium with them every N iterations of YADE.

When all has come to rest, the ground carries the weight of the grains.

Run it with `scripts/run examples/grains_on_soil/grains_on_soil.py [options]`; four seconds of 200 grains take a minute.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Grains poured onto soil.',
        grains=(200, 'number of grains, of 10 cm'),
        every=(25, 'iterations of YADE from one equilibrium of the ground to the next'),
        seconds=(4., 'that are simulated'),
        stiffness=(20., 'of the contact, over E / h'))
began = time.time()
width, depth, h, radius = 0.8, 0.3, 0.1, 0.05

O.materials.append(MpmElasticMat(young=2e6, poisson=0.2, density=1600, label='ground'))
O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2600, frictionAngle=radians(27), label='grain'))
O.materials.append(FrictMat(young=1e6, poisson=0.3, frictionAngle=0, label='glass'))  # rough walls would bear a part of the weight
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -depth), (width, width, 0)), grid, 2, 'ground'))

# layers of grains above each other, and walls around them which only they touch: grains have the bits 1 and 2, walls 2, and the contact means 1
perSide = int((width - 4 * radius) / (2.2 * radius))
shake = np.random.default_rng(1).uniform(-0.1, 0.1, (options.grains, 2)) * radius
grains = []
for i in range(options.grains):
	column, layer = i % perSide**2, i // perSide**2
	x, y = (2 * radius + 1.1 * radius + 2.2 * radius * np.array([column % perSide, column // perSide]) + shake[i])
	grains.append(O.bodies.append(utils.sphere((x, y, radius * (1.1 + 2.3 * layer)), radius, material='grain', mask=3)))
for axis in 0, 1:
	for at, sense in (0.5 * h, 1), (width - 0.5 * h, -1):
		O.bodies.append(utils.wall(at, axis=axis, sense=sense, material='glass', mask=2))

sides = [MpmBoundary(max=(inf, inf, -depth), fix='xyz')]
for axis, letter in enumerate('xy'):
	low, high = np.full(3, inf), np.full(3, -inf)
	low[axis], high[axis] = 0, width
	sides += [MpmBoundary(max=low, fix=letter), MpmBoundary(min=high, fix=letter)]
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
        MpmImplicitEngine(
                grid=grid,
                boundaries=sides,
                contacts=[MpmContact(mask=1, friction=radians(25), stiffness=options.stiffness)],
                iterPeriod=options.every,
                verbosity=0,
                label='solver'
        ),  # its forces act on the grains: before NewtonIntegrator, behind ForceResetter
        NewtonIntegrator(gravity=(0, 0, -10), damping=0.5),
]
O.dt = 2e-4

weight = 10 * sum(O.bodies[i].state.mass for i in grains)
print(f'{len(grains)} grains that weigh {weight:.1f} N, {len(mpm.arrays()["id"])} material points; O.dt of the grains alone could be {utils.PWaveTimeStep():.1e} s')
print('time [s]  force on the ground over the weight  reaction of its base over the weight  fastest grain [m/s]  iterations')
parts = 12
for part in range(parts):
	O.run(int(options.seconds / O.dt / parts), wait=True)
	onGround = -solver.plotData()['contact0_z']
	print(f'{O.time:.2f}  {-onGround / weight:.4f}  {solver.reactions[0][2] / weight:.4f}  {max(O.bodies[i].state.vel.norm() for i in grains):.4f}  {solver.iterations}')
print(f'reaction of the base over weight: {solver.reactions[0][2] / weight:.5f}; {time.time() - began:.0f} s')

ax = mpm.plot('stress_zz', plane=('y', width / 2))
ax.figure.savefig(os.path.join(options.out, 'grains_on_soil.png'), dpi=110, bbox_inches='tight')
print(f'written: {options.out}/grains_on_soil.png')
