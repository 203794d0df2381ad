#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Load steps chosen by newton.stepTolerance against fixed numbers of them: error against solves, in the scenes of examples/trade, the slope in frictional soil and the footing with contact.

The scenes are the scripts of the other examples, run with one number of steps after the other, and in a single step of the whole load which the tolerance cuts. The error is the root mean square of
the differences of points' positions from those with many steps, over that of the displacements: what the cells do is in both. What is found is kept in results/runs.csv, and a run that was interrupted
continues where it was; the page is written by page.py.

Run it with `scripts/run examples/load_steps/load_steps.py [options]`. Read examples/trade first.
"""
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
import studies
from scenes import scenes

options = readOptions('Load steps chosen by their error.',
        scenes=('', 'names of scenes with commas between; all of them if empty'),
        most=(1000, 'number of fixed steps that a run has at most, but for the reference'))
solves = []  # list that a PyRunner of the scenes of examples/trade appends to


def runScript(path, tolerance, arguments):
	"""Globals of the script of an example after it has run, with newton.stepTolerance [m]."""
	def engine(**attributes):
		made = MpmImplicitEngine(verbosity=0, **attributes)
		made.newton.stepTolerance = tolerance
		if tolerance: made.newton.minStep = 1 / 1024
		return made

	O.reset()
	solves.clear()
	return runExample(os.path.join(folder, '..', path), yadeNames | dict(MpmImplicitEngine=engine), **arguments)


def run(scene, steps, tolerance=0):
	"""Positions and displacements of the points [m], solves, steps and cuts; None if the load is not reached."""
	try: found = runScript(scene.script, tolerance, scene.arguments | dict(steps=steps))
	except RuntimeError as failure:
		print(failure)
		return None
	solver, points = O.engines[0], mpm.arrays()
	if solver.loadTime < 1 - 1e-9: return None
	counts = (solver.iterations, solver.substeps, solver.cuts) if steps == 1 else (sum(solves) or found.get('iterations') or sum(found['solves']), steps, solver.cuts)
	return points['pos'], points['pos'] - points['pos0'], *counts


def size(vectors):
	return np.sqrt((vectors**2).sum(axis=1).mean())


yadeNames = dict(globals())
makeFolder(options.out)
table = Results(options.out, 'runs', ['scene', 'steps', 'part'], ['tolerance', 'error', 'solves', 'made', 'cuts'])
chosen = options.scenes.split(',') if options.scenes else list(scenes)
for name in chosen:
	if name not in scenes: raise SystemExit(f"load_steps.py: no scene {name!r}; there are {', '.join(scenes)}")
	scene, reference = scenes[name], None
	for steps, part in [(steps, 0) for steps in scene.fixed if steps <= options.most] + [(1, part) for part in page.parts]:
		if (name, steps, part) in table: continue
		reference = reference or run(scene, scene.reference)
		tolerance = part * scene.displacement
		found = run(scene, steps, tolerance)
		row = dict(error='nan', solves='', made='', cuts='')
		if found: row = dict(zip(row, (f'{size(found[0] - reference[0]) / size(reference[1]):.4g}', *found[2:])))
		table.add([dict(scene=name, steps=steps, part=part, tolerance=f'{tolerance:.4g}') | row])
		print(name, steps, part, *row.values(), flush=True)
page.write(options.out)
studies.keepAll(options.out, page.tables(options.out), '')
print(f'written: {options.out}/README.md and its picture')
