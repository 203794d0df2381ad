# SPDX-License-Identifier: GPL-2.0-or-later
"""Boundaries that move their nodes: how far the soil follows, what is said when it does not, and the ways to push deeper."""
import json
import math
import re

import pytest
from conftest import root

setting = '''
import json
from math import log, ceil
from scenes import *
from yade.wrapper import PyRunner
E, nu, H = 1e6, 0.25, 4.

def ground(size, h, pointsPerCell=2, dim=2, yieldStress=None, basis='gimp'):
	"""A box of soil on a base, smooth sides; the last boundary is still to come."""
	O.reset()
	soil = dict(young=E, poisson=nu, density=2000, label='soil')
	O.materials.append(MpmVonMisesMat(yieldStress=yieldStress, **soil) if yieldStress else MpmElasticMat(**soil))
	grid = MpmGrid(cellSize=h, dim=dim)
	x, y, z = size[0], size[1], h if dim == 3 else 1
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (x, y, z)), grid, pointsPerCell, 'soil'))
	sides = [MpmBoundary(max=(inf, 0, inf), fix='xyz'[:dim]), MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(x, -inf, -inf), fix='x')]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, z), fix='z')]
	solver = MpmImplicitEngine(grid=grid, boundaries=sides, basis=basis, label='solver', verbosity=0)
	O.engines = [solver]
	return solver

def push(solver, cells, top, width=inf, stepsPerCell=10, along=(0, -1, 0), fix='y'):
	"""Moves the nodes at the height *top*; returns steps made and what ended them."""
	move = tuple(cells * solver.grid.cellSize * a for a in along)
	solver.boundaries = [*solver.boundaries, MpmBoundary(min=(-inf, top, -inf), max=(width, top, inf), fix=fix, displacement=move)]
	O.dt = 1 / (cells * stepsPerCell)
	return go(round(cells * stepsPerCell))

def go(steps):
	for step in range(steps):
		before = mpm.arrays()['pos']
		try: O.step()
		except RuntimeError as error:
			assert np.array_equal(before, mpm.arrays()['pos']) and solver.report()['failure'] == 'detached' and solver.cuts == 0, error
			return step, str(error)
	return steps, ''

def follows(top, width=inf):
	"""Movement of the soil's upper face over that of the nodes."""
	points = mpm.arrays()
	at = (points['pos0'][:, 1] > top - 0.6 * solver.grid.cellSize) & (points['pos0'][:, 1] < top) & (points['pos0'][:, 0] < width)
	at &= points['pos0'][:, 1] > points['pos0'][at, 1].max() - 1e-9
	return float((top - (points['pos'] + points['halfSize'])[at, 1].mean()) / -(solver.boundaries[-1].displacement[1] * solver.loadFactor))

def exact(pushed):
	"""Force on an elastic column per area."""
	stretch = 1 - pushed / H
	return -E * (1 - nu) / (1 + nu) / (1 - 2 * nu) * log(stretch) / stretch
'''


def test_a_step_that_would_lose_the_soil_ends_with_the_name_of_the_boundary(yade):
	"""After half a cell to three quarters, with a tenth of the movement lost at most, a sixth with one point a cell; at once after a step of a whole cell."""
	outcomes = yade(
	        setting + '''
outcomes = {}
def column(name, stepsPerCell=10, dim=2, **others):
	solver = ground((H / 8, H), H / 8, dim=dim, **others)
	steps, message = push(solver, 3, H, stepsPerCell=stepsPerCell)
	outcomes[name] = steps / stepsPerCell, follows(H), message
for pointsPerCell in 1, 2, 3, 4:
	column(f'{pointsPerCell} points', pointsPerCell=pointsPerCell)
column('3D', dim=3)
column('mpm', basis='mpm')
column('whole cells', stepsPerCell=1)
def footing(name, size, h, yieldStress, **others):
	solver = ground(size, h, yieldStress=yieldStress)
	steps, message = push(solver, 2, size[1], width=1, fix='xy', **others)
	outcomes[name] = steps / 10, follows(size[1], 0.9), message
footing('footing', (6, 3), 0.5, 20e3)
footing('finer footing', (6, 5), 0.25, 14e3)
print(json.dumps(outcomes))
'''
	).result
	assert len(outcomes) == 9
	cells, follows, message = outcomes.pop('whole cells')
	assert cells == 1 and abs(follows - 1) < 0.01 and 'none of its nodes' in message, (cells, follows, message)
	for name, (cells, follows, message) in outcomes.items():
		assert 0.5 <= cells <= 0.75 and 0.84 < follows < 1.01, (name, cells, follows)
		number = 5 if name == '3D' else 3
		parts = f'boundaries[{number}] moves by (0, -', 'pushes along -y is ', ' cells away from its node at (', 'put the box where the soil is', 'last converged'
		assert all(words in message for words in parts), (name, message)


def test_soil_that_is_pulled_or_moved_sideways_stays_with_its_nodes(yade):
	"""A row of nodes that moves up in its place stretches what is below it at an even rate, and lets what has passed it unload: so much follows, with this force over that of an even stretch of all soil."""
	pulled, force, sheared = yade(
	        setting + '''
solver = ground((H / 8, H), H / 8)
assert push(solver, 2.5, H, along=(0, 1, 0)) == (25, '')
pulled, force = follows(H), solver.reactions[-1][1] / (-exact(-2.5 * H / 8) * H / 8)
solver = ground((H / 8, H), H / 8)
solver.boundaries = solver.boundaries[:1]
assert push(solver, 2.5, H, along=(1, 0, 0), fix='x') == (25, '')
points = mpm.arrays()
sheared = (points['pos'] - points['pos0'])[points['pos0'][:, 1] > H - 0.2, 0].mean() / (2.5 * H / 8)
print(json.dumps([pulled, force, sheared]))
'''
	).result
	way = 2.5 / 8
	assert abs(pulled / ((1 - math.exp(-way)) / way) - 1) < 0.02
	assert abs(force / (way * math.exp(-way) / (math.log1p(way) / (1 + way))) - 1) < 0.02
	assert 0.85 < sheared < 1


def test_nodes_without_soil(yade):
	"""Those that are to move are refused, before they begin to; others are named once: soil may arrive there."""
	run = yade(
	        setting + '''
solver = ground((2, 2), 0.5)
sides = solver.boundaries
inTheAir = dict(min=(-inf, 3, -inf), max=(1, 4, inf), fix='y')
solver.gravityCurve, solver.loadCurve = [(0, 0), (1, 1)], [(1, 0), (2, 1)]
solver.boundaries = [*sides, MpmBoundary(displacement=(0, -0.1, 0), **inTheAir)]
O.dt = 0.1
steps, moving = go(1)
assert steps == 0
O.reset() # nothing of this engine is left
solver = ground((2, 2), 0.5)
solver.boundaries = [*solver.boundaries, MpmBoundary(**inTheAir)]
solver.gravity = (0, -10, 0)
O.dt = 0.1
for step in range(3):
	O.step()
	solver.boundaries = [*solver.boundaries[:4], MpmBoundary(max=(inf, 0, inf), fix='xy')] # anew: only what is new is looked at
print(json.dumps(moving))
'''
	)
	parts = 'boundaries[3] moves by (0, -0.1) m', 'none of its nodes, from (-inf, 3) to (1, 4), carries soil', 'between (0, 0) and (2, 2)', 'put the box where'
	assert all(words in run.result for words in parts), run.result
	said = run.stdout + run.stderr
	assert said.count('boundaries[3], from (-inf    3 -inf) to (  1   4 inf), constrains no node of any material. It constrains nothing until soil arrives there.') == 1, run
	assert said.count('constrains no node') == 1, run


def test_a_loaded_scene_ends_at_the_same_step(yade):
	ends = yade(
	        setting + '''
def columnSteps(saveAt):
	solver = ground((H / 8, H), H / 8)
	solver.boundaries = [*solver.boundaries, MpmBoundary(min=(-inf, H, -inf), max=(inf, H, inf), fix='y', displacement=(0, -1, 0))]
	O.dt = 1 / 40
	if saveAt:
		O.run(saveAt, wait=True)
		mpm.save('half.yade.gz')
		O.reset()
		O.load('half.yade.gz')
	return saveAt, *go(40)
ends = []
for saveAt in 0, 5, 9:
	before, steps, message = columnSteps(saveAt)
	ends.append([before + steps, message, mpm.arrays()['pos'].tolist()])
print(json.dumps(ends))
'''
	).result
	assert ends[0][0] > 9 and ends[0][1] and ends[0] == ends[1] == ends[2]


def test_recipes_for_pushing_deeper_are_as_exact_as_the_page_says(yade):
	"""Nodes that walk and a stiff block, by 3 cells of 8: movement and force of an elastic column."""
	page = (root / 'plugin/docs/studies/examples.md').read_text()
	row = re.search(r'\| 8 \| ([\d.]+) %, 0 to \+(\d+) % \| ([\d.]+) %, 0 to \+(\d+) % \|', page)
	walk, high, block, most = map(float, row.groups())
	walking, pushed = yade(
	        setting + '''
D, h = 1.5, H / 8
def errors():
	found = []
	for step in range(30):
		O.step()
		moved, force = follows(H), sum(r[1] for r in solver.reactions[3:])
		found.append([moved - 1, -force / h / exact(D * solver.loadFactor) - 1, solver.loadFactor * 3 > 1 + 1e-9])
	return found
solver = ground((h, H), h)
others = solver.boundaries
def walk():
	row = H - h * ceil(D * solver.loadFactor / h - 1e-6)
	solver.boundaries = [*others, MpmBoundary(min=(-inf, row, -inf), fix='y', displacement=(0, -D, 0))]
walk()
O.engines += [PyRunner(iterPeriod=1, initRun=True, command='walk()')]
O.dt = 1 / 30
results = [errors()]
solver = ground((h, H), h)
O.materials.append(MpmElasticMat(young=1000 * E, poisson=nu, density=2000, label='steel'))
O.bodies.append(mpm.fill(pack.inAlignedBox((0, H, -1), (h, H + 5 * h, 1)), solver.grid, 2, 'steel'))
solver.boundaries = [*solver.boundaries, MpmBoundary(min=(0, H + h, -inf), max=(0, H + 2 * h, inf), fix='y', displacement=(0, -D, 0))]
O.dt = 1 / 30
results.append(errors())
print(json.dumps(results))
'''
	).result
	for errors, movement, (least, largest) in (walking, walk, (0, high)), (pushed, block, (0, most)):
		assert movement - 0.1 < 100 * max(abs(moved) for moved, _, _ in errors) < movement + 0.1
		forces = [100 * force for _, force, isDeep in errors if isDeep]
		assert least - 0.5 < min(forces) < least + 1 and largest - 1 < max(forces) < largest + 0.5, (min(forces), max(forces))


def test_advise_tells_how_far_nodes_push(yade):
	advice = yade(
	        setting + '''
solver = ground((2, 2), 0.5)
solver.boundaries = [*solver.boundaries, *(MpmBoundary(min=(-inf, 2, -inf), max=(1, 2, inf), fix='y', displacement=(0, u, 0)) for u in (-0.2, -2))]
O.dt = 0.1
sides = solver.boundaries
advice = []
for k in 3, 4:
	solver.boundaries = [*sides[:3], sides[k]]
	advice.append(mpm.advise(solver)['advice'])
print(json.dumps(advice))
'''
	).result
	assert not any('boundaries' in sentence for sentence in advice[0])
	assert any(sentence.startswith('boundaries[3]: it moves by 4 cells') for sentence in advice[1])
