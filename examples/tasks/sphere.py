#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid sphere is pressed into elastic soil, around the axis. By hand: F = 4/3 E / (1 - nu^2) sqrt(R) d^1.5 (Hertz)."""
from yade import mpm, utils
R, d, E, nu, size, h = 1, 0.06, 1e7, 0.3, 4, 0.0625
O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='soil'))
O.materials.append(FrictMat(label='rigid'))
grid = MpmGrid(cellSize=h, axisymmetric=True)
O.bodies.append(mpm.fill(mpm.polygon([(0, -size), (size, -size), (size, 0), (0, 0)]), grid, 2, 'soil'))
sphere = O.bodies[O.bodies.append(utils.sphere((0, R, 0), R, material='rigid', fixed=True))]
sphere.state.vel = (0, -d, 0)
contact = MpmContact(friction=0)
sides = [MpmBoundary(max=(inf, -size, inf), fix='xy'), MpmBoundary(min=(size, -inf, -inf), fix='x')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact])], 1 / 6
O.run(6, wait=True)
found, hand = contact.forces[0][1], 4 / 3 * E / (1 - nu**2) * R**0.5 * d**1.5
print(f'sphere: {found / 1e3:.1f} kN, by hand {hand / 1e3:.1f} kN ({100 * (found / hand - 1):+.1f} %)')
