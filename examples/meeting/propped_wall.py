#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A sheet pile of points, propped at its top, between soil of two levels: its bending moments against free earth support.

	     prop -> ||
	 ============||             smooth, stiff, four cells across or two;
	 sand        ||             the sand is one body, with a slot for the wall
	             ||
	             ||============
	             ||        sand
	             ||
	             --
	 ==========================

Behind the wall the sand is in its active state, K_a; before it so much of the passive one is mobilised, K_m, as moments about the prop ask for. Then the moment at the depth z is
T (p + z) - K_a w z^3 / 6 + K_m w (z - H)^3 / 6 with the prop's force T at the height p.

Run it with `scripts/run examples/meeting/propped_wall.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
from math import inf, radians, sin

import numpy as np
from yade import mpm
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A sheet pile of points against free earth support.',
        cellSize=(0.25, 'of the grid [m]'),
        steps=(10, 'in which the weight is put on'),
        depth=(1.75, 'of the wall below the lower level [m]'),
        gives=(0.01, 'how far the prop gives way [m]'),
        friction=(0., 'of the wall [degrees]'))
h, H, D, p, thick, weight, phi = options.cellSize, 4., options.depth, 0.5, 0.5, 20e3, radians(30)  # p: of the prop above the sand
bottom, left, right = -8., -8., 6.
O.materials.append(MpmMohrCoulombMat(young=2e7, poisson=0.25, cohesion=20, frictionAngle=phi, dilationAngle=0, density=weight / 10, label='sand'))
O.materials.append(MpmElasticMat(young=5e9, poisson=0.2, density=100, label='steel'))
grid = MpmGrid(cellSize=h)
sand = mpm.polygon([(left, bottom), (right, bottom), (right, -H), (thick, -H), (thick, -H - D), (0, -H - D), (0, 0), (left, 0)])
wall = mpm.polygon([(0, -H - D), (thick, -H - D), (thick, p), (0, p)])
O.bodies.append(mpm.fill(sand, grid, 2, 'sand', body='sand'))
O.bodies.append(mpm.fill(wall, grid, 2, 'steel', body='wall'))
held = [MpmBoundary(max=(inf, bottom, inf), fix='xy'), MpmBoundary(max=(left, h / 2, inf), fix='x'), MpmBoundary(min=(right, -inf, -inf), max=(inf, -H + h / 2, inf), fix='x')]
prop = MpmBoundary(min=(-h, p - h / 4, -inf), max=(thick + h, inf, inf), fix='x', displacement=(options.gives, 0, 0))
contact = MpmBodyContact(between=('wall', 'sand'), friction=radians(options.friction))
O.engines = [
        MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[*held, prop], contacts=[contact], newton=MpmNewton(tolerance=1e-6), verbosity=1, label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'propped_wall-'), recorders=['points', 'contacts'], iterPeriod=options.steps),
]
O.dt = 1 / options.steps
O.run(options.steps, wait=True)

active, L = (1 - sin(phi)) / (1 + sin(phi)), H + D
thrust = active * weight * L**2 / 2
resistance = thrust * (p + 2 * L / 3) / (p + H + 2 * D / 3)
mobilised, force = resistance / (weight * D**2 / 2), thrust - resistance
depth = np.linspace(-p, L, 400)
moment = force * (p + depth) - active * weight * depth.clip(0)**3 / 6 + mobilised * weight * (depth - H).clip(0)**3 / 6
cuts = np.arange(-p + h, L - h / 2, h / 2)
ours = np.array([-mpm.sectionForces('wall', ((thick / 2, -z), (0, 1)))['M'] for z in cuts])
largest = lambda M: M[np.abs(M).argmax()]
print(f'{len(O.bodies)} points; mobilised: K_m = {mobilised:.3f} of K_p = {1 / active:.0f}')
print(f'prop: {abs(solver.reactions[3][0]) / 1e3:.2f} kN/m, free earth support {force / 1e3:.2f} kN/m')
print(f'largest moment: {largest(ours) / 1e3:.2f} kN m/m, free earth support {largest(moment) / 1e3:.2f} kN m/m')
compared('largest moment of a propped sheet pile', abs(largest(ours)), largest(moment), 'free earth support', 'N m/m')
figure, (picture, diagram) = plt.subplots(1, 2, figsize=(10, 4.6), width_ratios=[2.2, 1], layout='constrained')
picture.set_title('plastic strain, and pressure on the wall', pad=24)
mpm.plot('plasticStrain', ax=picture, loads=True)
picture.set(xlim=(-6, 5), ylim=(-7, 0.8))
diagram.plot(moment / 1e3, -depth, 'k-', label='free earth support')
diagram.plot(ours * np.sign(largest(ours)) / 1e3, -cuts, 'o', ms=3, label='points')
diagram.set_title('bending moment', pad=24)
diagram.set(xlabel='bending moment [kN m/m]', ylabel='y [m]')
diagram.legend()
figure.savefig(os.path.join(options.out, 'propped_wall.png'), dpi=130)
print(f'written: {options.out}/propped_wall.png, and for ParaView {options.out}/propped_wall-points.pvd')
