# SPDX-License-Identifier: GPL-2.0-or-later
"""Features on cells of several sizes (MpmGrid.refinements): time steps and water; tests/core/stepping/test_refined_motion.cpp has waves across the sizes."""
import pytest

setting = '''
import json
import numpy as np
from math import inf
from yade import mpm, pack
def block(corner, size, refinement, young=2e7, poisson=0.25, density=2000, cellSize=0.5):
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=density, label='soil'))
	grid = MpmGrid(cellSize=cellSize, refinements=[refinement])
	O.bodies.append(mpm.fill(pack.inAlignedBox((*corner, -1), (corner[0] + size[0], corner[1] + size[1], 1)), grid, 2, 'soil'))
	return grid
def sides(width): return [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
'''


def test_a_body_flies_into_smaller_cells(yade):
	"""Its points are split on the way, to one a cell, for which the critical step is a fifth; momentum is exact, mass is kept, and a rigid flight stays one."""
	results = yade(setting + '''
found = []
for scheme in 'newmark', 'generalised-alpha', 'midpoint', 'explicit':
	grid = block((0, 0), (1, 1), MpmRefinement(min=(1.6, -inf, -inf), halvings=2))
	for b in O.bodies: b.state.vel = (4, 1, 0)
	solver = MpmDynamicEngine(grid=grid, scheme=scheme, gravity=(0, -10, 0), loadCurve=[(0, 1)], verbosity=0)
	O.engines, number = [solver], len(O.bodies)
	O.dt = 0.2 * solver.criticalTimeStep() if scheme == 'explicit' else 0.005
	O.run(int(0.3 / O.dt), wait=True)
	points = mpm.arrays()
	v = np.array([b.state.vel for b in O.bodies])
	found.append([len(O.bodies) - number, float(points['volume'].sum()), float(abs(v - [4, 1 - 10 * O.time, 0]).max()), float(abs(points['stress']).max())])
print(json.dumps(found))
''').result
	for split, volume, error, stress in results:
		assert split > 0 and abs(volume - 1) < 1e-12 and error < 1e-10 and stress < 1e-3, results


def test_a_column_stays_at_rest_in_time(yade):
	"""Under its initial stress, on cells of three sizes; energy balances where it then swings, too."""
	still, swung, imbalance, added = yade(setting + '''
grid = block((0, 0), (1, 3), MpmRefinement(max=(inf, 0.6, inf), halvings=2))
solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), loadCurve=[(0, 1)], boundaries=sides(1), newton=MpmNewton(tolerance=1e-12), verbosity=0)
O.engines, O.dt = [solver], 1e-3
mpm.geostatic()
O.run(10, wait=True)
still = max(b.state.vel.norm() for b in O.bodies)
for b in O.bodies: b.state.vel = (0, 0.1 * np.sin(np.pi * b.state.pos[1] / 6), 0)
added = 2000 * sum(v * b.state.vel.squaredNorm() / 2 for v, b in zip(mpm.arrays()['volume'], O.bodies))
O.run(50, wait=True)
print(json.dumps([still, max(b.state.vel.norm() for b in O.bodies), solver.plotData()['energyImbalance'], added]))
''').result
	assert still < 1e-9 and 1e-3 < swung < 0.2
	assert imbalance == pytest.approx(added, rel=0.01)


@pytest.mark.parametrize('water', ['level=level', 'pressure=lambda x: 1e4 * max(0, level - x[1])'])
def test_ground_under_water_is_at_rest(yade, water):
	"""On layers of cells of three sizes: a water table in large and in small cells and one above the soil; effective stresses and what floor and walls bear."""
	results = yade(setting + f'water = lambda level: MpmWater({water}, weight=1e4)' + '''
out = []
for level in 1, 3, 6:
	grid = block((0, 0), (2, 4), MpmRefinement(min=(-inf, 0.6, -inf), max=(inf, 1.4, inf), halvings=2))
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), loadCurve=[(0, 1)], boundaries=sides(2), newton=MpmNewton(tolerance=1e-12), verbosity=0, water=[water(level)])
	O.engines, O.dt = [solver], 1
	mpm.geostatic()
	O.step()
	points = mpm.arrays()
	p = 1e4 * np.maximum(0, level - points['pos0'][:, 1])
	total = 2e4 * (4 - points['pos0'][:, 1]) + 1e4 * max(0, level - 4)
	error = lambda found, expected: float(abs(found - expected).max() / 1e4)
	out.append([level, float(abs(points['pos'] - points['pos0']).max()), error(points['stress'][:, 1, 1], p - total), error(points['porePressure'], p), solver.reactions[2][1], solver.water[0].onBoundaries[0][0], solver.water[0].onBoundaries[2][1]])
print(json.dumps(out))
''').result
	for level, moved, effective, pressure, floor, onWall, onFloor in results:
		assert max(moved, effective, pressure) < 1e-10, results
		assert floor == pytest.approx(2 * (8e4 + 1e4 * max(0, level - 4)), rel=1e-9)
		assert onWall == pytest.approx(1e4 * (level**2 - max(0, level - 4)**2) / 2, rel=1e-9) and onFloor == pytest.approx(2e4 * level, rel=1e-9)


def test_a_body_as_heavy_as_water_floats(yade):
	"""Around a corner of small cells: nothing moves, and effective stress stays zero."""
	moved, stress, pressure = yade(setting + '''
grid = block((0, 0), (2, 2), MpmRefinement(min=(0.6, 0.6, -inf), max=(0.9, 0.9, inf), halvings=2), density=1000)
walls = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), loadCurve=[(0, 1)], boundaries=walls, newton=MpmNewton(tolerance=1e-12), verbosity=0, water=[MpmWater(level=6, weight=1e4)])
O.engines, O.dt = [solver], 1
O.step()
points = mpm.arrays()
print(json.dumps([float(abs(points['pos'] - points['pos0']).max()), float(abs(points['stress']).max() / 1e4), float(abs(points['porePressure'] / 1e4 - 6 + points['pos0'][:, 1]).max())]))
''').result
	assert max(moved, stress, pressure) < 1e-10


def test_a_body_sinks_through_the_sizes(yade):
	"""Deep in still water it falls freely by its submerged weight, and is not strained."""
	error, stress, split = yade(setting + '''
grid = block((0.2, 3.1), (1, 1), MpmRefinement(max=(inf, 1.9, inf), halvings=2), density=1500)
for b in O.bodies: b.state.vel = (0, -2, 0)
solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), water=[MpmWater(level=100, weight=1e4)], loadCurve=[(0, 1)], verbosity=0)
O.engines, O.dt, number = [solver], 0.01, len(O.bodies)
O.run(50, wait=True)
v = np.array([b.state.vel for b in O.bodies])
print(json.dumps([float(abs(v - [0, -2 - 500 / 1500 * 10 * O.time, 0]).max()), float(abs(mpm.arrays()['stress']).max()), len(O.bodies) - number]))
''').result
	assert error < 1e-5 and stress < 20 and split > 0
