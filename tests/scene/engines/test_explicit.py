# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmDynamicEngine(scheme='explicit') in the real YADE."""
import numpy as np
import pytest
from test_dynamics import requireExactRestart
from test_dynamics import scene as motion

scene = motion + '''

def explicitBlock(*args, mass='consistent', **settings):
	solver = block(*args, scheme='explicit', ghost=MpmGhost(factor=1e-2 if mass == 'consistent' else 0), **settings)
	O.dt = 0.9 * solver.criticalTimeStep()
	return solver

def energy(solver):
	data = solver.plotData()
	return data['kineticEnergy'] + data['elasticEnergy']
'''


@pytest.mark.parametrize('dim', [2, 3])
def test_free_fall_is_exact_and_its_energy_balances(yade, dim):
	yade(scene + f'''
for mass in 'consistent', 'lumped':
	O.reset()
	solver = explicitBlock((0.3, 0.2, 0), (3.3, 2.2, {2 if dim == 3 else 1}), {dim}, mass=mass, gravity=(0, -10, 0))
	O.dt = 0.01
	velocities(3, 0, 0)
	before = mpm.arrays()['pos']
	O.run(50, wait=True)
	points, data = mpm.arrays(), solver.plotData()
	assert np.abs(points['pos'] - before - (1.5, -1.25, 0)).max() < 1e-11, mass
	assert np.abs(points['velocity'] - (3, -5, 0)).max() < 1e-11
	bodies = sum(b.state.mass for b in O.bodies)
	assert abs(data['momentum_y'] / (-5 * bodies) - 1) < 1e-12
	assert abs(data['loadWork'] / (12.5 * bodies) - 1) < 1e-11
	assert abs(data['energyImbalance']) < 1e-9 * data['loadWork']
''')


def test_a_saved_scene_goes_on_bit_for_bit(yade):
	requireExactRestart(
	        yade, scene, '''
solver = explicitBlock((0.2, 0.1, 0), (3.2, 3.1, 1), poisson=0.3, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])
''', 15)


def test_the_critical_step_goes_with_cells_and_waves(yade):
	yade(scene + '''
found = {}
for name, settings in dict(usual={}, fine=dict(cellSize=0.5), stiff=dict(young=4e6), lumped=dict(mass='lumped'), lightGhost=dict()).items():
	O.reset()
	solver = explicitBlock(**settings)
	if name == 'lightGhost': solver.ghost.massFactor = 1e-3
	found[name] = solver.criticalTimeStep() * (1e6 / 2000)**0.5
assert 0.4 < found['usual'] < 0.42 and 0.54 < found['lumped'] < 0.56, found
assert abs(found['fine'] / found['usual'] - 0.5) < 1e-9 and abs(found['stiff'] / found['usual'] - 0.5) < 1e-9, found
assert found['lightGhost'] < 0.3 * found['usual'], found
solver.contacts = [MpmContact(stiffness=100)]
try: assert not solver.criticalTimeStep()
except ValueError as error: assert 'no body that could touch the soil' in str(error), 'as in a step'
from yade import utils
O.bodies.append(utils.wall(-1, axis=1, sense=1, material=FrictMat(density=1000)))
assert solver.criticalTimeStep() < 0.1, 'penalties count'
''')


@pytest.mark.parametrize('mass', ['consistent', 'lumped'])
def test_two_blocks_meet(yade, mass):
	"""Through the grid, up to a cell early. The total momentum does not change, and no energy comes from nowhere."""
	run = yade(scene + f'mass = {mass!r}' + '''
solver = explicitBlock((0.3, 0, 0), (3.3, 2, 1), mass=mass, density=1000)
O.bodies.append(mpm.fill(pack.inAlignedBox((5.1, 0, 0), (9.1, 2, 1)), solver.grid, pointsPerCell=2, material='soil'))
x = mpm.arrays()['pos'][:, 0]
mpm.assign(velocity=[(1 if place < 4 else -0.5, 0, 0) for place in x])
before, first, most = solver.plotData()['momentum_x'], energy(solver), 0
while O.time < 1.2:
	O.step()
	most = max(most, energy(solver))
data = solver.plotData()
v = mpm.arrays()['velocity'][:, 0]
print(json.dumps([abs(data['momentum_x'] - before) / before, most / first, v[x < 4].mean(), data['ghostWork'] / first]))
''')
	momentum, most, left, _ = run.result
	assert momentum < 1e-10
	assert most < 1 + 2e-3 # at 0.9 of the critical step; it falls with the square of it
	assert left < 0.5, 'they have met'


def test_a_block_bounces_off_a_box(yade):
	run = yade(scene + '''
from yade import utils
c, speed = (1e6 / 1000)**0.5, 0.05
solver = explicitBlock((0, 0, 0), (1, 8, 1), cellSize=0.5, density=1000)
O.materials.append(FrictMat(young=1e9, frictionAngle=0, label='steel'))
O.bodies.append(utils.box((0.5, -0.5, 0), (2, 0.5, 1), fixed=True, material='steel')) # they touch
solver.contacts = [MpmContact(friction=0, stiffness=20)]
velocities(0, -speed, 0)
O.dt = 0.25 * solver.criticalTimeStep()
mass = solver.plotData()['momentum_y'] / -speed
first, most, impulse = energy(solver), 0, 0
while O.time < 3 * 8 / c:
	O.step()
	most = max(most, energy(solver))
	impulse -= O.dt * solver.contacts[0].forces[0][1] # by the trapezoidal rule, as nothing touches at the end
data = solver.plotData()
print(json.dumps([data['momentum_y'] / mass / speed, most / first, impulse / (data['momentum_y'] + mass * speed)]))
''')
	speed, most, impulse = run.result
	assert 0.95 < speed < 1 # some of the wave's energy stays in the bar
	assert most < 1 + 1e-3
	assert impulse == pytest.approx(1, abs=1e-9)


def test_waves_come_in_and_leave(yade):
	"""An edge whose dashpots are as stiff as its nodes are light costs no stability, and takes in second order what arrives."""
	run = yade(scene + '''
O.materials.append(MpmElasticMat(young=1e6, poisson=0.25, density=1000, label='soil'))
grid, cp = MpmGrid(cellSize=1, period=(3, 0, 0)), (3 * 400)**0.5
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (3, 12, 1)), grid, pointsPerCell=2, material='soil'))
pulse = lambda t: 1e-4 * np.exp(-((t - 1) / 0.4)**2)
edge = MpmAbsorbingBoundary(max=(inf, 0, inf), motion=MpmBaseMotion(history=[(t, float(pulse(t))) for t in np.linspace(0, 2, 401)], direction=(0, 1, 0)))
solver = MpmDynamicEngine(grid=grid, absorbing=[edge], scheme='explicit', verbosity=0)
O.engines = [solver]
h = mpm.histories([(0.25, 11.75, 0)], record=['velocity'])
O.dt = 0.95 * solver.criticalTimeStep()
O.run(int(3.2 / O.dt), wait=True)
t, v = np.array(h.time), h['velocity'][:, 0, 1]
data = solver.plotData()
print(json.dumps([np.abs(v - pulse(t - 11.75 / cp) - pulse(t - 12.25 / cp)).max() / 2e-4, data['boundaryWork'], energy(solver), data['energyImbalance']]))
''')
	error, work, left, imbalance = run.result
	assert error < 0.01
	assert left < 1e-7 and abs(imbalance) < 1e-6, 'of some 3e-4 J that went through'


def test_boundaries_carry_and_shake(yade):
	"""A displacement prescribed at constant speed, and a base that moves by a history, take a stiff block along."""
	yade(scene + '''
solver = explicitBlock(young=1e7, loadCurve=[(0, 0), (1, 1)])
solver.boundaries = [MpmBoundary(fix='y'), MpmBoundary(max=(0, inf, inf), fix='x', displacement=(0.2, 0, 0))]
mean = []
for step in range(int(0.8 / O.dt)): # it swings to and fro on the boundary
	O.step()
	mean.append(mpm.arrays()['velocity'][:, 0].mean())
assert abs(np.mean(mean) - 0.2) < 0.02 and solver.plotData()['boundaryWork'] > 0, np.mean(mean)
O.reset()
solver = explicitBlock(young=1e7)
ramp = lambda t: 0.1 * (1 - np.cos(np.pi * t))
solver.boundaries = [MpmBoundary(fix='y'), MpmBoundary(max=(0, inf, inf), fix='x', motion=MpmBaseMotion(history=[(t, float(ramp(t))) for t in np.linspace(0, 1, 201)], direction=(1, 0, 0)))]
O.run(int(0.9 / O.dt), wait=True)
v, data = mpm.arrays()['velocity'][:, 0], solver.plotData()
assert np.abs(v - ramp(O.time)).max() < 2e-3, v
assert abs(data['boundaryWork'] / data['kineticEnergy'] - 1) < 0.01, data
''')


def test_a_failing_step_leaves_the_scene(yade):
	run = yade(scene + '''
solver = explicitBlock()
velocities(1, 0, 0)
O.run(3, wait=True)
mpm.assign(velocity=np.outer(mpm.arrays()['pos'][:, 0], (-600, 0, 0)))
before, time = mpm.arrays(), solver.loadTime
try: O.step()
except RuntimeError as error: print(json.dumps([str(error), solver.report()['failure'], solver.cuts]))
after = mpm.arrays()
assert all(np.array_equal(before[name], after[name], equal_nan=True) for name in before) and solver.loadTime == time
''')
	message, failure, cuts = run.result
	assert failure == 'inverted' and cuts == 0
	assert 'not cut' in message and 'O.dt' in message


@pytest.mark.parametrize(
        'change, words', [
                ('O.dt = 1.', ['O.dt', 'step of 1 s', 'critical', 'criticalTimeStep', 'implicit']),
                ('solver.iterPeriod, O.dt = 100, 1e-3', ['iterPeriod', 'critical']),
                ('solver.timeTolerance = 1e-3', ['timeTolerance', 'explicit']),
                ('solver.rayleigh = (1., 0.)', ['rayleigh', 'explicit', 'implicit scheme']),
                ('solver.ghost.massFactor = 0', ['ghost.massFactor = 0', 'factor=0', 'lumps']),
        ]
)
def test_what_does_not_go_with_it_is_refused_by_name(yade, change, words):
	run = yade(scene + f'''
solver = explicitBlock()
try:
	{change}
	O.step()
	if solver.iterPeriod > 1: O.run(200, wait=True)
except (ValueError, RuntimeError) as error: # the latter from a run in the background
	print(json.dumps(str(error)))
''')
	for word in words:
		assert word in run.result
