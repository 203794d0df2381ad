# SPDX-License-Identifier: GPL-2.0-or-later
"""Page and pictures of how well errors are estimated, from the tables in the folder results/; needs nothing of YADE."""
import math
import os
import sys

import scenes
import stresses

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(here, '..', '..', *parts) for parts in (('examples', ), ('scripts', 'lib'), ('plugin', 'python', 'mpm', 'analysis'))]
import pages
import results
import studies
from style import plt
from refinement import errorOf


def rows(folder, name):
	return results.read(os.path.join(folder, 'results', name + '.csv'))


def ladders(folder):
	"""Value and exact value by scene, and by number of cells."""
	found = {}
	for row in rows(folder, 'values'):
		found.setdefault(row['scene'], {})[int(row['cells'])] = tuple(float(row[name]) for name in ('value', 'exact'))
	return found


def answer(ladder, cells):
	"""The exact value; or that of the smallest cells with their last change once more, if they are at most a quarter of the size asked about; or None."""
	value, exact = ladder[cells]
	if not math.isnan(exact): return exact
	most = max(ladder)
	return 2 * ladder[most][0] - ladder[most // 2][0] if most >= 4 * cells else None


def judged(folder):
	"""A dict for each cell size that has been halved and doubled: relative true error, that of the estimate, what errorOf says of it, and two other estimates: *coarse*, from
	this run and one with twice the cells, as first order has it, and *order*, with the order that three grids show."""
	found = []
	for name, ladder in ladders(folder).items():
		for cells, (value, _) in sorted(ladder.items()):
			if cells % 2 or cells // 2 not in ladder or 2 * cells not in ladder: continue
			exact = answer(ladder, cells)
			if exact is None: continue
			estimate, oneWay, settled = errorOf(ladder[cells // 2][0], value, ladder[2 * cells][0])
			before, change = value - ladder[cells // 2][0], ladder[2 * cells][0] - value
			others = dict(coarse=abs(before), order=abs(change) / (1 - min(max(change / before, -1), 0.6)))
			found.append(dict(scene=name, cells=cells, true=abs(value / exact - 1), estimate=estimate / abs(exact), oneWay=oneWay, settled=settled) | {name: error / abs(exact) for name, error in others.items()})
	return found


def within(ratios, factor=2):
	return sum(1 / factor <= ratio <= factor for ratio in ratios)


def picture(cases, found, path):
	figure, both = plt.subplots(1, 2, figsize=(14, 7), layout='constrained')
	exact = [scenes.scenes[case['scene']].against != scenes.smaller for case in cases]
	for chosen, mark, label in (True, 'o', 'known answer'), (False, 's', 'answer of smaller cells'):
		some = [case for case, isExact in zip(cases, exact) if isExact == chosen]
		both[0].loglog([case['true'] for case in some], [case['estimate'] for case in some], mark, markersize=4, label=label)
	both[0].set(xlabel='true error [-]', ylabel='estimate [-]', title=f'mpm.discretisationError: {len(cases)} cases')
	for number, name in enumerate(stresses.scenes):
		some = [row for row in found if row['scene'] == name]
		if some: both[1].loglog([float(row['true']) for row in some], [float(row['estimate']) for row in some], 'os^Dv'[number // 6] + '-', markersize=5, linewidth=0.7, color=f'C{number % 6}', label=name)
	both[1].set(xlabel='true error of the stress [-]', ylabel='estimate [-]', title=f'mpm.stressError: {len(found)} cases')
	for axes in both:
		low, high = axes.get_xlim()
		axes.plot((low, high), (low, high), 'k-', linewidth=0.8)
		axes.fill_between((low, high), (low / 2, high / 2), (2 * low, 2 * high), color='0.92', label='factor of two', zorder=0)
		axes.set(xlim=(low, high))
		axes.legend(frameon=False, loc='lower right', ncols=2)
	figure.savefig(path, dpi=110)
	plt.close(figure)


def quantityTable(cases):
	lines = [['quantity', 'against', 'cells', 'true error', 'estimate', 'ratio', 'remarks']]
	for name, scene in scenes.scenes.items():
		for case in (case for case in cases if case['scene'] == name):
			ratio = case['estimate'] / case['true']
			remarks = ([] if case['oneWay'] else ['up and down']) + ([] if case['settled'] else ['not settled']) + ([] if within([ratio]) else ['**not within two**'])
			first = case is next(other for other in cases if other['scene'] == name)
			lines.append((scene.what if first else '', scene.against if first else '', case['cells'], pages.percent(case['true']), pages.percent(case['estimate']), f'{ratio:.2f}', ', '.join(remarks)))
	return lines


def stressTable(found):
	lines = [['scene', 'against', 'cells', 'true error', 'estimate', 'ratio']]
	for name, scene in stresses.scenes.items():
		some = [row for row in found if row['scene'] == name]
		if not some: continue
		numbers = [[float(row[column]) for row in some] for column in ('true', 'estimate')]
		lines.append((scene.what, scene.against, *(', '.join(texts) for texts in (
		        [row['cells'] for row in some], *([pages.percent(x) for x in column] for column in numbers), [f'{estimate / true:.2f}' for true, estimate in zip(*numbers)]))))
	return lines


def counts(cases):
	"""Number of estimates within a factor of two."""
	ratio = lambda some, name='estimate': [case[name] / case['true'] for case in some]
	known = [case for case in cases if scenes.scenes[case['scene']].against != scenes.smaller]
	isKnown = lambda case: case in known
	groups = {
	        'all': cases, 'with a known answer': known, 'with the answer of smaller cells': [case for case in cases if not isKnown(case)], 'up and down': [case for case in cases if not case['oneWay']],
	        'not settled': [case for case in cases if not case['settled']]
	}
	lines = [(name, len(some), within(ratio(some)), f'{min(ratio(some)):.2f} to {max(ratio(some)):.2f}', within(ratio(some, 'order')), within(ratio(some, 'coarse'))) for name, some in groups.items() if some]
	return [['cases', '', 'within two', 'ratios', 'with the order of three grids', 'from cells of twice the size'], *lines]


def ofStresses(found):
	"""Number of estimates of stresses within a factor of two, as a sentence."""
	of = [float(row['estimate']) / float(row['true']) for row in found]
	return f'Stresses: {within(of)} of {len(of)} within a factor of two, {within(of, 1.25)} within 1.25; ratios {min(of):.2f} to {max(of):.2f}.' if of else ''


FINDINGS = """# Errors of the cells, estimated

Two estimates tell how much the size of the cells changes a result. They are compared with the true errors of scenes whose answer is known.

## Run it

    scripts/run discretisation                            # all of them: a quarter of an hour
    scripts/run discretisation --scenes column,ring       # 2 s

## Picture

![Estimates against true errors](discretisation.png)

## Numbers

- **`mpm.stressError()`** needs one run. It compares stresses of points with smooth ones (Zienkiewicz and Zhu 1992) and also shows where they are wrong: `mpm.plot(found['points'])`. It costs one pass over the points.
- **`mpm.discretisationError(run, cellSize)`** works for any result. It runs the scene with cells of twice, once and half the size, for 3 to 7 times the cost. The estimate is twice the change by halving, 0.7 times that where values go up and down.

Both fail where layers, gaps or slip bands are narrower than a cell. They do not see errors that all grids share: load steps, size of the model, law, points a cell. [The study](../../plugin/docs/studies/discretisation.md) has all cases.
"""

CHANGE = """## What to change

`--scenes` and `--largest`, the most cells, say what is run. For a scene of your own: `mpm.stressError()` behind any run, and `mpm.discretisationError(run, cellSize)` where `run` makes the scene with the cells that it is given ([recipe](../README.md#recipes)).
"""


def write(folder):
	cases, found = judged(folder), rows(folder, 'stresses')
	if cases or found: picture(cases, found, os.path.join(folder, 'discretisation.png'))
	pages.write(folder, [FINDINGS, studies.markdown(counts(cases)), f'\n{ofStresses(found)}\n' if found else '', CHANGE])


def tables(folder):
	"""File, title, rows and note of all tables."""
	cases, found = judged(folder), rows(folder, 'stresses')
	yield 'counts.csv', 'How many', counts(cases), ofStresses(found)
	yield 'quantities.csv', 'Quantities', quantityTable(cases)
	yield 'stresses.csv', 'Stresses', stressTable(found)


if __name__ == '__main__':  # of the kept runs
	write(here)
	studies.publish('discretisation', tables(here), '')
