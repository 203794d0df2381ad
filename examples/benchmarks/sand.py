#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Sand that yields: what Newton's method takes, and what the stabilisation of cut cells adds to the load.

	strip    smooth or rough strip footing of width B on weighty sand almost without cohesion: N_gamma = 2 q / (gamma B) after each step;
	         smooth, phi = psi = 20 degrees: 1.58 (and 0.03 of the cohesion, and the surcharge of the settlement)
	square   the same in 3D, a quarter of it
	slope    the slope of examples/slope/friction.py: the largest displacement

Run it with `scripts/run examples/benchmarks/sand.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions

options = readOptions('Sand that yields: iterations, cuts and loads.',
        scene=('strip', "'strip', 'square' or 'slope'"),
        phi=(20., 'angle of friction of the sand [degrees]'),
        psi=(20., 'of dilation [degrees]; of the slope: 0, or more for psi = phi'),
        refine=(0, 'how often cells are halved around the edge of the strip; cells is of these, over half its width'),
        cells=(8, 'cells over half the width of the footing, without the half cell at its edge; per metre of the slope, times 8'),
        cut=(0., 'part of a cell [-] by which the surface lies above a line of the grid; the footing is then a wall'),
        rough=(0, '1: the footing holds the sand sideways'),
        settlement=(0.001, 'of the footing at the end, as a part of B'),
        young=(2e8, "Young's modulus of the sand below the footing [Pa]"),
        steps=(40, 'load steps'),
        factor=(1e-2, 'of the ghost stabilisation'),
        memory=(0., "of the ghost stabilisation, 0 to 1"),
        where=('boundary', "'boundary' or 'aggregates'"),
        work=(1., 'part of the work of a step that the stabilisation may take up, above 0 to 1'),
        iterations=(20, "of Newton's method in a step; where they do not suffice it is cut"),
        axisymmetric=(0, '1: the footing is circular, of diameter B'))

B, density, gravity = 1., 2000, 10.


def material(label, cohesion, phi, psi, young, density):
	O.materials.append(
	        MpmMohrCoulombMat(young=young, poisson=0.3, density=density, cohesion=cohesion, frictionAngle=np.radians(phi), dilationAngle=np.radians(psi), label=label))


def solverOf(grid, boundaries, **settings):
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries, ghost=MpmGhost(factor=options.factor, where=options.where, memory=options.memory, workTolerance=options.work), newton=MpmNewton(maxIterations=options.iterations), verbosity=0, label='solver', **settings)]
	O.dt = 1 / options.steps


def footing(dim):
	"""Half of the strip, a quarter of the square; the load by step, as N_gamma (of the plane problem)."""
	h = B / 2 / (options.cells + .5)  # the footing ends in the middle between two nodes, so that each held node stands for a whole cell
	size = h * 2**options.refine
	width, depth = round(2.5 * B / size) * size, round(1.2 * B / size) * size
	if dim == 3: width = round(1.5 * B / h) * h
	material('sand', density * gravity * B / 1000, options.phi, options.psi, options.young, density)
	edge = options.cells * h
	near = lambda k: 1.5 * size / 2**k  # half the size of the cells that are halved so often
	boxes = [MpmRefinement(min=(edge - near(k), -near(k), -inf), max=(edge + near(k), inf, inf), halvings=k) for k in range(1, options.refine + 1)]
	grid = MpmGrid(cellSize=size, dim=dim, axisymmetric=bool(options.axisymmetric), refinements=boxes)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0 if dim == 3 else -1), (width, 0, width if dim == 3 else 1)), grid, 2, 'sand'))
	grid.origin = (0, -options.cut * h, 0)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xyz'[:dim])]
	if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, width), fix='z')]
	if options.cut: foot = MpmBoundary(surface=[(-B, 0), (B / 2, 0)], fix='xy' if options.rough else 'n', velocity=(0, -options.settlement * B, 0))
	else:
		directions = 'xyz'[:dim] if options.rough else 'y'
		foot = MpmBoundary(min=(-inf, 0, -inf), max=(B / 2, 0, B / 2), fix=directions, displacement=(0, -options.settlement * B, 0))
	solverOf(grid, [foot, *sides], fBar=True, gravity=(0, -gravity, 0), gravityCurve=[(0, 1)])
	if options.refine:  # the points of cells of several sizes do not have their tops in one row
		K0 = 1 - np.sin(np.radians(options.phi))
		mpm.assign(stress=density * gravity * mpm.arrays()['pos'][:, 1, None, None] * np.diag([K0, 1, K0]))
	else: mpm.geostatic()
	area = np.pi * B**2 / 4 if options.axisymmetric else (B / 2)**(dim - 1)
	return lambda: abs(solver.reactions[0][1]) / area * 2 / (density * gravity * B), ('N_gamma', '.3f')


def slope():
	h = 8 / options.cells
	for label, cohesion, phi in ('soil', 4e3, 16.), ('weak', 1.5e3, 8.):
		material(label, cohesion, phi, phi if options.psi else 0., 1e7, 2400)
	grid = MpmGrid(cellSize=h)
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	O.bodies.append(mpm.fill(profile, grid, 2, lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	solverOf(grid, [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')], gravity=(0, -9.81, 0))

	def movement():
		points = mpm.arrays()
		return np.linalg.norm(points['pos'] - points['pos0'], axis=1).max()

	return movement, ('largest displacement [m]', '.4f')


measure, (name, form) = dict(strip=lambda: footing(2), square=lambda: footing(3), slope=slope)[options.scene]()
curve, outcome, begin = [], 'complete', time.process_time()
count = dict.fromkeys(('iterations', 'cuts', 'lineSearchTrials', 'luSolves', 'reusedFactors'), 0)
worst, share = 0, 0.
for _ in range(options.steps):
	try:
		O.run(1, wait=True)
	except RuntimeError as error:
		outcome = f'ends at {solver.loadFactor:.4f}'
		reason = str(error)
	for key in count:
		count[key] += getattr(solver, key) if hasattr(solver, key) else solver.report()[key]
	worst, share = max(worst, solver.iterations), max(share, solver.ghostShare)
	if outcome != 'complete': break
	curve.append((solver.loadFactor, measure()))
times, values = np.array(curve).T if curve else (np.zeros(1), np.zeros(1))
parts = [part for part in (.25, .5, .75, 1) if part <= times[-1] + 1e-9]
print(f"{options.scene} psi {options.psi:g} cells {options.cells} cut {options.cut:g} settlement {options.settlement:g} steps {options.steps} factor {options.factor:g} {options.where} memory {options.memory:g} work {options.work:g}: {outcome}; {name} "
      f"{' '.join(format(np.interp(part, times, values), form) for part in parts)}; {count['iterations']} iterations (at most {worst}), {count['cuts']} cuts, "
      f"{count['lineSearchTrials']} trials, {count['luSolves']} LU, {count['reusedFactors']} factors again; share of the stabilisation {solver.ghostShare:.3f}, at most {share:.3f}; {time.process_time() - begin:.1f} s")
if outcome != 'complete': print(reason)
np.savetxt(os.path.join(options.out, f'{options.scene}-{options.psi:g}-{options.cells}-{options.cut:g}-{options.settlement:g}-{options.steps}.txt'), np.column_stack([times, values]))
