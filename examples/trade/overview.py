#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the page of examples/trade that fits on a screen and its figure, from the kept tables: `examples/trade/overview.py`."""
import os
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(here, '..', '..', 'scripts', 'lib'))
import matplotlib
matplotlib.use('Agg')
import matplotlib.patheffects
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullLocator
import pages
from panels import cost, panels, said
from plans import plans
from verdict import introduction, text

targets = .2, .1, .05, .02, .01, .003


def picture(found, path):
	"""The front of each scene, all that was run, and one choice beside it."""
	figure, plots = plt.subplots(4, 5, figsize=(14.5, 9.9), layout='constrained')
	for axes, panel in zip(plots.flat, found.values()):
		front, (name, beside) = panel.front(), panel.beside
		for points, style in (panel.points, dict(marker='o', color='.75', markersize=3)), (beside, dict(marker='^', color='tab:orange', markersize=4.5, zorder=3)), (front, dict(marker='o', color='tab:blue', markersize=4)):
			axes.loglog([point.cost for point in points], [100 * point.error for point in points], linestyle='-' if points is front else 'none', linewidth=1.2, **style)
		limits(axes)
		if panel.uncertainty > 0: axes.axhspan(axes.get_ylim()[0], 100 * panel.uncertainty, color='.92', zorder=0)
		labelled(axes, panel.worthwhile())
		axes.set_title(panel.title + ('*' if panel.luck else ''), fontsize=9.5, pad=4)
		axes.text(.98, .97, panel.measure + (f'\nn: cells {panel.cells}' if panel.cells else ''), transform=axes.transAxes, ha='right', va='top', fontsize=7.5, color='.3')
		axes.text(.98, .81 if panel.cells else .89, f'▲ {name}', transform=axes.transAxes, ha='right', va='top', fontsize=8, color='tab:orange')
		axes.set_xlabel('solves' if panel.unit == 'solves' else 'seconds', fontsize=8, labelpad=1)
		for axis in axes.xaxis, axes.yaxis:
			low, high = axis.get_view_interval()
			axis.set_major_locator(LogLocator(subs=(1, ) if high > 30 * low else (1, 2, 5)))
			axis.set_major_formatter('{x:g}')
			axis.set_minor_locator(NullLocator())
			axis.set_tick_params(labelsize=8, pad=2)
	for axes in plots[:, 0]: axes.set_ylabel('error [%]', fontsize=8.5)
	legend(plots.flat[len(found)])
	for axes in plots.flat[len(found) + 1:]: axes.axis('off')
	figure.savefig(path, dpi=130)
	plt.close(figure)


def limits(axes):
	"""Room for labels, and more where there is little."""
	for (low, high), limit in (axes.dataLim.intervalx, axes.set_xlim), (axes.dataLim.intervaly, axes.set_ylim):
		room = max(high / low, 10)**.15
		limit(low / room, high * room**2)


def labelled(axes, points):
	"""Each point with what its setting changes of that before."""
	before = {}
	for point in points:
		changed = {name: value for name, value in point.setting.items() if before.get(name) != value}
		before = point.setting
		axes.annotate(said(changed), (point.cost, 100 * point.error), (3, 2), textcoords='offset points', fontsize=8, path_effects=[matplotlib.patheffects.withStroke(linewidth=2, foreground='w')])


def legend(axes):
	axes.axis('off')
	for style, label in ('o-', 'front: nothing is cheaper and better'), ('o', 'all other runs'), ('^', 'the choice named in the corner'):
		axes.plot([], [], style, color={'o-': 'tab:blue', 'o': '.75', '^': 'tab:orange'}[style], markersize=4, label=label)
	axes.fill_between([], [], color='.92', label='the reference is no better known')
	axes.legend(frameon=False, fontsize=8.5, loc='upper left', borderaxespad=0)
	axes.text(0, .3, LETTERS, fontsize=8.5, va='center', transform=axes.transAxes)


def answers(found):
	"""A line for each scene: the cheapest setting of the front for some errors."""
	lines = []
	for panel in found.values():
		cells, last = [], None
		for target in targets:
			point = panel.cheapest(target)
			text = 'not known' if target < panel.uncertainty else f'{cost(panel, point)}: {said(point.setting)}' if point else '–'
			cells.append('"' if text == last and point and target >= panel.uncertainty else text)
			last = text
		lines.append((panel.title + ('*' if panel.luck else ''), *cells))
	return pages.table(['scene', *(f'{100 * target:g} %' for target in targets)], lines)


LETTERS = '''The letters, in labels only where they change:
n   cells (over what: in the panel)
p   points per cell and axis
s   load steps
k   stiffness of the contact
b   width of the bracket
*   some errors pass zero: luck'''


def write(folder):
	found = panels()
	picture(found, os.path.join(folder, 'fronts.png'))
	pages.write(folder, [introduction(), '## Picture\n\n![Error against cost, by scene](fronts.png)\n\n## Numbers\n', TABLE, answers(found), '\n## What to change\n', text(found)])


TABLE = '''**The cheapest setting for an error.** Processor time, one thread; hundredths of a second scatter by a third; columns, cantilever, slope, block factorise in every iteration. n: cells, p: points a cell and axis, s: load steps, k: contact stiffness, b: bracket of F; –: none, ": as to the left.
'''

if __name__ == '__main__':
	write(here)
