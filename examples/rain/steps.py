#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A bank of saturated silt that fails and runs out: seconds that implicit steps take, beside the number of explicit ones that stability would ask for. Run it with `scripts/run examples/rain/steps.py`.

Explicit steps are bounded by cell size over the speed of waves, of drained soil where a pressure solve in each step takes the water (semi-implicit), of undrained soil without; and by h2 / (4 c_v), in which pressure spreads over a cell
of the plane. Seconds of explicit steps are measured without water, which is less than with it.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Implicit and explicit steps of a run-out with water.',
        cellSize=(0.5, '[m]'), end=(3., 'of the run-out [s]'), step=(0.01, 'implicit one [s]'), young=('5e6,5e7', "Young's moduli [Pa]"), conductivity=('1e-6,1e-4', '[m/s]'), timed=(200, 'explicit steps that are timed'))
water, density, porosity, poisson = 2.2e9, 1950, 0.42, 0.3


def bank(young, conductivity, **settings):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=young, poisson=poisson, density=density, cohesion=500, frictionAngle=np.radians(20), conductivity=conductivity, porosity=porosity, label='silt'))
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (8, 0), (4, 4), (0, 4)]), grid, 2, 'silt'))
	if 'flow' in settings: mpm.assign(excessPressure=[9810 * (4 - y) for y in mpm.arrays()['pos'][:, 1]])
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, loadCurve=[(0, 1)], verbosity=0, **settings)]


print('| Young [MPa] | K [m/s] | h / c drained [ms] | h / c undrained [ms] | h2 / (4 c_v) [ms] | implicit steps | implicit [s] | run-out [m] | explicit, undrained | [s] at least | semi-implicit | [s] at least |')
for young in map(float, options.young.split(',')):
	for conductivity in map(float, options.conductivity.split(',')):
		modulus, h = young * (1 - poisson) / (1 + poisson) / (1 - 2 * poisson), options.cellSize
		waves, stiff, spread = h / np.sqrt(modulus / density), h / np.sqrt((modulus + water / porosity) / density), h**2 / (4 * conductivity / 9810 * modulus)
		bank(young, conductivity, scheme='explicit')
		O.dt, begin = 0.3 * waves, time.time()
		O.run(options.timed, wait=True)
		each = (time.time() - begin) / options.timed
		bank(young, conductivity, flow=MpmFlow(total=True, bulkModulus=water, drains=[MpmDrain(surface=[(8, 0), (4, 4), (0, 4)])]))
		O.dt, begin = options.step, time.time()
		while O.time < options.end - O.dt / 2: O.step()
		seconds, reached = time.time() - begin, mpm.arrays()['pos'][:, 0].max() - 8
		full, half = options.end / min(stiff, spread), options.end / waves
		print(f'| {young / 1e6:g} | {conductivity:g} | {1e3 * waves:.2f} | {1e3 * stiff:.3f} | {1e3 * spread:.3g} | {O.iter} | {seconds:.0f} | {reached:.2f} | {full:.0f} | {full * each:.0f} | {half:.0f} | {half * each:.1f} |')
