# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: the scenes by the plugin, large strains, one material point along each half of a cell. Steps by O.step, as O.run(1, wait=True) waits for 40 ms."""
import time
from math import inf

import numpy as np
from yade import mpm
from yade.wrapper import (MpmBeam, MpmBoundary, MpmDrain, MpmElasticMat, MpmFlow, MpmGrid, MpmImplicitEngine, MpmTraction, MpmVonMisesMat, Omega)

from .scenes import Beam, Cavity, Consolidation, Embankment, Footing

O = Omega()


def rectangle(x0, y0, x1, y1):
	return mpm.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def between(left, right, base, fixed='xy'):
	"""Smooth sides and a base."""
	return [MpmBoundary(max=(left, inf, inf), fix='x'), MpmBoundary(min=(right, -inf, -inf), fix='x'), MpmBoundary(max=(inf, base, inf), fix=fixed)]


def start(materials, h):
	O.reset()
	O.materials.append(materials)
	return MpmGrid(cellSize=h)


def engine(steps, **settings):
	solver = MpmImplicitEngine(verbosity=0, **settings)
	O.engines, O.dt = [solver], 1 / steps
	return solver


def clay(scene):
	return MpmVonMisesMat(young=scene.young, poisson=scene.poisson, density=1, yieldStress=np.sqrt(2) * scene.strength, label='soil')


def elastic(scene, **more):
	return MpmElasticMat(**(dict(young=scene.young, poisson=scene.poisson, density=1, label='soil') | more))


def footing(size, fBar):
	s = Footing(size)
	grid = start(clay(s), s.h)
	wide, deep = s.columns * s.h, s.rows * s.h
	O.bodies.append(mpm.fill(rectangle(0, -deep, wide, 0), grid, 2, 'soil'))
	strip = MpmBoundary(min=(-inf, 0, -inf), max=(s.width / 2, 0, inf), fix='xy', displacement=(0, -s.settlement, 0))
	solver, loads = engine(s.steps, grid=grid, fBar=fBar, boundaries=[*between(0, wide, -deep), strip]), []
	for _ in range(s.steps):
		O.step()
		loads.append(-solver.reactions[3][1])
	return max(loads) / (s.width / 2) / s.strength, solver


def arc(radius, begin, end):
	return [(radius * np.cos(angle), radius * np.sin(angle)) for angle in np.linspace(begin, end, 101)]


def cavity(size, fBar):
	s = Cavity(size)
	grid = start(clay(s), s.h)
	wall = arc(s.inner, np.pi / 2, 0)
	O.bodies.append(mpm.fill(mpm.polygon(wall + arc(s.outer, 0, np.pi / 2)), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	solver = engine(s.steps, grid=grid, fBar=fBar, boundaries=sides, loads=[MpmTraction(surface=wall, pressure=s.pressure)])
	for _ in range(s.steps): O.step()
	surface = solver.loads[0].surface
	return 1e3 * (np.linalg.norm(surface.vertices, axis=1) - np.linalg.norm(surface.initialVertices, axis=1)).mean() / s.inner, solver


def consolidation(size, fBar):
	s = Consolidation(size)
	grid = start(MpmElasticMat(young=s.young, poisson=0, density=2000, conductivity=s.mobility * 9810, porosity=0.5, label='soil'), s.h)
	O.bodies.append(mpm.fill(rectangle(0, 0, s.h, 1), grid, 2, 'soil'))
	top = [(s.h, 1), (0, 1)]
	solver = engine(
	        1, grid=grid, fBar=fBar, boundaries=between(0, s.h, 0), loads=[MpmTraction(surface=top, traction=(0, -s.load, 0))], loadCurve=[(0, 1), (1, 1)],
	        flow=MpmFlow(drains=[MpmDrain(surface=top)]))
	for duration in np.diff(s.times, prepend=0):
		O.dt = duration
		O.step()
	return (1 - solver.flow.drains[0].surface.vertices[0][1]) * s.young / s.load, solver


def beam(size, fBar):
	"""The beam has a weight, which keeps it on the ground: it cannot pull at it."""
	s = Beam(size)
	grid = start(elastic(s), s.h)
	O.bodies.append(mpm.fill(rectangle(0, -s.depth, s.length, 0), grid, 2, 'soil'))
	line = MpmBeam(line=[(0, 0), (s.length, 0)], axialStiffness=s.axial, bendingStiffness=s.bending, weight=5e3, fixHead='xr', fixFoot='xr', headForce=(0, -s.force / 2, 0))
	solver = engine(1, grid=grid, fBar=fBar, boundaries=between(0, s.length, -s.depth), loads=[line], gravity=(0, -1, 0), gravityCurve=[(0, 1)], loadCurve=[(1, 0), (2, 1)])
	bent = lambda: 1e3 * (line.vertices[-1][1] - line.vertices[0][1])
	O.step()
	first = bent()
	O.step()
	return bent() - first, solver


def embankment(size, fBar):
	s = Embankment(size)
	grid = start([elastic(s), elastic(s, density=s.weight, label='fill')], s.h)
	O.bodies.append(mpm.fill(rectangle(0, -s.depth, s.width, 0), grid, 2, 'soil'))
	solver = engine(1, grid=grid, fBar=fBar, boundaries=between(0, s.width, -s.depth), gravity=(0, -1, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)])
	O.materials['soil'].density = 1e-6 * s.weight
	for lift in range(s.lifts):
		low, high = lift * s.lift, (lift + 1) * s.lift
		mpm.stages.place(mpm.fill(mpm.polygon([(0, low), (s.toe(lift), low), (s.toe(lift + 1), high), (0, high)]), grid, 2, 'fill'), steps=1)
		O.step()
	points = mpm.arrays()
	x, y = points['pos0'][:, 0], points['pos0'][:, 1]
	row = lambda depth: (points['pos0'] - points['pos'])[(x < s.crest) & (abs(y + depth * s.h) < 0.1 * s.h), 1].mean()
	return 1e3 * (1.5 * row(0.25) - 0.5 * row(0.75)), solver


def run(scene, size, fBar):
	"""Value, unknowns and seconds of a scene."""
	begin = time.time()
	value, solver = globals()[scene](size, fBar)
	return dict(value=value, unknowns=solver.dofs, seconds=time.time() - begin)


def best(scene, size, fBar, repeats):
	"""The fastest of some runs."""
	return min((run(scene, size, fBar) for _ in range(repeats)), key=lambda found: found['seconds'])
