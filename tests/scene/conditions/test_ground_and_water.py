# SPDX-License-Identifier: GPL-2.0-or-later
"""Water where it meets other features: stages of construction, periods of the grid, ground at rest, functions that ask the engine; what is told of it."""
import math

import pytest

setting = '''
import json
import numpy as np
from yade import mpm
h, weight = .5, 1e4
grid = MpmGrid(cellSize=h)
def part(low, high, x0=0, x1=2): return mpm.polygon([(x0, low), (x1, low), (x1, high), (x0, high)])
def begin(**materials):
	O.reset()
	for label, material in (materials or dict(soil=MpmElasticMat(young=1e7, poisson=.3, density=2000))).items():
		material.label = label
		O.materials.append(material)
	O.dt = 1
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
def engine(**kw): return MpmImplicitEngine(**(dict(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, newton=MpmNewton(tolerance=1e-11), verbosity=0) | kw))
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
'''


def test_stages_under_water_go_as_those_of_submerged_density(yade):
	"""A layer is placed in steps, and dug out again: stresses, reactions less those of the water, and point loads as without water; cut, and saved and loaded in mid-stage."""
	wet, dry, loaded = yade(setting + '''
def run(density, water, save=False):
	begin(ground=MpmElasticMat(young=1e7, poisson=.3, density=density), layer=MpmElasticMat(young=1e7, poisson=.3, density=density))
	O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'ground'))
	solver = engine(water=water, loadCurve=[(0, 1)])
	O.engines = [solver]
	mpm.geostatic(K0=.5)
	found = []
	def note(solver):
		points = mpm.arrays()
		row = abs(points['pos0'][:, 1] - 1.875) < .01
		byWater = solver.water[0].onBoundaries[2][1] if solver.water else 0
		found.append([points['stress'][row, 1, 1].mean(), points['stress'][row, 0, 0].mean(), solver.reactions[2][1] - byWater])
	ids = mpm.stages.place(mpm.fill(part(2, 3), grid, 2, 'layer'), steps=3)
	mpm.assign(ids=list(ids), force=[(0, -100, 0)] * len(ids))
	for step in range(3):
		O.step()
		note(solver)
	mpm.stages.excavate(part(2.01, 4), steps=4)
	for step in range(4):
		O.step()
		note(O.engines[-1])
		if save and step == 1:
			mpm.save('half.yade.gz')
			mpm.load('half.yade.gz')
	return found
still = lambda: [MpmWater(level=6, weight=weight)]
print(json.dumps([run(2000, still()), run(1000, []), run(2000, still(), save=True)]))
''').result
	for found, expected in zip(wet, dry):
		assert found == pytest.approx(expected, rel=2e-3)  # volumes, with which water presses on walls, are those of the deformed body
	forces = [force for _, _, force in wet]
	whole, layer, loads = 1e4 * 2 * 2, 1e4 * 2, 100 * 32
	growing = [whole + (layer + loads) * i / 3 for i in (1, 2, 3)] + [whole + (layer + loads) * (1 - i / 4) for i in (1, 2, 3, 4)]
	assert forces == pytest.approx(growing, rel=2e-3)
	assert loaded == wet


def test_sand_without_tensile_strength_is_covered_and_dug_out_under_water(yade):
	results = yade(setting + '''
out = []
for what in 'placed', 'dug out':
	for steps in 1, 10:
		begin(ground=MpmMohrCoulombMat(young=1e7, poisson=.3, density=2000, cohesion=1e3, frictionAngle=radians(30), tensileStrength=0), layer=MpmElasticMat(young=1e7, poisson=.3, density=2000))
		O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'ground'))
		if what == 'dug out': O.bodies.append(mpm.fill(part(2, 3), grid, 2, 'layer'))
		O.engines = [engine(newton=MpmNewton(), water=[MpmWater(level=6, weight=weight)])]
		mpm.geostatic(K0=.5)
		mpm.stages.place(mpm.fill(part(2, 3), grid, 2, 'layer'), steps=steps) if what == 'placed' else mpm.stages.excavate(part(2, 4), steps=steps)
		cuts = 0
		for step in range(steps):
			O.step()
			cuts += O.engines[-1].cuts
		points = mpm.arrays()
		out.append([cuts, points['stress'][abs(points['pos0'][:, 1] - 1.875) < .01, 1, 1].mean()])
print(json.dumps(out))
''').result
	assert [cuts for cuts, _ in results] == [0] * 4
	(_, once), (_, placed), (_, dugAtOnce), (_, dug) = results
	assert placed == pytest.approx(once, rel=.02) and dug == pytest.approx(dugAtOnce, rel=.02)


def test_water_that_flows_along_the_period_drags_the_body(yade):
	"""Whatever its place in the period, along x and y; in the pores and outside as everywhere; a pressure that repeats itself, as without a word of the far side."""
	forces, refusal, shifted = yade(setting + '''
slope = .1
def run(where='everywhere', pressure=lambda x: weight * (4 - slope * x[0] - x[1]), origin=0, period=(8, 0, 0)):
	begin()
	own = MpmGrid(cellSize=h, period=period, origin=(origin, 0, 0))
	O.bodies.append(mpm.fill(part(0, 2, origin, origin + 8), own, 2, 'soil'))
	solver = engine(grid=own, boundaries=held[2:], water=[MpmWater(pressure=pressure, where=w) for w in ([where] if where == 'everywhere' else ['pores', 'outside'])])
	O.engines = [solver]
	O.run(2, wait=True)
	points = mpm.arrays()
	return [solver.reactions[0][0], sum(w.onBoundaries[0][0] for w in solver.water), abs(points['stress'][:, 0, 1]).max()]
print(json.dumps([[run(), run('both'), run(pressure=lambda x: weight * (4 - x[1])), run(pressure=lambda x: weight * (4 - x[1] + .2 * sin(x[0] * pi / 4)))],
	refused(run, pressure=lambda x: weight * max(0, 1.5 - slope * x[0] - x[1])), [run(origin=16), run()]]))
''').result
	drag = -1e4 * .1 * 16
	everywhere, both, none, waves = forces
	assert everywhere[0] - everywhere[1] == pytest.approx(drag, rel=1e-6) and everywhere[1] == pytest.approx(0, abs=1e-6 * abs(drag))
	assert both[0] == pytest.approx(drag, rel=1e-2) and both[2] == pytest.approx(everywhere[2], rel=5e-3)
	assert abs(none[0] - none[1]) < 1e-6 * abs(drag) and abs(waves[0] - waves[1]) < 1e-3 * abs(drag)
	assert 'water[0].pressure gains' in refusal and 'along the period' in refusal
	assert shifted[0][0] == pytest.approx(shifted[1][0], rel=1e-9)


def test_functions_of_the_pressure_may_ask_the_engine_and_change_the_scene(yade):
	asked, erased, added = yade(setting + '''
import faulthandler
faulthandler.dump_traceback_later(60, exit=True)
def run(pressure, step=False):
	begin()
	O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'soil'))
	O.engines = [engine(water=[MpmWater(pressure=pressure)])]
	O.step() if step else O.run(2, wait=True)
	return [O.engines[0].reactions[2][1], len(mpm.arrays()['id'])]
def asking(x):
	solver = O.engines[0]
	solver.report(), solver.plotData(), mpm.arrays(), solver.water[0].weight, O.bodies[0].state.stress
	return weight * max(0, 2 - 0 * solver.loadTime - x[1])
def erasing(x):
	if O.bodies[0]: O.bodies.erase(0)
	return 0
def adding(x):
	if len(O.bodies) < 100: O.bodies.append(mpm.fill(part(2, 4), grid, 2, 'soil'))
	return 0
print(json.dumps([[run(lambda x: weight * max(0, 2 - x[1])), run(asking), run(asking, step=True)], [run(erasing), run(erasing, step=True)], run(adding)]), flush=True)
''').result
	assert asked[0] == asked[1] and asked[0][1] == asked[2][1]
	assert erased[0][1] == erased[1][1] == 63 and erased[0][0] == pytest.approx(2e4 * 63 / 16, rel=1e-6)
	assert added == pytest.approx([2e4 * 8, 128], rel=1e-6)


def test_ground_with_a_water_level_within_a_row_is_at_rest(yade):
	"""Levels, functions, water in the pores or outside alone, ground that is not modelled."""
	results = yade(setting + '''
out = {}
waters = {f'level {level}': lambda level=level: [MpmWater(level=level)] for level in (2, 1.9, 1.75, 1.66, 1.5, 3)}
waters |= {f'function {level}': lambda level=level: [MpmWater(pressure=lambda x: weight * max(0, level - x[1]))] for level in (1.9, 1.6)}
waters |= {where: lambda where=where: [MpmWater(level=1.7, where=where)] for where in ('pores', 'outside')}
waters['both'] = lambda: [MpmWater(level=1.7, where='pores'), MpmWater(level=2.3, where='outside')]
for name, water in waters.items():
	begin()
	O.bodies.append(mpm.fill(part(0, 4), grid, 2, 'soil'))
	O.engines = [engine(water=water())]
	mpm.geostatic()
	before = mpm.arrays()['stress']
	O.step()
	points = mpm.arrays()
	out[name] = [float(abs(points['pos'] - points['pos0']).max()), float(abs(points['stress'] - before).max())]
print(json.dumps(out))
''').result
	for name, (moved, changed) in results.items():
		assert moved < 1e-12 and changed < 1e-6, name


def test_doubtful_water_and_ground_are_told(yade):
	run = yade(setting + '''
begin()
O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'soil'))
O.engines = [engine(water=[MpmWater(level=1, weight=9.81)])]
O.run(1, wait=True)
dam = mpm.polygon([(0, 0), (8, 0), (5, 6), (3, 6)])
base = [MpmBoundary(max=(inf, 0, inf), fix='xy')]
def load(water, boundaries=base):
	begin(dam=MpmElasticMat(young=1e9, poisson=.2, density=2400))
	O.bodies.append(mpm.fill(dam, grid, 2, 'dam'))
	O.engines = [engine(boundaries=boundaries, newton=MpmNewton(), water=[water])]
	O.run(1, wait=True)
print('THE DAM', flush=True)
import sys
print('THE DAM', file=sys.stderr, flush=True)
load(MpmWater(level=5, where='outside'))
print('ONE SIDE', file=sys.stderr, flush=True)
load(MpmWater(where='outside', pressure=lambda x: 9810 * max(0, 5 - x[1]) if x[0] < 4 else 0))
load(MpmWater(level=5))
load(MpmWater(level=5, where='outside'), base + [MpmBoundary(min=(7.5, -inf, -inf), fix='x')])
begin()
O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'soil'))
O.engines = [engine()]
mpm.geostatic(K0=50)
begin(soil=MpmElasticMat(young=1e7, poisson=.3, density=2000), wall=MpmElasticMat(young=1e7, poisson=.3, density=2500))
O.bodies.append(mpm.fill(part(0, 2), grid, 2, lambda x: 'wall' if x[0] < .5 else 'soil'))
O.engines = [engine()]
print(json.dumps(refused(mpm.geostatic)))
''')
	first, dam = run.stderr.split('THE DAM')
	dam, rest = dam.split('ONE SIDE')
	assert 'water[0] has weight = 9.81' in first and 'kN/m3' in first
	assert 'both of its sides along x' in dam and 'pressure=lambda' in dam
	assert 'both of its sides' not in rest and 'K0 = 50' in rest and 'percent' in rest
	assert 'differ in density' in run.result and '2500' in run.result and 'bodies=["wall"]' in run.result


def test_a_scene_saved_in_mid_stage_has_its_share_of_water_at_once(yade):
	"""Studies may be asked between loading and the next step."""
	before, after = yade(setting + '''
begin(soil=MpmElasticMat(young=1e7, poisson=.3, density=2000), layer=MpmElasticMat(young=1e7, poisson=.3, density=2000))
O.bodies.append(mpm.fill(part(0, 2), grid, 2, 'soil'))
O.engines = [engine(water=[MpmWater(level=2.6, where='outside', weight=weight)])]
mpm.geostatic(K0=.5)
mpm.stages.place(mpm.fill(part(2, 3), grid, 2, 'layer'), steps=4)
O.run(1, wait=True)
size = lambda: float(abs(O.engines[-1].stiffness()[2]).sum())
before = size()
mpm.save('stage.yade.gz')
mpm.load('stage.yade.gz')
print(json.dumps([before, size()]))
''').result
	assert after == pytest.approx(before, rel=1e-12)


def test_water_presses_on_beams_from_both_sides(yade):
	"""A wall that is clamped at its foot, with water behind it and soil that does not bear tension along it: force and moment of the water by hand. Where its two sides have the same water nothing happens. Files keep what is known beside it."""
	alone, differ, same, gone, flow = yade('''
import json
import numpy as np
from yade import mpm
h, weight = .5, 1e4
def ground(where='everywhere', level=3, other=0):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=2000, conductivity=1e-5, porosity=.4, label='soil'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(-4, 0), (4, 0), (4, 1), (-4, 1)]), grid, 2, 'soil'))
	wall = MpmBeam(line=[(.1, 4), (.1, 0)], axialStiffness=1e10, bendingStiffness=1e9, adhesion=0, fixFoot='xyr')
	water = MpmWater(pressure=lambda x: weight * max(0, (level if x[0] < .1 else other) - x[1]), where=where, weight=weight)
	held = [MpmBoundary(max=(-4, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=held, loads=[wall], water=[water], verbosity=0)], 1
	return O.engines[0]
def result(solver):
	wall, a = solver.loads[0], mpm.arrays()
	return [np.abs(wall.waterPressures).max(), abs(wall.moments[-1]), wall.pressures[-2], max(abs(np.diff(a['stress'][:, 0, 0])))]
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
solver = ground('outside')
O.run(2, wait=True)
alone = [result(solver), np.interp(1.5, [v[1] for v in solver.loads[0].vertices][::-1], solver.loads[0].waterPressures[::-1])]
solver = ground()
O.run(2, wait=True)
differ = result(solver)
mpm.save('wall.yade.gz')
O.run(1, wait=True)
before = result(solver)
O.load('wall.yade.gz')
O.run(1, wait=True)
gone = [before, result(O.engines[0])]
solver = ground(level=3, other=3)
O.run(2, wait=True)
same = result(solver)
flow = []
for permittivity in 0, inf:
	solver = ground(level=0)
	solver.water, solver.flow = [MpmWater(level=1)], MpmFlow()
	solver.loads = [MpmBeam(line=[(.9, 4), (.9, 0)], axialStiffness=1e10, bendingStiffness=1e9, fixFoot='xyr'), *solver.loads]
	for wall in solver.loads: wall.permittivity = permittivity
	flow.append(refused(O.run, 1, wait=True))
print(json.dumps([alone, differ, same, gone, flow]))
''').result
	hand = 1e4 * 3**3 / 6
	assert alone[1] == pytest.approx(-1.5e4, rel=.05) and alone[0][1] == pytest.approx(hand, rel=.1)
	assert differ[0] == pytest.approx(3e4, rel=.01) and differ[1] == pytest.approx(hand, rel=.1)
	assert same[0] < 100 and same[1] < .01 * hand
	assert gone[1] == pytest.approx(gone[0], rel=1e-9)
	assert flow == ['nothing was refused'] * 2
