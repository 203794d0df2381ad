# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of Coombs (2023) and the tables of results that the scripts of this folder fill, one script for each figure and table."""
import argparse
import os
import sys
from math import inf

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmElasticMat, MpmGhost, MpmGrid, MpmImplicitEngine, MpmNewton, Omega

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'scripts', 'lib'))
from results import Results
from slopes import weakLayerSlope

O = Omega()


def commandLine(what):
	"""Command line of a script: folder for the results, and whether a smaller part will do."""
	parser = argparse.ArgumentParser(description=what)
	parser.add_argument('--out', default='out/paper', help='folder of the results; what a table in it already holds is not run again (default %(default)s)')
	parser.add_argument('--quick', action='store_true', help='only a part that runs within seconds')
	return parser.parse_args()


def block(offset, basis='gimp', cellSize=1., **ghost):
	"""Figure 2: a block of 2 x 1 cells and eight points, moved by *offset* [cells] along x; returns the engine."""
	O.reset()
	h = cellSize
	O.materials.append(MpmElasticMat(young=1, poisson=0, density=1, label='block'))
	grid = MpmGrid(cellSize=h)
	bodies = mpm.fill(pack.inAlignedBox((0, 0, -1), (2 * h, h, 1)), grid, pointsPerCell=2, material='block')
	for body in bodies:
		body.state.pos += (offset * h, 0, 0)
	O.bodies.append(bodies)
	rollers = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(2 * h, 0, -inf), max=(2 * h, 0, inf), fix='x')]
	O.engines = [MpmImplicitEngine(grid=grid, basis=basis, boundaries=rollers, ghost=MpmGhost(**ghost))]
	return O.engines[0]


def column(cells, pointsPerCell=2, steps=40, height=50., **ghost):
	"""Section 4.1: elastic column of E = 10 kPa that its own weight b = 4 E / height compresses to half its height; returns the engine."""
	O.reset()
	h = height / cells
	O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=4e4 / height / 10, label='soil'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (h, height, 1)), grid, pointsPerCell=pointsPerCell, material='soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides, ghost=MpmGhost(**ghost), newton=MpmNewton(tolerance=1e-9, predictor=False, reuseFactor=False))]
	O.dt = 1 / steps
	return O.engines[0]


def columnError(height=50.):
	"""Error of the vertical stress, eq. 7; all points have the same initial volume."""
	points = mpm.arrays()
	return np.mean(np.abs(points['stress'][:, 1, 1] / 4e4 + 1 - points['pos0'][:, 1] / height))


def slope(cellSize, pointsPerCell, lineSearchTrials=0, **ghost):
	"""Section 4.2: slope with a weak layer, as in the paper without cutting of load steps; returns the engine and the number of load steps."""
	O.reset()
	grid, sides = weakLayerSlope(cellSize, pointsPerCell)
	newton = MpmNewton(tolerance=1e-6, maxIterations=20, minStep=1, lineSearchTrials=lineSearchTrials, predictor=False, reuseFactor=False)
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, domains='stretch', ghost=MpmGhost(**ghost), newton=newton)]
	steps = round(40 / cellSize)
	O.dt = 1 / steps
	return O.engines[0], steps


def runSteps(steps, after=lambda: None):
	"""Run load steps and call *after* when each has converged; returns the reason why a step failed, or ''."""
	for step in range(steps):
		try:
			O.step()
		except RuntimeError as error:
			return ' '.join(str(error).partition(' failed: ')[2].partition('. ')[0].split()) or str(error)
		after()
	return ''
