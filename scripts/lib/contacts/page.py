# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases and their numbers as a table."""
from math import inf


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


def table(cases, results, command, revision, day):
	"""All results in Markdown."""
	right = sum(not misses(cases[name], result) for name, result in results.items())
	lines = ['# Contact with rigid bodies, case by case', '', 'Written by `scripts/contacts`, whose `--help` says what the numbers are.', '']
	lines += [f'`{command}`, {day}, revision {revision}: {right} of {len(results)} cases are within their bounds.', '']
	lines += ['| case | numbers | bounds | missed |', '|---|---|---|---|']
	for name, result in results.items():
		case = cases[name]
		bounds = '; '.join(f'{n} {bound(*limits)}' for n, limits in case.bounds.items())
		missed = ', '.join(f'**{n}**' for n in misses(case, result)) or 'none'
		numbers = ', '.join(f'{n} {text(value)}' for n, value in result.items() if value != '' and n != 'why')
		if result.get('why'): numbers += ' — ' + str(result['why']).replace('|', '/')
		lines.append(f'| {name} | {numbers} | {bounds} | {missed} |')
	return '\n'.join(lines) + '\n'
