# SPDX-License-Identifier: GPL-2.0-or-later
"""Estimates of the discretisation error: by halved cells and by recovered stresses, what they say of known answers, and what they refuse."""
import sys

import numpy as np
import pytest
from conftest import Yade, root

sys.path.insert(0, str(root / 'plugin/python/mpm/analysis'))
from recovery import smoothed
from refinement import errorOf, errorOfFinest


@pytest.mark.parametrize('order', [0.42, 0.5, 1, 2, 4, 9])
def test_estimate_is_within_two_for_all_orders(order):
	coarser, value, finer = (3 - 0.2 * h**order for h in (2, 1, 0.5))
	error, oneWay, settled = errorOf(coarser, value, finer)
	assert 0.5 <= error / 0.2 <= 2 and oneWay and settled
	mirrored = errorOf(-coarser, -value, -finer)
	assert mirrored == (error, True, True)


@pytest.mark.parametrize('shrinks', [0.05, 0.3, 0.7, 0.95])
def test_estimate_of_what_goes_up_and_down(shrinks):
	error, oneWay, settled = errorOf(3 - 0.2 / shrinks, 3.2, 3 - 0.2 * shrinks)
	assert 0.5 <= error / 0.2 <= 2 and not oneWay and settled == (shrinks < 0.75)


def test_estimate_at_its_edges():
	assert errorOf(1, 1, 1) == (0, True, True)
	assert errorOf(1, 2, 4) == (4, True, False) # no order: the change grows
	assert errorOf(1, 1, 2) == (2, True, False)
	assert not errorOf(3 - 0.2 * 2**0.4, 2.8, 3 - 0.2 * 0.5**0.4)[2]


def test_estimate_of_the_finest():
	"""Among the kept results of examples/discretisation, whose answers are known, the true error is more than twice the estimate in three of 69."""
	sys.path[:0] = [str(root / 'examples/discretisation')]
	import page
	folder, ratios = str(root / 'examples/discretisation'), []
	for ladder in page.ladders(folder).values():
		for cells, (value, _) in ladder.items():
			exact = page.answer(ladder, cells)
			if cells % 4 or cells // 4 not in ladder or cells // 2 not in ladder or exact is None: continue
			ratios.append(errorOfFinest(ladder[cells // 4][0], ladder[cells // 2][0], value)[0] / abs(value - exact))
	assert len(ratios) >= 69 and sum(ratio < 0.5 for ratio in ratios) <= 3
	assert errorOfFinest(1, 1, 1) == (0, 0) and errorOfFinest(1, 1, 2)[1] == np.inf
	assert errorOfFinest(3, 2, 1.5) == (0.5, 0.5) and errorOfFinest(1, 2, 1.6) == (pytest.approx(0.2), pytest.approx(0.4))


def cloud(dim, n=400, seed=7):
	random = np.random.default_rng(seed)
	return random.uniform(-2, 3, (n, dim)), random.uniform(0.5, 2, n)


@pytest.mark.parametrize('dim', [2, 3])
def test_linear_fields_are_recovered(dim):
	"""Each group has its own, with a jump between them."""
	x, weight = cloud(dim, 400 if dim == 2 else 4000)
	group = (x[:, 0] > 0).astype(int)
	field = np.stack([3 + x @ np.arange(1, dim + 1), -2 - x[:, -1]], axis=1) + 50 * group[:, None]
	assert np.abs(smoothed(x, group, weight, field) - field).max() < 1e-9
	assert np.abs(smoothed(x, 0 * group, weight, field) - field).max() > 5


def test_what_cannot_be_a_plane_is_flat():
	x = np.array([[0.5, 0.5], [0.5, 1.5], [0.5, 2.5], [7.2, 3.3]]) # one row, and a point by itself
	field = np.array([[1.], [2.], [3.], [9.]])
	assert np.allclose(smoothed(x, np.zeros(4, int), np.ones(4), field)[:, 0], [1.25, 2, 2.75, 9]) # the nodes at the ends have one point each


def test_scatter_is_taken_out_and_far_points_are_refused():
	x, weight = cloud(2, 4000)
	noise = np.where(np.arange(4000) % 2, 1., -1.)[:, None]
	rest = smoothed(x, np.zeros(4000, int), weight, x[:, :1] + noise) - x[:, :1]
	assert np.sqrt((rest**2).mean()) < 0.2
	with pytest.raises(ValueError, match='more than can be numbered'):
		smoothed(np.array([[0, 0], [1e10, 1e10]]), np.zeros(2, int), np.ones(2), np.ones((2, 1)))


@pytest.fixture(scope='module')
def column(tmp_path_factory):
	"""The column of section 4.1, by the size of its cells."""
	return Yade(tmp_path_factory.mktemp('column'))('''
import io, contextlib, json
from scenes import *

def run(cellSize):
	column(round(50 / cellSize))
	O.engines[0].verbosity = 0
	O.run(40, wait=True)
	points = mpm.arrays()
	stress = points['stress'][:, 1, 1]
	exact = -800 * (50 - points['pos0'][:, 1])
	return dict(settlement=50 - (points['pos'] + points['halfSize'])[:, 1].max(), true=float(np.sqrt(((stress - exact)**2 @ points['volume']) / (exact**2 @ points['volume']))))

found, said = {}, io.StringIO()
with contextlib.redirect_stdout(said): judged = mpm.discretisationError(run, 50 / 16)
found['settlement'], found['last'] = judged['settlement'], O.engines[0].grid.cellSize
found['displacement'] = mpm.discretisationError(lambda h: run(h) and None, 50 / 16)
found['value'] = mpm.discretisationError(lambda h: run(h)['settlement'], 50 / 16)['value']
found['stress'] = []
for cells in 8, 16, 32:
	O.reset()
	true = run(50 / cells)['true']
	before = mpm.arrays()
	with contextlib.redirect_stdout(said): stress = mpm.stressError()
	assert all((before[name] == value).all() for name, value in mpm.arrays().items())
	assert stress['points'].shape == before['volume'].shape and stress['points'].max() == stress['points'][np.argmin(np.linalg.norm(before['pos'] - stress['place'], axis=1))]
	found['stress'].append([true, stress['error']])
found['said'] = said.getvalue()

# layers of which one carries a stress of its own: what jumps between materials is no error
O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='other'))
for body in O.bodies:
	if body.state.pos[1] > 10: body.material = O.materials['other']
pos = mpm.arrays()['pos']
mpm.assign(stress=np.where(pos[:, 1] > 10, 1e3, 3e3)[:, None, None] * np.eye(3))
found['layers'] = mpm.stressError()['error']
for body in O.bodies: body.material = O.materials['other']
found['one layer'] = mpm.stressError()['error']
print(json.dumps(found))
''').result


def test_settlement_of_a_column(column):
	exact = 25.9403541
	judged = column['settlement']
	assert judged['cellSizes'] == [6.25, 3.125, 1.5625] and judged['value'] == judged['values'][1]
	assert abs(judged['values'][2] - exact) < abs(judged['value'] - exact) and 0.5 < judged['error'] / abs(judged['value'] - exact) < 2
	assert judged['oneWay'] and judged['settled'] and column['last'] == 1.5625
	assert column['value'] == judged
	top = column['displacement']['displacement']
	assert 0.5 < top['error'] / judged['error'] < 2 and 25 < top['value'] < 26
	assert f"settlement = {judged['value']:.6g}, wrong by about" in column['said'] and 'cells of 3.125 m' in column['said']


def test_stress_of_a_column(column):
	for true, estimate in column['stress']:
		assert 0.5 < estimate / true < 2
	assert 'stress: wrong by about 1.7 %' in column['said']
	assert column['layers'] < 1e-9 and 0.05 < column['one layer'] < 0.5


# Notes what is said of arguments that are refused.
noting = '''
import json
from scenes import *
said = {}

def refused(name, f, *arguments):
	try: f(*arguments)
	except Exception as error: said[name] = type(error).__name__ + ' ' + str(error)
	else: said[name] = ''
'''


def test_refused(yade):
	refused = yade(noting + '''
def scene(cellSize, size=1):
	column(round(50 / cellSize))
	O.engines[0].verbosity = 0
	O.step()

for name, arguments in dict(function=(1, 1), text=(scene, '1'), zero=(scene, 0), infinite=(scene, inf), empty=(lambda h: {}, 1), kind=(lambda h: 'x', 1), nan=(lambda h: nan, 1),
		names=(lambda h: {str(h): 1.}, 1), grid=(lambda h: scene(2.5), 5), points=(lambda h: None, 1), fails=(lambda h: 1 / 0, 1)).items():
	refused(name, mpm.discretisationError, *arguments)
O.reset()
refused('no engine', mpm.stressError)
column(8)
refused('no stress', mpm.stressError)
O.bodies.clear()
refused('no points', mpm.stressError)
refused('engine', mpm.stressError, 1)
print(json.dumps(said))
''').result
	expected = {
	        'function': 'TypeError discretisationError: run = 1 must be a function',
	        'text': "TypeError discretisationError: cellSize = '1' must be a number",
	        'zero': 'ValueError discretisationError: cellSize = 0 is not admitted',
	        'infinite': 'ValueError discretisationError: cellSize = inf is not admitted',
	        'empty': 'ValueError discretisationError: run(2) returns an empty dict',
	        'kind': "TypeError discretisationError: run(2) returns value = 'x': expected a number",
	        'nan': 'ValueError discretisationError: run(2) returns value = nan: expected a finite number',
	        'names': "ValueError discretisationError: run(1) returns ['1.0'], and run(2) ['2.0']",
	        'grid': 'ValueError discretisationError: run(10) makes a grid with cellSize = 2.5 m',
	        'points': 'ValueError discretisationError: run(2) returns None, and has left no material points',
	        'fails': 'RuntimeError discretisationError: the run with cells of 2 m fails: ZeroDivisionError: division by zero',
	        'no engine': 'ValueError stressError: O.engines holds no MpmImplicitEngine',
	        'no stress': 'ValueError stressError: no point has any stress',
	        'no points': 'ValueError stressError: the scene has no material points',
	        'engine': 'TypeError stressError: solver = 1 must be an MpmImplicitEngine'
	}
	assert set(refused) == set(expected)
	for name, sentence in expected.items():
		assert refused[name].startswith(sentence), refused[name]


def test_until_accurate(yade):
	"""Numbers that are known, and the column of section 4.1; it says what more would take, and refuses what it cannot judge."""
	result = yade(noting + '''
first = mpm.untilAccurate(lambda k: 10 + 4 * 0.5**k, 0.05)
late = mpm.untilAccurate(lambda k: 10 + 4 * 0.5**k, 1e-9, mostSeconds=1e-9)
never = mpm.untilAccurate(lambda k: dict(load=10 + k, other=1), 0.5, 'load', mostSeconds=1e-9)
zero = mpm.untilAccurate(lambda k: [3., 1., 0.][k], 0.5, mostSeconds=1e-9)
assert not zero['isReached'] and zero['needed'] == inf

def run(halvings):
	column(4 * 2**halvings)
	O.engines[0].verbosity = 0
	O.run(40, wait=True)
	return 50 - (mpm.arrays()['pos'] + mpm.arrays()['halfSize'])[:, 1].max()

settlement = mpm.untilAccurate(run, 0.005)
for name, arguments in dict(function=(1, 0.1), text=(run, '1'), zero=(run, 0), time=(run, 0.1, None, -1), names=(lambda k: dict(a=1, b=2), 0.1), quantity=(lambda k: 1, 0.1, 'load'),
		fails=(lambda k: 1 / 0, 1), same=(lambda k: run(0), 0.1), others=(lambda k: {'abc'[k]: 1.}, 0.1)).items():
	refused(name, mpm.untilAccurate, *arguments)
print(json.dumps([first, late, never | dict(needed=str(never['needed'])), settlement, said]))
''').result
	first, late, never, settlement, said = result
	assert first['isReached'] and first['halvings'] == 3 and first['value'] == 10.5 and first['error'] == pytest.approx(0.5)
	assert not late['isReached'] and late['halvings'] == 2 and late['needed'] > 0 and len(late['seconds']) == 3
	assert not never['isReached'] and never['needed'] == 'inf' and never['load'] == 12
	assert settlement['isReached'] and abs(settlement['value'] - 25.9403541) <= settlement['error'] <= 0.005 * 26
	expected = {
	        'function': 'TypeError untilAccurate: run = 1 must be a function',
	        'text': "TypeError untilAccurate: accuracy = '1' must be a number",
	        'zero': 'ValueError untilAccurate: accuracy = 0 is not admitted',
	        'time': 'ValueError untilAccurate: mostSeconds = -1 is not admitted',
	        'names': "ValueError untilAccurate: quantity = None is not admitted: expected one of ['a', 'b']",
	        'quantity': "ValueError untilAccurate: quantity = 'load' is not admitted: expected one of ['value']",
	        'fails': 'RuntimeError untilAccurate: the run with 0 halvings fails: ZeroDivisionError',
	        'same': 'ValueError untilAccurate: run(1) has ',
	        'others': "ValueError untilAccurate: run(1) returns ['b'], and run(0) ['a']: expected the same names"
	}
	assert set(said) == set(expected)
	for name, sentence in expected.items():
		assert said[name].startswith(sentence), said[name]
