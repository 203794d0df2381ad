# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces and moments in sections of a body of points, against statics."""


def test_a_cantilever_under_its_weight(yade):
	"""Four cells deep: what cells that shear take up of the bending is missing in the stresses."""
	found = yade('''
import json
from yade import mpm, pack
O.materials.append(MpmElasticMat(young=1e8, poisson=0, density=2000, label='beam'))
grid = MpmGrid(cellSize=0.125)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (4, 0.5, 1)), grid, 2, 'beam', body='beam'))
O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='xy')], newton=MpmNewton(tolerance=1e-9), verbosity=0)]
O.dt = 1
O.run(1, wait=True)
ratios = []
for x in 0.5, 1, 1.5, 2:
	section, length = mpm.sectionForces('beam', ((x, 0), (1, 0))), 4 - x
	ratios.append([section['Q'] / (-1e4 * length), section['M'] / (1e4 * length**2 / 2), section['area'] / 0.5])
print(json.dumps(ratios))
''').result
	for shear, moment, area in found:
		assert abs(shear - 1) < 0.06 and abs(moment - 1) < 0.025 and abs(area - 1) < 0.01
