#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Volumetric locking and its cure, `MpmImplicitEngine.fBar`: limit loads of undrained clay, which flows without change of volume, and a beam
that can hardly change its volume.

	strip, square   footing of examples/footing3d, rough or smooth: load over area and c_u, exact 2 + pi for the strip, published 5.86 for the square
	cut             vertical cut of examples/collapse: stability number, limit analysis 3.776
	beam            cantilever 8 times as long as high in plane strain: deflection of its tip under a small weight over Timoshenko's

Run it with `scripts/run examples/locking/locking.py [options]`, or by yade-batch with locking.table. Read examples/footing3d and
examples/collapse first: scenes and what counts as failure are theirs.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('What locks, with F-bar and without.',
        scene=('strip', "'strip', 'square', 'cut' or 'beam'"),
        cells=(8, 'cells over half the width of the footing, without the half cell at its edge; over the height of cut and beam'),
        fBar=(1, '1: with F-bar, 0: without'),
        rough=(1, '1: the footing holds the clay sideways, 0: it does not'),
        law=('mises', "'mises' or 'tresca': the same strength in plane strain"),
        stiffness=(1., 'of the clay, times that of footing3d (1000 c_u) and collapse (500 c_u)'),
        factor=(1e-2, 'of the ghost stabilisation'),
        steps=(16, 'load steps of the footing'),
        settlement=(0.04, 'of the footing at the end, as a part of B'),
        stepSize=(0.05, 'of the stability number of the cut in a load step'),
        end=(4.5, 'stability number of the cut at the end'),
        poisson=(0.499, "Poisson's ratio of the beam"),
        picture=(1, '1: draw one, 0: only numbers'))

cu, density = 25e3, 2000
solves = []


def clay(young):
	common = dict(young=young * options.stiffness, poisson=0.3, density=density, label='clay')
	O.materials.append(MpmTrescaMat(undrainedStrength=cu, **common) if options.law == 'tresca' else MpmVonMisesMat(yieldStress=np.sqrt(2) * cu, **common))


def solverOf(grid, boundaries, **loads):
	return MpmImplicitEngine(grid=grid, boundaries=boundaries, fBar=bool(options.fBar), ghost=MpmGhost(factor=options.factor), label='solver', **loads)


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
	O.engines = [solverOf(grid, boundaries)]
	O.dt = 1 / options.steps
	return options.steps, lambda: (solver.loadFactor * options.settlement, -solver.reactions[3][1] / (B / 2)**(dim - 1) / cu)


def judgeFooting(dim, settlement, load):
	reference = (2 + np.pi) * (1.14 if dim == 3 else 1)
	rise = load[-1] / np.interp(settlement[-1] - 0.005, settlement, load) - 1
	print(f'N_c = {load.max():.3f}, {100 * (load.max() / reference - 1):+.1f} % of {reference:.3f}, to {settlement[-1]:.4f} B; rising by {100 * rise:.2f} % in the last 0.005 B')
	compared(f"N_c of the {options.scene}{'' if options.rough else ', smooth'}, {2 * options.cells + 1} cells over the width, F-bar {options.fBar}", load.max(), reference, 'Prandtl 1921' if dim == 2 else 'Gourvenec et al. 2006')
	return load.max() / reference - 1


def cut():
	"""The load factor is the stability number: how far the front has moved over the height, and the number."""
	H, L = 5., 10.
	clay(500 * cu)
	grid = MpmGrid(cellSize=H / options.cells)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, pointsPerCell=2, material='clay'))
	boundaries = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [solverOf(grid, boundaries, gravity=(0, -cu / (density * H), 0), loadCurve=[(0, 0), (options.end, options.end)])]
	O.dt = options.stepSize
	return round(options.end / options.stepSize), lambda: ((front() - L) / H, solver.loadFactor)


def front():
	points = mpm.arrays()
	return (points['pos'] + points['halfSize'])[:, 0].max()


def judgeCut(movement, number):
	failure = np.interp(0.01, movement, number) if movement[-1] > 0.01 else np.nan
	print(f'N = {failure:.3f} where the front has moved by H / 100: {100 * (failure / 3.776 - 1):+.1f} % of 3.776')
	compared(f'stability number of the vertical cut, {options.cells} cells over the height, F-bar {options.fBar}', failure, 3.776, 'Kammoun et al. 2010, limit analysis')
	return failure / 3.776 - 1


def beam():
	"""Its lower side cuts the cells. The deflection of the tip over Timoshenko's, by load factor."""
	L, H, E, nu, weight = 8., 1., 1e6, options.poisson, 0.5
	h = H / options.cells
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=weight, label='beam'))
	grid = MpmGrid(cellSize=h, origin=(0, -0.37 * h, 0))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -0.37 * h, -1), (L, H - 0.37 * h, 1)), grid, pointsPerCell=2, material='beam'))
	grid.origin = (0, 0, 0)
	O.engines = [solverOf(grid, [MpmBoundary(max=(0, inf, inf), fix='xy')], gravity=(0, -1, 0))]
	O.dt = 1
	exact = weight * H * (L**4 * 12 * (1 - nu**2) / (8 * E * H**3) + L**2 * 2 * (1 + nu) / (2 * 5 / 6 * E * H))

	def tip():
		points = mpm.arrays()
		last = points['pos0'][:, 0] > L - 0.6 * h
		return solver.loadFactor, (points['pos0'] - points['pos'])[last, 1].mean() / exact

	return 1, tip


def judgeBeam(_, tip):
	print(f"deflection of the tip: {tip[-1]:.3f} of Timoshenko's")
	compared(f"deflection of a beam, Poisson's ratio {options.poisson:g}, {options.cells} cells, F-bar {options.fBar}", tip[-1], 1, 'Timoshenko')
	return tip[-1] - 1


def run(steps, row):
	"""Rows of row() after each step, and the cost of the steps: seconds of all and of the assembly."""
	history, effort = [(0, 0)], np.zeros(2)
	try:
		for _ in range(steps):
			begin = time.time()
			O.run(1, wait=True)
			report = solver.report()
			solves.append(report['iterations'])
			effort += time.time() - begin, report['times']['assembly']
			history.append(row())
	except RuntimeError as error: # the quasi-static path may end: say where, and show what there is
		print(error)
	return np.array(history).T, effort


scenes = {
        'strip': (lambda: footing(2), lambda *history: judgeFooting(2, *history)),
        'square': (lambda: footing(3), lambda *history: judgeFooting(3, *history)),
        'cut': (cut, judgeCut),
        'beam': (beam, judgeBeam),
}
make, judge = scenes[options.scene]
history, (seconds, assembly) = run(*make())
kind = {'cut': options.law, 'beam': f'nu = {options.poisson}'}.get(options.scene, f"{'rough' if options.rough else 'smooth'}, {options.law}")
name = f"{options.scene}, {kind}, {options.cells} cells, {'with' if options.fBar else 'without'} F-bar"
print(f'{name}: {len(O.bodies)} points, {solver.dofs} unknowns; {sum(solves)} iterations in {seconds:.1f} s, of which assembly {assembly:.1f} s')
error = judge(*history)

if options.picture:
	from style import plt
	np.savetxt(os.path.join(options.out, 'locking.csv'), history.T, '%.6g', ',', header='movement,load', comments='')
	figure, axes = plt.subplots(figsize=(7, 4.4), layout='constrained')
	mpm.plot('meanStress', ax=axes, range=None if options.scene == 'beam' else (-6 * cu, cu), plane=('z', 1e-3) if options.scene == 'square' else None)
	axes.set_title(f'Mean stress, {name}', fontsize='medium')
	figure.savefig(os.path.join(options.out, 'locking.png'), dpi=130)
