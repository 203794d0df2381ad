# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs small forms of the examples and prints the SHA sum of each one's material points, as a line of JSON, for scripts/bench --bits: a change
of the program that is not meant to change results leaves every bit of them."""
import hashlib
import json
from math import inf

from yade import mpm, pack

columns = 'id', 'pos', 'pos0', 'halfSize', 'stress', 'defGrad', 'elasticStrain', 'volume', 'plasticStrain', 'material'


def fill(region, grid, pointsPerCell, *materials):
	"""Materials: (region, law), the first that contains a point applies."""
	for number, (_, law) in enumerate(materials):
		law.label = str(number)
		O.materials.append(law)
	O.bodies.append(mpm.fill(region, grid, pointsPerCell, [(where, law.label) for where, law in materials]))


def run(steps, make, **engine):
	"""*make* of *steps* load steps; the sum of positions, stresses ... and how many solves it took."""
	O.engines = [MpmImplicitEngine(verbosity=0, **engine)]
	O.dt = 1 / steps
	solves = 0
	for _ in range(make):
		O.step()
		solves += O.engines[0].iterations
	points = mpm.arrays()
	return hashlib.sha256(b''.join(points[name].tobytes() for name in columns)).hexdigest(), solves


def walls(dim, width, base, depth=inf):
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix=base)]
	return sides + ([MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, depth), fix='z')] if dim == 3 else [])


def slope(h, pointsPerCell, steps, make, newton):
	law = dict(young=1e6, poisson=.3, density=2400)
	grid, space = MpmGrid(cellSize=h), pack.inAlignedBox((-1, -1, -1), (31, 13, 1))
	weak = pack.inAlignedBox((-1, 7, -1), (31, 7.5, 1))
	profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	fill(profile, grid, pointsPerCell, (weak, MpmVonMisesMat(yieldStress=7.5e3, **law)), (space, MpmVonMisesMat(yieldStress=15e3, **law)))
	return run(steps, make, grid=grid, gravity=(0, -9.81, 0), boundaries=walls(2, 30, 'xy'), newton=newton)


def column(dim, cells):
	h = 50 / cells
	grid, soil = MpmGrid(cellSize=h, dim=dim), pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (h, 50, h if dim == 3 else 1))
	fill(soil, grid, 2, (soil, MpmElasticMat(young=1e4, poisson=0, density=80)))
	return run(20, 20, grid=grid, gravity=(0, -10, 0), boundaries=walls(dim, h, 'y', h))


def collapse():
	grid, clay = MpmGrid(cellSize=.5), mpm.polygon([(0, 0), (10, 0), (10, 5), (0, 5)])
	space = pack.inAlignedBox((-1, -1, -1), (11, 6, 1))
	fill(clay, grid, 2, (space, MpmVonMisesMat(young=12.5e6, poisson=.3, density=2000, yieldStress=25e3 * 2**.5)))
	return run(12, 12, grid=grid, gravity=(0, -15, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])


def cantilever():
	grid, beam = MpmGrid(cellSize=.125), mpm.polygon([(0, -.25), (10, -.25), (10, .25), (0, .25)])
	fill(beam, grid, 2, (pack.inAlignedBox((-1, -1, -1), (11, 1, 1)), MpmElasticMat(young=12e6, poisson=0, density=1)))
	for body in O.bodies:
		if body.state.pos[0] > 9.9: body.state.force = (0, -1250. / 8, 0)
	return run(20, 20, grid=grid, boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(0, 0, -inf), max=(0, 0, inf), fix='y')])


def footing(dim):
	grid = MpmGrid(cellSize=2 / 7, origin=(0, -2, 0), dim=dim)
	clay = pack.inAlignedBox((0, -2, 0 if dim == 3 else -1), (22 / 7, 0, 22 / 7 if dim == 3 else 1))
	fill(clay, grid, 2, (clay, MpmVonMisesMat(young=25e6, poisson=.3, density=2000, yieldStress=25e3 * 2**.5)))
	held = 'xyz'[:dim]
	sides = [boundary for boundary in walls(dim, 22 / 7, held, 22 / 7) if boundary.fix != held] + [MpmBoundary(max=(inf, -2, inf), fix=held)]
	foot = MpmBoundary(min=(-inf, 0, -inf), max=(1, 0, 1 if dim == 3 else inf), fix=held, displacement=(0, -.08, 0))
	return run(8, 8, grid=grid, boundaries=sides + [foot])


def paper():
	return MpmNewton(predictor=False, reuseFactor=False)


plans = {f'slope h=1, {n} x {n} points, Newton from zero': lambda n=n: slope(1, n, 40, 40, paper()) for n in (2, 3, 4)}
plans |= {f'slope h=0.5, {n} x {n} points': lambda n=n: slope(.5, n, 40, 20, MpmNewton()) for n in (2, 3, 4)}
plans |= {f'column in {dim}D': lambda dim=dim: column(dim, 32) for dim in (2, 3)}
plans |= dict(collapse=collapse, cantilever=cantilever) | {f'footing in {dim}D': lambda dim=dim: footing(dim) for dim in (2, 3)}
found = {}
for name, scene in plans.items():
	O.reset()
	found[name] = scene()
print(json.dumps(found))
