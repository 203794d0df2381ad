# SPDX-License-Identifier: GPL-2.0-or-later
"""Data from and to NumPy: mpm.assign, mpm.geostatic, mpm.export."""
import json

import pytest
from conftest import Yade

scene = '''
import json, os
from scenes import *

def ground(dim=2, up=1, layers=lambda height: 'soft' if 1 <= height <= 2 else 'firm', width=4):
	"""Level ground, 4 m wide and 3 m deep, of two materials in layers; rollers around it."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=1e5, label='firm'))
	O.materials.append(MpmVonMisesMat(young=1e5, poisson=0.2, density=1500, yieldStress=1e5, label='soft'))
	grid = MpmGrid(cellSize=0.5, dim=dim)
	size = [width, width, 1 if up == 1 else width]
	size[up] = 3
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1 if dim == 2 else 0), size), grid, pointsPerCell=2, material=lambda x: layers(x[up])))
	sides = []
	for a in range(dim):
		low, high = [-inf] * 3, [inf] * 3
		low[a], high[a] = size[a], 0
		sides += [MpmBoundary(max=high, fix='xyz'[a])] + ([MpmBoundary(min=low, fix='xyz'[a])] if a != up else [])
	gravity = [0, 0, 0]
	gravity[up] = -10
	O.engines = [MpmImplicitEngine(grid=grid, gravity=gravity, loadCurve=[(0, 1)], boundaries=sides, verbosity=0)]
	O.dt = 1
	return O.engines[0]
'''

refused = [
        ('mpm.assign()', 'TypeError', ['no column', 'stress']),
        ('mpm.assign(velocity=np.zeros((n, 3)))', 'TypeError', ['velocity', 'quasi-static']),
        ('mpm.assign(volume=np.ones(n))', 'TypeError', ['volume', 'a result', 'defGrad']),
        ('mpm.assign(sress=np.zeros((n, 3, 3)))', 'TypeError', ['sress', 'no such column', 'stress']),
        ('mpm.assign(stress=np.zeros((n, 3)))', 'ValueError', ['stress', '(192, 3)', '(192, 3, 3)']),
        ('mpm.assign(force=np.zeros((n - 1, 3)))', 'ValueError', ['force', '(191, 3)', '192 material points']),
        ('mpm.assign(force="up")', 'TypeError', ['force', 'array of numbers']),
        ('mpm.assign(pos=np.full((n, 3), np.nan))', 'ValueError', ['pos[0]', 'finite']),
        ('mpm.assign(plasticStrain=-np.ones(n))', 'ValueError', ['Body #0', 'plasticStrain = -1', '>= 0']),
        ('mpm.assign(stress=[[[0, 1, 0], [2, 0, 0], [0, 0, 0]]] * n)', 'ValueError', ['Body #0', 'stress', 'symmetric']),
        ('mpm.assign(stress=[np.diag([0, 2e5, 0])] * n)', 'ValueError', ['Body #0', 'yields']),
        ('mpm.assign(defGrad=[-np.eye(3)] * n)', 'ValueError', ['Body #0', 'defGrad', 'inside out']),
        ('mpm.assign(stress=[np.eye(3)] * n, elasticStrain=[np.eye(3)] * n)', 'ValueError', ['one of them']),
        ('mpm.assign(ids=[0, 0], force=np.zeros((2, 3)))', 'ValueError', ['#0', 'more than once']),
        ('mpm.assign(ids=[500], force=np.zeros((1, 3)))', 'ValueError', ['500', 'no material point']),
        ('mpm.assign(ids=3, force=np.zeros((1, 3)))', 'TypeError', ['ids = 3', 'sequence']),
        ('mpm.geostatic(K0="half")', 'TypeError', ["K0 = 'half'", 'ratio']),
        ('mpm.geostatic(K0=-1)', 'ValueError', ['K0 = -1', '>= 0']),
        ('mpm.geostatic(K0={"firm": 0.5})', 'ValueError', ["'soft'", 'no entry']),
        ('mpm.geostatic(K0=50)', 'ValueError', ['K0 = 50', 'yields']),
        ('mpm.geostatic(K0=0.5, surface=2)', 'ValueError', ['surface = 2', '3.0 m']),
        ('mpm.geostatic(K0=0.5, surface="top")', 'TypeError', ["surface = 'top'"]),
        ('solver.loadCurve = [(0, 0), (1, 1)]; mpm.geostatic(K0=0.5)', 'ValueError', ['factor of gravity is not 1', 'loadCurve = ((0', 'gravityCurve = [(0, 1)]']),
        ('solver.gravity = (1, -10, 0); mpm.geostatic(K0=0.5)', 'ValueError', ['gravity', 'along one of the axes']),
        ('ground(layers=lambda y: "firm").grid; O.bodies.erase(0); mpm.geostatic(K0=0.5)', 'ValueError', ['not level']),
        ('O.bodies[7].mat = O.materials["soft"]; mpm.geostatic(K0=0.5)', 'ValueError', ['differ in density', 'horizontal layers']),
        ('O.engines = []; mpm.geostatic(K0=0.5)', 'ValueError', ['no MpmImplicitEngine']),
        ('O.step(); mpm.geostatic(K0=0.5)', 'ValueError', ['deformed']),
        ('mpm.export("points.txt")', 'ValueError', ["'points.txt'", '.csv or .npz']),
        ('mpm.export("/proc/none/points.csv")', 'FileNotFoundError', ['/proc/none']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	yade = Yade(tmp_path_factory.mktemp('arrays'))
	(yade.folder / 'statements.json').write_text(json.dumps([statement for statement, _, _ in refused]))
	return yade(scene + '''
outcomes = {}
for statement in json.load(open('statements.json')):
	solver, before = ground(), None
	n, before = len(O.bodies), O.bodies[0].state.dict()
	try:
		exec(statement)
		outcomes[statement] = ['no exception', '', True]
	except Exception as error:
		same = 'assign' not in statement or O.bodies[0].state.dict() == before
		outcomes[statement] = [type(error).__name__, str(error), same]
print(json.dumps(outcomes))
''').result


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_isRefused(outcomes, statement, exception, words):
	kind, sentence, unchanged = outcomes[statement]
	assert kind == exception, sentence
	assert unchanged
	for word in words:
		assert word in sentence


def test_assign(yade):
	stress, strain, kirchhoff, volume, force, others, pushed = yade(scene + '''
solver = ground()
points = mpm.arrays()
n = len(points['id'])
F = np.eye(3) + np.pad([[0.1, 0.2], [0, 0.1]], (0, 1))
sigma = np.array([[-3e4, 5e3, 0], [5e3, -4e4, 0], [0, 0, -2e4]])
mpm.assign(stress=[sigma] * n, defGrad=[F] * n)
after = mpm.arrays()
J = np.linalg.det(F)
E, nu = np.array([[1e6, 0.3], [1e5, 0.2]])[points['material']].T
hooke = ((1 + nu)[:, None, None] * J * sigma - (nu * J * np.trace(sigma))[:, None, None] * np.eye(3)) / E[:, None, None]
mpm.assign(elasticStrain=after['elasticStrain'] / 2)
half = mpm.arrays()
top = points['id'][points['pos'][:, 1] > 2.8][::-1]
mpm.assign(ids=top, force=[(0, -i, 0) for i in range(len(top))])
given = [O.bodies[int(i)].state.force[1] for i in top]
mpm.assign(pos=points['pos'] + (0, 0.125, 0), pos0=points['pos'] + (0, 0.125, 0), force=np.zeros((n, 3)))
print(json.dumps([np.abs(after['stress'] / 1e4 - sigma / 1e4).max(), np.abs(after['elasticStrain'] - hooke).max(), np.abs(half['stress'] / 1e4 - sigma / 2e4).max(),
                  np.abs(after['volume'] / points['volume'] / J - 1).max(), given, sum(b.state.force.norm() for b in O.bodies), O.bodies[0].state.pos[1]]))
''').result
	assert stress < 1e-12 and strain < 1e-15 and kirchhoff < 1e-12 and volume < 1e-12
	assert force == [-i for i in range(16)] and others == 0 and pushed == 0.25


def test_geostaticStressIsInEquilibrium(yade):
	"""Layers of two densities, in plane strain and in space with z upwards: nothing moves, and the base carries the weight."""
	results = yade(scene + '''
results = []
for dim, up, K0 in (2, 1, 0.5), (2, 1, dict(firm=0.4, soft=1)), (3, 2, 0.5):
	solver = ground(dim, up, width=2 if dim == 3 else 4)
	mpm.geostatic(K0=K0)
	stress = mpm.arrays()['stress'][:, up, up]
	O.step()
	points = mpm.arrays()
	base = solver.reactions[-1 if up == dim - 1 else 2][up]
	ratio = [points['stress'][points['material'] == m][:, 0, 0] / points['stress'][points['material'] == m][:, up, up] for m in (0, 1)]
	results.append([solver.residuals[0], np.abs(points['pos'] - points['pos0']).max(), base / (10 * sum(b.state.mass for b in O.bodies)), stress.min(), stress.max(), [[r.min(), r.max()] for r in ratio]])
solver = ground()
mpm.geostatic(K0=0.5, surface=4)
results.append(mpm.arrays()['stress'][:, 1, 1].max())
print(json.dumps(results))
''').result
	for (residual, moved, share, lowest, highest, ratios), expected in zip(results, [(0.5, 0.5), (0.4, 1), (0.5, 0.5)]):
		assert residual <= 1e-3  # before anything is solved
		assert moved < 1e-9
		assert abs(share - 1) < 1e-9
		assert abs(lowest + 10 * (0.875 * 2000 + 1000 * 1.5 + 1000 * 2)) < 1e-6 and abs(highest + 10 * 2000 * 0.125) < 1e-6
		for (low, high), K0 in zip(ratios, expected):
			assert abs(low - K0) < 1e-9 and abs(high - K0) < 1e-9
	assert abs(results[-1] + 10 * 2000 * 1.125) < 1e-6  # a metre of soil that is not modelled


def test_export(yade):
	names, same, kinds, left = yade(scene + '''
solver = ground()
O.step()
mpm.export('out/points.csv')
mpm.export('out/points.npz')
points = mpm.arrays()
table, archive = np.genfromtxt('out/points.csv', delimiter=',', names=True), np.load('out/points.npz')
same = [(archive[name] == points[name]).all() for name in points] + [(table['stress_xy'] == points['stress'][:, 0, 1]).all(), (table['pos_y'] == points['pos'][:, 1]).all(),
        (table['displacement_y'] == (points['pos'] - points['pos0'])[:, 1]).all(), (table['id'] == points['id']).all(), float(archive['time']) == O.time == 1]
print(json.dumps([table.dtype.names, [bool(s) for s in same], len(table) == len(points['id']), os.listdir('out')]))
''').result
	assert {'id', 'pos_x', 'stress_xx', 'stress_zz', 'plasticStrain', 'meanStress', 'sqrt2J2', 'volume', 'material'} <= set(names)
	assert all(same) and kinds and sorted(left) == ['points.csv', 'points.npz']
