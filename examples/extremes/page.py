# SPDX-License-Identifier: GPL-2.0-or-later
"""Page and maps of the stability atlas, from the table in its folder results/."""
import csv
import math
import os
import sys

import pictures
from axes import axes, ghosts, groups

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages
import studies
from pages import number, table

names = {'none': 'no ghost', 'mesh-independent': 'ghost, h¹', 'paper': 'ghost, h³'}


def read(folder):
	"""Rows of the table, numbers converted: {(axis, dim, ghost, value as in axes.py): row}."""
	rows = {}
	with open(os.path.join(folder, 'results', 'atlas.csv'), newline='') as file:
		for row in csv.DictReader(file):
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


def section(rows, name):
	columns = columnsOf(rows, name)
	heads = ['value', *(f'{dim}D, {names[ghost]}' for dim, ghost in columns)]
	lines = [[shown(value), *(outcome(rows.get((name, *column, value))) for column in columns)] for value in valuesOf(rows, name)]
	return f"## `{name}`: {axes[name].title}\n\n{table(heads, lines)}\n"


def factorTable(rows):
	"""Condition numbers, counts and errors against the ghost factor."""
	lines = []
	for name, unit in ('columnFactor', 'column, {} cells'), ('slopeFactor', 'slope, h = 1/{} m'):
		for (axis, _, _, value), row in rows.items():
			if axis != name: continue
			cells, factor = value.split('/')
			error = '' if math.isnan(row['error']) else f"{row['error']:.2e}"
			excess = float(factor) * row['worstCondition']
			lines.append([unit.format(cells), factor, f"{row['condition']:.0f}", f"{row['worstCondition']:.2e}", f'{excess:.0f}', f"{row['meanIterations']:.2f} ({row['maxIterations']:.0f})", error])
	heads = ['scene', 'factor', 'κ at the start', 'largest κ of all steps', 'factor times that', 'solves a step, mean (max)', 'error']
	return FACTORS + table(heads, lines) + '\n'


def bandTable(rows):
	"""Load of a block that softens over its limit load before, by grid and kind of softening."""
	kinds = dict(none='none', same='the same on all grids', scaled='scaled with the size of cells')
	found = {tuple(key[3].split('/')): row for key, row in rows.items() if key[0] == 'softeningGrid'}
	cells = sorted({int(n) for n, _ in found})
	lines = [[kinds[kind], *(_bandLoad(found.get((str(n), kind))) for n in cells)] for kind in kinds]
	return BAND + table(['softening', *(f'h = 1/{n} m' for n in cells)], lines) + '\n'


def _bandLoad(row):
	if row is None: return ''
	return f"{row['measured']:.3f} ({row['meanIterations']:.1f}{cutsOf(row)})" if ran(row) else outcome(row)


def sandTable(rows):
	"""Largest displacement and iterations of slopes of sand, with a little cohesion and without."""
	found = {tuple(map(float, key[3].split('/'))): row for key, row in rows.items() if key[0] == 'sandSlope' and key[2] == 'mesh-independent'}
	lines = []
	for slope in sorted({slope for slope, _ in found}):
		cells = [found.get((slope, cohesion)) for cohesion in (0., 1e-3)]
		lines.append([f'{slope:g}', *(text for row in cells for text in (_motion(row), '' if row is None else f"{row['meanIterations']:.1f} ({row['maxIterations']:.0f})"))])
	return SAND + table(['angle [degrees]', 'c = 0: moves by [mm]', 'solves a step, mean (max)', 'c = 1e-3: moves by [mm]', 'solves a step, mean (max)'], lines) + '\n'


def _motion(row):
	if row is None: return ''
	return f"{1e3 * row['measured']:.3f}" if ran(row) else outcome(row)


def rangeTable(rows, present):
	lines = []
	for name in present:
		for dim in axes[name].dims:
			if not any(key[:2] == (name, dim) for key in rows): continue
			ranges = [safeRange(rows, name, (dim, ghost)) if (dim, ghost) in columnsOf(rows, name) else '' for ghost in ghosts]
			lines.append([f'`{name}`', axes[name].title, f'{dim}D', *ranges, outside(rows, name)])
	return table(['axis', 'parameter', '', *(names[g] for g in ghosts), 'seen where it does not run (cases)'], lines)


def parts(rows, drawn, link=''):
	"""Ranges, pictures, which are drawn into a folder, and all cases; link: the way to that folder."""
	present = [name for name in axes if any(key[0] == name for key in rows)]
	listed = [name for name in present if axes[name].listed]
	found = []
	if listed:
		found += [RANGES, rangeTable(rows, listed), '']
		for group, (title, members) in groups.items():
			shown = [axis for axis in members if axis in listed]
			if not shown: continue
			pictures.outcomes(rows, title, shown, os.path.join(drawn, f'outcomes-{group}.png'))
			found.append(f'![{title}: outcome of all cases]({link}outcomes-{group}.png)\n')
	curves = [name for name in ('overlap', 'factor', 'poisson', 'contrast', 'slender', 'thin') if name in present]
	if curves:
		pictures.conditions(rows, curves, os.path.join(drawn, 'condition.png'))
		found.append(f'![Condition numbers]({link}condition.png)\n')
	if 'corner' in present:
		pictures.cornerMaps(rows, os.path.join(drawn, 'corner.png'))
		found.append(f'![Condition number against both overlaps of a corner]({link}corner.png)\n')
	pictures.pivots(rows, os.path.join(drawn, 'pivots.png'))
	found.append(f'![Smallest pivot and error of a solve]({link}pivots.png)\n')
	if 'columnFactor' in present or 'slopeFactor' in present: found.append(factorTable(rows))
	if 'softeningGrid' in present: found.append(bandTable(rows))
	if 'sandSlope' in present: found.append(sandTable(rows))
	if listed: found += ['# All cases\n', OUTCOMES, *(section(rows, name) for name in listed)]
	return found


def write(folder):
	"""Page of runs of one's own."""
	pages.write(folder, [INTRODUCTION, *parts(read(folder), folder)])


def writeStudy(folder, home=studies.home):
	"""Page of the kept runs."""
	pages.write(home, [studies.conclusionOf('extremes'), '', *parts(read(folder), os.path.join(home, 'extremes'), 'extremes/')], 'extremes.md')


INTRODUCTION = """# Stability at the extremes, in detail

Each parameter below is driven to extremes until the method breaks down: without ghost stabilisation, with it (`factor=1e-2`) in its
mesh-independent scaling h¹, and in the paper's h³, in 2D and 3D. `scripts/extremes` runs all of it and writes this page (see `--help`); the scenes
are in `runs.py`, the values in `axes.py`, the numbers in `results/atlas.csv`.

Unless an axis says otherwise, the scene is an elastic column of 2 x 6 [x 2] cells of 0.1 m, 2 points per cell and axis, free at its sides, that
its own weight compresses in 5 load steps (b l0 = E / 2, Poisson's ratio 0). Its vertical stress is known from equilibrium whatever the material,
so that the error, eq. 7 of Coombs (2023), is exact. Cells of 0.1 m tell the two scalings apart: the paper's is 100 times weaker there.
"""

RANGES = """## Safe ranges

A value is safe if the analysis runs to its end without cutting a step and its error is at most 5 %, or three times the smallest of its axis. What
the user sees outside is how the analysis ended there.
"""

FACTORS = """## Which ghost factor

Columns shrink to half their height, the slope is that of Coombs (2023), both in 20 steps: the overlaps are whatever the motion brings.

"""

BAND = """## Softening depends on the grid

A block of clay, 1 m wide and 2 m high, between smooth plates with a weak spot at its foot, shortened by .5 % (`scripts/extremes softeningGrid`): load at the
end over the limit load without softening and weak spot, and mean iterations (linear solves) of a step.

"""

SAND = """## A slope of sand

Sand of 35 degrees that does not dilate, slopes of 1 m, h = 0.1 m (`scripts/extremes sandSlope`): how far the point moves that moves most, with no cohesion
and with one of 1e-3 of weight times height.

"""

OUTCOMES = """Each cell gives the error of the stress and the most iterations (linear solves) of a step, with the number of times a step was cut if it was; or, in
bold, how the analysis ended, and after how many steps.
"""
