# SPDX-License-Identifier: GPL-2.0-or-later
"""Structured meshes of quadrilaterals for the other programs: nodes h apart, linear elements of size h or quadratic ones of size 2 h. Needs nothing of YADE."""
import numpy as np

from .scenes import Beam, Cavity, Embankment, Footing


class Mesh:
	"""Nodes, elements of 4 or 8 nodes, counterclockwise with corners first, and named sets of nodes and of elements, all counted from 0."""

	def __init__(self, order):
		self.order, self.nodes, self.elements, self.sets, self.blocks, self._found = order, [], [], {}, {}, {}

	def _node(self, position):
		key = tuple(np.round(position, 9))
		if key not in self._found:
			self._found[key] = len(self.nodes)
			self.nodes.append(position)
		return self._found[key]

	def block(self, name, columns, rows, mapped):
		"""Add columns x rows intervals between nodes, at mapped(i, j); nodes at the same position are one."""
		n, begin = self.order, len(self.elements)
		around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)] if n == 2 else [(0, 0), (1, 0), (1, 1), (0, 1)]
		for j in range(0, rows, n):
			for i in range(0, columns, n): self.elements.append([self._node(mapped(i + di, j + dj)) for di, dj in around])
		self.blocks[name] = range(begin, len(self.elements))

	def where(self, condition):
		"""Nodes at which condition(x, y) holds."""
		return [number for number, position in enumerate(self.nodes) if condition(*position)]

	def sides(self, condition):
		"""(element, side) whose corners are both where condition(x, y) holds."""
		corners = set(self.where(condition))
		return [(number, side) for number, nodes in enumerate(self.elements) for side in range(4) if {nodes[side], nodes[(side + 1) % 4]} <= corners]


def footing(size, order):
	s, mesh = Footing(size), Mesh(order)
	mesh.block('clay', s.columns, s.rows, lambda i, j: (i * s.h, (j - s.rows) * s.h))
	return mesh


def cavity(size, order):
	s, mesh = Cavity(size), Mesh(order)

	def mapped(i, j):
		r, angle = s.inner + i * s.h, np.pi / 2 * j / s.rows
		return r * np.cos(angle), r * np.sin(angle)

	mesh.block('clay', s.columns, s.rows, mapped)
	return mesh


def beam(size, order):
	s, mesh = Beam(size), Mesh(order)
	mesh.block('ground', round(s.length * size), round(s.depth * size), lambda i, j: (i * s.h, j * s.h - s.depth))
	return mesh


def embankment(size, order, lifts=Embankment.lifts):
	"""Ground and the first lifts, whose columns narrow with height."""
	s, mesh = Embankment(size), Mesh(order)
	mesh.block('ground', round(s.width * size), round(s.depth * size), lambda i, j: (i * s.h, j * s.h - s.depth))
	rows, columns = max(order, round(s.lift * size)), round(s.toe(0) * size)
	for lift in range(lifts):
		below, above = s.toe(lift), s.toe(lift + 1)
		mesh.block(f'lift{lift}', columns, rows, lambda i, j: (i / columns * (below + (above - below) * j / rows), (lift + j / rows) * s.lift))
	return mesh


def meanOfLine(positions, values, end):
	"""Mean of values along a line from 0 to an end, by trapezoids."""
	order = np.argsort(positions)
	x, v = np.asarray(positions)[order], np.asarray(values)[order]
	keep = x <= end + 1e-9
	x, v = x[keep], v[keep]
	return (np.diff(x) * (v[1:] + v[:-1]) / 2).sum() / end
