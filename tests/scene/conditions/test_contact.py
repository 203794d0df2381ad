# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of YADE that touch the soil: who moves them, what they feel, what is kept, and what is refused."""
import math

import numpy as np
import pytest
from conftest import outcomesOf
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_QUAD
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

scene = '''
import json
import numpy as np
from yade import mpm, pack, utils

def block(dim=2, poisson=0, weight=1, boundaries=None, contact={}, size=1, axisymmetric=False, **engine):
	"""A body of size x size [x size] m, E = 1 MPa, on rollers below and on the left, that rigid bodies of material 'rigid' may touch."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=poisson, density=weight, label='soil'))
	O.materials.append(FrictMat(frictionAngle=radians(20), density=2600, young=1e7, label='rigid'))
	grid = MpmGrid(cellSize=0.25, dim=dim, axisymmetric=axisymmetric)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (size, size, size if dim == 3 else 1)), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')] + ([MpmBoundary(max=(inf, inf, 0), fix='z')] if dim == 3 else [])
	contact = MpmContact(**dict(dict(friction=0) | contact))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides if boundaries is None else boundaries, contacts=[contact], label='solver', verbosity=0, **engine)]
	O.dt = 0.1
	return contact

def add(body, velocity=(0, 0, 0), spin=(0, 0, 0)):
	i = O.bodies.append(body)
	O.bodies[i].state.vel, O.bodies[i].state.angVel = velocity, spin
	return O.bodies[i]

def plate(kind='box', y=1, velocity=(0, -0.25, 0)):
	if kind == 'box': return add(utils.box((0.5, y + 0.5, 0.5), (2, 0.5, 2), material='rigid', fixed=True), velocity)
	if kind == 'wall': return add(utils.wall(y, axis=1, sense=-1, material='rigid'), velocity)
	if kind == 'walls': return add(utils.wall(y, axis=1, sense=0, material='rigid'), velocity)
	return add(utils.facet([(-9, y, -9), (9, y, -9), (0, y, 9)], material='rigid', fixed=True), velocity)

def force(): return solver.contacts[0].forces[0]
'''


def test_a_plate_of_any_kind_presses_alike(yade):
	"""To 0.75 of the height, nu = 0: E ln l / l per area; whether the engine moves the plate or YADE does."""
	results = yade(scene + '''
found = []
for kind, dim in ('box', 2), ('wall', 2), ('walls', 2), ('facet', 2), ('box', 3):
	block(dim)
	moving = plate(kind)
	before = moving.state.pos[1]
	O.run(10, wait=True)
	data = solver.plotData()
	found.append([force()[1], before - moving.state.pos[1], data['reaction_y'], data['contact0_y'], data['body%d_y' % moving.id], data['contact0_touching']])
block()
moving = plate()
O.engines += [NewtonIntegrator(damping=0)]
O.run(11, wait=True)
print(json.dumps([found, [force()[1], moving.state.pos[1], O.time]]))
''').result
	exact = -1e6 * math.log(0.75) / 0.75
	for kind, found in zip(['box', 'wall', 'walls', 'facet', '3D box'], results[0], strict=True):
		assert abs(found[0] / exact - 1) < 0.01 and abs(found[1] - 0.25) < 1e-12
		assert abs(found[0] / found[2] - 1) < 1e-5 and found[3] == found[4] == found[0] and found[5] > 8
		assert abs(found[0] / results[0][0][0] - 1) < 1e-6, found[0] / results[0][0][0] - 1
	assert abs(results[1][0] / results[0][0][0] - 1) < 1e-5  # the soil follows YADE's positions: those of the start of the iteration


def test_a_mesh_of_facets_presses_and_rubs_as_a_box_does(yade):
	"""In 3D, with edges and corners of triangles over the soil, by one triangle's edge or by many."""
	results = yade(scene + '''
def mesh(cuts, velocity):
	x = np.linspace(-0.5, 1.5, cuts + 1)
	for i in range(cuts):
		for j in range(cuts):
			a, b, c, d = (x[i], 1, x[j]), (x[i + 1], 1, x[j]), (x[i + 1], 1, x[j + 1]), (x[i], 1, x[j + 1])
			for corners in (a, b, c), (a, c, d): add(utils.facet(corners, material='rigid', fixed=True), velocity)
found = []
for cuts in 0, 1, 5:
	contact = block(3, contact=dict(friction=radians(20)))
	if cuts: mesh(cuts, (0.05, -0.1, 0.02))
	else: plate(velocity=(0.05, -0.1, 0.02))
	O.run(5, wait=True)
	found.append(np.sum(contact.forces, axis=0).tolist() + [sum(contact.touching), sum(contact.slipping)])
print(json.dumps(found))
''').result
	box = results[0]
	assert box[1] > 5e4 and abs(math.hypot(box[0], box[2]) / box[1] - math.tan(math.radians(20))) < 0.05
	for mesh in results[1:]:
		assert max(abs(a - b) for a, b in zip(mesh[:3], box)) < 5e-5 * box[1] and mesh[3] == mesh[4]  # places of triangles are at other places of cells


def test_a_failed_step_leaves_the_bodies_where_the_soil_is(yade):
	results = yade(scene + '''
contact = block(newton=MpmNewton(minStep=0.25), contact=dict(stiffness=0.05))
moving = plate()
try: O.run(10, wait=True)
except RuntimeError as error: text = str(error)
height = 1.5 - moving.state.pos[1]
print(json.dumps([text, height, solver.loadTime, contact.poses if hasattr(contact, 'poses') else None, solver.report()['failure']]))
''').result
	assert 'would get soil inside of it, which moves' in results[0]
	assert results[4] == 'penetrated' and 0 < results[2] < 1
	assert abs(results[1] - 0.25 * results[2]) < 1e-12


def test_friction_is_kept_in_files(yade):
	"""A block dragged by a rough plate: a run that is saved and loaded between is the same, bit for bit."""
	results = yade(scene + '''
def finish():
	O.run(4, wait=True)
	contact = solver.contacts[0]
	return [mpm.arrays()['pos'].tolist(), [list(f) for f in contact.forces], list(contact.slipping), list(contact.touching), O.bodies[-1].state.pos[0]]
block(contact=dict(friction=radians(20)))
plate(velocity=(0.02, -0.02, 0))
O.run(4, wait=True)
mpm.save('between.xml.gz')
straight = finish()
O.load('between.xml.gz')
print(json.dumps([straight == finish(), straight[1:]]))
''').result
	assert results[0]
	(force, ), slipping, touching, moved = results[1]
	assert force[0] < 0 < force[1] and 0 < slipping[0] <= touching[0] and abs(moved - (0.5 + 0.8 * 0.02)) < 1e-12
	assert abs(force[0]) <= math.tan(math.radians(20)) * force[1] * (1 + 1e-9)


def test_what_corners_have_touched_in_a_file_of_earlier_revisions_is_refused(yade):
	"""They kept 17 numbers of a corner, the first of them a point's id; a new MpmContact goes on."""
	results = yade(scene + '''
block()
plate(velocity=(0, -0.02, 0))
O.run(2, wait=True)
mpm.save('now.xml')
text = open('now.xml').read()
first, middle, last = text.partition('<records>')[0], text.partition('<records>')[2].partition('</records>')[0], text.partition('</records>')[2]
count = middle.count('<item>')
old = [7, 1, 64] + [0.5] * 14
assert count > 16 and (count - 1) % 16 == 0
items = ''.join(f'<item>{x:.17e}</item>' for x in old * 16)  # as many numbers as of 17 places
import re
head = re.match(r'\\s*<count>\\d+</count>(.*?)<item>', middle, re.S).group(1)
open('then.xml', 'w').write(first + f'<records><count>{len(old) * 16}</count>{head}{items}</records>' + last)
O.load('then.xml')
try: O.step()
except ValueError as error: refused = str(error)
O.engines[0].contacts = [MpmContact(friction=0)]
O.step()
print(json.dumps([refused, O.engines[0].contacts[0].touching[0]]))
''').result
	assert 'is that of an earlier revision' in results[0] and 'solver.contacts = [MpmContact(...)]' in results[0] and results[1] > 0


slope = '''
def onSlope(degrees, mu):
	"""A block on a facet that is inclined, cut along it, under its weight."""
	b = radians(degrees)
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=0.2, density=2000, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	turned = lambda x, y: (x * cos(b) - y * sin(b), x * sin(b) + y * cos(b))
	grid = MpmGrid(cellSize=0.25, dim=2)
	O.bodies.append(mpm.fill(mpm.polygon([turned(0, 0), turned(2, 0), turned(2, 1), turned(0, 1)]), grid, 2, 'soil'))
	ends = [turned(-2, 0), turned(5, 0)]
	add(utils.facet([ends[0] + (-9, ), ends[1] + (-9, ), tuple(np.mean(ends, axis=0)) + (20, )], material='rigid', fixed=True))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), contacts=[MpmContact(friction=atan(mu))], newton=MpmNewton(minStep=0.25), label='solver', verbosity=0)]
	O.dt = 0.5
	O.run(2, wait=True)
	return [list(force()), 10 * mpm.arrays()['volume'].sum() * 2000]
'''


def test_a_block_on_a_slope_slides_beyond_the_angle_of_friction(yade):
	results = yade(scene + slope + '''
held = onSlope(20, tan(radians(20)) / 0.98)
try: onSlope(20, tan(radians(20)) / 1.02)
except RuntimeError as error: text = str(error)
print(json.dumps([held, text, solver.report()['failure']]))
''').result
	(x, y, _), weight = results[0]
	assert abs(y / -weight - 1) < 0.01 and abs(x / weight) < 1e-6
	assert 'only contact, which slips or comes off there, would hold' in results[1] and results[2] == 'slides'


def test_clumps_are_moved_and_felt_as_one(yade):
	results = yade(scene + '''
contact = block(dim=3)
clump, members = O.bodies.appendClumped([utils.sphere((0.3, 1.2, 0.5), 0.2, material='rigid'), utils.sphere((0.7, 1.2, 0.5), 0.2, material='rigid')])
O.bodies[clump].state.vel = (0, -0.2, 0)
O.bodies[clump].state.angVel = (0, 0, 0.1)
between = O.bodies[members[0]].state.pos - O.bodies[members[1]].state.pos
O.run(2, wait=True)
turned = O.bodies[members[0]].state.pos - O.bodies[members[1]].state.pos
print(json.dumps([list(contact.bodies), clump, len(contact.forces), contact.forces[0][1], contact.torques[0][2], turned.norm() / between.norm(), turned[1] / turned[0], O.bodies[clump].state.pos[1]]))
''').result
	assert results[0] == [results[1]] and results[2] == 1 and results[3] > 0
	assert abs(results[5] - 1) < 1e-12 and abs(results[6] - math.tan(0.02)) < 1e-9 and abs(results[7] - 1.16) < 1e-12


free = '''
def dropped(N, stiffness=20, damping=0.0, seconds=0.3):
	"""A sphere on a block, which YADE moves; the soil's step is made every N iterations."""
	contact = block(dim=3, poisson=0.2, weight=1000, contact=dict(friction=radians(20), stiffness=stiffness), iterPeriod=N)
	O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		*O.engines, NewtonIntegrator(gravity=(0, -10, 0), damping=damping)]
	O.dt = 2e-4
	ball = add(utils.sphere((0.5, 1.2, 0.5), 0.2, material='rigid'))
	heights = []
	for i in range(int(round(seconds / O.dt / 50))):
		O.run(50, wait=True)
		heights.append(ball.state.pos[1] - 1.2)
	return contact, ball, heights
'''


def test_a_free_body_gains_no_energy_and_comes_to_rest(yade):
	results = yade(
	        scene + free + '''
found = []
for N in 10, 50:
	contact, ball, heights = dropped(N)
	found.append([heights, list(contact.forces[0]), list(contact.torques[0]), list(solver.reactions[1]), list(contact.impulses[0])])
contact, ball, heights = dropped(50, damping=0.7, seconds=0.6)
print(json.dumps([found, [contact.forces[0][1], 10 * ball.state.mass, solver.reactions[1][1], ball.state.vel.norm()]]))
''', timeout=200
	).result
	for heights, force, torque, reaction, impulse in results[0]:
		half = len(heights) // 2
		assert max(heights[half:]) - min(heights[half:]) < max(heights[:half]) - min(heights[:half])
		assert min(heights) > -0.05 and abs(force[1] / reaction[1] - 1) < 1e-4 and impulse[1] != 0
	force, weight, reaction, speed = results[1]
	assert abs(force / weight - 1) < 2e-2 and abs(reaction / force - 1) < 1e-5 and speed < 1e-2


def test_what_cannot_touch_is_refused(yade):
	refused = {
	        'block(); add(utils.sphere((0.5, 1.2, 0), 0.2, material="rigid")); O.engines += [NewtonIntegrator()]': ['is free to move, but on a grid with dim=2', 'dynamic=False'],
	        'block(dim=3); add(utils.sphere((0.5, 1.2, 0.5), 0.2, material="rigid")); O.engines = [ForceResetter(), NewtonIntegrator(), *O.engines]': ['must stand behind ForceResetter and before NewtonIntegrator'],
	        'block()': ['no body that could touch the soil goes with mask = -1'],
	        'block(contact=dict(mask=4)); plate()': ['mask = 4', 'section at z = 0'],
	        'block(); plate("wall").shape.axis = 2': ['section at z = 0'],
	        'block(contact=dict(friction=30))': ['MpmContact.friction = 30', 'radians(30)'],
	        'block(contact=dict(friction=-0.1))': ['MpmContact.friction = -0.1'],
	        'block(contact=dict(adhesion=-1))': ['MpmContact.adhesion = -1'],
	        'block(contact=dict(stiffness=0))': ['MpmContact.stiffness = 0'],
	        'block(); plate().material = None': ['has no material'],
	        'block(contact=dict(friction=nan)); plate().material = O.materials["soil"]': ['material'],
	        'block(); O.materials.append(ElastMat(label="elastic")); solver.contacts[0].friction = nan; plate().material = O.materials["elastic"]': ['MpmContact.friction is not given', 'is no FrictMat'],
	        'block(); add(utils.sphere((0.5, 1.2, 0), 0, material="rigid"))': ['radius = 0', 'expected finite numbers > 0'],
	        'block(); plate().shape.extents = (1, nan, 1)': ['extents = (', 'expected finite numbers > 0'],
	        'block(); plate().state.pos = (0, nan, 0)': ['expected finite numbers'],
	        'block(); plate(velocity=(0, nan, 0))': ['its velocities are not finite'],
	        'block(); plate(velocity=(0, 0, 1))': ['with dim=2 it can only move in the plane'],
	        'block(); plate().state.angVel = (0, 0, 20)': ['turns by 2.0', 'admitted is 1 rad'],
	        'block(); plate(y=0.8)': ['has the middle of a material point inside of it, at ('],
	        'block(); plate(); solver.contacts = [MpmContact(friction=0), MpmContact(friction=0)]': ['is claimed by two MpmContacts'],
	        'block(); plate(); O.engines += [MpmImplicitEngine(grid=solver.grid, mask=4, contacts=[MpmContact(friction=0)])]': ['is claimed by contacts of two engines'],
	        'block(); add(Body(shape=Cylinder(), material=O.materials["rigid"]))': ['cannot touch the soil: Sphere, Box, Facet and Wall can'],
	}
	outcomes = outcomesOf(yade.folder, scene, [statement + '; O.step()' for statement in refused])
	for statement, parts in refused.items():
		for part in parts:
			assert part in outcomes[statement + '; O.step()'][1], (statement, outcomes[statement + '; O.step()'])


def test_pictures_and_files(yade):
	"""The faces of bodies, cut into places, with what acts there: the sum is the body's force, and pressure times area its normal part."""
	run = yade(scene + '''
forces = []
def written(name):
	O.engines += [MpmVtkRecorder(fileName=name, recorders=['contacts'])]
block(contact=dict(friction=0.3))
plate(velocity=(0.01, -0.1, 0))
written('pressed-')
O.run(2, wait=True)
forces.append(list(force()))
labels = [c.get_label() for c in mpm.plot('stress_yy', fileName='plane.png').collections]
block(axisymmetric=True)
plate('facet')
written('round-')
O.run(2, wait=True)
forces.append(list(force()))
block(dim=3)
add(utils.sphere((0.5, 1.3, 0.5), 0.3, material='rigid'), (0, -0.2, 0))
plate('wall', y=1.7, velocity=(0, 0, 0))
plate('facet', y=1.6, velocity=(0, 0, 0))
written('space-')
O.run(1, wait=True)
forces.append(list(force()))
mpm.plot('stress_yy', fileName='space.png', plane=('x', 0.5))
print(json.dumps([labels, forces, len(mpm.contactForces()[0])]))
''')
	labels, forces, touching = run.result
	assert 'rigid bodies' in labels and any('contact, up to' in label and label.endswith(' kPa') for label in labels)
	assert (run.folder / 'plane.png').stat().st_size > 5000 and (run.folder / 'space.png').stat().st_size > 5000
	assert 'pressed-contacts.2.vtu' in (run.folder / 'pressed-contacts.pvd').read_text()
	for name, kind, force in zip(['pressed-contacts.2', 'round-contacts.2', 'space-contacts.1'], [VTK_LINE, VTK_LINE, VTK_QUAD], forces, strict=True):
		cells = read(run.folder / f'{name}.vtu')
		assert {cells.GetCellType(i) for i in range(cells.GetNumberOfCells())} == {kind}
		field = {name: vtk_to_numpy(cells.GetCellData().GetArray(name)) for name in ('force', 'pressure', 'shear', 'gap', 'slip', 'touches', 'slips', 'body')}
		on = field['touches'] == 1
		total = field['force'].sum(axis=0)
		if name[0] == 'r': total[0] = 0  # all around the axis
		assert np.allclose(-total, force, rtol=1e-12) and (field['gap'][on] < 1e-12).all() and not field['force'][~on].any() and (field['pressure'][on] > 0).all()
		assert on.any() and (field['slips'] <= field['touches']).all() and np.isfinite(field['slip'][on]).all()
	assert touching == on.sum() and (~on).any() and np.isnan(field['gap']).any()
	pressed = read(run.folder / 'pressed-contacts.2.vtu')
	places, pressure = vtk_to_numpy(pressed.GetPoints().GetData()).reshape(-1, 2, 3), vtk_to_numpy(pressed.GetCellData().GetArray('pressure'))
	x, y = places.mean(axis=1)[:, :2].T
	middle = (np.abs(x - 0.5) < 0.4) & (y < 1)  # middle of the lower face; there is soil all along it
	assert pressure[middle].min() > 0 and abs(np.linalg.norm(places[:, 1] - places[:, 0], axis=1) @ pressure / forces[0][1] - 1) < 0.05


def read(path):
	reader = vtkXMLUnstructuredGridReader()
	reader.SetFileName(str(path))
	reader.Update()
	return reader.GetOutput()


@pytest.mark.parametrize('axisymmetric', [True, False])
def test_round_bodies_stand_on_the_axis(yade, axisymmetric):
	"""A cylinder in a confined one of soil, nu = 0: the stress of a plate, on its area pi r^2."""
	results = yade(scene + f'''
block(axisymmetric={axisymmetric})
add(utils.box((0, 1.5, 0), (2, 0.5, 2), material='rigid', fixed=True), (0, -0.25, 0))
O.run(10, wait=True)
print(json.dumps(list(force())))
''').result
	area = math.pi if axisymmetric else 1
	assert abs(results[1] / (-1e6 * math.log(0.75) / 0.75 * area) - 1) < 0.01 and (results[0] == 0 or not axisymmetric)
