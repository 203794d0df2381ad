# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope with a weak layer (Coombs 2023, section 4.2), for studies that run in YADE."""
from math import inf

from yade import mpm
from yade.wrapper import MpmBoundary, MpmGrid, MpmVonMisesMat, Omega


def weakLayerSlope(cellSize, pointsPerCell):
	"""Fill the scene with it.

	:return: grid and boundaries, for an engine with gravity (0, -9.81, 0)
	"""
	O = Omega()
	for label, strength in ('soil', 15e3), ('weak', 7.5e3):
		O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=strength, label=label))
	grid = MpmGrid(cellSize=cellSize)
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	O.bodies.append(mpm.fill(profile, grid, pointsPerCell=pointsPerCell, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	return grid, [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
