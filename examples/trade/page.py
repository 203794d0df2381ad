# SPDX-License-Identifier: GPL-2.0-or-later
"""Page and pictures of what accuracy costs, from the tables in the folder results/."""
import csv
import math
import os
import sys

import fronts
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages
import studies
from pages import table

targets = .1, .03, .01, .003
marks = {'o': 'circle', 's': 'square', 'D': 'diamond', '^': 'triangle'}


def described(setting, plan):
	"""The parameters that this plan varies, as 'cells 4, steps 10'; those of the usual value only if they are combined."""
	shown = [name for name in setting if name in plan.together or setting[name] != plan.parameters[name]]
	return ', '.join(f'{name} {setting[name]}' for name in shown)


def picture(name, plan, runs, front, uncertainty, path):
	"""Error against time of all runs; one mark for each value of the second combined parameter, one colour for each of the first."""
	figure, axes = plt.subplots(figsize=(7.5, 5))
	names = list(plan.together)
	first = plan.together[names[0]]
	second = plan.together[names[1]] if len(names) > 1 else ['']
	usual = [run for run in fronts.comparable(runs) if all(run.setting[k] == v for k, v in plan.parameters.items() if k not in plan.together)]
	for i, a in enumerate(first):
		for j, b in enumerate(second):
			chosen = [run for run in usual if run.setting[names[0]] == a and (b == '' or run.setting[names[1]] == b)]
			label = f'{plan.words.get(names[0], names[0])}: {a}' if j == 0 else None
			axes.loglog([run.cpu for run in chosen], [run.error for run in chosen], list(marks)[j % len(marks)], color=plt.cm.viridis(i / max(1, len(first) - 1)), markersize=5, label=label)
	others = [run for run in fronts.comparable(runs) if run not in usual]
	if others: axes.loglog([run.cpu for run in others], [run.error for run in others], '+', color='0.6', markersize=5, label='other settings')
	axes.loglog([run.cpu for run in front], [run.error for run in front], 'k-', linewidth=1, label='front')
	if uncertainty > 0: axes.axhspan(axes.get_ylim()[0], uncertainty, color='0.9', label='uncertainty of the reference')
	axes.set(xlabel='processor time of the whole script [s], one thread', title=f'{name}: what accuracy costs')
	axes.set_ylabel(errorLabel(plan), fontsize=9)
	axes.grid(alpha=.3)
	axes.legend(fontsize=7, frameon=False)
	if len(second) > 1: figure.text(.5, -.01, f"marks: {plan.words.get(names[1], names[1])}: {', '.join(f'{b} {list(marks.values())[j % len(marks)]}' for j, b in enumerate(second))}", ha='center', fontsize=7)
	figure.savefig(path, dpi=120, bbox_inches='tight')
	plt.close(figure)


def errorLabel(plan):
	"""Label of the error, with its quantity."""
	what = [plan.words.get(name, name) for name in plan.errors + plan.quantities]
	return f"relative error of the {' and '.join(what)} [-]" + (',\nthe largest of them' if len(what) > 1 else '')


def section(folder, name, plan, drawn, link):
	try:
		runs, uncertainty = fronts.read(folder, name, plan)
	except fronts.NoReference as reason:
		return f'## {name}\n\n{reason}.\n'
	front = fronts.front(runs)
	if not front: return f'## {name}\n\nNo run has come to its end.\n'
	picture(name, plan, runs, front, uncertainty, os.path.join(drawn, name + '.png'))
	failed = [run for run in runs if run.failure]
	parts = [
	        f'## {name}\n', measureOf(plan, uncertainty), f'![Error against time]({link}{name}.png)\n', answers(plan, runs, uncertainty), 'The front:\n',
	        table(['error', 'time [s]', 'solves', 'memory [MiB]', 'setting'], [(f'{run.error:.2%}', f'{run.cpu:.2f}', f'{run.solves:.0f}', f'{run.memory:.0f}', described(run.setting, plan)) for run in front]) + '\n',
	        knobs(plan, runs), dominated(plan, runs, front), others(plan, runs), threads(runs)
	]
	if failed: parts.append('Did not come to an end: ' + '; '.join(f'{described(run.setting, plan)}' for run in failed) + '.\n')
	return '\n'.join(part for part in parts if part)


def measureOf(plan, uncertainty):
	measures = ', '.join(f'`{name}`' for name in plan.errors + plan.quantities)
	if not plan.quantities: return f'Error: {measures}, exact.\n'
	trust = f'; a coarser one differs from it by {uncertainty:.2%}: errors are known no better' if uncertainty > 0 else ''
	reference = ', '.join(f'{name} {value}' for name, value in plan.reference.items())
	return f'Error: the largest of {measures}, against our own run with {reference}{trust}.\n'


def answers(plan, runs, uncertainty):
	lines = []
	for target in targets:
		run = fronts.cheapest(runs, target)
		doubt = ', which is below the uncertainty of the reference' if target < uncertainty else ''
		if run: lines.append(f'- {target:.1%} error{doubt}: **{described(run.setting, plan)}**, {run.cpu:.2f} s, {run.solves:.0f} solves, {run.memory:.0f} MiB (error {run.error:.2%}).')
		else: lines.append(f'- {target:.1%} error{doubt}: none of these settings.')
	return 'The cheapest setting for\n\n' + '\n'.join(lines) + '\n'


def knobs(plan, runs):
	found = {name: fronts.moves(runs, name, values) for name, values in plan.together.items()}
	found = {name: moved for name, moved in found.items() if moved}
	if not found: return ''
	worth = {name: fronts.exponent(moved) for name, moved in found.items()}
	order = sorted(found, key=lambda name: -(worth[name] if worth[name] is not None else -math.inf))
	lines = [(name, f'{a} → {b}', pairs, f'× {error:.2f}', f'× {time:.2f}') for name in order for a, b, pairs, error, time in found[name]]
	ranking = ', then '.join(f'`{name}` (error ~ time^{-worth[name]:.2f})' for name in order if worth[name] is not None)
	return f"What buys accuracy, in this order: {ranking}. Means over pairs of runs that differ in nothing else:\n\n" + table(['knob', 'move', 'pairs', 'error', 'time'], lines) + '\n'


def dominated(plan, runs, front):
	"""Values of the combined parameters and how many of their runs are on the front."""
	lines = []
	for name, values in plan.together.items():
		tried = {value: sum(run.setting[name] == value for run in fronts.comparable(runs)) for value in values}
		never = [value for value in values if tried[value] > 2 and not any(run.setting[name] == value for run in front)]
		if never: lines.append(f"{name} {', '.join(never)}")
	return f"Never on the front: {'; '.join(lines)}.\n" if lines else ''


def others(plan, runs):
	found = fronts.alternatives(runs, plan)
	if not found: return ''
	lines = [(f'{name} {value}', ', '.join(f'{k} {v}' for k, v in centre.items()), failure.partition(' failed: ')[2] or failure or f'× {error:.3f}', '' if failure else f'× {time:.2f}', verdict(error, time, failure))
	         for name, value, centre, error, time, failure in found]
	return 'Other settings, against the usual one:\n\n' + table(['setting', 'at', 'error', 'time', ''], lines) + '\n'


def verdict(error, time, failure):
	"""In words; 2 % of the error and 30 % of the time, which it scatters by, count as equal."""
	if failure: return 'fails'
	if error > 1.02: return 'dominated' if time > .7 else 'cheaper, less accurate'
	if error < .98: return 'better' if time < 1.3 else 'dearer, more accurate'
	return 'dearer, no gain' if time > 1.3 else 'cheaper at no loss' if time < .7 else 'no difference'


def threads(runs):
	found = []
	for run in runs:
		alone = next((one for one in runs if one.setting == run.setting | {'threads': '1'}), None)
		if run.setting.get('threads', '1') != '1' and alone and not run.failure: found.append(f"{run.setting['threads']} threads take {run.wall:.2f} s instead of {alone.wall:.2f} s")
	return f"Wall-clock time: {'; '.join(found)}.\n" if found else ''


def estimates(folder):
	"""Estimates of mpm.advise for scenes, and the measured values."""
	with open(os.path.join(folder, 'results', 'estimates.csv'), newline='') as file:
		rows = [row for row in csv.DictReader(file) if not row['failure']]
	lines, within, inRange = [], 0, 0
	for row in rows:
		time = {name: 1e3 * float(row[name]) for name in ('fastest', 'usual', 'slowest', 'measuredTime')}
		memory = [float(row[name]) / 2**20 for name in ('estimatedMemory', 'measuredMemory')]
		ratio, isInRange = fronts.judged(row)
		within += .5 <= ratio <= 2
		inRange += isInRange
		lines.append([
		        f"{row['scene'].strip(chr(39))} {row['dim']}D, {row['cells']} cells, {row['pointsPerCell']} points, {row['steps']} steps", row['unknowns'],
		        f"{time['usual']:.3g} ({time['fastest']:.3g} to {time['slowest']:.3g})", f"{time['measuredTime']:.3g}", f'{ratio:.2f}',
		        f'{memory[0]:.1f}', f'{memory[1]:.1f}'
		])
	heads = ['scene', 'unknowns', 'told: time of a step (range) [ms]', 'measured', 'ratio', 'told: memory [MiB]', 'measured']
	return ESTIMATES + table(heads, lines) + f'\n\nTimes are within a factor of 2 in {within} of {len(rows)} scenes, and inside the range that was told in {inRange}.\n'


def parts(folder, plans, drawn, link=''):
	"""A section for each scene, whose picture is drawn into a folder; link: the way to that folder."""
	found = [section(folder, name, plan, drawn, link) for name, plan in plans.items()]
	return found + ([estimates(folder)] if os.path.exists(os.path.join(folder, 'results', 'estimates.csv')) else [])


def write(folder, plans):
	"""Page of runs of one's own."""
	pages.write(folder, [INTRODUCTION, *parts(folder, plans, folder)])


def writeStudy(folder, plans, home=studies.home):
	"""Page of the kept runs."""
	pages.write(home, [studies.conclusionOf('trade'), '', *parts(folder, plans, os.path.join(home, 'trade'), 'trade/')], 'trade.md')


ESTIMATES = """## How well mpm.advise tells

`examples/trade/estimates.py` compares what `mpm.advise` says before a run with the run. Its constants were fitted to the first twelve of these scenes. The
number of unknowns is exact for the first step. The cantilever needs more solves than other elastic bodies, which nothing foretells.

"""

INTRODUCTION = """# What accuracy costs, in detail

`scripts/trade` runs a scene with many settings, each in a YADE process of its own, and writes this page (see `--help`; it does the same for a script
of yours). Times are processor times of the whole script with one thread, without YADE's start; memory comes on top of YADE's own. The runs
are in `results/`, the settings of the scenes in `plans.py`.
"""
