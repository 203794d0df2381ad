# SPDX-License-Identifier: GPL-2.0-or-later
"""Water in the pores and around bodies, in scenes with known answers: ground at rest, a wall, a slope with seepage, drawdown; saved and continued; mistakes."""
import math

import pytest

setting = '''
import json
import numpy as np
from yade import mpm
soil = MpmElasticMat(young=2e7, poisson=.25, density=2000, label='soil')
O.materials.append(soil)
h, weight = .5, 1e4
grid = MpmGrid(cellSize=h)
def body(top=4): return mpm.fill(mpm.polygon([(0, 0), (1, 0), (1, top), (0, top)]), grid, 2, 'soil')
O.bodies.append(body())
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(1, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
def engine(**kw): return MpmImplicitEngine(**(dict(grid=grid, gravity=(0, -10, 0), loadCurve=[(0, 1)], boundaries=sides, newton=MpmNewton(tolerance=1e-10), verbosity=0) | kw))
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
O.dt = 1
'''


def test_ground_under_water_is_at_rest(yade):
	"""Soil 4 m high with a density of 2000 kg/m3, a water table at 3 m or 2 m above it: stresses, fields, and what floor and walls bear."""
	results = yade(setting + '''
out = []
for level in (3, 6):
	O.bodies.clear()
	O.bodies.append(body())
	solver = engine(water=[MpmWater(level=level, weight=weight)])
	O.engines = [solver]
	mpm.geostatic()
	O.step()
	points, fields = mpm.arrays(), __import__('sys').modules['yade.mpm.points.data'].fields()
	depth = 4 - points['pos0'][:, 1]
	p = weight * np.maximum(0, level - points['pos0'][:, 1])
	total = 2e4 * depth + weight * max(0, level - 4)
	error = lambda found, expected: float(abs(found - expected).max() / 1e4)
	out.append(dict(moved=float(abs(points['pos'] - points['pos0']).max()), p=error(points['porePressure'], p), effective=error(points['stress'][:, 1, 1], p - total),
		horizontal=error(points['stress'][:, 0, 0], (p - total) / 3), total=error(fields['totalStress'][:, 1, 1], -total),
		floor=solver.reactions[2][1], wall=solver.reactions[0][0], water=[solver.water[0].onBoundaries[0][0], solver.water[0].onBoundaries[2][1]], iterations=solver.iterations))
print(json.dumps(out))
''').result
	for level, found in zip((3, 6), results):
		assert found['moved'] < 1e-9 and max(found[name] for name in ('p', 'effective', 'horizontal', 'total')) < 1e-6, found
		total, onWall = 8e4 + 1e4 * max(0, level - 4), 1e4 * (level**2 - max(0, level - 4)**2) / 2
		effective = 2e4 * 8 + 4 * 1e4 * max(0, level - 4) - onWall  # over the height of the wall
		assert found['floor'] == pytest.approx(total, rel=1e-6)
		assert found['wall'] == pytest.approx(effective / 3 + onWall, rel=1e-6)
		assert found['water'] == pytest.approx([onWall, 1e4 * level], rel=1e-6)


def test_infinite_slope_with_seepage_along_it(yade):
	"""A layer of D = 3 m on an incline, in a periodic grid turned with it: flow along the slope, p = weight (D - y) cos b; shear stress as without water,
	normal stress less the pressure (Lambe and Whitman 1969)."""
	errors, loaded, refusal = yade(setting + '''
b, D = radians(20), 3
O.bodies.clear()
slope = MpmGrid(cellSize=h, period=(2, 0, 0))
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (2, 0), (2, D), (0, D)]), slope, 2, 'soil'))
calls = []
def pressure(x):
	calls.append(x)
	return weight * cos(b) * max(0, D - x[1])
O.engines = [engine(grid=slope, gravity=(10 * sin(b), -10 * cos(b), 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], water=[MpmWater(pressure=pressure)])]
O.step()
first = len(calls)
mpm.save('slope.yade.gz')
O.run(2, wait=True)
def result():
	points = mpm.arrays()
	y = points['pos'][:, 1]
	return points, [points[name].tolist() for name in ('pos', 'stress', 'porePressure')]
points, end = result()
y0 = points['pos0'][:, 1]
rows = np.floor(y0 / h).astype(int)
ofCells = lambda values: np.bincount(rows, values) / np.bincount(rows)  # where stresses of linear elements are best
shear, normal = 2e4 * sin(b) * (D - y0), -(2e4 - weight) * cos(b) * (D - y0)
differ = lambda i, exact: float(abs(ofCells(points['stress'][:, i, 1]) - ofCells(exact))[1:].max() / abs(exact).max())
errors = [differ(0, shear), differ(1, normal), first, len(calls), *(np.array(O.engines[0].reactions[0])[:2] / (2e4 * D * 2)).tolist()]
O.load('slope.yade.gz')
O.run(2, wait=True)
same = result()[1] == end
O.engines[0].grid = MpmGrid(cellSize=h / 2, period=(2, 0, 0))
print(json.dumps([errors, same, refused(O.run, 1, wait=True)]))
''').result
	assert errors[0] < 5e-3 and errors[1] < 5e-3
	assert errors[4:] == pytest.approx([-math.sin(math.radians(20)), math.cos(math.radians(20))], rel=1e-4)  # relative to the total stress; the surface has moved a little
	assert 0 < errors[2] < 100 and errors[3] == 3 * errors[2]  # a node is asked once in a step
	assert loaded
	assert 'functions are not saved' in refusal and 'MpmWater.pressure' in refusal


def test_drawdown_and_water_that_fills_no_pores(yade):
	"""Ground with 2 m of water on it. The water falls with the pressure in the pores, or without: then it lifts the ground. An impervious body is pressed."""
	slow, rapid, pressed = yade(setting + '''
def run(*water, steps=2):
	O.bodies.clear()
	O.resetTime()
	O.bodies.append(body())
	solver = engine(gravityCurve=[(0, 1)], loadCurve=[(0, 0), (1, 1)], water=water)
	O.engines = [solver]
	mpm.geostatic()
	O.run(steps, wait=True)
	points = mpm.arrays()
	order = points['pos0'][:, 1].argsort()
	return [(points[name] if at is None else points[name][:, at, at])[order[[0, -1]]].tolist() for name, at in (('stress', 1), ('porePressure', None))] + [solver.reactions[2][1]]
falling = [(1, 6), (2, 4)]
print(json.dumps([run(MpmWater(levels=falling, weight=weight)),
	run(MpmWater(level=6, weight=weight, where='pores'), MpmWater(levels=falling, weight=weight, where='outside')),
	run(MpmWater(level=6, weight=weight, where='outside'))]))
''').result
	low, high = .125, 3.875  # heights of the points
	assert slow[0] == pytest.approx([-1e4 * (4 - low), -1e4 * (4 - high)], rel=2e-3)
	assert slow[1] == pytest.approx([1e4 * (4 - low), 1e4 * (4 - high)], rel=2e-3) and slow[2] == pytest.approx(8e4, rel=1e-6)
	assert rapid[0] == pytest.approx([-2e4 * (4 - low) + 1e4 * (6 - low), -2e4 * (4 - high) + 1e4 * (6 - high)], rel=5e-3)
	assert rapid[1] == pytest.approx([1e4 * (6 - low), 1e4 * (6 - high)], rel=3e-3)  # the highest points have risen by 3 mm
	assert rapid[2] == pytest.approx(8e4, rel=1e-3)
	assert pressed[0] == pytest.approx([-2e4 * (4 - low) - 2e4, -2e4 * (4 - high) - 2e4], rel=5e-3)
	assert pressed[1] == [0, 0] and pressed[2] == pytest.approx(1e5, rel=1e-3)


def test_no_water_no_fields_and_mistakes_are_named(yade):
	fields, gone, messages = yade(setting + '''
O.engines = [engine()]
O.step()
fields = [name for name in mpm.arrays() if 'ore' in name]
def step(**kw):
	O.engines = [engine(loadTime=O.time, **kw)]
	return refused(O.run, 1, wait=True)
def failing(x): raise KeyError('no such place')
tilted = dict(gravity=(1, -10, 0))
messages = [refused(MpmWater, weight=-1), refused(MpmWater, level=inf), refused(MpmWater, where='inside'), refused(MpmWater, pressure=3), refused(MpmWater, levels=[(1, 2), (0, 1)]),
	step(water=[MpmWater(level=1, pressure=lambda x: 0)]), step(water=[MpmWater()]), step(water=[MpmWater(pressure=lambda x: nan)]), step(water=[MpmWater(pressure=lambda x: None)]),
	step(water=[MpmWater(pressure=failing)]), step(water=[MpmWater(level=1)], **tilted), refused(engine, water=MpmWater(level=1))]
O.engines = [engine(loadTime=O.time, water=[MpmWater(level=1)])]
O.run(1, wait=True)
wet = 'porePressure' in mpm.arrays()
O.engines[0].water = []
O.run(1, wait=True)
print(json.dumps([fields, [wet, 'porePressure' in mpm.arrays()], messages]))
''').result
	assert fields == [] and gone == [True, False]
	weight, level, where, pressure, levels, both, none, number, nothing, failing, tilted, single = messages
	assert 'weight = -1' in weight and 'level = inf' in level and "'pores'" in where and 'pressure = 3' in pressure and 'levels' in levels
	assert 'given are level = 1, pressure' in both and 'none is' in none
	assert 'water[0]' in number and 'returned nan at' in number and 'returned None' in nothing and "raised KeyError('no such place')" in failing
	assert 'gravity' in tilted and 'pressure, a function' in tilted and '[item]' in single


def test_water_works_on_what_sinks(yade):
	"""Deep in still water a body sinks freely by its submerged weight, whose work is its kinetic energy."""
	sunk, work, kinetic, imbalance = yade('''
import json
from yade import mpm, pack
O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=1500, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(pack.inAlignedBox((0.2, 0.1, -1), (3.2, 3.1, 1)), MpmGrid(cellSize=1, origin=(0.2, 0.1, 0)), 2, 'soil'))
solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), water=[MpmWater(level=100, weight=1e4)], loadCurve=[(0, 1)], verbosity=0)
O.engines, O.dt = [solver], 0.01
O.run(20, wait=True)
points, data = mpm.arrays(), solver.plotData()
print(json.dumps([(points['pos0'] - points['pos'])[:, 1].tolist(), data['loadWork'], data['kineticEnergy'], data['energyImbalance']]))
''').result
	fall = (1500 - 1000) / 1500 * 10 * 0.2**2 / 2
	assert sunk == pytest.approx([fall] * len(sunk), rel=1e-6)
	assert work == pytest.approx(500 * 10 * 9 * fall, rel=1e-6) and kinetic == pytest.approx(work, rel=1e-6) and abs(imbalance) < 1e-6 * work


def test_a_function_is_asked_before_each_step(yade):
	"""Water on the ground falls by 1 m in a step, by a function of O.time and by a variable of the script: what the base bears, and the pressure in the pores. Studies and files keep the state that has been
	reached; a loaded scene whose function is lost does not go on as if the water stood still."""
	bears, pores, kept, lost, again, steady, flowing = yade(setting + '''
level = 8
def ofTime(x): return weight * max(0, 8 - (O.time + O.dt) - x[1])
def ofVariable(x): return weight * max(0, level - x[1])
def made(water, **kw):
	O.bodies.clear()
	O.bodies.append(body())
	O.resetTime()
	O.engines = [engine(gravityCurve=[(0, 1)], water=[water], **kw)]
	return O.engines[0]
bears, pores = [], []
solver = made(MpmWater(pressure=ofTime, where='outside'))
for step in range(4):
	O.step()
	bears.append(solver.reactions[2][1])
solver = made(MpmWater(pressure=ofVariable))
mpm.geostatic()
for level in (8, 6, 3):
	O.step()
	points = mpm.arrays()
	pores.append(abs(points['porePressure'] - weight * np.maximum(0, level - points['pos'][:, 1])).max())
mpm.save('falling.yade.gz')
before = mpm.arrays()['porePressure'].max()
O.load('falling.yade.gz')
lost = refused(O.run, 1, wait=True)
solver, level = O.engines[0], 3
solver.water = [MpmWater(pressure=ofVariable)]
O.step()
again = abs(mpm.arrays()['porePressure'].max() - before)
solver = made(MpmWater(pressure=lambda x: 1e4))
O.run(2, wait=True)
mpm.save('steady.yade.gz')
O.load('steady.yade.gz')
steady = refused(O.run, 1, wait=True)
O.materials['soil'].conductivity, O.materials['soil'].porosity = 1e-6, .4
solver, level = made(MpmWater(pressure=ofVariable), flow=MpmFlow(drains=[MpmDrain(surface=[(1, 4), (0, 4)])])), 4
O.step()
level = 3
print(json.dumps([bears, pores, before, lost, again, steady, refused(O.run, 1, wait=True)]))
''').result
	assert bears == pytest.approx([8e4 + 1e4 * (level - 4) for level in (7, 6, 5, 4)], rel=2e-3)  # the ground settles by 1 cm
	assert max(pores) < 60 and kept == pytest.approx(1e4 * (3 - .125), rel=1e-2)  # a kink of the pressure within a cell
	assert 'water[0].pressure has changed' in lost and 'give MpmWater.pressure again' in lost and again < 1
	assert steady == 'nothing was refused'
	assert 'water[0].pressure changes with time' in flowing and "where = 'outside'" in flowing
