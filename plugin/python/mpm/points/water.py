# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressure of the water that an engine has, now, and what the ground lets through."""
import math

import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3

from ..base.messages import brief


def pressuresOfEach(solver, positions):
	"""Pressures of each water (N,) [Pa] at positions (N, 3)."""
	return [_factor(solver, water) * _pressure(solver, water, positions) for water in solver.water]


def _factor(solver, water):
	return np.interp(wrapper.Omega().time, *np.transpose(water.curve or solver.gravityCurve or solver.loadCurve))


def _pressure(solver, water, positions):
	if water.pressure: return np.array([water.pressure(Vector3(*x)) for x in positions.tolist()])
	level = np.interp(wrapper.Omega().time, *np.transpose(water.levels)) if water.levels else water.level
	gravity = np.array(solver.gravity)
	up = -gravity / np.linalg.norm(gravity)
	return water.weight * np.maximum(0, level - positions @ up)


def conductivities(who, points, materials, number):
	"""(N, 2) horizontal and vertical conductivity of each point, its own or that of its material."""
	pairs = [material.conductivity if isinstance(material.conductivity, tuple) else (material.conductivity, math.nan) for material in materials]
	found = np.array(pairs)[number]
	for axis, name in enumerate(('conductivity', 'verticalConductivity')):
		if name in points: found[:, axis] = points[name]
	if 'conductivity' in points and 'verticalConductivity' not in points and not np.isnan(found[:, 1]).all():
		label = materials[number[np.flatnonzero(~np.isnan(found[:, 1]))[0]]].label
		raise ValueError(f'{who}: points of the material {label!r}, whose conductivity is a pair, have one of their own that is a single number: give them verticalConductivity, too')
	found[:, 1] = np.where(np.isnan(found[:, 1]), found[:, 0], found[:, 1])
	wrong = np.flatnonzero(~(found > 0).all(axis=1))
	if not len(wrong): return found
	material = materials[number[wrong[0]]]
	raise ValueError(
	        f'{who}: the material {material.label!r} has conductivity = {brief(material.conductivity)}; expected is a number > 0 [m/s], 1e-2 (gravel) to 1e-11 (clay), or a pair (horizontal, vertical)'
	)
