# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil and bodies that move up to several cells a step at each other: nothing ends inside of a body or behind it."""
import numpy as np
from yade import mpm, pack, utils
from yade.minieigenHP import Quaternion
from yade.wrapper import MpmBoundary, MpmContact, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmImplicitEngine, Omega

from .bodies import One, steel
from .course import Course, reasons, said

O = Omega()
h, side, place = .1, .4, -.5
kinds = 'wall', 'facet', 'box', 'thin box', 'turned box', 'sphere'


def _body(kind):
	"""Body with its upper end at y = *place*, under a block from y = 0 on."""
	if kind == 'wall': return One(utils.wall(place, axis=1, sense=1, material='rigid'))
	if kind == 'facet': return One(utils.facet([(-9, place, 0), (9, place, 0), (0, place, 9)], material='rigid', fixed=True))
	if kind == 'box': return One(utils.box((side / 2, place - .5, 0), (2, .5, 1), material='rigid', fixed=True))
	if kind == 'thin box': return One(utils.box((side / 2, place - .02, 0), (2, .02, 1), material='rigid', fixed=True))
	if kind == 'turned box': return One(utils.box((side / 2, place - .4 * 2**.5, 0), (.4, .4, 1), orientation=Quaternion((0, 0, 1), np.pi / 4), material='rigid', fixed=True))
	return One(utils.sphere((side / 2, place - .1, 0), .1, material='rigid', fixed=True))


def _behind(kind, body, places):
	"""Number of centres of points that are in the body by more than a tenth of a cell, or beyond it where it cannot be passed."""
	if kind in ('wall', 'facet'): return int((places[:, 1] < body.state.pos[1] - .1 * h).sum())
	deep = body.depths(places) > .1 * h
	if kind in ('box', 'thin box'): deep |= places[:, 1] < body.state.pos[1]
	return int(deep.sum())


def _block():
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=1000, label='soil'))
	steel()
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (side, side, 1)), grid, 2, 'soil'))
	return grid, len(O.bodies)


def _watch(kind, body, solver, steps, seconds, energy=False):
	"""Most points behind, the largest energy of the block, and the largest work of contact on it."""
	behind, most, gave = [0], [0.], [0.]

	def look():
		behind.append(_behind(kind, body, mpm.arrays()['pos']))
		if energy:
			data = solver.plotData()
			most.append(data['kineticEnergy'] + data['elasticEnergy'])
			gave.append(data['contactWork'])

	course = Course(solver, seconds)
	course.run(steps, look)
	return max(behind), max(most), max(gave), course


def flying(kind, cells, isSoil, seconds):
	"""A block that flies at a fixed body, or a body at a block at rest, by this many cells a step, with nothing said about how short steps should be."""
	grid, number = _block()
	body = _body(kind)
	solver = MpmDynamicEngine(grid=grid, contacts=[MpmContact(friction=0)], verbosity=0)
	O.engines, O.dt = [solver], cells * h
	if isSoil: mpm.assign(velocity=[(0, -1., 0)] * number)
	else: body.move((0, 1., 0))
	behind, most, gave, course = _watch(kind, body, solver, int(1.2 / O.dt) + 1, seconds, isSoil)
	first = .5 * 1000 * side**2
	return behind, most / first, gave / first, course


def pushed(kind, cells, isSoil, seconds):
	"""In statics, by 0.6 m in steps of so many cells: a block whose upper side is held is moved down at a body 0.5 m below it, or the body up at the block."""
	grid, number = _block()
	body = _body(kind)
	steps = max(1, round(.6 / (cells * h)))
	way = .6 / steps
	held = MpmBoundary(surface=[(side, side), (0, side)], fix='xy', velocity=(0, -way if isSoil else 0, 0))
	if not isSoil: body.move((0, way, 0))
	solver = MpmImplicitEngine(grid=grid, boundaries=[held], contacts=[MpmContact(friction=0)], verbosity=0)
	O.engines, O.dt = [solver], 1
	return _watch(kind, body, solver, steps, seconds)


modes = dict(soilFlies=(flying, True), bodyFlies=(flying, False), soilPushed=(pushed, True), bodyPushed=(pushed, False))


def met(mode, parts=(.3, .7, 1.4, 2., 3., 5.), seconds=120):
	"""All kinds of bodies at all speeds [cells a step], in one of *modes*."""
	scene, isSoil = modes[mode]
	runs = {}
	for kind in kinds:
		for cells in parts:
			with said():
				runs[f'{kind} {cells}'] = scene(kind, cells, isSoil, seconds / len(parts) / len(kinds))
	why = [course.why for *_, course in runs.values() if course.why]
	through = {name: behind for name, (behind, *_) in runs.items() if behind}
	told = dict(energy=max(most for _, most, _, _ in runs.values()), contactWork=max(gave for _, _, gave, _ in runs.values())) if mode == 'soilFlies' else {}
	told |= dict(failed=len(why), cuts=sum(c.cuts for *_, c in runs.values()))
	return dict(scenes=len(runs), behind=len(through), **told, iterations=sum(c.iterations for *_, c in runs.values()), first=', '.join(list(through)[:6]), why=reasons(why))
