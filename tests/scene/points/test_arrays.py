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

def give(material, bodies=None):
	"""A material that need not be in O.materials."""
	for body in bodies or O.bodies:
		body.mat = material
'''

refused = [
        ('mpm.assign()', 'TypeError', ['no column', 'stress']),
        ('mpm.assign(vel=np.zeros((n, 3)))', 'TypeError', ['vel', 'called velocity']),
        ('mpm.assign(acceleration=np.zeros((n, 3)))', 'TypeError', ['acceleration', 'velocity']),
        ('mpm.assign(volume=np.ones(n))', 'TypeError', ['volume', 'a result', 'defGrad']),
        ('mpm.assign(sress=np.zeros((n, 3, 3)))', 'TypeError', ['sress', 'no such column', 'stress']),
        ('mpm.assign(stress=np.zeros((n, 3)))', 'ValueError', ['stress', '(192, 3)', '(192, 3, 3)']),
        ('mpm.assign(force=np.zeros((n - 1, 3)))', 'ValueError', ['force', '(191, 3)', '192 material points']),
        ('mpm.assign(force="up")', 'TypeError', ['force', 'array of numbers']),
        ('mpm.assign(pos=np.full((n, 3), np.nan))', 'ValueError', ['pos[0]', 'finite']),
        ('mpm.assign(plasticStrain=-np.ones(n))', 'ValueError', ['Body #0', 'plasticStrain = -1', '>= 0']),
        ('mpm.assign(stress=[[[0, 1, 0], [2, 0, 0], [0, 0, 0]]] * n)', 'ValueError', ['Body #0', 'stress', 'symmetric']),
        ('mpm.assign(stress=[np.diag([0, 2e5, 0])] * n)', 'ValueError', ['Body #0', 'yields']),
        ('mpm.assign(stress=[np.diag([1e5, 4e5, 1e5])] * n)', 'ValueError', ['Body #0', 'yields', 'mean tension', 'has a minus']),
        ('mpm.assign(elasticStrain=[np.diag([0, .9, 0])] * n)', 'ValueError', ['Body #0', 'yields', 'mean tension']),
        ('mpm.assign(force=np.full((n, 3), 1j))', 'TypeError', ['force', 'real']),
        ('mpm.assign(force=[("1", "2", "3")] * n)', 'TypeError', ['force', 'array of numbers']),
        ('mpm.assign(force=np.ma.masked_less(np.zeros((n, 3)), 1))', 'TypeError', ['force', 'masked']),
        ('mpm.assign(ids=mpm.arrays()["pos"][:, 1] > 2, force=np.zeros((n, 3)))', 'TypeError', ['ids = array([', "mpm.arrays()['id'][mask]"]),
        ('mpm.assign(ids=[True, False], force=np.zeros((2, 3)))', 'TypeError', ["mpm.arrays()['id'][mask]"]),
        ('mpm.assign(ids=[2**70], force=np.zeros((1, 3)))', 'TypeError', ['sequence of body ids']),
        ('mpm.assign(defGrad=[-np.eye(3)] * n)', 'ValueError', ['Body #0', 'defGrad', 'inside out']),
        ('mpm.assign(stress=[np.eye(3)] * n, elasticStrain=[np.eye(3)] * n)', 'ValueError', ['one of them']),
        ('mpm.assign(ids=[0, 0], force=np.zeros((2, 3)))', 'ValueError', ['#0', 'more than once']),
        ('mpm.assign(ids=[500], force=np.zeros((1, 3)))', 'ValueError', ['500', 'no material point']),
        ('mpm.assign(ids=3, force=np.zeros((1, 3)))', 'TypeError', ['ids = 3', 'sequence']),
        ('mpm.geostatic(K0="half")', 'TypeError', ["K0 = 'half'", 'ratio']),
        ('mpm.geostatic(K0=-1)', 'ValueError', ['K0 = -1', '>= 0']),
        ('mpm.geostatic(K0={"firm": 0.5})', 'ValueError', ["'soft'", 'no entry']),
        ('solver.mask = 2; mpm.geostatic(K0=0.5)', 'ValueError', ['groupMask', 'mask = 2']),
        ('O.bodies.clear(); mpm.geostatic(K0=0.5)', 'ValueError', ['no material points', 'mpm.fill']),
        ('give(MpmElasticMat(young=1e6, poisson=0, density=1)); mpm.geostatic(K0={"firm": 0.5})', 'ValueError', ["''", 'needs a label']),
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
	n, before = len(O.bodies), repr(O.bodies[0].state.dict())  # with NaN, which is no number's equal
	try:
		exec(statement)
		outcomes[statement] = ['no exception', '', True]
	except Exception as error:
		same = 'assign' not in statement or repr(O.bodies[0].state.dict()) == before
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


def test_domainsFollowTheDeformation(yade):
	"""At once, as after a step, in the plane and in space; a step limits them to half a cell, as every step does."""
	yade(scene + '''
F2 = np.eye(3) + np.pad([[-0.3, 0.2], [0.1, -0.1]], (0, 1))
F3 = np.array([[0.8, 0.1, 0.2], [-0.1, 0.7, 0.1], [0, 0.2, 0.6]])
for dim, F in (2, F2), (3, F3):
	ground(dim, width=1)
	before = mpm.arrays()
	mpm.assign(defGrad=[F] * len(before['id']))
	after = mpm.arrays()
	half = after['halfSize'][:, :dim]
	assert np.abs(half.prod(axis=1) / before['halfSize'][:, :dim].prod(axis=1) / np.linalg.det(F) - 1).max() < 1e-12
	O.engines = [MpmImplicitEngine(grid=MpmGrid(cellSize=1, dim=dim), domains='stretch')]
	mpm.assign(defGrad=[F] * len(before['id']))
	after = mpm.arrays()
	squares, axes = np.linalg.eigh(F.T @ F)
	stretch = np.diag(axes * squares**0.5 @ axes.T) # of U; one out of the plane
	assert np.abs(after['halfSize'] / (before['halfSize'] * stretch) - 1).max() < 1e-12 and np.abs(after['halfSize'][:, :dim] - half).max() > 1e-3
	O.engines = []
	assert (after['halfSize0'] == before['halfSize0']).all() and (after['halfSize'][:, 2] == before['halfSize'][:, 2]).all() == (dim == 2)
	mpm.assign(defGrad=[np.eye(3)] * len(before['id']))
	assert (mpm.arrays()['halfSize'] == before['halfSize']).all()

# a state that steps have made, given to new points, one a cell, with domains that have outgrown it: the next step is
# the same
def pulled():
	O.reset()
	O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soil'))
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (2, 2, 1)), grid, 1, 'soil'))
	end = MpmBoundary(min=(2, -inf, -inf), max=(2, inf, inf), fix='x', displacement=(0.4, 0, 0))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), end], newton=MpmNewton(predictor=False), verbosity=0)]
	O.dt = 0.25
	return O.engines[0]
pulled()
O.run(2, wait=True)
half = mpm.arrays()
O.step()
expected = mpm.arrays()
assert half['halfSize'][:, 0].max() == 0.5 and half['defGrad'][:, 0, 0].max() > 1.02
solver = pulled()
solver.loadCurve = [(0, 0.5), (0.5, 1)]
mpm.assign(**{name: half[name] for name in ('pos', 'pos0', 'defGrad', 'elasticStrain')})
assert mpm.arrays()['halfSize'][:, 0].max() > 0.51
assert solver.stiffness()[3] > 0
O.step()
for name, values in mpm.arrays().items():
	assert np.abs(values - expected[name]).max() <= 1e-12 * np.abs(expected[name]).max(), name
for halfSize in (0.6, 0.5, 0.5), (0.51, 0.5, 0.5): # which no deformation has made
	pulled()
	O.bodies[0].shape.halfSize = halfSize
	try: O.step()
	except ValueError as error: assert 'Body #0: MpmPoint.halfSize' in str(error) and 'more than half a cell' in str(error), error
	else: assert False, halfSize
''')


def test_tensionInTheGroundIsTold(yade):
	"""Only where gravity acts: in other scenes it is ordinary."""
	run = yade(scene + '''
import sys
def assign(sign, share=1.):
	n = len(O.bodies)
	mpm.assign(stress=[np.eye(3) * (sign * 1e3 if i < share * n else -sign) for i in range(n)])
ground()
assign(1)
sys.stderr.write('# silent\\n')
assign(-1)
assign(1, 0.6)
mpm.geostatic(K0=0.5)
O.engines[0].gravity = (0, 0, 0)
assign(1)
O.engines = []
assign(1)
''')
	told, silent = run.stderr.split('# silent')
	assert told.count('mean tension') == 1 and 'WARNING' not in silent


def test_materialsThatAreNotInTheList(yade):
	"""Bodies may have materials of their own: each point counts with its own, not with another one of O.materials."""
	run = yade(scene + '''
own = dict(young=1e6, poisson=0.3, yieldStress=1e5)
def rest():
	before = mpm.arrays()['pos']
	O.step()
	return np.abs(mpm.arrays()['pos'] - before).max()

solver = ground() # the last of O.materials is of 1500 kg/m3
give(MpmVonMisesMat(density=1000, **own))
assert (mpm.arrays()['material'] == -1).all()
mpm.geostatic(K0=0.4)
assert abs(mpm.arrays()['stress'][:, 1, 1].min() + 10 * 1000 * 2.875) < 1e-6 and rest() < 1e-9
advice = mpm.advise()
assert advice['points'] == 192

solver = ground() # one layer of its own
heavy = MpmVonMisesMat(density=4000, label='heavy', **own)
give(heavy, [body for body in O.bodies if body.mat.label == 'soft'])
mpm.geostatic(K0=dict(firm=0.4, heavy=0.7))
points = mpm.arrays()
assert sorted(set(points['material'])) == [-1, 0]
ratio = points['stress'][:, 0, 0] / points['stress'][:, 1, 1]
assert np.allclose(ratio, np.where(points['material'] == -1, 0.7, 0.4)) and rest() < 1e-9
advice = mpm.advise()
assert any('plasticity' in sentence and 'heavy' in sentence for sentence in advice['advice']) == any('plasticity' in sentence and 'firm' in sentence for sentence in advice['advice'])
mpm.plot('material', fileName='material.png')
mpm.export('own.csv')
mpm.colour('material')

# the number of a material in the list of another scene says nothing here
O.reset()
ground()
foreign = O.materials[1]
O.switchScene()
solver = ground()
give(foreign)
O.engines += [MpmVtkRecorder(fileName='foreign-')]
assert foreign.id == 1 and (mpm.arrays()['material'] == -1).all()
O.step()

# only the points of the engine: ground beside it, higher and heavier
solver = ground()
n = len(O.bodies)
beside = O.bodies.append(mpm.fill(pack.inAlignedBox((10, 0, -1), (12, 6, 1)), solver.grid, 2, 'soft'))
for id in beside:
	O.bodies[id].groupMask = 2
	O.bodies[id].mat = heavy
solver.mask = 1
mpm.geostatic(K0=0.5)
points = mpm.arrays()
assert not points['stress'][n:].any() and abs(points['stress'][:, 1, 1].min() + 10 * (0.875 * 2000 + 1000 * 1.5 + 1000 * 2)) < 1e-6
advice = mpm.advise()
assert advice['points'] == n and not any('plasticity' in sentence and 'heavy' in sentence for sentence in advice['advice'])
assert rest() < 1e-9
''')
	from vtu import Vtu
	assert set(Vtu(run.folder / 'foreign-points.1.vtu').fields['material']) == {-1}


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
	"""Columns with units, of those components that the plane and space have; arrays as they are."""
	names, same, kinds, left, refused, chosen, inSpace = yade(scene + '''
def refusedBy(function, *arguments, **more):
	try: return repr(function(*arguments, **more))
	except Exception as error: return f'{type(error).__name__}: {error}'
solver = ground()
O.step()
mpm.export('out/points.csv')
mpm.export('out/points.npz')
mpm.export('out/few.csv', ['pos', 'stress_yy', 'id'])
mpm.export('out/few.npz', ['pos'])
points = mpm.arrays()
heads = open('out/points.csv', encoding='utf-8').readline().strip().split(',')
table, archive = dict(zip(heads, np.genfromtxt('out/points.csv', delimiter=',', skip_header=1).T)), np.load('out/points.npz')
same = [(archive[name] == points[name]).all() for name in points] + [(table['stress_xy [Pa]'] == points['stress'][:, 0, 1]).all(), (table['pos_y [m]'] == points['pos'][:, 1]).all(),
        (table['displacement_y [m]'] == (points['pos'] - points['pos0'])[:, 1]).all(), (table['id'] == points['id']).all(), float(archive['time']) == O.time == 1, dict(archive['units'])['stress'] == 'Pa',
        set(np.load('out/few.npz')) == {'pos', 'time', 'iter', 'units'}]
kinds = len(table['id']) == len(points['id'])
refused = [refusedBy(mpm.export, 'x.csv', ['sress']), refusedBy(mpm.export, 'x.npz', ['stress_yy']), refusedBy(mpm.export, 'x.csv', 'pos'), refusedBy(mpm.frame, [])]
left, few = os.listdir('out'), open('out/few.csv').readline().strip()
O.engines = []
mpm.export('space.csv')
print(json.dumps([heads, [bool(s) for s in same], kinds, left, refused, few, open('space.csv', encoding='utf-8').readline().strip().split(',')]))
''').result
	assert {'id', 'pos_x [m]', 'stress_xx [Pa]', 'stress_zz [Pa]', 'plasticStrain [-]', 'meanStress [Pa]', 'sqrt2J2 [Pa]', 'volume [m³]', 'material', 'defGrad_yx [-]'} <= set(names)
	assert not {name for name in names if name.partition(' ')[0] in ('pos_z', 'stress_yx', 'stress_xz', 'force_z', 'defGrad_zx', 'halfSize_z')}
	assert {'pos_z [m]', 'stress_xz [Pa]', 'stress_yz [Pa]', 'defGrad_zx [-]'} <= set(inSpace) and 'stress_zx [Pa]' not in inSpace
	assert all(same) and kinds and sorted(left) == ['few.csv', 'few.npz', 'points.csv', 'points.npz']
	assert chosen == 'pos_x [m],pos_y [m],stress_yy [Pa],id'
	assert "'sress'" in refused[0] and 'did you mean' in refused[0].lower() and "'stress_yy'" in refused[1] and refused[2].startswith('TypeError') and refused[3].startswith(('ImportError: frame: pandas', 'TypeError'))


def test_pandas(yade):
	"""The same columns as in a file, where pandas is installed; units beside them."""
	pytest.importorskip('pandas')
	shape, columns, unit, same = yade(scene + '''
ground()
O.step()
table = mpm.frame()
few = mpm.frame(['stress_yy', 'pos'])
print(json.dumps([table.shape, list(few.columns), table.attrs['units']['stress_yy'], bool((table['stress_yy'] == mpm.arrays()['stress'][:, 1, 1]).all())]))
''').result
	assert shape[1] > 20 and columns == ['stress_yy', 'pos_x', 'pos_y'] and unit == 'Pa' and same


def test_whatAPointHasIsAColumn(yade):
	"""An attribute that somebody adds to points is one of mpm.arrays; the initial volume follows from other columns, and what laws have of their own has columns by its names."""
	attributes, columns = yade(scene + '''
from yade.mpm.points.data import table
own = (set(MpmState().dict()) - set(State().dict())) | (set(MpmPoint().dict()) - set(Sphere().dict()))
print(json.dumps([sorted(own), sorted(table)]))
''').result
	assert len(attributes) > 10 and set(attributes) - set(columns) == {'volume0', 'internals', 'parameters'}
