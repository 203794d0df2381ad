# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmGrid.axisymmetric: bodies of revolution about x = 0."""
import numpy as np
import pytest
from conftest import Yade, outcomesOf

scene = '''
from yade import mpm
import json
import numpy as np

def cylinder(radius=2, grid=None, from_=0, boundaries=None, material='MpmElasticMat(young=1e6, poisson=0.3, density=2000, label="soil")', **engine):
	"""1.5 m high, on a smooth base."""
	global solver
	O.materials.append(eval(material))
	grid = grid or MpmGrid(cellSize=0.5, axisymmetric=True)
	O.bodies.append(mpm.fill(pack.inAlignedBox((from_, 0, -1), (radius, 1.5, 1)), grid, 2, 'soil'))
	base = [MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=base if boundaries is None else boundaries, label='solver', verbosity=0, **engine)]
	O.dt = 0.1
	return solver
'''


@pytest.fixture(scope='module')
def settled(tmp_path_factory):
	"""A cylinder that settles under its weight, saved on the way, with files of its section and revolved."""
	folder = tmp_path_factory.mktemp('settled')
	Yade(folder)(
	        scene + '''
cylinder(gravity=(0, -9.81, 0), fBar=True)
before = mpm.arrays()
O.engines += [MpmVtkRecorder(fileName='section-', iterPeriod=10), MpmVtkRecorder(fileName='whole-', iterPeriod=10, sectors=8)]
O.run(5, wait=True)
O.save('half.yade.gz')
O.run(5, wait=True)
np.savez('after.npz', **mpm.arrays(), volume0=before['volume'], reaction=solver.reactions[0], reactions=len(solver.reactions))
mpm.advise()
O.engines = O.engines[:1]
O.load('half.yade.gz')
O.run(5, wait=True)
np.savez('continued.npz', **mpm.arrays())
'''
	)
	return folder


def test_volumes_and_weights_are_those_of_the_whole_body(settled):
	after = np.load(settled / 'after.npz')
	volume = np.pi * 2**2 * 1.5
	assert np.isclose(after['volume0'].sum(), volume, rtol=1e-12)
	assert after['reactions'] == 1, 'the axis is not among the boundaries'
	assert np.isclose(after['reaction'][1], 2000 * 9.81 * volume, rtol=1e-6)
	assert np.allclose(after['halfSize'][:, 2], np.pi * after['pos'][:, 0])


def test_the_hoop_is_the_third_direction(settled):
	after = np.load(settled / 'after.npz')
	r, r0, F = after['pos'][:, 0], after['pos0'][:, 0], after['defGrad']
	assert np.allclose(F[:, 2, 2], r / r0, rtol=1e-12)
	assert np.allclose(after['volume'], after['volume0'] * np.linalg.det(F), rtol=1e-12)
	assert (F[:, 2, 2] > 1).all(), 'it bulges'
	assert (r - after['halfSize'][:, 0]).min() > -1e-12, 'no domain crosses the axis'


def test_a_saved_scene_goes_on_with_the_same_bits(settled):
	whole, parts = np.load(settled / 'after.npz'), np.load(settled / 'continued.npz')
	for name in parts:
		assert np.array_equal(whole[name], parts[name]), name


def test_revolved_files(settled):
	from vtkmodules.util.numpy_support import vtk_to_numpy
	from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
	from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

	def read(start):
		reader = vtkXMLUnstructuredGridReader()
		reader.SetFileName(str(sorted(settled.glob(start + 'points*.vtu'))[0]))
		reader.Update()
		return reader.GetOutput()

	section, whole = read('section-'), read('whole-')
	n = section.GetNumberOfCells()
	assert whole.GetNumberOfCells() == 8 * n
	sizes = vtkCellSizeFilter()
	sizes.SetInputData(whole)
	sizes.Update()
	volume = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray('Volume'))
	assert (volume > 0).all() and np.isclose(volume.sum(), 4 * np.sin(np.pi / 4) * 2**2 * 1.5), 'a prism with eight sides'
	stress = [vtk_to_numpy(data.GetCellData().GetArray('stress')).reshape(-1, 3, 3) for data in (section, whole)]
	assert np.allclose(np.linalg.eigvalsh(np.repeat(stress[0], 8, axis=0)), np.linalg.eigvalsh(stress[1]))


def test_pressure_on_a_tube_of_every_law(yade):
	"""Slightly strained, all laws are elastic: the same displacements."""
	result = yade(
	        scene + '''
common = 'poisson=0.3, density=2000, label="soil"'
found = {}
for law in (f'MpmElasticMat(young=1e8, {common})', f'MpmVonMisesMat(young=1e8, yieldStress=1e7, {common})', f'MpmTrescaMat(young=1e8, undrainedStrength=1e7, {common})',
        f'MpmMohrCoulombMat(young=1e8, cohesion=1e7, frictionAngle=0.5, {common})', f'MpmDruckerPragerMat(young=1e8, cohesion=1e7, frictionAngle=0.5, {common})'):
	for fBar in False, True:
		O.reset()
		cylinder(from_=1, material=law, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 1.5, -inf), fix='y')], fBar=fBar)
		for b in O.bodies:
			if b.state.pos[0] < 1.25: b.state.force = (1e3 * b.state.pos[0], 0, 0)
		O.run(10, wait=True)
		a = mpm.arrays()
		found[law[:12] + str(fBar)] = (a['pos'] - a['pos0'])[:, 0].tolist()
print(json.dumps(found))
'''
	).result
	for fBar in 'False', 'True':
		values = [np.array(value) for name, value in result.items() if name.endswith(fBar)]
		assert len(values) == 5 and (values[0] > 0).all()
		assert all(np.allclose(value, values[0], rtol=1e-6) for value in values)


def test_ground_at_rest_stays_so(yade):
	result = yade(
	        scene + '''
cylinder(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(2, -inf, -inf), fix='x')], gravity=(0, -9.81, 0), gravityCurve=[(0, 1)])
mpm.geostatic()
O.step()
a = mpm.arrays()
print(json.dumps([abs(a['pos'] - a['pos0']).max(), a['stress'].tolist()]))
'''
	).result
	assert result[0] < 1e-9
	stress = np.array(result[1])
	assert np.allclose(stress[:, 2, 2], stress[:, 0, 0]) and np.allclose(stress[:, 0, 0], 0.3 / 0.7 * stress[:, 1, 1])


refused = {
        'cylinder(grid=MpmGrid(cellSize=0.5, dim=3, axisymmetric=True)); O.step()': ('ValueError', 'MpmGrid.axisymmetric', 'dim=2'),
        'cylinder(grid=MpmGrid(cellSize=0.5, origin=(0.1, 0, 0), axisymmetric=True)); O.step()': ('ValueError', 'grid line', '0.2 cells'),
        'cylinder(grid=MpmGrid(cellSize=0.5, period=(2, 0, 0), axisymmetric=True)); O.step()': ('ValueError', 'radius x cannot repeat'),
        'cylinder(from_=-1)': ('ValueError', 'fill', 'x = -0.875', 'distance from the axis'),
        'cylinder(gravity=(1, -9.81, 0)); O.step()': ('ValueError', 'gravity', 'x component', 'along the axis'),
        'cylinder(); O.bodies[0].state.pos = O.bodies[0].state.refPos = (-0.125, 0.125, 0); O.step()': ('ValueError', 'Body #0', 'not at x > 0'),
        'cylinder(); O.bodies[0].state.pos = O.bodies[0].state.refPos = (0.1, 0.125, 0); O.step()': ('ValueError', 'Body #0', 'crosses the axis', 'halfSize'),
        'cylinder(grid=MpmGrid(cellSize=0.5)); solver.grid = MpmGrid(cellSize=0.5, axisymmetric=True); O.step()': ('ValueError', 'stands for a ring', 'another grid'),
        "cylinder(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy', displacement=(1, 0, 0))]); O.step()": ('ValueError', 'displacement', 'axis'),
        'cylinder(boundaries=[]); O.step()': ('RuntimeError', 'translation along y'),
        "cylinder(grid=MpmGrid(cellSize=0.5), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')]); O.engines += [MpmVtkRecorder(fileName='x', sectors=8)]; O.step()":
        ('ValueError', 'MpmVtkRecorder.sectors', 'axisymmetric'),
        'MpmVtkRecorder(sectors=2)': ('ValueError', 'sectors', '>= 3'),
}


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('refused'), scene, list(refused))


@pytest.mark.parametrize('statement', refused)
def test_refused(outcomes, statement):
	kind, text = outcomes[statement]
	expected, *parts = refused[statement]
	assert kind == expected and all(part in text for part in parts), (kind, text)
