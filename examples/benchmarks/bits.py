# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs small forms of the examples and prints the SHA sum of each one's material points, as a line of JSON, for scripts/bench --bits: a change
of the program that is not meant to change results leaves every bit of them."""
import hashlib
import json
from math import inf, radians

from yade import mpm, pack, utils

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


def plate(y, **motion):
	"""A horizontal plate, its outer side up or down as *sense* of utils.wall says, of YADE's own bodies."""
	if 'steel' not in [m.label for m in O.materials]: O.materials.append(FrictMat(young=1e9, frictionAngle=0, density=2000, label='steel'))
	body = utils.wall(y, axis=1, sense=motion.pop('sense', 1), material='steel')
	body.groupMask = 2
	O.bodies.append(body)
	for name, value in motion.items():
		setattr(body.state, name, value)


def block(dim=2, period=False, **grid):
	"""4 m wide and 2 m high, of two laws."""
	grid = MpmGrid(cellSize=.5, dim=dim, period=(4, 0, 0) if period else (0, 0, 0), **grid)
	low = pack.inAlignedBox((-1, -1, -1), (5, 1, 5))
	soil = mpm.polygon([(0, 0), (4, 0), (4, 2), (0, 2)]) if dim == 2 else pack.inAlignedBox((0, 0, 0), (4, 2, 1))
	fill(soil, grid, 2, (low, MpmElasticMat(young=1e7, poisson=.3, density=2000)), (soil, MpmMohrCoulombMat(young=1e7, poisson=.3, density=1800, cohesion=2e4, frictionAngle=.5)))
	return grid


def conditions(dim=2, **of):
	"""On a plate with friction, beside an oblique wall, under a pressure that follows and water in the pores."""
	grid = block(dim, **of)
	plate(0, sense=1)
	top = [(3.5, 2), (.5, 2)] if dim == 2 else [[(.5, 2, .1), (.5, 2, .9), (3.5, 2, .1)]]
	held = [MpmBoundary(max=(0, inf, inf), fix='x')] if not of.get('period') else []
	if dim == 3: held += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, 1), fix='z')]
	else: held.append(MpmBoundary(surface=[(3.6, 1.6), (3.8, .4)], fix='x'))
	water = [MpmWater(level=1.5, where='pores'), MpmWater(level=1.2, where='outside')]
	return run(
	        8, 8, grid=grid, gravity=(0, -9.81, 0), boundaries=held, water=water, loads=[MpmTraction(surface=top, pressure=2e4)],
	        contacts=[MpmContact(mask=2, friction=radians(20))])


def cells():
	"""Halved below the load; domains are split."""
	grid = block(refinements=[MpmRefinement(min=(1, 1, -inf), max=(3, 2, inf), halvings=1)])
	return run(
	        8, 8, grid=grid, gravity=(0, -9.81, 0), boundaries=walls(2, 4, 'xy'), loads=[MpmTraction(surface=[(2.75, 2), (1.25, 2)], traction=(0, -1e5, 0))],
	        maxSplits=2)


def moving(steps, **engine):
	"""A plate moves into soil that shakes, with an edge that absorbs waves: in the middle of a cell, in which it may bulge."""
	grid = block(origin=(-.25, 0, 0))
	plate(2, sense=-1, vel=(0, -.5, 0))
	shaking = MpmBaseMotion(history=[(0, 0), (.01, .2), (.03, -.2), (.05, 0)], direction=(1, 0, 0))
	O.engines = [
	        MpmDynamicEngine(
	                grid=grid, gravity=(0, -9.81, 0), verbosity=0, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy', motion=shaking)],
	                water=[MpmWater(level=1)], contacts=[MpmContact(mask=2, friction=radians(20))], absorbing=[MpmAbsorbingBoundary(min=(4.25, -inf, -inf))],
	                **engine)]
	O.dt = .02 / steps
	solves = 0
	for _ in range(steps):
		O.step()
		solves += O.engines[0].iterations
	points = mpm.arrays()
	return hashlib.sha256(b''.join(points[name].tobytes() for name in columns + ('velocity', 'acceleration'))).hexdigest(), solves


def paper():
	return MpmNewton(predictor=False, reuseFactor=False)


plans = {f'slope h=1, {n} x {n} points, Newton from zero': lambda n=n: slope(1, n, 40, 40, paper()) for n in (2, 3, 4)}
plans |= {f'slope h=0.5, {n} x {n} points': lambda n=n: slope(.5, n, 40, 20, MpmNewton()) for n in (2, 3, 4)}
plans |= {f'column in {dim}D': lambda dim=dim: column(dim, 32) for dim in (2, 3)}
plans |= dict(collapse=collapse, cantilever=cantilever) | {f'footing in {dim}D': lambda dim=dim: footing(dim) for dim in (2, 3)}
plans |= {
        'conditions in 2D': conditions, 'conditions in 3D': lambda: conditions(3), 'conditions with a period': lambda: conditions(period=True),
        'conditions around an axis': lambda: conditions(axisymmetric=True), 'refined cells': cells}
plans |= {
        'moving, damped': lambda: moving(8, rayleigh=(.1, 1e-4)), 'moving, generalised-alpha': lambda: moving(8, scheme='generalised-alpha'),
        'moving, midpoint': lambda: moving(8, scheme='midpoint'),
        'moving, explicit': lambda: moving(100, scheme='explicit', ghost=MpmGhost(factor=0))}
found = {}
for name, scene in plans.items():
	O.reset()
	found[name] = scene()
print(json.dumps(found))
