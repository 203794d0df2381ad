#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Earth pressure of sand on a smooth wall that moves away from it and into it, by less than half a cell.

	        ___________________________
	 wall  |                           |o    H = 5 m, length 4 H, gamma = 20 kN/m3, c = 0, phi = 30 degrees
	 <-->  |           sand            |o    at rest with K0 = 1 - sin(phi); the base is smooth
	       |___________________________|o
	         o o o o o o o o o o o o o o

Rankine (1857): the resultant on the wall is K gamma H^2 / 2, K_A = (1 - sin(phi)) / (1 + sin(phi)) = 1/3 and K_P = 1/K_A = 3. They are exact where flow is associated
(psi = phi). For psi = 0, Davis (1968) has another friction on slip planes: tan(phi*) = sin(phi) cos(psi) / (1 - sin(phi) sin(psi)), K_P = 2.62 by
Rankine with phi*; sand that yields as a whole, without slip planes, has 3.

Run it with `scripts/run examples/earth_pressure/earth_pressure.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Active and passive earth pressure.',
        cells=(20, 'over the height of the wall'),
        fBar=(1, '1: with F-bar, 0: without'),
        young=(2e8, 'modulus [Pa], so stiff that both limits come within half a cell'),
        steps=(20, 'load steps for each movement'),
        rough=(0, '1: the base holds the sand sideways too'),
        psi=('30', 'angles of dilation [degrees], with commas between'),
        movement=(0.4, 'of the wall at the end, in cells'))

H, L, gamma, phi = 5., 20., 20e3, 30
h = H / options.cells


def move(direction, psi):
	"""Movement of the wall [m] and K after each step; *direction* 1: into the sand, -1: away from it."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=options.young, poisson=0.3, density=gamma / 10, cohesion=0, frictionAngle=np.radians(phi), dilationAngle=np.radians(psi), label='sand'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, pointsPerCell=2, material='sand'))
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid,
	                gravity=(0, -10, 0),
	                gravityCurve=[(0, 1)],
	                fBar=bool(options.fBar),
	                boundaries=[
	                        MpmBoundary(max=(0, inf, inf), fix='x', displacement=(direction * options.movement * h, 0, 0)),
	                        MpmBoundary(min=(L, -inf, -inf), fix='x'),
	                        *([MpmBoundary(min=(h, -inf, -inf), max=(inf, 0, inf), fix='x')] if options.rough else []), # the node at the foot of the wall moves with it
	                        MpmBoundary(max=(inf, 0, inf), fix='y'),
	                ],
	                label='solver',
	        )
	]
	O.dt = 1 / options.steps
	mpm.geostatic()
	curve, solves = [], []
	try:
		for _ in range(options.steps):
			O.step()
			curve.append((solver.loadFactor * options.movement * h, abs(solver.reactions[0][0]) / (gamma * H**2 / 2)))
			solves.append(solver.iterations)
	except RuntimeError as error:
		print(error)
	return np.array([(0, 1 - np.sin(np.radians(phi)))] + curve), np.mean(solves)


def exact(psi, direction):
	"""By Rankine with the friction on slip planes of Davis."""
	sine, dilation = np.sin(np.radians(phi)), np.sin(np.radians(psi))
	slip = np.arctan(sine * np.cos(np.radians(psi)) / (1 - sine * dilation))
	return ((1 + np.sin(slip)) / (1 - np.sin(slip)))**direction


figure, axes = plt.subplots(2, 2, figsize=(12.5, 6.4), width_ratios=[1, 1.6], layout='constrained')
for row, (direction, name, side) in enumerate([(-1, 'active', 'away from the sand'), (1, 'passive', 'into the sand')]):
	axis, picture = axes[row]
	for number, psi in enumerate(map(float, options.psi.split(','))):
		if direction < 0 and psi < phi: continue  # without cohesion and dilation: no convergence where the sand follows the wall
		begin = time.time()
		curve, solves = move(direction, psi)
		K, theory = curve[-1, 1], exact(psi, direction)
		rise = 100 * (curve[-1, 1] / np.interp(0.75 * curve[-1, 0], *curve.T) - 1)
		print(f'{name}, psi = {psi:g}: K = {K:.4f}, theory {theory:.4f} ({100 * (K / theory - 1):+.2f} %), over the last quarter {rise:+.2f} %, {solves:.1f} iterations a step, '
		      f'{time.time() - begin:.1f} s')
		axis.plot(1000 * curve[:, 0], curve[:, 1], label=f'$\\psi$ = {psi:g}°')
		axis.axhline(theory, color=f'C{number}', linestyle='--', linewidth=0.8)
		if number == 0:
			points = mpm.arrays()
			mpm.plot('plasticStrain', grid=False, ghost=False, ax=picture, range=(0, np.quantile(points['plasticStrain'], 0.98)), colormap='YlOrRd')
			picture.set_title(f'{name}: plastic strain, psi = {psi:g}°', fontsize='medium')
	axis.set(title=f'Wall moves {side}; dashed: Rankine, Davis', xlabel='movement [mm]', ylabel='$K = 2 P / \\gamma H^2$')
	axis.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'earth_pressure.png'), dpi=130)
print(f'written: {options.out}/earth_pressure.png')
