# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmGrid.period: opposite sides are the same nodes."""
import numpy as np
import pytest
from conftest import Yade, outcomesOf

scene = '''
from yade import mpm
import json
import numpy as np

def layer(length=4, period=(4, 0, 0), grid=None, boundaries=None, **engine):
	"""Elastic, 1 m high, on a base that all its nodes are held to, with a step so that places along it differ."""
	global solver
	O.materials.append(MpmElasticMat(young=1e6, poisson=0.3, density=2000, label='soil'))
	grid = grid or MpmGrid(cellSize=0.5, period=period)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (length, 0), (length, 1), (length / 2, 1), (length / 2, 1.5), (0, 1.5)]), grid, 2, 'soil'))
	base = MpmBoundary(max=(inf, 0, inf), fix='xy', displacement=(5, 0, 0))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=[base] if boundaries is None else boundaries, label='solver', verbosity=0, **engine)]
	O.dt = 0.1
	return solver
'''


@pytest.fixture(scope='module')
def carried(tmp_path_factory):
	"""A layer that its base carries along by five metres, more than once around the period of four: saved on the way, and at the end."""
	folder = tmp_path_factory.mktemp('carried')
	Yade(folder)(
	        scene + '''
layer()
O.engines += [MpmVtkRecorder(fileName='out-', iterPeriod=10, recorders=['points', 'grid', 'ghostFaces'])]
np.savez('before.npz', **mpm.arrays())
O.run(5, wait=True)
O.save('half.yade.gz')
O.run(5, wait=True)
np.savez('after.npz', **mpm.arrays())
O.engines[1]()
O.load('half.yade.gz')
O.run(5, wait=True)
np.savez('continued.npz', **mpm.arrays())
'''
	)
	return folder


def test_points_that_leave_re_enter_and_keep_their_displacement(carried):
	before, after = np.load(carried / 'before.npz'), np.load(carried / 'after.npz')
	assert after['pos'][:, 0].min() >= 0 and after['pos'][:, 0].max() <= 4
	displacement = after['pos'] - after['pos0']
	assert abs(displacement - [5, 0, 0]).max() < 1e-9
	assert abs(after['stress']).max() < 1e-3, 'a rigid motion'
	# the initial position goes with the point by whole periods
	periods = (after['pos0'] - before['pos0']) / 4
	assert abs(periods - np.round(periods)).max() < 1e-12 and set(np.round(periods[:, 0])) == {-1, -2}


def test_a_saved_scene_goes_on_around_the_period(carried):
	whole, parts = np.load(carried / 'after.npz'), np.load(carried / 'continued.npz')
	for name in whole:
		assert np.array_equal(whole[name], parts[name]), name


def test_files_show_cells_and_faces_where_they_are(carried):
	"""No cell reaches from one side to the other, and displacements are those of the points."""
	from vtkmodules.util.numpy_support import vtk_to_numpy
	from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
	for kind in 'points', 'grid', 'ghostFaces':
		reader = vtkXMLUnstructuredGridReader()
		reader.SetFileName(str(sorted(carried.glob(f'out-*{kind}*.vtu'))[-1]))
		reader.Update()
		data = reader.GetOutput()
		sizes = [np.ptp(vtk_to_numpy(data.GetCell(c).GetPoints().GetData()), axis=0).max() for c in range(data.GetNumberOfCells())]
		assert sizes and max(sizes) < 0.51, kind
		if kind != 'points': continue
		displacement = vtk_to_numpy(data.GetCellData().GetArray('displacement'))
		assert abs(displacement - displacement[0]).max() < 1e-9 and displacement[0, 0] > 2.4, 'the last file is that of the loaded scene'


def test_sides_are_joined(yade):
	"""A slope that goes on for ever: what it weighs is carried by its base, and the step in it moves as wherever else along the period."""
	result = yade(
	        scene + '''
found = []
for shift in 0, 1.5, 3:
	O.reset()
	layer(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], gravity=(3, -9.81, 0))
	for b in O.bodies:
		b.state.pos = b.state.refPos = Vector3((b.state.pos[0] + shift) % 4, b.state.pos[1], 0)
	O.run(10, wait=True)
	a = mpm.arrays()
	found.append([list(solver.reactions[0]), (a['pos'] - a['pos0']).tolist()])
print(json.dumps(found))
'''
	).result
	weight = 2000 * (4 + 1)
	for reaction, displacement in result:
		assert np.allclose(reaction, [-3 * weight, 9.81 * weight, 0], rtol=1e-6)
		assert np.allclose(displacement, result[0][1], rtol=0, atol=1e-8)
	assert np.abs(result[0][1]).max() > 1e-2


refused = {
        'layer(period=(4.1, 0, 0)); O.step()': ('ValueError', 'MpmGrid.period', '8.2 cells', '4 m'),
        'layer(period=(1, 0, 0), length=1); O.step()': ('ValueError', 'MpmGrid.period', '2 cells', 'fewer than 3', 'three nodes'),
        'layer(period=(4, 0, 2)); O.step()': ('ValueError', 'MpmGrid.period', 'along z', 'dim=2'),
        'MpmGrid(cellSize=1, period=(-4, 0, 0))': ('ValueError', 'MpmGrid.period', '>= 0'),
        'MpmGrid(cellSize=1, period=(nan, 0, 0))': ('ValueError', 'MpmGrid.period', 'finite'),
        'layer(length=5); O.step()': ('ValueError', 'Body #', 'outside of the period', 'from 0 to 4 m', 'filled'),
        "layer(boundaries=[MpmBoundary(min=(4.5, -inf, -inf), fix='x')]); O.step()": ('ValueError', 'contains no grid node', 'period'),
        "layer(boundaries=[MpmBoundary(max=(0, inf, inf), fix='x', displacement=(1, 0, 0)), MpmBoundary(min=(4, -inf, -inf), fix='x')]); O.step()":
        ('ValueError', 'boundaries[0] and boundaries[1]', 'both boxes'),
        "layer(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y')]); O.step()": ('RuntimeError', 'translation along x'),
}


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('refused'), scene, list(refused))


@pytest.mark.parametrize('statement', refused)
def test_refused(outcomes, statement):
	kind, text = outcomes[statement]
	expected, *parts = refused[statement]
	assert kind == expected and all(part in text for part in parts), (kind, text)
