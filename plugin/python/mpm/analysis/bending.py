# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces and moments in sections of walls, piles and beams that are made of points."""
import itertools
import math

import numpy as np
from yade import wrapper

from ..base.messages import brief
from ..points.data import arrays


def sectionForces(body, cut):
	"""Normal force, shear force and bending moment where a plane cuts a body of points.

	Stresses are those of the points, weighed by what of their domains the plane cuts, as a mean over a cell along the normal; across the section they are taken as linear within a point, with the
	mean slope, so that few points across do for a beam. All act on the side from which the normal points away, and are about the middle of the section.

	:param body: name of the body, as given to :func:`fill`; or a predicate of ``yade.pack`` or an ``mpm.polygon``, of which the points belong to it that are inside now; None: all points
	:param cut: (place, normal): a point of the plane [m] and its normal, two or three numbers each, as ((0, 2.5), (0, 1)) for a level cut
	:return: dict. In the plane, with t the normal turned by 90 degrees to the left: ``N`` [N/m], positive in tension; ``Q`` [N/m], positive along t; ``M`` [N m/m], positive if it stretches the side that t
		points to; ``area`` of the section [m2/m] and ``centre``, its middle [m]. In space ``Q`` and ``M`` are vectors (3,) [N], [N m].
	:raises TypeError, ValueError: arguments that are not admitted, a body without points at the cut, an axisymmetric scene, in which a section is a ring.
	:raises KeyError: a body that no grid in ``O.engines`` knows.
	"""
	data = arrays()
	grid = _grid(body)
	place, normal = _plane(cut)
	if grid is not None and grid.axisymmetric: raise ValueError('sectionForces: a section of an axisymmetric scene is a ring; it is for dim=2 in plane strain and dim=3')
	isPlane = grid.dim == 2 if grid is not None else not normal[2] and np.ptp(data['pos'][:, 2]) == 0
	chosen = _pointsOf(body, data, grid)
	edges = 2 * np.einsum('pij,pj->pij', data['defGrad'], data['halfSize0'])[chosen][:, :, :2 if isPlane else 3]  # columns are the edges of a domain
	area = data['volume'][chosen] * _density((data['pos'][chosen] - place) @ normal, np.abs(np.einsum('pik,i->pk', edges, normal)), grid.cellSize if grid is not None else 0)
	if not area.sum() > 0: raise ValueError(f'sectionForces: the plane through {brief(tuple(place))} cuts no point of body = {brief(body)}')
	positions, traction = data['pos'][chosen], data['stress'][chosen] @ normal
	foot = positions - ((positions - place) @ normal)[:, None] * normal
	centre = area @ foot / area.sum()
	arm, force = foot - centre, area @ traction
	moment = np.einsum('p,pi->i', area, np.cross(arm, traction)) + _withinPoints(area, arm, traction @ normal, edges, normal)
	common = {'area': area.sum(), 'N': force @ normal, 'centre': centre[:2] if isPlane else centre}
	if not isPlane: return {**common, 'Q': force - force @ normal * normal, 'M': moment}
	return {**common, 'Q': force @ np.array([-normal[1], normal[0], 0]), 'M': moment @ np.cross(np.array([-normal[1], normal[0], 0]), normal)}


def _grid(body):
	grids = [engine.grid for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine) and engine.grid]
	if not isinstance(body, str): return grids[0] if grids else None
	known = [grid for grid in grids if body in [one.name for one in grid.bodies]]
	if known: return known[0]
	raise KeyError(f"sectionForces: no grid of an engine in O.engines has a body '{body}'; there are {', '.join(one.name for grid in grids for one in grid.bodies) or 'none'}")


def _plane(cut):
	try:
		place, normal = (np.array([float(x) for x in part] + [0.] * (3 - len(part))) for part in cut)
	except (TypeError, ValueError):
		raise TypeError(f'sectionForces: cut = {brief(cut)} must be (position, normal), two or three numbers each, as ((0, 2.5), (0, 1))') from None
	size = np.linalg.norm(normal)
	if place.shape != (3, ) or normal.shape != (3, ) or not (np.isfinite([place, normal]).all() and size > 0):
		raise ValueError(f'sectionForces: cut = {brief(cut)}: a position and a normal of finite numbers are needed, and the normal must not be zero')
	return place, normal / size


def _pointsOf(body, data, grid):
	if body is None: return np.ones(len(data['id']), dtype=bool)
	if isinstance(body, str): return data.get('body', np.full(len(data['id']), -1)) == [one.name for one in grid.bodies].index(body)
	if not callable(body): raise TypeError(f'sectionForces: body = {brief(body)} must be the name of a body, a predicate of yade.pack, an mpm.polygon or None')
	from ..geometry.regions import inside
	return inside(body, data['pos'])


def _density(distance, widths, cellSize):
	"""Part of each point's volume in a plane so far from its centre [1/m]: boxes as wide as its edges seen along the normal, one after the other, and one of a cell, over which stresses are right on"""
	widths = np.column_stack([widths, np.maximum(widths.max(axis=1), cellSize)])
	density = np.zeros(len(distance))
	for kept in itertools.product((False, True), repeat=widths.shape[1] - 1):  # edges along the plane have no width
		mask = (widths[:, :-1] > 1e-6 * widths[:, -1:]) == np.array(kept)
		these = np.flatnonzero(mask.all(axis=1))
		if not len(these) or not any(kept): continue
		own = widths[these][:, [*kept, True]]
		k, total = own.shape[1], 0
		for signs in itertools.product((-1, 1), repeat=k):
			total = total + np.prod(signs) * np.maximum(distance[these] + own @ np.array(signs) / 2, 0)**(k - 1)
		density[these] = np.maximum(total, 0) / (math.factorial(k - 1) * own.prod(axis=1))
	return density


def _withinPoints(area, arm, stress, edges, normal):
	"""The moment of normal stresses within the points, which differ as those of the points do on average."""
	axes = np.linalg.svd(arm * np.sqrt(area)[:, None])[2]
	axes = [axis for axis in axes if np.ptp(arm @ axis) > 1e-9 * np.ptp(arm, axis=0).max()][:2]
	if not axes: return np.zeros(3)
	basis = np.column_stack([np.ones(len(arm))] + [arm @ axis for axis in axes])
	slopes = np.linalg.lstsq(basis * np.sqrt(area)[:, None], stress * np.sqrt(area), rcond=None)[0][1:]
	moment = np.zeros(3)
	for axis, slope in zip(axes, slopes):
		spread = (np.einsum('pik,i->pk', edges, axis)**2).sum(axis=1) / 12
		moment += slope * (area @ spread) * np.cross(axis, normal)
	return moment
