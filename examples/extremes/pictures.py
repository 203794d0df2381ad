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
        'penetrated': ('p', 'tab:cyan'),
        'thrown': ('t', 'tab:brown'),
        'timeout': ('T', 'tab:pink'),
        'crash': ('X', 'black'),
        'not finite': ('f', 'tab:olive'),
        'law': ('l', 'gold'),
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


def outcomes(rows, title, present, path):
	"""One strip an axis: error by colour where it ran, kind of failure elsewhere, most iterations as a number."""
	columns = min(2, len(present))
	height = 1.2 + max(len(axes[name].dims) * len(axes[name].ghosts) for name in present) * .17
	count = math.ceil(len(present) / columns)
	figure, panels = plt.subplots(count, columns, figsize=(6.6 * columns, height * count + 1), squeeze=False, layout='constrained')
	scale = plt.Normalize(-8, 0)
	for name, panel in zip(present, panels.flat):
		strips = [(dim, ghost) for dim in axes[name].dims for ghost in axes[name].ghosts]
		for y, strip in enumerate(strips):
			for x, value in enumerate(axes[name].values):
				row = rows.get((name, *strip, str(value)))
				if row is not None: _cell(panel, x, y, row, scale)
		panel.set(xlim=(-.5, len(axes[name].values) - .5), ylim=(len(strips) - .5, -.5))
		panel.set_title(f'{name}: {axes[name].title}', fontsize=9, loc='left', pad=4)
		panel.set_xticks(range(len(axes[name].values)), map(short, axes[name].values), fontsize=7, rotation=40 if len(axes[name].values) > 12 else 0)
		panel.set_yticks(range(len(strips)), [f'{dim}D {labels[ghost]}' for dim, ghost in strips], fontsize=8)
		panel.tick_params(length=0)
	for panel in panels.flat[len(present):]:
		panel.axis('off')
	bar = figure.colorbar(plt.cm.ScalarMappable(scale, 'viridis_r'), ax=panels, shrink=.6, aspect=30, extend='min')
	bar.set_label(f"log10 of the relative error of the {'energy' if title == 'Inertia' else 'stress'} (number: most iterations of a load step)", fontsize=8)
	seen = {kind for name in present for kind in failures for key, row in rows.items() if key[0] == name and row['failure'].startswith(kind)}
	handles = [plt.Rectangle((0, 0), 1, 1, color=colour, label=f'{letter}: {kind}') for kind, (letter, colour) in failures.items() if kind in seen]
	if any(key[0] in present and not row['failure'] and math.isnan(row['error']) for key, row in rows.items()):
		handles.append(plt.Rectangle((0, 0), 1, 1, color='#cfe8cf', label='ran, no exact solution'))
	if handles: figure.legend(handles=handles, loc='upper center', bbox_to_anchor=(.5, 0), ncols=len(handles), fontsize=8, frameon=False)
	figure.suptitle(f'{title}: how each analysis ended, against the parameter', fontsize=11)
	save(figure, path)


def _cell(panel, x, y, row, scale):
	if row['failure']:
		text, colour = next((style for kind, style in failures.items() if row['failure'].startswith(kind)), ('?', 'yellow'))
	else:
		text = f"{row['maxIterations']:.0f}"
		colour = '#cfe8cf' if math.isnan(row['error']) else plt.cm.viridis_r(scale(math.log10(max(row['error'], 1e-30))))
	panel.add_patch(plt.Rectangle((x - .5, y - .5), 1, 1, facecolor=colour, edgecolor='white', linewidth=.5))
	dark = sum(matplotlib.colors.to_rgb(colour)) < 1.5
	panel.text(x, y, text, ha='center', va='center', fontsize=7, color='white' if dark else 'black')


mostShown = 1e20 # condition numbers beyond 1e16 leave a solution no digit: how far is of no interest


def conditions(rows, names, path):
	"""Condition number at the start against the parameter; crosses where the analysis failed, arrows where it is beyond the picture."""
	figure, panels = plt.subplots(2, (len(names) + 1) // 2, figsize=(4.4 * ((len(names) + 1) // 2), 7.4), squeeze=False, layout='constrained')
	for name, panel in zip(names, panels.flat):
		for dim in axes[name].dims:
			for ghost in ghosts:
				found = [(x, row) for x, value in enumerate(axes[name].values) if (row := rows.get((name, dim, ghost, str(value)))) is not None]
				if found: _condition(panel, dim, ghost, *map(np.array, zip(*((x, row['condition'], row['failure'] != '') for x, row in found))))
		if panel.get_ylim()[1] > 1e16: panel.axhline(1e16, color='k', linewidth=.8, linestyle=':')
		panel.set_ylim(10, min(panel.get_ylim()[1], 3 * mostShown))
		panel.set_xticks(range(len(axes[name].values)), map(short, axes[name].values), fontsize=7, rotation=60)
		panel.set_xlabel(axes[name].title, fontsize=8)
		panel.grid(alpha=.3)
	for panel in panels.flat[len(names):]:
		panel.axis('off')
	for panel in panels[:, 0]:
		panel.set_ylabel('condition number of K + K_g [-]')
	handles = [plt.Line2D([], [], label=f'{dim}D {labels[ghost]}', **_line(dim, ghost)) for dim in (2, 3) for ghost in ghosts]
	handles += [plt.Line2D([], [], color='k', marker='x', linestyle='none', label='the analysis fails'), plt.Line2D([], [], color='k', marker='^', linestyle='none', label='beyond 1e20, or infinite'),
	            plt.Line2D([], [], color='k', linewidth=.8, linestyle=':', label='1e16: no digit is left')]
	figure.legend(handles=handles, loc='upper center', bbox_to_anchor=(.5, 0), ncols=5, fontsize=8, frameon=False)
	figure.suptitle('Condition number of the first load step against the parameter', fontsize=11)
	save(figure, path)


def _line(dim, ghost):
	"""Style of a curve: wide below and narrow above, so that those of the same values show each other."""
	width = {'none': 6, 'paper': 3, 'mesh-independent': 1.2}[ghost]
	return dict(color=colours[ghost], linewidth=width, alpha=.35 if ghost == 'none' else .8, linestyle='-' if dim == 2 else (0, (3, 1)), marker='o' if dim == 2 else 's', markersize=width + 1.5)


def _condition(panel, dim, ghost, x, condition, failed):
	shown = np.minimum(condition, mostShown)
	order = ['none', 'paper', 'mesh-independent'].index(ghost)
	panel.semilogy(x, shown, zorder=2 + order, **_line(dim, ghost))
	panel.semilogy(x[failed], shown[failed], 'x', color='k', markersize=7, zorder=6)
	beyond = condition > mostShown
	panel.semilogy(x[beyond], shown[beyond], '^', color='k', markersize=6, zorder=6)


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
	figure, panels = plt.subplots(1, 3, figsize=(13, 4.4), sharey=True, layout='constrained')
	for ghost, panel in zip(ghosts, panels):
		image = panel.imshow(cornerGrid(rows, ghost), origin='lower', vmin=1, vmax=20, cmap='magma_r')
		for i, j in cornersThatFail(rows, ghost):
			panel.text(i, j, 'x', ha='center', va='center', color='tab:cyan')
		panel.set_xticks(range(len(corners)), [f'{c:g}' for c in corners], rotation=60)
		panel.set_yticks(range(len(corners)), [f'{c:g}' for c in corners])
		panel.set(title=labels[ghost], xlabel='overlap along x [h]')
	panels[0].set_ylabel('overlap along y [h]')
	figure.colorbar(image, ax=panels.tolist(), label='log10 of the condition number', fraction=.02, extend='max')
	failing = any(cornersThatFail(rows, ghost) for ghost in ghosts)
	figure.suptitle('Condition number of a body that overlaps its outermost cells along x and y' + (' (x: the analysis fails)' if failing else ''), fontsize=11)
	save(figure, path)


def pivots(rows, path):
	"""Error of a solve against the smallest pivot, and where the solver draws its line."""
	figure, axis = plt.subplots(figsize=(7, 4.5))
	for refused, marker, label in (False, 'o', 'solved'), (True, 'x', 'refused as singular'):
		found = [row for row in rows.values() if row['pivot'] > 0 and row['solveError'] > 0 and (row['condition'] == math.inf) == refused]
		axis.loglog([row['pivot'] for row in found], [row['solveError'] for row in found], marker, markersize=3, linestyle='none', label=f'{label} ({len(found)} cases)')
	axis.axvline(1e-12, color='k', linewidth=.8, linestyle=':', label='limit of the solver, 1e-12')
	axis.set(xlabel='smallest pivot of the matrix, its diagonal scaled to 1 [-]', ylabel='relative error of the solution in energy [-]')
	axis.legend(frameon=False)
	save(figure, path)
