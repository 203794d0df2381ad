# SPDX-License-Identifier: GPL-2.0-or-later
"""A law with tensors, and its class of materials, that the plugin does not have: tests/law is linked to it, and nothing else."""
import json
import re
import subprocess

import numpy as np
import pytest
from conftest import Yade, build, makeOverlay, root

library = build / 'tests' / 'engine_with_law' / 'mpm_engine.so'

scene = '''
import json
from scenes import *

G, yieldStress, hardening = 1e9, 1e3, 3e8

def sheared(dim=2, cells=2, **engine):
	"""A block whose rows of nodes are moved to and fro, in 40 steps: simple shear. Strains are so small that their products are round-off."""
	O.reset()
	O.materials.append(MpmKinematicMat(young=2.6e9, poisson=.3, density=2000, yieldStress=yieldStress, hardening=hardening, label='clay'))
	grid = MpmGrid(cellSize=1, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (cells, 2, 1)), grid, 2, 'clay'))
	top = 3 * yieldStress / 2**.5 / G
	rows = [(-inf, .1), (.9, 1.1), (1.9, inf)]
	boxes = [MpmBoundary(min=(-inf, low, -inf), max=(inf, high, inf), fix='xy' if dim == 2 else 'xyz', displacement=(row * top, 0, 0)) for row, (low, high) in enumerate(rows)]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boxes, loadCurve=[(0, 0), (1, 1), (3, -1), (4, 0)], verbosity=0, **engine)]
	O.dt = .1
	return O.engines[0]

def column(material, dim=2, height=4, engine=MpmImplicitEngine, **settings):
	"""A column under its weight, by a wall on its left; around an axis with settings['axisymmetric']."""
	O.reset()
	common = dict(young=1e6, poisson=.3, density=2000, yieldStress=2.5e4, label='clay')
	O.materials.append(MpmKinematicMat(**common) if material == 'tensors' else MpmVonMisesMat(**common))
	grid = MpmGrid(cellSize=1, dim=dim, axisymmetric=settings.pop('axisymmetric', False))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (2, height, 1)), grid, 2, 'clay'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	if grid.axisymmetric: sides = sides[1:]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z')]
	O.engines = [engine(grid=grid, boundaries=sides, gravity=(0, -9.81, 0), verbosity=0, **settings)]
	O.dt = .1
	return O.engines[0]
'''


@pytest.fixture(scope='module')
def yade(tmp_path_factory):
	"""YADE with that class."""
	if not library.exists(): pytest.skip('scripts/setup --tests builds the class')
	yade = Yade(tmp_path_factory.mktemp('tensors'))
	yade.command, yade.isShared = makeOverlay(tmp_path_factory.mktemp('overlay'), engine=library), True
	return yade


def loop(steps, G=1e9, yieldStress=1e3, hardening=3e8):
	"""Shear stress and back stress after each step: two straight lines, to and fro."""
	limit, strain = yieldStress / 2**.5, 3 * yieldStress / 2**.5 / G / 10
	stress, back, found = 0, 0, []
	for step in range(steps):
		trial = stress + G * strain * (1 if step < 10 or step >= 30 else -1)
		flow = max(0, abs(trial - back) - limit) / (2 * G + hardening) * np.sign(trial - back)
		stress, back = trial - 2 * G * flow, back + hardening * flow
		found.append((stress, back))
	return np.array(found)


@pytest.mark.parametrize('settings', ['dim=2', 'dim=3', 'dim=2, fBar=True', 'dim=3, fBar=True'])
def test_cyclic_shear(yade, settings):
	found = np.array(
	        yade(
	                scene + f'''
sheared({settings})
found = []
for step in range(40):
	O.step()
	points = mpm.arrays()
	found.append([(f(points['stress'][:, 0, 1]), f(points['backStressXY'])) for f in (np.min, np.max)])
print(json.dumps(found))
'''
	        ).result
	)
	expected = loop(40)
	for extreme in 0, 1:
		assert np.abs(found[:, extreme] - expected).max() < 2e-5 * 1e3
	assert np.abs(expected[:, 1]).max() > 100


def test_saved_and_continued(yade):
	run = yade(
	        scene + '''
sheared()
O.engines += [MpmVtkRecorder(fileName='back-', iterPeriod=15)]
O.run(15, wait=True)
O.save('middle.yade.gz')
O.run(15, wait=True)
straight = mpm.arrays()
mpm.export('back.csv')
mpm.plot('backStressXY', fileName='back.png')
O.load('middle.yade.gz')
O.run(15, wait=True)
after = mpm.arrays()
assert set(after) == set(straight)
assert all(values.tobytes() == straight[name].tobytes() for name, values in after.items())
assert set(name for name in after if name.startswith('backStress')) == {'backStress' + axes for axes in ('XX', 'YY', 'ZZ', 'XY', 'YZ', 'ZX')}
print(json.dumps(after['backStressXY'].tolist()))
'''
	)
	expected = loop(30)[-1, 1]
	assert np.abs(np.array(run.result) - expected).max() < 2e-2
	files = sorted(run.folder.glob('back-*.vtu'))
	assert files and all(b'backStressXY' in file.read_bytes() for file in files)
	assert 'backStressXY' in (run.folder / 'back.csv').read_text().splitlines()[0]


def test_assigned_and_split(yade):
	"""A state can be given; what lies beyond yield is refused; halves have what the whole had."""
	yade(
	        scene + '''
sheared()
n = len(O.bodies)
shear = lambda value: np.full((n, 1, 1), value) * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
mpm.assign(stress=shear(600.))
try: mpm.assign(stress=shear(1200.))
except ValueError as error: assert 'yields' in str(error)
else: assert False
mpm.assign(stress=shear(1200.), backStressXY=np.full(n, 800.))  # around its centre
points = mpm.arrays()
assert (points['backStressXY'] == 800).all() and np.allclose(points['stress'][:, 0, 1], 1200)
assert np.allclose(points['elasticStrain'][:, 0, 1], 1200 / 2e9, rtol=1e-9)
try: mpm.assign(backStressXY=np.full(n, np.nan))
except ValueError as error: assert 'backStressXY' in str(error)
else: assert False

# stretched until points outgrow half a cell
O.reset()
O.materials.append(MpmKinematicMat(young=1e6, poisson=.3, density=2000, yieldStress=1e3, hardening=1e5, label='clay'))
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), MpmGrid(cellSize=1), 2, 'clay'))
pulled = MpmBoundary(min=(.9, -inf, -inf), fix='x', displacement=(1.5, 0, 0))
O.engines = [MpmImplicitEngine(grid=MpmGrid(cellSize=1), boundaries=[MpmBoundary(max=(.1, inf, inf), fix='x'), MpmBoundary(fix='y'), pulled], maxSplits=2, verbosity=0)]
O.dt = 1 / 30
while len(O.bodies) == 4:
	O.step()
points = mpm.arrays()
parents = np.searchsorted(points['id'], points['parent'][4:])
assert len(parents) > 0 and (points['backStressXX'][4:] > 1e3).all()
for name in 'backStressXX', 'backStressYY', 'backStressZZ', 'backStressXY', 'plasticStrain':
	assert (points[name][4:] == points[name][parents]).all()
'''
	)


@pytest.mark.parametrize(
        'settings', [
                '', 'fBar=True', 'dim=3, height=3', 'dim=3, height=3, fBar=True', 'axisymmetric=True', 'axisymmetric=True, fBar=True',
                "engine=MpmDynamicEngine, scheme='explicit'", 'engine=MpmDynamicEngine'
        ]
)
def test_without_hardening_it_is_von_mises(yade, settings):
	"""In every analysis: the same results by six numbers as by principal values."""
	run = yade(
	        scene + f'''
from yade.wrapper import MpmDynamicEngine
found = []
for material in 'tensors', 'principal':
	solver = column(material, {settings})
	if isinstance(solver, MpmDynamicEngine): O.dt = .3 * solver.criticalTimeStep() if solver.scheme == 'explicit' else .02
	O.run(30 if isinstance(solver, MpmDynamicEngine) else 10, wait=True)
	points = mpm.arrays()
	found.append([points[name].tolist() for name in ('pos', 'stress', 'plasticStrain', 'halfSize')])
print(json.dumps(found))
'''
	)
	tensors, principal = run.result
	for ours, theirs in zip(tensors, principal):
		assert np.abs(np.array(ours) - np.array(theirs)).max() < 1e-6 * np.abs(np.array(theirs)).max()
	assert np.max(principal[2]) > 1e-4


def test_two_processes(yade):
	"""Together and with divided points: what one process comes to."""
	script = scene + '''
import sys
solver = sheared(cells=6, distributed=sys.argv[1] == 'divided')
O.run(30, wait=True)
points = mpm.arrays()
np.savez(sys.argv[2], **points)
'''
	if not list((build / 'mpm').glob('mpm_petsc.so')): pytest.skip('needs scripts/setup --with-petsc')
	alone = yade(script, 'whole', 'alone.npz').folder
	for how in 'whole', 'divided':
		yade(script, how, f'{how}.npz', processes=2)
	one = np.load(alone / 'alone.npz')
	for how in 'whole', 'divided':
		two = np.load(alone / f'{how}.npz')
		assert (two['id'] == one['id']).all()
		for name in 'stress', 'backStressXY', 'backStressXX', 'plasticStrain', 'pos':
			assert np.abs(two[name] - one[name]).max() <= 1e-7 * max(np.abs(one[name]).max(), 1e-12), name
	assert np.abs(one['backStressXY']).max() > 50


def test_single_answers(yade):
	"""mpm.respond and mpm.elementTest, which know of the axes and the time of the law."""
	found = yade(
	        scene + '''
material = MpmKinematicMat(young=2.6e9, poisson=.3, density=2000, yieldStress=yieldStress, hardening=hardening, label='clay')
strain = np.array([[0, 2e-6, 0], [2e-6, 0, 0], [0, 0, 0]])
answer = mpm.respond(material, strain, backStressXX=200., backStressYY=-200.)
h, n = 1e-10, []
for k, unit in enumerate(np.eye(6)):
	tensor = lambda v: np.array([[v[0], v[3] / 2**.5, v[5] / 2**.5], [v[3] / 2**.5, v[1], v[4] / 2**.5], [v[5] / 2**.5, v[4] / 2**.5, v[2]]])
	up, down = (mpm.respond(material, strain + s * h * tensor(unit), backStressXX=200., backStressYY=-200.)['stress'] for s in (1, -1))
	mandel = lambda m: np.array([m[0, 0], m[1, 1], m[2, 2], 2**.5 * m[0, 1], 2**.5 * m[1, 2], 2**.5 * m[2, 0]])
	n.append((mandel(up) - mandel(down)) / (2 * h))
assert np.abs(np.array(n).T - answer['tangent']).max() < 1e-6 * np.abs(answer['tangent']).max()
assert answer['plasticStrain'] > 0 and answer['backStressXX'] < 200
slow = MpmKinematicMat(young=2.6e9, poisson=.3, density=2000, yieldStress=yieldStress, hardening=hardening, viscosity=1e9)
at = [mpm.respond(slow, strain, duration=duration)['stress'][0, 1] for duration in (0, 1, 1e9)]
assert at[0] == 4000 and at[0] > at[1] > at[2]
curve = mpm.elementTest(material, 'simpleShear', 4e-6, steps=40)
oedometer = mpm.elementTest(material, 'oedometer', -4e-6, steps=40)
print(json.dumps([curve['stress'][:, 0, 1].tolist(), curve['backStressXY'].tolist(), oedometer['stress'][:, 1, 1].tolist()]))
'''
	).result
	shear, back, axial = map(np.array, found)
	strain = np.linspace(0, 4e-6, 41)
	limit = 1e3 / 2**.5
	flow = np.maximum(0, 1e9 * strain - limit) / 2.3e9
	assert np.abs(shear - (1e9 * strain - 2e9 * flow)).max() < .1
	assert np.abs(back - 3e8 * flow).max() < .1
	K, deviator = 2.6e9 / 1.2, 2e9 * (2 / 3)**.5 * strain
	s = deviator - 2e9 * np.maximum(0, deviator - 1e3) / 2.3e9
	assert np.abs(axial + K * strain + (2 / 3)**.5 * s).max() < .1


def test_stresses_across_are_kept_each(yade):
	"""A back stress that is not alike along x and z: the strains across differ, and shear stress, which no side of a triaxial test bears, is refused by name."""
	curves, biaxial, said = yade(
	        scene + '''
material = MpmKinematicMat(young=2.6e9, poisson=.3, density=2000, yieldStress=yieldStress, hardening=hardening, label='clay')
def test(kind='triaxial', **internals): return mpm.elementTest(material, kind, -4e-6, steps=8, confiningPressure=500., **internals)
curves = [test(backStressXX=b, backStressZZ=-b) for b in (0., 400.)]
biaxial = test('biaxial', backStressXX=400., backStressZZ=-400.)
said = []
for kind in 'triaxial', 'biaxial':
	try: test(kind, backStressXY=300.)
	except RuntimeError as error: said.append(str(error))
test('oedometer', backStressXY=300.) # whose walls hold it
print(json.dumps([[[c['stress'].tolist(), c['elasticStrain'].tolist(), c['defGrad'].tolist(), c['backStressXX'].tolist()] for c in curves], [biaxial['stress'].tolist(), biaxial['defGrad'].tolist()], said]))
'''
	).result
	for stress, elastic, defGrad, back in (map(np.array, curve) for curve in curves):
		across = stress[:, [0, 2], [0, 2]]
		assert np.abs(across + 500).max() < 1e-4  # relative to 1e4 and more along y, to the round-off of the strains
		assert stress[-1, 1, 1] < -1500
		stretch = np.log(defGrad[-1, [0, 1, 2], [0, 1, 2]])
		plastic = stretch - elastic[-1].diagonal() + elastic[0].diagonal()
		assert abs(plastic.sum()) < 1e-3 * np.abs(plastic).max() > 1e-10
		assert (abs(plastic[0] - plastic[2]) > .1 * np.abs(plastic).max()) == (back[0] != 0)
	stress, defGrad = map(np.array, biaxial)
	assert np.abs(stress[:, 0, 0] + 500).max() < 1e-4 and (defGrad[:, 2, 2] == 1).all() and abs(stress[-1, 2, 2] + 500) > 100
	for text in said:
		assert 'elementTest: ' in text and 'has no solution beyond axialStrain' in text and 'other axes than the test: a shear stress of' in text
	assert len(said) == 2


def test_ground_at_rest(yade):
	"""K0 has to be given, with which the ground does not move; what the law cannot carry is refused."""
	said, moved, stress, tooMuch = yade(
	        scene + '''
def ground():
	solver = column('tensors')
	solver.boundaries += (MpmBoundary(min=(2, -inf, -inf), fix='x'),)
	solver.gravityCurve = [(0, 1)]
	return solver
ground()
try: mpm.geostatic()
except ValueError as error: said = str(error)
mpm.geostatic(K0=.8)
stress = mpm.arrays()['stress']
O.step()
ended = mpm.arrays()
try:
	ground()
	O.materials[0].yieldStress = 1e3
	mpm.geostatic(K0=.8)
except ValueError as error: tooMuch = str(error)
print(json.dumps([said, float(np.abs(ended['pos'] - ended['pos0']).max()), [stress[:, 0, 0].min(), stress[:, 1, 1].min()], tooMuch]))
'''
	).result
	assert said.startswith("geostatic: K0 = None, but that of the material 'clay' is not known: MpmKinematicMat")
	assert moved < 1e-9 and stress[0] == pytest.approx(.8 * stress[1], rel=1e-9) and stress[1] == pytest.approx(-2000 * 9.81 * 3.75, rel=1e-9)
	assert 'geostatic: with K0 = 0.8 the ground would not be at rest' in tooMuch and 'yields' in tooMuch


@pytest.mark.parametrize('member', ['isElastic', 'isSymmetric', 'young', 'weakened'])
def test_what_is_forgotten_is_named_by_the_compiler(tmp_path, member):
	text = (root / 'tests/law/kinematic_hardening.hpp').read_text()
	(tmp_path / 'law.hpp').write_text(re.sub(rf'(?<!\.)\b{member}\b(?=\(\w* ?\w*|\(const| = )', 'other', text, count=1))
	(tmp_path / 'law.cpp').write_text('#include "law.hpp"\ngimpm::Law law = gimpm::KinematicHardening(1, .3, 1, 1);\n')
	command = ['g++', '-std=c++17', '-fsyntax-only', '-I', root / 'plugin', '-I', '/usr/include/eigen3', 'law.cpp']
	ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
	assert ended.returncode and re.search(rf'static assertion failed: the (tensor )?law has no `[^`]*\b{member}\b', ended.stderr), ended.stderr[:2000]
