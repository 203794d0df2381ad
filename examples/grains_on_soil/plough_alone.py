#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Half of the plough of grains_on_soil.py moves through clay without grains, in equilibrium at steps of 5 mm: its force by the size of the cells, beside a closed form.

It goes from 2 cm above the surface to 3 cm below on its first decimetre, then level. A plane of symmetry takes the place of its other half.

Run it with `scripts/run examples/grains_on_soil/plough_alone.py [options]`.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('Half of the plough alone.', cell=(0.1, 'size of the cells [m]'), step=(0.005, 'travel in a load step [m]'))
began, h, length, width, depth = time.time(), options.cell, 1.4, 0.3, 0.2
radius, above, sink, travel, cu, friction = 0.12, 0.02, 0.03, 0.21, 1e4, radians(25)

O.materials.append(MpmVonMisesMat(young=2e6, poisson=0.3, density=1600, yieldStress=np.sqrt(2) * cu, label='ground'))
O.materials.append(FrictMat(label='rigid'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -depth), (length, width, 0)), grid, 2, 'ground'))
plough = O.bodies[O.bodies.append(utils.sphere((0.25, radius / 2, radius + above), radius, material='rigid', fixed=True))]
contact = MpmContact(friction=friction, stiffness=20)
sides = [MpmBoundary(max=(inf, inf, -depth), fix='xyz'), MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(length, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, width, -inf), fix='y')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact], verbosity=0)], 1

found = []
for i in range(round(travel / options.step)):
	goesDown = (i + 0.5) * options.step < 0.1
	plough.state.vel = (options.step, 0, -options.step * (sink + above) / 0.1 if goesDown else 0)
	O.step()
	found.append([(i + 1) * options.step, *2 * np.array(contact.forces[0])])
at, x, _, z = np.transpose(found)
against, upwards = (-x[at > 0.1699]).mean(), z[at > 0.1699].mean()

# 6 c_u, as under a round footing, on the front half of the cap below the surface, of both spheres: areas as seen from above and from the front
across, low = 0.0184, 0.0063
known = 6 * cu * (low + across * np.tan(friction)), 6 * cu * across
print(f'cells of {h:g} m, {len(mpm.arrays()["id"])} points: {against / 1e3:.2f} kN against it, {upwards / 1e3:.2f} kN upwards; closed form {known[0] / 1e3:.2f} and {known[1] / 1e3:.2f} kN; {time.time() - began:.0f} s')
for name, ours, theirs in ('against a plough in clay', against, known[0]), ('on a plough in clay, upwards', upwards, known[1]):
	compared(f'force {name}, cells of {h:g} m', ours / 1e3, theirs / 1e3, '6 c_u on its front', 'kN')
