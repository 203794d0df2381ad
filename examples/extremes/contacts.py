# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact in the stability atlas: elastic blocks of 4 x 4 [x 4] cells between rollers, which rigid bodies press, drag and squeeze; and a sphere on a half-space."""
from math import inf, log, pi, radians, sqrt, tan

import numpy as np
from common import cellSize, fullNewton, stabilisation, young
from yade import mpm, pack, utils
from yade.wrapper import FrictMat, MpmBoundary, MpmContact, MpmElasticMat, MpmGrid, MpmImplicitEngine, MpmNewton, Omega

O = Omega()


class Touched:
	"""A body of soil; the bodies of YADE that touch it are to be added.

	:param size: of the soil [m], from the origin, where rollers hold it
	:param contact: attributes of the MpmContact
	:param fixed: letters of what holds the base
	"""

	def __init__(self, dim, ghost, steps, size, poisson=0., points=2, h=cellSize, contact={}, fixed='y', origin=(0, 0, 0), **kind):
		self.steps, self.contact = steps, MpmContact(**(dict(friction=0) | contact))
		O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=1, label='soil'))
		O.materials.append(FrictMat(label='rigid'))
		grid = MpmGrid(cellSize=h, dim=dim, **kind)
		low, high = np.array(origin, float), np.array(origin) + np.array(size)
		if dim == 2: low[2], high[2] = -h, h
		O.bodies.append(mpm.fill(pack.inAlignedBox(tuple(low), tuple(high)), grid, points, 'soil'))
		sides = [MpmBoundary(max=(inf, low[1], inf), fix=fixed)]
		if not kind: sides.append(MpmBoundary(max=(0, inf, inf), fix='x'))
		if dim == 3: sides.append(MpmBoundary(max=(inf, inf, 0), fix='z'))
		self.engine = MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[self.contact], ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def move(self, body, velocity):
		O.bodies[O.bodies.append(body)].state.vel = velocity

	def beforeStep(self, step):
		pass


block = np.full(3, 4 * cellSize)


def plate(axis, at, thickness=20 * cellSize):
	"""A Box whose face is at this coordinate, much wider than the block."""
	centre, half = block / 2, np.full(3, 20 * cellSize)
	centre[axis], half[axis] = at + thickness / 2, thickness / 2
	return utils.box(tuple(centre), tuple(half), material='rigid', fixed=True)


class Pressed(Touched):
	"""Block pressed by a plate, to this part of its height, free on two sides; exact: force per area E / (1 - nu^2) ln(ratio) / ratio in plane strain.

	:param thin: thickness of the plate over how far it moves in a step, None: a thick one
	"""

	def __init__(self, dim, ghost, ratio=.75, steps=10, stiffness=100, poisson=0., thin=None):
		super().__init__(dim, ghost, steps, block, poisson, contact=dict(stiffness=stiffness))
		way = (1 - ratio) * block[1]
		self.move(plate(1, block[1], thin * way / steps) if thin else plate(1, block[1]), (0, -way, 0))
		self.exact = -young / (1 - poisson**2) * log(ratio) / ratio * block[0] * (block[2] if dim == 3 else 1)

	def error(self):
		return abs(self.contact.forces[0][1] / self.exact - 1)


class Dragged(Touched):
	"""Block under a rough plate that presses it by a hundredth and goes aside by half a cell; exact: the ratio of both forces, once it slides."""

	def __init__(self, dim, ghost, degrees):
		super().__init__(dim, ghost, 10, block, contact=dict(friction=radians(degrees)), fixed='xyz'[:dim])
		self.friction = tan(radians(degrees))
		self.move(plate(1, block[1]), (.5 * cellSize, -.01 * block[1], 0))
		self.engine.boundaries = self.engine.boundaries[:1]

	def error(self):
		force = self.contact.forces[0]
		return abs(abs(force[0] / force[1]) - self.friction)


class Squeezed(Touched):
	"""Between plates to a half of its width, so that it grows up to a Wall a quarter above it and is pressed against it; exact: force on that Wall."""

	def __init__(self, dim, ghost, points):
		poisson, grown = .3, 1.25
		super().__init__(dim, ghost, 20, block, poisson, points, contact=dict(stiffness=1000))
		self.move(utils.wall(grown * block[1], axis=1, sense=-1, material='rigid'), (0, 0, 0))
		self.move(plate(0, block[0]), (-block[0] / 2, 0, 0))
		modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
		self.exact = -modulus * (log(grown) + poisson / (1 - poisson) * log(.5)) * block[0] / grown

	def error(self):
		return abs(self.contact.forces[0][1] / self.exact - 1)


class Ball(Touched):
	"""A sphere on a half-space, axisymmetric: force of Hertz, with what a half-space gives way at the base (examples/penetration).

	:param cells: over the radius of the contact, a tenth of that of the sphere
	"""

	def __init__(self, ghost, cells):
		self.R, a, self.poisson = 1., .1, .3
		h, self.depth = a / cells, 12 * a
		super().__init__(2, ghost, 5, (self.depth, self.depth, 1), self.poisson, h=h, origin=(0, -self.depth, 0), contact=dict(stiffness=20), axisymmetric=True)
		self.move(utils.sphere((0, self.R, 0), self.R, material='rigid', fixed=True), (0, -a**2 / self.R, 0))
		self.sunk = a**2 / self.R

	def error(self):
		F, nu = self.contact.forces[0][1], self.poisson
		base = F * (1 + nu) * (3 - 2 * nu) / (2 * pi * young * self.depth)
		return abs(F / (4 / 3 * young / (1 - nu**2) * sqrt(self.R) * (self.sunk + base)**1.5) - 1)


def contactScene(axis, dim, ghost, value):
	"""The scene of a case, None if the axis is not one of contact."""
	if axis == 'contactPenalty': return Pressed(dim, ghost, stiffness=value)
	if axis == 'contactSteps': return Pressed(dim, ghost, .5, steps=value)
	if axis == 'contactThin': return Pressed(dim, ghost, thin=value)
	if axis == 'contactHeight': return Pressed(dim, ghost, value, steps=40, poisson=.3)
	if axis == 'contactFriction': return Dragged(dim, ghost, value)
	if axis == 'contactClamped': return Squeezed(dim, ghost, value)
	if axis == 'contactRadius': return Ball(ghost, value)
	return None
