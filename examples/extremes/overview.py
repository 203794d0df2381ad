#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the page of examples/extremes that fits on a screen and its figure, from the kept table: `examples/extremes/overview.py`."""
import math
import os
import textwrap

import page
import pages
import pictures
from axes import axes, ghosts, groups
from pages import percent, span
from pictures import plt

here = os.path.dirname(os.path.abspath(__file__))
colours = {'safe': '#88bbee', 'runs': '#eecc66', 'fails': '#994455'}
default = 'mesh-independent'


def best(rows, name, dim, ghost):
	"""The smallest error of an axis, from which on three times as much is harm."""
	return min((row['error'] for key, row in rows.items() if key[:3] == (name, dim, ghost) and page.ran(row) and not math.isnan(row['error'])), default=math.nan)


def kind(rows, name, ghost, value):
	"""The worse of two and three dimensions: 'safe', 'runs' (with cuts, or an error that is too large) or 'fails'; None where it was not run."""
	found = [(rows.get((name, dim, ghost, str(value))), best(rows, name, dim, ghost)) for dim in axes[name].dims]
	kinds = ['fails' if not page.ran(row) else 'safe' if page.safe(row, harmless) else 'runs' for row, harmless in found if row]
	return max(kinds, key=list(colours).index, default=None)


def listed():
	return [name for _, members in groups.values() for name in members]


def rangeOf(rows, name, ghost):
	"""Safe values, in two and three dimensions, joined to ranges."""
	values = [value for value in axes[name].values if kind(rows, name, ghost, value)]
	good = [str(value) for value in values if kind(rows, name, ghost, value) == 'safe']
	if len(good) == len(values): return 'all' if values else ''
	return ', '.join(page.joined([str(value) for value in values], good)) or 'none'


def beyond(rows, name):
	"""Results with the default stabilisation where a value is not safe."""
	outside = [row for key, row in rows.items() if key[0] == name and key[2] == default and kind(rows, name, default, key[3]) != 'safe']
	found = [f'error {percent(max(wrong))}' if max(wrong) < 1 else 'wrong by any factor' for wrong in [[row['error'] for row in outside if page.ran(row) and row['error'] > .05]] if wrong]
	if any(page.ran(row) and row['cuts'] > 0 for row in outside): found.append('steps cut')
	return ', '.join(found + sorted({row['failure'].partition(':')[0] for row in outside if not page.ran(row)}))


def limits(rows):
	lines = [(axes[name].title.removesuffix(' [-]'), rangeOf(rows, name, default), beyond(rows, name)) for name in listed() if rangeOf(rows, name, default) != 'all']
	return pages.table(['parameter', 'safe', 'beyond'], lines)


def picture(rows, path):
	"""For each parameter three strips from harmless to extreme; the ends of what the default stabilisation takes are written in its strip, the thick one."""
	figure, halves = plt.subplots(1, 2, figsize=(13.5, 9.2), layout='constrained')
	names = listed()
	half = math.ceil(len(names) / 2)
	for panel, some in zip(halves, (names[:half], names[half:])):
		for y, name in enumerate(some):
			for ghost, top, height in ('none', -.4, .18), (default, -.2, .4), ('paper', .22, .18): strip(panel, rows, name, ghost, y + top, height)
		panel.set(xlim=(0, 1), ylim=(half - .4, -.6))
		panel.set_yticks(range(len(some)), [textwrap.fill(axes[name].title.removesuffix(' [-]'), 46) for name in some], fontsize=7.5)
		panel.set_xticks([0, 1], ['harmless', 'extreme'], fontsize=8)
		panel.tick_params(length=0)
		panel.spines[:].set_visible(False)
	figure.legend(handles=[plt.Rectangle((0, 0), 1, 1, color=colour, label=label) for colour, label in zip(colours.values(), ('safe', 'runs, but wrong or with cuts', 'does not run'))]
	              + [plt.Rectangle((0, 0), 0, 0, alpha=0, label='strips: no ghost, ghost h¹ (the default; thick), ghost h³')], loc='lower center', bbox_to_anchor=(.5, 1), ncols=4, fontsize=9, frameon=False)
	pictures.save(figure, path)


def strip(panel, rows, name, ghost, top, height):
	values = axes[name].values
	kinds = [kind(rows, name, ghost, value) for value in values]
	for i, (value, found) in enumerate(zip(values, kinds)):
		if not found: continue
		panel.add_patch(plt.Rectangle((i / len(values), top), 1 / len(values), height, facecolor=colours[found], edgecolor='w', linewidth=.5))
		isEnd = i in (0, len(values) - 1) or found == 'safe' and 'safe' != kinds[i + 1] or found == 'safe' != kinds[i - 1]
		if ghost == default and isEnd: panel.text((i + .5) / len(values), top + height / 2, pictures.short(value), ha='center', va='center', fontsize=6.5, color='w' if found == 'fails' else 'k')


def compared(rows):
	"""Number of parameters that were driven to extremes with all three choices; by choice, those that are safe throughout and the part of cases that do not run."""
	names = [name for name in listed() if axes[name].ghosts == ghosts]
	safe = {ghost: sum(rangeOf(rows, name, ghost) == 'all' for name in names) for ghost in ghosts}
	failed = {ghost: [not page.ran(row) for key, row in rows.items() if key[0] in names and key[2] == ghost] for ghost in ghosts}
	return len(names), safe, {ghost: sum(some) / len(some) for ghost, some in failed.items()}


def introduction(rows):
	return f'''# Stability at the extremes

How far can a parameter go before the method breaks down? `scripts/extremes` drives {len(listed())} parameters to extremes in {len(rows):,} cases, in 2D and 3D: without ghost stabilisation, with it (mesh-independent, h¹), and as in the paper (h³). Safe: no step is cut, and the error is at most 5 %, or three times the smallest ([all cases](../../plugin/docs/studies/extremes.md)).

## Run it

    scripts/extremes points turns --quick        # some parameters, few values; all: none named
'''


def text(rows):
	at = lambda name, value, dim=2, ghost=default: rows[name, dim, ghost, value]
	error = lambda *case, **more: percent(at(*case, **more)['error'])
	through = lambda name, ghost: [page.ran(row) for key, row in rows.items() if key[0] == name and key[2] == ghost]
	count, safe, failed = compared(rows)
	columns = {key[3].split('/')[1]: row for key, row in rows.items() if key[0] == 'columnFactor' and key[3].startswith('8/')}
	solves = [row['meanIterations'] for factor, row in columns.items() if float(factor) >= 1e-4]
	kept = [f"{at('softeningGrid', f'{cells}/same')['measured']:.2f}" for cells in (8, 16, 32)]
	scaled = [f"{at('softeningGrid', f'{cells}/scaled')['measured']:.2f}" for cells in (8, 16, 32)]
	return f'''**Three settings worth knowing**

1. **`MpmGhost()`, as it is** (`factor=1e-2`): of {count} parameters {safe[default]} are safe throughout; without it {safe['none']}, in the paper's scaling {safe['paper']}. Cases that do not run: {percent(failed[default])}, {percent(failed['none'])} and {percent(failed['paper'])}.
2. **2 x 2 points a cell, not one**: one has an error of {error('points', '1')} instead of {error('points', '2')} in the column ({at('points', '1', ghost='none')['failure']} without stabilisation). Pressed soil that grows aside: {at('contactClamped', '1')['failure']} (2 x 2: {error('contactClamped', '2')}).
3. **`fBar=True` for Poisson's ratios from 0.45 on**: a bent bar is off by {error('bendingFBar', '0.49')} at 0.49, {error('bendingFBar', '0.499999')} at 0.499999; without it {error('bending', '0.49')}, {error('bending', '0.499999')}. Not for yield stresses below {rangeOf(rows, 'yieldFBar', default).split()[-1]} E.

**Wrong without an error message**

- Layers of different stiffness that move through the grid: the error of stresses beside their boundary is {error('mixed', '10.0')} at a contrast of 10, {error('mixed', '100.0')} at 100. `mpm.advise` warns of it.
- A contact's `stiffness` of 10: {error('contactPenalty', '10.0')} (100: {error('contactPenalty', '100.0')}). A contact one cell wide: {error('contactRadius', '1')} (two: {error('contactRadius', '2')}). `ghost.factor=100`: {error('factor', '100.0')} (1e-2: {error('factor', '0.01')}).
- Softening with the same `hardening` on all grids: {', '.join(kept[:-1])} and {kept[-1]} of the load with 8, 16 and 32 cells; in proportion to the cells {', '.join(scaled[:-1])} and {scaled[-1]}.

**Never worth it**

- No stabilisation: a point shifted by a tenth of half its spacing is enough to fail ({at('jitter', '0.1', ghost='none')['failure']}); of {len(through('turns', 'none'))} bars that turn {sum(through('turns', 'none'))} come to their end, of {len(through('sandSlope', 'none'))} slopes of sand {sum(through('sandSlope', 'none'))} (with it {sum(through('turns', default))} and {sum(through('sandSlope', default))}).
- `scaling='paper'`: the same with cells of a metre. With cells of 100 m the error is {error('length', '100.0', ghost='paper')} (h¹: {error('length', '100.0')}); with cells of 0.1 m {sum(through('sandSlope', 'paper'))} slopes of sand come to their end.
- Another `ghost.factor`: from 1e-4 to 1 the column takes {span(solves)} solves a step, and its error is {percent(columns['0.01']['error'])} with 1e-2, {percent(columns['1']['error'])} with 1.
'''


TABLE = """**Where the default ends**; others are safe throughout ([without ghost, and as in the paper](../../plugin/docs/studies/extremes.md#safe-ranges)):
"""


def write(folder):
	rows = page.read(folder)
	picture(rows, os.path.join(folder, 'ranges.png'))
	pages.write(folder, [introduction(rows), '## Picture\n\n![How far each parameter can go](ranges.png)\n\n## Numbers\n', TABLE, limits(rows), '\n## What to change\n', text(rows)])


if __name__ == '__main__':
	write(here)
