# SPDX-License-Identifier: GPL-2.0-or-later
"""Inertia in the stability atlas: an elastic bar of 8 x 2 [x 2] cells between rollers, which vibrates in its first mode along x."""
from math import inf

import numpy as np
from common import cellSize, stabilisation, young
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmDynamicEngine, MpmElasticMat, MpmGrid, Omega

O = Omega()
speedOfSound = young**0.5 # density 1, no Poisson's ratio


class Bar:
	"""Held at x = 0, free at the other end, 40 steps. Exact is that its energy stays what it was.

	:param courant: O.dt times the speed of sound over the size of a cell
	:param overlap: by which it is longer [h]
	"""
	steps = 40

	def __init__(self, dim, ghost, courant=.5, overlap=.5, massFactor=None, **scheme):
		h = cellSize
		O.materials.append(MpmElasticMat(young=young, poisson=0, density=1, label='bar'))
		grid = MpmGrid(cellSize=h, dim=dim)
		size = np.array([8, 2, 2 if dim == 3 else 1]) * h
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -h), tuple(size)), grid, 2, 'bar'))
		longer = 1 + overlap * h / size[0]
		for body in O.bodies:
			(x, *others), (a, *sides) = body.state.pos, body.shape.halfSize
			body.state.pos = body.state.refPos = x * longer, *others
			body.shape.halfSize = body.shape.halfSize0 = a * longer, *sides
			body.state.volume = body.state.volume0 = body.state.volume * longer
		mode = np.sin(np.pi / 2 * mpm.arrays()['pos'][:, 0] / (size[0] * longer))
		mpm.assign(velocity=np.outer(1e-4 * speedOfSound * mode, (1, 0, 0)))
		held = [MpmBoundary(**{limit: tuple(x if a == axis else sign * inf for a in range(3))}, fix='xyz'[axis])
		        for axis in range(dim) for limit, x, sign in (('max', 0, 1), ('min', size[axis], -1)) if axis > 0 or limit == 'max']
		stabilising = stabilisation(ghost)
		if massFactor is not None: stabilising.massFactor = massFactor
		self.engine = MpmDynamicEngine(grid=grid, boundaries=held, ghost=stabilising, **scheme)
		self.dt = courant * h / speedOfSound

	def beforeStep(self, step):
		if step == 1: self.first = self.energy()

	def energy(self):
		data = self.engine.plotData()
		return data['kineticEnergy'] + data['elasticEnergy']

	def error(self):
		return abs(self.energy() / self.first - 1)


def vibratingBar(axis, dim, ghost, value):
	"""The scene of a case, None if it is none of these."""
	if axis == 'inertiaCut': return Bar(dim, ghost, overlap=value)
	if axis == 'inertiaCutExplicit': return Bar(dim, ghost, .25, value, scheme='explicit')
	if axis == 'massFactor': return Bar(dim, ghost, overlap=1e-3, massFactor=value)
	if axis == 'timeStep': return Bar(dim, ghost, value)
	if axis == 'rhoInfinity': return Bar(dim, ghost, scheme='generalised-alpha', rhoInfinity=value)
	return None
