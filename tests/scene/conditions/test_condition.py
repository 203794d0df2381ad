# SPDX-License-Identifier: GPL-2.0-or-later
"""A condition that the plugin does not know (tests/condition): a bed of springs goes through all that acts on the soil, without a line of the plugin that names it."""
import json

import numpy as np
import pytest
from conftest import Yade, build, makeOverlay
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

library = build / 'tests' / 'condition' / 'mpm_engine.so'


@pytest.fixture(scope='module')
def overlay(tmp_path_factory):
	"""YADE with the plugin that has one condition more."""
	if not library.exists(): pytest.skip('scripts/setup --tests builds the condition')
	return makeOverlay(tmp_path_factory.mktemp('overlay'), engine=library)


@pytest.fixture
def yade(tmp_path, overlay):
	found = Yade(tmp_path)
	found.command, found.isShared = overlay, True
	return found


# A block of 2 x 2 cells on springs; it rests on nothing else.
scene = '''
import json
from math import inf
import numpy as np
from yade import mpm, pack

def block(engine=MpmImplicitEngine, dim=2, bed={}, material=None, **settings):
	O.reset()
	O.materials.append(material or MpmElasticMat(young=1e6, poisson=0.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=1, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (2, 2, 1)), grid, 2, O.materials[0].label))
	springs = MpmSpringBed(**dict(dict(stiffness=1e6), **bed))
	O.engines = [engine(**dict(dict(grid=grid, gravity=(0, -10, 0), loads=[springs], verbosity=0, label='solver'), **settings))]
	O.dt = 1 / 4
	return O.engines[0], springs
'''
weight = 2000 * 10 * 4


def test_static_run_table_picture_files_and_restart(yade):
	result = yade(scene + f'''
solver, springs = block(bed=dict(lift=(0, 0.1, 0), curve=[(0, 0), (1, 0), (2, 1)]))
O.engines = O.engines + [MpmVtkRecorder(fileName='out-', recorders=['points', 'loads'], iterPeriod=4, ascii=True)]
assert solver.loadsEnd() == 2
before = [solver.plotData()['springs0_y'], springs.resultant[1]]
O.run(4, wait=True)
loaded, y = solver.plotData(), mpm.arrays()['pos'][:, 1]
O.save('half.yade')
mpm.plot(fileName='picture.png')
O.run(4, wait=True)
lifted, ends, after = mpm.arrays()['pos'][:, 1] - y, mpm.arrays(), solver.plotData()
O.load('half.yade')
solver = O.engines[0]
assert isinstance(solver.loads[0], MpmSpringBed) and solver.loads[0].resultant[1] == loaded['springs0_y']
O.run(4, wait=True)
again = mpm.arrays()
print(json.dumps(dict(before=before, force=[loaded['springs0_x'], loaded['springs0_y']], lifted=lifted.tolist(), after=[after['springs0_x'], after['springs0_y']],
	same=[name for name in ends if not np.array_equal(ends[name], again[name])])))
''').result
	assert result['before'] == [0, 0]
	assert np.allclose(result['force'], [0, weight], atol=1e-5 * weight)
	assert np.allclose(result['after'], [0, weight], atol=1e-5 * weight)
	assert abs(np.mean(result['lifted']) - 0.1) < 5e-3  # nodes share the weight in another way where it has come to
	assert result['same'] == []
	assert (yade.folder / 'picture.png').stat().st_size > 0
	reader = vtkXMLUnstructuredGridReader()
	reader.SetFileName(str(yade.folder / 'out-loads.4.vtu'))
	reader.Update()
	cells = reader.GetOutput()
	elongation = vtk_to_numpy(cells.GetCellData().GetArray('elongation'))
	assert cells.GetNumberOfCells() == len(elongation) >= 3 and abs(1e6 * elongation[:, 1].sum() + weight) < 1e-5 * weight


@pytest.mark.parametrize('scheme', ['newmark', 'midpoint', 'explicit'])
def test_steps_in_time_keep_the_energy(yade, scheme):
	result = yade(scene + f'''
solver, springs = block(MpmDynamicEngine, scheme='{scheme}', bed=dict(stiffness=2e4, young=1e6, lift=(0, 0.02, 0), curve=[(0, 0), (0.5, 1)]))
if solver.scheme == 'explicit': O.dt = solver.criticalTimeStep() / 8
else: O.dt = 5e-3
O.run(round(1 / O.dt), wait=True)
data = solver.plotData()
print(json.dumps(dict(work=springs.work, load=data['loadWork'], potential=data['gravityPotential'], kinetic=data['kineticEnergy'], imbalance=data['energyImbalance'])))
''').result
	assert result['kinetic'] > 100 and result['work'] < -100  # it falls onto soft springs
	assert abs(result['load'] - (result['work'] - result['potential'])) < 1e-6 * abs(result['potential'])
	assert abs(result['imbalance']) < 0.02 * abs(result['potential'])


def test_the_limit_of_explicit_steps_knows_it(yade):
	result = yade(scene + '''
def limit(stiffness): return block(MpmDynamicEngine, scheme='explicit', bed=dict(stiffness=stiffness))[0].criticalTimeStep()
limits = [limit(k) for k in (1, 1e6, 1e8)]
solver, springs = block(MpmDynamicEngine, scheme='explicit', bed=dict(stiffness=1e8))
O.dt = limits[0]
try: O.step()
except Exception as error: said = str(error)
print(json.dumps(dict(limits=limits, said=said)))
''', fails=False).result
	soft, middle, stiff = result['limits']
	assert stiff < 0.2 * middle < 0.2 * soft
	assert 'smaller MpmSpringBed.stiffness' in result['said']


def test_studies_know_it(yade):
	result = yade(scene + '''
from scipy.sparse import coo_matrix
def matrix(k):
	solver, springs = block(bed=dict(stiffness=k), boundaries=[MpmBoundary(max=(inf, 0, inf), min=(-inf, 0, -inf), fix='x')])
	rows, columns, values, size = solver.stiffness()
	return coo_matrix((values, (rows, columns)), (size, size)).toarray(), solver.conditionNumber()
(with1, c1), (with3, c3) = matrix(1e6), matrix(3e6)
difference = with3 - with1
diagonal = np.diag(difference)
clay = lambda: MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=1e5, label='clay')
solver, springs = block(material=clay(), bed=dict(stiffness=1e6))
O.run(4, wait=True)
pos, resultant = mpm.arrays()['pos'], springs.resultant[1]
strong, weak = solver.weakened(1.0), solver.weakened(20.0)
assert np.array_equal(pos, mpm.arrays()['pos']) and springs.resultant[1] == resultant
print(json.dumps(dict(off=abs(difference - np.diag(diagonal)).max(), diagonal=sorted(set(np.round(diagonal).tolist())), count=int((diagonal > 1).sum()), condition=[c1, c3],
	strong=strong['carries'], moved=float(np.abs(strong['displacement']).max()), weak=weak['carries'])))
''').result
	assert result['off'] == 0 and result['diagonal'] == [0, 2e6] and result['count'] == 3  # along y: x is held there
	assert result['condition'][0] != result['condition'][1]
	assert result['strong'] and result['moved'] < 0.05 and not result['weak'], result


def test_processes_compare_it(yade):
	script = scene + '''
import os
rank = int(os.environ.get('OMPI_COMM_WORLD_RANK', 0))
import sys
solver, springs = block(bed=dict(stiffness=1e6 if len(sys.argv) == 1 else 1e6 + rank))
O.run(4, wait=True)
if rank == 0: json.dump(dict(force=springs.resultant[1], y=mpm.arrays()['pos'][:, 1].tolist()), open('found.json', 'w'))
'''
	absence = yade("import json\nfrom yade.mpm.library import engine\nprint(json.dumps(engine.multigridAbsence()))").result
	if absence: pytest.skip('without PETSc: ' + absence)
	divided = script.replace("verbosity=0,", "verbosity=0, distributed=True,").replace("mpm.arrays()['pos'][:, 1].tolist()", '[]')
	found = lambda script, **how: (yade(script, **how), json.loads((yade.folder / 'found.json').read_text()))[1]
	alone, together = found(script), found(script, processes=2)
	assert np.allclose(alone['y'], together['y'], atol=1e-9) and abs(alone['force'] - together['force']) < 1e-6 * weight
	assert abs(found(divided, processes=2)['force'] - weight) < 1e-5 * weight
	failed = yade(divided, 'different', processes=2, fails=True)
	assert 'the processes have different settings' in failed.stderr


def test_it_hears_of_points_that_are_halved(yade):
	result = yade(scene + '''
solver, springs = block(MpmDynamicEngine, gravity=(0, 0, 0), maxSplits=2)
n = len(mpm.arrays()['id'])
mpm.assign(defGrad=[np.diag([2.5, 1, 1])] * n, elasticStrain=np.zeros((n, 3, 3)))
for body in O.bodies: body.state.pos = (2.5 * body.state.pos[0], body.state.pos[1], body.state.pos[2])
O.dt = 1e-6
O.step()
print(json.dumps(dict(new=len(mpm.arrays()['id']) - n, heard=springs.halves)))
''').result
	assert result['new'] == result['heard'] == 16


def test_what_looks_at_all_loads_takes_it(yade):
	result = yade(scene + '''
solver, springs = block(dim=3, boundaries=[MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, 1), fix='z')])
O.run(4, wait=True)
advice = mpm.advise()
dug = mpm.stages.excavate(pack.inAlignedBox((-1, 1.5, -1), (9, 9, 9)))
O.run(4, wait=True)
print(json.dumps(dict(advice=str(advice), dug=dug, force=springs.resultant[1])))
''').result
	assert 'dim=2 (plane strain) will do' not in result['advice']  # its action along z is not known
	assert result['dug'] > 0 and result['force'] < weight


def test_what_belongs_elsewhere_is_refused_by_name(yade):
	result = yade(scene + '''
solver, springs = block()
said = []
def tried(f):
	try: f()
	except Exception as error: said.append(f'{type(error).__name__}: {error}')
def assign(**values):
	for name, value in values.items(): setattr(solver, name, value)
tried(lambda: assign(loads=[MpmWater(level=1)]))
tried(lambda: assign(water=[springs]))
def step():
	solver.loads = [MpmCondition()]
	O.step()
tried(step)
def twice():
	solver.loads = [springs, springs]
	O.step()
tried(twice)
print(json.dumps(said))
''').result
	assert 'ValueError' in result[0] and 'MpmWater belongs into water' in result[0]
	assert 'TypeError' in result[1] and 'MpmWater' in result[1]
	assert 'loads[0] is an MpmCondition' in result[2] and 'derived from it' in result[2]
	assert 'loads[0] and loads[1] are the same MpmSpringBed' in result[3]
