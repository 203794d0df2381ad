# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.seepage: discharge and free surface of dams, pressures for an MpmWater, and what it refuses."""
import pytest

setting = '''
import json

import numpy as np
from yade import mpm

def dam(length, high, h, origin=0.):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=.3, density=2000, conductivity=1e-5, porosity=.4, label='soil'))
	grid = MpmGrid(cellSize=h, origin=(origin, origin, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (length, 0), (length, high), (0, high)]), grid, 2, 'soil'))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], verbosity=0)]
	return [(0, high), (0, 0)], [(length, 0), (length, high)]
'''


def test_rectangular_dams_have_the_discharge_of_dupuit(yade):
	"""k (h1^2 - h2^2) / 2 L is exact, with the seepage face above the lower level; what comes in goes out."""
	for found, into, exit, level in yade(
	        setting + '''
found = []
for length, high, low, h in (5, 4, 1, .5), (5, 4, 1, .25), (3, 4, 0, .25):
	left, right = dam(length, high, h)
	flow = mpm.seepage([(left, high), (right, low)])
	exact = 1e-5 * (high**2 - low**2) / 2 / length
	found.append([flow.discharge[1] / exact, flow.discharge[0] / exact, flow.surface[-1][1], low])
print(json.dumps(found))
'''
	).result:
		assert found == pytest.approx(1, abs=0.02) and into == pytest.approx(-found, abs=1e-4)
		assert exit > level + 0.2, 'water comes out above the lower level'


def test_layers_conduct_along_and_across(yade):
	"""Dupuit's discharge is that of the horizontal conductivity, whatever the vertical one. Under a sheet pile of half the depth of the layer passes sqrt(k_h k_v) H / 2: in coordinates x sqrt(k_v / k_h) such soil conducts alike."""
	dams, piles, said = yade(
	        setting + '''
dams, piles = [], []
for pair in (4e-5, 1e-5), (1e-5, 4e-5):
	left, right = dam(5, 4, .25)
	O.materials[0].conductivity = pair
	flow = mpm.seepage([(left, 4), (right, 1)])
	dams.append(flow.discharge[1] / (pair[0] * (4**2 - 1) / 10))
	T, L = 5, 20
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=.3, density=2000, conductivity=pair, porosity=.4, label='soil'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(-L, 0), (L, 0), (L, T), (-L, T)]), grid, 2, 'soil'))
	wall = MpmBeam(line=[(0, T), (0, T / 2)], axialStiffness=3e9, bendingStiffness=5e7)
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), loads=[wall], verbosity=0)]
	ground = [([(0, T), (-L, T)], T + 1), ([(L, T), (0, T)], T)]
	piles.append(mpm.seepage(ground, unitWeight=1e4).discharge[1] / (2e-5 / 2))
x = mpm.arrays()['pos']
mpm.assign(conductivity=[1e-5] * len(x))
try: mpm.seepage(ground)
except ValueError as error: said = str(error)
mpm.assign(verticalConductivity=[1e-5] * len(x))
piles.append(mpm.seepage(ground, unitWeight=1e4).discharge[1] / (1e-5 / 2))
print(json.dumps([dams, piles, said]))
'''
	).result
	assert dams == pytest.approx([1, 1], abs=0.02)
	assert piles == pytest.approx([1, 1, 1], abs=0.05)
	assert 'pair' in said and 'verticalConductivity' in said


def test_a_drain_below_a_dam_draws_the_parabola_of_kozeny(yade):
	"""Flow from a steep face to a horizontal drain: discharge k (sqrt(d^2 + h^2) - d), and the free surface y^2 = 2 a (d - x) + a^2. Kozeny's own face bulges a little towards the water."""
	for found, surface in yade(
	        setting + '''
found = []
for d in 12, 20:
	dam(d + 4, 6, .5)
	flow = mpm.seepage([([(0, 6), (0, 0)], 5)], faces=[[(d, 0), (d + 3.5, 0)]])
	a = np.sqrt(d**2 + 25) - d
	x, y = np.transpose([place for place in flow.surface if place[0] < d - .5])
	found.append([flow.discharge[1] / (1e-5 * a), float(abs(y - np.sqrt(2 * a * (d - x) + a * a)).max())])
print(json.dumps(found))
'''
	).result:
		assert found == pytest.approx(1, abs=0.05) and surface < 0.06


def test_points_own_conductivities_are_taken(yade):
	"""A dam in two halves, one ten times as tight, under water: the one drops ten times as much."""
	parts, said = yade(
	        setting + '''
left, right = dam(4, 1, .5)
points = mpm.arrays()
tight = points['id'][points['pos'][:, 0] > 2]
mpm.assign(ids=tight, conductivity=[1e-6] * len(tight))
flow = mpm.seepage([(left, 5), (right, 3)])
parts = (flow.pressure((.1, .5, 0)) - flow.pressure((1.9, .5, 0))) / (flow.pressure((2.1, .5, 0)) - flow.pressure((3.9, .5, 0)))
print(json.dumps([parts, flow.discharge[1] / (1e-5 * 2 / 22)]))
'''
	).result
	assert parts == pytest.approx(0.1, rel=0.1) and said == pytest.approx(1, abs=0.05)


def test_uniform_flow_is_exact_at_any_cut_and_water_takes_the_pressures(yade):
	errors, slopes, pressure = yade(
	        setting + '''
errors = []
for origin in 0, .1:  # a body that is under water altogether, in cells of .3
	left, right = dam(3, 1.2, .3, origin)
	x = [b.state.pos[0] for b in O.bodies]
	low = min(b.state.pos[1] - b.shape.halfSize[1] for b in O.bodies)
	a, b = min(x) - .075, max(x) + .075
	tall = len({round(b.state.pos[1], 6) for b in O.bodies}) * .15
	left, right = [(a, low + tall), (a, low)], [(b, low), (b, low + tall)]
	flow = mpm.seepage([(left, 5), (right, 4)])
	errors.append(flow.discharge[1] / (1e-5 * tall / (b - a + 2 * .3e-3)) - 1)
	slopes = (flow.pressure((1., .6, 0)) - flow.pressure((2., .6, 0))) * (b - a) / 9810
solver = O.engines[0]
solver.water = [MpmWater(pressure=flow.pressure)]
solver.boundaries = [MpmBoundary(max=(inf, origin - .3, inf), fix='xy')]  # on the line below the body
O.dt = .25
O.step()
middle = O.bodies[len(O.bodies) // 2].state
print(json.dumps([errors, slopes, middle.porePressure / (.25 * flow.pressure(middle.pos))]))
'''
	).result
	assert max(map(abs, errors)) < 1e-6
	assert slopes == pytest.approx(1, abs=1e-3)
	assert pressure == pytest.approx(1, abs=0.05)


def test_what_does_not_go_is_refused_by_name(yade):
	said = yade(
	        setting + '''
left, right = dam(3, 2, .5)
said = []
def tried(*arguments, **keywords):
	try: mpm.seepage(*arguments, **keywords)
	except Exception as error: said.append(f'{type(error).__name__}: {error}')
tried([])
tried([left])
tried([(left, nan)])
tried([(right[::-1], 1)])
tried([(left, 1)], unitWeight=0)
O.materials[0].conductivity = nan
tried([(left, 1)])
print(json.dumps(said))
'''
	).result
	for sentence, part in zip(said, ('levels = () has no surface', 'must be a pair', 'must be a pair', 'is not on the body', 'unitWeight = 0', 'has conductivity = nan'), strict=True):
		assert part in sentence, sentence


def test_a_beam_is_tight_for_water_or_leaks(yade):
	"""Flow under a sheet pile of half the depth of the layer: discharge k H / 2 (Harr 1962), on a line of the grid or between two. Down to the base nothing passes, and a leaky wall has what two layers of soil and it let through."""
	under, through, leaks, aside, open_, pressures = yade(
	        setting + '''
T, L, k = 5, 20, 1e-5
def flow(depth, h=.5, x=0., level=T + 1, length=L, side=False, **ofWall):
	dam(1, 1, h)
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=.3, density=2000, conductivity=k, porosity=.4, label='soil'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(-length, 0), (length, 0), (length, T), (-length, T)]), grid, 2, 'soil'))
	wall = MpmBeam(line=[(x, T), (x, T - depth)], axialStiffness=3e9, bendingStiffness=5e7, **ofWall)
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), loads=[wall], verbosity=0)]
	if side: return mpm.seepage([([(-length, T), (-length, 0)], T + 2), ([(length, 0), (length, T)], T + 1)], unitWeight=1e4)
	return mpm.seepage([([(x, T), (-length, T)], level), ([(length, T), (x, T)], T)], unitWeight=1e4)
under = [flow(2.5, h, x).discharge[1] / (k / 2) for h, x in ((.5, 0), (.25, 0), (.5, .2))]
f = flow(5, level=T + 2)
psi, length = 1e-5, 4
leaks = flow(5, length=length, side=True, permittivity=psi).discharge[1] / (T / (2 * length / k + 1 / psi))
print(json.dumps([under, f.discharge, leaks, flow(5, length=length, side=True).discharge[1], flow(5, length=length, side=True, permittivity=inf).discharge[1] / (T * k / (2 * length)),
	[f.pressure((-1e-3, 2, 0)), f.pressure((1e-3, 2, 0))]]))
'''
	).result
	assert under == pytest.approx([1, 1, 1], abs=.03) and under[1] < under[0]
	assert abs(through[0]) + abs(through[1]) < 1e-12 and leaks == pytest.approx(1, abs=2e-3) and abs(aside) < 1e-12 and open_ == pytest.approx(1, abs=2e-3)
	assert pressures == pytest.approx([5e4, 3e4], rel=1e-6)
