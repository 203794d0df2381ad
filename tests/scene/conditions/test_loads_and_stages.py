# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads on ground that goes away; stages of one engine among several; histories beside stages; displacements counted anew around an axis."""
import pytest

setting = '''
import json
import numpy as np
from yade import mpm
h = .5
grid, base = MpmGrid(cellSize=h), MpmBoundary(max=(inf, 0, inf), fix='xy')
def part(x0, x1, low, high): return mpm.polygon([(x0, low), (x1, low), (x1, high), (x0, high)])
def begin(**kw):
	O.reset()
	O.materials.append(MpmElasticMat(**(dict(young=1e6, poisson=.3, density=2000, label='soil') | kw)))
	O.dt = 1
def engine(**kw): return MpmImplicitEngine(**(dict(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=[base], verbosity=0) | kw))
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
'''


def test_a_load_whose_ground_has_gone_is_named(yade):
	"""Dug out by a stage, or erased by the script; as it is and mirrored, with and without Poisson's ratio; also half a cell below, and far from what is left."""
	results, beside = yade(setting + '''
def scene(mirrored, poisson, x0=2.25):
	begin(young=2e6, poisson=poisson)
	own = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(part(-4, 0, 0, 3) if mirrored else part(0, 4, 0, 3), own, 2, 'soil'))
	sign = -1 if mirrored else 1
	sides = [MpmBoundary(max=(-4 if mirrored else 0, inf, inf), fix='x'), MpmBoundary(min=(0 if mirrored else 4, -inf, -inf), fix='x')]
	load = MpmTraction(surface=[(sign * x, 3) for x in ((x0, 3) if mirrored else (3, x0))], pressure=5e3)
	O.engines = [engine(grid=own, boundaries=sides + [base], loads=[load])]
	mpm.geostatic(K0=None if poisson else 0)
	O.run(1, wait=True)
	return part(*sorted((2 * sign, 5 * sign)), 2, 4), part(*sorted((2 * sign, 5 * sign)), 2.5, 4)
out = []
for mirrored in False, True:
	for poisson in .3, 0:
		whole, half = scene(mirrored, poisson)
		out.append([refused(mpm.stages.excavate, region, steps=3) for region in (whole, half)])
		for region in half, whole:
			whole, half = scene(mirrored, poisson)
			before = mpm.arrays()['pos']
			for i in mpm.arrays()['id'][[region(Vector3(*x), 0) for x in before]].tolist(): O.bodies.erase(i)
			out[-1].append(refused(O.run, 1, wait=True))
whole, half = scene(False, .3)
region = part(3.5, 5, 2, 4)  # not below the load
mpm.stages.excavate(region, steps=2)
O.run(3, wait=True)
print(json.dumps([out, O.engines[-1].loads[0].resultant[1]]))
''').result
	for early, halfEarly, late, lateWhole in results:
		for text in early, halfEarly:
			assert text.startswith('ValueError: excavate: loads[0] acts on what is to be dug out') and 'take it from the loads' in text
		for text in late, lateWhole:
			assert 'loads[0] has a vertex at' in text and 'no material within 0.' in text and 'dug out' in text
	assert beside == pytest.approx(-5e3 * .75, rel=.02)


def test_a_load_inside_of_the_body_is_told(yade):
	run = yade(setting + '''
import sys
def run(name, surface, **kw):
	begin()
	O.bodies.append(mpm.fill(part(0, 4, 0, 3), grid, 2, 'soil'))
	O.engines = [engine(loads=[MpmTraction(surface=surface, **kw)])]
	print(name, file=sys.stderr, flush=True)
	O.run(2, wait=True)
run('INSIDE', [(3, 1.5), (1, 1.5)], traction=(0, -1e3, 0))
run('OUTSIDE', [(3, 3), (1, 3)], pressure=1e3)
run('GAUGE', [(3, 1.5), (1, 1.5)])
''')
	inside, rest = run.stderr.split('INSIDE')[1].split('OUTSIDE')
	assert inside.count('loads[0] acts inside of the body') == 1 and 'mpm.surface' in inside
	assert 'inside of the body' not in rest


def test_what_is_dug_out_is_that_of_the_engine_with_its_point_loads_and_without_doubts(yade):
	run = yade(setting + '''
begin()
O.bodies.append(mpm.fill(part(0, 2, 0, 3), grid, 2, 'soil'))
points = mpm.arrays()
top = points['pos'][:, 1] > 2.8
mpm.assign(ids=points['id'][top], force=[(0, -1000, 0)] * top.sum())
solver = engine()
O.engines = [solver]
O.run(1, wait=True)
mpm.stages.excavate(part(-1, 3, 2, 4), steps=4)
forces = []
for i in range(4):
	O.run(1, wait=True)
	forces.append(solver.reactions[0][1] - 80000)
ids = mpm.stages.place(mpm.fill(part(0, 2, 2, 3), grid, 2, 'soil'), steps=100)
O.run(2, wait=True)
begin()
one, two = mpm.fill(part(0, 2, 0, 2), grid, 2, 'soil'), mpm.fill(part(10, 12, 0, 2), grid, 2, 'soil')
for body in two: body.groupMask = 2
O.bodies.append(one + two)
engines = [engine(grid=MpmGrid(cellSize=h), mask=mask) for mask in (1, 2)]
O.engines = engines
O.run(1, wait=True)
dug = mpm.stages.excavate(part(-1, 20, 1, 3), steps=2, solver=engines[0])
O.run(2, wait=True)
other = mpm.fill(part(10, 12, 2, 3), grid, 2, 'soil')
for body in other: body.groupMask = 2
wrong = refused(mpm.stages.place, other, steps=2, solver=engines[0])
mixed = refused(mpm.histories, [100], label='b', solver=engines[0]), mpm.histories([(2.2, 1, 0)], label='a', solver=engines[0]).ids.tolist()
print(json.dumps([forces, dug, len(mpm.arrays()['id']), wrong, mixed]))
''')
	forces, dug, left, wrong, (mixed, nearest) = run.result
	assert forces == pytest.approx([48000 * (1 - i / 4) for i in (1, 2, 3, 4)], rel=1e-6, abs=.1)
	assert 'density' not in run.stderr and 'young' not in run.stderr
	assert dug == 32 and left == 96 and 'groupMask' in wrong
	assert '100' in mixed and nearest[0] < 64


def test_histories_go_on_beside_stages_and_a_lonely_position_is_refused(yade):
	without, loaded, messages, ids = yade(setting + '''
begin(young=1e7)
O.bodies.append(mpm.fill(part(0, 2, 0, 2), grid, 2, 'soil'))
O.engines = [engine()]
h = mpm.histories([(1, 2, 0)], record=['displacement'], label='top')
mpm.stages.place(mpm.fill(part(0, 2, 2, 3), grid, 2, 'soil'), steps=4)
mpm.save('at-once.yade.gz')
O.run(2, wait=True)
mpm.save('half.yade.gz')
O.run(2, wait=True)
without, loaded = h['displacement_y'].ravel().tolist(), []
for name in 'half.yade.gz', 'at-once.yade.gz':
	mpm.load(name)
	O.run(2, wait=True)
	loaded.append(mpm.histories.loaded('top')['displacement_y'].ravel().tolist())
messages = [refused(mpm.histories, at, label='b') for at in ((1, 2, 0), Vector3(1, 2, 0), (1.5, 2, 0), [1., 2., 0.], np.array([1., 2., 0.]))]
print(json.dumps([without, loaded, messages, mpm.histories([1, 2, 0], label='c').ids.tolist()]))
''').result
	assert loaded[0][-2:] == without[-2:] and loaded[1][-2:] == without[1:3]
	assert all(text.startswith('ValueError') and 'brackets' in text and 'at=[' in text for text in messages)
	assert ids == [1, 2, 0]


def test_displacements_are_counted_anew_around_an_axis(yade):
	results, other = yade(setting + '''
out = []
for again in False, True:
	begin(young=5e5)
	own = MpmGrid(cellSize=h, axisymmetric=True)
	O.bodies.append(mpm.fill(part(0, 3, 0, 2), own, 2, 'soil'))
	O.engines = [engine(grid=own, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y')])]
	O.dt = .25
	O.run(2, wait=True)
	if again: mpm.stages.resetDisplacements()
	O.run(2, wait=True)
	out.append(mpm.arrays()['pos'].tolist())
begin()
O.bodies.append(mpm.fill(part(0, 3, 0, 2), grid, 2, 'soil'))
O.engines = [engine(grid=MpmGrid(cellSize=h, axisymmetric=True), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y')])]
print(json.dumps([out, refused(O.run, 1, wait=True)]))
''').result
	assert results[0] == results[1]
	assert 'made for another grid' in other
