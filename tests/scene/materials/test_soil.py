# SPDX-License-Identifier: GPL-2.0-or-later
"""Tresca's, Mohr-Coulomb's and Drucker-Prager's laws and Cam clay as classes of YADE: from the material to every output, and what is refused."""
import numpy as np
import pytest
from conftest import Yade

scene = '''
import json
from scenes import *
from yade.wrapper import *

degree = np.pi / 180
elastic = dict(young=5e6, poisson=.3, density=2000, label='soil')
friction = dict(cohesion=5e3, frictionAngle=30 * degree, **elastic)
clay = dict(density=2000, shearModulus=3e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=8e4, referencePressure=5e4, label='soil')

def pressed(material, steps=10, to=0.05, stress=0, free=True):
	"""Two cells between smooth plates, free at one side or between walls, pressed in plane strain."""
	O.reset()
	O.materials.append(material)
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 2, 1)), grid, 2, 'soil'))
	if stress: mpm.assign(stress=[-stress * np.identity(3)] * len(O.bodies))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')] + ([] if free else [MpmBoundary(min=(1, -inf, -inf), fix='x')])
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides + [MpmBoundary(min=(-inf, 2, -inf), fix='y', displacement=(0, -to, 0))], verbosity=0)]
	O.dt = 1 / steps
	return O.engines[0]

def kirchhoff():
	points = mpm.arrays()
	return np.linalg.det(points['defGrad'])[:, None, None] * points['stress']

def refusal(material, **how):
	try:
		pressed(material, **how)
		O.step()
	except Exception as error:
		return f'{type(error).__name__}: {error}'
'''


@pytest.fixture(scope='module')
def yade(tmp_path_factory):
	return Yade(tmp_path_factory.mktemp('soil'))


def test_unconfined_strength(yade):
	"""2 c sqrt(k) of Mohr-Coulomb's law and of the cone that matches it in plane strain, at any dilation; 2 c_u of Tresca's."""
	found = yade(
	        scene + '''
found = {}
for dilation in 0, 15, 30:
	for cls in MpmMohrCoulombMat, MpmDruckerPragerMat:
		pressed(cls(dilationAngle=dilation * degree, **friction))
		O.run(10, wait=True)
		found[f'{cls.__name__} {dilation}'] = (kirchhoff()[:, 1, 1].tolist(), mpm.arrays()['plasticStrain'].min())
pressed(MpmTrescaMat(undrainedStrength=5e3, **elastic))
O.run(10, wait=True)
found['tresca'] = (kirchhoff()[:, 1, 1].tolist(), mpm.arrays()['plasticStrain'].min())
print(json.dumps(found))
'''
	).result
	assert len(found) == 7
	for name, (stress, plasticStrain) in found.items():
		assert abs(np.mean(stress) / (-1e4 if name == 'tresca' else -1e4 * 3**.5) - 1) < 1e-2, (name, stress)
		assert plasticStrain > 1e-3


def test_camClay_remembers_the_largest_pressure(yade):
	"""It begins where it was told to, hardens beyond that, and keeps it in unloading; saved and restarted with the same bits."""
	first, pressed, unloaded = yade(
	        scene + '''
pressed(MpmCamClayMat(**clay), stress=5e4, free=False)
assert np.all(mpm.arrays()['preconsolidation'] == 8e4)
assert np.allclose(mpm.arrays()['stress'], -5e4 * np.identity(3), rtol=1e-12, atol=1e-6)
points = [mpm.arrays()['preconsolidation'].tolist()]
O.run(5, wait=True)
O.save('clay.yade.gz')
O.run(5, wait=True)
straight = mpm.arrays()
points.append(straight['preconsolidation'].tolist())
O.load('clay.yade.gz')
O.run(5, wait=True)
assert all(values.tobytes() == straight[name].tobytes() for name, values in mpm.arrays().items())
mpm.assign(stress=.5 * straight['stress'])
points.append(mpm.arrays()['preconsolidation'].tolist())
mpm.assign(preconsolidation=np.linspace(5e5, 6e5, len(O.bodies)))
assert mpm.arrays()['preconsolidation'].max() == 6e5
print(json.dumps(points))
'''
	).result
	assert min(pressed) > 1.05 * max(first)
	assert unloaded == pressed


def test_camClay_on_its_yield_surface_is_admitted(yade):
	assert yade(scene + '''
pressed(MpmCamClayMat(**{**clay, 'preconsolidation': 5e4}), stress=5e4, free=False)
O.step()
print(json.dumps(bool(mpm.arrays()['preconsolidation'].min() > 5e4)))
''').result


def test_bad_input_is_refused_with_its_reason(yade):
	found = yade(
	        scene + '''
def tried(cls, **values):
	try: return refusal(cls(**values))
	except Exception as error: return f'{type(error).__name__}: {error}'

print(json.dumps([
	tried(MpmMohrCoulombMat, **{**friction, 'dilationAngle': 31 * degree}),
	tried(MpmMohrCoulombMat, **{**friction, 'frictionAngle': 30}),
	tried(MpmMohrCoulombMat, **{**friction, 'cohesion': -1}),
	tried(MpmDruckerPragerMat, **{**friction, 'cohesion': 0, 'frictionAngle': 0}),
	tried(MpmDruckerPragerMat, **{**friction, 'match': 'outer'}),
	tried(MpmFrictionalMat, **friction),
	tried(MpmMohrCoulombMat, **elastic),
	tried(MpmCamClayMat, **{**clay, 'swellingIndex': .1}),
	tried(MpmCamClayMat, **clay),
	refusal(MpmCamClayMat(**clay), stress=-1e3),
	refusal(MpmCamClayMat(**clay), stress=9e4),
]))
'''
	).result
	expected = [
	        'MpmMohrCoulombMat.dilationAngle = 0.54', 'radians(30)', 'cohesion = -1', 'MpmDruckerPragerMat.cohesion = 0 is not admitted', "'plane-strain'",
	        'no constitutive law', 'cohesion = nan', 'MpmCamClayMat.swellingIndex = 0.1', 'no stiffness without pressure', 'none but pressures', 'yields under'
	]
	assert len(found) == len(expected)
	for text, part in zip(found, expected):
		assert text and text.startswith('ValueError') and part in text, (part, text)


def test_advice_knows_what_can_yield(yade):
	found = yade(
	        scene + '''
found = []
for material in MpmElasticMat(**elastic), MpmMohrCoulombMat(**friction), MpmTrescaMat(undrainedStrength=1e9, **elastic), MpmCamClayMat(**clay):
	engine = pressed(material, stress=0 if isinstance(material, MpmElasticMat) else 5e4, free=False)
	engine.gravity = (0, -10, 0)
	found.append(' '.join(mpm.advise(engine)['advice']))
print(json.dumps(found))
'''
	).result
	assert ['cannot bring' in text for text in found] == [False, False, True, False]
