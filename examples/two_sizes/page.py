# SPDX-License-Identifier: GPL-2.0-or-later
"""Page and picture of what cells of several sizes would save, from results/runs.csv and the times kept in examples/trade; needs nothing of YADE."""
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages

titles = dict(tight='footing in a small block', footing='footing in a large block', cut='collapse of the cut', bar='bar, where it is', way='bar, along its way')


def rows(path):
	with open(path, newline='') as file:
		return [{name: pages.number(text) for name, text in row.items()} for row in csv.DictReader(file)]


def ladder(runs, scene):
	"""Runs with equal cells, from small errors to large ones."""
	return sorted((run for run in runs if run['scene'] == scene and run['choice'] == 'uniform'), key=lambda run: abs(run['error']))


def judged(runs):
	"""Runs with cells of several sizes, each with *off*, its error without luck of signs: that of its smallest cells everywhere and what the larger ones change; and with what equal
	cells of that error need over what it needs: *plane*, unknowns, and *round*, those of a body that is the section turned about its axis (of the cut: as long as needed)."""
	found = []
	for run in runs:
		equal = ladder(runs, run['scene'])
		smallest = [other for other in equal if other['cells'] == run['cells']]
		if run['choice'] == 'uniform' or not smallest: continue
		off = abs(smallest[0]['error']) + abs(run['error'] - smallest[0]['error'])
		if off > abs(equal[-1]['error']): continue
		need = lambda name: np.exp(np.interp(np.log(off), np.log([abs(other['error']) for other in equal]), np.log([other[name] for other in equal])))
		scene = 'way' if run['choice'] == 'way' else run['scene']
		found.append(run | dict(scene=scene, off=off, equal=need('unknowns'), plane=need('unknowns') / run['unknowns'], round=need('around') / run['around']))
	return found


def exponents(runs):
	"""By scene of examples/trade how the time of a solve grows with unknowns in the plane, from its largest grid and that with cells of about twice the size."""
	unknowns = {(run['scene'], run['cells']): run['unknowns'] for run in runs if run['choice'] == 'uniform'}
	found = {}
	for name, scene, chosen in (('footing', 'tight', dict(fBar=1)), ('cut', 'cut', dict(fBar=1)), ('clay', 'footing', dict(pointsPerCell=2, stiffness=100))):
		kept = [row for row in rows(os.path.join(here, '..', 'trade', 'results', name + '.csv')) if all(row[key] == value for key, value in chosen.items())]
		fine = max(kept, key=lambda row: row['cells'])
		coarse = next(row for row in kept if row['cells'] == fine['cells'] / 2)
		count = lambda row: unknowns.get((scene, row['cells'])) if name != 'clay' else 2 * (6 * row['cells'] + 1) * (5 * row['cells'] + 1)
		if not count(fine) or not count(coarse): continue
		found[name] = np.log((fine['cpu'] / fine['solves']) / (coarse['cpu'] / coarse['solves'])) / np.log(count(fine) / count(coarse))
	return found


def percent(x):
	return f'{100 * x:.2g} %'


def savings(found, exponent):
	lines = []
	for scene, title in titles.items():
		for levels in (1, 2):
			some = [run for run in found if run['scene'] == scene and run['levels'] == levels]
			if not some: continue
			best = max(some, key=lambda run: run['plane'])
			others = ', '.join(f"{name} {max(run['plane'] for run in some if run['choice'] == name):.1f}" for name in dict.fromkeys(run['choice'] for run in some))
			lines.append((title, levels, f"{best['choice']} {best['extent']:g}", f"{100 * best['smallest']:.0f} %", percent(best['off']), f"{best['unknowns']:.0f}", f"{best['equal']:.0f}",
			              f"{best['plane']:.1f}", f"{best['plane']**exponent:.1f}" if exponent else '', f"{best['round']:.1f}", others))
	return pages.table(['scene', 'halved', 'best choice', 'cells of the smallest size', 'error', 'unknowns', 'with equal cells', 'times fewer', 'times faster', 'times fewer in 3D', 'by choice'], lines)


def check(runs):
	"""Errors of equal cells, and those of the plugin in examples/trade."""
	lines = []
	for scene, kept in ('tight', 'footing'), ('cut', 'cut'):
		plugin = {row['cells']: row['error'] for row in rows(os.path.join(here, '..', 'trade', 'results', kept + '.csv')) if row['fBar'] == 1}
		both = sorted((run for run in ladder(runs, scene) if run['cells'] in plugin), key=lambda run: run['cells'])
		if not both: continue
		texts = [f"{run['cells']:.0f}" for run in both], [f"{100 * run['error']:+.1f} %" for run in both], [f"{100 * plugin[run['cells']]:+.1f} %" for run in both]
		lines.append((titles[scene], *map(', '.join, texts)))
	return pages.table(['scene', 'cells', 'here', 'the plugin, F-bar'], lines)


def picture(runs, found, path):
	figure, plots = plt.subplots(1, 4, figsize=(15, 3.8), layout='constrained')
	for axes, scene in zip(plots, ('tight', 'footing', 'cut', 'bar')):
		equal = ladder(runs, scene)
		axes.loglog([run['unknowns'] for run in equal], [100 * abs(run['error']) for run in equal], 'k.-', label='equal cells')
		for levels, colour in (1, 'tab:blue'), (2, 'tab:red'):
			for names, mark, label in ((scene, ), 'o', 'halved once' if levels == 1 else 'halved twice'), (('way', ) if scene == 'bar' else (), 'x', 'the same, along its way'):
				some = [run for run in found if run['scene'] in names and run['levels'] == levels]
				if some: axes.loglog([run['unknowns'] for run in some], [100 * run['off'] for run in some], mark, color=colour, markersize=4, label=label)
		axes.set(xlabel='unknowns', ylabel='error of the limit load [%]', title=titles[scene].removesuffix(', where it is'))
		axes.legend(frameon=False, fontsize=7)
	figure.savefig(path, dpi=110)
	plt.close(figure)


def write(folder):
	runs = rows(os.path.join(folder, 'results', 'runs.csv'))
	found, growth = judged(runs), exponents(runs)
	exponent = np.mean(list(growth.values())) if growth else None
	picture(runs, found, os.path.join(folder, 'two_sizes.png'))
	parts = [*pages.texts(os.path.join(here, 'findings.md')), '## Saving at equal error', '', savings(found, exponent), '']
	if growth: parts += ['Time of a solve of the plugin with equal cells: unknowns to the power ' + ', '.join(f'{power:.2f} ({name})' for name, power in growth.items()) + f'; the table takes {exponent:.2f}.', '']
	pages.write(folder, [*parts, '## Equal cells, here and in the plugin', '', check(runs), ''])
