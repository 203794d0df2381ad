# SPDX-License-Identifier: GPL-2.0-or-later
"""Files for ParaView, read back with VTK: what they hold, which states they hold, and what happens when they cannot be written."""
import xml.etree.ElementTree as xml
from itertools import product

import numpy as np
import pytest
from conftest import Yade
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtu import Vtu


def series(path):
	"""Iteration and time of the files that a .pvd lists; each file must exist, with the same time in it."""
	entries = []
	for entry in xml.parse(path).getroot().iter('DataSet'):
		file = path.parent / entry.get('file')
		assert file.name.startswith(path.stem + '.')
		assert Vtu(file).times == [float(entry.get('timestep'))]
		entries.append((int(file.suffixes[-2][1:]), float(entry.get('timestep'))))
	return entries


def iterations(path, dt=1 / 40):
	"""Iterations of a series whose states are one load step of *dt* an iteration apart."""
	entries = series(path)
	assert [time for _, time in entries] == pytest.approx([iteration * dt for iteration, _ in entries], abs=1e-12)
	return [iteration for iteration, _ in entries]


def equal(fields, arrays):
	"""Compares the cell data of a 'points' file with mpm.arrays(), to the last bit where nothing is computed."""
	mean = np.trace(arrays['stress'], axis1=1, axis2=2) / 3
	deviator = arrays['stress'] - mean[:, None, None] * np.eye(3)
	assert set(fields) == {'displacement', 'stress', 'defGrad', 'strain', 'elasticStrain', 'meanStress', 'sqrt2J2', 'plasticStrain', 'volume', 'material', 'clamped', 'id'}
	assert all(np.isfinite(field).all() for field in fields.values())
	assert np.array_equal(fields['displacement'], arrays['pos'] - arrays['pos0'])
	for name in 'stress', 'defGrad', 'elasticStrain':
		assert np.array_equal(fields[name].reshape(-1, 3, 3), arrays[name])
	b = arrays['defGrad'] @ arrays['defGrad'].transpose(0, 2, 1)
	values, axes = np.linalg.eigh(b)
	assert fields['strain'].reshape(-1, 3, 3) == pytest.approx(np.einsum('pik,pk,pjk->pij', axes, np.log(values) / 2, axes), abs=1e-12)
	assert fields['meanStress'] == pytest.approx(mean, rel=1e-13)
	assert fields['sqrt2J2'] == pytest.approx(np.linalg.norm(deviator, axis=(1, 2)), rel=1e-13)
	return all(np.array_equal(fields[name], arrays[name]) for name in ('plasticStrain', 'volume', 'material', 'id'))


@pytest.fixture(scope='module')
def yielded(tmp_path_factory):
	"""Folder with files of the slope when it has yielded, with a body among the points that is none, in all formats."""
	folder = tmp_path_factory.mktemp('yielded')
	Yade(folder)(
	        '''
from scenes import *
O.bodies.append(utils.sphere((0, 20, 0), 1, material=FrictMat()))
slope(steps=4)
for format in dict(ascii=True), dict(compress=False), dict(compress=True):
	O.engines += [MpmVtkRecorder(fileName='{}-{}/slope-'.format(*list(format.items())[0]), iterPeriod=4, **format)]
O.run(4, wait=True)
np.savez('arrays.npz', **mpm.arrays())
'''
	)
	return folder


@pytest.mark.parametrize('format', ['ascii-True', 'compress-False', 'compress-True'])
def test_points(yielded, format):
	arrays = np.load(yielded / 'arrays.npz')
	path = yielded / format / 'slope-points.4.vtu'
	file, text = Vtu(path), path.read_bytes()
	assert (b'format="ascii"' in text) == (format == 'ascii-True')
	assert (b'compressor=' in text) == (format != 'compress-False')
	assert len(file) == len(arrays['id']) == 1095
	assert file.types == {9} # VTK_QUAD
	assert arrays['plasticStrain'].max() > 0.1 and set(arrays['material']) == {0, 1} and arrays['id'][0] == 1
	assert equal(file.fields, arrays)
	corners = np.stack([arrays['pos'] - arrays['halfSize'] * (1, 1, 0), arrays['pos'] + arrays['halfSize'] * (1, 1, 0)], axis=1)
	assert np.array_equal(file.boxes, corners)
	assert file.sizes('Area') == pytest.approx(4 * arrays['halfSize'][:, 0] * arrays['halfSize'][:, 1], rel=1e-9)


def test_three_dimensions(yade):
	yade('''
from scenes import *
column(4, dim=3)
O.engines += [MpmVtkRecorder(fileName='column-', recorders=['all'])]
O.run(3, wait=True)
np.savez('arrays.npz', **mpm.arrays())
''')
	arrays = np.load(yade.folder / 'arrays.npz')
	points, grid, faces = (Vtu(yade.folder / f'column-{kind}.3.vtu') for kind in ('points', 'grid', 'ghostFaces'))
	assert equal(points.fields, arrays)
	assert points.types == grid.types == {12} # VTK_HEXAHEDRON
	assert points.sizes('Volume') == pytest.approx(8 * arrays['halfSize'].prod(axis=1), rel=1e-9)
	assert np.array_equal(points.boxes, np.stack([arrays['pos'] - arrays['halfSize'], arrays['pos'] + arrays['halfSize']], axis=1))
	# walls all around but above: only the topmost cell is a boundary cell, and only the face below it is stabilised
	assert grid.sizes('Volume') == pytest.approx(np.full(4, 12.5**3))
	assert list(grid.fields['boundary'][np.argsort(grid.boxes[:, 0, 1])]) == [0, 0, 0, 1]
	assert faces.types == {9} and faces.sizes('Area') == pytest.approx([12.5**2])
	assert np.array_equal(faces.boxes, [[[0, 37.5, 0], [12.5, 37.5, 12.5]]])
	assert faces.fields['ghostStiffness'] == pytest.approx([1e-2 * 1e4 * 12.5 / 3])


def populated(arrays, h):
	"""Cells that a domain overlaps, by their lower corner, in front of the walls of the slope."""
	reach = arrays['halfSize'][:, :2] * (1 - 1e-7)
	low, high = (np.floor((arrays['pos'][:, :2] + side * reach) / h).astype(int) for side in (-1, 1))
	cells = {cell for a, b in zip(low, high) for cell in product(*(range(i, j + 1) for i, j in zip(a, b)))}
	return {(i, j) for i, j in cells if 0 <= i < 30 / h and j >= 0}


def test_grid_and_ghost_faces_are_those_of_the_state_in_the_file(yade):
	"""Found anew from the written points; after large displacements the step began with other ones."""
	h = 0.5
	yade(
	        f'''
from scenes import *
slope(cellSize={h}, steps=4, scaling='paper')
O.engines += [MpmVtkRecorder(fileName='slope-', iterPeriod=4, recorders=['grid', 'ghostFaces'])]
O.run(3, wait=True)
np.savez('before.npz', **mpm.arrays())
O.run(1, wait=True)
np.savez('arrays.npz', **mpm.arrays())
'''
	)
	before, arrays = (np.load(yade.folder / f'{name}.npz') for name in ('before', 'arrays'))
	cells = populated(arrays, h)
	assert cells != populated(before, h)

	def isBoundary(i, j):
		neighbours = {(i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)}
		behindWalls = {(-1, j), (int(30 / h), j), (i, -1)}
		return bool(neighbours - behindWalls - cells)

	grid, faces = (Vtu(yade.folder / f'slope-{kind}.4.vtu') for kind in ('grid', 'ghostFaces'))
	corner = [tuple(c) for c in np.rint(grid.boxes[:, 0, :2] / h).astype(int).tolist()]
	assert len(corner) == len(cells) and set(corner) == cells
	assert list(grid.fields['boundary']) == [isBoundary(*c) for c in corner]
	assert np.allclose(grid.boxes[:, 1] - grid.boxes[:, 0], (h, h, 0), atol=1e-12)

	ends = {tuple(e) for e in np.rint(faces.boxes[:, :, :2].reshape(-1, 4) / h).astype(int).tolist()}
	upright = {(i, j, i, j + 1) for i, j in cells if (i - 1, j) in cells and (isBoundary(i, j) or isBoundary(i - 1, j))}
	level = {(i, j, i + 1, j) for i, j in cells if (i, j - 1) in cells and (isBoundary(i, j) or isBoundary(i, j - 1))}
	assert len(faces) == len(ends) and ends == upright | level
	assert faces.types == {3} # VTK_LINE
	assert faces.fields['ghostStiffness'] == pytest.approx(np.full(len(faces), 1e-2 * 1e6 * h**3 / 3)) # eq. 2
	assert Vtu(yade.folder / 'slope-grid.0.vtu').times == [0]
	assert not list(yade.folder.glob('slope-points*'))


def test_ghost_stiffness_is_that_of_the_softer_cell_beside_the_face(yade):
	"""Two cells, one three times as stiff as the other; without stabilisation there are no faces."""
	yade('''
from scenes import *
O.materials.append(MpmElasticMat(young=3, poisson=0, density=1, label='stiff'))
solver = block(0)
for body in O.bodies:
	if body.state.pos[0] > 1: body.material = O.materials['stiff']
recorder = MpmVtkRecorder(fileName='with-', recorders=['ghostFaces'])
O.engines += [recorder]
recorder()
solver.ghost = MpmGhost(factor=0)
recorder.fileName = 'without-'
recorder()
''')
	faces = Vtu(yade.folder / 'with-ghostFaces.0.vtu')
	assert np.array_equal(faces.boxes, [[[1, 0, 0], [1, 1, 0]]])
	assert faces.fields['ghostStiffness'] == pytest.approx([1e-2 * 1 / 3])  # stiffness of the softer cell
	assert len(Vtu(yade.folder / 'without-ghostFaces.0.vtu')) == 0


recorded = '''
from scenes import *
solver = column(8)
recorder = MpmVtkRecorder(fileName='column-', iterPeriod=10)
O.engines = [recorder, solver] if %s else [solver, recorder]
'''


@pytest.mark.parametrize('first', [False, True])
def test_series_has_the_initial_state_every_tenth_and_the_last(yade, first):
	"""Wherever the recorder stands: at the end of O.run(n), and when the script ends after single steps."""
	run = yade(
	        recorded % first + '''
O.run(25, wait=True)
assert O.iter == 25
states = [[time for _, time in recorder.written]]
O.run(5, wait=True)
states.append([time for _, time in recorder.written])
O.step()
O.step()
np.savez('arrays.npz', **mpm.arrays())
print(states)
'''
	)
	assert iterations(yade.folder / 'column-points.pvd') == [0, 10, 20, 25, 30, 32]
	assert [len(times) for times in run.result] == [4, 5]
	assert equal(Vtu(yade.folder / 'column-points.32.vtu').fields, np.load(yade.folder / 'arrays.npz'))
	assert len(list(yade.folder.glob('column-*'))) == 6 + 1 # neither leftovers nor more than the list has


@pytest.mark.parametrize('end', ['', 'O.exitNoBacktrace()', 'O.run()'])
def test_last_state_is_written_however_the_script_ends(yade, end):
	yade(recorded % False + f'O.run(11, wait=True)\nO.step()\nO.step()\n{end}')
	written = iterations(yade.folder / 'column-points.pvd')
	if end == 'O.run()': # in the background, and nobody knows how far
		assert written[:3] == [0, 10, 11] and written[-1] >= 13
	else:
		assert written == [0, 10, 11, 13]


def test_last_state_is_written_when_the_script_fails(yade):
	yade(recorded % False + 'O.step()\nO.step()\nO.nonsense', fails=True)
	assert iterations(yade.folder / 'column-points.pvd') == [0, 2]


def test_a_state_that_was_loaded_is_not_written_unless_it_moves(yade):
	yade(recorded % False + 'O.step()\nO.step()\nO.save("two.yade.gz")')
	for file in yade.folder.glob('column-*'):
		file.unlink()
	yade('O.load("two.yade.gz")')
	assert not list(yade.folder.glob('column-*'))


failing = '''
from scenes import *
slope()
solver.newton.maxIterations = 2 # the elastic steps at the beginning need no more, those near failure do
recorder = MpmVtkRecorder(fileName='slope-', iterPeriod=1000)
O.engines = [recorder, solver] if %s else [solver, recorder]
'''


@pytest.mark.parametrize('first, call', [(False, 'O.run(40, wait=True)'), (True, '[O.step() for i in range(40)]')])
def test_when_a_step_fails_the_last_converged_state_is_written(yade, first, call):
	yade(
	        failing % first + f'''
solver.newton.minStep = 1 # no cutting
try:
	{call}
finally:
	np.savez('arrays.npz', **mpm.arrays(), iteration=O.iter, time=solver.loadTime)
''',
	        fails=True
	)
	arrays = np.load(yade.folder / 'arrays.npz')
	assert 0 < arrays['iteration'] < 40
	assert series(yade.folder / 'slope-points.pvd') == [(0, 0), (arrays['iteration'], arrays['time'])]
	assert equal(Vtu(yade.folder / f'slope-points.{arrays["iteration"]}.vtu').fields, arrays)


def test_when_a_step_fails_the_part_of_it_that_converged_is_written_until_it_is_repeated(yade):
	run = yade(
	        failing % False + '''
import json
recorder.iterPeriod = 1
try:
	O.run(40, wait=True)
except RuntimeError:
	failedAt, part, partial = O.iter, solver.loadTime / O.dt - O.iter, recorder.written[-1]
solver.newton.maxIterations = 20
O.run(2, wait=True)
print(json.dumps([failedAt, part, partial]))
'''
	)
	failedAt, part, (file, time) = run.result
	assert 0 < part < 1 and time / (1 / 40) == pytest.approx(failedAt + part, rel=1e-12)
	assert file == f'slope-points.{failedAt + 1}.vtu'
	assert iterations(yade.folder / 'slope-points.pvd') == list(range(failedAt + 3))


def test_periods(yade):
	"""Periods of load time, counted with a tolerance; without the first; a limited number; late; not at all while dead."""
	yade(
	        '''
from scenes import *
column(8)
settings = {
        'virtual': dict(iterPeriod=0, virtPeriod=0.1), 'later': dict(iterPeriod=10, initRun=False), 'limited': dict(iterPeriod=2, nDo=3),
        'from5': dict(iterPeriod=10, firstIterRun=5), 'dead': dict(dead=True), 'standard': {}}
O.engines += [MpmVtkRecorder(fileName=name + '-', **values) for name, values in settings.items()]
O.run(17, wait=True)
'''
	)
	expected = {
	        'virtual': [0, 4, 8, 12, 16, 17],
	        'later': [10, 17],
	        'limited': [0, 2, 4],
	        'from5': [5, 15, 17],
	        'standard': list(range(18)),
	}
	assert {name: iterations(yade.folder / f'{name}-points.pvd') for name in expected} == expected
	assert not list(yade.folder.glob('dead-*'))


def test_loaded_scene_continues_the_series(yade):
	yade(recorded % False + 'O.run(15, wait=True)\nO.save("half.xml.gz")\nO.run(7, wait=True)')
	assert iterations(yade.folder / 'column-points.pvd') == [0, 10, 15, 20, 22]
	yade('O.load("half.xml.gz")\nO.run(10, wait=True)')
	assert iterations(yade.folder / 'column-points.pvd') == [0, 10, 15, 20, 25]


def test_time_set_back_begins_the_series_anew(yade):
	yade(recorded % False + '''
recorder.iterPeriod = 2
O.run(6, wait=True)
O.resetTime()
solver.loadTime = 0
O.run(3, wait=True)
''')
	assert iterations(yade.folder / 'column-points.pvd') == [0, 2, 3]


def test_a_solver_with_a_period_of_its_own(yade):
	"""Files as among grains: a state that has not changed is not written again, and the last one is there when O.run(n) ends."""
	expected = {7: [0, .001, .011, .021, .031, .041], 100: [0, .021, .041]}
	run = yade(
	        f'''
from scenes import *
solver = column(8)
recorders = [MpmVtkRecorder(fileName=f'every{{period}}-', iterPeriod=period) for period in {list(expected)}]
O.engines = [solver, *recorders]
solver.iterPeriod, O.dt = 10, 1e-3
O.run(24, wait=True)
O.run(24, wait=True)
print([[time for _, time in recorder.written] for recorder in recorders])
'''
	)
	for (period, times), written in zip(expected.items(), run.result, strict=True):
		assert written == pytest.approx(times, rel=1e-12)
		assert [time for _, time in series(yade.folder / f'every{period}-points.pvd')] == written


blocked = '''
from scenes import *
column(8)
O.engines += [MpmVtkRecorder(fileName='script.py/column-')]
'''


@pytest.mark.parametrize('call', ['O.step()', 'O.run(3, wait=True)'])
def test_a_folder_that_cannot_be_written_to_ends_the_script(yade, call):
	run = yade(blocked + call, fails=True)
	assert run.exitCode == 1
	assert 'cannot write file script.py/column-points.0.vtu: its folder cannot be created (Not a directory)' in run.stderr


def test_a_file_that_cannot_be_finished_leaves_no_trace_and_can_be_repeated(yade):
	"""A limit on the size of files takes the place of a full disk."""
	run = yade(
	        '''
import json, os, resource
from scenes import *
column(64)
recorder = MpmVtkRecorder(fileName='out/column-')
O.engines += [recorder]
O.run(2, wait=True)
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY))
message = ''
try:
	O.step()
except RuntimeError as error:
	message = str(error)
left = sorted(os.listdir('out'))
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
O.run(2, wait=True)
print(json.dumps([message, left]))
'''
	)
	message, left = run.result
	assert message == 'cannot write file out/column-points.3.vtu: File too large.'
	assert left == [f'column-points.{i}.vtu' for i in (0, 1, 2)] + ['column-points.pvd']
	assert iterations(yade.folder / 'out/column-points.pvd') == [0, 1, 2, 3, 4]
	assert 'vtk' not in run.stderr.replace('column-points.3.vtu', '') # words of that library for the same


def test_a_file_that_fails_while_the_run_goes_on_ends_it(yade):
	"""Files are written beside the next step."""
	run = yade(
	        '''
import json, os, resource, time
from scenes import *
column(64)
recorder = MpmVtkRecorder(fileName='out/column-')

def fill():
	while 'points.1.vtu' not in open('out/column-points.pvd').read(): time.sleep(0.01) # until the file before is complete
	resource.setrlimit(resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY))

O.engines += [PyRunner(iterPeriod=1, initRun=True, command='if O.iter == 1: fill()'), recorder]
message = ''
try:
	O.run(8, wait=True)
except RuntimeError as error:
	message = str(error)
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
print(json.dumps([message, O.iter, sorted(os.listdir('out')), [file for file, time in recorder.written]]))
'''
	)
	message, reached, left, written = run.result
	assert message == 'cannot write file out/column-points.2.vtu: File too large.'
	assert reached <= 4
	assert left == ['column-points.0.vtu', 'column-points.1.vtu', 'column-points.pvd']
	assert written == ['out/column-points.0.vtu', 'out/column-points.1.vtu']


mistakes = {
        "MpmVtkRecorder(recorders=['points', 'spheres'])": (
                ValueError, "MpmVtkRecorder.recorders = ('points', 'spheres') is not admitted: expected one or more of 'points', 'grid', 'ghostFaces', 'loads', 'walls', 'contacts' and 'all'"
        ),
        'MpmVtkRecorder(recorders=[])': (ValueError, 'MpmVtkRecorder.recorders = () is not admitted'),
        "MpmVtkRecorder(recorders='points')": (TypeError, "MpmVtkRecorder.recorders = 'points': expected a sequence"),
        "MpmVtkRecorder(fileName='')": (ValueError, "MpmVtkRecorder.fileName = '' is not admitted"),
        'record()': (ValueError, "MpmVtkRecorder.fileName = '' is not admitted"),
        "record(fileName='x-', solver='other')": (ValueError, "O.engines holds none labelled 'other', as the attribute solver says"),
        "O.engines = [MpmVtkRecorder(fileName='x-')]; O.step()": (ValueError, 'follows one MpmImplicitEngine, and O.engines holds none'),
        "O.engines += [MpmImplicitEngine(grid=solver.grid, label='second')]; record(fileName='x-')":
                (ValueError, 'O.engines holds 2. Label them, and give the label of one as solver'),
        r"MpmVtkRecorder(fileName='x-\nline-')": (ValueError, r"MpmVtkRecorder.fileName = 'x-\nline-' is not admitted: expected the start of the files' names, as in 'out/slope-', without line breaks"),
        r"MpmVtkRecorder(fileName='x-\x7f')": (ValueError, 'other control characters'),
        "O.engines += [MpmVtkRecorder(fileName='./x-', recorders=['grid', 'points'])]; record(fileName='x-')":
                (ValueError, "MpmVtkRecorder.fileName = 'x-': another MpmVtkRecorder among O.engines writes the same files, "),
        "os.symlink('.', 'same'); O.engines += [MpmVtkRecorder(fileName='same/x-', recorders=['all'])]; record(fileName='x-', recorders=['ghostFaces'])":
                (ValueError, 'x-ghostFaces.*, so that one would replace the other'),
        "O.engines += [MpmVtkRecorder(fileName='x-'), MpmVtkRecorder(fileName='x-', iterPeriod=2)]; O.step()": (ValueError, 'Give each a fileName of its own'),
        "O.bodies[3].state.pos = (nan, 0, 0); record(fileName='x-')": (ValueError, 'Body #3: MpmState.pos'),
}


def test_mistakes(yade):
	run = yade(
	        f'''
import json, os
from math import nan
from scenes import *
messages = []
for mistake in {list(mistakes)}:
	O.reset()
	solver = column(4)
	def record(**settings):
		O.engines += [MpmVtkRecorder(**settings)]
		O.engines[-1]()
	try:
		exec(mistake)
		messages.append('')
	except Exception as error:
		messages.append(type(error).__name__ + ': ' + str(error))
print(json.dumps(messages))
'''
	)
	for (mistake, (kind, text)), message in zip(mistakes.items(), run.result, strict=True):
		assert message.startswith(kind.__name__) and text in message, (mistake, message)
	assert not list(yade.folder.glob('x-*'))


def test_recorders_may_share_a_name_if_their_files_differ(yade):
	"""Files differ by kind, or only one of the recorders is alive."""
	yade('''
from scenes import *
column(4)
O.engines += [MpmVtkRecorder(fileName='x-', recorders=['points']), MpmVtkRecorder(fileName='x-', recorders=['grid']), MpmVtkRecorder(fileName='x-', dead=True)]
O.run(2, wait=True)
''')
	assert iterations(yade.folder / 'x-points.pvd') == iterations(yade.folder / 'x-grid.pvd') == [0, 1, 2]


def test_a_solver_is_chosen_by_its_label(yade):
	yade('''
from scenes import *
solver = column(4)
O.engines += [MpmImplicitEngine(grid=solver.grid, label='idle', dead=True), MpmVtkRecorder(fileName='column-', solver='solver', recorders=['all'])]
O.run(2, wait=True)
''')
	for kind in ('points', 'grid', 'ghostFaces'):
		assert iterations(yade.folder / f'column-{kind}.pvd') == [0, 1, 2]


def test_chosen_fields(yade):
	yade(
	        '''
from scenes import *
solver = slope()
O.engines += [MpmVtkRecorder(fileName='all-'), MpmVtkRecorder(fileName='few-', fields=['displacement', 'stress']), MpmVtkRecorder(fileName='none-', fields=[])]
O.step()
try: O.engines[1].fields = ['displacment']
except ValueError as error: assert "'displacment'" in str(error) and 'plasticStrain' in str(error)
else: raise AssertionError('accepted')
'''
	)
	every, few, none = (Vtu(yade.folder / f'{name}-points.0.vtu') for name in ('all', 'few', 'none'))
	assert set(few.fields) == {'displacement', 'stress'} and not none.fields
	assert len(every) == len(few) == len(none) == 1095
	assert np.array_equal(few.fields['stress'], every.fields['stress'])


def test_yades_own_writers(yade):
	"""VTKRecorder and export.VTKExporter know material points as spheres."""
	yade(
	        '''
from scenes import *
from yade import export
solver = slope()
O.engines += [VTKRecorder(fileName='yade-', recorders=['spheres', 'colors', 'materialId'], iterPeriod=1, initRun=True)]
O.run(2, wait=True)
mpm.colour('displacement')
export.VTKExporter('exported').exportSpheres(what=dict(sxy='b.state.stress[0, 1]', plastic='b.state.plasticStrain', u='b.state.displ()'))
points = mpm.arrays()
np.savez('points.npz', **points)
'''
	)
	points = np.load(yade.folder / 'points.npz')
	spheres = Vtu(max(yade.folder.glob('yade-spheres.*.vtu'))).cells
	data = spheres.GetPointData()
	assert np.allclose(vtk_to_numpy(spheres.GetPoints().GetData()), points['pos'], atol=1e-6)  # single precision
	assert np.allclose(vtk_to_numpy(data.GetArray('radii')), 0.25) and np.array_equal(vtk_to_numpy(data.GetArray('materialId')), points['material'])
	lines = next(yade.folder.glob('exported-spheres-*.vtk')).read_text().split()
	assert int(lines[lines.index('POINTS') + 1]) == 1095
	first = lines.index('sxy')
	assert np.allclose(np.array(lines[first + 5:first + 5 + 1095], dtype=float), points['stress'][:, 0, 1])
