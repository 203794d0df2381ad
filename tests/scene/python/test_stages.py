# SPDX-License-Identifier: GPL-2.0-or-later
"""Stages of construction against sums by hand: a column on which layers are placed, and which is dug out again."""
import pytest

column = '''
import json
from yade import mpm
E, weight, h = 2e7, 2000 * 10, .5
for label in ('ground', 'fill'): O.materials.append(MpmElasticMat(young=E, poisson=0, density=2000, label=label))
grid = MpmGrid(cellSize=h)
def part(low, high): return mpm.polygon([(0, low), (h, low), (h, high), (0, high)])
def layer(low, high): return mpm.fill(part(low, high), grid, 2, 'fill')
O.bodies.append(mpm.fill(part(0, 4), grid, 2, 'ground'))
base = MpmBoundary(max=(inf, 0, inf), fix='y')
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), base], verbosity=0)
O.engines, O.dt = [solver], 1
mpm.geostatic()
def settlement():
	points = mpm.arrays()
	top = abs(points['pos0'][:, 1] - 3.875) < .01  # the highest row of the ground
	return (points['pos0'] - points['pos'])[top, 1].mean()
def load(): return solver.reactions[-1][1] / (weight * h)
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
'''


def test_layers_are_placed_and_dug_out_step_by_step(yade):
	result = yade(column + '''
out = dict(ids=len(mpm.stages.place(layer(4, 5), steps=4)), placed=[], dug=[])
for step in range(4):
	O.run(1, wait=True)
	out['placed'].append([settlement(), load()])
mpm.stages.place(layer(5, 6))  # at once
O.run(2, wait=True)
out['second'] = [settlement(), load()]
out['materials'] = sorted({b.material.label for b in O.bodies})
out['points'] = mpm.stages.excavate(part(4, 7), steps=4)
mpm.save('half.yade.gz')
for step in range(4):
	O.run(1, wait=True)
	out['dug'].append([settlement(), load(), len(mpm.arrays()['id'])])
O.load('half.yade.gz')
O.run(4, wait=True)
solver = O.engines[-1]
out['loaded'] = [settlement(), load(), len(mpm.arrays()['id'])]
mpm.stages.resetDisplacements()
mpm.stages.place(layer(4, 5), steps=2)
out['engines'] = len(O.engines)
O.run(2, wait=True)
out['again'] = settlement()
print(json.dumps(out))
''').result
	unit = 2000 * 10 * 3.875 / 2e7  # settlement of a layer 1 m thick, at the middle of the highest points
	assert result['ids'] == 8 and result['materials'] == ['fill', 'ground']
	for i, (down, force) in enumerate(result['placed'], 1):
		assert down == pytest.approx(unit * i / 4, rel=.006) and force == pytest.approx(4 + i / 4, rel=1e-6)
	assert result['second'] == pytest.approx([2 * unit, 6], rel=.006)
	assert result['points'] == 16
	for i, (down, force, points) in enumerate(result['dug'], 1):
		assert down == pytest.approx(2 * unit * (1 - i / 4), rel=.02, abs=1e-3 * unit) and force == pytest.approx(6 - i / 2, rel=1e-6)
		assert points == (48 if i < 4 else 32)
	assert result['loaded'] == result['dug'][-1]
	assert result['engines'] == 2  # runners that are done are taken away
	assert result['again'] == pytest.approx(unit, rel=.006)


def test_a_support_is_taken_away_and_mistakes_are_named(yade):
	side, messages = yade(column + '''
solver.boundaries = [*solver.boundaries[:2], MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.run(1, wait=True)
mpm.stages.release(1)
side = len(solver.boundaries)
print(json.dumps([side, [refused(mpm.stages.release, 5), refused(mpm.stages.release, base), refused(mpm.stages.place, []), refused(mpm.stages.place, layer(4, 5), steps=0), refused(mpm.stages.place, layer(4, 5), steps=2.5),
	refused(mpm.stages.place, list(O.bodies)), refused(mpm.stages.excavate, part(8, 9)), refused(mpm.stages.excavate, part(0, 9)), refused(mpm.stages.excavate, 3), refused(mpm.stages.excavate, part(2, 4), solver=7),
	refused(mpm.stages.place, layer(4, 5), solver=MpmDynamicEngine())]]))
''').result
	assert side == 2
	number, base, empty, none, real, twice, beside, all_, three, solver, dynamic = messages
	assert 'boundary = 5' in number and 'none of the 2' in base
	assert 'TypeError' in empty and 'bodies' in empty and 'steps = 0' in none and 'steps = 2.5' in real and 'already' in twice
	assert 'no material point' in beside and 'all material points' in all_ and 'region = 3' in three and 'solver = 7' in solver and 'inertia' in dynamic


def test_an_engine_that_takes_over_deformed_ground_does_not_doubt_its_grid(yade):
	"""Displacements are counted from where points were then, which is no place where mpm.fill would have put them; of undeformed points that are not, it is told."""
	run = yade('''
import sys
from yade import mpm
O.materials.append(MpmElasticMat(young=1e5, poisson=0, density=2000, label='soil'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (2, 0), (2, 2), (0, 2)]), grid, 2, 'soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
engine = lambda grid: MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides, gravityCurve=[(0, 1)], verbosity=0)
O.engines, O.dt = [engine(grid)], 1
O.step()
mpm.stages.resetDisplacements()
sys.stderr.write('taken over\\n')
O.engines = [engine(grid)]
O.step()
sys.stderr.write('another grid\\n')
O.reset()
O.materials.append(MpmElasticMat(young=1e5, poisson=0, density=2000, label='soil'))
O.bodies.append(mpm.fill(mpm.polygon([(0.1, 0), (2.1, 0), (2.1, 2), (0.1, 2)]), MpmGrid(cellSize=0.5, origin=(0.1, 0, 0)), 2, 'soil'))
O.engines, O.dt = [engine(grid)], 1
O.step()
''')
	takenOver, another = run.stderr.split('taken over\n')[1].split('another grid\n')
	assert 'would have put it' not in takenOver and 'would have put it' in another, run.stderr


def test_ground_becomes_concrete_with_its_stress_and_its_weight_comes_in_steps(yade):
	"""A quarter of the difference of weight in each of four steps, in a saved and loaded scene, too; a material that cannot carry the stress is refused, and all is as before."""
	result = yade(column + '''
O.materials.append(MpmElasticMat(young=1000 * E, poisson=0, density=2500, label='concrete'))
O.materials.append(MpmVonMisesMat(young=E, poisson=.3, density=2000, yieldStress=1, label='butter'))
O.materials.append(FrictMat(label='steel'))
before = repr([(b.material.label, b.state.dict()) for b in O.bodies])
messages = [refused(mpm.stages.replace, part(2, 4), label) for label in ('butter', 'steel', 'timber')] + [refused(mpm.stages.replace, part(5, 6), 'concrete'), refused(mpm.stages.replace, 3, 'concrete')]
out = dict(messages=messages, same=before == repr([(b.material.label, b.state.dict()) for b in O.bodies]), points=mpm.stages.replace(part(3, 4), 'concrete', steps=4), poured=[])
for step in range(4):
	if step == 2:
		mpm.save('poured.yade.gz')
		O.load('poured.yade.gz')
		solver = O.engines[-1]
	O.run(1, wait=True)
	out['poured'].append([settlement(), load()])
out['materials'] = sorted({b.material.label for b in O.bodies})
mpm.stages.replace(part(0, 1), 'concrete')
O.run(1, wait=True)
out['atOnce'] = load()
print(json.dumps(out))
''').result
	weak, steel, timber, nowhere, three = result['messages']
	assert 'ValueError' in weak and "'butter' cannot carry the stress that the points have" in weak and result['same']
	assert 'TypeError' in steel and 'FrictMat' in steel and 'KeyError' in timber and 'no material point' in nowhere and 'region = 3' in three
	assert result['points'] == 8 and result['materials'] == ['concrete', 'ground']
	for i, (down, force) in enumerate(result['poured'], 1):
		assert force == pytest.approx(4 + i / 4 / 4, rel=1e-6)
		assert down == pytest.approx(i / 4 * 5000 * 3 / 2e7, rel=.02)  # 3 m of ground below 1 m of concrete
	assert result['atOnce'] == pytest.approx(4.5, rel=1e-6)


def test_ground_is_at_rest_around_a_wall_that_is_wished_in_place(yade):
	"""A stiff wall of the density of the ground moves nothing; what a heavier one and what stands out of the ground weigh more is told, and is what the base bears more."""
	result = yade('''
import json
from yade import mpm
def wished(density, top, **settings):
	O.reset()
	O.materials.append([MpmMohrCoulombMat(young=4e7, poisson=.3, density=1800, cohesion=1e3, frictionAngle=radians(35), label='sand'), MpmElasticMat(young=3e10, poisson=.2, density=density, label='wall')])
	grid = MpmGrid(cellSize=.5)
	soil = mpm.polygon([(-3, -4), (4, -4), (4, 0), (-3, 0)])
	O.bodies.append(mpm.fill(soil | mpm.polygon([(0, -1), (1, -1), (1, top), (0, top)]) if top else soil, grid, 2, lambda x: 'wall' if 0 <= x[0] <= 1 and x[1] >= -2 else 'sand'))
	base = MpmBoundary(max=(inf, -4, inf), fix='xy')
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=[base, MpmBoundary(max=(-3, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x')], verbosity=0)
	O.engines, O.dt = [solver], 1
	told = mpm.geostatic(**settings)
	O.run(1, wait=True)
	points = mpm.arrays()
	return told, abs(points['pos'] - points['pos0']).max(), solver.reactions[0][1]
found = [wished(1800, 0, bodies=['wall']), wished(2400, 0, bodies=['wall']), wished(2400, 1, bodies=['wall'], K0=dict(sand=.5))]
messages = []
for bodies in ['wal'], 'wall', ['sand', 'wall'], []:
	try: wished(2400, 0, bodies=bodies)
	except Exception as error: messages.append(f'{type(error).__name__}: {error}')
print(json.dumps([found, messages]))
''').result
	(alike, heavier, outstanding), messages = result
	assert alike[0] == {'wall': 0} and alike[1] < 1e-9
	assert heavier[0]['wall'] == pytest.approx(12e3) and heavier[2] == pytest.approx(28 * 18e3 + 12e3, rel=1e-6)
	assert outstanding[0]['wall'] == pytest.approx(36e3) and outstanding[2] == pytest.approx(28 * 18e3 + 36e3, rel=1e-6)
	unknown, text, all_, none = messages
	assert "no material of the points has the label 'wal'" in unknown and 'TypeError' in text and 'nothing is ground' in all_ and 'differ in density' in none and 'bodies=' in none


undrained = '''
import json
import numpy as np
from yade import mpm
pores = dict(undrained=dict(undrained=True, waterModulus=5e8), flowing=dict(conductivity=0, porosity=.4), byPoint=dict(conductivity=1e-3, porosity=.4), drained={})
def ground(kind, wall=1e9):
	O.reset()
	O.materials.append([MpmElasticMat(young=1e6, poisson=.3, density=1800, label='clay', **pores[kind]), MpmElasticMat(young=wall, poisson=.3, density=1800, label='wall')])
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3, 0), (3, 2), (0, 2)]), grid, 2, 'clay'))
	sides = [MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(3, -inf, -inf), fix='x')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 0), (2, 1)], boundaries=sides, fBar=True, verbosity=0)
	if kind == 'byPoint': mpm.assign(conductivity=[0] * len(O.bodies))
	if kind in ('flowing', 'byPoint'): solver.flow = MpmFlow(drains=[MpmDrain(surface=[(1, 2), (0, 2)])])
	O.engines, O.dt = [solver], 1
	O.run(2, wait=True)
	mpm.stages.resetDisplacements()
def total(a): return a['stress'] - (a['excessPressure'][:, None, None] * np.eye(3) if 'excessPressure' in a else 0)
'''


def test_undrained_ground_that_is_replaced_keeps_its_total_stress(yade):
	moved, changed, largest, concrete = yade(undrained + '''
ground('undrained')
before = total(mpm.arrays())
mpm.stages.replace(mpm.polygon([(1, .5), (2, .5), (2, 9), (1, 9)]), 'wall')
O.step()
a = mpm.arrays()
isWall = a['material'] == O.materials['wall'].id
print(json.dumps([abs(a['pos'] - a['pos0']).max(), abs(total(a) - before).max(), abs(before).max(), abs(a['excessPressure'][isWall]).max()]))
''').result
	assert moved < 1e-9 and changed < 1e-4 * largest and concrete == 0


def test_undrained_ground_and_ground_with_flow_are_dug_out_in_equal_parts(yade):
	found = yade(undrained + '''
out = {}
for kind in pores:
	ground(kind)
	mpm.stages.excavate(mpm.polygon([(1.5, 1.5), (9, 1.5), (9, 9), (1.5, 9)]), steps=4)
	heave = []
	for step in range(4):
		O.step()
		a = mpm.arrays()
		stays = (a['pos0'][:, 0] < 1.5) | (a['pos0'][:, 1] < 1.46)
		heave.append((a['pos'] - a['pos0'])[stays, 1].max())
	out[kind] = heave
print(json.dumps(out))
''').result
	for kind, heave in found.items():
		assert [up / heave[-1] for up in heave] == pytest.approx([.25, .5, .75, 1], abs=.02), kind
	assert 0 < found['undrained'][-1] < .7 * found['drained'][-1] and found['flowing'][-1] == pytest.approx(found['undrained'][-1], rel=.1)
	assert found['byPoint'] == pytest.approx(found['flowing'], rel=1e-9) # what is dug out keeps the conductivities of its points
