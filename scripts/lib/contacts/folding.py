# SPDX-License-Identifier: GPL-2.0-or-later
"""A body of points that folds: its sides meet as two bodies do, and part again."""
from math import inf

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBodyContact, MpmBoundary, MpmDynamicEngine, MpmElasticMat, MpmGrid, MpmNewton, Omega

from .course import Course

O = Omega()


def _fill(regions, dim, speed, bottom):
	"""Bodies by name, with legs that fly at each other, faster upwards from a height on: solver, contact, and the points of the left leg and of the tops."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e5, poisson=.3, density=1000, label='soil'))
	grid, x = MpmGrid(cellSize=.1, dim=dim), [p[0] for _, points in regions for p in points]
	for name, points in regions:
		region = mpm.polygon(points)
		if dim == 3: region = region & pack.inAlignedBox((min(x), 0, 0), (max(x), 2, .2))
		O.bodies.append(mpm.fill(region, grid, 2, 'soil', body=name))
	contact = MpmBodyContact(between=(regions[0][0], regions[-1][0]), friction=.2, folds=len(regions) == 1)
	solver = MpmDynamicEngine(grid=grid, contacts=[contact], newton=MpmNewton(tolerance=1e-10), verbosity=0)
	begin, velocity = mpm.arrays()['pos'], np.zeros((len(O.bodies), 3))
	left, height = begin[:, 0] < (min(x) + max(x)) / 2, (begin[:, 1] - bottom) / (begin[:, 1].max() - bottom)
	velocity[:, 0] = np.where(left, speed, -speed) * np.clip(height, 0, 1)
	mpm.assign(velocity=velocity)
	O.engines, O.dt = [solver], .01
	return solver, contact, left, height > .75


def legs(dim=2, steps=40, seconds=200):
	"""Largest force between two legs on a base that is held, of one body over that of two bodies, and the largest difference of the ways of their tops over the largest way, until they are far apart again."""
	one = [('soil', [(0, 0), (.8, 0), (.8, 1.1), (.5, 1.1), (.5, .2), (.3, .2), (.3, 1.1), (0, 1.1)])]
	two = [('right', [(.5, 0), (.8, 0), (.8, 1.1), (.5, 1.1)]), ('left', [(0, 0), (.3, 0), (.3, 1.1), (0, 1.1)])]
	forces, ways, why = [], [], []
	for regions in one, two:
		solver, contact, left, top = _fill(regions, dim, 1.5, .2)
		solver.boundaries = [MpmBoundary(max=(inf, .2, inf), fix='xyz'[:dim])]
		begin, force, way, course = mpm.arrays()['pos'][:, 0], [], [], Course(solver, seconds / 2)

		def look():
			moved = mpm.arrays()['pos'][:, 0] - begin
			force.append(abs(contact.force[0])), way.append([moved[left & top].mean(), moved[~left & top].mean()])

		course.run(steps, look)
		forces.append(force), ways.append(way), why.append(course.why)
	if any(why): return dict(why=' '.join(why))
	ours, theirs = np.array(ways)
	return dict(force=max(forces[0]) / max(forces[1]), off=abs(ours - theirs).max() / abs(theirs).max(), why='')


def free(steps=80, offset=.03, seconds=200):
	"""A free U: momentum that is lost over that of a leg, energy that is won over the first, the narrowest and the last gap in cells, and the largest force."""
	x = np.array([0, .9, .9, .6, .6, .3, .3, 0]) + offset
	solver, contact, left, top = _fill([('soil', list(zip(x, [0, 0, 1.5, 1.5, .3, .3, 1.5, 1.5])))], 2, 1.5, .3)
	first, rows, course = 1000 * mpm.arrays()['volume'][left] @ mpm.arrays()['velocity'][left, 0], [], Course(solver, seconds)

	def look():
		data, at = solver.plotData(), mpm.arrays()['pos'][:, 0]
		rows.append([max(abs(data['momentum_x']), abs(data['momentum_y'])) / first, data['kineticEnergy'] + data['elasticEnergy'], (at[~left & top].min() - at[left & top].max()) / .1, abs(contact.force[0])])

	course.run(steps, look)
	momentum, energy, gap, force = np.array(rows).T
	return dict(momentum=momentum.max(), gain=max(0, np.diff(energy).max()) / energy[0], narrowest=gap.min(), last=gap[-1], force=force.max()) | course.told()
