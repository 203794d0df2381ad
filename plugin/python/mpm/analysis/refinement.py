# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of a value from its results on three grids; needs nothing of YADE."""
import math


def errorOf(coarser, value, finer):
	"""Error of *value*, from itself and what cells twice and half as large give.

	An error C h^p changes by d = |C| h^p (1 - 2^-p) where h is halved (Richardson 1911, https://doi.org/10.1098/rsta.1911.0009), so it is between d and 4 d for all orders
	p from 0.415 up. 2 d is within a factor of two of all of them, whatever the order is. Where values go up and down with the cells, as bodies that cut cells at one
	place or another make them do, an error that shrinks is between d / 2 and d, and the estimate is d / sqrt(2).

	:return: estimate, in the unit of the values and >= 0; whether the values go one way; and whether d is less than three quarters of the change before (p > 0.415):
		otherwise the cells are not yet so small that there is an order
	"""
	before, change = value - coarser, finer - value
	oneWay = before * change >= 0
	return abs(change) * (2 if oneWay else math.sqrt(0.5)), oneWay, abs(change) < 0.75 * abs(before) or change == 0


def errorOfFinest(coarser, value, finer):
	"""Error of *finer*, from itself and what cells twice and four times as large give.

	Where changes shrink by q in each halving, what is left is d q / (1 - q) of the last change d; it is taken for d at least, as errorOf() does, for q of a half. Where values go up and down it
	is between 0 and d, and the estimate d / 2.

	:return: estimate, in the unit of the values and >= 0; and q, infinity where the change before was none and this is one
	"""
	before, change = value - coarser, abs(finer - value)
	shrinks = change / abs(before) if before else math.inf if change else 0.
	if before * (finer - value) < 0: return change / 2, shrinks
	return change * max(1, shrinks / (1 - shrinks) if shrinks < 0.75 else 3), shrinks
