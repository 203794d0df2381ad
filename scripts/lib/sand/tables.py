# SPDX-License-Identifier: GPL-2.0-or-later
"""The cases of scripts/sand as tables."""
from math import isnan, log2

titles = dict(
        factors='Strips over grids',
        early='Strips of one point a cell at a settlement of 0.00025 B',
        rigid='Strips in stiffer soil, at a settlement as much smaller',
        limit='One setting for N_gamma and steps, all strips',
        box='One setting for N_gamma, strips as boxes with contact',
        causes='Dependence on steps by cause, smooth, 20 degrees, one point a cell, all runs',
        parts='Load of a strip by part of the method, smooth, 20 degrees',
        steps='Load by number of steps, smooth, 20 degrees, 2 x 2 points',
        walls='Smooth walls (Rankine)',
        cuts='Condition numbers by cut')
heads = ['case', 'setting', 'grid', 'exact', 'at a quarter', 'at the end', 'last tenth', 'iterations', 'cuts', 'points', 'seconds', 'ends by']


def percent(value, exact):
	return '-' if isnan(value) else f'{100 * (value / exact - 1):+.1f} %'


def extrapolated(values):
	"""To cells of no size, from three grids of which each halves the cells of the one before: by the order that they show, where they show one from one half to two, else by the first."""
	if any(map(isnan, values)): return float('nan')
	first, second = values[1] - values[0], values[2] - values[1]
	order = log2(first / second) if first * second > 0 else 1
	order = order if .5 <= order <= 2 else 1
	return values[2] + second / (2**order - 1)


def loads(rows):
	"""Rows of one group, head first."""
	found = [heads]
	for row in rows:
		number = lambda name: float(row[name] or 'nan')
		load = lambda name: '-' if isnan(number(name)) else f"{number(name):.4g} ({percent(number(name), number('exact'))})"
		found.append([row['case'], row['with'], row['grid'], f"{number('exact'):.4g}", load('quarter'), load('whole'), load('late'), *(str(row[name]) for name in ('iterations', 'cuts', 'points', 'seconds', 'why'))])
	return found


def conditions(rows):
	"""Rows of one state, by stabilisation over the part of a cell that is filled, head first."""
	parts = list(dict.fromkeys(row['grid'] for row in rows))
	found = [['stabilisation', *parts]]
	for name in dict.fromkeys(row['with'] for row in rows):
		of = {row['grid']: row['why'] or f"{float(row['condition']):.1e}" for row in rows if row['with'] == name}
		found.append([name, *(of.get(part, '-') for part in parts)])
	return found


def extrapolations(rows):
	"""Rows of cases that were run on three grids, head first."""
	found = [['case', 'setting', 'at a quarter', 'at the end']]
	for case, points in dict.fromkeys((row['case'], row['with']) for row in rows):
		of = [row for row in rows if (row['case'], row['with']) == (case, points)]
		if len(of) != 3: continue
		ends = [extrapolated([float(row[name] or 'nan') for row in of]) for name in ('quarter', 'whole')]
		found.append([case, points, *(percent(end, float(of[0]['exact'])) for end in ends)])
	return found


def tables(rows):
	"""(file, title, rows with their head first) of all groups."""
	for group, title in titles.items():
		of = [row for row in rows if row['group'] == group]
		if not of: continue
		if group == 'cuts':
			for state in dict.fromkeys(row['case'] for row in of): yield f"cuts-{state.lower().replace(', ', '-')}.csv", f'{title}, {state}', conditions([row for row in of if row['case'] == state])
			continue
		yield f'{group}.csv', title, loads(of)
		if group in ('factors', 'limit', 'walls') and len(limits := extrapolations(of)) > 1: yield f'{group}-limit.csv', f'{title}, extrapolated to cells of no size', limits
