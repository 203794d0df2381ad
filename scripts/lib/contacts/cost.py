# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of contact: a block under a plate, against the block under its weight alone; a ball with contact points an eighth of a cell apart, against one with a quarter; a block in two bodies of points, against one; and one in contact with itself, against one that is not."""
import time
from math import atan, inf

from yade import mpm, pack, utils
from yade.wrapper import MpmBodyContact, MpmBoundary, MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, Omega

from .bodies import One, steel
from .course import Course

O = Omega()


def _seconds(dim, wide, deep, steps, friction, seconds, growth=0.):
	"""Processor time of an iteration of load steps behind the first one. friction None: without a plate, under weight that grows in each step by *growth* [m/s2], or stays."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.2, density=1, label='soil'))
	steel()
	grid, isFlat = MpmGrid(cellSize=1., dim=dim), dim == 2
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1 if isFlat else 0), (wide, deep, 1 if isFlat else wide)), grid, 2, 'soil'))
	settings = dict(gravity=(0, -growth * (steps + 1), 0), gravityCurve=[(0, 0), (steps + 1, 1)]) if growth else dict(gravity=(0, -10, 0))
	if friction is not None:
		plate = One(utils.box((wide / 2, deep + 2, 0 if isFlat else wide / 2), (wide, 2, 1 if isFlat else wide), material='rigid', fixed=True), (.006 if friction else 0, -.02, 0))
		settings = dict(contacts=[MpmContact(friction=friction)])
	solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz'[:dim])], verbosity=0, **settings)
	O.engines, O.dt = [solver], 1
	course = Course(solver, seconds)
	course.run(1)
	first, began = course.iterations, time.process_time()
	course.run(steps)
	places = settings['contacts'][0].touching[0] if friction is not None else 0
	return (time.process_time() - began) / (course.iterations - first), course.iterations - first, places, course.why


def share(dim=2, wide=80, deep=20, steps=6, friction=0., seconds=200):
	"""Part of an iteration that contact takes, beyond one of the same block without it: *wide* by *deep* cells, of which the plate touches the uppermost.

	A step takes as long as an iteration or two before and after Newton's method. With friction it has several iterations, so that each bears less of that: in the plane the block without a plate is loaded so much that it has several, too. In space an iteration takes much longer than the rest, and so much load would make its matrix indefinite.
	"""
	growth = 4e4 / deep if friction and dim == 2 else 0.
	alone, own, *_ = _seconds(dim, wide, deep, steps, None, seconds / 2, growth)
	with_, iterations, places, why = _seconds(dim, wide, deep, steps, friction, seconds / 2)
	return dict(share=1 - alone / with_, alone=1e3 * alone, milliseconds=1e3 * with_, iterations=iterations, iterationsAlone=own, places=places, why=why)


def search(sizes=(200, 800, 3200), deep=4, steps=6, seconds=200):
	"""Cost of a contact point in a step of one iteration, most over least for plates of these widths [cells]: 1 where it is linear in their number."""
	found = []
	for wide in sizes:
		one = share(2, wide, deep, steps, 0., seconds / len(sizes))
		found.append((one['milliseconds'] - one['alone']) / one['places'])
	return dict(growth=found[-1] / found[0], each=[1e3 * x for x in found])


def _secondsOfBall(dim, radius, wide, deep, steps, friction, seconds):
	"""Processor time of a step in time in which a ball slides over a block, half a cell deep in it; iterations and places."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.2, density=1000, label='soil'))
	steel()
	grid, isFlat = MpmGrid(cellSize=1., dim=dim), dim == 2
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1 if isFlat else 0), (wide, deep, 1 if isFlat else wide)), grid, 2, 'soil'))
	sink = 10
	ball = One(utils.sphere((wide / 2, deep + radius, 0 if isFlat else wide / 2), radius, material='rigid', fixed=True))
	contact = MpmContact(friction=friction, stiffness=20)
	solver = MpmDynamicEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz'[:dim])], contacts=[contact], scheme='generalised-alpha', rhoInfinity=.5, verbosity=0)
	O.engines, O.dt = [solver], .1
	course = Course(solver, seconds)
	ball.state.vel = (0, -.5 / sink / O.dt, 0)
	course.run(sink)
	ball.state.vel = (.05 / O.dt, 0, 0)
	first, began = course.iterations, time.process_time()
	course.run(steps)
	return (time.process_time() - began) / steps, course.iterations - first, contact.touching[0], course.why


def ball(dim=3, wide=12, deep=4, steps=20, friction=.3, runs=3, seconds=200):
	"""Ratio of the times of a time step with contact points an eighth of a cell apart on a ball of two cells of radius, and with a quarter, as on one that is a thousandth smaller.

	:param runs: of each, in turn, of which the fastest counts
	"""
	found = [[_secondsOfBall(dim, r, wide, deep, steps, friction, seconds / runs / 2) for r in (1.998, 2.)] for _ in range(runs)]
	(quarter, *before), (eighth, *after) = (min(of) for of in zip(*found))
	told = dict(more=eighth / quarter - 1, quarter=1e3 * quarter, milliseconds=1e3 * eighth)
	return told | dict(iterations=[before[0], after[0]], places=[before[1], after[1]], why=before[2] or after[2])


def _secondsOfBlock(isCut, wide, deep, steps, friction, inTime, seconds):
	"""Processor time in which a block comes under its weight, which it falls into in time; in two pieces that lie on each other, or in one."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=.3, density=2000, label='soil'))
	h = 4 / wide
	grid = MpmGrid(cellSize=h)
	for low, high, name in (0, deep / 2, 'low'), (deep / 2, deep, 'up' if isCut else 'low'):
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, low * h, -1), (4, high * h, 1)), grid, 2, 'soil', body=name))
	held = [MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmBoundary(max=(0, inf, inf), fix='x')]
	common = dict(grid=grid, gravity=(0, -10, 0), boundaries=held, contacts=[MpmBodyContact(between=('low', 'up'), friction=atan(friction))] if isCut else [], verbosity=0)
	solver = MpmDynamicEngine(gravityCurve=[(0, 1)], **common) if inTime else MpmImplicitEngine(**common)
	O.engines, O.dt = [solver], .01 if inTime else 1 / steps
	course, began = Course(solver, seconds), time.process_time()
	course.run(steps)
	return time.process_time() - began, course.iterations, course.why


def bodies(wide=128, deep=48, steps=4, friction=0., inTime=False, runs=3, seconds=200):
	"""Processor time of a block in two bodies over that of the same in one, least of *runs* of each in turn, and their iterations."""
	found = [[_secondsOfBlock(isCut, wide, deep, steps, friction, inTime, seconds / 2 / runs) for isCut in (False, True)] for _ in range(runs)]
	one, two = (min(run[i][0] for run in found) for i in (0, 1))
	return dict(times=two / one, one=one, two=two, iterations=[run[1] for run in found[0]], why=' '.join({why for run in found for *_, why in run if why}))


def _secondsOfOne(dim, cells, isOwn, steps, seconds):
	"""Processor time in which a block falls into its weight; in contact with itself or not."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=1000, label='soil'))
	grid = MpmGrid(cellSize=.1, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (.1 * cells, .1 * cells, .1 * cells if dim == 3 else 1)), grid, 2, 'soil', body='soil'))
	contacts = [MpmBodyContact(between=('soil', 'soil'), friction=.3, folds=True)] if isOwn else []
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz'[:dim])], contacts=contacts, verbosity=0)
	O.engines, O.dt = [solver], .002
	course = Course(solver, seconds)
	course.run(1)
	began = time.process_time()
	course.run(steps)
	return time.process_time() - began, course.iterations, course.why


def itself(dim=2, cells=55, steps=12, runs=6, seconds=200):
	"""Processor time of steps of a block in contact with itself, which touches itself nowhere, over that without, least of *runs* of each in turn, and their iterations."""
	found = [[_secondsOfOne(dim, cells, isOwn, steps, seconds / 2 / runs) for isOwn in (False, True)] for _ in range(runs)]
	without, with_ = (min(run[i][0] for run in found) for i in (0, 1))
	return dict(times=with_ / without, without=without, seconds=with_, iterations=[run[1] for run in found[0]], why=' '.join({why for run in found for *_, why in run if why}))
