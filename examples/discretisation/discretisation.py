#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check of mpm.discretisationError and mpm.stressError on scenes whose answer is known: those of the other examples, on grids of several cell sizes.

Every scene is the script of its example, run with one number of cells after the other; what it finds is kept in results/*.csv, and a run that was interrupted continues
where it was. Of each cell size that has been halved and doubled the page (page.py) compares the estimate with the true error.

Run it with `scripts/run examples/discretisation/discretisation.py [options]`. Read examples/column first.
"""
import functools
import os
import sys

from yade import mpm
import numpy as np
folder = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [folder, os.path.join(folder, '..'), os.path.join(folder, '..', '..', 'scripts', 'lib')]
from examplerun import runExample
from options import readOptions
from results import Results, makeFolder
import page
import scenes
import stresses
import studies

options = readOptions('The estimated error of known answers.',
        scenes=('', 'names of scenes with commas between; all of them if empty'),
        largest=(1000, 'number of cells that a run has at most, as the scene counts them'))


def script(path, **arguments):
	"""Globals of the script of an example after it has run."""
	O.reset()
	return runExample(os.path.join(folder, '..', path), yadeNames, **arguments)


def quantity(name, scene, cells):
	"""A row of the table of quantities."""
	value, exact = scene.run(kept, cells)
	print(f'{name}, {cells} cells: {value:.6g}, exact {exact:.6g}', flush=True)
	return dict(value=f'{value:.9g}', exact=f'{exact:.9g}')


def stress(name, scene, cells):
	"""A row of the table of stresses: estimate and true error, both over the root mean square of the stress, where it is known."""
	exact = scene.run(script, cells)
	points, estimated = mpm.arrays(), mpm.stressError()['points']
	known = np.isfinite(exact).all(axis=(1, 2))
	meanSquare = lambda tensors: points['volume'][known] @ (tensors[known]**2).sum(axis=(1, 2))
	estimate, true = np.sqrt([points['volume'][known] @ estimated[known]**2 / meanSquare(points['stress']), meanSquare(points['stress'] - exact) / meanSquare(exact)])
	print(f'{name}, {cells} cells: stress wrong by {true:.4g}, estimate {estimate:.4g}', flush=True)
	return dict(estimate=f'{estimate:.6g}', true=f'{true:.6g}')


yadeNames = dict(globals())
kept = functools.lru_cache(8)(script)  # some scenes are about the same runs
makeFolder(options.out)
kinds = ('values', quantity, scenes.scenes, ['value', 'exact']), ('stresses', stress, stresses.scenes, ['estimate', 'true'])
chosen = options.scenes.split(',') if options.scenes else [*scenes.scenes, *stresses.scenes]
for name in chosen:
	if not any(name in known for _, _, known, _ in kinds): raise SystemExit(f"discretisation.py: no scene {name!r}; there are {', '.join([*scenes.scenes, *stresses.scenes])}")
for file, measure, known, columns in kinds:
	table = Results(options.out, file, ['scene', 'cells'], columns)
	for name in chosen:
		for cells in known[name].cells if name in known else []:
			if (name, cells) in table or cells > options.largest: continue
			table.add([dict(scene=name, cells=cells) | measure(name, known[name], cells)])

page.write(options.out)
studies.keepAll(options.out, page.tables(options.out), '')
print(f'written: {options.out}/README.md and pictures')
