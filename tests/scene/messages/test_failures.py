# SPDX-License-Identifier: GPL-2.0-or-later
"""Failures as a user meets them: a reason, an exit code, and a scene that is still usable."""
import json

import pytest

failing = '''
from scenes import *
solver = slope()
solver.newton.maxIterations = 2 # the elastic steps at the beginning need no more, those near failure do
solver.newton.minStep = 1
'''


@pytest.mark.parametrize('call', ['O.run(40, wait=True)', '[O.step() for i in range(40)]', 'O.run(40)\nO.wait()'])
def test_a_failed_script_ends_with_a_reason_and_an_exit_code(yade, call):
	run = yade(failing + call, fails=True)
	assert 'is above the tolerance 1e-06 after 2 iterations' in run.stderr + run.stdout
	assert run.exitCode == 1


def test_a_failure_in_the_first_step_of_a_background_run_is_not_lost(yade):
	"""The worker has then often ended before O.wait() looks at it."""
	for attempt in range(5):
		run = yade(failing + 'solver.newton.maxIterations = 1\nO.run(40, wait=True)\nprint("went on")', fails=True)
		assert 'went on' not in run.stdout


def test_a_run_that_fails_twice_is_told_of_once(yade):
	"""In a ParallelEngine the second engine fails when the script has seen the first error and goes on. Steps of other scenes tell of theirs."""
	assert yade(
	        '''
import json, time
from scenes import *
def inParallel(*engines):
	O.reset()
	solver = slope()
	O.engines, O.dt = [ParallelEngine([[solver, *engines, MpmImplicitEngine(grid=solver.grid, boundaries=solver.boundaries, verbosity=0)]])], 1
def errors(run):
	found = []
	for call in run, lambda: time.sleep(0.4), lambda: 1:
		try: call()
		except Exception as error: found.append(type(error).__name__)
	return found
inParallel(PyRunner(command='time.sleep(0.2)', iterPeriod=1, initRun=True))
ofRun = errors(lambda: O.run(3, wait=True))
inParallel()
print(json.dumps([ofRun, errors(O.step)]))
'''
	).result == [['RuntimeError'], ['ValueError']]


def test_a_failed_step_leaves_the_scene_as_it_was_and_can_be_repeated(yade):
	yade(
	        failing + '''
message = ''
try:
	while O.iter < 40:
		before, time, factor = mpm.arrays(), O.time, solver.loadFactor
		O.step()
except RuntimeError as error:
	message = str(error)
after, failedAt = mpm.arrays(), O.iter
assert 0 < failedAt < 40, failedAt
assert 'largest out-of-balance force' in message and f'iteration {failedAt}' in message, message
assert all(np.array_equal(before[k], after[k]) for k in before)
assert (O.time, solver.loadFactor, solver.converged) == (time, factor, False)

solver.newton.maxIterations = 20
O.step() # not skipped by the engine's period
assert O.iter == failedAt + 1 and solver.converged and solver.loadFactor > factor
assert not np.array_equal(mpm.arrays()['pos'], after['pos'])
'''
	)


def test_a_step_that_does_not_converge_is_cut(yade):
	"""The whole load at once, without line search: it converges in parts, and the next step starts with the part that worked."""
	yade(
	        '''
from scenes import *
solver = slope(steps=1)
solver.newton.lineSearchTrials = 0
O.step()
assert (O.iter, solver.loadFactor, solver.converged) == (1, 1, True)
assert solver.cuts > 0 and solver.substeps > 1 and solver.iterations > 20, (solver.cuts, solver.substeps, solver.iterations)
largest = np.linalg.norm(mpm.arrays()['pos'] - mpm.arrays()['pos0'], axis=1).max()
assert abs(largest - 2.6124) < 0.02, largest # as in 40 steps
'''
	)


def test_cutting_ends_with_a_reason_at_the_last_converged_state(yade):
	"""Two iterations are not enough near failure however small the step."""
	yade(
	        failing + '''
solver.newton.minStep = 1 / 8
solver.newton.maxIterations = 1
solver.loadCurve = [(0, 0), (1, 20)]
try:
	O.step()
	assert False, solver.cuts
except RuntimeError as error:
	message = str(error)
assert '0.125 of O.dt, after 3 cuts' in message and 'more than the body can carry' in message, message
assert O.iter == 0 and solver.loadTime == 0 and not solver.converged
assert np.array_equal(mpm.arrays()['pos'], mpm.arrays()['pos0'])
'''
	)


def test_unconverged_steps_pass_only_on_request_and_with_a_warning(yade):
	run = yade(failing + '''
solver.newton.maxIterations = 3
solver.newton.acceptUnconverged = True
accepted = 0
for step in range(40):
	O.step()
	accepted += not solver.converged
assert 0 < accepted < 40 and solver.loadFactor > 0.99
print('accepted', accepted)
''')
	accepted = int(run.stdout.splitlines()[-1].split()[1])
	assert (run.stdout + run.stderr).count('has not converged and is accepted') == accepted


def test_pause_stops_within_an_iteration_and_the_run_can_go_on(yade):
	yade(
	        '''
import time
from scenes import *
solver = slope(cellSize=0.5, pointsPerCell=4, steps=4)
O.run(4)
while O.iter < 1: # past failure in the second half: many iterations of some 20 ms
	time.sleep(0.005)
time.sleep(0.05)
O.pause()
begin = time.time()
while not solver.residuals or O.running:
	time.sleep(0.001)
time.sleep(0.5)
stopped, factor, positions = O.iter, solver.loadFactor, mpm.arrays()['pos']
assert stopped < 4 and solver.loadTime == O.time, (stopped, solver.loadTime, O.time)
time.sleep(0.5)
assert np.array_equal(mpm.arrays()['pos'], positions) # nothing runs any more
O.run(4 - stopped, wait=True)
assert O.iter == 4 and solver.loadFactor == 1
'''
	)


mistakes = [
        ('solver.boundaries = []', 'nothing restrains the translation along x'),
        ('solver.boundaries = solver.boundaries[:2]', 'nothing restrains the translation along y'),
        ('O.dt = 0', 'O.dt = 0'),
        ('O.dt = float("nan")', 'O.dt = nan'),
        ('solver.grid = MpmGrid()', 'MpmGrid.cellSize = nan'),
        ('solver.grid.cellSize = 0.25', 'Body #0: MpmPoint.halfSize'),
        ('solver.boundaries = [MpmBoundary(min=(0.2, 0.2, -1), max=(0.8, 0.8, 1), fix="x")]', 'contains no grid node'),
        ('solver.boundaries = [MpmBoundary(fix="z")]', "no direction z"),
        ('solver.boundaries += (MpmBoundary(max=(inf, 0, inf), fix="y", displacement=(0, 1, 0)),)', 'different displacements along y'),
        ('O.bodies[7].state.pos = (float("nan"), 0, 0)', 'Body #7'),
        ('O.bodies[7].state.pos = (1e12, 0, 0)', 'Body #7'),
        ('O.bodies[7].material = FrictMat()', 'Body #7'),
        ('O.bodies[7].material = MpmMaterial(density=1)', 'Body #7'),
        ('O.bodies[7].material = MpmElasticMat(density=1, young=1)', 'Body #7'),
        ('O.bodies[7].state = State()', 'state'),
        ('O.bodies.clear()', 'no material points'),
        ('O.periodic = True', 'periodic'),
        ('O.materials["soil"].young = -1', 'MpmElasticMat.young = -1'),
        ('O.materials["soil"].yieldStress = 0', 'MpmVonMisesMat.yieldStress = 0'),
        ('O.materials["soil"].poisson = 0.5', 'MpmElasticMat.poisson = 0.5'),
        ('O.materials["soil"].density = float("nan")', 'MpmMaterial.density = nan'),
        ('solver.loadCurve = []', 'MpmImplicitEngine.loadCurve'),
        ('solver.loadCurve = [(0, 0), (0, 1)]', 'MpmImplicitEngine.loadCurve'),
        ('solver.gravity = (0, float("inf"), 0)', 'MpmImplicitEngine.gravity'),
        ('solver.basis = "cubic"', 'MpmImplicitEngine.basis'),
        ('solver.grid = None', 'MpmImplicitEngine.grid'),
        ('solver.tolerance = 1e-6', 'tolerance'),
        ('MpmGrid(cellSize=1, dim=4)', 'MpmGrid.dim = 4'),
]


def test_bad_input_names_itself(yade):
	run = yade(
	        f'''
import json
from scenes import *
messages = []
for change in json.loads({json.dumps(json.dumps([change for change, words in mistakes]))}):
	O.reset()
	solver = slope()
	try:
		exec(change)
		O.step()
		messages.append(None)
	except (ValueError, RuntimeError, AttributeError, TypeError) as error:
		messages.append(str(error))
	assert O.iter == 0 or messages[-1] is None, change
print(json.dumps(messages))
'''
	)
	for (change, words), message in zip(mistakes, run.result):
		assert message and words in message, f'{change}: {message}'


def test_stiffness_can_be_asked_for_while_the_scene_runs(yade):
	"""It waits for the step at work; also when that step is about to be refused."""
	yade(
	        '''
from scenes import *
solver = slope(cellSize=0.5)
O.run(20)
sizes = {solver.stiffness()[3] for i in range(5)}
assert all(1900 < size < 2300 for size in sizes), sizes
O.wait()
O.reset()
solver = slope()
O.bodies[7].state.pos = (float('nan'), 0, 0)
O.run(5)
try:
	solver.stiffness()
	assert False
except (ValueError, RuntimeError) as error:
	assert 'Body #7' in str(error)
'''
	)
