# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells that are halved by themselves around edges of rigid bodies (MpmGrid.adaptation)."""
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
for setting in dict(profile=[(0, 0), (16, 0), (16, 6), (0, 6)]), dict():
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
O.dt = 0.003 if {scheme!r} == 'explicit' else 0.02
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
