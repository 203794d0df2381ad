# SPDX-License-Identifier: GPL-2.0-or-later
"""Edges that move with the body, beyond which free ground is shaken."""
import numpy as np
import pytest

scene = '''
from scenes import *
import numpy as np
import json

cs = 200.  # of shear waves [m/s]
G, density, h = 2000 * cs**2, 2000., 2.

def pulse(t, length=0.6):
	"""A velocity [m/s] that comes back to rest, after a displacement of .4 m, 0.2 cells."""
	return np.where((t > 0) & (t < length), 0.4 / length * (1 - np.cos(2 * np.pi * t / length)), 0)

def body(corners, gravity=0., label=lambda x: 'soil', materials=None):
	"""In equilibrium with its weight, its sides and its base held."""
	O.materials.append(materials or [MpmElasticMat(young=2.5 * G, poisson=0.25, density=density, label='soil')])
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon(corners), grid, 2, label))
	right = max(x for x, y in corners)
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(right, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	settings = dict(grid=grid, gravity=(0, -gravity, 0), verbosity=0)
	if gravity:
		O.engines, O.dt = [MpmImplicitEngine(boundaries=held, newton=MpmNewton(tolerance=1e-11), **settings)], 0.5
		O.run(4, wait=True)
		O.resetTime()
		mpm.stages.resetDisplacements()
	O.dt = 0.02
	return settings

def level(width=8, height=6, **settings):
	return body([(0, 0), (width * h, 0), (width * h, height * h), (0, height * h)], **settings)

def refused(call, expected):
	try:
		call()
	except (ValueError, TypeError, RuntimeError) as error:
		assert expected in str(error), (expected, str(error))
	else:
		assert False, 'not refused: ' + expected
'''
