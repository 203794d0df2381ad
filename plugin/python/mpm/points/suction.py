# SPDX-License-Identifier: GPL-2.0-or-later
"""Water in level ground that is not saturated: pressures above and below a water table, and what they do to the initial stress."""
import math

import numpy as np

from ..base.messages import brief, isNumber
from ..library import engine as _library
from .water import conductivities

_ofCurve = 'alpha', 'entry', 'n', 'exponent', 'residual', 'saturated'  # parameters of retention curves that points may have of their own
_slices = 50  # of a cell, by which heads of infiltration are integrated


def poreWater(flow, material, pressures, own={}, volumeRatio=1.):
	"""(3, ...) degree of saturation, pressure on the grains [Pa] and relative permeability at pressures [Pa], of a point with these parameters of its own."""
	values = np.ascontiguousarray(pressures, float)
	return np.array([np.frombuffer(column).reshape(values.shape) for column in _library.poreWater(flow, material, values, own, volumeRatio)])


def alike(points, materials, number):
	"""Points that have the same retention curve: their material, their rows, and what of the curve is theirs, for poreWater."""
	for i, material in enumerate(materials):
		rows = np.flatnonzero(number == i)
		changes = material.retention and material.retention.voidExponent > 0
		names = [name for name in _ofCurve + ('porosity', ) * bool(changes) if name in points and not np.isnan(points[name][rows]).any()]
		ratio = np.linalg.det(points['defGrad'][rows]) if changes else np.ones(len(rows))
		values, group = np.unique(np.column_stack([points[name][rows] for name in names] + [ratio]), axis=0, return_inverse=True)
		parts = np.split(rows[np.argsort(group, kind='stable')], np.cumsum(np.bincount(group, minlength=len(values)))[:-1])
		for value, part in zip(values, parts):
			yield material, part, (dict(zip(names, value.tolist())), value[-1].item())


def pressureOnGrains(flow, points, materials, number):
	"""Part of the pressure (N,) [Pa] of points that acts on their grains (Bishop)."""
	pushes = np.empty(len(number))
	for material, rows, curve in alike(points, materials, number): pushes[rows] = poreWater(flow, material, points['excessPressure'][rows], *curve)[1]
	return pushes


class Suction:
	"""Water of an MpmFlow(total=True) in level ground. Heights are those of the nodes of the grid, as its pressures and saturations are linear between these."""

	def __init__(self, solver, axis, up, height, half, rows):
		grid, self.flow, self.rows = solver.grid, solver.flow, rows
		self.low, self.high = height - half, height + half
		first = up * np.array(grid.origin)[axis]
		lines = (np.array([self.low.min(), self.high.max()]) - first) / grid.cellSize
		self.nodes = first + grid.cellSize * np.arange(math.floor(lines[0] + 1e-9), math.ceil(lines[1] - 1e-9) + 1)

	def atNodes(self, pressure):
		"""Pressures of the nodes from those of points (N,), linear between and beyond the rows."""
		count = np.bincount(self.rows.row)
		values = np.bincount(self.rows.row, self.rows.ofSlices(pressure)) / count
		z, p = self.rows.level[::-1], values[::-1]
		if len(z) == 1: return np.full(len(self.nodes), p[0])
		found = np.interp(self.nodes, z, p)
		for outside, i, j in (self.nodes < z[0], 0, 1), (self.nodes > z[-1], -1, -2): found[outside] = p[i] + (self.nodes[outside] - z[i]) * (p[j] - p[i]) / (z[j] - z[i])
		return found

	def means(self, values, rows):
		"""Means over the domains of points in these rows of what nodes have."""
		nodes, steps = self.nodes, np.diff(self.nodes)
		sums = np.concatenate([[0], np.cumsum(steps * (values[1:] + values[:-1]) / 2)])

		def integral(z):
			i = np.clip(np.searchsorted(nodes, z, side='right') - 1, 0, len(steps) - 1)
			part = z - nodes[i]
			return sums[i] + part * (values[i] + (values[i + 1] - values[i]) * part / (2 * steps[i]))

		return (integral(self.high[rows]) - integral(self.low[rows])) / (self.high - self.low)[rows]

	def lightened(self, points, materials, number):
		"""What the vertical pressure (N,) of saturated ground is more than the effective one, as pores lose water and the rest presses on the grains or draws them together."""
		p = self.atNodes(points['excessPressure'] if 'excessPressure' in points else np.zeros(len(number)))
		lost, push = np.empty(len(number)), np.empty(len(number))
		for material, rows, curve in alike(points, materials, number):
			porosity = points['porosity'][rows] if 'porosity' in points else material.porosity
			lost[rows] = porosity * (1 - self.means(poreWater(self.flow, material, p, *curve)[0], rows)) * self.flow.unitWeight
			push[rows] = poreWater(self.flow, material, self.means(p, rows), *curve)[1]
		if np.isnan(lost).any(): raise ValueError(f'geostatic: the material {materials[number[np.flatnonzero(np.isnan(lost))[0]]].label!r} has no porosity [-], which MpmFlow needs')
		return self.rows.above(lost) + push

	def pressures(self, points, materials, number, table, infiltration):
		"""Pressures (N,) [Pa] of water that is at rest about a water table, or flows down steadily: dh/dz = q / K - 1."""
		middle = (self.low + self.high) / 2
		if infiltration == 0: return self.flow.unitWeight * (table - middle)
		vertical = conductivities('geostatic', points, materials, number)[:, 1]
		step, edges = (self.nodes[1] - self.nodes[0]) / _slices, self.rows.level + self.rows.thickness / 2
		order = [np.flatnonzero(self.rows.row == r)[0] for r in range(len(self.rows.level))]
		ofRow = self.rows.point[self.rows.order][order]
		curves = {point: (material, curve) for material, rows, curve in alike(points, materials, number) for point in rows}

		def slope(z, h):
			point = ofRow[np.clip(np.count_nonzero(edges > z) - 1, 0, len(ofRow) - 1)]
			material, curve = curves[point]
			return infiltration / (vertical[point] * max(poreWater(self.flow, material, self.flow.unitWeight * h, *curve)[2].item(), 1e-300)) - 1

		known = []
		for end in self.low.min(), self.high.max():
			z, h, count = table, 0., max(1, math.ceil(abs(end - table) / step))
			dz = (end - table) / count
			for _ in range(count):
				first = slope(z + 1e-9 * dz, h)
				middleOne = slope(z + dz / 2, h + dz / 2 * first)
				again = slope(z + dz / 2, h + dz / 2 * middleOne)
				last = slope(z + (1 - 1e-9) * dz, h + dz * again)
				h += dz / 6 * (first + 2 * middleOne + 2 * again + last)
				z += dz
				known.append((z, h))
			if end > table and not h <= 0 or not math.isfinite(h):
				raise ValueError(f'geostatic: infiltration = {brief(infiltration)} m/s cannot pass through the ground steadily from the water table on; give less than its conductivities, or less evaporation')
		z, h = np.transpose(sorted([*known, (table, 0.)]))
		return self.flow.unitWeight * np.interp(middle, z, h)


def requireTable(solver, table, infiltration):
	"""Refuses a water table or an infiltration that cannot be meant."""
	if table is None and infiltration == 0: return
	for name, value in ('waterTable', table), ('infiltration', infiltration):
		if not isNumber(value): raise TypeError(f'geostatic: {name} = {brief(value)} must be a number')
		if not math.isfinite(value): raise ValueError(f'geostatic: {name} = {brief(value)} must be finite')
	if not (solver.flow and solver.flow.total):
		raise ValueError(f'geostatic: waterTable = {brief(table)} needs MpmFlow(total=True) in flow of the solver; without suction the water is an MpmWater(level={brief(table)})')
