# SPDX-License-Identifier: GPL-2.0-or-later
"""Edges that move with the body, beyond which free ground is shaken."""
import numpy as np
import pytest

scene = '''
from scenes import *
import numpy as np
import json

cs = 200.  # of shear waves [m/s]
G, density, h = 2000 * cs**2, 2000., 2.

def pulse(t, length=0.6):
	"""A velocity [m/s] that comes back to rest, after a displacement of .4 m, 0.2 cells."""
	return np.where((t > 0) & (t < length), 0.4 / length * (1 - np.cos(2 * np.pi * t / length)), 0)

def body(corners, gravity=0., label=lambda x: 'soil', materials=None):
	"""In equilibrium with its weight, its sides and its base held."""
	O.materials.append(materials or [MpmElasticMat(young=2.5 * G, poisson=0.25, density=density, label='soil')])
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon(corners), grid, 2, label))
	right = max(x for x, y in corners)
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(right, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	settings = dict(grid=grid, gravity=(0, -gravity, 0), verbosity=0)
	if gravity:
		O.engines, O.dt = [MpmImplicitEngine(boundaries=held, newton=MpmNewton(tolerance=1e-11), **settings)], 0.5
		O.run(4, wait=True)
		O.resetTime()
		mpm.stages.resetDisplacements()
	O.dt = 0.02
	return settings

def level(width=8, height=6, **settings):
	return body([(0, 0), (width * h, 0), (width * h, height * h), (0, height * h)], **settings)

def refused(call, expected):
	try:
		call()
	except (ValueError, TypeError, RuntimeError) as error:
		assert expected in str(error), (expected, str(error))
	else:
		assert False, 'not refused: ' + expected
'''


def test_level_ground_stays_one_dimensional(yade):
	"""Ground with weight, carried 0.2 cells through the grid for 20 s: rows of points move alike, as in the column beside it, and the surface with twice the wave."""
	run = yade(scene + '''
settings = level(6, 4, gravity=9.81)
history = [(t, float(v)) for t, v in zip(np.arange(0, 18, 0.02), pulse(np.arange(0, 18, 0.02) % 3 - 0.5) * np.where(np.arange(0, 18, 0.02) % 6 < 3, 1, -1) / 2)]
solver = MpmDynamicEngine(scheme='generalised-alpha', **settings)
O.engines = [solver]
points = mpm.arrays()
solver.loads = mpm.freeField(solver, until=20, motion=MpmBaseMotion(history=history))
assert len(O.bodies) == len(points['id']) and O.engines == [solver] and solver.loadTime == 0
held = mpm.histories(points['id'], record=['velocity', 'displacement'])
O.run(1000, wait=True)
rows = np.unique(np.round(points['pos'][:, 1], 3), return_inverse=True)[1]
v = held['velocity']
mean = np.array([v[:, rows == r].mean(axis=1) for r in range(rows.max() + 1)])
time = np.array(held.time)
wave = np.interp(time - 8 / cs, *np.transpose(history), 0, 0)
free = np.reshape(solver.loads[0].velocities, (1001, -1, 2))[:, 0, 0]
print(json.dumps([float(np.abs(v).max()), float(np.abs(v - mean[rows].transpose(1, 0, 2)).max()), float(np.abs(held['displacement'][:, :, 0]).max() / h), float(np.abs(mean[-1, :, 0] - 2 * wave).max() / np.abs(2 * wave).max()),
	float(np.abs(mean[-1, :, 0] - free).max()), float(np.abs(held['displacement'][-1]).max()), solver.loads[2].reaction[1] / (12 * 8 * density * 9.81)]))
''')
	peak, spread, way, ofOutcrop, ofColumn, left, carried = run.result
	assert way > 0.15, 'cells that soil has crossed'
	assert spread < 0.01 * peak and ofColumn < 0.01 * peak
	assert ofOutcrop < 0.02, 'of the largest velocity; some of it is dispersion'
	assert left < 1e-3 and carried > 0.8


def test_a_static_stage_hands_over_what_has_held(yade):
	"""A slope between two levels: at rest it stays there, and forces on its edges are its weight and what leans on its sides."""
	run = yade(scene + '''
settings = body([(0, 0), (16, 0), (16, 6), (12, 6), (6, 12), (0, 12)], gravity=9.81)
solver = MpmDynamicEngine(newton=MpmNewton(tolerance=1e-10), **settings)
O.engines = [solver]
solver.loads = mpm.freeField(solver, until=1, motion=MpmBaseMotion(history=[(0, 0), (1, 0)]))
start = mpm.arrays()
O.run(50, wait=True)
end = mpm.arrays()
left, right, base = (np.array(edge.reaction) for edge in solver.loads)
weight = float((start['volume'] * density * 9.81).sum() * np.linalg.det(start['defGrad'])[0] ** -1)
print(json.dumps([float(np.abs(end['pos'] - start['pos']).max()), (left + right + base).tolist(), float(sum(b.state.mass for b in O.bodies) * 9.81), left.tolist()]))
''')
	moved, sum_, weight, left = run.result
	assert moved < 1e-6, 'm'
	assert sum_[1] == pytest.approx(weight, rel=1e-6) and abs(sum_[0]) < 1e-6 * weight
	assert left[0] > 0.02 * weight


def test_waves_leave_at_right_angles_and_obliquely(yade):
	"""Plane packets on a grid that repeats itself along x: what is left of their energy."""
	run = yade(scene + '''
def left(angle, isPressure, cells=8):
	"""Over the first one; half of the packet goes to each edge."""
	O.reset()
	c = cs * (3**0.5 if isPressure else 1)
	O.materials.append(MpmElasticMat(young=2.5 * G, poisson=0.25, density=density, label='soil'))
	width = round(cells / np.sin(angle)) if angle else 3
	k = 2 * np.pi / (width * np.sin(angle) if angle else cells)
	height = 8 * cells
	grid = MpmGrid(cellSize=1, period=(width, 0, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (width, 0), (width, height), (0, height)]), grid, 2, 'soil'))
	x, y, _ = mpm.arrays()['pos'].T
	way = np.array([np.sin(angle), -np.cos(angle), 0])
	along = way if isPressure else np.array([way[1], -way[0], 0])
	y = y - height / 2
	mpm.assign(velocity=(1e-4 * np.cos(k * (np.sin(angle) * x - np.cos(angle) * y)) * np.exp(-(y / cells)**2))[:, None] * along)
	edges = [MpmFreeField(surface=[(0, 0), (width, 0)]), MpmFreeField(surface=[(width, height), (0, height)])]
	solver = MpmDynamicEngine(grid=grid, verbosity=0, loads=edges)
	O.engines, O.dt = [solver], 1 / c
	energy = lambda: solver.plotData()['kineticEnergy'] + solver.plotData()['elasticEnergy']
	first = energy()
	O.run(int(7 * cells / np.cos(angle)), wait=True)
	assert abs(solver.plotData()['energyImbalance']) < 1e-6 * first
	return energy() / first

print(json.dumps([[left(np.radians(angle), isPressure) for isPressure in (False, True)] for angle in (0, 45)]))
''')
	normal, oblique = run.result
	assert max(normal) < 3e-3 and max(oblique) < 0.05, run.result


def test_a_rigid_base_and_a_saved_scene(yade):
	"""Level ground on a base that moves it is a column; a scene saved on the way goes on bit for bit."""
	go = '''
O.run(30, wait=True)
np.savez('%s.npz', energy=O.engines[0].plotData()['energyImbalance'], **mpm.arrays())
'''
	yade(scene + '''
settings = level(5, 4)
history = [(t, float(v)) for t, v in zip(np.arange(0, 1, 0.02), pulse(np.arange(0, 1, 0.02)))]
solver = MpmDynamicEngine(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy', motion=MpmBaseMotion(history=history))], rayleigh=(0, 1e-3), **settings)
O.engines = [solver]
solver.loads = mpm.freeField(solver, until=1.2)
assert len(solver.loads) == 2
assert any(text.startswith('loads[1].velocities: 5, 50 and 95 %') and 'damps by itself' in text for text in mpm.advise()['advice'])
O.run(30, wait=True)
O.save('free.xml.gz')
''' + go % 'whole' + '''
points = mpm.arrays()
rows = np.unique(np.round(points['pos'][:, 1], 2), return_inverse=True)[1]
v = points['velocity'][:, 0]
assert max(np.ptp(v[rows == r]) for r in range(rows.max() + 1)) < 0.01 * np.abs(v).max()
refused(lambda: O.step(), 'known until t = 1.2')
''')
	yade(scene + "O.load('free.xml.gz')" + go % 'parts')
	whole, parts = np.load(yade.folder / 'whole.npz'), np.load(yade.folder / 'parts.npz')
	assert np.abs(whole['velocity'][:, 0]).max() > 0.01
	for name in whole:
		assert np.array_equal(whole[name], parts[name], equal_nan=True), name


def test_of_two_edges_with_a_node_one_bears_it(yade):
	"""A block at rest whose held sides and base become absorbing edges: their corner nodes are held once."""
	run = yade(scene + '''
settings = level(4, 3, gravity=9.81)
edges = [MpmAbsorbingBoundary(max=(0, inf, inf)), MpmAbsorbingBoundary(min=(8, -inf, -inf)), MpmAbsorbingBoundary(max=(inf, 0, inf))]
solver = MpmDynamicEngine(absorbing=edges, newton=MpmNewton(tolerance=1e-10), **settings)
O.engines = [solver]
start = mpm.arrays()['pos']
O.run(25, wait=True)
print(json.dumps([float(np.abs(mpm.arrays()['pos'] - start).max()), sum(edge.reaction[1] for edge in edges) / (sum(b.state.mass for b in O.bodies) * 9.81)]))
''')
	moved, carried = run.result
	assert moved < 1e-6 and carried == pytest.approx(1, rel=1e-6)


def test_what_cannot_have_free_ground_is_refused_by_name(yade):
	yade(scene + '''
settings = level(4, 3)
wave = MpmBaseMotion(history=[(0, 0), (1, 0)])
engine = lambda **others: MpmDynamicEngine(**{**settings, **others})
for call, expected in {
		"mpm.freeField(MpmImplicitEngine(), 1)": 'MpmDynamicEngine', "mpm.freeField(engine(), '1')": 'until', "mpm.freeField(engine(), 0)": 'after now', "mpm.freeField(engine(), 1, 3)": 'motion = 3',
		"mpm.freeField(engine(), 1, sides='top')": "sides = 'top'", "mpm.freeField(engine(), 1, distance=0)": 'distance', "mpm.freeField(engine(scheme='explicit'), 1)": "'explicit'",
		"mpm.freeField(engine(grid=MpmGrid(cellSize=h, period=(8, 0, 0))), 1)": 'period', "mpm.freeField(engine(boundaries=[MpmBoundary(max=(0, inf, inf), fix='x')]), 1, wave)": 'boundaries[0]',
		"mpm.freeField(engine(boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')]), 1, wave)": 'base', "mpm.freeField(engine(grid=MpmGrid(cellSize=h, origin=(.7, 0, 0))), 1, wave)": 'line of the grid'}.items():
	refused(lambda: eval(call), expected)
line = lambda: [(0, 6), (0, 0)]
for setting, expected in {
		"times=[0, 1]": 'velocities has 0 numbers', "motion=wave, times=[0], velocities=[0.] * 4, displacements=[0.] * 4, forces=[0.] * 4": 'one of them', "distance=0": 'distance',
		"surface=[(-3, 6), (-3, 0)]": 'edge of the body', "times=[1, 2], velocities=[0.] * 8, displacements=[0.] * 8, forces=[0.] * 8": 'the first of its times'}.items():
	def step():
		O.engines = [engine(loads=[eval('MpmFreeField(**{**dict(surface=line()), **dict(' + setting + ')})')])]
		O.step()
	refused(step, expected)
for kind, expected in (MpmImplicitEngine, 'MpmBoundary there'), (lambda **s: MpmDynamicEngine(scheme='explicit', **s), "scheme='explicit'"):
	O.engines = [kind(loads=[MpmFreeField(surface=line())], **settings)]
	refused(O.step, expected)
O.switchScene()
O.bodies.append(utils.sphere((0, 0, 0), 1))
O.switchScene()
refused(lambda: mpm.freeField(engine(), 1, wave), 'O.switchScene')

O.reset()
O.materials.append(MpmElasticMat(young=1e6, poisson=.25, density=density, label='soil'))
inSpace = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (h, h, h)), inSpace, 2, 'soil'))
O.dt = .02
refused(lambda: mpm.freeField(MpmDynamicEngine(grid=inSpace), 1), 'plane strain only')
O.engines = [MpmDynamicEngine(grid=inSpace, loads=[MpmFreeField(surface=line())])]
refused(O.step, 'of plane strain: on a grid with dim=3 take MpmAbsorbingBoundary')
''')


def test_sides_that_are_the_same_nodes_are_tied(yade):
	"""An embankment between level ground of the same layers, by one argument of the grid: far from it the ground moves as a column, and what goes out on one side comes in on the other."""
	run = yade(scene + '''
O.materials.append(MpmElasticMat(young=2.5 * G, poisson=0.25, density=density, label='soil'))
def shaken(width, corners):
	for body in list(O.bodies): O.bodies.erase(body.id)
	O.resetTime()
	grid = MpmGrid(cellSize=h, period=(width, 0, 0))
	O.bodies.append(mpm.fill(mpm.polygon(corners), grid, 2, 'soil'))
	history = [(t, float(v)) for t, v in zip(np.arange(0, 1, 0.02), pulse(np.arange(0, 1, 0.02)) / 2)]
	O.engines, O.dt = [MpmDynamicEngine(grid=grid, verbosity=0, absorbing=[MpmAbsorbingBoundary(max=(inf, 0, inf), motion=MpmBaseMotion(history=history))])], 0.02
	held = mpm.histories([(0.5, 5.5, 0), (width - 0.5, 5.5, 0)], record=['velocity'])
	O.run(40, wait=True)
	return held['velocity'][:, :, 0]
column = shaken(6, [(0, 0), (6, 0), (6, 6), (0, 6)])
found = shaken(48, [(0, 0), (48, 0), (48, 6), (28, 6), (26, 8), (22, 8), (20, 6), (0, 6)])
print(json.dumps([float(np.abs(one - other).max() / np.abs(column).max()) for one, other in ((column[:, 0], column[:, 1]), (found[:, 0], found[:, 1]), (found[:, 0], column[:, 0]))]))
''')
	ofColumn, ofSides, apart = run.result
	assert ofColumn < 1e-7 and ofSides < 0.01 and apart < 0.1, run.result
