#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Troughs above the same tunnel in sand that is described by three laws: Mohr and Coulomb's with one modulus, hardening soil, and hardening soil with small-strain stiffness. All parameters follow from the relative density (Brinkgreve, Engin and Engin 2010)."""
import os
import sys
import time
from yade import mpm
import numpy as np
from scipy.optimize import curve_fit
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions
from style import plt
laws = dict(constant="Mohr-Coulomb", hardening='hardening soil', smallStrain='hardening soil with small-strain stiffness')
options = readOptions(
        'Troughs above a tunnel, by law.',
        cellSize=(1., '[m]'),
        OCR=(2., 'overconsolidation ratio of the ground at rest'),
        volumeLoss=(0.01, 'part of the area of the tunnel'),
        relativeDensity=(0.6, 'of the sand'),
        steps=(10, 'of the contraction'),
        laws=(' '.join(laws), 'in quotes, some of these')
)
h, R, depth, width, base = options.cellSize, 3, 15, 45, 30
ring = [(R * np.sin(a), R * np.cos(a) - depth) for a in np.linspace(0, np.pi, 49)]  # half of it, from crown to invert
ring[0], ring[-1] = (0, R - depth), (0, -R - depth)


def sand(law):
	"""The law's material; the constant modulus is that of first loading under the smallest stress at the axis of the tunnel."""
	D = options.relativeDensity
	typical = mpm.typicalSand(D, pressure=100e3, poisson=0.2) | dict(cohesion=1e3, label='sand')
	atRest = 1 - np.sin(typical['frictionAngle'])
	if law == 'constant':
		pressure = atRest * typical['density'] * 10 * depth
		return MpmMohrCoulombMat(**typical | dict(young=mpm.typicalSand(D, pressure=pressure, poisson=0.2)['young']))
	first = typical.pop('young')
	small = dict(G0ref=60e6 + 68e6 * D, gamma07=(2 - D) * 1e-4) if law == 'smallStrain' else {}
	return MpmHardeningSoilMat(E50ref=first, Eoedref=first, Eurref=3 * first, power=0.7 - D / 3.2, referencePressure=100e3, failureRatio=1 - D / 8, K0nc=atRest, **typical, **small)


def trough(law):
	"""Places [m] and settlements [m] of the surface by the contraction, the solver's scene being left for a picture."""
	O.reset()
	O.materials.append(sand(law))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, -base), (width, -base), (width, 0), (0, 0)]), grid, 2, 'sand'))
	lining = MpmBeam(line=ring, axialStiffness=1e10, bendingStiffness=5e7, fixHead='xr', fixFoot='xr', contraction=options.volumeLoss, curve=[(0, 0), (5, 0), (5 + options.steps, 1)])
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -base, inf), fix='xy')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0)
	O.engines, O.dt = [solver], 1
	mpm.geostatic(OCR=options.OCR)
	solver.loads = [lining]
	O.run(1, wait=True)
	mpm.stages.excavate(lambda x, pad=0: np.hypot(x[0], x[1] + depth) < R, steps=4)
	O.run(4, wait=True)
	mpm.stages.resetDisplacements()
	O.run(options.steps, wait=True)
	points = mpm.arrays()
	top = np.flatnonzero(points['pos0'][:, 1] > -h / 2)
	top = top[np.argsort(points['pos0'][top, 0])]
	return points['pos0'][top, 0], (points['pos0'] - points['pos'])[top, 1]


def gauss(x, largest, i):
	return largest * np.exp(-x**2 / (2 * i**2))


lost = options.volumeLoss * np.pi * R**2
figure, (settlements, shapes) = plt.subplots(1, 2, figsize=(12, 4.5), layout='constrained')
for law in options.laws.split():
	began = time.time()
	x, s = trough(law)
	(fitted, i), _ = curve_fit(gauss, x, s, (s.max(), 0.4 * depth))
	inflexion = np.interp(-np.exp(-0.5), -s / s[0], x)  # the curve falls outwards
	volume = 2 * s.sum() * (x[1] - x[0])
	print(f'{laws[law]}: i = {i:.2f} m = {i / depth:.3f} z0 by fit, {inflexion:.2f} m where 0.61 of the largest, settles {1e3 * s[0]:.2f} mm, volume {volume / lost:.3f} of the loss, {time.time() - began:.0f} s')
	line, = settlements.plot(x, -1e3 * s, label=laws[law])
	settlements.plot(x, -1e3 * gauss(x, fitted, i), ':', color=line.get_color())
	shapes.plot(x, s / s[0], color=line.get_color())
for K in 0.25, 0.45:
	shapes.plot(x, gauss(x, 1, K * depth), 'k--', linewidth=0.8, label='sand, i = 0.25 and 0.45 z0' if K < 0.3 else None)
settlements.set(xlabel='distance from the axis [m]', ylabel='vertical displacement [mm]', title="settlement; dotted: Gauss' curves")
shapes.set(xlabel='distance from the axis [m]', ylabel='settlement over the largest [-]', title='shape')
settlements.legend()
shapes.legend()
figure.savefig(f'{options.out}/trough.png')
