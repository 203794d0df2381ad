# SPDX-License-Identifier: GPL-2.0-or-later
"""Data for the rule that declares a matrix singular (plugin/core/solvers/linear_solver.cpp): the last pivot, and how well the system can be solved."""
from math import nan

import numpy as np
import scipy.linalg
import scipy.sparse

largest = 260 # unknowns: the comparison is dense, in extended precision


def measure(rows, columns, values, size):
	"""Smallest pivot of Cholesky's method, with the diagonal scaled to one, and the relative error in energy of a solution in double precision.

	:return: (pivot, error); NaN above *largest* unknowns, and (0, NaN) for a matrix that is not positive definite to working precision
	"""
	if size > largest: return nan, nan
	K = scipy.sparse.coo_matrix((values, (rows, columns)), (size, size)).toarray()
	if not (np.diag(K) > 0).all(): return 0., nan
	scale = 1 / np.sqrt(np.diag(K))
	K = scale[:, None] * K * scale
	try:
		lower = np.linalg.cholesky(K)
	except np.linalg.LinAlgError:
		return 0., nan
	load = np.random.default_rng(1).uniform(-1, 1, size) # excites the softest modes, as a load does
	reference = solveExtended(K, load)
	error = scipy.linalg.cho_solve((lower, True), load) - reference
	return float(np.diag(lower).min()**2), float(np.sqrt(abs(error @ K @ error) / abs(reference @ K @ reference)))


def solveExtended(K, load):
	"""K x = load by Cholesky's method in 80-bit numbers."""
	L = np.tril(K).astype(np.longdouble)
	n = len(L)
	for k in range(n):
		L[k, k] = np.sqrt(L[k, k])
		L[k + 1:, k] /= L[k, k]
		L[k + 1:, k + 1:] -= np.outer(L[k + 1:, k], L[k + 1:, k])
	y = load.astype(np.longdouble)
	for k in range(n):
		y[k] = (y[k] - L[k, :k] @ y[:k]) / L[k, k]
	for k in reversed(range(n)):
		y[k] = (y[k] - L[k + 1:, k] @ y[k + 1:]) / L[k, k]
	return y
