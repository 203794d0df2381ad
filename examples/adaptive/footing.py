#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit load of a rough strip footing on undrained clay, 2 + pi, with F-bar: equal cells beside cells that are halved around the footing (`MpmGrid.refinements`).

The block is large, 3 widths B wide (half of it) and 2.5 deep, so that most of it does not fail. All runs have cells of the same size at the footing. With --dim 3 it is a square
footing, a quarter of it, which is compared with equal cells only.

Run it with `scripts/run examples/adaptive/footing.py [options]`. A row: halvings, how far from the footing's edge cells are smallest [B], unknowns, points, the largest load over area
and c_u, its difference from that of equal cells, linear solves, seconds of the processor.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'scripts', 'lib'))
from options import readOptions
from results import Results

options = readOptions('Cells that are halved around a footing.',
        dim=(2, '2: strip, 3: square'),
        cells=(16, 'of the smallest size over half the width of the footing, without the half cell at its edge'),
        halvings=(2, 'of the cells around the footing, 1 to 3'),
        reach=('1,0.5', 'how far from the edge cells are smallest [B], one or several'),
        equal=(1, '1: with equal cells first, 0: not'),
        steps=(16, 'load steps'),
        picture=(1, '1: draw one, 0: only numbers'))

B, cu, stiffness = 2., 25e3, 5000 # stiff, so that it fails before the footing has moved by half a cell
settlement = min(0.01 * B, 0.45 * B / (2 * options.cells + 1))


def scene(halvings, reach):
	O.reset()
	h = B / (2 * options.cells + 1) # the footing ends in the middle between two nodes, so that each held node stands for a whole cell
	H = h * 2**halvings
	width, depth = np.ceil(3 * B / H - 1e-9) * H, np.ceil(2.5 * B / H - 1e-9) * H
	O.materials.append(MpmTrescaMat(undrainedStrength=cu, young=stiffness * cu, poisson=0.3, density=2000, label='clay'))
	grid = MpmGrid(cellSize=H, dim=options.dim)
	edge = B / 2 + reach * B
	if halvings: grid.refinements = [MpmRefinement(min=(-inf, -reach * B, -inf), max=(edge, inf, edge), halvings=halvings)]
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0), (width, 0, width)), grid, pointsPerCell=2, material='clay'))
	directions = 'xyz'[:options.dim]
	boundaries = [
	        MpmBoundary(max=(0, inf, inf), fix='x'),
	        MpmBoundary(min=(width, -inf, -inf), fix='x'),
	        MpmBoundary(max=(inf, -depth, inf), fix=directions),
	        MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, B / 2), fix=directions, displacement=(0, -settlement, 0)),
	]
	if options.dim == 3: boundaries += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries, fBar=True, label='solver')]
	O.dt = 1 / options.steps


def limitLoad():
	"""Over area and c_u, solves, seconds of the processor."""
	loads, solves, begin = [], 0, time.process_time()
	for _ in range(options.steps):
		O.step()
		loads.append(-solver.reactions[3][1] / (B / 2)**(options.dim - 1) / cu)
		solves += solver.iterations
	return max(loads), solves, time.process_time() - begin


table = Results(options.out, 'footing', ['dim', 'cells', 'halvings', 'reach'], ['unknowns', 'points', 'load', 'solves', 'seconds'])
equal = None
variants = [(0, 0.)] * bool(options.equal) + [(options.halvings, float(reach)) for reach in str(options.reach).split(',')]
for halvings, reach in variants:
	scene(halvings, reach)
	load, solves, seconds = limitLoad()
	if not halvings: equal = load
	table.add([dict(dim=options.dim, cells=options.cells, halvings=halvings, reach=reach, unknowns=solver.dofs, points=len(O.bodies), load=load, solves=solves, seconds=seconds)])
	of = f'{100 * (load / (2 + np.pi) - 1):+.2f} % of 2 + pi' if options.dim == 2 else ''
	beside = f'{100 * (load / equal - 1):+.2f} % of that of equal cells' if equal and halvings else ''
	print(f'halvings {halvings}, to {reach:g} B: {solver.dofs} unknowns, {len(O.bodies)} points, N_c = {load:.4f} {of} {beside}; {solves} solves, {seconds:.1f} s of the processor')

if options.picture:
	from style import plt
	figure, axes = plt.subplots(figsize=(8, 5.6), layout='constrained')
	axes.set_title('mean stress below half of the footing', pad=24)
	mpm.plot('meanStress', ax=axes, grid=True, range=(-6 * cu, 0), plane=('z', 1e-3) if options.dim == 3 else None)
	axes.set(xlim=(0, 2 * B), ylim=(-1.25 * B, 0.15 * B))
	figure.savefig(os.path.join(options.out, 'footing.png'), dpi=130)
