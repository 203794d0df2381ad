# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces of regions, for loads on them."""
import math

import numpy as np
from yade import pack
from yade.wrapper import MpmSurface

from ..base.messages import brief, numbersIn, place
from .outline import polygon
from .regions import bounds, inside, requireRightWay


def surface(region, min=(-math.inf, ) * 3, max=(math.inf, ) * 3, dim=2, spacing=None):
	"""Surface of a region, or the part of it in a box: ``mpm.surface(profile, min=(2, 11.9), max=(4, inf))`` is a crest between x = 2 and 4 m.

	Exact for polygons, boxes and closed surfaces of triangles; in the plane any other region is walked around in steps of *spacing*, which cuts its
	corners by as much. In 3D these may be ``pack.inGtsSurface``, ``pack.inAlignedBox`` and a polygon that is cut to length by a box, ``polygon & box``.

	:param region: predicate, as for :func:`fill`
	:param min: lower corner of the box [m], two or three numbers; faces of the box belong to it
	:param max: upper corner [m]
	:param dim: 2: segments in the plane; 3: triangles
	:param spacing: length of a step [m] > 0; by default a 200th of the region's larger extent
	:return: ``MpmSurface``, with the region on its inner side
	:raises TypeError: *region* is no predicate, *min* or *max* are no points.
	:raises ValueError: nothing of the surface is in the box, the region is unbounded, or one whose surface is not known in 3D.
	"""
	if dim not in (2, 3): raise ValueError(f'surface: dim = {brief(dim)} must be 2 or 3')
	if not callable(region): raise TypeError(f'surface: region = {brief(region)} must be a predicate, as for mpm.fill')
	low, high = _corner('min', min, -math.inf, dim), _corner('max', max, math.inf, dim)
	pieces = _outline(region, spacing) if dim == 2 else _triangles(region)
	extent = np.ptp(np.concatenate(pieces), axis=0).max()
	tolerance = 1e-9 * extent
	sliver = 4 * tolerance * extent**(dim - 2)  # smallest area of a piece on a face of the box
	kept = [part for piece in pieces for part in _clipped(piece, low - tolerance, high + tolerance) if _size(part) > sliver]
	if not kept:
		corners = np.concatenate(pieces)
		raise ValueError(
		        f'surface: nothing of it lies between min = {place(low)} and max = {place(high)}; '
		        f'that of the region reaches from {place(corners.min(axis=0))} to {place(corners.max(axis=0))}'
		)
	return _joined(kept, tolerance)


def _corner(name, point, missing, dim):
	numbers = numbersIn(point)
	if numbers.shape not in ((2, ), (3, )) or np.isnan(numbers).any(): raise TypeError(f'surface: {name} = {brief(point)} must be two or three numbers')
	return np.append(numbers, missing)[:dim]


def _outline(region, spacing):
	"""Segments (2, 2) around a region of the plane, which is on their left."""
	if isinstance(region, polygon): corners = region.vertices
	elif isinstance(region, pack.inAlignedBox):
		(x0, y0), (x1, y1) = bounds(region, 2)
		corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
	else: return _walkAround(region, spacing)
	if not np.isfinite(corners).all(): raise ValueError(f'surface: the region is unbounded, from {place(corners.min(axis=0))} to {place(corners.max(axis=0))}')
	return _ring(corners)


def _ring(corners):
	x, y = corners.T
	if (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() < 0: corners = corners[::-1]
	return list(np.stack([corners, np.roll(corners, -1, axis=0)], 1))


def _walkAround(region, spacing):
	"""Contours of the predicate, on a lattice; where one crosses an edge of it is found by bisection."""
	from matplotlib.figure import Figure
	low, high = bounds(region, 2)
	if not (np.isfinite(low).all() and np.isfinite(high).all()):
		raise ValueError(f'surface: the region is unbounded, from {place(low)} to {place(high)}')
	step = (high - low).max() / 200 if spacing is None else float(spacing)
	if not step > 0: raise ValueError(f'surface: spacing = {brief(spacing)} must be > 0')
	axes = [np.arange(l - 1.5 * step, h + 2.5 * step, step) for l, h in zip(low, high)]
	x, y = np.meshgrid(*axes)
	isIn = lambda points: inside(region, np.column_stack([points, np.zeros(len(points))]))
	values = isIn(np.column_stack([x.ravel(), y.ravel()])).reshape(x.shape)
	segments = []
	for line in Figure().add_subplot().contour(x, y, values.astype(float), [0.5]).allsegs[0]:
		segments += _ring(_onEdge(line[:-1], isIn, axes, step))
	return segments


def _onEdge(middles, isIn, axes, step):
	"""Points of a contour moved along the edges of the lattice that they halve, to where the region ends."""
	offset = [np.abs((middles[:, a] - axes[a][0]) / step % 1 - 0.5) < 0.25 for a in (0, 1)]
	along = np.stack(offset, 1) * step / 2  # towards one end of the edge
	outer = np.where(isIn(middles + along)[:, None], -along, along)
	inner = -outer
	for _ in range(40):
		half = (inner + outer) / 2
		isInner = isIn(middles + half)[:, None]
		inner, outer = np.where(isInner, half, inner), np.where(isInner, outer, half)
	points = middles + inner
	return points[np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) > 1e-9 * step]


def _triangles(region):
	"""(3, 3) corners of triangles, counterclockwise from outside."""
	if isinstance(region, pack.inGtsSurface):
		requireRightWay('surface', region)
		return [np.array([v.coords() for v in face.vertices()]) for face in region.surf.faces()]
	if isinstance(region, pack.inAlignedBox):
		low, high = bounds(region, 3)
		return _prism(np.array([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]), low[2], high[2])
	if isinstance(region, pack.PredicateIntersection):
		for profile, box in ((region.A, region.B), (region.B, region.A)):
			if not (isinstance(profile, polygon) and isinstance(box, pack.inAlignedBox)): continue
			low, high = bounds(box, 3)
			if (low[:2] <= profile.low).all() and (profile.high <= high[:2]).all(): return _prism(profile.vertices, low[2], high[2])
	raise ValueError(
	        f'surface: that of {brief(region)} is not known in 3D: expected pack.inGtsSurface, pack.inAlignedBox, or a polygon cut to length by a box '
	        'that is as wide and high as it; or give the triangles themselves'
	)


def _prism(corners, low, high):
	if not (np.isfinite(corners).all() and np.isfinite([low, high]).all()): raise ValueError('surface: the region is unbounded')
	ring = _ring(corners)
	corners = np.array([a for a, _ in ring])
	at = lambda x, z: np.append(x, z)
	sides = [[at(a, low), at(b, low), at(b, high)] for a, b in ring] + [[at(a, low), at(b, high), at(a, high)] for a, b in ring]
	ends = [[at(x, z) for x in (ear if z == high else ear[::-1])] for ear in _ears(list(corners)) for z in (low, high)]
	return [np.array(triangle) for triangle in sides + ends]


def _ears(corners):
	"""Triangles that make up a simple polygon, counterclockwise."""
	ears = []
	while len(corners) > 3:
		n = len(corners)
		i = next(i for i in range(n) if _isEar(corners[i - 1], corners[i], corners[(i + 1) % n], corners))
		ears.append((corners[i - 1], corners[i], corners[(i + 1) % n]))
		del corners[i]
	return ears + [tuple(corners)]


def _isEar(a, b, c, others):
	side = lambda p, q, x: (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])
	if side(a, b, c) <= 0: return False
	corners = {tuple(a), tuple(b), tuple(c)}
	return not any(tuple(x) not in corners and min(side(a, b, x), side(b, c, x), side(c, a, x)) >= 0 for x in others)


def _clipped(piece, low, high):
	"""Part of a segment or triangle in a box: pieces of its kind (Sutherland and Hodgman 1974)."""
	corners = list(piece)
	for axis in range(len(low)):
		for sign, limit in ((1, high[axis]), (-1, low[axis])):
			corners = _cutOff(corners, axis, sign, sign * limit, closed=len(piece) == 3)
	if len(piece) == 2: return [np.array(corners)] if len(corners) == 2 else []
	return [np.array([corners[0], corners[i], corners[i + 1]]) for i in range(1, len(corners) - 1)]


def _cutOff(corners, axis, sign, limit, closed):
	kept = []
	for i, corner in enumerate(corners):
		beyond = sign * corner[axis] - limit
		if beyond <= 0: kept.append(corner)
		if i + 1 == len(corners) and not closed: break
		following = corners[(i + 1) % len(corners)]
		beyondNext = sign * following[axis] - limit
		if beyond * beyondNext < 0: kept.append(corner + beyond / (beyond - beyondNext) * (following - corner))
	return kept


def _size(piece):
	if len(piece) == 2: return np.linalg.norm(piece[1] - piece[0])
	return np.linalg.norm(np.cross(piece[1] - piece[0], piece[2] - piece[0])) / 2


def _joined(pieces, tolerance):
	"""MpmSurface in which corners that meet are one vertex."""
	numbers, vertices = {}, []
	def number(x):
		key = tuple(np.round(x / max(tolerance, 1e-300) / 16).astype(np.int64).tolist())
		if key not in numbers:
			numbers[key] = len(vertices)
			vertices.append(tuple(x.tolist()) + (0., ) * (3 - len(x)))
		return numbers[key]
	return MpmSurface(pieces=[[number(x) for x in piece] for piece in pieces], vertices=vertices)
