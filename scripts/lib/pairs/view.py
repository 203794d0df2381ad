# SPDX-License-Identifier: GPL-2.0-or-later
"""View of a scene: turned and mirrored, moved by whole cells, in other units, with bodies in another order. Nothing here needs YADE."""
import math

import numpy as np

inf = math.inf
# Attributes and columns that are stresses
pressures = {'porePressure', 'yieldStress', 'undrainedStrength', 'cohesion', 'shearModulus', 'preconsolidation', 'referencePressure', 'young', 'excessPressure', 'capPressure', 'imagePressure', 'hardening', 'residualYieldStress', 'tensileStrength', 'E50ref', 'Eoedref', 'Eurref'}


class View:
	"""Coordinates are those of the scene, shifted, then turned by a signed permutation of the axes, then scaled; in the plane z stays.

	:param turn: for each axis of the scene, the axis along which it lies and the sign
	:param shift: [m of the scene]
	:param scales: exponents of two of length, stress, density; the sum of the last two must be even, so that times scale by a power of two
	:param heavier: part by which gravity is larger
	"""

	def __init__(self, dim, isRing, turn=((0, 1), (1, 1), (2, 1)), shift=(0, 0, 0), scales=(0, 0, 0), order=None, threads=1, restart=False, heavier=0.):
		self.dim, self.isRing, self.shift, self.order, self.threads, self.restart, self.heavier = dim, isRing, np.array(shift, float), order, threads, restart, heavier
		self.turn = np.zeros((3, 3))
		for axis, (to, sign) in enumerate(turn):
			self.turn[to, axis] = sign
		length, stress, density = scales
		self.L, self.S, self.D, self.T = 2.**length, 2.**stress, 2.**density, 2.**(length + (density - stress) // 2)
		assert (density - stress) % 2 == 0
		self.F = self.S * self.L**(1 if dim == 2 and not isRing else 2)  # unit of forces
		self.volume = self.L**(2 if dim == 2 and not isRing else 3)

	@property
	def isMirrored(self):
		return np.linalg.det(self.turn) < 0

	def point(self, x):
		moved = self.turn @ (np.array(x, float) + self.shift)
		moved[:self.dim] *= self.L
		return _tuple(moved)

	def vector(self, v, unit=1.):
		return _tuple(self.turn @ np.array(v, float) * unit)

	def around(self, w, unit=1.):
		"""Vector of angular velocities and torques."""
		return _tuple(np.linalg.det(self.turn) * (self.turn @ np.array(w, float)) * unit)

	def sizes(self, extents):
		turned = np.abs(self.turn) @ np.array(extents, float)
		turned[:self.dim] *= self.L
		return _tuple(turned)

	def box(self, low, high):
		ends = np.array([self._corner(low), self._corner(high)])
		return _tuple(ends.min(0)), _tuple(ends.max(0))

	def _corner(self, x):
		moved = np.zeros(3)
		for axis in range(3):
			to = int(np.abs(self.turn[:, axis]).argmax())
			moved[to] = self.turn[to, axis] * (x[axis] + self.shift[axis]) * (self.L if axis < self.dim else 1)
		return moved

	def letters(self, fix):
		return fix if fix == 'n' else ''.join(sorted('xyz'[int(np.abs(self.turn[:, 'xyz'.index(a)]).argmax())] for a in fix))

	def axis(self, axis):
		"""Along which axis it lies, and the sign."""
		to = int(np.abs(self.turn[:, axis]).argmax())
		return to, int(self.turn[to, axis])

	def line(self, points):
		"""A surface with the body on its inner side: a line, or triangles."""
		if self.dim == 2: return [self.point(x) for x in (points[::-1] if self.isMirrored else points)]
		return [[self.point(x) for x in (corners[::-1] if self.isMirrored else corners)] for corners in points]

	def curve(self, knees):
		return [(time * self.T, factor) for time, factor in knees]

	def back(self, name, values):
		"""A quantity of the points, by its name in mpm.arrays, as the scene has it."""
		v = np.array(values, float)
		if name in ('pos', 'pos0'):
			v[:, :self.dim] /= self.L
			return v @ self.turn - self.shift
		if name in ('halfSize', 'halfSize0'):
			v[:, :3 if self.isRing else self.dim] /= self.L
			return v @ np.abs(self.turn)
		if name in ('velocity', 'acceleration'): return v @ self.turn * (self.T**(1 if name == 'velocity' else 2) / self.L)
		if name in ('waterFlux', 'conductivity'): return (v @ self.turn if v.ndim > 1 else v) * (self.T / self.L)
		if name == 'force': return v @ self.turn / self.F
		if v.ndim == 3: return self.turn.T @ v @ self.turn / (self.S if name == 'stress' else 1)
		return v / (self.volume if name in ('volume', 'volume0') else self.S if name in pressures else 1)

	def forces(self, vectors, unit=1.):
		return np.array(vectors, float).reshape(-1, 3) @ self.turn / (self.F * unit)

	def torques(self, vectors):
		return np.linalg.det(self.turn) * self.forces(vectors, self.L)


def _tuple(x):
	return tuple(float(number) + 0. for number in x)


def views(dim, chosen, random, cell):
	"""Views to compare a scene with, by name. Around an axis only those that keep the axis; a period is where the grid begins, which is moved along."""
	isRing = 'axisymmetric' in chosen
	mirror, quarter = [(a, 1) for a in range(3)], {2: [[(1, 1), (0, -1), (2, 1)], [(1, -1), (0, 1), (2, 1)]], 3: [[(1, 1), (2, 1), (0, 1)], [(0, 1), (2, 1), (1, -1)], [(2, -1), (1, 1), (0, 1)]]}[dim]
	axis = 1 if isRing else random.randrange(dim)
	mirror[axis] = (axis, -1)
	shift = [0 if a >= dim or (isRing and a == 0) else cell * random.randint(-9, 9) for a in range(3)]
	scales = random.choice([(2, 0, 0), (0, 4, 0), (0, 0, -2), (-2, 6, 2), (4, -4, 2)])
	found = {
	        'again': {}, 'mirrored': dict(turn=mirror), 'shifted': dict(shift=shift), 'scaled': dict(scales=scales), 'other order': dict(order=random.randrange(1 << 30)), 'saved and loaded': dict(restart=True),
	        'two threads': dict(threads=2)
	}
	if not isRing: found['turned'] = dict(turn=random.choice(quarter))
	return {name: View(dim, isRing, **changes) for name, changes in found.items()}
