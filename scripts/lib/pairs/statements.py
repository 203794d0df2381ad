# SPDX-License-Identifier: GPL-2.0-or-later
"""Statements of a script for YADE, in the coordinates of a View. Nothing here needs YADE."""
import math


def arguments(values):
	return ', '.join(f'{name}={value!r}' for name, value in values.items())


class Statements:
	"""Lines of the script; its boundaries and settings of its engine are collected until the engine is written."""

	def __init__(self, scene, view):
		self.scene, self.view, self.lines = scene, view, []
		self.boundaries, self.engine = [], {}
		self.add('import numpy as np', 'from yade import mpm, pack, utils', 'O.reset()')

	def add(self, *lines):
		self.lines += lines

	def placeInScene(self):
		"""A function of the script: coordinates of the scene from those of the view."""
		v, dim = self.view, self.scene.dim
		matrix = [[float(x) for x in row] for row in v.turn.T]
		self.add(f'def placeInScene(x): return np.array({matrix}) @ (np.array(x, float) / {[v.L] * dim + [1.] * (3 - dim)}) - {[float(x) for x in v.shift]}')

	def boundary(self, low, high, fix, **more):
		low, high = self.view.box(low, high)
		fix = ''.join(a for a in fix if 'xyz'.index(a) < self.scene.dim)
		self.boundaries.append(f'MpmBoundary(min={low}, max={high}, fix={self.view.letters(fix)!r}{"".join(f", {name}={value}" for name, value in more.items())})')

	def plane(self, a, b, axis, side, perCell=6):
		"""A rectangle across an axis between two corners [m], with the body on its inner side: outwards is -1 or 1 along the axis."""
		if self.scene.dim == 2:
			ends = [tuple(a[:2]) + (0., ), tuple(b[:2]) + (0., )]
			# on the left of a line lies the body: to the right for the base, downwards on the left side
			return ends if (axis == 1) == (side < 0) else ends[::-1]
		return self._triangles(a, b, axis, side, perCell)

	def _triangles(self, a, b, axis, side, perCell):
		"""Divides pieces as the engine wants them: how it divides larger ones depends on the corner with which they begin, and so on the side from which one looks."""
		u, w = [k for k in range(3) if k != axis]
		if (axis == 1) == (side > 0): u, w = w, u
		n = {k: math.ceil((b[k] - a[k]) / self.scene.cell * perCell - 1e-9) for k in (u, w)}
		corner = lambda i, j: tuple(a[k] if k == axis else a[k] + (b[k] - a[k]) * (i if k == u else j) / n[k] for k in range(3))
		quads = [(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)) for i in range(n[u]) for j in range(n[w])]
		return [[q[0], *q[k:k + 2]] for q in quads for k in (1, 2)]
