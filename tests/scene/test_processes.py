# SPDX-License-Identifier: GPL-2.0-or-later
"""Several processes on one scene (scripts/run -n): the states of one process, files of the first one, and no process that outlives another's failure."""
import json
import re

import numpy as np
import pytest
from conftest import Yade, root

scenes = root / 'examples' / 'benchmarks' / 'shared.py'
names = 'slope2', 'slope3', 'friction', 'contact', 'dynamics', 'collapse', 'splitting'

setting = '''
import json
import os
from scenes import *
from yade.mpm import processes
rank = int(os.environ.get('OMPI_COMM_WORLD_RANK', 0))
'''


@pytest.fixture(scope='module', autouse=True)
def petsc(tmp_path_factory):
	"""Skips where the plugin was built without PETSc."""
	absence = Yade(tmp_path_factory.mktemp('petsc'))("import json\nfrom yade.mpm.library import engine\nprint(json.dumps(engine.multigridAbsence()))").result
	if absence: pytest.skip('without PETSc: ' + absence)


def found(run):
	"""The results and positions by scene."""
	with np.load(run.folder / 'out.npz') as file:
		positions = dict(file)
	return json.loads(str(positions.pop('measured'))), positions


def test_two_processes_come_to_the_states_of_one(yade):
	"""Von Mises' slope in the plane and in 3D, friction (K not symmetric), contact with pushed sides, a thrown block, a column in time, and points that are split; by each method."""
	results, alone = found(yade(scenes, 'out.npz', *names))
	together = lambda method, *these, **how: found(yade(scenes, 'out.npz', 'linearSolver=' + method, *these, processes=2, **how))
	methods = dict(iterative=together('iterative', *names), amg=together('amg', 'slope3', 'friction', threads=2), direct=together('direct', 'slope2', 'friction', 'contact', 'dynamics'))
	for method, (together, positions) in methods.items():
		for name in positions:
			difference = np.abs(positions[name] - alone[name]).max()
			assert difference < 1e-8, (method, name, difference)
			one, (first, second) = results[name][0], together[name]
			same = 'points', 'solves', 'iterations', 'fallbacks'
			assert [first[key] for key in same] == [second[key] for key in same]
			assert first['fallbacks'] == 0 and first['sent'] > 0 < second['sent'] and one['sent'] == 0
			assert (first['iterations'] > 0) == (method != 'direct')
			assert 'agree' in first['parts'] and 'agree' not in one['parts']
	solves, iterations = (methods['iterative'][0]['slope3'][0][key] for key in ('solves', 'iterations'))
	assert (solves, iterations) == (results['slope3'][0]['solves'], results['slope3'][0]['iterations']), 'conjugate gradients do the same'


def test_points_in_pieces_come_to_the_states_of_one(yade):
	"""Each process with its own points: von Mises' slope in the plane and in 3D, friction, F-bar, a pushed block whose points change the process; loaded surfaces, an axis of symmetry,
	walls off the grid, contact, a period, water."""
	names = 'slope2', 'slope3', 'friction', 'incompressible', 'pushed', 'loaded', 'ring', 'walls', 'rubbing', 'periodic', 'wet'
	results, alone = found(yade(scenes, 'out.npz', *names))
	for processes in 2, 3:
		together, positions = found(yade(scenes, 'out.npz', 'distributed', *names, processes=processes))
		for name in names:
			assert np.abs(positions[name] - alone[name]).max() < 1e-8, (name, processes)
			assert together[name][0]['points'] == results[name][0]['points']
			if name not in ('rubbing', 'wet'): # K is not symmetric: GMRES of one process has another preconditioner, and ends elsewhere below its tolerance
				assert together[name][0]['solves'] == results[name][0]['solves'], (name, processes)
			forces = [of['results'] for of in together[name]]
			assert all(of == forces[0] for of in forces), (name, 'the same in all processes, to the last bit')
			assert np.allclose(forces[0], results[name][0]['results'], rtol=0, atol=1e-9 * np.abs(forces[0]).max()), (name, processes)


pieces = setting + '''
import numpy as np
solver = slope(2.0)
solver.distributed, solver.newton.tolerance, solver.newton.linearSolver = True, 1e-10, 'iterative'
'''


def test_pieces_are_saved_and_loaded_in_any_number_of_processes(yade):
	"""Each process holds a part of the bodies; arrays are of all, columns of a law that one process alone knows, too. Two processes save, three, one and two go on."""
	run = yade(
	        pieces + '''
O.materials.append(MpmCamClayMat(density=2000, shearModulus=1e6, criticalStateRatio=1, compressionIndex=.1, swellingIndex=.02, preconsolidation=1e6, referencePressure=1e3, label='clay'))
filled = len(mpm.arrays()['id'])
top = [body for body in O.bodies if body.state.pos[1] > 11]
for body in top:
	body.material = O.materials[-1]
mpm.assign(ids=[body.id for body in top], stress=[-2e4 * np.eye(3)] * len(top))
O.engines += [MpmVtkRecorder(fileName='vtk/slope', iterPeriod=2, solver='solver')]
O.run(2, wait=True)
mpm.save('half.yade.gz')
own = len([body for body in O.bodies if body])
try:
	O.save('plain.yade.gz')
	said = ['']
except RuntimeError as error:
	said = [str(error)]
for wrong in (lambda: mpm.assign(pos=mpm.arrays()['pos']), solver.conditionNumber):
	try:
		wrong()
	except ValueError as error:
		said.append(str(error))
O.run(3, wait=True)
points = mpm.arrays()
with open(f'process{rank}.json', 'w') as file:
	json.dump([filled, own, said, sorted(points), points['pos'].tolist(), points['id'].tolist(), solver.plotData()['settlement'], solver.report()['points']], file)
''', processes=2
	)
	first, second = (json.loads((run.folder / f'process{rank}.json').read_text()) for rank in (0, 1))
	filled, own, said, columns, pos, ids, settlement, points = first
	assert first[3:] == second[3:] and filled == second[0] == own + second[1] == len(ids) == points and 0 < own < filled and ids == sorted(ids)
	assert 'preconsolidation' in columns and np.isclose(settlement, settlement)
	assert 'mpm.save' in said[0] and 'distributed' in said[1] and 'distributed' in said[2] and not (run.folder / 'plain.yade.gz').exists()
	files = {path.name for path in (run.folder / 'vtk').iterdir()}
	assert files >= {'slopepoints.pvd', 'slopepoints.4.pvtu', 'slopepoints.4-0.vtu', 'slopepoints.4-1.vtu'}, files
	goesOn = setting + '''
import numpy as np
mpm.load('half.yade.gz')
O.run(3, wait=True)
pos = mpm.arrays()['pos']
if rank == 0: np.save('pos.npy', pos)
'''
	for processes in 3, 1, 2:
		yade(goesOn, processes=processes)
		assert np.abs(np.load(run.folder / 'pos.npy') - pos).max() < 1e-8, processes


def test_what_points_in_pieces_do_not_admit_is_named(yade):
	"""In all processes, and the scene stays as it was; other settings in one, a piece by itself, a failure of the step with the body's id."""
	run = yade(
	        pieces + '''
said = []
def tried():
	try:
		O.run(1, wait=True)
		said.append('')
	except (ValueError, RuntimeError) as error:
		said.append(str(error))
for name, value in dict(maxSplits=2, newton=MpmNewton(stepTolerance=1e-3)).items():
	before = getattr(solver, name)
	setattr(solver, name, value)
	tried()
	setattr(solver, name, before)
O.materials.append(FrictMat(frictionAngle=.3, density=2600, young=1e7, label='rigid'))
plate = O.bodies.append(utils.box((15, 20, 0), (1, 1, 1), material='rigid', fixed=True))
solver.contacts = [MpmContact()]
if rank == 1: O.bodies[plate].state.vel = (0, -1, 0)
tried()
O.bodies.erase(plate)
solver.contacts = []
mpm.assign(ids=[5], yieldStress=[2e4])
tried()
O.bodies[5].state.parameters = []
O.run(1, wait=True)
if rank == 1: solver.gravity *= 1.01
tried()
if rank == 1: solver.gravity /= 1.01
young = O.materials[0].young
if rank == 1: O.materials[0].young = 1.01 * young
tried()
O.materials[0].young = young
O.run(1, wait=True)
mpm.save('piece.yade')
before = mpm.arrays()['pos'].tolist()
solver.gravity *= 100
solver.newton.minStep = 1
tried()
said.append(mpm.arrays()['pos'].tolist() == before)
O.load(f'piece-{1 - rank}of2.yade')
tried()
with open(f'process{rank}.json', 'w') as file:
	json.dump(said, file)
''', processes=2
	)
	first, second = (json.loads((run.folder / f'process{rank}.json').read_text()) for rank in (0, 1))
	assert first[:-1] == [said.replace('Process 1 of 2 has failed: ', '') if isinstance(said, str) else said for said in second[:-1]] or first[:-1] == second[:-1], (first, second)
	for said, named in zip(first, ('maxSplits = 2', 'stepTolerance = 0.001', 'rigid bodies', 'a strength or modulus of its own (yieldStress)', 'settings', 'values of materials', 'failed: ')):
		assert named in said, (named, first)
	assert first[7] is True and 'mpm.load(file) puts together' in first[8]
	alone = yade("O.load('piece-0of2.yade')\nO.run(1, wait=True)\n", fails=True)
	assert 'mpm.load(file) puts together' in alone.stderr


def test_the_first_process_writes_files_and_all_have_the_arrays(yade):
	"""A recorder, pictures, tables and saves: of each file one writer, whose error is one of all. A save is there for all when it has been made."""
	run = yade(
	        setting + '''
solver = slope(2.0)
O.engines += [MpmVtkRecorder(fileName='vtk/slope', iterPeriod=1, solver='solver')]
written = []
import yade.mpm.files as files
replacing = files.replacing
def noted(file):
	written.append(file)
	return replacing(file)
files.replacing = noted
O.run(2, wait=True)
mpm.save('half.yade.gz')
O.save('plain.xml')
points = mpm.arrays()
try:
	mpm.save('/proc/no/such.xml')
	failed = ''
except OSError as error:
	failed = str(error)
O.load('half.yade.gz')
O.run(1, wait=True)
with open(f'process{rank}.json', 'w') as file:
	json.dump([len(points['id']), points['pos'].tolist(), written, failed, O.iter, mpm.arrays()['pos'].tolist()], file)
''', processes=2
	)
	(points, pos, written, failed, step, last), other = (json.loads((run.folder / f'process{rank}.json').read_text()) for rank in (0, 1))
	assert points == other[0] > 200 and pos == other[1] and last == other[5] and step == other[4] == 3
	assert written == ['half.yade.gz', '/proc/no/such.xml'] and other[2] == []
	assert '/proc/no' in failed and other[3] == failed
	assert (run.folder / 'plain.xml').exists() and list((run.folder / 'vtk').glob('*')) and not [p for p in run.folder.iterdir() if p.name.startswith('.')]
	assert run.stderr.count('step 2/2') == 1, 'one process tells of progress'


def test_a_failure_of_one_process_is_one_of_all(yade):
	"""Bad input in one, other points in one, other materials in one; the scene stays as it is, and goes on when all are alike again. Motion without strain is found by MUMPS."""
	run = yade(
	        setting + '''
solver = slope(2.0)
O.run(1, wait=True)
said = []
def tried():
	before = mpm.arrays()['stress'].tolist()
	try:
		O.run(1, wait=True)
	except RuntimeError as error:
		said.append(str(error))
	except ValueError as error:
		said.append(str(error))
	assert mpm.arrays()['stress'].tolist() == before and O.iter == 1
body = O.bodies[3]
place, young = body.state.pos, O.materials[0].young
if rank == 1: body.state.pos = (nan, 0, 0)
tried()
if rank == 1: body.state.pos = place + Vector3(1e-12, 0, 0)
tried()
if rank == 1: body.state.pos, O.materials[0].young = place, 1.01 * young
tried()
said.append(solver.report()['failure'])
if rank == 1: O.materials[0].young = young
O.run(1, wait=True)
O.reset()
grid = MpmGrid(cellSize=1)
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (6, 6, 1)), grid, 1, 'soil'))
rollers = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(max=(0, inf, inf), fix='x')]
solver = MpmImplicitEngine(grid=grid, basis='mpm', ghost=MpmGhost(factor=0), gravity=(0, -10, 0), boundaries=rollers, newton=MpmNewton(minStep=1))
O.engines, O.dt = [solver], .1
try:
	O.run(1, wait=True)
except RuntimeError as error:
	said.append(str(error))
with open(f'process{rank}.json', 'w') as file:
	json.dump(said, file)
''', processes=2
	)
	first, second = (json.loads((run.folder / f'process{rank}.json').read_text()) for rank in (0, 1))
	assert second[0].startswith('Body #3: MpmState.pos = (nan') and first[0] == 'Process 1 of 2 has failed: ' + second[0]
	for said in first, second:
		assert 'hold different material points in iteration 1' in said[1]
		assert 'have come to different states of the points' in said[2] and said[3] == 'apart'
		assert 'the stiffness matrix is singular to working precision' in said[4]


def test_an_error_of_the_script_and_a_kill_end_all_with_a_reason(yade):
	"""A script that fails in one process; one that ends before the other; one that is killed, after which the last save can be gone on with; YADE's own decomposition."""
	alone = yade(setting + '''
processes._grace = 1
solver = slope(2.0)
O.run(1, wait=True)
if rank == 1: raise ValueError('only here')
O.run(1, wait=True)
''', processes=2, fails=True)
	assert 'only here' in alone.stderr and 'process 1 of 2 has failed, and others go on without it: all are ended' in alone.stderr
	early = yade(setting + 'slope(2.0)\nO.run(1, wait=True)\nif rank == 0: O.run(1, wait=True)\n', processes=2, fails=True)
	assert 'process 0 cannot go on, and ends all: it is in a load step, and another process has come to the end of its script' in early.stderr
	killed = yade(
	        setting + '''
solver = slope(2.0)
for step in range(100):
	O.run(1, wait=True)
	mpm.save('last.yade.gz')
	if step == 2 and rank == 1: os.kill(os.getpid(), 9)
''', processes=2, fails=True
	)
	assert re.search(r'rank 1 .*signal 9', killed.stderr, re.DOTALL), killed.stderr  # OpenMPI 5 breaks the line
	assert yade("O.load('last.yade.gz')\nO.run(1, wait=True)\nprint(O.iter)").result >= 4
	split = yade(setting + 'from yade import mpy as mp\nslope(2.0)\nmp.mpirun(3)\n', processes=2, fails=True)
	assert 'yade.mpy.mpirun knows nothing of material points' in split.stderr


def test_without_the_library_one_sentence_says_what_to_do(yadeWithoutPetsc):
	"""In processes that mpirun has started."""
	run = yadeWithoutPetsc(setting + 'slope(2.0)\nO.run(1, wait=True)\n', processes=2, fails=True)
	assert 'mpirun has started 2 processes' in run.stderr and 'scripts/setup --with-petsc installs it' in run.stderr
