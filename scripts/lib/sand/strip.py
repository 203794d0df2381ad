# SPDX-License-Identifier: GPL-2.0-or-later
"""Half of a strip of width B = 1 that sinks into sand, borne by its weight, by a surcharge beside it or by cohesion."""
from math import inf, radians, sin

import numpy as np
from contacts.course import Course
from yade import mpm, pack, utils
from yade.wrapper import FrictMat, MpmAdaptation, MpmBoundary, MpmContact, MpmGhost, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmRefinement, MpmTraction, Omega

from .exact import cohesionFactor, surchargeFactor, weightFactor

O = Omega()
density, gravity = 2000, 10.
weight = density * gravity
early = .25  # part of the way


def sizes(phi, isRough):
	"""Size of the ground, in widths, that holds the mechanism: half the width, depth."""
	return {(20, False): (1.5, .6), (20, True): (2., .8), (30, False): (2.5, 1.), (30, True): (3.5, 1.3)}[phi, isRough]


def strip(phi, isRough=False, load='weight', cells=8, points=2, steps=40, settlement=1e-3, stiff=1e4, cohesion=1e-3, fBar=True, relaxation=False, tolerance=None, halvings=None, finer=None, seconds=200, **ghost):
	"""The factor N_gamma, N_q or N_c after a quarter and all of the way; N_gamma less what the cohesion and the settlement add.

	:param load: what bears the strip: 'weight', 'surcharge' or 'cohesion', the last two of sand without weight
	:param cells: over half the width, without the half cell at the edge, which ends in the middle between two nodes
	:param points: per cell and direction
	:param stiff: Young's modulus over the bearing pressure that is exact
	:param cohesion: over weight and width, of sand that weighs
	:param relaxation: MpmImplicitEngine.pressureRelaxation
	:param tolerance: of Newton's method, if not its own
	:param halvings: None: the strip is nodes with a prescribed displacement; a number: it is a rigid Box with MpmContact, with cells halved so often at its edge (MpmAdaptation)
	:param finer: width and depth of a region below the strip whose cells are halved once (MpmRefinement)
	:param ghost: MpmGhost's, instead of those for sand that yields
	"""
	isBox = halvings is not None
	h = .5 / (cells if isBox else cells + .5)
	isHeavy, isLoaded = load == 'weight', load == 'surcharge'
	exact = weightFactor(phi, isRough) if isHeavy else surchargeFactor(phi) if isLoaded else cohesionFactor(phi)
	bears = weight * exact * (.5 if isHeavy else 1)  # surcharge, and the cohesion of sand without weight, are the weight of a cube
	O.reset()
	O.materials.append(
	        MpmMohrCoulombMat(
	                young=stiff * bears, poisson=.3, density=density, cohesion=dict(weight=cohesion, surcharge=0, cohesion=1)[load] * weight, frictionAngle=radians(phi), dilationAngle=radians(phi), label='sand'))
	grid = MpmGrid(cellSize=h, refinements=[MpmRefinement(min=(-inf, -finer[1], -inf), max=(finer[0], inf, inf))] if finer else [],
	               adaptation=[MpmAdaptation(halvings=halvings)] if halvings else [])
	width, depth = (round(size / h) * h for size in sizes(phi, isRough or not isHeavy))
	ground = pack.inAlignedBox((0, -depth, -1), (width, 0, 1))
	O.bodies.append(mpm.fill(ground, grid, points, 'sand'))
	foot = [] if isBox else [MpmBoundary(min=(-inf, 0, -inf), max=(cells * h, 0, inf), fix='xy' if isRough else 'y', displacement=(0, -settlement, 0))]
	if isBox:
		O.materials.append(FrictMat(label='steel'))
		box = O.bodies[O.bodies.append(utils.box((0, 1, 0), (.5, 1, 1), material='steel', fixed=True))]
		box.state.vel = (0, -settlement, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	beside = mpm.surface(ground, min=(.5, 0), max=(width, 0)) if isLoaded else None
	loads = dict(gravity=(0, -gravity, 0), gravityCurve=[(0, 1)]) if isHeavy else dict(loads=[MpmTraction(surface=beside, pressure=weight, curve=[(0, 1)])] if isLoaded else [])
	solver = MpmImplicitEngine(grid=grid, boundaries=[*foot, *sides], contacts=[MpmContact(friction=radians(89) if isRough else 0)] if isBox else [], fBar=fBar, pressureRelaxation=relaxation, ghost=MpmGhost(**(dict(where='aggregates', memory=1) | ghost)), verbosity=0, **loads)
	O.engines, O.dt = [solver], 1 / steps
	if isLoaded: mpm.assign(stress=np.repeat(-weight * np.diag([1 - sin(radians(phi)), 1, 1 - sin(radians(phi))])[None], len(O.bodies), 0))
	if isHeavy: mpm.geostatic()
	if tolerance: solver.newton.tolerance = tolerance
	course, parts, curve = Course(solver, seconds), [], []

	def look():
		parts.append(course.steps / steps)
		pressure = abs(solver.contacts[0].forces[0][1] if isBox else solver.reactions[0][1]) / .5 / weight
		own = surchargeFactor(phi) * parts[-1] * settlement + cohesionFactor(phi) * cohesion
		curve.append(2 * (pressure - own) if isHeavy else pressure)

	course.run(steps, look)
	at = lambda part: float(np.interp(part, parts, curve)) if parts and parts[-1] > part - 1e-9 else float('nan')
	late = [value for part, value in zip(parts, curve) if part > .9 + 1e-9] if parts and parts[-1] > 1 - 1e-9 else [float('nan')]
	return dict(course.told(), exact=exact, quarter=at(early), whole=at(1.), late=float(np.mean(late)), points=len(O.bodies))
