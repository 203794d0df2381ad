# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages of the functions about the values that they were given."""
import math
import os

import numpy as np


def brief(value):
	"""repr(value), on one line and shortened to what fits into a message, as the attributes of the classes are."""
	longest = 160
	text = ' '.join(repr(value).split())
	return text if len(text) <= longest else text[:longest] + '...'


def isNumber(value):
	"""True for a number of Python or NumPy; a bool is none."""
	return isinstance(value, (int, float, np.floating, np.integer)) and not isinstance(value, bool)


def numberOf(who, name, value, expected, admits=lambda value: True):
	"""A finite number that is admitted; TypeError and ValueError name the function, the argument and what is expected."""
	if not isNumber(value): raise TypeError(f'{who}: {name} = {brief(value)} must be {expected}')
	if not (math.isfinite(value) and admits(value)): raise ValueError(f'{who}: {name} = {brief(value)} must be {expected}')
	return float(value)


def numbersIn(value):
	"""Array of the numbers of a sequence; empty if there is something else in it."""
	try:
		return np.asarray(value, float)
	except (TypeError, ValueError):
		return np.empty(0)


def place(vector):
	"""The numbers of a vector in brackets, whatever the version of NumPy calls its own."""
	return str(tuple(map(float, vector)))


def pathOf(who, name, value):
	"""The path as a string; TypeError that names the function and the argument."""
	try:
		return os.fsdecode(value)
	except TypeError:
		raise TypeError(f'{who}: {name} = {brief(value)} must be a path, as in {name}="out/slope"') from None
