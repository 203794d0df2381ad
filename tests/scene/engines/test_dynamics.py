# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmDynamicEngine: motion in time in the real YADE."""
import numpy as np
import pytest

scene = '''
from scenes import *
import numpy as np
import json

def block(lower=(0, 0, 0), upper=(3, 3, 1), dim=2, cellSize=1., young=1e6, poisson=0., density=2000, engine=MpmDynamicEngine, **settings):
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=density, label='soil'))
	grid = MpmGrid(cellSize=cellSize, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox(lower, upper), grid, pointsPerCell=2, material='soil'))
	O.engines = [engine(grid=grid, verbosity=0, **settings)]
	return O.engines[0]

def velocities(*v):
	mpm.assign(velocity=[v] * len(mpm.arrays()['id']))
'''


@pytest.mark.parametrize('dim', [2, 3])
def test_free_fall_is_exact_and_its_energy_balances(yade, dim):
	yade(scene + f'''
for scheme in 'newmark', 'generalised-alpha', 'midpoint':
	O.reset()
	solver = block((0.3, 0.2, 0), (3.3, 2.2, {2 if dim == 3 else 1}), {dim}, gravity=(0, -10, 0), scheme=scheme)
	velocities(3, 0, 0)
	before = mpm.arrays()['pos']
	O.dt = 0.05
	O.run(10, wait=True)
	points, data = mpm.arrays(), solver.plotData()
	assert np.abs(points['pos'] - before - (1.5, -1.25, 0)).max() < 1e-12, scheme
	assert np.abs(points['velocity'] - (3, -5, 0)).max() < 1e-12
	assert np.abs(points['acceleration'] - (0, -10, 0)).max() < 1e-8
	mass = sum(b.state.mass for b in O.bodies)
	assert abs(data['momentum_y'] / (-5 * mass) - 1) < 1e-12
	assert abs(data['kineticEnergy'] / (17 * mass) - 1) < 1e-12
	assert abs(data['loadWork'] / (12.5 * mass) - 1) < 1e-12
	assert abs(data['energyImbalance']) < 1e-9 * data['loadWork']
	assert abs(solver.report()['momentum_x'] / (3 * mass) - 1) < 1e-12
''')


def test_a_bar_swings_back_in_half_a_period(yade):
	"""First mode of a bar that is held at one end, 20 cells, a sound wave's way of a cell in a step."""
	run = yade(scene + '''
c = 1e3**0.5
solver = block((0, 0, 0), (20, 1, 1), density=1000, newton=MpmNewton(tolerance=1e-9),
	boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 1, -inf), fix='y')])
mode = np.sin(np.pi * mpm.arrays()['pos'][:, 0] / 40)
mpm.assign(velocity=np.outer(1e-4 * mode, (1, 0, 0)))
energy = solver.plotData()['kineticEnergy']
O.dt = 1 / c
O.run(20, wait=True) # a quarter
quarter = solver.plotData()
O.run(20, wait=True)
v = mpm.arrays()['velocity'][:, 0]
print(json.dumps([v @ mode / (mode @ mode) / 1e-4, quarter['elasticEnergy'] / energy, solver.plotData()['kineticEnergy'] / energy, quarter['energyImbalance'] / energy]))
''')
	back, elastic, kinetic, imbalance = run.result
	assert back == pytest.approx(-1, abs=1e-3)
	assert elastic == pytest.approx(1, abs=2e-3) and kinetic == pytest.approx(1, abs=2e-3)
	assert abs(imbalance) < 1e-3


def test_what_generalised_alpha_damps_is_accounted_for(yade):
	"""A third of the energy of a bar in its second mode and more, in a few periods."""
	run = yade(scene + '''
solver = block((0, 0, 0), (8, 1, 1), density=1000, scheme='generalised-alpha', rhoInfinity=0.3, newton=MpmNewton(tolerance=1e-10),
	boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 1, -inf), fix='y')])
mpm.assign(velocity=np.outer(1e-2 * np.sin(3 * np.pi * mpm.arrays()['pos'][:, 0] / 16), (1, 0, 0)))
energy = solver.plotData()['kineticEnergy']
O.dt = 1 / 1e3**0.5
O.run(40, wait=True)
data = solver.plotData()
print(json.dumps([data[name] / energy for name in ('gridWork', 'energyImbalance')]))
''')
	damped, imbalance = run.result
	assert 0.3 < damped < 0.6 and abs(imbalance) < 1e-4


def test_energy_of_a_column_that_slumps_is_accounted_for(yade):
	"""Clay too soft for its height: weight works, flow dissipates, and what moves comes to rest."""
	run = yade(scene + '''
O.materials.append(MpmTrescaMat(young=2e6, poisson=0.3, density=2000, undrainedStrength=8e3, label='clay'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (2, 4, 1)), grid, pointsPerCell=2, material='clay'))
solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), verbosity=0,
	boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])
O.engines, O.dt = [solver], 0.01
O.run(120, wait=True)
print(json.dumps(solver.plotData()))
''')
	data = run.result
	assert data['plasticWork'] > 0.5 * data['loadWork'] > 0
	assert data['ghostWork'] >= 0
	assert abs(data['energyImbalance']) < 0.02 * data['loadWork']


def requireExactRestart(yade, scene, make, steps):
	"""A scene that is saved halfway and loaded in another process ends where it would have, bit for bit; *make* sets it up with a solver."""
	go = f'O.run({steps}, wait=True)'
	yade(scene + make + f'''
{go}
O.save('half.xml.gz')
{go}
np.savez('whole.npz', **mpm.arrays(), energy=solver.plotData()['energyImbalance'])
''')
	yade(scene + f'''
O.load('half.xml.gz')
{go}
np.savez('parts.npz', **mpm.arrays(), energy=O.engines[0].plotData()['energyImbalance'])
''')
	whole, parts = np.load(yade.folder / 'whole.npz'), np.load(yade.folder / 'parts.npz')
	assert np.abs(whole['velocity']).max() > 0
	for name in whole:
		assert np.array_equal(whole[name], parts[name], equal_nan=True), name


@pytest.mark.parametrize('scheme', ['newmark', 'generalised-alpha', 'midpoint'])
def test_a_saved_scene_goes_on_bit_for_bit(yade, scheme):
	requireExactRestart(
	        yade, scene, f'''
solver = block((0.2, 0.1, 0), (3.2, 3.1, 1), poisson=0.3, gravity=(0, -10, 0), scheme='{scheme}', boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])
O.dt = 0.02
''', 5)


def test_elastic_energy_that_is_not_henckys_is_told_as_nan(yade):
	"""Laws whose elasticity depends on the pressure have another energy."""
	told = yade(scene + '''
power = dict(young=2e7, poisson=.3, cohesion=5e3, frictionAngle=.55, density=2000, label='soil')
soils = dict(
	friction=MpmMohrCoulombMat(**power), power=MpmMohrCoulombMat(power=.5, **power),
	clay=MpmCamClayMat(density=2000, shearModulus=5e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=1e5, referencePressure=1e3, label='soil'),
	sand=MpmHardeningSoilMat(density=2000, E50ref=3e7, Eoedref=3e7, Eurref=9e7, power=.5, cohesion=1e3, frictionAngle=.61, dilationAngle=.09, K0nc=.43, label='soil'))
told = {}
for name, soil in soils.items():
	O.reset()
	O.materials.append(soil)
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (2, 2, 1)), grid, 2, 'soil'))
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], verbosity=0)
	O.engines, O.dt = [solver], 1e-3
	mpm.geostatic(.5 if 'ower' in name or name == 'friction' else None)
	O.run(2, wait=True)
	data = solver.plotData()
	told[name] = [bool(np.isnan(data[x])) for x in ('elasticEnergy', 'energyImbalance', 'plasticWork')]
print(json.dumps(told))
''').result
	assert told == dict(friction=[False] * 3, power=[True, True, False], clay=[True, True, False], sand=[True, True, False])


def test_slow_loading_is_static(yade):
	"""A ramp over ten thousand periods: the result of MpmImplicitEngine."""
	yade(scene + '''
found = []
for engine in MpmImplicitEngine, MpmDynamicEngine:
	O.reset()
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	solver = block((0, 0, 0), (2, 8, 1), engine=engine, gravity=(0, -10, 0), boundaries=sides, newton=MpmNewton(tolerance=1e-9))
	period = 4 * 8 / (1e6 / 2000)**0.5
	solver.loadCurve = [(0, 0), (1e4 * period, 1)]
	O.dt = 1e3 * period
	O.run(10, wait=True)
	found.append(mpm.arrays()['pos'] - mpm.arrays()['pos0'])
assert np.abs(found[0]).max() > 0.1
assert np.abs(found[0] - found[1]).max() < 1e-6 * np.abs(found[0]).max(), np.abs(found[0] - found[1]).max() / np.abs(found[0]).max()
''')


def test_ground_at_rest_stays_so_until_it_is_let_go(yade):
	"""A static stage and a dynamic one in the same scene: stiff ground, for the state at the end of a static stage is in balance on the grid where it began only.
	Static steps leave velocities alone."""
	yade(scene + '''
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x')]
base = MpmBoundary(max=(inf, 0, inf), fix='y')
static = block((0, 0, 0), (2, 4, 1), young=1e8, engine=MpmImplicitEngine, gravity=(0, -10, 0), boundaries=sides + [base], newton=MpmNewton(tolerance=1e-9))
velocities(1, 2, 0)
O.dt = 0.2
O.run(5, wait=True)
assert np.all(mpm.arrays()['velocity'] == (1, 2, 0)) and np.all(mpm.arrays()['acceleration'] == 0)
velocities(0, 0, 0)
solver = MpmDynamicEngine(grid=static.grid, gravity=static.gravity, boundaries=static.boundaries, newton=static.newton, loadTime=O.time, verbosity=0)
O.engines, O.dt = [solver], 0.005
O.run(10, wait=True)
assert np.abs(mpm.arrays()['velocity']).max() < 1e-4, np.abs(mpm.arrays()['velocity']).max() # falling freely it would be 0.5
assert abs(solver.reactions[2][1] / (10 * sum(b.state.mass for b in O.bodies)) - 1) < 5e-3, solver.reactions[2][1] / (10 * sum(b.state.mass for b in O.bodies))
solver.boundaries = sides
velocities(0, 0, 0) # begin anew
O.run(10, wait=True)
mass = sum(b.state.mass for b in O.bodies)
assert abs(solver.plotData()['momentum_y'] / (-0.5 * mass) - 1) < 1e-3
''')


@pytest.mark.parametrize('scheme', ['newmark', 'generalised-alpha'])
def test_a_block_bounces_off_a_box(yade, scheme):
	"""Contact works with inertia: a bar that hits a rigid wall flies back after the wave has run to its end and back. No energy comes from nowhere."""
	run = yade(scene + f'scheme = {scheme!r}' + '''
from yade import utils
c, speed = (1e6 / 1000)**0.5, 0.05
solver = block((0, 0, 0), (1, 8, 1), cellSize=0.5, density=1000, scheme=scheme)
O.materials.append(FrictMat(young=1e9, frictionAngle=0, label='steel'))
O.bodies.append(utils.box((0.5, -0.5, 0), (2, 0.5, 1), fixed=True, material='steel')) # they touch
solver.contacts = [MpmContact(friction=0, stiffness=100)]
velocities(0, -speed, 0)
mass = solver.plotData()['momentum_y'] / -speed
energy, most = solver.plotData()['kineticEnergy'], 0
O.dt = 0.25 / c
times, speeds = [], []
while O.time < 3 * 8 / c:
	O.step()
	data = solver.plotData()
	most = max(most, data['kineticEnergy'] + data['elasticEnergy'])
	times.append(O.time), speeds.append(data['momentum_y'] / mass / speed)
stopped = times[np.argmax(np.array(speeds) >= 0)] # in the middle of the contact
print(json.dumps([speeds[-1], most / energy, stopped * c / 8, data['contactWork'] / energy, data['energyImbalance'] / energy]))
''')
	speed, most, middle, work, imbalance = run.result
	assert 0.95 < speed < 1 # some of the wave's energy stays in the bar
	assert most < 1 + 1e-3
	assert middle == pytest.approx(1, abs=0.05)
	assert -0.03 < work < 1e-3 and abs(imbalance) < 0.02


def test_prescribed_motion_works_on_the_body(yade):
	"""A boundary that moves at constant speed carries a stiff block along with it."""
	yade(scene + '''
solver = block(young=1e8, scheme='generalised-alpha', rhoInfinity=0, loadCurve=[(0, 0), (1, 1)])
solver.boundaries = [MpmBoundary(fix='y'), MpmBoundary(max=(0, inf, inf), fix='x', displacement=(0.2, 0, 0))]
O.dt = 0.01
O.run(50, wait=True)
points, data = mpm.arrays(), solver.plotData()
assert np.abs(points['velocity'][:, 0] - 0.2).max() < 1e-3, points['velocity'][:, 0]
assert data['boundaryWork'] > data['kineticEnergy'] > 0, data # part of it is taken by the blow and by the scheme
''')


def test_long_steps_are_cut_to_the_time_tolerance(yade):
	yade(scene + '''
cuts = []
for tolerance in 0, 1e-4:
	O.reset()
	solver = block(gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y')], timeTolerance=tolerance)
	O.dt = 0.1
	O.run(2, wait=True)
	cuts.append(solver.substeps)
assert cuts[0] == 1 and cuts[1] > 4, cuts
try:
	O.reset()
	solver = block(gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y')], timeTolerance=tolerance, newton=MpmNewton(minStep=1))
	O.dt = 0.1
	O.step()
	assert False
except RuntimeError as error:
	assert 'local error' in str(error) and 'timeTolerance' in str(error) and 'MpmDynamicEngine' in str(error), error
assert solver.report()['failure'] == 'inaccurate'
''')


@pytest.mark.parametrize('integrator, moves', [('NewtonIntegrator()', True), ('NewtonIntegrator(mask=1)', False)])
def test_an_integrator_that_moves_points_too_is_refused(yade, integrator, moves):
	yade(scene + f'''
solver = block()
for body in O.bodies: body.groupMask = 2
velocities(1, 0, 0)
O.engines = [ForceResetter(), solver, {integrator}]
O.dt = 0.01
try:
	for step in range(3): O.step()
	assert not {moves}
	assert np.abs(mpm.arrays()['pos'][:, 0] - mpm.arrays()['pos0'][:, 0] - 0.03).max() < 1e-12
except ValueError as error:
	assert {moves} and 'NewtonIntegrator' in str(error) and 'groupMask' in str(error), error
''')


@pytest.mark.parametrize(
        'change, words', [
                ('solver.scheme = "explicit euler"', ['MpmDynamicEngine.scheme', 'newmark', 'midpoint']),
                ('solver.beta = 0.', ['MpmDynamicEngine.beta', '> 0']),
                ('solver.gamma = 0.4', ['MpmDynamicEngine.gamma', '1/2', 'energy']),
                ('solver.rhoInfinity = 1.5', ['MpmDynamicEngine.rhoInfinity', '0 to 1']),
                ('solver.timeTolerance = -1.', ['MpmDynamicEngine.timeTolerance', '>= 0']),
                ('solver.ghost.massFactor = -1.', ['MpmGhost.massFactor', '>= 0']),
                ('solver.scheme, solver.rayleigh, solver.contacts = "generalised-alpha", (0, 1e-3), [MpmContact()]', ['MpmDynamicEngine.rayleigh', 'newmark']),
                ('solver.scheme, solver.timeTolerance = "midpoint", 1e-3', ['timeTolerance', 'midpoint']),
                ('velocities(0, 0, 1)', ['vel', 'dim=2']),
                ('O.bodies[3].state.vel = (float("nan"), 0, 0)', ['Body #3', 'vel', 'finite']),
        ]
)
def test_bad_input_is_refused_by_name(yade, change, words):
	run = yade(scene + f'''
solver = block()
O.dt = 0.01
try:
	{change}
	O.step()
except ValueError as error:
	print(json.dumps(str(error)))
''')
	for word in words:
		assert word in run.result


def test_velocities_are_in_files_where_points_move(yade):
	yade(scene + '''
solver = block()
recorder = MpmVtkRecorder(fileName='still-', iterPeriod=1)
O.engines, O.dt = O.engines + [recorder], 0.01
O.step()
recorder.fileName = 'moving-'
velocities(1, 0, 0)
O.step()
''')
	fields = {name: b''.join(path.read_bytes() for path in yade.folder.glob(f'{name}-*.vtu')) for name in ('still', 'moving')}
	assert b'"stress"' in fields['still'] and b'"velocity"' not in fields['still']
	assert b'"velocity"' in fields['moving'] and b'"acceleration"' in fields['moving']
