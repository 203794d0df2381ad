# SPDX-License-Identifier: GPL-2.0-or-later
"""Two cylinders of rubber, bodies of points of 1 m of radius, pressed together (MpmBodyContact), one half of each: half width of their contact, and pressure in its middle, against Hertz's by the force between them.

`cells` are those over the half width that Hertz has for the approach, roughly. One run: `scripts/run examples/trade/meeting.py`.
"""
from math import asin, cos, inf, pi, sin, sqrt

import numpy as np
from yade import mpm

readParamsFromTable(noTableOk=True, cells=4, pointsPerCell=2, stiffness=10, steps=3)
from yade.params import table

width, depth, push, E, nu = 0.054, 0.5, 0.0075, 1e6, 0.3
h = width / table.cells
O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='rubber'))
grid = MpmGrid(cellSize=h)
face = [(sin(a), 1 - cos(a)) for a in np.linspace(0, asin(depth), 400)]
O.bodies.append(mpm.fill(mpm.polygon([(0, -depth), (depth, -depth), *((x, -y) for x, y in reversed(face))]), grid, table.pointsPerCell, 'rubber', body='low'))
O.bodies.append(mpm.fill(mpm.polygon([*face, (depth, depth), (0, depth)]), grid, table.pointsPerCell, 'rubber', body='up'))
way = depth - 1.6 * h
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, -way, inf), fix='xy'), MpmBoundary(min=(-inf, way, -inf), fix='xy', displacement=(0, -push, 0))]
contact = MpmBodyContact(between=('up', 'low'), friction=0, stiffness=table.stiffness)
O.engines, O.dt = [MpmImplicitEngine(grid=grid, boundaries=held, contacts=[contact], verbosity=0, label='solver')], 1 / table.steps
solves = []
for step in range(table.steps):
	O.step()
	solves.append(solver.iterations)
body = grid.bodies[1]
ends = np.array(body.vertices)[:, :2][np.array(body.pieces)]
x, length, pressure = ends[:, :, 0].mean(1), np.hypot(*(ends[:, 1] - ends[:, 0]).T), np.array(contact.pressures)
force = contact.force[1]
a = sqrt(8 * force * (1 - nu**2) / (pi * E))  # half width of the contact of two cylinders of the radius 1 m: each has the modulus E / (1 - nu^2), so that both have half of it, at the radius of 1/2 m
widthError = abs(sqrt(4 * (length * pressure @ x**2) / (length @ pressure)) / a - 1)
inner = (pressure >= 0) & (x < a / 2) & (np.abs(ends[:, :, 1].mean(1)) < depth / 2) & (x > 1e-6)
shape = np.mean(np.sqrt(1 - np.linspace(0, 0.5, 50)**2))
pressureError = abs((pressure * length)[inner].sum() / length[inner].sum() / (4 * force / (pi * a) * shape) - 1)
error = max(widthError, pressureError)
print(f'half width {a:.4f} m, {a / h:.2f} cells: off by {100 * widthError:.2f} %; pressure in the inner half off by {100 * pressureError:.2f} %; {sum(solves)} iterations')
