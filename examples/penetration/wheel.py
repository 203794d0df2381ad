#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A driven wheel on clay, in plane strain, in steps in time: as in a soil bin it is pressed in, and turned faster than it goes on, by a slip that is given.

The drawbar pull, the weight that it bears and the torque that it takes come out, and where the energy of the drive goes: pull, plastic flow of the clay, rubbing under the rim; and that the soil is in
equilibrium: what base and sides bear is its weight, that of the wheel and the pull.
Run it with `scripts/run examples/penetration/wheel.py [options]`.
"""
import os
import sys
import time

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A driven wheel on clay.',
        slip=(0.4, '1 - speed of the middle over that of the rim'),
        sinkage=(0.08, 'of the wheel, over its radius'),
        way=(1.5, 'on which it is driven, over its radius'),
        cells=(8, 'over the radius'),
        rough=(1., 'adhesion over c_u'),
        stepsPerCell=(6, 'steps while the middle goes on by a cell'))
R, cu, rim = 0.4, 20e3, 1.  # [m], [Pa], speed of the rim [m/s]
h = R / options.cells
speed, spin = rim * (1 - options.slip), rim / R
sink, way = options.sinkage * R, options.way * R
began, solves, found, balance, forces = time.time(), [], [], [], []

O.materials.append(MpmTrescaMat(young=200 * cu, poisson=0.4, density=1800, undrainedStrength=cu, label='clay'))
O.materials.append(FrictMat(label='rigid'))
low, right = -np.ceil(2 * options.cells) * h, np.ceil((way + 2.5 * R) / h) * h
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(pack.inAlignedBox((-2.5 * R, low, -1), (right, 0, 1)), grid, 3, 'clay'))
wheel = O.bodies[O.bodies.append(utils.sphere((0, R, 0), R, material='rigid', fixed=True))]
contact = MpmContact(friction=np.arctan(5), adhesion=options.rough * cu, stiffness=10)
sides = [MpmBoundary(max=(inf, low, inf), fix='xy'), MpmBoundary(max=(-2.5 * R, inf, inf), fix='x'), MpmBoundary(min=(right, -inf, -inf), fix='x')]
O.engines = [
        MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=sides, contacts=[contact], scheme='generalised-alpha', rhoInfinity=0.5, label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'wheel-'), recorders=['points'], iterPeriod=20),
]
soil = 1800 * mpm.arrays()['volume'].sum()  # its mass
mpm.geostatic()


energies = 'contactWork', 'plasticWork', 'elasticEnergy', 'kineticEnergy', 'ghostWork', 'gridWork', 'energyImbalance'
borne = 'reaction_x', 'reaction_y', 'momentum_x', 'momentum_y'


def run(duration, velocity, turns):
	"""After each step: place, forces on the wheel, work of the drive and of the pull in it, and the energies so far. How many steps."""
	steps = int(np.ceil(duration * rim / h * options.stepsPerCell))
	wheel.state.vel, wheel.state.angVel = (*velocity, 0), (0, 0, -turns)
	O.dt = duration / steps
	for _ in range(steps):
		O.step()
		solves.append(solver.iterations)
		force, torque, data = contact.forces[0], contact.torques[0][2], solver.plotData()
		found.append([wheel.state.pos[0], force[0], force[1], torque, torque * turns * O.dt, force[0] * velocity[0] * O.dt])
		balance.append([data[name] for name in energies])
		forces.append([data[name] for name in borne])
	return steps


pressed = run(2 * sink / rim, (0, -rim / 2), 0)
run(way / speed, (speed, 0), spin)
x, pull, weight, torque, driven, pulled = np.array(found)[pressed:].T
taken = dict(zip(energies, balance[-1] - np.array(balance[pressed - 1])))
energy, late = driven.sum(), x > x[-1] / 2
shares = dict(pull=pulled.sum(), rubbing=energy - pulled.sum() - taken['contactWork'], plastic=taken['plasticWork'], stored=taken['elasticEnergy'] + taken['kineticEnergy'],
              scheme=taken['ghostWork'] + taken['gridWork'])
print('way / R    pull    weight    torque, over c_u R, c_u R and c_u R^2')
for k in np.linspace(0, len(x) - 1, 20).astype(int): print(f'{x[k] / R:7.3f}  {pull[k] / (cu * R):7.3f}  {weight[k] / (cu * R):7.3f}  {torque[k] / (cu * R * R):7.3f}')
print(f'second half of the way: pull over weight {pull[late].mean() / weight[late].mean():.3f}, torque over R times weight {torque[late].mean() / R / weight[late].mean():.3f}')
print('of the energy of the drive: ' + ', '.join(f'{name} {100 * share / energy:.1f} %' for name, share in shares.items()))
off = sum(shares.values()) / energy - 1
print(f'in sum = {1 + off:.3f}, 1.000 ({100 * off:+.1f} %)')
compared(f'energy of a driven wheel found again, slip {options.slip:g}', 1 + off, 1, 'balance', 'given')
reactions, momentum = np.mean(forces[pressed:], axis=0)[:2], (np.array(forces[-1]) - forces[pressed - 1])[2:] / (len(pull) * O.dt)
missing = (reactions - momentum - [pull.mean(), weight.mean() + 9.81 * soil]) / weight.mean()
print(f'equilibrium, of the weight of the wheel: along the way {100 * missing[0]:+.2f} %, upwards {100 * missing[1]:+.2f} %')
print(f'{len(mpm.arrays()["id"])} material points, {sum(solves)} iterations in {len(solves)} steps, {time.time() - began:.0f} s')

figure, (picture, curve) = plt.subplots(2, 1, figsize=(9, 7), layout='constrained')
mpm.plot('plasticStrain', ax=picture, loads=False, range=(0, 1))
picture.add_patch(plt.Circle(tuple(wheel.state.pos)[:2], R, facecolor='0.8', edgecolor='0.3', zorder=3))
picture.set(title=' ', ylim=(-1.5 * R, 2 * R - sink + 0.1 * R))
for name, values, unit in ('weight', weight, cu * R), ('pull', pull, cu * R), ('torque', torque, cu * R * R): curve.plot(x / R, values / unit, label=name)
curve.axhline(0, color='k', linewidth=0.8)
curve.set(xlabel='way / R', ylabel='over $c_u R$, torque over $c_u R^2$')
curve.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'wheel.png'), dpi=110)
print(f'written: {options.out}/wheel.png, and for ParaView {options.out}/wheel-points.pvd')
