# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of the scene in the plane of a picture."""

import numpy as np
from yade import O, Box, Facet, Sphere, Vector3, Wall


def touched(solver):
	"""Bodies that the contacts of a solver mean."""
	from yade import MpmPoint
	masks = [contact.mask for contact in solver.contacts]
	meant = lambda body: any(mask in (0, -1) or body.groupMask & mask for mask in masks)
	return [body for body in O.bodies if body.shape and not body.isClump and not isinstance(body.shape, MpmPoint) and meant(body)]


def outline(body, normal, at, limits):
	"""(M, 2) points of a line around or along the body, in the plane x[normal] = at, seen along it; none where it is not cut.

	:param limits: (low, high) corners of the picture, at which walls end
	"""
	shape, shown = body.shape, [axis for axis in (0, 1, 2) if axis != normal]
	if isinstance(shape, Sphere): return _circle(np.array(body.state.pos), shape.radius, normal, at, shown)
	if isinstance(shape, Wall): return _line(shape.axis, body.state.pos[shape.axis], normal, shown, limits)
	if isinstance(shape, Facet): return _cut(_inSpace(body, shape.vertices), [(0, 1), (1, 2), (2, 0)], normal, at)[:, shown]
	if not isinstance(shape, Box): return np.empty((0, 2))
	signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
	edges = [(i, j) for i in range(8) for j in range(i) if np.abs(signs[i] - signs[j]).sum() == 2]
	around = _cut(_inSpace(body, signs * np.array(shape.extents)), edges, normal, at)[:, shown]
	if not len(around): return around
	away = around - around.mean(axis=0)
	around = around[np.argsort(np.arctan2(away[:, 1], away[:, 0]))]
	return np.concatenate([around, around[:1]])


def _inSpace(body, corners):
	return np.array([body.state.pos + body.state.ori * Vector3(*corner) for corner in corners])


def _circle(centre, radius, normal, at, shown):
	square = radius**2 - (centre[normal] - at)**2
	angle = np.linspace(0, 2 * np.pi, 361)
	return centre[shown] + np.sqrt(square) * np.stack([np.cos(angle), np.sin(angle)], 1) if square > 0 else np.empty((0, 2))


def _line(axis, place, normal, shown, limits):
	if axis == normal: return np.empty((0, 2))
	ends = np.array(limits, float)
	ends[:, shown.index(axis)] = place
	return ends


def _cut(corners, edges, normal, at):
	"""(M, 3) points where edges meet the plane; those that begin in it count as above."""
	above = corners[:, normal] >= at
	cut = [(i, j) for i, j in edges if above[i] != above[j]]
	if not cut: return np.empty((0, 3))
	a, b = corners[[i for i, _ in cut]], corners[[j for _, j in cut]]
	return a + ((at - a[:, normal]) / (b - a)[:, normal])[:, None] * (b - a)
