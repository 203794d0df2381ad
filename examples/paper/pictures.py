# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the results: plain Python, no YADE needed. Each function takes rows of a table, numbers already converted."""
import os
import sys

from matplotlib.collections import PolyCollection
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))
from style import plt

names = {'mpm': 'MPM', 'gimp': 'GIMPM', 'none': 'GIMPM', 'ghost': 'ghost-stabilised GIMPM', 'mesh-independent': 'ghost, $h^1$', 'paper': "ghost, paper's $h^3$"}
colours = {'mpm': '0.55', 'gimp': 'C3', 'none': 'C3', 'ghost': 'C0', 'mesh-independent': 'C0', 'paper': 'C2'}
stressScale = -13, 13 # [kPa]: yield in pure shear is at a Kirchhoff stress of 15 / sqrt(2) = 10.6 kPa; Cauchy stress is that over det F


def save(figure, path):
	figure.savefig(path, dpi=150, bbox_inches='tight')
	plt.close(figure)


def conditionNumbers(rows, path):
	"""Figure 2."""
	figure, axes = plt.subplots(figsize=(6.5, 4))
	for name in 'gimp', 'ghost', 'mpm':
		axes.semilogy([row['offset'] for row in rows], [row[name] for row in rows], color=colours[name], label=names[name])
	axes.set(xlabel='offset $a/h$', ylabel='condition number $\\kappa([K])$', xlim=(0, 2))
	axes.legend(frameon=False)
	save(figure, path)


def columnErrors(series, path):
	"""Figure 4; *series* maps (ghost, kind of load steps) to lists of (cells, error)."""
	figure, axes = plt.subplots(figsize=(6.5, 4.5))
	for (ghost, steps), points in series.items():
		axes.loglog(*zip(*points), 'o-' if steps == '40 steps' else 's--', color=colours[ghost], markersize=4, label=f'{names[ghost]}, {steps}')
	cells = np.array([32., 256.])
	for order, top in (1, 1.6e-3), (2, 8e-4):
		axes.loglog(cells, top * (cells / cells[0])**-order, 'k:', linewidth=0.8)
		axes.annotate(f'order {order}', (cells[1], top * 8.**-order), fontsize=10)
	axes.set(xlabel='cells over the height', ylabel='stress error (C7) [-]', ylim=(1e-5, 0.1))
	axes.legend(frameon=False, fontsize=10)
	save(figure, path)


def oscillation(runs, steps, path):
	"""Stress oscillation along B-C during loading in so many steps; *runs* maps 'none' and 'ghost' to rows of steps."""
	figure, axes = plt.subplots(figsize=(7, 4))
	for name, rows in runs.items():
		axes.plot([row['step'] for row in rows], [row['oscillation'] for row in rows], color=colours[name], label=names[name])
	last = max(row['step'] for rows in runs.values() for row in rows)
	axes.set(xlabel=f'load step (step {last:g} is load factor {last / steps:.3g})', ylabel='deviation of $\\sigma_{xy}$ from a local linear fit,\nRMS over RMS of $\\sigma_{xy}$ [-]', ylim=(0, None))
	axes.set_title('Oscillation of the shear stress in one layer of cells along the face B-C', fontsize='medium')
	axes.legend(frameon=False, loc='upper center')
	_sketch(axes, [.72, .62, .27, .34])
	save(figure, path)


def _sketch(axes, place):
	"""A small picture of the slope as it was, with the face B-C."""
	small = axes.inset_axes(place)
	small.fill([0, 30, 30, 15, 10, 0], [0, 0, 7, 7, 12, 12], color='0.9')
	small.plot([10, 15], [12, 7], color='k', linewidth=2)
	small.annotate('B', (10, 12), (10.5, 12.2), fontsize=8)
	small.annotate('C', (15, 7), (15.5, 7.2), fontsize=8)
	small.set(xlim=(-.5, 30.5), ylim=(-.5, 15.5), aspect='equal')
	small.axis('off')


def faceStress(states, step, steps, path):
	"""sigma_xy of the points near the face B-C after a load step of so many; *states* maps 'none' and 'ghost' to saved states."""
	figure, axes = plt.subplots(figsize=(7, 4))
	for name, state in states.items():
		axes.plot(state['along'], state['faceStress'][step - 1] / 1e3, '.', color=colours[name], markersize=3, label=names[name])
	length = np.hypot(5, 5)
	for letter, at in ('B', 0), ('C', length):
		axes.axvline(at, color='k', linewidth=.6)
		axes.annotate(letter, (at, 1), (0, 3), xycoords=('data', 'axes fraction'), textcoords='offset points', ha='center')
	axes.set(xlabel='initial distance from the crest B towards the toe C [m]', ylabel='shear stress $\\sigma_{xy}$ [kPa]')
	axes.set_title(f'Material points in one layer of cells along the face B-C, load step {step} (load factor {step / steps:.4g})', fontsize='medium', pad=18)
	axes.legend(frameon=False, loc='lower left', bbox_to_anchor=(.12, 0))
	_sketch(axes, [.62, .02, .27, .34])
	save(figure, path)


def deformedSlope(state, title, path):
	"""Figures 6 and 7: the deformed domains shaded by sigma_xy, all and near the face B-C; the same colours for the same stress in all pictures."""
	figure, (whole, near) = plt.subplots(2, 1, figsize=(9, 9.5), height_ratios=[1, 1.5])
	for axes in whole, near:
		domains = PolyCollection(state['corners'], array=state['shearStress'] / 1e3, cmap='RdBu_r', clim=stressScale, edgecolors='face', linewidths=0.2)
		axes.add_collection(domains)
		axes.plot([0, 10, 15, 30], [12, 12, 7, 7], 'k--', linewidth=0.8, label='initial surface')
		axes.plot([0, 30], [7, 7], 'k:', [0, 14.5], [7.5, 7.5], 'k:', linewidth=0.6, label='initial weak layer')
		for letter, corner in ('B', (10, 12)), ('C', (15, 7)):
			axes.annotate(letter, corner, (3, 3), textcoords='offset points')
		axes.set(aspect='equal', xlabel='x [m]', ylabel='y [m]')
	whole.set(xlim=(-0.5, 30.5), ylim=(-0.5, 12.5))
	whole.set_title(title, fontsize='medium')
	near.set_title('The same near the face', fontsize='medium')
	handles, labels = whole.get_legend_handles_labels()
	whole.legend(handles[:2], labels[:2], frameon=False, fontsize=8)
	near.set(xlim=(7.5, 18.5), ylim=(5.5, 12.5))
	figure.colorbar(domains, ax=[whole, near], label='shear stress $\\sigma_{xy}$ [kPa]', fraction=0.03)
	save(figure, path)


def scalings(rows, path):
	"""Condition number and column error against the cell size."""
	figure, panels = plt.subplots(1, 2, figsize=(10, 3.8), layout='constrained')
	for axes, column, label in zip(panels, ('conditionNumber', 'error'), ('condition number $\\kappa([K])$', 'stress error (C7) [-]')):
		for ghost in 'none', 'paper', 'mesh-independent':
			ours = sorted((row['cellSize'], row[column]) for row in rows if row['ghost'] == ghost)
			axes.loglog(*zip(*ours), 'o-', color=colours[ghost], markersize=4, label=names[ghost])
		axes.set(xlabel='cell size $h$ [m]', ylabel=label)
	panels[1].set(ylim=(1e-3, 1e-2))
	panels[0].legend(frameon=False)
	panels[1].legend(frameon=False)
	save(figure, path)
