# SPDX-License-Identifier: GPL-2.0-or-later
"""Requirements of a law of the plugin, for each of them: every_law.py, which says what each check does, tries all of it in one process."""
import subprocess
from math import radians, sin

import pytest
from conftest import Yade, root

clay, sand = (3 * ratio / (6 + ratio) for ratio in (1.2, 1.27))  # sine of the angle of friction by that of critical states
jaky = lambda sine, first=None: ((1 - sine) if first is None else first) * 1.5**sine  # for the OCR of the scenes
loose, firm = jaky(.5), jaky(sin(radians(35)), .43)
hardening = {'stiffness', 'shearHardening', 'capPressure', 'mobilisedFriction', 'volumetricStrain'}
small = hardening | {'strainHistoryXX', 'strainHistoryYY', 'strainHistoryZZ', 'strainHistoryXY'}
plastic = {'plasticStrain'}

# K0, and the variables of its own that change below a footing
laws = {
        'elastic': (3 / 7, set()),
        'von Mises': (3 / 7, plastic),
        'Tresca': (3 / 7, plastic),
        'Drucker-Prager': (loose, plastic),
        'Mohr-Coulomb': (loose, plastic),
        'Drucker-Prager, power': (loose, plastic | {'stiffness'}),
        'Mohr-Coulomb, power': (loose, plastic | {'stiffness'}),
        'softening': (loose, plastic | {'softening'}),
        'softening, nonlocal': (loose, plastic | {'softening'}),
        'Cam clay': (jaky(clay), plastic | {'preconsolidation'}),
        'hardening soil': (firm, plastic | hardening),
        'hardening soil, small strain': (firm, plastic | small),
        'NorSand': (jaky(sand), plastic | {'imagePressure', 'specificVolume'}),
        'viscous von Mises': (3 / 7, plastic),
        'viscous Drucker-Prager': (loose, plastic),
        'relaxing Mohr-Coulomb': (loose, plastic),
        'relaxing softening': (loose, plastic | {'softening'}),
        'relaxing Cam clay': (jaky(clay), plastic | {'preconsolidation'}),
        'relaxing hardening soil': (firm, plastic | small),
        'relaxing NorSand': (jaky(sand), plastic | {'imagePressure', 'specificVolume'}),
        'user': (.5, {'state1', 'stressBeforeXY', 'strainXY'}),
}
flowing = {name: 'viscosity' if name.startswith('viscous') else 'relaxationTime' for name in laws if name.startswith(('viscous', 'relaxing'))}
inMemory = 'the strength of which follows from what its points remember'

# Refusals, with words of their sentence.
refused = {(name, 'static'): (attribute, 'seconds') for name, attribute in flowing.items()}
refused |= {(name, check): ('with inertia', 'MpmImplicitEngine') for name in flowing for check in ('excavation', 'replacement')}
refused |= {(name, 'explicit'): ('nonlocalLength', "scheme = 'explicit'") for name in ('softening, nonlocal', 'relaxing softening')}
refused |= {('elastic', 'strength'): ('MpmElasticMat', 'carry any load')}
refused |= {(name, 'strength'): ('MpmHardeningSoilMat', inMemory) for name in ('hardening soil', 'hardening soil, small strain')}
refused |= {(name, 'strength'): (law, inMemory) for name, law in (('Cam clay', 'MpmCamClayMat'), ('NorSand', 'MpmNorSandMat'), ('user', 'MpmUserMat'))}
refused |= {(name, 'strength'): (attribute, 'strengthReduction') for name, attribute in flowing.items()}


def requireRest(name, found):
	"""The vertical stress is the weight, the horizontal one K0 of that, and nothing moves."""
	assert found['stress'] < 1e-6 and found['moved'] < 1e-9
	assert found['ratio'] == pytest.approx(laws[name][0], rel=1e-9) and found['spread'] < 1e-9


def requireSettled(name, found):
	"""Steps with F-bar and without have followed the footing by 8 mm, of which points below it, not at its face, have most, and the pressure has grown from that of a metre."""
	requireRest(name, found)
	assert found['isFinite'] and -8e-3 < found['settled'] < -6e-3
	assert found['pressed'] > 1.3
	if 'plasticStrain' in laws[name][1]: assert found['plastic'] > 1e-4


def static(name, found):
	requireSettled(name, found)


def dynamic(name, found):
	requireSettled(name, found)


def explicit(name, found):
	requireRest(name, found)
	assert found['isFinite'] and -5e-4 < found['settled'] < -3e-4


def restart(name, found):
	assert found['other'] == []
	assert laws[name][1] <= set(found['changed']) <= set(found['columns'])


def water(name, found):
	requireRest(name, found)


def undrained(name, found):
	"""The water takes the pressure: its excess is many times the effective stress."""
	requireSettled(name, found)
	assert found['excess'] > 5 * found['pressed']


def strength(name, found):
	"""A bank of 2 m that stands, between one and the fivefold of its strength."""
	assert 1 < found['lower'] < found['upper'] < 5


def excavation(name, found):
	"""Points are gone; the stress below is that of the weight that is left, to that of a tenth of a metre, and the ground has heaved."""
	assert found['points'] == 48 and found['stress'] < .1 and 0 < found['heave'] < 5e-3


def replacement(name, found):
	assert found['points'] == 32 and found['moved'] < 1e-9 and found['stress'] < 1e-9


def element(name, found):
	"""The curve of a triaxial test: the stress that is kept, and one that has grown."""
	assert found['isFinite'] and found['kept'] < 1e-6 and found['q'] > 20e3


def tangent(name, found):
	"""The tangent is the slope of the stress, to the round-off of differences."""
	assert found['tangentError'] < 1e-7 and found['worst'] < 1e-6 and found['stress'] < 1e-9


checks = {check.__name__: check for check in (static, dynamic, explicit, restart, water, undrained, strength, excavation, replacement, element, tangent)}


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	folder = tmp_path_factory.mktemp('laws')
	subprocess.run(['g++', '-shared', '-fPIC', '-o', folder / 'law.so', root / 'tests/umat/von_mises.cpp'], check=True)
	return Yade(folder)(root / 'tests/scene/materials/every_law.py', folder / 'law.so').result


def cells():
	for name in laws:
		for check in checks:
			yield pytest.param(name, check, id=f'{name}: {check}')


@pytest.mark.parametrize('name, check', cells())
def test_law(outcomes, name, check):
	kind, found = outcomes[name][check]
	if (name, check) in refused:
		assert kind == 'ValueError' and all(word in found for word in refused[name, check]), (kind, found)
		return
	assert not kind, (kind, found)
	checks[check](name, found)


def test_all_laws_and_checks_are_there(outcomes):
	assert outcomes.keys() == laws.keys() and all(tried.keys() == checks.keys() for tried in outcomes.values())
