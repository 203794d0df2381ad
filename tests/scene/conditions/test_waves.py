# SPDX-License-Identifier: GPL-2.0-or-later
"""Edges that absorb waves, motion of the base, Rayleigh damping and histories, in the real YADE."""
import numpy as np
import pytest

scene = '''
from scenes import *
import numpy as np
import json

def ground(depth=12, engine=MpmDynamicEngine, gravity=(0, 0, 0), boundaries=(), **settings):
	"""Level ground, a cell high layers, free at y = depth, that repeats itself along x."""
	O.materials.append(MpmElasticMat(young=1e6, poisson=0.25, density=1000, label='soil'))
	grid = MpmGrid(cellSize=1, period=(3, 0, 0))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (3, depth, 1)), grid, pointsPerCell=2, material='soil'))
	O.engines = [engine(grid=grid, verbosity=0, gravity=gravity, boundaries=boundaries, **settings)]
	return O.engines[0]

cs = 400**0.5  # G = 4e5 Pa
cp = 3**0.5 * cs
base = dict(max=(inf, 0, inf))
pulse = lambda t: 1e-4 * np.exp(-((t - 1) / 0.4)**2)
history = [(t, float(pulse(t))) for t in np.linspace(0, 2, 401)]
'''


def test_the_surface_moves_with_twice_the_wave(yade):
	"""Sampled at points, with the work of the boundary as the only source of energy."""
	run = yade(scene + '''
results = []
for direction, c in ((1, 0, 0), cs), ((0, 1, 0), cp):
	O.reset()
	edge = MpmAbsorbingBoundary(motion=MpmBaseMotion(history=history, direction=direction), **base)
	solver = ground(absorbing=[edge])
	h = mpm.histories([(0.25, 11.75, 0)], record=['velocity'])
	O.dt = 0.5 / c
	O.run(int(3.2 / O.dt), wait=True)
	t, v = np.array(h.time), h['velocity'][:, 0] @ np.array(direction)
	expected = pulse(t - 11.75 / c) + pulse(t - 12.25 / c)
	data = solver.plotData()
	results.append([np.abs(v - expected).max() / 2e-4, data['boundaryWork'], data['kineticEnergy'] + data['elasticEnergy'], data["energyImbalance"], len(t)])
print(json.dumps(results))
''')
	for error, work, energy, imbalance, times in run.result:
		assert error < 0.01
		assert energy < 1e-7 and abs(imbalance) < 1e-7, 'of some 3e-4 J that went through'
		assert times > 30


def test_ground_at_rest_stays_there_when_its_base_is_let_go(yade):
	run = yade(scene + '''
held = MpmBoundary(fix='xy', **base)
solver = ground(4, engine=MpmImplicitEngine, gravity=(0, -1e-2, 0), boundaries=[held], newton=MpmNewton(tolerance=1e-12))
O.dt = 1
O.run(4, wait=True)
before = mpm.arrays()['pos']
edge = MpmAbsorbingBoundary(**base)
O.engines = [MpmDynamicEngine(grid=solver.grid, verbosity=0, gravity=(0, -1e-2, 0), absorbing=[edge], loadTime=O.time, newton=MpmNewton(tolerance=1e-12))]
O.dt = 0.02
O.run(20, wait=True)
print(json.dumps([edge.reaction[1] / (12 * 1000 * 1e-2), float(np.abs(mpm.arrays()['pos'] - before).max())]))
''')
	share, moved = run.result
	assert share == pytest.approx(1, abs=1e-9)
	assert moved < 1e-12


def test_a_saved_scene_goes_on_bit_for_bit(yade):
	"""Bits with all that is remembered: load of the edge, energies, the accelerations of a moving base."""
	go = '''
for kind in kinds:
	O.reset()
	%s
	O.run(10, wait=True)
	np.savez('%s-' + kind + '.npz', **mpm.arrays(), energy=O.engines[0].plotData()['energyImbalance'])
'''
	kinds = """
side = dict(motion=MpmBaseMotion(history=history, direction=(1, 0, 0)))
kinds = dict(
	edge=lambda: dict(absorbing=[MpmAbsorbingBoundary(**side, **base)], rayleigh=(0.1, 1e-3), scheme='generalised-alpha'),
	rigid=lambda: dict(boundaries=[MpmBoundary(fix='xy', **side, **base)], rayleigh=(0, 1e-3)))
"""
	yade(scene + kinds + go % ("ground(6, gravity=(0, -0.1, 0), **kinds[kind]()); O.dt = 0.05; O.run(10, wait=True); O.save(kind + '.xml.gz')", 'whole'))
	yade(scene + kinds + go % ("O.load(kind + '.xml.gz')", 'parts'))
	for kind in 'edge', 'rigid':
		whole, parts = np.load(yade.folder / f'whole-{kind}.npz'), np.load(yade.folder / f'parts-{kind}.npz')
		assert np.abs(whole['velocity'][:, 0]).max() > 1e-5
		for name in whole:
			assert np.array_equal(whole[name], parts[name], equal_nan=True), (kind, name)


def test_damping_takes_energy_and_it_balances(yade):
	"""Energies of ground that a moving base shakes, by its stiffness; and of a body that flies, by its mass."""
	run = yade(scene + '''
shaken = MpmBoundary(fix='xy', motion=MpmBaseMotion(history=history), **base)
solver = ground(6, boundaries=[shaken], rayleigh=(0, 0.05))
h = mpm.histories([(0.25, 0.25, 0), (0.25, 5.75, 0)], record=['displacement'])
O.dt = 0.02
O.run(400, wait=True)
result = [h['displacement_x'][-1].tolist(), float(sum(v for t, v in history) * 0.005), solver.plotData()]
O.reset()  # damping by mass
solver = ground(3, rayleigh=(0.7, 0))
mpm.assign(velocity=[(0, 1, 0)] * len(mpm.arrays()['id']))
O.dt = 0.01
O.run(50, wait=True)
assert abs(mpm.arrays()['velocity'][:, 1] / np.exp(-0.35) - 1).max() < 1e-4
data = solver.plotData()
assert abs(data['dampingWork'] / (4500 * (1 - np.exp(-0.7))) - 1) < 1e-4
print(json.dumps(result))
''')
	moved, total, data = run.result
	assert moved == pytest.approx([total, total], rel=0.02)
	assert data['dampingWork'] > 0.5 * data['boundaryWork'] > 0
	assert abs(data['energyImbalance']) < 0.01 * data['boundaryWork']


mistakes = {
        'a boundary inside of the body': ("absorbing=[MpmAbsorbingBoundary(min=(-inf, 3, -inf), max=(inf, 3, inf))]", 'on both sides'),
        'a boundary beside the body': ("absorbing=[MpmAbsorbingBoundary(max=(inf, -3, inf))]", 'no face'),
        'between the nodes': ("absorbing=[MpmAbsorbingBoundary(min=(-inf, .2, -inf), max=(inf, .3, inf))]", 'contains no grid node'),
        'swapped': ("absorbing=[MpmAbsorbingBoundary(min=(-inf, 1, -inf), max=(inf, 0, inf))]", 'swapped'),
        'a wave without history': ("absorbing=[MpmAbsorbingBoundary(motion=MpmBaseMotion(), **base)]", 'MpmBaseMotion.history'),
        'out of the plane': ("absorbing=[MpmAbsorbingBoundary(motion=MpmBaseMotion(history=history, direction=(0, 0, 1)), **base)]", 'no direction z'),
        'a free direction': ("boundaries=[MpmBoundary(fix='y', motion=MpmBaseMotion(history=history), **base)]", 'leaves free'),
        'two ways': ("boundaries=[MpmBoundary(fix='x', motion=MpmBaseMotion(history=history), **base), MpmBoundary(fix='xy', **base)]", 'only one moves'),
        'and a displacement': ("boundaries=[MpmBoundary(fix='x', displacement=(1, 0, 0), motion=MpmBaseMotion(history=history), **base)]", 'give one of them'),
        'without inertia': ("engine=MpmImplicitEngine, boundaries=[MpmBoundary(fix='x', motion=MpmBaseMotion(history=history), **base)]", 'MpmDynamicEngine'),
}


historyFile = '''
open('quake.txt', 'w').write('time velocity\\n# of a station\\n0, 0.1\\n0.5; 0.2\\n1 -0.3\\n')
assert mpm.readHistory('quake.txt') == [(0, 0.1), (0.5, 0.2), (1, -0.3)]
assert MpmBaseMotion(history=mpm.readHistory('quake.txt')).history[1] == (0.5, 0.2)
for text, expected in {'0 0\\n0 1\\n': 'line 2: time 0', '0 0\\n1 x\\n': 'line 2', 'x\\n': 'no line', '0 0\\n1 nan\\n': 'line 2', '0 1 2\\n1 1\\n2 y\\n': 'line 3'}.items():
	open('bad.txt', 'w').write(text)
	try:
		mpm.readHistory('bad.txt')
	except ValueError as error:
		assert expected in str(error), str(error)
	else:
		assert False, text
'''


def test_what_cannot_be_meant_is_refused_by_name(yade):
	"""Conditions, settings and files; a file that is right is read."""
	yade(scene + f'''
for name, (settings, expected) in {mistakes!r}.items():
	O.reset()
	try:
		solver = eval('ground(6, ' + settings + ')')
		O.dt = 0.01
		O.step()
	except (ValueError, RuntimeError) as error:
		assert expected in str(error), (name, str(error))
	else:
		assert False, name
for text in 'rayleigh=(-1, 0)', 'rayleigh=(0, nan)', 'rayleigh=1', 'absorbing=[MpmBoundary()]':
	O.reset()
	nan = float('nan')
	try:
		eval('ground(6, ' + text + ')')
	except (ValueError, TypeError) as error:
		assert 'MpmDynamicEngine.' + text.split('=')[0] in str(error), str(error)
	else:
		assert False, text
''' + historyFile)


def test_histories_are_arrays_tables_and_pictures(yade):
	yade(scene + '''
solver = ground(3, engine=MpmImplicitEngine, gravity=(0, -1, 0), boundaries=[MpmBoundary(fix='xy', **base)])
h = mpm.histories([0, 7], record=['displacement', 'stress', 'meanStress'], every=2, label='two')
O.dt = 0.25
O.run(4, wait=True)
assert h.ids.tolist() == [0, 7] and len(h.time) == 3 and h.time[0] == 0, h.time
points = mpm.arrays()
O.run(1, wait=True)
assert h['stress'].shape == (len(h.time), 2, 3, 3) and h['stress_yy'].shape == (len(h.time), 2)
assert (h['stress'][0] == 0).all() and h['stress_yy'][-1, 0] < 0
h.save('out/two.csv')
table = np.genfromtxt('out/two.csv', delimiter=',', names=True)
assert (table['stress_yy_7'] == h['stress_yy'][:, 1]).all() and (table['time'] == h.time).all()
assert h.plot('stress_yy', 'two.png').get_ylabel()
for call, expected in {
		"mpm.histories([0], label='two')": 'is taken', "mpm.histories([10**6])": 'no id', "mpm.histories([(0, 1)])": 'three finite numbers',
		"mpm.histories([0], record=['speed'])": 'not known', "mpm.histories('top')": 'must be ids', "mpm.histories([0], every=0)": '>= 1',
		"h['velocity']": 'not recorded', "h.plot('stress')": 'one component', "mpm.histories.loaded('none')": 'nothing'}.items():
	try:
		eval(call)
	except (ValueError, TypeError) as error:
		assert expected in str(error), (call, str(error))
	else:
		assert False, call
O.save('histories.xml.gz')
''')
	yade(scene + '''
O.load('histories.xml.gz')
O.run(4, wait=True)
h = mpm.histories.loaded('two')
assert len(h.time) >= 2 and h['stress'].shape[1:] == (2, 3, 3)
''')
