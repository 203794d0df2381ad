# SPDX-License-Identifier: GPL-2.0-or-later
"""A body of points in contact with itself that folds: its sides meet as two bodies do, part again, and stay one body at the tip of the fold."""
import numpy as np
import pytest

scene = '''
import json
import numpy as np
from math import inf
from yade import mpm, pack

def fill(points, grid, name, depth=0.2, young=1e5, k=0):
	if not O.materials: O.materials.append(MpmElasticMat(young=young, poisson=0.3, density=1000, conductivity=k, porosity=0.4, label='m'))
	region = mpm.polygon(points)
	if grid.dim == 3: region = region & pack.inAlignedBox((*np.min(points, axis=0), 0), (*np.max(points, axis=0), depth))
	return O.bodies.append(mpm.fill(region, grid, 2, 'm', body=name))

def legs(names, dim, steps, k=0, cells={}, **more):
	"""Two legs on a base that is held, thrown at each other: of one body or of two."""
	O.reset()
	grid = MpmGrid(cellSize=0.1, dim=dim, **cells)
	if names[0] == names[1]: fill([(0, 0), (0.8, 0), (0.8, 1.1), (0.5, 1.1), (0.5, 0.2), (0.3, 0.2), (0.3, 1.1), (0, 1.1)], grid, names[0], k=k)
	else: fill([(0.5, 0), (0.8, 0), (0.8, 1.1), (0.5, 1.1)], grid, names[0], k=k), fill([(0, 0), (0.3, 0), (0.3, 1.1), (0, 1.1)], grid, names[1], k=k)
	contact = MpmBodyContact(between=names, friction=0.2, folds=names[0] == names[1])
	solver = MpmDynamicEngine(grid=grid, contacts=[contact], boundaries=[MpmBoundary(max=(inf, 0.2, inf), fix='xyz'[:dim])], newton=MpmNewton(tolerance=1e-10), verbosity=0, **more)
	ids, begin, velocity = mpm.arrays()['id'], mpm.arrays()['pos'], np.zeros((len(O.bodies), 3))
	left, top = begin[:, 0] < 0.4, begin[:, 1] > 0.9
	velocity[:, 0] = np.where(left, 1.5, -1.5) * np.clip((begin[:, 1] - 0.2) / 0.9, 0, 1)
	mpm.assign(velocity=velocity)
	O.engines, O.dt, track = [solver], 0.01, []
	for _ in range(steps):
		O.step()
		moved = np.array([O.bodies[int(i)].state.pos[0] for i in ids]) - begin[:, 0]
		track.append([moved[left & top].mean(), moved[~left & top].mean(), abs(contact.force[0]), contact.touching])
	return track, list(contact.pairs)
'''


@pytest.mark.parametrize('dim, steps, share', [(2, 40, 0.01), (3, 17, 0.02)])
def test_legs_of_one_body_meet_as_two_bodies(yade, dim, steps, share):
	"""They press on each other with the same force, and come apart again."""
	one, two = yade(scene + f'print(json.dumps([legs(names, {dim}, {steps}) for names in (("soil", "soil"), ("right", "left"))]))').result
	(one, pairs), (two, _) = [(np.array(track), pairs) for track, pairs in (one, two)]
	left, right, force, touching = one.T
	assert abs(one[:, :2] - two[:, :2]).max() < share * abs(two[:, :2]).max()
	assert force.max() > (500 if dim == 3 else 2500) and abs(force.max() / two[:, 2].max() - 1) < share
	assert force[-1] == 0 and touching[-1] == 0 and left[-1] < left.max() - 0.02 and not pairs


def test_a_free_body_folds_and_opens(yade):
	"""The legs of a free U, oblique to the grid by its points: momentum is kept to 1e-12, no energy is won, nothing pulls after they have parted, and a restart in touch goes on as they do."""
	track, change = yade(scene + '''
def free():
	O.reset()
	grid = MpmGrid(cellSize=0.1)
	fill([(0.03, 0), (0.93, 0), (0.93, 1.5), (0.63, 1.5), (0.63, 0.3), (0.33, 0.3), (0.33, 1.5), (0.03, 1.5)], grid, 'soil')
	contact = MpmBodyContact(between=('soil', 'soil'), friction=0.2, folds=True)
	O.engines, O.dt = [MpmDynamicEngine(grid=grid, contacts=[contact], newton=MpmNewton(tolerance=1e-10), verbosity=0, label='solver')], 0.01
	begin, velocity = mpm.arrays()['pos'], np.zeros((len(O.bodies), 3))
	velocity[:, 0] = np.where(begin[:, 0] < 0.48, 1.5, -1.5) * np.clip((begin[:, 1] - 0.3) / 1.2, 0, 1)
	mpm.assign(velocity=velocity)
	return begin

def step(begin):
	O.step()
	solver, contact = O.engines[0], O.engines[0].contacts[0]
	points, data = mpm.arrays(), solver.plotData()
	left, top = begin[:, 0] < 0.48, begin[:, 1] > 1.2
	gap = points['pos'][~left & top, 0].min() - points['pos'][left & top, 0].max()
	return [gap, abs(contact.force[0]), contact.touching, abs(data['momentum_x']), abs(data['momentum_y']), data['kineticEnergy'] + data['elasticEnergy']]

begin = free()
track = [step(begin) for _ in range(55)]
whole = mpm.arrays()['pos']
free()
O.run(13, wait=True)
assert O.engines[0].contacts[0].touching > 5
O.save('folded.yade')
O.load('folded.yade')
O.run(42, wait=True)
print(json.dumps([track, abs(mpm.arrays()['pos'] - whole).max()]))
''').result
	gap, force, touching, along, across, energy = np.array(track).T
	assert max(along.max(), across.max()) < 1e-12 * 1000 * 0.99 * 1.5 / 4
	assert np.diff(energy).max() < 1e-3 * energy[0] and touching.max() > 20
	assert gap.min() < 0.045 and gap[-1] > 0.15 and force[-15:].max() == 0 and touching[-15:].max() == 0
	assert change < 1e-9


@pytest.mark.parametrize('names, tip, force', [(('soil', 'soil'), -0.097, 566), (('low', 'high'), -0.097, 566), (None, -0.009, 0)])
def test_a_slab_sags_on_the_slab_below(yade, names, tip, force):
	"""In steps without inertia, as one body that is folded and as two; without a contact it sticks to what is a cell below."""
	sag, pressed = yade(scene + f'''
names = {names}
grid = MpmGrid(cellSize=0.1)
if names and names[0] != names[1]: fill([(0, 0), (1.6, 0), (1.6, 0.3), (0, 0.3)], grid, names[0], young=6e6), fill([(0, 0.4), (1.6, 0.4), (1.6, 0.6), (0, 0.6)], grid, names[1])
else: fill([(0, 0), (1.6, 0), (1.6, 0.3), (0.2, 0.3), (0.2, 0.4), (1.6, 0.4), (1.6, 0.6), (0, 0.6)], grid, 'soil', young=6e6)
contacts = [MpmBodyContact(between=names, friction=0.2, folds=names[0] == names[1])] if names else []
O.engines, O.dt = [MpmImplicitEngine(grid=grid, contacts=contacts, boundaries=[MpmBoundary(max=(inf, 0.1, inf), fix='xy'), MpmBoundary(max=(0.2, inf, inf), fix='xy')], gravity=(0, -9.81, 0), loadCurve=[(0, 0), (1, 1)], newton=MpmNewton(tolerance=1e-9), verbosity=0)], 1 / 40
begin = mpm.arrays()['pos']
top = (begin[:, 0] > 1.5) & (begin[:, 1] > 0.4)
O.run(40, wait=True)
print(json.dumps([(mpm.arrays()['pos'] - begin)[top, 1].mean(), sum(abs(contact.force[1]) for contact in contacts)]))
''').result
	assert abs(sag / tip - 1) < 0.03 and abs(pressed - force) < 0.02 * 566


def test_legs_meet_on_cells_of_two_sizes(yade):
	"""As two bodies do, where the upper half of both has cells of half the size, and where one leg has."""
	runs = yade(scene + '''
halved = [dict(min=(0, 0.6, -inf), max=(0.8, 1.2, inf)), dict(min=(0, 0, -inf), max=(0.3, 1.2, inf))]
print(json.dumps([[legs(names, 2, 24, cells=dict(refinements=[MpmRefinement(**box)]))[0] for names in (("soil", "soil"), ("right", "left"))] for box in halved]))
''').result
	for one, two in np.array(runs):
		assert abs(one[:, :2] - two[:, :2]).max() < 0.02 * abs(two[:, :2]).max()
		assert one[:, 2].max() > 3000 and abs(one[:, 2].max() / two[:, 2].max() - 1) < 0.015 and one[-1, 3] == 0


def test_folds_of_soil_in_which_water_flows(yade):
	"""A slab that sags on the slab below, in load steps and on cells of two sizes, and legs that meet in time: motion and force as of two bodies, 2 %, and pressures within 10 %; water passes around the tip of the fold."""
	sags, thrown = yade(scene + '''
def sag(names, steps=24):
	O.reset()
	grid = MpmGrid(cellSize=0.1, refinements=[MpmRefinement(min=(0.2, 0.2, -inf), max=(1.7, 0.5, inf))])
	if names[0] != names[1]: fill([(0, 0), (1.6, 0), (1.6, 0.3), (0, 0.3)], grid, names[0], young=6e6, k=1e-6), fill([(0, 0.4), (1.6, 0.4), (1.6, 0.6), (0, 0.6)], grid, names[1], k=1e-6)
	else: fill([(0, 0), (1.6, 0), (1.6, 0.3), (0.2, 0.3), (0.2, 0.4), (1.6, 0.4), (1.6, 0.6), (0, 0.6)], grid, 'soil', young=6e6, k=1e-6)
	contact = MpmBodyContact(between=names, friction=0.2, folds=names[0] == names[1])
	flow = MpmFlow(unitWeight=1e4, bulkModulus=2e8, drains=[MpmDrain(surface=[(0, 0), (1.6, 0)], pressure=0)])
	held = [MpmBoundary(max=(inf, 0.1, inf), fix='xy'), MpmBoundary(max=(0.2, inf, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, contacts=[contact], boundaries=held, gravity=(0, -9.81, 0), gravityCurve=[(0, 0), (40, 1)], newton=MpmNewton(tolerance=1e-9), flow=flow, verbosity=0)]
	O.dt, ids, begin = 40 / steps, mpm.arrays()['id'], mpm.arrays()['pos']
	top, low = (begin[:, 0] > 1.5) & (begin[:, 1] > 0.4), (begin[:, 0] > 1) & (begin[:, 1] < 0.3)
	O.run(steps, wait=True)
	states = [O.bodies[int(i)].state for i in ids]
	pressure = np.array([state.excessPressure for state in states])
	return [np.mean([state.pos[1] for state in np.array(states)[top]]) - begin[top, 1].mean(), abs(contact.force[1]), pressure[top].mean(), pressure[low].mean()]

water = lambda: MpmFlow(unitWeight=1e4, bulkModulus=2e6)
print(json.dumps([[sag(names) for names in (('soil', 'soil'), ('low', 'high'))], [legs(names, 2, 24, k=1e-4, flow=water())[0] for names in (('soil', 'soil'), ('right', 'left'))]]))
''').result
	one, two = np.array(sags)
	assert (abs(one / two - 1) < [0.01, 0.02, 0.1, 0.1]).all() and one[1] > 400 and one[2] > 1000, sags
	one, two = np.array(thrown)
	assert abs(one[:, :2] - two[:, :2]).max() < 0.02 * abs(two[:, :2]).max()
	assert one[:, 2].max() > 3000 and abs(one[:, 2].max() / two[:, 2].max() - 1) < 0.01 and one[-1, 3] == 0


def test_what_does_not_fold_is_refused(yade):
	"""Contact of two bodies, and explicit steps."""
	said = yade(scene + '''
def refused(names, engine):
	O.reset()
	grid = MpmGrid(cellSize=0.2)
	for name in dict.fromkeys(names): fill([(0, 0), (0.4, 0), (0.4, 0.4), (0, 0.4)], grid, name)
	O.engines, O.dt = [engine(grid=grid, contacts=[MpmBodyContact(between=names, friction=0.2, folds=True)], verbosity=0)], 1e-4
	try: O.step()
	except (RuntimeError, ValueError) as error: return str(error)
print(json.dumps([refused(('a', 'b'), MpmDynamicEngine), refused(('a', 'a'), lambda **more: MpmDynamicEngine(scheme='explicit', **more))]))
''').result
	assert 'name one body twice' in said[0] and 'explicit steps' in said[1], said
