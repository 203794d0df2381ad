# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's analyses as scenes, for scripts that run in YADE: `from scenes import slope`."""
from math import inf

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmElasticMat, MpmGhost, MpmGrid, MpmImplicitEngine, MpmNewton, MpmVonMisesMat, Omega

O = Omega()


def slope(cellSize=1.0, pointsPerCell=2, steps=None, **ghost):
	"""Section 4.2 of Coombs (2023); returns the engine. O.run(steps) applies the whole load."""
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=7.5e3, label='weak'))
	grid = MpmGrid(cellSize=cellSize)
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	O.bodies.append(mpm.fill(profile, grid, pointsPerCell=pointsPerCell, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid,
	                gravity=(0, -9.81, 0),
	                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')],
	                domains='stretch',
	                ghost=MpmGhost(**ghost),
	                newton=MpmNewton(predictor=False, reuseFactor=False),  # steps start from zero in the paper
	                label='solver'
	        )
	]
	O.dt = 1 / (steps or round(40 / cellSize))
	return O.engines[0]


def column(cells, dim=2, width=1, **ghost):
	"""Section 4.1, *width* cells wide and deep; returns the engine. O.run(40) applies the whole load."""
	h = 50 / cells
	O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soil'))
	grid = MpmGrid(cellSize=h, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (width * h, 50, width * h)), grid, pointsPerCell=2, material='soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width * h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width * h), fix='z')]
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid, gravity=(0, -10, 0), boundaries=sides, ghost=MpmGhost(**ghost), newton=MpmNewton(tolerance=1e-9, predictor=False, reuseFactor=False), label='solver'
	        )
	]
	O.dt = 1 / 40
	return O.engines[0]


def columnError():
	"""Error of the vertical stress, eq. 7."""
	points = mpm.arrays()
	return np.mean(np.abs(points['stress'][:, 1, 1] + 800 * (50 - points['pos0'][:, 1]))) / (800 * 50)


def block(offset, basis='gimp', factor=1e-2):
	"""Figure 2: a block of 2 x 1 cells and eight points, moved by *offset* along x; returns the engine."""
	O.materials.append(MpmElasticMat(young=1, poisson=0, density=1, label='block'))
	grid = MpmGrid(cellSize=1)
	bodies = mpm.fill(pack.inAlignedBox((0, 0, -1), (2, 1, 1)), grid, pointsPerCell=2, material='block')
	for body in bodies:
		body.state.pos += (offset, 0, 0)
	O.bodies.append(bodies)
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid,
	                basis=basis,
	                boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(2, 0, -inf), max=(2, 0, inf), fix='x')],
	                ghost=MpmGhost(factor=factor)
	        )
	]
	O.dt = 1
	return O.engines[0]


def againstCsv(path):
	"""Largest differences between the material points and a reference file: position [m], and stress over the largest stress."""
	points = mpm.arrays()
	reference = np.genfromtxt(path, delimiter=',', names=True)
	place = {tuple(np.round(p, 6)): i for i, p in enumerate(points['pos0'][:, :2])}
	rows = [place[tuple(np.round((x, y), 6))] for x, y in zip(reference['x0'], reference['y0'])]
	assert sorted(rows) == list(range(len(place)))
	position = np.column_stack([reference['x'], reference['y']])
	stress = np.column_stack([reference[k] for k in ('sxx', 'syy', 'szz', 'sxy')])
	ours = points['stress'][rows][:, [0, 1, 2, 0], [0, 1, 2, 1]]
	return np.abs(points['pos'][rows][:, :2] - position).max(), np.abs(ours - stress).max() / np.abs(stress).max()
