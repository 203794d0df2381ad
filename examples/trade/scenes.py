# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes whose speed and accuracy scripts/trade measures. All parameters come from YADE's parameter table; `scene` chooses:

	column      elastic column under its own weight that shrinks to half its height (Coombs 2023, section 4.1); exact: stress and height
	slope       elasto-plastic slope with a weak layer (Coombs 2023, section 4.2): settlement of the crest (10, 12), run-out of the toe (15, 7)
	collapse    block of soil, 4 m high and 8 m wide (one half is computed), too heavy for its strength: mean run-out and
	            settlement of all points (those at its corners depend on the grid: strains localise there)
	cantilever  elastic beam of 10 x 1 m that bends by 70 degrees under its own weight: displacement of its tip

`cells` counts the cells over the height of the column, 1 m of the others. One 2D run: `scripts/run examples/trade/scenes.py`.
"""
import os
import resource
import sys
import time
from math import inf

import numpy as np
from yade import mpm

readParamsFromTable(noTableOk=True, scene='column', dim=2, cells=16, pointsPerCell=2, steps=40, tolerance=1e-6, basis='gimp', ghostFactor=1e-2,
                    scaling='mesh-independent', predictor=True, advise=False)
from yade.params import table
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'scripts', 'lib'))
from slopes import weakLayerSlope

rollers = {'left': MpmBoundary(max=(0, inf, inf), fix='x'), 'floor': MpmBoundary(max=(inf, 0, inf), fix='y'), 'base': MpmBoundary(max=(inf, 0, inf), fix='xy'),
           'clamp': MpmBoundary(max=(0, inf, inf), fix='xy')}
solves, advised, found = [], {}, {} # estimates of mpm.advise for the run, and the measured values


def peakMemory():
	return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def analyse(grid, boundaries, gravity):
	"""Apply gravity in equal steps."""
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid, basis=table.basis, gravity=(0, -gravity, 0), boundaries=boundaries, ghost=MpmGhost(factor=table.ghostFactor, scaling=table.scaling),
	                newton=MpmNewton(tolerance=table.tolerance, predictor=table.predictor, reuseFactor=False), label='solver'),
	        PyRunner(iterPeriod=1, initRun=True, command='solves.append(solver.iterations)'),
	]
	O.dt = 1 / table.steps
	memory = peakMemory()
	if table.advise: advised.update(mpm.advise(solver))
	begin = time.process_time()
	O.run(table.steps, wait=True)
	found.update(secondsPerStep=(time.process_time() - begin) / table.steps, memory=peakMemory() - memory)


def displacementAt(place, radius=1.5):
	"""Displacement [m] of a place of the initial configuration: linear fit to that of the points around it, so that the lattice of points does not matter."""
	points = mpm.arrays()
	away = (points['pos0'][:, :2] - place) / radius
	near = (away**2).sum(axis=1) < 1
	fit = np.column_stack([np.ones(near.sum()), away[near]])
	return np.linalg.lstsq(fit, (points['pos'] - points['pos0'])[near, :2], rcond=None)[0][0]


if table.scene == 'column':
	l0, E, b = 50., 1e4, 800.
	h = l0 / table.cells
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=b / 10, label='soil'))
	grid = MpmGrid(cellSize=h, dim=table.dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (h, l0, h)), grid, table.pointsPerCell, 'soil'))
	sides = [rollers['left'], rollers['floor'], MpmBoundary(min=(h, -inf, -inf), fix='x')]
	if table.dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, h), fix='z')]
	analyse(grid, sides, 10)
	points = mpm.arrays()
	stressError = np.mean(np.abs(points['stress'][:, 1, 1] + b * (l0 - points['pos0'][:, 1]))) / (b * l0) # eq. 7
	height = (points['pos'] + points['halfSize'])[:, 1].max()
elif table.scene == 'slope':
	analyse(*weakLayerSlope(1 / table.cells, table.pointsPerCell), 9.81)
	crest, toe = -displacementAt((10, 12))[1], displacementAt((15, 7))[0]
elif table.scene == 'collapse':
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
	grid = MpmGrid(cellSize=1 / table.cells)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (4, 4, 1)), grid, table.pointsPerCell, 'soil'))
	analyse(grid, [rollers['left'], rollers['base']], 9.81)
	points = mpm.arrays()
	spread, settlement = np.mean(points['pos'] - points['pos0'], axis=0)[:2] * (1, -1)
elif table.scene == 'cantilever':
	O.materials.append(MpmElasticMat(young=12e6, poisson=0.3, density=1e3, label='beam'))
	grid = MpmGrid(cellSize=1 / table.cells)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (10, 1, 1)), grid, table.pointsPerCell, 'beam'))
	analyse(grid, [rollers['clamp']], 12)
	tipX, tipY = displacementAt((10, .5), radius=1)
else:
	raise ValueError(f'scene = {table.scene!r} is not one of column, slope, collapse, cantilever')
if table.advise:
	fastest, usual, slowest, estimatedMemory = (advised[name] for name in ('fastest', 'secondsPerStep', 'slowest', 'memory'))
	unknowns, measuredTime, measuredMemory = advised['dofs'], found['secondsPerStep'], found['memory']
