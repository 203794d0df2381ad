#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Deposits of columns of sand on grids of several sizes and in steps of several lengths: how smooth they are, how far they go, and what a step costs.

Columns as those of runout.py, which says what they are, but points that outgrow half a cell are split. Where a deposit ends is told in five ways: its front, the first place where its depth falls below a tenth of the
shorter side, which is a cell of ten over that side; its edge, where it falls below a twentieth; the places up to which 95 and 99 % of its matter lie; and the distance of its middle from the plane of symmetry.

Run it with `scripts/run examples/runout/profiles.py [options]`.
"""
import csv
import os
import sys
import time

import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from columns import L, runSand
from deposits import front, profile
from options import readOptions
from style import plt

options = readOptions('Deposits of sand on several grids and in several steps.',
        aspects=('0.5 1 2 3', 'height over width of the columns, between blanks'),
        runs=('10/0.3 20/0.3 10/0.1', 'cells over the shorter side / how far what falls down the height goes in a step, in cells'),
        pointsPerCell=(2, 'material points per cell and axis'),
        maxSplits=(2, 'how often a point that outgrows half a cell is split in two'),
        repose=(31., 'angle of repose [degrees]'),
        end=(6., 'latest time, over sqrt(height / g)'))

columns = ['a', 'cells', 'courant', 'front', 'edge', 'holds 95 %', 'holds 99 %', 'middle', 'height', 'rest', 'points', 'steps', 'solves', 'most in a step', 'cuts', 'energy not accounted for', 'seconds']


def measured(aspect, cells, courant):
	"""A row of the table, and the profile at rest: places and depths over L."""
	began = time.process_time()
	options.cells, options.courant = cells, courant
	history, film, counts = runSand(aspect * L, options)
	_, pos, _, area = film[-1]
	x, side = pos[:, 0], min(L, aspect * L)
	places, depth = profile(x, area, side)
	order = np.argsort(x)
	holds = np.interp((.95, .99), np.cumsum(area[order]) / area.sum(), x[order])
	numbers = [aspect, cells, courant, front(x, area, side, L, 0.1) / L, front(x, area, side, L) / L, *holds / L, np.average(x, weights=area) / L, depth[0] / L, history[-1, 0], *counts.values(), history[-1, 9] / history[-1, 3], time.process_time() - began]
	return dict(zip(columns, numbers)), places / L, depth / L


aspects = [float(a) for a in options.aspects.split()]
figure, axes = plt.subplots(len(aspects), 1, figsize=(9, 3.4 * len(aspects)), squeeze=False, layout='constrained')
with open(os.path.join(options.out, 'profiles.csv'), 'w', newline='') as file:
	table = csv.DictWriter(file, columns)
	table.writeheader()
	for ax, aspect in zip(axes.flat, aspects):
		for cells, courant in (map(float, run.split('/')) for run in options.runs.split()):
			row, places, depth = measured(aspect, int(cells), courant)
			table.writerow({name: f'{value:.5g}' for name, value in row.items()})
			file.flush()
			print(', '.join(f'{name} {value:.4g}' for name, value in row.items()), flush=True)
			if abs(row['energy not accounted for']) > 0.02: print(f"{100 * row['energy not accounted for']:.0f} % of the energy is not accounted for: single points may have got it of nothing, and where they have gone then says nothing")
			ax.plot(places, depth, ':' if courant < .3 else '-', label=f'{cells:.0f} cells, {courant:g} of a cell in a step')
		ax.set(xlabel='x / L [-]', ylabel='depth at rest / L [-]', title=f'height over width a = {aspect:g}', ylim=(0, None))
		ax.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'profiles.png'), dpi=100)
print(f'written: {options.out}/profiles.png, profiles.csv')
