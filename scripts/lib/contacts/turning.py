# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction that turns with the matter: a sheared block with its plates, and torques of bodies that turn in soil."""
from math import acos, atan, ceil, cos, degrees, inf, log, pi, sin, sqrt

import numpy as np
from yade import mpm, pack, utils
from yade.wrapper import MpmBoundary, MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, MpmNewton, MpmRefinement, MpmTrescaMat, Omega

from .bodies import One, steel
from .course import Course
from .penetration import R, adhesion, clay, strength

O = Omega()


def _rotation(axis, a):
	c, s = cos(a), sin(a)
	return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) if axis == 2 else np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def block(dim=3, axis=2, mu=1., steps=120, turns=1., stiffness=20., cells=1, points=2, seconds=300):
	"""A block between two plates is squeezed and sheared by them; then everything turns rigidly. Angle and size of the force on a plate, in axes that turn along, against those before.

	:param axis: 2, z: the normal of the plates in 3D; in the plane they are turned about z, too, which there is across their normal. 1: in 3D across the normal
	"""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.2, density=1, label='soil'))
	steel()
	size, half = .125 / cells, .125
	grid = MpmGrid(cellSize=size, dim=dim)
	normal = 2 if dim == 3 else 1
	low = (-.25, -.25, -half) if dim == 3 else (-.25, -half, -1)
	O.bodies.append(mpm.fill(pack.inAlignedBox(low, tuple(-x for x in low)), grid, points, 'soil'))
	along = np.eye(3)[normal]
	extents = tuple(.2 if k == normal else .6 for k in range(3))
	plates = [One(utils.box(tuple(side * (half + .2) * along), extents, material='rigid', fixed=True)) for side in (1, -1)]
	contact = MpmContact(friction=atan(mu), stiffness=stiffness)
	solver = MpmImplicitEngine(grid=grid, contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], 1
	course = Course(solver, seconds)
	for plate, side in zip(plates, (1, -1)): plate.move(tuple(-side * .002 * along))
	course.run(5)
	plates[0].move((.0005 * 1.5, 0, 0))
	plates[1].move((0, 0, 0))
	course.run(10)
	before = plates[0].force(contact)
	off, sizes = [0.], [1.]

	def look():
		angle = 2 * pi * turns * len(off) / steps
		F = _rotation(axis, angle).T @ plates[0].force(contact)
		cosine = F @ before / (np.linalg.norm(F) * np.linalg.norm(before) or 1)
		off.append(degrees(np.arccos(np.clip(cosine, -1, 1))))
		sizes.append(np.linalg.norm(F) / np.linalg.norm(before))
		look.shear = np.linalg.norm(F - along * (F @ along)) / np.linalg.norm(before - along * (before @ along))

	look.shear = float('nan')
	_turn(course, plates, axis, 2 * pi * turns / steps, steps, look)
	return dict(turned=360 * turns * (len(off) - 1) / steps, angle=max(off), size=max(abs(s - 1) for s in sizes), last=sizes[-1], shear=look.shear, before=list(before / 1e3), **course.told())


def _turn(course, plates, axis, angle, steps, look):
	matrix = _rotation(axis, angle)
	for _ in range(steps):
		for plate in plates:
			x = np.array(plate.state.pos)
			plate.move(tuple(matrix @ x - x))
			plate.state.angVel = tuple(angle * np.eye(3)[axis])
		if not course.run(1, look): return


def _around(hole, bodies, h, contact, pressure, points, fBar, wide=5 * R, refinements=()):
	"""Soil under a pressure between rollers, with a hole where bodies are wished in place; its material is in the scene."""
	grid = MpmGrid(cellSize=h, refinements=list(refinements))
	O.bodies.append(mpm.fill(pack.inAlignedBox((-wide, -wide, -1), (wide, wide, 1)) - hole, grid, points, 'soil'))
	mpm.assign(stress=np.repeat(-pressure * np.eye(3)[None], len(O.bodies), axis=0))
	rigid = [One(body) for body in bodies]
	sides = [MpmBoundary(max=(-wide, inf, inf), fix='x'), MpmBoundary(min=(wide, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -wide, inf), fix='y'), MpmBoundary(min=(-inf, wide, -inf), fix='y')]
	solver = MpmImplicitEngine(grid=grid, fBar=fBar, boundaries=sides, contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], 1
	return rigid, solver


def _torques(rigid, contact, course, perStep, angle, exact):
	"""About the origin, over the exact one: *torque* in the second half of the turn, *first* over its first twentieth of a radian."""
	found, aside = [], []

	def look():
		found.append(-sum(body.torque(contact)[2] + np.cross(np.array(body.state.pos), body.force(contact))[2] for body in rigid) / exact)
		aside.append(np.linalg.norm(sum(body.force(contact)[:2] for body in rigid)) * R / exact)

	course.run(1)
	for body in rigid: body.state.angVel = (0, 0, perStep)
	course.run(round(angle / perStep), look)
	first = np.abs(found[:max(1, round(.05 / perStep))] or [float('nan')])
	late = found[len(found) // 2:] or [float('nan')]
	T = float(np.mean(np.abs(late)))
	return dict(turned=degrees(len(found) * perStep), torque=T, first=float(np.mean(first)), scatter=float(np.mean(np.abs(np.abs(late) / T - 1))), largest=float(np.max(np.abs(np.abs(late) / T - 1))), aside=float(np.mean(aside[len(aside) // 2:] or [float('nan')])), **course.told())


def cylinder(cells=4, angle=1., stiffness=10., points=3, seconds=200):
	"""A cylinder turns in soft elastic soil that presses on it from all around, with an adhesion that slips everywhere: 2 pi R^2 of it, per metre."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e5, poisson=.2, density=1, label='soil'))
	cap = 5e3
	contact = MpmContact(friction=atan(5), adhesion=cap, stiffness=stiffness)
	steel()
	body = utils.sphere((0, 0, 0), R, material='rigid', fixed=True)
	rigid, solver = _around(pack.inCylinder((0, 0, -2), (0, 0, 2), R), [body], R / cells, contact, 5e4, points, False)
	return _torques(rigid, contact, Course(solver, seconds), .1 / cells, angle, 2 * pi * R**2 * cap)


def _ring(halvings, wide):
	"""Cells halved all around the circle of radius R."""
	places = R * np.array([(cos(a), sin(a)) for a in np.linspace(0, 2 * pi, 64, endpoint=False)])
	return [MpmRefinement(min=(x - wide, y - wide, -inf), max=(x + wide, y + wide, inf), halvings=halvings) for x, y in places] if halvings else []


def vane(cells=6, width=1., angle=1., stiffness=10., pressure=5., points=2, halvings=0, seconds=300):
	"""Two Boxes crossed, *width* cells thick, rough, in clay. The cylinder through their edges that slips is an upper bound, 2 pi r^2 c_u; on a grid the nodes of the cells in which the edges end, half a cell farther on average, turn with them, and the row of cells beyond is what shears, in its middle another half farther: (1 + h / r)^2 of it. As *band*, the torque over that, with h of the smallest cells.

	:param halvings: of the cells all around that cylinder; around the edges alone they do not help
	"""
	O.reset()
	clay('tresca')
	steel()
	w = width * R / cells / 2
	hole = pack.inAlignedBox((-R, -w, -2), (R, w, 2)) | pack.inAlignedBox((-w, -R, -2), (w, R, 2))
	contact = MpmContact(stiffness=stiffness, **adhesion(1.))
	bodies = [utils.box((0, 0, 0), extents, material='rigid', fixed=True) for extents in ((R, w, 1), (w, R, 1))]
	small = R / cells / 2**halvings
	rigid, solver = _around(hole, bodies, R / cells, contact, pressure * strength, points, True, refinements=_ring(halvings, R / 8))
	told = _torques(rigid, contact, Course(solver, seconds), .1 / cells / 2**halvings, angle, 2 * pi * (R**2 + w**2) * strength)
	return told | dict(band=told['torque'] / (1 + small / sqrt(R**2 + w**2))**2)


def ring(turns=1., steps=120, cells=4, stiffness=20., seconds=300):
	"""In 3D a plate turns on a square block about its normal, with an adhesion that slips everywhere: torque of that, s^3 (sqrt 2 + ln(1 + sqrt 2)) / 6 of it."""
	O.reset()
	E, cap, side = 1e7, 1e4, 1.
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=1, label='soil'))
	steel()
	h = side / cells
	grid = MpmGrid(cellSize=h, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((-.5, -.5, -2 * h), (.5, .5, 0)), grid, 2, 'soil'))
	plate = One(utils.box((0, 0, .2), (1.5, 1.5, .2), material='rigid', fixed=True))
	contact = MpmContact(friction=atan(5), adhesion=cap, stiffness=stiffness)
	solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, inf, -2 * h), fix='xyz')], contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], 1
	course, exact, found = Course(solver, seconds), cap * side**3 * (sqrt(2) + log(1 + sqrt(2))) / 6, []
	plate.move((0, 0, -.001))
	course.run(5)
	plate.move((0, 0, 0))
	plate.state.angVel = (0, 0, 2 * pi * turns / steps)
	course.run(steps, lambda: found.append(abs(plate.torque(contact)[2]) / exact))
	late = found[len(found) // 4:] or [float('nan')]
	return dict(turned=360 * turns * len(found) / steps, torque=float(np.mean(late)), largest=float(np.max(np.abs(np.array(late) / np.mean(late) - 1))), slipping=contact.slipping[0] / max(1, contact.touching[0]), **course.told())


def wheel(cells=4, isDynamic=True, sinkage=.1, turn=.4, points=2, seconds=200):
	"""A wheel is pressed into clay that sticks to it up to c_u, and turned on the spot: torque over that of c_u all along its arc, in the second half of the turn.

	:param sinkage: over its radius, with respect to the surface before
	:param turn: [rad]
	"""
	O.reset()
	R, strength, rim = .4, 2e4, 1.
	O.materials.append(MpmTrescaMat(young=200 * strength, poisson=.4, density=1800, undrainedStrength=strength, label='soil'))
	steel()
	h, deep = R / cells, sinkage * R
	wide, low = ceil(2.5 * cells) * h, ceil(1.5 * cells) * h
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((-wide, -low, -1), (wide, 0, 1)), grid, points, 'soil'))
	body = One(utils.sphere((0, R, 0), R, material='rigid', fixed=True))
	contact = MpmContact(friction=atan(5), adhesion=strength, stiffness=10)
	sides = [MpmBoundary(max=(inf, -low, inf), fix='xy'), MpmBoundary(max=(-wide, inf, inf), fix='x'), MpmBoundary(min=(wide, -inf, -inf), fix='x')]
	common = dict(grid=grid, boundaries=sides, contacts=[contact], newton=MpmNewton(minStep=1 / 64), verbosity=0)
	solver = MpmDynamicEngine(scheme='generalised-alpha', rhoInfinity=.5, **common) if isDynamic else MpmImplicitEngine(**common)
	steps, course = ceil(8 * deep / h), Course(solver, seconds)
	O.engines, O.dt = [solver], 2 * deep / rim / steps
	body.state.vel = (0, -rim / 2, 0)
	course.run(steps)
	steps, found = ceil(8 * turn * R / h), []
	O.dt = turn * R / rim / steps
	body.state.vel, body.state.angVel = (0, 0, 0), (0, 0, -rim / R)
	course.run(steps, lambda: found.append(body.torque(contact)[2] / (strength * R**2 * 2 * acos(1 - sinkage))))
	late = found[len(found) // 2:] or [float('nan')]
	return dict(torque=float(np.mean(late)), largest=float(np.max(np.abs(np.array(late) / np.mean(late) - 1))), **course.told())
