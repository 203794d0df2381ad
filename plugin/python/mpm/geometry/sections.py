# SPDX-License-Identifier: GPL-2.0-or-later
"""Boxes and triangles where a plane cuts them."""
import numpy as np

signs = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])  # signs of the corners of a box
boxEdges = np.array([(i, j) for i in range(8) for j in range(i) if np.abs(signs[i] - signs[j]).sum() == 2])
triangleSides = np.array([(0, 1), (1, 2), (2, 0)])


def cut(corners, above, edges, normal, at):
	"""(M, 2) places, seen along the axis *normal*, where the plane x[normal] = at cuts those of the edges, pairs of corners, of which one end is above it."""
	low, high = edges[above[edges[:, 0]] != above[edges[:, 1]]].T
	share = (at - corners[low, normal]) / (corners[high, normal] - corners[low, normal])
	return (corners[low] + share[:, None] * (corners[high] - corners[low]))[:, [axis for axis in (0, 1, 2) if axis != normal]]


def inOrder(points):
	"""The corners of a convex figure in order around its middle."""
	return points[np.argsort(np.arctan2(*(points - points.mean(axis=0)).T))]
