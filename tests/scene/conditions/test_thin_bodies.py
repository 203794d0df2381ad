# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies thinner than a cell with soil on both of their sides, which they part."""
import numpy as np
from conftest import root
import pytest

scene = '''
import json
import numpy as np
from yade import mpm, utils

def ground(h=0.25, low=(-2, -1), high=(2, 1), axisymmetric=False, engine=MpmImplicitEngine, K0=0.5, young=1e7, poisson=0.3, gridMore={}, friction=0, **settings):
	"""Ground of 20 kN/m3 at rest, up to y = 1."""
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=2000, label='soil'))
	O.materials.append(FrictMat(frictionAngle=friction, density=2600, label='rigid'))
	grid = MpmGrid(cellSize=h, axisymmetric=axisymmetric, **gridMore)
	O.bodies.append(mpm.fill(mpm.polygon([low, (high[0], low[1]), high, (low[0], high[1])]), grid, 2, 'soil'))
	held = [MpmBoundary(max=(low[0], inf, inf), fix='x'), MpmBoundary(min=(high[0], -inf, -inf), fix='x'), MpmBoundary(max=(inf, low[1], inf), fix='xy')]
	solver = engine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, verbosity=0, **settings)
	O.engines, O.dt = [solver], 1
	mpm.geostatic(K0=K0)
	return solver

def sheet(x, toe, top=1.25): return O.bodies[O.bodies.append(utils.facet([(x, toe, 0), (x, top, 0), (x, toe, 1)], material='rigid', fixed=True))]
def plank(x, toe, thick, top=1.25): return O.bodies[O.bodies.append(utils.box((x, (toe + top) / 2, 0), (thick / 2, (top - toe) / 2, 1), material='rigid', fixed=True))]
def sizes(axisymmetric):
	"""Settings of a grid of 0.125 m, and of one with such cells around a sheet alone."""
	x = 1 if axisymmetric else 0
	return dict(h=0.125), dict(h=0.25, gridMore=dict(refinements=[MpmRefinement(min=(x - 0.4, -inf, -inf), max=(x + 0.4, inf, inf))]))
def sides(solver):
	"""Forces of a body on the soil to its left and to its right."""
	_, force = mpm.contactForces(solver)
	return [force[side * force[:, 0] > 0].sum(axis=0)[:2].tolist() for side in (-1, 1)]
'''


def test_soil_presses_on_both_sides_of_a_sheet_wished_in_place(yade):
	"""K0 gamma H^2 / 2 on each of them within 8 %, on a line of the grid and off it, down to the base and to a toe in the soil; before, nothing."""
	found = yade(scene + '''
found = []
for x, toe in (0, -1), (0.1, -1), (-0.15, -1), (0, 0):
	solver = ground(h=0.125)
	sheet(x, toe)
	solver.contacts = [MpmContact()]
	O.run(1, wait=True)
	found.append([1 - toe, *sides(solver)])
print(json.dumps(found))
''').result
	for depth, left, right in found:
		weight = 0.5 * 20e3 * depth**2 / 2
		assert abs(-left[0] / weight - 1) < 0.08 and abs(right[0] / weight - 1) < 0.08
		assert abs(left[0] + right[0]) < 0.06 * weight


def test_sides_of_a_sheet_on_cells_of_several_sizes(yade):
	"""Unequal pressures on the two sides of a stiff wall stay as they are, and press on it, to 1e-6: cells halved on one side, around a part of it and by adaptation, in the plane and around an axis."""
	found = yade(scene + '''
found = []
cells = [dict(refinements=[MpmRefinement(min=(0.3, -inf, -inf), halvings=1)]), dict(refinements=[MpmRefinement(min=(-0.2, -0.2, -inf), max=(1.2, 0.2, inf), halvings=2)]), dict(adaptation=[MpmAdaptation(halvings=1)])]
for axisymmetric in False, True:
	for more in cells:
		solver = ground(axisymmetric=axisymmetric, low=(0 if axisymmetric else -2, -1), K0=1, gridMore=more)
		x = 1. if axisymmetric else 0.
		mpm.assign(stress=np.where(mpm.arrays()['pos'][:, 0] < x, -1e4, -3e4)[:, None, None] * np.eye(3))
		solver.gravity, solver.gravityCurve = (0, 0, 0), []
		solver.boundaries = [*solver.boundaries[:2], MpmBoundary(max=(inf, -1, inf), fix='y'), MpmBoundary(min=(-inf, 1, -inf), fix='y')]
		before = mpm.arrays()['stress'].copy()
		sheet(x, -1, 1)
		solver.contacts = [MpmContact(stiffness=1e6)]
		O.run(2, wait=True)
		area = 2 * (2 * np.pi * x if axisymmetric else 1)
		found.append([abs(mpm.arrays()['stress'] - before).max() / 3e4, *(abs(side[0]) / (p * area) - 1 for side, p in zip(sides(solver), (1e4, 3e4)))])
print(json.dumps(found))
''').result
	assert np.abs(found).max() < 1e-6, found


def test_two_near_sheets_part_soil_on_all_sides(yade):
	"""Half a cell to three cells apart, one is pulled off the soil between them: that stays where it is, and the soil beyond is pushed. Unequal pressures between and beside them press on each by themselves, to 1e-3."""
	moved, pressures = yade(scene + '''
moved, pressures = [], []
for gap in 0.125, 0.25, 0.5, 0.75:
	solver = ground(K0=1)
	solver.gravity, solver.gravityCurve = (0, 0, 0), []
	mpm.assign(stress=np.zeros((len(O.bodies), 3, 3)))
	first, second = sheet(-0.25, -1), sheet(-0.25 + gap, -1)
	solver.contacts = [MpmContact()]
	second.state.vel = (5e-3, 0, 0)
	start = mpm.arrays()['pos'].copy()
	O.run(1, wait=True)
	way, x, isAbove = (mpm.arrays()['pos'] - start)[:, 0] / 5e-3, start[:, 0], start[:, 1] > -0.5
	moved.append([abs(way[(x < gap - 0.25) & isAbove]).max(), way[(x > gap - 0.25) & (x < gap) & isAbove].min()])

	solver = ground(K0=1)
	x = mpm.arrays()['pos'][:, 0]
	mpm.assign(stress=np.where(x < -0.25, -1e4, np.where(x < gap - 0.25, -3e4, -2e4))[:, None, None] * np.eye(3))
	solver.gravity, solver.gravityCurve = (0, 0, 0), []
	solver.boundaries = [*solver.boundaries[:2], MpmBoundary(max=(inf, -1, inf), fix='y'), MpmBoundary(min=(-inf, 1, -inf), fix='y')]
	sheet(-0.25, -1, 1), sheet(gap - 0.25, -1, 1)
	solver.contacts = [MpmContact(stiffness=1e6)]
	O.run(2, wait=True)
	pressures.append([side[0] / (2 * 1e4) for side in sides(solver)])
print(json.dumps([moved, pressures]))
''').result
	assert all(still < 1e-9 and pushed > 0.85 for still, pushed in moved), moved
	assert np.allclose(pressures, [[-1 - 3, 3 + 2]] * 4, atol=1e-3), pressures


def test_a_caisson_with_a_partition_parts_all_cells(yade):
	"""A square of sheets with one across it, and a cross: soil of each of the cells stays where it is as a wall is pulled off it, and soil outside is whole beyond the ends of the partition."""
	found = yade(scene + '''
def line(a, b): return O.bodies[O.bodies.append(utils.facet([(*a, 0), (*b, 0), (*a, 1)], material='rigid', fixed=True))]
def moved(walls, number, way):
	"""Displacement of points along y over that of a wall."""
	solver = ground(low=(-2, -2), high=(2, 2), K0=1)
	solver.gravity, solver.gravityCurve = (0, 0, 0), []
	mpm.assign(stress=np.zeros((len(O.bodies), 3, 3)))
	made = [line(*wall) for wall in walls]
	solver.contacts = [MpmContact()]
	made[number].state.vel = (0, way, 0)
	start = mpm.arrays()['pos'].copy()
	O.run(1, wait=True)
	return start, (mpm.arrays()['pos'] - start)[:, 1] / way

square = [((-1, -1), (1, -1)), ((1, -1), (1, 1)), ((1, 1), (-1, 1)), ((-1, 1), (-1, -1))]
x, partition = moved(square + [((-1, 0), (1, 0))], 4, 5e-3)
within = (abs(x[:, 0]) < 1)
below, above, outside = (abs(partition[within & (x[:, 1] > low) & (x[:, 1] < high)]) for low, high in ((-1, 0), (0, 1), (1, 2)))
x, cross = moved([((-2, 0), (2, 0)), ((0, -2), (0, 2))], 0, 5e-3)
print(json.dumps([below.max(), above.max(), outside.max(), abs(cross[x[:, 1] < 0]).max(), cross[(x[:, 1] > 0) & (x[:, 1] < 0.5)].min()]))
''').result
	below, above, outside, behind, before = found
	assert below < 1e-9 and above > 0.8 and outside < 0.5, found
	assert behind < 1e-9 and before > 0.7, found


def test_a_sheet_rubs_on_both_sides(yade):
	"""In the plane and, as the skirt of a caisson, around an axis, on cells of one and of two sizes: the cap of the shear stress over the length in the soil, on each side within 3 % after the first millimetres."""
	found = yade(scene + '''
found = []
for axisymmetric, cells in [(ring, cells) for ring in (False, True) for cells in sizes(ring)]:
	solver = ground(**cells, low=(0 if axisymmetric else -2, -1), axisymmetric=axisymmetric, friction=1.2, K0=1)
	wall = sheet(1 if axisymmetric else 0, 0)
	solver.contacts = [MpmContact(adhesion=2e3)]
	O.run(1, wait=True)
	wall.state.vel = (0, -2e-3, 0)
	O.run(3, wait=True)
	found.append([-side[1] / (2e3 * 1.006 * (2 * np.pi if axisymmetric else 1)) for side in sides(solver)])
print(json.dumps(found))
''').result
	assert all(abs(part - 1) < 0.03 for pair in found for part in pair), found


def test_adhesion_and_pressure_of_a_sheet_at_any_angle(yade):
	"""A sheet of eight cells in clay under even pressure, off the lines of the grid, upright, level and oblique: as it slides each side has the whole cap of the shear stress within 1 %, and the pressure within 4 %; before, points of it were open."""
	found = yade(scene + '''
found = []
for angle in np.radians([0, 10, 20, 30, 45, 60, 90]):
	solver = ground(low=(-3, -3), high=(3, 3), K0=1, friction=1.2)
	solver.gravity, solver.gravityCurve = (0, 0, 0), []
	mpm.assign(stress=np.repeat(-5e4 * np.eye(3)[None], len(O.bodies), axis=0))
	solver.boundaries = [MpmBoundary(max=(-3, inf, inf), fix='xy'), MpmBoundary(min=(3, -inf, -inf), fix='xy'), MpmBoundary(max=(inf, -3, inf), fix='xy'), MpmBoundary(min=(-inf, 3, -inf), fix='xy')]
	along, middle = np.array([np.cos(angle), np.sin(angle)]), np.array([0.03, 0.02])
	ends = middle - along, middle + along
	wall = O.bodies[O.bodies.append(utils.facet([(*ends[0], 0), (*ends[1], 0), (*ends[0], 1)], material='rigid', fixed=True))]
	solver.contacts = [MpmContact(adhesion=2e3)]
	O.run(1, wait=True)
	wall.state.vel = (*(-1e-3 * along), 0)
	O.run(3, wait=True)
	force = mpm.contactForces(solver)[1][:, :2]
	normal = force @ (-along[1], along[0])
	found.append([[-(force[side * normal > 0] @ along).sum() / 4e3, side * normal[side * normal > 0].sum() / 1e5] for side in (1, -1)])
print(json.dumps(found))
''').result
	adhesion, pressure = np.moveaxis(found, -1, 0)
	assert (abs(adhesion - 1) < 0.01).all() and (abs(pressure - 1) < 0.04).all(), found


def test_friction_of_a_sheet_goes_by_the_beta_method(yade):
	"""K sigma_v tan(delta) on each side, in the plane and around an axis, on cells of one and of two sizes, within 3 %: through all of the ground, whose sides bear nothing of the weight (Poisson's ratio 0)."""
	found = yade(scene + '''
found = []
for axisymmetric, cells in [(ring, cells) for ring in (False, True) for cells in sizes(ring)]:
	solver = ground(**cells, low=(0 if axisymmetric else -3, -1), high=(3, 1), axisymmetric=axisymmetric, friction=np.radians(20), young=1e8, poisson=0)
	wall = sheet(1 if axisymmetric else 0, -1)
	solver.contacts = [MpmContact()]
	O.run(1, wait=True)
	wall.state.vel = (0, -1e-3, 0)
	O.run(2, wait=True)
	shaft = 0.5 * 20e3 * 2**2 / 2 * np.tan(np.radians(20)) * (2 * np.pi if axisymmetric else 1)
	found.append([-side[1] / shaft for side in sides(solver)])
print(json.dumps(found))
''').result
	assert all(abs(part - 1) < 0.03 for pair in found for part in pair), found


def test_soil_leaves_one_side_of_a_plank_alone(yade):
	"""A Box of a fifth of a cell that is pushed to the right comes off the soil on its left, which keeps its shape there."""
	left, right, moved = yade(scene + '''
solver = ground(K0=0.05)
wall = plank(0.125, -1, 0.05)
for i in [b.id for b in O.bodies if isinstance(b.shape, type(O.bodies[0].shape)) and abs(b.state.pos[0] - 0.125) < 0.025]: O.bodies.erase(i)
solver.contacts = [MpmContact()]
O.run(1, wait=True)
before = mpm.arrays()['pos'].copy()
wall.state.vel = (0.01, 0, 0)
O.run(3, wait=True)
way = mpm.arrays()['pos'] - before
beside = abs(before[:, 1] - 0.5) < 0.2
near = [float(abs(way[beside & (side * (before[:, 0] - 0.125) > 0.05) & (side * (before[:, 0] - 0.125) < 0.3)][:, 0]).mean()) for side in (-1, 1)]
print(json.dumps([*near, wall.state.pos[0] - 0.125]))
''').result
	assert abs(moved - 0.03) < 1e-9 and right > 0.8 * moved and left < 0.05 * moved


@pytest.mark.parametrize('halvings', [0, 1])
def test_both_sides_of_a_wall_that_turns_about_its_toe(yade, halvings):
	"""The example, on coarser cells, smooth: Rankine, also where cells are larger away from the wall."""
	run = yade(root / 'examples' / 'earth_pressure' / 'sheet.py', '--cells', 10, '--turn', 0.005, '--steps', 10, '--halvings', halvings)
	off = [abs(float(line.split('(')[1].split('%')[0])) for line in run.stdout.splitlines() if line.startswith(('active', 'passive'))]
	assert len(off) == 2 and off[0] < 8 and off[1] < 5, run.stdout
	assert (run.folder / 'out/sheet/sheet.png').stat().st_size > 20000


# settings, and what the warning names
oneBody = {
        'dict()': '',
        'dict(gridMore=dict(refinements=[MpmRefinement(min=(-inf, 0, -inf), max=(inf, inf, inf))]))': '',
        'dict(more=[MpmBeam(line=[(-1, 1), (-1, 0.5)], axialStiffness=1e9, bendingStiffness=1e6)])': 'loads[0]',
        'dict(nonlocalLength=0.5)': 'nonlocalLength',
        'dict(pressureRelaxation=True, fBar=True)': 'pressureRelaxation',
}


def test_what_keeps_soil_whole_beside_a_sheet_is_said(yade):
	"""For each reason why soil moves as one on the two sides of a sheet; not where that is parted."""
	run = yade(scene + '''
import sys
def said(more=(), **settings):
	solver = ground(**settings)
	sheet(0, 0)
	solver.loads = list(more)
	solver.contacts = [MpmContact()]
	O.bodies[-1].state.vel = (1e-3, 0, 0)
	O.run(2, wait=True)
for case in CASES:
	print('case:', case, file=sys.stderr, flush=True)
	said(**eval(case))
'''.replace('CASES', repr(list(oneBody))))
	told = dict(part.split('\n', 1) for part in run.stderr.split('case: ')[1:])
	for case, reason in oneBody.items():
		assert ('moves as one' in told[case]) == bool(reason) and reason in told[case], (case, told[case])


def test_thin_bodies_part_soil_in_explicit_steps(yade):
	"""A sheet and a thin Box that go to one side leave the soil behind them at rest, and push as in Newmark's steps, within 10 %; a sheet that goes down has the whole cap of the shear stress on both sides, within 2 %."""
	pushes, rubbed = yade(scene + '''
def thrown(make, scheme, dt, velocity, time, friction=0, **settings):
	solver = ground(K0=1, engine=MpmDynamicEngine, scheme=scheme, friction=friction)
	if not friction:
		solver.gravity, solver.gravityCurve = (0, 0, 0), []
		mpm.assign(stress=np.zeros((len(O.bodies), 3, 3)))
	wall = make()
	wall.state.vel, solver.contacts, O.dt = velocity, [MpmContact(**settings)], dt
	O.run(round(time / dt), wait=True)
	points = mpm.arrays()
	return [abs((points['pos'] - points['pos0'])[points['pos0'][:, 0] < 0.03]).max(), solver.contacts[0].forces[0][0], solver.plotData()['momentum_x']]

pushes = [[thrown(make, scheme, dt, (0.2, 0, 0), 0.02) for scheme, dt in (('explicit', 1e-4), ('newmark', 2e-3))] for make in (lambda: sheet(0.03, -1), lambda: plank(0.03, -1, 0.05))]
thrown(lambda: sheet(0, 0), 'explicit', 1e-4, (0, -0.2, 0), 0.005, 1.2, adhesion=2e3)
print(json.dumps([pushes, [side[1] for side in sides(O.engines[0])]]))
''').result
	for explicit, newmark in np.array(pushes):
		assert explicit[0] < 1e-9 and newmark[0] < 1e-9, pushes
		assert abs(explicit[1:] / newmark[1:] - 1).max() < 0.1, pushes
	assert np.allclose(rubbed, -2e3, rtol=0.02), rubbed


def test_water_does_not_pass_thin_bodies_unseen(yade):
	"""In time steps the pressure to the left of a sheet stays there; where soil is not parted MpmFlow is refused."""
	pressures, said = yade(scene + '''
def wet(toe=-1, **settings):
	solver = ground(K0=1, flow=MpmFlow(unitWeight=1e4, bulkModulus=1e7), engine=MpmDynamicEngine, **settings)
	solver.gravity, solver.gravityCurve = (0, 0, 0), []
	O.materials[0].conductivity, O.materials[0].porosity = 1e-4, 0.4
	isLeft = mpm.arrays()['pos'][:, 0] < 0
	mpm.assign(stress=np.zeros((len(O.bodies), 3, 3)), excessPressure=np.where(isLeft, 1e4, 0))
	sheet(0, toe)
	solver.contacts, O.dt = [MpmContact()], 0.01
	return isLeft
isLeft = wet()
O.run(5, wait=True)
pressure = mpm.arrays()['excessPressure']
wet(fBar=True, pressureRelaxation=True)
try: O.run(1, wait=True)
except RuntimeError as error: said = str(error)
print(json.dumps([[pressure[isLeft].max(), abs(pressure[~isLeft]).max()], said]))
''').result
	assert pressures[0] > 2e3 and pressures[1] < 0.01 * 1e4, pressures
	assert '(Facet)' in said and 'pressureRelaxation' in said and 'MpmFlow' in said, said


in3D = scene + '''
from yade import pack

def block(refinements=(), h=0.25, young=1e7, poisson=0.3, friction=0, low=(-1, -1, -0.5), high=(1, 1, 0.5)):
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=2000, label='soil'))
	O.materials.append(FrictMat(frictionAngle=friction, density=2600, label='rigid'))
	grid = MpmGrid(cellSize=h, dim=3, refinements=list(refinements))
	O.bodies.append(mpm.fill(pack.inAlignedBox(low, high), grid, 2, 'soil'))
	held = []
	for a in range(3):
		for side, at in ('max', low), ('min', high):
			limit = [inf if side == 'max' else -inf] * 3
			limit[a] = at[a]
			held.append(MpmBoundary(**{side: tuple(limit)}, fix='xyz'[a]))
	solver = MpmImplicitEngine(grid=grid, boundaries=held, verbosity=0)
	O.engines, O.dt = [solver], 1
	return solver

def facets(*corners): return [O.bodies.append(utils.facet(three, material='rigid', fixed=True)) for three in corners]
'''


def test_a_plate_of_facets_between_two_soils_in_3d(yade):
	"""Their unequal pressures stay as they are, and press on it, to 1e-6, on cells of one and of two sizes; a Box of a tenth of a cell bears them, too, within 2 %."""
	plate, box = yade(in3D + '''
found = []
for refinements, isBox in ([], False), ([MpmRefinement(min=(-0.2, -0.2, -inf), max=(0.2, 0.2, 0.1), halvings=1)], False), ([], True):
	solver = block(refinements)
	mpm.assign(stress=np.where(mpm.arrays()['pos'][:, 0] < 0, -1e4, -3e4)[:, None, None] * np.eye(3))
	before = mpm.arrays()['stress'].copy()
	if isBox: O.bodies.append(utils.box((0, 0, 0), (0.0125, 1, 0.5), material='rigid', fixed=True))
	else: facets(((0, -1, -0.5), (0, 1, -0.5), (0, -1, 0.5)), ((0, 1, -0.5), (0, 1, 0.5), (0, -1, 0.5)))
	solver.contacts = [MpmContact(stiffness=100 if isBox else 1e6)]
	O.run(2, wait=True)
	found.append([0 if isBox else abs(mpm.arrays()['stress'] - before).max() / 3e4, *(abs(side[0]) / (2 * p) - 1 for side, p in zip(sides(solver), (1e4, 3e4)))])
print(json.dumps([found[:2], found[2]]))
''').result
	assert np.abs(plate).max() < 1e-6, plate
	assert np.abs(box).max() < 0.02, box


def test_friction_of_a_skirt_of_facets_in_3d(yade):
	"""K sigma_v tan(delta) on the facets of a quarter of a skirt, oblique to the grid with four cells over its radius, on a smooth base: inside and outside within 3 % each; it stays so while the skirt slides."""
	found = yade(in3D + '''
solver = block(young=1e8, poisson=0, friction=np.radians(20), low=(0, 0, -1), high=(2, 2, 1))
solver.boundaries = [*solver.boundaries[:4], MpmBoundary(max=(inf, inf, -1), fix='z')]
solver.gravity, solver.gravityCurve = (0, 0, -10), [(0, 1)]
mpm.geostatic(K0=0.5)
at = lambda i, z: (np.cos(i * np.pi / 16), np.sin(i * np.pi / 16), z)
skirt = [number for i in range(8) for number in facets((at(i, -1), at(i + 1, -1), at(i, 1.25)), (at(i, 1.25), at(i + 1, -1), at(i + 1, 1.25)))]
solver.contacts = [MpmContact()]
O.run(1, wait=True)
for i in skirt: O.bodies[i].state.vel = (0, 0, -1e-3)
found = []
for _ in range(3):
	O.run(1, wait=True)
	where, force = mpm.contactForces(solver)
	isOutside = (force * where)[:, :2].sum(axis=1) > 0
	shaft = 16 * np.sin(np.pi / 32) * 0.5 * 2e4 * 2**2 / 2 * np.tan(np.radians(20))
	found.append([-force[which, 2].sum() / shaft for which in (~isOutside, isOutside)])
print(json.dumps(found))
''').result
	assert (abs(np.array(found) - 1) < 0.03).all(), found


vane = '''
def torque(contact): return abs(sum(np.array(T)[2] + np.cross(np.array(O.bodies[i].state.pos), np.array(F))[2] for i, T, F in zip(contact.bodies, contact.torques, contact.forces)))

def turn(dim, halvings, steps, height=1., c=1e4, p=5e4, wide=2.5, cells=4):
	"""Torque of a vane of radius 1 over 2 pi R^2 c_u per metre, after each step of a tenth of a smallest cell at its edges. Cells are halved all around."""
	O.reset()
	O.materials.append(MpmTrescaMat(young=2 * 1.49 * 200 * c, poisson=0.49, density=1, undrainedStrength=c, label='clay'))
	O.materials.append(FrictMat(density=2600, label='rigid'))
	ring = [(np.cos(a), np.sin(a)) for a in np.linspace(0, 2 * np.pi, 64, endpoint=False)]
	grid = MpmGrid(cellSize=1 / cells, dim=dim, refinements=[MpmRefinement(min=(x - 0.1, y - 0.1, -inf), max=(x + 0.1, y + 0.1, inf), halvings=halvings) for x, y in ring])
	O.bodies.append(mpm.fill(pack.inAlignedBox((-wide, -wide, 0 if dim == 3 else -1), (wide, wide, height)), grid, 2, 'clay'))
	mpm.assign(stress=np.repeat(-p * np.eye(3)[None], len(O.bodies), axis=0))
	blades = []
	for x, y in ring[::16]:
		corners = [((0, 0, 0), (x, y, 0), (x, y, height)), ((0, 0, 0), (x, y, height), (0, 0, height))] if dim == 3 else [((0, 0, 0), (x, y, 0), (x / 2, y / 2, 1))]
		blades += facets(*corners)
	contact = MpmContact(friction=0, adhesion=c, stiffness=10)
	held = [MpmBoundary(max=(-wide, inf, inf), fix='x'), MpmBoundary(min=(wide, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -wide, inf), fix='y'), MpmBoundary(min=(-inf, wide, -inf), fix='y')]
	if dim == 3: held += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, height), fix='z')]
	solver = MpmImplicitEngine(grid=grid, fBar=True, boundaries=held, contacts=[contact], newton=MpmNewton(minStep=1 / 64, tolerance=1e-4), verbosity=0)
	O.engines, O.dt, found = [solver], 1, []
	O.run(1, wait=True)
	contact.friction = 1.37
	angle = 0.1 / cells / 2**halvings
	for _ in range(steps):
		for i in blades:
			x, y, _ = O.bodies[i].state.pos
			O.bodies[i].state.angVel, O.bodies[i].state.vel = (0, 0, angle), (np.cos(angle) * x - np.sin(angle) * y - x, np.sin(angle) * x + np.cos(angle) * y - y, 0)
		O.run(1, wait=True)
		found.append(torque(contact) / (2 * np.pi * c * (height if dim == 3 else 1)))
	return found
'''


def test_near_boxes_part_soil_in_3d(yade):
	"""Two plates a cell apart, and one that ends at another one: soil behind that which is pulled off stays where it is, soil before it is pushed."""
	found = yade(in3D + '''
def moved(isTee):
	solver = block(low=(-2, -1, -1), high=(2, 1, 1), h=0.5)
	solver.boundaries = [MpmBoundary(max=(-2, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1, inf), fix='xyz')]
	plate = lambda middle, half: O.bodies[O.bodies.append(utils.box(middle, half, material='rigid', fixed=True))]
	plate((-0.5, 0, 0), (0.02, 1.5, 1.5))
	second, axis = (plate((0.75, 0, 0), (1.25, 1.5, 0.02)), 2) if isTee else (plate((0, 0, 0), (0.02, 1.5, 1.5)), 0)
	solver.contacts = [MpmContact()]
	second.state.vel = 5e-3 * np.eye(3)[axis]
	start = mpm.arrays()['pos'].copy()
	O.run(1, wait=True)
	way, isAbove = (mpm.arrays()['pos'] - start)[:, axis] / 5e-3, (start[:, 1] > -0.5) & (start[:, 0] > -0.5)
	beside = start[:, axis]
	return abs(way[(beside < 0) & isAbove]).max(), way[(beside > 0) & (beside < 0.5) & isAbove].min(), abs(way[start[:, 0] < -0.5]).max()
print(json.dumps([moved(False), moved(True)]))
''').result
	assert all(behind < 1e-9 and before > 0.75 and beyond < 1e-9 for behind, before, beyond in found), found


def test_the_torque_of_a_vane(yade):
	"""2 pi R^2 c_u per metre within 3 %, as soon as clay has yielded, where the cells around are R / 64; in 3D on cells of R / 16 within 3 % of what these make of it, (1 + h / R)^2."""
	plane, space = yade(in3D + vane + '''
print(json.dumps([turn(2, 4, 12), turn(3, 2, 4, height=0.25)]))
''').result
	assert all(abs(part - 1) < 0.03 for part in plane[3:]), plane
	assert all(abs(part / (17 / 16)**2 - 1) < 0.03 for part in space[2:]), space


def test_a_wall_of_facets_that_turns_in_3d_as_in_the_plane(yade):
	"""A slab of two cells with a smooth wall that turns about its toe: active and passive force as in the plane within 3 %."""
	plane, space = yade(in3D + '''
def turned(dim, width=0.25, turn=-1e-3):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=1e8, poisson=0.3, density=2000, cohesion=100, frictionAngle=np.radians(30), dilationAngle=np.radians(30), label='sand'))
	O.materials.append(FrictMat(frictionAngle=0, density=2600, label='rigid'))
	grid = MpmGrid(cellSize=0.125, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((-4, -1, 0 if dim == 3 else -1), (4, 1.5, width)), grid, 2, 'sand'))
	held = [MpmBoundary(max=(-4, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1, inf), fix='xyz'[:dim])]
	if dim == 3: held += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], boundaries=held, fBar=True, verbosity=0)
	O.engines, O.dt = [solver], 1
	mpm.geostatic(K0=0.5)
	wall = facets(*[((0, 0, 0), (0, 1.75, 0), (0, 0, width)), ((0, 1.75, 0), (0, 1.75, width), (0, 0, width))][:dim - 1])
	solver.contacts = [MpmContact()]
	O.run(1, wait=True)
	for _ in range(5):
		for i in wall:
			x, y, _ = O.bodies[i].state.pos
			O.bodies[i].state.angVel, O.bodies[i].state.vel = (0, 0, turn), (np.cos(turn) * x - np.sin(turn) * y - x, np.sin(turn) * x + np.cos(turn) * y - y, 0)
		O.run(1, wait=True)
	return [abs(side[0]) / (width if dim == 3 else 1) for side in sides(solver)]

print(json.dumps([turned(2), turned(3)]))
''').result
	assert all(abs(a / b - 1) < 0.03 for a, b in zip(space, plane)) and plane[1] > 4 * plane[0], (plane, space)
