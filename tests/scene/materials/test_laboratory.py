# SPDX-License-Identifier: GPL-2.0-or-later
"""Laws by themselves, without a scene: mpm.respond, and the curves of mpm.elementTest against closed forms."""
import numpy as np
import pytest
from conftest import Yade, outcomesOf

setting = '''
import json
from scenes import *
from yade.wrapper import *

degree = np.pi / 180
elastic = dict(young=20e6, poisson=.3, density=2000)
friction = dict(cohesion=5e3, frictionAngle=30 * degree, **elastic)
clay = dict(density=2000, shearModulus=5e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.03, preconsolidation=1e5, referencePressure=1e5)
'''


@pytest.fixture
def lab(yade):
	"""lab(expression): what it is in YADE, with arrays as lists."""
	return lambda text: yade(setting + f'''
def plain(value):
	if isinstance(value, dict): return {{name: plain(item) for name, item in value.items()}}
	return [plain(item) for item in value] if isinstance(value, (list, tuple)) else np.asarray(value).tolist()
print(json.dumps(plain({text})))
''').result


def test_one_answer_of_each_law(lab):
	"""Numbers that were found by hand: the main plane, an edge and the apex of Mohr-Coulomb's law, von Mises' hardening, Cam clay."""
	strain = '(2e-3, -1e-3, -4e-3)'
	found = lab(
	        f'''[
	mpm.respond(MpmMohrCoulombMat(dilationAngle=10 * degree, **friction), {strain}),
	mpm.respond(MpmMohrCoulombMat(dilationAngle=10 * degree, **friction), (1e-3, .95e-3, -3e-3)),
	mpm.respond(MpmMohrCoulombMat(dilationAngle=10 * degree, **friction), (2e-3, 1.9e-3, 1.8e-3)),
	mpm.respond(MpmVonMisesMat(yieldStress=15e3, hardening=1e6, **elastic), {strain}, plasticStrain=1e-4),
	mpm.respond(MpmCamClayMat(**clay), (1e-3, -10e-3, -30e-3)),
	mpm.respond(MpmElasticMat(**elastic), {strain})]'''
	)
	expected = [
	        (-23670.349, -53600.571, -88331.556), (-10638.938, -10638.938, -49237.323), (8660.254, ) * 3, (-37534.757, -50000, -62465.243),
	        (-115248.20, -134572.23, -169706.84)
	]
	for answer, stress in zip(found, expected):
		assert np.abs(np.subtract(answer['stress'], stress)).max() < 6e-3
	assert abs(found[3]['plasticStrain'] - 2.62851612e-3) < 1e-11
	assert abs(found[4]['preconsolidation'] - 151198.4637) < 1e-3
	assert found[5]['elasticStrain'] == [2e-3, -1e-3, -4e-3] and 'plasticStrain' not in found[5]


def test_answer_to_a_tensor(yade):
	"""It turns with the strain, and its tangent is the derivative along the axes that are given."""
	assert yade(
	        setting + '''
law = MpmMohrCoulombMat(dilationAngle=10 * degree, **friction)
angle = .4
turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
principal = mpm.respond(law, (2e-3, -1e-3, -4e-3))
answer = mpm.respond(law, turn @ np.diag([2e-3, -1e-3, -4e-3]) @ turn.T)
for name in 'stress', 'elasticStrain':
	assert np.allclose(answer[name], turn @ np.diag(principal[name]) @ turn.T, rtol=0, atol=1e-12 * np.abs(answer[name]).max())
axes = answer['axes']
for j in range(3):
	step = 1e-7 * np.outer(axes[:, j], axes[:, j])
	strain = turn @ np.diag([2e-3, -1e-3, -4e-3]) @ turn.T
	slope = (mpm.respond(law, strain + step)['stress'] - mpm.respond(law, strain - step)['stress']) / 2e-7
	assert np.abs(np.diag(axes.T @ slope @ axes) - answer['tangent'][:, j]).max() < 1e-6 * 20e6
O.materials.append(law)
O.materials[0].label = 'sand'
assert (mpm.respond('sand', (2e-3, -1e-3, -4e-3))['stress'] == principal['stress']).all()
print(json.dumps(True))
'''
	).result


def test_strength_of_friction(lab):
	"""k times the stress that is kept, and the cohesion, which is divided by the change of volume: in both kinds of compression, at any dilation."""
	found = lab(
	        '''[(type(law).__name__, kind, mpm.elementTest(law, kind, -.03, confiningPressure=50e3)) for dilation in (0, 15, 30) for law, kinds in (
	(MpmMohrCoulombMat(dilationAngle=dilation * degree, **friction), ('triaxial', 'biaxial')),
	(MpmDruckerPragerMat(dilationAngle=dilation * degree, match='compression', **friction), ['triaxial']),
	(MpmDruckerPragerMat(dilationAngle=dilation * degree, **friction), ['biaxial'])) for kind in kinds]'''
	)
	assert len(found) == 12
	for law, kind, curve in found:
		isGradual = law == 'MpmDruckerPragerMat' and kind == 'biaxial'  # the stress out of the plane goes on changing
		stress, change = np.array(curve['stress'][-1]), np.exp(curve['volumetricStrain'][-1])
		assert abs(stress[0, 0] + 50e3) < 3e-5 and (kind == 'biaxial' or abs(stress[2, 2] + 50e3) < 1e-5)
		assert abs(stress[1, 1] / (-150e3 - 1e4 * 3**.5 / change) - 1) < (1e-3 if isGradual else 1e-9), (law, kind, stress)
		assert abs(curve['axialStrain'][-1] + .03) < 1e-15 and len(curve['p']) == 101


def test_simple_shear(lab):
	"""Davis (1968): sin(phi) cos(psi) / (1 - sin(phi) sin(psi)) of the normal stress, which is kept. The elastic strains, which change with the volume, and the steps leave 1e-4."""
	law = 'MpmMohrCoulombMat(**{**friction, "young": 1e9, "cohesion": 0, "dilationAngle": %d * degree})'
	found = lab('[' + ', '.join(f"mpm.elementTest({law % psi}, 'simpleShear', .1, steps=1000, confiningPressure=1e5)" for psi in (30, 15, 0)) + ']')
	for curve, expected in zip(found, (.577350, .554753, .5)):
		stress = np.array(curve['stress'])
		assert np.abs(stress[:, 1, 1] + 1e5).max() < 3e-5
		assert abs(stress[-1, 0, 1] / 1e5 / expected - 1) < 1.2e-4
		assert np.array(curve['defGrad'])[-1, 0, 1] == pytest.approx(.1, rel=1e-12)


def test_cam_clay_reaches_critical_states(lab):
	"""Undrained p = p0 (OCR / 2)^(1 - kappa / lambda), drained 3 p0 / (3 - M); q = M p."""
	law = "MpmCamClayMat(**{**clay, 'preconsolidation': %d * 1e5, 'swellingIndex': .02})"
	found = lab(
	        '[' + ', '.join(
	                f"[mpm.elementTest({law % OCR}, kind, end, steps=200, confiningPressure=1e5) for kind, end in (('undrainedTriaxial', -.5), ('triaxial', -1.5))]"
	                for OCR in (1, 5)
	        ) + ']'
	)
	for OCR, (undrained, drained) in zip((1, 5), found):
		assert undrained['p'][-1] == pytest.approx(1e5 * (OCR / 2)**.8, rel=1e-9)
		assert undrained['q'][-1] == pytest.approx(1.2 * undrained['p'][-1], rel=1e-9)
		assert np.abs(undrained['volumetricStrain']).max() < 1e-12
		assert drained['p'][-1] == pytest.approx(5e5 / 3, rel=1e-5) and drained['q'][-1] == pytest.approx(2e5, rel=1e-5)
		assert undrained['preconsolidation'][0] == OCR * 1e5 and undrained['preconsolidation'][-1] == pytest.approx(2 * undrained['p'][-1], rel=1e-6)


def test_elastic_oedometer_and_hardening(lab):
	"""(K + 4 G / 3) ln(l) / l; and the yield stress that grows with the plastic strain of a straight path."""
	oedometer, clay, hardening = lab(
	        '''[mpm.elementTest(MpmElasticMat(young=1e6, poisson=.3, density=1), 'oedometer', np.log(.8), steps=4),
	mpm.elementTest(MpmTrescaMat(undrainedStrength=2e4, **elastic), 'undrainedTriaxial', .02, initialStress=(-3e4, -4e4, -3e4)),
	mpm.elementTest(MpmVonMisesMat(yieldStress=15e3, hardening=1e6, **elastic), 'undrainedTriaxial', -.02)]'''
	)
	assert oedometer['stress'][-1][1][1] == pytest.approx(-375481.937, abs=1e-3)
	assert clay['q'][0] == 1e4 and clay['q'][-1] == pytest.approx(4e4, rel=1e-12)
	shear = 20e6 / 2.6
	assert hardening['q'][-1] == pytest.approx(1.5**.5 * (15e3 + 1e6 * .02) / (1 + 1e6 * (2 / 3)**.5 / (2 * shear)), rel=1e-9)


def test_result_does_not_depend_on_the_steps(lab):
	"""Along a straight path of strain only the first of them matters; a step that is too large for Newton's method is halved."""
	fine, coarse = lab(
	        "[mpm.elementTest(MpmMohrCoulombMat(**friction), 'triaxial', -.5, steps=steps, confiningPressure=1e5)['stress'][-1] for steps in (400, 1)]"
	)
	assert np.abs(np.subtract(fine, coarse)).max() < 20


def test_picture(yade):
	yade(setting + "mpm.elementTest(MpmMohrCoulombMat(**friction), 'triaxial', -.02, confiningPressure=1e5, fileName='out/curve.png')")
	assert (yade.folder / 'out/curve.png').stat().st_size > 20000


refused = [
        ('mpm.respond(3, (0, 0, 0))', 'TypeError', ['respond: material = 3', 'label']),
        ('mpm.respond("mud", (0, 0, 0))', 'ValueError', ["material = 'mud'", 'O.materials']),
        ('mpm.respond(sand, (0, 0))', 'ValueError', ['strain = (0, 0)', 'three principal strains']),
        ('mpm.respond(sand, [[0, 1, 0], [0, 0, 0], [0, 0, 0]])', 'ValueError', ['strain', 'symmetric']),
        ('mpm.respond(sand, (0, 0, np.nan))', 'ValueError', ['strain', 'finite']),
        ('mpm.respond(sand, "abc")', 'TypeError', ["strain = 'abc'"]),
        ('mpm.respond(sand, (0, 0, 0), plasticStrain=-1)', 'ValueError', ['plasticStrain', '-1']),
        ('mpm.respond(sand, (0, 0, 0), plasticStrain="no")', 'TypeError', ["plasticStrain = 'no'"]),
        ('mpm.respond(sand, (0, 0, 0), preconsolidation=1)', 'ValueError', ['MpmMohrCoulombMat has no internal variable preconsolidation', 'plasticStrain']),
        ('mpm.respond(sand, (0, 0, 0), memory=1)', 'ValueError', ['memory', 'preconsolidation']),
        ('mpm.respond(MpmMohrCoulombMat(), (0, 0, 0))', 'ValueError', ['respond', 'nan']),
        ('mpm.respond(MpmCamClayMat(**clay), (-4, 0, 0))', 'ValueError', ['respond', 'no stress for these strains']),
        ('mpm.elementTest(sand, "shear", .1)', 'ValueError', ["kind = 'shear'", "'simpleShear'"]),
        ('mpm.elementTest(sand, ["triaxial"], .1)', 'ValueError', ['kind']),
        ('mpm.elementTest(sand, "triaxial", 0)', 'ValueError', ['strain = 0']),
        ('mpm.elementTest(sand, "triaxial", "x")', 'TypeError', ["strain = 'x'"]),
        ('mpm.elementTest(sand, "triaxial", -.1, steps=0)', 'ValueError', ['steps = 0']),
        ('mpm.elementTest(sand, "triaxial", -.1, steps=1.5)', 'TypeError', ['steps = 1.5', 'integer']),
        ('mpm.elementTest(sand, "triaxial", -.1, confiningPressure=-1)', 'ValueError', ['confiningPressure = -1', 'positive in compression']),
        ('mpm.elementTest(sand, "triaxial", -.1, confiningPressure=1, initialStress=(0, 0, 0))', 'ValueError', ['confiningPressure and initialStress']),
        ('mpm.elementTest(sand, "triaxial", -.1, initialStress=(0, 0))', 'ValueError', ['initialStress = (0, 0)']),
        ('mpm.elementTest(sand, "triaxial", -.1, initialStress=(0, -1e6, 0))', 'ValueError', ['elementTest: the material yields under']),
        ('mpm.elementTest(MpmCamClayMat(**clay), "triaxial", -.1)', 'ValueError', ['confiningPressure = 0', 'MpmCamClayMat']),
        ('mpm.elementTest(MpmCamClayMat(**clay), "triaxial", -.1, confiningPressure=2e5)', 'ValueError', ['yields']),
        ('mpm.elementTest(sand, "triaxial", -.1, confiningPressure=1e5, fileName="curve.txt")', 'ValueError', ['elementTest: fileName', '.png']),
        (
                'mpm.elementTest(MpmElasticMat(young=1e6, poisson=.3, density=1), "triaxial", 2, initialStress=[8e5] * 3)', 'RuntimeError',
                ["'triaxial' has no solution beyond axialStrain = 0.0398", ' of 2: ', 'the stress that is kept']
        ),
]


def test_what_is_refused(yade):
	found = outcomesOf(yade.folder, setting + 'sand = MpmMohrCoulombMat(**friction)', [statement for statement, _, _ in refused])
	for statement, kind, parts in refused:
		name, text = found[statement]
		assert name == kind and all(part in text for part in parts), (statement, name, text)
