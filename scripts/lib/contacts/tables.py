# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases and their numbers as a table."""
from math import inf

heads = ['case', 'numbers', 'bounds', 'missed']


def text(value):
	if isinstance(value, float): return f'{value:.4g}'
	if isinstance(value, (list, tuple)): return ' '.join(map(text, value))
	return str(value)


def bound(low, high):
	"""Bounds as a phrase."""
	if low == -inf: return f'at most {high:.4g}'
	if high == inf: return f'at least {low:.4g}'
	return f'{low:.4g} ... {high:.4g}'


def misses(case, result):
	"""Names of the numbers that are not within their bounds, or are not there."""
	return [name for name, (low, high) in case.bounds.items() if not isinstance(value := result.get(name), (int, float)) or not low <= value <= high]


def rows(cases, results):
	"""Texts of all results."""
	found = []
	for name, result in results.items():
		case = cases[name]
		bounds = '; '.join(f'{n} {bound(*limits)}' for n, limits in case.bounds.items())
		missed = ', '.join(f'**{n}**' for n in misses(case, result)) or 'none'
		numbers = ', '.join(f'{n} {text(value)}' for n, value in result.items() if value != '' and n != 'why')
		if result.get('why'): numbers += ' — ' + str(result['why']).replace('|', '/')
		found.append([name, numbers, bounds, missed])
	return found
