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


def test_a_sheet_rubs_on_both_sides(yade):
	"""In the plane and, as the skirt of a caisson, around an axis: the cap of the shear stress over the length in the soil, on each side within 3 % after the first millimetres."""
	found = yade(scene + '''
found = []
for axisymmetric in False, True:
	solver = ground(h=0.125, low=(0 if axisymmetric else -2, -1), axisymmetric=axisymmetric, friction=1.2, K0=1)
	wall = sheet(1 if axisymmetric else 0, 0)
	solver.contacts = [MpmContact(adhesion=2e3)]
	O.run(1, wait=True)
	wall.state.vel = (0, -2e-3, 0)
	O.run(3, wait=True)
	found.append([-side[1] / (2e3 * 1.006 * (2 * np.pi if axisymmetric else 1)) for side in sides(solver)])
print(json.dumps(found))
''').result
	assert all(abs(part - 1) < 0.03 for pair in found for part in pair), found


def test_friction_of_a_sheet_goes_by_the_beta_method(yade):
	"""K sigma_v tan(delta) on each side, in the plane and around an axis, within 3 %: through all of the ground, whose sides bear nothing of the weight (Poisson's ratio 0)."""
	found = yade(scene + '''
found = []
for axisymmetric in False, True:
	solver = ground(h=0.125, low=(0 if axisymmetric else -3, -1), high=(3, 1), axisymmetric=axisymmetric, friction=np.radians(20), young=1e8, poisson=0)
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
