# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of points that meet in the stability atlas: an elastic column in two pieces under its weight, a block that slides down an incline, and one that flies at another one."""
from math import atan, ceil, cos, inf, radians, sin, tan

import numpy as np
from common import cellSize, fullNewton, stabilisation, young
from yade import mpm
from yade.wrapper import MpmBodyContact, MpmBoundary, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, MpmNewton, Omega

O = Omega()


def add(name, grid, low, high, density, points=2, E=young):
	"""A rectangle [cells] that is a body of points."""
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=density, label=name))
	(a, b), (c, d) = np.array(low) * cellSize, np.array(high) * cellSize
	O.bodies.append(mpm.fill(mpm.polygon([(a, b), (c, b), (c, d), (a, d)]), grid, points, name, body=name))


class Stack:
	"""A piece of 4 x 2.5 cells and one on it, which meet in the middle of a cell; exact: stress of the column that they are.

	:param weight: strain at the base in small deformations
	:param ratio: modulus of the upper piece over that of the lower one
	:param rows: height of the upper one [cells]
	:param points: per cell and axis, of the upper one
	"""

	def __init__(self, ghost, weight=.1, ratio=1, stiffness=10, rows=3, points=2):
		self.steps, middle, grid = 5, 2.5, MpmGrid(cellSize=cellSize)
		self.height = (middle + rows) * cellSize
		self.unit = weight * young / self.height
		add('low', grid, (0, 0), (4, middle), self.unit)
		add('up', grid, (0, middle), (4, middle + rows), self.unit, points, ratio * young)
		self.volume = mpm.arrays()['volume']
		sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
		contact = MpmBodyContact(between=('up', 'low'), friction=0, stiffness=stiffness)
		self.engine = MpmImplicitEngine(grid=grid, gravity=(0, -1, 0), boundaries=sides, contacts=[contact], ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		points = mpm.arrays()
		exact = -self.unit * (self.height - points['pos0'][:, 1])
		return np.average(np.abs(points['stress'][:, 1, 1] - exact), weights=self.volume) / (self.unit * self.height)


class Incline:
	"""A block of 4 x 2 cells on a slope of 45 degrees, along x; exact: the way that it slides, and none where its friction is larger."""
	steps, slope, gravity = 10, radians(45), 10.

	def __init__(self, ghost, degrees):
		grid, E = MpmGrid(cellSize=cellSize), 1e3 * young
		add('low', grid, (0, 0), (10, 2.5), 1e3, E=E)
		add('up', grid, (1, 2.5), (5, 4.5), 1e3, E=E)
		self.exact = max(0., self.gravity * (sin(self.slope) - tan(radians(degrees)) * cos(self.slope)))
		self.dt, self.upper = .01, mpm.arrays()['body'] == 1
		contact = MpmBodyContact(between=('up', 'low'), friction=radians(degrees))
		self.engine = MpmDynamicEngine(
		        grid=grid, gravity=(self.gravity * sin(self.slope), -self.gravity * cos(self.slope), 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], contacts=[contact],
		        ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		speed = mpm.arrays()['velocity'][self.upper, 0].mean() / (self.steps * self.dt)
		return abs(speed - self.exact) / self.gravity


class Flight:
	"""A block of 3 x 3 cells flies at one that is held at its base, a cell away, and back; the error is the energy that is won.

	:param part: of a cell, by which it flies in a step
	"""

	def __init__(self, ghost, part):
		grid, speed = MpmGrid(cellSize=cellSize), 1.
		add('low', grid, (0, 0), (6, 2.5), 1e3)
		add('up', grid, (1.5, 3.5), (4.5, 6.5), 1e3)
		upper = mpm.arrays()['body'] == 1
		mpm.assign(velocity=np.outer(upper, (0, -speed, 0)))
		self.first = (1e3 * mpm.arrays()['volume'][upper]).sum() * speed**2 / 2
		self.steps, self.dt, self.most = ceil(4 / part), part * cellSize / speed, 0.
		contact = MpmBodyContact(between=('up', 'low'), friction=atan(.3))
		self.engine = MpmDynamicEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], contacts=[contact], ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		if step > 0: self.most = max(self.most, self.energy())

	def energy(self):
		data = self.engine.plotData()
		return data['kineticEnergy'] + data['elasticEnergy']

	def error(self):
		return max(0., max(self.most, self.energy()) / self.first - 1)


def meetingScene(axis, ghost, value):
	"""The scene of a case, None if the axis is not one of bodies that meet."""
	if axis == 'meetingRatio': return Stack(ghost, ratio=value)
	if axis == 'meetingPenalty': return Stack(ghost, stiffness=value)
	if axis == 'meetingFriction': return Incline(ghost, value)
	if axis == 'meetingStep': return Flight(ghost, value)
	if axis == 'meetingThin':
		rows, points = map(int, value.split('/'))
		return Stack(ghost, rows=rows / points, points=points)
	return None
