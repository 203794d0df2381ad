# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of points that are drawn at random, and meet: they win no energy, and forces and momenta balance."""
import random
from math import atan, cos, inf, pi, sin

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBodyContact, MpmBoundary, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, MpmNewton, MpmVonMisesMat, Omega

from .course import Course, reasons, said

O = Omega()
schemes = 'newmark', 'generalised-alpha', 'midpoint'
admitted = 1e-3  # part of the first energy
h, density = .1, 1800.


class Scene:
	"""Scene of a seed: one or two turned blocks or polygons above a block. In time they fly at each other, all free, or fall on the lowest, which is constrained; in statics the upper one is pushed down and along by a row of nodes."""

	def __init__(self, seed):
		draw = self.draw = random.Random(seed)
		self.isDynamic = draw.random() < .6
		self.isFree = self.isDynamic and draw.random() < .5
		self.E = [10**draw.uniform(5, 7) for _ in range(3)]
		self.poisson, self.points = draw.choice([0., .2, .3, .45]), draw.choice([2, 2, 3])
		self.yields = draw.random() < .25
		self.friction = draw.choice([0., 0., .2, .5, 1.])
		self.adhesion = draw.choice([inf, inf, inf, 2e3])
		self.scheme, self.part = draw.choice(schemes), draw.choice([.03, .05, .1, .15, .2])
		self.angle = draw.uniform(-.7, .7)
		self.shapes = [self._shape(k) for k in range(draw.choice([1, 1, 2]) if self.isDynamic else 1)]
		kind = ('free' if self.isFree else 'falls') + ' ' + self.scheme if self.isDynamic else 'static'
		self.text = f"{kind} E {' '.join(f'{E:.1e}' for E in self.E)} nu {self.poisson} mu {self.friction} {'yields' if self.yields else ''} {len(self.shapes)} above"

	def _shape(self, number):
		"""Corners, counterclockwise, of a body whose lowest one is a little above the block, or above the body before."""
		draw = self.draw
		x, gap = draw.uniform(-.25, .25), draw.uniform(.004, .03)
		if not self.isDynamic: corners = [(x + a, b) for a, b in ((-.2, 0), (.2, 0), (.2, .3), (-.2, .3))]
		elif draw.random() < .6:
			turn, a, b = draw.uniform(0, pi), draw.uniform(.12, .25), draw.uniform(.12, .25)
			corners = [(x + p * cos(turn) - q * sin(turn), p * sin(turn) + q * cos(turn)) for p, q in ((-a, -b), (a, -b), (a, b), (-a, b))]
		else:
			count, radius, turn = draw.choice([5, 6, 12]), draw.uniform(.15, .25), draw.uniform(0, pi)
			corners = [(x + radius * cos(turn + 2 * pi * k / count), radius * sin(turn + 2 * pi * k / count)) for k in range(count)]
		lift = gap - min(y for _, y in corners) + .65 * number
		return [(p, q + lift) for p, q in corners]

	def add(self):
		O.reset()
		names = ['low', 'up', 'top'][:1 + len(self.shapes)]
		for name, E in zip(names, self.E):
			kind, more = (MpmVonMisesMat, dict(yieldStress=E / 50)) if self.yields else (MpmElasticMat, {})
			O.materials.append(kind(young=E, poisson=self.poisson, density=density, label=name, **more))
		grid = MpmGrid(cellSize=h)
		regions = [pack.inAlignedBox((-.6, -.4, -1), (.6, 0, 1)), *(mpm.polygon(shape) for shape in self.shapes)]
		for name, region in zip(names, regions):
			O.bodies.append(mpm.fill(region, grid, self.points, name, body=name))
		pairs = [(a, b) for i, a in enumerate(names) for b in names[i + 1:]]
		self.contacts = [MpmBodyContact(between=pair, friction=atan(self.friction), adhesion=self.adhesion) for pair in pairs]
		held = [] if self.isFree else [MpmBoundary(max=(inf, -.4, inf), fix='xy')]
		common = dict(grid=grid, contacts=self.contacts, newton=MpmNewton(minStep=1 / 256, tolerance=1e-8), verbosity=0)
		if not self.isDynamic:
			top = max(y for _, y in self.shapes[0]) - 1.5 * h
			pushed = MpmBoundary(min=(-inf, top, -inf), fix='xy', displacement=(.04 * sin(self.angle), -.04 * cos(self.angle), 0))
			O.dt = 1 / 8
			return MpmImplicitEngine(gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=[*held, pushed], **common)
		points = mpm.arrays()
		velocity = np.array([sin(self.angle), -cos(self.angle), 0])
		mpm.assign(velocity=np.outer(points['body'] > 0, velocity) - (np.outer(points['body'] == 0, velocity) if self.isFree else 0))
		O.dt = self.part * h
		gravity = {} if self.isFree else dict(gravity=(0, -9.81, 0), gravityCurve=[(0, 1)])
		return MpmDynamicEngine(scheme=self.scheme, boundaries=held, **gravity, **common)


def run(seed, seconds):
	"""Largest energy less the work of gravity over the first, what of momenta or of forces is left over, and the course."""
	scene = Scene(seed)
	O.engines = [solver := scene.add()]
	course, energies, off, touched = Course(solver, seconds), [0.], [0.], [False]
	mass = density * mpm.arrays()['volume']
	momentum = lambda: mass @ mpm.arrays()['velocity']
	begun = momentum() if scene.isDynamic else None
	size = mass.sum() * 1.
	first = (mass * (mpm.arrays()['velocity']**2).sum(1)).sum() / 2 if scene.isDynamic else None

	def look():
		touched[0] = touched[0] or any(contact.touching for contact in scene.contacts)
		data = solver.plotData()
		if scene.isDynamic: energies.append((data['kineticEnergy'] + data['elasticEnergy'] - data['loadWork']) / (first + abs(data['loadWork'])))
		if scene.isFree: off.append(float(np.abs(momentum() - begun).max() / size))
		if not scene.isDynamic:
			forces = [*map(np.array, solver.reactions), np.array([0, -9.81 * mass.sum(), 0])]
			off.append(float(np.abs(sum(forces)[:2]).max() / sum(np.linalg.norm(F) for F in forces)))

	course.run(8 if not scene.isDynamic else min(60, int(.3 / O.dt) + 1), look)
	return scene, max(energies), max(off), touched[0], course


def drawn(seeds=(0, 300), seconds=300):
	"""Number of runs that end, of those that move and gain energy, and the balance of forces or momenta."""
	runs = {}
	for seed in range(*seeds):
		with said():
			runs[seed] = run(seed, max(3, seconds / (seeds[1] - seeds[0])))
	stopped = {seed: course.why for seed, (*_, course) in runs.items() if course.why}
	worst, least = max(runs, key=lambda seed: runs[seed][1]), max(runs, key=lambda seed: runs[seed][2])
	told = dict(scenes=len(runs), touched=sum(met for *_, met, _ in runs.values()), ended=1 - len(stopped) / len(runs), energy=runs[worst][1], gains=sum(energy > 1 + admitted for _, energy, *_ in runs.values()), worst=worst)
	told |= dict(balance=runs[least][2], least=least, cuts=sum(course.cuts for *_, course in runs.values()), iterations=sum(course.iterations for *_, course in runs.values()))
	return told | dict(stopped=[f'{seed} ({runs[seed][0].text}): {text}' for seed, text in list(stopped.items())[:20]], why=reasons(stopped.values()))
