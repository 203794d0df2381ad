# SPDX-License-Identifier: GPL-2.0-or-later
"""Load steps chosen by an estimate of their error: newton.stepTolerance."""
import pytest

scene = '''
from scenes import *
from yade.wrapper import MpmContact, MpmDynamicEngine, MpmTraction

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
soft(0, steps=160)
O.run(160, wait=True)
exact, displacement = mpm.arrays()['pos'], rms(mpm.arrays()['pos'] - mpm.arrays()['pos0'])
assert O.engines[0].report()['localError'] == 0 # nobody asks
errors, made = [], []
for tolerance in 0.03, 0.003:
	solver = soft(tolerance)
	O.step()
	assert 0 < solver.report()['localError'] <= 1
	errors.append(rms(mpm.arrays()['pos'] - exact))
	made.append(solver.substeps)
assert 8 <= made[0] < 24 and made[1] > 1.5 * made[0], made
assert errors[1] < errors[0] / 2 < 0.05 * displacement, (errors, displacement)
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


def test_the_estimate_is_about_what_finer_steps_change(yade):
	"""Within a factor of two, for a footing that is pressed into clay: the estimates of all steps together, against the difference to four times as many."""
	yade(scene + '''
from yade import utils

def footing(steps):
	O.reset()
	B, h, cu = 1., 0.25, 1e4
	grid = MpmGrid(cellSize=h)
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.49, density=1800, yieldStress=np.sqrt(2) * cu, label='clay'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -1.5 * B, -1), (2 * B, 0, 1)), grid, 2, 'clay'))
	box = O.bodies[O.bodies.append(utils.box((0, 2 * B, 0), (B / 2, 2 * B, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -0.1 * B, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2 * B, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1.5 * B, inf), fix='xy')]
	newton = MpmNewton(stepTolerance=1, minStep=1)
	O.engines = [MpmImplicitEngine(grid=grid, fBar=True, boundaries=sides, contacts=[MpmContact(friction=0)], newton=newton, verbosity=0, label='solver')]
	O.dt, error = 1 / steps, 0
	for step in range(steps):
		O.step()
		error += O.engines[0].report()['localError']
	return mpm.arrays()['pos'], error

fine, _ = footing(80)
for steps in 10, 20:
	pos, estimate = footing(steps)
	assert 0.5 < estimate / rms(pos - fine) < 2, (steps, estimate, rms(pos - fine))
''')


def test_loads_that_turn_begin_with_small_steps(yade):
	yade(scene + '''
solver = soft(0.01, steps=2)
solver.loadCurve = [(0, 0), (0.5, 1), (1, 0.5)]
O.run(2, wait=True)
assert solver.substeps == 4, solver.substeps # unloading is elastic: 1/8, 1/4, 1/2 and the rest
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


def test_steps_that_cannot_be_cut_so_far_fail_and_say_why(yade):
	yade(scene + '''
solver = soft(1e-6, steps=8, minStep=1 / 2)
try:
	O.run(8, wait=True)
	assert False
except RuntimeError as error:
	assert all(word in str(error) for word in ('local error', '1e-06 m', 'newton.stepTolerance', 'newton.minStep')), error
report = solver.report()
assert report['failure'] == 'inaccurate' and report['localError'] > 1 and abs(report['loadTime'] - solver.loadFactor) < 1e-12
''')
