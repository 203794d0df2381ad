# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs cases of the stability atlas, in YADE.

A case is (axis, dim, ghost, value), see axes.py. Most are columns of 2 x 6 [x 2] cells under their own weight, whose vertical
stress is known from equilibrium, whatever the material: -b (l0 - Y) at the initial height Y.
"""
import os
import re
import sys
import time
from math import cos, inf, nan, sin, tau

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmDrain, MpmElasticMat, MpmFlow, MpmGrid, MpmImplicitEngine, MpmNewton, MpmVanGenuchten, MpmWater, Omega

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, '..', '..', 'scripts', 'lib')]
import pivots
from common import cellSize, fullNewton, stabilisation, young
from contacts import contactScene
from laws import lawScene
from meeting import meetingScene
from slopes import weakLayerSlope
from soils import Band, SandSlope, friction, frictional, tresca, vonMises
from vibrating import vibratingBar

O = Omega()


class Column:
	"""A column on a smooth floor; between smooth walls if *confined*, else held by one side only and free on the others.

	:param weight: b l0 / E, the strain at the base in small deformations
	:param law: law(E, attributes of every material) makes it; None: elastic
	:param overlap: the column is stretched by this part of a cell in all directions in which it is free
	"""

	def __init__(self, dim, ghost, steps=5, weight=.5, confined=False, overlap=(0, 0), h=cellSize, E=young, poisson=0., points=2, contrast=1, law=None,
	             factor=1e-2, width=2, rows=6, fBar=False):
		self.steps = steps
		size = np.array([width, rows, 2 if dim == 3 else 1]) * h
		density = weight * E / size[1]
		for label, modulus in ('soft', E), ('stiff', E * contrast):
			values = dict(young=modulus, poisson=poisson, density=density, label=label)
			O.materials.append(law(E, values) if law else MpmElasticMat(**values))
		grid = MpmGrid(cellSize=h, dim=dim)
		box = pack.inAlignedBox((0, 0, -1 * h if dim == 2 else 0), tuple(size))
		O.bodies.append(mpm.fill(box, grid, points, lambda x: 'stiff' if int(x[1] / h) % 2 else 'soft'))
		self.stretch(size, np.array([overlap[0], overlap[1], overlap[0]]) * h, dim)
		sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
		if dim == 3: sides.append(MpmBoundary(max=(inf, inf, 0), fix='z'))
		if confined: sides.append(MpmBoundary(min=(size[0], -inf, -inf), fix='x'))
		if confined and dim == 3: sides.append(MpmBoundary(min=(-inf, -inf, size[2]), fix='z'))
		self.engine = MpmImplicitEngine(grid=grid, gravity=(0, -1, 0), boundaries=sides, fBar=fBar, ghost=stabilisation(ghost, factor), newton=MpmNewton(**fullNewton))
		self.height, self.unit = size[1] + overlap[1] * h, weight * E / size[1]

	def stretch(self, size, by, dim):
		scale = 1 + by / size
		if dim == 2: scale[2] = 1
		if (scale == 1).all(): return
		for body in O.bodies:
			body.state.pos = body.state.refPos = tuple(np.array(body.state.pos) * scale)
			body.shape.halfSize = body.shape.halfSize0 = tuple(np.array(body.shape.halfSize) * scale)
			body.state.volume = body.state.volume0 = body.state.volume * scale.prod()

	def top(self, dim):
		"""Its surface there, of two cells a side."""
		w, high = 2 * cellSize, self.height
		return [(w, high, 0), (0, high, 0)] if dim == 2 else [[(0, high, 0), (0, high, w), (w, high, w)], [(0, high, 0), (w, high, w), (w, high, 0)]]

	def error(self):
		points = mpm.arrays()
		volume = [b.state.volume0 for b in O.bodies]
		exact = -self.unit * (self.height - points['pos0'][:, 1])
		return np.average(np.abs(points['stress'][:, 1, 1] - exact), weights=volume) / (self.unit * self.height)

	def beforeStep(self, step):
		pass


class Consolidating(Column):
	"""A column between walls that drains at its top while its weight grows: what soil and water bear together.

	:param part: length of a step over that in which pressures spread over a cell
	"""

	def __init__(self, dim, ghost, part, porosity=.4, conductivityLaw='constant', **more):
		super().__init__(dim, ghost, confined=True, **more)
		for material in O.materials:
			material.conductivity, material.porosity, material.conductivityLaw = part * cellSize**2 / young * self.steps * 9810, porosity, conductivityLaw
		self.engine.flow = MpmFlow(drains=[MpmDrain(surface=self.top(dim))], ghost=0 if ghost == 'none' else .01)

	def error(self):
		points = mpm.arrays()
		exact = -self.unit * (self.height - points['pos0'][:, 1])
		return np.average(np.abs(points['stress'][:, 1, 1] - points['porePressure'] - exact), weights=[b.state.volume0 for b in O.bodies]) / (self.unit * self.height)


class Flooded(Column):
	"""Dry soil that hardly strains, on whose top water stands from the first step on; exact is that no water is lost, and no soil drier than at first or more than full.

	:param suction: head at first over the height of the column, which is the inverse of van Genuchten's alpha
	:param n: van Genuchten's
	"""

	def __init__(self, dim, ghost, suction, n=2., **more):
		super().__init__(dim, ghost, confined=True, weight=1e-6, steps=20, **more)
		high, gammaW = self.height, self.unit / 2
		for material in O.materials:
			material.conductivity, material.porosity, material.retention = .1 * high * self.steps, .4, MpmVanGenuchten(alpha=1 / high, n=n, residual=.1)
		mpm.assign(excessPressure=np.full(len(O.bodies), -suction * gammaW * high))
		self.engine.flow = MpmFlow(total=True, unitWeight=gammaW, drains=[MpmDrain(surface=self.top(dim))], ghost=0 if ghost == 'none' else .01)
		self.first = .1 + .9 * (1 + suction**n)**(1 / n - 1)

	def error(self):
		S, flow = mpm.arrays()['saturation'], self.engine.flow
		return max(self.first - S.min(), S.max() - 1, abs(flow.waterIn - flow.waterOut - flow.waterStored) / flow.waterIn, 0)


class Wet(Column):
	"""A column with water up to a level, over its height, of a part of its weight by volume: effective stress."""

	def __init__(self, dim, ghost, part, level, **more):
		super().__init__(dim, ghost, **more)
		self.level, self.water = level * self.height, part * self.unit
		if part > 0: self.engine.water = [MpmWater(level=self.level, weight=self.water)]

	def error(self):
		points = mpm.arrays()
		above = lambda top: np.minimum(top, self.height) - np.minimum(points['pos0'][:, 1], min(top, self.height))
		exact = self.water * above(self.level) - self.unit * above(self.height)
		return np.average(np.abs(points['stress'][:, 1, 1] - exact), weights=[b.state.volume0 for b in O.bodies]) / (self.unit * self.height)


class Bar:
	"""A bar of 6 x 2 [x 2] cells whose middle is turned about z; exact is the rotation of the whole without stress.

	:param turns: rotation in all
	:param steps: load steps for it
	"""

	def __init__(self, dim, ghost, turns, steps):
		self.steps, self.angle, h = steps, tau * turns / steps, cellSize
		O.materials.append(MpmElasticMat(young=young, poisson=.3, density=1, label='bar'))
		grid = MpmGrid(cellSize=h, dim=dim)
		O.bodies.append(mpm.fill(pack.inAlignedBox((-3 * h, -h, -h), (3 * h, h, h)), grid, 2, 'bar'))
		# not all nodes of any cell face, which would make it a wall
		self.nodes = [np.array([i, j, k]) * h for i, j in ((1, 0), (0, 1), (-1, 0), (0, -1)) for k in ((-1, 1) if dim == 3 else [0])]
		margin = np.full(3, h / 4)
		held = [MpmBoundary(min=tuple(x - margin), max=tuple(x + margin), fix='xyz'[:dim]) for x in self.nodes]
		self.engine = MpmImplicitEngine(grid=grid, boundaries=held, ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		c, s = cos(self.angle), sin(self.angle)
		for held, x in zip(self.engine.boundaries, self.nodes):
			held.displacement = tuple(self.steps * np.array([c * x[0] - s * x[1] - x[0], s * x[0] + c * x[1] - x[1], 0]))

	def error(self):
		points = mpm.arrays()
		c, s = cos(self.angle * self.steps), sin(self.angle * self.steps)
		exact = points['pos0'] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
		return np.abs(points['pos'] - exact).max() / (3 * cellSize)


class Slope:
	"""The slope of Coombs (2023), section 4.2, in 20 steps."""

	def __init__(self, ghost, cells, factor):
		self.steps = 20
		grid, sides = weakLayerSlope(1 / cells, 2)
		self.engine = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, ghost=stabilisation(ghost, factor), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		return nan


class Cantilever:
	"""A horizontal bar fixed at its end under a small part of its weight: its stiffness matrix is the worse the longer it is. No exact solution is used."""

	def __init__(self, ghost, slenderness, cells=1, poisson=.3, fBar=False):
		self.steps, h = 1, cells * cellSize
		self.weight, self.size, self.poisson = 1e-3 * young * h / (slenderness * h)**4 * h**3, (slenderness * h, h), poisson
		O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=self.weight, label='bar'))
		grid = MpmGrid(cellSize=cellSize)
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (*self.size, 1)), grid, 2, 'bar'))
		held = MpmBoundary(max=(0, inf, inf), fix='xy')
		self.engine = MpmImplicitEngine(grid=grid, gravity=(0, -1, 0), boundaries=[held], fBar=fBar, ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		return nan


class Beam(Cantilever):
	"""Four cells thick and eight times as long, with Timoshenko's deflection of the tip."""

	def __init__(self, ghost, poisson, fBar=False):
		super().__init__(ghost, 8, 4, poisson, fBar)

	def error(self):
		(L, H), nu = self.size, self.poisson
		exact = self.weight * H * (L**4 * 12 * (1 - nu**2) / (8 * young * H**3) + L**2 * 2 * (1 + nu) / (2 * 5 / 6 * young * H))
		points = mpm.arrays()
		last = points['pos0'][:, 0] > L - .6 * cellSize
		return abs((points['pos0'] - points['pos'])[last, 1].mean() / exact - 1)


def weightForHeight(ratio):
	"""b l0 / E that compresses a column of nu = 0 to this part of its height: s with (W + W^2 / 2) / s = ratio, W exp(W) = s."""
	low, high = 1e-6, 20.
	for _ in range(200):
		W = (low + high) / 2
		low, high = (W, high) if (1 + W / 2) * np.exp(-W) > ratio else (low, W)
	return W * np.exp(W)


def shiftedAtRandom(column, part, points=2):
	"""Move each point by up to *part* of half the spacing, but not through walls."""
	random, spacing = np.random.default_rng(1), cellSize / points
	dim = column.engine.grid.dim
	for body in O.bodies:
		by = random.uniform(-1, 1, 3) * part * spacing / 2
		by[dim:] = 0
		x = np.array(body.state.pos) + by
		x[:dim] = np.maximum(x[:dim], spacing / 100)
		body.state.pos = tuple(x)
	return column


def thinnedAtRandom(column, part):
	random = np.random.default_rng(1)
	for body in list(O.bodies):
		if random.uniform() < part: O.bodies.erase(body.id)
	column.error = lambda: nan # the weight is not that of a column
	return column


def scene(axis, dim, ghost, value):
	"""The scene of a case."""
	if (touched := contactScene(axis, dim, ghost, value)) is not None: return touched
	if (bearing := lawScene(axis, dim, ghost, value)) is not None: return bearing
	if (meeting := meetingScene(axis, ghost, value)) is not None: return meeting
	if (moving := vibratingBar(axis, dim, ghost, value)) is not None: return moving
	if axis == 'overlap': return Column(dim, ghost, overlap=(value, value))
	if axis == 'factor': return Column(dim, ghost, overlap=(1e-4, 1e-4), factor=value)
	if axis == 'poisson': return Column(dim, ghost, confined=True, poisson=value)
	if axis == 'contrast': return Column(dim, ghost, contrast=value, weight=1e-3, steps=1)
	if axis == 'mixed': return Column(dim, ghost, contrast=value)
	if axis == 'yield': return Column(dim, ghost, confined=True, poisson=.3, law=vonMises(value))
	if axis == 'softening': return Column(dim, ghost, confined=True, poisson=.3, law=vonMises(1e-2, value))
	if axis == 'tresca': return Column(dim, ghost, confined=True, poisson=.3, law=tresca(value))
	if axis == 'sandSlope': return SandSlope(ghost, *map(float, value.split('/')))
	if axis == 'softeningGrid':
		cells, softening = value.split('/')
		return Band(ghost, int(cells), softening)
	if axis == 'overlapFBar': return Column(dim, ghost, overlap=(value, value), fBar=True)
	if axis == 'yieldFBar': return Column(dim, ghost, confined=True, poisson=.3, law=vonMises(value), fBar=True)
	if axis in ('bending', 'bendingFBar'): return Beam(ghost, value, axis == 'bendingFBar')
	if axis == 'compressionFBar': return Column(dim, ghost, confined=True, weight=weightForHeight(value), steps=40, fBar=True)
	if axis in frictional: return Column(dim, ghost, confined=True, law=friction(**frictional[axis](value)))
	if axis == 'length': return Column(dim, ghost, h=value)
	if axis == 'waterWeight': return Wet(dim, ghost, value, 10)
	if axis == 'waterLevel': return Wet(dim, ghost, .5, value, weight=1e-3)
	if axis == 'flowStep': return Consolidating(dim, ghost, value, weight=1e-2)
	if axis == 'flowCut': return Consolidating(dim, ghost, 1e-2, weight=1e-2, overlap=(0, value))
	if axis == 'flowPorosity': return Consolidating(dim, ghost, 1, porosity=value, conductivityLaw='kozeny-carman', weight=2e-2)
	if axis == 'suction': return Flooded(dim, ghost, value)
	if axis == 'suctionPores': return Flooded(dim, ghost, 10., n=value)
	if axis == 'suctionCut': return Flooded(dim, ghost, 10., overlap=(0, value))
	if axis == 'young': return Column(dim, ghost, E=value)
	if axis == 'strain': return Column(dim, ghost, weight=value)
	if axis == 'steps': return Column(dim, ghost, confined=True, weight=4, steps=value)
	if axis == 'points': return Column(dim, ghost, points=value)
	if axis == 'jitter': return shiftedAtRandom(Column(dim, ghost), value)
	if axis == 'missing': return thinnedAtRandom(Column(dim, ghost), value)
	if axis == 'compression': return Column(dim, ghost, confined=True, weight=weightForHeight(value), steps=40)
	if axis == 'free': return Column(dim, ghost, weight=weightForHeight(value), steps=40)
	if axis == 'turns': return Bar(dim, ghost, value, round(24 * value))
	if axis == 'turnStep': return Bar(dim, ghost, max(1, round(90 / value)) * value / 360, max(1, round(90 / value)))
	if axis == 'thin':
		columns, points = map(int, value.split('/'))
		return Column(dim, ghost, points=points, width=columns / points)
	if axis == 'slender': return Cantilever(ghost, value)
	if axis == 'columnFactor':
		cells, factor = value.split('/')
		return Column(dim, ghost, confined=True, weight=4, steps=20, h=.5, rows=int(cells), width=1, factor=float(factor))
	if axis == 'slopeFactor': return Slope(ghost, *map(float, value.split('/')))
	if axis == 'corner': return Column(dim, ghost, overlap=tuple(map(float, value.split('/'))))
	raise ValueError(f'no axis {axis}')


conditionOfSteps = 'overlap', 'factor', 'columnFactor', 'slopeFactor' # axes for which the condition number is estimated after each step
kinds = [ # kinds of failures, by words of the exception
        ('nothing restrains', 'refused: mechanism'),
        ('in the same place', 'refused: points in the same place'),
        ('singular', 'singular'),
        ('inside out', 'inverted'),
        ('not finite', 'not finite'),
        ('thrown off', 'thrown off the grid'),
        ('diverges', 'diverging'),
        ('would get soil inside of it', 'penetrated'),
        ('would let soil through', 'penetrated'),
        ('m into body', 'penetrated'),
        ('against each other in the step', 'penetrated'),
        ('bodies must not overlap', 'penetrated'),
        ('above the tolerance', 'not converging'),
        ('times the tolerance', 'not converging'), # around a node
        ('has no stress for its strain', 'law without an answer'),
]


def kindOf(error):
	return next((kind for text, kind in kinds if text in str(error)), 'refused: ' + re.sub(r'[-+]?\b\d[\d.]*(e[-+]?\d+)?', '#', str(error))[:80])


def run(axis, dim, ghost, value):
	"""One case; returns a dictionary of results."""
	O.reset()
	result = dict(
	        dofs=0, steps=0, completed=0, condition=nan, worstCondition=nan, pivot=nan, solveError=nan, meanIterations=nan, maxIterations=0, cuts=0, luSolves=0, clamped=0, error=nan, measured=nan,
	        failure='')
	begin = time.process_time()
	try:
		tried = scene(axis, dim, ghost, value)
		engine = tried.engine
		O.engines, O.dt = [engine], getattr(tried, 'dt', 1 / tried.steps)
		result['steps'] = tried.steps
		result['condition'] = engine.conditionEstimate()
		result['pivot'], result['solveError'] = pivots.measure(*engine.stiffness())
		solves = []
		for step in range(tried.steps):
			tried.beforeStep(step)
			O.step()
			solves.append(engine.iterations)
			result |= dict(completed=step + 1, dofs=engine.dofs, meanIterations=np.mean(solves), maxIterations=max(solves))
			result['cuts'] += engine.cuts
			result['luSolves'] += engine.luSolves
			if axis in conditionOfSteps: result['worstCondition'] = np.nanmax([result['worstCondition'], engine.conditionEstimate()])
			result['clamped'] = max(result['clamped'], engine.clampedDomains)
		result['error'] = tried.error()
		if hasattr(tried, 'measured'): result['measured'] = tried.measured()
	except (RuntimeError, ValueError) as error:
		result['failure'] = kindOf(error)
	return {name: float(f'{x:.6g}') if isinstance(x, float) else x for name, x in result.items()} | dict(seconds=round(time.process_time() - begin, 3))

