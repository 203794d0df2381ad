# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls off the lines of the grid, MpmBoundary.surface: what they hold, how they move, that they continue, and what is refused about them."""
import numpy as np
import pytest
from conftest import outcomesOf

block = '''
import json
import numpy as np
from yade import mpm, pack

def block(dim=2, push=0.1, penalty=100, halvings=0, adapts=False, **keywords):
	"""2 x 2 [x 2] m, nu = 0, E = 1 MPa, without weight, between walls off the lines of the grid, of which the upper one moves down; with cells that are halved in a corner."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=1, label='soil'))
	grid = MpmGrid(cellSize=0.5, dim=dim)
	if halvings: grid.refinements = [MpmRefinement(min=(1.4, 1.4, 1.4 if dim == 3 else -inf), halvings=halvings)]
	if adapts: grid.adaptation = [MpmAdaptation(where='error', halvings=2)]
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (2, 2, 2 if dim == 3 else 1)), grid, 2, 'soil'))
	grid.origin = (-0.17, -0.2, 0)  # after the points are in their places
	a, b = -0.3, 2.3
	def wall(p, q, **more):
		if dim == 2: surface = [p, q]
		else: surface = [[(*p, a), (*p, b), (*q, b)], [(*p, a), (*q, b), (*q, a)]]
		return MpmBoundary(**dict(dict(surface=surface, fix='n', penalty=penalty), **more))
	sides = [wall((a, 0), (b, 0)), wall((0, b), (0, a)), wall((2, a), (2, b)), wall((b, 2), (a, 2), velocity=(0, -2 * push, 0))]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, 2), fix='z')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, newton=MpmNewton(tolerance=1e-9), label='solver', verbosity=0, **keywords)]
	O.dt = 0.25

def state(): return [mpm.arrays()[name].tolist() for name in ('pos', 'stress')] + [[list(r) for r in solver.reactions], [list(v) for b in solver.boundaries if b.surface for v in b.surface.vertices]]
'''


def test_a_wall_that_is_pushed_in(yade):
	"""Cauchy stress E ln(l) / l at the stretch l; what pushes is what the foot bears."""
	results = yade(block + '''
found = []
for dim, halvings in (2, 0), (3, 0), (2, 2), (3, 1):
	block(dim, halvings=halvings)
	O.run(4, wait=True)
	data = solver.plotData()
	found.append([mpm.arrays()['stress'][:, 1, 1].tolist(), data['reaction3_y'], data['reaction0_y'], data['reaction1_x'], [v[1] for v in solver.boundaries[3].surface.vertices]])
print(json.dumps(found))
''').result
	exact = 1e6 * np.log(0.9) / 0.9
	for dim, (stress, lid, foot, side, heights) in zip((2, 3, 2, 3), results):
		area = 2**(dim - 1)
		assert abs(np.mean(stress) / exact - 1) < 0.01 and np.ptp(stress) < -0.03 * exact
		assert abs(lid / (area * exact) - 1) < 0.012 and abs(foot / -lid - 1) < 1e-8 and abs(side / lid) < 1e-3
		assert max(abs(y - 1.8) for y in heights) < 1e-12


@pytest.mark.parametrize('cells', ['', 'halvings=2', 'adapts=True'])
def test_a_saved_run_continues_bit_for_bit(yade, cells):
	results = yade(block + f'''
block({cells})
O.run(2, wait=True)
mpm.save('between.xml.gz')
O.run(2, wait=True)
straight = state()
O.load('between.xml.gz')
O.run(2, wait=True)
print(json.dumps([straight, state()]))
''').result
	assert results[0] == results[1]


def test_nothing_is_forgotten_from_step_to_step(yade):
	"""In many steps the wall gives way by no more than in few, and a step without anything new moves nothing."""
	results = yade(block + '''
found = []
for steps in 2, 40:
	block(push=0.01, penalty=10)
	O.dt = 1 / steps
	O.run(steps, wait=True)
	found.append(solver.reactions[3][1])
solver.boundaries[3].velocity = (0, 0, 0)
before = mpm.arrays()['pos']
O.run(5, wait=True)
print(json.dumps([found, solver.reactions[3][1], np.abs(mpm.arrays()['pos'] - before).max()]))
''').result
	(few, many), later, moved = results
	assert abs(many / few - 1) < 2e-3 and abs(later / many - 1) < 1e-4 and moved < 2e-6 * 2  # the stabilisation of the last increment goes away


def test_studies_see_walls(yade):
	results = yade(block + '''
block()
O.run(1, wait=True)
with_ = solver.conditionNumber(), solver.workload()['dofs'], solver.conditionEstimate()
for b in solver.boundaries: b.penalty = 1e4
print(json.dumps([with_, solver.conditionNumber()]))
''').result
	(condition, dofs, estimate), harder = results
	assert 1 < estimate <= 1.001 * condition < 1e6 and dofs > 0 and harder > 5 * condition


def test_a_sheared_layer_goes_around(yade):
	"""Periodic along x, between two rough plates off the lines of the grid of which one is pulled along: simple shear, and the plates bear the same."""
	results = yade(block + '''
block()
solver.grid.origin, solver.grid.period = (0, -0.2, 0), (2, 0, 0)
solver.boundaries = [MpmBoundary(surface=[(0, 0), (2, 0)], fix='xy'), MpmBoundary(surface=[(2, 2), (0, 2)], fix='xy', velocity=(0.02, 0, 0))]
O.run(4, wait=True)
print(json.dumps([mpm.arrays()['stress'][:, 0, 1].tolist(), [list(r) for r in solver.reactions], solver.boundaries[1].surface.vertices[0][0]]))
''').result
	stress, (below, above), place = results
	assert abs(np.mean(stress) / 5000 - 1) < 0.01 and np.ptp(stress) < 150  # shear modulus times 0.01
	assert abs(above[0] / 1e4 - 1) < 0.01 and abs(below[0] / above[0] + 1) < 1e-8 and abs(place - 2.02) < 1e-12


def test_strength_is_reduced_between_walls(yade):
	"""A vertical cut on a rough base off the grid has the factor of safety of one on nodes, within what the search tells."""
	results = yade(block + '''
def cut(onNodes):
	O.reset()
	O.materials.append(MpmTrescaMat(young=1e7, poisson=0.3, density=2000, undrainedStrength=20e3, label='clay'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (4, 2, 1)), grid, 2, 'clay'))
	if onNodes: held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	else:
		grid.origin = (-0.08, -0.1, 0)
		held = [MpmBoundary(surface=[(0, 3), (0, -1)], fix='x'), MpmBoundary(surface=[(-1, 0), (6, 0)], fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=held, gravity=(0, -10, 0), fBar=True, label='solver', verbosity=0)]
	O.dt = 0.5
	O.run(2, wait=True)
	found = mpm.strengthReduction(tolerance=0.02)
	return found['lower'], found['upper']
print(json.dumps([cut(True), cut(False)]))
''').result
	(low, high), (lower, upper) = results
	assert abs((lower + upper) / (low + high) - 1) < 0.04 and lower > 1.888  # limit analysis; both are above, on cells of an eighth of the height


def test_pictures_and_files(yade):
	run = yade(block + '''
block()
O.engines += [MpmVtkRecorder(fileName='block-', recorders=['walls'])]
O.run(2, wait=True)
ax = mpm.plot('stress_yy', fileName='plane.png')
print(json.dumps([c.get_label() for c in ax.collections]))
''')
	assert 'walls' in run.result
	assert (run.folder / 'plane.png').stat().st_size > 5000
	written = (run.folder / 'block-walls.2.vtu').read_text(errors='replace')
	assert 'Name="boundary"' in written and 'Name="traction"' in written


def test_what_is_refused(yade):
	refused = {
	        "MpmBoundary(fix='n')": ["fix = 'n' is the normal of a surface", "fix='x'"],
	        "MpmBoundary(surface=[(0, 0), (1, 1)], min=(0, 0, 0), fix='n')": ['has a surface and a box', 'give one of them'],
	        "MpmBoundary(surface=[(0, 0), (1, 1)], displacement=(0, 1, 0), fix='xy')": ['MpmBoundary.displacement = 1 along y', 'moves by its velocity'],
	        "MpmBoundary(velocity=(1, 0, 0), fix='x')": ['MpmBoundary.velocity = 1 along x', 'move by their displacement'],
	        "MpmBoundary(penalty=10, fix='x')": ['MpmBoundary.penalty = 10 is that of a surface'],
	        "MpmBoundary(surface=[(0, 0), (1, 1)], velocity=(1, 0, 0), fix='y')": ["a direction that fix = 'y' leaves free"],
	        "MpmBoundary(surface=[(0, 0), (1, 1)], fix='z')": ['there is no direction z'],
	        "MpmBoundary(surface=[[(0, 0, 0), (1, 0, 0), (1, 1, 0)]], fix='n')": ['boundaries[0].surface is made of triangles', 'a line of points'],
	        "MpmBoundary(surface=[(0, 0), (0, 0)], fix='n')": ['has no size'],
	        "MpmBoundary(surface=[(0, 9), (1, 9)], fix='n', velocity=(0, -1, 0))": ['a wall moves, but none of it is where the grid holds material'],
	}
	outcomes = outcomesOf(yade.folder, block, [f'solver.boundaries = [{statement}] + list(solver.boundaries[1:]); O.step()' for statement in refused], before='block()')
	for (statement, parts), outcome in zip(refused.items(), outcomes.values()):
		for part in parts:
			assert part in outcome[1], (statement, outcome)
	others = {
	        'solver.ghost = MpmGhost(factor=0); O.step()': ['boundaries[0].surface', 'needs ghost stabilisation'],
	        'solver.boundaries[1].surface = solver.boundaries[0].surface; O.step()': ['boundaries[0] and boundaries[1] have the same MpmSurface'],
	        'solver.loads = [MpmTraction(surface=solver.boundaries[3].surface)]; O.step()': ['boundaries[3] and loads[0] have the same MpmSurface'],
	        'O.step(); solver.grid.cellSize = 0.25; solver.grid.cellSize = 0.7; solver.boundaries[0].surface.pieces = solver.boundaries[0].surface.pieces[1:]; O.step()':
	                ['but what it bears is known of', 'give it a new MpmSurface'],
	        'solver.grid.origin = (0, 0, 0); solver.grid.period = (2, 0, 0); O.step()': ['boundaries[0].surface is 2.6 m long along x', 'after 2 m', 'one period at most'],
	        'solver.boundaries = [solver.boundaries[1]]; O.step()': ['nothing restrains the'],
	}
	outcomes = outcomesOf(yade.folder, block, list(others), before='block()')
	for statement, parts in others.items():
		for part in parts:
			assert part in outcomes[statement][1], (statement, outcomes[statement])
