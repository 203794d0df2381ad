#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""DEM grains come to rest on ground of material points, in one scene. By hand: the base of the ground bears their weight."""
from yade import mpm, utils
r, h = 0.05, 0.1
O.materials.append(MpmElasticMat(young=2e6, poisson=0.3, density=1600, label='ground'))
O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2600, frictionAngle=radians(27), label='grain'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -0.2), (0.6, 0.6, 0)), grid, 2, 'ground'))
places = [(x, y, 0.06) for x in (0.2, 0.31, 0.42) for y in (0.2, 0.31, 0.42)]
grains = [O.bodies[i] for i in O.bodies.append([utils.sphere((x, y, z), r, material='grain') for x, y, z in places])]
held = [MpmBoundary(max=(inf, inf, -0.2), fix='xyz')]
solver = MpmImplicitEngine(grid=grid, boundaries=held, contacts=[MpmContact(stiffness=2)], iterPeriod=25, verbosity=0)
O.engines = [
        ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
        solver, NewtonIntegrator(gravity=(0, 0, -10), damping=0.5)]
O.dt = 2e-4
O.run(10000, wait=True)
found, hand = solver.reactions[0][2], 10 * sum(grain.state.mass for grain in grains)
print(f'grains: load = {found:.2f} N, by hand {hand:.2f} N ({100 * (found / hand - 1):+.2f} %)')
