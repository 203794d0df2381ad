# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars and beams in the soil: MpmReinforcement, MpmBeam, their closed forms, and what is refused about them."""
import re

import numpy as np
import pytest
from conftest import outcomesOf

block = '''
import json
import numpy as np
from yade import mpm

def ground(*loads, size=(4, 2), cellSize=.25, young=1e7, poisson=0, gravity=(0, 0, 0), fix='y', sides=True, engine=MpmImplicitEngine, grid=None, **settings):
	"""A rectangle of elastic soil without weight worth speaking of, on a base that is held."""
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=1e-6, label='soil'))
	width, height = size
	grid = grid or MpmGrid(cellSize=cellSize)
	corner = [(0, 0), (width, 0), (width, height), (0, height)]
	if grid.dim == 2: O.bodies.append(mpm.fill(mpm.polygon(corner), grid, 2, 'soil'))
	else: O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (width, height, 1)), grid, 2, 'soil'))
	held = [MpmBoundary(max=(inf, 0, inf), fix=fix)]
	if sides: held += [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x')]
	O.engines, O.dt = [engine(grid=grid, gravity=gravity, boundaries=held, loads=loads, verbosity=0, label='solver', **settings)], .5
'''


def test_a_strip_is_drawn_out_as_by_the_closed_form(yade):
	"""From soil that hardly moves: u = P coth(a L) / (EA a) at its front, a^2 = k / EA; in the plane and in space. More than the bond takes is refused."""
	plane, space, data, more = yade(block + '''
EA, k, L, P = 1e6, 4e5, 2, 1e4
def strip(**settings): return MpmReinforcement(line=[(3, .6, .5), (1, .6, .5)], axialStiffness=EA, bond=8e3, bondStiffness=k, **settings)
found = []
for grid in MpmGrid(cellSize=.25), MpmGrid(cellSize=.25, dim=3):
	bar = strip(pull=P)
	ground(bar, size=(4, 1), young=1e12, grid=grid, fix='xyz'[:grid.dim])
	O.run(2, wait=True)
	a = np.sqrt(k / EA)
	found.append([-bar.slips[0], P / (EA * a * np.tanh(a * L)), sum(bar.bondForces)])
found.append(solver.plotData()['load0_axialForce'] / bar.axialForces[0])
solver.loads = [strip(pull=2e4)]
solver.loadCurve = [(0, 0), (4, 1)]
try: O.run(6, wait=True)
except RuntimeError as error: found.append(str(error))
print(json.dumps(found))
''').result
	for found, exact, bond in plane, space:
		assert abs(found / exact - 1) < 0.01
		assert abs(bond / -1e4 - 1) < 1e-6
	assert data == 1
	assert 'loads[0] is pulled out: the pull of ' in more and 'more than its bond can take, 16000 N' in more


def test_a_geotextile_has_the_strain_of_the_ground(yade):
	"""Strain of a block that is stretched, and of one that is pressed only if it takes compression; load that it takes is taken off the ground."""
	found = yade(block + '''
found = []
for pulled in 1, -1:
	for tensionOnly in True, False:
		sheet = MpmReinforcement(line=[(0, .6), (4, .6)], axialStiffness=1e6, tensionOnly=tensionOnly)
		ground(sheet, size=(4, 1), fix='y')
		solver.boundaries[2].displacement = (pulled * .04, 0, 0)
		solver.newton.tolerance, O.dt = 1e-10, 1
		O.run(1, wait=True)
		data = solver.plotData()
		found.append([min(sheet.axialForces), max(sheet.axialForces), data['reaction2_x']])
print(json.dumps(found))
''').result
	for (low, high, reaction), pulled in zip(found, (1, 1, -1, -1)):
		strain = np.log(1 + 0.01 * pulled)
		carries = pulled > 0 or (low, high) != (0, 0)
		force = 1e6 * strain / (1 + 0.01 * pulled)
		assert not carries or (abs(low / force - 1) < 1e-6 and abs(high / force - 1) < 1e-6)
	assert found[2][:2] == [0, 0] and found[3][0] < -9e3
	assert abs(found[0][2] - found[2][2] * -1) > 5e3  # the sheet's share


def test_a_tendon_is_stressed_and_then_locked(yade):
	"""While its curve changes it has the force of the jack; afterwards that goes with the ground, which is pressed by a load."""
	jacked, released, plates = yade(block + '''
anchor = MpmReinforcement(line=[(0, .6), (2.9, .6)], axialStiffness=1e6, freeLength=1.5, headPlate=True, pretension=2e4, bond=1e5, bondStiffness=1e7, curve=[(0, 0), (1, 1)])
press = MpmTraction(surface=[(0, 1), (0, 0)], pressure=2e4, curve=[(0, 0), (1, 0), (2, 1)])
ground(anchor, press, size=(4, 1), fix='y', sides=False)
solver.boundaries = [*solver.boundaries, MpmBoundary(min=(4, -inf, -inf), fix='x')]
O.run(2, wait=True)
jacked = anchor.axialForces[0]
O.run(2, wait=True)
moved = anchor.vertices[1][0] - anchor.vertices[0][0]
print(json.dumps([jacked, anchor.axialForces[0], 1e6 * (np.log(moved / 1.5))]))
''').result
	assert abs(jacked - 2e4) < 1e-6
	assert 1.3e4 < released < 1.99e4  # the ground is 2 m of E = 10 MPa to the front of the free length


def test_beam_on_a_layer_is_that_of_winkler(yade):
	"""A thin smooth layer has k = E / H: a point load sinks an endless beam by P l / 2 k, with the moment P / 4 l (l = (k / 4 EI)^(1/4))."""
	sinks, moment, pressed, drawn = yade(block + '''
H, EI, P, w = .5, 2e6, 1e4, 1e3
k = 1e7 / H
l = (k / 4 / EI) ** .25
beam = MpmBeam(line=[(0, H), (5, H)], axialStiffness=1e9, bendingStiffness=EI, adhesion=0, fixHead='xr', headForce=(0, -P / 2, 0), weight=w)
ground(beam, size=(5, H), cellSize=.125, gravity=(0, -10, 0))
O.run(2, wait=True)
weights = np.array(beam.pressures) * np.gradient([x[0] for x in beam.vertices])
weights[[0, -1]] /= 2
print(json.dumps([(H - beam.vertices[0][1] - w / k) / (P * l / 2 / k), beam.moments[0] / (P / 4 / l), weights.sum() / (w * 5 + P / 2), solver.plotData()['load0_moment'] / beam.moments[0]]))
''').result
	assert abs(sinks - 1) < 0.03 and abs(moment - 1) < 0.01
	assert abs(pressed + 1) < 1e-4 and drawn == 1


def test_stiff_plate_on_the_half_space(yade):
	"""The pressure in its middle is 2 / pi of the mean one (Boussinesq's problem of the plane), and that of a plate without stiffness the mean one."""
	stiff, soft = yade(block + '''
found = []
for EI in 1e9, 1:
	plate = MpmBeam(line=[(0, 8), (1, 8)], axialStiffness=1e9, bendingStiffness=EI, adhesion=0, fixHead='xr', weight=1e4)
	ground(plate, size=(8, 8), poisson=.3, gravity=(0, -10, 0))
	O.run(2, wait=True)
	found.append(-plate.pressures[0] / 1e4)
print(json.dumps(found))
''').result
	assert abs(stiff / (2 / np.pi) - 1) < 0.03
	assert abs(soft - 1) < 0.01


@pytest.mark.parametrize('rough', [False, True])
def test_lined_tunnel(yade, rough):
	"""Within 3 % of the closed form for a lining in elastic ground that is in place before the ground is dug out (Einstein and Schwartz 1979): axial forces, and the moment's part with cos(2 angle)."""
	N, M = yade(
	        block + '''
R, E, nu, P, K, size = 3., 1e8, .3, 5e5, .5, 60  # 20 radii: at 10 the moments are 2 % less
EA, EI = 1.5e9, 1.125e7
arc = [(R * np.sin(a), R * np.cos(a)) for a in np.linspace(0, np.pi / 2, 33)]
O.materials.append(MpmElasticMat(young=E, poisson=nu, density=2000, label='ground'))
grid = MpmGrid(cellSize=1, refinements=[MpmRefinement(max=(9, 9, inf))])
O.bodies.append(mpm.fill(mpm.polygon(arc + [(size, 0), (size, size), (0, size)]), grid, 2, 'ground'))
mpm.assign(stress=[np.diag([-K * P, -P, -nu * (1 + K) * P])] * len(O.bodies))
lining = MpmBeam(line=arc, axialStiffness=EA, bendingStiffness=EI, adhesion=inf if ROUGH else 0, fixHead='xr', fixFoot='yr')
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(size, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, size, -inf), fix='y')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, boundaries=sides, loads=[lining], verbosity=0)], 1
O.run(1, wait=True)
C, F = E * R / EA / (1 - nu**2), E * R**3 / EI / (1 - nu**2)
a0 = C * F * (1 - nu) / (C + F + C * F * (1 - nu))
if ROUGH:
	beta = ((6 + F) * C * (1 - nu) + 2 * F * nu) / (3 * F + 3 * C + 2 * C * F * (1 - nu))
	b2 = C * (1 - nu) / (2 * (C * (1 - nu) + 4 * nu - 6 * beta - 3 * beta * C * (1 - nu)))
	T, M = (1 - K) / 2 * (1 + 2 * beta * b2), (1 - K) / 4 * (1 - 2 * beta * b2 + 2 * b2)
else:
	a2 = (F + 6) * (1 - nu) / (2 * F * (1 - nu) + 6 * (5 - 6 * nu))
	T = M = (1 - K) / 2 * (1 - 2 * a2)
mean = (1 + K) / 2 * (1 - a0)
force = [-lining.axialForces[0] / (P * R * (mean - T)), -lining.axialForces[-1] / (P * R * (mean + T))]
x, y = np.array(lining.vertices)[:, :2].T
twice = np.cos(2 * np.arctan2(y, x))
print(json.dumps([force, -np.linalg.lstsq(np.c_[np.ones(len(x)), twice], lining.moments, rcond=None)[0][1] / (M * P * R**2)]))
'''.replace('ROUGH', str(rough))
	).result
	assert np.abs(np.array(N) - 1).max() < 0.03
	assert abs(M - 1) < 0.03


wall = block + '''
def excavated(steps=4, fixFoot='y'):
	"""An anchored wall in elastic ground: soil to its left, and to its right below the middle."""
	O.reset()
	O.materials.append(MpmElasticMat(young=2e7, poisson=.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (10, 0), (10, 3), (6, 3), (6, 6), (0, 6)]), grid, 2, 'soil'))
	anchor = MpmReinforcement(line=[(6, 5), (3, 4), (1.5, 3.5)], axialStiffness=2e7, freeLength=3, bond=1e5, bondStiffness=1e7, pretension=1e4)
	sheet = MpmBeam(line=[(6, 6), (6, 1)], axialStiffness=1e9, bendingStiffness=2e7, adhesion=0, friction=radians(20), fixFoot=fixFoot, anchors=[anchor], weight=1e3)
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(10, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, loads=[sheet], verbosity=0, label='solver'), MpmVtkRecorder(fileName='wall-', recorders=['loads'])], .25
	O.run(steps, wait=True)
	return sheet, anchor
'''


def test_anchored_wall_goes_on_from_a_file_bit_for_bit(yade):
	same, sum_, free, told, cells = yade(wall + '''
excavated(2)
mpm.save('wall.xml.gz')
O.run(2, wait=True)
sheet = solver.loads[0]
once = sheet.dict() | sheet.anchors[0].dict() | dict(points=mpm.arrays()['pos'].tolist())
O.load('wall.xml.gz')
O.run(2, wait=True)
sheet = solver.loads[0]
again = sheet.dict() | sheet.anchors[0].dict() | dict(points=mpm.arrays()['pos'].tolist())
same = all(repr(once[name]) == repr(again[name]) for name in once if name != 'anchors')
length = .25
left = sum(q * length for q in sheet.pressures[:-1]) + sheet.pressures[-1] * length / 2 - sheet.pressures[0] * length / 2
pull = sheet.anchors[0].axialForces[0]
head, first = sheet.anchors[0].vertices[:2]
direction = np.subtract(first, head) / np.linalg.norm(np.subtract(first, head))
print(json.dumps([same, [left, pull * direction[0]], [sheet.moments[0], sheet.moments[-1]], sorted(n for n in solver.plotData() if n.startswith('load0')), open('wall-loads.4.vtu', 'rb').read().count(b'moment')]))
''').result
	assert same
	# The line goes down, so that its left side is on the right: soil there presses it to the left and the anchor draws it there.
	assert abs(sum_[0] + sum_[1]) < 0.05 * abs(sum_[1]) or abs(sum_[0] - sum_[1]) < 0.05 * abs(sum_[1])
	assert max(map(abs, free)) < 1e-6
	assert told == ['load0_anchor0', 'load0_axialForce', 'load0_moment', 'load0_shearForce']
	assert cells > 0


def test_a_wall_that_only_friction_bears_needs_pressure_first(yade):
	"""In ground without stress its friction bears nothing: it once fell by 2.6 m in the first step, until it hung on its anchor."""
	kind, sentence = outcomesOf(yade.folder, wall, ["excavated(1, fixFoot='')"])["excavated(1, fixFoot='')"]
	assert kind == 'RuntimeError' and 'loads[0] finds no equilibrium' in sentence and 'slide along itself' in sentence and 'fix an end' in sentence, sentence


sheetPile = block + '''
def sand(cohesion=100):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=4e7, poisson=.3, density=1800, cohesion=cohesion, frictionAngle=phi, dilationAngle=phi, label='sand'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(low, -depth), (high, -depth), (high, 0), (low, 0)]), grid, 2, 'sand'))
	held = [MpmBoundary(max=(low, inf, inf), fix='x'), MpmBoundary(min=(high, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0, fBar=True, label='solver')], 1
	mpm.geostatic(.5)

def dig(wall, level, steps=2):
	"""To the right of the wall, wherever that is now."""
	x, y = np.array(wall.vertices)[::-1, :2].T
	mpm.stages.excavate(lambda at, pad=0: at[0] > -.15 and at[1] > -level and at[0] > np.interp(at[1], y, x), steps)
	O.run(steps, wait=True)
h, phi, gamma = .5, radians(30), 18e3
Ka = np.tan(pi / 4 - phi / 2)**2
'''


def test_cantilever_wall_fails_where_blum_says(yade):
	"""A smooth stiff wall of 6 m in sand, dug out on one side: it does not move while it is put in, stands at 0.9 of Blum's depth (without his addition of 20 %), with his moment, and is thrown over at 1.05 of it."""
	putIn, moment, stands, thrown = yade(sheetPile + '''
L, low, high, depth = 6, -12, 14, 9
sand()
wall = MpmBeam(line=[(0, 0), (0, -L)], axialStiffness=1e10, bendingStiffness=1e9, adhesion=0, fixFoot='y')
solver.loads = [wall]
O.run(1, wait=True)
points = mpm.arrays()
putIn = [abs(points['pos'] - points['pos0']).max(), wall.leftPressures[12] / (gamma * 1.5), wall.rightPressures[12] / (gamma * 1.5)]
dig(wall, 1.5, 6)
for level in np.arange(1.75, 2.76, .25): dig(wall, level)
H, x = 2.75, 2.75 / (1 / Ka - 1)
moment, stands = max(wall.moments) / (gamma * (Ka * (H + x)**3 - x**3 / Ka) / 6), wall.vertices[0][0]
for level in 3, 3.25: dig(wall, level)
print(json.dumps([putIn, moment, stands, wall.vertices[0][0]]))
''').result
	assert putIn[0] < 1e-6 and abs(putIn[1] - 1) < 0.01 and abs(putIn[2] - 1) < 0.01
	assert abs(moment - 1) < 0.1
	assert stands < 6 / 300 and thrown > 6 / 60


def test_anchored_wall_has_free_earth_support(yade):
	"""Dug out to where the earth before its foot is used up: anchor force and moment within 10 % of those by hand."""
	force, moment = yade(sheetPile + '''
L, z, H, low, high, depth = 8, 1.5, 5.75, -18, 14, 12
sand()
anchor = MpmReinforcement(line=[(0, -z), (-9, -z), (-14, -z)], axialStiffness=2.5e7, freeLength=8, bond=1e5, bondStiffness=1e8)
wall = MpmBeam(line=[(0, 0), (0, -L)], axialStiffness=1e10, bendingStiffness=1e9, adhesion=0, fixFoot="y", anchors=[anchor])
solver.loads = [wall]
O.run(1, wait=True)
for level in 2, 3, 4, 4.75, 5.25, 5.5, H: dig(wall, level, 6 if level == 2 else 4)
d, active = L - H, Ka * gamma * L**2 / 2
passive = active * (2 * L / 3 - z) / (L - d / 3 - z)  # which turns the wall about its anchor as much as the active earth
y = np.linspace(0, L, 4001)
shear = Ka * gamma * y**2 / 2 - np.where(y > H, passive * ((y - H) / d)**2, 0) - np.where(y > z, active - passive, 0)
print(json.dumps([anchor.axialForces[0] / (active - passive), min(wall.moments) / (np.cumsum(shear) * y[1]).min()]))
''').result
	assert abs(force - 1) < 0.1 and abs(moment - 1) < 0.1


def test_round_plates_on_the_half_space(yade):
	"""A shell on its axis: without stiffness it sinks as its load does, by 2 (1 - nu^2) p R / E in its middle and 2 / pi of that at its edge (Boussinesq); stiff, by pi / 4 of it, with half of the mean pressure in its middle."""
	soft, stiff = yade(block + '''
E, nu, R, p, far, of = 1e7, .3, 1, 1e4, 64, .2
found = []
for EI in 1e2, 1e7:
	O.reset()
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1e-3, label='soil'))
	grid = MpmGrid(cellSize=.5, axisymmetric=True, refinements=[MpmRefinement(min=(-inf, -2**(k + 1), -inf), max=(2**(k + 1), inf, inf), halvings=2 - k) for k in range(2)])
	O.bodies.append(mpm.fill(mpm.polygon([(0, -far), (far, -far), (far, 0), (0, 0)]), grid, 1, 'soil'))
	plate = MpmBeam(line=[(0, 0), (R, 0)], axialStiffness=1e9, bendingStiffness=EI, poisson=of, adhesion=0, weight=p)
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(min=(far, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -far, inf), fix='xy')], loads=[plate], verbosity=0, label='solver')
	O.engines, O.dt = [solver], 1
	O.step()
	sinks = [-x[1] / (2 * (1 - nu**2) * p * R / E) for x in plate.vertices]
	# The moment in its middle, of a free plate under its load and the pressure of a rigid one.
	G = p * R**2 / 2 * (np.log(2) - .5)
	found.append([sinks[0], sinks[-1], plate.rightPressures[0] / p, plate.moments[0] / (G * (1 + of) / 2 + (1 - of) * p * R**2 / 48), plate.hoopMoments[0] / plate.moments[0], solver.plotData()['load0_hoopMoment'] / plate.hoopMoments[0]])
print(json.dumps(found))
''').result
	assert abs(soft[0] - 1) < 0.03 and abs(soft[1] * np.pi / 2 - 1) < 0.03
	assert abs(stiff[0] * 4 / np.pi - 1) < 0.03 and abs(stiff[1] * 4 / np.pi - 1) < 0.03
	assert abs(stiff[2] - 0.5) < 0.1 and abs(stiff[3] - 1) < 0.1
	assert abs(stiff[4] - 1) < 1e-9 and abs(stiff[5]) >= 1


shaft = block + '''
def pressed(R=1, b=4, H=.5):
	"""A lining that is put into a cylinder of ground pressed from outside."""
	O.reset()
	O.materials.append(MpmElasticMat(young=2e7, poisson=.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=.25, axisymmetric=True)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (b, 0), (b, H), (0, H)]), grid, 2, 'soil'))
	press = MpmTraction(surface=[(b, 0), (b, H)], pressure=p0)
	solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, H, -inf), fix='y')], loads=[press], verbosity=0, label='solver')
	O.engines, O.dt = [solver, MpmVtkRecorder(fileName='shaft-', recorders=['loads'], iterPeriod=1)], 1
	O.run(1, wait=True)
	lining = MpmBeam(line=[(R, H), (R, 0)], axialStiffness=2e8, bendingStiffness=1e6, poisson=.2, adhesion=0, fixHead='r', fixFoot='yr')
	solver.loads = [press, lining]
	before = mpm.arrays()['pos']
	O.run(1, wait=True)
	return lining, abs(mpm.arrays()['pos'] - before).max()

def dig(R=1): mpm.stages.excavate(lambda at, pad=0: at[0] < R, 2)
p0, nu, G = 1e5, .3, 2e7 / 2.6
'''


def test_a_shaft_is_lined_and_dug_out(yade):
	"""Put into pressed ground, on a line of the grid and through the domains of points, the lining bears what is there on both sides and nothing moves; dug out, it has the hoop force of Lame's tube around it."""
	for moved, before, force, axial, moment in yade(shaft + '''
found = []
for R in 1, 1.1:
	lining, moved = pressed(R)
	found.append([moved, [lining.leftPressures[1] / p0, lining.rightPressures[1] / p0]])
	dig(R)
	O.run(2, wait=True)
	soil, steel = 2 * G * (16 - R**2) / R / ((1 - 2 * nu) * R**2 + 16), lining.axialStiffness * (1 - .2**2) / R**2
	N = -p0 * R / (1 + soil / steel)
	found[-1] += [[n / N for n in lining.hoopForces], max(map(abs, lining.axialForces)) / -N, max(map(abs, lining.moments)) / -N]
print(json.dumps(found))
''').result:
		assert moved < 1e-5 and np.abs(np.array(before) - 1).max() < 0.03  # the cylinder has shrunk by 1.3 cm in all
		assert np.abs(np.array(force) - 1).max() < 0.03
		assert axial < 1e-3 and moment < 1e-3


def test_a_shaft_goes_on_from_a_file_bit_for_bit(yade):
	same, drawn, hoop = yade(shaft + '''
pressed()
dig()
O.run(1, wait=True)
mpm.save('shaft.xml.gz')
def ends():
	O.run(1, wait=True)
	return repr(solver.loads[1].dict()) + repr(mpm.arrays()['pos'].tolist())
once = ends()
O.load('shaft.xml.gz')
import matplotlib
matplotlib.use('Agg')
same = once == ends()
mpm.diagram(solver.loads[1], 'hoopForce')
print(json.dumps([same, open('shaft-loads.4.vtu', 'rb').read().count(b'hoopForce'), sorted(n for n in solver.plotData() if 'hoop' in n)]))
''').result
	assert same and drawn > 0
	assert hoop == ['load1_hoopForce', 'load1_hoopMoment']


pile = block + '''
def pile(T, load, ramp, steps, engine=MpmDynamicEngine, **settings):
	"""Ground beside a pit, held by a sheet pile."""
	O.reset()
	O.materials.append(MpmElasticMat(young=2e7, poisson=.3, density=1800, label='soil'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (8, 0), (8, 2.5), (4, 2.5), (4, 4), (0, 4)]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(8, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	sheet = MpmBeam(line=[(4, 4), (4, 1)], axialStiffness=1e9, bendingStiffness=2e7, adhesion=0, friction=radians(20), fixFoot='y')
	press = MpmTraction(surface=[(3.5, 4), (0, 4)], pressure=load)
	O.engines, O.dt = [engine(grid=grid, gravity=(0, -10, 0), boundaries=held, loads=[press, sheet], loadCurve=[(0, 0), (ramp, 1)], newton=MpmNewton(tolerance=1e-10), verbosity=0, label='solver', **settings)], T
	most = 0
	for _ in range(steps):
		O.step()
		most = max(most, solver.iterations)
	return sheet, most, solver.plotData() if engine == MpmDynamicEngine else {}
'''


def test_a_sheet_pile_in_time(yade):
	"""Weight and a load that come within a wave's way through the ground: the soil is parted, no energy comes or goes unaccounted, and Newton's method is as fast as in statics. Slowly, it is as in statics."""
	(most, imbalance, lost), still, slow = yade(pile + '''
sheet, most, data = pile(5e-3, 2e4, .02, 30)
found = [[most, data['energyImbalance'] / data['loadWork'], (data['ghostWork'] + data['gridWork']) / data['loadWork']]]
for engine in MpmImplicitEngine, MpmDynamicEngine:
	sheet, most, data = pile(250, 2e4, 1e3, 4, engine=engine)
	found.append([sheet.moments, sheet.leftPressures, sheet.rightPressures])
print(json.dumps(found))
''').result
	assert most <= 10 and abs(imbalance) < 1e-4 and 0 <= lost < 0.01
	for quasi, dynamic in zip(still, slow):
		assert np.abs(np.subtract(quasi, dynamic)).max() < 1e-4 * np.abs(quasi).max() > 0


@pytest.mark.parametrize('scheme', ['newmark', 'midpoint', 'generalised-alpha'])
def test_parted_soil_in_time_goes_on_from_a_file_bit_for_bit(yade, scheme):
	same = yade(pile + f'''
pile(5e-3, 2e4, .02, 6, scheme='{scheme}')
mpm.save('pile.xml.gz')
def ends():
	O.run(4, wait=True)
	return repr(solver.loads[1].dict()) + repr(mpm.arrays()['pos'].tolist()) + repr(mpm.arrays()['velocity'].tolist())
once = ends()
O.load('pile.xml.gz')
print(json.dumps(once == ends()))
''').result
	assert same


def test_a_wall_that_is_put_into_stressed_ground_moves_nothing(yade):
	"""On a line of the grid, through the domains of points, and inclined, where it bears shear stress, too: it takes over the stress of both sides. Water is no matter."""
	moves = yade(block + '''
found = []
for line, water in ([(0, 0), (0, -3)], []), ([(.1, 0), (.1, -3)], [MpmWater(level=-1, curve=[(0, 1)])]), ([(.1, 0), (.9, -3)], []):
	O.reset()
	O.materials.append(MpmElasticMat(young=2e7, poisson=.3, density=2000, label='soil'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(-4, -5), (4, -5), (4, 0), (-4, 0)]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(-4, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -5, inf), fix='y')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, water=water, verbosity=0)
	O.engines, O.dt = [solver], 1
	mpm.geostatic()
	wall = MpmBeam(line=line, axialStiffness=1e9, bendingStiffness=1e7)
	solver.loads = [wall]
	O.run(1, wait=True)
	points = mpm.arrays()
	found.append([abs(points['pos'] - points['pos0']).max(), min(wall.leftPressures[4:8]), max(map(abs, wall.moments))])
print(json.dumps(found))
''').result
	for (moved, pressure, moment), most in zip(moves, (1e-5, 1e-5, 1e-4)):  # a layer of 5 m of this ground settles by 9 mm under its own weight
		assert moved < most and pressure > 5e3 and moment < 1e3


def test_geotextile_bears_the_thrust_of_an_embankment(yade):
	"""On a smooth base nothing else holds the active earth pressure in its middle."""
	force, moves = yade(block + '''
O.reset()
H, phi = 4, radians(30)
O.materials.append(MpmMohrCoulombMat(young=2e7, poisson=.3, density=1800, cohesion=100, frictionAngle=phi, dilationAngle=phi, label='fill'))
grid = MpmGrid(cellSize=.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (12, 0), (6, H), (0, H)]), grid, 2, 'fill'))
sheet = MpmReinforcement(line=[(0, .05), (11.5, .05)], axialStiffness=2e6)
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, loads=[sheet], verbosity=0, fBar=True)], .05
O.run(20, wait=True)
print(json.dumps([max(sheet.axialForces) / (np.tan(pi / 4 - phi / 2)**2 * 18e3 * H**2 / 2), sheet.vertices[-1][0] - 11.5]))
''').result
	assert abs(force - 1) < 0.08 and moves > 0


def test_near_beams_part_soil_on_all_sides(yade):
	"""Two walls, two cells to eight apart, on lines of the grid and off them: unequal pressures of the soil beside and between them stay, and press on each, to 0.2 %; water that seeps through both loses half of its pressure at each."""
	pressures, water = yade('''
import json
import numpy as np
from yade import mpm
def pressed(gap, middle, flow=False):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=0.3, density=2000, conductivity=1e-4, porosity=0.4, label='soil'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(mpm.polygon([(-2, -1), (2, -1), (2, 1), (-2, 1)]), grid, 2, 'soil'))
	x, (a, b) = mpm.arrays()['pos'][:, 0], (middle - gap / 2, middle + gap / 2)
	mpm.assign(stress=np.where(x < a, -1e4, np.where(x < b, -3e4, -2e4))[:, None, None] * np.eye(3))
	walls = [MpmBeam(line=[(at, 1), (at, -1)], axialStiffness=1e9, bendingStiffness=1e9, adhesion=0, fixHead='xyr', fixFoot='xyr', permittivity=1e-6 if flow else 0) for at in (a, b)]
	held = [MpmBoundary(max=(-2, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1, inf), fix='y'), MpmBoundary(min=(-inf, 1, -inf), fix='y')]
	drains = [MpmDrain(surface=[(side * 2, -side), (side * 2, side)], pressure=p) for side, p in ((-1, 5e3), (1, 0))]
	solver = MpmImplicitEngine(grid=grid, boundaries=held, loads=walls, verbosity=0, **(dict(flow=MpmFlow(drains=drains)) if flow else {}))
	O.engines, O.dt = [solver], 1e6 if flow else 1
	O.run(2, wait=True)
	if flow: return [mpm.arrays()['excessPressure'][side].mean() for side in (x < a, (x > a) & (x < b), x > b)]
	return [np.mean(side[1:-1]) for wall in walls for side in (wall.leftPressures, wall.rightPressures)]
print(json.dumps([[pressed(gap, middle) for gap in (0.5, 0.75, 2) for middle in (0, 0.06)], pressed(0.5, 0.06, True)]))
''').result
	assert np.allclose(pressures, [[3e4, 1e4, 2e4, 3e4]] * 6, rtol=2e-3), pressures  # left of a beam that goes down is the side of larger x
	assert np.allclose(water, [5e3, 2.5e3, 0], atol=50), water


# Arguments of ground(), and the feature beside which a beam is said not to part the soil; '' if it does.
oneBody = {
        'dict()': '',
        'dict(line=((1, 2), (3, 2)))': '',
        'dict(engine=MpmDynamicEngine)': '',
        'dict(grid=MpmGrid(cellSize=.25, period=(4, 0, 0)), sides=False)': 'beside MpmGrid.period',
        'dict(grid=MpmGrid(cellSize=.5, refinements=[MpmRefinement(min=(-inf, 1, -inf), halvings=1)]))': 'beside cells of several sizes',
        'dict(nonlocalLength=.5)': 'beside nonlocalLength',
        'dict(pressureRelaxation=True, fBar=True)': 'beside pressureRelaxation',
        "dict(newton=MpmNewton(linearSolver='amg'))": "beside MpmNewton.linearSolver = 'amg'",
        'dict(contacts=[MpmContact(friction=0)])': 'beside contacts[0]',
        'dict(flow=MpmFlow(), conductivity=1e-4, porosity=.4)': '',
        'dict(more=[MpmBoundary(surface=[(4, 2), (4, 0)], fix="n")])': 'beside boundaries[3].surface',
        'dict(engine=MpmDynamicEngine, other=[MpmFreeField(surface=[(0, 2), (0, 0)])])': 'beside loads[1]',
        'dict(other=[MpmBeam(line=[(2.5, 2), (2.5, 1)], axialStiffness=1e9, bendingStiffness=1e6)])': '',
}


def test_what_leaves_the_soil_one_body_is_said(yade):
	"""For each reason why a beam with soil on both of its sides does not part it; not where it does, nor of one on the ground. And points that go through a soft beam are counted."""
	run = yade(block + '''
import sys
from yade.mpm.library import engine as library
def said(line=((2, 2), (2, 1)), other=(), more=(), conductivity=None, porosity=None, **settings):
	beam = MpmBeam(line=list(line), axialStiffness=1e9, bendingStiffness=1e6, adhesion=0, fixFoot='xyr')
	ground(beam, *other, **{**dict(poisson=.3), **settings})
	if conductivity: O.materials[0].conductivity, O.materials[0].porosity = conductivity, porosity
	solver.boundaries = [*solver.boundaries, *more]
	if 'contacts' in settings: O.bodies.append(utils.wall(0, axis=1, sense=1, material=FrictMat()))
	O.dt = .01
	O.run(1, wait=True)
for case in CASES:
	print('case:', case, file=sys.stderr, flush=True)
	if 'amg' in case and library.multigridAbsence(): print('no amg', file=sys.stderr, flush=True)
	else: said(**eval(case))

print('case: soft', file=sys.stderr, flush=True)
soft = MpmBeam(line=[(2, 2), (2, .5)], axialStiffness=1e9, bendingStiffness=1e9, adhesion=0, fixHead='xyr', fixFoot='xyr', stiffness=1e-3)
press = MpmTraction(surface=[(0, 2), (0, 0)], pressure=3e6)
ground(soft, press, sides=False)
solver.boundaries = [*solver.boundaries, MpmBoundary(min=(4, -inf, -inf), fix='x')]
O.dt = .1
O.run(5, wait=True)
'''.replace('CASES', repr(list(oneBody))))
	told = dict(part.split('\n', 1) for part in run.stderr.split('case: ')[1:])
	sentence = 'has soil on both of its sides, which stays one body'
	for case, reason in oneBody.items():
		if 'no amg' in told[case]: continue
		assert (sentence in told[case]) == bool(reason) and reason in told[case], (case, told[case])
	assert sentence not in told['soft']
	assert re.search(r'\d+ material points? ha(s|ve) gone through loads\[0\]', told['soft']) and 'gone through' not in told['dict()']


def test_loads_on_the_two_sides_of_a_wall_do_not_mix(yade):
	"""Equal loads on both sides do not bend the wall if one surface ends at it and another begins a millimetre behind; one surface across it bends it a little."""
	apart, across = yade(block + '''
found = []
for lines in [[(3, 2), (2.001, 2)], [(1.999, 2), (1, 2)]], [[(3, 2), (1, 2)]]:
	wall = MpmBeam(line=[(2, 2), (2, .5)], axialStiffness=1e9, bendingStiffness=1e6, adhesion=0)
	ground(wall, *[MpmTraction(surface=line, pressure=1e5) for line in lines], poisson=.3, fix='xy', newton=MpmNewton(tolerance=1e-10))
	O.dt = 1
	O.step()
	found.append([solver.plotData()['reaction0_y'] / (1e5 * sum(a[0] - b[0] for a, b in lines)), max(map(abs, wall.moments)), min(wall.leftPressures[1:-2])])
print(json.dumps(found))
''').result
	for force, _, pressed in (apart, across):
		assert abs(force - 1) < 0.01 and pressed > 1e4
	assert apart[1] < 1e-3 and 10 < across[1] < 1e5 * 0.25 * 0.125  # the load of half of a piece, a quarter of a cell, on an arm of a piece


def test_stiff_round_plate_on_the_half_space(yade):
	"""A rigid disk, smooth: the force of its settlement, 2 E R w / (1 - nu^2), and the share of its inner half, 1 - sqrt(3 / 4)."""
	force, share = yade(block + '''
E, nu, R, w, far = 1e7, .3, 1, 1e-3, 64
O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='soil'))
O.materials.append(FrictMat(frictionAngle=0, label='rigid'))
grid = MpmGrid(cellSize=.5, axisymmetric=True, refinements=[MpmRefinement(min=(-inf, -2**(k + 1), -inf), max=(2**(k + 1), inf, inf), halvings=3 - k) for k in range(3)])
O.bodies.append(mpm.fill(mpm.polygon([(0, -far), (far, -far), (far, 0), (0, 0)]), grid, 1, 'soil'))
disk = O.bodies[O.bodies.append(utils.box((0, .5, 0), (R, .5, R), material='rigid', fixed=True))]
disk.state.vel = (0, -w, 0)
solver = MpmImplicitEngine(grid=grid, boundaries=[MpmBoundary(min=(far, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -far, inf), fix='xy')], contacts=[MpmContact(stiffness=100)], verbosity=0)
O.engines, O.dt = [solver], 1
O.step()
at, forces = mpm.contactForces()
print(json.dumps([solver.contacts[0].forces[0][1] / (2 * E * R * w / (1 - nu**2)), forces[at[:, 0] < R / 2, 1].sum() / forces[:, 1].sum()]))
''').result
	assert abs(force - 1) < 0.03
	assert abs(share / (1 - np.sqrt(0.75)) - 1) < 0.02


refusals = {
        "MpmReinforcement(line=[(1, 1), (1, 1)], axialStiffness=1e6)": "MpmReinforcement.line",
        "MpmReinforcement(line=[(1, 1)], axialStiffness=1e6)": "two or more points",
        "MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6, friction=30)": "as radians(30)",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)]))": "MpmReinforcement.axialStiffness = nan",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6, bond=1e3))": "needs a finite bondStiffness",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6, freeLength=2))": "expected less than the length of the first segment of line, 1 m",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6, freeLength=.5))": "loads[0].freeLength = 0.5: nothing supports its head",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6, pull=1, headPlate=True))": "cannot be pulled",
        "add(MpmReinforcement(line=[(1, 1), (5, 1)], axialStiffness=1e6))": "loads[0] has a vertex at (",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6), grid=MpmGrid(cellSize=.25, axisymmetric=True))": "MpmReinforcement cannot go with MpmGrid.axisymmetric",
        "shell(line=[(-1, 1), (2, 1)])": "loads[0].line has a point at Vector3(-1,1,0): around an axis x is a radius",
        "shell(line=[(0, 1), (0, .5), (1, .5)])": "two points on the axis one after the other",
        "shell(line=[(1, 1), (0, .5), (1, .5)])": "loads[0].line goes through the axis",
        "shell(plasticMoment=1e3)": "loads[0].plasticMoment = 1000: a shell of revolution does not yield",
        "shell(prestress=1e3)": "loads[0].prestress = 1000 is that of a beam in the plane",
        "shell(contraction=.01)": "a shell of revolution does not contract",
        "shell(anchors=[MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6)])": "loads[0].anchors: around an axis they would be cones",
        "shell(headForce=(1, 0, 0))": "its first vertex is on the axis",
        "shell(hinges=[(0, 2)])": "a point on the axis, where nothing turns",
        "shell(poisson=.6)": "a number from 0 to 0.5",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6, bendingStiffness=1e3, poisson=.2))": "loads[0].poisson = 0.2 is that of a shell of revolution",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6, bendingStiffness=1e3, prestress=-2e6))": "would press it to nothing",
        "add(MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6), engine=MpmDynamicEngine, scheme='explicit')": "MpmReinforcement cannot go with explicit steps",
        "add(MpmReinforcement(line=[(1, 1, .5), (2, 1, .5)], axialStiffness=1e6, bond=0, bondStiffness=1e6, friction=.5), grid=MpmGrid(cellSize=.5, dim=3))": "loads[0].perimeter",
        "add(MpmReinforcement(line=[(1, 1), (2000, 1)], axialStiffness=1e6))": "loads[0].line would have 15992 pieces of half a cell",
        "add(MpmBeam(line=[(1, 1), (2, 1), (1, 1)], axialStiffness=1e6, bendingStiffness=1e4))": "needs three different points or more",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6))": "MpmBeam.bendingStiffness = nan",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6, bendingStiffness=1e3, fixHead='z'))": "letters out of 'xyr'",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6, bendingStiffness=1e3, weight=1))": "loads[0].weight = 1 acts along MpmImplicitEngine.gravity, which is zero",
        "add(MpmBeam(line=[(1, 1), (2, 1)], axialStiffness=1e6, bendingStiffness=1e3), grid=MpmGrid(cellSize=.5, dim=3))": "the grid has dim=3",
        "add(MpmBeam(line=[(1, 1), (2, 1), (1, 1)], axialStiffness=1e6, bendingStiffness=1e3))": "needs three different points or more",
        "add(MpmBeam(line=[(1, 2), (2, 2)], axialStiffness=1e6, bendingStiffness=1e3, anchors=[MpmReinforcement(line=[(1, 1), (2, 1)], axialStiffness=1e6)]))": "loads[0].anchors[0].line begins at Vector3(1,1,0), 1 m away",
}


def test_refusals(yade):
	found = outcomesOf(yade.folder, block + '''
def add(load, **settings):
	ground(load, **settings)
	O.run(1, wait=True)
def shell(**settings): add(MpmBeam(**{**dict(line=[(0, 2), (1, 2)], axialStiffness=1e6, bendingStiffness=1e3), **settings}), grid=MpmGrid(cellSize=.25, axisymmetric=True))
''', list(refusals))
	for text, (kind, sentence) in found.items():
		assert kind in ('ValueError', 'RuntimeError') and refusals[text] in sentence, (text, kind, sentence)


def test_an_anchor_that_no_equilibrium_is_found_for_in_a_trial_does_not_end_the_step(yade):
	"""Dug out below water before a wall with a prestressed anchor: in a trial of Newton's method forces of the anchor are not finite, which its next trials must not go on from."""
	force, moment = yade('''
import json
from yade import mpm
O.materials.append(MpmMohrCoulombMat(young=3e7, poisson=0.3, density=1900, cohesion=1e3, frictionAngle=radians(32), label='sand'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (28, 0), (28, 16), (0, 16)]), grid, 2, 'sand'))
anchor = MpmReinforcement(line=[(14, 14.5), (7, 12), (4, 11)], axialStiffness=5e7, freeLength=6, bond=2e5, bondStiffness=1e8, pretension=4e4)
wall = MpmBeam(line=[(14, 16), (14, 6)], axialStiffness=3e9, bendingStiffness=5e7, adhesion=0, friction=radians(20), anchors=[anchor])
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(28, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=held, gravityCurve=[(0, 1)], water=[MpmWater(level=14)], verbosity=0)
O.engines, O.dt = [solver], 0.25
mpm.geostatic(0.5)
solver.loads = [wall]
O.run(2, wait=True)
for dug in 2, 4:
	O.run(4, wait=True)
	mpm.stages.excavate(mpm.polygon([(14, 16 - dug), (28, 16 - dug), (28, 17), (14, 17)]), steps=4)
	O.run(4 if dug < 4 else 2, wait=True)
print(json.dumps([anchor.axialForces[0], max(wall.moments)]))
''').result
	assert 4e4 < force < 5.5e4 and 5e3 < moment < 1.5e4


# Walls that end in the middle of a cell, in its upper and in its lower half, and on a line of the grid.
wallInElasticGround = '''
def wall(x, foot, fromFoot=False, mirrored=False, F=0, load=0, steps=4):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=.3, density=1800, label='soil'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (6, 0), (6, 3), (0, 3)]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(6, -inf, -inf), fix='x')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, newton=MpmNewton(tolerance=1e-11), verbosity=0)
	O.engines, O.dt = [solver], 1 / steps
	mpm.geostatic(.5)
	at = lambda x: 6 - x if mirrored else x
	line = [(at(x), 3), (at(x), foot)]
	beam = MpmBeam(line=line[::-1] if fromFoot else line, axialStiffness=1e8, bendingStiffness=1e5, adhesion=0, friction=.3, headForce=(F, 0, 0))
	crest = [(at(1.9), 3), (at(.2), 3)]
	solver.loads = [beam] + ([MpmTraction(surface=crest[::-1] if mirrored else crest, pressure=load)] if load else [])
	for k in range(steps):
		O.run(1, wait=True)
		yield beam
'''


def test_a_foot_keeps_its_pressure_wherever_it_is_in_its_cell(yade):
	"""K0 gamma z on both of its sides, also after the wall has moved by micrometres: within 10 % on and off lines of the grid, as the stress of the soil is a mean over a cell."""
	found = yade(block + wallInElasticGround + '''
found = []
for x, foot in (2, 1.25), (2.01, 1.25), (2, 1.3), (2.1, 1.3), (2, 1), (2, 1.0000001), (2, .9999999):
	pressures = [(b.leftPressures[-1], b.rightPressures[-1]) for b in wall(x, foot, F=500)]
	found.append([[p / (9e3 * (3 - foot)) for p in both] for both in pressures])
print(json.dumps(found))
''').result
	for steps in found:
		assert all(0.9 < ratio < 1.1 for both in steps for ratio in both), found
		assert all(abs(a - b) < 0.02 for both, then in zip(steps, steps[1:]) for a, b in zip(both, then)), found


def test_a_wall_is_the_same_from_its_foot_and_in_a_mirror(yade):
	found = yade(block + wallInElasticGround + '''
found = []
for x, foot in (3.3, .8), (2.85, 1.3), (3.3, 1), (3.3, 1.0000000000000004):
	def moments(**how):
		for b in wall(x, foot, load=5e3, **how): pass
		return np.array(b.moments)
	a = moments()
	found.append([abs(a + moments(fromFoot=True)[::-1]).max() / abs(a).max(), abs(a + moments(mirrored=True)).max() / abs(a).max()])
print(json.dumps(found))
''').result
	assert max(max(both) for both in found) < 1e-5, found  # springs that touch or not by round-off


def test_a_beam_in_the_soil_is_the_same_from_its_other_end_and_in_a_mirror(yade):
	"""Both ends in the soil, inclined and upright: soil ahead of a tip is on the side where it is."""
	found = yade(block + '''
def forces(line, mirrored=False):
	beam = MpmBeam(line=[(4 - x if mirrored else x, y) for x, y in line], axialStiffness=1e7, bendingStiffness=1e5)
	ground(beam, size=(4, 2), cellSize=.5, young=1e6, poisson=.3, fix='xy', newton=MpmNewton(tolerance=1e-11))
	solver.gravity = (0, -1e10, 0)
	O.run(2, wait=True)
	return np.array(beam.axialForces)
found = []
for line in [(3.35, 1), (2.05, 1.29)], [(3.35, .8), (2.15, 1.6)], [(3.35, 1.7), (2.9, .6)], [(2.8, 1.7), (2.8, .6)]:
	N = forces(line)
	found += [abs(N - forces(line[::-1])[::-1]).max() / abs(N).max(), abs(N - forces(line, mirrored=True)).max() / abs(N).max()]
print(json.dumps(found))
''').result
	assert max(found) < 1e-9, found


def test_a_wall_that_stands_on_its_tip_is_told_of(yade):
	"""Smooth, anchored, phi = 35 degrees: statics lets it stand down to 7.8 m (front at most Kp gamma D^2 / 2, back at least Ka gamma L^2 / 2), and not at 8.25 m, where the tip bears less than a quarter of the front, but much more than its part."""
	run = yade(block + '''
import sys
O.materials.append(MpmMohrCoulombMat(young=5e7, poisson=.3, density=2e3, cohesion=100, frictionAngle=radians(35), dilationAngle=radians(35), label='sand'))
grid = MpmGrid(cellSize=.5)
O.bodies.append(mpm.fill(mpm.polygon([(-16, -14), (13, -14), (13, 0), (-16, 0)]), grid, 2, 'sand'))
held = [MpmBoundary(max=(-16, inf, inf), fix='x'), MpmBoundary(min=(13, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -14, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0, fBar=True)
O.engines, O.dt = [solver], 1
mpm.geostatic(.45)
anchor = MpmReinforcement(line=[(0, -1.6), (-8, -1.6), (-13, -1.6)], axialStiffness=3e7, freeLength=7.5, bond=1e5, bondStiffness=1e8)
wall = MpmBeam(line=[(0, 0), (0, -10)], axialStiffness=1e10, bendingStiffness=1e9, adhesion=0, fixFoot='y', anchors=[anchor])
solver.loads = [wall]
O.run(1, wait=True)
for dug in 3.5, 6, 7.5, 8.25:
	print(f'dug out: {dug} m', file=sys.stderr, flush=True)
	y, x = np.array(wall.vertices)[::-1, 1], np.array(wall.vertices)[::-1, 0]
	mpm.stages.excavate(lambda at, pad=0: at[1] > -dug and at[0] > np.interp(at[1], y, x), steps=3)
	O.run(3, wait=True)
''')
	stages = dict(part.split(' m\n', 1) for part in run.stderr.split('dug out: ')[1:])
	assert {dug: 'it may stand on its tip' in told for dug, told in stages.items()} == {'3.5': False, '6': False, '7.5': False, '8.25': True}
	assert 'the vertex of loads[0] at (' in stages['8.25']


def test_a_smooth_wall_does_not_leave_the_ground_along_itself(yade):
	"""Nothing holds it along itself: it once ended 9 m below its place."""
	outcome = outcomesOf(yade.folder, block + '''
def lean():
	O.reset()
	O.materials.append(MpmMohrCoulombMat(density=2000, cohesion=6e3, frictionAngle=.5, dilationAngle=.1, young=1e6, poisson=.3, label='soil'))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (6, 0), (6, 3), (0, 3)]), MpmGrid(cellSize=.5), 2, 'soil'))
	wall = MpmBeam(line=[(1.8645641239037907, 3), (2.0411199336369785, 1.03)], axialStiffness=1e7, bendingStiffness=1e6, adhesion=0)
	load = MpmTraction(surface=[(1.8545641239037907, 3), (0, 3)], pressure=6e3)
	held = [MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(6, -inf, -inf), fix='x')]
	O.engines = [MpmImplicitEngine(grid=MpmGrid(cellSize=.5), gravity=(0, -10, 0), boundaries=held, loads=[wall, load], gravityCurve=[(0, 0), (.5, 1)], newton=MpmNewton(minStep=1/4), verbosity=0)]
	O.dt = .25
	O.run(3, wait=True)
''', ['lean()'])
	kind, sentence = outcome['lean()']
	assert kind == 'RuntimeError' and 'in the soil around it, more than a cell' in sentence and 'adhesion' in sentence, sentence
