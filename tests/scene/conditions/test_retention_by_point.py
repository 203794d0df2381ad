# SPDX-License-Identifier: GPL-2.0-or-later
"""Retention curves that differ from point to point, and that change with the pores."""
import pytest

setting = '''
import json

import numpy as np
from yade import mpm

w, k, h = 9810., 1e-5, .1

def ground(curves, materials=('lower', 'upper'), by=lambda x: 'lower' if x[1] < .5 else 'upper', head=lambda y: -2., drains=(), young=1e7, **flow):
	"""Two layers of half a metre, each with its curve; held at the sides and at the base."""
	O.reset()
	for label, curve in zip(materials, curves):
		O.materials.append(MpmElasticMat(young=young, poisson=0.2, density=2000, conductivity=k, porosity=.4, retention=curve, label=label))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (h, 0), (h, 1), (0, 1)]), grid, 2, by))
	mpm.assign(excessPressure=[w * head(y) for y in mpm.arrays()['pos'][:, 1]])
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	flow = MpmFlow(total=True, drains=list(drains), **flow)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1), (1, 1)], flow=flow, verbosity=0)]
	O.engines[0].newton.tolerance = 1e-11
	return O.engines[0]

def rain(): return [MpmDrain(surface=[(h, 1), (0, 1)], rain=2e-6), MpmDrain(surface=[(0, 0), (h, 0)], pressure=-2 * w)]

def totalStress(): return __import__('sys').modules['yade.mpm.points.data'].fields()['totalStress']

def found():
	points = mpm.arrays()
	return np.concatenate([points[name].ravel() for name in ('pos', 'stress', 'excessPressure', 'saturation', 'waterFlux')]).tolist()
'''


@pytest.mark.parametrize('curve, changes', [
        ('MpmVanGenuchten(alpha=3.35, n=2, residual=.2)', dict(alpha=1.5, n=1.6, residual=.1, saturated=.95)),
        ('MpmGardner(alpha=2, residual=.1)', dict(alpha=.7, residual=.2, saturated=.9)),
        ('MpmBrooksCorey(entry=.5, exponent=1.2)', dict(entry=.3, exponent=.8, residual=.15)),
])
def test_points_with_curves_of_their_own_are_as_two_materials(yade, curve, changes):
	"""Rain on two layers: two materials, and one of which the upper points have parameters of their own; from mpm.geostatic on."""
	two, one, read = yade(
	        setting + f'''
lower, changes = {curve}, {changes!r}
upper = type(lower)(**(lower.dict() | changes))
def run():
	mpm.geostatic(K0=.4, waterTable=-2, infiltration=1e-8)
	O.dt = 20
	for _ in range(5): O.step()
	return found()
ground([lower, upper], drains=rain())
two = run()
ground([lower], ['lower'], lambda x: 'lower', drains=rain())
points = mpm.arrays()
isUpper = points['pos'][:, 1] > .5
mpm.assign(ids=points['id'][isUpper], **{{name: [value] * int(isUpper.sum()) for name, value in changes.items()}})
one = run()
read = [sorted(set(mpm.arrays()[name].round(12).tolist())) for name in changes]
print(json.dumps([two, one, read]))
'''
	).result
	assert len(two) == len(one) and max(map(abs, two)) > 1e4
	assert one == pytest.approx(two, rel=1e-9, abs=1e-9)
	assert all(value in values and len(values) == 2 for value, values in zip(changes.values(), read, strict=True))


def test_soil_that_is_compressed_follows_its_curve(yade):
	"""Suction counts times (e / e0)^psi: a column that no water leaves, squeezed by 12 %, has its water, and in each step the saturation of its curve at the suction that is left."""
	rows, lost, fixed, total = yade(
	        setting + '''
def squeezed(psi):
	solver = ground([MpmVanGenuchten(alpha=1.5, n=1.8, residual=.1, voidExponent=psi)], ['soil'], lambda x: 'soil', young=.7e6)
	solver.gravity = (0, 0, 0)
	solver.loads = [MpmTraction(surface=mpm.surface(mpm.polygon([(0, 0), (h, 0), (h, 1), (0, 1)]), min=(-1, .9)), pressure=1e5)]
	solver.loadCurve, rows = [(0, 0), (4, 1)], []
	O.dt = 1
	for _ in range(4):
		O.step()
		points = mpm.arrays()
		volume0 = np.array([O.bodies[int(i)].state.volume0 for i in points['id']])
		J = points['volume'] / volume0
		rows.append([float(np.ptp(column)) if spread else float(column.mean()) for column in (J, points['saturation'], points['excessPressure']) for spread in (0, 1)])
		content = float((points['saturation'] * (J - .6) * volume0).sum())
	return solver, rows, content, float(totalStress()[:, 1, 1].mean())
solver, rows, content, total = squeezed(2.5)
begun = .4 * h * (.1 + .9 * (1 + (1.5 * 2)**1.8)**(1 / 1.8 - 1))
print(json.dumps([rows, content / begun - 1, squeezed(0.)[1], total]))
'''
	).result
	assert abs(lost) < 1e-12
	for J, unevenJ, S, unevenS, p, unevenP in rows:
		assert unevenJ < 1e-8 and unevenS < 1e-8 and unevenP < 1e-3
		head = -p / 9810 * ((J - .6) / .4)**2.5
		assert S == pytest.approx(.1 + .9 * (1 + (1.5 * head)**1.8)**(1 / 1.8 - 1), rel=1e-9)
	assert rows[-1][0] < .89
	assert rows[-1][4] < fixed[-1][4] - 1000, 'small pores hold more suction'
	assert total == pytest.approx(-1e5 / .999, rel=.02)


def test_curves_of_points_are_checked(yade):
	said = yade(
	        setting + '''
said = []
def attempt(change, *curves):
	ground([*curves], ['soil'], lambda x: 'soil')
	try: change(), O.step()
	except Exception as error: said.append(f'{type(error).__name__}: {error}')
sand, table = MpmVanGenuchten(alpha=3, n=2, residual=.2), MpmRetentionTable(saturations=[(0, 1), (4, .2)], permeabilities=[(0, 1), (4, .1)])
all = lambda **columns: mpm.assign(**{name: [value] * len(mpm.arrays()['id']) for name, value in columns.items()})
O.dt = 1
attempt(lambda: all(n=.9), sand)
attempt(lambda: all(residual=.9, saturated=.8), sand)
attempt(lambda: all(entry=1), sand)
attempt(lambda: all(alpha=1), table)
try: sand.voidExponent = -1
except Exception as error: said.append(f'{type(error).__name__}: {error}')
print(json.dumps(said))
'''
	).result
	for text, words in zip(said, (('n = 0.9', '> 1'), ('residual = 0.9', 'saturated = 0.8'), ('entry', 'alpha'), ('alpha', ), ('voidExponent = -1', )), strict=True):
		assert text.startswith('ValueError') and all(word in text for word in words), text


def test_soil_under_suction_is_replaced_at_rest(yade):
	"""A column with hydrostatic suction, the lower half of which becomes another soil: total stress and pressures stay, and nothing moves but by the weight of other water."""
	moved, stress, pressure, wet = yade(
	        setting + '''
solver = ground([MpmVanGenuchten(alpha=1.5, n=1.8, residual=.1)], ['soil'], lambda x: 'soil', head=lambda y: -2 - y, young=1e7)
O.materials.append(MpmElasticMat(young=5e7, poisson=0.2, density=2000, conductivity=1e-6, porosity=.4, retention=MpmGardner(alpha=.6), label='grout'))
mpm.geostatic(K0=.5, waterTable=-2)
O.dt = 1
O.step()
before, total = mpm.arrays(), totalStress()
mpm.stages.replace(mpm.polygon([(-1, -1), (1, -1), (1, .5), (-1, .5)]), 'grout')
solver.loadCurve = [(0, 1), (9, 1)]
O.dt = 1e-3
O.step()
after = mpm.arrays()
lower = after['pos'][:, 1] < .5
print(json.dumps([float(abs(after['pos'] - before['pos']).max()), float(abs(totalStress() - total).max()),
	float(abs(after['excessPressure'] - before['excessPressure'])[after['pos'][:, 1] < .3].max()), [after['excessPressure'][lower].tolist(), after['saturation'][lower].tolist()]]))
'''
	).result
	from math import exp
	for p, S in zip(*wet):
		assert S == pytest.approx(exp(.6 * p / 9810), rel=2e-3)
	assert moved < 1e-5 and stress < 1500 and pressure < 500
