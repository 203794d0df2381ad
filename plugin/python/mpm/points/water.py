# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressure of the water that an engine has, now."""
import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3


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
