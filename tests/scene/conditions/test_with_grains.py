# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points and DEM grains in one scene leave each other alone."""
import numpy as np

scene = '''
from scenes import *
from yade import utils

def grains():
	"""Two spheres falling on a third one; spheres have their own material."""
	O.materials.append(FrictMat(young=1e10, poisson=0.3, density=2600, frictionAngle=0.5, label='grains'))
	# in the middle of the material points: a collider that saw those would find contacts
	O.bodies.append(utils.sphere((10, 5, 0), 0.5, fixed=True, material='grains'))
	O.bodies.append([utils.sphere((10.1, 6, 0), 0.5, material='grains'), utils.sphere((10, 7.01, 0.1), 0.5, material='grains')])

dem = lambda: [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
	InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	GlobalStiffnessTimeStepper(active=True, defaultDt=1e-4, timeStepUpdateInterval=10), NewtonIntegrator(gravity=(0, -9.81, 0), damping=0.2)]
spheres = lambda: np.array([list(b.state.pos) + list(b.state.vel) for b in O.bodies if type(b.shape) is Sphere])
'''


def test_both_get_the_results_that_they_get_alone(yade):
	"""Also with the usual time stepper: the material points then take the time of every 50th iteration as their load time."""
	yade(
	        scene + '''
grains()
O.engines, O.dt = dem(), 1e-4
O.run(1000, wait=True)
np.save('grains_alone.npy', spheres())
times = []

O.reset()
solver = slope()
grains()
solver.iterPeriod = 50
solver.loadCurve = [(0, 0), (1, 1)]
O.engines = dem() + [solver, PyRunner(iterPeriod=1, initRun=True, command='times.append(solver.loadTime)')]
O.dt = 1e-4
O.run(1000, wait=True)
np.save('grains_together.npy', spheres())
np.save('points_together.npy', mpm.arrays()['pos'])
assert len(O.interactions) > 0
assert all(max(i.id1, i.id2) >= 1095 for i in O.interactions)

times = sorted(set(times))
assert len(times) == 20, times
O.reset()
solver = slope()
solver.loadCurve = [(0, 0), (1, 1)]
O.engines = [solver]
for time in times: # the same load times, without grains
	O.dt = time - O.time
	O.step()
np.save('points_alone.npy', mpm.arrays()['pos'])
'''
	)
	load = lambda name: np.load(yade.folder / f'{name}.npy')
	assert np.array_equal(load('grains_alone'), load('grains_together'))
	assert np.abs(load('grains_alone')[:, 3:]).max() > 0
	assert np.abs(load('points_alone') - load('points_together')).max() < 1e-9


def test_a_time_step_that_yade_sets_is_no_load_increment(yade):
	run = yade(scene + '''
solver = slope()
O.engines = dem() + [solver]
O.step()
''', fails=True)
	assert 'TimeStepper' in run.stderr + run.stdout and 'iterPeriod' in run.stderr + run.stdout


def test_material_points_left_to_the_integrator_are_refused(yade):
	run = yade(scene + '''
solver = slope()
O.bodies[3].dynamic = True
O.step()
''', fails=True)
	assert 'Body #3' in run.stderr + run.stdout and 'blockedDOFs' in run.stderr + run.stdout


def test_yade_writes_material_points_as_spheres(yade):
	run = yade(
	        scene + '''
solver = slope()
O.engines = [solver, VTKRecorder(fileName='yade-', recorders=['spheres'], iterPeriod=1)]
O.step()
'''
	)
	assert 'NumberOfPoints="1095"' in (run.folder / 'yade-spheres.0.vtu').read_text(errors='replace')
