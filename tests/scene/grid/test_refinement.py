# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells that are halved in boxes (MpmGrid.refinements), from the filling to the files; tests/core/stepping/test_refined_step.cpp has what is exact across the sizes."""
import math

import pytest
from conftest import outcomesOf

scene = '''
import json
import numpy as np
from yade import mpm, pack, utils

def block(dim=2, halvings=2, near=0.3, poisson=0., axisymmetric=False, top=False, law=None, **engine):
	"""A body of 2 x 2 [x 2] m on rollers, E = 1 MPa, with large cells of half a metre that are halved near the corner at the top (or the whole of it)."""
	O.reset()
	O.materials.append(law or MpmElasticMat(young=1e6, poisson=poisson, density=1000))
	O.materials[0].label = 'soil'
	O.materials.append(FrictMat(frictionAngle=radians(20), density=2600, young=1e7, label='rigid'))
	grid = MpmGrid(cellSize=0.5, dim=dim, axisymmetric=axisymmetric)
	if halvings: grid.refinements = [MpmRefinement(min=(-inf, 2 - near, -inf), max=(inf if top else near, inf, inf if top else near), halvings=halvings)]
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (2, 2, 2 if dim == 3 else 1)), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')] + ([MpmBoundary(max=(inf, inf, 0), fix='z')] if dim == 3 else [])
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, label='solver', verbosity=0, **engine)]
	O.dt = 0.1
	return grid

def sizes():
	half, number = np.unique(mpm.arrays()['halfSize'][:, 0], return_counts=True)
	return dict(zip((8 * half).tolist(), number.tolist()))

def plate(y=2, velocity=(0, -0.5, 0)):
	i = O.bodies.append(utils.wall(y, axis=1, sense=-1, material='rigid'))
	O.bodies[i].state.vel = velocity
'''


def test_each_cell_is_filled_by_as_many_points(yade):
	"""A cell halved twice, its neighbours once; the volume is that of the block; predicates of other kinds cut through cells of all sizes."""
	results = yade(scene + '''
found = []
for dim in 2, 3:
	block(dim)
	points = mpm.arrays()
	found.append([sizes(), points['volume'].sum(), len(np.unique(points['pos'].round(9), axis=0)), len(O.bodies)])
grid = MpmGrid(cellSize=0.5, refinements=[MpmRefinement(min=(1, 1, -inf), halvings=3)])
ball = pack.inSphere((1, 1, 0), 1)
points = [b.state.pos for b in mpm.fill(ball, grid, 3, 'soil')]
volume = sum(8 * b.shape.halfSize[0] * b.shape.halfSize[1] / 2 for b in mpm.fill(ball, grid, 3, 'soil'))
print(json.dumps([found, volume, all((p - Vector3(1, 1, 0)).norm() <= 1 for p in points)]))
''').result
	for dim, (sizes, volume, places, points) in zip((2, 3), results[0]):
		once, cells = 2**dim - 1, 2**dim  # the cell in the corner is halved twice, those that touch it once
		assert sizes == {'0.25': cells**2 * cells, '0.5': once * cells * cells, '1.0': (4**dim - 1 - once) * cells}
		assert abs(volume - 2**dim) < 1e-12 and places == points
	assert abs(results[1] / math.pi - 1) < 0.01 and results[2]


def test_a_plate_presses_across_the_sizes(yade):
	"""To 0.75 of the height, nu = 0: E ln l / l per area, the same at all points; with F-bar too, and around an axis, where it is even to a percent with equal cells."""
	results = yade(scene + '''
found = []
for dim, options in (2, {}), (2, dict(fBar=True)), (2, dict(top=True)), (2, dict(axisymmetric=True)), (2, dict(axisymmetric=True, fBar=True)), (3, {}), (3, dict(fBar=True)), (3, dict(newton=MpmNewton(linearSolver='iterative', tolerance=1e-9))):
	block(dim, contacts=[MpmContact(friction=0)], **options)
	plate()
	O.run(10, wait=True)
	stress = mpm.arrays()['stress'][:, 1, 1]
	area = math.pi * 4 if 'axisymmetric' in options else 2.**(dim - 1)
	found.append([solver.contacts[0].forces[0][1] / area, stress.min(), stress.max(), 'axisymmetric' in options])
print(json.dumps(found))
''').result
	exact = 1e6 * math.log(0.75) / 0.75
	for pressure, low, high, isRing in results:
		assert abs(-pressure / exact - 1) < 0.01
		assert abs(low / high - 1) < (0.06 if isRing else 1e-6)


def test_a_slope_slides_through_smaller_cells(yade):
	"""Its points are split as they come there; the slope of the paper moves as far as in equal cells."""
	result = yade('''
import json
from math import inf
from yade import mpm
import numpy as np
law = dict(young=1e6, poisson=0.3, density=2400)
found = []
for halvings in 0, 1:
	O.reset()
	O.materials.append([MpmVonMisesMat(yieldStress=15e3, label='soil', **law), MpmVonMisesMat(yieldStress=7.5e3, label='weak', **law)])
	grid = MpmGrid(cellSize=1, refinements=[MpmRefinement(min=(5, 4, -inf), max=(20, 9, inf), halvings=1)] * halvings)
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	O.bodies.append(mpm.fill(profile, grid, 2, lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, verbosity=0)]
	O.dt, number = 1 / 40, len(mpm.arrays()['id'])
	O.run(40, wait=True)
	at = mpm.arrays()
	found.append([np.linalg.norm(at['pos'] - at['pos0'], axis=1).max(), len(at['id']) - number, O.engines[0].clampedDomains, O.engines[0].cuts])
print(json.dumps(found))
''').result
	(equal, *_), (halved, split, clamped, cuts) = result
	assert abs(halved / equal - 1) < 0.01 and split > 50 and clamped == cuts == 0, result


def test_it_goes_on_bit_for_bit_after_saving_and_with_two_threads(yade):
	"""Half way the box is moved and taken away, too: points that get into smaller cells are split, and mass is kept."""
	script = scene + '''
import sys
def start():
	block(3 if 'dim' in sys.argv else 2, law=MpmVonMisesMat(young=1e6, poisson=0.3, density=1000, yieldStress=2e4), gravity=(0, -30, 0), contacts=[MpmContact(friction=0.2)], fBar=True)
	O.engines = O.engines + [MpmVtkRecorder(fileName='out-', recorders=['points', 'grid', 'ghostFaces'], iterPeriod=3)]
	plate(velocity=(0.1, -0.3, 0))
def change():
	solver.grid.refinements = [MpmRefinement(min=(1, -inf, -inf), max=(1.4, 0.7, inf), halvings=2)]
def goOn():
	O.run(2, wait=True)
	solver.grid.refinements = []
	O.run(1, wait=True)
	points = mpm.arrays()
	return [points[name].tobytes().hex()[-200:] for name in ('pos', 'stress', 'halfSize')] + [points['volume'].sum(), len(points['id']), abs(points['stress']).sum()]
start()
O.run(2, wait=True)
change()
O.save('half.yade.gz')
first = goOn()
O.reset()
O.load('half.yade.gz')
second = goOn()
print(json.dumps([first, first == second]))
'''
	one, two = yade(script).result, yade(script, threads=2).result
	assert one[1] and two[1] and one[0] == two[0]
	points = one[0][4]
	assert points > 64 + 3 * 8 + 48  # some have been split


def test_files_and_pictures_show_the_leaves(yade):
	run = yade(scene + '''
block(gravity=(0, -10, 0))
O.engines = O.engines + [MpmVtkRecorder(fileName='out-', recorders=['points', 'grid', 'ghostFaces'], ascii=True)]
O.run(1, wait=True)
mpm.plot('stress_yy').figure.savefig('picture.png')
from vtk import vtkXMLUnstructuredGridReader
def read(kind):
	reader = vtkXMLUnstructuredGridReader()
	import glob
	reader.SetFileName(sorted(glob.glob(f'out-{kind}*.vtu'))[0])
	reader.Update()
	return reader.GetOutput()
cells, faces = read('grid'), read('ghostFaces')
bounds = [cells.GetCell(c).GetBounds() for c in range(cells.GetNumberOfCells())]
area = [(b[1] - b[0]) * (b[3] - b[2]) for b in bounds]
lengths = sorted({round(sum(faces.GetCell(c).GetBounds()[2 * a + 1] - faces.GetCell(c).GetBounds()[2 * a] for a in (0, 1)), 9) for c in range(faces.GetNumberOfCells())})
print(json.dumps([len(area), sum(area), cells.GetNumberOfPoints(), lengths, solver.activeCells, solver.ghostFaces, faces.GetNumberOfCells()]))
''')
	cells, area, corners, lengths, active, ghost, faces = run.result
	assert cells == active == 12 + 3 * 4 + 16 and abs(area - 4) < 1e-12
	assert lengths == [0.125, 0.25, 0.5] and ghost == faces
	assert (run.folder / 'picture.png').stat().st_size > 10000


def test_loads_on_surfaces(yade):
	"""A traction goes across the sizes; a pressure stays in cells of one size."""
	results = yade(scene + '''
found = []
for dim in 2, 3:
	surface = [(2, 2), (0, 2)] if dim == 2 else [[(0, 2, 0), (0, 2, 2), (2, 2, 2)], [(0, 2, 0), (2, 2, 2), (2, 2, 0)]]
	block(dim, loads=[MpmTraction(surface=surface, traction=(0, -1e4, 0))])
	O.dt = 1
	O.run(1, wait=True)
	stress = mpm.arrays()['stress'][:, 1, 1]
	found.append([solver.reactions[1][1] / 2**(dim - 1), stress.min(), stress.max()])
block(top=True, loads=[MpmTraction(surface=[(2, 2), (0, 2)], pressure=1e4)])
O.dt = 1
O.run(1, wait=True)
found.append([solver.reactions[1][1] / 2, *[f(mpm.arrays()['stress'][:, 1, 1]) for f in (min, max)]])
block(loads=[MpmTraction(surface=[(2, 2), (0, 2)], pressure=1e4)])
try: O.run(1, wait=True)
except RuntimeError as error: found.append(str(error))
print(json.dumps(found))
''').result
	for reaction, low, high in results[:3]:
		assert abs(reaction / 1e4 - 1) < 1e-6 and abs(low / -1e4 - 1) < 0.03 and abs(high / -1e4 - 1) < 0.03
	assert 'under pressure goes from cells of one size to cells of another' in results[3]


def test_errors_of_stress_are_estimated_across_the_sizes(yade):
	"""Under its weight, nu = 0: the stress is that of what lies above."""
	for true, estimate in yade(scene + '''
found = []
for halvings, top in (0, False), (1, True), (2, False), (2, True):
	block(halvings=halvings, top=top, near=0.8, gravity=(0, -50, 0))
	O.run(10, wait=True)
	points = mpm.arrays()
	exact = -1000 * 50 * (2 - points['pos0'][:, 1])
	off = (points['stress'][:, 1, 1] - exact)**2 @ points['volume']
	found.append([float(np.sqrt(off / (exact**2 @ points['volume']))), mpm.stressError()['error']])
print(json.dumps(found))
''').result:
		assert 0.5 < estimate / true < 2, (true, estimate)


def test_refused(yade):
	"""Features that have not been shown to be right with cells of several sizes are refused by a sentence that names them."""
	cases = {
	        'block(); solver.grid.period = (2, 0, 0)': 'MpmGrid.refinements: a grid with period = (2 0 0)',
	        'block(water=[MpmWater(pressure=lambda x: 0)], loads=[MpmBeam(line=[(1, 3), (1, 1)], axialStiffness=1e9, bendingStiffness=1e6)])': 'water[0].pressure, a function, knows the two sides of beams on equal cells only',
	        "block(newton=MpmNewton(linearSolver='amg'))": "linearSolver = 'amg'",
	        'block(); solver.grid.refinements = [MpmRefinement(min=(2, 0, 0), max=(1, 0, 0))]': 'MpmRefinement.min = 2 is greater than max = 1 along x',
	        'block(); solver.boundaries = [*solver.boundaries, MpmBoundary(min=(1.125, 0.125, -inf), max=(1.125, 0.125, inf), fix="x")]': 'boundaries[2] lies between the nodes of larger cells',
	}
	found = outcomesOf(yade.folder, scene, [case + '; O.run(1, wait=True)' for case in cases])
	for (statement, (_, said)), expected in zip(found.items(), cases.values()):
		assert expected in said, (statement, said)


def test_cells_are_halved_where_positions_ask_for_it(yade):
	"""An L of positions: halved twice there, equal far away; whatever the dimension. Each row of cells has a box."""
	yade('''
from yade import mpm
import numpy as np
O.materials.append(MpmElasticMat(young=1, poisson=0, label='soil'))
for dim in 2, 3:
	grid = MpmGrid(cellSize=1, dim=dim, origin=(0.25, 0, 0))
	places = [(0.3, 0.1, 0), (1.2, 0.2, 0.3), (0.4, 0.9, 0.1)]
	grid.refinements = found = mpm.refinementsAt(places, grid, halvings=2)
	assert len(found) == 2 and all(box.halvings == 2 for box in found)
	for place, size in *[(place, 0.25) for place in places], ((1.5, 0.2, 0.3), 0.5), ((9.5, 9.5, 0.2), 1):
		filled = mpm.fill(pack.inAlignedBox([x - 1 for x in place], [x + 1 for x in place]), grid, 1, 'soil')
		nearest = min(filled, key=lambda body: np.linalg.norm((np.array(body.state.pos) - place)[:dim]))
		assert 2 * nearest.shape.halfSize[0] == size, (dim, place, nearest.shape.halfSize)
	assert mpm.refinementsAt(np.empty((0, 3)), grid) == []
for wrong, parts in (([(0, 0)], 'positions'), ([(0, 0, np.nan)], 'positions'), ('here', 'positions')):
	try: mpm.refinementsAt(wrong, grid)
	except ValueError as error: assert parts in str(error), error
	else: raise AssertionError(wrong)
for arguments in (dict(grid=grid, halvings=6), dict(grid=1)):
	try: mpm.refinementsAt([(0, 0, 0)], **arguments)
	except (ValueError, TypeError) as error: assert 'halvings' in str(error) or 'grid' in str(error), error
	else: raise AssertionError(arguments)
''')


def test_cells_are_halved_around_bodies_and_along_their_way(yade):
	"""One box around each, or along a straight way; several across the axes. Without limits out of the plane."""
	yade('''
from yade import mpm, utils
import numpy as np
O.materials.append(FrictMat(label='rigid'))
def add(body): return O.bodies[O.bodies.append(body)]
def limits(box): return np.array([box.min, box.max])
ball, box = add(utils.sphere((1, 2, 3), 0.5)), add(utils.box((0, 0, 0), (1, 0.5, 0.25)))
facet = add(utils.facet([(0, 0, 0), (1, 0, 0), (0, 2, 0)]))
box.state.ori = Quaternion((0, 0, 1), pi / 2)
clump = O.bodies[O.bodies.appendClumped([utils.sphere((5, 0, 0), 1), utils.sphere((6, 0, 0), 1)])[0]]
space, plane = MpmGrid(cellSize=0.5, dim=3), MpmGrid(cellSize=0.5, dim=2)
for body, middle, half in (ball, (1, 2, 3), (0.5, 0.5, 0.5)), (box, (0, 0, 0), (0.5, 1, 0.25)), (facet, (0.5, 1, 0), (0.5, 1, 0)), (clump, (5.5, 0, 0), (1.5, 1, 1)):
	found, = mpm.refinementsAt(body, space, halvings=2, margin=0.125)
	assert found.halvings == 2 and np.allclose(limits(found), [np.array(middle) - half - 0.125 * np.ones(3), np.array(middle) + half + 0.125 * np.ones(3)])
found, = mpm.refinementsAt([ball], plane, way=(0, -4, 0))
assert np.allclose(limits(found), [(0, -3, -inf), (2, 3, inf)])
assert len(mpm.refinementsAt([ball, box], plane)) == 2
oblique = mpm.refinementsAt(ball, plane, way=(3, -4, 0), margin=0)
assert len(oblique) == 10
for part in np.linspace(0, 1, 50):
	place = (1 + 3 * part, 2 - 4 * part, 0)
	assert any((limits(b)[0] <= place).all() and (place <= limits(b)[1]).all() for b in oblique)
assert max((limits(b)[1] - limits(b)[0])[:2].max() for b in oblique) < 1.5
wall = add(utils.wall(0, axis=1, material='rigid'))
for arguments, said in ((wall, {}), 'has no end'), ((ball, dict(margin=-1)), 'margin = -1'), ((ball, dict(way=(1, nan, 0))), 'way'), (([(0, 0, 0)], dict(way=(1, 0, 0))), 'way'):
	try: mpm.refinementsAt(arguments[0], plane, **arguments[1])
	except ValueError as error: assert said in str(error), error
	else: raise AssertionError(said)
''')


def test_small_cells_travel_with_a_body(yade):
	"""A ball presses into cells that are halved around it, along its way or where it is: nearly as into small cells everywhere, with large ones alone an eighth harder."""
	forces = yade('''
import json
from yade import mpm, utils
def press(refine):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0.3, density=1, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	grid = MpmGrid(cellSize=0.125 if refine is None else 0.25, dim=2)
	ball = O.bodies[O.bodies.append(utils.sphere((0, 1.25, 0), 0.25, material='rigid', fixed=True))]
	ball.state.vel = (0, -0.05, 0)
	along = refine == 'along'
	if along: grid.refinements = mpm.refinementsAt(ball, grid, way=(0, -0.3, 0))
	O.bodies.append(mpm.fill(pack.inAlignedBox((-1.5, -0.5, -1), (1.5, 1, 1)), grid, 2, 'soil'))
	solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, -0.5, inf), fix='xy')], contacts=[MpmContact(friction=0)], verbosity=0, label='solver')
	travels = PyRunner(iterPeriod=1, initRun=True, command='solver.grid.refinements = mpm.refinementsAt(O.bodies[0], solver.grid)')
	O.engines = [travels, solver] if refine == 'travels' else [solver]
	__builtins__.__dict__['solver'] = solver
	O.dt = 1
	O.run(5, wait=True)
	return solver.contacts[0].forces[0][1], solver.dofs
print(json.dumps([press(None), press('along'), press('travels'), press('coarse')]))
''').result
	(fine, dofs), along, travels, coarse = forces
	assert 0.1 < coarse[0] / fine - 1 < 0.15
	for (force, unknowns), error in (along, 0.01), (travels, 0.03):
		assert abs(force / fine - 1) < error and unknowns < dofs / 2
