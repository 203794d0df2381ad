#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of a step of soil with water that flows, beside one without water, and how many iterations the block preconditioner takes as the grid is refined; the tables are on the page of measurements.

	scripts/run -j 1 examples/benchmarks/saturated.py                                    plane, 4096 and 16384 points, with and without water
	scripts/run -j 1 examples/benchmarks/saturated.py --dim 3 --cells 6,12,18 --steps 1   cubes, up to 46656 points, by multigrid

A load on a quarter of the top of an elastic layer that is drained there; one step is not counted, the next ones are of equal length, and the load grows in all of them.
"""
import argparse
import resource
import time

from yade import mpm, pack

parser = argparse.ArgumentParser(prog='saturated.py', description='What water that flows costs.')
parser.add_argument('--dim', type=int, default=2, help='2 or 3 (default %(default)s)')
parser.add_argument('--cells', default='32,64', help='along each side, one run each (default %(default)s)')
parser.add_argument('--steps', type=int, default=5, help='that are counted, after one that is not (default %(default)s)')
parser.add_argument('--dt', default='1e5', help='lengths of a step [s], one run each (default %(default)s); h2/c_v is printed')
parser.add_argument('--keepFactor', type=int, default=0, help='solves with the factor of an earlier step (default %(default)s)')
options = parser.parse_args()
L, young, poisson, k = 8., 1e7, .3, 1e-8
modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def layer(cells, flows, dt):
	O.reset()
	O.materials.append(MpmElasticMat(young=young, poisson=poisson, density=2000, conductivity=k, porosity=.4, label='soil'))
	dim, far = options.dim, inf
	up = (0, 1, 0) if dim == 2 else (0, 0, 1)
	grid = MpmGrid(cellSize=L / cells, dim=dim)
	region = mpm.polygon([(0, 0), (L, 0), (L, L), (0, L)]) if dim == 2 else pack.inAlignedBox((0, 0, 0), (L, L, L))
	O.bodies.append(mpm.fill(region, grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, far, far), fix='x'), MpmBoundary(min=(L, -far, -far), fix='x')]
	if dim == 3: sides += [MpmBoundary(max=(far, 0, far), fix='y'), MpmBoundary(min=(-far, L, -far), fix='y')]
	sides.append(MpmBoundary(max=tuple(0 if a else far for a in up), fix='xyz'[:dim]))
	square = lambda b: [(b, L), (0, L)] if dim == 2 else [[(0, 0, L), (b, 0, L), (b, b, L)], [(0, 0, L), (b, b, L), (0, b, L)]]
	load = MpmTraction(surface=square(L / 4), traction=tuple(-5e4 * a for a in up))
	solver = MpmImplicitEngine(grid=grid, boundaries=sides, loads=[load], verbosity=0, newton=MpmNewton(linearSolver='amg' if dim == 3 else 'direct'))
	solver.newton.keepFactor = options.keepFactor
	solver.loadCurve = [(0, 0), ((options.steps + 1) * dt, 1)]
	if flows: solver.flow = MpmFlow(drains=[MpmDrain(surface=square(L))])
	O.engines, O.dt = [solver], dt
	return solver


def measure(cells, flows, dt):
	solver = layer(cells, flows, dt)
	O.step()
	begin, parts, solves, inner = time.process_time(), {}, 0, 0
	for _ in range(options.steps):
		O.step()
		report = solver.report()
		solves, inner = solves + solver.iterations, inner + report['cgIterations']
		for name, value in report['times'].items():
			parts[name] = parts.get(name, 0) + value / options.steps
	spent = (time.process_time() - begin) / options.steps
	parts = ', '.join(f'{name} {value:.2f}' for name, value in sorted(parts.items(), key=lambda part: -part[1])[:4])
	print(
	        f'{len(O.bodies)} points, {solver.dofs} unknowns, {"with flow" if flows else "dry"}, dt {dt * k * modulus / 9810 / solver.grid.cellSize**2:.2g} h2/c_v: {spent:.3f} s of processor time a step, '
	        f'{solves / options.steps:.1f} solves, {inner / max(1, solves):.1f} inner iterations each, {report["cgFallbacks"]} left to LU, {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB; wall time: {parts}'
	)
	return spent


for cells in map(int, options.cells.split(',')):
	for dt in map(float, options.dt.split(',')):
		if options.dim == 2: print(f'with flow over dry: {measure(cells, True, dt) / measure(cells, False, dt):.2f}')
		else: measure(cells, True, dt)
