# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: the set-ups of AMPLE GS by the plugin, step by step. SI units."""
from math import inf

import numpy as np
from yade import mpm
from yade.wrapper import MpmBoundary, MpmElasticMat, MpmGhost, MpmGrid, MpmImplicitEngine, MpmNewton, MpmVonMisesMat, Omega

O = Omega()

# Body (corners, points per cell and axis), cells, gravity, steps, and gamma_k over Young's modulus; 'mpm' has points without domains.
column = dict(body=(0, 0, 3.125, 50), points=2, h=3.125, gravity=10, steps=40, ghost=1, basis='mpm')
beam = dict(body=(0, 9, 10, 10), points=3, h=0.25, gravity=0, steps=50, ghost=1, basis='gimp')
collapse = dict(body=(0, 0, 8, 8), points=6, h=1, gravity=10, steps=40, ghost=0.01, basis='gimp')
materials = dict(
        column=lambda: MpmElasticMat(young=1e4, poisson=0, density=80, label='body'),
        beam=lambda: MpmElasticMat(young=12e6, poisson=0.2, density=1, label='body'),
        collapse=lambda: MpmVonMisesMat(young=1e6, poisson=0.3, density=1000, yieldStress=20e3, label='body'))
left, base = dict(max=(0, inf, inf), fix='x'), dict(max=(inf, 0, inf), fix='y')
sides = dict(column=[left, dict(min=(3.125, -inf, -inf), fix='x'), base], beam=[left, dict(min=(-inf, 9.5, -inf), max=(0, 9.5, inf), fix='y')], collapse=[left, base])
scenes = dict(column=column, beam=beam, collapse=collapse)


def sameAs(scene, tolerance):
	"""Settings that give AMPLE's method: domains by the stretch, its scaling of the stabilisation, and full Newton steps from no displacement."""
	newton = MpmNewton(tolerance=tolerance, minStep=1, lineSearchTrials=0, predictor=False, reuseFactor=False)
	return dict(basis=scene['basis'], domains='stretch', ghost=MpmGhost(factor=scene['ghost'], scaling='paper'), newton=newton)


def run(name, tolerance, file):
	"""Keeps positions and stresses (xx, yy, zz, xy) of all points at the start and after each step; a tolerance of 0 stands for the plugin's defaults. Returns the number of solves."""
	scene = scenes[name]
	O.reset()
	O.materials.append(materials[name]())
	grid = MpmGrid(cellSize=scene['h'])
	x0, y0, x1, y1 = scene['body']
	O.bodies.append(mpm.fill(mpm.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), grid, scene['points'], 'body'))
	if name == 'beam':
		halfPoint = scene['h'] / 2 / scene['points']
		for body in O.bodies:
			x, y, _ = body.state.pos
			if np.allclose((x, abs(y - 9.5)), (10 - halfPoint, halfPoint)): body.state.force = (0, -50e3, 0)
	settings = sameAs(scene, tolerance) if tolerance else {}
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -scene['gravity'], 0), boundaries=[MpmBoundary(**side) for side in sides[name]], verbosity=0, **settings)
	O.engines, O.dt = [solver], 1 / scene['steps']
	states, solves = [mpm.arrays()], 0
	for _ in range(scene['steps']):
		O.step()
		solves += solver.iterations
		states.append(mpm.arrays())
	stress = np.array([state['stress'] for state in states])
	np.savez_compressed(file, positions=np.array([state['pos'][:, :2] for state in states]), stresses=np.stack([stress[..., i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1))], -1))
	return dict(solves=solves)
