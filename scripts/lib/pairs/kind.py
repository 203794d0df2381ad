# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that is drawn as a whole, instead of from a list of features: what all kinds have. Nothing here needs YADE."""
import random

from .statements import Statements, arguments
from .view import inf

gravity, density, young = 10., 2000., 1e6


class Kind:
	"""A scene by its seed, in metres; *finer* and *shorter* divide cells and time steps.

	`plan` draws all numbers, so that they are the same in each copy; `write` adds the statements to a Statements.
	"""
	isRing = isDynamic = False
	shape = None
	dims = (2, )
	cell, side = .5, 2.  # cell size and size of the body [m], unless drawn otherwise
	steps, dt = 4, .25
	isBalanced = False  # true if the engine tells of all forces that act in statics
	close = 1e-9  # part of the largest of the quantity, where round-off differs
	isExact = True  # true if other units change no bit
	isEnergyKnown, imbalance = True, .05  # true if the balance of energy is told in time; part of the energy that may be unaccounted for
	water = None
	without = ()  # copies that are not compared
	admitted = dict(finer=.25, shorter=.1)  # relative differences of the means with half the cell size and half the time step

	def __init__(self, seed, finer=1, shorter=1):
		self.seed, self.finer = seed, finer
		draw = random.Random(f'{type(self).__name__} {seed}')
		self.dim = draw.choice(self.dims)
		self.plan(draw)
		self.cell /= finer
		if self.isDynamic and self.scheme == 'explicit': shorter *= finer
		self.dt, self.steps = self.dt / shorter, self.steps * shorter

	@property
	def end(self):
		return self.steps * self.dt

	def units(self):
		"""Sizes of quantities; smaller differences of what is next to nothing are no difference."""
		stress = density * gravity * self.side
		area = self.side if self.dim == 2 and not self.isRing else self.side**2
		return dict(length=self.side, stress=stress, strain=stress / young, displacement=stress / young * self.side, force=stress * area, moment=stress * area * self.side, volume=stress / young * area * self.side, discharge=stress / young * area * self.side / self.end,
		            velocity=stress / young * self.side / self.end, energy=stress * area * stress / young * self.side)

	def has(self, *features):
		return False

	def text(self, view):
		text = Text(self, view)
		self.write(text)
		return '\n'.join(text.lines) + '\n'


class Text(Statements):
	"""Statements that several kinds need, from metres of the scene."""

	def __init__(self, scene, view):
		super().__init__(scene, view)
		values = dict(cellSize=scene.cell * view.L, dim=scene.dim)
		if scene.isRing: values['axisymmetric'] = True
		self.add(f'grid = MpmGrid({arguments(values)})', 'points = []')
		self.placeInScene()

	def scaled(self, values):
		"""Attributes in the units of the view: each is a number, or a number and the powers of L, S, D and T in its unit."""
		v = self.view
		powers = lambda x, L=0, S=0, D=0, T=0: x * v.L**L * v.S**S * v.D**D * v.T**T
		return {name: powers(value[0], **value[1]) if isinstance(value, tuple) and isinstance(value[1], dict) else value for name, value in values.items()}

	def material(self, kind, values, label='soil'):
		self.add(f'O.materials.append({kind}({arguments(self.scaled(dict(density=(density, dict(D=1))) | values))}, label={label!r}))')

	def box(self, low, high):
		"""A region, all through the plane."""
		ends = [tuple(x[a] if a < self.scene.dim else (-1., 1.)[x is high] for a in range(3)) for x in (low, high)]
		low, high = self.view.box(*ends)
		return f'pack.inAlignedBox({low}, {high})'

	def polygon(self, corners):
		corners = [self.view.point((*x, 0)) for x in corners]
		return f'mpm.polygon({[x[:2] for x in (corners[::-1] if self.view.isMirrored else corners)]})'

	def fill(self, *regions, perCell=2, names=('', )):
		"""Regions of the materials *soil*, or of named bodies, each of the material of its name."""
		order = self.view.order
		bodies = list(zip(regions, names))
		for region, name in bodies if order is None else bodies[::-1]:
			named = f', body={name!r}' if name else ''
			self.add(f'part = mpm.fill({region}, grid, {perCell}, {name or "soil"!r}{named})')
			if order is not None: self.add(f'np.random.RandomState({order % (1 << 31)}).shuffle(part)')
			self.add('points += part')
		if self.scene.shape: self.add('for body in points: body.groupMask = 2')
		self.add('O.bodies.append(points)')

	def sides(self, low, high, base='xyz'):
		"""Smooth sides and a base; around an axis the inner side is the axis. *low* and *high* are those of x."""
		s = self.scene
		self.boundary((-inf, -inf, -inf), (inf, 0., inf), base)
		if low is not None and not s.isRing: self.boundary((-inf, -inf, -inf), (low, inf, inf), 'x')
		if high is not None: self.boundary((high, -inf, -inf), (inf, inf, inf), 'x')
		if s.dim == 3:
			self.boundary((-inf, -inf, -inf), (inf, inf, 0.), 'z')
			self.boundary((-inf, -inf, s.depth), (inf, inf, inf), 'z')

	def level(self, height):
		"""Coordinate against gravity, as levels of water are given."""
		axis, sign = self.view.axis(1)
		return self.view.point((0, height, 0))[axis] * sign + 0.

	def traction(self, surface, curve=None, **load):
		"""A load on a surface: *pressure* or *traction* [Pa]."""
		v = self.view
		value = f"pressure={load['pressure'] * v.S}" if 'pressure' in load else f"traction={v.vector(load['traction'], v.S)}"
		return f'MpmTraction(surface={v.line(surface)}, {value}{f", curve={v.curve(curve)}" if curve else ""})'

	def write(self, loadCurve=None, gravityCurve=None, **settings):
		"""The engine, with what has been collected for it; curves are of times [s]."""
		s, v = self.scene, self.view
		values = dict(self.engine) | settings
		acts = s.gravity if hasattr(s, 'gravity') else (0, -gravity, 0)
		values |= dict(grid='grid', gravity=v.vector(acts, (1 + v.heavier) * (v.L / v.T**2 if s.isDynamic else v.S / (v.D * v.L))), boundaries=f'[{", ".join(self.boundaries)}]', verbosity=0, ompThreads=v.threads)
		values['newton'] = 'MpmNewton(tolerance=1e-10, minStep=1/16)'
		values['loadCurve'] = v.curve(loadCurve or [(0., 0.), (s.end, 1.)])
		if gravityCurve: values['gravityCurve'] = v.curve(gravityCurve)
		if s.isDynamic: values['scheme'] = repr(s.scheme)
		name = 'MpmDynamicEngine' if s.isDynamic else 'MpmImplicitEngine'
		self.add(f'solver = {name}({", ".join(f"{key}={value}" for key, value in values.items())}, label="solver")', 'O.engines = [solver]', f'O.dt = {s.dt * v.T}')

	def end(self, actions=''):
		self.add(f'actions = {actions or dict()}', f'steps = {self.scene.steps}')
