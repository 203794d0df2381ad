# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that could be computed but can hardly be meant are refused or doubted, whenever they become so; sound ones are left in peace."""
import pytest
from conftest import outcomesOf

setting = '''
import re, sys, time
from math import inf
import numpy as np
from yade import mpm, pack

base = MpmBoundary(max=(inf, 0, inf), fix='xy')
damaged = 'damaged.xml'

def say(text):
	sys.stderr.write(f'== {text}\\n')
	sys.stderr.flush()

def box(a, b, grid=None, n=2):
	return mpm.fill(pack.inAlignedBox((*a, -1), (*b, 1)), grid or MpmGrid(cellSize=1), n, 'soil')

def scene(bodies=None, young=1e6, density=2000, **changes):
	"""A block of 4 x 4 m on the ground."""
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=0.3, density=density, label='soil'))
	O.bodies.append(bodies() if bodies else box((0, 0), (4, 4)))
	solver = MpmImplicitEngine(**(dict(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), boundaries=[base], verbosity=0) | changes))
	O.engines, O.dt = [solver], 1 / 4
	return solver

def deformed():
	"""The same after a step."""
	solver = scene()
	O.step()
	return solver

def nested(*engines):
	scene()
	O.engines = [ParallelEngine([MpmImplicitEngine(**(dict(grid=MpmGrid(cellSize=1), boundaries=[base], verbosity=0) | e)) for e in engines])]

def load(attribute, value):
	"""The scene from a file in which somebody has changed a number."""
	solver = deformed()
	mpm.save('sound.xml')
	text, number = re.subn(f'(<{attribute}>(?:[^<]*<count>\\\\d+</count>.*?<item>)?)[-+.0-9e]+', f'\\\\g<1>{value}', open('sound.xml').read(), count=1, flags=re.S)
	assert number == 1, attribute
	open(damaged, 'w').write(text)
	O.load(damaged)
'''

# (script, exception, what its sentence must contain)
refused = [
        # after the first step, with as many points as before
        ('s = deformed(); s.gravity = (0, 0, -10); O.step()', 'ValueError', ['.gravity', 'z component']),
        ('s = deformed(); s.gravity = (0, 0, -10); O.run(1, wait=True)', 'RuntimeError', ['.gravity', 'z component']),
        ('s = deformed(); s.grid.cellSize = 1e7; O.step()', 'ValueError', ['cellSize = 1e+07', '2e+07 times']),
        ('deformed(); O.dt = 1e-8; O.step()', 'ValueError', ['O.dt = 1e-08', 'forgotten']),
        ('s = deformed(); s.loadCurve = [(0.25, 0), (0.3, 1)]; O.step()', 'ValueError', ['O.dt = 0.25', 'more than the whole loadCurve']),
        ('deformed(); [O.bodies.erase(i) for i in range(32)]; O.bodies.append(box((2, 0), (4, 4))); O.step()', 'ValueError', ['same place', 'filled twice']),
        ('deformed(); O.bodies.append(box((0, 0), (2, 2), n=3)); O.step()', 'ValueError', ['same place', 'filled twice']),
        # before it
        ('scene(lambda: box((0, 0), (4, 4)) + box((1.25, 0), (3.25, 4), MpmGrid(cellSize=1, origin=(0.25, 0, 0)))); O.step()', 'ValueError', ['same place', 'overlap']),
        ('scene(lambda: box((0, 0), (4, 4)) + box((1, 1), (3, 3), MpmGrid(cellSize=1, origin=(0.25, 0.25, 0)))); O.step()', 'ValueError', ['same place', 'overlap']),
        ('scene(lambda: box((0, 0), (4, 4)) + box((1, 1), (3, 3), MpmGrid(cellSize=0.7), 1)); O.step()', 'ValueError', ['same place', 'overlap']),
        ('scene(); O.bodies[9].state.pos = O.bodies[20].state.pos + Vector3(0.01, 0, 0); O.step()', 'ValueError', ['#9 and #20', 'same place']),
        ('scene(); O.bodies.clump(list(range(4))); O.step()', 'ValueError', ['Body #0', 'part of a clump', 'body #64', 'releaseFromClump']),
        ('deformed(); O.bodies.clump(list(range(4))); O.step()', 'ValueError', ['Body #0', 'part of a clump']),
        ('deformed(); O.bodies.clump(list(range(4))); mpm.arrays()', 'ValueError', ['Body #0', 'part of a clump']),
        # inside YADE's OpenMP region, which no exception may leave
        ('nested({}, {}); O.step(); pass', 'ValueError', ['ParallelEngine', 'O.engines itself']),
        ('nested(dict(boundaries=[])); O.step(); pass', 'ValueError', ['ParallelEngine']),
        ('nested({}, {}); O.run(3, wait=True)', 'RuntimeError', ['ParallelEngine']),
        ('O.engines = [ParallelEngine([MpmVtkRecorder(fileName="x-")])]; O.step(); pass', 'ValueError', ['O.engines holds none']),
        # stress with the wrong sign
        ('''scene()
O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=1e3, label='clay'))
for b in O.bodies: b.mat = O.materials['clay']
mpm.assign(stress=np.tile(np.diag([0, 8e4, 0]), (64, 1, 1)))''', 'ValueError', ['Body #0', 'yields under', 'positive in tension']),
] + [
        (f'load({attribute!r}, {value!r}); O.step()', 'ValueError', [f'.{attribute}', 'is not admitted', words])
        for attribute, value, words in (('stepPart', '0', '> 0 and <= 1'), ('stepPart', '-1', '> 0 and <= 1'), ('stepPart', 'nan', '> 0 and <= 1'), ('stepPart', '2', '> 0 and <= 1'), ('loadFactor', 'nan', 'finite'),
                                        ('lastLoadIncrement', 'inf', 'finite'), ('lastDisplacements', 'nan', 'all finite'), ('lastDisplacements', '1e300', 'grid coordinates'), ('cuts', '-3', '>= 0'),
                                        ('dofs', '-3', '>= 0'), ('wallOverlap', 'nan', '>= 0'), ('loadTime', 'nan', 'finite'))
]


# Sentences that must hold, with their scripts.
sound = {
        'a look at the points takes a time in proportion to their number, whatever their sizes; a step whose points are those of the last one takes none':
        '''
solver = scene(lambda: box((0, 0), (1, 1), n=150) + box((1, 0), (2, 1), n=1))
O.step()
assert solver.report()['points'] == 22501 and solver.report()['times']['check'] < 0.4, solver.report()
O.step()
assert 'check' not in solver.report()['times']
O.bodies[3].state.pos = O.bodies[3].state.pos + Vector3(1e-9, 0, 0)
O.step()
assert 'check' in solver.report()['times']
''',
        'all bodies are meant by the masks that say so':
        '''
for mask in -1, 0:
	solver = scene(mask=mask, loadCurve=[(0, 1)])
	O.bodies[5].groupMask = 0
	O.step()
	assert solver.report()['points'] == 64 and abs(solver.reactions[0][1] - 320e3) < 1, (mask, solver.reactions)
''',
        'an engine answers for its own scene':
        '''
solver = scene()
def answers(): return solver.stiffness()[3], solver.plotData()['points'], solver.workload()['dofs'], round(solver.conditionEstimate(), 6)
made = answers()
O.switchScene()
O.materials.append(MpmElasticMat(young=1, poisson=0, density=1, label='soil'))
O.bodies.append(box((0, 0), (2, 2)))
assert answers() == made and made[1] == 64
other = MpmImplicitEngine(grid=MpmGrid(cellSize=1), boundaries=[base], verbosity=0)
assert other.plotData()['points'] == 16 # also in no scene
O.engines = [other]
O.switchScene()
assert other.plotData()['points'] == 16 and answers() == made
O.step()
O.switchScene()
assert solver.plotData()['points'] == 64
O.engines = [solver] # taken along
assert solver.plotData()['points'] == 16
O.switchScene()
O.engines = []
O.resetThisScene()
assert solver.plotData()['points'] == 16
''',
        'the end of the load curve is not left out by an engine that runs in every third iteration, and it keeps its rhythm':
        '''
solver = scene(iterPeriod=3)
O.dt = 1 / 30
times = []
for step in range(36):
	O.step()
	times.append(round(30 * solver.loadTime))
assert solver.loadFactor == 1 and times[27:] == [28, 28, 30, 31, 31, 31, 34, 34, 34], times
''',
}


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('plausibility'), setting, [*(script for script, _, _ in refused), *sound.values()])


@pytest.mark.parametrize('script, exception, words', refused, ids=[script for script, _, _ in refused])
def test_isRefused(outcomes, script, exception, words):
	kind, sentence = outcomes[script]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence, sentence


@pytest.mark.parametrize('script', sound.values(), ids=sound)
def test_holds(outcomes, script):
	assert outcomes[script] == ['no exception', ''], outcomes[script]


def paragraphs(run):
	"""Text on stderr after each say(title)."""
	return {text.split('\n')[0]: text for text in run.stderr.split('== ')[1:]}


def test_doubts_are_said_once_and_name_the_likely_unit(yade):
	run = yade(setting + '''
ordinary = dict(clay=(5e6, 1800), sand=(5e7, 2000), peat=(5e5, 1100), fill=(2e7, 1600))
for name, (young, density) in ordinary.items():
	for title, values in (name, (young, density)), (name + ' in kPa', (young / 1000, density)), (name + ' in t/m3', (young, density / 1000)):
		say(title)
		scene(young=values[0], density=values[1], gravity=(0, -9.81, 0))
		O.dt = 1e-3 # what follows is not the subject
		for step in range(3): O.step()
say('weightless'); s = scene(density=1e-3, gravity=(0, 0, 0)); O.step()
say('without units'); scene(density=1, young=1, gravity=(0, -1e-2, 0)); O.step()
say('later'); s = deformed(); O.materials[0].density = 2; O.step(); O.step()
say('gravity turned'); s = deformed(); s.gravity = (0, 10, 0); O.step(); s.gravity = (0, -10, 0); O.step(); s.gravity = (0, 9, 0); O.step()
say('tension'); scene(loadCurve=[(0, 1)]); mpm.assign(stress=np.tile(np.diag([1e3, 4e4, 1e3]), (64, 1, 1))); O.step(); O.step()
say('compression'); scene(loadCurve=[(0, 1)]); mpm.geostatic(K0=0.5, surface=4); O.step(); O.step()
say('sunk'); scene(boundaries=[MpmBoundary(max=(inf, -8, inf), fix='xy')])
for b in O.bodies: b.state.pos = b.state.pos - Vector3(0, 8, 0)
O.step(); O.step()
say('end')
''')
	said = paragraphs(run)
	for name in 'clay', 'sand', 'peat', 'fill':
		assert 'WARNING' not in said[name], said[name]
		for title, words in (name + ' in kPa', ('young = ', 'meant in kPa')), (name + ' in t/m3', ('density = ', 'meant in t/m3')):
			assert said[title].count('WARNING') == 1 and all(word in said[title] for word in ("'soil'", *words)), said[title]
	assert said['weightless'].count('WARNING') == said['weightless'].count('nothing acts on the material points') == 1, said['weightless']
	for title in 'without units', 'compression':
		assert 'WARNING' not in said[title], said[title]
	assert said['later'].count('WARNING') - said['later'].count('(ghostShare)') == said['later'].count('t/m3') == 1, said['later'] # the stabilisation resists, too, where nearly all weight goes at once, and says so
	assert said['gravity turned'].count('WARNING') == said['gravity turned'].count('gravity acts along +y') == 2, said['gravity turned']
	assert said['tension'].count('the initial stress along gravity is tension, 40000 Pa') == 1, said['tension']
	assert said['sunk'].count('m, is more than the size of the body, 4 m') == 1, said['sunk']


# script, and what the first step says of it once; empty: nothing
doubted = [
        ('scene(gravity=(0, 0, 0)); O.step(); O.step()', 'nothing acts on the material points'),
        ('scene(gravity=(0, 0, 0), boundaries=[base, MpmBoundary(min=(-inf, 4, -inf), fix="y", displacement=(0, -0.01, 0))]); O.step()', ''),
        ('scene(gravity=(0, 0, 0)); mpm.assign(force=np.tile((0, -10, 0), (64, 1))); O.step()', ''),
        ('scene(gravity=(0, 0, 0)); mpm.assign(stress=np.tile(np.diag([0, -10., 0]), (64, 1, 1))); O.step()', ''),
        ('moving(gravity=(0, 0, 0)); O.step()', 'nothing acts on the material points'),
        ('moving(gravity=(0, 0, 0)); mpm.assign(velocity=np.tile((1e-3, 0, 0), (64, 1))); O.step()', ''),
        ('scene(boundaries=[MpmBoundary(fix="xy")]); O.step(); O.step()', 'all nodes that material points touch are constrained'),
        ('scene(boundaries=[MpmBoundary(fix="xy", displacement=(0.01, 0, 0))]); O.step()', ''),
        ('moving(); O.dt = 1e-8; O.step(); O.step()', "YADE's default, in which the fastest wave"),
        ('moving(scheme="explicit"); O.dt = 1e-8; O.step()', "YADE's default, in which the fastest wave"),
        ('moving(); O.dt = 1e-3; O.step()', ''),
        ('made(MpmElasticMat(young=1e6, poisson=0.3, label="soil")); O.step(); O.step()', "the density of material 'soil' was not given"),
        ('made(MpmElasticMat(young=1e6, poisson=0.3, density=1000, label="soil")); O.step()', ''),
        ('m = MpmElasticMat(young=1e6, poisson=0.3, label="soil"); m.density = 1900; made(m); O.step()', ''),
        ('made(MpmElasticMat(young=1e6, poisson=0.3, density=1000, label="soil")); O.save("a.xml"); O.load("a.xml"); O.step()', ''),
        ('scene(); rock((2, 4.5, 0)); O.step(); O.step()', 'has no contacts, so that soil passes through it'),
        ('scene(contacts=[MpmContact(friction=0.3)]); rock((2, 4.5, 0)); O.step()', ''),
        ('scene(); rock((2, 40, 0)); O.step()', ''),
        ('scene(loads=[beam(20)]); O.step(); O.step()', 'is in the air: no material point is beside it'),
        ('scene(loads=[beam(2)]); O.step()', ''),
        ('scene(); mpm.assign(velocity=np.tile((1e-3, 0, 0), (64, 1))); O.step(); O.step()', 'does not use, as its steps have no inertia'),
        ('made(MpmElasticMat(young=1e6, poisson=0.49, density=2000, label="soil")); O.step(); O.step()', 'poisson = 0.49'),
        ('made(MpmElasticMat(young=1e6, poisson=0.49, density=2000, label="soil"), fBar=True); O.step()', ''),
        ('made(MpmElasticMat(young=1e6, poisson=0.49, density=2000, label="soil"), lambda: box((0, 0), (1, 4))); O.step()', ''),
        ('scene(basis="mpm", fBar=True); O.step(); O.step()', "basis = 'mpm' with fBar = True"),
        ('scene(basis="mpm"); O.step()', ''),
        ('moving(boundaries=[based(shaken)]); O.step(); O.step()', 'boundaries[0].motion.history is of velocities'),
        ('moving(boundaries=[based(np.sin(0.02 * np.pi * np.arange(1001)) * np.sin(0.001 * np.pi * np.arange(1001))**2)]); O.step()', ''),
        ('deformed(); O.step(); mpm.stages.place(box((0, 4), (3, 5.2), MpmGrid(cellSize=0.6))); O.step(); O.step()', 'Was mpm.fill given another MpmGrid than the engine?'),
        ('deformed(); O.step(); mpm.stages.place(box((0, 4), (3, 5))); O.step()', ''),
        ('scene(); mpm.stages.place(box((0, 4), (3, 5.2), MpmGrid(cellSize=0.6))); O.step(); O.step()', 'Was mpm.fill given another MpmGrid than the engine?'),
        ('scene(); mpm.stages.place(box((0, 4), (3, 5.2), MpmGrid(cellSize=0.3)), steps=2); O.step(); O.step()', 'no material point is of a size that fits'),
        ('scene(); mpm.stages.place(box((0, 4), (3, 5))); O.step()', ''),
        ('scene(); mpm.stages.place(mpm.add(mpm.polygon([(0, 4), (3, 4), (3, 5), (0, 5)]), O.engines[0], 2, "soil")); O.step()', ''),
]


def test_the_first_step_doubts_what_is_seldom_meant(yade):
	run = yade(setting + '''
def made(material, bodies=None, **changes):
	solver = scene(bodies, **changes)
	O.reset()
	O.materials.append(material)
	O.bodies.append(bodies() if bodies else box((0, 0), (4, 4)))
	O.engines, O.dt = [solver], 1 / 4

def moving(**changes):
	static = scene()
	O.engines = [MpmDynamicEngine(**(dict(grid=static.grid, gravity=(0, -10, 0), boundaries=[base], verbosity=0) | changes))]
	O.dt = 1e-3

def rock(place):
	from yade import utils
	O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2000, label='rock'))
	O.bodies.append(utils.sphere(place, 0.5, material='rock', fixed=True))

def beam(x):
	return MpmBeam(line=[(x, 3), (x, 1)], axialStiffness=1e7, bendingStiffness=1e6)

shaken = np.random.default_rng(1).standard_normal(1001) * np.sin(np.pi * np.arange(1001) / 1000)**2
def based(values):
	return MpmBoundary(max=(inf, 0, inf), fix='xy', motion=MpmBaseMotion(history=[(0.01 * i, float(v)) for i, v in enumerate(values)]))

''' + '\n'.join(f'say({i})\n{script}' for i, (script, _) in enumerate(doubted)))
	said = paragraphs(run)
	for i, (script, words) in enumerate(doubted):
		own = [line for line in said[str(i)].splitlines() if 'WARNING' in line and '(ghostShare)' not in line and 'loadCurve has' not in line]
		assert len(own) == (words != '') and words in ''.join(own), (script, said[str(i)])


def test_what_advise_says_is_what_the_first_step_would(yade):
	assert 'settings: nothing acts' in yade(setting + '''
solver = scene(gravity=(0, 0, 0))
mpm.advise()
O.step()
''').stdout


def test_sound_neighbours_and_deformed_scenes_are_left_in_peace(yade):
	"""Fills of other lattices side by side; points that shear has pushed into one another, loaded, or with others erased and added."""
	run = yade(setting + '''
say('sound')
for grid, n in (None, 3), (MpmGrid(cellSize=0.5), 2), (MpmGrid(cellSize=0.7), 2), (MpmGrid(cellSize=1, origin=(0.25, 0.1, 0)), 2), (MpmGrid(cellSize=1, origin=(0.25, 0.25, 0)), 1):
	scene(lambda: box((0, 0), (4, 4)) + box((4, 0), (8, 4), grid, n) + box((0, 4), (8, 6), grid, n))
	O.step()
from scenes import *
O.reset()
O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
O.bodies.append(box((0, 0), (4, 4)))
O.engines = [MpmImplicitEngine(grid=MpmGrid(cellSize=1), gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), base], verbosity=0, label='solver')]
O.dt = 1 / 20
O.run(20, wait=True)
a = mpm.arrays()
assert np.abs(a['pos'] - a['pos0']).max() > 1 and a['plasticStrain'].max() > 0.5
solver.loadCurve = [(0, 0), (1, 1), (2, 1.01)]
mpm.save('cut.yade.gz')
O.load('cut.yade.gz')
O.step()
O.bodies.erase(int(np.argmax(mpm.arrays()['pos'][:, 1])))
O.step()
say('loaded twice')
twins = mpm.arrays()
O.bodies.append(box((0, 0), (4, 4))[:len(twins['id'])])
own = mpm.arrays()['id'][len(twins['id']):]
mpm.assign(ids=own, **{name: twins[name] for name in ('pos', 'defGrad', 'elasticStrain', 'plasticStrain')})
for b, half in zip((O.bodies[int(i)] for i in own), twins['halfSize']): b.shape.halfSize = tuple(half)
O.step()
say('end')
''')
	said = paragraphs(run)
	warnings = [line for line in said['sound'].splitlines() if 'WARNING' in line]
	assert all('fill: the region has' in line for line in warnings), warnings  # some of the lattices are off the region's edges
	assert said['loaded twice'].count('m3 of material are counted twice') == 1, said['loaded twice']


def test_a_scene_is_replaced_quietly_in_the_middle_of_a_step(yade):
	run = yade('''
from scenes import *
import time
solver = slope(steps=400)
solver.verbosity = 0
O.run(5, wait=True)
O.saveTmp()
for replace in O.loadTmp, O.pause, O.reload, O.reset:
	O.run(100)
	time.sleep(0.1)
	replace()
	assert not O.running
''')
	assert 'ERROR' not in run.stdout + run.stderr, run


def test_a_forked_process_does_not_wait_for_threads_that_it_has_not(yade):
	yade('''
from scenes import *
import os, time
solver = slope(cellSize=0.5)
solver.verbosity = 0
def child(threads):
	pid = os.fork()
	if pid == 0:
		solver.ompThreads = threads
		try: O.step()
		except RuntimeError as error: os._exit(1 if 'was forked' in str(error) else 2)
		os._exit(0)
	deadline = time.time() + 20
	while time.time() < deadline:
		ended, status = os.waitpid(pid, os.WNOHANG)
		if ended: return os.waitstatus_to_exitcode(status)
		time.sleep(0.02)
	os.kill(pid, 9)
assert child(2) == 1, 'not refused' # YADE has had threads already
O.step()
assert child(2) == 1, 'not refused'
assert child(1) == 0
''', threads=2)
