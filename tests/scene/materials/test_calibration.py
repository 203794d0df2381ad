# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.calibrate: what laws are made of is found again in their curves, and how well it is known; mpm.typicalSand."""
import pytest
from conftest import outcomesOf

setting = '''
import json
from scenes import *
from yade.wrapper import *

degree, elastic = np.pi / 180, dict(young=20e6, poisson=.3, density=2000)
friction = dict(cohesion=5e3, frictionAngle=30 * degree, dilationAngle=8 * degree, **elastic)


def measured(material, kind, strain, columns, steps=40, every=2, pressure=0, noise=None, **more):
	"""A test in the computer, in finer steps than the fit takes, with errors of a part of the largest reading if noise is a (generator, part)."""
	curve = mpm.elementTest(material, kind, strain, steps=steps, confiningPressure=pressure)
	curve |= {'stress_' + 'xyz'[i] + 'xyz'[j]: curve['stress'][:, i, j] for i in range(3) for j in range(3)}
	def reading(name):
		values = curve[name][every::every]
		return values + noise[1] * abs(values).max() * noise[0].normal(size=len(values)) if noise else values
	driven = 'shearStrain' if kind == 'simpleShear' else 'axialStrain'
	return dict(kind=kind, confiningPressure=pressure, **{driven: curve[driven][every::every]}, **{name: reading(name) for name in columns}, **more)
'''

laws = {
        'elastic': ('MpmElasticMat(**elastic)', "[measured(true, 'oedometer', -.05, ['stress_xx', 'stress_yy'])]", 'young=(1e6, 1e9), poisson=(0, .45)'),
        'von Mises': (
                'MpmVonMisesMat(yieldStress=15e3, hardening=-3e5, residualYieldStress=8e3, young=5e6, poisson=.3, density=2000)',
                "[measured(true, 'triaxial', -.04, ['q', 'volumetricStrain'], pressure=3e4)]",
                'young=(1e6, 1e8), poisson=(0, .45), yieldStress=(1e4, 1e5), hardening=(-1e6, 1e6), residualYieldStress=(1e3, 1e4)'
        ),
        'Tresca': ('MpmTrescaMat(undrainedStrength=12e3, **elastic)', "[measured(true, 'biaxial', -.004, ['q', 'volumetricStrain'], pressure=2e4)]",
                   'young=(1e6, 1e9), poisson=(0, .45), undrainedStrength=(1e3, 1e5)'),
        'Mohr-Coulomb':
                ('MpmMohrCoulombMat(**friction)', "[measured(true, 'triaxial', -.03, ['q', 'volumetricStrain'], pressure=p) for p in (5e4, 1e5)]",
                 'young=(1e6, 1e9), poisson=(0, .45), cohesion=(0, 5e4), frictionAngle=(.1, .9), dilationAngle=(0, .4)'),
        'Drucker-Prager':
                ('MpmDruckerPragerMat(**friction)', "[measured(true, 'biaxial', -.03, ['stress_yy', 'stress_zz', 'volumetricStrain'], pressure=p) for p in (5e4, 1e5)]",
                 'young=(1e6, 1e9), poisson=(0, .45), cohesion=(0, 5e4), frictionAngle=(.1, .9), dilationAngle=(0, .4)'),
        'Cam clay': (
                'MpmCamClayMat(density=2000, shearModulus=5e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=1.5e5, referencePressure=1e5)',
                "[measured(true, 'triaxial', -.15, ['q', 'volumetricStrain'], pressure=1e5, steps=30, every=1), measured(true, 'undrainedTriaxial', -.05, ['p'], pressure=1e5, steps=30, every=1)]",
                'shearModulus=(1e6, 1e8), criticalStateRatio=(.5, 2), compressionIndex=(.03, .3), swellingIndex=(1e-3, .029), preconsolidation=(1.01e5, 1e6)'
        ),
}


@pytest.mark.parametrize('law', laws)
def test_parameters_are_found_again(yade, law):
	"""From values of which the search knows no more than bounds."""
	material, tests, bounds = laws[law]
	run = yade(
	        setting + f'''
true, bounds = {material}, dict({bounds})
start = type(true)(**{{name: value for name, value in true.dict().items() if name not in bounds and name != 'id'}})
fit = mpm.calibrate(start, {tests}, bounds, steps={dict([('Cam clay', 30), ('Drucker-Prager', 40)]).get(law, 20)}, samples=8)
print(fit['report'])
print(json.dumps([{{name: fit['values'][name] / getattr(true, name) - 1 for name in bounds}}, fit['undetermined'], fit['atBounds'], fit['total'],
	[getattr(fit['material'], name) == fit['values'][name] for name in bounds], fit['uncertainty']]))
'''
	)
	errors, undetermined, atBounds, total, taken, uncertainty = run.result
	assert max(map(abs, errors.values())) < 1e-3, run.stdout
	assert not undetermined and not atBounds and total < 1e-3 and all(taken)


def test_tests_that_turn_back_and_weights(yade):
	"""Unloading tells stiffness from strength; of two tests that contradict each other a weight says which is believed."""
	assert yade(
	        setting + '''
from yade.mpm.laboratory.tests import curveAt
true = MpmMohrCoulombMat(**friction)
there = np.concatenate([np.linspace(0, -.02, 11), np.linspace(-.018, -.01, 5), np.linspace(-.012, -.03, 10)])
curve = curveAt('', true, 'triaxial', there, confiningPressure=1e5)
test = dict(kind='triaxial', confiningPressure=1e5, axialStrain=there, q=curve['q'][1:], volumetricStrain=curve['volumetricStrain'][1:])
fit = mpm.calibrate(MpmMohrCoulombMat(**friction | dict(cohesion=0)), [test], dict(young=(1e6, 1e9), frictionAngle=(.1, .9), dilationAngle=(0, .4)), steps=30, samples=6)
equal = fit['values']
assert abs(equal['young'] / 20e6 - 1) < 1e-3 and abs(equal['dilationAngle'] / (8 * degree) - 1) < .01 and equal['frictionAngle'] > 31 * degree

def oedometer(factor, **more): return dict(kind='oedometer', axialStrain=[-.001, -.002], stress_yy=[-factor * 1e4, -factor * 2e4], **more)
young = lambda tests: mpm.calibrate(MpmElasticMat(poisson=0, density=1), tests, dict(young=(1e6, 1e8)), samples=0)['values']['young']
low, high, middle = young([oedometer(1)]), young([oedometer(1.1)]), young([oedometer(1), oedometer(1.1)])
assert low < young([oedometer(1, weight=10), oedometer(1.1, weight={'stress_yy': .1})]) < low * 1.001 and low * 1.03 < middle < high * .97
print(1)
'''
	).result


def test_uncertainty_covers_the_truth(yade):
	"""Over many sets of readings with errors: squares of the error over the uncertainty are 1 in the mean; those of one set are less than 4 standard deviations off."""
	mean, worst, known = yade(
	        setting + '''
random, bounds = np.random.default_rng(1), dict(young=(1e6, 1e9), poisson=(0, .45), yieldStress=(1e3, 1e5))
true = MpmVonMisesMat(yieldStress=15e3, **elastic)
squares, spreads = [], []
for _ in range(25):
	test = measured(true, 'triaxial', -.003, ['q', 'volumetricStrain'], steps=20, every=1, pressure=3e4, noise=(random, .02))
	fit = mpm.calibrate(true, [test], bounds, steps=20, samples=0)
	squares.append([((fit['values'][name] - getattr(true, name)) / fit['uncertainty'][name])**2 for name in bounds])
	spreads.append([fit['uncertainty'][name] / getattr(true, name) for name in bounds])
	assert not fit['undetermined'] and np.allclose(np.sqrt(np.diag(fit['covariance'])), list(fit['uncertainty'].values()))
print(np.mean(squares, axis=0))
print(json.dumps([np.mean(squares), np.max(squares), np.max(spreads)]))
'''
	).result
	assert 0.6 < mean < 1.7 and worst < 16 and 1e-3 < known < 0.05


def test_what_tests_do_not_determine_is_named(yade):
	yade(
	        setting + '''
clay = MpmTrescaMat(undrainedStrength=12e3, **elastic)
undrained = measured(clay, 'undrainedTriaxial', -.01, ['q'], steps=20, every=1)
fit = mpm.calibrate(clay, [undrained], dict(young=(1e6, 1e9), poisson=(0, .45), undrainedStrength=(1e3, 1e5)), steps=20, samples=4)
assert fit['undetermined'] == ['young', 'poisson'] and fit['uncertainty']['poisson'] == inf, fit['report']
values = fit['values']
assert abs(values['undrainedStrength'] / 12e3 - 1) < 1e-6 and abs(values['young'] / (1 + values['poisson']) / (20e6 / 1.3) - 1) < 1e-6
assert 'not determined by these tests: young, poisson' in fit['report'], fit['report']

sand = MpmMohrCoulombMat(**friction)
one = measured(sand, 'triaxial', -.03, ['q'], steps=20, every=1, pressure=1e5, noise=(np.random.default_rng(3), .03))
fit = mpm.calibrate(sand, [one], dict(cohesion=(0, 5e4), frictionAngle=(.1, .9), tensileStrength=(1e3, 1e6)), steps=20, samples=4)
assert fit['undetermined'] == ['cohesion', 'frictionAngle', 'tensileStrength'] and fit['uncertainty']['tensileStrength'] == inf, fit['report']

# bounds say as much as readings with large errors
noisy = measured(sand, 'triaxial', -.03, ['q'], steps=20, every=1, pressure=1e5, noise=(np.random.default_rng(2), .3))
fit = mpm.calibrate(sand, [noisy], dict(frictionAngle=(.5, .54)), steps=20, samples=4)
assert fit['undetermined'] == ['frictionAngle'] and 0 < fit['uncertainty']['frictionAngle'] < 1, fit['report']

# a bound, and values beside those that the law refuses, stop the search
fit = mpm.calibrate(sand, [one], dict(frictionAngle=(.1, .4)), steps=20, samples=4)
assert fit['atBounds'] == ['frictionAngle'] and 'at a bound: frictionAngle' in fit['report']
loose, dense = (MpmMohrCoulombMat(**friction | dict(young=2e8, frictionAngle=angle * degree, dilationAngle=angle * degree)) for angle in (20, 40))
test = measured(dense, 'triaxial', -.03, ['volumetricStrain'], steps=20, every=1, pressure=1e5)
fit = mpm.calibrate(loose, [test], dict(dilationAngle=(0, .8)), steps=20, samples=4)
assert abs(fit['values']['dilationAngle'] - 20 * degree) < 1e-4 and 'dilationAngle' in fit['beside'] and 'beside values that are refused' in fit['report'], fit['report']
'''
	)


def test_picture(yade):
	run = yade(
	        setting + '''
import matplotlib.pyplot
true = MpmMohrCoulombMat(**friction)
tests = [measured(true, 'triaxial', -.03, ['q', 'volumetricStrain'], pressure=p) for p in (5e4, 1e5)] + [measured(true, 'simpleShear', .03, ['stress_xy'], pressure=1e5)]
for name in 'fit.png', 'fit.svg':
	mpm.calibrate(true, tests, dict(frictionAngle=(.1, .9)), steps=20, samples=0, fileName=name)
print(json.dumps(matplotlib.pyplot.imread('fit.png').shape))
'''
	)
	height, width, _ = run.result
	assert width < 1900 and height < 1300
	drawn = (run.folder / 'fit.svg').read_text()
	for text in 'triaxial at 50 kPa', 'simpleShear at 100 kPa', 'volumetricStrain [%]', 'shear strain [%]':
		assert f'<!-- {text}' in drawn, text


refused = [
        ('fit(unknown=(0, 1))', 'ValueError', "'unknown' is no parameter of MpmMohrCoulombMat; there are residualCohesion, "),
        ('fit(frictonAngle=(0, 1))', 'ValueError', "did you mean 'frictionAngle'"),
        ('fit(density=(1, 2))', 'ValueError', 'density has no effect'),
        ('fit(young=(2e6, 1e6))', 'ValueError', "bounds['young'] = (2000000.0, 1000000.0) must be the least value and then the largest"),
        ('fit(young=(1e6, inf))', 'ValueError', "bounds['young'] = (1000000.0, inf) must be finite"),
        ('fit(young=1e6)', 'TypeError', "bounds['young'] = 1000000.0 must be two numbers"),
        ('fit()', 'ValueError', 'names no parameter'),
        ("mpm.calibrate(sand, [good], [('young', 1, 2)])", 'TypeError', 'must be a dict'),
        ('mpm.calibrate(sand, [], angle)', 'ValueError', 'tests = [] has no curve to fit'),
        ('mpm.calibrate(sand, good, angle)', 'TypeError', 'must be a list of dicts'),
        ('mpm.calibrate(sand, [7], angle)', 'TypeError', 'tests[0] = 7 must be a dict'),
        ("tested(q=[1e5, np.nan])", 'ValueError', 'tests[0]: q[1] = nan is not finite (1 of 2 readings); leave such readings out'),
        ("tested(q=[1e5, 2e5, 3e5])", 'ValueError', 'q has 3 readings for 2 strains'),
        ("tested(q=['a', 'b'])", 'TypeError', 'must be numbers'),
        ("tested(q=[0, 0])", 'ValueError', 'q is 0 in all readings'),
        ("tested(q=[])", 'ValueError', 'must be a list of numbers'),
        ("tested(axialStrain=[0, 0])", 'ValueError', 'not all 0'),
        ("tested(axialStrain=[-1, -20])", 'ValueError', 'from -10 to 10'),
        ("tested(kind='simpleShear')", 'ValueError', 'axialStrain is that of a curve of another kind'),
        ("tested(kind='triaxal')", 'ValueError', "kind = 'triaxal' must be one of 'triaxial'"),
        ("tested(stress_xx=[1, 1])", 'ValueError', "stress_xx is prescribed in a test of kind 'triaxial'"),
        ("tested(kind='undrainedTriaxial', volumetricStrain=[1, 1])", 'ValueError', 'volumetricStrain is prescribed'),
        ("tested(volumetricStrian=[1, 1])", 'ValueError', "did you mean 'volumetricStrain'?"),
        ("tested(confiningPressure=-5)", 'ValueError', 'tests[0]: confiningPressure = -5 must be'),
        ("tested(initialStress=(0, 0, 0))", 'ValueError', 'give one of them'),
        ("tested(internals=dict(plasticStran=1))", 'ValueError', "did you mean 'plasticStrain'"),
        ("tested(weight=0)", 'ValueError', 'must be > 0'),
        ("tested(weight=dict(p=1))", 'ValueError', "weight has 'p', which is none of its curves q"),
        ("mpm.calibrate(sand, [dict(kind='triaxial', q=[1])], angle)", 'ValueError', 'axialStrain is missing'),
        ("mpm.calibrate(sand, [dict(kind='triaxial', axialStrain=[-1])], angle)", 'ValueError', 'has no readings'),
        ("mpm.calibrate(sand, [dict(kind='triaxial', axialStrain=[-.1], q=[1])], angle | dict(young=(1, 2)))", 'ValueError', '1 readings are fewer than the 2 parameters'),
        ("mpm.calibrate(7, [good], angle)", 'TypeError', 'must be a material of the plugin'),
        ("mpm.calibrate(sand, [good], angle, steps=0)", 'ValueError', 'steps = 0 must be >= 1'),
        ("mpm.calibrate(sand, [good], angle, samples=1.5)", 'TypeError', 'samples = 1.5 must be an integer'),
        ("mpm.calibrate(sand, [good], angle, fileName='x.xyz', steps=5, samples=0)", 'ValueError', 'must end in one of'),
        ("mpm.calibrate(MpmMohrCoulombMat(density=1), [good], angle)", 'ValueError', 'no values between the bounds are admitted, of 9 that were tried; the last: frictionAngle = '),
        ("mpm.calibrate(sand, [good], angle, test=1)", 'TypeError', "there is no argument 'test'; did you mean 'tests'?"),
        ("sys.modules['scipy.optimize'] = None; mpm.calibrate(sand, [good], angle)", 'ImportError', 'SciPy is not installed; it is the package python3-scipy'),
        ("mpm.typicalSand(60, 1e5, .3)", 'ValueError', 'relativeDensity = 60 must be a number from 0.1 to 1 [-]; it is a fraction, 0.6 for 60 %'),
        ("mpm.typicalSand(.6, 0, .3)", 'ValueError', 'pressure = 0 must be a number > 0 [Pa]'),
        ("mpm.typicalSand(.6, 1e5, .5)", 'ValueError', 'poisson = 0.5 must be'),
        ("mpm.typicalSand('dense', 1e5, .3)", 'TypeError', "relativeDensity = 'dense' must be"),
        ("mpm.typicalSand(.6, 1e5, .3, saturated=1)", 'TypeError', 'saturated = 1 must be True or False'),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	before = '''
import sys
sand, angle = MpmMohrCoulombMat(**friction), dict(frictionAngle=(.1, .9))
good = dict(kind='triaxial', confiningPressure=1e5, axialStrain=[-.01, -.02], q=[1e5, 2e5])
def fit(**bounds): return mpm.calibrate(sand, [good], bounds)
def tested(**changes): return mpm.calibrate(sand, [good | changes], angle)
'''
	return outcomesOf(tmp_path_factory.mktemp('calibration'), setting + before, [statement for statement, _, _ in refused])


@pytest.mark.parametrize('statement, kind, said', refused)
def test_bad_input_is_refused(outcomes, statement, kind, said):
	name, sentence = outcomes[statement]
	assert name == kind and said in sentence, outcomes[statement]
	assert sentence.startswith(('calibrate:', 'typicalSand:')), sentence


def test_typical_sand(yade):
	"""Values by hand: R = 0.5 at 100 and at 50 kPa, loose and dense. A triaxial test has the modulus and strength that the formulas mean."""
	run = yade(
	        setting + '''
near = lambda values, **expected: all(abs(values[name] - number) <= 1e-6 * abs(number) for name, number in expected.items())
assert near(mpm.typicalSand(.5, 100e3, .2), young=30e6, poisson=.2, density=17e3 / 9.81, cohesion=0, frictionAngle=34.25 * degree, dilationAngle=4.25 * degree)
assert near(mpm.typicalSand(.5, 50e3, .2, saturated=True), young=30e6 * .5**.54375, density=19.8e3 / 9.81)
assert near(mpm.typicalSand(1, 400e3, .2), young=60e6 * 4**.3875, frictionAngle=40.5 * degree, dilationAngle=10.5 * degree)
assert near(mpm.typicalSand(.1, 100e3, .2), young=6e6, frictionAngle=29.25 * degree, dilationAngle=0)
sand = mpm.typicalSand(.8, 50e3, .3)
for law in MpmMohrCoulombMat, MpmDruckerPragerMat: law(**sand)
curve = mpm.elementTest(MpmMohrCoulombMat(**sand), 'triaxial', -.05, steps=500, confiningPressure=50e3)
s = sin(sand['frictionAngle'])
strength, half = 50e3 * 2 * s / (1 - s), np.argmax(curve['q'] > curve['q'].max() / 2)
assert abs(curve['q'].max() / strength - 1) < 1e-6 and abs(curve['q'][half] / -curve['axialStrain'][half] / sand['young'] - 1) < .01
'''
	)
	assert 'relativeDensity = 0.1 a dilation of -0.75 degrees' in run.stdout + run.stderr
