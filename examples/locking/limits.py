#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Volumetric locking and its cure, `MpmImplicitEngine.fBar`: limit loads of undrained clay, which flows without change of volume.

	strip, square   footing of examples/footing3d, rough or smooth: load over area and c_u, exact 2 + pi for the strip, published 5.86 for the square
	cut             vertical cut of examples/collapse: stability number, limit analysis 3.776

Run it with `scripts/run examples/locking/limits.py [options]`, or by yade-batch with limits.table. Read examples/footing3d and
examples/collapse first: scenes and what counts as failure are theirs.
"""
import os
import sys
import time

from yade import mpm
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Limit loads with and without F-bar.',
        scene=('strip', "'strip', 'square' or 'cut'"),
        cells=(8, 'cells over half the width of the footing, without the half cell at its edge; over the height of the cut'),
        fBar=(1, '1: with F-bar, 0: without'),
        rough=(1, '1: the footing holds the clay sideways, 0: it does not'),
        law=('mises', "'mises' or 'tresca': the same strength in plane strain"),
        steps=(16, 'load steps'),
        settlement=(0.04, 'of the footing at the end, as a part of B'),
        end=(4.5, 'stability number of the cut at the end'))

cu, density = 25e3, 2000


def clay(young):
	common = dict(young=young, poisson=0.3, density=density, label='clay')
	O.materials.append(MpmTrescaMat(undrainedStrength=cu, **common) if options.law == 'tresca' else MpmVonMisesMat(yieldStress=np.sqrt(2) * cu, **common))


def footing(dim):
	"""A quarter of the square, half of the strip: the load over area and c_u after each step, by settlement over B."""
	B = 2.
	h = B / (2 * options.cells + 1) # the footing ends in the middle between two nodes, so that each held node stands for a whole cell
	width, depth = np.ceil(1.5 * B / h) * h, np.ceil(B / h) * h
	clay(1000 * cu)
	grid = MpmGrid(cellSize=h, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0), (width, 0, width)), grid, pointsPerCell=2, material='clay'))
	directions = 'xyz'[:dim]
	boundaries = [
	        MpmBoundary(max=(0, inf, inf), fix='x'),
	        MpmBoundary(min=(width, -inf, -inf), fix='x'),
	        MpmBoundary(max=(inf, -depth, inf), fix=directions),
	        MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, B / 2), fix=directions if options.rough else 'y', displacement=(0, -options.settlement * B, 0)),
	]
	if dim == 3:
		boundaries += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries, fBar=bool(options.fBar), label='solver')]
	O.dt = 1 / options.steps
	return lambda: (solver.loadFactor * options.settlement, -solver.reactions[3][1] / (B / 2)**(dim - 1) / cu)


def cut():
	"""The load factor is the stability number: how far the front has moved over the height, and the number."""
	H, L = 5., 10.
	clay(500 * cu)
	grid = MpmGrid(cellSize=H / options.cells)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, pointsPerCell=2, material='clay'))
	O.engines = [
	        MpmImplicitEngine(
	                grid=grid,
	                gravity=(0, -cu / (density * H), 0),
	                loadCurve=[(0, 0), (options.end, options.end)],
	                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')],
	                fBar=bool(options.fBar),
	                label='solver',
	        )
	]
	O.dt = 0.05
	return lambda: (front(L) / H, solver.loadFactor)


def front(L):
	points = mpm.arrays()
	return (points['pos'] + points['halfSize'])[:, 0].max() - L


def run(row, steps):
	"""What row() gives after each step, and what the steps took: iterations, and seconds of all and of the assembly."""
	history, effort = [(0, 0)], np.zeros(3)
	try:
		for _ in range(steps):
			begin = time.time()
			O.run(1, wait=True)
			report = solver.report()
			effort += report['iterations'], time.time() - begin, report['times']['assembly']
			history.append(row())
	except RuntimeError as error: # the quasi-static path may end: say where, and show what there is
		print(error)
	return np.array(history).T, effort


isCut = options.scene == 'cut'
(movement, load), (iterations, seconds, assembly) = run(cut() if isCut else footing(3 if options.scene == 'square' else 2), round(options.end / 0.05) if isCut else options.steps)
name = f"{options.scene}, {'' if isCut else 'rough, ' if options.rough else 'smooth, '}{options.law}, {options.cells} cells, {'with' if options.fBar else 'without'} F-bar"
print(f'{name}: {len(O.bodies)} points, {solver.dofs} unknowns; {iterations:.0f} iterations in {seconds:.1f} s, of which assembly {assembly:.1f} s')
if isCut:
	failure, reference = np.interp(0.01, movement, load) if movement[-1] > 0.01 else np.nan, 3.776
	print(f'N = {failure:.3f} where the front has moved by H / 100: {100 * (failure / reference - 1):+.1f} % of {reference}')
else:
	reference = 1.14 * (2 + np.pi) if options.scene == 'square' else 2 + np.pi
	rise = load[-1] / np.interp(movement[-1] - 0.005, movement, load) - 1
	print(f'N_c = {load.max():.3f}, {100 * (load.max() / reference - 1):+.1f} % of {reference:.3f}, to {movement[-1]:.4f} B; rising by {100 * rise:.2f} % in the last .005 B')
np.savetxt(os.path.join(options.out, 'limits.csv'), np.transpose([movement, load]), '%.6g', ',', header='movement,load', comments='')

figure, axes = plt.subplots(figsize=(7, 4.4), layout='constrained')
mpm.plot('meanStress', grid=False, ghost=False, ax=axes, range=(-6 * cu, cu), plane=('z', 1e-3) if options.scene == 'square' else None)
axes.set_title(f'Mean stress, {name}', fontsize='medium')
figure.savefig(os.path.join(options.out, 'limits.png'), dpi=130)
