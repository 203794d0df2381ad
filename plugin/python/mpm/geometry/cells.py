# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells that are halved where something tells that it matters."""
import numpy as np
from yade.minieigenHP import Vector3
from yade.wrapper import MpmGrid, MpmRefinement

from ..base.messages import brief, numbersIn
from .rigid import bodiesIn, cornersOf


def refinementsAt(positions, grid, halvings=1, way=None, margin=None):
	"""Boxes in which the cells at these places, or around rigid bodies, are halved, for ``MpmGrid.refinements``: near what moves, or where an error indicator asks for it, as where a first run has yielded::

		points = mpm.arrays()
		flows = points['plasticStrain'] > 0.1 * points['plasticStrain'].max()
		grid.refinements = mpm.refinementsAt(points['pos0'][flows], grid, halvings=2)  # and fill anew

		grid.refinements = mpm.refinementsAt(O.bodies[cone], grid, halvings=2, way=(0, -4, 0))  # before filling

	:param positions: (N, 3) [m]; N may be 0. Or a Body with a Sphere, Box or Facet, a clump of those, or a list of them, where they are now.
	:param grid: MpmGrid; its own refinements do not count
	:param halvings: how often the cells are halved there, 1 to 3
	:param way: of bodies, by which they are going to move, straight on [m]; by default they stay
	:param margin: of bodies, how far around them [m] >= 0; by default half of their largest extent
	:return: list of MpmRefinement, one for each row of cells along x; around bodies one for each of them, or several along a way across the axes
	:raises TypeError: *grid* is no MpmGrid.
	:raises ValueError: *positions* is neither an array (N, 3) of finite numbers nor bodies that have an end, *halvings* not 1, 2 or 3, *way* or *margin* not finite
		or given with places.
	"""
	if not isinstance(grid, MpmGrid): raise TypeError(f'refinementsAt: grid = {brief(grid)} must be an MpmGrid')
	MpmRefinement(halvings=halvings)  # refuses others
	bodies = bodiesIn(positions)
	if bodies: return [box for body in bodies for box in _around(body, grid, halvings, (0, 0, 0) if way is None else way, margin)]
	for name, value in ('way', way), ('margin', margin):
		if value is not None: raise ValueError(f'refinementsAt: {name} = {brief(value)} goes with bodies, and positions are points')
	places = numbersIn(positions)
	if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
		raise ValueError(f'refinementsAt: positions = {brief(positions)} must be an array (N, 3) of finite numbers [m], or bodies')
	size, origin = grid.cellSize / 2**(halvings - 1), np.array(grid.origin)  # size and origin of the cells that are halved last
	cells = np.unique(np.floor((places - origin) / size)[:, :grid.dim][:, ::-1], axis=0)  # x fastest
	ends = np.flatnonzero((np.diff(cells, axis=0) != [0] * (grid.dim - 1) + [1]).any(axis=1)) + 1
	rows = [row[:, ::-1] for row in np.split(cells, ends) if len(row)]
	return [MpmRefinement(halvings=halvings, **_box(row[0], row[-1] + 1, size, origin)) for row in rows]


def _around(body, grid, halvings, way, margin):
	"""Along a way across the axes as many boxes as let each reach no farther beside it than one cell more."""
	corners = cornersOf(body)
	if corners is None: raise ValueError(f'refinementsAt: body #{body.id} has no end, or a shape that contact does not know; admitted are a Sphere, a Box or a Facet, and clumps of these')
	low, high = corners.min(axis=0), corners.max(axis=0)
	margin = (high - low).max() / 2 if margin is None else margin
	if not (np.ndim(margin) == 0 and np.isfinite(margin) and margin >= 0): raise ValueError(f'refinementsAt: margin = {brief(margin)}, expected a number >= 0 [m]')
	way = np.asarray(way, float)
	if way.shape != (3, ) or not np.isfinite(way).all(): raise ValueError(f'refinementsAt: way = {brief(way)}, expected three finite numbers [m]')
	alongAxis = np.count_nonzero(way[:grid.dim]) < 2
	parts = 1 if alongAxis else int(np.ceil(np.linalg.norm(way) / grid.cellSize))
	ways = [way * i / parts for i in range(parts + 1)]
	return [_limits(grid, halvings, low + np.minimum(a, b) - margin, high + np.maximum(a, b) + margin) for a, b in zip(ways, ways[1:])]


def _limits(grid, halvings, low, high):
	if grid.dim == 2: low[2], high[2] = -np.inf, np.inf
	return MpmRefinement(halvings=halvings, min=Vector3(*low), max=Vector3(*high))


def _box(low, high, size, origin):
	"""The corners, in the plane without limits along z."""
	low, high = (np.append(x, [sign * np.inf] * (3 - len(x))) for x, sign in ((low, -1), (high, 1)))
	return dict(min=Vector3(*(origin + size * low)), max=Vector3(*(origin + size * high)))
