#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cone resistance of sand in calibration chambers, predicted from relative density alone: a cone of 60 degrees, wished in place in sand under a uniform stress, is pushed by ten radii.

Laws by the formulas of Brinkgreve, Engin and Engin (2010), made for Toyoura, Ham River, Hostun and Ticino sand: hardening soil whose dilation ends at the loosest state, or Mohr-Coulomb. No fit.
Measured, Ticino sand, normally consolidated: G. Baldi, R. Bellotti, V. Ghionna, M. Jamiolkowski and E. Pasqualini (1986): Interpretation of CPTs and CPTUs. 4th Int. Geotech. Seminar, Singapore:
q_c = 157 kPa (sigma_v / kPa)^0.55 exp(2.41 D).
"""
import os
import sys
import numpy as np
from yade import mpm
folder = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [os.path.join(folder, '..'), os.path.join(folder, '..', '..', 'scripts', 'lib')]
from contacts.bodies import Outline, steel
from contacts.course import Course
from contacts.penetration import Ground
from options import compared, readOptions
from style import plt
options = readOptions('Cone resistance of sand in calibration chambers.',
        densities=('0.4 0.6 0.8', 'relative densities, between blanks'),
        pressure=(100e3, 'vertical stress [Pa]'),
        law=('hardening', "'hardening' or 'constant' (Mohr-Coulomb with one modulus)"),
        cells=(2, 'over the radius of the cone'),
        depth=(10., 'way in radii'),
        friction=(0., 'of the cone [degrees]'),
        seconds=(600., 'of processor time for each, after which it ends with what it has'))
R, largest, smallest, stepsPerCell = 1., 0.93, 0.58, 8  # radius [m]; void ratios of Ticino sand


def sand(D):
	"""The material 'soil', and its K0."""
	typical = mpm.typicalSand(D, pressure=100e3, poisson=0.2) | dict(label='soil', density=1, cohesion=options.pressure / 1000)
	K0, first = 1 - np.sin(typical['frictionAngle']), typical['young']
	if options.law == 'constant':
		O.materials.append(MpmMohrCoulombMat(**typical | dict(young=3 * first * (options.pressure / 100e3)**(0.7 - D / 3.2))))
	else:
		typical.pop('young')
		opens = np.log((1 + largest) / (1 + largest - D * (largest - smallest)))
		O.materials.append(MpmHardeningSoilMat(E50ref=first, Eoedref=first, Eurref=3 * first, power=0.7 - D / 3.2, failureRatio=1 - D / 8, K0nc=K0, mostDilation=opens, **typical))
	return K0


def pushed(D):
	"""Way [radii] and resistance [Pa] by step."""
	O.reset()
	K0 = sand(D)
	steel()
	h, tip = R / options.cells, R / np.tan(np.radians(30))
	start = -R - tip
	ground = Ground(h, start - options.depth * R, [(R, 0), (R, -R), (0, start)], axisymmetric=True)
	ground.fill(3)
	number = len(mpm.arrays()['id'])
	mpm.assign(stress=np.repeat(-options.pressure * np.diag([K0, 1, K0])[None], number, axis=0))
	high = start + tip + options.depth * R + 3 * R
	cone = Outline([(0, start), (R, -R), (R, high), (0, high)])
	contact = MpmContact(stiffness=10, friction=np.radians(options.friction))
	load = MpmTraction(surface=[(ground.width, 0), (R, 0)], pressure=options.pressure)
	solver = MpmImplicitEngine(grid=ground.grid, fBar=True, boundaries=ground.rollers(True), loads=[load], loadCurve=[(0, 1)], contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], 1
	course = Course(solver, options.seconds)
	rows = []
	cone.move((0, -h / stepsPerCell, 0))
	course.run(round(options.depth * options.cells * stepsPerCell), lambda: rows.append((-cone.way[1] / R, cone.force(contact, [0])[1] / (np.pi * R**2))))
	print(f"  {number} points, {course.told()}", flush=True)
	return np.transpose(rows)


figure, (line, final) = plt.subplots(1, 2, figsize=(10, 4.6), layout='constrained')
found = []
for D in map(float, options.densities.split()):
	way, q = pushed(D)
	late = q[way > 0.6 * way[-1]].mean()
	measured = 157e3 * (options.pressure / 1e3)**0.55 * np.exp(2.41 * D)
	found.append((D, late, measured))
	print(f'relative density {D:g}: {late / 1e6:.2f} MPa from {0.6 * way[-1]:.1f} to {way[-1]:.1f} radii, measured {measured / 1e6:.2f} MPa ({100 * (late / measured - 1):+.0f} %)', flush=True)
	compared(f'cone resistance of sand, relative density {D:g}, {options.pressure / 1e3:g} kPa, {options.law}', late / 1e6, measured / 1e6, 'Baldi et al. 1986, experiments in chambers', 'MPa')
	line.plot(q / 1e6, way, label=f'relative density {D:g}')
line.set(xlabel='resistance of the tip [MPa]', ylabel='way / R', xlim=(0, None), ylim=(way[-1], 0))
line.legend(frameon=False)
D, late, measured = np.transpose(found)
final.plot(D, late / 1e6, 'o-', label='predicted')
final.plot(D, measured / 1e6, 'k--', label='chambers, Baldi et al.')
final.set(xlabel='relative density', ylabel='resistance of the tip [MPa]', ylim=(0, None))
final.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'chamber.png'), dpi=100)
