# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells that are halved where something tells that it matters."""
import numpy as np
from yade.minieigenHP import Vector3
from yade.wrapper import MpmGrid, MpmRefinement

from .messages import brief


def refinementsAt(positions, grid, halvings=1):
	"""Boxes in which the cells at these places are halved, for ``MpmGrid.refinements``: near what moves, or where an error indicator asks for it, as where a first run has yielded::

		points = mpm.arrays()
		flows = points['plasticStrain'] > 0.1 * points['plasticStrain'].max()
		grid.refinements = mpm.refinementsAt(points['pos0'][flows], grid, halvings=2)  # and fill anew

	:param positions: (N, 3) [m]; N may be 0
	:param grid: MpmGrid; its own refinements do not count
	:param halvings: how often the cells are halved there, 1 to 3
	:return: list of MpmRefinement, one for each row of cells along x
	:raises TypeError: *grid* is no MpmGrid.
	:raises ValueError: *positions* is no array (N, 3) of finite numbers, or *halvings* not 1, 2 or 3.
	"""
	if not isinstance(grid, MpmGrid): raise TypeError(f'refinementsAt: grid = {brief(grid)} must be an MpmGrid')
	try:
		places = np.asarray(positions, float)
	except (TypeError, ValueError):
		places = np.empty(0)
	if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
		raise ValueError(f'refinementsAt: positions = {brief(positions)} must be an array (N, 3) of finite numbers [m]')
	MpmRefinement(halvings=halvings)  # refuses others
	size, origin = grid.cellSize / 2**(halvings - 1), np.array(grid.origin)  # of the cells that are halved last
	cells = np.unique(np.floor((places - origin) / size)[:, :grid.dim][:, ::-1], axis=0)  # x fastest
	ends = np.flatnonzero((np.diff(cells, axis=0) != [0] * (grid.dim - 1) + [1]).any(axis=1)) + 1
	rows = [row[:, ::-1] for row in np.split(cells, ends) if len(row)]
	return [MpmRefinement(halvings=halvings, **_box(row[0], row[-1] + 1, size, origin)) for row in rows]


def _box(low, high, size, origin):
	"""The corners, in the plane without limits along z."""
	low, high = (np.append(x, [sign * np.inf] * (3 - len(x))) for x, sign in ((low, -1), (high, 1)))
	return dict(min=Vector3(*(origin + size * low)), max=Vector3(*(origin + size * high)))
