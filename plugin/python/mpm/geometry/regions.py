# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions that predicates describe: which points are inside, and how large they are."""
import math

import numpy as np
from yade import pack
from yade.minieigenHP import Vector3

from .outline import polygon
from .terrains import terrain


def inside(predicate, points):
	"""Mask of the points (N, 3) inside; combinations are taken apart, so that the polygons in them are tested in bulk."""
	if isinstance(predicate, polygon):
		return predicate.contains(points[:, :2])
	if isinstance(predicate, terrain): return predicate.contains(points)
	for kind, combine in _combinations.items():
		if isinstance(predicate, kind):
			return combine(inside(predicate.A, points), inside(predicate.B, points))
	return np.fromiter((predicate(Vector3(*p), 0.) for p in each(points)), bool, len(points))


def requireRightWay(who, predicate):
	"""ValueError for a closed surface of triangles that face inwards, by itself or in a combination: its inside would be all that is around it."""
	if isinstance(predicate, tuple(_combinations)):
		requireRightWay(who, predicate.A)
		requireRightWay(who, predicate.B)
	elif isinstance(predicate, pack.inGtsSurface) and predicate.surf.volume() < 0:
		raise ValueError(
		        f'{who}: the triangles of the closed surface face inwards (its volume is {predicate.surf.volume():.6g} m3), so that its inside would be what is around it; turn it by '
		        'surface.revert() before pack.inGtsSurface(surface). mpm.solid turns what it reads from a file.'
		)


def each(points):
	"""The rows, as lists of which few are in memory at a time."""
	for first in range(0, len(points), 2**14):
		yield from points[first:first + 2**14].tolist()


_combinations = {
        pack.PredicateUnion: np.logical_or,
        pack.PredicateIntersection: np.logical_and,
        pack.PredicateDifference: np.greater,  # in the first and not in the second
        pack.PredicateSymmetricDifference: np.logical_xor,
}


def bounds(predicate, dim):
	"""Lower and upper corner (dim,) of the region's box; infinite where it has none."""
	return tuple(np.array([corner[i] for i in range(dim)], dtype=float) for corner in predicate.aabb())


def volumeInBoxes(predicate, grid, n, filled, admitted):
	"""Volume of a region in boxes, of which each point that fills it stands for one.

	Exact for a polygon, a box, and a closed surface of triangles.

	Else, in a grid of equal cells, estimated from points that are spread evenly, by those which are in the region or in the box of a point of
	the lattice, but not in both: as many as it takes to say whether the region's volume differs from that of the boxes by more than the part *admitted*,
	and not so many that filling takes a tenth longer.

	:param n: points per cell and axis
	:param filled: number of points in the region
	"""
	spacing = grid.cellSize / n
	if isinstance(predicate, polygon) and grid.dim == 2: return predicate.area(spacing)
	if isinstance(predicate, pack.inAlignedBox): return np.prod(np.subtract(*reversed(bounds(predicate, grid.dim))) / spacing)
	if isinstance(predicate, pack.inGtsSurface) and grid.dim == 3: return abs(predicate.surf.volume()) / spacing**3
	if grid.refinements: return filled  # it is not estimated
	return max(0, filled + _estimatedLack(predicate, grid, n, admitted * filled))


def _estimatedLack(predicate, grid, n, admitted):
	"""Volume of the region that the boxes lack, in boxes; negative if they have more."""
	half = grid.cellSize / (2 * n)
	low, high = bounds(predicate, grid.dim)
	low, high = low - half, high + half  # so far do boxes reach beyond the region
	box = np.prod((high - low) / (2 * half))
	block = 2**10
	difference = unequal = 0
	for first in range(0, max(2**14, int(box / 40)), block):
		points = _spread(first, block, low, high, grid)
		inRegion, inBoxes = inside(predicate, points), inside(predicate, _centres(points, grid, n))
		difference += int(inRegion.sum()) - int(inBoxes.sum())
		unequal += int((inRegion != inBoxes).sum())
		lack, scatter = (number * box / (first + block) for number in (difference, math.sqrt(unequal + 1)))
		if abs(abs(lack) - admitted) > 3 * scatter: return lack
	return math.copysign(max(0, abs(lack) - scatter), lack)  # part beyond doubt


def _spread(first, number, low, high, grid):
	"""(number, 3) points of a sequence that fills a box evenly: multiples of powers of the root of x^(dim + 1) = x + 1 (Roberts 2018)."""
	dim = len(low)
	root = {2: 1.32471795724474602596, 3: 1.22074408460575947536}[dim]
	share = (0.5 + np.arange(first, first + number)[:, None] * root**-np.arange(1., dim + 1)) % 1
	points = np.full((number, 3), grid.origin[2])
	points[:, :dim] = low + share * (high - low)
	return points


def _centres(points, grid, n):
	"""The points of the lattice in whose boxes these are, to the last bit those with which mpm.fill fills the cells."""
	centres = points.copy()
	origin = np.array(grid.origin)[:grid.dim]
	odd = 2 * np.floor((points[:, :grid.dim] - origin) / (grid.cellSize / n)) + 1
	centres[:, :grid.dim] = origin + grid.cellSize * odd / (2 * n)
	return centres
