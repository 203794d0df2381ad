#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Possible savings by cells of two and three sizes, where plastic clay decides: limit loads on quadtrees (hanging nodes) against those of equal cells, each with its number of unknowns.

The plugin has equal cells only. Quadtree and clay are small programs of this folder, for small displacements, in which the plugin's method is the one of clay.py; so what a grid of
several sizes is worth is measured without such a grid in the plugin. Which cells are halved is chosen in three ways, each to several extents; page.py takes the best.

	uniform  none
	near     those within a distance of the edge of the footing, the toe of the cut, the rim of the bar; twice as far for each larger size
	stress   those that bear most of the estimated error of the stress (O.C. Zienkiewicz, J.Z. Zhu 1987), found by a run with the larger cells
	flow     those that bear most of the plastic work
	way      as near, for a bar that goes by its diameter, along all of its way

Run it with `scripts/run examples/two_sizes/two_sizes.py [options]`; what is in its results/runs.csv is not run again.
"""
import os
import sys
import time

import numpy as np
folder = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [folder, os.path.join(folder, '..'), os.path.join(folder, '..', '..', 'scripts', 'lib')]
from options import readOptions
from results import Results, makeFolder
import page
import studies
from scenes import scenes

options = readOptions('Limit loads with cells of several sizes.',
        scenes=('', 'names of scenes with commas between; all of them if empty'),
        largest=(1000, 'number of the smallest cells over the length that the scene counts them over'))

uniform = dict(footing=(2, 3, 4, 6, 8, 12, 16, 24), cut=(5, 10, 20, 40, 80), bar=(3, 4, 6, 8, 12, 16, 20))
several = dict(footing=(8, 16), cut=(20, 40), bar=(8, 12))
for name in list(uniform): uniform['tight' + name.title()], several['tight' + name.title()] = uniform[name], several[name]
extents = dict(near=(0.1, 0.2, 0.4, 0.8), stress=(0.5, 0.7, 0.85, 0.95), flow=(0.5, 0.7, 0.85, 0.95), way=(0.1, 0.2, 0.4, 0.8))
length = dict(footing=2., cut=5., bar=1., tightFooting=2., tightCut=5., tightBar=1.)


def halved(name, cells, levels, choice, extent):
	"""The scene with its tree, cells of which have been halved *levels* times."""
	scene = scenes[name](cells, levels, **(dict(way=1.) if choice == 'way' else {}))
	tree = scene.tree
	for level in range(levels):
		distance, size = scene.near(tree.centres()), tree.sizes()
		marked = distance < 1.5 * size  # the smallest are the same whatever is chosen besides
		if choice in ('near', 'way'): marked |= distance < extent * length[name] * 2**(levels - 1 - level)
		else:
			_, clay = scene.analyse(tree.connect())
			marked |= carriers(clay.stressError() if choice == 'stress' else clay.work * size**2, extent)
		tree.halve(marked & (tree.width == tree.width.min()))
	return scene


def carriers(amounts, share):
	"""Mask of the largest that together are a share of the sum (W. Doerfler 1996)."""
	order = np.argsort(-amounts)
	found = np.zeros(len(amounts), bool)
	found[order[:np.searchsorted(np.cumsum(amounts[order]), share * amounts.sum()) + 1]] = True
	return found


def measure(name, cells, levels, choice, extent):
	began = time.process_time()
	scene = halved(name, cells, levels, choice, extent)
	value, _ = scene.analyse(scene.tree.connect())
	size, x = scene.tree.sizes(), scene.tree.centres()[:, 0]
	around = np.sum((x if not name.lower().endswith('cut') else 1) / size)  # cells of a body that is the section turned about its axis, or as long as needed: up to a factor
	return dict(unknowns=2 * scene.tree.free.shape[1], around=f'{around:.6g}', smallest=f'{np.mean(size == size.min()) if levels else 1:.3f}',
	            error=f'{value / scene.exact - 1:.6g}', seconds=f'{time.process_time() - began:.3g}')


makeFolder(options.out)
table = Results(options.out, 'runs', ['scene', 'cells', 'levels', 'choice', 'extent'], ['unknowns', 'around', 'smallest', 'error', 'seconds'])
chosen = options.scenes.split(',') if options.scenes else list(scenes)
for name in chosen:
	if name not in scenes: raise SystemExit(f"two_sizes.py: no scene {name!r}; there are {', '.join(scenes)}")
plan = [(name, cells, 0, 'uniform', 0.) for name in chosen for cells in uniform[name]]
plan += [(name, cells, levels, choice, extent) for name in chosen for cells in several[name] for choice in extents if choice != 'way' or name == 'bar'
         for levels in (1, 2) for extent in extents[choice]]
for row in sorted(plan, key=lambda row: row[1]):
	if row in table or row[1] > options.largest: continue
	found = measure(*row)
	table.add([dict(zip(['scene', 'cells', 'levels', 'choice', 'extent'], row)) | found])
	print(*row, *found.values(), flush=True)
page.write(options.out)
studies.keepAll(options.out, page.tables(options.out), '')
print(f'written: {options.out}/README.md and its picture')
