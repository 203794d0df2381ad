# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and maps of the stability atlas, from the table in its folder results/."""
import math
import os
import sys

import pictures
from axes import axes, ghosts, groups

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'scripts', 'lib'))
import results
from pages import number

names = {'none': 'no ghost', 'mesh-independent': 'ghost, h¹', 'paper': 'ghost, h³'}


def read(folder):
	"""Rows of the table, numbers converted: {(axis, dim, ghost, value as in axes.py): row}."""
	rows = {}
	for row in results.read(os.path.join(folder, 'results', 'atlas.csv')):
		row = {name: number(text) for name, text in row.items()} | dict(value=row['value'], failure=row['failure'])
		rows[row['axis'], int(row['dim']), row['ghost'], row['value']] = row
	return rows


def ran(row):
	return row['failure'] == ''


def outcome(row):
	"""A cell of a table: error and most iterations of a step, or how it failed."""
	if row is None: return ''
	if not ran(row): return f"**{row['failure']}**" + (f" after {row['completed']:.0f}/{row['steps']:.0f}" if row['completed'] > 0 else '')
	error = '' if math.isnan(row['error']) else f"{row['error']:.1e}, "
	return f"{error}{row['maxIterations']:.0f}{cutsOf(row)}"


def cutsOf(row):
	return f", {row['cuts']:.0f} cuts" if row['cuts'] > 0 else ''


def columnsOf(rows, name):
	"""(dim, ghost) that the table has of an axis."""
	return [(dim, ghost) for dim in axes[name].dims for ghost in axes[name].ghosts if any((name, dim, ghost, str(v)) in rows for v in axes[name].values)]


def valuesOf(rows, name):
	return [str(v) for v in axes[name].values if any(key[0] == name and key[3] == str(v) for key in rows)]


def safe(row, harmless):
	"""It ran without cutting a step, and is not much worse than the best of its axis."""
	return row is not None and ran(row) and row['cuts'] == 0 and (math.isnan(row['error']) or row['error'] <= max(3 * harmless, 0.05))


def shown(value):
	"""1e+08 rather than 100000000.0; what cannot be written shorter as it is."""
	try:
		short = f'{float(value):g}'
		return short if float(short) == float(value) else value
	except ValueError:
		return value


def safeRange(rows, name, column):
	found = [(value, rows.get((name, *column, value))) for value in valuesOf(rows, name)]
	errors = [row['error'] for _, row in found if row and ran(row) and not math.isnan(row['error'])]
	good = [value for value, row in found if safe(row, min(errors, default=math.nan))]
	if len(good) == len(found): return 'all: ' + _run(good)
	if not good: return 'none'
	return ', '.join(joined([value for value, _ in found], good))


def joined(values, good):
	"""Neighbouring good values joined to 'first … last'."""
	runs = []
	for value in values:
		if value not in good: runs.append([])
		elif runs: runs[-1].append(value)
		else: runs = [[value]]
	return [_run(run) for run in runs if run]


def _run(values):
	return shown(values[0]) if len(values) == 1 else f'{shown(values[0])} … {shown(values[-1])}'


def outside(rows, name):
	"""Message for the user where it does not run."""
	kinds = {}
	for key, row in rows.items():
		if key[0] == name and not ran(row): kinds[row['failure']] = kinds.get(row['failure'], 0) + 1
	return '; '.join(f'{kind} ({count})' for kind, count in sorted(kinds.items(), key=lambda item: -item[1])) or 'always runs'


def cases(rows, present):
	"""Outcome of all cases, a row for each value of a parameter."""
	columns = [(dim, ghost) for dim in (2, 3) for ghost in ghosts]
	lines = [[name, shown(value), *(outcome(rows.get((name, *column, value))) for column in columns)] for name in present for value in valuesOf(rows, name)]
	return [['parameter', 'value', *(f'{dim}D, {names[ghost]}' for dim, ghost in columns)], *lines]


def factors(rows):
	"""Condition numbers, counts and errors against the ghost factor."""
	lines = [['scene', 'factor', 'κ at the start', 'largest κ of all steps', 'factor times that', 'solves a step, mean (max)', 'error']]
	for name, unit in ('columnFactor', 'column, {} cells'), ('slopeFactor', 'slope, h = 1/{} m'):
		for (axis, _, _, value), row in rows.items():
			if axis != name: continue
			cells, factor = value.split('/')
			error = '' if math.isnan(row['error']) else f"{row['error']:.2e}"
			excess = float(factor) * row['worstCondition']
			lines.append([unit.format(cells), factor, f"{row['condition']:.0f}", f"{row['worstCondition']:.2e}", f'{excess:.0f}', f"{row['meanIterations']:.2f} ({row['maxIterations']:.0f})", error])
	return lines


def bands(rows):
	"""Load of a block that softens over its limit load before, by grid and kind of softening."""
	kinds = dict(none='none', same='the same on all grids', scaled='scaled with the size of cells')
	found = {tuple(key[3].split('/')): row for key, row in rows.items() if key[0] == 'softeningGrid'}
	cells = sorted({int(n) for n, _ in found})
	return [['softening', *(f'h = 1/{n} m' for n in cells)], *([kinds[kind], *(_bandLoad(found.get((str(n), kind))) for n in cells)] for kind in kinds)]


def _bandLoad(row):
	if row is None: return ''
	return f"{row['measured']:.3f} ({row['meanIterations']:.1f}{cutsOf(row)})" if ran(row) else outcome(row)


def sandSlopes(rows):
	"""Largest displacement and iterations of slopes of sand, with a little cohesion and without."""
	found = {tuple(map(float, key[3].split('/'))): row for key, row in rows.items() if key[0] == 'sandSlope' and key[2] == 'mesh-independent'}
	lines = [['angle [degrees]', 'c = 0: moves by [mm]', 'solves a step, mean (max)', 'c = 1e-3: moves by [mm]', 'solves a step, mean (max)']]
	for slope in sorted({slope for slope, _ in found}):
		pair = [found.get((slope, cohesion)) for cohesion in (0., 1e-3)]
		lines.append([f'{slope:g}', *(text for row in pair for text in (_motion(row), '' if row is None else f"{row['meanIterations']:.1f} ({row['maxIterations']:.0f})"))])
	return lines


def _motion(row):
	if row is None: return ''
	return f"{1e3 * row['measured']:.3f}" if ran(row) else outcome(row)


def ranges(rows, present):
	lines = [['axis', 'parameter', 'dimensions', *(names[g] for g in ghosts), 'seen where it does not run (cases)']]
	for name in present:
		for dim in axes[name].dims:
			if not any(key[:2] == (name, dim) for key in rows): continue
			safe = [safeRange(rows, name, (dim, ghost)) if (dim, ghost) in columnsOf(rows, name) else '' for ghost in ghosts]
			lines.append([name, axes[name].title, f'{dim}D', *safe, outside(rows, name)])
	return lines


def draw(rows, folder):
	"""Draw maps in a folder; yields file and title of each."""
	present = [name for name in axes if any(key[0] == name for key in rows)]
	for group, (title, members) in groups.items():
		members = [axis for axis in members if axis in present and axes[axis].listed]
		if not members: continue
		pictures.outcomes(rows, title, members, os.path.join(folder, f'outcomes-{group}.png'))
		yield f'outcomes-{group}.png', f'Outcome of all cases: {title}'
	curves = [name for name in ('overlap', 'factor', 'poisson', 'contrast', 'slender', 'thin') if name in present]
	if curves:
		pictures.conditions(rows, curves, os.path.join(folder, 'condition.png'))
		yield 'condition.png', 'Condition numbers'
	if 'corner' in present:
		pictures.cornerMaps(rows, os.path.join(folder, 'corner.png'))
		yield 'corner.png', 'Condition number against both overlaps of a corner'
	pictures.pivots(rows, os.path.join(folder, 'pivots.png'))
	yield 'pivots.png', 'Smallest pivot and error of a solve'


def tables(rows, drawn):
	"""File, title, rows and note of all tables and pictures; these are drawn into a folder."""
	present = [name for name in axes if any(key[0] == name for key in rows)]
	listed = [name for name in present if axes[name].listed]
	if listed: yield 'ranges.csv', 'Safe ranges', ranges(rows, listed), RANGES
	for file, title in draw(rows, drawn): yield file, title, None
	if 'columnFactor' in present or 'slopeFactor' in present: yield 'factors.csv', 'Ghost factors', factors(rows), FACTORS
	if 'softeningGrid' in present: yield 'softening.csv', 'Softening by grid', bands(rows), BAND
	if 'sandSlope' in present: yield 'sand-slopes.csv', 'A slope of sand', sandSlopes(rows), SAND
	if listed: yield 'outcomes.csv', 'All cases', cases(rows, listed), OUTCOMES


RANGES = 'A value is safe if the analysis runs to its end without cutting a step and its error is at most 5 %, or three times the smallest of its axis. The last column is how the analysis ended outside.'
FACTORS = 'Columns shrink to half their height, the slope is that of Coombs (2023), both in 20 steps: the overlaps are whatever the motion brings.'
BAND = """A block of clay, 1 m wide and 2 m high, between smooth plates with a weak spot at its foot, shortened by 0.5 % (`scripts/extremes softeningGrid`): load at the end over the limit
load without softening and weak spot, and mean iterations (linear solves) of a step.""".replace('\n', ' ')
SAND = """Sand of 35 degrees that does not dilate, slopes of 1 m, h = 0.1 m (`scripts/extremes sandSlope`): displacement of the point that moves most, with no cohesion and with one of
1e-3 of weight times height.""".replace('\n', ' ')
OUTCOMES = """Error of the stress and the most iterations (linear solves) of a step, with the number of times a step was cut if it was; or, in bold, how the analysis ended, and after how
many steps.""".replace('\n', ' ')
