# SPDX-License-Identifier: GPL-2.0-or-later
"""Strongly stretched points: drawn as dots of the same volume, as their boxes, many cells long, would cover what is not theirs."""
import numpy as np

longest = 5  # times the shortest side: beyond it a point is drawn as a dot
_around = np.linspace(0, 2 * np.pi, 13)[:-1]


def radiiOfStretched(defGrad, halfSize0, dim):
	"""(N,) radii [m] of discs or spheres with the matter of points that are stretched to more than *longest* to one, NaN of the others."""
	sides = np.linalg.svd(defGrad[:, :dim, :dim] * halfSize0[:, None, :dim], compute_uv=False)
	isNeedle = sides[:, 0] > longest * sides[:, -1]
	size = (2 * sides).prod(axis=1)
	radius = np.sqrt(size / np.pi) if dim == 2 else np.cbrt(3 / (4 * np.pi) * size)
	return np.where(isNeedle, radius, np.nan)


def discs(middles, radii):
	"""(N, 12, 2) corners around discs in the picture."""
	circle = np.stack([np.cos(_around), np.sin(_around)], 1)
	return middles[:, None, :] + radii[:, None, None] * circle


def cutSpheres(middles, radii, normal, at):
	"""Radii [m] (N,) of the circles where the plane x[normal] = at cuts spheres, NaN of those that it misses."""
	square = radii**2 - (middles[:, normal] - at)**2
	return np.sqrt(np.where(square > 0, square, np.nan))
