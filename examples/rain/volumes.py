# SPDX-License-Identifier: GPL-2.0-or-later
"""Richards' equation by finite volumes, in the mixed form of Celia and others (1990): a solution apart from that of the plugin, of NumPy and SciPy alone."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve


class Section:
	"""A rectangle of soil in equal volumes, x to the right and z upwards; heads of water [m] are arrays (nx, nz). Water passes its top and its right side, if it is told so.

	:param cells: (nx, nz)
	:param size: (length, height) [m]
	:param soil: a Soil
	:param fall: part of gravity that acts against z: the cosine of a slope, z being the normal of its ground
	"""

	def __init__(self, cells, size, soil, fall=1.):
		self.cells, self.soil, self.fall = cells, soil, fall
		self.dx, self.dz = size[0] / cells[0], size[1] / cells[1]
		self.x = (np.arange(cells[0]) + .5) * self.dx
		self.z = (np.arange(cells[1]) + .5) * self.dz
		self.rain = np.zeros(cells[0])  # on the top [m/s], which ponds no higher than the ground
		self.level = None  # height of water before the right side [m], above which water can leave only
		self.base = None  # head at the base [m]

	def faces(self):
		"""Cells on the two sides of the faces inside, their area over the distance of the cells, and the growth of the height."""
		number = np.arange(np.prod(self.cells)).reshape(self.cells)
		for low, high, ratio, rise in (number[:-1], number[1:], self.dz / self.dx, 0.), (number[:, :-1], number[:, 1:], self.dx / self.dz, self.fall * self.dz):
			yield low.ravel(), high.ravel(), ratio, rise

	def residual(self, h, before, dt):
		"""Water that each cell has gained or lost too much [m2], and its derivative."""
		soil, h = self.soil, h.reshape(self.cells)
		(S, dS), (k, dk) = soil.saturation(h), soil.permeability(h)
		K, dK = soil.conductivity * k, soil.conductivity * dk
		area = self.dx * self.dz
		r = (area * soil.porosity * (S - soil.saturation(before)[0])).ravel()
		diagonal = (area * soil.porosity * dS).ravel()
		rows, columns, entries = [np.arange(h.size)], [np.arange(h.size)], [diagonal]
		flat, K, dK = h.ravel(), np.broadcast_to(K, self.cells).ravel(), np.broadcast_to(dK, self.cells).ravel()
		for low, high, ratio, rise in self.faces():
			drop = flat[low] - flat[high] - rise
			flow = dt * ratio * (K[low] + K[high]) / 2
			np.add.at(r, low, flow * drop)
			np.add.at(r, high, -flow * drop)
			for column, slope in (low, flow + dt * ratio * drop * dK[low] / 2), (high, -flow + dt * ratio * drop * dK[high] / 2):
				rows += [low, high]
				columns += [column, column]
				entries += [slope, -slope]
		for at, out, slope in self.outside(h, K.reshape(self.cells), dK.reshape(self.cells)):
			r[at] += dt * out
			diagonal[at] += dt * slope
		return r, coo_matrix((np.concatenate(entries), (np.concatenate(rows), np.concatenate(columns)))).tocsc()

	def outside(self, h, K, dK):
		"""(cells, what leaves [m2/s], its derivative) of the faces of the section."""
		number = np.arange(h.size).reshape(self.cells)
		skin = 2 * self.dx / self.dz * np.broadcast_to(self.soil.conductivity, self.cells)[:, -1]
		ponded, rain = skin * (h[:, -1] - self.fall * self.dz / 2), -self.rain * self.dx
		yield number[:, -1], np.maximum(ponded, rain), np.where(ponded > rain, skin, 0)
		if self.base is not None:
			drop = h[:, 0] - self.base + self.fall * self.dz / 2
			yield number[:, 0], 2 * self.dx / self.dz * K[:, 0] * drop, 2 * self.dx / self.dz * (K[:, 0] + dK[:, 0] * drop)
		if self.level is not None:
			drop = h[-1] - np.maximum(self.level - self.z, 0)
			passes = 2 * self.dz / self.dx * np.where((self.z < self.level) | (drop > 0), 1, 0)
			yield number[-1], passes * K[-1] * drop, passes * (K[-1] + dK[-1] * drop)

	def step(self, before, dt):
		"""Heads after a time [s], or None where Newton's method does not find them."""
		h = before.ravel().copy()
		for _ in range(25):
			r, K = self.residual(h, before, dt)
			change = spsolve(K, -r)
			h += change
			if not np.isfinite(h).all(): return None
			if abs(change).max() < 1e-9: return h.reshape(self.cells)
		return None

	def run(self, h, times, longest):
		"""Yields the heads at times [s], by steps of no more than `longest`."""
		now, dt = 0., longest / 100
		for time in times:
			while now < time * (1 - 1e-12):
				dt = min(dt, time - now)
				new = self.step(h, dt)
				if new is None:
					dt /= 3
					continue
				h, now, dt = new, now + dt, min(1.3 * dt, longest)
			yield h


class Soil:
	"""*saturation* and *permeability* are functions of an array of heads [m] that return values and slopes; *conductivity* [m/s] and *porosity* are numbers, or arrays of the cells."""

	def __init__(self, conductivity, porosity, saturation, permeability):
		self.conductivity, self.porosity, self.saturation, self.permeability = conductivity, porosity, saturation, permeability


def rational(scale, power):
	"""1 / (1 + (s / scale)^power) of a head of suction s [m], and its slope."""

	def curve(h):
		x = (np.maximum(-h, 0) / scale)**power
		return 1 / (1 + x), np.where(h < 0, power * x / (np.where(h < 0, -h, 1) * (1 + x)**2), 0)

	return curve


def vanGenuchten(alpha, n):
	"""Effective saturation and Mualem's relative permeability as functions of heads [m], with their slopes; alpha [1/m]."""
	m = 1 - 1 / n

	def saturation(h):
		s = np.where(h < 0, -h, 1)
		x = (alpha * s)**n
		return np.where(h < 0, (1 + x)**-m, 1), np.where(h < 0, m * n * x / (s * (1 + x)) * (1 + x)**-m, 0)

	def permeability(h):
		s = np.where(h < 0, -h, 1)
		x = (alpha * s)**n
		root, full = (1 + x)**(-m / 2), (x / (1 + x))**m
		value = root * (1 - full)**2
		return np.where(h < 0, value, 1), np.where(h < 0, m * n / (s * (1 + x)) * (x / 2 * value + 2 * root * (1 - full) * full), 0)

	return saturation, permeability
