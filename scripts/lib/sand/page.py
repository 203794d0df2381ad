# SPDX-License-Identifier: GPL-2.0-or-later
"""The cases of scripts/sand as tables."""
from math import isnan, log2

titles = dict(
        factors='Strips over grids', early='Strips of one point per cell at a settlement of .00025 B', rigid='The same in stiffer soil, at a settlement as much smaller', limit='One setting for N_gamma and steps', causes='What the dependence on steps is made of (smooth, 20 degrees, one point per cell)', parts='What the load of a strip is made of (smooth, 20 degrees)', steps='Dependence on the number of steps (smooth, 20 degrees, 2 x 2 points)', walls='Smooth walls (Rankine)', cuts='Condition numbers by the part of a cell that is filled')


def percent(value, exact):
	return '-' if isnan(value) else f'{100 * (value / exact - 1):+.1f} %'


def extrapolated(values):
	"""To cells of no size, from three grids of which each halves the cells of the one before: by the order that they show, where they show one from one half to two, else by the first."""
	if any(map(isnan, values)): return float('nan')
	first, second = values[1] - values[0], values[2] - values[1]
	order = log2(first / second) if first * second > 0 else 1
	order = order if .5 <= order <= 2 else 1
	return values[2] + second / (2**order - 1)


def table(rows):
	"""Table of one group, in Markdown."""
	lines = ['| | | grid | exact | at a quarter | at the end | last tenth | iterations | cuts | points | seconds | |', '|---|---|---|---|---|---|---|---|---|---|---|---|']
	for row in rows:
		number = lambda name: float(row[name] or 'nan')
		load = lambda name: '-' if isnan(number(name)) else f"{number(name):.4g} ({percent(number(name), number('exact'))})"
		lines.append(f"| {row['case']} | {row['with']} | {row['grid']} | {number('exact'):.4g} | {load('quarter')} | {load('whole')} | {load('late')} | {row['iterations']} | {row['cuts']} | {row['points']} | {row['seconds']} | {row['why']} |")
	return '\n'.join(lines) + '\n'


def conditions(rows):
	"""Lines by state and stabilisation, over the part of a cell that is filled."""
	lines = []
	for state in dict.fromkeys(row['case'] for row in rows):
		of = [row for row in rows if row['case'] == state]
		parts = list(dict.fromkeys(row['grid'] for row in of))
		lines += [f"| {state} | {' | '.join(parts)} |", '|---' * (len(parts) + 1) + '|']
		for name in dict.fromkeys(row['with'] for row in of):
			found = {row['grid']: row['why'] or f"{float(row['condition']):.1e}" for row in of if row['with'] == name}
			lines.append(f"| {name} | {' | '.join(found.get(part, '-') for part in parts)} |")
		lines.append('')
	return '\n'.join(lines)


def extrapolations(rows):
	"""Table of strips that were run on three grids, in Markdown; empty if there are none."""
	lines = []
	for case, points in dict.fromkeys((row['case'], row['with']) for row in rows):
		of = [row for row in rows if (row['case'], row['with']) == (case, points)]
		if len(of) != 3: continue
		ends = [extrapolated([float(row[name] or 'nan') for row in of]) for name in ('quarter', 'whole')]
		lines.append(f"| {case} | {points} | {' | '.join(percent(end, float(of[0]['exact'])) for end in ends)} |")
	return '\n'.join(['', '| extrapolated to cells of no size | | at a quarter | at the end |', '|---|---|---|---|', *lines, '']) if lines else ''


def page(rows, command, revision, day):
	"""In Markdown, without what is said about it."""
	lines = [f'`{command}`, {day}, revision {revision}.', '']
	for group, title in titles.items():
		if of := [row for row in rows if row['group'] == group]:
			lines += [f'### {title}', '', conditions(of) if group == 'cuts' else table(of) + (extrapolations(of) if group in ('factors', 'limit', 'walls') else '')]
	return '\n'.join(lines)
