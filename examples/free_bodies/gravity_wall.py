#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A gravity wall, a free rigid body, holds sand; a load on the sand grows until the wall slides or tips over.

	 load v v v v v v
	 ================ ----          a block on rock, held by nothing but its weight and friction,
	 sand            |    |         moved by the engine (MpmContact.implicit)
	                 |    |
	 ================ ----
	 rock

By hand, with the friction delta on back and base and Coulomb's active pressure K_a of a wall with friction: with the thrust E = K_a (w H^2 / 2 + q H) at the angle delta the wall slides where E cos(delta) = (W + E sin(delta)) tan(delta), and tips where the moments
about its toe are in balance.

Run it with `scripts/run examples/free_bodies/gravity_wall.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
from math import cos, inf, radians, sin, sqrt, tan

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A gravity wall until it slides or tips.',
        cellSize=(0.25, 'of the grid [m]'),
        width=(2., 'of the wall [m]; 1.2 with a friction of 30 tips over'),
        friction=(20., 'of back and base [degrees]'),
        increment=(4e3, 'of the load [Pa]'))
H, B, depth, back, weight, phi, delta = 4., options.width, 1., 6., 18e3, radians(30), radians(options.friction)
O.materials.append(MpmMohrCoulombMat(young=2e7, poisson=0.3, density=weight / 10, cohesion=100, frictionAngle=phi, dilationAngle=phi, label='sand'))
O.materials.append(MpmElasticMat(young=1e9, poisson=0.2, density=weight / 10, label='rock'))
O.materials.append(FrictMat(density=2400, frictionAngle=delta, label='wall'))
grid = MpmGrid(cellSize=options.cellSize)
O.bodies.append(mpm.fill(mpm.polygon([(-back, 0), (0, 0), (0, H), (-back, H)]), grid, 2, 'sand'))
O.bodies.append(mpm.fill(mpm.polygon([(-back, -depth), (B, -depth), (B, 0), (-back, 0)]), grid, 2, 'rock'))
for point in O.bodies: point.groupMask = 2
wall = O.bodies[O.bodies.append(utils.box((B / 2, H / 2, 0), (B / 2, H / 2, 0.5), material='wall', fixed=True))]
held = [MpmBoundary(max=(-back, inf, inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy'), MpmBoundary(min=(B, -inf, -inf), fix='x')]
load = MpmTraction(surface=[(0, H), (-back, H)], pressure=1e5, curve=[(0, 0), (2, 0), (3, 1)])
contact = MpmContact(mask=1, implicit=True, stiffness=50)
solver = MpmImplicitEngine(
        grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=held, contacts=[contact], loads=[load], fBar=True, newton=MpmNewton(maxIterations=40, minStep=1 / 16), verbosity=0)
O.engines, O.dt = [solver], 1
points = mpm.arrays()['pos']
vertical = -weight * (H - points[:, 1]) * (points[:, 0] < 0)  # stress as if the wall were poured in front of level ground
mpm.assign(stress=vertical[:, None, None] * np.array([np.diag([K, 1, K]) for K in np.where(points[:, 1] > 0, 0.5, 0.25)]))
O.step()
force, own = contact.forces[0], 2400 * 10 * B * H
wall.dynamic, O.dt = True, 0.05
for part in np.linspace(1, 0, 21)[1:]:  # its support is let go, and its weight comes
	O.forces.setPermF(wall.id, (-part * force[0], part * (own - force[1]), 0))
	O.step()

O.dt = options.increment / load.pressure
path = []
try:
	while wall.state.pos[0] - B / 2 < H / 100:
		O.step()
		places, forces = mpm.contactForces()
		path.append((1e5 * (O.time - 2), wall.state.pos[0] - B / 2 + H / 2 * wall.state.ori.Rotate((0, 1, 0))[0], -forces[places[:, 0] < wall.state.pos[0] - B / 2 + options.cellSize / 16, 0].sum()))
except RuntimeError as failure:
	print(failure)
q = 1e5 * (solver.loadTime - 2)
Ka = (cos(phi) / (1 + sqrt(sin(phi + delta) * sin(phi) / cos(delta))))**2 / cos(delta)
thrust = lambda q: Ka * (weight * H**2 / 2 + q * H)
slides = ((own * tan(delta) / (cos(delta) - sin(delta) * tan(delta))) / Ka - weight * H**2 / 2) / H
overturning, resisting = (lambda q: Ka * cos(delta) * (weight * H**3 / 6 + q * H**2 / 2)), (lambda q: own * B / 2 + thrust(q) * sin(delta) * B)
excess = overturning(0) - resisting(0)
tips = -excess / (overturning(1) - resisting(1) - excess)
print(f'the load is {q / 1e3:.2f} kPa as the wall gives way; by hand it slides at {slides / 1e3:.2f} kPa, and tips at {tips / 1e3:.2f} kPa')
way, ratio = ('slides', thrust(q) / thrust(slides)) if slides < tips else ('tips', overturning(q) / resisting(q))
what = {'slides': 'thrust over what the base can bear', 'tips': 'overturning over resisting moment'}[way]
if way == 'slides': print(f'thrust as it slides {path[-1][2] / (thrust(slides) * cos(delta)):.4f} of what its base bears by hand')
else: print(f'thrust as it tips {path[-1][2] / (thrust(q) * cos(delta)):.3f} of that by Coulomb')
print(f'it {way}: {what} by hand {ratio:.3f}')
compared(f'{way}, cells of {options.cellSize:g} m: {what}', ratio, 1, 'Coulomb')
figure, (picture, diagram) = plt.subplots(1, 2, figsize=(12.5, 4.6), width_ratios=[1.5, 1], layout='constrained')
mpm.plot('plasticStrain', ax=picture)
loads, moves, thrusts = np.array(path).T
diagram.plot(1e3 * moves, thrusts / 1e3, 'o-', ms=3, label='wall')
diagram.axhline(thrust(min(slides, tips)) * cos(delta) / 1e3, color='k', label=f'{way} by hand')
diagram.set(xlabel='top of the wall moves [mm]', ylabel='horizontal thrust [kN/m]')
diagram.legend()
figure.savefig(os.path.join(options.out, 'gravity_wall.png'), dpi=130)
print(f'written: {options.out}/gravity_wall.png')
