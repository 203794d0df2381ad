#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Debris runs down a channel of rock, over level ground and against a wall, and carries boulders along.

	  o\\                      a channel of facets, 40 degrees steep, which levels out; its sides rise as a parabola
	 ooo\\                     debris: Mohr-Coulomb, 25 degrees, from rest
	  \\  \\             _      boulders: clumps of two spheres, on top of it
	    \\__\\__________| |     wall: a Box, on which the force is recorded, of debris and of boulders

Inertia in explicit steps with lumped mass; bed, wall and boulders touch the debris by MpmContact, and each other by YADE's laws.

Run it with `scripts/run examples/debris/debris.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions
from style import plt

options = readOptions('Debris on terrain, against a wall.',
        cellSize=(0.5, 'h [m]'),
        pointsPerCell=(2, 'material points per cell and axis'),
        boulders=(2, 'clumps on top of the debris'),
        end=(2.5, 'time of the last state [s]'),
        states=(25, 'states in the view for the browser'))
began = time.time()
density, g, slope, foot, wallAt = 1800., 9.81, np.radians(40), 4.5, 7.
length, width, depth = 3., 2., 1.2  # size of the debris along x, across, and above the bed [m]
h = options.cellSize


def bed(x, y):
	"""Height of the rock [m]: a slope that levels out around the foot, within 2 m, and sides that rise."""
	down = 2 * np.logaddexp(0, (foot - x) / 2 / 0.5) * 0.5  # 0 beyond the foot
	return np.tan(slope) * down + 0.15 * y**2


def surface(x, y):
	"""Height of the debris at first [m]."""
	return bed(x, y) + depth * (1 - (y / width)**2) + 0.1 * h


O.materials.append(MpmMohrCoulombMat(young=2e6, poisson=0.3, density=density, cohesion=100, frictionAngle=radians(25), label='debris'))
O.materials.append(FrictMat(young=3e6, poisson=0.3, density=2600, frictionAngle=radians(20), label='rock'))
grid = MpmGrid(cellSize=h, dim=3)
ends = dict(min=(0.5, -0.9 * width), max=(0.5 + length, 0.9 * width), spacing=h / 2)
O.bodies.append(mpm.fill(mpm.terrain(surface, lambda x, y: bed(x, y) + 0.1 * h, **ends), grid, options.pointsPerCell, 'debris'))
for body in O.bodies: body.groupMask = 8  # the contacts mean rock and boulders: 1, bed; 2, boulders; 4, wall
points = mpm.arrays()
mass = points['volume'].sum() * density

O.bodies.append(mpm.facets(bed, spacing=1, min=(-0.5, -3), max=(wallAt + 1, 3), material='rock', mask=1 | 16))
wall = O.bodies.append(utils.box((wallAt + 0.5, 0, 1.2), (0.5, 3, 1.4), material='rock', fixed=True, mask=4 | 16, color=(0.45, 0.5, 0.55)))
clumps = []
for i in range(options.boulders):
	members = []
	for k in 0, 1:
		x, y, radius = 1.7 + 1.4 * i + 0.35 * k, 0.3 * (-1)**i, 0.45 - 0.1 * k
		above = (radius + h / 4) / np.cos(slope)  # beside the points
		members.append(utils.sphere((x, y, surface(x, y) + above), radius, material='rock', mask=2 | 16, color=(0.35, 0.3, 0.28)))
	clumps.append(O.bodies.appendClumped(members)[0])
	O.bodies[clumps[-1]].groupMask = 2 | 16

onBed, onWall, onBoulders = (MpmContact(mask=mask, friction=radians(angle), stiffness=stiffness) for mask, angle, stiffness in ((1, 15, 5), (4, 20, 10), (2, 25, 5)))
solver = MpmDynamicEngine(grid=grid, gravity=(0, 0, -g), contacts=[onBed, onWall] + [onBoulders] * bool(clumps), scheme='explicit', ghost=MpmGhost(factor=0, massFactor=0), verbosity=0, label='solver')
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb(), Bo1_Facet_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
        solver,
        NewtonIntegrator(gravity=(0, 0, -g), damping=0.1, mask=16),
        PyRunner(iterPeriod=5, initRun=True, command='record()'),
]
O.dt = min(0.5 * solver.criticalTimeStep(), 0.5 * utils.PWaveTimeStep() if clumps else np.inf)
steps = int(np.ceil(options.end / O.dt))
history = []


def record():
	debris = onWall.forces[0][0] if len(onWall.forces) else 0
	boulders = sum(abs(contact.phys.normalForce[0]) for contact in O.bodies[wall].intrs() if contact.isReal)
	history.append((O.time, debris, boulders))


print(f'{len(points["id"])} points of {mass / 1000:.1f} t, {len(clumps)} boulders; {steps} steps of {1000 * O.dt:.2f} ms')
film = mpm.view(os.path.join(options.out, 'debris.html'), ['velocity_x', 'displacement'], every=max(1, steps // options.states), solver=solver)
O.run(steps, wait=True)
film.finish()

t, debris, boulders = np.array(history).T
points = mpm.arrays()
x, z = points['pos'][:, 0], points['pos'][:, 2]
smooth = np.convolve(np.pad(debris, 4, mode='edge'), np.ones(9) / 9, 'valid')  # mean of nine records
isBeside = np.abs(points['pos'][:, 1]) > 3
below = z < np.array([bed(*place) for place in points['pos'][:, :2]]) - h / 4
work = solver.plotData()
print(f'front reaches {x.max():.2f} m, wall at {wallAt:g} m; {100 * (x > wallAt + 1).mean():.1f} % of the points beyond the wall, {isBeside.sum()} beside the bed, {(below & ~isBeside).sum()} below it')
print(f'force of the debris on the wall: at most {smooth.max() / 1000:.1f} kN at {t[smooth.argmax()]:.2f} s, at the end {smooth[-20:].mean() / 1000:.1f} kN; of boulders at most {boulders.max() / 1000:.1f} kN')
print(f'energy not accounted for: {work["energyImbalance"] / work["loadWork"]:+.1e} of the work of gravity; {time.time() - began:.0f} s')

figure, (section, force) = plt.subplots(2, 1, figsize=(9, 6.4), height_ratios=[1.25, 1], layout='constrained')
mpm.plot('displacement', ax=section, plane=('y', 0.11 * h))
force.plot(t, smooth / 1000, label='debris, mean over nine records')
if clumps: force.plot(t, boulders / 1000, label='boulders', linewidth=0.9)
force.set(xlabel='time [s]', ylabel='force on the wall [kN]', xlim=(0, t[-1]))
force.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'debris.png'), dpi=110)
print(f'written: {options.out}/debris.png, debris.html for the browser')
