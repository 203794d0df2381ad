#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A pile is driven into clay by blows: how far each one takes it, by what it bears in a static test.

	    blow
	     ||
	     ||          a rigid pile of revolution, free along the axis, moved by the engine (MpmContact.implicit);
	=====||=====     clay without inertia worth speaking of, so that it resists as in the test
	     ||
	     --
	============

In the test the pile is pushed in and let go: it bears R (read in the middle of the set), and springs back by the quake q until it bears its weight W alone. A blow with the energy E then takes it, for good, by E / (R - W) - q / 2, as a spring that yields at R. Before the first blow the clay is
soft, and R is reached on the way: there the area under the curve of the test is the energy.

Run it with `scripts/run examples/free_bodies/driven_pile.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions
from style import plt

options = readOptions('A pile driven by blows.',
        cellSize=(0.125, 'of the grid [m]'),
        blows=(3, 'how many'),
        speed=(1.5, 'of the pile after a blow [m/s]'),
        stepSize=(2e-3, 'O.dt [s]'),
        density=(1., 'of the clay [kg/m3]; 1800 has waves that take energy away'))
R, L, width, deep, cu, adhesion = 0.25, 1.5, 2., 3., 2e4, 1e4  # half of the pile, which is 2 L long, is in the clay
mass = 2600 * np.pi * R**2 * 2 * L
weight, energy = 9.81 * mass, mass * options.speed**2 / 2


def scene(isFree):
	"""Pile and settings of an engine."""
	O.reset()
	O.materials.append(MpmTrescaMat(young=1e7, poisson=0.45, density=options.density, undrainedStrength=cu, label='clay'))
	O.materials.append(FrictMat(density=2600, frictionAngle=0, label='pile'))
	grid = MpmGrid(cellSize=options.cellSize, axisymmetric=True)
	O.bodies.append(mpm.fill(mpm.polygon([(0, -deep), (width, -deep), (width, 0), (R, 0), (R, -L), (0, -L)]), grid, 2, 'clay'))
	for point in O.bodies: point.groupMask = 2
	pile = O.bodies[O.bodies.append(utils.box((0, 0, 0), (R, L, R), material='pile', fixed=not isFree))]
	held = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -deep, inf), fix='xy')]
	contact = MpmContact(friction=0, adhesion=adhesion, mask=1, implicit=True, stiffness=20)
	return pile, dict(grid=grid, boundaries=held, contacts=[contact], fBar=True, newton=MpmNewton(tolerance=1e-9, minStep=1 / 64), verbosity=0)


def use(engine, dt, **settings):
	O.engines, O.dt = [engine(**settings, loadTime=O.time)], dt
	return O.engines[0]


pile, settings = scene(isFree=False)
solver = use(MpmImplicitEngine, 1, **settings)
curve = [[0, 0]]


def push(way):
	pile.state.vel = (0, -way, 0)
	O.step()
	curve.append([-pile.state.pos[1], solver.contacts[0].forces[0][1]])


while curve[-1][0] < 0.05 * options.blows * options.speed**2 / 1.5**2: push(1e-3)
steps = len(curve)
while curve[-1][1] > weight: push(-5e-4)
down, back = np.array(curve[:steps]).T, np.array(curve[steps - 1:]).T
quake = back[0, 0] - np.interp(-weight, -back[1], back[0])
area = np.r_[0, np.cumsum((down[1, 1:] + down[1, :-1]) / 2 * np.diff(down[0]))] - weight * down[0]
first = np.interp(area[down[1] > weight][0] + energy, area, down[0]) - np.interp(weight, *down[::-1]) - quake
print(f'test: bears {down[1, -1] / 1e3:.2f} kN, Skempton {(9 * cu * np.pi * R**2 + adhesion * 2 * np.pi * R * L) / 1e3:.2f} kN; quake {1e3 * quake:.2f} mm; weight {weight / 1e3:.2f} kN')

pile, settings = scene(isFree=True)
contact = settings['contacts'][0]


def letGo(force):
	"""Down to the equilibrium of the pile under its weight, from a force besides. The place of the pile."""
	solver = use(MpmImplicitEngine, 1, **settings)
	for part in np.linspace(1, 0, 21)[1:]:
		O.forces.setPermF(pile.id, (0, -weight - part * force, 0))
		O.step()
	return solver, -pile.state.pos[1]


solver, at = letGo(0)
start, figure = at, plt.figure(figsize=(10, 4.6), layout='constrained')
picture, diagram = figure.subplots(1, 2, width_ratios=[1, 1.4])
for number in range(options.blows):
	reaction, clay, off, path = solver.plotData()['reaction_y'], 0, 0, []
	solver = use(MpmDynamicEngine, options.stepSize, **settings)
	pile.state.vel = (0, -options.speed, 0)
	while pile.state.vel[1] < 0:
		before = mass * pile.state.vel[1] + clay
		O.step()
		data = solver.plotData()
		clay, reactions, reaction = data['momentum_y'], (reaction + data['reaction_y']) / 2, data['reaction_y']
		if data['cuts'] == 0: off = max(off, abs(mass * pile.state.vel[1] + clay - before - options.stepSize * (reactions - weight)))
		path.append((-pile.state.pos[1], contact.forces[0][1]))
	pile.state.vel = (0, 0, 0)
	mpm.assign(velocity=np.zeros((len(mpm.arrays()['id']), 3)))
	solver, rests = letGo(contact.forces[0][1] - weight)
	byHand = energy / (np.interp((at + rests) / 2, *down) - weight) - quake / 2 if number else first
	print(f'blow {number + 1}: set {1e3 * (rests - at):.2f} mm, by its energy {1e3 * byHand:.2f} mm ({100 * ((rests - at) / byHand - 1):+.1f} %); momentum of pile and clay is off by {off / mass / options.speed:.1e} of the blow in a step')
	diagram.plot(*(np.array([(at, weight / 1e3), *((s, F / 1e3) for s, F in path), (rests, weight / 1e3)]).T * [[1e3], [1]]), '.-', ms=3, lw=0.8, label=f'blow {number + 1}')
	at = rests
diagram.plot(1e3 * down[0], down[1] / 1e3, 'k-', label='static test')
diagram.plot(1e3 * back[0], back[1] / 1e3, 'k--', label='let go')
diagram.set(xlabel='pile below where it was put in [mm]', ylabel='force of the clay [kN]')
diagram.legend()
mpm.plot('plasticStrain', ax=picture)
figure.savefig(os.path.join(options.out, 'driven_pile.png'), dpi=130)
print(f'written: {options.out}/driven_pile.png')
