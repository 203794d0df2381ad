#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Steady flow through a dam with a sloping face and a horizontal drain, without a grid over the dam: what dam.py is compared with. Needs NumPy and SciPy, and not YADE.

	python3 examples/water/potential_plane.py

The unknown phreatic line is a straight one in the plane of the potential and the stream function, where the flow fills a rectangle: 0 to the level H along the one axis, and the discharge q over the
conductivity along the other. There the height y is harmonic. It is 0 on the base and on the drain, and the potential itself on the phreatic line; the face, of m horizontal for 1 vertical, says that
dy/ds + m dy/dt = 0 with s along the flow and t across it. So y is found by one linear solve (bilinear elements, which become ever smaller towards the heel, where velocities are zero), and the length of
the base from the heel to the drain by the reaction there. Prints a table of discharges beside Casagrande's rule (1937): Kozeny's parabola that begins 0.3 of the horizontal length of the wetted
face before the waterline.
"""
import numpy as np
from scipy.optimize import brentq
from scipy.sparse import csr_matrix, kron, lil_matrix
from scipy.sparse.linalg import spsolve


def graded(length, elements, first):
	"""Places from 0 to *length*, the first element of about the length *first*, the next ones longer by one factor."""
	factor = brentq(lambda r: np.expm1(elements * np.log(r)) / (r - 1) * first - length, 1 + 1e-9, 5)
	x = first * np.expm1(np.arange(elements + 1) * np.log(factor)) / (factor - 1)
	return np.append(x[:-1], length)


def bothEnds(length, elements, first, last):
	"""The same, small at both ends."""
	return np.concatenate([graded(length / 2, elements, first * length), length - graded(length / 2, elements, last * length)[-2::-1]])


def inOneDimension(x):
	"""Integrals of products of slopes, of values, and of values with slopes."""
	matrices = [lil_matrix((len(x), len(x))) for _ in range(3)]
	for i, h in enumerate(np.diff(x)):
		for a in range(2):
			for b in range(2):
				for matrix, value in zip(matrices, ((1 if a == b else -1) / h, h / (3 if a == b else 6), b - .5)):
					matrix[i + a, i + b] += value
	return [matrix.tocsr() for matrix in matrices]


def baseLength(q, H, m, elements):
	"""From the heel to the drain, through which q over the conductivity flows."""
	s, t = bothEnds(H, elements, 1e-9, 1e-5) - H, bothEnds(q, elements, 1e-9, 1e-6)
	(alongS, ofS, _), (alongT, ofT, slopeT) = inOneDimension(s), inOneDimension(t)
	face = csr_matrix(([1.], ([0], [0])), shape=(len(s), len(s)))
	K = (kron(alongS, ofT) + kron(ofS, alongT) - m * kron(face, slopeT)).tocsr()
	y = np.full((len(s), len(t)), np.nan)
	y[:, 0] = 0
	y[-1, :] = 0
	y[:, -1] = -s
	free = np.isnan(y).ravel()
	y = np.nan_to_num(y).ravel()
	y[free] = spsolve(K[free][:, free].tocsc(), -(K @ y)[free])
	return -(K @ y).reshape(len(s), len(t))[:, 0].sum()


def discharge(length, H, m, elements=40):
	"""Over the conductivity [m]; *length* of the base from the heel to the drain, level *H*, face of *m* : 1."""
	return brentq(lambda q: baseLength(q, H, m, elements) - length, .05 * H, .9 * H, xtol=1e-5 * H)


def kozeny(distance, H):
	return np.hypot(distance, H) - distance


if __name__ == '__main__':
	print('slope  drain from the waterline  discharge  by Casagrande\'s rule  would fit')
	for m in .5, 1, 2, 3:
		for distance in 1, 2, 4:
			q = discharge(m + distance, 1, m)
			rule = kozeny(distance + .3 * m, 1)
			print(f'{m:5g}  {distance:19g} H    {q:.4f} k H  {rule:.4f} ({100 * (rule / q - 1):+5.1f} %)     {((1 - q * q) / (2 * q) - distance) / m:.2f}')
