# SPDX-License-Identifier: GPL-2.0-or-later
"""Factor of safety of a slope by slices after Bishop (1955), with suction: the least of all circles. NumPy only."""
import numpy as np


class Slope:
	"""Ground of one soil that rises to the right. Suction acts by the degree of saturation, as in MpmFlow with residual=0."""

	def __init__(self, surface, cohesion, friction, weight, porosity, saturation, weightOfWater=9810.):
		"""*surface*: heights as a function of x; *weight*: of saturated soil by volume; *saturation*: as a function of the pressure."""
		self.surface, self.cohesion, self.tan, self.weight = surface, cohesion, np.tan(friction), weight
		self.porosity, self.saturation, self.ofWater = porosity, saturation, weightOfWater

	def circle(self, x0, x1, angle, pressure, level, floor):
		"""F of the circle from the surface at x0 up to that at x1, which it leaves *angle* steeper than its chord. Water outside has a level: what it carries is taken from weights and pressures."""
		y0, y1 = self.surface(x0), self.surface(x1)
		chord, slope = np.hypot(x1 - x0, y1 - y0), np.arctan2(y1 - y0, x1 - x0)
		R = chord / 2 / np.sin(angle)
		cx, cy = x1 - R * np.sin(slope + angle), y1 + R * np.cos(slope + angle)
		edges = np.linspace(x0, x1, 61)
		x, b = (edges[1:] + edges[:-1]) / 2, edges[1] - edges[0]
		y, top = cy - np.sqrt(R**2 - (x - cx)**2), self.surface(x)
		if slope + angle > 1.4 or y.min() < floor or (y > top).any(): return np.inf
		parts = (np.arange(40) + .5) / 40
		ys = y[:, None] + (top - y)[:, None] * parts
		lost = self.porosity * (1 - self.saturation(pressure(x[:, None], ys))) * self.ofWater
		W = b * ((top - y) * self.weight - (top - y) * lost.mean(axis=1) - self.ofWater * np.clip(np.minimum(level, top) - y, 0, None))
		p = pressure(x, y)
		u = np.where(p < 0, self.saturation(p), 1) * p - self.ofWater * np.clip(level - y, 0, None)
		sin = (x - cx) / R
		cos = np.sqrt(1 - sin**2)
		F = 1.
		for _ in range(60):
			m = cos + sin * self.tan / F
			if (m <= .2).any() or (W * sin).sum() <= 0: return np.inf
			new = ((self.cohesion * b + (W - u * b) * self.tan) / m).sum() / (W * sin).sum()
			if abs(new - F) < 1e-6: return new
			F = max(new, .05)
		return F

	def least(self, left, right, pressure, level, floor):
		"""The least F of circles that begin between two x of *left* and end between two of *right*, by a search that narrows."""
		low, high, best = np.array([left[0], right[0], .05]), np.array([left[1], right[1], 1.]), (np.inf, None)
		bounds = low.copy(), high.copy()
		for _ in range(5):
			for place in np.stack(np.meshgrid(*np.linspace(low, high, 9).T), axis=-1).reshape(-1, 3):
				F = self.circle(*place, pressure, level, floor)
				if F < best[0]: best = F, place
			span = (high - low) / 4
			low, high = np.maximum(best[1] - span, bounds[0]), np.minimum(best[1] + span, bounds[1])
		return best
