#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Earth pressure of sand on a wall that moves away from it and into it: nodes of the grid, by less than half a cell, or a Box of YADE, by any way.

	        ___________________________
	 wall  |                           |o    H = 5 m, length 4 H, gamma = 20 kN/m3, c = 0, phi = 30 degrees
	 <-->  |           sand            |o    at rest with K0 = 1 - sin(phi); the base is smooth
	       |___________________________|o
	         o o o o o o o o o o o o o o

Rankine (1857): the resultant on the wall is K gamma H^2 / 2, K_A = (1 - sin(phi)) / (1 + sin(phi)) = 1/3 and K_P = 1/K_A = 3. They are exact where flow is associated
(psi = phi). For psi = 0, Davis (1968) has another friction on slip planes: tan(phi*) = sin(phi) cos(psi) / (1 - sin(phi) sin(psi)), K_P = 2.62 by
Rankine with phi*; sand that yields as a whole, without slip planes, has 3. A wall that has moved far has other sand behind it: on a smooth base Rankine holds with the
height and the weight over the width that the sand has then.

A Box may be rough. Then the base has to be rough, too, for no section of sand on a smooth one carries more than Rankine's passive thrust; it is a Wall of YADE with the
friction phi. Planes of Coulomb bound the horizontal part of K from one side, stress fields of Lancellotta (2002) from the other.

Run it with `scripts/run examples/earth_pressure/earth_pressure.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Active and passive earth pressure.',
        cells=(20, 'over the height of the wall'),
        fBar=(1, '1: with F-bar, 0: without'),
        young=(2e8, 'modulus [Pa], so stiff that both limits come within half a cell'),
        steps=(20, 'load steps for each movement'),
        contact=(0, '1: the wall is a Box of YADE, through MpmContact; 0: nodes of the grid'),
        wall=(0., 'friction of the Box [degrees]'),
        rough=(0, '1: the base holds the sand sideways too; with contact=1 as far as friction phi does'),
        psi=('30', 'angles of dilation [degrees], with commas between'),
        movement=(0.4, 'of the wall at the end, in cells'))

H, L, gamma, phi = 5., 20., 20e3, 30
h = H / options.cells


def heldWall(way):
	"""Wall and base of nodes: boundaries."""
	sides = [MpmBoundary(max=(0, inf, inf), fix='x', displacement=(way, 0, 0)), MpmBoundary(min=(L, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	if options.rough: sides.append(MpmBoundary(min=(h, -inf, -inf), max=(inf, 0, inf), fix='x'))  # the node at the foot of the wall moves with it
	return dict(boundaries=sides)


def bodyWall(way):
	"""The wall is a Box of YADE, and so is a rough base: contacts with the friction of their materials."""
	for label, friction in ('wall', options.wall), ('base', phi):
		O.materials.append(FrictMat(frictionAngle=np.radians(friction), label=label))
	box = O.bodies[O.bodies.append(utils.box((-h, H, 0), (h, 2 * H, 1), material='wall', fixed=True))]
	box.state.vel = (way, 0, 0)
	sides = [MpmBoundary(min=(L, -inf, -inf), fix='x')]
	if options.rough: O.bodies.append(utils.wall(0, axis=1, sense=1, material='base'))
	else: sides.append(MpmBoundary(max=(inf, 0, inf), fix='y'))
	return dict(boundaries=sides, contacts=[MpmContact()])


def thrust():
	"""Horizontal force on the wall [N/m]."""
	return abs(solver.contacts[0].forces[0][0] if options.contact else solver.reactions[0][0])


def presentSize(way):
	"""Height of the sand times its weight over its width, over what that was at first, after the wall has moved by *way* [m] into it."""
	width = L - way
	return mpm.arrays()['volume'].sum() / (H * width) * L / width


def move(direction, psi):
	"""Movement of the wall [m], K and presentSize() after each step; *direction* 1: into the sand, -1: away from it."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=options.young, poisson=0.3, density=gamma / 10, cohesion=0, frictionAngle=np.radians(phi), dilationAngle=np.radians(psi), label='sand'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, pointsPerCell=2, material='sand'))
	conditions = (bodyWall if options.contact else heldWall)(direction * options.movement * h)
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], fBar=bool(options.fBar), label='solver', **conditions)]
	O.dt = 1 / options.steps
	mpm.geostatic()
	curve, solves = [], []
	try:
		for _ in range(options.steps):
			O.step()
			way = solver.loadFactor * options.movement * h
			curve.append((way, thrust() / (gamma * H**2 / 2), presentSize(direction * way)))
			solves.append(solver.iterations)
	except RuntimeError as error:
		print(error)
	return np.array([(0, 1 - np.sin(np.radians(phi)), 1)] + curve), np.mean(solves)


def exact(psi, direction):
	"""Coefficient by Rankine with the friction on slip planes of Davis."""
	sine, dilation = np.sin(np.radians(phi)), np.sin(np.radians(psi))
	slip = np.arctan(sine * np.cos(np.radians(psi)) / (1 - sine * dilation))
	return ((1 + np.sin(slip)) / (1 - np.sin(slip)))**direction


def roughWall(direction):
	"""Horizontal part of K for psi = phi and friction of the wall: of a stress field (Lancellotta 2002), and of plane slips (Coulomb 1776). The exact one lies between."""
	sine, delta = np.sin(np.radians(phi)), np.radians(options.wall)
	turned = np.arcsin(np.sin(delta) / sine) + direction * delta
	field = np.cos(delta) / (1 - direction * sine) * (np.cos(delta) + direction * np.sqrt(sine**2 - np.sin(delta)**2)) * np.exp(direction * turned * np.tan(np.radians(phi)))
	root = np.sqrt(np.sin(np.radians(phi) + delta) * sine / np.cos(delta))
	return field, np.cos(np.radians(phi))**2 / (1 - direction * root)**2


smooth = not (options.contact and options.wall)
figure, axes = plt.subplots(2, 2, figsize=(12.5, 6.4), width_ratios=[1, 1.6], layout='constrained')
for row, (direction, name, side) in enumerate([(-1, 'active', 'away from the sand'), (1, 'passive', 'into the sand')]):
	axis, picture = axes[row]
	for number, psi in enumerate(map(float, options.psi.split(','))):
		if direction < 0 and psi < phi: continue  # without cohesion and dilation: no convergence where the sand follows the wall
		begin = time.time()
		curve, solves = move(direction, psi)
		K, theory, bounds = curve[-1, 1], exact(psi, direction), roughWall(direction)
		rise = 100 * (curve[-1, 1] / np.interp(0.75 * curve[-1, 0], *curve.T[:2]) - 1)
		beside = f'theory {theory:.4f} ({100 * (K / theory - 1):+.2f} %)' if smooth else 'theory from {:.4f} to {:.4f}'.format(*sorted(bounds))
		print(f'{name}, psi = {psi:g}: K = {K:.4f}, {beside}, over the last quarter {rise:+.2f} %, {solves:.1f} iterations a step, {time.time() - begin:.1f} s')
		grown = curve[-1, 2] * theory
		if not options.rough: print(f'    with the height and the weight over the width of now: theory {grown:.4f} ({100 * (K / grown - 1):+.2f} %)')
		if smooth and not options.rough: compared(f'K, {name}, psi = {psi:g}, {"as the sand is then, " if options.contact else ""}{options.cells} cells over the height', K, grown if options.contact else theory, 'Rankine 1857')
		if not smooth: compared(f'K, {name}, rough wall, {options.cells} cells over the height', K, bounds[1], 'Coulomb 1776')
		axis.plot(1000 * curve[:, 0], curve[:, 1], label=f'$\\psi$ = {psi:g}°')
		for limit in [theory] if smooth else bounds:
			axis.plot(1000 * curve[:, 0], limit * (np.ones(len(curve)) if options.rough else curve[:, 2]), color=f'C{number}', linestyle='--', linewidth=0.8)
		if number == 0:
			points = mpm.arrays()
			mpm.plot('plasticStrain', ax=picture, range=(0, max(np.quantile(points['plasticStrain'], 0.98), 1.5 * np.median(points['plasticStrain']))))
			picture.set_title(f'{name}: plastic strain, psi = {psi:g}°', fontsize='medium')
			if options.contact: picture.get_legend().remove()
			picture.set_ylim(-0.1 * H, 1.6 * H)
	axis.plot([], [], '--', color='0.4', label='Rankine, Davis' if smooth else 'Lancellotta, Coulomb')
	axis.set_title(f'wall moves {side}', fontsize='medium')
	axis.set(xlabel='movement [mm]', ylabel='$K = 2 P / \\gamma H^2$')
	axis.legend(frameon=False)
picture = os.path.join(options.out, 'contact.png' if options.contact else 'earth_pressure.png')
figure.savefig(picture, dpi=130)
print(f'written: {picture}')
