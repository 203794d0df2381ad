#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A band of clay between two rough walls that slide past each other, at an angle to the grid: shear stress over the undrained strength.

The band is 1 m thick and 12 m long, with free ends; 1 is right for a band without ends. Its ends give the same loss at all angles.

Run it with `scripts/run examples/benchmarks/shear.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
from math import cos, inf, radians, sin

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('A band of clay that is sheared at an angle to the grid.',
        degrees=(0., 'angle of the band to the lines of the grid [degrees]'),
        cellSize=(0.25, 'h [m]'),
        pointsPerCell=(2, 'material points per cell and axis'),
        domains=('tiling', "rule of the domains, 'tiling' or 'stretch'"),
        shear=(2., 'displacement of the upper wall over the thickness of the band [-]'),
        steps=(160, 'load steps'))

thickness, length, strength = 1., 12., 1e4
angle = radians(options.degrees)
along, across = np.array([cos(angle), sin(angle)]), np.array([-sin(angle), cos(angle)])


def corner(s, z):
	"""Point at the distances s along and z across the band from its centre."""
	return tuple(s * length / 2 * along + z * thickness / 2 * across)


O.materials.append(MpmTrescaMat(young=5e6, poisson=0.49, density=1, undrainedStrength=strength, label='clay'))
grid = MpmGrid(cellSize=options.cellSize)
O.bodies.append(mpm.fill(mpm.polygon([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]), grid, options.pointsPerCell, 'clay'))
area = mpm.arrays()['volume'].sum() / thickness
velocity = options.shear * thickness * along
solver = MpmImplicitEngine(
        grid=grid,
        verbosity=0,
        fBar=True,
        domains=options.domains,
        newton=MpmNewton(minStep=1 / 64),
        boundaries=[MpmBoundary(surface=[corner(-1, -1), corner(1, -1)], fix='xy'), MpmBoundary(surface=[corner(1, 1), corner(-1, 1)], fix='xy', velocity=(*velocity, 0))]
)
O.engines, O.dt = [solver], 1 / options.steps
for part in range(8):
	O.run(options.steps // 8, wait=True)
	stress = np.array(solver.reactions[1])[:2] @ along / area
	print(f'shear {options.shear * (part + 1) / 8:.3g}: tau / c_u = {stress / strength:.3f}, clampedDomains {solver.clampedDomains}', flush=True)
