# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases and their numbers as a table."""
from math import inf

import pages
import studies


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
	found = []
	for name, (low, high) in case.bounds.items():
		value = result.get(name)
		if not isinstance(value, (int, float)) or not low <= value <= high: found.append(name)
	return found


heads = ['case', 'numbers', 'bounds', 'missed']


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


def table(cases, results, command, revision, day):
	"""All results in Markdown."""
	right = sum(not misses(cases[name], result) for name, result in results.items())
	lines = ['# Contact with rigid bodies, case by case', '', 'Written by `scripts/contacts`, whose `--help` says what the numbers are.', '']
	lines += [f'`{command}`, {day}, revision {revision}: {right} of {len(results)} cases are within their bounds.', '']
	return '\n'.join([*lines, pages.table(heads, rows(cases, results)), ''])


def keep(cases, results, revision, day, folder):
	"""Keeps a table of the study of contact in a folder of results."""
	run = f'{day}, revision {revision}'
	studies.keep(folder, 'cases.csv', 'All cases', '`scripts/contacts`, by case; the run of each row is in its last column.', [[*heads, 'run'], *([*row, run] for row in rows(cases, results))])
