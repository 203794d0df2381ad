# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads on surfaces that move with the body: mpm.surface, MpmTraction, and what is refused about them."""
import pytest
from conftest import outcomesOf

column = '''
import json
import numpy as np
from yade import mpm, pack

def column(dim=2, **load):
	"""A confined block of 2 x 2 [x 2] m without weight, nu = 0, E = 1 MPa, with a load on its upper side."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0, density=1, label='soil'))
	grid = MpmGrid(cellSize=0.5, dim=dim)
	block = pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (2, 2, 2 if dim == 3 else 1))
	O.bodies.append(mpm.fill(block, grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, 2), fix='z')]
	load = MpmTraction(**dict(dict(surface=mpm.surface(block, min=(-inf, 2), dim=dim), pressure=2e5) | load))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, loads=[load], newton=MpmNewton(tolerance=1e-9), label='solver', verbosity=0)]
	O.dt = 0.25
	return load

def height(): return max(v[1] for v in solver.loads[0].surface.vertices) / 2
'''


def test_surcharge_gives_the_exact_stretch(yade):
	"""Confined, nu = 0: E ln l / l = -q, so l = 0.844580 for q = E / 5; dead or following, it is the same."""
	results = yade(column + '''
found = []
for load in dict(), dict(pressure=0, traction=(0, -2e5, 0)):
	column(**load)
	O.run(4, wait=True)
	data = solver.plotData()
	found.append([height(), data['load0_y'], data['reaction_y'], data['load0_x']])
column(dim=3)
O.run(4, wait=True)
print(json.dumps([found, height()]))
''').result
	for stretch, down, up, aside in results[0]:
		assert abs(stretch - 0.844580) < 2e-6
		assert abs(down / -4e5 - 1) < 1e-8 and abs(up / 4e5 - 1) < 1e-8 and abs(aside) < 1e-6
	assert abs(results[1] - 0.844580) < 1e-3  # triangles hand a uniform load to the nodes less evenly than segments


def test_a_load_with_its_own_curve_goes_and_comes_back(yade):
	"""And a run that stops between is continued from a saved file to the same state, bit for bit."""
	results = yade(column + '''
def finish():
	O.run(6, wait=True)
	return [height(), mpm.arrays()['pos'].tolist(), [list(v) for v in solver.loads[0].surface.vertices], O.time]

heights = []
column(curve=[(0, 0), (1, 1), (2, 0)])
for i in range(2):
	O.run(1, wait=True)
	heights.append(height())
mpm.save('between.xml.gz')
straight = finish()
O.load('between.xml.gz')
print(json.dumps([heights, straight[0], straight == finish()]))
''').result
	assert 1 > results[0][0] > results[0][1] > 0.845
	assert abs(results[1] - 1) < 1e-9
	assert results[2]


def test_safety_counts_loads_on_surfaces(yade):
	"""Clay that may widen, under a pressure q with c_u = 0.8 q: 2 c_u = 1.6 q carries it up to F = 1.6; the load is left where it is."""
	results = yade(column + '''
load = column()
O.materials.append(MpmTrescaMat(young=1e8, poisson=0.3, density=1, undrainedStrength=8e4, label='clay'))
for b in O.bodies: b.material = O.materials['clay']
load.pressure = 1e5
solver.boundaries = solver.boundaries[:1] + solver.boundaries[2:]
O.run(4, wait=True)
before = [list(v) for v in load.surface.vertices]
safety = mpm.strengthReduction(tolerance=0.01)
print(json.dumps([safety['lower'], safety['upper'], before == [list(v) for v in load.surface.vertices]]))
''').result
	assert 0.98 * 1.6 < results[0] < results[1] < 1.02 * 1.6 and results[2]


def test_surfaces_of_regions(yade):
	"""Number of pieces, their total size, and the sum of their normals; that of a closed surface vanishes."""
	results = yade('''
import json
import numpy as np
import gts
from yade import mpm, pack, geom

def measured(surface):
	x = np.array(surface.vertices)
	if len(surface.pieces[0]) == 2:
		along = np.array([x[b] - x[a] for a, b in surface.pieces])
		normals = np.stack([along[:, 1], -along[:, 0], 0 * along[:, 0]], 1)
	else: normals = np.array([np.cross(x[b] - x[a], x[c] - x[a]) / 2 for a, b, c in surface.pieces])
	return [len(surface.pieces), np.linalg.norm(normals, axis=1).sum(), normals.sum(axis=0).tolist(), len(surface.vertices)]

profile = mpm.polygon([(0, 0), (10, 0), (10, 4), (6, 4), (3, 8), (0, 8)])
bank = profile & pack.inAlignedBox((0, 0, 0), (10, 8, 5))
cube = pack.inAlignedBox((0, 0, 0), (1, 1, 1))
ball = gts.sphere(3)
print(json.dumps(dict(
	outline=measured(mpm.surface(profile)), crest=measured(mpm.surface(profile, min=(1, 7.9), max=(2, inf))), slope=measured(mpm.surface(profile, min=(3.6, 4), max=(6, 8))),
	circle=measured(mpm.surface(pack.inSphere((0, 0, 0), 1))), hole=measured(mpm.surface(pack.inAlignedBox((-2, -2, -1), (2, 2, 1)) - pack.inSphere((0, 0, 0), 1))),
	bank=measured(mpm.surface(bank, dim=3)), crestOfBank=measured(mpm.surface(bank, min=(0, 8, 1), max=(2, 8, 3), dim=3)),
	cube=measured(mpm.surface(cube, dim=3)), ball=measured(mpm.surface(pack.inGtsSurface(ball), dim=3)), given=measured(MpmTraction(surface=ball).surface),
	line=measured(MpmTraction(surface=[(0, 1), (3, 1), (3, 5)]).surface), ring=measured(MpmTraction(surface=[(0, 0), (1, 0), (1, 1), (0, 0)]).surface),
	triangles=measured(MpmTraction(surface=[[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0), (0, 1, 0)]]).surface))))
''').result
	closed = ('outline', 'circle', 'hole', 'bank', 'cube', 'ball', 'given', 'ring')
	for name in closed:
		assert max(map(abs, results[name][2])) < 1e-9 * results[name][1], name
	assert results['outline'][:2] == [6, pytest.approx(10 + 4 + 4 + 5 + 3 + 8)]
	assert results['crest'] == [1, pytest.approx(1), pytest.approx([0, 1, 0]), 2]
	assert results['slope'][1:3] == [pytest.approx(4), pytest.approx([3.2, 2.4, 0])]
	assert abs(results['circle'][1] / 6.283185 - 1) < 2e-3
	assert abs(results['hole'][1] / (6.283185 + 16) - 1) < 5e-3
	assert results['bank'][1] == pytest.approx(2 * (10 * 4 + 3 * 4 + 6) + 34 * 5)
	assert results['crestOfBank'][1:3] == [pytest.approx(4), pytest.approx([0, 4, 0])]
	assert results['cube'] == [12, pytest.approx(6), pytest.approx([0, 0, 0]), 8]
	assert results['ball'] == results['given'] and results['ball'][0] == 320 and results['ball'][3] == 162
	assert results['line'][:2] == [2, pytest.approx(7)] and results['ring'][3] == 3
	assert results['triangles'][1:] == [pytest.approx(1), pytest.approx([0, 0, 1]), 4]


def test_what_cannot_be_meant_is_refused(yade):
	refused = {
	        'column(surface=[(2, 2), (0, 2)][::-1])': ['reverse the order of its points'],
	        'column(surface=[(2, 2.3), (0, 2.3)])': ['loads[0] has a vertex at (', '2.3), where there is no material within 0.25 cells'],
	        'column(surface=[[(0, 2, 0), (0, 2, 1), (1, 2, 0)]])': ['loads[0].surface is made of triangles, but the grid has dim=2'],
	        'column(dim=3, surface=[(2, 2), (0, 2)])': ['loads[0].surface is made of segments, but the grid has dim=3'],
	        'column(traction=(0, 0, 1))': ['loads[0].traction = Vector3(0,0,1)', 'no direction z'],
	        'load = column(); solver.loads = [load, MpmTraction(surface=load.surface, pressure=1)]': ['loads[0] and loads[1] have the same MpmSurface'],
	        'solver = column(surface=[(2, 2), (2, 2), (0, 2)])': ['MpmSurface.pieces[0] = (0, 1)', 'has no size'],
	        'load = column(); load.surface = MpmSurface(vertices=[(0, 0, 0), (1, 0, 0)], pieces=[(0, 2)])': ['MpmSurface.pieces[0] = (0, 2): there are vertices 0 to 1 only'],
	        'mpm.surface(mpm.polygon([(0, 0), (1, 0), (0, 1)]), min=(3, 3))': ['surface: nothing of it lies between min = (3.0, 3.0)', 'from (0.0, 0.0) to (1.0, 1.0)'],
	        'mpm.surface(pack.inSphere((0, 0, 0), 1), dim=3)': ['is not known in 3D', 'pack.inGtsSurface'],
	        'mpm.surface(3)': ['region = 3 must be a predicate'],
	        'mpm.surface(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), min=1)': ['min = 1 must be two or three numbers'],
	        'MpmTraction(surface=[(0, 0)])': ['MpmTraction.surface = ', 'a sequence of points'],
	}
	outcomes = outcomesOf(yade.folder, column, [statement + '; O.step()' for statement in refused])
	for statement, parts in refused.items():
		for part in parts:
			assert part in outcomes[statement + '; O.step()'][1], (statement, outcomes[statement + '; O.step()'])


def test_pictures_and_files(yade):
	run = yade(column + '''
column()
O.engines += [MpmVtkRecorder(fileName='column-', recorders=['loads'])]
O.run(2, wait=True)
ax = mpm.plot('stress_yy', fileName='plane.png')
labels = [c.get_label() for c in ax.collections]
column(dim=3)
O.run(1, wait=True)
mpm.plot('stress_yy', fileName='space.png', plane=('x', 1))
print(json.dumps(labels))
''')
	assert 'loads' in run.result
	assert (run.folder / 'plane.png').stat().st_size > 5000 and (run.folder / 'space.png').stat().st_size > 5000
	assert (run.folder / 'column-loads.2.vtu').exists() and 'column-loads.2.vtu' in (run.folder / 'column-loads.pvd').read_text()
