# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of the scene in the plane of a picture."""

import numpy as np
from yade import Body, O, Box, Facet, GridConnection, GridNode, PFacet, Sphere, Vector3, Wall

from ..library import engine
from .sections import boxEdges, cut, inOrder, signs, triangleSides


def touchable(solver):
	"""Bodies that the contacts of a solver mean."""
	return [O.bodies[number] for number in engine.touchableBodies(solver)]


def bodiesIn(given):
	"""The bodies of a list of them, or the one that is given; none if that is something else."""
	given = given if isinstance(given, (list, tuple)) else [given]
	return given if given and all(isinstance(body, Body) for body in given) else []


def cornersOf(body):
	"""(N, 3) corners of what the body fills, of a sphere those of the box around it, of a clump those of its members; None if it has no end."""
	shape = body.shape
	if body.isClump:
		found = [cornersOf(O.bodies[member]) for member in shape.members]
		return None if any(corners is None for corners in found) else np.concatenate(found)
	if isinstance(shape, (GridConnection, PFacet)): return np.concatenate([node + shape.radius * signs for node in _nodes(shape)])
	if isinstance(shape, Sphere): return np.array(body.state.pos) + shape.radius * signs
	if isinstance(shape, Box): return _inSpace(body, signs * np.array(shape.extents))
	if isinstance(shape, Facet): return _inSpace(body, shape.vertices)
	return None


def outline(body, normal, at, limits):
	"""(M, 2) points of a line around or along the body, in the plane x[normal] = at, seen along it; none where it is not cut.

	:param limits: (low, high) corners of the picture, at which walls end
	"""
	shape, shown = body.shape, [axis for axis in (0, 1, 2) if axis != normal]
	if isinstance(shape, GridNode): return np.empty((0, 2))  # its connections are
	if isinstance(shape, GridConnection): return _lineOf(*_nodes(shape), shape.radius, normal, at, shown)
	if isinstance(shape, Sphere): return _circle(np.array(body.state.pos), shape.radius, normal, at, shown)
	if isinstance(shape, Wall): return _line(shape.axis, body.state.pos[shape.axis], normal, shown, limits)
	if isinstance(shape, Facet):
		corners, edges = cornersOf(body), triangleSides
		isIn = np.abs(corners[:, normal] - at) <= 1e-9 * np.ptp(corners)
		if isIn.sum() == 2: return corners[isIn][:, shown]  # an edge in the plane, by which it is felt there
	elif isinstance(shape, PFacet): corners, edges = _nodes(shape), triangleSides
	elif isinstance(shape, Box): corners, edges = cornersOf(body), boxEdges
	else: return np.empty((0, 2))
	ends = cut(corners, corners[:, normal] >= at, edges, normal, at)
	return np.concatenate([inOrder(ends), inOrder(ends)[:1]]) if len(ends) else ends


def _nodes(shape):
	nodes = [shape.node1, shape.node2] + ([shape.node3] if isinstance(shape, PFacet) else [])
	return np.array([node.state.pos for node in nodes])


def _lineOf(first, second, radius, normal, at, shown):
	"""A cylinder that lies in the plane as its axis, one that goes through it as a circle."""
	away = np.array([first[normal], second[normal]]) - at
	if np.abs(away).max() <= radius: return np.array([first, second])[:, shown]
	if away[0] * away[1] > 0: return np.empty((0, 2))
	return _circle(first + away[0] / (away[0] - away[1]) * (second - first), radius, normal, at, shown)


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
