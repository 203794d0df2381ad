# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and pictures of what accuracy costs, from the runs in the folder results/."""
import math
import os

import fronts
import results
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt


targets = 0.1, 0.03, 0.01, 0.003
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
	axes.set_ylabel(errorLabel(plan), fontsize=11)
	axes.grid(alpha=0.3)
	axes.legend(fontsize=9, frameon=False)
	if len(second) > 1: figure.text(0.5, -0.03, f"marks: {plan.words.get(names[1], names[1])}: {', '.join(f'{b} {list(marks.values())[j % len(marks)]}' for j, b in enumerate(second))}", ha='center', fontsize=10)
	figure.savefig(path, dpi=120, bbox_inches='tight')
	plt.close(figure)


def errorLabel(plan):
	"""Label of the error, with its quantity."""
	what = [plan.words.get(name, name) for name in plan.errors + plan.quantities]
	if len(what) == 1: return f'relative error of the {what[0]} [-]'
	return 'relative error [-], the largest of\n' + ' and '.join(what)


def measureOf(plan, uncertainty):
	"""What the error of a scene is, and the uncertainty of its reference."""
	measures = ', '.join(plan.errors + plan.quantities)
	if not plan.quantities: return measures, 'exact', ''
	return measures, 'our own run with ' + ', '.join(f'{name} {value}' for name, value in plan.reference.items()), '' if math.isnan(uncertainty) else f'{100 * uncertainty:.2f} %'


def cheapest(plan, runs, uncertainty):
	"""Cheapest setting for some errors."""
	found = [fronts.cheapest(runs, target) for target in targets]
	doubt = [', uncertain' * (target < uncertainty) for target in targets]
	return [f'{described(run.setting, plan)}: {run.cpu:.2f} s{mark}' if run else 'none' for run, mark in zip(found, doubt)]


def knobs(plan, runs):
	"""Effects of the combined parameters, those that buy most accuracy first."""
	found = {name: moved for name, values in plan.together.items() if (moved := fronts.moves(runs, name, values))}
	worth = {name: fronts.exponent(moved) for name, moved in found.items()}
	for name in sorted(found, key=lambda name: -(worth[name] if worth[name] is not None else -math.inf)):
		for a, b, pairs, error, time in found[name]: yield name, '' if worth[name] is None else f'{worth[name]:.2f}', f'{a} → {b}', pairs, f'{error:.2f}', f'{time:.2f}'


def never(plan, runs, front):
	"""Values of the combined parameters that no run on the front has."""
	for name, values in plan.together.items():
		for value in values:
			if sum(run.setting[name] == value for run in fronts.comparable(runs)) > 2 and not any(run.setting[name] == value for run in front): yield f'{name} {value}'


def others(plan, runs):
	"""Other settings against the usual one."""
	for name, value, centre, error, time, failure in fronts.alternatives(runs, plan):
		at = ', '.join(f'{k} {v}' for k, v in centre.items())
		ratios = (failure.partition(' failed: ')[2] or failure, '') if failure else (f'{error:.3f}', f'{time:.2f}')
		yield f'{name} {value}', at, *ratios, verdict(error, time, failure)


def verdict(error, time, failure):
	"""In words; 2 % of the error and 30 % of the time, which it scatters by, count as equal."""
	if failure: return 'fails'
	if error > 1.02: return 'dominated' if time > 0.7 else 'cheaper, less accurate'
	if error < 0.98: return 'better' if time < 1.3 else 'dearer, more accurate'
	return 'dearer, no gain' if time > 1.3 else 'cheaper at no loss' if time < 0.7 else 'no difference'


def threads(plan, runs):
	"""Runs with several threads beside those with one."""
	for run in runs:
		alone = next((one for one in runs if one.setting == run.setting | {'threads': '1'}), None)
		if run.setting.get('threads', '1') != '1' and alone and not run.failure: yield described(run.setting, plan), f'{alone.wall:.2f}', f'{run.wall:.2f}'


def estimates(folder):
	"""Estimates of mpm.advise for scenes beside the measured values, and a sentence on them."""
	rows = [row for row in results.read(os.path.join(folder, 'results', 'estimates.csv')) if not row['failure']]
	lines, within, inRange = [['scene', 'unknowns', 'estimate: time of a step (range) [ms]', 'measured', 'ratio', 'estimate: memory [MiB]', 'measured']], 0, 0
	for row in rows:
		time = {name: 1e3 * float(row[name]) for name in ('fastest', 'usual', 'slowest', 'measuredTime')}
		memory = [f'{float(row[name]) / 2**20:.1f}' for name in ('estimatedMemory', 'measuredMemory')]
		ratio, isInRange = fronts.judged(row)
		within, inRange = within + (0.5 <= ratio <= 2), inRange + isInRange
		scene = f"{row['scene'].strip(chr(39))} {row['dim']}D, {row['cells']} cells, {row['pointsPerCell']} points, {row['steps']} steps"
		lines.append([scene, row['unknowns'], f"{time['usual']:.3g} ({time['fastest']:.3g} to {time['slowest']:.3g})", f"{time['measuredTime']:.3g}", f'{ratio:.2f}', *memory])
	return lines, f'{ESTIMATES} Times are within a factor of 2 in {within} of {len(rows)} scenes, and inside the estimated range in {inRange}.'


def tables(folder, plans, drawn):
	"""File, title, rows and note of all tables and pictures; these are drawn into a folder."""
	found = {name: [head] for name, (_, _, head) in kinds.items()}
	pictures = []
	for name, plan in plans.items():
		try:
			runs, uncertainty = fronts.read(folder, name, plan)
		except fronts.NoReference as reason:
			found['failures'].append([name, str(reason), ''])
			continue
		front = fronts.front(runs)
		found['failures'] += [[name, run.failure, described(run.setting, plan)] for run in runs if run.failure]
		if not front: continue
		picture(name, plan, runs, front, uncertainty, os.path.join(drawn, name + '.png'))
		pictures.append((name + '.png', f'Error against time: {name}', None))
		found['cheapest'].append([name, *measureOf(plan, uncertainty), *cheapest(plan, runs, uncertainty)])
		found['fronts'] += [[name, f'{100 * run.error:.2f} %', f'{run.cpu:.2f}', f'{run.solves:.0f}', f'{run.memory:.0f}', described(run.setting, plan)] for run in front]
		for kind, rows in dict(knobs=knobs(plan, runs), others=others(plan, runs), threads=threads(plan, runs)).items(): found[kind] += [[name, *row] for row in rows]
		found['never'] += [[name, ', '.join(values)]] if (values := list(never(plan, runs, front))) else []
	yield from ((f'{kind}.csv', title, found[kind], note) for kind, (title, note, _) in kinds.items() if len(found[kind]) > 1)
	yield from pictures
	if os.path.exists(os.path.join(folder, 'results', 'estimates.csv')):
		rows, note = estimates(folder)
		yield 'estimates.csv', 'Estimates of mpm.advise', rows, note


# title, note and head of each table
kinds = dict(
        cheapest=('Cheapest setting for an error', 'Processor time of the script. Uncertain: the error is below the uncertainty of the reference, the difference of a coarser one.', ['scene', 'error of', 'against', 'uncertainty', *(f'{100 * target:g} %' for target in targets)]),
        fronts=('Fronts', 'Runs that no other beats in both time and error.', ['scene', 'error', 'time [s]', 'solves', 'memory [MiB]', 'setting']),
        knobs=('Accuracy by parameter', 'Factors on error and time, means over pairs of runs that differ in nothing else; g of error ~ time^-g over all of them.', ['scene', 'parameter', 'g', 'move', 'pairs', 'error', 'time']),
        others=('Other settings', 'Factors on error and time against the usual setting.', ['scene', 'setting', 'at', 'error', 'time', 'verdict']),
        never=('Never on the front', '', ['scene', 'settings']),
        threads=('Threads', 'Time of the wall clock [s].', ['scene', 'setting', 'one thread', 'these threads']),
        failures=('Runs that do not end', '', ['scene', 'reason', 'setting']))

ESTIMATES = """`examples/trade/estimates.py` compares estimates of `mpm.advise` before a run with the run. Its constants were fitted to the first twelve of these scenes. The number of unknowns
is exact for the first step. The cantilever needs more solves than other elastic bodies, which nothing foretells.""".replace('\n', ' ')
