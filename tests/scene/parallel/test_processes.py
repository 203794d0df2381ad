# SPDX-License-Identifier: GPL-2.0-or-later
"""Several processes on one scene (scripts/run -n): the states of one process, files of the first one, and no process that outlives another's failure."""
import json
import re

import numpy as np
import pytest
from conftest import Yade, root

scenes = root / 'examples' / 'benchmarks' / 'shared.py'
names = 'slope2', 'slope3', 'friction', 'contact', 'dynamics', 'collapse', 'splitting', 'seeping'

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
	"""Von Mises' slope in the plane and in 3D, friction (K not symmetric), contact with pushed sides, a thrown block, a column in time, points that are split, and water that flows; by each method."""
	results, alone = found(yade(scenes, 'out.npz', *names))
	together = lambda method, *these, **how: found(yade(scenes, 'out.npz', 'linearSolver=' + method, *these, processes=2, **how))
	methods = dict(iterative=together('iterative', *names), amg=together('amg', 'slope3', 'friction', threads=2), direct=together('direct', 'slope2', 'friction', 'contact', 'dynamics', 'seeping'))
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
	walls off the grid, contact, a period, water; in time, by each way of steps, with their energies; load steps chosen by their error; points that are split, under the ids of one process, also where they touch a plate;
	a point by itself; strengths of points' own, stages of construction, a block that grows, gets other materials and is dug out."""
	static = 'slope2', 'lone', 'slope3', 'friction', 'incompressible', 'pushed', 'loaded', 'ring', 'walls', 'rubbing', 'periodic', 'wet', 'field', 'layers', 'changing'
	names = *static, 'dynamics', 'collapse', 'shaken', 'explicit', 'chosen', 'splitting', 'impact'
	results, alone = found(yade(scenes, 'out.npz', *names))
	for processes in 2, 3:
		together, positions = found(yade(scenes, 'out.npz', 'distributed', *names, processes=processes))
		for name in names:
			assert np.abs(positions[name] - alone[name]).max() < 1e-8, (name, processes)
			assert together[name][0]['points'] == results[name][0]['points']
			if name not in ('rubbing', 'wet', 'impact'): # K is not symmetric: GMRES of one process has another preconditioner, and ends elsewhere below its tolerance
				assert together[name][0]['solves'] == results[name][0]['solves'], (name, processes)
			first, *others = [each['told'] for each in together[name]]
			one = results[name][0]['told']
			energies = [key for key in one if 'Energy' in key or 'Work' in key]
			assert np.isclose([first[key] for key in energies], [one[key] for key in energies], rtol=0, atol=1e-9 * max(abs(one[key]) for key in energies)).all(), (name, processes)
			assert all(json.dumps(other) == json.dumps(first) for other in others)
			forces = [of['results'] for of in together[name]]
			assert all(of == forces[0] for of in forces), (name, 'the same in all processes, to the last bit')
			assert np.allclose(forces[0], results[name][0]['results'], rtol=0, atol=1e-9 * np.abs(forces[0]).max(initial=0)), (name, processes)


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
for wrong in solver.conditionNumber, mpm.advise, mpm.strengthReduction:
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
	assert 'mpm.save' in said[0] and len(said) == 4 and all('distributed' in text for text in said[1:]) and not (run.folder / 'plain.yade.gz').exists()
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


@pytest.mark.parametrize('isWhole', [False, True])
def test_water_goes_on_in_other_numbers_of_processes(yade, isWhole):
	"""Two processes that share a body from which water is pressed, or into which rain seeps, save it, or divide its points; one and three go on."""
	begin = '''
import json
import os
from yade import mpm
rank = int(os.environ.get('OMPI_COMM_WORLD_RANK', 0))
'''
	goesOn = '''
solver = O.engines[0]
O.run(2, wait=True)
points = mpm.arrays()
if rank == 0:
	with open('reached.json', 'w') as file:
		json.dump([points['pos'].tolist(), points["excessPressure"].tolist(), solver.flow.waterOut + solver.flow.waterIn, solver.flow.drains[0].discharge], file)
'''
	scene = '''
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, conductivity=1e-6, porosity=.4, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (10, 0), (10, 4), (0, 4)]), grid, 2, 'soil'))
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
load = MpmTraction(surface=[(4, 4), (0, 4)], pressure=2e4, curve=[(0, 1), (1, 1)])
O.engines = [MpmImplicitEngine(grid=grid, boundaries=held, loads=[load], loadCurve=[(0, 1), (1, 1)], flow=MpmFlow(drains=[MpmDrain(surface=[(10, 4), (0, 4)])]),
        newton=MpmNewton(tolerance=1e-11), verbosity=0)]
''' + isWhole * '''
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=1900, conductivity=2e-6, porosity=.4, retention=MpmGardner(alpha=.5), label='top'))
O.materials[0].retention = MpmVanGenuchten(alpha=1, n=2, residual=.1, voidExponent=2)
for body in O.bodies:
	if body.state.pos[1] > 3: body.material = O.materials[1]
mpm.assign(excessPressure=[1e4 * (1 - y) for y in mpm.arrays()['pos'][:, 1]])
ids = [body.id for body in O.bodies if body.material.label == 'top']
mpm.assign(ids=ids, alpha=[.3 + .04 * O.bodies[i].state.pos[0] for i in ids])
solver = O.engines[0]
solver.gravity, solver.flow = (0, -10, 0), MpmFlow(total=True, unitWeight=1e4, drains=[MpmDrain(surface=[(10, 4), (0, 4)], rain=1e-6)])
''' + '''
O.dt = 1e3
O.run(2, wait=True)
mpm.save('between.yade.gz')
'''
	run = yade(begin + scene + goesOn, processes=2)
	read = lambda: json.loads((run.folder / 'reached.json').read_text())
	positions, pressures, out, discharge = read()
	divided = scene.replace('verbosity=0', 'verbosity=0, distributed=True')
	for processes, script in ((2, divided), (1, '')) if isWhole else ((1, ''), (3, ''), (2, divided), (3, ''), (1, '')):
		yade(begin + (script or "mpm.load('between.yade.gz')\n") + goesOn, processes=processes)
		found = read()
		assert np.abs(np.subtract(found[0], positions)).max() < 1e-8
		assert np.abs(np.subtract(found[1], pressures)).max() < 1e-8 * 2e4 and abs(found[2] / out - 1) < 1e-8 and abs(found[3] / discharge - 1) < 1e-7


def test_motion_and_halves_are_saved_in_pieces(yade):
	"""Soft soil that hangs, swings on an edge that shakes and is split meanwhile: two processes save, three go on, to the state of one that has not stopped."""
	scene = setting + """
import numpy as np
O.materials.append(MpmElasticMat(young=2e4, poisson=.3, density=1000, label='soil'))
top = MpmBoundary(min=(-inf, 0, -inf), fix='xy', motion=MpmBaseMotion(history=[(0, 0), (.1, .5), (.2, -.5), (1, 0)], direction=(1, 0, 0)))
solver = MpmDynamicEngine(grid=MpmGrid(cellSize=1), gravity=(0, -9.81, 0), maxSplits=2, boundaries=[top], verbosity=0, distributed=True, rayleigh=(.2, 1e-3))
solver.newton.tolerance = 1e-10
O.bodies.append(mpm.fill(pack.inAlignedBox((0, -6, -1), (3, 0, 1)), solver.grid, 1, 'soil'))
O.engines, O.dt = [solver], .04
"""
	goesOn = """
O.run(4, wait=True)
points, data, isLeft = mpm.arrays(), O.engines[0].plotData(), len([body for body in O.bodies if body])
if rank == 0: json.dump([points['id'].tolist(), points['pos'].tolist(), points['velocity'].tolist(), data['energyImbalance'], data['kineticEnergy'], len(O.bodies), isLeft], open('end.json', 'w'))
"""
	run = yade(scene + 'O.run(8, wait=True)' + goesOn)
	ids, pos, velocity, imbalance, kinetic, bodies, isLeft = json.loads((run.folder / 'end.json').read_text())
	assert 18 < len(ids) == bodies == isLeft, 'points have been split'
	yade(scene + "O.run(8, wait=True)\nmpm.save('swing.yade.gz')\n", processes=2)
	yade(setting + "mpm.load('swing.yade.gz')\n" + goesOn, processes=3)
	end = json.loads((run.folder / 'end.json').read_text())
	assert end[0] == ids and np.abs(np.array(end[1]) - pos).max() < 1e-8 and np.abs(np.array(end[2]) - velocity).max() < 1e-7
	assert abs(end[3] - imbalance) < 1e-8 * kinetic and end[5] == bodies and end[6] < bodies


def test_each_process_makes_its_own_points_and_writes_to_them(yade):
	"""Ids are those of one process, arrays are complete from the beginning. Values go to whoever has the point; what one refuses is refused by all, and nothing is taken. Pictures, tables,
	histories and colours of points that no process has all of."""
	script = setting + '''
import numpy as np
O.materials.append(MpmMohrCoulombMat(young=1e6, poisson=.3, density=2000, cohesion=2e4, frictionAngle=.4, label='soil'))
solver = MpmImplicitEngine(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'),
	MpmBoundary(min=(20, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')], newton=MpmNewton(tolerance=1e-10, linearSolver='iterative'), distributed=True, verbosity=0)
said = []
def refused(f, *arguments, **options):
	try:
		f(*arguments, **options)
		said.append('')
	except (TypeError, ValueError, RuntimeError) as error:
		said.append(str(error))
box = lambda low, high: pack.inAlignedBox((0, low, -1), (20, high, 1))
refused(mpm.add, box(0, 4), solver, 2, 'soil')
O.engines, O.dt = [solver, MpmVtkRecorder(fileName='vtk/', iterPeriod=1)], .1
refused(mpm.add, box(0, 4), solver, 2, 'soil', cohesion=lambda x: -1)
if processes.count > 1: refused(mpm.add, box(0, 4 + rank), solver, 2, 'soil')
empty = len(O.bodies)
first = mpm.add(box(0, 4), solver, 2, 'soil', cohesion=lambda x: 2e4 + 100 * x[1])
second = mpm.add(box(4, 6), solver, 2, 'soil')
own = len([body for body in O.bodies if body])
points = mpm.arrays()
ids = [empty, first[0], first[-1], second[0], second[-1], points['id'].tolist() == list(range(len(O.bodies)))]
mpm.geostatic()
low, high = points['id'][0], points['id'][-1]
refused(mpm.assign, ids=[low, len(O.bodies)], cohesion=[1e4, 1e4])
beyond = 1e7 * np.diag([1, -1, 0])
for stresses in (0 * beyond, beyond, beyond), (0 * beyond, 0 * beyond, beyond):
	refused(mpm.assign, ids=[low, low + 1, high - 1], stress=stresses)
stress = mpm.arrays()['stress']
h = mpm.histories([(10, 5.7, 0), (10, .2, 0)], record=['displacement'])
O.run(2, wait=True)
if processes.count > 1: refused(mpm.assign, ids=[rank], force=[(0, 0, 0)])
mpm.assign(ids=second, force=[(0, -100., 0)] * len(second), frictionAngle=lambda x: .4 + .01 * x[0])
mpm.colour('cohesion')
mpm.plot('displacement', fileName='picture.png')
mpm.export('table.csv')
mpm.save(f'pieces{processes.count}.yade.gz')
O.run(1, wait=True)
after = mpm.arrays()
with open(f'process{rank}of{processes.count}.json', 'w') as file:
	json.dump([own, said, ids, stress.tolist(), after['pos'].tolist(), after['frictionAngle'].tolist(), h['displacement_y'].tolist(), solver.report()['points'], len(np.unique([body.shape.color for body in O.bodies if body])),
		mpm.stressError()['error']], file)
'''
	run = yade(script, processes=2)
	read = lambda rank, count: json.loads((run.folder / f'process{rank}of{count}.json').read_text())
	first, second = (read(rank, 2) for rank in (0, 1))
	table = (run.folder / 'table.csv').read_text()
	yade(script)
	alone = read(0, 1)
	assert first[1:8] == second[1:8] and first[0] + second[0] == alone[0] and 0 < first[0] < alone[0]
	assert first[2] == alone[2] and np.allclose(first[3], alone[3], rtol=1e-12) and first[7] == alone[7]
	for mine, theirs in zip(first[4:7], alone[4:7]):
		assert np.abs(np.array(mine) - theirs).max() < 1e-8
	assert min(first[8], second[8]) > 5 and np.isclose(first[9], alone[9])
	before, cohesion, different, missing, low, high, own = first[1]
	assert 'put it there before: O.engines = [solver]' in before and 'cohesion = -1' in cohesion and 'different material points' in different
	assert [before, cohesion, missing, low, high] == alone[1] and 'no material point with body id 480' in missing and 'Body #1:' in low and 'Body #478:' in high
	assert 'different ids' in own
	assert {'points.0.pvtu', 'points.0-0.vtu', 'points.0-1.vtu'} <= {path.name for path in (run.folder / 'vtk').iterdir()}
	assert (run.folder / 'picture.png').exists() and len(table.splitlines()) == 481
	goesOn = setting + "import numpy as np\nmpm.load('pieces2.yade.gz')\nO.run(1, wait=True)\npos = mpm.arrays()['pos']\nif rank == 0: np.save('pos.npy', pos)\n"
	for count in 3, 1:
		yade(goesOn, processes=count)
		assert np.abs(np.load(run.folder / 'pos.npy') - alone[4]).max() < 1e-8, count


def test_whatever_stops_one_process_in_adding_points_stops_all(yade):
	"""Also what is no refusal: the material of a point that only one of them has is not in the list. The scene is as it was, and goes on."""
	run = yade(
	        setting + '''
from yade.mpm.points.filling import _points
from yade.mpm.library import engine
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
solver = MpmImplicitEngine(grid=MpmGrid(cellSize=1), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], distributed=True, verbosity=0)
O.engines, O.dt, said = [solver], 1, []
points = _points(pack.inAlignedBox((0, 0, -1), (20, 4, 1)), solver.grid, 2, 'soil', {})
for wrong in 0, -1:
	index = points[3].copy()
	index[wrong] = 7
	try:
		engine.addPoints(solver, *points[:3], index, {})
	except Exception as error:
		said.append(type(error).__name__)
bodies = len(O.bodies)
engine.addPoints(solver, *points)
O.run(1, wait=True)
with open(f'process{rank}.json', 'w') as file:
	json.dump([said, bodies, len(mpm.arrays()['id'])], file)
''',
	        processes=2
	)
	first, second = (json.loads((run.folder / f'process{rank}.json').read_text()) for rank in range(2))
	assert first[1:] == second[1:] == [0, 320]
	assert len(first[0]) == len(second[0]) == 2


def test_another_engine_goes_on_with_points_in_pieces(yade):
	"""Inertia after a static stage, also when the scene has been saved in between; an engine that is to hold all points is refused."""
	stages = setting + """
import numpy as np
static = slope(2.0)
static.distributed, static.newton.tolerance = True, 1e-10
O.run(1, wait=True)
moving = MpmDynamicEngine(grid=static.grid, boundaries=static.boundaries, gravity=static.gravity, loadTime=O.time, verbosity=0, distributed=True)
moving.newton.tolerance = 1e-10
O.engines, O.dt = [moving], .02
"""
	goesOn = """
O.run(3, wait=True)
points = mpm.arrays()
said = ''
O.engines = [MpmImplicitEngine(grid=O.engines[0].grid, boundaries=O.engines[0].boundaries, gravity=(0, -9.81, 0), loadTime=O.time, verbosity=0)]
try:
	O.run(1, wait=True)
except (ValueError, RuntimeError) as error:
	said = str(error)
if rank == 0: json.dump([points['id'].tolist(), points['pos'].tolist(), said], open('end.json', 'w'))
"""
	run = yade(stages + goesOn)
	ids, pos, _ = json.loads((run.folder / 'end.json').read_text())
	for first, processes in (stages, 2), (setting + "mpm.load('between.yade.gz')\n", 3):
		yade(first + ("mpm.save('between.yade.gz')\n" if processes == 2 else '') + goesOn, processes=processes)
		end = json.loads((run.folder / 'end.json').read_text())
		assert end[0] == ids and np.abs(np.array(end[1]) - pos).max() < 1e-8, processes
		assert 'without distributed = True' in end[2], processes


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
O.engines = [solver, MpmImplicitEngine(grid=MpmGrid(cellSize=2), mask=2)]
tried()
O.engines = [solver]
O.materials.append(FrictMat(frictionAngle=.3, density=2600, young=1e7, label='rigid'))
plate = O.bodies.append(utils.box((15, 20, 0), (1, 1, 1), material='rigid', fixed=True))
solver.contacts = [MpmContact()]
if rank == 1: O.bodies[plate].state.vel = (0, -1, 0)
tried()
O.bodies.erase(plate)
solver.contacts = []
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
	for said, named in zip(first, ('a second engine', 'rigid bodies', 'settings', 'values of materials', 'failed: ')):
		assert named in said, (named, first)
	assert first[5] is True and 'mpm.load(file) puts together' in first[6]
	alone = yade("O.load('piece-0of2.yade')\nO.run(1, wait=True)\n", fails=True)
	assert 'mpm.load(file) puts together' in alone.stderr


def test_the_first_process_writes_files_and_all_have_the_arrays(yade):
	"""A recorder, pictures, tables and saves: of each file one writer, whose error is one of all. A save is there for all when it has been made."""
	run = yade(
	        setting + '''
solver = slope(2.0)
O.engines += [MpmVtkRecorder(fileName='vtk/slope', iterPeriod=1, solver='solver')]
written = []
import yade.mpm.points.files as files
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
		assert 'have different material points in iteration 1' in said[1]
		assert 'have come to different states of the points' in said[2] and said[3] == 'apart'
		assert 'the stiffness matrix is singular to working precision' in said[4]


def test_edges_of_free_ground_are_refused_by_name(yade):
	"""Also those that are not made by the call; without them the scene goes on."""
	run = yade(
	        setting + '''
O.materials.append(MpmElasticMat(young=1e7, poisson=.25, density=2000, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (6, 4, 1)), grid, 2, 'soil'))
solver = MpmDynamicEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], verbosity=0)
O.engines, O.dt, said = [solver], .01, []
def tried(call):
	try:
		call()
		said.append('')
	except (ValueError, RuntimeError) as error:
		said.append(str(error))
tried(lambda: mpm.freeField(solver, until=1))
solver.loads = [MpmFreeField(surface=[(0, 4), (0, 0)])]
tried(lambda: O.run(1, wait=True))
solver.loads = []
O.run(1, wait=True)
with open(f'process{rank}.json', 'w') as file:
	json.dump([said, O.iter], file)
''', processes=2
	)
	for rank in 0, 1:
		(ofCall, ofStep), steps = json.loads((run.folder / f'process{rank}.json').read_text())
		assert ofCall.startswith('freeField: ') and 'MpmFreeField' in ofStep and steps == 1
		assert all('several processes' in said for said in (ofCall, ofStep))


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
	assert 'mpirun has started 2 processes' in run.stderr and 'scripts/setup --with-petsc, or the package yade-mpm-petsc, installs it' in run.stderr


def test_water_that_jumps_is_that_of_one_process(yade):
	"""A pressure that jumps from 5 to 3 m of water, and water that flows between such drains, with all points in both processes and with points in pieces; a beam that parts soil is refused there, one that lies on it is not, and in pieces all are."""
	script = '''
import json, os, sys
import numpy as np
from yade import mpm
which, hasWall, setting = sys.argv[1:]
O.materials.append(MpmElasticMat(young=5e7, poisson=0.3, density=2000, conductivity=1e-5, porosity=0.4, label='sand'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (8, 0), (8, 3), (4, 3), (4, 5), (0, 5)]), grid, 2, 'sand'))
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(8, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
level = lambda x: 5 if x[0] < 4 else 3
wet = dict(water=[MpmWater(pressure=lambda x: 1e4 * max(0, level(x) - x[1]))]) if which == 'water' else dict(flow=MpmFlow(drains=[MpmDrain(surface=[(4, 5), (0, 5)], pressure=1e4), MpmDrain(surface=[(8, 3), (4, 3)])]))
line = dict(wall=[(4, 5), (4, 1)], plate=[(4, 5), (0, 5)]).get(hasWall)
walls = [MpmBeam(line=line, axialStiffness=3e9, bendingStiffness=5e7, weight=1e4)] if line else []
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, loads=walls, newton=MpmNewton(tolerance=1e-10), verbosity=0, **wet, **eval(setting))
O.engines, O.dt = [solver], 0.5
said = ''
try:
	O.run(1 if walls else 2, wait=True)
except (ValueError, RuntimeError) as error:
	said = str(error)
points = mpm.arrays()
order = np.lexsort(points['pos0'].T)
if int(os.environ.get('OMPI_COMM_WORLD_RANK', 0)) == 0:
	json.dump([said, [*(points['pos'] - points['pos0'])[order].tolist(), *[(1e-9 * moment, 0, 0) for wall in walls for moment in wall.moments]]], open('found.json', 'w'))
'''
	def found(which, wall='', setting='{}', **how):
		yade(script, which, wall, setting, **how)
		return json.loads((yade.folder / 'found.json').read_text())
	for which in 'water', 'flow':
		_, moved = found(which)
		assert np.abs(moved).max() > 1e-4
		for setting in ('{}', 'dict(distributed=True)') if which == 'water' else ('dict(distributed=True)', ):
			said, same = found(which, setting=setting, processes=2)
			assert said == '' and np.abs(np.array(same) - moved).max() < 1e-9
	(_, alone), (said, same) = found('water', 'plate'), found('water', 'plate', processes=2)
	assert said == '' and np.abs(np.array(same) - alone).max() < 1e-9
	assert 'loads[0], an MpmBeam, has soil on both of its sides, which 2 processes cannot part as one does' in found('water', 'wall', processes=2)[0]
	assert 'MpmBeam cannot go with distributed=True' in found('water', 'wall', 'dict(distributed=True)', processes=2)[0]
