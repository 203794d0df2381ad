# SPDX-License-Identifier: GPL-2.0-or-later
"""Initial stress of the ground."""
import math

import numpy as np
from yade import wrapper

from .analysis import noPoints, solverOf
from .data import assign, pointsOf
from .messages import brief, place


def geostatic(K0, surface=None, solver=None):
	"""Give the material points of an engine the stress of level ground under its own weight, in equilibrium with gravity at load factor 1.

	The vertical stress is the weight of the soil above, of whatever density its horizontal layers have; the horizontal one is *K0*
	times that, in all directions. The first step then finds nothing to move, if the sides are held in their normal direction and gravity
	acts in full from the beginning. Point loads and prescribed displacements may grow meanwhile, with ``loadCurve``::

		solver.gravityCurve = [(0, 1)]
		mpm.geostatic(K0=0.5)

	To be called when ``O.engines`` and ``O.bodies`` are complete, before the first step. Other shapes than level ground have no such stress: let
	gravity grow first, and then the loads, by ``gravityCurve=[(0, 0), (1, 1)]`` and ``loadCurve=[(1, 0), (2, 1)]``.

	:param K0: ratio of horizontal to vertical stress, a number >= 0, or a dict of one for each label of the materials that the bodies have
	:param surface: height of the ground's surface [m]: the coordinate against gravity's direction; by default the top of the highest
		points. Higher than that: the ground above is not modelled, its weight acts as a stress (of the density of the highest points),
		and the scene has to provide it as a load.
	:param solver: ``MpmImplicitEngine`` whose gravity and points are meant (those of its ``mask``); needed if there are several
	:raises TypeError: *K0* or *surface* is no number.
	:raises ValueError: a value that is not admitted; gravity that is zero or not along an axis; a load factor other than 1 at O.time;
		points that have been deformed; ground that is not level, with layers of one density and one extent; or a stress that a
		material cannot carry without yielding.
	"""
	solver = solverOf('geostatic', solver)
	points, materials, number = pointsOf(solver)
	if not len(points['id']): raise ValueError(noPoints('geostatic', solver))
	axis, up = _upwards(solver)
	_requireFullGravity(solver)
	if np.abs(points['pos'] - points['pos0']).max() > 0 or np.abs(points['defGrad'] - np.eye(3)).max() > 0:
		raise ValueError('geostatic: the points have been deformed; an initial stress can be given only before the first step')
	height = up * points['pos'][:, axis]
	half = points['halfSize'][:, axis]
	density = np.array([material.density for material in materials])[number]
	top = height.max() + half[np.argmax(height)]
	if surface is None: surface = top
	elif not _isNumber(surface): raise TypeError(f'geostatic: surface = {brief(surface)} must be a height [m]')
	elif not (math.isfinite(surface) and surface >= top - 1e-9 * abs(top)):
		raise ValueError(f'geostatic: surface = {surface} is below the top of the highest points, at {top} m; at what height does the ground end?')
	pressure = _weightAbove(points, axis, height, half, density, surface - top) * np.linalg.norm(solver.gravity)
	horizontal = pressure * np.array([_ratio(K0, material) for material in materials])[number]
	stress = np.zeros((len(height), 3, 3))
	for i in range(3):
		stress[:, i, i] = -(pressure if i == axis else horizontal)
	try:
		assign(ids=points['id'], stress=stress)
	except ValueError as error:
		raise ValueError(f'geostatic: with K0 = {brief(K0)} the ground would not be at rest. {str(error).removeprefix("assign: ")}') from None


def _isNumber(value):
	return isinstance(value, (int, float, np.floating, np.integer)) and not isinstance(value, bool)


def _upwards(solver):
	"""Axis of gravity, and the sign that makes its coordinate a height."""
	gravity = np.array(solver.gravity)
	axes = np.flatnonzero(gravity)
	if len(axes) != 1 or (solver.grid.dim == 2 and axes[0] == 2):
		raise ValueError(f'geostatic: gravity = {place(gravity)} of the MpmImplicitEngine must act along one of the axes of the grid')
	return axes[0], -np.sign(gravity[axes[0]])


def _requireFullGravity(solver):
	name = 'gravityCurve' if solver.gravityCurve else 'loadCurve'
	curve = np.array(getattr(solver, name))
	now = wrapper.Omega().time
	if np.interp(now, *curve.T) != 1 or (curve[curve[:, 0] > now, 1] != 1).any():
		raise ValueError(
		        f'geostatic: the factor of gravity is not 1 from now on (O.time = {now}, {name} = {getattr(solver, name)}), so gravity would not balance the '
		        'stress; set gravityCurve = [(0, 1)] of the MpmImplicitEngine'
		)


def _ratio(K0, material):
	"""K0 of a material."""
	if isinstance(K0, dict) and material.label not in K0:
		raise ValueError(f'geostatic: K0 = {brief(K0)} has no entry for material {material.label!r}' + ('' if material.label else ', which needs a label'))
	value = K0[material.label] if isinstance(K0, dict) else K0
	if not _isNumber(value): raise TypeError(f'geostatic: K0 = {brief(value)} must be a number, the ratio of horizontal to vertical stress, or a dict of them')
	if not (math.isfinite(value) and value >= 0): raise ValueError(f'geostatic: K0 = {brief(value)} must be finite and >= 0')
	return value


def _weightAbove(points, axis, height, half, density, cover):
	"""Mass per area above the middle of each point [kg/m2]; *cover*: height of soil above the highest points."""
	step = 2 * half.min()
	order = np.argsort(-height, kind='stable')
	rows = np.concatenate([[0], np.cumsum(-np.diff(height[order]) > 1e-6 * step)])  # number of the row of each point, from the top
	first = np.flatnonzero(np.diff(rows, prepend=-1))
	area = np.bincount(rows, (points['volume'] / (2 * half))[order])
	level, thickness, rho = height[order][first], 2 * half[order][first], density[order][first]
	mixed = np.flatnonzero((density[order] != rho[rows]) | (np.abs(half[order] * 2 / thickness[rows] - 1) > 1e-9))
	if mixed.size:
		raise ValueError(f'geostatic: the points at the height {level[rows[mixed[0]]]} m differ in density or size; only horizontal layers are at rest')
	unequal = np.flatnonzero(np.abs(area / area[0] - 1) > 1e-9)
	if unequal.size:
		raise ValueError(
		        f'geostatic: the ground is not level: the points at the height {level[0]} m cover {area[0]} m2, those at '
		        f'{level[unequal[0]]} m cover {area[unequal[0]]} m2 (in plane strain per metre of thickness). Let gravity grow first, and then the loads: '
		        'gravityCurve = [(0, 0), (1, 1)], loadCurve = [(1, 0), (2, 1)]'
		)
	gaps = np.flatnonzero(np.abs(level[:-1] - level[1:] - (thickness[:-1] + thickness[1:]) / 2) > 1e-6 * step)
	if gaps.size: raise ValueError(f'geostatic: the ground has a gap or an overlap between the heights {level[gaps[0] + 1]} and {level[gaps[0]]} m')
	masses = rho * thickness
	above = cover * rho[0] + np.cumsum(masses) - masses / 2
	result = np.empty(len(height))
	result[order] = above[rows]
	return result
