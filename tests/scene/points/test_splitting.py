# SPDX-License-Identifier: GPL-2.0-or-later
"""Points whose domains outgrow half a cell are split in two: what their halves have, and what the scene makes of them."""
import numpy as np
import pytest

# Blocks without stress that have been stretched far: a step leaves them as they are.
stretched = '''
import json
from math import inf
import numpy as np
from yade import mpm, pack, utils
h = 0.5

def block(F, engine=MpmImplicitEngine, dim=2, size=(1, 1, 1), low=(0, 0, 0), points=2, **settings):
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=1000, yieldStress=1e4, label='soil'))
	grid = MpmGrid(cellSize=h, dim=dim, axisymmetric=settings.pop('axisymmetric', False), period=settings.pop('period', (0, 0, 0)))
	bodies = mpm.fill(pack.inAlignedBox(low, tuple(a + b for a, b in zip(low, size))), grid, points, 'soil')
	for body in bodies:
		x, body.groupMask, body.shape.color = body.state.pos, 5, (0, 1, 0)
		body.state.pos = Matrix3(*F) * x
		body.state.force = (3, 7, 0)
	O.bodies.append(bodies)
	mpm.assign(defGrad=[np.reshape(F, (3, 3))] * len(bodies), elasticStrain=np.zeros((len(bodies), 3, 3)), plasticStrain=np.linspace(0, 1, len(bodies)))
	O.engines = [engine(grid=grid, verbosity=0, loadCurve=[(0, 0), (1, 0)], label='solver', **settings)]
	O.dt = 0.01
	return O.engines[0]

held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
'''

# Row of the first of all in the arrays, for each point; and what a point was before is the sum of all that came from
# it.
ancestry = '''
def roots(points):
	of = {}
	for id, parent in zip(points['id'], points['parent']):
		of[id] = of[parent] if parent >= 0 else id
	return np.array([of[id] for id in points['id']])
'''


@pytest.mark.parametrize('dim, F, halvings', [(2, (2.5, 0, 0, 0, 4.5, 0, 0, 0, 1), 1 + 2), (3, (2.5, 0, 0, 0, 0.5, 0, 0, 0, 2.2), 2)])
def test_halves_have_exactly_what_the_whole_had(yade, dim, F, halvings):
	result = yade(stretched + ancestry + f'''
moving = dict(F={F}, engine=MpmDynamicEngine, dim={dim})
def moved(maxSplits):
	solver = block(**moving, maxSplits=maxSplits)
	mpm.assign(velocity=[(1.25, 0.5, 0)] * len(mpm.arrays()['id']))
	O.step()
	return solver, mpm.arrays()
solver, whole = moved(0)
massBefore = np.array([O.bodies[int(i)].state.mass for i in whole['id']])
assert solver.clampedDomains == len(whole['id']) and 'parent' not in whole, solver.clampedDomains
solver, halves = moved(8)
of = np.searchsorted(whole['id'], roots(halves))
mass = np.array([O.bodies[int(i)].state.mass for i in halves['id']])
for name in 'velocity acceleration stress defGrad elasticStrain plasticStrain material'.split():
	assert np.array_equal(halves[name], whole[name][of]), name
# equal parts of a power of two have the whole as their sum, to the last bit
def sums(values): return np.array([values[of == i].sum(axis=0) for i in range(len(whole['id']))])
assert set(np.bincount(of)) == {{2**{halvings}}}
for name in 'volume', 'force':
	assert np.array_equal(halves[name] * 2**{halvings}, whole[name][of]), name
assert np.array_equal(mass * 2**{halvings}, massBefore[of])
# matter is where it was: first and second moments of boxes that lie side by side are those of the unlimited domains of
# before
U = np.array([{F}[0], {F}[4], {F}[8]])
box = whole['halfSize0'] * U
first, second = sums(halves['volume'][:, None] * halves['pos']), sums(halves['volume'][:, None] * (halves['pos']**2 + halves['halfSize']**2 / 3))
assert np.allclose(first, whole['volume'][:, None] * whole['pos'], rtol=1e-14, atol=1e-14)
axes = slice(0, {dim})
assert np.allclose(second[:, axes], (whole['volume'][:, None] * (whole['pos']**2 + box**2 / 3))[:, axes], rtol=1e-13)
# in a linear field of displacements those of halves go on in it
assert np.allclose(halves['pos0'] - whole['pos0'][of], (halves['pos'] - whole['pos'][of]) / U, atol=1e-14)
assert halves['halfSize'][:, axes].max() <= h / 2 and solver.clampedDomains == 0
bodies = [O.bodies[int(i)] for i in halves['id']]
assert all(b.groupMask == 5 and tuple(b.shape.color) == (0, 1, 0) and not b.bounded and b.state.blockedDOFs == 'xyzXYZ' for b in bodies)
O.run(3, wait=True)
print(json.dumps([len(whole['id']), len(halves['id']), halves['splits'].tolist()]))
''').result
	before, after, splits = result
	assert before == 4**dim and after == 2**halvings * before and set(splits) == {halvings}


def test_rings_are_shared_by_volume(yade):
	yade(stretched + ancestry + '''
grow = (2.5, 0, 0, 0, 3, 0, 0, 0, 2.5) # x / X is the stretch around the axis
def run(maxSplits):
	solver = block(grow, size=(1, 1, 2), low=(0, 0, -1), axisymmetric=True, boundaries=held[1:], maxSplits=maxSplits)
	O.step()
	return solver, mpm.arrays()
whole, (solver, halves) = run(0)[1], run(6)
of = np.searchsorted(whole['id'], roots(halves))
volume = np.array([halves['volume'][of == i].sum() for i in range(len(whole['id']))])
assert np.allclose(volume, whole['volume'], rtol=4e-16) and len(halves['id']) == 4 * len(whole['id'])
# a ring has 2 pi x times its section
assert np.allclose(halves['volume'], 2 * np.pi * halves['pos'][:, 0] * 4 * halves['halfSize'][:, 0] * halves['halfSize'][:, 1], rtol=1e-12)
assert np.allclose(halves['pos0'][:, 0] * 2.5, halves['pos'][:, 0], rtol=1e-13)
O.run(2, wait=True) # which looks at all rings
assert solver.converged and len(mpm.arrays()['id']) == len(halves['id'])
''')


def test_limits(yade):
	run = yade(stretched + '''
solver = block((2.5, 0, 0, 0, 2.5, 0, 0, 0, 1), boundaries=held, maxSplits=1) # along x, and then y
O.run(3, wait=True)
points = mpm.arrays()
assert len(points['id']) == 2 * 16 and set(points['splits']) == {1}
assert solver.clampedDomains == solver.report()['clampedDomains'] == 32
solver = block((1.9, 0, 0, 0, 1, 0, 0, 0, 1), boundaries=held, maxSplits=4) # none has outgrown
O.step()
assert len(mpm.arrays()['id']) == 16 and 'splits' not in mpm.arrays()
# a wall between the middles of the halves
solver = block((1, 0, 0, 0, 1, 0, 0, 0, 1), points=1, boundaries=held + [MpmBoundary(min=(h, -inf, -inf), max=(h, inf, inf), fix='x')], maxSplits=4)
for body in O.bodies:
	if body.state.pos[0] < h: O.bodies.erase(body.id) # the others are half a domain away from it
mpm.assign(defGrad=[np.diag((2.2, 1, 1))] * 2, elasticStrain=np.zeros((2, 3, 3)))
O.step()
assert len(mpm.arrays()['id']) == 2 and solver.clampedDomains == 2
# a wall off the lines of the grid there; beside it there is none
for face, number in (0.6, 1), (1.2, 2):
	wall = MpmBoundary(surface=MpmSurface(vertices=[(face, 0, 0), (face, 1, 0)], pieces=[(0, 1)]), fix='x')
	solver = block((1.9, 0, 0, 0, 0.9, 0, 0, 0, 1), points=1, size=(0.5, 0.5, 1), boundaries=[MpmBoundary(fix='xy', max=(0.3, inf, inf)), wall], maxSplits=4)
	O.bodies[0].state.pos = Vector3(0.5, 0.25, 0)
	O.step()
	assert len(mpm.arrays()['id']) == number and solver.clampedDomains == 2 - number, (face, len(mpm.arrays()['id']))
# a rigid body where the middle of a half would be; half a cell beside it there is none
for face, number in (0.9, 1), (1.2, 2):
	solver = block((1.9, 0, 0, 0, 0.9, 0, 0, 0, 1), points=1, size=(0.5, 0.5, 1), engine=MpmDynamicEngine, contacts=[MpmContact(friction=0)], maxSplits=4)
	O.bodies[0].state.pos = Vector3(0.75, 0.25, 0)
	O.bodies.append(utils.box((face + 0.5, 0.25, 0), (0.5, 1, 1), material=O.materials.append(FrictMat()), fixed=True))
	O.step()
	assert len(mpm.arrays()['id']) == number and solver.clampedDomains == 2 - number, (face, len(mpm.arrays()['id']))
solver.basis = 'mpm'
try: O.step()
except ValueError as error: message = str(error)
assert message.startswith('maxSplits = 4') and "basis='gimp'" in message, message
''')
	assert run.stderr.count('has outgrown half a cell again, after maxSplits = 1') == 1, run.stderr


def test_halves_enter_the_period(yade):
	yade(stretched + '''
solver = block((2.5, 0, 0, 0, 1, 0, 0, 0, 1), engine=MpmDynamicEngine, size=(0.5, 0.5, 1), period=(3, 0, 0), maxSplits=2)
for body in O.bodies: body.state.pos = body.state.pos + Vector3(2.95 - 0.9375, 0, 0) # the domain reaches beyond x = 3
before = mpm.arrays()
O.step()
points = mpm.arrays()
assert len(points['id']) == 2 * len(before['id']) == 8
assert np.allclose(np.unique(points['pos'][:, 0].round(9)), (0.10625, 2.16875, 2.48125, 2.79375)), points['pos'][:, 0]
moved = (points['pos'] - points['pos0'])[:, 0]
assert np.allclose(np.sort(moved), np.sort(np.concatenate([(before['pos'] - before['pos0'])[:, 0] + 0.6 * s * 0.15625 for s in (-1, 1)])))
O.run(2, wait=True)
''')


# A block pressed to a fifth between plates, with friction: it grows aside.
pressed = '''
import numpy as np
from yade import mpm, pack, utils
def press(maxSplits, friction=0.2):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0.45, density=1, label='rubber'))
	O.materials.append(FrictMat(label='rigid'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), grid, 2, 'rubber'))
	box = O.bodies[O.bodies.append(utils.box((5, 1.5, 0), (10, 0.5, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -0.8, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[MpmContact(friction=friction)], maxSplits=maxSplits, verbosity=0, label='solver')]
	O.dt = 1 / 60
	return O.engines[0]
inf = float('inf')
def state(): return dict(mpm.arrays(), force=O.engines[0].contacts[0].forces[0])
'''


def test_bits_do_not_depend_on_threads_or_on_saving(yade):
	"""Across several splits of points that touch a body with friction."""
	for threads in 1, 2:
		yade(pressed + f'''
solver = press(4)
O.run(40, wait=True)
n = len(mpm.arrays()['id'])
O.save('half.yade.gz')
O.run(8, wait=True)
assert 64 < n < len(mpm.arrays()['id']), (n, len(mpm.arrays()['id']))
np.savez('whole-{threads}.npz', **state())
''', threads=threads)
	yade(pressed + '''
O.load('half.yade.gz')
O.run(8, wait=True)
np.savez('continued.npz', **state())
''')
	one, two, continued = (np.load(yade.folder / f'{name}.npz') for name in ('whole-1', 'whole-2', 'continued'))
	for name in one:
		assert np.array_equal(one[name], two[name]) and np.array_equal(one[name], continued[name]), name


def test_contact_keeps_its_forces(yade):
	"""Remembered forces of contact points on the body add up to the force of the step, whatever points are split."""
	yade(pressed + '''
def forces():
	touching = mpm.contactForces()
	return len(touching[0]), touching[1].sum(axis=0)
split = 0
solver = press(4)
while O.iter < 48:
	before = len(mpm.arrays()['id'])
	O.step()
	number, sum_ = forces()
	if len(mpm.arrays()['id']) > before: split += 1
	assert np.allclose(-sum_, solver.contacts[0].forces[0], rtol=1e-12), (O.iter, sum_, solver.contacts[0].forces[0])
assert split > 0
''')


def test_a_step_that_fails_leaves_the_points_as_they_were(yade):
	yade(pressed + '''
solver = press(4)
while solver.clampedDomains == 0 and len(mpm.arrays()['id']) == 64: O.step()
before = state()
assert len(before['id']) > 64
solver.newton.maxIterations, solver.newton.minStep, O.bodies[64].state.vel = 2, 1, (0, -30, 0)
try: O.step()
except RuntimeError: pass
else: raise AssertionError
after = state()
assert all(np.array_equal(before[name], after[name]) for name in before)
''')


def test_files_name_parents(yade):
	yade(stretched + '''
block((2.5, 0, 0, 0, 1, 0, 0, 0, 1), boundaries=held, maxSplits=2)
O.engines = O.engines + [MpmVtkRecorder(fileName='split-', iterPeriod=1, recorders=['points'])]
O.run(2, wait=True)
''')
	texts = sorted(path.read_bytes() for path in yade.folder.glob('split-*.vtu'))
	assert any(b'"parent"' in text and b'"splits"' in text and b'NumberOfCells="32"' in text for text in texts)


def test_a_needle_is_not_split_into_soil_that_lies_elsewhere(yade):
	"""Its halves would be more than a cell away."""
	bodies = yade(stretched + '''
found = []
for stretch in 2.5, 9:
	solver = block((stretch, 0, 0, 0, 0.8, 0, 0, 0, 1), engine=MpmDynamicEngine, maxSplits=4)
	before = len(O.bodies)
	O.step()
	found.append([len(O.bodies) - before, solver.clampedDomains])
print(json.dumps(found))
''').result
	(halves, left), (none, kept) = bodies
	assert halves > 0 and left == 0 and none == 0 and kept > 0
