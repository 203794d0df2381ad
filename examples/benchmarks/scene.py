# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a scene in YADE and prints where time and memory went, as a line of JSON: `yade -n -x scene.py '{"cellSize": 0.5}'`, for scripts/bench."""
import json
import os
import sys
import tempfile
import time
from math import radians
from types import SimpleNamespace

from yade import mpm, pack, utils
from yade.mpm.library import engine as library

defaults = dict(
        scene='slope', # function of this script
        count=0, # number of points or spheres
        cellSize=.5, # [m]
        pointsPerCell=4, # per axis
        steps=None, # load steps to make of 40/cellSize, all if None
        loads=None, # [load factor at the end of each step]: these steps instead
        depth=0, # cells along z, between smooth walls; 0: plane strain
        basis='gimp',
        ghost=1e-2,
        predictor=True,
        reuseFactor=True,
        linearSolver='auto',
        elastic=False,
        isDrying=False, # its pores need not be full, in the scene `water`
        fBar=False,
        recorder=False, # writes all material points after every step, or these fields of them
        arrays=False, # reads all material points after every step
        distributed=False, # several processes divide the points
        added=False, # added by mpm.add
        extent=[60, 20, 25], # size of the block [cells]
        isExplicit=False, # the scene `column`: an elastic block in explicit steps, not sand that runs out
)
setting = SimpleNamespace(**defaults | json.loads(sys.argv[1]))


def memory(entry='VmRSS'):
	"""Memory of this process [bytes]."""
	with open('/proc/self/status') as file:
		return next(1024 * int(line.split()[1]) for line in file if line.startswith(entry + ':'))


def timed(act, *arguments):
	"""Seconds that a call takes, and what it returns."""
	begin = time.perf_counter()
	result = act(*arguments)
	return time.perf_counter() - begin, result


def slope():
	"""The slope of the paper, or in 3D a slice of it."""
	h, loads = setting.cellSize, setting.loads
	steps = len(loads) if loads else setting.steps or round(40 / h)
	law = dict(young=1e6, poisson=.3, density=2400)
	for label, strength in ('soil', 15e3), ('weak', 7.5e3):
		O.materials.append(MpmElasticMat(label=label, **law) if setting.elastic else MpmVonMisesMat(label=label, yieldStress=strength, **law))
	grid = MpmGrid(cellSize=h, dim=3 if setting.depth else 2)
	soil = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
	if setting.depth: soil = soil & pack.inAlignedBox((0, 0, 0), (30, 12, setting.depth * h))
	layers = [(pack.inAlignedBox((-1, 7, -100), (31, 7.5, 100)), 'weak'), (soil, 'soil')]
	global solver, ended # for afterStep
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), basis=setting.basis, boundaries=walls(h), ghost=MpmGhost(factor=setting.ghost))
	if setting.fBar: solver.fBar = True
	if setting.distributed: solver.distributed = True
	start, O.engines = memory(), [solver]
	fill, _ = timed(put, soil, solver, layers)
	filled = memory()

	for name in 'predictor', 'reuseFactor', 'linearSolver':
		if hasattr(solver.newton, name): setattr(solver.newton, name, getattr(setting, name)) # other revisions may have none
	engines = [solver]
	O.dt = h / 40
	with tempfile.TemporaryDirectory() as folder:
		if setting.recorder: engines.append(MpmVtkRecorder(fileName=os.path.join(folder, 'slope-'), iterPeriod=1, recorders=['points'], fields=['all'] if setting.recorder is True else setting.recorder))
		O.engines = engines + [PyRunner(iterPeriod=1, initRun=True, command='afterStep()')]
		begin = ended = time.perf_counter()
		if loads:
			for load in loads:
				O.dt = load - O.time
				O.step()
		else: O.run(steps, wait=True)
	peak, points, work = memory('VmHWM'), mpm.arrays(), dict(dofs=solver.dofs, factorFlops=0) if setting.distributed else solver.workload()
	return dict(
	        points=len(points['id']), unknowns=work['dofs'], peakMemory=peak, sent=getattr(library, 'bytesSent', float)(), # other revisions may have none
	        steps=steps, **count, times=times, fill=fill, run=ended - begin, factorFlops=work['factorFlops'],
	        sceneMemory=filled - start, runMemory=peak - filled, displacement=abs(points['pos'] - points['pos0']).max(),
	        yielded=(points['plasticStrain'] > 0).mean(), last=last
	)


def put(region, solver, material):
	"""Points into the scene, which has the solver."""
	if setting.added: mpm.add(region, solver, setting.pointsPerCell, material)
	else: O.bodies.append(mpm.fill(region, solver.grid, setting.pointsPerCell, material))


def block():
	"""An elastic block in 3D: the peak of memory at each stage [bytes]."""
	peaks = dict(start=memory('VmHWM'))
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2400, label='soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(max=(inf, inf, 0), fix='z')]
	solver = MpmImplicitEngine(grid=MpmGrid(cellSize=1, dim=3), gravity=(0, -9.81, 0), boundaries=held, distributed=setting.distributed)
	solver.newton.linearSolver = setting.linearSolver
	O.engines, O.dt = [solver], .05
	region = pack.inAlignedBox((0, 0, 0), setting.extent)
	put(region, solver, 'soil')
	peaks['filled'] = memory('VmHWM')
	begin = time.perf_counter()
	for step in range(setting.steps):
		O.step()
		peaks[f'step {step + 1}'] = memory('VmHWM')
	run = time.perf_counter() - begin
	return dict(points=len(mpm.arrays()['id']), own=len([body for body in O.bodies if body]), run=run, peaks=peaks)


def water():
	"""A cut in silt into which water flows for three steps of half an hour, and then for those that are measured: saturated, by its base, or with suction, as rain."""
	h, silt = setting.cellSize, dict(young=5e7, poisson=.3, density=1950, conductivity=5e-6, porosity=.42, label='silt')
	if setting.isDrying: silt['retention'] = MpmVanGenuchten(alpha=1, n=1.8, residual=.15)
	O.materials.append(MpmElasticMat(**silt) if setting.elastic else MpmMohrCoulombMat(cohesion=20e3, frictionAngle=radians(34), dilationAngle=0, **silt))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (24, 0), (24, 12), (14, 12), (9, 4), (0, 4)]), grid, 2, 'silt'))
	ground, base = [(24, 12), (14, 12), (9, 4), (0, 4)], [(0, 0), (24, 0)]
	if setting.isDrying:
		mpm.assign(excessPressure=[9810 * (2 - y) for y in mpm.arrays()['pos'][:, 1]])
		drains = [MpmDrain(surface=ground, rain=2.8e-6), MpmDrain(surface=base, pressure=9810 * 2)]
	else: drains = [MpmDrain(surface=ground, pressure=0), MpmDrain(surface=base, flux=-2.8e-6)]
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(24, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	global solver, ended # for afterStep
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=held, flow=MpmFlow(drains=drains), loadCurve=[(0, 1), (1, 1)])
	if setting.isDrying: solver.flow.total = True # other revisions may have none
	solver.verbosity = 0
	O.engines, O.dt = [solver], 1800
	O.run(3, wait=True)
	O.engines = [solver, PyRunner(iterPeriod=1, command='afterStep()')]
	begin = ended = time.perf_counter()
	O.run(setting.steps, wait=True)
	return dict(points=len(mpm.arrays()['id']), unknowns=solver.dofs, steps=setting.steps, **count, times=times, run=ended - begin)


def column():
	"""A square column of sand that runs out, or an elastic one in explicit steps, with 4 x 4 points a cell."""
	h, density, g, steps = setting.cellSize, 1600, 10, setting.steps
	law = dict(young=500 * density * g, poisson=.3, density=density, label='sand')
	O.materials.append(MpmElasticMat(**law) if setting.isExplicit else MpmMohrCoulombMat(cohesion=1e-3 * density * g, frictionAngle=radians(35.3), dilationAngle=0, **law))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), grid, 4, 'sand'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	scheme = dict(scheme='explicit', ghost=MpmGhost(factor=0)) if setting.isExplicit else dict(newton=MpmNewton(minStep=1 / 256))
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -g, 0), boundaries=held, verbosity=0, **scheme)
	O.engines = [solver]
	O.dt = .5 * solver.criticalTimeStep() if setting.isExplicit else .15 * h / (2 * g)**.5
	begin = time.perf_counter()
	O.run(steps, wait=True)
	return dict(points=len(O.bodies), steps=steps, times={}, run=time.perf_counter() - begin)


def walls(h):
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(30, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xyz' if setting.depth else 'xy')]
	if setting.depth: held += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, setting.depth * h), fix='z')]
	return held


times, count = {}, dict(solves=0, factorisations=0, passes=0)
last = {} # step


def afterStep():
	"""Adds up times and passes over the points: one before the first solve (two with a prediction), one after each."""
	report = solver.report()
	for phase, seconds in report['times'].items():
		times[phase] = times.get(phase, 0) + seconds
	count['solves'] += report['iterations']
	count['factorisations'] += report['iterations'] - report.get('reusedFactors', 0)
	count['passes'] += report['iterations'] + report['lineSearchTrials'] + report['substeps'] * (2 if setting.predictor else 1)
	if setting.arrays: mpm.arrays()
	global ended # O.run() comes back up to 20 ms later
	before, ended = ended, time.perf_counter()
	last.update(run=ended - before, solves=report['iterations'], iterations=report.get('cgIterations', 0), residual=report['residual'], times=report['times'])


def appended(make):
	"""Makes bodies and appends them."""
	start = memory()
	making, bodies = timed(make)
	appending, _ = timed(O.bodies.append, bodies)
	return dict(bodies=len(O.bodies), make=making, append=appending, memory=memory() - start)


def spheres():
	side = round(setting.count**.5)
	return appended(lambda: [utils.sphere((i % side, i // side, 0), .25) for i in range(side**2)])


def points():
	side = round(setting.count**.5)
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2400, label='soil'))
	return appended(lambda: mpm.fill(pack.inAlignedBox((0, 0, -1), (side / 2, side / 2, 1)), MpmGrid(cellSize=1), 2, 'soil'))


print(json.dumps(dict(slope=slope, water=water, column=column, block=block, points=points, spheres=spheres)[setting.scene]()), flush=True)
