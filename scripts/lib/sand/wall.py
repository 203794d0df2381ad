# SPDX-License-Identifier: GPL-2.0-or-later
"""A smooth wall of height one that goes away from sand or into it, on a smooth base."""
from math import inf, radians

from contacts.course import Course
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmGhost, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, Omega

from .exact import rankine
from .strip import density, gravity, weight

O = Omega()
length = 4


def wall(phi, isPassive, cells=10, points=2, steps=20, seconds=200, **ghost):
	"""K of Rankine; the wall moves by a tenth of a cell, and the height is that at first.

	:param cells: over the height
	:param points: per cell and direction
	"""
	h = 1 / cells
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=5e4 * weight, poisson=.3, density=density, cohesion=0, frictionAngle=radians(phi), dilationAngle=radians(phi), label='sand'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -1, -1), (length, 0, 1)), grid, points, 'sand'))
	moving = MpmBoundary(max=(0, inf, inf), fix='x', displacement=(.1 * h * (1 if isPassive else -1), 0, 0))
	sides = [MpmBoundary(min=(length, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1, inf), fix='y')]
	settings = dict(where='aggregates', memory=1) | ghost
	solver = MpmImplicitEngine(grid=grid, boundaries=[moving, *sides], fBar=True, ghost=MpmGhost(**settings), gravity=(0, -gravity, 0), gravityCurve=[(0, 1)], verbosity=0)
	O.engines, O.dt = [solver], 1 / steps
	mpm.geostatic()
	course, values = Course(solver, seconds), []
	course.run(steps, lambda: values.append(abs(solver.reactions[0][0]) / (weight / 2)))
	ended = course.steps == steps
	return dict(course.told(), exact=rankine(phi, isPassive), quarter=values[steps // 4 - 1] if len(values) >= steps // 4 else float('nan'), whole=values[-1] if ended else float('nan'), points=len(O.bodies))
