# SPDX-License-Identifier: GPL-2.0-or-later
"""Stresses that are smooth, from those of the points; needs nothing of YADE."""
import itertools

import numpy as np

_leastVariance = 0.01  # least variance of the positions of a node's points [cells^2] for a gradient in that direction: below, they are one row


def smoothed(places, group, weight, values):
	"""Values that vary smoothly, at the points: at each node mean and slope of those around it, weighted by its hat, and between nodes the hats
	(O.C. Zienkiewicz, J.Z. Zhu 1992, https://doi.org/10.1002/nme.1620330702, with the points of the cells around a node as its patch).

	:param places: (N, dim) in cells from the origin of the grid
	:param group: (N,) whole numbers from 0; values are smoothed among points of the same
	:param weight: (N,) > 0
	:param values: (N, K)
	:return: (N, K)
	"""
	patches = list(_patches(places, group))
	size = max(node.max() for node, _, _ in patches) + 1
	dim, width = places.shape[1], values.shape[1]
	total, middle, mean = np.zeros(size), np.zeros((size, dim)), np.zeros((size, width))
	square, product = np.zeros((size, dim, dim)), np.zeros((size, dim, width))
	for node, hat, away in patches:
		add = lambda numbers: np.bincount(node, hat * weight * numbers, size)
		total += add(1.)
		for k in range(width): mean[:, k] += add(values[:, k])
		for i in range(dim):
			middle[:, i] += add(away[:, i])
			for j in range(dim): square[:, i, j] += add(away[:, i] * away[:, j])
			for k in range(width): product[:, i, k] += add(away[:, i] * values[:, k])
	total[total == 0] = 1  # points on the lines of the grid are not in the hats beside them
	middle, mean = middle / total[:, None], mean / total[:, None]
	square = square / total[:, None, None] - middle[:, :, None] * middle[:, None, :]
	product = product / total[:, None, None] - middle[:, :, None] * mean[:, None, :]
	atNode = mean - np.einsum('ni,nik->nk', middle, _slopes(square, product))
	return sum(hat[:, None] * atNode[node] for node, hat, _ in patches)


def _patches(places, group):
	"""For each corner of a cell the number of the node there (N,), its hat (N,), and where the points are from it (N, dim) [cells]."""
	cell = np.floor(places).astype(np.int64)
	corners = list(itertools.product((0, 1), repeat=places.shape[1]))
	low, extent = cell.min(axis=0), np.ptp(cell, axis=0) + 2
	if group.max() + 1. > 2.**62 / np.prod(extent.astype(float)): raise ValueError(f'points are spread over {extent.tolist()} cells, which are more than can be numbered')
	codes = [np.ravel_multi_index(tuple((cell - low + corner).T), extent) * (group.max() + 1) + group for corner in corners]
	used = np.unique(np.concatenate(codes))
	for corner, code in zip(corners, codes):
		away = places - cell - corner
		yield np.searchsorted(used, code), np.prod(1 - np.abs(away), axis=1), away


def _slopes(square, product):
	"""Least squares (M, dim, K), flat in directions along which the points of a node do not vary."""
	variance, axes = np.linalg.eigh(square)
	inverse = np.where(variance > _leastVariance, 1 / np.maximum(variance, _leastVariance), 0)
	return np.einsum('nij,nj,nkj,nkl->nil', axes, inverse, axes, product)
