#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cook's membrane by finite elements of nine nodes, small strains, plane strain: the reference of cook.py. Needs NumPy and SciPy, and not YADE.

	python3 examples/walls/reference.py [largest number of elements along a side]

Lift of (48, 52) over F / E. With 32, 64, 96, 128 elements: 21.9350, 21.9409, 21.9426, 21.9433 for Poisson's ratio 0.3, and 18.378, 18.450, 18.472, 18.483 for 0.4999. The
corner at (0, 44), where the stress is infinite, makes them converge slowly: ratios of successive differences, 0.41 and 0.45, lead to 21.945 and 18.51. As a check, with 0.499975
(lambda = 7500, G = 0.375), for which P. Krysl's faesor gives 16.4326 by extrapolation.
"""
import sys

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

points, weights = np.polynomial.legendre.leggauss(3)


def functions(x):
	"""Quadratic ones of -1, 0, 1 and their derivatives."""
	return np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - 0.5, -2 * x, x + 0.5])


def elements(n):
	"""Places of the nodes, and the nine nodes of each of n x n elements."""
	s, t = np.meshgrid(*2 * [np.linspace(0, 1, 2 * n + 1)], indexing='ij')
	x = np.stack([48 * s, 44 * s + t * (44 * (1 - s) + 16 * s)], -1).reshape(-1, 2)
	i, j = (2 * number.ravel() for number in np.meshgrid(np.arange(n), np.arange(n), indexing='ij'))
	return x, np.stack([(i + a) * (2 * n + 1) + j + b for a in range(3) for b in range(3)], 1)


def stiffness(x, nodes, young, poisson):
	lame, shear = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
	D = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
	K = np.zeros((len(nodes), 18, 18))
	for a in range(3):
		for b in range(3):
			(Na, da), (Nb, db) = functions(points[a]), functions(points[b])
			slopes = np.stack([np.outer(da, Nb).ravel(), np.outer(Na, db).ravel()])
			jacobian = np.einsum('kn,end->ekd', slopes, x[nodes])
			gradient = np.linalg.solve(jacobian, np.broadcast_to(slopes, (len(nodes), 2, 9)))
			B = np.zeros((len(nodes), 3, 18))
			B[:, 0, 0::2] = B[:, 2, 1::2] = gradient[:, 0]
			B[:, 1, 1::2] = B[:, 2, 0::2] = gradient[:, 1]
			K += (weights[a] * weights[b] * np.linalg.det(jacobian))[:, None, None] * np.einsum('eki,kl,elj->eij', B, D, B)
	dofs = np.stack([2 * nodes, 2 * nodes + 1], 2).reshape(len(nodes), 18)
	return coo_matrix((K.ravel(), (np.repeat(dofs, 18, 1).ravel(), np.tile(dofs, (1, 18)).ravel()))).tocsc()


def lift(n, young, poisson):
	"""Lift of the middle of the right side under a uniform shear of resultant 1."""
	x, nodes = elements(n)
	last = 2 * n * (2 * n + 1)
	force, u = np.zeros(2 * len(x)), np.zeros(2 * len(x))
	for element in range(n):
		force[2 * (last + 2 * element + np.arange(3)) + 1] += np.array([1, 4, 1]) / (6 * n)
	free = slice(2 * (2 * n + 1), None)
	u[free] = spsolve(stiffness(x, nodes, young, poisson)[free, free], force[free])
	return u[2 * (last + n) + 1]


if __name__ == '__main__':
	largest = int(sys.argv[1]) if len(sys.argv) > 1 else 64
	print('elements  nu = 0.3  0.4999   check')
	for n in (8, 16, 32, 64, 96, 128):
		if n <= largest: print(f'{n:8d}  {lift(n, 1, 0.3):.4f}  {lift(n, 1, 0.4999):.4f}  {lift(n, 0.375 * 22500.75 / 7500.375, 3750 / 7500.375 ):.4f}', flush=True)
