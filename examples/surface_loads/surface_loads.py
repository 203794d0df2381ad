#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Strip load on an elastic block, one half by symmetry: a pressure that moves with the surface, against the closed forms of elasticity.

	  q = 1 kPa
	  vvvvvv                                 a strip of width 2 b on the surface
	o|------------------------------|o       rollers left (the axis of symmetry), right and below
	o|<-b->                         |o
	o|          E, nu               |o
	o|______________________________|o
	   o    o    o    o    o    o            20 b wide (40 b in all) and 20 b deep

Closed forms, of the half space in plane strain under a uniform strip: stress along z under the middle q (2 alpha + sin 2 alpha) / pi with
tan alpha = b / z, and along z anywhere q (t + sin t cos(t + 2 s)) / pi with the angles s and s + t between the vertical and the edges of the strip; difference
of the settlements of the middle and a place at 3 b, by integration of Flamant's solution: 12 ln 2 (1 - nu^2) q b / (pi E).

Run it with `scripts/run examples/surface_loads/surface_loads.py [options]`, or by yade-batch with the options as columns of a parameter
table. Read examples/column first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Strip load on an elastic block.',
        cells=(4, 'cells over half the width of the strip'),
        size=(20, 'width and depth of the half block over half the width of the strip'),
        pointsPerCell=(2, 'material points per cell and axis'))

b, q, E, nu = 1., 1e3, 1e9, 0.3
h, size = b / options.cells, options.size * b

O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='ground'))
grid = MpmGrid(cellSize=h)
block = mpm.polygon([(0, -size), (size, -size), (size, 0), (0, 0)])
O.bodies.append(mpm.fill(block, grid, pointsPerCell=options.pointsPerCell, material='ground'))
strip = MpmTraction(surface=mpm.surface(block, min=(0, 0), max=(b, 0)), pressure=q)
gauge = MpmTraction(surface=mpm.surface(block, min=(0, 0), max=(4 * b, 0)))  # a load of nothing: its line moves with the surface

O.engines = [
        MpmImplicitEngine(
                grid=grid,
                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(size, -inf, -inf), fix='x'),
                            MpmBoundary(max=(inf, -size, inf), fix='y')],
                loads=[strip, gauge],
                newton=MpmNewton(tolerance=1e-8),
                label='solver',
        ),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'surface_loads-'), recorders=['points', 'loads']),
]
O.dt = 1


def stress(x, z):
	"""Vertical stress of the half space [Pa] at depth z, compression > 0."""
	s, e = np.arctan2(x - b, z), np.arctan2(x + b, z)
	return q / np.pi * (e - s + np.sin(e - s) * np.cos(e + s))


def compare(what, found, exact, unit):
	print(f'{what}: {found / unit:.4f}, half space {exact / unit:.4f} ({100 * (found / exact - 1):+.2f} %)')
	compared(f'strip load, {what}, {options.cells} cells', found / unit, exact / unit, 'half space, Boussinesq')


begin = time.time()
O.run(1, wait=True)
print(f'h = b / {options.cells}: {len(O.bodies)} material points, {solver.dofs} unknowns, {solver.iterations} iterations in {time.time() - begin:.1f} s')
print(f'resultant over q b: {-strip.resultant[1] / (q * b):.6f}')

points = mpm.arrays()
x, z = points['pos0'][:, 0], -points['pos0'][:, 1]
found = -points['stress'][:, 1, 1]
column = np.flatnonzero(x < h / options.pointsPerCell)
column = column[np.argsort(z[column])]
for depth in 0.5, 1, 2:
	compare(f'stress under the middle at z = {depth:g} b, over q', np.interp(depth, z[column], found[column]), stress(0, depth), q)
inTopRow = z < h
cells = np.floor(x / h).astype(int)
mean = [[values[inTopRow & (cells == i)].mean() for values in (found, stress(x, z))] for i in range(options.cells)]
for i, (value, exact) in enumerate(mean):
	compare(f'stress in the cell at the surface from x = {i * h:g} b, over q', value, exact, q)
line = sorted((v[0], v0[1] - v[1]) for v, v0 in zip(gauge.surface.vertices, gauge.surface.initialVertices))
settlement = np.interp([0, 3 * b], *np.transpose(line))
compare('settlement of the middle less that at x = 3 b, over q b / E', settlement[0] - settlement[1], 12 * np.log(2) * (1 - nu**2) * q * b / (np.pi * E), q * b / E)

figure, (picture, curve) = plt.subplots(1, 2, figsize=(9.5, 4.2), layout='constrained')
mpm.plot('stress_yy', ax=picture, range=(-q, 0))
picture.set(xlim=(0, 4 * b), ylim=(-4 * b, 0.6 * b), title='vertical stress')
picture.get_legend().remove()  # arrows show the load
curve.plot(found[column] / q, z[column], '.', label='under the centre')
edge = np.flatnonzero(np.abs(x - 2 * b + h / (2 * options.pointsPerCell)) < 1e-6 * h)
curve.plot(found[edge] / q, z[edge], '.', label='at x = 2 b')
depths = np.linspace(0.01, 8, 400)
for place in x[column[0]], x[edge[0]]:
	curve.plot(stress(place, depths) / q, depths, 'k-', linewidth=0.7)
curve.set(xlabel='vertical stress over q [-] (lines: half space)', ylabel='z / b [-]', ylim=(8, 0), xlim=(0, 1.05))
curve.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'surface_loads.png'), dpi=130)
print(f'written: {options.out}/surface_loads.png, and for ParaView {options.out}/surface_loads-loads.pvd')
