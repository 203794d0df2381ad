#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A tyre of rubber on clay, in plane strain, both of points: it sinks in under its weight, and is then turned on the spot, as if what it pulls did not give way.

	       ___
	     /     \\         four nodes on the upright through the hub are moved to the sides, so that
	    |   o   |        it turns; nothing holds it up
	 ____\\     /____     the clay sticks to the tyre up to its strength c_u
	       ‾‾‾
	 clay

What the contact does to it must be in balance with its weight and with what turns it. And a rigid wheel (a Sphere of YADE, by MpmContact) that goes as deep as the lowest place of the tyre, and is turned
as the hub is, says what a tyre that does not give way would bear. Time is there to keep what is not held yet from falling: steps of half a second are slow for it.

Run it with `scripts/run examples/meeting/tyre.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
from math import atan, cos, inf, pi, radians, sin

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A tyre of rubber on clay.',
        cells=(8, 'over the radius'),
        young=(2e6, 'of the rubber [Pa]'),
        load=(4., 'weight of the tyre over c_u R'),
        turn=(45., 'of the hub [degrees]'),
        steps=(20, 'in which the weight comes; of the turn there are twice as many'),
        stepSize=(0.5, 'of time [s], slow enough for forces to be in balance'))
R, cu, n = 0.4, 20e3, options.steps
h, weight = R / options.cells, options.load * cu * R


def start(contact, held=[]):
	"""Clay, and what is on it; weight comes in the first part."""
	O.materials.append(MpmTrescaMat(young=200 * cu, poisson=0.4, density=1800, undrainedStrength=cu, label='clay'))
	O.bodies.append(mpm.fill(mpm.polygon([(-2.5 * R, -1.5 * R), (2.5 * R, -1.5 * R), (2.5 * R, 0), (-2.5 * R, 0)]), grid, 2, 'clay', body='clay'))
	sides = [MpmBoundary(max=(inf, -1.5 * R, inf), fix='xy'), MpmBoundary(max=(-2.5 * R, inf, inf), fix='x'), MpmBoundary(min=(2.5 * R, -inf, -inf), fix='x')]
	end = 3 * n * options.stepSize
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 0), (end / 3, 1)], loadCurve=[(0, 0), (end, end)], boundaries=[*held, *sides], contacts=[contact], fBar=True, beta=0.5, gamma=1, verbosity=0)
	O.engines, O.dt = [solver], options.stepSize
	return solver


def run(move, look):
	"""move(step, angle) before each step, and what look() says after all of them."""
	found = []
	for step in range(3 * n):
		move(step, radians(options.turn) / (2 * n) * (step >= n))
		O.step()
		found.append(look())
	return np.array(found).T


grid, contact = MpmGrid(cellSize=h), MpmBodyContact(between=('tyre', 'clay'), friction=atan(5), adhesion=cu)
O.materials.append(MpmElasticMat(young=options.young, poisson=0.45, density=weight / 9.81 / (pi * R**2), label='rubber'))
O.bodies.append(mpm.fill(mpm.polygon([(R * cos(a), R + R * sin(a)) for a in np.arange(16 * options.cells) * 2 * pi / (16 * options.cells) - pi / 2]), grid, 2, 'rubber', body='tyre'))
heights, volume = np.array([-4, -2, 2, 4]) * options.cells // 8 * h + R, mpm.arrays()['volume']
hub = [MpmBoundary(min=(-h / 4, y - h / 4, -inf), max=(h / 4, y + h / 4, inf), fix='x') for y in heights]
solver = start(contact, hub)
centre = lambda: np.average(mpm.arrays()['pos'][:len(volume)], axis=0, weights=volume)


def turnHub(step, angle):
	for node, y in zip(hub, heights): node.displacement = (sin(angle) * (y - centre()[1]) / O.dt, 0, 0)


def look():
	held, (x, y, _), (right, up, _) = np.array([solver.reactions[i][0] for i in range(len(hub))]), centre(), contact.force
	return -min(v[1] for v in grid.bodies[0].vertices), right, up, contact.moment[2] - x * up + y * right, -held.sum(), held @ (heights - y), R - y


sank, pull, borne, torque, pulled, given, deep = run(turnHub, look)
figure, (picture, curves) = plt.subplots(1, 2, figsize=(11, 4.2), width_ratios=[1.5, 1], layout='constrained')
mpm.plot('plasticStrain', ax=picture, loads=False, range=(0, 0.5))
weight = 9.81 * O.materials[0].density * volume.sum()  # weight of its points

O.reset()
grid, contact = MpmGrid(cellSize=h), MpmContact(mask=2, friction=atan(5), adhesion=cu, stiffness=10)
O.materials.append(FrictMat(label='rigid'))
wheel = O.bodies[O.bodies.append(utils.sphere((0, R, 0), R, material='rigid', mask=2, fixed=True))]
solver = start(contact)


def drive(step, angle):
	wheel.state.vel, wheel.state.angVel = (0, -np.diff(sank, prepend=0)[step] / O.dt, 0), (0, 0, -angle / O.dt)


wheelPull, wheelBorne, wheelTorque = run(drive, lambda: (*list(contact.forces[0])[:2], contact.torques[0][2]))
late = slice(2 * n, None)  # the second half of the turn
print(f'sinkage under the weight {sank[n - 1] / R:.4f} R, turned {sank[-1] / R:.4f} R; of the hub {deep[n - 1] / R:.4f} and {deep[-1] / R:.4f} R')
print(f'under the weight, {weight / 1e3:.2f} kN/m: the contact bears {borne[n - 1] / 1e3:.2f} kN/m, a rigid wheel as deep {wheelBorne[n - 1] / 1e3:.2f} kN/m')
print(f'turned: it bears {borne[late].mean() / 1e3:.2f} kN/m, the rigid wheel {wheelBorne[late].mean() / 1e3:.2f} kN/m')
print(f'torque of the contact {torque[late].mean():.0f} N m/m, of what turns the hub {given[late].mean():.0f} N m/m, of the rigid wheel {wheelTorque[late].mean():.0f} N m/m')
print(f'pull of the contact {pull[late].mean():.0f} N/m, of what holds the hub {pulled[late].mean():.0f} N/m, of the rigid wheel {wheelPull[late].mean():.0f} N/m')
compared('what clay bears of a tyre', borne[n - 1], weight, 'its weight', 'N/m')
compared('torque of clay on a tyre', torque[late].mean(), given[late].mean(), 'what turns its hub', 'N m/m')
compared('what clay bears of a tyre as deep as a wheel', borne[n - 1], wheelBorne[n - 1], 'rigid wheel by MpmContact', 'N/m')
degrees = np.arange(1, 2 * n + 1) * options.turn / (2 * n)
for values, unit, name, colour in (borne, weight, 'force upwards over the weight', 'C0'), (torque, cu * R**2, 'torque over $c_u R^2$', 'C1'): curves.plot(degrees, values[n:] / unit, colour, label=name)
curves.plot(degrees, given[n:] / (cu * R**2), 'C1:', label='the same of the hub')
for values, unit, colour, what in (wheelBorne, weight, 'C0', 'force'), (wheelTorque, cu * R**2, 'C1', 'torque'): curves.plot(degrees, values[n:] / unit, colour + '--', label=f'{what} of a rigid wheel as deep')
curves.set(xlabel='turn [degrees]', ylabel='normalised force, torque [-]', ylim=(0, None))
curves.legend(frameon=False, fontsize='small')
figure.savefig(os.path.join(options.out, 'tyre.png'), dpi=110)
print(f'written: {options.out}/tyre.png')
