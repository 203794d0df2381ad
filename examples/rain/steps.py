#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A bank of saturated loose silt that fails and runs out: seconds that implicit steps take, beside the number of explicit ones that stability would ask for. Run it with `scripts/run examples/rain/steps.py`.

Explicit steps of drained soil are bounded by MpmDynamicEngine.criticalTimeStep(), and take so many where a pressure solve in each takes the water (semi-implicit). Without, the bound is as much less as waves of undrained soil are faster,
and at most h2 / (4 c_v), in which pressure spreads over a cell of the plane. Seconds of explicit steps are measured without water, and without the pressure solve, so that they are the least.
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
	O.materials.append(MpmMohrCoulombMat(young=young, poisson=poisson, density=density, cohesion=100, frictionAngle=np.radians(8), conductivity=conductivity, porosity=porosity, label='silt'))
	if 'flow' in settings: O.materials[0].retention = MpmVanGenuchten(alpha=1, n=2)  # water that no air replaces would hold the bank by its suction
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (8, 0), (4, 4), (0, 4)]), grid, 2, 'silt'))
	if 'flow' in settings: mpm.assign(excessPressure=[9810 * (4 - y) for y in mpm.arrays()['pos'][:, 1]])
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, loadCurve=[(0, 1)], verbosity=0, **settings)]


print('| Young [MPa] | K [m/s] | drained step [ms] | undrained step [ms] | h2 / (4 c_v) [ms] | implicit steps | implicit [s] | run-out [m] | explicit, undrained | [s] at least | semi-implicit | [s] at least |')
for young in map(float, options.young.split(',')):
	for conductivity in map(float, options.conductivity.split(',')):
		modulus = young * (1 - poisson) / (1 + poisson) / (1 - 2 * poisson)
		bank(young, conductivity, scheme='explicit')
		drained = 0.9 * O.engines[0].criticalTimeStep()
		undrained, spread = drained / np.sqrt(1 + water / porosity / modulus), options.cellSize**2 / (4 * conductivity / 9810 * modulus)
		O.dt, begin = drained / 4, time.time()
		O.run(options.timed, wait=True)
		each = (time.time() - begin) / options.timed
		bank(young, conductivity, flow=MpmFlow(total=True, bulkModulus=water, drains=[MpmDrain(surface=[(0, 0), (2, 0)], flux=0)]))
		O.dt, begin = options.step, time.time()
		while O.time < options.end - O.dt / 2: O.step()
		seconds, reached = time.time() - begin, mpm.arrays()['pos'][:, 0].max() - mpm.arrays()['pos0'][:, 0].max()
		full, half = options.end / min(undrained, spread), options.end / drained
		print(f'| {young / 1e6:g} | {conductivity:g} | {1e3 * drained:.2f} | {1e3 * undrained:.3f} | {1e3 * spread:.3g} | {O.iter} | {seconds:.0f} | {reached:.2f} | {full:.0f} | {full * each:.0f} | {half:.0f} | {half * each:.1f} |')
