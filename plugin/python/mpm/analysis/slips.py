# SPDX-License-Identifier: GPL-2.0-or-later
"""Plane slips that bound the factor of safety from above, whatever the cells."""
import math

import numpy as np
from yade import wrapper

from ..points.data import parameter

_angles = np.radians(np.arange(5, 86, 2.5))
_leastDepth = 1.5  # depth of a slip [point sizes]: the surface of points is one of steps


def leastPlaneSlip(solver, points, materials, number):
	"""Least factor of safety of the plane slips of a dry slope in plane strain that only its weight loads (Coulomb 1776; Culmann 1875), with foot and inclination [rad] of its plane.

	A plane at an angle theta below a block of weight W slips at F = (c L + W cos(theta) tan(phi)) / (W sin(theta)), L its length: with c = 0 and a long slope at the angle beta this is
	tan(phi) / tan(beta), that of an infinite slope. No plane at all bears more than this (upper bound theorem), so that cells which carry more are too few.

	:return: (F, (x, y), theta), or None where no plane is judged: in space, with water, loads, contact, periodic or axisymmetric grids, and materials other than Mohr-Coulomb and Tresca
	"""
	if not _isJudged(solver, points): return None
	strength = _strengths(points, materials, number)
	if strength is None: return None
	weight = _gravityNow(solver) * np.array([material.density for material in materials])[number]
	found = [_leastTowards(side, solver, points, weight, *strength) for side in (1, -1)]
	return min((one for one in found if one), default=None)


def _isJudged(solver, points):
	grid, gravity = solver.grid, solver.gravity
	isAlone = not (solver.loads or solver.contacts or solver.water or getattr(solver, 'flow', None) or any(b.surface for b in solver.boundaries))
	isPlain = grid.dim == 2 and not grid.axisymmetric and not any(grid.period)
	return isAlone and isPlain and gravity[0] == gravity[2] == 0 and gravity[1] < 0 and not np.any(points['force'])


def _gravityNow(solver):
	curve = np.array(solver.gravityCurve or solver.loadCurve)
	return float(np.interp(wrapper.Omega().time, *curve.T)) * -solver.gravity[1]


def _strengths(points, materials, number):
	"""Cohesion [Pa] and tangent of the friction angle of all points; None where a material has another strength."""
	cohesion, friction = np.empty(len(number)), np.empty(len(number))
	for i, material in enumerate(materials):
		rows = number == i
		if isinstance(material, wrapper.MpmMohrCoulombMat):
			cohesion[rows] = parameter('cohesion', material, points, rows)
			friction[rows] = np.tan(parameter('frictionAngle', material, points, rows))
		elif isinstance(material, wrapper.MpmTrescaMat): cohesion[rows], friction[rows] = parameter('undrainedStrength', material, points, rows), 0
		else: return None
	return cohesion, friction


class _Columns:
	"""Vertical columns of points, from the foot of slopes that rise along +x (*side* 1) or -x."""

	def __init__(self, side, points, weight):
		self.x, self.y = side * points['pos'][:, 0], points['pos'][:, 1]
		half = points['halfSize']
		self.width = 2 * half[:, 0].min()
		self.left = (self.x - half[:, 0]).min()
		self.column = ((self.x - self.left) / self.width).astype(int)
		count = self.column.max() + 1
		self.top, bottom = np.full(count, -math.inf), np.full(count, math.inf)
		np.maximum.at(self.top, self.column, self.y + half[:, 1])
		np.minimum.at(bottom, self.column, self.y - half[:, 1])
		volume = np.bincount(self.column, points['volume'], count)
		self.isSolid = (volume > 0) & (np.abs(volume / (self.width * np.maximum(self.top - bottom, 1e-9 * self.width)) - 1) < 0.1)
		self.weight = np.bincount(self.column, points['volume'] * weight, count) / np.maximum(volume, 1e-300)
		self.middle = self.left + self.width * (np.arange(count) + 0.5)


def _leastTowards(side, solver, points, weight, cohesion, friction):
	columns, least = _Columns(side, points, weight), None
	feet = np.flatnonzero(columns.isSolid[:-1] & columns.isSolid[1:] & (np.diff(columns.top) > 0))
	for foot in feet:
		start = columns.left + columns.width * (foot + 1)
		for angle in _angles:
			F = _factorOf(side, solver, columns, foot, start, angle, cohesion, friction)
			if F is not None and (least is None or F < least[0]): least = F, (side * start, columns.top[foot]), angle
	return least


def _factorOf(side, solver, columns, foot, start, angle, cohesion, friction):
	"""Factor of safety of the block above a plane; None where it is no free block of some depth."""
	line = columns.top[foot] + (columns.middle[foot + 1:] - start) * math.tan(angle)
	depth = columns.top[foot + 1:] - line
	beyond = np.flatnonzero(depth <= 0)
	if not beyond.size or beyond[0] == 0: return None
	block = slice(foot + 1, foot + 1 + beyond[0])
	depth = depth[:beyond[0]]
	if depth.max() < _leastDepth * columns.width or not columns.isSolid[block].all(): return None
	end = start + columns.width * beyond[0]
	if any(_holds(box, *sorted((side * start, side * end)), columns.top[foot], columns.top[block].max()) for box in solver.boundaries): return None
	total = (columns.weight[block] * depth).sum() * columns.width
	isNear = (columns.x > start) & (columns.x < end) & (np.abs(columns.y - columns.top[foot] - (columns.x - start) * math.tan(angle)) < 1.5 * columns.width / math.cos(angle))
	if total <= 0 or not isNear.any(): return None
	length = (end - start) / math.cos(angle)
	return float((cohesion[isNear].max() * length + total * math.cos(angle) * friction[isNear].max()) / (total * math.sin(angle)))


def _holds(box, low, high, bottom, top):
	"""True if a box of constrained nodes reaches into a block."""
	return box.min[0] < high and box.max[0] > low and box.min[1] < top and box.max[1] > bottom
