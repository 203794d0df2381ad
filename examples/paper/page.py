# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes README.md and the pictures of a folder of results: every number of ours is read from the tables in its folder results/. With --kept that page is a short one, and all tables go to a page of the studies."""
import argparse
import math
import os
import re
import sys

import numpy as np
import pictures

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages
import studies
from pages import number, table
from results import read as readTable

options = argparse.ArgumentParser(description=__doc__)
options.add_argument('--out', default='out/paper', help='folder of the results (default %(default)s)')
options.add_argument('--kept', metavar='FOLDER', help='folder for the page of the studies, paper.md, beside a short README.md')
options = options.parse_args()
folder = options.out


def read(path):
	"""Rows of a table as dictionaries; an empty list if there is no such table."""
	return readTable(path, number)


def results(name):
	return read(os.path.join(folder, 'results', name + '.csv'))


def inFolder(name):
	return os.path.join(folder, name)


def kappa(value):
	return f'{value:.4g}' if value <= 1e14 else '> 1e14'


def figure2():
	rows = sorted(results('fig2'), key=lambda row: row['offset'])
	if not rows: return ''
	pictures.conditionNumbers(rows, inFolder('fig2.png'))
	reference = {row['a']: row for row in read(os.path.join(here, '../../tests/data/fig2.csv'))}
	columns = {'mpm': 'cond_mpm', 'gimp': 'cond_gimp', 'ghost': 'cond_gimp_ghost'}
	difference = {ours: max(abs(row[ours] / reference[row['offset']][theirs] - 1) for row in rows) for ours, theirs in columns.items()}
	largest = {name: max(row[name] for row in rows) for name in columns}
	edges = sorted(results('fig2-edges'), key=lambda row: -row['distance'])
	byPlace = {(row['edge'], row['distance']): row for row in edges}
	ends = [byPlace[0, d]['gimp'] for d in (1e-3, 1e-6)]
	distances = list(dict.fromkeys(row['distance'] for row in edges))
	beyond = {name: max(row[name] for row in edges) for name in columns}
	smallest = 1.5e-8 * 0.25
	return f'''### Figure 2: condition number of the stiffness matrix

{len(rows)} offsets a from 0 to 2 h, condition number of the reduced K (+ K_g with 0.01 E). The paper prints a graph; numbers come from an independent
implementation of the method ([tests/data/fig2.csv](../../tests/data/fig2.csv), 10 digits).

{table(['', 'paper', 'ours: largest at these offsets', 'largest relative difference from the reference', 'why they differ'], [
        ['MPM', 'bounded', kappa(largest['mpm']), f"{difference['mpm']:.1e}", 'digits of the reference'],
        ['GIMPM', 'to infinity at a = h and 2 h', kappa(largest['gimp']), f"{difference['gimp']:.1e}", 'digits of the reference'],
        ['GIMPM with ghost', 'bounded (section 3)', kappa(largest['ghost']), f"{difference['ghost']:.1e}", 'digits of the reference']])}

Just beyond the edges of cells, at a = n h + distance:

{table(['distance / h'] + [f'{name}, n = {edge}' for edge in (0, 1, 2) for name in ('MPM', 'GIMPM', 'with ghost')],
       [[f'{d:.0e}'] + [kappa(byPlace[edge, d][name]) for edge in (0, 1, 2) for name in ('mpm', 'gimp', 'ghost')] for d in distances])}

Without ghost stabilisation the condition number grows as distance to the power {-math.log10(ends[1] / ends[0]) / 3:.3f}; above 1e14 it is no more than round-off of the
eigenvalues. With it, {kappa(beyond['ghost'])} is the largest of all. An overlap below 1.5e-8 of a domain's half length (here below {smallest:.2g} h) does not
populate a cell, because round-off must not: there GIMPM without ghost stabilisation falls back to its value at the edge itself.
'''


def errorsByCells(rows, pointsPerCell, ghost, steps):
	"""Sorted list of (cells, error) of the runs with steps(cells) load steps."""
	return sorted((row['cells'], row['error']) for row in rows
	              if (row['pointsPerCell'], row['ghost']) == (pointsPerCell, ghost) and row['steps'] == steps(row['cells']) and not row['failure'])


def orders(series):
	"""Observed orders between neighbours of a list of (cells, error)."""
	return [math.log(e0 / e1) / math.log(n1 / n0) for (n0, e0), (n1, e1) in zip(series, series[1:])]


ghosts = {'none': 'no ghost', 'paper': 'ghost, h³ (paper)', 'mesh-independent': 'ghost, h¹'}


def errorTable(series):
	"""Errors and observed orders of several lists of (cells, error) over the same numbers of cells, by name; as far as all of them have been run."""
	cells = [n for n, error in min(series.values(), key=len)]
	columns = []
	for name, points in series.items():
		columns.append([name] + [f'{error:.4e}' for n, error in points])
		columns.append(['order', ''] + [f'{order:.2f}' for order in orders(points)])
	return table(['cells'] + [column[0] for column in columns], [[f'{n:g}'] + [column[i + 1] for column in columns] for i, n in enumerate(cells)])


def between(values):
	return f'{min(values):.2f} to {max(values):.2f}' if values else '–'


def figure4():
	rows = results('fig4')
	if not rows: return ''
	fixed = {n: {ghosts[g]: errorsByCells(rows, n, g, lambda cells: 40) for g in ghosts} for n in sorted({row['pointsPerCell'] for row in rows})}
	refined = {g: errorsByCells(rows, 2, g, lambda cells: 5 * cells) for g in ghosts}
	curves = {(g, '40 steps'): fixed[2][ghosts[g]] for g in ghosts} | {(g, 'steps refined'): series for g, series in refined.items()}
	pictures.columnErrors({name: series for name, series in curves.items() if series}, inFolder('fig4.png'))
	allOrders = [order for tables in fixed.values() for series in tables.values() for order in orders(series)]
	allRefined = [order for series in refined.values() for order in orders(series)]
	without, stabilised = ([order for tables in fixed.values() for g in names for order in orders(tables[ghosts[g]])] for names in (['none'], ['paper', 'mesh-independent']))
	coarse = [order for tables in fixed.values() for series in tables.values() for order in orders([p for p in series if p[0] <= 32])]
	parts = [f'''### Figure 4: stress error of the column

![Stress error against cells](fig4.png)

{table(['', 'paper', 'ours', 'why they differ'], [
        ['order with 40 steps, up to 32 cells', 'between 1 and 2', between(coarse), 'same'],
        ['order with 40 steps, all grids', 'between 1 and 2', between(allOrders), 'finest grids: the load steps, see below'],
        ['order, steps refined with the grid (2 x 2 points)', '–', between(allRefined), ''],
        ['order with 40 steps, with ghost', 'not degraded', f'{between(stabilised)}; without ghost {between(without)}', 'same']])}

The paper prints a graph; the errors at 8 to 64 cells (2 x 2 points) agree with independent implementations of
the method to one part in 1e6 (`tests/scene/project/test_paper.py`).
''']
	for n, series in fixed.items():
		parts.append(f'40 load steps, {n:g} x {n:g} points per cell:\n\n{errorTable(series)}\n')
	few = {'10 steps': errorsByCells(rows, 2, 'mesh-independent', lambda cells: 10), '40 steps': fixed[2][ghosts['mesh-independent']]}
	parts.append(f'''**Why the order falls on fine grids.** The strain increment of one load step has the error of linear elements: first order in h, a sawtooth over each
cell. A point that takes several steps to cross a cell averages it out. But the top of the column comes down by 26 m, in 40 steps by more than a cell a
step from {math.ceil(40 * 50 / 26)} cells on; a point that leaps over cells samples the sawtooth only once a step, and what remains is of first order in h and the smaller the
more steps there are. So with fewer steps the order falls on coarser grids already (2 x 2 points per cell, ghost, h¹):

{errorTable(few)}

and it recovers when the steps are refined together with the grid, five for each cell:

{errorTable({ghosts[g]: series for g, series in refined.items()})}
''')
	return '\n'.join(parts)


paper = {(row['table'], row['cellSize'], row['pointsPerCell'], row['factor']): row['result'] for row in read(os.path.join(here, 'published.csv'))}


def completed(row):
	return row['completed'] == row['steps']


def meanIterations(row):
	"""Mean with two digits as the paper prints it, a first pass without solve included; halves rounded up: 219 in 40 steps are 5.48."""
	return math.floor(100 * (row['meanIterations'] + 1) + 0.5 + 1e-9) / 100


def outcome(row):
	"""Outcome in the form of the paper: mean and largest number of iterations."""
	if completed(row): return f"{meanIterations(row):.2f} ({row['maxIterations'] + 1:g})"
	return f"fails after step {row['completed']:g}"


def why(row, published):
	"""Why ours differs from the paper's, by what can be told from the two."""
	if not completed(row):
		step = f"step {row['completed'] + 1:g}: {row['failure']}"
		if published.startswith('fails'): return f'both fail: note 2; {step}'
		return f"{'notes 2 and 3' if published.endswith('(20)') else 'note 2'}; {step}"
	if published.startswith('fails'): return 'note 2'
	mean, _, largest = published.strip(')').partition(' (')
	if outcome(row) == published: return 'same'
	return f"mean {meanIterations(row) - float(mean):+.2f}, largest {row['maxIterations'] + 1 - float(largest):+g}: note 1"


slopeKey = ('cellSize', 'pointsPerCell', 'factor')
slopes = [row for row in results('slope') if row['lineSearchTrials'] == 0] # Newton's method as in the paper


def published(number, row):
	return paper[(number, *(row[k] for k in slopeKey))]


def slopeTable(number, rows, more=lambda row: {}):
	"""Rows of table 1 or 2; *more* gives further columns by name."""
	columns = [{
	        'h [m]': f"{row['cellSize']:g}",
	        'points per cell': f"{row['pointsPerCell']:g}²",
	        'points': f"{row['points']:g}",
	        'ghost factor': f"{row['factor']:g}",
	        'paper': published(number, row),
	        'ours': outcome(row),
	        'why they differ': why(row, published(number, row)),
	        **more(row),
	        'load steps': f"{row['completed']:g} of {row['steps']:g}",
	        'largest displacement [m]': f"{row['displacement']:.4f}",
	        'stress oscillation along B-C': f"{row['oscillation']:.3f}"
	} for row in rows]
	return table(list(columns[0]), [column.values() for column in columns])


def table1():
	rows = [row for row in slopes if row['factor'] in (0, 0.01)]
	if not rows: return ''
	rows.sort(key=lambda row: (row['factor'], -row['cellSize'], row['pointsPerCell']))
	stabilised = [row for row in rows if row['factor'] > 0]
	good = [row for row in stabilised if completed(row) and row['maxIterations'] <= 20]
	return f'''### Table 1: iterations of the slope

Mean and largest number of Newton-Raphson iterations of a load step, counted as in the paper: linear solves, and one first pass without solve. As in the
paper no step is cut, there is no line search, and 20 solves are allowed. With ghost stabilisation {len(good)} of {len(stabilised)} runs complete within 20 iterations a step.
(Stress oscillation: see figures 6 and 7; displacement and oscillation are those of the last converged step.)

{slopeTable(1, rows)}

1. Not printed in the paper, and each moves the count: the norm in the convergence check (the paper's code keeps held nodes in it), what counts as the edge of the
   body where the paper's finite mesh ends (our grid has no end), and the tangent of points that lie on the yield surface to round-off. Independent
   implementations of the method count near 5.3 at h = 0.5 m, as ours does. Counts are that sensitive: see the table below, where the tolerance stands for a norm that
   is two or three times as strict.
2. Without enough ghost stabilisation some systems are singular to working precision. Which, and what comes out, depends on round-off, so on compiler, libraries and
   machine: these rows are a report and no criterion. The plugin refuses to solve a system that is singular to working precision; MATLAB, in which
   the paper's code runs, solves it with a warning.
3. The paper went on after a step that had not converged in 20 iterations. Here such a step is a failure, and the scene stays at the last converged one.
{toleranceTable()}'''


def toleranceTable():
	"""Effect of a stricter norm on the iterations with ghost stabilisation."""
	cell = {(row['cellSize'], row['pointsPerCell'], row['tolerance']): outcome(row | dict(completed=1, steps=1)) for row in results('table1-tolerance')}
	if not cell: return ''
	cases = sorted({key[:2] for key in cell}, key=lambda case: (-case[0], case[1]))
	tolerances = sorted({key[2] for key in cell}, reverse=True)
	return f'''
Iterations with ghost stabilisation at other tolerances:

{table(['h [m]', 'points per cell', 'paper, 1e-06'] + [f'ours, {tolerance:.0e}' for tolerance in tolerances],
       [[f'{h:g}', f'{n:g}²', paper[1, h, n, 0.01]] + [cell[h, n, tolerance] for tolerance in tolerances] for h, n in cases])}
'''


def table2():
	rows = sorted((row for row in slopes if (2, *(row[k] for k in slopeKey)) in paper), key=lambda row: row['factor'])
	if not rows: return ''
	withLineSearch = {tuple(row[k] for k in slopeKey): row for row in results('slope') if row['lineSearchTrials'] == 5}

	def lineSearch(row):
		other = withLineSearch.get(tuple(row[k] for k in slopeKey))
		return {'ours with line search': outcome(other) if other else ''}

	return f'''### Table 2: strength of the ghost stabilisation

h = 1 m, 3 x 3 points per cell; notes as for table 1. Beside it the same with the plugin's line search, which is on by default (`MpmNewton.lineSearchTrials=5`).

{slopeTable(2, rows, lineSearch)}
'''


def figures67():
	rows = [row for row in slopes if row['pointsPerCell'] == 4 and row['factor'] in (0, 0.01)]
	finest = min((row['cellSize'] for row in rows), default=None)
	runs = {'none' if row['factor'] == 0 else 'ghost': row for row in rows if row['cellSize'] == finest}
	if not runs: return ''
	history = {name: [row for row in results('slope-steps') if row['lineSearchTrials'] == 0 and all(row[k] == run[k] for k in slopeKey)] for name, run in runs.items()}
	files = {name: os.path.join(folder, 'states', f'slope-{finest:g}-4-{run["factor"]:g}-0.npz') for name, run in runs.items()}
	states = {name: np.load(path) for name, path in files.items() if os.path.exists(path)} # without them the pictures stay as they are
	figures = {'none': (6, 'without'), 'ghost': (7, 'with')}
	steps = next(iter(runs.values()))['steps']
	for name, state in states.items():
		number, kind = figures[name]
		at = f"load factor {runs[name]['completed'] / steps:g} (step {runs[name]['completed']:g} of {steps:g})"
		pictures.deformedSlope(state, f'Shear stress {kind} ghost stabilisation at {at}\nh = {finest:g} m, 4 x 4 points per cell', inFolder(f'fig{number}.png'))
	pictures.oscillation(history, steps, inFolder('oscillation.png'))
	text = f'''### Figures 6 and 7: shear stress in the deformed slope

h = {finest:g} m, 4 x 4 points per cell, without and with ghost stabilisation (factor 0.01), same colours for the same stress.
'''
	for name, run in runs.items():
		number, kind = figures[name]
		text += f"\n![Figure {number}](fig{number}.png)\n"
		if not completed(run): text += f"\n{kind.capitalize()} ghost stabilisation load step {run['completed'] + 1:g} fails: {run['failure']}. The picture shows the last converged state.\n"
	if len(runs) == 2:
		step = int(min(run['completed'] for run in runs.values()))
		if len(states) == 2: pictures.faceStress(states, step, steps, inFolder('face.png'))
		text += oscillationText(history, step)
	return text


def oscillationText(history, step):
	at = {name: rows[step - 1]['oscillation'] for name, rows in history.items()}
	mean = {name: np.mean([row['oscillation'] for row in rows[:step]]) for name, rows in history.items()}
	worst = {name: max(row['oscillation'] for row in rows[:step]) for name, rows in history.items()}
	end = {name: f"{rows[-1]['oscillation']:.4f} (step {rows[-1]['step']:g})" for name, rows in history.items()}
	return f'''
**Stress oscillation along B-C**, of the points that started within one cell of the face and above the weak layer: RMS of the deviation of sigma_xy from a local
linear fit (moving least squares over the points of this layer, weight (1 - (r / 2h)²)², initial positions), over the RMS of sigma_xy.

{table(['', 'paper', 'without ghost', 'with ghost', 'ratio'], [
        [what, 'removed (by eye)', *(f'{values[name]:.4f}' for name in ('none', 'ghost')), f"{values['none'] / values['ghost']:.2f}"]
        for what, values in ((f'mean of load steps 1 to {step}, which both completed', mean), ('largest in these steps', worst), (f'load step {step}', at))]
        + [['last converged step of each (different loads)', '', end['none'], end['ghost'], '']])}

![Stress along the face](face.png)

![Stress oscillation during loading](oscillation.png)
'''


def scaling():
	rows = sorted(results('scaling'), key=lambda row: row['cellSize'])
	if not rows: return ''
	pictures.scalings(rows, inFolder('scaling.png'))
	spread = {}
	for ghost in ghosts:
		for column in 'conditionNumber', 'error':
			values = [row[column] for row in rows if row['ghost'] == ghost]
			spread[ghost, column] = max(values) / min(values)
	independent = [name for ghost, name in ghosts.items() if ghost != 'none' and spread[ghost, 'conditionNumber'] < 1.001 and spread[ghost, 'error'] < 1.001]
	cell = {(row['cellSize'], row['ghost']): row for row in rows}
	sizes = sorted({row['cellSize'] for row in rows})
	return f'''### Beyond the paper: which scaling is independent of the grid

![Condition number and column error against cell size](scaling.png)

Eq. 2 multiplies the integral over a face by gamma_k h³/3 (`scaling='paper'`), the default of the plugin by gamma_k h/3 (`scaling='mesh-independent'`).
They agree at h = 1 m. Here the same two problems at all sizes, geometry scaled with h and E unchanged, ghost factor 0.01: the block of figure 2 at its worst
offset, a = {rows[0]['offset']:g} h, and the column of section 4.1 with 16 cells, its weight scaled so that it compresses to half its height at every size.

{table(['h [m]'] + [f'condition number, {name}' for name in ghosts.values()] + [f'error, {name}' for name in ghosts.values()],
       [[f'{h:g}'] + [kappa(cell[h, g]['conditionNumber']) for g in ghosts] + [cell[h, g]['failure'] or f"{cell[h, g]['error']:.4e}" for g in ghosts] for h in sizes]
       + [['largest / smallest'] + [f'{spread[g, c]:.6g}' for c in ('conditionNumber', 'error') for g in ghosts]])}

Independent of the mesh size (largest / smallest below 1.001): {', '.join(independent) or 'none'}. With h³ the stabilisation vanishes on fine grids, where the condition number
returns to that of plain GIMPM, and on coarse ones it outweighs the material, so that both condition number and error grow. The default of the plugin is h¹.
'''


introduction = '''# The paper, side by side

Figures and tables of W.M. Coombs (2023), *A ghost-stabilised material point method for large deformation geotechnical analysis*, NUMGE 2023, are computed with this plugin. The comparison shows that the plugin has the method of the paper. Iterations are counted as in the paper: linear solves, and one first pass without solve.

## Run it

    scripts/reproduce all                   # 4 minutes
    scripts/reproduce fig2                  # the picture below: fig4, table1, table2, fig6, fig7, scaling are the others

`scripts/reproduce` writes a page with all figures and tables to `out/paper`.
'''

picture = '''## Picture

![Condition number of the stiffness matrix against the offset of a block in the grid](fig2.png)
'''

change = '''## What to change

The scripts of this folder take `--quick` for a coarse run and `--out` for another folder. The [slope](../slope/README.md) and the [column](../column/README.md) of the paper have cells, points and stabilisation of your own.
'''


def summary():
	"""Results of the paper beside ours, one line each."""
	offsets = results('fig2')
	condition = {name: kappa(max(row[name] for row in offsets)) for name in ('mpm', 'gimp', 'ghost')}
	allOrders = [order for n in (2, 4) for ghost in ghosts for order in orders([point for point in errorsByCells(results('fig4'), n, ghost, lambda cells: 40) if point[0] <= 32])]
	stabilised, plain = ([row for row in slopes if row['factor'] == factor and (1, *(row[k] for k in slopeKey)) in paper] for factor in (0.01, 0))
	ended = lambda rows: f'{sum(map(completed, rows))} of {len(rows)} complete'
	printed = lambda rows: f"{sum(not published(1, row).startswith('fails') for row in rows)} of {len(rows)} complete"
	factors = [row['factor'] for row in slopes if (2, *(row[k] for k in slopeKey)) in paper and completed(row)]
	ratios = {name: np.mean([row['oscillation'] for row in rows]) for name, rows in oscillations().items()}
	scaled = {ghost: [row['conditionNumber'] for row in results('scaling') if row['ghost'] == ghost] for ghost in ghosts}
	spread = {ghost: max(values) / min(values) for ghost, values in scaled.items()}
	return table(['', 'paper', 'ours'], [
	        ['figure 2: largest condition number, MPM, GIMPM, GIMPM with ghost', 'bounded, unbounded, bounded', f"{condition['mpm']}, {condition['gimp']}, {condition['ghost']}"],
	        ['figure 4: order of the stress error of the column, up to 32 cells', 'between 1 and 2', between(allOrders)],
	        ['table 1: runs of the slope with ghost stabilisation', printed(stabilised), ended(stabilised)],
	        ['table 1: the same without', printed(plain), ended(plain)],
	        ['table 2: least ghost factor with which the slope completes', '1e-08', f'{min(factors):g}'],
	        ['figures 6 and 7: stress oscillation along the face, without over with ghost', 'removed (by eye)', f"{ratios['none'] / ratios['ghost']:.2f}"],
	        ['scaling of the ghost stabilisation, cells of 1 mm to 1 km: largest over least condition number', '', f"h³ (paper) {spread['paper']:.4g}, h¹ {spread['mesh-independent']:.4g}"],
	])


def oscillations():
	"""Steps that both runs of figures 6 and 7 completed."""
	found = {}
	for name, factor in ('none', 0), ('ghost', 0.01):
		run = min((row for row in slopes if row['pointsPerCell'] == 4 and row['factor'] == factor), key=lambda row: row['cellSize'])
		found[name] = [row for row in results('slope-steps') if row['lineSearchTrials'] == 0 and all(row[k] == run[k] for k in slopeKey)]
	least = min(map(len, found.values()))
	return {name: rows[:least] for name, rows in found.items()}


def shortTable1():
	by = {tuple(row[k] for k in slopeKey): row for row in slopes}
	cases = sorted({key[:2] for key in by if (1, *key) in paper}, key=lambda case: (-case[0], case[1]))
	cells = lambda h, n: [text for factor in (0, 0.01) for text in (published(1, by[h, n, factor]), outcome(by[h, n, factor]))]
	return table(['h [m]', 'points per cell', 'paper, without', 'ours, without', 'paper, with ghost', 'ours, with ghost'], [[f'{h:g}', f'{n:g}²', *cells(h, n)] for h, n in cases])


def keptPages(sections):
	"""The short page, and that of the studies, whose links need the way from there."""
	short = [introduction, picture, '## Numbers\n', summary(), numbers, shortTable1(), notes, change]
	pages.write(folder, short)
	moved = lambda link: f'{link[1]}{os.path.relpath(os.path.join(here, link[2]), studies.home)})'
	pages.write(options.kept, [studies.conclusionOf('paper'), '', *(re.sub(r'(\]\()([^)#\s]+)\)', moved, section).replace('### ', '## ') for section in sections if section)], 'paper.md')


numbers = '''
Table 1, mean (largest) iterations of a load step of the slope:
'''

notes = '''
With ghost stabilisation all runs complete, and mean iterations differ from the paper by at most 0.22. Counts depend on details that the paper does not print, such as the norm of the residual. Without stabilisation some systems are singular to working precision, and round-off decides which runs fail. The plugin refuses such systems; MATLAB solves them with a warning.

![Figure 7](fig7.png)

The paper multiplies the ghost terms by h³. Then they vanish on fine grids and outweigh the material on coarse ones. The default of the plugin, h¹, does not depend on the cells.

[The study](../../plugin/docs/studies/paper.md) has all figures and tables.
'''

computed = [figure2(), figure4(), table1(), table2(), figures67(), scaling()]
if options.kept: keptPages(computed)
else: pages.write(folder, [section for section in [introduction, computed[0] and picture, '## Numbers\n', *computed, change] if section])
print(f'written: {inFolder("README.md")}')
