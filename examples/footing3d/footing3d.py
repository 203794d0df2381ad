#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Bearing capacity of a rough rigid footing on undrained clay: a strip in plane strain, and a square one in three dimensions.

	     B/2
	  |#######|____________________      footing: grid nodes of the surface, pushed down, held sideways (rough)
	 o|       surface              |o    B = 2 m; quarter of the square, half of the strip
	 o|                            |o    symmetry at x = 0 (and z = 0), rollers at 1.5 B
	 o|          clay              |o    base at depth B: held
	 o|                            |o    c_u = 25 kPa, E = 1000 c_u, weightless
	  //////////////////////////////

Published: strip N_c = 2 + pi (Prandtl 1921, exact); square: 1.14 (2 + pi) = 5.86, from finite elements that were calibrated by the
exact solution (S. Gourvenec, M. Randolph, O. Kingsnorth (2006): Undrained bearing capacity of square and rectangular footings.
Int. J. Geomech. 6(3)).

Run it with `scripts/run examples/footing3d/footing3d.py [options]`, or by yade-batch with the options as columns of a parameter
table. Read examples/collapse first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Rough rigid footing on undrained clay, strip and square.',
        cells=(3, 'cells over half the width of the footing, without the half cell at its edge'),
        pointsPerCell=(2, 'material points per cell and axis'),
        steps=(16, 'load steps'),
        settlement=(0.04, 'at the end, as a part of B'))

B, cu = 2., 25e3
h = B / (2 * options.cells + 1) # the footing ends in the middle between two nodes, so that each held node stands for a whole cell
width, depth = np.ceil(1.5 * B / h) * h, np.ceil(B / h) * h
published = {2: ('strip', 2 + np.pi), 3: ('square', 1.14 * (2 + np.pi))}


def scene(dim):
	"""The clay, and a footing that settles by *settlement* B while the load factor grows from 0 to 1."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1000 * cu, poisson=0.3, density=2000, yieldStress=np.sqrt(2) * cu, label='clay'))
	grid = MpmGrid(cellSize=h, dim=dim)
	clay = pack.inAlignedBox((0, -depth, 0), (width, 0, width))
	O.bodies.append(mpm.fill(clay, grid, pointsPerCell=options.pointsPerCell, material='clay'))
	allDirections = 'xyz'[:dim]
	boundaries = [
	        MpmBoundary(max=(0, inf, inf), fix='x'),
	        MpmBoundary(min=(width, -inf, -inf), fix='x'),
	        MpmBoundary(max=(inf, -depth, inf), fix=allDirections),
	        MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, B / 2), fix=allDirections, displacement=(0, -options.settlement * B, 0)),
	]
	if dim == 3:
		boundaries += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
	O.engines = [
	        MpmImplicitEngine(grid=grid, boundaries=boundaries, label='solver'),
	        PyRunner(iterPeriod=1, initRun=True, command='record(solver.grid.dim)'),
	        MpmVtkRecorder(fileName=os.path.join(options.out, published[dim][0] + '-'), iterPeriod=max(1, options.steps // 4)),
	]
	O.dt = 1 / options.steps


def record(dim):
	"""Settlement over B, and the force on it over its area and c_u: it is boundary number 3."""
	history.append((solver.loadFactor * options.settlement, -solver.reactions[3][1] / (B / 2)**(dim - 1) / cu))


curves = {}
for dim in 2, 3:
	name, reference = published[dim]
	history = [(0, 0)]
	scene(dim)
	begin = time.time()
	O.run(options.steps, wait=True)
	seconds = time.time() - begin
	curves[dim] = np.array(history).T
	print(f'{name}: {len(O.bodies)} material points, {solver.dofs} unknowns, {O.iter} of {options.steps} load steps in {seconds:.1f} s')
	print(f'{name}: N_c = {curves[dim][1].max():.3f}, published {reference:.3f} (difference {100 * (curves[dim][1].max() / reference - 1):+.1f} %)')
	compared(f'N_c of the {name}, {B / h:g} cells over the width', curves[dim][1].max(), reference, {2: 'Prandtl 1921', 3: 'Gourvenec et al. 2006'}[dim])
print(f'h = B / {B / h:g}: square over strip {curves[3][1].max() / curves[2][1].max():.3f}, published 1.14')
compared(f'square over strip, {B / h:g} cells over the width', curves[3][1].max() / curves[2][1].max(), 1.14, 'Gourvenec et al. 2006')
np.savetxt(os.path.join(options.out, 'footing3d.csv'), np.column_stack([*curves[2], curves[3][1]]), '%.6g', ',', header='settlement/B,strip,square', comments='')

figure, (curve, shape) = plt.subplots(1, 2, figsize=(12.5, 4.2), width_ratios=[1, 1.5], layout='constrained')
for dim, colour in (2, 'C0'), (3, 'C1'):
	name, reference = published[dim]
	curve.plot(100 * curves[dim][0], curves[dim][1], color=colour, label=f'{name}, h = B / {B / h:g}')
	curve.axhline(reference, color=colour, linestyle='--', linewidth=0.9, label=f'{name}, published: {reference:.2f}')
curve.set(xlabel='settlement / B [%]', ylabel='load / (area $c_u$) [-]', xlim=(0, None), ylim=(0, None))
curve.legend(frameon=False, loc='lower right')
mpm.plot('displacement', ax=shape, plane=('z', h / (2 * options.pointsPerCell)))
shape.plot([0, B / 2], [0.03 - options.settlement * B] * 2, 'k-', linewidth=5, solid_capstyle='butt', label='footing')
shape.set(xlim=(-0.05, width + 0.05), ylim=(-depth - 0.05, 0.25), title='square footing, section near its centre')
figure.savefig(os.path.join(options.out, 'footing3d.png'), dpi=130)
print(f'written: {options.out}/footing3d.png, footing3d.csv, and for ParaView {options.out}/square-points.pvd')
