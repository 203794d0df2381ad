#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A net of YADE's own PFacets, held at its edges, catches a block of soil and grains; at rest its edges bear the weight of all.

The nodes are bodies of YADE, moved by its NewtonIntegrator, and so are the grains. MpmContact gives the nodes what the soil presses with. The soil falls with inertia (MpmDynamicEngine); as it hangs in the net it is let come to rest in statics (MpmImplicitEngine), while YADE damps nodes and grains.

Run it with `scripts/run examples/free_bodies/net.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys

import numpy as np
from yade import gridpfacet, mpm, pack, utils
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A net catches soil and grains.', falls=(0.12, 'until the soil is let come to rest [s]'), rests=(0.48, 'until the end [s]'), drop=(0.01, 'height that it falls from [m]'))
n, spacing, radius, g = 5, 0.2, 0.01, 9.81
O.materials.append(MpmElasticMat(young=2e5, poisson=0.3, density=1500, label='soil'))
O.materials.append(CohFrictMat(young=1e7, poisson=0.3, density=2600, frictionAngle=0.3, normalCohesion=1e40, shearCohesion=1e40, momentRotationLaw=True, label='inner'))
O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2600, frictionAngle=0.3, label='outer'))
grid = MpmGrid(cellSize=0.2, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0.2, 0.2, 0), (0.6, 0.6, 0.2)), grid, 2, 'soil'))
for point in O.bodies: point.groupMask = 2  # neither moved by the integrator nor touched by grains
ofSoil = g * 1500 * 0.4 * 0.4 * 0.2
height = -radius - options.drop
before = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_PFacet_Aabb()]),
        InteractionLoop([Ig2_GridNode_GridNode_GridNodeGeom6D(), Ig2_Sphere_PFacet_ScGridCoGeom()], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True), Ip2_FrictMat_FrictMat_FrictPhys()],
                        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(), Law2_ScGridCoGeom_FrictPhys_CundallStrack()])
]
O.engines = before  # engines whose laws connect the nodes
nodes = {}
for i in range(n):
	for j in range(n):
		nodes[i, j] = O.bodies.append(gridpfacet.gridNode((spacing * i, spacing * j, height), radius, material='inner', fixed=i in (0, n - 1) or j in (0, n - 1)))
		O.bodies[nodes[i, j]].groupMask = 1
for i, j in nodes:
	for other in (i + 1, j), (i, j + 1), (i + 1, j + 1):
		if other in nodes: O.bodies.append(gridpfacet.gridConnection(nodes[i, j], nodes[other], radius, material='outer'))
triangles = [(c, (c[0] + 1, c[1]), (c[0] + 1, c[1] + 1)) for c in nodes if max(c) < n - 1] + [(c, (c[0] + 1, c[1] + 1), (c[0], c[1] + 1)) for c in nodes if max(c) < n - 1]
for corners in triangles: O.bodies.append(gridpfacet.pfacet(*[nodes[c] for c in corners], material='outer'))
grains = [O.bodies.append(utils.sphere((x, y, height + 0.08), 0.05, material='outer')) for x, y in ((0.1, 0.3), (0.1, 0.5), (0.7, 0.3), (0.7, 0.5), (0.3, 0.1), (0.5, 0.1), (0.3, 0.7), (0.5, 0.7))]
for i in grains: O.bodies[i].groupMask = 1
edge = [i for c, i in nodes.items() if not O.bodies[i].dynamic]
weight = ofSoil + g * sum(O.bodies[i].state.mass for i in [*grains, *set(nodes.values()).difference(edge)])

contact = MpmContact(friction=0.3, mask=1, stiffness=10)
soil = dict(grid=grid, gravity=(0, 0, -g), contacts=[contact], iterPeriod=4, newton=MpmNewton(tolerance=1e-7), verbosity=0)
O.dt, history = 2.5e-4, []


def run(solver, until, damping):
	O.engines = before + [solver, NewtonIntegrator(gravity=(0, 0, -g), damping=damping, mask=1)]
	while O.time < until - 1e-9:
		O.run(20, wait=True)
		history.append((O.time, -sum(O.forces.f(i)[2] for i in edge), -sum(f[2] for f in contact.forces)))


run(MpmDynamicEngine(**soil, scheme='generalised-alpha', rhoInfinity=0.5), options.falls, 0.3)
run(MpmImplicitEngine(**soil | dict(iterPeriod=10), loadCurve=[(0, 1)], loadTime=O.time), options.falls + options.rests, 0.4)
times, held, pressed = np.array(history).T
found = held[-10:].mean()
print(f'edges hold {found:.2f} N, the weight of soil, grains and net is {weight:.2f} N ({100 * (found / weight - 1):+.2f} %)')
print(f'soil presses with {pressed[-1]:.6f} N, its weight is {ofSoil:.6f} N; the net sags by {height - O.bodies[nodes[2, 2]].state.pos[2]:.4f} m')
compared('edges of a net at rest', found, weight, 'weight of soil, grains and net', 'N')
figure = plt.figure(figsize=(11, 4.6), layout='constrained')
picture, diagram = figure.add_subplot(121, projection='3d'), figure.add_subplot(122)
picture.add_collection3d(Poly3DCollection([[O.bodies[nodes[c]].state.pos for c in corners] for corners in triangles], alpha=0.25, edgecolor='k'))
picture.scatter(*mpm.arrays()['pos'].T, s=40, c='peru', label='soil')
picture.scatter(*np.array([O.bodies[i].state.pos for i in grains]).T, s=120, c='grey', label='grains')
picture.set(xlim=(0, 0.8), ylim=(0, 0.8), zlim=(-0.2, 0.2), xlabel='x [m]', ylabel='y [m]', zlabel='z [m]')
picture.tick_params(labelsize=8)
picture.zaxis.labelpad = 10
picture.view_init(35, -60)
picture.legend()
diagram.plot(times, held / weight, label='edges over weight of all')
diagram.plot(times, pressed / ofSoil, label='soil on the net over its weight')
diagram.axhline(1, color='k', lw=0.8)
diagram.axvline(options.falls, color='k', lw=0.8, ls=':')
diagram.set(xlabel='time [s]', ylabel='force over weight')
diagram.legend()
figure.savefig(os.path.join(options.out, 'net.png'), dpi=130)
print(f'written: {options.out}/net.png')
