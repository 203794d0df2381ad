# SPDX-License-Identifier: GPL-2.0-or-later
"""Page of where time and memory go, from results/bench.json."""
import json
import os
import shutil
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', '..', 'scripts', 'lib'))
import pages


def load(folder):
	"""The results in a folder; of a run that has not been made, nothing."""
	path = os.path.join(folder, 'results', 'bench.json')
	if not os.path.exists(path): return {}
	with open(path) as file:
		return json.load(file)


def write(folder, results):
	"""Results and page."""
	pages.replace(os.path.join(folder, 'results', 'bench.json'), json.dumps(results, indent='\t') + '\n')
	parts = [INTRODUCTION.format(**results['machine']), *pages.texts(os.path.join(folder, 'findings.md'))]
	parts += [section(results[name]) for name, section in sections.items() if name in results]
	pages.write(folder, parts)


def machine():
	"""What the times depend on."""
	with open('/proc/cpuinfo') as file:
		model = next(line.partition(':')[2].strip() for line in file if line.startswith('model name'))
	describe = ['git', '-C', here, 'describe', '--always', '--dirty']
	revision = subprocess.run(describe, capture_output=True, text=True).stdout.strip() if shutil.which('git') else ''
	return dict(processor=model, processors=os.cpu_count(), revision=revision or 'unknown')


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
	base = results['as it is']
	rows = []
	for name, r in results.items():
		times = split(r)
		rows.append([
		        name, f"{1e3 * r['run'] / r['steps']:.1f}", f"{r['run'] / base['run']:.2f}", f"{r['solves'] / r['steps']:.2f}",
		        *(f"{1e3 * times[phase] / r['steps']:.2f}" for phase in ('basis', 'ghost', 'assembly', 'factorise', 'update', 'rest'))
		])
	heads = ['setting', 'step [ms]', 'ratio', 'solves a step', 'of it basis', 'ghost', 'assembly', 'factorise', 'update', 'rest']
	return FEATURES.format(**base) + table(heads, rows)


def start(seconds):
	rows = [[what, f'{seconds[name]:.2f}', f"{seconds[name] - seconds['without']:+.2f}"] for name, what in STARTS.items()]
	return START + table(['YADE', 'start [s]', 'more than without'], rows)


def bodies(results):
	rows = []
	for name, r in results.items():
		n = r['bodies']
		rows.append([f'{n} {name}', f"{r['make']:.2f}", f"{r['append']:.2f}", f"{r['make'] + r['append']:.2f}", f"{r['memory'] / n / 1024:.2f}"])
	return BODIES + table(['', 'make [s]', 'O.bodies.append [s]', 'both [s]', 'memory [KiB each]'], rows)


sections = dict(kernels=kernels, scenes=scenes, sizes=sizes, features=features, start=start, bodies=bodies)


def comparison(found, revision):
	"""Times of this revision and another."""
	rows = [[part, f'{1e3 * ours:.4g}', f'{1e3 * theirs:.4g}', f'{ours / theirs:.2f}' if theirs else ''] for part, (ours, theirs) in found.items()]
	return table(['part', 'this revision [ms]', f'{revision} [ms]', 'this / other'], rows)


def table(heads, rows):
	return pages.table(heads, rows) + '\n'


INTRODUCTION = """# Where time and memory go

`scripts/bench` measures this page (see `--help`), from the parts of a load step to whole scenes; its numbers are in `results/bench.json`. Machine:
{processor}, {processors} processors. Revision: {revision}.
"""

KERNELS = """## Parts of a load step

On the slope of the paper half way through its failure, where points yield and cross cells: 17,440 points in 2D (4 x 4 a cell), 7,128 in 3D (2 x 2 x 2).
`residual` and `stiffness` are passes over the points without and with stiffness; `linearSolve` is factorisation and triangular solves, `unsymmetricSolve`
the same by LU for a matrix of the same pattern that is not symmetric. Memory is what the solver holds: the factor, and the matrix scaled.

"""

SCENES = """## Whole scenes

The slope at h = 0.25 m with 4 x 4 points a cell, all 160 steps; a slice of it in 3D, 4 cells of 0.5 m deep with 2 x 2 x 2 points a cell, its first 20 steps.
Seconds by phase, those of `solver.report()`. `check` is a look at all points before the first step; `rest` is YADE's loop and Python. All that is YADE: these, and
gathering the points from their bodies and writing them back. A pass evaluates the forces of all points, with or without
stiffness. Newton `full`: from zero, with a factorisation for each solve; `default`: with `newton.predictor` and `newton.reuseFactor`.

"""

SIZES = """## Size

The first two steps of the slope with 4 x 4 points a cell, one thread, on finer and finer grids. Memory of the scene is what filling it has added to the process;
that of the run is the peak on top of it.

"""

FEATURES = """## What each feature costs

The first {steps} steps of the slope at h = 0.5 m ({points} points, {unknowns} unknowns), one thread; each row differs from the first in one thing. Times are per step.

"""

STARTS = dict(without='without the plugin', plugin='with it', imported='with `from yade import mpm`')

START = """## YADE's start

A script that does nothing, the quickest of several starts taken in turn.

"""

BODIES = """## Filling

A scene filled with material points (`mpm.fill`), and one with spheres (`utils.sphere` in a list), in processes of their own.

"""
