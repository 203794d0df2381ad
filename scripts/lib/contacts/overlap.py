# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies over each other, clumps and meshes of facets act as the one body that they look like: forces over those of that body."""
from math import atan, inf, radians

import numpy as np
from yade import mpm, pack, utils
from yade.wrapper import MpmBoundary, MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, Omega

from .bodies import One, steel
from .course import Course

O = Omega()


def _soil(dim, h=.25, size=1., young=1e6, poisson=0.):
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=1, label='soil'))
	steel()
	grid = MpmGrid(cellSize=h, dim=dim)
	low, high = ((0, 0, 0), (size, size, size)) if dim == 3 else ((0, 0, -1), (size, size, 1))
	O.bodies.append(mpm.fill(pack.inAlignedBox(low, high), grid, 2, 'soil'))
	return grid


def _pressed(grid, bodies, contact, seconds, steps=10, velocity=(.0025, -.005, 0), fix='xyz'):
	"""Sum of the forces on all bodies, which are moved alike, and the course."""
	for body in bodies: body.move(velocity)
	touch = MpmContact(**contact)
	solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix=fix[:grid.dim])], contacts=[touch], verbosity=0)
	O.engines, O.dt = [solver], 1
	course = Course(solver, seconds)
	course.run(steps)
	return np.sum([np.array(F) for F in touch.forces], axis=0), course


def _told(forces, courses, **more):
	"""Largest difference of a scene's force from that of the first, over it."""
	first = forces[0]
	off = [float(np.linalg.norm(F - first) / np.linalg.norm(first)) for F in forces[1:]]
	return dict(off=max(off), each=off, first=list(first), **more, iterations=sum(c.iterations for c in courses), cuts=sum(c.cuts for c in courses), why='; '.join({c.why for c in courses if c.why}))


def _plates(kind, number):
	"""Bodies with their faces at y = 1."""
	if kind == 'box': return [One(utils.box((.5, 1.5, 0), (3, .5, 1), material='rigid', fixed=True)) for _ in range(number)]
	if kind == 'wall': return [One(utils.wall(1, axis=1, sense=-1, material='rigid')) for _ in range(number)]
	if kind == 'facet': return [One(utils.facet([(-9, 1, 0), (9, 1, 0), (0, 1, 9)], material='rigid', fixed=True)) for _ in range(number)]
	places = [(0, .5), (1, .5), (.5, .3)][:number + 1]
	return [One(utils.box((x, 1.5, 0), (half, .5, 1), material='rigid', fixed=True)) for x, half in places]


def layers(adhesion=2e3, seconds=60):
	"""Floors over each other, two or three of a kind, that rub on a block with adhesion; exact shear: adhesion times area. Also two Boxes side by side, and a third over their joint."""
	forces, courses, sheared = [], [], []
	for kind, number in ('box', 1), ('box', 2), ('box', 3), ('wall', 1), ('wall', 2), ('facet', 1), ('facet', 3), ('pieces', 1), ('pieces', 2):
		F, course = _pressed(_soil(2), _plates(kind, number), dict(friction=atan(1), adhesion=adhesion), seconds / 9, 20, (.001, -.004, 0))
		forces.append(F)
		courses.append(course)
		sheared.append(float(-F[0] / adhesion))
	return _told(forces, courses, shear=sheared, rubs=max(abs(x - 1) for x in sheared))


def embracing(seconds=60):
	"""A Box of which the lower part is another, smaller Box as well, pressed into soil farther than that: only the outer faces act."""
	forces, courses = [], []
	for inner in (), ((.5, 1.35, .2, .35), ), ((.5, 1.2, .1, .15), (.6, 1.3, .15, .3)):
		grid = _soil(2, h=.125)
		bodies = [One(utils.box((.5, 1.5, 0), (.25, .5, 1), material='rigid', fixed=True))]
		bodies += [One(utils.box((x, y, 0), (a, b, 1), material='rigid', fixed=True)) for x, y, a, b in inner]
		F, course = _pressed(grid, bodies, dict(friction=atan(.3), stiffness=20), seconds / 3, 20, (0, -.005, 0))
		forces.append(F)
		courses.append(course)
	return _told(forces, courses)


def clumps(seconds=60):
	"""In 3D a clump of a Sphere and two smaller ones inside of it, against the Sphere."""
	forces, courses = [], []
	for number in 0, 2:
		grid = _soil(3)
		sphere = lambda x, r: utils.sphere((.5 + x, 1 + .4 - (.4 - r) * (r < .4) * .999, .5), r, material='rigid', fixed=True)
		clump, _ = O.bodies.appendClumped([sphere(0, .4), *[sphere(.05 * k, .2) for k in range(number)]])
		O.bodies[clump].state.vel = (0, -.01, 0)
		F, course = _pressed(grid, [], dict(friction=radians(20), stiffness=20), seconds / 2)
		forces.append(F)
		courses.append(course)
	return _told(forces, courses)


def _mesh(cuts, low, high, y):
	"""A square of 2 cuts^2 triangles whose normals are down."""
	x = np.linspace(low, high, cuts + 1)
	for i in range(cuts):
		for j in range(cuts):
			a, b, c, d = (x[i], y, x[j]), (x[i + 1], y, x[j]), (x[i + 1], y, x[j + 1]), (x[i], y, x[j + 1])
			yield from ((a, b, c), (a, c, d))


def mesh(cuts=5, seconds=120):
	"""In 3D a plate of 2 cuts^2 facets, wider than a block that it rubs and presses, against the Box, and the block's side against one that ends over it."""
	told = {}
	for name, low, high in ('wide', -.5, 1.5), ('narrow', .2, .8):
		forces, courses = [], []
		for isMesh in False, True:
			grid = _soil(3)
			half = (high - low) / 2
			if isMesh: bodies = [One(utils.facet(list(corners), material='rigid', fixed=True)) for corners in _mesh(cuts, low, high, 1)]
			else: bodies = [One(utils.box((.5, 1.5, .5), (half, .5, half), material='rigid', fixed=True))]
			F, course = _pressed(grid, bodies, dict(friction=radians(20)), seconds / 4)
			forces.append(F)
			courses.append(course)
		told |= {name: _told(forces, courses)}
	return dict(off=told['wide']['off'], narrow=told['narrow']['off'], first=told['wide']['first'], firstNarrow=told['narrow']['first'], iterations=told['wide']['iterations'] + told['narrow']['iterations'], why=told['wide']['why'] + told['narrow']['why'])


def closed(seconds=120):
	"""In 3D a Box of twelve facets, all of its sides, pressed into soil, against the Box."""
	forces, courses = [], []
	for isMesh in False, True:
		grid = _soil(3, poisson=.2)
		low, high = np.array((.25, 1., .25)), np.array((.75, 2., .75))
		if isMesh: bodies = [One(utils.facet([tuple(p) for p in corners], material='rigid', fixed=True)) for corners in _sides(low, high)]
		else: bodies = [One(utils.box(tuple((low + high) / 2), tuple((high - low) / 2), material='rigid', fixed=True))]
		F, course = _pressed(grid, bodies, dict(friction=radians(20), stiffness=20), seconds / 2, 10, (0, -.02, 0))
		forces.append(F)
		courses.append(course)
	return _told(forces, courses)


def _sides(low, high):
	"""Triangles of a block with outward normals."""
	for axis in range(3):
		u, v = (axis + 1) % 3, (axis + 2) % 3
		for value, flip in ((low[axis], True), (high[axis], False)):
			def corner(a, b):
				p = np.empty(3)
				p[axis], p[u], p[v] = value, (low[u], high[u])[a], (low[v], high[v])[b]
				return p
			square = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
			if flip: square.reverse()
			yield square[:3]
			yield [square[0], *square[2:]]


def explicitFloors(seconds=60):
	"""One, four and sixteen floors over each other in explicit steps of 0.95 of the critical one: the energy imbalance over that of the fall."""
	found = []
	for number in 1, 4, 16:
		O.reset()
		O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=1000, label='soil'))
		steel()
		grid = MpmGrid(cellSize=.1)
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (.4, .4, 1)), grid, 2, 'soil'))
		for _ in range(number): One(utils.box((.2, -.1, 0), (3, .1, 1), material='rigid', fixed=True))
		solver = MpmDynamicEngine(grid=grid, contacts=[MpmContact(friction=0)], verbosity=0, scheme='explicit', gravity=(0, -9.81, 0))
		O.engines = [solver]
		O.dt = .95 * solver.criticalTimeStep()
		course = Course(solver, seconds / 3)
		course.run(2000)
		data = solver.plotData()
		found.append(abs(data['energyImbalance']) / abs(1000 * .16 * 9.81 * .4))
	return dict(imbalance=max(found), each=found, why=course.why)
