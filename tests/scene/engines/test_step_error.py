# SPDX-License-Identifier: GPL-2.0-or-later
"""Load steps chosen by an estimate of their error: newton.stepTolerance."""
import pytest

scene = '''
from scenes import *
from yade.wrapper import MpmDynamicEngine, MpmTraction

rms = lambda vectors: np.sqrt((vectors**2).sum(axis=1).mean())

def soft(tolerance, steps=1, minStep=1 / 1024):
	"""A block that is too heavy for its strength, on cells of half a metre."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
	grid = MpmGrid(cellSize=0.5)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (4, 4, 1)), grid, 2, 'soil'))
	boundaries = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	newton = MpmNewton(stepTolerance=tolerance, minStep=minStep)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries, gravity=(0, -7, 0), newton=newton, verbosity=0, label='solver')]
	O.dt = 1 / steps
	return O.engines[0]
'''


def test_smaller_tolerances_make_more_steps_and_smaller_errors(yade):
	yade(scene + '''
def run(tolerance, steps):
	"""Positions and displacements of the points of the slope."""
	O.reset()
	solver = slope(steps=steps)
	solver.newton = MpmNewton(stepTolerance=tolerance)
	O.run(steps, wait=True)
	points = mpm.arrays()
	return points['pos'], points['pos'] - points['pos0']

fine, displacements = run(0, 80)
assert O.engines[0].report()['localError'] == 0 # nobody asks
errors, made = [], []
for tolerance in 0.06, 0.006:
	errors.append(rms(run(tolerance, 1)[0] - fine) / rms(displacements))
	solver = O.engines[0]
	assert 0 < solver.report()['localError'] <= 1 and solver.loadFactor == 1
	made.append(solver.substeps)
assert 6 <= made[0] <= 12 and 2 * made[0] <= made[1] < 40, made
assert errors[1] < errors[0] / 2 < 0.02, errors
''')


def test_what_does_not_yield_takes_a_few_growing_steps(yade):
	yade(scene + '''
solver = column(16)
solver.newton = MpmNewton(stepTolerance=1e-6)
O.dt = 1
O.step()
assert solver.substeps == 4 and solver.cuts == 0, (solver.substeps, solver.cuts) # 1/8, 1/4, 1/2 and the rest
assert solver.report()['localError'] == 0
''')


def test_the_estimate_is_what_finer_steps_change(yade):
	"""Within a factor of two, where the error is known to be of second order in a step: a cube under three pressures whose deviator turns. Stresses are given, and the plastic strain of a step has the
	direction at its end, so that a step is wrong by half of the change of its rate. These errors add up along an arc, and the difference at the end is its chord."""
	yade(scene + '''
def cube(steps):
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e9, poisson=0.3, density=1, yieldStress=1e5, hardening=1e8, label='soil'))
	grid = MpmGrid(cellSize=1, dim=3)
	box = pack.inAlignedBox((0, 0, 0), (1, 1, 1))
	O.bodies.append(mpm.fill(box, grid, 2, 'soil'))
	t = np.linspace(0, 2, 321)
	angle, size = 2 * np.pi / 3 * np.maximum(t - 1, 0), 1e5 * np.maximum(t, 4 * t - 3) # of the deviator: to yield, and on in another direction
	loads, sides = [], []
	for axis in range(3):
		low, high = [-np.inf] * 3, [np.inf] * 3
		low[axis], high[axis] = 1, 0
		pressure = size * np.cos(angle + 2 * np.pi / 3 * axis)
		loads.append(MpmTraction(surface=mpm.surface(box, min=low, dim=3), pressure=1, curve=list(zip(t.tolist(), pressure.tolist()))))
		sides.append(MpmBoundary(max=high, fix='xyz'[axis]))
	newton = MpmNewton(stepTolerance=1, minStep=0.5)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, loads=loads, newton=newton, loadCurve=[(0, 0), (2, 2)], verbosity=0)]
	O.dt = 1
	O.step()
	O.dt, error = 1 / steps, 0
	for step in range(steps):
		O.step()
		error += O.engines[0].report()['localError']
	return mpm.arrays()['pos'], error
fine, _ = cube(80)
for steps in 10, 20:
	pos, estimate = cube(steps)
	assert 0.5 < estimate / rms(pos - fine) < 2, (steps, estimate, rms(pos - fine))
''')


def test_loads_that_turn_begin_with_small_steps(yade):
	yade(scene + '''
solver = column(16)
solver.newton, solver.loadCurve, O.dt = MpmNewton(stepTolerance=1e-6), [(0, 0), (2, 2), (3, 1)], 1
made = []
for step in range(3):
	O.step()
	made.append(solver.substeps)
assert made == [4, 1, 4], made
''')


def test_a_saved_scene_goes_on_with_the_same_steps_and_bits(yade):
	yade(scene + '''
solver = soft(0.01, steps=4)
O.run(2, wait=True)
O.save('half.xml')
O.run(2, wait=True)
whole, part, tried = mpm.arrays()['pos'], solver.stepPart, solver.report()['localError']
assert part < 1
''')
	yade(scene + '''
O.load('half.xml')
solver = O.engines[0]
assert solver.newton.stepTolerance == 0.01
O.run(2, wait=True)
continued = mpm.arrays()['pos'], solver.stepPart, solver.report()['localError']
solver = soft(0.01, steps=4)
O.run(4, wait=True)
assert (continued[0] == mpm.arrays()['pos']).all() and continued[1:] == (solver.stepPart, solver.report()['localError'])
''')


@pytest.mark.parametrize(
        'change, words', [
                ('solver.newton.predictor = False', ['MpmNewton.stepTolerance = 0.01', 'predictor=False']),
                ('solver.newton.minStep = 1', ['MpmNewton.stepTolerance = 0.01', 'minStep = 1', '<= 1/2']),
                ('O.engines = [MpmDynamicEngine(grid=solver.grid, newton=solver.newton, gravity=(0, -7, 0))]', ['MpmNewton.stepTolerance', 'quasi-static', 'timeTolerance']),
                ('solver.newton.stepTolerance = float("nan")', ['MpmNewton.stepTolerance', '>= 0']),
        ])
def test_settings_that_cannot_be_are_refused(yade, change, words):
	yade(scene + f'''
solver = soft(0.01)
try:
	{change}
	O.step()
	assert False, 'not refused'
except ValueError as error:
	assert all(word in str(error) for word in {words}), error
''')


def test_steps_that_are_not_cut_further_are_made_with_a_warning(yade):
	run = yade(scene + '''
solver = soft(1e-6, steps=8, minStep=1 / 2)
for step in range(8):
	O.step()
	assert solver.substeps <= 2 and solver.report()['localError'] == 0 # of the steps that are made nobody asks
''')
	said = [line for line in run.stderr.splitlines() if 'newton.stepTolerance' in line]
	assert 1 <= len(said) <= 8 and all('local error' in line and '1e-06 m' in line and 'newton.minStep' in line for line in said), run.stderr
