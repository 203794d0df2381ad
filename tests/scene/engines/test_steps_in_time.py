# SPDX-License-Identifier: GPL-2.0-or-later
"""When steps begin, how long they may be, what they may not gain, and what is said of those that fail."""
import re

import pytest

bouncing = '''
import json
from math import atan
from yade import mpm, pack, utils
import numpy as np

def block(seed):
	"""A block that is thrown at a wall in steps of 1 to 4 cells of its waves, .1 to .3 cells of its own way."""
	r = np.random.default_rng(seed)
	poisson, young, cells = r.uniform(.2, .45), 10**r.uniform(4.3, 5.5), r.uniform(1, 4)
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=1000, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	grid = MpmGrid(cellSize=.1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (.3, .3, 1)), grid, int(r.integers(2, 4)), 'soil'))
	n = len(O.bodies)
	O.bodies.append(utils.wall(-r.uniform(.02, .1), axis=1, sense=1, material='rigid'))
	solver = MpmDynamicEngine(grid=grid, scheme=scheme, contacts=[MpmContact(friction=atan(r.uniform(0, .6)))], verbosity=0)
	O.engines, O.dt = [solver], cells * .1 / (young * (1 - poisson) / (1 + poisson) / (1 - 2 * poisson) / 1000)**.5
	v = np.array((r.uniform(-.5, .5), -r.uniform(.3, 1), 0))
	v *= r.uniform(.1, .3) * .1 / O.dt / np.linalg.norm(v)
	mpm.assign(velocity=[tuple(v)] * n)
	return solver, 45 * v @ v, .6 / np.linalg.norm(v)

found = []
for scheme, seed in ('newmark', 101), ('newmark', 119), ('generalised-alpha', 78):
	solver, first, end = block(seed)
	most, cuts = 0, 0
	while O.time < end:
		O.step()
		data = solver.plotData()
		most, cuts = max(most, (data['kineticEnergy'] + data['elasticEnergy']) / first), cuts + solver.cuts
	found.append((most, cuts))
print(json.dumps(found))
'''


def test_no_step_makes_energy_of_nothing(yade):
	"""In these, with the arithmetic of this kind of processor, Newton's method finds an equilibrium with 5 to 17 times the energy of the motion."""
	for most, cuts in yade(bouncing, environment={'OPENBLAS_CORETYPE': 'Haswell'}).result:
		assert most < 1.1 and cuts > 0


def test_the_first_step_begins_when_the_engine_joins(yade):
	"""Whatever the clock says then, how it was made to wait, and how many iterations of YADE there are from step to step."""
	run = yade(
	        '''
import json
from scenes import *
found = []
for engine in MpmDynamicEngine, MpmImplicitEngine:
	for period, joins in (1, 'late'), (1, 'dead'), (5, 'late'):
		O.reset()
		O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=1000, label='soil'))
		O.materials.append(FrictMat(label='rigid'))
		grid = MpmGrid(cellSize=.25)
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), grid, 2, 'soil'))
		plate = O.bodies[O.bodies.append(utils.box((.5, 1.6, 0), (3, .5, 1), material='rigid', fixed=True))]
		plate.state.vel = (0, -.1, 0)
		solver = engine(grid=grid, iterPeriod=period, dead=joins == 'dead', boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], contacts=[MpmContact(friction=0)], verbosity=0)
		O.engines, O.dt = [PyRunner(command='pass', iterPeriod=1)] + [solver] * (joins == 'dead'), 1e-3
		O.run(100, wait=True)
		O.engines, solver.dead = [solver], False
		y = plate.state.pos[1]
		O.step()
		first = (solver.loadTime - O.time, (y - plate.state.pos[1]) / 1e-4)
		O.run(period, wait=True)
		found.append(first + (solver.loadTime - O.time, (y - plate.state.pos[1]) / 1e-4 / (period + 1), O.iter))

O.reset()  # what was told to begin earlier does, and what has run goes on from where it was, with a word
solver = column(2)
O.dt = 1 / 8
O.engines = []
O.run(2, wait=True)
solver.loadTime = 1 / 8
O.engines = [solver]
O.step()
told = solver.loadFactor, solver.substeps
solver.dead = True
O.run(2, wait=True)
solver.dead = False
O.step()
print(json.dumps([found, told, solver.loadFactor]))
''')
	found, told, last = run.result
	for first in found:
		assert first[:4] == pytest.approx((0, 1, 0, 1), abs=1e-9), first
	assert told[0] == pytest.approx(3 / 8) and last == pytest.approx(6 / 8)
	assert (run.stdout + run.stderr).count('from loadTime = 0.375 to 0.75 s at once') == 1


def test_what_friction_of_moving_plates_holds_is_not_taken_for_free(yade):
	"""A block between rough plates, sheared by more in a step than friction bears before the block has followed; and plates that go back by more than they press in."""
	run = yade(
	        '''
import json
from math import atan
from scenes import *
found = []
for dt, then in (.1, (.02, 0)), (.025, (.02, 0)), (.1, (0, .015)):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.2, density=1, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	grid = MpmGrid(cellSize=.125)
	O.bodies.append(mpm.fill(pack.inAlignedBox((-.5, -.25, -1), (.5, .25, 1)), grid, 2, 'soil'))
	top, bottom = [O.bodies[O.bodies.append(utils.box((0, y, 0), (.8, .2, 1), material='rigid', fixed=True))] for y in (.45, -.45)]
	contact = MpmContact(friction=atan(1))
	solver = MpmImplicitEngine(grid=grid, contacts=[contact], verbosity=0)
	O.engines, O.dt = [solver], .1
	top.state.vel, bottom.state.vel = (0, -.02, 0), (0, .02, 0)
	O.run(5, wait=True)
	O.dt = dt
	top.state.vel, bottom.state.vel = then + (0,), tuple(-x for x in then) + (0,)
	O.run(round(.5 / dt), wait=True)
	found.append((contact.forces[0][0], contact.forces[0][1], contact.slipping[0], solver.cuts))
print(json.dumps(found))
''')
	coarse, fine, back = run.result
	assert coarse[0] == pytest.approx(fine[0], rel=.02) and coarse[1] == pytest.approx(fine[1], rel=.005) and coarse[2] == 0
	assert abs(back[0]) < 1e-6 * back[1] and 0.2 * fine[1] < back[1] < .3 * fine[1]  # a fourth of the way in is left


def test_the_reaction_of_an_absorbing_edge_is_all_of_it(yade):
	"""Also of the parts of domains that have come beyond: momentum changes by weight and reaction, that of the middle of the step or the mean of its ends."""
	run = yade(
	        '''
import json
from scenes import *
found = []
for scheme in 'newmark', 'midpoint':
	O.reset()
	O.materials.append(MpmElasticMat(young=1e5, poisson=.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=.2)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (.8, .6, 1)), grid, 2, 'soil'))
	edge = MpmAbsorbingBoundary(max=(inf, 0, inf))
	solver = MpmDynamicEngine(grid=grid, absorbing=[edge], gravity=(0, -9.81, 0), scheme=scheme, verbosity=0, newton=MpmNewton(tolerance=1e-10))
	O.engines, O.dt = [solver], 2e-3
	mpm.assign(velocity=[(0, -.5, 0)] * len(O.bodies))
	weight, missing, last = 960 * 9.81, 0, None
	for i in range(30):
		before = solver.plotData()['momentum_y']
		O.step()
		force = (edge.reaction[1] + last) / 2 if scheme == 'newmark' and i > 0 else edge.reaction[1]
		if scheme == 'midpoint' or i > 0: missing = max(missing, abs((solver.plotData()['momentum_y'] - before) / O.dt + weight - force) / weight)
		last = edge.reaction[1]
	found.append((missing, edge.reaction[1] / weight))
print(json.dumps(found))
''')
	for missing, reaction in run.result:
		assert missing < 1e-4 and reaction > .5


def test_failures_in_time_tell_when_and_what(yade):
	run = yade(
	        '''
import json
from scenes import *

def falling(**settings):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e5, poisson=.3, density=1000, label='soil'))
	grid = MpmGrid(cellSize=.25)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1.5, 1)), grid, 2, 'soil'))
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(1, -9.81, 0), verbosity=0, **settings)]
	O.dt = .05
	return O.engines[0]

def text(run):
	try: run()
	except (RuntimeError, ValueError) as error: return str(error)

base = [MpmBoundary(max=(inf, 0, inf), fix='xy')]
found = {}
solver = falling(boundaries=base)
O.run(2, wait=True)
solver.newton.maxIterations, solver.newton.minStep = 1, .5
found['cut'] = text(lambda: O.run(3, wait=True))
falling(absorbing=[MpmAbsorbingBoundary(max=(inf, .5, inf))])
found['inside'] = text(O.step)
falling(absorbing=[MpmAbsorbingBoundary(max=(inf, 0, inf)), MpmAbsorbingBoundary(min=(2, 0, -inf))])
found['nowhere'] = text(O.step)
O.reset()
solver = column(8)
O.run(40, wait=True)
solver.gravity, solver.newton.maxIterations, solver.newton.minStep = (0, -1e4, 0), 1, .5
found['static'] = text(lambda: O.run(1, wait=True))
print(json.dumps(found))
''')
	found = run.result
	assert 'the time step from O.time = 0.1 to 0.125 s (0.5 of O.dt' in found['cut'] and 'The scene is at 0.1 s' in found['cut']
	assert 'equilibrium' not in found['cut'] and 'factor' not in found['cut']
	assert (run.stdout + run.stderr).count('from O.time = 0.1 to 0.125 s') == 1  # in the result: YADE has not written it too
	inside = re.search(r'absorbing\[0\] has material on both sides: behind it are (\S+) cells full, most of it in the cell around \((\S+) (\S+)\), of which it fills (\S+);', found['inside'])
	assert float(inside[1]) == pytest.approx(8, abs=1e-3) and float(inside[4]) == pytest.approx(1, abs=1e-3) and float(inside[3]) < .5
	assert 'absorbing[1]: no face of a cell' in found['nowhere']
	assert 'the load step from O.time = 1 to ' in found['static'] and 'from factor' not in found['static']


def test_a_scene_can_be_loaded_while_a_run_begins(yade):
	run = yade(
	        '''
import json
from scenes import *
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
grid = MpmGrid(cellSize=.25)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (.5, .5, 1)), grid, 2, 'soil'))
O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], scheme='explicit', verbosity=0)]
O.dt = 1e-3
O.run(2, wait=True)
mpm.save('scene.yade.gz')
for i in range(60): # a thread of YADE that has not yet begun would take a lock of the scene before
	O.run(3000)
	mpm.load('scene.yade.gz')
	assert O.iter == 2
	O.step()
print(json.dumps([O.iter, len(O.bodies)]))
''')
	assert run.result == [3, 16]


def test_long_steps_and_early_looks_are_remarked(yade):
	run = yade(
	        '''
import json
from scenes import *

def ground(**settings):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=.25)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1.5, 1)), grid, 2, 'soil'))
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], **settings)]
	return O.engines[0]

solver = ground(verbosity=0)
speed = solver.waveSpeed(), (1e6 * .7 / 1.3 / .4 / 2000)**.5
advice = []
for O.dt in 10, 1e-2, 1e-3:
	advice += [text for text in mpm.advise()['advice'] if text.startswith('O.dt')]
O.dt = 10
try: O.step()
except RuntimeError: pass
solver = ground(scheme='explicit', verbosity=2)
O.dt = .9 * solver.criticalTimeStep()
O.run(3, wait=True)
O.run(3000)
for i in range(3): mpm.arrays()
O.pause()
open('broken.yade.gz', 'wb').write(b'nothing')
try: mpm.load('broken.yade.gz')
except OSError as error: broken = str(error)
print(json.dumps([speed, advice, broken]))
''')
	speed, advice, broken = run.result
	assert speed[0] == pytest.approx(speed[1], rel=1e-3)
	assert 'points, which should move less than half a cell' in advice[0] and 'averaged over' in advice[1] and 'short enough' in advice[2]
	assert 'a time step lasts 10 s (O.dt = 10)' in run.stdout + run.stderr
	assert 'residual nan' not in run.stderr and re.search(r'time \S+ s, step 3/3, \S+ elapsed, (\S+ left, )?(\S+ steps/s, )?96 points', run.stderr)
	assert run.stderr.count('mpm.arrays() while the simulation runs') == 1
	assert "'broken.yade.gz', of 7 bytes, cannot be read as a scene" in broken
