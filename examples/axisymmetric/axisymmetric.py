#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of revolution as plane problems: a thick tube under inner pressure, and a circular footing on undrained clay.

	 axis          p                        axis
	  |        ->|#######|                   |#####|_______________      footing of radius R, smooth or rough
	  |        ->|#######|                   |                     |o    rollers at 3 R
	  |        ->|#######|                   |      clay           |o    base at 2 R: held
	  |          a       b                    /////////////////////

Tube: a = 1 m, b = 2 m, plane strain along the axis. Elastic: u(a) / a = p / E (1 + nu) ((1 - 2 nu) a^2 + b^2) / (b^2 - a^2) (Lame). Plastic, Tresca: it
collapses at p = 2 c_u ln(b / a).

Footing: N_c = 5.69 smooth, 6.05 rough (R. T. Shield 1955; A. D. Cox, G. Eason, H. G. Hopkins 1961), with F-bar. With --scene circle the same in 3D, a quarter
of the circle, for what it costs.

Run it with `scripts/run examples/axisymmetric/axisymmetric.py [options]`, or by yade-batch with the options as columns of a parameter table. Read
examples/footing3d and examples/locking first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('Thick tube and circular footing, axisymmetric.',
        scene=('section', "'section': tube and footing, axisymmetric; 'circle': the rough footing in 3D, 'rough': it alone in axisymmetry"),
        cells=(8, 'cells over the radius of the footing, without the half cell at its edge'),
        tubeCells=(16, 'cells over the inner radius of the tube'),
        steps=(16, 'load steps of the footing'),
        settlement=(0.004, 'of the footing at the end, as a part of its diameter'))

cu = 25e3
solves = []


def tube(law, pressure, steps, **more):
	"""A ring one cell high, and the pressure at its inner surface at load factor 1."""
	O.reset()
	O.materials.append(law)
	h = 1 / options.tubeCells
	grid = MpmGrid(cellSize=h, axisymmetric=True)
	O.bodies.append(mpm.fill(pack.inAlignedBox((1, 0, -1), (2, h, 1)), grid, pointsPerCell=2, material='tube'))
	ends = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, h, -inf), fix='y')]
	inner = MpmTraction(surface=[(1, h), (1, 0)], pressure=pressure)
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=ends, loads=[inner], label='solver', **more)]
	O.dt = 1 / steps


def elasticTube():
	young, nu, p = 1e8, 0.3, 1e3
	tube(MpmElasticMat(young=young, poisson=nu, density=2000, label='tube'), p, 1)
	O.run(1, wait=True)
	points, cell = mpm.arrays(), 1 / options.tubeCells
	inner, outer = (np.isclose(points['pos0'][:, 0], 1 + part * cell) for part in (0.25, 0.75)) # the two rows of points in the first cell
	found, exact = solver.loads[0].surface.vertices[0][0] - 1, p / young * (1 + nu) * ((1 - 2 * nu) + 4) / 3
	print(f'tube, elastic: u(a) / a = {found:.6g}, exact {exact:.6g} (difference {100 * (found / exact - 1):+.2f} %)')
	compared(f'widening of a thick tube, {options.tubeCells} cells', found, exact, 'Lame', 'a')
	hoop, exact = points['stress'][inner | outer, 2, 2].mean() / p, (1 + 4 / (1 + cell / 2)**2) / 3
	print(f'tube, elastic: hoop stress in the first cell {hoop:.4f} p, exact in its middle {exact:.4f} (difference {100 * (hoop / exact - 1):+.2f} %)')
	compared(f'hoop stress of a thick tube, {options.tubeCells} cells', hoop, exact, 'Lame', 'p')


def plasticTube():
	exact, most = 2 * np.log(2), 1.6
	tube(MpmTrescaMat(young=1e4 * cu, poisson=0.3, density=2000, undrainedStrength=cu, label='tube'), most * cu, 64, fBar=True, newton=MpmNewton(minStep=1 / 64))
	try:
		O.run(64, wait=True)
	except RuntimeError: # the tube has collapsed
		pass
	found = most * solver.loadFactor
	print(f'tube, Tresca: last converged at p = {found:.4f} c_u, collapse at {exact:.4f} c_u (difference {100 * (found / exact - 1):+.2f} %)')
	compared(f'collapse of a thick tube, {options.tubeCells} cells', found, exact, '2 ln(b / a)', 'c_u')
	points = mpm.arrays()
	return points['pos'][:, 0], points['stress']


R = 1.
h = R / (options.cells + 0.5) # the footing ends in the middle between two nodes


def clay(grid):
	width, depth = np.ceil(3 * R / h) * h, np.ceil(2 * R / h) * h
	O.materials.append(MpmTrescaMat(young=1e4 * cu, poisson=0.3, density=2000, undrainedStrength=cu, label='clay'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0 if grid.dim == 3 else -1), (width, 0, width)), grid, pointsPerCell=2, material='clay'))
	return width, depth


def pushed(boxes, boundaries, grid, parts):
	"""Load over area and c_u after each step, by settlement over the diameter; `parts` of the circle are computed."""
	push = dict(displacement=(0, -options.settlement * 2 * R, 0))
	feet = [MpmBoundary(**box, **push) for box in boxes]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries + feet, fBar=True, label='solver')]
	O.dt = 1 / options.steps
	history, begin = [(0, 0)], time.time()
	for _ in range(options.steps):
		O.step()
		solves.append(solver.iterations)
		load = -sum(reaction[1] for reaction in solver.reactions[len(boundaries):])
		history.append((solver.loadFactor * options.settlement, load / (parts * np.pi * R**2 * cu)))
	return np.array(history).T, time.time() - begin


def circularFooting(fix):
	O.reset()
	grid = MpmGrid(cellSize=h, axisymmetric=True)
	width, depth = clay(grid)
	boundaries = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	return pushed([dict(min=(-inf, 0, -inf), max=(R, 0, inf), fix=fix)], boundaries, grid, 1)


def circleIn3D():
	"""The nodes within the circle, row by row."""
	O.reset()
	grid = MpmGrid(cellSize=h, dim=3)
	width, depth = clay(grid)
	boundaries = [
	        MpmBoundary(max=(0, inf, inf), fix='x'),
	        MpmBoundary(min=(width, -inf, -inf), fix='x'),
	        MpmBoundary(max=(inf, inf, 0), fix='z'),
	        MpmBoundary(min=(-inf, -inf, width), fix='z'),
	        MpmBoundary(max=(inf, -depth, inf), fix='xyz'),
	]
	rows = [(row * h, np.sqrt(R**2 - (row * h)**2)) for row in range(options.cells + 1)]
	return pushed([dict(min=(-inf, 0, z - h / 9), max=(end, 0, z + h / 9), fix='xyz') for z, end in rows], boundaries, grid, 1 / 4)


def report(name, curve, seconds, reference):
	settlement, load = curve
	rise = load[-1] / np.interp(0.9 * settlement[-1], settlement, load) - 1
	print(f'{name}: {len(O.bodies)} material points, {solver.dofs} unknowns, {options.steps} steps in {seconds:.1f} s')
	print(f'{name}: N_c = {load.max():.3f}, published {reference} (difference {100 * (load.max() / reference - 1):+.1f} %), rising by {100 * rise:.2f} % in the last tenth')
	compared(f'N_c of the {name}, {2 * options.cells + 1} cells over the diameter', load.max(), reference, 'Shield 1955, Cox et al. 1961')


def picture(curves, radius, stress):
	from style import plt # takes longer than the footing on coarse grids, whose time scripts/trade measures
	figure, (ring, loads, section) = plt.subplots(1, 3, figsize=(14, 4), width_ratios=[1, 1, 1.5], layout='constrained')
	order = np.argsort(radius)
	for i, name in (0, 'radial'), (2, 'hoop'):
		ring.plot(radius[order], stress[order, i, i] / cu, '.', markersize=3, label=f'{name} stress')
	ring.plot(radius[order], 2 * np.log(radius[order] / 2), 'k--', linewidth=0.9, label='$2 \\ln(r / b)$ and that $+ 2$')
	ring.plot(radius[order], 2 * np.log(radius[order] / 2) + 2, 'k--', linewidth=0.9)
	ring.set(xlabel='r / a', ylabel='stress / $c_u$', title='tube at collapse')
	for (name, curve, reference), colour in zip(curves, ('C0', 'C1')):
		loads.plot(100 * curve[0], curve[1], color=colour, label=name)
		loads.axhline(reference, color=colour, linestyle='--', linewidth=0.9, label=f'{name}, published: {reference}')
	loads.set(xlabel='settlement / diameter [%]', ylabel='load / (area $c_u$)', xlim=(0, None), ylim=(0, None), title='circular footing')
	for axes in ring, loads:
		axes.legend(frameon=False)
	mpm.plot('displacement', ax=section)
	section.plot([0, R], [0.03 - options.settlement * 2 * R] * 2, 'k-', linewidth=5, solid_capstyle='butt')
	section.set(title='rough footing: section, the axis on the left')
	figure.savefig(os.path.join(options.out, 'axisymmetric.png'), dpi=130)
	print(f'written: {options.out}/axisymmetric.png')


if options.scene == 'section':
	elasticTube()
	ring = plasticTube()
	curves = []
	for name, fix, reference in ('smooth', 'y', 5.69), ('rough', 'xy', 6.05):
		curve, seconds = circularFooting(fix)
		report('footing, ' + name, curve, seconds, reference)
		curves.append((name, curve, reference))
	picture(curves, *ring)
else:
	curve, seconds = circleIn3D() if options.scene == 'circle' else circularFooting('xy')
	report('footing in 3D, rough' if options.scene == 'circle' else 'footing, rough', curve, seconds, 6.05)
	error = curve[1].max() / 6.05 - 1
