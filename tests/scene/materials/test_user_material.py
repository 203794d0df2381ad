# SPDX-License-Identifier: GPL-2.0-or-later
"""A user material that is compiled here, against the same law of the plugin."""
import subprocess

import pytest
from conftest import Yade, root

setting = '''
import json, os
from scenes import *
from yade.wrapper import *

elastic = dict(young=20e6, poisson=.3, density=2000)
own = MpmVonMisesMat(yieldStress=30e3, **elastic)
theirs = lambda part=1., **more: MpmUserMat(library=os.environ['UMAT'], parameters=[20e6, .3, 30e3, part], stateVariables=[0], **{**elastic, **more})

def pressed(law, steps=5, **settings):
	"""Two cells between rollers, pressed and sheared by a plate."""
	O.reset()
	O.materials.append(law)
	law.label = 'soil'
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 2, 1)), grid, 2, 'soil'))
	held = [MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmBoundary(min=(-inf, 2, -inf), fix='xy', displacement=(.1, -.02, 0))]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=held, verbosity=0, **settings)]
	O.dt = 1 / steps
	return O.engines[0]

def goesOn(law):
	"""After a restart to the bit; and a step that the law refuses leaves the points where they were."""
	pressed(law())
	O.run(2, wait=True)
	O.save('middle.yade.gz')
	O.run(3, wait=True)
	straight = mpm.arrays()
	O.load('middle.yade.gz')
	O.run(3, wait=True)
	assert all(values.tobytes() == straight[name].tobytes() for name, values in mpm.arrays().items())
	solver = pressed(law(), steps=1)
	solver.newton = MpmNewton(minStep=1)
	solver.boundaries = [solver.boundaries[0], MpmBoundary(min=(-inf, 2, -inf), fix='xy', displacement=(0, -1.9, 0))] # a thousand times the strength, elastically
	before = mpm.arrays()['pos']
	try: O.step()
	except RuntimeError: assert (mpm.arrays()['pos'] == before).all()
	else: raise AssertionError('the step has ended')
'''


@pytest.fixture(scope='module')
def door(tmp_path_factory):
	folder = tmp_path_factory.mktemp('umat')
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-o', folder / 'law.so', root / 'tests/umat/von_mises.cpp'], check=True)
	yade = Yade(folder)
	yade.environment['UMAT'] = str(folder / 'law.so')
	return yade


def test_it_answers_as_the_law_of_the_plugin(door):
	"""To the differences of increments and logarithmic strain where the axes turn; without turns to round-off."""
	door(
	        setting + '''
a, b = (mpm.elementTest(law, 'oedometer', -.02, steps=10, confiningPressure=10e3) for law in (own, theirs()))
assert np.allclose(a['stress'], b['stress'], rtol=1e-9, atol=1e-6), (a['stress'][-1], b['stress'][-1])
assert np.allclose(a['plasticStrain'], b['state1'], rtol=1e-9)
results = []
for law in own, theirs(), theirs(reentrant=True):
	solver = pressed(law)
	O.run(5, wait=True)
	results.append((solver.iterations, mpm.arrays()))
for iterations, data in results[1:]:
	assert np.abs(data['stress'] - results[0][1]['stress']).max() < 1e-2 * 30e3
	assert iterations <= results[0][0] + 2, (iterations, results[0][0])
assert 'state1' in results[1][1] and (results[1][1]['state1'] > 0).any()
'''
	)


def test_its_tangent_is_checked(door):
	door(
	        setting + '''
right, wrong = (mpm.checkLaw(theirs(part), strain=5e-3, confiningPressure=10e3) for part in (1., 1.1))
assert right['tangentError'] < 1e-6 and right['stress'] < 1e-9, right
assert .05 < wrong['tangentError'] < .15, wrong
for law in own, MpmMohrCoulombMat(cohesion=5e3, frictionAngle=.5, **elastic), MpmNorSandMat(density=2000, shearModulus=45e6, swellingIndex=.0015, referencePressure=1e5,
		criticalStateRatio=1.27, compressionIndex=.02, criticalVolume=1.8911, hardening=70, specificVolume=1.75):
	assert mpm.checkLaw(law, strain=1e-3, confiningPressure=50e3)['tangentError'] < 1e-6, type(law)
'''
	)


def test_it_goes_on_after_a_restart_and_a_step_that_it_refuses(door):
	door(
	        setting + '''
goesOn(theirs)
'''
	)


def test_tensors_among_its_state_variables_turn_with_the_points(door):
	"""As columns of their own, whose sizes stay while points turn; they are named where there are none."""
	door(
	        setting + '''
states = [0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0]
law = lambda **tensors: MpmUserMat(library=os.environ['UMAT'], parameters=[20e6, .3, 30e3, 1], stateVariables=states, **tensors, **elastic)
solver = pressed(law(stressTensors=[2], strainTensors=[8]))
O.run(5, wait=True)
data = mpm.arrays()
parts = lambda k: [data[f'stateTensor{k}{axes}'] for axes in ('XX', 'YY', 'ZZ', 'XY', 'YZ', 'ZX')]
for k, squares in (1, 1), (2, 2 * .5**2 * 2**2): # of the second, one shear component of 2 like a strain: twice 1
	normal, shear = parts(k)[:3], parts(k)[3:]
	assert np.allclose(sum(x**2 for x in normal) + 2 * sum(x**2 for x in shear), squares, rtol=1e-9), k
assert np.abs(parts(1)[3]).max() > 1e-2 and np.ptp(parts(1)[3]) > 1e-3
for tensors, said in (dict(stressTensors=[9]), 'have 9, and stateVariables 13'), (dict(stressTensors=[2], strainTensors=[7]), 'have 7 and 2'):
	try: pressed(law(**tensors)); O.step()
	except Exception as error: assert said in str(error) and 'at least six apart' in str(error), error
	else: raise AssertionError(tensors)
'''
	)


@pytest.fixture(scope='module')
def told(tmp_path_factory):
	folder = tmp_path_factory.mktemp('told')
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-o', folder / 'law.so', root / 'tests/umat/told.cpp'], check=True)
	yade = Yade(folder)
	yade.environment['UMAT'] = str(folder / 'law.so')
	return yade


counting = setting + '''
counter = lambda rate=0., **more: MpmUserMat(library=os.environ['UMAT'], parameters=[20e6, .3, rate], stateVariables=[0] * 4, label='Sand', **{**elastic, **more})
'''


def test_it_is_told_the_first_increment_and_the_times(told):
	"""Times as Abaqus counts them: TIME as the increment begins, KINC from 1 on. A step that is cut counts once; a DTIME of 0 is never told; CMNAME is the label in capitals."""
	told(
	        counting + '''
for duration, seconds in (0, 10), (5, 5):
	curve = mpm.elementTest(counter(), 'oedometer', -.01, steps=10, duration=duration)
	assert curve['state1'][-1] == curve['state2'][-1] == 10 and abs(curve['state3'][-1] - seconds * .9) < 1e-9, curve['state3']
	assert abs(curve['state4'][-1] - seconds / 10) < 1e-12
found = mpm.checkLaw(counter(1.), confiningPressure=100e3)
assert found['tangentError'] < 1e-6 and found['stress'] < 1e-9, found
for engine in MpmImplicitEngine, MpmDynamicEngine:
	pressed(counter(), steps=4)
	if engine is MpmDynamicEngine: O.engines = [MpmDynamicEngine(grid=O.engines[0].grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], gravity=(0, -10, 0), verbosity=0)]
	O.run(2, wait=True)
	O.save('middle.yade.gz')
	O.load('middle.yade.gz')
	O.run(2, wait=True)
	data = mpm.arrays()
	assert (data['state1'] == 4).all() and (data['state2'] == 4).all() and np.allclose(data['state3'], .75) and np.allclose(data['state4'], .25), (engine, data['state1'], data['state3'])
other = counter()
other.label = 'Clay'
try: mpm.elementTest(other, 'oedometer', -.01, steps=1)
except Exception as error: assert 'elementTest' in str(error) or 'law' in str(error), error
else: raise AssertionError('another name has been told')
'''
	)


rough = '''extern "C" void umat_(double* stress, double*, double* D, double*, double*, double*, double*, double*, double*,
                      double*, double*, const double* strain, double*, double*, double*, double*, double*, double*, char*, int*, int*, int*, int*, double* parameters)
{
	for (int i = 0; i < 6; ++i) {
		for (int j = 0; j < 6; ++j) stress[i] += (D[6 * i + j] = i == j ? (i < 3 ? 20e6 : 10e6) : 0) * strain[j];
		stress[i] *= 1 + parameters[0];
	}
}'''


def test_a_law_that_solves_its_equations_to_a_tolerance_has_ground_at_rest(tmp_path):
	"""As one by iterations does, it answers no strain with a stress that is off by its tolerance; off by more it yields."""
	(tmp_path / 'law.cpp').write_text(rough)
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-o', tmp_path / 'law.so', tmp_path / 'law.cpp'], check=True)
	yade = Yade(tmp_path)
	yade.environment['UMAT'] = str(tmp_path / 'law.so')
	yade(
	        setting + '''
for off in 1e-7, 1e-5:
	law = MpmUserMat(density=2000, young=20e6, poisson=0, library=os.environ['UMAT'], parameters=[off])
	solver = pressed(law, gravity=(0, -10, 0), gravityCurve=[(0, 1)])
	try: mpm.geostatic(K0=.5)
	except ValueError as error: assert off == 1e-5 and 'yields under the elastic strain' in str(error), error
	else: assert off == 1e-7 and abs(mpm.arrays()['stress'][:, 1, 1].min() / -3.5e4 - 1) < 0.1, mpm.arrays()['stress']
'''
	)


def test_a_law_that_ends_the_program_is_named(told):
	run = told(
	        counting + '''
print('before', flush=True)
mpm.checkLaw(MpmUserMat(library=os.environ['UMAT'], function='stops_', parameters=[1.], **elastic))
print('after')
''',
	        fails=True
	)
	assert 'before' in run.stdout and 'after' not in run.stdout
	assert "function = 'stops_' has ended the program" in run.stderr, run.stderr


def test_what_cannot_be_opened_is_named(door):
	said = door(
	        setting + '''
def tried(**attributes):
	try:
		pressed(MpmUserMat(**{**elastic, 'library': os.environ['UMAT'], **attributes}))
		O.step()
	except Exception as error: return str(error)
	return 'no error'
few = tried(parameters=[20e6])
assert 'no stress' in few, few
print(json.dumps([tried(library='./none.so'), tried(function='vumat'), tried(relaxationTime=1.), tried(stateVariables=[0.] * 41), tried(library='')]))
'''
	).result
	for text, words in zip(said, [('none.so', 'opened'), ('vumat', 'nm -D'), ('relaxationTime', ), ('stateVariables', '40'), ('library', 'path')]):
		assert all(word in text for word in words), (text, words)


def test_hypoplastic_sand_of_the_example(tmp_path):
	"""Its tangent; isotropic compression in the loosest state, which stays the loosest (Bauer); its critical state."""
	library = tmp_path / 'sand.so'
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', library, root / 'examples/laboratory/hypoplasticity.cpp'], check=True)
	yade = Yade(tmp_path)
	yade.environment['UMAT'] = str(library)
	yade(
	        setting + '''
import ctypes
phi, hardness, exponent = np.pi * 33 / 180, 1.5e9, .28
constants = [phi, hardness, exponent, .55, .95, 1.05, .25, 1, 0]
voidRatio = lambda first, p: first * np.exp(-(3 * p / hardness)**exponent)
array = lambda values: (ctypes.c_double * len(values))(*values)
stress, state, none, shorter = array([-10e3] * 3 + [0] * 3), array([voidRatio(1.05, 10e3)]), array([0] * 36), array([1])
tangent = array([0] * 36)
umat = ctypes.CDLL(os.environ['UMAT']).umat_
for step in range(200):
	increment = array([-1e-4] * 3 + [0] * 3)
	umat(stress, state, tangent, *[none] * 8, increment, *[none] * 6, *[None] * 5, array(constants), None, none, none, shorter, *[none] * 3, *[None] * 6, 0)
p = -stress[0]
assert p > 100e3 and shorter[0] == 1
assert abs(state[0] / voidRatio(1.05, p) - 1) < 1e-5, (state[0], voidRatio(1.05, p))
sand = lambda e: MpmUserMat(library=os.environ['UMAT'], parameters=constants[:-1] + [1.], stateVariables=[e], reentrant=True, density=1600, young=50e6, poisson=.2)
assert mpm.checkLaw(sand(.7), confiningPressure=100e3)['tangentError'] < 1e-8
for e, most in (.9, 1.01), (.65, 1.6):
	curve = mpm.elementTest(sand(e), 'triaxial', -.3, steps=300, confiningPressure=100e3)
	ratio, critical = curve['q'] / -np.trace(curve['stress'], axis1=1, axis2=2) * 3, 6 * np.sin(phi) / (3 - np.sin(phi))
	assert .99 < ratio.max() / critical < most and ratio[-1] <= ratio.max(), (e, ratio.max() / critical)
	if e == .9: assert abs(ratio[-1] / critical - 1) < .01 and abs(curve['state1'][-1] / voidRatio(.95, 175e3) - 1) < .02
	else: assert ratio.max() > 1.2 * critical and ratio[-1] < .9 * ratio.max() # dense sand has a peak
'''
	)


ofMfront = setting + '''
mfront = lambda **more: MpmUserMat(**{**elastic, 'library': os.environ['MFRONT'], 'function': 'VonMises', 'parameters': [20e6, .3, 30e3 * 1.5**.5], **more})
'''


@pytest.fixture(scope='module')
def mfront(tmp_path_factory):
	folder = tmp_path_factory.mktemp('mfront')
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-o', folder / 'laws.so', root / 'tests/mfront/laws.cpp'], check=True)
	yade = Yade(folder)
	yade.environment['UMAT'] = yade.environment['MFRONT'] = str(folder / 'laws.so')
	return yade


def test_a_law_by_the_generic_interface_of_mfront_answers_as_that_of_the_plugin(mfront):
	"""It goes by its elastic strain, a tensor that turns, which follows from the stress at first. To the differences of increments and logarithmic strain where the axes turn."""
	mfront(
	        ofMfront + '''
a, b = (mpm.elementTest(law, 'oedometer', -.02, steps=10, confiningPressure=10e3) for law in (own, mfront()))
assert np.allclose(a['stress'], b['stress'], rtol=1e-9, atol=1e-6), (a['stress'][-1], b['stress'][-1])
assert np.allclose(a['plasticStrain'], b['state1'], rtol=1e-9)
found = mpm.checkLaw(mfront(), strain=5e-3, initialStress=(-10e3, -20e3, -15e3))
assert found['tangentError'] < 1e-6 and found['stress'] < 1e-9, found
results = []
for law in own, mfront(), mfront(reentrant=True):
	solver = pressed(law)
	O.run(5, wait=True)
	results.append((solver.iterations, mpm.arrays()))
for iterations, data in results[1:]:
	assert np.abs(data['stress'] - results[0][1]['stress']).max() < 1e-2 * 30e3
	assert iterations <= results[0][0] + 2, (iterations, results[0][0])
data = results[1][1]
assert (data['state1'] > 0).any() and np.abs(data['stateTensor1XY']).max() > 1e-4
'''
	)


def test_components_and_rows_are_those_of_mfront(mfront):
	"""The dilation makes a shear stress along x and z, and no shear makes a pressure."""
	mfront(
	        ofMfront + '''
law = mfront(function='Elastic', parameters=[20e6, .3, 5e6])
assert mpm.checkLaw(law)['tangentError'] < 1e-6
O.materials.append(law)
law.label = 'soil'
grid = MpmGrid(cellSize=1, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), grid, 2, 'soil'))
O.engines = [MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz'), MpmBoundary(min=(-inf, 1, -inf), fix='xyz', displacement=(0, -.01, 0))], verbosity=0)]
O.dt = 1
O.step()
for F, stress, volume in zip(*(mpm.arrays()[name] for name in ('defGrad', 'stress', 'volume'))):
	J = np.linalg.det(F)
	assert abs(J * stress[0, 2] / (5e6 / 2**.5 * np.log(J)) - 1) < 1e-9 and abs(stress[1, 2]) < 1e-9 * abs(stress[0, 2]), (stress, J)
'''
	)


def test_a_law_of_mfront_goes_on_after_a_restart_and_a_step_that_it_refuses(mfront):
	said = mfront(
	        ofMfront + '''
goesOn(mfront)
said = []
for setting in dict(strain=10), dict(initialStress=(-10e3, -20e3, -15e3)):
	try: mpm.checkLaw(mfront(function='Elastic', parameters=[20e6, .3, 0]), **setting)
	except ValueError as error: said.append(str(error))
try: mpm.elementTest(mfront(function='Elastic', parameters=[20e6, .3, 0]), 'oedometer', -5, steps=5)
except RuntimeError as error: said.append(str(error))
print(json.dumps(said))
'''
	).result
	assert said[0].startswith('checkLaw: the law') and said[0].endswith('It says: the strain is too large'), said
	assert said[2].startswith('elementTest: ') and 'It says: the strain is too large' in said[2], said
	assert said[1].endswith('has no variable ElasticStrain, and forgets the stress with which a step begins.'), said


def test_a_parameter_file_that_mfront_would_read_is_named(mfront):
	said = mfront(
	        ofMfront + '''
said = []
for name in 'VonMises-parameters.txt', 'VonMisesTridimensional-parameters.txt', 'Other-parameters.txt':
	open(name, 'w').write('epsilon 1e-3')
	try: mpm.checkLaw(mfront())
	except ValueError as error: said.append(str(error))
	os.remove(name)
print(json.dumps(said))
'''
	).result
	assert len(said) == 2 and all(f"'VonMises{name}-parameters.txt'" in text and 'Move the file away' in text for name, text in zip(('', 'Tridimensional'), said)), said


def test_what_of_mfront_is_not_admitted_is_named(mfront):
	names = dict(Old='3.4.3', Finite='small strain', Layered='orthotropic', Plane='Tridimensional', Wet='Humidity', Directed='Axis', Elsewhere='Castem')
	names |= dict(VonMises_Tridimensional="function = 'VonMises'", VonMises3D='@Behaviour')
	said = mfront(
	        ofMfront + f'''
def tried(**attributes):
	try: mpm.checkLaw(mfront(**attributes))
	except Exception as error: return str(error)
	return 'no error'
print(json.dumps([tried(function=name) for name in {list(names)}] + [tried(parameters=[1.]), tried(stateVariables=[1.])]))
'''
	).result
	expected = [(word, ) for word in names.values()] + [('parameters', '3', 'YoungModulus, PoissonRatio, YieldStress'), ('stateVariables', '7', 'EquivalentPlasticStrain, ElasticStrain (xx')]
	for text, words in zip(said, expected):
		assert all(word in text for word in words), (text, words)
