# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies as small as domains: their force must not depend on where they stand in a cell."""
import time
from math import atan, cos, inf, radians, sin, sqrt

import numpy as np
from yade import mpm, pack, utils
from yade.minieigenHP import Quaternion
from yade.wrapper import MpmBoundary, MpmContact, MpmElasticMat, MpmGrid, MpmImplicitEngine, MpmNewton, Omega

from .bodies import One, steel
from .course import Course, said, spread
from .penetration import clay, strength

O = Omega()
h = 1.


def _places(body, area, deep, places, soil, contact, seconds, push=None):
	"""Forces on a body pushed this deep at each of some places in a cell, over *area* c_u; and how often a warning of thin bodies was given.

	:param body: function of the place that adds one
	:param soil: function that makes the scene but for the body, and returns grid and boundaries
	"""
	steps, total, found, began, warned, why = 10, dict(iterations=0, cuts=0, steps=0), [], time.process_time(), 0, []
	for place in places:
		with said() as text:
			grid, sides = soil()
			rigid = body(place)
			touch = MpmContact(**contact)
			solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=sides, contacts=[touch], newton=MpmNewton(minStep=1 / 64), verbosity=0)
			O.engines, O.dt = [solver], 1
			rigid.move(push or ((0, -deep / steps, 0)))
			course = Course(solver, seconds / len(places))
			found.append(float(rigid.force(touch) @ _upwards(grid)) / area if course.run(steps) else float('nan'))
			for name in total: total[name] += course.told()[name]
			if course.why: why.append(course.why)
		warned += ('less than a cell' in text.text or 'less than three cells' in text.text) and 'WARN' in text.text
	whole = [F for F in found if F == F]
	of = dict(mean=float(np.mean(whole)) if whole else float('nan'), least=min(whole, default=float('nan')), spread=spread(whole) if len(whole) == len(found) else float('nan'))
	return dict(forces=found, **of, warned=warned, **total, seconds=round(time.process_time() - began, 1), why='; '.join(dict.fromkeys(why)))


def _upwards(grid):
	return np.array((0, 0, 1) if grid.dim == 3 else (0, 1, 0), float)


def _claySoil(law, wide=8, points=2):
	O.reset()
	clay(law)
	steel()
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -wide * h, -1), (wide * h, 0, 1)), grid, points, 'soil'))
	return grid, [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(wide * h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -wide * h, inf), fix='xy')]


def _spread(places, wide=8):
	return [wide / 2 * h + (k / places + .03) * h for k in range(places)]


def strip(width, deep=.5, places=5, law='vonMises', stiffness=10., points=2, wide=8, seconds=120):
	"""A smooth Box of this width pushed into clay that is *wide* wide and deep, in cells; force over c_u h. As *resolved*, what a body would feel that the cells could resolve: 5.14 (1 + 0.27 sqrt(s / w)) w (Salgado et al. 2004)."""
	body = lambda x: One(utils.box((x, 5 * h, 0), (width / 2 * h, 5 * h, 1), material='rigid', fixed=True))
	result = _places(body, strength * h, deep * h, _spread(places, wide), lambda: _claySoil(law, wide, points), dict(friction=0, stiffness=stiffness), seconds)
	return result | dict(resolved=5.14 * (1 + .27 * sqrt(deep / width)) * width)


def tip(degrees=45., deep=.5, places=5, law='vonMises', stiffness=10., points=2, wide=8, seconds=120):
	"""A Box of three cells that is turned, its lowest edge pushed into clay that is *wide* wide and deep, in cells; force over c_u h."""
	a = radians(degrees)
	low = 1.5 * h * (abs(cos(a)) + abs(sin(a)))

	def body(x):
		at = x + 1.5 * h * (cos(a) - sin(a)), low  # its corner (-1, -1) is the lowest, and at x
		return One(utils.box((*at, 0), (1.5 * h, 1.5 * h, 1), orientation=Quaternion((0, 0, 1), a), material='rigid', fixed=True))

	return _places(body, strength * h, deep * h, _spread(places, wide), lambda: _claySoil(law, wide, points), dict(friction=0, stiffness=stiffness), seconds)


def edge(degrees=90., rough=1., deep=.5, places=5, law='vonMises', stiffness=10., points=2, seconds=120):
	"""A Facet at this angle to the horizontal, its lower edge pushed into clay; force over c_u h. Upright and rough it is that of two faces, 2 s; smooth it is nothing."""
	a, long = radians(degrees), 10 * h
	contact = dict(friction=atan(5), adhesion=rough * strength, stiffness=stiffness) if rough else dict(friction=0, stiffness=stiffness)
	body = lambda x: One(utils.facet([(x, 0, 0), (x + long * cos(a), long * sin(a), 0), (x + long / 2 * cos(a), long / 2 * sin(a), long)], material='rigid', fixed=True))
	result = _places(body, strength * h, deep * h, _spread(places), lambda: _claySoil(law, points=points), contact, seconds)
	return result | (dict(exact=2. * deep * rough) if degrees == 90 else {})


def ball(diameter=.25, deep=.25, places=5, stiffness=10., wide=4, seconds=120):
	"""In 3D a Sphere of this diameter, in cells, pushed into elastic soil that is *wide* wide, with domains of half a cell; force over E h^2. Hertz: 4/3 E sqrt(R s^3) / (1 - nu^2), as long as s is much less than R."""
	young, nu = 1e6, .3

	def soil():
		O.reset()
		O.materials.append(MpmElasticMat(young=young, poisson=nu, density=1, label='soil'))
		steel()
		grid = MpmGrid(cellSize=h, dim=3)
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (wide * h, wide * h, 3 * h)), grid, 2, 'soil'))
		return grid, [MpmBoundary(max=(inf, inf, 0), fix='xyz')]

	R = diameter / 2 * h
	body = lambda x: One(utils.sphere((x - 4.5 * h + wide / 2 * h, wide / 2 * h + (x - 4 * h) * .7, 3 * h + R), R, material='rigid', fixed=True))
	result = _places(body, young * h * h, deep * h, _spread(places), soil, dict(friction=0, stiffness=stiffness), seconds, push=(0, 0, -deep * h / 10))
	return result | dict(hertz=4 / 3 / (1 - nu**2) * sqrt(R * (deep * h)**3) / h**2)
