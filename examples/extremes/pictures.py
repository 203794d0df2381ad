# SPDX-License-Identifier: GPL-2.0-or-later
"""Maps of the stability atlas: plain Python, no YADE needed."""
import math

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from axes import axes, corners, ghosts

labels = {'none': 'no ghost', 'mesh-independent': 'ghost, $h^1$', 'paper': 'ghost, $h^3$'}
colours = {'none': 'tab:red', 'mesh-independent': 'tab:blue', 'paper': 'tab:green'}
failures = { # kinds, by how they begin: letter and colour
        'singular': ('s', '0.25'),
        'refused': ('r', '0.6'),
        'inverted': ('i', 'tab:purple'),
        'diverging': ('d', 'tab:red'),
        'not converging': ('n', 'tab:orange'),
        'thrown': ('t', 'tab:brown'),
        'timeout': ('T', 'tab:pink'),
        'crash': ('X', 'black'),
        'not finite': ('f', 'tab:olive'),
}


def save(figure, path):
	figure.savefig(path, dpi=110, bbox_inches='tight')
	plt.close(figure)


def short(value):
	"""A value as a tick label."""
	try:
		number = float(value)
	except ValueError:
		return value
	return f'{number:.0e}'.replace('e-0', 'e-').replace('e+0', 'e') if number and (abs(number) < 1e-2 or abs(number) >= 1e4) else f'{number:g}'


def outcomes(rows, present, path):
	"""One strip an axis: error by colour where it ran, kind of failure elsewhere, most iterations as a number."""
	heights = [len(axes[name].dims) * len(axes[name].ghosts) + 3.2 for name in present]
	figure, panels = plt.subplots(len(present), 1, figsize=(11, sum(heights) * .2), gridspec_kw=dict(height_ratios=heights, hspace=.75), squeeze=False)
	scale = plt.Normalize(-8, 0)
	for name, panel in zip(present, panels[:, 0]):
		strips = [(dim, ghost) for dim in axes[name].dims for ghost in axes[name].ghosts]
		for y, strip in enumerate(strips):
			for x, value in enumerate(axes[name].values):
				row = rows.get((name, *strip, str(value)))
				if row is not None: _cell(panel, x, y, row, scale)
		panel.set(xlim=(-.5, len(axes[name].values) - .5), ylim=(len(strips) - .5, -.5))
		panel.set_title(f'{name}: {axes[name].title}', fontsize=8, loc='left', pad=3)
		panel.set_xticks(range(len(axes[name].values)), map(short, axes[name].values), fontsize=6)
		panel.set_yticks(range(len(strips)), [f'{dim}D {labels[ghost]}' for dim, ghost in strips], fontsize=6)
		panel.tick_params(length=0)
	bar = figure.colorbar(plt.cm.ScalarMappable(scale, 'viridis_r'), ax=panels[:, 0].tolist(), fraction=.015, pad=.01, shrink=.3, anchor=(0, 1))
	bar.set_label('log10 of the error of the stress', fontsize=7)
	figure.legend(
	        handles=[plt.Rectangle((0, 0), 1, 1, color=colour, label=f'{letter}: {kind}') for kind, (letter, colour) in failures.items()]
	        + [plt.Rectangle((0, 0), 1, 1, color='#cfe8cf', label='ran, no exact solution')], loc='upper left', bbox_to_anchor=(.91, .45), fontsize=7, frameon=False)
	save(figure, path)


def _cell(panel, x, y, row, scale):
	if row['failure']:
		text, colour = next((style for kind, style in failures.items() if row['failure'].startswith(kind)), ('?', 'yellow'))
	else:
		text = f"{row['maxIterations']:.0f}"
		colour = '#cfe8cf' if math.isnan(row['error']) else plt.cm.viridis_r(scale(math.log10(max(row['error'], 1e-30))))
	panel.add_patch(plt.Rectangle((x - .5, y - .5), 1, 1, facecolor=colour, edgecolor='white', linewidth=.5))
	dark = sum(matplotlib.colors.to_rgb(colour)) < 1.5
	panel.text(x, y, text, ha='center', va='center', fontsize=6, color='white' if dark else 'black')


def conditions(rows, names, path):
	"""Condition number at the start against the parameter; crosses where the analysis failed."""
	figure, panels = plt.subplots(2, (len(names) + 1) // 2, figsize=(4.2 * ((len(names) + 1) // 2), 7), squeeze=False)
	for name, panel in zip(names, panels.flat):
		for dim in axes[name].dims:
			for ghost in ghosts:
				found = [(x, row) for x, value in enumerate(axes[name].values) if (row := rows.get((name, dim, ghost, str(value)))) is not None]
				if not found: continue
				x, y = np.array([x for x, _ in found]), np.array([row['condition'] for _, row in found])
				panel.semilogy(x, y, '-' if dim == 2 else '--', color=colours[ghost], linewidth=1, label=f'{dim}D {labels[ghost]}')
				bad = np.array([row['failure'] != '' for _, row in found])
				panel.semilogy(x[bad], y[bad], 'x', color=colours[ghost], markersize=5)
		panel.set_xticks(range(len(axes[name].values)), map(short, axes[name].values), fontsize=6, rotation=60)
		panel.set_title(axes[name].title, fontsize=7)
		panel.grid(alpha=.3)
	for panel in panels.flat[len(names):]:
		panel.axis('off')
	panels[0, 0].set_ylabel('condition number of K + K_g')
	panels[0, 0].legend(fontsize=6, frameon=False)
	figure.text(.5, .03, 'crosses: the analysis fails', ha='center', fontsize=8)
	figure.subplots_adjust(hspace=.4)
	save(figure, path)


def cornerGrid(rows, ghost):
	grid = np.full((len(corners), len(corners)), math.nan)
	for i, x in enumerate(corners):
		for j, y in enumerate(corners):
			row = rows.get(('corner', 2, ghost, f'{x:g}/{y:g}'))
			if row is not None: grid[j, i] = math.log10(row['condition']) if math.isfinite(row['condition']) else 20
	return grid


def cornersThatFail(rows, ghost):
	return [(i, j) for i, x in enumerate(corners) for j, y in enumerate(corners) if (row := rows.get(('corner', 2, ghost, f'{x:g}/{y:g}'))) and row['failure']]


def cornerMaps(rows, path):
	figure, panels = plt.subplots(1, 3, figsize=(13, 4), sharey=True)
	for ghost, panel in zip(ghosts, panels):
		image = panel.imshow(cornerGrid(rows, ghost), origin='lower', vmin=1, vmax=20, cmap='magma_r')
		for i, j in cornersThatFail(rows, ghost):
			panel.text(i, j, 'x', ha='center', va='center', color='tab:cyan')
		panel.set_xticks(range(len(corners)), [f'{c:g}' for c in corners], rotation=60)
		panel.set_yticks(range(len(corners)), [f'{c:g}' for c in corners])
		panel.set(title=labels[ghost], xlabel='overlap along x [h]')
	panels[0].set_ylabel('overlap along y [h]')
	figure.colorbar(image, ax=panels.tolist(), label='log10 of the condition number (x: the analysis fails)', fraction=.02)
	save(figure, path)


def pivots(rows, path):
	"""Error of a solve against the smallest pivot, and where the solver draws its line."""
	figure, axis = plt.subplots(figsize=(7, 4.5))
	for refused, marker, label in (False, 'o', 'solved'), (True, 'x', 'refused as singular'):
		found = [row for row in rows.values() if row['pivot'] > 0 and row['solveError'] > 0 and (row['condition'] == math.inf) == refused]
		axis.loglog([row['pivot'] for row in found], [row['solveError'] for row in found], marker, markersize=3, linestyle='none', label=f'{label} ({len(found)} cases)')
	axis.axvline(1e-12, color='k', linewidth=.8, linestyle=':')
	axis.set(xlabel='smallest pivot, diagonal scaled to 1', ylabel='relative error of the solution in energy')
	axis.legend(frameon=False)
	save(figure, path)
