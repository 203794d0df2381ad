# SPDX-License-Identifier: GPL-2.0-or-later
"""How far matter has run out, for studies of columns that are let go."""
import numpy as np


def front(x, area, side, face):
	"""Where the deposit ends [m]: where its depth, a mean with weights that fall to none a tenth of the shorter side away, falls below a twentieth of that side. Both are as large
	whatever the size of the cells, or grains, is; what is thinner is a sheet of single points that run ahead.

	:param x: places of the matter (N,) [m]
	:param area: of each, one number or (N,) [m2]
	:param side: the shorter one of the column [m]
	:param face: of the column; it is looked for from half of that on [m]
	"""
	order, width = np.argsort(x), 0.1 * side
	x, area = x[order], np.broadcast_to(area, x.shape)[order]
	places = np.arange(0.5 * face, x[-1] + 2 * width, 0.1 * width)
	near = [(place, slice(*np.searchsorted(x, (place - width, place + width)))) for place in places]
	depth = np.array([(area[these] * (1 - np.abs(x[these] - place) / width)).sum() / width for place, these in near])
	i = max(1, np.argmax(depth < 0.05 * side))
	return np.interp(-0.05 * side, -depth[i - 1:i + 1], places[i - 1:i + 1])
