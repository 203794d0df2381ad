# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages and picture of what cells of several sizes would save, from results/runs.csv and the times kept in examples/trade, and of what they save in the plugin, from
results/footing.csv; needs nothing of YADE."""
import os
import sys

import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(here, '..'), os.path.join(here, '..', '..', 'scripts', 'lib')]
import pages
import results
import studies
from style import plt

titles = dict(footing='footing', tightFooting='footing, small block', cut='cut', tightCut='cut, small block', bar='bar, where it is', way='bar, along its way', tightBar='bar, small block')


def rows(path):
	return results.read(path, pages.number)


def ladder(runs, scene):
	"""Runs with equal cells, from the smallest on."""
	return sorted((run for run in runs if run['scene'] == scene and run['choice'] == 'uniform'), key=lambda run: -run['cells'])


def settled(runs):
	"""Runs with the error of the cut over the answer of its smallest cells with their last change once more: where its front has moved so far it is not quite at the limit load."""
	for scene in dict.fromkeys(run['scene'] for run in runs if run['scene'].lower().endswith('cut')):
		equal = ladder(runs, scene)
		if len(equal) < 2: continue
		last, before = (1 + run['error'] for run in equal[:2])
		runs = [run | dict(error=(1 + run['error']) / (2 * last - before) - 1) if run['scene'] == scene else run for run in runs]
	return runs


def front(equal):
	"""Runs with equal cells that no run with larger cells surpasses, from small errors on."""
	return [run for i, run in enumerate(equal) if all(abs(run['error']) < abs(other['error']) for other in equal[i + 1:])]


def needed(equal, error, name):
	"""Number of a quantity that equal cells need for an error, by powers between runs; infinite for an error below that of all of them."""
	best = front(equal)
	if not best: return np.nan
	return np.exp(np.interp(np.log(error), np.log([abs(run['error']) for run in best]), np.log([run[name] for run in best]), left=np.inf))


def judged(runs):
	"""Runs with cells of several sizes, each with *off*, its error without luck of signs: that of its smallest cells everywhere and what the larger ones change; with the unknowns that
	equal cells of that error need, in the same block, *equal*, and in the small one, *small*; and how many times fewer it has than *equal* in the plane, *plane*, and in 3D as the
	section turned about its axis (the cut: as long as needed), *round*."""
	found = []
	for run in runs:
		equal = ladder(runs, run['scene'])
		same = [other for other in equal if other['cells'] == run['cells']]
		if run['choice'] == 'uniform' or not same: continue
		off = abs(same[0]['error']) + abs(run['error'] - same[0]['error'])
		if off > max(abs(other['error']) for other in front(equal)): continue
		scene = 'way' if run['choice'] == 'way' else run['scene']
		unknowns, cells = needed(equal, off, 'unknowns'), needed(equal, off, 'around')
		small = needed(ladder(runs, 'tight' + run['scene'].title()), off, 'unknowns') if scene in ('footing', 'cut', 'bar') else np.nan
		found.append(run | dict(scene=scene, off=off, equal=unknowns, small=small, plane=unknowns / run['unknowns'], round=cells / run['around']))
	return found


def exponents(runs):
	"""Exponents of the time of a solve over unknowns in the plane, by scene of examples/trade, from its largest grid and that with cells of about twice the size."""
	unknowns = {(run['scene'], run['cells']): run['unknowns'] for run in runs if run['choice'] == 'uniform'}
	found = {}
	for name, scene, chosen in (('footing', 'tightFooting', dict(fBar=1)), ('cut', 'cut', dict(fBar=1)), ('clay', 'footing', dict(pointsPerCell=2, stiffness=100))):
		kept = [row for row in rows(os.path.join(here, '..', 'trade', 'results', name + '.csv')) if all(row[key] == value for key, value in chosen.items())]
		fine = max(kept, key=lambda row: row['cells'])
		coarse = next(row for row in kept if row['cells'] == fine['cells'] / 2)
		count = lambda row: unknowns.get((scene, row['cells'])) if name != 'clay' else 2 * (6 * row['cells'] + 1) * (5 * row['cells'] + 1)
		if not count(fine) or not count(coarse): continue
		found[name] = np.log((fine['cpu'] / fine['solves']) / (coarse['cpu'] / coarse['solves'])) / np.log(count(fine) / count(coarse))
	return found


def savings(found, exponent):
	lines = []
	for scene, title in titles.items():
		for levels in (1, 2):
			some = [run for run in found if run['scene'] == scene and run['levels'] == levels]
			if not some: continue
			best = max(some, key=lambda run: run['plane'])
			small = '' if not np.isfinite(best['small']) else f"{best['small']:.0f}"
			byDistance = max((run['plane'] for run in some if run['choice'] in ('near', 'way')), default=np.nan)
			lines.append((title, levels, f"{best['choice']} {best['extent']:g}", pages.percent(best['off']), f"{best['unknowns']:.0f}", f"{best['equal']:.0f}", small,
			              f"**{best['plane']:.1f}**", f'{byDistance:.1f}', f"{best['plane']**exponent:.1f}" if exponent else '', f"{best['round']:.1f}"))
	return [['scene', 'halved', 'best choice', 'error', 'unknowns', 'equal cells', 'equal cells, small block', 'times fewer', 'by distance', 'times faster', 'times fewer in 3D'], *lines]


def shortSavings(found):
	"""Largest saving of each scene in the plane and in 3D, by halvings."""
	lines = []
	for scene, title in titles.items():
		best = [max((run for run in found if run['scene'] == scene and run['levels'] == levels), key=lambda run: run['plane'], default=None) for levels in (1, 2)]
		if any(best): lines.append((title, *(text for run in best for text in ((pages.percent(run['off']), f"{run['plane']:.1f}", f"{run['round']:.1f}") if run else ('', '', '')))))
	return pages.table(['scene', 'halved once: error', 'times fewer', 'in 3D', 'halved twice: error', 'times fewer', 'in 3D'], lines)


def check(runs):
	"""Errors of equal cells, and those of the plugin in examples/trade."""
	lines = []
	for scene, kept in ('tightFooting', 'footing'), ('cut', 'cut'):
		plugin = {row['cells']: row['error'] for row in rows(os.path.join(here, '..', 'trade', 'results', kept + '.csv')) if row['fBar'] == 1}
		both = sorted((run for run in ladder(runs, scene) if run['cells'] in plugin), key=lambda run: run['cells'])
		if not both: continue
		texts = [f"{run['cells']:.0f}" for run in both], [f"{100 * run['error']:+.1f} %" for run in both], [f"{100 * plugin[run['cells']]:+.1f} %" for run in both]
		lines.append((titles[scene], *map(', '.join, texts)))
	return [['scene', 'cells', 'here', 'the plugin, F-bar'], *lines]


def picture(runs, found, path):
	figure, plots = plt.subplots(1, 3, figsize=(14.5, 5.5), layout='constrained')
	for axes, scene in zip(plots, ('footing', 'cut', 'bar')):
		for name, line in (scene, 'k.-'), ('tight' + scene.title(), 'k.--'):
			equal = ladder(runs, name)
			label = 'equal cells' + (', small block' if name != scene else '')
			if equal: axes.loglog([run['unknowns'] for run in equal], [100 * abs(run['error']) for run in equal], line, label=label, linewidth=0.8)
		for levels, colour in (1, 'C0'), (2, 'C3'):
			halvings = 'halved once' if levels == 1 else 'halved twice'
			for name, mark, label in (scene, 'o', halvings), ('tight' + scene.title(), '^', halvings + ', small block'), ('way', 'x', halvings + ', along its way'):
				if name == 'way' and scene != 'bar': continue
				some = [run for run in found if run['scene'] == name and run['levels'] == levels]
				if some: axes.loglog([run['unknowns'] for run in some], [100 * run['off'] for run in some], mark, color=colour, markersize=3.5, label=label)
		axes.set(xlabel='unknowns [-]', ylabel='error of the limit load [%]', title=scene)
		axes.set_ylim(top=20 * axes.get_ylim()[1])  # room for the legend
		axes.legend(frameon=False)
	figure.savefig(path, dpi=110)
	plt.close(figure)


def limitLoads(measured):
	"""Limit loads of footings with cells that are halved, beside that with equal cells, which comes first."""
	lines, equal = [], None
	for row in measured:
		isEqual = row['halvings'] == 0
		if isEqual: equal = row
		of = (('strip', 'square')[int(row['dim']) - 2], f"{row['cells']:.0f}", 'everywhere') if isEqual else ('', '', f"{row['reach']:g} B")
		beside = ('', '') if isEqual else (f"{equal['unknowns'] / row['unknowns']:.1f}", f"{100 * (row['load'] / equal['load'] - 1):+.2f} %")
		lines.append((*of, f"{row['unknowns']:.0f}", beside[0], f"{row['points']:.0f}", f"{row['load']:.4f}", beside[1], f"{row['solves']:.0f}", f"{row['seconds']:.1f}"))
	heads = ['footing', 'cells over half the width', 'smallest to', 'unknowns', 'times fewer', 'points', 'N_c', 'beside equal cells', 'solves', 'processor seconds']
	return [heads, *lines]


FOOTINGS = '*Smallest to*: how far from the edge of the footing, and below it, cells are smallest. One thread; rows of halved cells by `--equal 0 --reach 1,0.7,0.5`. The largest load within 16 load steps.'

FINDINGS = """# Gain of cells of two sizes

How many unknowns do smaller cells in a part of the grid save, with the same error of a limit load? A strip footing, a vertical cut, and a rough bar that moves through clay are compared, in undrained clay with F-bar.

## Run it

    scripts/run two_sizes                                 # all of it: 7 minutes
    scripts/run two_sizes --scenes cut --largest 20       # 10 s

## Picture

![Error against unknowns](two_sizes.png)

## Numbers

- **Make the block no larger than the failing soil first**: equal cells in a block of 1.5 B x B need a fifth of the unknowns of a large one.
- **Cells halved twice** save 4.5 to 7.7 times the unknowns in the plane, and more in 3D. With `MpmGrid.refinements` a footing in a large block has 3.8 times fewer unknowns and the same limit load to 0.04 %.
- **Cells halved once** save 2.5 to 3.1 times.

![Mean stress below the footing](footing.png)
"""

STUDY = """[The study](../../plugin/docs/studies/two_sizes.md) tells how unknowns were counted.
"""

CHANGE = """## What to change

`--scenes` and `--largest`, the most cells; `examples/two_sizes/footing.py` is the scene with the plugin, with `--cells` and `--reach` of the small ones. In a scene of your own make the block smaller first, then `MpmGrid(refinements=mpm.refinementsAt(...))`.
"""


def write(folder):
	runs = settled(rows(os.path.join(folder, 'results', 'runs.csv')))
	found, _, _ = powers(runs)
	picture(runs, found, os.path.join(folder, 'two_sizes.png'))
	pages.write(folder, [FINDINGS, shortSavings(found), '', STUDY, CHANGE])


def powers(runs):
	"""Runs with cells of several sizes, the mean power with which a solve of the plugin grows, and each by its scene."""
	growth = exponents(runs)
	return judged(runs), np.mean(list(growth.values())) if growth else None, growth


def tables(folder):
	"""File, title, rows and note of all tables."""
	measured = rows(os.path.join(folder, 'results', 'runs.csv'))
	found, exponent, growth = powers(settled(measured))
	powersOf = ', '.join(f'{power:.2f} ({name})' for name, power in growth.items())
	yield 'savings.csv', 'Saving at equal error', savings(found, exponent), f'Time of a solve of the plugin with equal cells: unknowns to the power {powersOf}; the table takes {exponent:.2f}.' if growth else ''
	yield 'equal.csv', 'Equal cells, here and in the plugin', check(measured)
	yield 'footings.csv', 'Footings of the plugin', limitLoads(rows(os.path.join(folder, 'results', 'footing.csv'))), FOOTINGS


if __name__ == '__main__':  # of the kept runs
	write(here)
	studies.publish('two_sizes', tables(here), '')
