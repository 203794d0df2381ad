# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that several processes work on: `scripts/run -n 2 shared.py out.npz slope2 contact` runs these, and measures them.

The file has the positions of the points after each scene, by its name, and as `measured` a text of JSON: for each scene the solves, the iterations of conjugate
gradients or GMRES, and the SHA sum of the points and of what the conditions tell; of each process CPU seconds, seconds by part, memory, and what it has sent to others. The argument `linearSolver=amg` sets the method, `size=2`
halves the cells, `depth=60` sets that of the slope in 3D [m], and with `distributed` the processes divide the points among them.
"""
import hashlib
import json
import os
import resource
import sys
import time
from collections import Counter

import numpy as np

from yade import mpm, pack, utils
from yade.mpm import processes
from yade.mpm.library import engine as library

h, method, depth, distributed = 2., 'iterative', 6., False
law = dict(young=1e6, poisson=.3, density=2400)
profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])


def engine(kind=MpmImplicitEngine, dim=2, grid={}, **settings):
	newton = MpmNewton(linearSolver=method, tolerance=1e-10, maxIterations=30)
	return kind(grid=MpmGrid(cellSize=h, dim=dim, **grid), newton=newton, verbosity=0, distributed=distributed, **settings)


def sides(*held):
	return [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy'), *held]


def weakLayer(solver, region, materials, steps):
	"""The slope of the paper, up to 3/4 of its weight, at which parts of it have yielded."""
	O.materials.append(materials)
	O.bodies.append(mpm.fill(region, solver.grid, 2, lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))
	O.engines = [solver]
	O.dt = .75 / steps
	return steps


def slope2():
	materials = [MpmVonMisesMat(yieldStress=k, label=label, **law) for label, k in (('soil', 15e3), ('weak', 7.5e3))]
	return weakLayer(engine(gravity=(0, -9.81, 0), boundaries=sides()), profile, materials, 6)


def lone():
	"""The slope, and a point by itself above it, which statics leaves where it is."""
	steps = slope2()
	O.bodies.append(mpm.fill(pack.inAlignedBox((24, 10, -1), (25, 11, 1)), O.engines[-1].grid, 2, 'soil'))
	return steps


def slope3():
	materials = [MpmVonMisesMat(yieldStress=k, label=label, **law) for label, k in (('soil', 15e3), ('weak', 7.5e3))]
	ends = [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, depth), fix='z')]
	return weakLayer(engine(dim=3, gravity=(0, -9.81, 0), boundaries=sides(*ends)), profile & pack.inAlignedBox((0, 0, 0), (30, 12, depth)), materials, 3)


def friction():
	"""The same of soil with friction that does not dilate: K is not symmetric."""
	materials = [MpmMohrCoulombMat(cohesion=c, frictionAngle=np.radians(phi), dilationAngle=0, label=label, **law) for label, c, phi in (('soil', 1e4, 20), ('weak', 5e3, 12))]
	return weakLayer(engine(gravity=(0, -9.81, 0), boundaries=sides()), profile, materials, 6)


def incompressible():
	"""The slope in the plane of soil that keeps its volume, with F-bar."""
	materials = [MpmTrescaMat(young=1e6, poisson=.49, density=2400, undrainedStrength=k, label=label) for label, k in (('soil', 15e3), ('weak', 10e3))]
	return weakLayer(engine(gravity=(0, -9.81, 0), boundaries=sides(), fBar=True), profile, materials, 4)


def pushed():
	"""A block of soil pushed from the side, with a load on its surface; its points go from cell to cell."""
	O.materials.append(MpmVonMisesMat(yieldStress=6e4, label='soil', **law))
	moved = [MpmBoundary(max=(0, inf, inf), fix='x', displacement=(.8, 0, 0)), MpmBoundary(max=(inf, 0, inf), fix='y')]
	solver = engine(gravity=(0, -9.81, 0), boundaries=moved)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (20, 8, 1)), solver.grid, 2, 'soil'))
	points = mpm.arrays()
	top = points['pos'][:, 1] > 7
	mpm.assign(ids=points['id'][top], force=[(0, -2e4, 0)] * top.sum())
	O.engines = [solver]
	O.dt = .25
	return 4


def block(solver, region, strength=6e4, steps=4, end=1):
	"""Makes a block of soil; returns the steps."""
	O.materials.append(MpmVonMisesMat(yieldStress=strength, label='soil', **law))
	O.bodies.append(mpm.fill(region, solver.grid, 2, 'soil'))
	O.engines = [solver]
	O.dt = end / steps
	return steps


def loaded():
	"""A block with a pressure that follows its top, and a traction of fixed direction beside that."""
	loads = [MpmTraction(surface=[(14, 8), (6, 8)], pressure=4e4), MpmTraction(surface=[(20, 8), (16, 8)], traction=(1e4, -1e4, 0))]
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	return block(engine(gravity=(0, -9.81, 0), boundaries=held, loads=loads), pack.inAlignedBox((0, 0, -1), (20, 8, 1)))


def ring():
	"""A circular footing on a cylinder of soil, around an axis of symmetry."""
	footing = MpmBoundary(min=(-inf, 8, -inf), max=(4, 8, inf), fix='y', displacement=(0, -.3, 0))
	held = [MpmBoundary(min=(14, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy'), footing]
	return block(engine(grid=dict(axisymmetric=True), gravity=(0, -9.81, 0), boundaries=held), pack.inAlignedBox((0, 0, -1), (14, 8, 1)), 3e4)


def walls():
	"""Soil on a slope of rock that rises, off the lines of the grid, beside a wall that leans and stays."""
	rock, leaning = [(0, 1.3), (20, 3.7)], [(20, 0), (21, 10)]
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(surface=rock, fix='n', velocity=(0, .1, 0)), MpmBoundary(surface=leaning, fix='n')]
	return block(engine(gravity=(0, -9.81, 0), boundaries=held), mpm.polygon([*rock, (20.37, 3.74), (20.9, 9), (0, 9)]))


def periodic():
	"""A step that repeats itself, carried along by its base until its points enter again on the other side."""
	base = MpmBoundary(max=(inf, 0, inf), fix='xy', displacement=(6, 0, 0))
	region = mpm.polygon([(0, 0), (16, 0), (16, 6), (8, 6), (8, 8), (0, 8)])
	return block(engine(grid=dict(period=(16, 0, 0)), gravity=(2, -9.81, 0), boundaries=[base]), region)


def wet():
	"""The slope beside a lake that falls, with a head of its own in the pores; K is not symmetric."""
	head = lambda x: 2e3 * max(0, 12 - x[1])
	water = [MpmWater(levels=[(0, 9), (.75, 8)]), MpmWater(pressure=head, where='pores')]
	return block(engine(gravity=(0, -9.81, 0), boundaries=sides(), water=water), profile, 6e4, 3, .75)


def seeping():
	"""A block under a load on a half of its top, through which the water leaves that the load presses out."""
	O.materials.append(MpmVonMisesMat(yieldStress=3e4, conductivity=1e-6, porosity=.4, conductivityLaw='kozeny-carman', label='wet', **law))
	load = MpmTraction(surface=[(8, 8), (0, 8)], pressure=4e4, curve=[(0, 1), (1, 1)])
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(20, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	solver = engine(boundaries=held, loads=[load], loadCurve=[(0, 1), (1, 1)], flow=MpmFlow(drains=[MpmDrain(surface=[(20, 8), (0, 8)])]))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (20, 8, 1)), solver.grid, 2, 'wet'))
	O.engines, O.dt = [solver], 2e3
	return 3


def contact(strength=3e4, speed=.3):
	"""A heavy plate presses into soil that is pushed from the side."""
	O.materials.append(MpmVonMisesMat(yieldStress=strength, label='soil', **law))
	O.materials.append(FrictMat(frictionAngle=.3, density=2600, young=1e7, label='rigid'))
	pushed = [MpmBoundary(max=(0, inf, inf), fix='x', displacement=(.05, 0, 0)), MpmBoundary(max=(inf, 0, inf), fix='y')]
	solver = engine(gravity=(0, -9.81, 0), boundaries=pushed, contacts=[MpmContact(friction=.3)])
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (20, 8, 1)), solver.grid, 2, 'soil'))
	plate = O.bodies.append(utils.box((8, 9, 0), (3, 1, 2), material='rigid', fixed=True))
	O.bodies[plate].state.vel = (.1, -speed, 0)
	O.engines = [solver]
	O.dt = .2
	return 4


def rubbing():
	"""A plate that is pressed into firmer soil, and rubs on it to the end."""
	return contact(8e4, 1.5)


def dynamics():
	"""A block that falls on the ground, and is thrown to the side."""
	O.materials.append(MpmElasticMat(label='soil', **law))
	solver = engine(MpmDynamicEngine, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])
	O.bodies.append(mpm.fill(pack.inAlignedBox((3.1, 0, -1), (13.1, 8, 1)), solver.grid, 2, 'soil'))
	mpm.assign(velocity=[(2, -1, 0)] * len(mpm.arrays()['id']))
	O.engines = [solver]
	O.dt = .05
	return 6


def collapse():
	"""A column of sand, which stands up to here and would run out later, in time."""
	O.materials.append(MpmMohrCoulombMat(young=1e6, poisson=.3, density=1800, cohesion=500, frictionAngle=np.radians(30), dilationAngle=0, label='sand'))
	solver = engine(MpmDynamicEngine, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (8, 12, 1)), solver.grid, 2, 'sand'))
	O.engines = [solver]
	O.dt = .02
	return 5


def splitting():
	"""A bar of rubber that its own weight stretches until points are split, most of them twice."""
	E, length, top = 1e6, 20., 2.5
	O.materials.append(MpmElasticMat(young=E, poisson=.3, density=E * np.log(top) / top / length / 10, label='rubber'))
	solver = engine(gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(-inf, 0, -inf), fix='y')], maxSplits=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -length, -1), (2, 0, 1)), solver.grid, 1, 'rubber'))
	O.engines = [solver]
	O.dt = .05
	return 20


def shaken():
	"""Soil on an edge that absorbs waves, through which one comes from below; damped."""
	O.materials.append(MpmElasticMat(label='soil', **law))
	base = MpmAbsorbingBoundary(max=(inf, 0, inf), motion=MpmBaseMotion(history=[(0, 0), (.1, .3), (.2, -.2), (1, 0)], direction=(1, 0, 0)))
	ends = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(20, -inf, -inf), fix='x')]
	solver = engine(MpmDynamicEngine, gravity=(0, -9.81, 0), boundaries=ends, absorbing=[base], rayleigh=(.5, .002), scheme='generalised-alpha')
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (20, 10, 1)), solver.grid, 2, 'soil'))
	O.engines = [solver]
	O.dt = .03
	return 5


def explicit():
	"""Blocks that meet in the air, one of them in pieces, by central differences."""
	O.materials.append(MpmElasticMat(label='soil', **law))
	solver = engine(MpmDynamicEngine, scheme='explicit')
	isThere = lambda body: body.state.pos[0] < 8 or int(body.state.pos[0]) % 3 == 0
	O.bodies.append([body for body in mpm.fill(pack.inAlignedBox((.3, 0, -1), (16.3, 6, 1)), solver.grid, 2, 'soil') if isThere(body)])
	mpm.assign(velocity=[(3 if x < 8 else -3, .1 * x, 0) for x in mpm.arrays()['pos'][:, 0]])
	O.engines = [solver]
	O.dt = .7 * solver.criticalTimeStep()
	return 12


def impact():
	"""Soft soil thrown on a plate, that spreads on it and is split."""
	O.materials.append(MpmElasticMat(young=5e4, poisson=.3, density=1000, label='soil'))
	O.materials.append(FrictMat(frictionAngle=.3, density=2600, young=1e7, label='rigid'))
	solver = engine(MpmDynamicEngine, gravity=(0, -9.81, 0), contacts=[MpmContact(friction=.3)], maxSplits=2)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, .4, -1), (16, 12.4, 1)), solver.grid, 1, 'soil'))
	O.bodies.append(utils.box((8, -2, 0), (12, 2, 4), material='rigid', fixed=True))
	mpm.assign(velocity=[((x - 8) * abs(x - 8) / 2, -4, 0) for x in mpm.arrays()['pos'][:, 0]])
	O.engines = [solver]
	O.dt = .03
	return 12


def chosen():
	"""A vertical cut in soil that yields, in load steps as long as their error admits."""
	O.materials.append(MpmMohrCoulombMat(cohesion=1.2e4, frictionAngle=.3, dilationAngle=.3, label='soil', **law))
	solver = engine(gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])
	solver.newton.stepTolerance, solver.newton.minStep = 5e-4, 1e-2
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (12, 6, 1)), solver.grid, 2, 'soil'))
	O.engines = [solver]
	O.dt = .2
	return 3


def field():
	"""The slope of soil whose cohesion is a random field within it; in the weak layer it also dilates less than it rubs, so that K is not symmetric only where points are that know it."""
	O.materials.append(MpmMohrCoulombMat(cohesion=1e4, frictionAngle=.3, dilationAngle=.3, label='soil', **law))
	solver = engine(gravity=(0, -9.81, 0), boundaries=sides())
	O.engines = [solver]
	mpm.add(profile, solver, 2, 'soil')
	points = mpm.arrays()
	random = np.random.default_rng(1).lognormal(np.log(8e3), .3, len(points['id']))
	soft, weak = points['pos'][:, 0] < 16, (points['pos'][:, 1] > 7) & (points['pos'][:, 0] < 12)
	mpm.assign(ids=points['id'][soft], cohesion=random[soft])
	mpm.assign(ids=points['id'][weak], dilationAngle=np.zeros(weak.sum()))
	O.dt = .15
	return 4


def layers():
	"""Level ground at rest, on which a layer is placed, and beside which soil is dug out; each process makes its own points."""
	O.materials.append([MpmVonMisesMat(yieldStress=1.2e5, label=label, **law) for label in ('ground', 'fill')])
	solver = engine(gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=sides())
	O.engines, O.dt = [solver], .2
	mpm.add(pack.inAlignedBox((0, 0, -1), (30, 8, 1)), solver, 2, 'ground')
	mpm.geostatic()
	mpm.stages.place(mpm.add(pack.inAlignedBox((0, 8, -1), (12, 10, 1)), solver, 2, 'fill'), steps=2)
	mpm.stages.excavate(pack.inAlignedBox((20, 6, -1), (26, 8, 1)), steps=2)
	return 4


def refined():
	"""A footing on soil with small cells below it, which points come into and are split, with F-bar."""
	footing = MpmBoundary(min=(-inf, 8, -inf), max=(2, 8, inf), fix='xy', displacement=(0, -.4, 0))
	small = [MpmRefinement(min=(-1, 5, -1), max=(5, 9, 1))]
	return block(engine(grid=dict(refinements=small), gravity=(0, -9.81, 0), boundaries=sides(footing), fBar=True), pack.inAlignedBox((0, 0, -1), (30, 8, 1)), 3e4)


def change():
	"""Changes the points of the next scene between its steps."""
	solver, box = O.engines[-1], lambda low, high: pack.inAlignedBox((0, low, -1), (16, high, 1))
	if O.iter == 1: O.bodies.append(mpm.fill(box(4, 8), solver.grid, 2, 'soil'))
	if O.iter == 2: mpm.add(box(8, 14), solver, 2, 'soil')
	if O.iter in (3, 4):
		points = mpm.arrays()
		for i in points['id'][(points['pos'][:, 1] > 7) & (abs(points['pos'][:, 0] - 8) < 3)].tolist():
			if not O.bodies[i]: continue  # another process has it
			if O.iter == 3: O.bodies[i].material = O.materials['stiff']
			else: O.bodies.erase(i)


def changing():
	"""A block that grows upwards, so that the work must be cut anew, of which points become stiffer and are dug out."""
	O.materials.append([MpmElasticMat(young=young, poisson=.3, density=2400, label=label) for label, young in (('soil', 1e6), ('stiff', 2e6))])
	solver = engine(gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=sides())
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (16, 4, 1)), solver.grid, 2, 'soil'))
	O.engines, O.dt = [PyRunner(iterPeriod=1, command='change()'), solver], .1
	return 6


def results(solver):
	"""Results of the last step from the engine and its conditions: forces, one number after the other."""
	vectors = [*solver.reactions, *(load.resultant for load in solver.loads)]
	for contact in solver.contacts:
		vectors += [*contact.forces, *contact.torques]
	for water in solver.water:
		vectors += water.onBoundaries
	return [number for vector in vectors for number in vector]


def digest(solver):
	"""Checksum of all that a user reads of the points, and of the conditions on them: a change of the program that is not meant to change results leaves every bit of them."""
	columns = 'id', 'pos', 'pos0', 'halfSize', 'stress', 'defGrad', 'elasticStrain', 'volume', 'plasticStrain', 'material', 'velocity', 'acceleration'
	points = mpm.arrays()
	return hashlib.sha256(b''.join(points[name].tobytes() for name in columns) + np.array(results(solver)).tobytes()).hexdigest()


def effort(steps):
	"""Runs the scene; what it takes."""
	solver, solves, iterations, parts = next(engine for engine in O.engines if isinstance(engine, MpmImplicitEngine)), 0, 0, Counter()
	sent, begin, cpu = library.bytesSent(), time.perf_counter(), time.process_time()
	for step in range(steps):
		O.step()
		solves, iterations = solves + solver.iterations, iterations + solver.cgIterations
		parts.update(solver.report()['times'])
	return dict(
	        results=results(solver), digest=digest(solver), points=len(mpm.arrays()['id']), steps=steps, solves=solves, iterations=iterations, fallbacks=solver.cgFallbacks,
	        seconds=time.perf_counter() - begin, cpu=time.process_time() - cpu, told=solver.plotData(), parts=parts, sent=(library.bytesSent() - sent) / steps,
	        memory=1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
	)


def gathered(mine):
	"""Values of each process, in the first one."""
	if processes.count == 1: return [mine]
	from mpi4py import MPI
	return MPI.COMM_WORLD.gather(mine)


found, positions = {}, {}
out, *words = sys.argv[1:]
for word in words:
	if word.startswith('linearSolver='): method = word.partition('=')[2]
	elif word.startswith('size='): h = 2 / float(word.partition('=')[2])
	elif word.startswith('depth='): depth = float(word.partition('=')[2])
	elif word == 'distributed': distributed = True
	else:
		O.reset()
		mine = effort(globals()[word]())
		positions[word] = mpm.arrays()['pos']
		found[word] = gathered(mine)
if processes.isFirst: np.savez(out, measured=json.dumps(found), **positions)
