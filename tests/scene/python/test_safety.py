# SPDX-License-Identifier: GPL-2.0-or-later
"""Strength reduction against closed forms, and what it refuses."""
import math

import pytest
from conftest import Yade

scene = '''
import json
from scenes import *
from yade.wrapper import MpmCamClayMat, MpmDruckerPragerMat, MpmMohrCoulombMat, MpmTrescaMat

phi, c, q = radians(20), 10e3, 16e3
common = dict(young=2e8, poisson=.3, density=1, label='soil')
laws = dict(tresca=MpmTrescaMat(undrainedStrength=c, **common), mises=MpmVonMisesMat(yieldStress=2**.5 * c, **common),
            friction=MpmMohrCoulombMat(cohesion=c, frictionAngle=phi, dilationAngle=phi, **common),
            cone=MpmDruckerPragerMat(cohesion=c, frictionAngle=phi, dilationAngle=phi, **common))

def block(material, **fields):
	"""A block on a smooth base under a pressure q on its surface."""
	O.reset()
	O.materials.append(material)
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (3, 6, 1)), grid, 2, 'soil', **fields))
	for b in O.bodies:
		share = {5.75: 1.5, 5.25: -.5}.get(b.state.pos[1], 0) # together they act at the surface, so that stress is uniform
		b.state.force = (0, -q / 2 * share, 0)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')], verbosity=0, label='solver')]
	O.dt = 1 / 4
	O.run(4, wait=True)
	return O.engines[0]
'''


def strength(F):
	"""Strength of the block with friction, uniaxial in plane strain."""
	angle = math.atan(math.tan(math.radians(20)) / F)
	return 2 * 10e3 / F * math.cos(angle) / (1 - math.sin(angle))


@pytest.fixture(scope='module')
def found(tmp_path_factory):
	return Yade(tmp_path_factory.mktemp('safety'))(
	        scene + '''
import io, contextlib
found = {}
for name, law in laws.items():
	block(law)
	before, said = mpm.arrays(), io.StringIO()
	with contextlib.redirect_stdout(said):
		safety = mpm.strengthReduction(tolerance=.004)
	assert all(values.tobytes() == before[column].tobytes() for column, values in mpm.arrays().items())
	assert 'cells of 1 m' in said.getvalue() and 'failed: no equilibrium' in said.getvalue()
	found[name] = safety['lower'], safety['upper'], safety['plasticStrain'].max()
	O.step() # and the scene goes on
# strengths of the points instead of the material's
block(laws['tresca'], undrainedStrength=lambda x: 2 * c)
safety = mpm.strengthReduction(tolerance=.004)
found['field'] = safety['lower'], safety['upper'], safety['plasticStrain'].max()
# what is refused
messages = []
def refused(f):
	try: f()
	except (ValueError, TypeError) as error: messages.append(str(error))
	else: messages.append('')
block(MpmElasticMat(**common))
refused(mpm.strengthReduction)
block(laws['tresca'])
for bad in dict(tolerance=0), dict(tolerance='1'), dict(first=-1), dict(factor=1): refused(lambda: mpm.strengthReduction(**bad))
refused(lambda: O.engines[0].weakened(0))
for b in O.bodies: b.state.force = (0, 0, 0)
clay = MpmCamClayMat(density=2000, shearModulus=3e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=8e4, referencePressure=5e4, label='clay')
O.materials.append(clay)
O.bodies[0].material = clay
refused(mpm.strengthReduction)
print(json.dumps([found, messages]))
'''
	).result


@pytest.mark.parametrize('name', ['tresca', 'mises', 'friction', 'cone', 'field'])
def test_block(found, name):
	lower, upper, slip = found[0][name]
	assert 0 < upper - lower <= 0.004 * lower and slip > 0
	if name in ('friction', 'cone'):
		tolerance = .005 if name == 'friction' else .015  # the cone comes to its strength as the stress out of the plane does, in the course of flow
		assert strength(lower) >= 16e3 * (1 - tolerance) and strength(upper) <= 16e3 * (1 + tolerance)
	else: assert lower <= 1.005 * (exact := 20 / 16 * (2 if name == 'field' else 1)) and upper >= .995 * exact


def test_refused(found):
	expected = ['all materials are elastic', 'tolerance = 0', "tolerance = '1' must be a number", 'first = -1', 'factor = 1', 'expected a finite number > 0', 'Body #0 is of MpmCamClayMat']
	for part, message in zip(expected, found[1], strict=True):
		assert part in message, (part, message)


def test_a_body_that_a_contact_holds_has_the_factor_of_one_that_nodes_hold(yade):
	"""The scaled moduli leave the forces of the penalty as they are: on a smooth plate as on rollers, with friction as on held nodes, and with a gap that carries nothing."""
	found = yade(
	        scene + '''
from yade import utils

def stands(how):
	O.reset()
	O.materials.append(MpmTrescaMat(young=1e7, poisson=.3, density=2000, undrainedStrength=60e3, label='soil'))
	O.materials.append(FrictMat(young=1e9, frictionAngle=0, density=2000, label='steel'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4, 0), (4, 2), (0, 2)]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x')]
	if how in ('nodes', 'held'): held.append(MpmBoundary(max=(inf, 0, inf), fix='y' if how == 'nodes' else 'xy'))
	else: O.bodies.append(utils.wall(0, axis=1, sense=1, material='steel'))
	contacts = dict(nodes=[], held=[]).get(how, [MpmContact(friction=1.5 if how == 'rough' else 0, stiffness=1000 if how == 'rough' else 100)])
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, contacts=contacts, verbosity=0)]
	O.dt = .25
	O.run(4, wait=True)
	kept = [contact.dict() for contact in contacts], mpm.arrays()['pos'].tobytes()
	safety = mpm.strengthReduction(tolerance=.01, first=2)
	assert kept == ([contact.dict() for contact in contacts], mpm.arrays()['pos'].tobytes()), 'the scene is left alone'
	return safety['lower'], safety['upper']

print(json.dumps({how: stands(how) for how in ('nodes', 'smooth', 'held', 'rough')}))
''').result
	for nodes, contact in ('nodes', 'smooth'), ('held', 'rough'):
		assert abs(found[contact][0] / found[nodes][0] - 1) < 0.03, found


def test_cells_that_carry_more_than_a_plane_slip_are_refused(yade):
	"""Sand without cohesion stands at 45 degrees on cells of 1 m, where tan(phi) / tan(beta) is 0.70; clay of the same slope has its number."""
	told, found = yade(
	        scene + """
def slope(cohesion, friction):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=2e7, poisson=.3, density=2000, cohesion=cohesion, frictionAngle=radians(friction), label='soil'))
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (12, 0), (12, 2), (9, 2), (5, 6), (0, 6)]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(12, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=held, verbosity=0)]
	O.dt = 1 / 10
	O.run(10, wait=True)
	return mpm.strengthReduction(tolerance=.1)['lower']

try: told = str(slope(0, 35))
except ValueError as error: told = str(error)
print(json.dumps([told, slope(2e4, 20)]))
"""
	).result
	assert told.startswith('strengthReduction: cells of 1 m carry') and 'tan(phi) / tan(beta)' in told and 'halved cells' in told, told
	assert 1 < found < 3


def test_factors_in_time_leave_the_run_as_it_is(yade):
	"""A slope under rain goes on with the same bits as without factors, and these fall; what cannot be done is refused by name before a step is made."""
	differ, times, factors, bounds, failed, refusals, steps = yade(
	        scene + '''
import numpy as np
from yade.wrapper import MpmDrain, MpmDynamicEngine, MpmFlow, MpmVanGenuchten

beta, H, h = np.radians(40), 1., .2

def rainy(rain=2e-6, law=MpmMohrCoulombMat, engine=MpmImplicitEngine, **strength):
	O.reset()
	O.materials.append(law(young=1e8, poisson=.3, density=1900, conductivity=1e-6, porosity=.4, retention=MpmVanGenuchten(alpha=1, n=2), label='soil', **strength))
	grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3 * h, 0), (3 * h, H), (0, H)]), grid, 2, 'soil'))
	mpm.assign(excessPressure=[-2e4 - 9810 * np.cos(beta) * y for y in mpm.arrays()['pos'][:, 1]])
	flow = MpmFlow(total=True, drains=[MpmDrain(surface=[(3 * h, H), (0, H)], rain=rain)])
	O.engines = [engine(grid=grid, gravity=(9.81 * np.sin(beta), -9.81 * np.cos(beta), 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], flow=flow, loadCurve=[(0, 1), (1, 1)], verbosity=0)]
	O.dt = 3600

sand = dict(cohesion=1e3, frictionAngle=radians(32), dilationAngle=radians(32))

def state(): return mpm.arrays(), np.array([O.engines[0].flow.waterIn, O.engines[0].flow.waterStored, O.engines[0].loadTime, O.time, O.iter])

rainy(**sand)
for _ in range(8): O.step()
alone = state()
rainy(**sand)
found = mpm.safetyInTime([3600, 7200, 14400, 18000], tolerance=.02)
for _ in range(3): O.step()
points, water = state()
differ = [name for name, values in points.items() if values.tobytes() != alone[0][name].tobytes()] + ['water'] * (water.tobytes() != alone[1].tobytes())
# until no equilibrium is left
rainy(2e-5, **dict(sand, cohesion=100))
failing = mpm.safetyInTime([3600 * hour for hour in range(1, 400, 8)], tolerance=.05)
refusals = []
def refused(make, *arguments, **more):
	make()
	try: mpm.safetyInTime(*arguments, **more)
	except (ValueError, TypeError) as error: refusals.append(str(error))
	else: refusals.append('')
def begun():
	rainy(**sand)
	O.step(), O.step()
def still():
	rainy(**sand)
	O.dt = 0
refused(lambda: rainy(law=MpmElasticMat), [3600])
refused(lambda: rainy(engine=MpmDynamicEngine, **sand), [3600])
refused(begun, [3600])
refused(still, [3600])
for bad in 3600, [], ['a'], [7200, 3600]: refused(lambda: rainy(**sand), bad)
print(json.dumps([differ, found['time'].tolist(), found['factor'].tolist(), (found['upper'] - found['lower']).tolist(),
	[failing['failureTime'], failing['factor'].tolist(), failing['end'], float(failing['time'][-1]), O.engines[0].loadTime], refusals, O.iter]))
'''
	).result
	assert not differ and times == [3600, 7200, 14400, 18000]
	assert factors[0] > factors[-1] > 1 and max(bounds) < 0.03
	time, values, end, last, reached = failed
	assert values[0] > values[-1] and len(values) < 50
	if values[-1] < 1: assert values[-2] >= 1 and last - 8 * 3600 <= time <= last, 'the factor passes one there'
	else: assert end and last <= time == reached, 'no equilibrium is left'
	for part, message in zip(
	        ['all materials are elastic', 'MpmDynamicEngine', 'O.time is 7200 s already', 'O.dt = 0', 'times = 3600', 'times = []', "times = ['a']", 'must grow'], refusals, strict=True
	):
		assert message.startswith('safetyInTime: ') and part in message, (part, message)
