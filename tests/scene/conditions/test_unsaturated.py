# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil that is not saturated, rain and evaporation, through the classes of YADE."""
import pytest

setting = '''
import json

import numpy as np
from yade import mpm

w, k = 9810., 1e-5
sand = lambda **more: MpmVanGenuchten(**(dict(alpha=3.35, n=2, residual=.2) | more))

def column(head=lambda y: -2., cells=10, base=-2., young=1e9, retention=True, drained=True, top=dict(rain=2e-6), engine=MpmImplicitEngine, **flow):
	"""One cell wide, 1 m high, rain on its top, a head at its base."""
	O.reset()
	h = 1 / (cells + .5)
	O.materials.append(MpmElasticMat(young=young, poisson=0.2, density=2000, conductivity=k, porosity=.4, retention=sand() if retention else None, label='soil'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (h, 0), (h, 1), (0, 1)]), grid, 2, 'soil'))
	mpm.assign(excessPressure=[w * head(y) for y in mpm.arrays()['pos'][:, 1]])
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	drains = ([MpmDrain(surface=[(h, 1), (0, 1)], **top)] if top else []) + [MpmDrain(surface=[(0, 0), (h, 0)], pressure=base * w)] * drained
	O.engines = [engine(grid=grid, boundaries=sides, gravity=(0, -9.81, 0), flow=MpmFlow(**(dict(total=True, drains=drains) | flow)), loadCurve=[(0, 1), (1, 1)], verbosity=0)]
	O.engines[0].newton.tolerance = 1e-10
	return O.engines[0]

def weight(points):
	"""Of saturated soil, less what its pores have lost."""
	V0 = np.array([O.bodies[int(i)].state.volume0 for i in points['id']])
	return V0 * 2000 * 9.81 + w * (points['saturation'] * (points['volume'] - .6 * V0) - .4 * V0)

def refusal(change=lambda solver: None, **settings):
	solver = column(**settings)
	O.dt = 10
	try:
		change(solver)
		O.step()
	except Exception as error: return f'{type(error).__name__}: {error}'
	return ''
'''


def test_rain_is_counted_and_a_saved_scene_goes_on(yade):
	counted, content, range_, names, differ = yade(
	        setting + '''
def content():
	points = mpm.arrays()
	return float((points['volume'] * (1 - .6 * np.array([O.bodies[int(i)].state.volume0 for i in points['id']]) / points['volume']) * points['saturation']).sum())

solver = column()
O.dt = 100
O.step()
first, before = content(), solver.flow.waterStored
dts = [100 * 1.2**n for n in range(1, 13)]
for n in range(12):
	if n == 8: O.save('wet.yade.gz')
	O.dt = dts[n]
	O.step()
data, points = solver.plotData(), mpm.arrays()
gained = content() - first, solver.flow.waterStored - before
O.load('wet.yade.gz')
for dt in dts[8:]:
	O.dt = dt
	O.step()
again = mpm.arrays()
print(json.dumps([[data[name] for name in ('waterIn', 'waterOut', 'waterStored')], gained, [float(points['saturation'].min()), float(points['saturation'].max())],
	sorted(points), {name: float(abs(points[name] - values).max()) for name, values in again.items() if name != 'id' and (points[name] != values).any()}]))
'''
	).result
	came, left, stored = counted
	assert came > 0 and came - left - stored == pytest.approx(0, abs=1e-10 * came)
	assert content[0] == pytest.approx(content[1], rel=1e-9), 'the points have what has been counted'
	assert 0.2 < range_[0] < range_[1] < 1
	assert {'saturation', 'excessPressure', 'porePressure', 'waterFlux'} <= set(names)
	assert not differ, 'a scene that was saved goes on with the same bits'


def test_suction_at_rest_stays(yade):
	moved, flux, pressures, reaction, weight = yade(
	        setting + '''
solver = column(lambda y: .3 - y, base=.3, top=None, young=1e7)
for _ in range(3):
	O.dt = 1e9
	O.step()
before = mpm.arrays()['pos']
O.step()
points = mpm.arrays()
saturated = 1 - .6 * np.array([O.bodies[int(i)].state.volume0 for i in points['id']]) / points['volume']
weight = 9.81 * sum(O.bodies[int(i)].state.mass for i in points['id']) + w * float((points['volume'] * saturated * points['saturation']).sum()) - w * .4 * sum(O.bodies[int(i)].state.volume0 for i in points['id'])
print(json.dumps([float(abs(points['pos'] - before).max()), float(abs(points['waterFlux']).max()), float(abs(points['porePressure'] - w * (.3 - points['pos'][:, 1])).max()),
	solver.reactions[2][1], weight]))
'''
	).result
	assert moved < 1e-11 and flux < 1e-10 * 1e-5 and pressures < 1e-10 * 9810
	assert reaction == pytest.approx(weight, rel=1e-6), 'the weight is that of the grains and of the water that is there'


def test_rain_ponds_and_fields_count(yade):
	rates, heads, flux = yade(
	        setting + '''
solver = column(cells=40, top=dict(rain=3e-5))
rates = []
O.dt = 30
for _ in range(40):
	O.step()
	rates.append(-solver.flow.drains[0].discharge / (solver.grid.cellSize * k))
solver = column(base=-1, top=dict(rain=2e-6))
mpm.assign(conductivity=[1e-5 if y < 5 * solver.grid.cellSize else 2e-5 for y in mpm.arrays()['pos'][:, 1]])
O.dt = 1e9
for _ in range(3): O.step()
points = mpm.arrays()
y = points['pos'][:, 1] / solver.grid.cellSize
print(json.dumps([rates, [float(points['excessPressure'][abs(y - at) < .3].mean()) / w for at in (4.75, 10.25)], float(points['waterFlux'][y > 10, 1].mean())]))
'''
	).result
	assert rates[0] == pytest.approx(3) and rates[-1] < 2.5
	first = next(i for i, rate in enumerate(rates) if rate < 2.999)
	assert all(rate < 3 for rate in rates[first:]), 'the switch does not ring'
	assert flux == pytest.approx(-2e-6, rel=1e-6)
	for head, part in zip(heads, (0.2, 0.1)):  # below and above a jump of the conductivity: water falls by its weight
		Se = (1 + (3.35 * head)**2)**-0.5
		assert Se**0.5 * (1 - (1 - Se**2)**0.5)**2 == pytest.approx(part, rel=0.03)


def test_steps_go_by_the_error_of_saturation(yade):
	"""One O.dt in which rain wets dry sand: the parts are as short as the tolerance asks for, and the saturations differ from those of 480 steps by less than it."""
	found = yade(
	        setting + '''
def wetted(steps=1, **flow):
	solver = column(cells=40, top=dict(rain=3e-5), **flow)
	if flow: solver.newton.stepTolerance, solver.newton.minStep = 1., 1 / 4096
	O.dt = 1200 / steps
	for _ in range(steps): O.step()
	return solver.substeps, mpm.arrays()['saturation']
_, fine = wetted(480)
rms = lambda saturation: float(np.sqrt(((saturation - fine)**2).mean()))
found = [[1, 1, rms(wetted()[1])]]
for tolerance in .05, .01, .002:
	parts, saturation = wetted(saturationTolerance=tolerance)
	found.append([tolerance, parts, rms(saturation)])
print(json.dumps(found))
'''
	).result
	(_, _, whole), *rows = found
	assert whole > 0.03
	assert all(error < tolerance for tolerance, _, error in rows)
	assert 1 < rows[0][1] < rows[1][1] < rows[2][1] < 100


def test_curves_have_their_saturation(yade):
	found = yade(
	        setting + '''
found = []
for curve in (sand(), sand(saturated=.9, permeability='gardner'), MpmGardner(alpha=2, residual=.1), MpmBrooksCorey(entry=.5, exponent=1.2),
              MpmRetentionTable(saturations=[(0, .95), (1, .5), (4, .2)], permeabilities=[(0, 1), (4, 1e-3)])):
	column(top=None)
	O.materials[0].retention = curve
	O.dt = 1
	O.step()
	found.append(float(mpm.arrays()['saturation'].mean()))
print(json.dumps(found))
'''
	).result
	Se = (1 + (3.35 * 2)**2)**-0.5
	from math import exp
	assert found == pytest.approx([0.2 + 0.8 * Se, 0.2 + 0.7 * Se, 0.1 + 0.9 * exp(-4), (0.5 / 2)**1.2, 0.4], rel=1e-4)


def test_what_does_not_go_with_it_is_refused_by_name(yade):
	said = yade(
	        setting + '''
def water(solver): solver.water = [MpmWater(level=1)]
def table(solver): O.materials[0].retention = MpmRetentionTable(saturations=[(0, 1), (1, .5)])
def residual(solver): O.materials[0].retention.residual, O.materials[0].retention.saturated = .6, .5
def base(solver): O.materials[0].retention = MpmRetention()
def both(solver): solver.flow.drains[0].flux = 1e-6
def tolerant(solver): solver.flow.saturationTolerance = .01
print(json.dumps([refusal(total=False, top=None), refusal(total=False, retention=False), refusal(water), refusal(table),
	refusal(residual), refusal(base), refusal(both), refusal(tolerant)]))
'''
	).result
	for text, words in zip(said, [
	        ('retention curve', 'total=True'), ('rain = 2e-06', 'total=True'), ('water[0]', "where = 'outside'"),
	        ('permeabilities', ), ('residual = 0.6', 'saturated = 0.5'), ('MpmVanGenuchten', ), ('flux', 'rain'), ('saturationTolerance = 0.01', 'stepTolerance')
	]):
		assert all(word in text for word in words), (text, words)


def test_suction_holds_a_slope_in_strength_reduction(yade):
	"""Factor of safety of an infinite slope whose base has suction: closed form with Bishop's suction stress."""
	low, high = yade(
	        setting + '''
beta, phi, H, h = np.radians(25), np.radians(30), 2., .25
O.materials.append(MpmMohrCoulombMat(young=1e8, poisson=0.3, density=19e3 / 9.81, cohesion=0, frictionAngle=phi, dilationAngle=phi, conductivity=1e-6, porosity=.002, retention=MpmVanGenuchten(alpha=1, n=2), label='soil'))
grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3 * h, 0), (3 * h, H), (0, H)]), grid, 2, 'soil'))
mpm.assign(excessPressure=[-1e4 - 9810 * np.cos(beta) * y for y in mpm.arrays()['pos'][:, 1]])
flow = MpmFlow(total=True, drains=[MpmDrain(surface=[(0, 0), (3 * h, 0)], pressure=-1e4)])
O.engines = [MpmImplicitEngine(grid=grid, gravity=(9.81 * np.sin(beta), -9.81 * np.cos(beta), 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], flow=flow,
                               loadCurve=[(0, 1), (1, 1)], verbosity=0, label='solver')]
O.dt = 1e6
for _ in range(2): O.step()
found = mpm.strengthReduction(tolerance=.04)
print(json.dumps([found['lower'], found['upper']]))
'''
	).result
	from math import cos, radians, sin, sqrt, tan
	beta, phi, s = radians(25), radians(30), 1e4
	vertical = 19e3 * 2 / cos(beta)
	factor = tan(phi) * (vertical * cos(beta)**2 + s / sqrt(1 + (s / 9810)**2)) / (vertical * sin(beta) * cos(beta))
	assert factor > 1.4 and (low + high) / 2 == pytest.approx(factor, rel=0.03)


def test_ground_with_suction_is_at_rest(yade):
	"""mpm.geostatic: effective stress with Bishop's suction stress, weight of the water that is there; hydrostatic, and with steady infiltration, in layers."""
	rest, stress, flows, said = yade(
	        setting + '''
def ground(q=0, layers=False, h=.25, **of):
	O.reset()
	for label, more in ('clay', dict(conductivity=1e-7, retention=sand(alpha=1.))), ('sand', {}):
		O.materials.append(MpmElasticMat(**(dict(young=1e7, poisson=0.2, density=2000, conductivity=k, porosity=.4, retention=sand(), label=label) | more)))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (.5, 0), (.5, 3), (0, 3)]), grid, 2, lambda x: 'clay' if layers and x[1] < 2 else 'sand'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(.5, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	drains = [MpmDrain(surface=[(0, 0), (.5, 0)], level=1, conductance=1e4), MpmDrain(surface=[(.5, 3), (0, 3)], rain=q)]
	if q: drains[0] = MpmDrain(surface=[(0, 0), (.5, 0)], flux=q)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, gravity=(0, -10, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1), (1, 1)], verbosity=0, flow=MpmFlow(total=True, drains=drains))]
	O.engines[0].newton.tolerance = 1e-11
	O.dt = 100
	mpm.geostatic(**of)

def moved():
	before = mpm.arrays()
	O.step()
	after = mpm.arrays()
	return [float(abs(after['pos'] - before['pos']).max()), float(abs(after['excessPressure'] - before['excessPressure']).max()), after['waterFlux'][:, 1].tolist()]

ground(waterTable=1)
points = mpm.arrays()
s = points['excessPressure']
stress = [points['pos'][:, 1].tolist(), s.tolist(), points['stress'][:, 1, 1].tolist(), points['stress'][:, 0, 0].tolist()]
rest = moved()
flows = []
for layers in False, True:
	ground(q=5e-8, layers=layers, h=.1, waterTable=1, infiltration=5e-8)
	flows.append(moved())
said = []
for change in dict(waterTable=1, infiltration=1e-3), dict(waterTable='1'):
	try: ground(**change)
	except Exception as error: said.append(str(error))
O.engines[0].flow.total = False
try: mpm.geostatic(waterTable=1)
except Exception as error: said.append(str(error))
print(json.dumps([rest, stress, flows, said]))
'''
	).result
	from scipy.integrate import quad
	assert rest[0] < 1e-10 and rest[1] < 1e-4 and max(map(abs, rest[2])) < 1e-14
	effective = lambda s: (1 + (3.35 * s / 9810)**2)**-0.5
	for y, p, vertical, horizontal in list(zip(*stress))[::5]:
		assert p == pytest.approx(9810 * (1 - y), abs=1e-6)
		weight = 2e4 * (3 - y) - 0.4 * 9810 * quad(lambda z: 0.8 * (1 - effective(max(0, 9810 * (z - 1)))), y, 3)[0]
		assert -vertical == pytest.approx(weight - (p if p > 0 else effective(-p) * p), rel=3e-3)
		assert horizontal == pytest.approx(vertical / 4, rel=1e-9)
	for motion, change, flux in flows:
		assert motion < 5e-7 and change < 0.01 * 2e4, 'but for what cells of 0.1 m leave'
		assert sum(flux) / len(flux) == pytest.approx(-5e-8, rel=0.1)
	for text, words in zip(said, (('infiltration = 0.001', 'less'), ("waterTable = '1'", 'number'), ('waterTable = 1', 'total=True')), strict=True):
		assert all(word in text for word in words), text


def test_layers_are_placed_and_dug_out_with_their_suction(yade):
	"""A column whose layer is dug out in four parts, or placed, with water that can go nowhere: the base bears the weight with the water that is there, and placed soil keeps its saturation."""
	dug, before, heave, placed, wet, balance = yade(
	        setting + '''
def base(): return solver.reactions[2][1]

# dug out, fast enough for water to stay where it is
solver = column(lambda y: -1.5 - y, cells=10, base=-1.5, top=None, drained=False, young=1e7)
O.dt = 1e6
O.step(), O.step()
O.dt = 1
points, at = mpm.arrays(), mpm.arrays()['pos'].copy()
own, whole = weight(points), base()
before = [whole, own.sum()]
region = mpm.polygon([(-1, .62), (2, .62), (2, 2), (-1, 2)])
mine = points['pos'][:, 1] > .62
mpm.stages.excavate(region, steps=4)
dug, heave = [], []
for step in range(1, 5):
	O.step()
	dug.append([base(), own[~mine].sum() + (1 - step / 4) * own[mine].sum()])
	rest = mpm.arrays()
	heave.append((rest['pos'][:, 1][rest['pos'][:, 1] < .62] - at[~mine][:, 1]).max())
O.step()
# placed: a layer with another suction
solver = column(lambda y: -1.5 - y, cells=10, base=-1.5, top=None, drained=False, young=1e7)
O.dt = 1e6
O.step(), O.step()
O.dt = 1e-3
def content(points): return (points['saturation'] * (points['volume'] - .6 * np.array([O.bodies[int(i)].state.volume0 for i in points['id']]))).sum()
old = content(mpm.arrays())
h = solver.grid.cellSize
ids = mpm.stages.place(mpm.fill(mpm.polygon([(0, 1), (h, 1), (h, 1 + 4 * h), (0, 1 + 4 * h)]), solver.grid, 2, 'soil'), steps=2)
mpm.assign(ids=list(ids), excessPressure=[-4 * w] * len(ids))
placed, stored = [], solver.flow.waterStored
for step in 1, 2:
	O.step()
	points = mpm.arrays()
	new = np.isin(points['id'], list(ids))
	own = weight(points)
	placed.append([base(), own[~new].sum() + step / 2 * own[new].sum()])
S = .2 + .8 * (1 + (3.35 * 4)**2)**-.5
upper = points['pos'][:, 1] > 1 + 2 * h
wet = [float(points['saturation'][upper].mean()), S, content(points), old + S * .4 * h * 4 * h]
print(json.dumps([dug, before, heave, placed, wet, solver.flow.waterStored - stored]))
'''
	).result
	assert before[0] == pytest.approx(before[1], rel=1e-6)
	for ours, hand in dug + placed:
		assert ours == pytest.approx(hand, rel=1e-4)
	assert [up / heave[-1] for up in heave] == pytest.approx([.25, .5, .75, 1], abs=.03) and heave[-1] > 0
	assert wet[0] == pytest.approx(wet[1], rel=1e-3) and abs(balance) < 1e-9
	assert wet[2] == pytest.approx(wet[3], rel=1e-6), 'no water is lost'


def test_soil_with_suction_moves_with_the_mass_of_its_water(yade):
	"""Free fall, in which suction draws the body together, at g with energies in balance; and a column at rest goes on in time at rest, with its pressures."""
	fall, energies, moved, kept, bears = yade(
	        setting + '''
solver = column(lambda y: -1.5 - y, top=None, drained=False, young=1e7, engine=MpmDynamicEngine)
solver.boundaries = []
O.dt = 1e-3
for _ in range(20): O.step()
points, data = mpm.arrays(), solver.plotData()
mass = weight(points)
fall = [float((mass * points['velocity'][:, 1]).sum() / mass.sum()), data['momentum_y'] / (mass.sum() / 9.81), float(points['saturation'].max())]
energies = [data['loadWork'], data['energyImbalance']]
solver = column(lambda y: -1.5 - y, base=-1.5, top=None, young=1e7)
for _ in range(3):
	O.dt = 1e6
	O.step()
before, bore = mpm.arrays(), solver.reactions[2][1]
O.engines = [MpmDynamicEngine(grid=solver.grid, boundaries=solver.boundaries, gravity=solver.gravity, flow=solver.flow, loadCurve=[(0, 1)], verbosity=0)]
O.dt = 1e-3
for _ in range(20): O.step()
after = mpm.arrays()
print(json.dumps([fall, energies, float(abs(after['pos'] - before['pos']).max()), float(abs(after['excessPressure'] - before['excessPressure']).max() / w), O.engines[0].reactions[2][1] / bore]))
'''
	).result
	assert fall[2] < 0.7, 'pores have lost water that would have mass'
	assert fall[:2] == pytest.approx([-9.81 * 0.02] * 2, rel=1e-5), 'masses are those as a step begins'
	assert energies[0] > 0 and abs(energies[1]) < 0.02 * energies[0]
	assert moved < 1e-8 and kept < 1e-5 and bears == pytest.approx(1, rel=1e-4)
