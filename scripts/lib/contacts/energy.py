# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks that fall on fixed bodies: these give no energy, whatever the step and the edge, and whether they are smooth or soil sticks to them."""
import random
from math import atan, cos, hypot, inf, pi, sin

import numpy as np
from yade import mpm, pack, utils
from yade.minieigenHP import Quaternion
from yade.wrapper import MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, Omega

from .bodies import One, Outline, steel
from .course import Course, reasons, said

O = Omega()
schemes = 'newmark', 'generalised-alpha', 'midpoint'
admitted = 1e-3  # part of the first energy


def falling(E, nu, size, points, h, velocity, bodies, scheme, part, end, seconds, density=1000., gravity=0., **rubs):
	"""A square block on bodies that are fixed, in steps of *part* cells: the largest energy less the work of gravity, and the largest work of contact, over the first energy.

	:param rubs: *friction* and *adhesion* of the contact; smooth without
	"""
	O.reset()
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=density, label='soil'))
	steel()
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (size, size, 1)), grid, points, 'soil'))
	number, speed = len(O.bodies), hypot(*velocity)
	bodies()
	solver = MpmDynamicEngine(grid=grid, scheme=scheme, contacts=[MpmContact(**(rubs or dict(friction=0)))], gravity=(0, -gravity, 0), gravityCurve=[(0, 1)], verbosity=0)
	O.engines, O.dt = [solver], part * h / speed
	mpm.assign(velocity=[(*velocity, 0)] * number)
	first, most, gave, fell = .5 * density * size**2 * speed**2, [0.], [-inf], [0.]

	def look():
		data = solver.plotData()
		fell[0] = max(fell[0], abs(data['loadWork']))
		most.append(data['kineticEnergy'] + data['elasticEnergy'] - data['loadWork'])
		gave.append(data['contactWork'])

	course = Course(solver, seconds)
	course.run(int(end / O.dt) + 1, look)
	return dict(energy=max(most) / first if not gravity else max(most) / (first + fell[0]), gave=max(gave) / (first + fell[0]), why=course.why, course=course)


def _sum(runs):
	"""Summary of many runs."""
	worst = max(runs, key=lambda k: runs[k]['gave'])
	told = dict(energy=max(r['energy'] for r in runs.values()), contactWork=max(r['gave'] for r in runs.values()))
	told |= dict(gains=sum(r['energy'] > 1 + admitted for r in runs.values()), gifts=sum(r['gave'] > admitted for r in runs.values()))
	why = [r['why'] for r in runs.values() if r['why']]
	courses = [r['course'] for r in runs.values()]
	return dict(**told, ended=1 - len(why) / len(runs), scenes=len(runs), worst=str(worst), iterations=sum(c.iterations for c in courses), cuts=sum(c.cuts for c in courses), why=reasons(why))


def edges(scheme, parts=(.3, .15, .05), seconds=120):
	"""A block falls on the edge of a turned Box, in nine places."""
	runs = {}
	for part in parts:
		for turn in .4, pi / 4, 1.1:
			for x in .12, .15, .17:
				top = .15 * (abs(cos(turn)) + abs(sin(turn)))
				body = lambda: One(utils.box((x, -.03 - top, 0), (.15, .15, 1), orientation=Quaternion((0, 0, 1), turn), material='rigid', fixed=True))
				runs[f'{part} {turn:.2f} {x}'] = falling(1e5, .2, .3, 3, .1, (0, -1.), body, scheme, part, .6, seconds / (9 * len(parts)))
	return _sum(runs)


class Drawn:
	"""A scene by its seed: a block that flies at one to three fixed bodies, or slides down on them."""

	rubs = {}

	def __init__(self, seed):
		draw = random.Random(seed)
		self.h, self.size, self.points = .1, .3, draw.choice([2, 3])
		self.E, self.nu = 10**draw.uniform(4.3, 6), draw.uniform(0, .45)
		self.scheme, self.part = draw.choice(schemes), draw.choice([.03, .05, .1, .15, .3, .3, 1.])
		angle = draw.uniform(-.9, .9)
		self.velocity = sin(angle), -cos(angle)
		self.gravity = draw.choice([0., 0., 9.81])
		self.bodies = [self._body(draw, k) for k in range(draw.choice([1, 1, 2, 3]))]

	def _body(self, draw, number):
		"""Kind, and what it needs: below the block, so far that nothing of it reaches y = -0.02."""
		kind = draw.choice(['box', 'box', 'sphere', 'facet', 'outline'] + ['wall'] * (number == 0))
		x, turn = draw.uniform(-.05, .35) + .1 * number * draw.choice([-1, 1]), draw.uniform(0, pi)
		gap = draw.uniform(.02, .05)
		if kind == 'wall': return kind, -gap - draw.uniform(0, .1)
		if kind == 'sphere': return kind, (x, draw.uniform(.04, .3), gap)
		if kind == 'box': return kind, (x, draw.uniform(.03, .2), draw.uniform(.03, .2), turn, gap)
		if kind == 'facet': return kind, (x, draw.uniform(.3, 1.), draw.uniform(-.9, .9), gap)
		return kind, (x, sorted(draw.uniform(0, 2 * pi) for _ in range(draw.choice([3, 4, 5]))), draw.uniform(.08, .25), gap)

	def add(self):
		for kind, values in self.bodies:
			getattr(self, '_' + kind)(values)

	def _wall(self, y):
		One(utils.wall(y, axis=1, sense=1, material='rigid'))

	def _sphere(self, values):
		x, radius, gap = values
		One(utils.sphere((x, -gap - radius, 0), radius, material='rigid', fixed=True))

	def _box(self, values):
		x, a, b, turn, gap = values
		top = a * abs(sin(turn)) + b * abs(cos(turn))
		One(utils.box((x, -gap - top, 0), (a, b, 1), orientation=Quaternion((0, 0, 1), turn), material='rigid', fixed=True))

	def _facet(self, values):
		x, long, slope, gap = values
		end = long / 2 * cos(slope), long / 2 * sin(slope)
		middle = x, -gap - abs(end[1])
		ends = [(middle[0] - end[0], middle[1] - end[1]), (middle[0] + end[0], middle[1] + end[1])]
		One(utils.facet([(*ends[0], 0), (*ends[1], 0), (*middle, long)], material='rigid', fixed=True))

	def _outline(self, values):
		"""A polygon in a circle: its corners are in order and it is convex, with the soil on its right."""
		x, angles, radius, gap = values
		corners = [(radius * cos(a), radius * sin(a)) for a in angles]
		top = max(y for _, y in corners)
		line = [(x + p, q - top - gap) for p, q in corners]
		if min(hypot(a[0] - b[0], a[1] - b[1]) for a, b in zip(line, line[1:] + line[:1])) < .02: return self._sphere((x, radius, gap))
		Outline([*line, line[0]])


class Sticking(Drawn):
	"""The same with Spheres alone, to which soil sticks up to an adhesion, or which only rub, or are smooth."""

	def __init__(self, seed):
		super().__init__(seed)
		draw = random.Random(seed + 1000000)
		self.bodies = [('sphere', (draw.uniform(-.05, .35), draw.uniform(.04, .4), draw.uniform(.02, .05))) for _ in range(draw.choice([1, 1, 2, 3]))]
		self.rubs = dict(friction=draw.choice([0., .2, .5, 1.2, atan(5)]), adhesion=draw.choice([inf, 10**draw.uniform(2, 4.5), 10**draw.uniform(2, 4.5)]))


def drawn(seeds=(0, 1000), seconds=600, sticks=False):
	"""Blocks and bodies by their seeds."""
	runs = {}
	for seed in range(*seeds):
		scene = (Sticking if sticks else Drawn)(seed)
		with said():
			runs[seed] = falling(scene.E, scene.nu, scene.size, scene.points, scene.h, scene.velocity, scene.add, scene.scheme, scene.part, .5, max(2, seconds / (seeds[1] - seeds[0])), gravity=scene.gravity, **scene.rubs)
	return _sum(runs)
