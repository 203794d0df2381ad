#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Five square footings on sand, loaded in the field to 150 mm: prediction by hardening soil from relative density and triaxial tests, without a fit.

	axis Q
	  |####|               concrete, circle of the same area
	  |####|v v v v v v|o  weight of 0.75 m of sand
	  |   sand         |o  sides slide, base constrained

Measured: J.-L. Briaud and R. M. Gibbens (1994): Predicted and measured behavior of five spread footings on sand. ASCE, Geotechnical Special Publication 41.
"""
import os
import sys
from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Footings on sand in the field.',
        cells=(4, 'cells over the radius'),
        steps=(20, 'load steps to 150 mm'),
        relativeDensity=(0.55, 'of the sand'),
        frictionAngle=(35., 'of triaxial tests [degrees]'),
        cohesion=(0., 'by suction [Pa]'),
        OCR=(1., 'overconsolidation ratio'))
measured = {'1 m': (1, 850, 1740), '1.5 m': (1.5, 1500, 3400), '2.5 m': (2.5, 3600, 7100), '3 m, south': (3, 4500, 9000), '3 m, north': (3, 5200, 10250)}  # width [m], loads at 25 and 150 mm [kN]
weight, embedment, most = 15.5e3, 0.75, 0.15  # of the sand [N/m3]; of the base below the ground, settlement [m]


def sand():
	"""Hardening soil with small-strain stiffness by relative density (Brinkgreve, Engin and Engin 2010)."""
	D, phi = options.relativeDensity, np.radians(options.frictionAngle)
	typical = mpm.typicalSand(D, pressure=100e3, poisson=0.2) | dict(density=weight / 9.81, cohesion=options.cohesion, frictionAngle=phi)
	first = typical.pop('young')
	return MpmHardeningSoilMat(label='sand', E50ref=first, Eoedref=first, Eurref=3 * first, power=0.7 - D / 3.2, failureRatio=1 - D / 8, K0nc=1 - np.sin(phi), G0ref=60e6 + 68e6 * D, gamma07=(2 - D) * 1e-4, **typical)


def loads(width):
	"""Settlements [m] and loads [kN] of a footing; its scene stays."""
	O.reset()
	R = width / np.sqrt(np.pi)
	O.materials.append([sand(), FrictMat(label='concrete')])
	grid = MpmGrid(cellSize=R / options.cells, axisymmetric=True)
	ground = mpm.polygon([(0, -5 * R), (5 * R, -5 * R), (5 * R, 0), (0, 0)])
	O.bodies.append(mpm.fill(ground, grid, 2, 'sand'))
	footing = O.bodies[O.bodies.append(utils.box((0, 1, 0), (R, 1, 1), material='concrete', fixed=True))]
	footing.state.vel = (0, -most, 0)
	sides = [MpmBoundary(min=(5 * R, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -5 * R, inf), fix='xy')]
	beside = MpmTraction(surface=mpm.surface(ground, min=(0, 0), max=(5 * R, 0)), pressure=weight * embedment, curve=[(0, 1)])
	contact = MpmContact(friction=np.radians(options.frictionAngle))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], fBar=True, ghost=MpmGhost(where='aggregates', memory=1), boundaries=sides, loads=[beside], contacts=[contact], verbosity=0)]
	O.dt = 1 / options.steps
	mpm.geostatic(surface=embedment, OCR=options.OCR)
	curve = [(0, 0)]
	for _ in range(options.steps):
		O.step()
		curve.append((1 - footing.state.pos[1], contact.forces[0][1] / 1e3))
	return np.array(curve).T


figure, (lines, scene) = plt.subplots(1, 2, figsize=(12, 4.6), layout='constrained')
curves = {width: loads(width) for width in (1, 1.5, 2.5, 3)}
colours = dict(zip(curves, ('C0', 'C1', 'C2', 'C3')))
for width, (settlement, load) in curves.items(): lines.plot(1e3 * settlement, load / 1e3, color=colours[width], label=f'{width:g} m')
for name, (width, *tests) in measured.items():
	for at, test in zip((0.025, 0.15), tests):
		found = np.interp(at, *curves[width])
		print(f'footing of {name} at {1e3 * at:g} mm: {found:.0f} kN, measured {test} kN ({100 * (found / test - 1):+.0f} %)')
		compared(f'load of a footing of {name} at {1e3 * at:g} mm', found, test, 'Briaud and Gibbens 1994, field', 'kN')
		lines.plot(1e3 * at, test / 1e3, 'o', color=colours[width])
lines.set(xlabel='settlement [mm]', ylabel='load [MN]', xlim=(0, None), ylim=(0, None), title='lines: predicted, points: measured')
lines.legend(frameon=False)
mpm.plot('displacement', ax=scene)
figure.savefig(os.path.join(options.out, 'footings.png'), dpi=100)
