# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells that are halved by themselves (MpmGrid.adaptation), and points that go with them."""
import numpy as np
import pytest
from conftest import outcomesOf

scene = '''
import json
import numpy as np
from yade import mpm, pack, utils

def footing(cells=4, halvings=2, dim=2, **rule):
	"""Half of a smooth Box of 1 m width on clay, cells over half its width."""
	O.reset()
	h, cu = 0.5 / cells, 1e4
	grid = MpmGrid(cellSize=h, dim=dim)
	if halvings: grid.adaptation = [MpmAdaptation(halvings=halvings, **rule)]
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=.49, density=1800, yieldStress=np.sqrt(2) * cu, label='clay'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -2.5, 0 if dim == 3 else -1), (3, 0, .25 if dim == 3 else 1)), grid, 2, 'clay'))
	box = O.bodies[O.bodies.append(utils.box((0, 2, 0), (.5, 2, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -.03, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(3, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -2.5, inf), fix='xy')]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, .25), fix='z')]
	O.engines = [MpmImplicitEngine(grid=grid, fBar=True, boundaries=sides, contacts=[MpmContact(friction=0)], newton=MpmNewton(minStep=1 / 64), label='solver', verbosity=0)]
	O.dt = 1 / 6
	return grid, box

def N(): return 2 * solver.contacts[0].forces[0][1] / 1e4
'''


def test_a_footing_is_as_right_as_with_small_cells_everywhere(yade):
	"""Load at a settlement of 0.02 B over the closed form 2 + pi: what four cells miss comes from the cell at the edge."""
	results = yade(scene + '''
found = []
for cells, halvings in (4, 0), (4, 2), (8, 0):
	footing(cells, halvings)
	O.run(4, wait=True)
	found.append([N() / (2 + np.pi) - 1, solver.dofs, len(solver.report()['cells'])])
print(json.dumps(found))
''').result
	(coarse, fewer, one), (adapted, dofs, sizes), (fine, more, _) = results
	assert (one, sizes) == (1, 3)
	assert abs(adapted) < 0.06 < fine + 0.005 and coarse > 0.09
	assert dofs < 1.1 * fewer < 0.4 * more


def test_cells_follow_the_body_and_are_joined_behind_it(yade):
	"""The corner of the Box is always in cells halved twice, and cells that it has left are large again; mass stays."""
	results = yade(scene + '''
grid, box = footing()
found = []
for velocity in (0, -.06, 0), (0, -.06, 0), (0, 1.5, 0), (0, 0, 0):
	box.state.vel = velocity
	O.run(6, wait=True)
	smallest = min(solver.report()['cells'])
	x, half = mpm.arrays()['pos'], mpm.arrays()['halfSize']
	found.append([smallest, len(grid.adapted), mpm.arrays()['volume'].sum() if velocity[1] < 0 else 0, sum(b.state.mass for b in O.bodies if isinstance(b.shape, MpmPoint))])
print(json.dumps([found, grid.cellSize]))
''').result
	found, size = results
	assert [row[0] for row in found] == [size / 4, size / 4, size, size]
	assert all(abs(row[3] / found[0][3] - 1) < 1e-12 for row in found)


def test_unknowns_have_a_limit_and_a_warning_tells_of_it(yade):
	run = yade(scene + '''
grid, box = footing(halvings=3, maxUnknowns=985)
O.run(2, wait=True)
cells = solver.report()['cells']
print(json.dumps([2 * sum(cells.values()), len(cells)]))
''')
	unknowns, sizes = run.result
	assert unknowns <= 985 and sizes < 4
	assert 'MpmGrid.adaptation[0].maxUnknowns = 985 admits' in run.stderr and run.stderr.count('maxUnknowns') == 2


def test_in_space_edges_are_halved_too(yade):
	result = yade(scene + '''
footing(2, 1, dim=3)
O.run(1, wait=True)
print(json.dumps([sorted(solver.report()['cells'].items()), N()]))
''').result
	(small, many), (large, few) = result[0]
	assert large == 2 * small and many >= 32 and result[1] > 0


@pytest.mark.parametrize('change, said', [
        ("footing(2, 4, dim=3)", 'MpmGrid.adaptation[0].halvings = 4 is not admitted with dim=3: expected 1 to 3'),
        ("footing()[0].period = (3, 0, 0); solver.contacts = []", 'MpmGrid.adaptation: a grid with period'),
        ("footing(); solver.nonlocalLength = 1", 'cannot go with MpmGrid.adaptation, cells of several sizes'),
])
def test_what_cannot_be_is_refused(yade, change, said):
	assert said in yade(scene + change + '''
try: O.step()
except Exception as error: print(json.dumps(str(error)))
''').result


def test_a_function_says_how_large_cells_are(yade):
	"""Small cells at the edge as a function wants them, asked anew in each step, are as good as those that follow the edge by themselves."""
	results = yade(scene + '''
footing(4, 0)
O.run(4, wait=True)
coarse, dofs = N(), solver.dofs
asked = []
def size(x):
	asked.append(O.iter)
	return 0.125 * max(.25, np.hypot(x[0] - .5, x[1]) / .25)
grid, box = footing(4, 2, where=size)
O.run(4, wait=True)
middles = np.array([(np.array(b.min) + b.max) / 2 for b in grid.adapted if b.halvings == 2])
far = np.hypot(middles[:, 0] - .5, middles[:, 1]).max()
found = [N(), solver.dofs, far, sorted(set(asked)), sorted(solver.report()['cells'])]
grid.adaptation[0].where = lambda x: inf
O.step()
print(json.dumps([coarse, dofs, found, sorted(solver.report()['cells'])]))
''').result
	coarse, few, (load, dofs, far, asked, cells), at_last = results
	exact = 2 + np.pi
	assert abs(load / exact - 1) < 0.06 < 0.09 < coarse / exact - 1
	assert dofs < 1.2 * few and 0.06 < far < 0.2 and cells == [0.03125, 0.0625, 0.125]
	assert asked == [0, 1, 2, 3] and at_last == [0.125]


def test_cells_of_a_function_are_those_of_a_box(yade):
	"""The same cells by MpmRefinement, with the points split alike, give the same bits."""
	results = yade(slope + '''
def settled(**cells):
	grid = slope(profile=[(0, 0), (16, 0), (16, 6), (0, 6)])
	for name, value in cells.items(): setattr(grid, name, value)
	O.run(3, wait=True)
	return mpm.arrays()['pos'].tolist(), sorted(solver.report()['cells'].items())
small = MpmAdaptation(halvings=2, where=lambda x: .25 if max(abs(x[0] - 7), abs(x[1] - 3)) < 1 else 1)
large = MpmAdaptation(where=lambda x: inf)
box = MpmRefinement(min=(6, 2, -inf), max=(8, 4, inf), halvings=2)
print(json.dumps([settled(adaptation=[small]), settled(adaptation=[large], refinements=[box])]))
''').result
	assert results[0] == results[1] and len(results[0][1]) == 3


@pytest.mark.parametrize('function, said', [
        ('lambda x: -1.', "MpmGrid.adaptation[0].where returned -1.0 at "),
        ('lambda x: None', 'expected the size of cells [m] > 0'),
        ('lambda x: 1 / 0', "raised ZeroDivisionError('division by zero')"),
])
def test_a_function_that_says_no_size_is_refused(yade, function, said):
	"""Before the step has changed anything."""
	state, message = yade(scene + f'''
grid, box = footing(4, 1, where={function})
try: O.step()
except Exception as error: print(json.dumps([[solver.nDone, len(grid.adapted), len(O.bodies)], str(error)]))
''').result
	assert said in message and 'Vector3(0.03125,-2.46875,0)' in message and state == [0, 0, 1921]


def test_files_do_not_keep_functions(yade):
	"""A scene that is loaded says so, and goes on with the same bits when the function is given again."""
	results = yade(scene + '''
def size(x): return .0625 if x[1] > -.25 else .125
grid, box = footing(4, 1, where=size)
O.run(2, wait=True)
O.save('adapted.yade')
O.run(2, wait=True)
whole = solver.contacts[0].forces[0][1]
O.reset()
O.load('adapted.yade')
solver = O.engines[0]
try: O.step()
except Exception as error: said = str(error)
solver.grid.adaptation[0].where = size
O.run(2, wait=True)
print(json.dumps([said, whole, solver.contacts[0].forces[0][1]]))
''').result
	assert "MpmAdaptation.where = 'function' is not admitted" in results[0] and 'files do not keep' in results[0]
	assert results[1] == results[2]


slope = '''
import json
import numpy as np
from yade import mpm

def slope(yieldStress=1.2e4, engine=MpmImplicitEngine, profile=[(0, 0), (16, 0), (16, 2), (9, 2), (5, 6), (0, 6)], **options):
	O.reset()
	grid = MpmGrid(cellSize=1, adaptation=[MpmAdaptation(halvings=1, where='error')])
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=yieldStress, label='soil'))
	O.bodies.append(mpm.fill(mpm.polygon(profile), grid, 4, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(16, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [engine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, label='solver', verbosity=0, **options)]
	O.dt = 1 / 20
	return grid
'''


def test_cells_are_halved_where_soil_slides_and_nowhere_of_level_ground(yade):
	results = yade(slope + '''
found = []
for setting in dict(profile=[(0, 0), (16, 0), (16, 6), (0, 6)], yieldStress=1e6), dict():
	grid = slope(**setting)
	O.run(20, wait=True)
	found.append([len(grid.adapted), [(np.array(box.min) + box.max).tolist() for box in grid.adapted], len(solver.report()['cells'])])
print(json.dumps(found))
''').result
	(none, _, one), (some, middles, sizes) = results
	assert (none, one, sizes) == (0, 1, 2) and 5 < some < 50
	assert all(x / 2 < 14 and max(x, y) / 2 > 2 for x, y, _ in middles)  # level ground in front of the toe, and the corner behind the slide


@pytest.mark.parametrize('start, before, after, sizes', [(scene + 'footing()', 2, 3, 3), (slope + 'slope()', 15, 4, 2)], ids=['contact', 'error'])
def test_a_scene_that_is_saved_goes_on_with_the_same_bits(yade, start, before, after, sizes):
	result = yade(start + f'''
O.run({before}, wait=True)
mpm.save('half.yade.gz')
O.run({after}, wait=True)
whole = [mpm.arrays()[name].tobytes() for name in ('pos', 'stress', 'halfSize')]
mpm.load('half.yade.gz')
O.run({after}, wait=True)
print(json.dumps([whole == [mpm.arrays()[name].tobytes() for name in ('pos', 'stress', 'halfSize')], len(solver.report()['cells'])]))
''').result
	assert result == [True, sizes]


@pytest.mark.parametrize('scheme', ['newmark', 'explicit'])
def test_cells_change_in_time_without_a_jump_of_energy(yade, scheme):
	"""A slide in time: what the step of the sizes does to the energy is less than a percent of what slides."""
	result = yade(slope + f'''
slope(1e4, MpmDynamicEngine, scheme={scheme!r})
O.dt = 0.0025 if {scheme!r} == 'explicit' else 0.02
sizes = set()
while O.time < 1:
	O.step()
	sizes.add(len(solver.report()['cells']))
data = solver.plotData()
print(json.dumps([sorted(sizes), data['energyImbalance'], data['kineticEnergy'], data['loadWork']]))
''').result
	sizes, imbalance, kinetic, work = result
	assert sizes == [1, 2] and kinetic > 0
	assert abs(imbalance) < 0.01 * abs(work)


halves = '''
import json
import numpy as np
from yade import mpm, pack

whole = dict(min=(-inf, -inf, -inf), max=(inf, inf, inf))

def block(engine=MpmImplicitEngine, dim=2, axisymmetric=False, merge=True, gravity=0, size=(4, 4), boundaries=None, material=None, **options):
	"""Points that are split at once, as cells are halved everywhere, and may become one in the next step, where they are not."""
	O.reset()
	grid = MpmGrid(cellSize=1, dim=dim, axisymmetric=axisymmetric, refinements=[MpmRefinement(halvings=1, **whole)])
	O.materials.append(material or MpmElasticMat(young=1e6, poisson=0.3, density=2000, label='soil'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (*size, size[0])), MpmGrid(cellSize=1, dim=dim, axisymmetric=axisymmetric), 2, 'soil'))
	grid.adaptation = [MpmAdaptation(halvings=1, where='error', merge=merge)]
	sides = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(max=(0, inf, inf), fix='x')] + [MpmBoundary(max=(inf, inf, 0), fix='z')] * (dim == 3)
	O.engines = [engine(grid=grid, gravity=(0, gravity, 0), boundaries=sides if boundaries is None else boundaries, label='solver', verbosity=0, **options)]
	O.dt = 1
	return grid

def sums():
	a = mpm.arrays()
	bodies = [b for b in O.bodies if isinstance(b.shape, MpmPoint)]
	mass = np.array([b.state.mass for b in bodies])
	return dict(points=len(bodies), volume=a['volume'].sum(), mass=mass.sum(), moment=(mass[:, None] * a['pos']).sum(axis=0).tolist(),
	        momentum=(mass[:, None] * np.array([b.state.vel for b in bodies])).sum(axis=0).tolist(), stress=[a['stress'].min(axis=0).tolist(), a['stress'].max(axis=0).tolist()],
	        size=mpm.arrays()['halfSize'][:, :2].max())
'''


@pytest.mark.parametrize('options', ['', 'dim=3, size=(2, 2)', 'axisymmetric=True'])
def test_halves_become_one_again_without_a_trace(yade, options):
	"""A block under uniform stress: points are split where cells are halved, and one again where they are not."""
	results = yade(halves + f'''
found = []
grid = block({options})
count = len(O.bodies)
mpm.assign(stress=np.tile(-1e4 * np.eye(3), (count, 1, 1)))
solver.boundaries = [MpmBoundary(fix='xyz'[:grid.dim])]
for refinements in grid.refinements, [], []:
	grid.refinements = refinements
	O.step()
	found.append(sums())
print(json.dumps([count, solver.mergedEnergy, found]))
''').result
	count, energy, (split, one, still) = results
	parts = 8 if 'dim=3' in options else 4
	assert (split['points'], one['points'], still['points']) == (parts * count, count, count)
	assert one['size'] == pytest.approx(2 * split['size'], rel=1e-12)
	assert abs(energy) < 1e-6
	for name in 'volume', 'mass', 'moment', 'stress':
		assert np.allclose(split[name], one[name], rtol=1e-12, atol=1e-9 * np.abs(np.max(split[name]))), name


def test_a_column_at_rest_stays_at_rest_and_loses_little(yade):
	"""Under its weight the halves differ: those that become one lose no more than 1e-4 of the stored energy, and the base bears the same."""
	results = yade(halves + '''
found = []
grid = block(gravity=-10, size=(4, 8))
for refinements in grid.refinements, [], []:
	grid.refinements = refinements
	before = solver.mergedEnergy
	O.step()
	found.append([len(mpm.arrays()['pos']), solver.reactions[0][1], solver.plotData()['settlement'], (solver.mergedEnergy - before) / solver.plotData()['elasticEnergy']])
print(json.dumps(found))
''').result
	(many, weight, settlement, _), (few, after, settled, lost), (_, later, at, _) = results
	assert many > few and 0 < lost < 1e-4
	assert after == pytest.approx(weight, rel=1e-6) and later == pytest.approx(weight, rel=1e-6)
	assert at == pytest.approx(settlement, rel=2e-3)


def test_halves_stay_if_that_is_wanted_or_they_are_not_alike(yade):
	results = yade(halves + '''
found = []
for merge, strain in (False, 0), (True, 0.2), (True, 0):
	grid = block(merge=merge, material=MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=1e4, label='soil'))
	O.step()
	x = mpm.arrays()['pos']
	mpm.assign(plasticStrain=strain * (1 + (x[:, 1] > 2) * np.arange(len(x))))
	grid.refinements = []
	O.step()
	found.append(len(mpm.arrays()['pos']))
print(json.dumps(found))
''').result
	assert results[0] == 4 * results[2] and results[2] < results[1]


def test_momentum_is_kept_in_time(yade):
	"""A block that flies and turns: its momentum is kept to round-off, and what halves lose of their energy is told."""
	results = yade(halves + '''
grid = block(MpmDynamicEngine, boundaries=[])
x = mpm.arrays()['pos']
mpm.assign(velocity=np.column_stack([3 - .5 * x[:, 1], 1 + .5 * x[:, 0], 0 * x[:, 0]]))
O.dt = 0.01
found = []
for refinements in grid.refinements, []:
	grid.refinements = refinements
	if not refinements: grid.adaptation = [MpmAdaptation(where='contact')]
	O.step()
	data = solver.plotData()
	found.append([len(mpm.arrays()['pos']), data['momentum_x'], data['momentum_y'], data['angularMomentum_z'], data['kineticEnergy'], solver.mergedEnergy, data['energyImbalance']])
print(json.dumps(found))
''').result
	(many, *split), (few, *one) = results
	assert few < many
	assert one[0] == pytest.approx(split[0], rel=1e-12) and one[1] == pytest.approx(split[1], rel=1e-12)
	assert one[2] == pytest.approx(split[2], rel=0.05)
	assert 0 < one[4] < 0.05 * split[3] and abs(one[5]) < 0.01 * split[3]


def test_a_surface_stays_where_it_is_when_cells_are_halved(yade):
	"""Cells that the surface of a region cuts have the points of halved cells; within, there are no more than without."""
	results = yade(slope + '''
import collections
profile = mpm.polygon([(0, 0), (16, 0), (16, 2), (9, 2), (5, 6), (0, 6)])
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
def half(bodies): return collections.Counter(round(4 / b.shape.halfSize[0]) for b in bodies)
def volume(bodies): return sum(b.state.volume for b in bodies)
adapted, fine, coarse = [mpm.fill(profile, grid, 2, 'soil') for grid in (MpmGrid(cellSize=1, adaptation=[MpmAdaptation(halvings=2, where='error')]), MpmGrid(cellSize=.25), MpmGrid(cellSize=1))]
print(json.dumps([volume(adapted), volume(fine), len(adapted), len(fine), len(coarse), half(adapted)]))
''').result
	volume, exact, points, most, fewest, sizes = results
	assert volume == pytest.approx(exact, rel=1e-12)
	assert fewest < points < most / 2 and sorted(map(int, sizes)) == [16, 32, 64]


def test_large_points_are_split_where_cells_are_halved_three_times_at_once(yade):
	"""Each small cell has points then, and domains tile; what is strongly stretched by a body stays whole, these are not."""
	cells, clamped, mismatch = yade('''
import json
from yade import mpm
O.materials.append(MpmElasticMat(young=1e6, poisson=0.3, density=1000, label='soil'))
grid = MpmGrid(cellSize=0.5, adaptation=[MpmAdaptation(where='error')])
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4, 0), (4, 4), (0, 4)]), MpmGrid(cellSize=0.5), 1, 'soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, gravity=(0, -10, 0), label='solver', verbosity=0)]
O.dt = 1 / 10
O.step()
grid.refinements = [MpmRefinement(min=(1.6, 1.6, -inf), max=(2.4, 2.4, inf), halvings=3)]
O.step()
report = solver.report()
print(json.dumps([list(report['cells'].values()), solver.clampedDomains, report['domainMismatch']]))
''').result
	assert cells == [256, 80, 28, 48] and clamped == 0 and mismatch < 1e-5


def test_water_is_kept_as_cells_adapt(yade):
	"""A Box pushes saturated soil, and then the cells halved at its corner are joined: the soil keeps its water, and its pressure in the mean."""
	steps = yade(scene + '''
grid = MpmGrid(cellSize=.25, adaptation=[MpmAdaptation(halvings=2)])
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, conductivity=1e-7, porosity=.4, label='soil'))
O.materials.append(FrictMat(label='rigid'))
O.bodies.append(mpm.fill(mpm.polygon([(0, -1), (2, -1), (2, 0), (0, 0)]), grid, 2, 'soil'))
box = O.bodies[O.bodies.append(utils.box((0, 1, 0), (.5, 1, 1), material='rigid', fixed=True))]
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1, inf), fix='xy')]
flow = MpmFlow(drains=[MpmDrain(surface=[(2, 0), (.6, 0)])])
O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[MpmContact(friction=0)], flow=flow, loadCurve=[(0, 1), (1, 1)], label='solver', verbosity=0)]
found = []
for velocity, duration in (-1e-4, 10), (-1e-4, 10), (0, 100), (0, 1e-3):
	if duration < 1: grid.adaptation = []
	box.state.vel, O.dt = (0, velocity, 0), duration
	O.step()
	points = mpm.arrays()
	found.append([len(solver.report()['cells']), float((points['excessPressure'] * points['volume']).sum()), flow.waterIn - flow.waterOut - flow.waterStored, flow.waterOut])
print(json.dumps(found))
''').result
	assert [sizes for sizes, *_ in steps] == [3, 3, 3, 1]
	assert steps[3][1] == pytest.approx(steps[2][1], rel=0.03) and steps[2][1] > 0
	for _, _, lost, out in steps:
		assert out > 0 and lost == pytest.approx(0, abs=1e-6 * out)
