#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""DEM grains are poured onto ground of material points, in one scene, and a plough moves through both: YADE moves the grains, which touch each other and the plough
by its laws and the ground by MpmContact; the ground is in equilibrium with them every N iterations of YADE.

When all has come to rest, the ground carries the weight of the grains. Then the plough, a clump of two spheres, sinks into the clay on its first decimetre and goes on level.

Run it with `scripts/run examples/grains_on_soil/grains_on_soil.py [options]`; --travel 0 is the grains alone, --grains 0 the plough alone.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Grains poured onto soil.',
        grains=(200, 'number of grains, of 10 cm; 0: the plough alone'),
        cell=(0.1, 'size of the cells of the ground [m]'),
        every=(25, 'iterations of YADE from one equilibrium of the ground to the next'),
        seconds=(3., 'that the grains have to come to rest'),
        travel=(0.5, 'of the plough [m]; 0: there is none'),
        sink=(0.03, 'of the plough into the ground [m]'),
        stiffness=(20., 'of the contact, over E / h'))
began = time.time()
length, width, depth, h, radius = 1.4, 0.6, 0.2, options.cell, 0.05
speed, share, above = 0.25, 0.12, 0.02  # speed of the plough [m/s], radius of its spheres [m], height at which it waits

O.materials.append(MpmVonMisesMat(young=2e6, poisson=0.3, density=1600, yieldStress=np.sqrt(2) * 1e4, label='ground'))  # clay, c_u = 10 kPa
O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2600, frictionAngle=radians(27), label='grain'))
O.materials.append(FrictMat(young=1e6, poisson=0.3, frictionAngle=0, label='glass'))  # rough walls would bear a part of the weight
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -depth), (length, width, 0)), grid, 2, 'ground'))

plough, members = None, []
if options.travel:
	spheres = [utils.sphere((0.25, y, share + above), share, material='grain', mask=3) for y in (width / 2 - share / 2, width / 2 + share / 2)]
	plough, members = O.bodies.appendClumped(spheres)
	O.bodies[plough].dynamic = False

# layers of grains above each other, and walls around them which only they touch: grains have the bits 1 and 2, walls 2,
# and the contact means 1
shake = np.random.default_rng(1)
rows = [int((size - 4 * radius) / (2.2 * radius)) for size in (length, width)]
grains, place = [], 0
while len(grains) < options.grains:
	layer, rest = divmod(place, rows[0] * rows[1])
	x, y = 3.1 * radius + 2.2 * radius * np.array(divmod(rest, rows[1])) + shake.uniform(-0.1, 0.1, 2) * radius
	place, z = place + 1, radius * (1.1 + 2.3 * layer)
	free = not members or min(np.linalg.norm(O.bodies[i].state.pos - Vector3(x, y, z)) for i in members) > share + radius
	if free: grains.append(O.bodies.append(utils.sphere((x, y, z), radius, material='grain', mask=3)))
for axis, end in enumerate((length, width)):
	for at, sense in (radius, 1), (end - radius, -1):
		O.bodies.append(utils.wall(at, axis=axis, sense=sense, material='glass', mask=2))

sides = [MpmBoundary(max=(inf, inf, -depth), fix='xyz')]
for axis, letter in enumerate('xy'):
	low, high = np.full(3, inf), np.full(3, -inf)
	low[axis], high[axis] = 0, (length, width)[axis]
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
if grains: print('time [s]  force on the ground over the weight  reaction of its base over the weight  fastest grain [m/s]  iterations')
parts = 12 if grains else 0
for part in range(parts):
	O.run(int(options.seconds / O.dt / parts), wait=True)
	onGround = -solver.plotData()['contact0_z']
	print(f'{O.time:.2f}  {-onGround / weight:.4f}  {solver.reactions[0][2] / weight:.4f}  {max(O.bodies[i].state.vel.norm() for i in grains):.4f}  {solver.iterations}')

def picture(name, shown):
	"""Section near the middle, of the ground and what stands on it."""
	ax = mpm.plot(shown, plane=('y', width / 2 + 0.02))  # not between two rows of points
	ax.figure.savefig(os.path.join(options.out, name + '.png'), dpi=110, bbox_inches='tight')
	print(f'written: {options.out}/{name}.png')


def fromGrains():
	"""Force of the grains on the plough [N]."""
	force = np.zeros(3)
	for member in members:
		for contact in O.bodies[member].intrs():
			if contact.isReal: force += (-1 if contact.id1 == member else 1) * np.array(contact.phys.normalForce + contact.phys.shearForce)
	return force


def fromGround():
	contact = solver.contacts[0]
	return np.array(contact.forces[contact.bodies.index(plough)])


def drive():
	"""Forces on the plough along its travel: (M, 7), travel [m], of the grains and of the ground [N]."""
	state, start, found = O.bodies[plough].state, O.bodies[plough].state.pos[0], []
	while state.pos[0] < start + options.travel:
		state.vel = (speed, 0, -speed * (options.sink + above) / 0.1 if state.pos[0] < start + 0.1 else 0)
		O.run(options.every, wait=True)
		found.append([state.pos[0] - start, *fromGrains(), *fromGround()])
	return np.array(found)


if grains:
	onPlough = -fromGrains()[2]
	print(f'reaction of the base over weight: {solver.reactions[0][2] / weight:.5f}, with what the plough bears: {(solver.reactions[0][2] + onPlough) / weight:.5f}; {time.time() - began:.0f} s')
	compared('weight of the grains on the base', (solver.reactions[0][2] + onPlough) / weight, 1, 'balance', 'weight')
	picture('grains_on_soil', 'stress_zz')
if options.travel:
	began = time.time()
	found = drive()
	print('travel [m]  against it [N]: of the grains  of the ground  upwards [N]: of the grains  of the ground')
	for part in np.array_split(found, min(len(found), 12)):  # means
		print('{:.3f}  {:.1f}  {:.1f}  {:.1f}  {:.1f}'.format(part[-1, 0], *(part[:, [1, 4, 3, 6]].mean(axis=0) * (-1, -1, 1, 1) + 0.)))
	print(f'{len(found)} equilibria, {time.time() - began:.0f} s')
	picture('plough', 'plasticStrain')
	figure, axis = plt.subplots(figsize=(7, 3.2), layout='constrained')
	for column, label in (1, 'grains'), (4, 'ground'):
		axis.plot(found[:, 0], -found[:, column], label=label)
	axis.set(xlabel='travel [m]', ylabel='force against the plough [N]')
	axis.legend(frameon=False)
	figure.savefig(os.path.join(options.out, 'force.png'), dpi=110)
	print(f'written: {options.out}/force.png')
