# SPDX-License-Identifier: GPL-2.0-or-later
"""What contact costs: a block under a plate, against the block under its weight alone."""
import time
from math import inf

from yade import mpm, pack, utils
from yade.wrapper import MpmBoundary, MpmContact, MpmElasticMat, MpmGrid, MpmImplicitEngine, Omega

from .bodies import One, steel
from .course import Course

O = Omega()


def _seconds(dim, wide, deep, steps, friction, seconds):
	"""Processor time of an iteration of load steps behind the first one; friction None: without a plate."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.2, density=1, label='soil'))
	steel()
	grid, isFlat = MpmGrid(cellSize=1., dim=dim), dim == 2
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1 if isFlat else 0), (wide, deep, 1 if isFlat else wide)), grid, 2, 'soil'))
	settings = dict(gravity=(0, -10, 0))
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
	"""Part of an iteration that contact takes, beyond one of the same block without it: *wide* by *deep* cells, of which the plate touches the uppermost."""
	alone, *_ = _seconds(dim, wide, deep, steps, None, seconds / 2)
	with_, iterations, places, why = _seconds(dim, wide, deep, steps, friction, seconds / 2)
	return dict(share=1 - alone / with_, alone=1e3 * alone, milliseconds=1e3 * with_, iterations=iterations, places=places, why=why)


def search(sizes=(200, 800, 3200), deep=4, steps=6, seconds=200):
	"""What a place costs in a step of one iteration, most over least for plates of these widths [cells]: 1 where it is linear in their number."""
	found = []
	for wide in sizes:
		one = share(2, wide, deep, steps, 0., seconds / len(sizes))
		found.append((one['milliseconds'] - one['alone']) / one['places'])
	return dict(growth=found[-1] / found[0], each=[1e3 * x for x in found])
