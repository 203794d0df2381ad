# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes whose stress is known everywhere: the scripts of other examples. For discretisation.py, and page.py, which needs no YADE."""
from dataclasses import dataclass
from typing import Callable

import numpy as np


@dataclass
class Scene:
	"""A scene for several sizes of the cells.

	:param what: the scene, in words
	:param against: where the stress is from
	:param cells: numbers of cells over a length
	:param run: function of ``script(path, **options)`` and the number of cells; returns the exact stress (N, 3, 3) [Pa] of the points, NaN where it is not compared
	"""
	what: str
	against: str
	cells: list
	run: Callable


def tensors(xx, yy, zz, xy=0):
	"""(N, 3, 3) of components (N,)."""
	found = np.zeros((len(xx), 3, 3))
	found[:, 0, 0], found[:, 1, 1], found[:, 2, 2] = xx, yy, zz
	found[:, 0, 1] = found[:, 1, 0] = xy
	return found


def column(pointsPerCell, dim=2):
	def run(script, cells):
		found = script('column/column.py', cells=cells, pointsPerCell=pointsPerCell, dim=dim)
		zero = 0 * found['depth']
		return tensors(zero, -found['b'] * found['depth'], zero)

	return run


def walls(**more):
	def run(script, cells):
		found = script('walls/walls.py', cells=cells, **more)
		axis = np.append(found['axis'], 0)
		return found['exact'][:, None, None] * np.outer(axis, axis)

	return run


def lame(r, pressure):
	"""Radial and hoop stress of a tube of inner radius 1 and outer radius 2."""
	return pressure / 3 * (1 - 4 / r**2), pressure / 3 * (1 + 4 / r**2)


def tube(pointsPerCell):
	def run(script, cells):
		found = script('surface_loads/tube.py', cells=cells, pointsPerCell=pointsPerCell)
		x, y = found['mpm'].arrays()['pos0'][:, :2].T
		r2 = x**2 + y**2
		radial, hoop = lame(np.sqrt(r2), found['p'])
		return tensors((radial * x**2 + hoop * y**2) / r2, (radial * y**2 + hoop * x**2) / r2, 0.3 * (radial + hoop), (radial - hoop) * x * y / r2)

	return run


def rings(script, cells):
	"""Rings with so many cells over the inner radius; the script itself runs a footing."""
	return script('axisymmetric/axisymmetric.py', scene='rough', cells=4, steps=1, settlement=1e-4, tubeCells=cells)


def ring(script, cells):
	found = rings(script, cells)
	found['elasticTube']()
	radial, hoop = lame(found['mpm'].arrays()['pos0'][:, 0], 1e3)
	return tensors(radial, 0.3 * (radial + hoop), hoop)


def plasticRing(fBar):
	"""Tresca, plastic up to the radius 1.5: the pressure is that there and c_u 2 ln 1.5."""
	def run(script, cells):
		found, c = rings(script, cells), 1.5
		cu, edge = found['cu'], 1 - c**2 / 4
		found['tube'](found['MpmTrescaMat'](young=1e4 * cu, poisson=0.3, density=2000, undrainedStrength=cu, label='tube'), (2 * np.log(c) + edge) * cu, 10, fBar=fBar)
		found['O'].run(10, wait=True)
		r = found['mpm'].arrays()['pos0'][:, 0]
		radial, hoop = lame(r, 0.75 * c**2 * cu)
		radial = np.where(r < c, (2 * np.log(r / c) - edge) * cu, radial)
		hoop = np.where(r < c, radial + 2 * cu, hoop)
		return tensors(radial, 0.3 * (radial + hoop), hoop)

	return run


def strip(script, cells):
	"""Stresses of a half space; the block is 20 times as wide as half of the strip, and is compared near it."""
	found = script('surface_loads/surface_loads.py', cells=cells)
	x, z = found['x'], found['z']
	s, e = np.arctan2(x - found['b'], z), np.arctan2(x + found['b'], z)
	mean, deviator = (e - s) * found['q'] / np.pi, np.sin(e - s) * found['q'] / np.pi
	mean[np.hypot(x, z) > 4 * found['b']] = np.nan
	xx, yy = -mean + deviator * np.cos(s + e), -mean - deviator * np.cos(s + e)
	return tensors(xx, yy, found['nu'] * (xx + yy), deviator * np.sin(s + e))


scenes = {
        'column': Scene('elastic column, 2 points per cell and axis', 'closed form', [8, 16, 32, 64], column(2)),
        'column1': Scene('the same, 1 point', 'closed form', [8, 16, 32, 64], column(1)),
        'column3': Scene('the same, 3 points', 'closed form', [8, 16, 32, 64], column(3)),
        'column3D': Scene('the same in 3D, 2 points', 'closed form', [8, 16, 32], column(2, 3)),
        'askew': Scene('column askew, rows of points along its walls', 'closed form', [8, 16, 32], walls()),
        'askewStairs': Scene('the same, rows of points along the grid', 'closed form', [8, 16, 32], walls(pattern='grid')),
        'lid': Scene('column askew under a lid', 'closed form', [8, 16, 32], walls(load='lid')),
        'tube': Scene('thick tube, cut by the grid', 'Lame', [8, 16, 32], tube(2)),
        'tube3': Scene('the same, 3 points per cell and axis', 'Lame', [8, 16, 32], tube(3)),
        'ring': Scene('thick tube, axisymmetric', 'Lame', [4, 8, 16, 32], ring),
        'plasticRing': Scene('the same, half plastic (Tresca)', 'closed form', [4, 8, 16, 32], plasticRing(False)),
        'plasticRingFBar': Scene('the same with F-bar', 'closed form', [4, 8, 16, 32], plasticRing(True)),
        'stripLoad': Scene('strip load on a block, within two widths of the strip', 'half space', [1, 2, 4, 8], strip),
}
