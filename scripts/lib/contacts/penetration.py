# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that are pushed deep into clay and sand: how far they get, and with which resistance over area and c_u.

What is wished in place lies in clay under a uniform overburden, as its initial stress and on its surface, which closes the gap above the body; resistances are net of it.
Sides are 32 radii away. Cells grow with the distance by three halvings.
"""
from math import atan, ceil, inf, log, pi, radians, tan

import numpy as np
from yade import mpm, pack, utils
from yade.wrapper import MpmAdaptation, MpmBoundary, MpmContact, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmNewton, MpmRefinement, MpmTraction, MpmTrescaMat, MpmVonMisesMat, Omega

from .bodies import One, Outline, QuarterCone, steel
from .course import Course, meanBetween, smoothness

O = Omega()
R, strength, rigidity, poisson = 1., 1e4, 200., .49
stepsPerCell = 8
coneHeight = R / tan(radians(30))


def clay(law):
	"""c_u is the strength in simple shear of both laws; in triaxial compression von Mises' has 0.866 c_u."""
	elastic = dict(young=2 * (1 + poisson) * rigidity * strength, poisson=poisson, density=1, label='soil')
	if law == 'tresca': O.materials.append(MpmTrescaMat(undrainedStrength=strength, **elastic))
	else: O.materials.append(MpmVonMisesMat(yieldStress=np.sqrt(2) * strength, **elastic))


class Ground:
	"""Soil to the right of x = 0, below y = 0, around the path of a body of radius R.

	:param h: size of the small cells
	:param low: depth of the path, as a coordinate
	:param near: radius of the small cells
	:param below, far: what lies below the path, and beside it
	:param hole: corners where a body stands, from the surface to the axis; none: a whole half-space
	:param top: where the path begins, if that is below the surface; otherwise small cells lie along all of the surface, as a pressure on it wants cells of one size
	"""

	def __init__(self, h, low, hole=(), near=3 * R, below=17 * R, far=32 * R, halvings=3, top=None, **kind):
		size = h * 2**halvings
		self.h, self.width, self.depth = h, ceil(far / size - 1e-9) * size, ceil((below - low) / size - 1e-9) * size
		above = lambda k: inf if top is None else top + near * (1.3 + k) / 2
		boxes = [MpmRefinement(min=(-inf, low - near * (2**k - .3), -inf), max=(near * 2**k, above(k), inf), halvings=halvings - k) for k in range(halvings)]
		if top is None and halvings: boxes.append(MpmRefinement(min=(-inf, -h / 2, -inf), halvings=halvings))
		self.grid = MpmGrid(cellSize=size, refinements=boxes, **kind)
		corners = [(0, -self.depth), (self.width, -self.depth), (self.width, 0), *(hole or [(0, 0)])]
		self.region = mpm.polygon(corners)

	def fill(self, points):
		O.bodies.append(mpm.fill(self.region, self.grid, points, 'soil'))

	def rollers(self, isAxisymmetric):
		sides = [MpmBoundary(min=(self.width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -self.depth, inf), fix='xy')]
		return sides if isAxisymmetric else [MpmBoundary(max=(0, inf, inf), fix='x'), *sides]

	def overburden(self, pressure, since):
		"""Stress of all points, and a load beside the body."""
		points = len(mpm.arrays()['id'])
		mpm.assign(stress=np.repeat(-pressure * np.eye(3)[None], points, axis=0))
		return MpmTraction(surface=[(self.width, 0), (since, 0)], pressure=pressure)


def adhesion(rough):
	"""Attributes of a contact with clay that sticks up to this part of c_u."""
	return dict(friction=atan(5), adhesion=rough * strength) if rough else dict(friction=0)


def _push(course, body, contact, h, depth, of):
	"""Down to a depth; travel and resistance of each step, and the deepest middle of a point inside over h. of: force along y to resistance."""
	travel, found, deepest = [0.], [of(body.force(contact)[1])], [0.]

	def look():
		travel.append(-body.way[1])
		found.append(of(body.force(contact)[1]))
		if course.steps % stepsPerCell == 0: deepest.append(body.depths(mpm.arrays()['pos']).max() / h)

	body.move((0, -h / stepsPerCell, 0))
	course.run(round(depth / h * stepsPerCell), look)
	deepest.append(body.depths(mpm.arrays()['pos']).max() / h)
	return np.array(travel), np.array(found), max(deepest)


def _told(course, h, depth, radius, travel, N, inside, late, **more):
	mean, largest = smoothness(travel, N, h, radius)
	curve = ' '.join(f'{s:g}:{np.interp(s * radius, travel, N):.2f}' for s in (.1, .25, .5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10) if s * radius <= travel[-1] + 1e-9)
	way = dict(reached=travel[-1] / radius, part=travel[-1] / depth)
	means = dict(N=meanBetween(travel, N, radius, inf), late=meanBetween(travel, N, late, inf))
	return way | means | dict(scatter=mean, largest=largest, inside=inside, **more, **course.told(), curve=curve)


def onAxis(kind, law='tresca', rough=0., cells=3, depth=10., wished=True, pressure=5., points=3, stiffness=10., relaxation=False, seconds=300):
	"""A cone of 60 degrees or a pile with a flat end, as closed lines of Facets, or a Box, in clay around an axis.

	:param kind: 'cone', 'pile' or 'box'
	:param rough: adhesion over c_u, on all faces
	:param depth: travel in radii
	:param wished: begins with its shoulder one radius deep, under an overburden of this *pressure* over c_u; otherwise on the surface, without
	"""
	O.reset()
	clay(law)
	steel()
	h, tip = R / cells, coneHeight if kind == 'cone' else 0.
	start = -R - tip if wished else 0.
	line = [(0, start), (R, start + tip), (R, start + tip + depth + 3 * R), (0, start + tip + depth + 3 * R)]
	ground = Ground(h, start - depth * R, [(R, 0), (R, start + tip), (0, start)] if wished else (), axisymmetric=True)
	ground.fill(points)
	length = depth * R + 3 * R
	body = One(utils.box((0, start + length / 2, 0), (R, length / 2, R), material='rigid', fixed=True)) if kind == 'box' else Outline([p for k, p in enumerate(line) if k == 0 or p != line[k - 1]])
	contact = MpmContact(stiffness=stiffness, **adhesion(rough))
	loads = [ground.overburden(pressure * strength, R)] if wished else []
	solver = _engine(ground, contact, loads, True, pressureRelaxation=relaxation)
	course = Course(solver, seconds)
	above, area = pressure if wished else 0., pi * R * R * strength
	if loads: course.run(1)
	travel, N, inside = _push(course, _Part(body, None if kind == 'box' else [0]), contact, h, depth * R, lambda F: F / area - above)
	return _told(course, h, depth * R, R, travel, N, inside, .6 * depth * R, lu=3.4 + 1.6 * log(rigidity) + 1.3 * rough)


class _Part:
	"""A body whose force is that of some of its facets."""

	def __init__(self, body, members):
		self.body, self.members = body, members

	def force(self, contact):
		return self.body.force(contact, self.members)

	def __getattr__(self, name):
		return getattr(self.body, name)


def _engine(ground, contact, loads, isAxisymmetric, **more):
	solver = MpmImplicitEngine(grid=ground.grid, fBar=True, boundaries=ground.rollers(isAxisymmetric), loads=loads, loadCurve=[(0, 1)], contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0, **more)
	O.engines = [solver]
	O.dt = 1
	return solver


def fullFlow(kind, law='tresca', rough=0., cells=4, depth=3., pressure=15., points=3, stiffness=10., seconds=300):
	"""A T-bar in plane strain or a ball, wished six radii deep in clay under an overburden of this pressure over c_u that closes the gap, and moved on by some diameters.

	:param kind: 'tbar' or 'ball'
	:param cells: over the radius
	:param depth: travel in diameters
	"""
	O.reset()
	clay(law)
	steel()
	isBall = kind == 'ball'
	h, centre, D = R / cells, -6. * R, 2. * R
	arc = [(R * np.sin(a), centre + R * np.cos(a)) for a in np.linspace(0, pi, 16 * cells + 1)]
	arc[0], arc[-1] = (0, centre + R), (0, centre - R)
	ground = Ground(h, centre - R - depth * D, [(0, 0), *arc], near=2.5 * R, below=8 * R, far=16 * R, halvings=2, top=centre + R, **(dict(axisymmetric=True) if isBall else {}))
	ground.fill(points)
	body = One(utils.sphere((0, centre, 0), R, material='rigid', fixed=True))
	contact = MpmContact(stiffness=stiffness, **adhesion(rough))
	solver = _engine(ground, contact, [ground.overburden(pressure * strength, 0.)], isBall, pressureRelaxation=True)
	course = Course(solver, seconds)
	course.run(1)
	area = (pi * R * R if isBall else R) * strength
	travel, N, inside = _push(course, body, contact, h, depth * D, lambda F: F / area)
	return _told(course, h, depth * D, R, travel, N, inside, .5 * depth * D, diameters=travel[-1] / D)


def _quarter(width, low):
	"""Two planes of symmetry, two smooth sides, and the base."""
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(max=(inf, low, inf), fix='xyz')]
	return sides + [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, -inf, width), fix='z')]


def inSpace(kind, law='vonMises', depth=3., cells=2, wide=5., points=2, stiffness=10., seconds=300):
	"""A quarter of a smooth square pile or of a ball in 3D, from the surface into clay; sides and base *wide* radii away.

	:param kind: 'box' or 'ball'
	:param depth: travel in radii
	"""
	O.reset()
	clay(law)
	steel()
	h, travel = R / cells, depth * R
	width, low = ceil(wide * cells) * h, -ceil((wide + depth) * cells) * h
	grid = MpmGrid(cellSize=h, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, low, 0), (width, 0, width)), grid, points, 'soil'))
	length = travel + R
	body = One(utils.box((0, length / 2, 0), (R, length / 2, R), material='rigid', fixed=True) if kind == 'box' else utils.sphere((0, R, 0), R, material='rigid', fixed=True))
	contact = MpmContact(friction=0, stiffness=stiffness)
	solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=_quarter(width, low), contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], 1
	course = Course(solver, seconds)
	area = (R * R if kind == 'box' else pi * R * R / 4) * strength
	found, N, inside = _push(course, body, contact, h, travel, lambda F: F / area)
	return _told(course, h, travel, R, found, N, inside, .6 * travel)


def _sand(grid, contact, sides):
	"""Sand of phi = 32 degrees, psi = 2 degrees, c = 0.3 kPa with its weight, whose stiffness grows with the depth."""
	solver = MpmImplicitEngine(grid=grid, boundaries=sides, loadCurve=[(0, 1)], contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)])
	O.engines, O.dt = [solver], 1
	mpm.geostatic()
	mpm.assign(young=lambda x: 5e6 + 15e6 * max(0., -x[1]))
	return solver


def _sandMaterial():
	O.materials.append(MpmMohrCoulombMat(young=20e6, poisson=.3, density=1700, cohesion=300, frictionAngle=radians(32), dilationAngle=radians(2), label='soil'))
	steel()


def sand(kind, depth=10., radius=.4, cells=3, points=2, friction=None, stiffness=20., seconds=600):
	"""A smooth cone or a rough pile with a flat end, jacked from the surface into sand, around the axis.

	:param depth: travel in radii
	:param friction: of the body [degrees]
	"""
	h = radius / cells
	course, *pushed = pushedIntoSand(kind, depth * radius, radius, cells, points, friction, stiffness, seconds)
	return _told(course, h, depth * radius, radius, *pushed, .6 * depth * radius, unit='kPa')


def pushedIntoSand(kind, travel, radius=.4, cells=3, points=2, friction=None, stiffness=20., seconds=600):
	"""The course of it, travel and resistance over the area [m, kPa] of each step, and the deepest middle of a point inside over h.

	:param kind: 'cone' or 'box'
	:param travel: [m]
	:param friction: of the body [degrees]
	"""
	O.reset()
	_sandMaterial()
	h = radius / cells
	ground = Ground(h, -travel, below=8 * radius, far=12 * radius, halvings=0, axisymmetric=True)
	ground.fill(points)
	tip = radius / tan(radians(30)) if kind == 'cone' else 0.
	line = [(0, 0), (radius, tip), (radius, tip + travel + radius), (0, tip + travel + radius)]
	body = Outline(line) if kind == 'cone' else One(utils.box((0, travel, 0), (radius, travel, radius), material='rigid', fixed=True))
	contact = MpmContact(stiffness=stiffness, friction=radians(friction or 0))
	course = Course(_sand(ground.grid, contact, ground.rollers(True)), seconds)
	return course, *_push(course, body, contact, h, travel, lambda F: F / (pi * radius**2) / 1e3)


def sandInSpace(depth=3., radius=.4, cells=2, wide=5., points=2, stiffness=20., seconds=600):
	"""A quarter of the smooth cone in 3D; sides and base *wide* radii away.

	:param depth: travel in radii
	"""
	h = radius / cells
	course, *pushed = quarterPushedIntoSand(depth * radius, radius, cells, wide, points, stiffness, seconds)
	return _told(course, h, depth * radius, radius, *pushed, .6 * depth * radius, unit='kPa')


def quarterPushedIntoSand(travel, radius=.4, cells=2, wide=5., points=2, stiffness=20., seconds=600, halvings=0):
	"""Result of pushedIntoSand; *travel* in m. With halvings of the cells at edges a step is a quarter of the smallest ones, or less."""
	O.reset()
	_sandMaterial()
	h = radius / cells
	width, low = ceil(wide * cells) * h, -ceil(wide * cells + travel / h - 1e-9) * h
	grid = MpmGrid(cellSize=h, dim=3, adaptation=[MpmAdaptation(halvings=halvings)] if halvings else [])
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, low, 0), (width, 0, width)), grid, points, 'soil'))
	body, contact = QuarterCone(radius, travel + radius), MpmContact(friction=0, stiffness=stiffness)
	course = Course(_sand(grid, contact, _quarter(width, low)), seconds)
	return course, *_push(course, body, contact, h / 2**max(0, halvings - 1), travel, lambda F: F / (pi * radius**2 / 4) / 1e3)
