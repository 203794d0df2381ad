# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's analyses against reference results of independent implementations of the same method."""
import numpy as np
import pytest
from conftest import root

data = root / 'tests' / 'data'


@pytest.mark.parametrize('pointsPerCell, iterations, displacement', [(2, 5.475, 2.612404), (3, 5.500, 2.611236), (4, 5.525, 2.596672)])
def test_slope(yade, pointsPerCell, iterations, displacement):
	"""Iterations count a first pass without solve, as in the paper."""
	run = yade(
	        f'''
import json
from scenes import *
solver = slope(pointsPerCell={pointsPerCell})
solves = []
for step in range(40):
	O.step()
	solves.append(solver.iterations)
points = mpm.arrays()
print(json.dumps(dict(
	steps=O.iter, iterations=np.mean(solves) + 1, displacement=np.linalg.norm(points['pos'] - points['pos0'], axis=1).max(),
	history=solver.residuals, difference=againstCsv('{data}/slope_h1_2x2_ghost.csv') if {pointsPerCell} == 2 else (0, 0))))
'''
	)
	print(run.result)
	assert run.result['steps'] == 40
	assert run.result['iterations'] == pytest.approx(iterations, abs=0.06)
	assert run.result['displacement'] == pytest.approx(displacement, abs=1e-5)
	assert run.result['difference'][0] < 1e-5
	assert run.result['difference'][1] < 1e-4


def test_slope_on_a_finer_grid_completes(yade):
	run = yade('''
import json
from scenes import *
solver = slope(cellSize=0.5)
O.run(80, wait=True)
print(json.dumps([O.iter, solver.loadFactor, solver.converged]))
''')
	assert run.result == [80, pytest.approx(1), True]


def test_slope_without_stabilisation_is_reported_as_what_it_is(yade):
	"""Failure and its step depend on round-off; a failure at step 24 is expected."""
	run = yade(
	        '''
import json
from scenes import *
solver = slope(pointsPerCell=3, factor=0)
solver.newton.minStep = 1 # no cutting
before, message = None, ''
try:
	for step in range(40):
		before = mpm.arrays()
		O.step()
except RuntimeError as error:
	message = str(error)
after = mpm.arrays()
print(json.dumps(dict(
	completed=O.iter, time=O.time * 40, factor=solver.loadFactor * 40, converged=solver.converged, message=message, faces=solver.ghostFaces,
	unchanged=all(np.array_equal(before[k], after[k]) for k in before))))
'''
	)
	result = run.result
	print(result)
	assert result['faces'] == 0
	assert result['time'] == pytest.approx(result['completed'])
	assert result['factor'] == pytest.approx(result['completed'])
	if result['completed'] < 40:
		assert not result['converged'] and result['unchanged']
		assert 'ghost stabilisation is off' in result['message']


def test_column(yade):
	reference = {
	        8: (1.29408206e-2, 9.64276631e-3, 1.12729015e-2),
	        16: (3.65890602e-3, 3.01201409e-3, 3.35234265e-3),
	        32: (1.04870581e-3, 9.86432725e-4, 1.01301122e-3),
	        64: (4.35723724e-4, 4.01470630e-4, 3.97129009e-4),
	}
	run = yade(
	        f'''
import json
from scenes import *
settings = [dict(factor=0), dict(scaling='paper'), dict(scaling='mesh-independent')]
files = [None, 'column_64cells_ghost_paper_scaling.csv', 'column_64cells_ghost_mesh_independent.csv']
errors, differences, solves = {{}}, [], []
for cells in 8, 16, 32, 64:
	for ghost, file in zip(settings, files):
		O.reset()
		solver = column(cells, **ghost)
		for step in range(40):
			O.step()
			solves.append(solver.iterations)
		errors.setdefault(cells, []).append(columnError())
		if cells == 64 and file: differences.append(againstCsv('{data}/' + file))
print(json.dumps(dict(errors=errors, differences=differences, iterations=[np.mean(solves) + 1, max(solves) + 1])))
'''
	)
	print(run.result)
	for cells, errors in reference.items():
		assert run.result['errors'][str(cells)] == pytest.approx(errors, rel=1e-6)
	for position, stress in run.result['differences']:
		assert position < 1e-5 and stress < 1e-6
	assert run.result['iterations'] == [pytest.approx(4.15, abs=0.06), 5]


def test_column_of_cubes_equals_plane_strain(yade):
	"""Poisson's ratio is 0, the column one cell wide and deep."""
	run = yade(
	        '''
import json
from scenes import *
errors = []
for dim in 2, 3:
	O.reset()
	column(8, dim=dim)
	O.run(40, wait=True)
	errors.append(columnError())
print(json.dumps(errors))
'''
	)
	assert run.result[1] == pytest.approx(run.result[0], rel=1e-8)


def test_condition_numbers_of_figure_2(yade):
	reference = np.genfromtxt(data / 'fig2.csv', delimiter=',', names=True)[[0, 1, 5, 25, 50, 75, 99, 101, 125, 199]]
	run = yade(
	        f'''
import json
from scenes import *
table = []
for offset in {reference['a'].tolist()}:
	row = []
	for basis, factor in ('mpm', 0), ('gimp', 0), ('gimp', 1e-2):
		O.reset()
		row.append(block(offset, basis, factor).conditionNumber())
	table.append(row)
print(json.dumps(table))
'''
	)
	for row, expected in zip(run.result, reference):
		assert row == pytest.approx(list(expected)[1:], rel=1e-6), f"offset {expected['a']}"
