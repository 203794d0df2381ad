# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of contact that are drawn at random: each ends, with forces that balance."""
import random
from math import atan, inf, pi, radians

import numpy as np
from yade import mpm, pack, utils
from yade.minieigenHP import Quaternion
from yade.wrapper import (ForceResetter, FrictMat, MpmBoundary, MpmCamClayMat, MpmContact, MpmDruckerPragerMat, MpmDynamicEngine, MpmElasticMat, MpmGhost, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmNewton, MpmTrescaMat,
                          MpmVonMisesMat, NewtonIntegrator, Omega)

from .bodies import One
from .course import Course, reasons, said

O = Omega()
laws = dict(elastic=(MpmElasticMat, {}), vonMises=(MpmVonMisesMat, dict(yieldStress=2e4)), tresca=(MpmTrescaMat, dict(undrainedStrength=1.4e4)), mohrCoulomb=(MpmMohrCoulombMat, dict(cohesion=5e3, frictionAngle=.5, dilationAngle=.05)),
            druckerPrager=(MpmDruckerPragerMat, dict(cohesion=5e3, frictionAngle=.5, dilationAngle=.1)))
kinds = 'box', 'box', 'turned box', 'sphere', 'wall', 'facet', 'clump'


class Scene:
	"""Scene of a seed: a body of soil on a constrained base, and one or two rigid bodies above it, which are pushed into it, dragged over it, or fall on it."""

	def __init__(self, seed):
		draw = self.draw = random.Random(seed)
		self.dim = draw.choice([2, 2, 3])
		self.isRing = self.dim == 2 and draw.random() < .15
		self.isDynamic = draw.random() < .35
		self.isFree = self.dim == 3 and draw.random() < .4
		self.h = draw.choice([.1, .25])
		self.size = (draw.choice([4, 5, 6]), draw.choice([2, 3, 4]), draw.choice([3, 4]))
		self.points = draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.law, self.poisson = draw.choice(list(laws)), draw.choice([0., .2, .3, .45, .49])
		self.friction = draw.choice([0., 0., .2, .5, 1.])
		self.adhesion = draw.choice([inf, inf, 5e3])
		self.stiffness = draw.choice([10., 20., 50., 100.])
		self.fBar = self.poisson > .4 and draw.random() < .7
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint'])
		self.base = draw.choice(['xyz', 'xyz', 'y' if self.dim == 2 else 'z']) if not self.isRing else 'xy'
		self.steps = 12
		self.bodies = [self._body(k) for k in range(1 if self.isRing or self.isFree or len(self.base) == 1 else draw.choice([1, 1, 2]))]
		self.text = ' '.join(map(str, (f'{self.dim}D', 'ring' if self.isRing else '', 'free' if self.isFree else '', self.scheme if self.isDynamic else 'static', self.law, f'nu {self.poisson}', f'mu {self.friction}', *(b['kind'] for b in self.bodies))))

	@property
	def up(self):
		return 1 if self.dim == 2 else 2

	def _body(self, number):
		"""Lengths in cells; it begins just above the soil, and moves by a part of a cell a step."""
		draw = self.draw
		kind = 'sphere' if self.isFree else draw.choice([k for k in kinds if k not in (('turned box', 'facet', 'clump', 'wall') if self.isRing else ())])
		if number and kind == 'wall': kind = 'box'
		at = 0. if self.isRing else draw.uniform(.5, self.size[0] - .5) if not number else -2.5
		speed = min(draw.choice([.02, .05, .1, .2]), .4 * self.size[1] / self.steps)  # no more than two fifths of the soil's height in all
		if number: return dict(kind='box', at=at, half=[draw.uniform(.6, 2.), draw.uniform(.5, 1.), 9.], turn=0., way=(draw.choice([.05, .1]), 0.), side=True)
		across = 0. if self.isRing or draw.random() < .4 else draw.uniform(-1, 1) * speed
		return dict(kind=kind, at=at, half=[draw.uniform(.4, 2.5), draw.uniform(.4, 2.), draw.uniform(.5, 3.)], radius=draw.uniform(.5, 4.), turn=draw.uniform(0, pi) if kind == 'turned box' else 0., slope=draw.uniform(-.3, .3), spin=draw.choice([0., 0., .02]), way=(across, -speed), side=False)

	def add(self):
		"""The scene; its solver."""
		O.reset()
		kind, values = laws[self.law]
		O.materials.append(kind(young=2e6, poisson=self.poisson, density=1800, label='soil', **values))
		O.materials.append(FrictMat(young=1e9, density=2600, frictionAngle=atan(self.friction), label='rigid'))
		grid = MpmGrid(cellSize=self.h, dim=self.dim, **(dict(axisymmetric=True) if self.isRing else {}))
		nx, ny, nz = self.size
		high = (nx * self.h, ny * self.h, 1) if self.dim == 2 else (nx * self.h, nz * self.h, ny * self.h)
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1 if self.dim == 2 else 0), high), grid, self.points, 'soil'))
		for body in O.bodies: body.groupMask = 2
		self.number = len(O.bodies)
		self.rigid = [self._add(body) for body in self.bodies]
		contact = MpmContact(mask=1, friction=atan(self.friction), adhesion=self.adhesion, stiffness=self.stiffness)
		sides = [self._held(self.up, 0., self.base[:self.dim] if len(self.base) > 1 else self.base)]
		if len(self.base) == 1: sides += [self._held(axis, 0., 'xyz'[axis]) for axis in range(self.dim) if axis != self.up]
		common = dict(grid=grid, boundaries=sides, contacts=[contact], fBar=self.fBar, newton=MpmNewton(minStep=1 / 256, tolerance=1e-8), verbosity=0)
		gravity = tuple(-9.81 * (axis == self.up) for axis in range(3))
		if self.isDynamic: solver = MpmDynamicEngine(scheme=self.scheme, gravity=gravity, **common)
		else: solver = MpmImplicitEngine(gravity=gravity, gravityCurve=[(0, 1)], **common)
		O.engines = [ForceResetter(), solver, NewtonIntegrator(gravity=gravity, damping=.2, mask=1)] if self.isFree else [solver]
		O.dt = 1.
		if self.isDynamic: O.dt = self.draw.choice([.3, 1.]) * self.h / 30
		if self.isFree: O.dt, solver.iterPeriod = 1e-4, self.draw.choice([1, 5])
		self._move()
		return solver, contact

	def _held(self, axis, value, fix):
		return MpmBoundary(max=tuple(value if a == axis else inf for a in range(3)), fix=fix)

	def _place(self, x, above):
		"""In metres, this far above the surface."""
		top = self.size[1] * self.h
		return (x * self.h, top + above * self.h, 0.) if self.dim == 2 else (x * self.h, self.size[2] / 2 * self.h, top + above * self.h)

	def _add(self, body):
		draw, h = self.draw, self.h
		solid = dict(material='rigid', fixed=not self.isFree)
		if body['side']:
			place = (body['at'] * h - body['half'][0] * h + 2.4 * h, self.size[1] * h / 2) if self.dim == 2 else (body['at'] * h - body['half'][0] * h + 2.4 * h, self.size[2] / 2 * h)
			half = [body['half'][0] * h, body['half'][1] * h, 9.]
			return One(utils.box((*place, 0.) if self.dim == 2 else (*place, self.size[1] * h / 2), half if self.dim == 2 else (half[0], 2 * h, half[1]), **solid))
		kind, gap = body['kind'], .01
		if kind == 'wall': return One(utils.wall(self._place(0, gap)[self.up], axis=self.up, sense=-1, material='rigid'))
		if kind == 'sphere': return One(utils.sphere(self._place(body['at'], gap + body['radius']), body['radius'] * h, **solid))
		if kind == 'clump': return self._clump(body, gap)
		if kind == 'facet': return self._facet(body, gap)
		half = body['half'] if self.dim == 3 else body['half'][:2] + [9 / h]
		if self.dim == 3: half = [half[0], half[2], half[1]]
		a, b = half[0], half[self.up]
		top = a * abs(np.sin(body['turn'])) + b * abs(np.cos(body['turn']))
		axis = (0, 0, 1) if self.dim == 2 else (0, 1, 0)
		return One(utils.box(self._place(body['at'], gap + top), tuple(x * h for x in half), orientation=Quaternion(axis, body['turn']), **solid))

	def _facet(self, body, gap):
		rise = body['slope'] * 9
		ends = [np.array(self._place(body['at'] + sign * 9, gap + abs(rise) + sign * rise)) for sign in (-1, 1)]
		if self.dim == 2: return One(utils.facet([tuple(ends[0]), tuple(ends[1]), tuple(ends.pop() * 0 + (0, self.size[1] * self.h + gap + abs(rise) * self.h, 9.))], material='rigid', fixed=True))
		return One(utils.facet([tuple(ends[0] - (0, 9, 0)), tuple(ends[1] - (0, 9, 0)), tuple((ends[0] + ends[1]) / 2 + (0, 12, 0))], material='rigid', fixed=True))

	def _clump(self, body, gap):
		r = body['radius'] * self.h
		spheres = [utils.sphere(self._place(body['at'] + k * body['radius'] * .8, gap + body['radius']), r, material='rigid', fixed=True) for k in (0, 1)]
		clump, _ = O.bodies.appendClumped(spheres)
		return _Clump(clump)

	def _move(self):
		"""Speed of a pushed body that makes its way in a step; in time steps it is at least 0.05 m/s."""
		if self.isFree: return
		for body, rigid in zip(self.bodies, self.rigid):
			a, b = (x * self.h / O.dt for x in body['way'])
			if self.isDynamic: a, b = (float(np.clip(x, -1., 1.)) for x in (a, b))
			rigid.move((a, b, 0) if self.dim == 2 else (a, 0, b))
			if body.get('spin') and not self.isRing and body['kind'] in ('sphere', 'turned box'): rigid.state.angVel = (0, 0, body['spin'] / O.dt) if self.dim == 2 else (0, body['spin'] / O.dt, 0)


class _Clump:

	def __init__(self, clump):
		self.state = O.bodies[clump].state

	def move(self, velocity):
		self.state.vel = velocity


def balanceOf(scene, solver, contact):
	"""Forces from outside that are left over, over the sum of their sizes. The force that holds points apart from the rest, which a warning tells, is one of them."""
	weight = 1800 * 9.81 * sum(O.bodies[i].state.volume0 for i in range(scene.number))
	held = [np.array(solver.report()['looseForce'])] if not scene.isDynamic else []
	forces = [np.array(F) for F in solver.reactions] + [-np.array(F) for F in contact.forces] + held + [weight * np.array([-(axis == scene.up) for axis in range(3)], float)]
	axes = [1] if scene.isRing else list(range(scene.dim))
	return float(np.abs(sum(forces)[axes]).max() / sum(np.linalg.norm(F) for F in forces))


def run(seed, seconds, ghost):
	"""Why it ended, largest balance of its steps, and the course."""
	scene = Scene(seed)
	solver, contact = scene.add()
	if scene.poisson >= .45: solver.ghost = MpmGhost(factor=ghost)
	course, off = Course(solver, seconds), [0.]

	def look():
		if not scene.isDynamic and solver.iterPeriod in (0, 1): off.append(balanceOf(scene, solver, contact))

	course.run(scene.steps if not scene.isFree else 60, look)
	return scene, max(off), course


def drawn(seeds=(0, 1000), seconds=900, ghost=.01):
	"""Number of runs that end, the balance of forces in statics, and the seeds that do not end.

	:param ghost: factor of the stabilisation where Poisson's ratio is 0.45 or more
	"""
	runs = {}
	for seed in range(*seeds):
		with said():
			runs[seed] = run(seed, max(5, seconds / (seeds[1] - seeds[0])), ghost)
	stopped = {seed: course.why for seed, (_, _, course) in runs.items() if course.why}
	worst = max(runs, key=lambda seed: runs[seed][1])
	return dict(scenes=len(runs), ended=(len(runs) - len(stopped)) / len(runs), balance=runs[worst][1], worst=worst, cuts=sum(c.cuts for *_, c in runs.values()), iterations=sum(c.iterations for *_, c in runs.values()), stopped=[f'{seed} ({runs[seed][0].text}): {text}' for seed, text in list(stopped.items())[:20]], why=reasons(stopped.values()))
