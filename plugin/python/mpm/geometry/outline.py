# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions of the x-y plane."""
import math

import numpy as np
from yade import pack
from yade.minieigenHP import Vector3

from ..base.messages import brief, place


class polygon(pack.Predicate):
	"""Predicate of a simple polygon in the x-y plane, at any z.

	Works wherever a predicate of ``yade.pack`` does, boolean combinations included: ``mpm.polygon(...) - pack.inSphere(...)``.
	In three dimensions cut it to length: ``mpm.polygon(...) & pack.inAlignedBox(low, high)``.

	:param vertices: sequence of at least three (x, y) in m, in order around the polygon, either way round; the last one
		is joined to the first by itself. Concave outlines are welcome.
	:param more: none; vertices that are given one by one, without a list, are refused
	:raises TypeError: vertices are not pairs of numbers in one sequence.
	:raises ValueError: fewer than three vertices, a coordinate that is not finite, or an outline that crosses or touches itself.

	Points on the edge are inside, with a tolerance of 1e-9 of the polygon's larger extent.
	"""

	def __init__(self, vertices, *more):
		if more: raise TypeError('polygon: the vertices go into one list: mpm.polygon([(x, y), (x, y), ...])')
		super().__init__()  # YADE's boolean operators need the C++ part of the object
		self.vertices = _outline(vertices)
		self.low, self.high = self.vertices.min(axis=0), self.vertices.max(axis=0)
		self.tolerance = 1e-9 * (self.high - self.low).max()
		_refuseSelfContact(self.vertices, self.tolerance)

	def __repr__(self):
		return f'mpm.polygon({[tuple(v) for v in self.vertices.tolist()]})'

	def __call__(self, pt, pad=0.):
		"""True if the point is inside, no closer than *pad* [m] to the edge (a negative *pad* widens the polygon)."""
		return bool(self.contains([(pt[0], pt[1])], pad)[0])

	def aabb(self):
		"""Lower and upper corner of the bounding box; unbounded in z."""
		return Vector3(*self.low, -math.inf), Vector3(*self.high, math.inf)

	def area(self, unit=1.):
		"""Area of the polygon, in squares of a side of *unit* [m]."""
		vertices = (self.vertices - self.low) / unit
		(x, y), (nextX, nextY) = vertices.T, np.roll(vertices, -1, axis=0).T
		return float(abs((x * nextY - nextX * y).sum()) / 2)

	def contains(self, points, pad=0.):
		"""Test many points at once.

		:param points: (N, 2) coordinates [m]
		:param pad: as in ``__call__``
		:return: (N,) array of bool
		"""
		points = np.asarray(points, dtype=float).reshape(-1, 2)
		inside = np.empty(len(points), dtype=bool)
		block = 1 + 2**15 // len(self.vertices)  # keeps points x edges in cache
		for start in range(0, len(points), block):
			inside[start:start + block] = self._signedDistance(points[start:start + block]) >= pad - self.tolerance
		return inside

	def _signedDistance(self, points):
		"""(N,) distances from the edge [m], positive inside."""
		x, y = points.T[:, :, None]  # one row for each point, one column for each edge
		(ax, ay), (bx, by) = self.vertices.T, np.roll(self.vertices, -1, axis=0).T
		# a ray towards +x crosses the edge: half-open in y, so that one through a vertex counts it once
		spans = (ay > y) != (by > y)
		crossings = spans & (x < ax + (y - ay) * np.divide(bx - ax, by - ay, out=np.zeros(len(ax)), where=by != ay))
		inside = crossings.sum(axis=1) % 2 == 1
		return np.where(inside, 1, -1) * np.sqrt(_squaredDistance(x, y, ax, ay, bx, by).min(axis=1))


def _outline(vertices):
	"""Vertices as an (n, 2) array of finite numbers, n >= 3."""
	try:
		points = np.array([tuple(v) for v in vertices], dtype=float)
	except (TypeError, ValueError):
		raise TypeError(f'polygon: vertices = {brief(vertices)} must be a sequence of (x, y) pairs of numbers') from None
	if len(points) < 3:
		raise ValueError(f'polygon: vertices = {brief(vertices)}: at least 3 are needed to enclose an area, {len(points)} given')
	if points.ndim != 2 or points.shape[1] != 2:
		raise TypeError(f'polygon: vertices[0] = {place(points[0])} must be an (x, y) pair; the profile lies in the x-y plane')
	for i, point in enumerate(points):
		if not np.isfinite(point).all():
			raise ValueError(f'polygon: vertices[{i}] = {place(point)} must be finite')
	return points


def _refuseSelfContact(vertices, tolerance):
	"""Raise ValueError unless edges touch only where one follows the other: inside and outside would be ambiguous."""
	n = len(vertices)
	following = np.roll(vertices, -1, axis=0)
	for i in np.flatnonzero(np.hypot(*(following - vertices).T) <= tolerance):
		hint = '; the last vertex is joined to the first by itself: do not repeat it' if i == n - 1 else ''
		raise ValueError(f'polygon: vertices[{i}] and vertices[{(i + 1) % n}] coincide at {place(vertices[i])}{hint}')
	for i, (a, b) in enumerate(zip(vertices, following)):
		others = np.delete(np.arange(n), [i, (i + 1) % n])
		near = others[_squaredDistance(*vertices[others].T, *a, *b) <= tolerance**2]
		if near.size:
			raise ValueError(f'polygon: vertices[{near[0]}] = {place(vertices[near[0]])} lies on the edge from {place(a)} to {place(b)}; '
			                 'the outline must not touch itself or enclose no area')
		separates = _side(vertices, a, b) * _side(following, a, b) < 0
		separated = _side(a, vertices, following) * _side(b, vertices, following) < 0
		crossing = np.flatnonzero(separates & separated)
		if crossing.size:
			j = crossing[0]
			raise ValueError(f'polygon: the edge from {place(a)} to {place(b)} crosses the one from {place(vertices[j])} to '
			                 f'{place(following[j])}; are the vertices in order around the outline?')


def _side(p, a, b):
	"""Sign of the side of the line a-b on which p lies (any of the three may be an array of points)."""
	(px, py), (ax, ay), (bx, by) = np.transpose(p), np.transpose(a), np.transpose(b)
	return np.sign((bx - ax) * (py - ay) - (by - ay) * (px - ax))


def _squaredDistance(x, y, ax, ay, bx, by):
	"""Squared distance of the points (x, y) from the segment a-b."""
	dx, dy = bx - ax, by - ay
	t = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0, 1)
	return (x - ax - t * dx)**2 + (y - ay - t * dy)**2
