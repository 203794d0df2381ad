# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of sand that are let go, and how they come to rest; of runout.py and profiles.py."""
import os
import sys
from math import inf, radians

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmDynamicEngine, MpmGrid, MpmMohrCoulombMat, MpmNewton, Omega
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'scripts', 'lib'))
from deposits import front

O = Omega()
L, g, density = 1., 10., 1600.
frames = 0, 0.8, 1.4, 2, 3  # times of the pictures over sqrt(height / g); and one at rest
atRest = 2e-3  # kinetic energy over the work of gravity so far


def makeSand(height, options):
	"""The column, a scene of its own; returns the engine. Options are those of runout.py; *law* there has the angles of another law [rad]."""
	O.reset()
	law = getattr(options, 'law', None) or dict(frictionAngle=np.arcsin(np.tan(radians(options.repose))), dilationAngle=0)
	O.materials.append(MpmMohrCoulombMat(young=500 * density * g * L, poisson=0.3, density=density, cohesion=1e-3 * density * g * L, label='sand', **law))
	grid = MpmGrid(cellSize=min(L, height) / options.cells)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (L, height, 1)), grid, options.pointsPerCell, 'sand'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -g, 0), boundaries=sides, newton=MpmNewton(minStep=1 / 256), maxSplits=options.maxSplits, verbosity=0)]
	O.dt = options.courant * grid.cellSize / np.sqrt(2 * g * height)
	return O.engines[0]


def outline(pos, area, width):
	"""Depth of matter at pos (N, 2), of an area each [m2], by strips of a width [m]: middles of the strips, depths (S,)."""
	strips = np.floor(pos[:, 0] / width).astype(int)
	return (np.arange(strips.max() + 2) + 0.5) * width, np.bincount(strips, np.broadcast_to(area, strips.shape), strips.max() + 2) / width


def run(height, advance, state, end):
	"""Motion to rest. advance() goes on a little, state() gives positions (N, 2), speeds (N,), areas (N,) [m2] and energies [J]: kinetic, work of gravity, and others. end: the latest time, over sqrt(height / g).

	:return: rows of time, front and energies, over sqrt(height / g), L and the first potential energy; list of (time, positions, speeds, areas)
	"""
	begin, duration, history, film = O.time, np.sqrt(height / g), [], []
	while True:
		t = (O.time - begin) / duration
		pos, speed, area, *energies = state()
		kinetic, work = energies[:2]
		history.append((t, front(pos[:, 0], area, min(L, height), L) / L, *energies))
		resting = t > 2 and kinetic < atRest * work or t >= end
		if len(film) < len(frames) and t >= frames[len(film)] or resting: film.append((t, pos, speed, area))
		if resting: return np.array(history) / (1, 1, *[density * g * film[0][3] @ film[0][1][:, 1]] * len(energies)), film
		advance()


def runSand(height, options):
	"""See run; and counts of what it took."""
	solver = makeSand(height, options)
	counts = dict(points=len(mpm.arrays()['id']), steps=0, iterations=0, most=0, cuts=0)
	def advance():
		O.step()
		counts['steps'] += 1
		counts['iterations'] += solver.iterations
		counts['most'] = max(counts['most'], solver.iterations)
		counts['cuts'] += solver.cuts

	def state():
		points, data = mpm.arrays(), solver.plotData()
		energies = [data[name] for name in ('kineticEnergy', 'loadWork', 'plasticWork', 'elasticEnergy', 'ghostWork', 'impactWork', 'gridWork', 'energyImbalance')]
		return points['pos'][:, :2], np.linalg.norm(points['velocity'], axis=1), points['volume'] / np.linalg.det(points['defGrad']), *energies

	return *run(height, advance, state, options.end), counts
