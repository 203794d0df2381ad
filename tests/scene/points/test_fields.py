# SPDX-License-Identifier: GPL-2.0-or-later
"""Strengths and moduli that differ from point to point within a material."""
import numpy as np
import pytest
from conftest import Yade

scene = '''
import json
from scenes import *
from yade.wrapper import MpmCamClayMat, MpmDruckerPragerMat, MpmMohrCoulombMat, MpmTrescaMat, MpmVtkRecorder

strength = lambda y: 4e3 + 1.2e3 * (6 - y)
young = lambda y: 1e6 + 2e5 * (6 - y)

def slope(layers=False, **fields):
	"""A slope of clay, in layers of half a cell, the rows of points, or of one material; returns the engine."""
	O.reset()
	rows = [.25 + .5 * i for i in range(12)]
	for y in rows if layers else [3]:
		O.materials.append(MpmTrescaMat(young=young(y), poisson=.3, density=2000, undrainedStrength=strength(y), label=f'{y:.2f}'))
	grid = MpmGrid(cellSize=1)
	profile = mpm.polygon([(0, 0), (12, 0), (12, 3), (7, 3), (4, 6), (0, 6)])
	O.bodies.append(mpm.fill(profile, grid, 2, (lambda x: f'{x[1]:.2f}') if layers else '3.00', **fields))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(12, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, verbosity=0, label='solver')]
	O.dt = 1 / 8
	return O.engines[0]
'''


@pytest.fixture(scope='module')
def run(tmp_path_factory):
	return Yade(tmp_path_factory.mktemp('fields'))(
	        scene + '''
slope(layers=True)
O.run(8, wait=True)
np.savez('layers.npz', **mpm.arrays())

functions = dict(undrainedStrength=lambda x: strength(x[1]), young=lambda x: young(x[1]))
slope(**functions)
O.engines += [MpmVtkRecorder(fileName='field-', iterPeriod=4)]
O.run(4, wait=True)
O.save('middle.yade.gz')
O.run(4, wait=True)
straight = mpm.arrays()
np.savez('field.npz', **straight)
mpm.export('field.csv')
mpm.plot('undrainedStrength', fileName='field.png')
mpm.colour('undrainedStrength')
O.load('middle.yade.gz')
O.run(4, wait=True)
assert all(values.tobytes() == straight[name].tobytes() for name, values in mpm.arrays().items())

# the same from arrays and functions, by mpm.assign
slope()
assert 'undrainedStrength' not in mpm.arrays()
y = mpm.arrays()['pos'][:, 1]
mpm.assign(undrainedStrength=strength(y), young=functions['young'])
O.run(8, wait=True)
assert (mpm.arrays()['stress'] == straight['stress']).all()
slope(undrainedStrength=strength(y), young=young(y))
assert (mpm.arrays()['young'] == young(y)).all()
advice = mpm.advise()['advice']

# some points only
engine = slope()
some = mpm.arrays()['id'][::7]
mpm.assign(ids=some, undrainedStrength=np.full(len(some), 2e3))
found = mpm.arrays()['undrainedStrength']
assert (found[::7] == 2e3).all() and (found[1] == strength(3)) and mpm.arrays().keys() - straight.keys() == set()
assert O.bodies[0].state.parameters == [('undrainedStrength', 2e3)] or O.bodies[0].state.parameters == (('undrainedStrength', 2e3),)

# stress is checked by the strength of the point
shear = lambda tau, n: [[[0, tau, 0], [tau, 0, 0], [0, 0, 0]]] * n
mpm.assign(ids=some, stress=shear(1.9e3, len(some)))
messages = []
def refused(f, kind=ValueError):
	before = mpm.arrays()
	try: f()
	except kind as error: messages.append(str(error))
	else: raise AssertionError('not refused')
	assert all(values.tobytes() == before[name].tobytes() for name, values in mpm.arrays().items())
refused(lambda: mpm.assign(ids=some, stress=shear(2.1e3, len(some))))
mpm.assign(ids=some, stress=shear(2.1e3, len(some)), undrainedStrength=np.full(len(some), 2.2e3))

# what the material admits
n = len(O.bodies)
bad = np.full(n, 5e3)
bad[5] = -1
refused(lambda: mpm.assign(undrainedStrength=bad))
refused(lambda: mpm.assign(cohesion=np.ones(n)))
refused(lambda: mpm.assign(undrainedStrength=5e3))
refused(lambda: mpm.assign(undrainedStrength=lambda x: 'five'), TypeError)
refused(lambda: mpm.assign(undrainedStrength=np.full(n, np.nan)))
refused(lambda: mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), MpmGrid(cellSize=1), 2, '3.00', undrainedStrength=lambda x: x[0] - .5))
refused(lambda: mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), MpmGrid(cellSize=1), 2, '3.00', poisson=lambda x: .2), TypeError)
refused(lambda: mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), MpmGrid(cellSize=1), 2, '3.00', young=[1e6]))
O.bodies[3].state.parameters = [('undrainedStrength', -7.)]
refused(O.step)
refused(lambda: setattr(O.bodies[3].state, 'parameters', [('poisson', .2)]))
refused(lambda: setattr(O.bodies[3].state, 'parameters', [('young', 1.), ('young', 2.)]))

# two materials of which one has it
O.reset()
O.materials.append(MpmMohrCoulombMat(young=1e6, poisson=.3, density=2000, cohesion=1e3, frictionAngle=.5, label='sand'))
O.materials.append(MpmElasticMat(young=1e8, poisson=.2, density=2500, label='rock'))
grid = MpmGrid(cellSize=1)
layered = lambda **fields: mpm.fill(pack.inAlignedBox((0, 0, -1), (2, 2, 1)), grid, 2, lambda x: 'sand' if x[1] > 1 else 'rock', **fields)
refused(lambda: layered(cohesion=lambda x: 2e3))
O.bodies.append(layered(young=lambda x: 1e6))
sand = mpm.arrays()['pos'][:, 1] > 1
refused(lambda: mpm.assign(cohesion=np.full(16, 2e3)))
mpm.assign(ids=mpm.arrays()['id'][sand], cohesion=np.full(8, 2e3))
assert np.isnan(mpm.arrays()['cohesion'][~sand]).all() and (mpm.arrays()['cohesion'][sand] == 2e3).all()
refused(lambda: mpm.assign(ids=mpm.arrays()['id'][sand], dilationAngle=np.full(8, .6)))
refused(lambda: mpm.assign(ids=mpm.arrays()['id'][sand], frictionAngle=np.full(8, 30.)))
print(json.dumps([advice, messages]))
'''
	)


def test_field_equals_layers(run):
	layers, field = (np.load(run.folder / f'{name}.npz') for name in ('layers', 'field'))
	assert field['plasticStrain'].max() > 1e-3
	for name in 'stress', 'plasticStrain', 'pos':
		assert np.abs(layers[name] - field[name]).max() <= 1e-9 * np.abs(field[name]).max(), name
	assert field['undrainedStrength'] == pytest.approx(4e3 + 1.2e3 * (6 - field['pos0'][:, 1]))


def test_outputs(run):
	from vtu import Vtu
	points = np.load(run.folder / 'field.npz')
	heads = (run.folder / 'field.csv').read_text().partition('\n')[0].split(',')
	table = dict(zip(heads, np.genfromtxt(run.folder / 'field.csv', delimiter=',', skip_header=1).T))
	assert (table['undrainedStrength [Pa]'] == points['undrainedStrength']).all()
	assert (Vtu(run.folder / 'field-points.8.vtu').fields['young'] == points['young']).all()
	assert (run.folder / 'field.png').stat().st_size > 10000


def test_refused(run):
	messages = run.result[1]
	expected = [
	        ('Body #', 'yields'), ('Body #5', 'MpmTrescaMat.undrainedStrength = -1', 'expected a finite number > 0'), ('Body #0', "'3.00' (MpmTrescaMat)", 'no parameter cohesion', 'young, undrainedStrength'),
	        ('undrainedStrength = 5000.0', 'function of the position'), ("returned 'five'", ), ('MpmTrescaMat.undrainedStrength = nan', ), ('fill: at (0.25, ', 'undrainedStrength = -0.25'),
	        ('poisson is no strength or modulus', ), ('array of 4 numbers', ), ('Body #3', 'undrainedStrength = -7'), ('parameters', 'each once'), ('parameters', 'each once'),
	        ("'rock' (MpmElasticMat)", 'no parameter cohesion'), ("'rock' (MpmElasticMat)", 'no parameter cohesion'), ('dilationAngle = 0.6', 'frictionAngle = 0.5'), ('frictionAngle = 30', 'radians(30)')
	]
	for parts, message in zip(expected, messages, strict=True):
		assert all(part in message for part in parts), (parts, message)
