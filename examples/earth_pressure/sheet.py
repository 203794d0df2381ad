#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Earth pressure on the two sides of a thin rigid wall in sand that turns about its toe: active on one side, passive on the other.

	 _______________|_______________
	o|              |  ->          |o    H = 5 m of sand above the toe, H/2 below; gamma = 20 kN/m3, phi = psi = 30 degrees, K0 = 0.5
	o|    sand      |      sand    |o    the wall is a Facet of YADE, wished in place, thinner than any cell
	o|             toe             |o
	 |______________________________|    smooth: Rankine; rough: planes of Coulomb, stress fields of Lancellotta (2002)

Run it with `scripts/run examples/earth_pressure/sheet.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Both sides of a thin rigid wall.',
        cells=(20, 'over the height of the wall, the smallest ones'),
        halvings=(0, 'of larger cells within half the height of the wall'),
        wall=(0., 'friction of the wall [degrees]'),
        toe=(0., 'of the wall above a line of the grid [cells]'),
        turn=(0.01, 'of the wall about its toe [rad]'),
        steps=(20, 'load steps'))
H, gamma, phi, delta = 5., 20e3, np.radians(30), np.radians(options.wall)
L, D, h = 4 * H, H / 2, H / options.cells
toe = options.toe * h
O.materials.append(MpmMohrCoulombMat(young=1e9, poisson=0.3, density=gamma / 10, cohesion=100, frictionAngle=phi, dilationAngle=phi, label='sand'))
O.materials.append(FrictMat(frictionAngle=delta, label='wall'))
grid = MpmGrid(cellSize=2**options.halvings * h)
if options.halvings: grid.refinements = [MpmRefinement(min=(-H / 2, -H / 2, -inf), max=(H / 2, inf, inf), halvings=options.halvings)]
O.bodies.append(mpm.fill(mpm.polygon([(-L, -D), (L, -D), (L, H), (-L, H)]), grid, pointsPerCell=2, material='sand'))
held = [MpmBoundary(max=(-L, inf, inf), fix='x'), MpmBoundary(min=(L, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -D, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, fBar=True, verbosity=0)
O.engines, O.dt = [solver], 1
mpm.geostatic(K0=0.5)
wall = O.bodies[O.bodies.append(utils.facet([(0, toe, 0), (0, 1.1 * H, 0), (0, toe, 1)], material='wall', fixed=True))]
solver.contacts = [MpmContact()]


def pressures():
	"""K on the left and on the right of the wall, and the contact points with their forces."""
	places, force = mpm.contactForces(solver)
	weight = gamma * (H - toe)**2 / 2
	return -force[force[:, 0] < 0, 0].sum() / weight, force[force[:, 0] > 0, 0].sum() / weight, places, force


O.run(1, wait=True)
curve = [(0, *pressures()[:2])]
turn = -options.turn / options.steps
for _ in range(options.steps):
	x, y = wall.state.pos[0], wall.state.pos[1] - toe
	wall.state.angVel = (0, 0, turn)
	wall.state.vel = (np.cos(turn) * x - np.sin(turn) * y - x, np.sin(turn) * x + np.cos(turn) * y - y, 0)
	O.run(1, wait=True)
	active, passive, places, force = pressures()
	curve.append((curve[-1][0] - turn, active, passive))
	print(f'turn {curve[-1][0]:.4f}: active K = {active:.4f}, passive K = {passive:.4f}, {solver.iterations} iterations')


def limits(side):
	"""Horizontal part of K: plane slips (Coulomb 1776), and a stress field (Lancellotta 2002); *side* 1: passive, -1: active."""
	root = np.sqrt(np.sin(phi + delta) * np.sin(phi) / np.cos(delta))
	turned = np.arcsin(np.sin(delta) / np.sin(phi)) + side * delta
	field = np.cos(delta) / (1 - side * np.sin(phi)) * (np.cos(delta) + side * np.sqrt(np.sin(phi)**2 - np.sin(delta)**2)) * np.exp(side * turned * np.tan(phi))
	return np.cos(phi)**2 / (1 - side * root)**2, field


coulomb, lancellotta = limits(-1)[0], limits(1)[1]
where = f'{"a smooth" if not delta else "a rough"} sheet, {options.cells} cells over the height' + (f', {options.cells // 2**options.halvings} away from it' if options.halvings else '') + (f', toe {options.toe:g} cells above a line' if options.toe else '')
for name, K, theory, source in ('active', active, coulomb, 'Coulomb 1776'), ('passive', passive, lancellotta, 'Lancellotta 2002'):
	print(f'{name}: K = {K:.4f}, {source} {theory:.4f} ({100 * (K / theory - 1):+.1f} %)')
	compared(f'K, {name}, {where}', K, theory, source if delta else 'Rankine 1857')

figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4), width_ratios=[1, 1.6], layout='constrained')
turned, *both = np.array(curve).T
for K, theory, name, colour in zip(both, (coulomb, lancellotta), ('active side', 'passive side'), ('C0', 'C1')):
	left.plot(1e3 * turned, K, label=name, color=colour)
	left.axhline(theory, color=colour, linestyle='--', linewidth=0.8)
left.set(xlabel='turn about the toe [mrad]', ylabel='$K = 2 P / \\gamma H^2$', title='dashed: closed form')
left.legend(frameon=False)
mpm.plot('plasticStrain', ax=right, range=(0, 4 * options.turn))
right.set(xlim=(-2 * H, 2.6 * H), ylim=(-D, 1.2 * H))
figure.savefig(os.path.join(options.out, 'sheet.png'), dpi=130)
