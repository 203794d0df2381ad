# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact of a body of points with itself, by the parts that it falls into; and bodies that begin to stick."""
import numpy as np

scene = '''
import json
import numpy as np
from yade import mpm, pack

def material(label, young=1e6, poisson=0., density=1000):
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=density, label=label))

def box(low, high): return pack.inAlignedBox((*low, -1), (*high, 1))

def fly(solver, contact, left, speed, steps):
	"""The worst momentum over the first one, mean velocities, and what touches in each step."""
	mpm.assign(velocity=speed * np.outer(left, [1, 0, 0]))
	first, worst, track = 1000 * mpm.arrays()['volume'][left].sum() * speed, 0, []
	for step in range(steps):
		O.step()
		data, v = solver.plotData(), mpm.arrays()['velocity'][:, 0]
		worst = max(worst, abs(data['momentum_x'] / first - 1), abs(data['momentum_y']) / first)
		track.append([v[left].mean() / speed, v[~left].mean() / speed, contact.touching, contact.force[0], (data['kineticEnergy'] + data['elasticEnergy']) / (first * speed / 2)])
	return worst, track
'''


def test_two_lumps_of_one_body_collide_and_part(yade):
	"""As two bodies with names do, to the last digit: momentum is kept to 1e-12, no energy is won, and nothing pulls after they have parted."""
	one, two = yade(scene + '''
def lumps(names):
	O.reset()
	material('m')
	grid = MpmGrid(cellSize=0.1)
	O.bodies.append(mpm.fill(box((0, 0), (0.5, 0.5)), grid, 2, 'm', body=names[0]))
	O.bodies.append(mpm.fill(box((0.55, 0.1), (1.05, 0.6)), grid, 2, 'm', body=names[1]))
	contact = MpmBodyContact(between=names, friction=0.3)
	solver = MpmDynamicEngine(grid=grid, contacts=[contact], newton=MpmNewton(tolerance=1e-10), verbosity=0)
	O.engines, O.dt = [solver], 0.01
	worst, track = fly(solver, contact, mpm.arrays()['pos'][:, 0] < 0.52, 0.5, 40)
	return worst, track, [[body.name, body.partOf] for body in grid.bodies], list(contact.pairs)

print(json.dumps([lumps(('soil', 'soil')), lumps(('a', 'b'))]))
''').result
	assert one[2] == [['soil', ''], ['soil 2', 'soil']] and two[2] == [['a', ''], ['b', '']]
	assert one[1] == two[1] and not one[3] and not two[3]
	assert one[0] < 1e-12
	left, right, touching, force, energy = np.array(one[1]).T
	assert touching.max() > 5 and touching[-10:].max() == 0 and force[-10:].any() == 0 and energy.max() < 1 + 1e-6
	assert left[-1] < 0.2 < 0.8 < right[-1] and np.ptp(right[-10:]) < 1e-9


def test_a_body_that_is_torn_has_new_surfaces(yade):
	"""Two lumps whose neck is removed: surfaces are drawn around them, in the plane and in 3D, and they collide and part with momentum kept to 1e-12; a restart goes on as they do."""
	runs, change = yade(scene + '''
def torn(dim, steps):
	O.reset()
	material('m')
	grid = MpmGrid(cellSize=0.1, dim=dim)
	depth = (0, 0.2) if dim == 3 else (-1, 1)
	region = mpm.polygon([(0, 0), (0.4, 0), (0.4, 0.1), (0.7, 0.1), (0.7, 0), (1.1, 0), (1.1, 0.4), (0.7, 0.4), (0.7, 0.3), (0.4, 0.3), (0.4, 0.4), (0, 0.4)]) if dim == 2 else pack.inAlignedBox((0, 0, 0), (1.1, 0.3, 0.2))
	O.bodies.append(mpm.fill(region, grid, 2, 'm', body='soil'))
	contact = MpmBodyContact(between=('soil', 'soil'), friction=0.3)
	solver = MpmDynamicEngine(grid=grid, contacts=[contact], newton=MpmNewton(tolerance=1e-10), verbosity=0, label='solver')
	O.engines, O.dt = [solver], 0.02
	O.step()
	assert len(grid.bodies) == 1
	points = mpm.arrays()
	for i in points['id'][(points['pos'][:, 0] > 0.4) & (points['pos'][:, 0] < 0.7)]: O.bodies.erase(int(i))
	worst, track = fly(solver, contact, mpm.arrays()['pos'][:, 0] < 0.5, 0.5, steps)
	return worst, track, [[body.name, len(body.pieces)] for body in grid.bodies]

runs = [torn(3, 38), torn(2, 40)]
whole = mpm.arrays()['velocity'][:, 0].tolist()
torn(2, 29)
O.save('torn.yade')
O.load('torn.yade')
O.run(11, wait=True)
print(json.dumps([runs, abs(mpm.arrays()['velocity'][:, 0] - whole).max()]))
''').result
	for worst, track, bodies in runs:
		assert [name for name, _ in bodies] == ['soil', 'soil 2'] and min(count for _, count in bodies) > 20
		left, right, touching, force, energy = np.array(track).T
		assert worst < 1e-12 and energy.max() < 1 + 1e-6
		assert touching.max() > 5 and touching[-1] == 0 and left[-1] < 0.25 < 0.75 < right[-1]
	assert change < 1e-12


def test_a_slide_closes_on_a_berm_of_the_same_body(yade):
	"""The slide stops at a berm that a wall holds, as one with a name of its own does, to the last digit, if the same points touch first (a matter of round-off, by compilers):
	nothing pulls, and ground and wall bear the weight along the slope."""
	one, two, weight = yade(scene + '''
from math import radians, sin, cos, inf
def slide(names):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=5e6, poisson=0.3, cohesion=2e4, frictionAngle=radians(30), dilationAngle=0, density=1800, label='soil'))
	material('rock', 2e8, 0.2, 2400)
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (6.5, 0), (6.5, 2), (6, 2), (6, 0.5), (0, 0.5)]), grid, 2, 'rock', body='ground'))
	O.bodies.append(mpm.fill(box((1, 0.5), (3, 1.5)), grid, 2, 'soil', body=names[0]))
	O.bodies.append(mpm.fill(mpm.polygon([(4.5, 0.5), (6, 0.5), (6, 1.75), (5, 1.25)]), grid, 2, 'soil', body=names[1]))
	others = [MpmBodyContact(between=(name, 'ground'), friction=radians(15)) for name in dict.fromkeys(names)]
	contact, slope = MpmBodyContact(between=names, friction=radians(30)), radians(30)
	solver = MpmDynamicEngine(grid=grid, scheme='generalised-alpha', rhoInfinity=0.5, gravity=(9.81 * sin(slope), -9.81 * cos(slope), 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy', body='ground')],
		contacts=[*others, contact], newton=MpmNewton(tolerance=1e-8), verbosity=0)
	O.engines, O.dt, track = [solver], 0.02, []
	isSlide = (mpm.arrays()['pos'][:, 0] < 3) & (mpm.arrays()['pos'][:, 1] > 0.5)
	for step in range(150):
		O.step()
		track.append([mpm.arrays()['velocity'][isSlide, 0].mean(), contact.force[0], sum(other.force[0] for other in others)])
	return track
print(json.dumps([slide(('soil', 'soil')), slide(('slide', 'berm')), 1800 * 9.81 * sin(radians(30)) * (2 + 1.3125)]))
''').result
	speed, force, borne = np.array(one).T
	meeting = np.flatnonzero(force)[0]
	alike = [np.allclose(one[:end], two[:end], rtol=1e-6, atol=1e-3 * weight) for end in (meeting, meeting + 1, len(one))]
	assert 10 < meeting < 100 and alike[0] and alike[1] == alike[2], alike
	assert np.allclose(speed, np.array(two)[:, 0], atol=0.1 * speed.max())
	assert speed.max() > 1.5 and abs(speed[-30:]).max() < 0.1 and force.max() < 1e-6 * weight
	assert force[-30:].mean() < 0 and abs(borne[-30:].mean() / -weight - 1) < 0.05


def test_bodies_that_begin_to_stick_are_named_once(yade):
	"""Where two bodies, or one and points without a name, come to share cells without a contact; not where they were filled side by side."""
	said = yade(scene + '''
def fly(first, gap, speed=0.5):
	O.reset()
	material('m')
	grid = MpmGrid(cellSize=0.1)
	O.bodies.append(mpm.fill(box((0, 0), (0.5, 0.5)), grid, 2, 'm', body=first))
	O.bodies.append(mpm.fill(box((0.5 + gap, 0.1), (1 + gap, 0.6)), grid, 2, 'm', body='b'))
	mpm.assign(velocity=speed * np.outer(mpm.arrays()['pos'][:, 0] < 0.5 + gap / 2, [1, 0, 0]))
	O.engines, O.dt = [MpmDynamicEngine(grid=grid, verbosity=0)], 0.02
	O.run(25, wait=True)
for first, gap in ('a', 0.3), (None, 0.3), ('a', 0): fly(first, gap)
print('0')
''')
	warnings = [line for line in said.stderr.splitlines() if 'begin to share cells' in line]
	assert len(warnings) == 2 and "body 'a' and body 'b'" in warnings[0] and "points without a name and body 'b'" in warnings[1], said.stderr
