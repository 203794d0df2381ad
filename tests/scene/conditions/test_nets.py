# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that deform with nodes beside the soil: YADE's GridConnection, ChainedCylinder and PFacet, moved and free."""
from conftest import outcomesOf

scene = '''
import json, warnings
import numpy as np
from yade import gridpfacet, mpm, pack, utils

def soil(low, high, h=0.25, young=1e6, density=1500, engine=MpmImplicitEngine, held=True, dim=3, **settings):
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=0.3, density=density, label='soil'))
	O.materials.append(CohFrictMat(young=1e7, poisson=0.3, density=2600, frictionAngle=0.3, normalCohesion=1e40, shearCohesion=1e40, momentRotationLaw=True, label='inner'))
	O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2600, frictionAngle=0.3, label='outer'))
	grid = MpmGrid(cellSize=h, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox(low, high), grid, 2, 'soil'))
	for body in O.bodies: body.groupMask = 2
	base = [inf, inf, inf]
	base[dim - 1] = low[dim - 1]
	settings.setdefault('contacts', [MpmContact(friction=0.3, mask=1)])
	solver = engine(grid=grid, boundaries=[MpmBoundary(max=base, fix='xyz'[:dim])] if held else [], verbosity=0, **settings)
	inner = InteractionLoop([Ig2_GridNode_GridNode_GridNodeGeom6D(), Ig2_Sphere_PFacet_ScGridCoGeom()],
		[Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True), Ip2_FrictMat_FrictMat_FrictPhys()],
		[Law2_ScGeom6D_CohFrictPhys_CohesionMoment(), Law2_ScGridCoGeom_FrictPhys_CundallStrack()])
	O.engines, O.dt = [inner, solver], 0.1
	return solver

def line(vertices, radius):
	nodes, members = [], []
	gridpfacet.cylinderConnection(vertices, radius, nodes, members, intMaterial='inner', extMaterial='outer', fixed=True)
	return nodes, members

def membrane(n, spacing, radius, z=0):
	"""A square of n x n nodes that is held at its edges; ids of the nodes by row and column."""
	ids = {}
	for i in range(n):
		for j in range(n):
			node = gridpfacet.gridNode((spacing * i, spacing * j, z), radius, material='inner', fixed=i in (0, n - 1) or j in (0, n - 1))
			ids[i, j] = O.bodies.append(node)
			node.groupMask = 1  # that of the integrator
	for i, j in ids:
		for other in (i + 1, j), (i, j + 1), (i + 1, j + 1):
			if other in ids: O.bodies.append(gridpfacet.gridConnection(ids[i, j], ids[other], radius, material='outer'))
	for i in range(n - 1):
		for j in range(n - 1):
			for corners in ((i, j), (i + 1, j), (i + 1, j + 1)), ((i, j), (i + 1, j + 1), (i, j + 1)):
				O.bodies.append(gridpfacet.pfacet(*[ids[c] for c in corners], material='outer'))
	return ids

def forces(solver): return [list(f) for f in solver.contacts[0].forces]
'''


def test_a_cylinder_presses_as_a_sphere_in_the_plane_does(yade):
	"""Between smooth sides soil before a straight line of cylinders deforms in the plane; the force of its nodes is what the base bears, and there is a mean of their moments."""
	results = yade(scene + '''
solver = soil((0, 0, 0), (2, 0.5, 1), newton=MpmNewton(tolerance=1e-9))
solver.boundaries = list(solver.boundaries) + [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 0.5, -inf), fix='y')]
nodes, members = line([(1, -1 + 0.75 * i, 1.3) for i in range(5)], 0.3)
for i in nodes: O.bodies[i].state.vel = (0.02, 0, -0.1)
O.run(8, wait=True)
contact = solver.contacts[0]
chain = [np.sum(contact.forces, axis=0).tolist(), solver.plotData()['reaction_x'], solver.plotData()['reaction_z'], list(contact.bodies) == nodes, [k for k in solver.plotData() if k.startswith('body')], sum(contact.touching)]

solver = soil((0, 0, -1), (2, 1, 1), dim=2, newton=MpmNewton(tolerance=1e-9))
ball = O.bodies[O.bodies.append(utils.sphere((1, 1.3, 0), 0.3, material='outer', fixed=True))]
ball.state.vel = (0.02, -0.1, 0)
O.run(8, wait=True)
print(json.dumps([chain, forces(solver)[0]]))
''').result
	(force, x, z, areNodes, columns, touching), plane = results
	assert plane[1] > 5e4 and abs(force[2] / 0.5 / plane[1] - 1) < 2e-3 and abs(force[0] / 0.5 / plane[0] - 1) < 1e-2
	assert abs(force[0] - x) + abs(force[2] - z) < 1e-6 * z
	assert areNodes and not columns and touching > 10


def test_a_membrane_catches_soil_and_a_grain(yade):
	"""Soil and grain fall on a net of PFacets, which sags and bears both; and what the soil has lost of its momentum its nodes have got, load step by load step."""
	results = yade(scene + '''
solver = soil((0.2, 0.2, 0.02), (0.6, 0.6, 0.22), h=0.2, young=2e5, engine=MpmDynamicEngine, held=False, gravity=(0, 0, -9.81), iterPeriod=4, contacts=[MpmContact(friction=0.3, mask=1, stiffness=10)], newton=MpmNewton(tolerance=1e-9))
ids = membrane(5, 0.2, 0.01)
grain = O.bodies[O.bodies.append(utils.sphere((0.12, 0.06, 0.08), 0.05, material='outer'))]
grain.groupMask = 5
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_PFacet_Aabb()])] + O.engines + [NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.3, mask=5)]
solver.contacts[0].mask = 1
O.dt = 2.5e-4
impulse, off = np.zeros(3), 0
mass = 1500 * 0.4 * 0.4 * 0.2
O.run(4, wait=True)  # of which the first load step has one iteration only
for step in range(200):
	before = mass * mpm.arrays()['velocity'].mean(axis=0)
	O.run(4, wait=True)
	change = mass * mpm.arrays()['velocity'].mean(axis=0) - before
	off = max(off, np.abs(change + np.sum(solver.contacts[0].forces, axis=0) * 1e-3 - mass * np.array([0, 0, -9.81]) * 1e-3).max())
print(json.dumps([off / (mass * 9.81e-3), O.bodies[ids[2, 2]].state.pos[2], mpm.arrays()['pos'][:, 2].min(), grain.state.pos[2], sum(solver.contacts[0].touching)]))
''').result
	off, middle, lowest, grain, touching = results
	assert off < 1e-6
	assert -0.2 < middle < -0.02 and lowest > middle and grain > -0.1 and touching > 0


def test_nets_go_on_from_a_saved_scene_to_the_bit(yade):
	results = yade(scene + '''
def run(isSaved):
	solver = soil((0, 0, 0), (0.8, 0.8, 0.4), h=0.2)
	ids = membrane(3, 0.4, 0.01, z=0.41)
	for i in ids.values(): O.bodies[i].state.vel = (0.05, 0, -0.1 - 0.05 * (i == ids[1, 1]))
	O.run(2, wait=True)
	if isSaved:
		mpm.save('between.xml')
		O.load('between.xml')
		solver = O.engines[-1]
	O.run(2, wait=True)
	return [forces(solver), mpm.arrays()['pos'].tolist()]
straight, loaded = run(False), run(True)
print(json.dumps([straight == loaded, np.sum(straight[0], axis=0).tolist()]))
''').result
	assert results[0] and results[1][2] > 1e3


def test_chained_cylinders_share_as_grid_connections_do(yade):
	results = yade(scene + '''
warnings.simplefilter('ignore')
places = [Vector3(-0.2 + 0.35 * i, 0.5, 0.75) for i in range(5)]
def pressed(isChained):
	solver = soil((0, 0, 0), (1, 1, 0.5))
	if isChained:
		ids = [gridpfacet.chainedCylinder(begin=a, end=b, radius=0.25, fixed=True, material='outer').id for a, b in zip(places, places[1:] + places[-1:])]
		for i in ids: O.bodies[i].state.refPos = O.bodies[i].state.pos
	else: ids = line(places, 0.25)[0]
	for i in ids: O.bodies[i].state.vel = (0, 0, -0.1)
	O.run(3, wait=True)
	return forces(solver)
print(json.dumps([pressed(False), pressed(True)]))
''').result
	grid, chain = results
	assert len(grid) == len(chain) == 5 and grid[1][2] > 1e3
	for a, b in zip(grid, chain):
		assert all(abs(x - y) < 1e-6 * grid[1][2] for x, y in zip(a, b)), (a, b)


def test_what_cannot_touch_is_refused_by_name(yade):
	ground = 's = soil((0, 0, 0), (0.5, 0.5, 0.25)); '
	member = ground + 'n, m = line([(0, 0, 0.5), (0.5, 0, 0.5)], 0.2); '
	net = ground + 'n = membrane(2, 0.5, 0.01, z=0.4); pf = [b for b in O.bodies if isinstance(b.shape, PFacet)]; '
	refused = {
	        's = soil((0, 0, -1), (0.5, 0.5, 1), dim=2); n, m = line([(0, 0.8, 0), (0.5, 0.8, 0)], 0.2); O.step()': ['a GridConnection', 'in 3D only', 'MpmBeam'],
	        member + 'O.bodies[n[1]].state.pos = O.bodies[n[0]].state.pos; O.step()': ['are in one place, so that it has no length'],
	        member + 'O.bodies[m[0]].shape.radius = 0; O.step()': ['its radius = 0'],
	        member + 'O.bodies[n[1]].state.pos = (nan, 0, 0); O.step()': ['expected finite numbers'],
	        member + 'O.bodies.erase(n[1]); O.step()': ['has a node that is none of O.bodies'],
	        member + 'O.bodies[m[0]].shape.cellDist = (1, 0, 0); O.step()': ['nodes of different periods'],
	        net + 'O.bodies[n[1, 1]].state.pos = (0.25, 0, 0.4); O.step()': ['its nodes do not span a triangle'],
	        net + 'pf[0].shape.radius = -1; O.step()': ['a PFacet', 'its radius = -1'],
	        member + 's.contacts[0].implicit = True; O.bodies[n[0]].dynamic = True; O.step()': ['MpmContact.implicit', 'is a node of body', 'moved by YADE'],
	        member + 'O.bodies[n[0]].dynamic = True; O.bodies[n[0]].groupMask = 1; O.engines = O.engines + [NewtonIntegrator(mask=1)]; O.step()': ['O.engines has no ForceResetter'],
	        ground + 'c = Body(); c.shape = Cylinder(radius=0.1, length=1); c.material = O.materials["outer"]; c.groupMask = 1; O.bodies.append(c); O.step()': ['a Cylinder', 'cannot touch the soil'],
	}
	outcomes = outcomesOf(yade.folder, scene, list(refused))
	for statement, parts in refused.items():
		for part in parts:
			assert part in outcomes[statement][1], (statement, outcomes[statement])
