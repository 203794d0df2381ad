# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes of geotechnical engineering that are drawn at random, with default settings. Lengths are in cells of size h, heights from the surface of level ground or from the base of what lies on it."""
import random
from math import inf, radians, sqrt, tan

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBeam, MpmBoundary, MpmDynamicEngine, MpmGhost, MpmGrid, MpmImplicitEngine, MpmWater, Omega

from .soils import Soil, gravity, weight

O = Omega()
flowing = ['mohrCoulomb', 'mohrCoulomb', 'druckerPrager', 'vonMises', 'tresca']
all = [*flowing, 'elastic']
kinds = {}


def kind(scene):
	kinds[scene.__name__.lower()] = scene
	return scene


class Scene:
	"""Scene of a seed: *steps* load steps; soil that is dug away or put there stage by stage is in *before*."""
	laws, dims, isDynamic, h = all, (2, ), False, .5

	def __init__(self, seed):
		self.draw = random.Random(seed)
		self.draw.random()  # the kind
		self.dim = self.draw.choice(self.dims)
		self.up = 1 if self.dim == 2 else 2
		self.steps = 10
		self.plan()

	def plan(self):
		"""Draws what is its own, and self.soil, for the height of its ground."""

	def add(self, finer=1, divide=1, strict=False, ghost=None):
		"""The scene; its solver. finer, divide: its steps are so much shorter, its cells so much smaller. strict: F-bar, and a stabilisation that may not carry much. ghost: attributes of MpmGhost."""
		O.reset()
		O.materials.append(self.soil.material())
		self.grid = MpmGrid(cellSize=self.h / divide, dim=self.dim)
		self.finer, pull = finer, tuple(-gravity * (axis == self.up) for axis in range(3))
		self.fill()
		solver = (MpmDynamicEngine if self.isDynamic else MpmImplicitEngine)(grid=self.grid, gravity=pull, boundaries=self.boundaries(), verbosity=0, **self.settings())
		if strict and not self.isDynamic: solver.fBar, solver.ghost = True, MpmGhost(where='aggregates', memory=1, workTolerance=.03)
		for name, value in (ghost or {}).items() if not self.isDynamic else ():
			setattr(solver.ghost, name, value)
		O.engines, O.dt = [solver], self.duration() / (self.steps * finer)
		self.begin()
		return solver

	def duration(self):
		return 1.

	def settings(self):
		return dict(gravityCurve=[(0, 1)])

	def begin(self):
		"""Before the first step: ground at rest."""
		mpm.geostatic(K0=self.soil.K0)

	def before(self, step, solver):
		"""Changes before a step."""

	def box(self, low, high):
		"""Places [m] from corners in cells, (x, height) or (x, z, height), of which z is left out in the plane."""
		flat = lambda corner, z: (corner[0] * self.h, corner[-1] * self.h, z) if self.dim == 2 else tuple(x * self.h for x in corner)
		return flat(low, -1), flat(high, 1)

	def put(self, low, high):
		O.bodies.append(mpm.fill(pack.inAlignedBox(*self.box(low, high)), self.grid, 2, 'soil'))

	def corner(self, value, axis, otherwise):
		return tuple(value * self.h if a == axis else otherwise for a in range(3))

	def below(self, value, axis, fix):
		return MpmBoundary(max=self.corner(value, axis, inf), fix=fix)

	def above(self, value, axis, fix):
		return MpmBoundary(min=self.corner(value, axis, -inf), fix=fix)

	def tub(self, size, bottom):
		"""Rollers at the sides of (x, z) from zero to size, all held at the bottom."""
		sides = [self.below(0, axis, 'xyz'[axis]) for axis in range(self.dim) if axis != self.up]
		sides += [self.above(size[axis], axis, 'xyz'[axis]) for axis in range(self.dim) if axis != self.up]
		return [*sides, self.below(bottom, self.up, 'xyz'[:self.dim])]

	def isRight(self, solver):
		"""Numbers and whether they are within their bounds, as pairs by name."""
		return {}

	def load(self, part):
		"""Load that has been borne after this part of the way, by which runs in other steps are compared."""
		return part

	def mayFail(self):
		"""True if equilibrium may be impossible, for all that is known."""
		return False

	def __str__(self):
		return f'{type(self).__name__.lower()} {self.dim}D {self.soil} {self.told()}'.strip()

	def told(self):
		return ''


class Ground(Scene):
	"""Level ground, deep below its surface at zero."""
	size, deep = (12, 4), 6

	def plan(self):
		self.soil = Soil(self.draw, self.deep * self.h, self.laws)

	def fill(self):
		self.put((0, -self.deep) if self.dim == 2 else (0, 0, -self.deep), (self.size[0], 0) if self.dim == 2 else (*self.size, 0))

	def boundaries(self):
		return self.tub(self.size, -self.deep)


@kind
class Footing(Ground):
	"""Half of a strip, or a quarter of a rectangle, is pressed into the ground."""
	laws, dims = [*all, 'camClay'], (2, 2, 2, 3)

	def plan(self):
		super().plan()
		self.half, self.way, self.isRough = self.draw.choice([2.5, 3.5, 4.5]), self.draw.choice([.02, .1, .3]), self.draw.random() < .5
		if self.dim == 3: self.size, self.deep = (7, 7), 5

	def boundaries(self):
		places = [-.01 if axis == self.up else -inf for axis in range(3)], [inf if axis == self.up else int(self.half) * self.h + .01 for axis in range(3)]
		fix = 'xyz'[:self.dim] if self.isRough else 'xyz'[self.up]
		return [MpmBoundary(min=places[0], max=places[1], fix=fix, displacement=tuple(-self.way * self.h * (axis == self.up) for axis in range(3))), *super().boundaries()]

	def isRight(self, solver):
		"""The edge counts half a cell beyond the last node."""
		if self.soil.law in ('elastic', 'camClay') or self.dim == 3: return {}
		width = self.half * self.h
		mean = abs(solver.reactions[0][1]) / width
		return dict(bearing=(mean / self.soil.bearing(2 * width, self.way * self.h * weight), mean < 2.2 * self.soil.bearing(2 * width, self.way * self.h * weight) + 1e-3 * weight))

	def told(self):
		return f'half {self.half} way {self.way} {"rough" if self.isRough else "smooth"}'


@kind
class Wall(Ground):
	"""A smooth wall goes into the ground or away from it, on a smooth base."""
	laws, deep = flowing, 5

	def plan(self):
		super().plan()
		self.way = self.draw.choice([-1, 1]) * self.draw.choice([.05, .3])

	def boundaries(self):
		return [MpmBoundary(max=(0, inf, inf), fix='x', displacement=(self.way * self.h, 0, 0)), self.above(self.size[0], 0, 'x'), self.below(-self.deep, 1, 'y')]

	def isRight(self, solver):
		"""The height has grown, or fallen, as the ground keeps its volume or dilates: a tenth is for that and for the grid."""
		active, passive = self.soil.thrusts(self.deep * self.h)
		thrust = abs(solver.reactions[0][0])
		return dict(thrust=(thrust / passive, .8 * active <= thrust <= 1.3 * passive))

	def told(self):
		return f'way {self.way}'


class Cutting(Ground):
	"""Ground is dug away row by row, on the right of x = 6."""
	deep, rows = 6, 3

	def plan(self):
		super().plan()
		self.rows = self.draw.choice([1, 2, 3])

	def duration(self):
		return float(2 * self.rows)

	def before(self, step, solver):
		"""A row, and a step of rest after it."""
		each = 2 * self.finer
		row = step // each
		if step % each or row >= self.rows: return
		for body in [b for b in O.bodies if b and self.isDug(b) and b.state.pos[self.up] > -(row + 1) * self.h]: O.bodies.erase(body.id)

	def isDug(self, point):
		"""In its turn."""
		return point.state.pos[0] > 6 * self.h

	def load(self, part):
		"""Rows: what is done at once, and the steps of rest after it."""
		return int(part * self.rows + 1e-6)

	def farthest(self):
		"""Largest displacement of all points [cells]."""
		points = mpm.arrays()
		return float(np.linalg.norm(points['pos'] - points['pos0'], axis=1).max() / self.h)

	def told(self):
		return f'{self.rows} rows'


@kind
class Cut(Cutting):
	"""Ground with a vertical face that nothing supports; in space a strip of it, or the corner of a pit."""
	dims = (2, 2, 2, 3)

	def plan(self):
		super().plan()
		self.steps = 2 * self.rows
		self.across = self.draw.choice([0, 1]) if self.dim == 3 else 0
		if self.dim == 3: self.size = (12, 3)

	def isDug(self, point):
		return super().isDug(point) and (self.dim == 2 or point.state.pos[1] > self.across * self.h)

	def mayFail(self):
		return not self.soil.isSurelyStable(self.rows * self.h)

	def isRight(self, solver):
		"""Check that soil without a possible equilibrium has moved, where the run has got to its end all the same."""
		moved = self.farthest()
		return dict(moved=(moved, moved > .1 or self.across > 0 or not self.soil.isSurelyUnstable(self.rows * self.h)))

	def told(self):
		return f'{super().told()}{" corner" * (self.across > 0)}'


@kind
class Excavation(Cutting):
	"""The face is held by a smooth wall that is in the ground from the beginning."""

	def plan(self):
		super().plan()
		self.steps = 2 * self.rows

	def boundaries(self):
		wall = MpmBoundary(min=(6 * self.h, -(self.rows + 1) * self.h, -inf), max=(6 * self.h, inf, inf), fix='x')
		return [wall, *super().boundaries()]


@kind
class Sheetpile(Cutting):
	"""The face is held by a smooth wall that bends, and stands in the ground below."""
	deep = 9

	def plan(self):
		super().plan()
		self.steps = 2 * self.rows
		self.long, self.bending = self.rows + self.draw.choice([1, 2, 4]), self.draw.choice([1e7, 1e8, 1e9])

	def begin(self):
		"""It takes over the stress of the ground."""
		super().begin()
		self.right = {b.id for b in O.bodies if b and super(Sheetpile, self).isDug(b)}
		x = 6 * self.h
		O.engines[0].loads = [MpmBeam(line=[(x, 0), (x, -self.long * self.h)], axialStiffness=1e10, bendingStiffness=self.bending, adhesion=0, fixFoot='y')]

	def isDug(self, point):
		"""True for a point of the side that is dug out; those that the wall pushes over the line stay."""
		return point.id in self.right

	def mayFail(self):
		return not self.soil.isSurelyStable(self.rows * self.h)

	def isRight(self, solver):
		"""In sand without cohesion a stiff wall is thrown over at the depth of Blum (1931), which flow with less dilation does not raise; a tenth is for the grid."""
		moved, thrown = self.farthest(), self.soil.cohesion == 0 and self.soil.phi > 0 and self.rows > 1.1 * self.soil.depthOfBlum(self.long)
		return dict(moved=(moved, moved > .1 or not thrown))

	def told(self):
		return f'{super().told()} wall {self.long} EI {self.bending:.0e}'


@kind
class Slope(Scene):
	"""Its weight grows from nothing."""
	dims, angles = (2, 2, 3), (20, 70)

	def plan(self):
		self.high, self.angle = self.draw.choice([3, 5]), self.draw.uniform(*self.angles)
		self.soil = Soil(self.draw, self.high * self.h, self.laws)

	def fill(self):
		run, top, base = self.high / tan(radians(self.angle)), 3, 2
		corners = [(0, -base), (top + run + 3, -base), (top + run + 3, 0), (top + run, 0), (top, self.high), (0, self.high)]
		self.width = top + run + 3
		outline = [(x * self.h, y * self.h) for x, y in corners]
		profile = mpm.polygon(outline)
		if self.dim == 2: return O.bodies.append(mpm.fill(profile, self.grid, 2, 'soil'))
		block = mpm.fill(pack.inAlignedBox(*self.box((0, 0, -base), (np.ceil(self.width), 3, self.high))), self.grid, 2, 'soil')
		O.bodies.append([point for point in block if profile((point.state.pos[0], point.state.pos[2], 0), 0)])

	def boundaries(self):
		return self.tub((np.ceil(self.width), 3), -2)

	def settings(self):
		return {}

	def begin(self):
		pass

	def mayFail(self):
		"""Below the angle of Davis' friction on slip planes nothing slides."""
		sine, dilation = np.sin(self.soil.phi), np.sin(self.soil.psi)
		slip = np.arctan(sine * np.cos(self.soil.psi) / (1 - sine * dilation))
		return not (self.soil.isSurelyStable(self.high * self.h) or radians(self.angle) < slip)

	def told(self):
		return f'{self.high} high {self.angle:.0f} degrees'


@kind
class Water(Slope):
	"""A slope with a water table, or a lake before it."""
	dims, angles, laws = (2, ), (20, 45), ['mohrCoulomb', 'druckerPrager', 'elastic']

	def plan(self):
		super().plan()
		self.level = self.draw.uniform(-1.5, self.high)

	def settings(self):
		return dict(water=[MpmWater(level=self.level * self.h)])

	def mayFail(self):
		return self.soil.law != 'elastic'

	def told(self):
		return f'{super().told()} level {self.level:.1f}'


@kind
class Fill(Ground):
	"""Banks are put on the ground one on top of the other, each of a row of cells."""
	deep, size, dims = 4, (12, 3), (2, 2, 3)

	def plan(self):
		super().plan()
		self.rows = self.draw.choice([1, 2, 3])
		self.steps = 2 * self.rows

	def duration(self):
		return float(self.steps)

	def before(self, step, solver):
		each = 2 * self.finer
		row = step // each
		if step % each or row >= self.rows: return
		end = 7 - 1.5 * row
		self.put((0, row) if self.dim == 2 else (0, 0, row), (end, row + 1) if self.dim == 2 else (end, self.size[1], row + 1))

	def mayFail(self):
		return not self.soil.isSurelyStable((self.rows + 1) * self.h)

	def told(self):
		return f'{self.rows} rows'


class InTime(Scene):
	"""Something moves. What energy comes in is found again."""
	isDynamic, h, laws = True, .2, flowing

	def settings(self):
		return {}

	def begin(self):
		pass

	def boundaries(self):
		return [*(self.below(0, axis, 'xyz'[axis]) for axis in range(self.dim) if axis != self.up), self.below(0, self.up, 'xyz'[:self.dim])]

	def isRight(self, solver):
		data = solver.plotData()
		come = abs(data['loadWork']) + self.kinetic
		return dict(energy=(data['energyImbalance'] / come, abs(data['energyImbalance']) < .05 * come))


@kind
class Runout(InTime):
	"""A column is let go."""
	dims = (2, 2, 2, 3)

	def plan(self):
		self.width, self.high = self.draw.choice([4, 5]), self.draw.choice([3, 5, 8])
		self.soil = Soil(self.draw, self.high * self.h, ['mohrCoulomb', 'mohrCoulomb', 'druckerPrager'])
		self.steps, self.kinetic = 60 if self.dim == 2 else 30, 0.
		if self.dim == 3: self.width, self.high = 3, 4

	def fill(self):
		self.put((0, 0) if self.dim == 2 else (0, 0, 0), (self.width, self.high) if self.dim == 2 else (self.width, self.width, self.high))

	def duration(self):
		return self.steps * .3 * self.h / sqrt(2 * gravity * self.high * self.h)

	def told(self):
		return f'{self.width} wide {self.high} high'


@kind
class Impact(InTime):
	"""A block flies against the ground, or against another one that rests there."""
	dims = (2, 2, 3)

	def plan(self):
		self.size, self.gap = self.draw.choice([2, 3, 4]), self.draw.uniform(.1, 1.5)
		self.onSoil = self.draw.random() < .5
		self.speed, self.across = self.draw.choice([1., 3., 8.]), self.draw.choice([0., 0., 2.])
		self.soil = Soil(self.draw, self.size * self.h, [*flowing, 'elastic'])
		self.steps = 50 if self.dim == 2 else 25

	def fill(self):
		bed, n = (2 if self.onSoil else 0), self.size if self.dim == 2 else 2
		if bed: self.put((0, 0) if self.dim == 2 else (0, 0, 0), (10, bed) if self.dim == 2 else (5, 5, bed))
		first = len(O.bodies)
		low = bed + self.gap
		self.put((3, low) if self.dim == 2 else (1, 1, low), (3 + n, low + n) if self.dim == 2 else (1 + n, 1 + n, low + n))
		self.flying = range(first, len(O.bodies))

	def begin(self):
		velocity = tuple(-self.speed if axis == self.up else self.across * (axis == 0) for axis in range(3))
		points = len(O.bodies)
		mpm.assign(velocity=[velocity if i in self.flying else (0, 0, 0) for i in range(points)])
		self.kinetic = sum(O.bodies[i].state.volume0 for i in self.flying) * weight / gravity * (self.speed**2 + self.across**2) / 2

	def duration(self):
		return self.steps * .1 * self.h / max(self.speed, 2)

	def told(self):
		return f'{self.size} wide speed {self.speed} across {self.across} {"on soil" if self.onSoil else "on the base"}'


def sceneOf(seed):
	names = list(kinds)
	return kinds[names[int(random.Random(seed).random() * len(names))]](seed)
