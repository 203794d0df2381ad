# SPDX-License-Identifier: GPL-2.0-or-later
"""The stiffness that studies tell is that of a load step, whatever acts on the body; and studies refuse what a step refuses."""
from conftest import outcomesOf

scene = '''
import itertools
import json
from math import inf, pi, radians
import numpy as np
from yade import mpm, pack, utils

young, h, size = 1e6, .5, 1.5

def build(dim=2, fBar=False, period=False, Engine=MpmImplicitEngine, without=(), **ofGrid):
	"""A block on a plate with friction, beside an oblique wall, under a pressure that follows, with water in its pores and outside."""
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=.2, density=2000, label='soil'))
	O.materials.append(FrictMat(young=1e9, frictionAngle=0, density=2000, label='steel'))
	grid = MpmGrid(cellSize=h, dim=dim, period=(size, 0, 0) if period else (0, 0, 0), **ofGrid)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (size, size, size if dim == 3 else 1)), grid, 2, 'soil'))
	plate = utils.wall(0, axis=1, sense=1, material='steel')
	plate.groupMask = 2
	O.bodies.append(plate)
	top = [(1.4, size), (.1, size)] if dim == 2 else [[(.1, size, .1), (.1, size, 1.4), (1.4, size, 1.4)]]
	side = [(1.2, 1.3), (1.3, .2)] if dim == 2 else [[(1.2, 1.3, .2), (1.25, .7, 1.2), (1.3, .1, .2)]]
	held = [] if period else [MpmBoundary(max=(0, inf, inf), fix='x')]
	if dim == 3: held += [MpmBoundary(max=(inf, inf, 0), fix='z')]
	acting = dict(
	        boundaries=held + [MpmBoundary(surface=side, fix='n', penalty=3)], loads=[MpmTraction(surface=top, pressure=3e4)],
	        water=[MpmWater(level=1.4, where='pores', weight=2e4), MpmWater(level=1, where='outside')], contacts=[MpmContact(mask=2, friction=radians(30), stiffness=5)])
	O.engines = [
	        Engine(grid=grid, basis='mpm', fBar=fBar, gravity=(0, -10, 0), loadCurve=[(0, 0), (1, 1)], newton=MpmNewton(tolerance=1e-11, maxIterations=40), verbosity=0,
	               label='solver', **{name: value for name, value in acting.items() if name not in without})]
	O.dt = .25
	return held

def shapes(held):
	"""N of the points on the free degrees of freedom, in the order of stiffness(): nodes by z, y, x."""
	x, dim, period = mpm.arrays()['pos'], solver.grid.dim, solver.grid.period[0] > 0
	found = {}
	for p, place in enumerate(x):
		cell = np.floor(place[:dim] / h).astype(int)
		for corner in itertools.product((0, 1), repeat=dim):
			node = cell + corner
			value = np.prod(1 - abs(place[:dim] / h - node))
			if period: node[0] %= round(size / h)
			found.setdefault(tuple(node[::-1]), []).append((p, value))
	N, axisHeld = [], solver.grid.axisymmetric
	for node in sorted(found):
		place = h * np.array(node[::-1] + (0,) * (3 - dim))
		for axis in range(dim):
			if any('xyz'[axis] in b.fix and all(place <= np.array(b.max) + 1e-9) for b in held) or (axis == 0 and axisHeld and place[0] == 0): continue
			column = np.zeros((len(x), 3))
			for p, value in found[node]:
				column[p, axis] += value
			N.append(column.ravel())
	return np.transpose(N)

def stiffness():
	rows, columns, values, count = solver.stiffness()
	K = np.zeros((count, count))
	K[rows, columns] = values
	return K

def error(**of):
	"""Displacements of all points by a small force on one of them: those of load steps, and by the stiffness; relative."""
	held = build(**of)
	O.run(8, wait=True)
	N, K = shapes(held), stiffness()
	assert N.shape[1] == len(K), (N.shape, K.shape)
	points, worst = mpm.arrays(), 0
	mpm.save('state.xml.gz')
	for place, axis in ((1.1, 1.1), 1), ((.6, .4), 0):
		p = int(abs(points['pos'][:, :2] - place).sum(axis=1).argmin())
		force = np.zeros(points['pos'].shape)
		force[p, axis] = 2
		ends = []
		for sign in 1, -1:
			mpm.load('state.xml.gz')
			O.bodies[int(points['id'][p])].state.force = Vector3(*(sign * force[p]))
			O.step()
			ends.append(mpm.arrays()['pos'])
		moved = ((ends[0] - ends[1]) / 2).ravel()
		told = N @ np.linalg.solve(K, N.T @ force.ravel())
		worst = max(worst, np.linalg.norm(told - moved) / np.linalg.norm(moved))
	return worst
'''


def test_a_small_force_moves_the_points_as_the_stiffness_tells(yade):
	"""The other loads, a wall, water and contact are there, and none of them may be left out: without any one of them it is off by 1 % or more."""
	errors = yade(scene + '''
print(json.dumps(dict(plane=error(), ring=error(axisymmetric=True), period=error(period=True), space=error(dim=3), fBar=error(fBar=True))))
''', timeout=300).result
	for name, error in errors.items():
		assert error < 1e-6, (name, error)


def test_studies_refuse_what_a_step_refuses(tmp_path):
	"""Refusal by name, instead of leaving it out."""
	above = 'solver.loads = [MpmTraction(surface=[(1, 5), (0, 5)], pressure=1e3)]; '
	both = 'build(); solver.loads = [MpmTraction(surface=solver.boundaries[1].surface, pressure=1)]; '
	cells = 'build(without=("loads", "boundaries", "contacts"), refinements=[MpmRefinement(max=(.5, .5, inf), halvings=1)]); '
	shaken = "build(Engine=MpmDynamicEngine); solver.scheme = 'explicit'; solver.ghost = MpmGhost(massFactor=.25); "
	statements = {f'build(); {above}solver.{study}': ['loads[0]', 'has a vertex at (1 5)', 'would fail']
	              for study in ('stiffness()', 'conditionNumber()', 'conditionEstimate()', 'workload()')}
	statements |= {
	        both + 'solver.workload()': ['have the same MpmSurface'], cells + "solver.newton.linearSolver = 'amg'; solver.stiffness()": ['cannot go with', 'amg'],
	        shaken + 'solver.loads = [MpmTraction(surface=solver.boundaries[1].surface, pressure=1)]; solver.criticalTimeStep()': ['have the same MpmSurface'],
	        shaken + 'solver.absorbing = [MpmAbsorbingBoundary(min=(40, 0, 0), max=(30, 1, 1))]; solver.stiffness()': ['MpmAbsorbingBoundary']}
	outcomes = outcomesOf(tmp_path, scene, statements)
	for statement, parts in statements.items():
		kind, text = outcomes[statement]
		assert kind == 'ValueError' and all(part in text for part in parts), (statement, outcomes[statement])


def test_cells_behind_an_absorbing_edge_are_not_counted(yade):
	"""Domains that reach through the edge end there: in studies and pictures as in steps, whose cells and faces are told by attributes."""
	found = yade(scene + '''
build(Engine=MpmDynamicEngine, without=('loads', 'water', 'contacts', 'boundaries'))
solver.basis, solver.gravity = 'gimp', Vector3(0, 0, 0)
for b in O.bodies:
	if isinstance(b.shape, MpmPoint): b.state.pos += Vector3(.05, 0, 0) # through an edge at 1.5
solver.absorbing = [MpmAbsorbingBoundary(min=(1.5, -inf, -inf))]
O.dt = 1e-4
before = solver.workload()
assert all(np.isnan(solver.plotData()[f'absorbing0_{axis}']) for axis in 'xy')
O.step()
assert all(np.isfinite(solver.plotData()[f'absorbing0_{axis}']) for axis in 'xy')
assert 'kineticEnergy' in solver.report() and 'absorbing0_x' not in solver.report() # which has energies, but not what acts
print(json.dumps([before['activeCells'], before['ghostFaces'], solver.activeCells, solver.ghostFaces]))
''').result
	assert found[:2] == found[2:] and found[0] == 9, found


def test_steps_to_the_end_of_all_curves(yade):
	"""Those of loads, boundaries and water of their own, too."""
	found = yade(scene + '''
ends = []
for change in '', 'solver.loads[0].curve = [(0, 0), (3, 1)]', 'solver.water[0].curve = [(0, 1), (4, 1)]', 'solver.boundaries[0].displacement, solver.boundaries[0].curve = (1e-3, 0, 0), [(0, 0), (5, 1)]':
	build()
	exec(change)
	ends.append((solver.loadsEnd(), mpm.advise()['steps']))
print(json.dumps(ends))
''').result
	assert found == [[1, 4], [3, 12], [4, 16], [5, 20]]
