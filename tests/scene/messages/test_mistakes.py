# SPDX-License-Identifier: GPL-2.0-or-later
"""Mistakes in a first script: each message says what to do instead. (Single values: test_bad_input.py.)"""
import pytest
from conftest import outcomesOf

setting = '''
import json, sys
from yade import mpm, pack

square = mpm.polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]

def fill(predicate=square, grid=MpmGrid(cellSize=1), pointsPerCell=2, material='soil'):
	return mpm.fill(predicate, grid, pointsPerCell, material)

many = mpm.polygon([(i, (i % 2) * i) for i in range(100)] + [(99, -1), (0, -1)])

def surface():
	"""A long list of something else."""
	return [facet(((0, 0, 0), (1, 0, 0), (0, 1, i * 1e-3)), material=FrictMat()) for i in range(200)]

def solver(**changes):
	"""A sound engine but for the changes."""
	return MpmImplicitEngine(**(dict(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), boundaries=sides, label='solver', verbosity=0) | changes))

def scene(**changes):
	"""The whole scene with it."""
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=15e3, label='soil'))
	O.bodies.append(fill())
	O.engines = [solver(**changes)]
	O.dt = 0.1
	return O.engines[0]
'''

# (script, exception, what its sentence must contain)
mistakes = [
        # the order in which things are written
        ('fill()', 'KeyError', ["'soil'", 'O.materials', 'append it there before filling']),
        ('scene(); fill(material="clay")', 'KeyError', ["'clay'", "['soil']"]),
        ('scene(); fill(material=fill())', 'TypeError', ['a body', 'the label of a material is meant']),
        ('scene(); fill(material=O.materials["soil"])', 'TypeError', ['O.materials', 'give its label']),
        ('scene(); O.bodies.clear(); fill(); O.step()', 'ValueError', ['no material points', 'O.bodies.append(mpm.fill(...))']),
        ('scene(); O.bodies.append(sphere((9, 9, 9), 1)); O.step()', 'ValueError', ['Body #64', "'soil'", 'Sphere', 'last material of O.materials']),
        ('scene(); O.engines = [MpmVtkRecorder(fileName="x-")]; O.step()', 'ValueError', ['MpmImplicitEngine', 'none', 'O.engines']),
        ('scene(); O.engines = O.engines + [solver()]; O.step()', 'ValueError', ['two engines with material points', 'mask']),
        ('scene(); O.engines = O.engines * 2; O.step()', 'ValueError', ['listed 2 times']),
        ('scene(); O.engines = O.engines + [GlobalStiffnessTimeStepper()]; O.step()', 'ValueError', ['TimeStepper', 'active=False', 'iterPeriod=N']),
        # filling
        ('mpm.polygon((0, 0), (4, 0), (4, 4))', 'TypeError', ['mpm.polygon([(x, y), (x, y), ...])']),
        ('mpm.polygon([(0, 0), (4, 4), (4, 0), (0, 4)])', 'ValueError', ['crosses', 'in order around the outline?']),
        ('scene(); fill(grid=1.0)', 'TypeError', ['grid = 1.0', 'MpmGrid']),
        ('scene(); fill(grid=MpmGrid(cellSize=1000))', 'ValueError', ['spacing 500', 'from (0, 0, -inf) to (4, 4, inf)', 'smaller than that']),
        ('scene(); fill(grid=MpmGrid(cellSize=1e-4))', 'ValueError', ['cellSize = 0.0001', 'do not suit a region']),
        ('scene(); fill(pack.inAlignedBox((0, 0, 1), (4, 4, 2)))', 'ValueError', ['plane z = 0', 'from (0, 0, 1)', 'miss the plane']),
        ('scene(); fill(surface())', 'TypeError', ['<Body instance', '...', 'pack.inGtsSurface(surface)']),
        ('scene(); import gts; fill(gts.sphere(2))', 'TypeError', ['gts.Surface', 'pack.inGtsSurface(surface)']),
        ('scene(); fill([(0, 0), (4, 0), (4, 4)])', 'TypeError', ['mpm.polygon([(x, y), ...])']),
        ('scene(); fill(pack.inSphere)', 'TypeError', ['this is a class']),
        ('scene(); fill(grid=surface())', 'TypeError', ['must be an MpmGrid']),
        ('scene(); fill(pointsPerCell=surface())', 'TypeError', ['must be an integer']),
        ('scene(); fill(material=[(many, "soil")] * 2 + surface())', 'TypeError', ['material[2] = <Body']),
        ('scene(); fill(material=lambda x: surface())', 'TypeError', ['the label of a material']),
        ('scene(); fill(material=surface())', 'TypeError', ['the label of a material is meant']),
        ('scene(); fill(material="x" * 5000)', 'KeyError', ['is not in O.materials']),
        ('mpm.polygon(surface())', 'TypeError', ['(x, y) pairs']),
        ('fill(many, MpmGrid(cellSize=1, dim=3))', 'ValueError', ['no bounds']),
        ('scene(); mpm.assign(ids=surface(), force=[])', 'TypeError', ['sequence of body ids']),
        ('scene(); mpm.assign(force=surface())', 'TypeError', ['an array of numbers']),
        ('scene(); mpm.colour(surface())', 'ValueError', ['one number for each of 64']),
        ('scene(); mpm.colour("material", colormap=surface())', 'ValueError', ['viridis']),
        ('scene(); mpm.plot("material", range=surface())', 'TypeError', ['(low, high)']),
        ('scene(); mpm.plot("material", plane=surface())', 'ValueError', ['in the plane x-y']),
        ('scene(); mpm.plot("x" * 5000)', 'ValueError', ['is not known']),
        ('scene(); mpm.plot(fileName=3)', 'TypeError', ['plot: fileName = 3 must be a path']),
        ('scene(); mpm.export(None)', 'TypeError', ['export: fileName = None must be a path']),
        ('scene(); mpm.geostatic(K0=[0.5] * 5000)', 'ValueError', ['factor of gravity']),
        ('scene(gravityCurve=[(0, 1)]); mpm.geostatic(K0=[0.5] * 5000)', 'TypeError', ['ratio of horizontal']),
        ('scene(); mpm.advise(surface())', 'TypeError', ['must be an MpmImplicitEngine']),
        ('scene(boundaries=surface())', 'TypeError', ['MpmBoundary']),
        ('scene(); fill(pointsPerCell=0)', 'ValueError', ['pointsPerCell = 0', 'at least 1']),
        ('scene(); fill(pointsPerCell=(2, 2))', 'TypeError', ['pointsPerCell = (2, 2)', 'integer']),
        ('scene(); O.bodies.append(fill()); O.step()', 'ValueError', ['#0 and #64', 'same place', 'filled twice']),
        ('scene(); O.bodies.append(fill(pack.inAlignedBox((3, 3, -1), (6, 6, 1)), pointsPerCell=3)); O.step()', 'ValueError', ['same place', 'two fills overlap']),
        ('scene(grid=MpmGrid(cellSize=0.25)); O.step()', 'ValueError', ['halfSize = 0.25', 'cellSize = 0.25', 'another grid']),
        # the engine and what belongs to it
        ('scene(grid=1.0)', 'TypeError', ['.grid = 1.0', 'MpmGrid']),
        ('scene(grid=None); O.step()', 'ValueError', ['.grid = None', 'the MpmGrid that mpm.fill was given']),
        ('scene(boundaries=sides[2])', 'TypeError', ['.boundaries', 'write [item]']),
        ('scene(boundaries=[]); O.step()', 'RuntimeError', ['nothing restrains', 'MpmBoundary', 'no boundaries']),
        ('scene(boundaries=[MpmBoundary(max=(0, inf, inf), fix="x")]); O.step()', 'RuntimeError', ['nothing restrains the translation along y', 'MpmBoundary']),
        ('scene(boundaries=[MpmBoundary(max=(inf, -5, inf), fix="xy")]); O.step()', 'RuntimeError', ['boundaries[0]', '-5', 'constrains no node of any material']),
        ('scene(boundaries=[MpmBoundary(max=(inf, inf, 0), fix="z")]); O.step()', 'ValueError', ["fix = 'z'", 'dim=2', 'x-y']),
        ('scene(boundaries=[MpmBoundary(max=(inf, inf, -1), fix="xy")]); O.step()', 'ValueError', ['contains no grid node', 'nodes are at']),
        ('scene(boundaries=[MpmBoundary(max=(inf, 0, inf))]); O.step()', 'ValueError', ["fix = ''", 'letters x, y, z']),
        ('MpmBoundary(max=(inf, 0, inf), fix="Y")', 'ValueError', ["fix = 'Y'", 'letters x, y, z']),
        ('MpmBoundary(max=(inf, 0, inf), fix=("x", "y"))', 'TypeError', ['.fix', 'a string']),
        ('scene(grid=MpmGrid(cellSize=1, dim=3)); O.step()', 'RuntimeError', ['translation along z']),
        ('scene(gravity=-9.81)', 'TypeError', ['.gravity = -9.81', 'three numbers']),
        ('scene(gravity=(0, 0, -9.81)); O.step()', 'ValueError', ['.gravity', 'z component', '(0, -9.81, 0)']),
        ('scene(ghost=0.01)', 'TypeError', ['.ghost = 0.01', 'MpmGhost']),
        ('scene(newton=1e-6)', 'TypeError', ['.newton = 1e-06', 'MpmNewton']),
        ('scene(tolerance=1e-6)', 'AttributeError', ["'tolerance'", 'newton']),
        ('scene(basis="GIMP")', 'ValueError', ["'GIMP'", "'gimp' or 'mpm'"]),
        ('scene(loadCurve=[0, 1])', 'TypeError', ['.loadCurve = [0, 1]', 'pair']),
        ('scene(loadCurve=[(1, 1), (0, 0)]); O.step()', 'ValueError', ['.loadCurve', 'increasing times']),
        ('MpmVonMisesMat(E=1e6, nu=0.3)', 'AttributeError', ["'E'", 'young']),
        ('scene(); O.bodies[0].state.stress = Matrix3.Zero', 'AttributeError', ['MpmState.stress', 'mpm.assign(stress=...)']),
        ('scene().iterations = 3', 'AttributeError', ['.iterations', 'only be read']),
        ('scene(); O.engines = O.engines + [MpmVtkRecorder()]; O.step()', 'ValueError', ['.fileName', "'out/slope-'"]),
        ('MpmVtkRecorder(fileName="x-", recorders="points")', 'TypeError', ["'points'", 'write [item]']),
        ('MpmVtkRecorder(fileName="x-", recorders=["spheres"])', 'ValueError', ["'spheres'", "'ghostFaces'"]),
        # the load clock
        ('scene(); O.dt = 1e-8; O.step()', 'ValueError', ['O.dt = 1e-08', '1e+08 steps', 'forgotten', '1/80']),
        ('scene(); O.dt = 0; O.step()', 'ValueError', ['O.dt = 0', 'load time of one step']),
        ('scene(); O.dt = 80; O.step()', 'ValueError', ['O.dt = 80', 'more than the whole loadCurve']),
        ('scene(); O.run(3, wait=True); O.resetTime(); O.run(2, wait=True)', 'RuntimeError', ['not after the last converged load time', 'loadTime = O.time']),
        ('scene(grid=MpmGrid(cellSize=1e6)); O.step()', 'ValueError', ['cellSize = 1e+06 m is 2e+06 times', 'mpm.fill']),
        ('scene(grid=MpmGrid(cellSize=1e308)); O.step()', 'ValueError', ['cellSize = 1e+308 m is', '(0.5 m)']),
        ('scene(); O.periodic = True; O.step()', 'ValueError', ['O.periodic']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('mistakes'), setting, [script for script, _, _ in mistakes])


@pytest.mark.parametrize('script, exception, words', mistakes, ids=[script for script, _, _ in mistakes])
def test_isExplained(outcomes, script, exception, words):
	kind, sentence = outcomes[script]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence, sentence
	assert len(sentence) < 700, sentence


def test_warnings(yade):
	"""Settings that can be meant, but seldom are."""
	run = yade(setting + '''
scene(gravity=(0, 1, 0))
O.step()
O.reset()
scene(grid=MpmGrid(cellSize=20), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])
O.step()
O.reset()
scene(gravity=(0, -1, 0))
O.run(13, wait=True)
sys.stderr.write('sound from here\\n')
O.reset()
scene(loadCurve=[(0, 1)])
O.run(3, wait=True)
O.reset()
scene()
O.run(10, wait=True)
''')
	said, sound = (run.stdout + run.stderr).split('sound from here')
	assert said.count('gravity acts along +y') == 1
	assert said.count('cellSize = 20 m is more than 20 times') == 1
	assert said.count('loadCurve has ended at time 1: the load factor stays at 1') == 1
	assert 'WARNING' not in sound


def test_endOfTheScriptBeforeThatOfTheRun(yade):
	"""The step under way comes to its end; none begins."""
	run = yade(setting + '''
import time

def slow():
	begun.append(O.iter)
	time.sleep(0.5)
	sys.stderr.write('the step has ended')

scene()
begun = []
O.engines = O.engines + [PyRunner(iterPeriod=1, initRun=True, command='slow()')]
O.run(10)
while not begun: time.sleep(0.01)
''')
	assert 'the script ends while the simulation runs' in run.stderr and 'O.run(n, wait=True)' in run.stderr
	assert run.stderr.count('the step has ended') == 1


def test_what_is_left_at_the_end_of_the_script_is_told(yade):
	"""Films that are not finished, and stages that no step has followed; those that are finished are left in peace."""
	begun, ended = (yade(setting + script).stderr for script in ('''
scene()
O.step()
film = mpm.view('film.html', every=1)
mpm.stages.excavate(mpm.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), steps=2)
''', '''
scene()
O.step()
film = mpm.view('film.html', every=1)
mpm.stages.excavate(mpm.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), steps=2)
O.run(2, wait=True)
film.finish()
'''))
	assert "'film.html' is not written, and its 1 pictures are lost" in begun and 'mpm.stages.excavate(..., steps=2) was not followed by a step' in begun, begun
	assert 'yade.mpm:' not in ended, ended
