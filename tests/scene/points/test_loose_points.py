# SPDX-License-Identifier: GPL-2.0-or-later
"""Points that fly off by themselves, as at the front of a slide."""
import pytest


@pytest.mark.parametrize('massFactor', [1e-3, 0.25])
@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_few_points_fall(yade, number, massFactor):
	"""Points of a cell that has no neighbours: no ghost face makes up for what is missing in the mass of its nodes."""
	yade(
	        f'''
from yade import mpm
import numpy as np
O.materials.append(MpmElasticMat(young=1e6, poisson=0.3, density=1000, label='soil'))
for x, y in [(0.2, 0.2), (0.6, 0.2), (0.2, 0.6), (0.6, 0.6)][:{number}]:
	O.bodies.append(mpm.fill(pack.inAlignedBox((x, y, 0), (x + 0.2, y + 0.2, 1)), MpmGrid(cellSize=0.2), 1, 'soil'))
O.engines = [MpmDynamicEngine(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), ghost=MpmGhost(massFactor={massFactor}), verbosity=0)]
O.dt = 0.01
for step in range(30): O.step()
points = mpm.arrays()
assert len(points['id']) == {number}
assert np.abs(points['pos'] - points['pos0'] - (0, -0.45, 0)).max() < 1e-9
'''
	)


@pytest.mark.parametrize('number', [1, 2, 3])
def test_few_points_fall_in_explicit_steps(yade, number):
	"""Beside a body, whose ghost faces make the mass a consistent one: what the points do not see of their nodes stays stable."""
	yade(
	        f'''
from yade import mpm
import numpy as np
O.materials.append(MpmElasticMat(young=1e6, poisson=0.3, density=1000, label='soil'))
for x, y in [(0.2, 0.2), (0.6, 0.2), (0.2, 0.6)][:{number}]:
	O.bodies.append(mpm.fill(pack.inAlignedBox((x, y, 0), (x + 0.2, y + 0.2, 1)), MpmGrid(cellSize=0.2), 1, 'soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(pack.inAlignedBox((5, 0, 0), (8, 3, 1)), grid, 2, 'soil'))
O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), scheme='explicit', verbosity=0, label='solver')]
mpm.assign(velocity=np.random.default_rng(1).normal(0, 1e-3, (len(mpm.arrays()['id']), 3)) * (1, 1, 0))  # something to grow
O.dt = 0.9 * solver.criticalTimeStep()
O.run(600, wait=True)
points = mpm.arrays()
fallen = points['pos'] - points['pos0']
assert np.abs(fallen - (0, -5 * O.time**2, 0)).max() < 5e-3 * O.time, (O.time, fallen[:5])
assert np.abs(points['stress']).max() < 5e3
'''
	)
