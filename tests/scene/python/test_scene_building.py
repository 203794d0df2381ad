# SPDX-License-Identifier: GPL-2.0-or-later
"""Filling regions with material points, reading them as arrays, saving and copying them."""
import sys

import numpy as np
import pytest
from conftest import root

# the slope of Coombs 2023, section 4.2
setting = '''
import json
import numpy as np
from yade import mpm, pack
outline = [(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)]
slope = mpm.polygon(outline)
soil = MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil')
weak = MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=7.5e3, label='weak')
O.materials.append([soil, weak])

def positions(bodies):
	return np.array([b.state.pos for b in bodies])

def report(**values):
	print(json.dumps(values, default=lambda value: np.asarray(value).tolist()))
'''


def test_number_of_points_in_the_slope(yade):
	"""Those of the paper, with points on the slope line inside."""
	result = yade(
	        setting + '''
report(counts=[[len(mpm.fill(slope, MpmGrid(cellSize=h), n, 'soil')) for n in (2, 3, 4)] for h in (1, 0.5, 0.25)])
'''
	).result
	assert result['counts'] == [[1095, 2460, 4370], [4370, 9825, 17460], [17460, 39270, 69800]]


def test_a_fill_that_misses_the_volume_of_its_region_is_told(yade):
	"""A layer thinner than the points' boxes, oblique; the paper's slope, aligned boxes and fine round bodies are silent."""
	run = yade(
	        setting + '''
import sys
import gts
def say(name):
	sys.stdout.flush()
	sys.stderr.write(f'\\n# {name}\\n')
	sys.stderr.flush()
layer = [(0, 0), (6, 1), (6, 1.3), (0, 0.3)] # 0.3 m thick, 1.8 m2
round_ = gts.sphere(3)
round_.scale(1.2, 1.2, 1.2)
warned = dict(
    thin=(mpm.polygon(layer), 1, 2, (1, 2, 3, 4)),
    sampled=(mpm.polygon(layer) & pack.inAlignedBox((-1, -1, -1), (9, 9, 1)), 1, 2, (1, 2, 3)),
    solid=(mpm.polygon(layer) & pack.inAlignedBox((-1, -1, 0), (9, 9, 1)), 1, 3, (1, 2)),
    plate=(pack.inAlignedBox((0, 0.25, -1), (4, 0.35, 1)), 1, 2, (2,)),
    flat=(pack.inAlignedBox((0, 0.25, -1), (4, 0.25, 1)), 1, 2, (2,)),
    coarse=(pack.inSphere((0, 0, 0), 2), 1, 2, (1,)),
    surface=(pack.inGtsSurface(round_), 1, 3, (1,)))
silent = dict(
    slope=(slope, 1, 2, (1, 2, 3, 4)),
    half=(slope, 0.5, 2, (2, 3, 4)),
    solidSlope=(slope & pack.inAlignedBox((0, 0, 0), (30, 12, 2)), 1, 3, (2,)),
    box=(pack.inAlignedBox((0, 0, -1), (0.7, 0.7, 1)), 0.7 / 3, 2, (1, 2, 3)),
    beams=(pack.inAlignedBox((0, 0, -1), (9, 0.3, 1)) | pack.inAlignedBox((0, 5.1, -1), (9, 5.4, 1)), 0.3, 2, (1, 2)),
    disc=(pack.inSphere((0, 0, 0), 5), 1, 2, (2, 3, 4)),
    pipe=(pack.inCylinder((0, 0, 0), (0, 0, 4), 4) - pack.inCylinder((0, 0, 0), (0, 0, 4), 2), 1, 3, (3,)))
for name, (region, cellSize, dim, numbers) in (warned | silent).items():
	for n in numbers:
		say(f'{name} {n}')
		mpm.fill(region, MpmGrid(cellSize=cellSize, dim=dim), n, 'soil')
report(warned=[f'{name} {n}' for name, (*_, numbers) in warned.items() for n in numbers])
'''
	)
	said = dict(part.split('\n', 1) for part in run.stderr.split('\n# ')[1:])
	assert len(said) > 20
	told = {name: text for name, text in said.items() if 'WARNING' in text}
	assert sorted(told) == sorted(run.result['warned'])
	for name, ratio in ('thin 1', '0.9'), ('thin 2', '0.9'), ('thin 3', '1.08'), ('plate 2', '0.2'), ('flat 2', '0'):
		assert f'fill: the region has {ratio} times the volume' in told[name], told[name]
		assert 'More points per cell help, smaller cells' in told[name]


def test_points_are_equally_spaced_in_their_cells(yade):
	"""Against the definition, for a rectangle in an oblique place of the plane and for a box."""
	result = yade(
	        setting + '''
grid = MpmGrid(cellSize=0.5, origin=(-0.2, 0.1, 7), dim=2)
flat = mpm.fill(mpm.polygon([(-1.2, 0.6), (0.3, 0.6), (0.3, 1.1), (-1.2, 1.1)]), grid, 3, 'soil')
grid = MpmGrid(cellSize=0.5, origin=(-0.2, 0.1, 7), dim=3)
solid = mpm.fill(pack.inAlignedBox((-0.7, 0.1, 7.5), (0.3, 1.1, 8.5)), grid, 2, 'soil')
for bodies in flat, solid:
	state, shape = bodies[0].state, bodies[0].shape
	assert all(b.shape.halfSize == b.shape.halfSize0 == shape.halfSize and b.state.volume == b.state.volume0 == state.volume for b in bodies)
report(flat=positions(flat), solid=positions(solid), flatHalf=flat[0].shape.halfSize, solidHalf=solid[0].shape.halfSize,
       flatVolume=flat[0].state.volume0, solidVolume=solid[0].state.volume0)
'''
	).result
	inCell = (np.arange(3) + 0.5) / 3 * 0.5
	x, y = np.add.outer(-1.2 + 0.5 * np.arange(3), inCell).ravel(), 0.6 + inCell
	assert_same_points(result['flat'], [(a, b, 7) for a in x for b in y])
	assert result['flatHalf'] == pytest.approx([1 / 12, 1 / 12, 0.5])  # one metre thick
	assert result['flatVolume'] == pytest.approx((0.5 / 3)**2)

	inCell = np.array([0.125, 0.375])
	x, y, z = (np.add.outer(start + np.array([0, 0.5]), inCell).ravel() for start in (-0.7, 0.1, 7.5))
	assert_same_points(result['solid'], [(a, b, c) for a in x for b in y for c in z])
	assert result['solidHalf'] == pytest.approx([1 / 8] * 3)
	assert result['solidVolume'] == pytest.approx(0.25**3)


def assert_same_points(actual, expected):
	"""Compares sets of points, to round-off."""
	assert len(actual) == len(expected)
	distances = np.linalg.norm(np.array(actual)[:, None] - np.array(expected), axis=2)
	assert distances.min(axis=0).max() < 1e-14
	assert distances.min(axis=1).max() < 1e-14


def test_symmetric_regions_are_filled_symmetrically_to_the_last_bit(yade):
	result = yade(
	        setting + '''
lens = mpm.polygon([(-7, -0.1), (0, -3), (7, -0.1), (7, 0.1), (0, 3), (-7, 0.1)])
report(points=positions(mpm.fill(lens, MpmGrid(cellSize=0.3), 3, 'soil'))[:, :2])
'''
	).result
	points = {tuple(p) for p in result['points']}
	assert len(points) == len(result['points']) > 2000
	assert points == {(-x, y) for x, y in points} == {(x, -y) for x, y in points}


def test_polygon_contains_what_an_independent_test_says(yade):
	"""matplotlib decides on random points; on edges and corners the answer is known."""
	result = yade(
	        setting + '''
from matplotlib.path import Path
star = [(np.cos(a) * r, np.sin(a) * r) for a, r in zip(np.arange(0, 14) * np.pi / 7, [2, 5] * 7)]
points = np.random.default_rng(1).uniform(-6, 6, (20000, 2))
report(
    agree=[bool((mpm.polygon(v).contains(points) == Path(v + v[:1]).contains_points(points)).all()) for v in (star, star[::-1])],
    inside=int(mpm.polygon(star).contains(points).sum()),
    onEdges=[slope((x, y, 5)) for x, y in [(0, 0), (15, 7), (10, 12), (12, 10), (30, 3), (4, 12), (0, 11)]],
    beyond=[slope((x, y, 5)) for x, y in [(12 + 1e-7, 10), (15, 7 + 1e-7), (-1e-7, 3), (30 + 1e-7, 3)]],
    rounded=[slope((x, y, 5)) for x, y in [(12 + 1e-9, 10), (-1e-9, 3)]],
    padded=[slope((5, 0.5, 0), pad) for pad in (0.49, 0.51)] + [slope((5, -0.5, 0), pad) for pad in (0, -0.49, -0.51)],
    box=slope.aabb())
'''
	).result
	assert result['agree'] == [True, True]
	assert result['inside'] / 20000 == pytest.approx(14 * 2 * 5 * np.sin(np.pi / 7) / 2 / 12**2, rel=0.05)  # the areas
	assert all(result['onEdges']) and all(result['rounded']) and not any(result['beyond'])
	assert result['padded'] == [True, False, False, False, True]
	assert result['box'] == [[0, 0, -float('inf')], [30, 12, float('inf')]]


def test_predicates_of_yade_pack_and_their_combinations(yade):
	"""Filling agrees with YADE's own answer, point by point."""
	result = yade(
	        setting + '''
ball, box = pack.inSphere((10, 8, 0), 3), pack.inAlignedBox((5, 1, -1), (28, 9, 1))
square = mpm.polygon([(20, 0), (35, 0), (35, 10), (20, 10)])
combinations = dict(ball=ball, union=slope | square, intersection=slope & box, difference=slope - ball, outside=slope ^ square, nested=(slope - box) | (ball & box))
lattice = MpmGrid(cellSize=1)
everywhere = positions(mpm.fill(mpm.polygon([(-5, -5), (40, -5), (40, 20), (-5, 20)]), lattice, 2, 'soil'))
solid = mpm.fill(slope & pack.inAlignedBox((0, 0, 0), (30, 12, 2)), MpmGrid(cellSize=1, dim=3), 2, 'soil')
report(
    filled={name: sorted(map(tuple, positions(mpm.fill(p, lattice, 2, 'soil')))) for name, p in combinations.items()},
    expected={name: sorted(tuple(x) for x in everywhere if p(Vector3(*x), 0)) for name, p in combinations.items()},
    solid=positions(solid))
'''
	).result
	assert result['filled'] == result['expected']
	sizes = {name: len(points) for name, points in result['filled'].items()}
	assert sizes['union'] > sizes['intersection'] > 0 and len(set(sizes.values())) == len(sizes)
	depth, numbers = np.unique(np.array(result['solid'])[:, 2], return_counts=True)
	assert depth.tolist() == [0.25, 0.75, 1.25, 1.75] and numbers.tolist() == [1095] * 4


def test_material_by_name_list_or_function(yade):
	"""The weak layer of the paper, 7 <= y <= 7.5, in all ways to say it; mass follows the density."""
	result = yade(
	        setting + '''
grid = MpmGrid(cellSize=1)
ways = dict(
    name='soil',
    function=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil',
    first=[(mpm.polygon([(0, 7), (30, 7), (30, 7.5), (0, 7.5)]), 'weak'), (slope, 'soil')],
    everything=[(slope, 'soil'), (mpm.polygon([(0, 7), (30, 7), (30, 7.5), (0, 7.5)]), 'weak')],
    space=[(pack.inAlignedBox((0, 7, 0), (30, 7.5, 0)), 'weak'), (pack.inSpace(), 'soil')])
filled = {way: mpm.fill(slope, grid, 2, material) for way, material in ways.items()}
report(
    weak={way: sum(b.mat.label == 'weak' for b in bodies) for way, bodies in filled.items()},
    misplaced=sum((b.mat.label == 'weak') != (7 <= b.state.pos[1] <= 7.5) for way in ('function', 'first', 'space') for b in filled[way]),
    masses=sorted({(b.mat.label, b.state.mass) for b in filled['function']}),
    shared=all(b.mat is soil or b.mat is weak for b in filled['function']))
'''
	).result
	layer = 30  # one row at y = 7.25, every half metre from the wall to the slope line at x = 14.75
	assert result['weak'] == dict(name=0, function=layer, first=layer, everything=0, space=layer)
	assert result['misplaced'] == 0 and result['shared']
	assert result['masses'] == [['soil', 600.], ['weak', 500.]]  # a quarter of a cubic metre each


def test_points_stay_out_of_the_way_of_yade(yade):
	"""Collider and integrator pass them by, and so nothing moves them; a grain beside them falls."""
	result = yade(
	        setting + '''
O.materials.append(FrictMat(label='grain'))
grain = O.bodies.append(sphere((5, 5, 0), 0.5, material='grain'))
points = O.bodies.append(mpm.fill(slope, MpmGrid(cellSize=1), 2, 'soil'))
before = mpm.arrays()
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
             [Law2_ScGeom_FrictPhys_CundallStrack()]), NewtonIntegrator(gravity=(0, -10, 0))]
O.dt = 1e-3
O.run(10, wait=True)
after = mpm.arrays()
report(unmoved=all((before[key] == after[key]).all() for key in before), contacts=len(O.interactions), fell=O.bodies[grain].state.displ()[1],
       ids=after['id'], points=points, kinds=sorted({type(b.shape).__name__ + type(b.state).__name__ for b in O.bodies}))
'''
	).result
	assert result['unmoved'] and result['contacts'] == 0 and result['fell'] < 0
	assert result['ids'] == result['points'] and len(result['points']) == 1095
	assert result['kinds'] == ['MpmPointMpmState', 'SphereState']


def test_arrays_are_the_data_of_the_bodies(yade):
	result = yade(
	        setting + '''
empty = mpm.arrays()
O.bodies.append(mpm.fill(slope, MpmGrid(cellSize=2), 2, lambda x: 'weak' if x[0] > 15 else 'soil'))
O.bodies.erase(3)
random = np.random.default_rng(2)
for b in O.bodies:
	skew = [Matrix3(*random.uniform(-1, 1, 9)) for i in range(3)]
	b.state.elasticStrain = skew[1] + skew[1].transpose()
	b.state.defGrad = Matrix3.Identity + 0.1 * skew[2]
	b.state.pos, b.state.refPos, b.shape.halfSize, b.shape.halfSize0, b.state.force, b.state.vel = (Vector3(*random.uniform(0.1, 1, 3)) for i in range(6))
	b.state.volume, b.state.plasticStrain = random.uniform(0.1, 1, 2)
a = mpm.arrays()
rows = dict(id=lambda b: b.id, pos=lambda b: b.state.pos, pos0=lambda b: b.state.refPos, halfSize=lambda b: b.shape.halfSize,
            halfSize0=lambda b: b.shape.halfSize0, force=lambda b: b.state.force, velocity=lambda b: b.state.vel, acceleration=lambda b: b.state.acceleration,
            stress=lambda b: [b.state.stress.row(i) for i in range(3)], defGrad=lambda b: [b.state.defGrad.row(i) for i in range(3)],
            elasticStrain=lambda b: [b.state.elasticStrain.row(i) for i in range(3)], volume=lambda b: b.state.volume,
            plasticStrain=lambda b: b.state.plasticStrain, material=lambda b: b.mat.id)
unequal = [key for key, row in rows.items() if not np.array_equal(a[key], np.array([row(b) for b in O.bodies]))]
a['pos'][:] = 99
report(keys=list(a), unequal=unequal, shapes={key: value.shape for key, value in a.items()}, empty={key: value.shape for key, value in empty.items()},
       kinds={key: str(value.dtype) for key, value in a.items()}, ids=a['id'][:4], materials=sorted(set(a['material'].tolist())),
       copied=all(b.state.pos[0] < 2 for b in O.bodies))
'''
	).result
	rows = dict(id=(), pos=(3, ), pos0=(3, ), halfSize=(3, ), halfSize0=(3, ), force=(3, ), velocity=(3, ), acceleration=(3, ), stress=(3, 3), defGrad=(3, 3), elasticStrain=(3, 3),
	            volume=(), plasticStrain=(), material=())
	n = result['shapes']['id'][0]
	assert result['unequal'] == [] and result['copied']
	assert n > 200 and result['ids'] == [0, 1, 2, 4] and result['materials'] == [0, 1]
	assert result['shapes'] == {key: [n, *row] for key, row in rows.items()}
	assert result['empty'] == {key: [0, *row] for key, row in rows.items()}
	assert result['kinds'] == {key: 'int64' if key in ('id', 'material') else 'float64' for key in rows}


# every attribute different from its default
objects = '''
from yade.wrapper import *
originals = dict(
    elastic=MpmElasticMat(young=2.5, poisson=-0.25, density=7, label='elastic'),
    mises=MpmVonMisesMat(young=3.5, poisson=0.25, density=9, yieldStress=1 / 3, label='mises'),
    state=MpmState(defGrad=Matrix3(2,.1,.2, .3,3,.4, .5,.6,4), elasticStrain=Matrix3(-1,2,3, 2,-4,5, 3,5,-6) / 7,
                   force=(1, 2, 3), volume=1 / 7, volume0=1 / 9, plasticStrain=1 / 11, refPos=(4, 5, 6), vel=(7, 8, 9), mass=10),
    point=MpmPoint(halfSize=(1 / 3, 2, 3), halfSize0=(4, 5, 6), radius=7),
    grid=MpmGrid(cellSize=1 / 3, origin=(1, 2, 3), dim=3),
    boundary=MpmBoundary(min=(-inf, 1 / 3, -inf), max=(4, inf, 5), fix='zx', displacement=(1, 0, 2)),
    ghost=MpmGhost(factor=1 / 3, scaling='paper'),
    newton=MpmNewton(tolerance=1e-9, maxIterations=7, minStep=1 / 3, lineSearchTrials=2, acceptUnconverged=True))

def values(thing):
	"""Attributes as text; shortest representations of numbers are exact."""
	plain = lambda v: [plain(x) for x in v] if hasattr(v, '__len__') and not isinstance(v, str) else repr(v)
	return {name: plain(value) for name, value in thing.dict().items()}
'''


def test_copies_and_pickles_are_equal(yade):
	result = yade(
	        setting + objects + '''
import copy, pickle
report(
    originals={name: values(thing) for name, thing in originals.items()},
    copies={name: values(copy.deepcopy(thing)) for name, thing in originals.items()},
    pickled={name: values(pickle.loads(pickle.dumps(thing))) for name, thing in originals.items()},
    default={name: values(type(thing)()) for name, thing in originals.items()})
'''
	).result
	assert result['copies'] == result['pickled'] == result['originals']
	own = [
	        'young', 'poisson', 'density', 'yieldStress', 'defGrad', 'elasticStrain', 'force', 'volume', 'volume0', 'plasticStrain', 'halfSize',
	        'halfSize0', 'cellSize', 'origin', 'dim', 'min', 'max', 'fix', 'displacement', 'factor', 'scaling', 'tolerance', 'maxIterations', 'minStep',
	        'lineSearchTrials', 'acceptUnconverged'
	]
	for name, attributes in result['originals'].items():
		for attribute in set(attributes) & set(own):
			assert attributes[attribute] != result['default'][name][attribute], f'{name}.{attribute} of the test is its default'


@pytest.mark.parametrize('file', ['scene.xml.gz', 'scene.yade.gz'])
def test_everything_survives_saving(yade, file):
	"""Loaded in another process. Objects that engines own are kept with the scene's miscellaneous parameters here."""
	keep = '''
def scene():
	body = O.bodies[0]
	things = [O.materials[2], O.materials[3], body.state, body.shape, body.mat] + list(O.miscParams)
	return [values(thing) for thing in things] + [body.bounded, body.state.blockedDOFs, type(body.state).__name__, type(body.mat).__name__]
'''
	saved = yade(
	        setting + objects + keep + f'''
O.materials.append([originals['elastic'], originals['mises']])
body = mpm.fill(slope, MpmGrid(cellSize=1), 2, 'mises')[0]
body.state, body.shape = originals['state'], originals['point']
body.dynamic = False
O.bodies.append(body)
O.miscParams = [originals[name] for name in ('grid', 'boundary', 'ghost', 'newton')]
O.save('{file}')
report(scene=scene())
'''
	).result
	loaded = yade(setting + objects + keep + f'''
O.load('{file}')
report(scene=scene(), arrays=mpm.arrays()['volume'])
''').result
	assert loaded['scene'] == saved['scene'] and len(saved['scene']) == 13
	assert loaded['arrays'] == [1 / 7]


def test_materials_bring_their_state(yade):
	result = yade(
	        setting + '''
elastic = MpmElasticMat(young=1, poisson=0)
body = mpm.fill(slope, MpmGrid(cellSize=1), 1, 'soil')[0]
O.bodies.append(body)
body.state = State()
O.engines = []
try:
	O.step()  # YADE asks the material once, before the first step
	mismatch = ''
except RuntimeError as error:
	mismatch = str(error)
report(state=type(elastic.newAssocState()).__name__, mismatch=mismatch,
       bases=[isinstance(soil, MpmElasticMat), isinstance(elastic, MpmMaterial), isinstance(elastic, MpmVonMisesMat)],
       names=[m.dispHierarchy() for m in (soil, elastic)], shape=MpmPoint().dispHierarchy())
'''
	).result
	assert result['state'] == 'MpmState' and result['bases'] == [True, True, False]
	assert 'Body #0' in result['mismatch'] and 'MpmState' in result['mismatch']
	assert result['names'] == [['MpmVonMisesMat', 'MpmElasticMat', 'MpmMaterial', 'Material'], ['MpmElasticMat', 'MpmMaterial', 'Material']]
	assert result['shape'] == ['MpmPoint', 'Sphere', 'Shape']


def test_example_of_the_module_runs(yade):
	"""The script in the documentation of module mpm, for one of its 80 steps."""
	result = yade(
	        '''
import json, textwrap
from yade import mpm
lines = mpm.__doc__.splitlines()
script = textwrap.dedent('\\n'.join(line for line in lines if line.startswith('    ') or not line))
assert 'O.run(80, wait=True)' in script
exec(script.replace('O.run(80,', 'O.run(1,'))
print(json.dumps([O.iter, O.engines[0].converged, len(O.bodies)]))
'''
	).result
	assert result == [1, True, 9825]


def test_scripts_are_found_by_words(yade):
	"""The list in the package is that of the scripts that there are; it is there without them."""
	sys.path.insert(0, str(root / 'scripts' / 'lib'))
	import examplelist
	assert (root / 'plugin/python/mpm/scripts.py').read_text() == examplelist.listed(), 'write it by /usr/bin/python3 scripts/lib/examplelist.py'
	run = yade('''
import json
from yade import mpm
found = {words: mpm.examples(words) for words in ('footing', 'MpmTraction', 'slope water', 'CPT', 'dams', 'fooling', 'pipe', 'ESRI', 'liquefaction', 'groundwater', 'spectrum', 'uplift', 'umat', '')}
try: mpm.examples(3)
except TypeError as error: found['error'] = str(error)
print(json.dumps(found))
''')
	found = run.result
	assert found['footing'][:3] == ['examples/tasks/deep_footing.py', 'examples/tasks/round_footing.py', 'examples/tasks/square_footing.py'] and 'examples/footing3d/footing3d.py' in found['footing']
	assert 'examples/tasks/tunnel.py' in found['MpmTraction'] and 'examples/water/water.py' in found['slope water'] and 'examples/tasks/earthquake.py' not in found['slope water']
	assert 'examples/penetration/deep.py' in found['CPT'] and 'examples/tasks/drawdown.py' in found['dams']
	assert 'examples/earthquake/liquefaction.py' in found['liquefaction'] and 'examples/laboratory/hypoplasticity.py' in found['umat'] and 'examples/water/dam.py' in found['groundwater']
	assert all(found[words] for words in ('pipe', 'ESRI', 'spectrum', 'uplift'))
	assert not found['fooling'] and "No script is about 'fooling'" in run.stdout and 'footing' in run.stdout.partition('fooling')[2].splitlines()[0]
	assert len(found['']) > 40 and all((root / path).exists() for path in found['']) and "words = 3 must be a text" in found['error']
	assert 'scripts/run examples/tasks/tunnel.py' in run.stdout
