# SPDX-License-Identifier: GPL-2.0-or-later
"""Points that fly off by themselves, as at the front of a slide."""
import pytest


@pytest.mark.parametrize('massFactor', [1e-3, 0.25])
@pytest.mark.parametrize('number', [1, 2, 3, 4])
def test_few_points_fall(yade, number, massFactor):
	"""Of a cell that has no neighbours: no ghost face makes up for what is missing in the mass of its nodes."""
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
