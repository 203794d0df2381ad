# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres that YADE moves on elastic ground: rolling, slipping, driven, and the momentum of an impact."""
from math import cos, inf, radians, sin, tan

import numpy as np
from yade import mpm, pack, utils
from yade.wrapper import ForceResetter, FrictMat, MpmBoundary, MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, NewtonIntegrator, Omega

from .bodies import One
from .course import Course

O = Omega()
g, R = 10., .5


def _ground(young, friction, gravity, every, isDynamic, stiffness, dt=1e-3, long=12, wide=4, deep=2, off=.5, rest=.1, h=.125):
	"""A sphere that has sunk into stiff ground two cells thick, whose base is held, by its weight on level ground in *rest* seconds, and is at rest there."""
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=.2, density=2000, label='soil'))
	O.materials.append(FrictMat(young=1e9, density=2600, frictionAngle=np.arctan(friction), label='rigid'))
	grid = MpmGrid(cellSize=h, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -deep * h), (long * h, wide * h, 0)), grid, 2, 'soil'))
	for body in O.bodies: body.groupMask = 2
	ball = One(utils.sphere(((3 + off) * h, wide / 2 * h, R), R, material='rigid'))
	contact = MpmContact(mask=1, stiffness=stiffness)
	sides = [MpmBoundary(max=(inf, inf, -deep * h), fix='xyz')]
	solver = MpmDynamicEngine(grid=grid, boundaries=sides, contacts=[contact], scheme='generalised-alpha', rhoInfinity=.5, iterPeriod=every, verbosity=0) if isDynamic else MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact], iterPeriod=every, verbosity=0)
	mover = NewtonIntegrator(gravity=(0, 0, gravity[2]), damping=.7, mask=1)
	O.engines = [ForceResetter(), solver, mover]
	O.dt = dt / every
	O.run(int(round(rest / O.dt)), wait=True)
	mover.gravity, mover.damping = gravity, 0
	ball.state.vel = ball.state.angVel = (0, 0, 0)
	return ball, contact, solver


def exactOf(friction, slope):
	"""Accelerations along the slope, of the middle and of the rim relative to it; with friction beyond two sevenths of tan(slope) it rolls."""
	if friction >= 2 / 7 * tan(slope): return 5 / 7 * g * sin(slope), 5 / 7 * g * sin(slope)
	return g * (sin(slope) - friction * cos(slope)), 5 / 2 * friction * g * cos(slope)


def rolling(friction, degrees=30., heading=0., isDynamic=True, every=1, end=.5, starts=(0., .5), young=2e8, stiffness=100., dt=5e-4, long=13, seconds=200, **ground):
	"""Down a slope, by gravity that is turned; way and speeds of middle and rim over those on rigid ground, and how far way and speed are off at most.

	:param young: of the ground [Pa]: the closed forms are those of a rigid one. On a softer one the dent is deeper, and as the stiffness of a contact of less than a cell is not the same above a node and between two, the sphere bounces where it passes nodes as fast as it swings on the ground.
	:param heading: direction on the ground, from the x axis [degrees]
	:param starts: where in a cell it begins, run by run
	:param long: of the ground [cells]
	:param ground: *h* of a cell, *rest* before it is let go, as of _ground
	"""
	slope, direction = radians(degrees), radians(heading)
	down = np.array((cos(direction), sin(direction), 0))
	ways, speeds, rims, courses = [], [], [], []
	for off in starts:
		ball, contact, solver = _ground(young, friction, tuple(g * sin(slope) * down - (0, 0, g * cos(slope))), every, isDynamic, stiffness, dt, wide=10 if heading else 4, long=11 if heading else long, off=off, **ground)
		start, course, began = np.array(ball.state.pos), Course(solver, seconds / len(starts)), O.time
		course.run(int(round(end / O.dt)))
		t, (a, spin) = O.time - began, exactOf(friction, slope)
		ways.append(float((np.array(ball.state.pos) - start) @ down / (a * t * t / 2)))
		speeds.append(float(np.array(ball.state.vel) @ down / (a * t)))
		if friction: rims.append(float(np.linalg.norm(ball.state.angVel) * R / (spin * t)))
		courses.append(course)
	told = dict(kind='rolls' if friction >= 2 / 7 * tan(slope) else 'slips', off=max(abs(x - 1) for x in ways), speedOff=max(abs(x - 1) for x in speeds), way=ways, speed=speeds, rim=rims, cells=a * t * t / 2 / ground.get('h', .125))
	return told | dict(iterations=sum(c.iterations for c in courses), cuts=sum(c.cuts for c in courses), seconds=sum(c.told()['seconds'] for c in courses), why='; '.join(c.why for c in courses if c.why))


def driven(friction=.4, speed=1.5, end=.6, every=1, young=5e7, stiffness=100., seconds=200):
	"""A sphere that is kept spinning on level ground: its middle accelerates by friction g until the rim's speed is its own."""
	ball, contact, solver = _ground(young, friction, (0, 0, -g), every, True, stiffness, long=14)
	ball.state.blockedDOFs = 'yXYZ'
	ball.state.angVel = (0, speed / R, 0)
	start, course, ways, began = ball.state.pos[0], Course(solver, seconds), [], O.time
	course.run(int(round(end / O.dt)), lambda: ways.append((O.time - began, ball.state.pos[0] - start, ball.state.vel[0])))
	t, gone, v = ways[-1]
	until = speed / (friction * g)
	exact = speed * t - speed * until / 2 if t > until else friction * g * t * t / 2
	return dict(way=float(gone / exact), speed=float(v / min(speed, friction * g * t)), **course.told())


def impact(every=1, seconds=200):
	"""A sphere meets a slab that nothing holds: momentum of both after it, over what the sphere had. A period may be refused instead, by a sentence that names it."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=1500, label='soil'))
	O.materials.append(FrictMat(density=2600, label='rigid'))
	grid = MpmGrid(cellSize=.1, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (.4, .4, .2)), grid, 2, 'soil'))
	for body in O.bodies: body.groupMask = 2
	ball = One(utils.sphere((.25, .22, .301), .1, material='rigid'), (.3, 0, -1))
	contact = MpmContact(friction=.3, mask=1)
	solver = MpmDynamicEngine(grid=grid, contacts=[contact], verbosity=0, iterPeriod=every)
	O.engines, O.dt = [ForceResetter(), solver, NewtonIntegrator(damping=0, mask=1)], 2e-4
	mass, before = ball.state.mass, ball.state.mass * np.array(ball.state.vel)
	course = Course(solver, seconds)
	course.run(400)
	now = mass * np.array(ball.state.vel) + mpm.arrays()['velocity'].mean(axis=0) * 1500 * .032
	change = np.linalg.norm(now - before) / np.linalg.norm(before)
	isRefused = 'iterPeriod' in course.why
	return dict(off=0. if isRefused else float(change), refused=isRefused, **course.told())
