# SPDX-License-Identifier: GPL-2.0-or-later
"""Run-out of matter, for studies of columns that are let go."""
import numpy as np


def front(x, area, side, face, least=0.05):
	"""End of the deposit [m]: where its depth, a mean with weights that fall to none a tenth of the shorter side away, falls below a part *least* of that side. Both are as large
	whatever the size of the cells, or grains, is; what is thinner than a twentieth is a sheet of single points that run ahead.

	:param x: places of the matter (N,) [m]
	:param area: of each, one number or (N,) [m2]
	:param side: the shorter one of the column [m]
	:param face: of the column; it is looked for from half of that on [m]
	:param least: a tenth is a cell of ten over the shorter side, the thinnest layer that such a grid resolves: in one that is thinner all nodes but those above it are held by the base
	"""
	width = 0.1 * side
	places = np.arange(0.5 * face, np.max(x) + 2 * width, 0.1 * width)
	depth = _depth(x, area, places, width)
	i = max(1, np.argmax(depth < least * side))
	return np.interp(-least * side, -depth[i - 1:i + 1], places[i - 1:i + 1])


def profile(x, area, side):
	"""Smooth depth of matter beside a plane of symmetry at x = 0, a mean with weights that fall to none three tenths of the shorter side away: places (M,) and depths (M,) [m]."""
	width = 0.3 * side
	places = np.arange(0, np.max(x) + 2 * width, 0.1 * width)
	both, areas = np.concatenate([x, -np.asarray(x)]), np.tile(np.broadcast_to(area, np.shape(x)), 2)
	return places, _depth(both, areas, places, width)


def _depth(x, area, places, width):
	order = np.argsort(x)
	x, area = x[order], np.broadcast_to(area, x.shape)[order]
	near = [(place, slice(*np.searchsorted(x, (place - width, place + width)))) for place in places]
	return np.array([(area[these] * (1 - np.abs(x[these] - place) / width)).sum() / width for place, these in near])
