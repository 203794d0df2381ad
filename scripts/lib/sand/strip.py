# SPDX-License-Identifier: GPL-2.0-or-later
"""Half of a strip of width B = 1 that sinks into sand, by its weight or by a surcharge beside it."""
from math import inf, radians, sin

import numpy as np
from contacts.course import Course
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmGhost, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmTraction, Omega

from .exact import cohesionFactor, surchargeFactor, weightFactor

O = Omega()
density, gravity = 2000, 10.
weight = density * gravity
early = .25  # of the way


def sizes(phi, isRough):
	"""Of the ground, in widths, that holds the mechanism: half the width, depth."""
	return {(20, False): (1.5, .6), (20, True): (2., .8), (30, False): (2.5, 1.), (30, True): (3.5, 1.3)}[phi, isRough]


def strip(phi, isRough=False, surcharge=False, cells=8, points=2, steps=40, settlement=1e-3, stiff=1e4, cohesion=1e-3, fBar=True, tolerance=None, seconds=200, **ghost):
	"""The factor N_gamma, or N_q, after a quarter and all of the way, less what the cohesion and the settlement add.

	:param cells: over half the width, without the half cell at the edge, which ends in the middle between two nodes
	:param points: per cell and direction
	:param stiff: Young's modulus over the bearing pressure that is exact
	:param cohesion: over weight and width; without a surcharge
	:param tolerance: of Newton's method, if not its own
	:param ghost: MpmGhost's, instead of those for sand that yields
	"""
	h = .5 / (cells + .5)
	exact = 2 * surchargeFactor(phi) if surcharge else weightFactor(phi, isRough)
	O.reset()
	O.materials.append(
	        MpmMohrCoulombMat(
	                young=stiff * exact * weight / 2, poisson=.3, density=density, cohesion=0 if surcharge else cohesion * weight, frictionAngle=radians(phi), dilationAngle=radians(phi), label='sand'))
	grid = MpmGrid(cellSize=h)
	width, depth = (round(size / h) * h for size in sizes(phi, isRough or surcharge))
	ground = pack.inAlignedBox((0, -depth, -1), (width, 0, 1))
	O.bodies.append(mpm.fill(ground, grid, points, 'sand'))
	foot = MpmBoundary(min=(-inf, 0, -inf), max=(cells * h, 0, inf), fix='xy' if isRough else 'y', displacement=(0, -settlement, 0))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	beside = mpm.surface(ground, min=(.5, 0), max=(width, 0)) if surcharge else None
	loads = dict(loads=[MpmTraction(surface=beside, pressure=weight, curve=[(0, 1)])]) if surcharge else dict(gravity=(0, -gravity, 0), gravityCurve=[(0, 1)])
	solver = MpmImplicitEngine(grid=grid, boundaries=[foot, *sides], fBar=fBar, ghost=MpmGhost(**(dict(where='aggregates', memory=1) | ghost)), verbosity=0, **loads)
	O.engines, O.dt = [solver], 1 / steps
	if surcharge: mpm.assign(stress=np.repeat(-weight * np.diag([1 - sin(radians(phi)), 1, 1 - sin(radians(phi))])[None], len(O.bodies), 0))
	else: mpm.geostatic()
	if tolerance: solver.newton.tolerance = tolerance
	course, parts, curve = Course(solver, seconds), [], []

	def look():
		parts.append(course.steps / steps)
		pressure = abs(solver.reactions[0][1]) / .5 / weight
		own = surchargeFactor(phi) * parts[-1] * settlement + (0 if surcharge else cohesionFactor(phi) * cohesion)
		curve.append(pressure if surcharge else 2 * (pressure - own))

	course.run(steps, look)
	exact = surchargeFactor(phi) if surcharge else exact
	at = lambda part: float(np.interp(part, parts, curve)) if parts and parts[-1] > part - 1e-9 else float('nan')
	late = [value for part, value in zip(parts, curve) if part > .9 + 1e-9] if parts and parts[-1] > 1 - 1e-9 else [float('nan')]
	return dict(course.told(), exact=exact, quarter=at(early), whole=at(1.), late=float(np.mean(late)), points=len(O.bodies))
