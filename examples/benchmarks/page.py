# SPDX-License-Identifier: GPL-2.0-or-later
"""Page of where time and memory go, from results/bench.json."""
import json
import os
import sys

import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages
import studies


def load(folder):
	"""The results in a folder; of a run that has not been made, nothing."""
	path = os.path.join(folder, 'results', 'bench.json')
	if not os.path.exists(path): return {}
	with open(path) as file:
		return json.load(file)


def write(folder, results):
	"""Results and page."""
	pages.replace(os.path.join(folder, 'results', 'bench.json'), json.dumps(results, indent='\t') + '\n')
	pages.write(folder, [INTRODUCTION.format(**results['machine']), *tables(results), CHANGE])


def tables(results):
	return [section(results[name]) for name, section in sections.items() if name in results]


def writeKept(folder, home=studies.home):
	"""The page of the example, which has times of whole scenes only, and that of the study, which has all parts, from the kept results."""
	results = load(folder)
	pages.write(folder, [INTRODUCTION.format(**results['machine']), FINDINGS, short(results['scenes']), CHANGE])
	pages.write(home, [studies.conclusionOf('benchmarks', results['machine']), '', *(part.replace('### ', '## ') for part in tables(results))], 'benchmarks.md')


def machine():
	"""Machine that the times depend on."""
	with open('/proc/cpuinfo') as file:
		model = next(line.partition(':')[2].strip() for line in file if line.startswith('model name'))
	return dict(processor=model, processors=os.cpu_count(), revision=studies.revision() or 'unknown')


def kernels(results):
	rows = []
	for name, one in results['1'].items():
		two = results['2'][name]
		if 's_per_point' in one: unit, key, digits = 'ns per point', 's_per_point', 1e9
		elif 's_per_unknown' in one: unit, key, digits = 'ns per unknown', 's_per_unknown', 1e9
		else: unit, key, digits = 'GFLOP/s', 'flops', 1e-9
		rows.append([f'`{name}`', unit, *(f'{digits * x[key]:.3g}' for x in (one, two))])
		if name.startswith('linearSolve'):
			rows.append(['... of it factorisation', 'GFLOP/s', *(f"{x['flops'] * 1e-9:.3g}" for x in (one, two))])
			rows.append(['... beside `dgemm`', 'part', *(f"{x['flops'] / results[n]['dgemm']['flops']:.2f}" for x, n in ((one, '1'), (two, '2')))])
		if name.startswith('unsymmetricSolve'):
			cholesky = name.replace('unsymmetricSolve', 'linearSolve')
			for what, key in dict(time='s_per_unknown', memory='bytes_per_unknown').items():
				if key in one: rows.append([f'... {what} beside `{cholesky}`', 'ratio', *(f'{results[n][name][key] / results[n][cholesky][key]:.2f}' for n in '12')])
	return KERNELS + table(['part', 'unit', '1 thread', '2 threads'], rows)


def split(result):
	"""Parts of the run by phase; what is not in any of them is YADE and its Python. Only some runs have ghost faces."""
	return dict.fromkeys(phases, 0) | result['times'] | dict(rest=result['run'] - sum(result['times'].values()))


phases = 'check', 'gather', 'basis', 'ghost', 'assembly', 'analyse', 'factorise', 'solve', 'update', 'scatter', 'rest'


def scenes(results):
	rows = []
	for r in results:
		times = split(r)
		rows.append([
		        r['name'], r['points'], r['unknowns'], r['threads'], 'default' if r['predictor'] else 'full', f"{r['solves'] / r['steps']:.2f}",
		        f"{r['factorisations'] / r['steps']:.2f}",
		        f"{r['run']:.2f}",
		        *(f'{times[phase]:.2f}' for phase in phases), f"{1e9 * times['assembly'] / r['points'] / r['passes']:.0f}",
		        f"{1e-9 * r['factorFlops'] * r['factorisations'] / times['factorise']:.1f}", f"{sum(times[phase] for phase in ('check', 'gather', 'scatter', 'rest')) / r['run']:.1%}"
		])
	heads = ['scene', 'points', 'unknowns', 'threads', 'Newton', 'solves a step', 'factorisations a step', 'run [s]', *phases,
	         'assembly [ns per point and pass]', 'factorisation [GFLOP/s]', 'all that is YADE']
	return SCENES + table(heads, rows)


def short(results):
	"""Whole scenes, with the parts that take most of the time."""
	rows = [[r['name'], r['points'], r['unknowns'], r['threads'], 'default' if r['predictor'] else 'full', f"{r['solves'] / r['steps']:.2f}", f"{r['run']:.1f}", f"{r['times']['assembly']:.1f}", f"{r['times']['factorise']:.1f}"] for r in results]
	return SHORT + table(['scene', 'points', 'unknowns', 'threads', 'Newton', 'solves a step', 'run [s]', 'assembly', 'factorise'], rows)


def sizes(results):
	rows = []
	for r in results:
		times, n, steps, passes, solves = split(r), r['points'], r['steps'], r['passes'], r['solves']
		perStep = lambda *names: f'{1e9 * sum(times[name] for name in names) / n / steps:.0f}'
		rows.append([
		        n, r['unknowns'], f"{1e9 * times['assembly'] / n / passes:.0f}", perStep('basis'), perStep('update'), perStep('gather'), perStep('scatter'),
		        f"{1e9 * (times['factorise'] + times['solve']) / r['unknowns'] / r['factorisations']:.0f}", perStep('ghost'), f"{1e6 * r['run'] / n / steps:.2f}",
		        f"{r['sceneMemory'] / n / 1024:.2f}", f"{r['runMemory'] / n / 1024:.2f}", f"{1e6 * r['fill'] / n:.2f}"
		])
	heads = [
	        'points', 'unknowns', 'assembly [ns per point and pass]', 'basis [ns per point and step]', 'update', 'gather', 'scatter', 'factorise and solve [ns per unknown and solve]',
	        'ghost [ns per point and step]', 'all [us per point and step]', 'scene [KiB per point]', 'run, on top [KiB per point]', 'fill [us per point]'
	]
	return SIZES + table(heads, rows)


def features(results):
	base = results['runs']['as it is']
	rows = []
	for name, r in results['runs'].items():
		times = split(r)
		rows.append([
		        name, f"{1e3 * r['run'] / r['steps']:.1f}", f"{r['run'] / base['run']:.2f}", f"{r['solves'] / r['steps']:.2f}",
		        *(f"{1e3 * times[phase] / r['steps']:.2f}" for phase in ('basis', 'ghost', 'assembly', 'factorise', 'update', 'rest'))
		])
	heads = ['setting', 'step [ms]', 'ratio', 'solves a step', 'of it basis', 'ghost', 'assembly', 'factorise', 'update', 'rest']
	return FEATURES.format(revision=results['revision'], **base) + table(heads, rows)


def water(results):
	saturated, rows = {r['law']: r for r in results['runs'] if not r['isDrying']}, []
	for r in results['runs']:
		times, per = split(r), 1e3 / r['steps']
		rows.append([
		        f"{r['law']}, {'with suction' if r['isDrying'] else 'saturated'}", f"{per * r['run']:.1f}", f"{r['run'] / saturated[r['law']]['run']:.2f}",
		        f"{r['solves'] / r['steps']:.2f}", f"{r['factorisations'] / r['steps']:.2f}", *(f'{per * times[phase]:.1f}' for phase in ('assembly', 'factorise', 'solve', 'rest'))
		])
	return WATER.format(revision=results['revision'], **results['runs'][0]) + table(['soil', 'step [ms]', 'ratio', 'solves a step', 'factors a step', 'of it assembly', 'factorise', 'solve', 'rest'], rows)


def start(seconds):
	rows = [[what, f'{seconds[name]:.2f}', f"{seconds[name] - seconds['without']:+.2f}"] for name, what in STARTS.items()]
	return START + table(['YADE', 'start [s]', 'more than without'], rows)


def bodies(results):
	rows = []
	for name, r in results.items():
		n = r['bodies']
		rows.append([f'{n} {name}', f"{r['make']:.2f}", f"{r['append']:.2f}", f"{r['make'] + r['append']:.2f}", f"{r['memory'] / n / 1024:.2f}"])
	return BODIES + table(['', 'make [s]', 'O.bodies.append [s]', 'both [s]', 'memory [KiB each]'], rows)


def solvers(results):
	return SOLVERS + ''.join(CASES[name] + _solves(rows) for name, rows in results.items() if rows)


def processes(runs):
	rows = []
	for one in sorted(runs, key=lambda one: (one['method'], one['scene'], one['processes'])):
		each = one['measured']
		most = lambda key: max(process[key] for process in each)
		part = lambda *names: max(sum(process['parts'].get(name, 0) for name in names) for process in each)
		rows.append([
		        f"{one['scene']}, {one['method']}" if one['processes'] == 1 else '', each[0]['points'] if one['processes'] == 1 else '', one['processes'], each[0]['solves'], each[0]['iterations'],
		        f"{one['difference']:.0e}" if one['processes'] > 1 else '', f"{most('cpu'):.2f}", f"{part('assembly'):.2f}", f"{part('analyse', 'factorise', 'solve'):.2f}",
		        f"{most('sent') / 1e6:.3f}", f"{most('memory') / 1e6:.0f}"
		])
	heads = ['', 'points', 'processes', 'solves', 'iterations', 'difference [m]', 'CPU [s]', 'assembly [s]', 'solving [s]', 'sent a step [MB]', 'memory [MB]']
	return PROCESSES + table(heads, rows) + ON_PAPER + table(['processes', 'memory of each [GB]', 'seconds a step', 'sent by each [MB]', 'speed-up'], onPaper())


def sharing(results):
	rows = []
	for one in results['runs']:
		for number, each in enumerate(one['each']):
			times = split(each)
			rows.append([
			        *((str(one['processes']) + ', with points divided' * one.get('areDivided', False), one['threads']) if number == 0 else ('', '')), f"{each['run']:.2f}", f"{times['basis'] + times['ghost']:.2f}", f"{times['assembly']:.2f}",
			        f"{times['analyse'] + times['factorise'] + times['solve']:.2f}", f"{times['update']:.2f}", f"{times['check'] + times['gather'] + times['scatter']:.2f}", f"{times.get('agree', 0):.2f}", f"{times['rest']:.2f}",
			        f"{each['peakMemory'] / 1e6:.0f}", f"{each['sent'] / each['steps'] / 1e6:.1f}"
			])
	heads = ['processes', 'threads of each', 'run [s]', 'basis and ghost', 'assembly', 'solve', 'update', 'from and to bodies', 'agree', 'rest', 'memory [MB]', 'sent a step [MB]']
	return SHARING.format(**results) + table(heads, rows)


def pieces(results):
	rows = []
	for one in results['found']:
		each = [one['each'][count] for count in sorted(one['each'], key=int)]
		solves = sorted({one['solves'], *(of['solves'] for of in each)})
		rows.append([one['scene'], one['points'], ' to '.join(map(str, {solves[0]: 0, solves[-1]: 0})), *(f"{of['positions']:.0e}" for of in each), f"{max(of['forces'] for of in each):.0e}"])
	counts = sorted(results['found'][0]['each'], key=int)
	return PIECES.format(**results) + table(['scene', 'points at the end', 'solves', *(f'{count} processes [m]' for count in counts), 'forces'], rows)


def division(results):
	rows = []
	for one in results['runs']:
		each = one['each']
		peak = lambda stage: f"{max(process['peaks'][stage] for process in each) / 1e6:.0f}"
		stages = list(each[0]['peaks'])
		rows.append([WAYS[one['way']], one['processes'], max(process['own'] for process in each), *map(peak, stages)])
	heads = ['points', 'processes', 'points of one, at most', *(f'{stage} [MB]' for stage in stages)]
	return DIVISION.format(revision=results['revision'], points=results['runs'][0]['each'][0]['points']) + table(heads, rows)


def onPaper():
	"""A step of a million points in 3D (131,000 nodes, 372,000 unknowns) on 100 layers of nodes: 7 solves of 200 iterations. Of one process [s]: 2.4 that each
	of several does, too, 30 of assembly, 90 of solving; 0.25 ms for a sum over 1,024 processes, 10 GB/s from each to its neighbours, 1 GB/s to all."""
	nodes, layers, solves, iterations, face = 131e3, 100, 7, 200, 1403
	rows, alone = [], None
	for count in (1, 16, 64, 256, 1024):
		share = min(1, 1 / count + 2 / layers * (count > 1)) # points whose domains reach across the borders are assembled twice
		products = solves * iterations * (2 * 24 * face * (count > 1)) # vectors at both borders
		gathered = 2 * (solves + 1) * 24 * nodes * (1 - 1 / count) # forces and displacements, to all
		sums = 2 * solves * iterations * 2.5e-5 * np.log2(count)
		seconds = 2.4 + 30 * share + 90 / count + products / 10e9 + gathered / 1e9 + sums
		alone = alone or seconds
		rows.append([count, f'{.9 + 2.4 / count:.2f}', f'{seconds:.1f}', f'{(products + gathered / count) / 1e6:.0f}', f'{alone / seconds:.0f}'])
	return rows


def large(result):
	last, gigabytes = result['last'], (result['sceneMemory'] + result['runMemory']) / 1e9
	perSolve = {what: last['times'][phase] / last['solves'] for what, phase in dict(assembly='assembly', solving='solve').items()}
	rows = [
	        ['points', result['points']],
	        ['unknowns', result['unknowns']],
	        ['points that have yielded', f"{result['yielded']:.1%}"],
	        ['the step [s]', f"{last['run']:.1f}"],
	        ['solves', last['solves']],
	        ['iterations of conjugate gradients', last['iterations']],
	        ['seconds per solve', ', '.join(f'{seconds:.2f} {what}' for what, seconds in perSolve.items())],
	        ['residual', f"{last['residual']:.1e}"],
	        ['the three steps [s]', f"{result['run']:.1f}"],
	        ['memory', f"{gigabytes:.2f} GB, {gigabytes * 1e9 / result['points'] / 1024:.2f} KiB a point"],
	]
	return LARGE + table(['', ''], rows)


def largeStep(result):
	last = result['last']
	return (f"{result['points']} points, {result['yielded']:.1%} of them yielded: load .5 to .6 in {last['run']:.1f} s, {last['run'] / max(last['solves'], 1):.2f} s per solve "
	        f"({last['solves']}), {(result['sceneMemory'] + result['runMemory']) / result['points']:.0f} bytes per point")


def _solves(rows):
	"""Iterations of each method, and the seconds to set up and to solve."""
	methods = [one['method'] for one in rows[0][1]]
	heads = ['', 'unknowns', *(f'{method}: {what}' for method in methods for what in (['iterations'] if method != 'direct' else []) + ['seconds'])]
	cells = []
	for what, ones in rows:
		cells.append([what, ones[0]['unknowns']])
		for one in ones:
			failed = one['failure'] != ''
			if one['method'] != 'direct': cells[-1].append(f"{one['iterations']}, {'**breaks down**' if one['solved'] else '**fails**'}: {one['failure']}" if failed else one['iterations'])
			cells[-1].append(f"{one['setUp']:.2f} + {one['solve']:.2f}" if one['setUp'] else f"{one['solve']:.2f}")
	return table(heads, cells) + '\n'


def picture(results, path):
	"""Iterations with multigrid and without over the cut of the cells."""
	import matplotlib
	matplotlib.use('Agg')
	from matplotlib import pyplot
	figure, axes = pyplot.subplots(figsize=(6, 3.6), layout='constrained')
	styles = {('iterative', '0.01'): 'C0o-', ('iterative', '0'): 'C0o:', ('amg', '0.01'): 'C1s-', ('amg', '0'): 'C1s:'}
	names = dict(iterative='conjugate gradients', amg='with multigrid')
	for (method, ghost), style in styles.items():
		chosen = [(float(what.split(', ')[1]), one) for what, ones in results['tilted'] for one in ones if what.startswith(ghost + ',') and one['method'] == method]
		good = [(cut, one['iterations']) for cut, one in chosen if not one['failure']]
		bad = [cut for cut, one in chosen if one['failure']]
		stabilised = 'stabilised' if ghost != '0' else 'not stabilised'
		line, = axes.loglog(*zip(*good), style, label=f'{names[method]}, {stabilised}') if good else (None,)
		if bad: axes.loglog(bad, [2000] * len(bad), style[:2] + 'x', markersize=9, label=f'{names[method]}, {stabilised}: fails')
	axes.set(xlabel='part of a cell that the body reaches into', ylabel='iterations to 1e-8', ylim=(10, 3000))
	axes.invert_xaxis()
	axes.legend(fontsize='small', ncols=2, loc='lower center', bbox_to_anchor=(.5, 1))
	figure.savefig(path, dpi=120)
	pyplot.close(figure)


sections = dict(kernels=kernels, scenes=scenes, sizes=sizes, features=features, water=water, start=start, bodies=bodies, solvers=solvers, processes=processes, pieces=pieces, sharing=sharing, division=division, large=large)


def comparison(found, revision):
	"""Times of this revision and another; whole runs that take 3 % longer are marked."""
	isSlower = lambda part, ours, theirs: part.endswith('whole run') and ours > 1.03 * theirs
	rows = [[part, f'{1e3 * ours:.4g}', f'{1e3 * theirs:.4g}', f'{ours / theirs:.2f}{", slower" * isSlower(part, ours, theirs)}' if theirs else ''] for part, (ours, theirs) in found.items()]
	return table(['part', 'this revision [ms]', f'{revision} [ms]', 'this / other'], rows)


def table(heads, rows):
	return pages.table(heads, rows) + '\n'


INTRODUCTION = """# Where time and memory go

`scripts/bench` measures time and memory (see `--help`). Numbers are in `results/bench.json`. Machine:
{processor}, {processors} processors. Revision: {revision}.

## Run it

    scripts/bench                # five minutes; nothing else should run meanwhile
    scripts/bench sizes --quick  # one part, in short

## Picture

![Iterations of the solvers over the cut, with the stabilisation and without: a beam that cuts the cells in all ways](solvers.png)

## Numbers
"""

FINDINGS = """- **A pass over the points** takes 32 ns a point without and 72 ns with stiffness in 2D, 0.10 and 0.58 microseconds in 3D.
- **Newton's method**: predictor and reuse of the factor (`newton.predictor`, `newton.reuseFactor`) save two fifths of the time.
- **Two threads** save a third of assembly, update and gathering.
- **In 3D** conjugate gradients take over from some 30,000 unknowns on (`newton.linearSolver`). A load step of a million points takes 27 s with two threads (`scripts/bench --large`).
- **Algebraic multigrid** suits slender bodies that bend; it needs the ghost stabilisation.
- **Memory** is 2.2 KiB a point, of which 1.3 are the body of YADE; 3.2 KiB in 3D at the peak of a step.
- **Filling** a million points takes 4.1 s, appending a million spheres 27 s.

[The study](../../plugin/docs/studies/benchmarks.md) has all parts: phases of a load step, sizes, features, solvers, several processes.
"""

SHORT = """A slope with h = 0.25 m, all 160 steps, and a slice of it in 3D, its first 20 steps. Newton `full` factorises in each iteration; `default` has predictor and reuse of the factor.

"""

CHANGE = """
## What to change

`scripts/bench --help` names the parts. `scripts/bench --compare REVISION` times another revision in turn with this one, `scripts/bench --bits REVISION` asks whether the results are the same to the last bit. For a scene of your own: `mpm.advise()` beforehand, `solver.report()['times']` afterwards.
"""

KERNELS = """### Parts of a load step

On the slope of the paper half way through its failure, where points yield and cross cells: 17,440 points in 2D (4 x 4 a cell), 7,128 in 3D (2 x 2 x 2).
`residual` and `stiffness` are passes over the points without and with stiffness; `linearSolve` is factorisation and triangular solves, `unsymmetricSolve`
the same by LU for a matrix of the same pattern that is not symmetric. Memory is what the solver holds: the factor, and the matrix scaled.

"""

SCENES = """### Whole scenes

The slope at h = 0.25 m with 4 x 4 points a cell, all 160 steps; a slice of it in 3D, 4 cells of 0.5 m deep with 2 x 2 x 2 points a cell, its first 20 steps.
Seconds by phase, those of `solver.report()`. `check` is a look at all points before the first step; `rest` is YADE's loop and Python. All that is YADE: these, and
gathering the points from their bodies and writing them back. A pass evaluates the forces of all points, with or without
stiffness. Newton `full`: from zero, with a factorisation for each solve; `default`: with `newton.predictor` and `newton.reuseFactor`.

"""

SIZES = """### Size

The first two steps of the slope with 4 x 4 points a cell, one thread, on finer and finer grids. Memory of the scene is what filling it has added to the process;
that of the run is the peak on top of it.

"""

FEATURES = """### What each feature costs

The first {steps} steps of the slope at h = 0.5 m ({points} points, {unknowns} unknowns), one thread; each row differs from the first in one thing. Times are per step. Revision: {revision}.

"""

WATER = """### Soil with suction

A cut of 8 m with {points} points and {unknowns} unknowns, {steps} steps of half an hour, one thread: saturated soil into which water flows by its base, and soil with
suction under rain. The flow of the first is linear. That of the second is not, and its matrix is not symmetric. Revision: {revision}.

"""

STARTS = dict(without='without the plugin', plugin='with it', imported='with `from yade import mpm`')

START = """### YADE's start

A script that does nothing, the quickest of several starts taken in turn.

"""

SOLVERS = """### One solve in 3D

By a program without YADE, with two threads: iterations, and seconds to set up (a factor, or multigrid) and to solve. `iterative` are conjugate gradients with the
diagonal as preconditioner, `amg` with algebraic multigrid, `auto` with the diagonal for 300 iterations, or 100 where the residual does not fall, and then with multigrid. Where multigrid breaks down the diagonal goes on. Matrices are of the first iteration of a step.
Measured at revision 730c7fa6.

"""

CASES = dict(
        methods="""A cantilever of 15 x 15 x 120 cells, 2 x 2 x 2 points a cell, off the grid lines by 0.3 of a cell, under its own weight:

""",
        size="""Its size, to 1e-8:

""",
        cut="""How far it reaches into the next cells, 6 x 6 x 48 cells, to 1e-8; the factor of the ghost stabilisation comes first (0: none), then the part of a cell:

""",
        tilted="""The same inclined by 0.7 rad, so that cells are cut in all ways. Here multigrid needs the stabilisation (the picture):

""",
        poisson="""Poisson's ratio, 6 x 6 x 48 cells, to 1e-8:

""",
        slope="""A slope, 30 x 12 m with 10 m of depth, at the start and when nearly all points have yielded, to 1e-8:

"""
)

PROCESSES = """### Several processes

`scripts/run -n`: each process holds all points, assembles the rows of its nodes, and solves together with the others; one thread each. Scenes of `shared.py` with
`newton.tolerance` 1e-10: von Mises' slope in the plane and in 3D, the slope with friction that does not dilate (not symmetric: GMRES, with multigrid of the symmetric
part where there are several processes, and an incomplete factor where there is one), a plate that presses, a block that is thrown, a column of sand in time. The difference is the largest of the positions
at the end from those of one process. CPU seconds are those of the process that has taken most; they include what it spends waiting, and the other seconds do so, too. What is sent is that of one process.
Memory is the peak of a process, of which YADE alone takes 0.32 GB beside MPI. With
two processors three processes and four take turns. Measured at revision 55c5208.

"""

ON_PAPER = """
What to expect of more of them is on paper: a model, not measured. A step of a million points in 3D on 100 layers of nodes, of which one process takes two minutes: what every process
does for all points (basis, update, 2.4 s) stays, and slabs thinner than two layers share no assembly. So some 30 processes are worth their while, and no process needs less than the memory of
all points.

"""

SHARING = """### Two processes

The first steps of the slope with a weak layer in 3D, 262,200 points and 101,197 unknowns, by conjugate gradients (`scripts/bench sharing`, at revision {revision}): one process with one thread and with two, and two processes
with one thread each, with all points in both and with points divided by `mpm.add`, in turn; of each the quickest of five runs, with the parts of each process. What a process waits for another is in the parts where they meet. `agree`: checksum of the points before a step; the
one after it is part of the update. Measured with precedence over other programs (`chrt`). With the first step comes what it takes to begin MPI and to open PETSc, some 0.2 s, in what is from and to bodies. Memory is the peak of the process.

"""

WAYS = dict(undivided='in all processes', appended='appended as a list, then divided', added='divided, by `mpm.add`', tall='the same, cut across its longest side')

PIECES = """### Scenes of which processes divide the points

Small scenes of `shared.py` with `distributed`, each of one feature or two, `newton.tolerance` 1e-10: the largest difference of positions from those of one process, and of forces on boundaries, bodies and loaded surfaces as a part of the largest one
(`scripts/bench pieces`, at revision {revision}). Where K is not symmetric, one process and several have different preconditioners, and numbers of solves may differ.

"""

DIVISION = """### Points divided among processes

Peak of memory (VmHWM) of the process that has most, at the stages of a run: before there are points, when the block of {points} points in 3D is filled, after each of two elastic steps by conjugate
gradients (`scripts/bench division`, at revision {revision}); one thread each. With `MpmImplicitEngine.distributed` and `O.bodies.append(mpm.fill(...))` each process makes all points and erases the others' at the first
step; with `mpm.add` it makes its own only. Slabs are cut across the last axis, here the second longest side of the block, and each process has copies of the points up to two cells beyond its nodes; the last rows have
the same block turned. Measured beside other programs, on which memory does not depend; times would.

"""

LARGE = """### A million points in 3D

The slope at h = 0.5 m with 2 x 2 x 2 points a cell and 115 cells deep, two threads: the step from load factor 0.5 to 0.6, the third after 0.25 and 0.5 (`scripts/bench --large`).
Memory is the peak beside YADE's own: the bodies and all that a step takes.

"""

BODIES = """### Filling

A scene filled with material points (`mpm.fill`), and one with spheres (`utils.sphere` in a list), in processes of their own.

"""


if __name__ == '__main__': writeKept(here)
