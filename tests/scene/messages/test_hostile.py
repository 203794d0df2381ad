# SPDX-License-Identifier: GPL-2.0-or-later
"""Uses that nobody intended: each makes sense, or is refused with a reason."""
import os
import signal
import subprocess
import time

import numpy as np
import pytest

refusing = '''
from contextlib import contextmanager
from scenes import *

@contextmanager
def refused(error, *words):
	"""The block raises the error, and its sentence contains the words."""
	try:
		yield
	except error as raised:
		assert all(word in str(raised) for word in words), raised
	else:
		assert False, ('not refused', words)
'''

virial = '''
def outOfBalance():
	"""Equilibrium times position, summed: the stress times the volume must be minus the weight times the height above the base, relative to it."""
	points = mpm.arrays()
	moment = sum(10 * O.bodies[int(i)].mat.density * O.bodies[int(i)].state.volume0 * y for i, y in zip(points['id'], points['pos'][:, 1]))
	return abs((points['stress'][:, 1, 1] * points['volume']).sum() + moment) / moment
'''


def test_the_report_says_what_the_last_run_met(yade):
	"""Numbers that can be counted by hand in a column of two materials: interface in a cell's middle, and two islands."""
	yade(
	        refusing + '''
O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soft'))
O.materials.append(MpmElasticMat(young=1e5, poisson=0, density=80, label='stiff'))
grid = MpmGrid(cellSize=1)
def column(x):
	return mpm.fill(pack.inAlignedBox((x, 0, -1), (x + 1, 4, 1)), grid, 2, lambda p: 'soft' if p[1] < 1.5 else 'stiff')
O.bodies.append(column(0) + column(5))
sides = [MpmBoundary(min=(x, -inf, -inf), max=(x, inf, inf), fix='x') for x in (0, 1, 5, 6)]
base = MpmBoundary(max=(inf, 0, inf), fix='y')
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides + [base], label='solver')
O.engines = [solver, MpmVtkRecorder(fileName='two-', recorders=['points', 'grid'])]
O.dt = 1
assert solver.report() == {}
O.step()
report = solver.report()
assert report['converged'] and report['failure'] == 'none' and report['cause'] == '' and not report['accepted']
# free: y of the upper 4 of 5 rows of nodes, two columns of them in each island
expected = dict(points=32, islands=2, mixedCells=2, activeCells=8, nodes=20, dofs=16, clampedDomains=0, substeps=1, cuts=0, loadTime=1, loadFactor=1)
assert {name: report[name] for name in expected} == expected, report
for name in 'iterations', 'residual', 'residuals', 'dofs', 'wallOverlap', 'boundaryCells', 'ghostFaces', 'reusedFactors', 'luSolves', 'lineSearchTrials', 'cgIterations', 'cgFallbacks':
	value = getattr(solver, name)
	assert report[name] == (list(value) if isinstance(value, tuple) else value), name
assert len(report['residuals']) == report['iterations'] + 1 and report['residual'] == report['residuals'][-1] <= 1e-6
assert set(report['times']) >= {'gather', 'basis', 'assembly', 'factorise', 'scatter'} and min(report['times'].values()) >= 0

solver.boundaries = sides[:2] + [MpmBoundary(max=(1, 0, inf), fix='y')] # the right one stands on nothing
with refused(RuntimeError, 'nothing restrains the translation along x of the material around (5.5, '):
	O.step()
report = solver.report()
assert report['failure'] == 'unrestrained' and report['islands'] == 2 and report['iterations'] == 0 and 'around (5.5' in report['cause']
'''
	)
	from vtu import Vtu
	cells = Vtu(yade.folder / 'two-grid.1.vtu')
	mixed = {tuple(box[0, :2]) for box, is_ in zip(cells.boxes, cells.fields['mixed']) if is_}
	assert mixed == {(0, 1), (5, 1)}


def test_domains_that_outgrow_half_a_cell_are_counted_and_marked(yade):
	yade(
	        '''
from scenes import *
O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (2, 2, 1)), grid, 1, 'soil'))
pulled = MpmBoundary(min=(2, -inf, -inf), max=(2, inf, inf), fix='x', displacement=(0.2, 0, 0))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), pulled]
solver = MpmImplicitEngine(grid=grid, boundaries=sides, label='solver')
O.engines = [solver, MpmVtkRecorder(fileName='pulled-')]
O.dt = 1
O.step()
assert solver.report()['clampedDomains'] == solver.clampedDomains == 4
assert mpm.arrays()['halfSize'][:, 0].max() == 0.5
'''
	)
	from vtu import Vtu
	assert list(Vtu(yade.folder / 'pulled-points.0.vtu').fields['clamped']) == [0] * 4
	assert list(Vtu(yade.folder / 'pulled-points.1.vtu').fields['clamped']) == [1] * 4


def test_bodies_and_materials_may_change_between_steps(yade):
	"""The next step finds equilibrium for what is there then."""
	yade(
	        refusing + virial + '''
solver = column(8, factor=0)
O.dt = 1 # whole load at once
O.step()
assert outOfBalance() < 1e-8, outOfBalance()
for body in O.bodies:
	if body.state.refPos[1] > 25: O.bodies.erase(body.id)
O.step()
assert solver.report()['points'] == 16 and outOfBalance() < 1e-8, outOfBalance()
before = mpm.arrays()['pos'][:, 1].max()
O.materials['soil'].young, O.materials['soil'].density = 4e4, 160
O.step()
assert outOfBalance() < 1e-8 and mpm.arrays()['pos'][:, 1].max() > before + 1

h = 50 / 8
hanging = O.bodies.append(mpm.fill(pack.inAlignedBox((0, 5 * h, -1), (h, 7 * h, 1)), solver.grid, 2, 'soil'))
with refused(RuntimeError, 'nothing restrains the translation along y of the material around (3.125, 37.5)'):
	O.step()
assert solver.report()['islands'] == 2
for id in hanging:
	O.bodies.erase(id)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 3 * h, -1), (h, 4 * h, 1)), solver.grid, 2, 'soil')) # into the numbers that are free now
O.step()
assert solver.report()['points'] == 20 and solver.report()['islands'] == 1 and outOfBalance() < 1e-8, outOfBalance()
O.bodies.clear()
with refused(ValueError, 'no material points'):
	O.step()
'''
	)


def test_engines_share_a_scene_by_masks(yade):
	"""Two slopes, one of them far to the right on a finer grid, each as it goes alone; points of neither engine stay as they are."""
	yade(
	        refusing + '''
def right(bodies):
	for body in bodies:
		body.groupMask = 2
	return bodies
def block(x, grid):
	return mpm.fill(pack.inAlignedBox((x, 0, -1), (x + 4, 4, 1)), grid, 2, 'soil')
def engine(grid, x, mask=-1):
	return MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), mask=mask, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])
def soil():
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=25e3, label='soil'))
coarse, fine = MpmGrid(cellSize=1), MpmGrid(cellSize=0.5, origin=(0.1, 0, 0))
alone = []
for x, grid in (0, coarse), (10.1, fine):
	O.reset()
	soil()
	O.bodies.append(block(x, grid))
	O.engines, O.dt = [engine(grid, x)], 1 / 4
	O.run(4, wait=True)
	alone.append(mpm.arrays()['pos'])
	assert abs(alone[-1] - mpm.arrays()['pos0']).max() > 1e-2
O.reset()
soil()
O.bodies.append(block(0, coarse) + right(block(10.1, fine)))
bystander = O.bodies.append(mpm.fill(pack.inAlignedBox((30, 9, -1), (34, 10, 1)), coarse, 2, 'soil')[0])
O.bodies[bystander].groupMask = 4
one, two = engine(coarse, 0), engine(fine, 10.1)
O.engines, O.dt = [one, two], 1 / 4
with refused(ValueError, 'Body #0', 'two engines with material points'):
	O.step()
one.mask, two.mask = 1, 3
with refused(ValueError, 'Body #0', 'mask = 1 and 3', 'groupMask'):
	O.step()
two.mask = 2
O.engines = [one, two, MpmVtkRecorder(fileName='one-')]
with refused(ValueError, 'solver'):
	O.step()
two.label = 'two'
O.engines = [one, two, MpmVtkRecorder(fileName='two-', solver='two', recorders=['all'])]
O.run(4, wait=True)
pos = mpm.arrays()['pos']
n = len(alone[0])
assert np.array_equal(pos[:n], alone[0]) and np.array_equal(pos[n:-1], alone[1])
assert np.array_equal(pos[-1], mpm.arrays()['pos0'][-1])
assert one.stiffness()[3] != two.stiffness()[3] and two.report()['points'] == len(alone[1])
two.mask = 8
with refused(ValueError, 'groupMask', 'mask = 8'):
	O.step()
two.dead, one.mask = True, 0
moved = mpm.arrays()['pos']
O.step() # the rest of the iteration, in which the first engine has made its step
assert np.array_equal(mpm.arrays()['pos'], moved)
O.step() # a point by itself, which this engine has now, too, is held
assert one.report()['loosePoints'] == 1 and np.array_equal(mpm.arrays()['pos'][-1], moved[-1])
O.engines = [one, one]
with refused(ValueError, 'listed 2 times'):
	O.step()
'''
	)
	from vtu import Vtu
	assert len(Vtu(yade.folder / 'two-points.4.vtu')) == 256


def test_copies_of_an_engine(yade):
	"""A copy goes on where the original stands, also one that shares its objects; both in one scene would move points twice."""
	yade(
	        refusing + '''
from copy import copy, deepcopy
original = slope()
O.run(5, wait=True)
O.saveTmp()
O.run(5, wait=True)
straight = mpm.arrays()
for copied in deepcopy, copy, lambda e: MpmImplicitEngine(**{k: v for k, v in e.dict().items() if k in settable}):
	O.loadTmp()
	engine = O.engines[0]
	settable = ('grid', 'basis', 'domains', 'gravity', 'loadCurve', 'gravityCurve', 'boundaries', 'ghost', 'newton', 'loadTime', 'mask', 'label')
	twin = copied(engine)
	assert twin is not engine and twin.loadTime == engine.loadTime and twin.report() == {}
	O.engines = [engine, twin]
	with refused(ValueError, 'Body #0', 'two engines with material points'):
		O.step()
	O.engines = [twin]
	O.run(5, wait=True)
	points = mpm.arrays()
	assert all(np.array_equal(points[name], straight[name]) for name in points), copied
'''
	)


@pytest.mark.parametrize('points', [1, 40000])
def test_all_points_in_one_cell(yade, points):
	"""From a single one to very many."""
	yade(
	        virial + f'''
from scenes import *
O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), grid, round({points}**0.5), 'soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(1, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides, label='solver', newton=MpmNewton(tolerance=1e-9))
O.engines, O.dt = [solver], 1
O.step()
report = solver.report()
assert (report['points'], report['activeCells'], report['dofs']) == ({points}, 1, 2), report
assert outOfBalance() < 1e-8, outOfBalance()
''',
	        threads=2
	)


def test_python_may_ask_while_the_scene_runs(yade):
	"""Python gets one converged state, whole; also with bodies erased in the middle of a step and values assigned."""
	yade(
	        refusing + '''
import time
solver = slope(steps=200)
states = []
for i in range(40):
	O.step()
	states.append(mpm.arrays()['pos'])
O.reset()
solver = slope(steps=200)
O.run(40)
seen = set()
while O.running:
	pos, factor = mpm.arrays()['pos'], solver.loadFactor
	found = [i for i, state in enumerate(states) if np.array_equal(pos, state)]
	assert found or np.array_equal(pos, mpm.arrays()['pos0']), 'torn state'
	seen.update(found)
	len(solver.residuals), solver.report(), solver.dict()
	solver.boundaries, solver.loadCurve = solver.boundaries, solver.loadCurve
	solver.grid, solver.newton, solver.ghost = MpmGrid(cellSize=1), MpmNewton(predictor=False, reuseFactor=False), MpmGhost()
	mpm.save('now.yade.gz')
	solver.stiffness()
assert len(seen) > 3, seen
O.wait()
assert np.array_equal(mpm.arrays()['pos'], states[-1])
O.run(5)
with refused(RuntimeError, 'called while the scene runs'):
	solver()
with refused(RuntimeError, 'assign: a load step is at work'):
	while O.running:
		mpm.assign(plasticStrain=np.zeros(1095))
O.wait()
assert O.iter == 45
O.run(20)
for id in range(800, 900):
	O.bodies.erase(id)
	time.sleep(1e-3)
O.wait()
O.load('now.yade.gz')
pos = mpm.arrays()['pos']
assert any(np.array_equal(pos, state) for state in states) or np.array_equal(pos, mpm.arrays()['pos0'])
'''
	)


def test_a_scene_is_reset_in_the_middle_of_a_step(yade):
	"""Also while that step is being refused; and the next scene is as if there had been none.

	Not before the thread of the run has begun: YADE itself then crashes now and then, with any engine.
	"""
	yade(
	        refusing + '''
import threading, time
slope()
O.run(10, wait=True)
expected = mpm.arrays()['pos']
for delay in 0, 0.001, 0.01, 0.05, 0.2:
	for bad in False, True:
		O.reset()
		solver = slope(cellSize=0.5)
		if bad: O.bodies[7].state.force[1] = float('nan')
		began = threading.Event()
		O.engines = [PyRunner(iterPeriod=1, initRun=True, command='began.set()'), *O.engines]
		O.run(10)
		try:
			assert began.wait(60)
			time.sleep(delay)
			O.reset()
		except RuntimeError as error: # of the background
			assert bad and 'Body #7' in str(error)
			O.reset()
		assert len(O.bodies) == 0 and len(O.engines) < 9
slope()
O.run(10, wait=True)
assert np.array_equal(mpm.arrays()['pos'], expected)
'''
	)


interrupted = refusing + '''
import os, signal, subprocess, time
def press(seconds):
	"""Ctrl-C after a while; from outside, since O.step() keeps the other threads of Python from running."""
	subprocess.Popen(['sh', '-c', f'sleep {seconds}; kill -INT {os.getpid()}'])
	return time.time() + seconds
def hard():
	"""Its steps near failure take tens of iterations."""
	solver = slope(cellSize=0.25, steps=2)
	solver.newton.minStep, solver.newton.maxIterations = 1 / 64, 1000
	return solver
'''


@pytest.mark.parametrize('run', ['O.run(2, wait=True)', 'O.run(2); O.wait()', 'O.step(); O.step()', 'solver()'])
def test_ctrl_c_stops_a_step_within_an_iteration(yade, run):
	"""It leaves the last converged state, from which the run can go on to the result that it would have had."""
	yade(
	        interrupted + f'''
solver = hard()
O.step() # the first half
half, factor = mpm.arrays(), solver.loadFactor
pressed = press(0.15)
try:
	{run}
	assert False, 'went on'
except KeyboardInterrupt:
	assert time.time() - pressed < 2, time.time() - pressed
assert not O.running and O.iter == 1 and (solver.loadFactor, solver.loadTime) == (factor, O.time)
assert not solver.converged and solver.report()['failure'] == 'interrupted' and solver.iterations < 900
assert all(np.array_equal(half[name], values) for name, values in mpm.arrays().items())
'''
	)


def test_an_uncaught_ctrl_c_ends_the_script(yade):
	run = yade(interrupted + 'hard()\nO.step()\npress(0.15)\nO.run(2, wait=True)\nprint("went on")', fails=True)
	assert 'KeyboardInterrupt' in run.stdout + run.stderr and 'went on' not in run.stdout
	assert 'it was interrupted' in run.stderr and 'last converged state' in run.stderr


def test_ctrl_c_for_somebody_else_leaves_a_background_run_alone(yade):
	"""For the script, which does something else meanwhile, or has a handler of its own; afterwards it works as before."""
	yade(
	        interrupted + '''
solver = slope(cellSize=0.5, steps=400)
O.run(30)
press(0.2)
try:
	while O.running:
		time.sleep(0.01)
	assert False
except KeyboardInterrupt:
	pass
while O.running: # Python executes
	solver.iterations
assert O.iter == 30 and solver.converged

presses = []
default = signal.signal(signal.SIGINT, lambda *_: presses.append(O.iter))
press(0.2)
O.run(30, wait=True)
time.sleep(0) # after a call with keywords Python 3.14 does not look for signals
assert O.iter == 60 and len(presses) == 1, presses

signal.signal(signal.SIGINT, default)
press(0.2)
with refused(KeyboardInterrupt):
	O.run(30, wait=True)
assert 60 <= O.iter < 90
press(0.2)
with refused(KeyboardInterrupt):
	while True:
		pass
O.run(90 - O.iter, wait=True)
assert O.iter == 90
'''
	)
