# SPDX-License-Identifier: GPL-2.0-or-later
"""Page and picture of load steps chosen by their error, from the table in the folder results/; needs nothing of YADE."""
import os
import sys

from matplotlib.ticker import LogLocator, NullLocator
from scenes import scenes

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(here, '..'), os.path.join(here, '..', '..', 'scripts', 'lib')]
import pages
import results
import studies
from style import plt

parts = 0.04, 0.02, 0.01, 0.005, 0.002  # stepTolerance over the displacement at the end


def runs(folder):
	"""Runs by scene that have come to an end, those with fixed steps and those with a tolerance."""
	rows = results.read(os.path.join(folder, 'results', 'runs.csv'), pages.number)
	ended = [row for row in rows if row['error'] == row['error']]
	return {name: [[row for row in ended if row['scene'] == name and bool(row['part']) == chosen] for chosen in (False, True)] for name in scenes if any(row['scene'] == name for row in ended)}


def cheapest(fixed, error):
	"""Run with the cheapest fixed number of steps whose error is no larger, or None."""
	return min((row for row in fixed if row['error'] <= error), key=lambda row: row['solves'], default=None)


def picture(found, path):
	figure, all = plt.subplots(2, 4, figsize=(14.5, 7.5), layout='constrained')
	for axes, (name, (fixed, chosen)) in zip(all.flat, found.items()):
		for rows, mark, label in (fixed, 'o-', 'steps of one length'), (chosen, 's-', 'stepTolerance'):
			axes.loglog([row['solves'] for row in rows], [100 * row['error'] for row in rows], mark, markersize=4, linewidth=0.8, label=label)
		axes.set(title=scenes[name].what, xlabel='solves [-]', ylabel='error [%]')
		for axis in axes.xaxis, axes.yaxis:
			axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
			axis.set_major_formatter('{x:g}')
			axis.set_minor_locator(NullLocator())
		axes.title.set_fontsize(11)
	for axes in all.flat[len(found):]:
		axes.axis('off')
	all.flat[0].legend(frameon=False)
	figure.savefig(path, dpi=110)
	plt.close(figure)


def comparison(found):
	"""Cost of each tolerance, beside the cheapest fixed number of steps with the same error."""
	lines = []
	for name, (fixed, chosen) in found.items():
		for row in chosen:
			best = cheapest(fixed, row['error'])
			beside = [f"{best['steps']:.0f}", f"{best['solves']:.0f}", f"{row['solves'] / best['solves']:.2f}"] if best else ['', '', '']
			lines.append((scenes[name].what if row is chosen[0] else '', f"{row['tolerance']:.2g}", pages.percent(row['part']), pages.percent(row['error']), f"{row['made']:.0f} ({row['cuts']:.0f})",
			              f"{row['solves']:.0f}", *beside))
	return [['scene', 'stepTolerance [m]', 'of the displacement', 'error', 'steps (cuts)', 'solves', 'fixed steps', 'solves', 'ratio'], *lines]


def fixedTable(found):
	heads = sorted({row['steps'] for fixed, _ in found.values() for row in fixed})
	lines = []
	for name, (fixed, _) in found.items():
		of = {row['steps']: row for row in fixed}
		lines.append((scenes[name].what, *(f"{pages.percent(of[steps]['error'])}, {of[steps]['solves']:.0f}" if steps in of else '' for steps in heads)))
	return [['steps', *(f'{steps:.0f}' for steps in heads)], *lines]


def verdict(found):
	ratios = {name: [row['solves'] / best['solves'] for row in chosen for best in [cheapest(fixed, row['error'])] if best] for name, (fixed, chosen) in found.items()}
	lines = [(scenes[name].what, len(of), sum(ratio <= 1.6 for ratio in of), f'{min(of):.2f} to {max(of):.2f}') for name, of in ratios.items() if of]
	return [['scene', 'tolerances', 'at most 1.6 times the solves', 'ratios'], *lines]


FINDINGS = """# Load steps chosen by their error

With `MpmNewton(stepTolerance=...)` and `O.dt` as large as the whole load the program chooses the load steps. Is that as cheap as the best number of equal steps, which nobody knows beforehand?

## Run it

    scripts/run load_steps                                # all scenes: 5 minutes
    scripts/run load_steps --scenes slope                 # 10 s

## Picture

![Error against solves](load_steps.png)

## Numbers

- **Where bodies yield** it is nearly as cheap: at most 1.7 times the solves of the best number of equal steps (table).
- **The tolerance is that of a step.** The error at the end is 0.4 to 2.5 times as large in a slope, and up to 30 times at a limit load. Halve it once to see.
- **Elastic bodies** need no finer steps, and the estimate ignores them.
- **A frictional slope beyond its limit** stands by the ghost stabilisation alone; the estimate does not see that.

[The study](../../plugin/docs/studies/load_steps.md) has all runs.
"""

CHANGE = """## What to change

`--scenes` and `--most`, the most steps. In a scene of your own: `O.dt` as long as the whole load, and `newton=MpmNewton(stepTolerance=...)` of half a percent of the displacement that counts; halve it once to see what it does to the result.
"""


def write(folder):
	found = runs(folder)
	picture(found, os.path.join(folder, 'load_steps.png'))
	pages.write(folder, [FINDINGS, studies.markdown(verdict(found)), '', CHANGE])


def tables(folder):
	"""File, title and rows of all tables."""
	found = runs(folder)
	yield 'counts.csv', 'How many', verdict(found)
	yield 'tolerances.csv', 'Tolerances', comparison(found)
	yield 'fixed.csv', 'Fixed numbers of steps', fixedTable(found), 'Error, solves.'


if __name__ == '__main__':  # of the kept runs
	write(here)
	studies.publish('load_steps', tables(here), '')
