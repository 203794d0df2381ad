# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures where time and memory go: parts of a load step by themselves, whole scenes, features, sizes, threads, YADE's start.

	scripts/bench                       everything below
	scripts/bench kernels features      these only; the others keep their last results
	scripts/bench --large               a step of a million points in 3D
	scripts/bench --compare HEAD~5      this revision against another one, measured alternately, a quarter of an hour; whole runs are kept in results/history.csv
	scripts/bench --bits HEAD~5         whether small forms of the examples, and small scenes of all that acts on points, end with the same bits as there, with one thread and with two

  kernels    parts of a load step on a slope half way through its failure, and OpenBLAS' dgemm (Google Benchmark)
  scenes     the largest slope of the paper and a slice of it in 3D, each with 1 and 2 threads, with all shortcuts and with full Newton from zero
  sizes      cost and memory of a point, from 1e3 to 1e5 points
  features   what each feature costs, switched on or off by itself
  water      a step of soil with suction beside one of saturated soil
  start      YADE's start with and without the plugin
  bodies     a million material points against a million spheres
  solvers    iterations and seconds of one solve in 3D: direct, by conjugate gradients, with algebraic multigrid (needs scripts/setup --with-petsc)
  processes  scenes shared by 1 to 4 processes: the same states, and what is sent (needs scripts/setup --with-petsc)
  pieces     scenes of which 2 to 4 processes divide the points: the same states (needs scripts/setup --with-petsc)
  sharing    a slope in 3D by one process, with one thread and with two, and by two processes, which divide its points or do not: the parts of a step (needs scripts/setup --with-petsc)
  division   peak of memory of a block in 3D by 1, 2 and 4 processes, which divide its points or do not (needs scripts/setup --with-petsc)
  large      a step in 3D of a million points of which nearly all have yielded, with two threads: some five minutes and 4 GB; only on demand

Writes results/bench.json and a page with the tables (README.md). Nothing else should run meanwhile. It takes about five minutes.
"""
import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

from mpi import byMpi, makingRoom
from results import makeFolder
from worker import root

examples = os.path.join(root, 'examples', 'benchmarks')
sys.path.insert(0, examples)
import page

# scenes of shared.py, which processes may divide
smallScenes = 'slope2 slope3 friction incompressible pushed loaded ring walls rubbing periodic wet field layers changing dynamics collapse shaken explicit chosen splitting impact'.split()
variants = {
        'as it is': {},
        "basis 'mpm'": dict(basis='mpm'),
        'no ghost stabilisation': dict(ghost=0),
        'elastic': dict(elastic=True),
        'no predictor': dict(predictor=False),
        'no factor twice': dict(reuseFactor=False),
        'recorder at every step': dict(recorder=True),
        'recorder of two fields': dict(recorder=['displacement', 'plasticStrain']),
        'mpm.arrays() at every step': dict(arrays=True)
}


class Installation:
	"""A source tree with the plugin built in it."""

	def __init__(self, folder, forUser):
		self.folder = folder
		if folder == root and 'YADE' in os.environ: self.yade = os.environ['YADE'] # same command as in the tests
		else:
			succeed([os.path.join(folder, 'scripts', 'setup'), *(['--user'] if forUser else [])])
			self.yade = os.path.join(folder, 'build/overlay/bin/yade') if forUser or os.geteuid() != 0 else '/usr/bin/yade'

	def scene(self, threads=1, **settings):
		"""Measurements of scene.py of this revision there."""
		return self.scenes(threads, 1, settings)[0]

	def scenes(self, threads, processes, settings):
		"""The same in each of the processes that share it."""
		print(f'-n {processes} ' * (processes > 1) + f'-j{threads}', settings, flush=True)
		command = [*byMpi(processes), self.yade, '-n', '-x', f'-j{threads}', os.path.join(examples, 'scene.py'), json.dumps(settings)]
		lines = run(command, **makingRoom).replace('}{', '}\n{').splitlines() # mpirun may leave out what parts them
		return [json.loads(line) for line in lines if line.startswith('{')]

	def shared(self, processes, *words, threads=1):
		"""Measurements of shared.py by scene, in each process; and the positions of the points by scene."""
		print(f'-n {processes}', *words, flush=True)
		with tempfile.TemporaryDirectory() as folder:
			command = [*byMpi(processes), self.yade, '-n', '-x', f'-j{threads}', os.path.join(examples, 'shared.py'), os.path.join(folder, 'positions.npz'), *words]
			run(command, **makingRoom)
			with np.load(os.path.join(folder, 'positions.npz')) as file:
				positions = dict(file)
		return json.loads(str(positions.pop('measured'))), positions

	def bits(self, threads):
		"""SHA sum of the points and number of solves of each scene of bits.py and of shared.py of this revision."""
		found = json.loads(run([self.yade, '-n', '-x', f'-j{threads}', os.path.join(examples, 'bits.py')]).splitlines()[-1])
		measured, _ = self.shared(1, 'linearSolver=auto', *smallScenes, 'refined', threads=threads)
		return found | {name: (each[0]['digest'], each[0]['solves']) for name, each in measured.items()}

	def program(self, name):
		"""The path of a program of the tests, once it is built."""
		build = os.path.join(self.folder, 'build')
		if not os.path.exists(os.path.join(build, 'build.ninja')): succeed(['cmake', '-S', self.folder, '-B', build, '-G', 'Ninja'], stdout=subprocess.DEVNULL)
		succeed(['cmake', '--build', build, '--target', name], stdout=subprocess.DEVNULL)
		return os.path.join(build, 'tests', name)

	def solves(self, threads, *words):
		"""Output of tests/bench/solvers.cpp."""
		print('solvers', *words, flush=True)
		program = self.program('solvers')
		return [json.loads(line) for line in run([program, *map(str, words)], OMP_NUM_THREADS=str(threads)).splitlines()]

	def kernels(self, threads=1, shortest=.1):
		"""Counters of the kernels by name; of three repetitions the quickest."""
		print(f'kernels with {threads} threads', flush=True)
		installBenchmark = f'source {root}/scripts/lib/common.sh; installPackages libbenchmark-dev'
		succeed(['bash', '-eu', '-c', installBenchmark])
		if not os.path.exists(os.path.join(self.folder, 'build', 'tests', 'kernels')): succeed(['cmake', '-S', self.folder, '-B', os.path.join(self.folder, 'build'), '-G', 'Ninja'], stdout=subprocess.DEVNULL)
		with tempfile.NamedTemporaryFile(suffix='.json') as out:
			run([self.program('kernels'), '--benchmark_out=' + out.name, f'--benchmark_min_time={shortest}', '--benchmark_repetitions=3'],
			    OMP_NUM_THREADS=str(threads), OPENBLAS_NUM_THREADS=str(threads))
			found = json.load(out)['benchmarks']
		best = {}
		for one in (one for one in found if one['run_type'] == 'iteration'):
			name = one['name'].removesuffix('/real_time')
			if name not in best or one['real_time'] < best[name]['real_time']: best[name] = one
		return best


def succeed(command, **streams):
	"""A command whose output is seen while it runs."""
	ended = subprocess.run(command, **streams)
	if ended.returncode: sys.exit(f"scripts/bench: {' '.join(command)} ended with exit code {ended.returncode}")


def run(command, **environment):
	ended = subprocess.run(command, env=os.environ | environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)
	if ended.returncode: sys.exit(f"scripts/bench: {' '.join(command)} ended with exit code {ended.returncode}\n{ended.stdout[-2000:]}{ended.stderr[-2000:]}")
	return ended.stdout


def kernels(here):
	return {str(threads): here.kernels(threads, .001 if options.quick else .1) for threads in (1, 2)}


def scenes(here):
	plans = dict(slope=dict(cellSize=.25), slice=dict(cellSize=.5, pointsPerCell=2, depth=4, steps=20))
	if options.quick: plans = {name: plan | dict(cellSize=1, steps=2) for name, plan in plans.items()}
	return [
	        dict(name=name, threads=threads, predictor=predictor, **here.scene(threads, **plan, predictor=predictor, reuseFactor=predictor))
	        for name, plan in plans.items() for predictor in (False, True) for threads in (1, 2)
	]


def sizes(here):
	cells = [2, 1] if options.quick else [2, 1, .5, .2] + ([.066] if options.large else [])
	return [best(here, cellSize=h, steps=2) for h in cells]


def features(here):
	plan = dict(cellSize=1, steps=2) if options.quick else dict(cellSize=.5, steps=20)
	return dict(revision=page.machine()['revision'], runs={name: best(here, **plan | change) for name, change in variants.items()})


def water(here):
	"""A cut under rain, and the same soil where all pores are full, in turn; the quickest of three runs of each."""
	plan, found = dict(scene='water', cellSize=1, steps=2) if options.quick else dict(scene='water', cellSize=.25, steps=20), {}
	for _ in range(1 if options.quick else 3):
		for law in 'elastic', 'Mohr-Coulomb':
			for isDrying in False, True:
				found.setdefault((law, isDrying), []).append(here.scene(**plan, elastic=law == 'elastic', isDrying=isDrying))
	runs = [dict(law=law, isDrying=isDrying, **min(each, key=lambda run: run['run'])) for (law, isDrying), each in found.items()]
	return dict(revision=page.machine()['revision'], runs=runs)


def best(here, **settings):
	"""The quickest of three runs."""
	return min((here.scene(**settings) for _ in range(1 if options.quick else 3)), key=lambda result: result['run'])


def start(here):
	"""Seconds of a YADE that does nothing: without the plugin, with it, and with `from yade import mpm`; the quickest of several, taken in turn."""
	with tempfile.TemporaryDirectory() as prefix, tempfile.NamedTemporaryFile('w', suffix='.py') as nothing, tempfile.NamedTemporaryFile('w', suffix='.py') as imports:
		imports.write('from yade import mpm\n')
		imports.flush()
		system, bare = '/usr/lib/x86_64-linux-gnu/yade-double', os.path.join(prefix, 'lib/x86_64-linux-gnu/yade-double')
		os.makedirs(bare)
		for name in os.listdir(system):
			if name == 'py' or name.endswith('.so') and name != 'libpkg_mpm.so': os.symlink(os.path.join(system, name), os.path.join(bare, name))
		ways = dict(without=('/usr/bin/yade', nothing.name, dict(YADE_PREFIX=prefix)), plugin=(here.yade, nothing.name, {}), imported=(here.yade, imports.name, {}))
		times = {name: [] for name in ways}
		for _ in range(1 if options.quick else 7):
			for name, (yade, script, environment) in ways.items():
				begin = time.perf_counter()
				run([yade, '-n', '-x', script], **environment)
				times[name].append(time.perf_counter() - begin)
	return {name: min(seconds) for name, seconds in times.items()}


def large(here):
	"""The slope with h = 0.5 m and 2 x 2 x 2 points a cell, deep enough for a million points, from load 0.5 to 0.6."""
	settings = dict(cellSize=.5, pointsPerCell=2, depth=115) if not options.quick else dict(cellSize=2, pointsPerCell=2, depth=2)
	result = here.scene(2, **settings, loads=[.25, .5, .6])
	print(page.largeStep(result))
	return result


def bodies(here):
	return {name: here.scene(scene=name, count=10000 if options.quick else 1000000) for name in ('spheres', 'points')}


def solvers(here):
	"""Lists of [what, results of each method], by table."""
	across, deep = (2, 2) if options.quick else (15, 20)
	small = min(across, 6)
	cantilever = lambda cells, cut=.3, ghost=1e-2, poisson=.3, tolerance=1e-8, methods=('iterative', 'amg'): here.solves(
	        2, 'cantilever', cells, 8, cut, ghost, poisson, tolerance, *methods)
	slope = lambda h, load: here.solves(2, 'slope', h, round(deep / h / 2), load, 1e-2, .3, 1e-8, 'iterative', 'amg', 'auto')
	return dict(
	        methods=[[f'to {tolerance:g}', cantilever(across, tolerance=tolerance, methods=('direct', 'iterative', 'amg', 'auto'))] for tolerance in (1e-3, 1e-8)],
	        size=[[f'{cells} x {cells} x {8 * cells} cells', cantilever(cells)] for cells in (2, 4, 6, 8, 11, 15) if cells <= across],
	        cut=[[f'{ghost:g}, {cut:g}', cantilever(small, cut, ghost)] for ghost in (1e-2, 0) for cut in (.1, .01, 1e-4, 1e-6, 1e-8)],
	        tilted=[[f'{ghost:g}, {cut:g}', here.solves(2, 'tilted', small, 8, cut, ghost, .3, 1e-8, 'iterative', 'amg')]
	                for ghost in (1e-2, 0) for cut in (.1, .01, 1e-4, 1e-6, 1e-8)],
	        poisson=[[f'{nu:g}', cantilever(small, poisson=nu)] for nu in (.3, .45, .49, .499)],
	        slope=[[f'h = {h:g}, load {load:g}', slope(h, load)] for h in (1, .5) for load in (0, .6)] if not options.quick else []
	)


def processes(here):
	"""Time that 1 to 4 processes take for each scene, with the largest difference of the positions from those of one process [m]."""
	plans = [('size=1', 'slope2', 'slope3')] if options.quick else [('size=4', 'slope2', 'friction', 'dynamics', 'collapse'), ('size=2', 'contact'), ('size=3', 'slope3'), ('size=3', 'linearSolver=amg', 'slope3')]
	found = []
	for plan in plans:
		alone = None
		for count in (1, 2) if options.quick else (1, 2, 3, 4):
			results, positions = here.shared(count, *plan)
			alone = alone or positions
			for name, measured in results.items():
				method = 'amg' if 'linearSolver=amg' in plan else 'iterative'
				difference = float(np.abs(positions[name] - alone[name]).max()) # difference of the same method
				effort = [{key: value for key, value in each.items() if key not in ('told', 'results')} for each in measured]
				found.append(dict(scene=name, method=method, processes=count, difference=difference, measured=effort))
	return found


def sharing(here):
	"""The slope in 3D by one process, by one with two threads, and by two processes that divide the points or do not, in turn; of each the quickest of five runs."""
	plan = dict(cellSize=.5, pointsPerCell=2, depth=30, steps=4, linearSolver='iterative') if not options.quick else dict(cellSize=2, pointsPerCell=2, depth=4, steps=2)
	ways, runs = ((1, 1, False), (1, 2, False), (2, 1, False), (2, 1, True)), {}
	for _ in range(1 if options.quick else 5):
		for processes, threads, areDivided in ways:
			runs.setdefault((processes, threads, areDivided), []).append(here.scenes(threads, processes, plan | (dict(distributed=True, added=True) if areDivided else {})))
	quickest = lambda found: min(found, key=lambda each: max(one['run'] for one in each))
	return dict(revision=page.machine()['revision'], runs=[dict(processes=way[0], threads=way[1], areDivided=way[2], each=quickest(runs[way])) for way in ways])


def pieces(here):
	"""Differences of scenes whose points 2 to 4 processes divide from those of one process: the largest one of the positions [m], and of the forces as a part of the largest one."""
	scenes = ['slope2', 'walls'] if options.quick else smallScenes
	results, alone = here.shared(1, *scenes)
	found = [dict(scene=name, points=len(alone[name]), solves=results[name][0]['solves'], each={}) for name in scenes]
	for count in (2,) if options.quick else (2, 3, 4):
		measured, positions = here.shared(count, 'distributed', *scenes)
		for one in found:
			name = one['scene']
			forces, those = (np.array(of[name][0]['results']) for of in (results, measured))
			apart = float(np.abs(those - forces).max() / np.abs(forces).max()) if forces.size else 0
			one['each'][count] = dict(positions=float(np.abs(positions[name] - alone[name]).max()), forces=apart, solves=measured[name][0]['solves'])
	return dict(revision=page.machine()['revision'], found=found)


def division(here):
	"""Peaks of memory of each process by stage, for each way to fill, and each number of processes."""
	plan = dict(scene='block', pointsPerCell=2, steps=2, linearSolver='iterative', extent=[60, 20, 25]) if not options.quick else dict(scene='block', pointsPerCell=1, steps=2, extent=[4, 4, 6])
	ways = dict(undivided={}, appended=dict(distributed=True), added=dict(distributed=True, added=True))
	ways['tall'] = ways['added'] | dict(extent=sorted(plan['extent']))
	runs = [dict(way=way, processes=count, each=here.scenes(1, count, plan | change)) for way, change in ways.items() for count in ((1, 2) if options.quick else (1, 2, 4))]
	return dict(revision=page.machine()['revision'], runs=runs)


def otherRevision(revision):
	"""Another revision, built in a folder of its own."""
	if not shutil.which('git'): sys.exit(f'scripts/bench: --compare {revision} needs git, which is not installed')
	commit = run(['git', '-C', root, 'rev-parse', '--verify', revision + '^{commit}']).strip()
	folder = os.path.join(root, 'build', 'compare', commit[:12])
	if not os.path.exists(folder):
		os.makedirs(folder)
		succeed(['bash', '-eu', '-o', 'pipefail', '-c', f'git -C {root} archive {commit} | tar -x -C {folder}'])
	return Installation(folder, forUser=True)


def compare(here, there):
	"""Seconds of (this revision, the other) by part, each the least of the rounds."""
	plans = {
	        'slope': dict(cellSize=.5, steps=20), 'elastic': dict(cellSize=.5, steps=20, elastic=True), 'recorder': dict(cellSize=.5, steps=20, recorder=True),
	        'largest slope': dict(cellSize=.25), 'largest slope, 2 threads': dict(threads=2, cellSize=.25), 'slice': dict(cellSize=.5, pointsPerCell=2, depth=4, steps=10),
	        'slice, 2 threads': dict(threads=2, cellSize=.5, pointsPerCell=2, depth=4, steps=10), 'flow': dict(scene='water', cellSize=.25, steps=20, elastic=True),
	        'run-out': dict(scene='column', cellSize=1 / 16, steps=160), 'explicit steps': dict(scene='column', cellSize=1 / 32, steps=200, isExplicit=True)}
	if options.quick: plans = dict(slope=dict(cellSize=1, steps=2))
	haveKernels = os.path.exists(os.path.join(there.folder, 'tests/bench/kernels.cpp')) and not options.quick
	found = {}

	def note(part, which, seconds):
		pair = found.setdefault(part, [float('inf')] * 2)
		pair[which] = min(pair[which], seconds)

	for _ in range(1 if options.quick else 3):
		for which, one in enumerate([here, there]):
			for name, plan in plans.items():
				result = one.scene(**plan)
				note(f'{name}: whole run', which, result['run'])
				for phase, seconds in result['times'].items():
					note(f'{name}: {phase}', which, seconds)
			for name, counters in (one.kernels(shortest=.05) if haveKernels else {}).items():
				note(f'kernel {name}', which, counters['real_time'] * dict(ns=1e-9, us=1e-6, ms=1e-3, s=1)[counters['time_unit']])
	return found


def remember(found, revision):
	"""Appends the whole runs to the history: day, this revision and the other, part, seconds of both, their ratio."""
	ours, day = page.machine()['revision'], time.strftime('%Y-%m-%d')
	rows = [[day, ours, revision, part.removesuffix(': whole run'), *(f'{x:.4g}' for x in pair), f'{pair[0] / pair[1]:.3f}'] for part, pair in found.items() if part.endswith(': whole run')]
	path = os.path.join(examples, 'results', 'history.csv')
	isNew = not os.path.exists(path)
	with open(path, 'a', newline='') as file:
		table = csv.writer(file, lineterminator='\n')
		table.writerows([['day', 'revision', 'beside', 'part', 'seconds', 'beside [s]', 'ratio']] * isNew + rows)


def sameBits(here, there):
	"""Prints a line for each scene and number of threads; returns whether all are the same."""
	same = True
	for threads in 1, 2:
		ours, theirs = here.bits(threads), there.bits(threads)
		for name, (sha, solves) in ours.items():
			isSame = sha == theirs[name][0]
			same &= isSame
			print(f"{'same' if isSame else 'DIFFERENT':9}  {threads} thread{'s' if threads > 1 else ' '}  {sha[:12]}  {solves:4} solves ({theirs[name][1]} there)  {name}")
	return same


parts = dict(kernels=kernels, scenes=scenes, sizes=sizes, features=features, water=water, start=start, bodies=bodies, solvers=solvers, processes=processes, pieces=pieces, sharing=sharing, division=division, large=large)


def main(study, arguments):
	global options
	study.option('part', nargs='*', help=', '.join(parts))
	study.option('--compare', metavar='REVISION', help='of git: builds it in build/compare, and prints the ratios of times')
	study.option('--bits', metavar='REVISION', help='of git: the same, and compares results bit by bit; ends with exit code 1 where they differ')
	study.option('--large', action='store_true', help='a step of a million points in 3D; beside named parts: a million points too in the part sizes (4 GB of memory)')
	options = study.parse(arguments, quick='small scenes and few steps: shows that it works, and nothing else')
	chosen = study.chosen(options.part, parts, 'part') if options.part else ['large'] if options.large else [name for name in parts if name != 'large']
	isNamed = options.part or '--out' in arguments
	if options.bits and (isNamed or options.compare): study.fail('--bits goes with no other option')
	if options.compare and isNamed: study.fail('--compare measures parts of its own, and writes to results/history.csv')
	here = Installation(root, options.user)
	if options.bits: return int(not sameBits(here, otherRevision(options.bits)))
	if options.compare:
		found = compare(here, otherRevision(options.compare))
		if not options.quick: remember(found, options.compare)
		return print(page.comparison(found, options.compare))
	makeFolder(options.out)
	results = page.load(options.out)
	results['machine'] = page.machine()
	for name in chosen:
		results[name] = parts[name](here)
		page.write(options.out, results)
		if name == 'solvers' and not options.quick: page.picture(results[name], os.path.join(options.out, 'solvers.png'))
	study.summary = f'Written: {options.out}/README.md'
