# SPDX-License-Identifier: GPL-2.0-or-later
"""Saves a scene half way, and goes on with those that were saved by other releases of YADE; for scripts/hosts.

usage: yade -n -x saved.py FOLDER NAME save
       yade -n -x saved.py FOLDER NAME load

The first saves FOLDER/NAME.xml.gz and FOLDER/NAME.yade.gz half way, goes on and writes to FOLDER/NAME.json how it has ended. The second loads
each file that is there, goes on and fails unless it ends alike. Only .xml goes both ways: boost refuses .yade of a later version of its own. YADE's bodies have a
member more where it has MPI, so that it loads no files of its own, with the plugin or without, from a YADE without MPI, and the other way round.
"""
import gzip
import json
import os
import sys
import traceback

import numpy as np

from yade import config, mpm

folder, name, task = sys.argv[1:]
steps = 10


def slope():
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=20e3, hardening=1e5, label='soil'))
	grid = MpmGrid(cellSize=2)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)]), grid, pointsPerCell=2, material='soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=held), PyRunner(iterPeriod=1, command='pass')]
	O.dt = 1 / steps


def end():
	"""Runs the rest: places [m], plastic strain and shear stress [Pa] of the points."""
	O.run(steps - O.iter, wait=True)
	points = mpm.arrays()
	return {'pos': points['pos'].tolist(), 'plasticStrain': points['plasticStrain'].tolist(), 'shear': points['stress'][:, 0, 1].tolist()}


def archiveVersion(path):
	"""Boost's, which a binary file begins with."""
	with gzip.open(path) as file:
		head = file.read(64)
	return head[head.index(b'::archive') + len('::archive')]


def save():
	slope()
	O.run(steps // 2, wait=True)
	for ending in 'xml.gz', 'yade.gz':
		mpm.save(f'{folder}/{name}.{ending}')
	with open(f'{folder}/{name}.json', 'w') as file:
		json.dump(end() | {'MPI': 'MPI' in config.features}, file)


def requireRefusal(path, reason, why):
	try:
		O.load(path)
	except RuntimeError as error:
		assert reason in str(error), error
		print(path, 'is refused:', why)
		return
	assert False, f'{path} should have been refused'


def load(path):
	O.reset()
	with open(path.replace('.xml.gz', '.json').replace('.yade.gz', '.json')) as file:
		expected = json.load(file)
	if path.endswith('.yade.gz') and archiveVersion(path) > archiveVersion(f'{folder}/{name}.yade.gz'):
		return requireRefusal(path, 'unsupported version', 'boost reads no archive of a later version')
	if expected.pop('MPI') != ('MPI' in config.features):
		if path.endswith('.xml.gz'): requireRefusal(path, 'input stream error', 'YADE was built with MPI here or there only')
		return # YADE would read a binary file, whatever its contents
	O.load(path)
	assert O.iter == steps // 2, O.iter
	for quantity, values in end().items():
		difference, largest = np.abs(np.subtract(values, expected[quantity])).max(), np.abs(expected[quantity]).max()
		assert difference <= 1e-6 * largest, f'{path}: {quantity} differs by {difference:g}, largest is {largest:g}'
	print(path, 'goes on and ends as where it was saved')


try:
	if task == 'save': save()
	else:
		for entry in sorted(os.listdir(folder)):
			if entry.endswith('.gz'): load(f'{folder}/{entry}')
except BaseException:
	traceback.print_exc()
	sys.stderr.flush()
	os._exit(1)
