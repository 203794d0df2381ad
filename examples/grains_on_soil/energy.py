#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy of DEM grains and soil in one scene: grains are thrown onto clay, collide, roll and leave ruts, and all of their energy is found again.

YADE counts what grains have and lose among themselves, the plugin what the soil takes, what friction on it dissipates, and what the penalties of contact and the discretisation take. What is missing in the sum is lost in the exchange of forces.

Run it with `scripts/run examples/grains_on_soil/energy.py [options]`.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Energy of grains thrown onto soil.',
        cell=(0.1, 'size of the cells of the ground [m]'),
        rows=(2, 'grains across the ground'),
        every=(10, 'iterations of YADE from one time step of the ground to the next'),
        seconds=(0.6, 'of the motion'),
        speed=(2., 'of the grains along the ground [m/s]'),
        friction=(25., 'of grains on the soil [degrees]'),
        stiffness=(20., 'of the contact, over E / h'))
began, h, radius, g = time.time(), options.cell, 0.12, 10.
length, width, depth = 1.6, 0.4 * options.rows, 0.3

O.materials.append(MpmVonMisesMat(young=2e6, poisson=0.3, density=1600, yieldStress=np.sqrt(2) * 1e4, label='ground'))  # clay, c_u = 10 kPa
O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2600, frictionAngle=radians(27), label='grain'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -depth), (length, width, 0)), grid, 2, 'ground'))
for point in O.bodies: point.groupMask = 4
grains = []
for row in range(options.rows):
	for x, z, speed in (0.3, 0.3, options.speed), (0.6, 0.15, 0.4 * options.speed):  # the first of a row overtakes the other
		grains.append(utils.sphere((x, (row + 0.5) * width / options.rows, z), radius, material='grain', mask=1))
		grains[-1].state.vel = (speed, 0.2 * (-1)**row, 0)
O.bodies.append(grains)
mass = np.array([grain.state.mass for grain in grains])

sides = [MpmBoundary(max=(inf, inf, -depth), fix='xyz')]
for axis, letter in enumerate('xy'):
	low, high = np.full(3, inf), np.full(3, -inf)
	low[axis], high[axis] = 0, (length, width)[axis]
	sides += [MpmBoundary(max=low, fix=letter), MpmBoundary(min=high, fix=letter)]
law = Law2_ScGeom_FrictPhys_CundallStrack()
solver = MpmDynamicEngine(grid=grid, boundaries=sides, contacts=[MpmContact(mask=1, friction=radians(options.friction), stiffness=options.stiffness)], iterPeriod=options.every, initRun=False, verbosity=0)
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [law]),
        solver,
        NewtonIntegrator(gravity=(0, 0, -g), damping=0, mask=1),
]
O.dt, O.trackEnergy = 1e-4, True


def height():
	return np.array([grain.state.pos[2] for grain in grains])


def energies():
	"""Energy by where it is [J]; in sum what the grains have had and what their weight has worked."""
	data = solver.plotData()
	return {
	        'grains, kinetic': sum(mass * [grain.state.vel.squaredNorm() / 2 for grain in grains]) + sum(grain.state.inertia[0] * grain.state.angVel.squaredNorm() / 2 for grain in grains),
	        'contact of grains: elastic': law.elasticEnergy(),
	        'contact of grains: friction': dict(O.energy.items()).get('plastDissip', 0),
	        'friction on the soil': data['frictionWork'],
	        'penalties of that contact': data['penaltyWork'],
	        'soil, plastic': data['plasticWork'],
	        'soil, elastic and kinetic': data['elasticEnergy'] + data['kineticEnergy'],
	        'stabilisation and time scheme': data['ghostWork'] + data['gridWork'] + data['impactWork'],
	}


first, start = sum(mass * [grain.state.vel.squaredNorm() / 2 for grain in grains]), height()
times, given, taken = [], [], []
while O.time < options.seconds:
	O.run(200, wait=True)
	times.append(O.time), given.append(first + g * mass @ (start - height())), taken.append(list(energies().values()))
times, given, taken = map(np.array, (times, given, taken))
names = list(energies())
print(f'{len(grains)} grains with {first:.1f} J, {len(mpm.arrays()["id"])} material points; energy put in {given[-1]:.1f} J')
for name, energy in zip(names, taken[-1]): print(f'{name}: {100 * energy / given[-1]:.2f} %')
found = taken.sum(axis=1) / given
print(f'found again: {found[-1]:.4f} of it at the end, {found.min():.4f} to {found.max():.4f} on the way; soil alone off by {solver.plotData()["energyImbalance"] / given[-1]:.1e}; {time.time() - began:.0f} s')
compared(f'energy of grains thrown onto soil found again, cells of {h:g} m', found[-1], 1, 'balance', 'given')
figure, ax = plt.subplots(figsize=(8, 4), layout='constrained')
ax.stackplot(times, taken.T, labels=names, linewidth=0, colors=['C0', 'C1', 'C2', 'C3', 'C4', 'C5', '0.6', '0.85'])
ax.plot(times, given, 'k', label='put in')
ax.set(xlabel='time [s]', ylabel='energy [J]', xlim=(0, times[-1]), ylim=(0, None))
ax.legend(frameon=False, bbox_to_anchor=(1, 0.5), loc='center left')
figure.savefig(os.path.join(options.out, 'energy.png'), dpi=100)
print(f'written: {options.out}/energy.png')
