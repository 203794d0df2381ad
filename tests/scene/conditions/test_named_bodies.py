# SPDX-License-Identifier: GPL-2.0-or-later
"""Held nodes, walls and loads of one of several bodies of points that share cells."""
import numpy as np
from conftest import outcomesOf

weight = 2000 * 10 * 0.625 * 1.625

scene = '''
import json
import numpy as np
from yade import mpm, pack

def beside(engine=MpmImplicitEngine, loads=(), more=(), feet=('left', 'right'), **settings):
	"""Two columns of 20312.5 N each, with a gap between them in the middle of cells, on floors of their own."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=2000, label='soil'))
	grid = MpmGrid(cellSize=0.25)
	for name, low, high in (('left', 0, 0.625), ('right', 0.625, 1.25)):
		O.bodies.append(mpm.fill(pack.inAlignedBox((low, 0, -1), (high, 1.625, 1)), grid, 2, 'soil', body=name))
	points = mpm.arrays()
	mpm.assign(pos=points['pos'] + np.outer(points['body'] == 1, (0.1, 0, 0)))
	grid.bodies[1].vertices = [np.array(x) + (0.1, 0, 0) for x in grid.bodies[1].vertices]
	floors = [MpmBoundary(max=(inf, 0, inf), fix='xy', body=name) for name in feet]
	solver = engine(grid=grid, gravity=(0, -10, 0), boundaries=[*floors, *more], loads=list(loads), contacts=[MpmBodyContact(between=('left', 'right'), friction=0)], newton=MpmNewton(tolerance=1e-9), verbosity=0, **settings)
	O.engines, O.dt = [solver], 1 / 2
	return solver

def top(**what):
	"""A load of 500 N between the columns, near both of them, and on one only by its name."""
	return MpmTraction(surface=[(0.71, 1.625), (0.66, 1.625)], traction=(0, -1e4, 0), **what)
'''


def test_loads_and_held_nodes_act_on_the_body_they_name(yade):
	"""Each floor bears the soil above it, and a row of nodes that is constrained for one body does not constrain the other one in the same cells."""
	loaded, held, walled = yade(scene + '''
found = []
solver = beside(loads=[top(body='right')])
O.run(2, wait=True)
found.append([solver.reactions[0][1], solver.reactions[1][1], solver.loads[0].resultant[1]])
solver = beside(more=[MpmBoundary(min=(-inf, 1.5, -inf), fix='y', body='left', displacement=(0, -0.01, 0))])
O.run(2, wait=True)
points = mpm.arrays()
sinks = [np.abs(points['pos'] - points['pos0'])[(points['body'] == b) & (points['pos0'][:, 1] > 1.5), 1].max() for b in (0, 1)]
found.append([solver.reactions[1][1], sinks])
solver = beside(feet=('left', ), more=[MpmBoundary(surface=[(2, 0.1), (-1, 0.1)], fix='xy', body='right')])
O.run(2, wait=True)
points = mpm.arrays()
found.append([solver.reactions[0][1], solver.reactions[1][1], np.abs(points['pos'] - points['pos0'])[points['body'] == 0, 1].max()])
print(json.dumps(found))
''').result
	assert np.allclose(loaded, [weight, weight + 500, -500], rtol=1e-6)
	# A column of 1.625 m sinks by 2000 * 10 * 1.625^2 / 2 / 1e6 = 26 mm at its top.
	reaction, (left, right) = held
	assert abs(reaction / weight - 1) < 1e-6 and left < 0.0105 and 0.014 < right < 0.026
	assert np.allclose(walled[:2], [weight, weight], rtol=1e-6)


def test_a_load_goes_on_after_a_restart(yade):
	"""Same bits with the body that the load names."""
	same, names = yade(scene + '''
solver = beside(MpmDynamicEngine, [top(body='right')], gravityCurve=[(0, 1)])
O.dt = 0.01
O.run(2, wait=True)
mpm.save('half.yade.gz')
O.run(2, wait=True)
ends = mpm.arrays()
mpm.load('half.yade.gz')
O.run(2, wait=True)
again, solver = mpm.arrays(), O.engines[0]
print(json.dumps([all(np.array_equal(ends[name], again[name]) for name in ends), [solver.loads[0].body, *(boundary.body for boundary in solver.boundaries)]]))
''').result
	assert same and names == ['right', 'left', 'right']


refusals = {
        "beside(loads=[top()])": ['loads[0]', 'two bodies', 'body'],
        "beside(loads=[top(body='middle')])": ["loads[0].body = 'middle'", 'left, right'],
        "beside(feet=('left', 'below'))": ["boundaries[1].body = 'below'", 'left, right'],
        "beside(more=[MpmBoundary(surface=[(2, 0.1), (-1, 0.1)], fix='xy')])": ['boundaries[2].surface', 'MpmBoundary.body'],
        "beside().contacts = []": ["boundaries[0].body = 'left'", 'no MpmBodyContact'],
        "beside(loads=[MpmTraction(surface=[(0.5, 1.625), (0, 1.625)], pressure=1, body='right')])": ["loads[0] on body 'right'", 'no material'],
        "beside(more=[MpmBoundary(min=(3, 0.5, -inf), max=(3, inf, inf), fix='x', body='left', displacement=(-0.1, 0, 0))])": ['boundaries[2]', 'carries soil'],
        "beside(more=[MpmBoundary(min=(-inf, 1.5, -inf), fix='y', displacement=(0, -0.01, 0), body='left'), MpmBoundary(min=(-inf, 1.5, -inf), fix='y', body='left')])": ['boundaries[2]', 'boundaries[3]', 'different displacements'],
        "beside(more=[MpmBoundary(min=(-inf, 1.5, -inf), fix='y', displacement=(0, -0.01, 0), body='left'), MpmBoundary(min=(-inf, 1.5, -inf), fix='y', body='right')])": [],
}


def test_names_that_no_body_has_are_refused(yade):
	outcomes = outcomesOf(yade.folder, scene, [statement + '; O.step()' for statement in refusals])
	for statement, words in refusals.items():
		_, said = outcomes[statement + '; O.step()']
		assert all(word in said for word in words) and bool(said) == bool(words), (statement, said)
