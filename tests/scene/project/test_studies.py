# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/extremes, scripts/trade, scripts/bench and mpm.advise, in their shortest forms."""
import csv
import json
import os
import shutil
import subprocess
import sys

import pytest
from conftest import root

sys.path.insert(0, str(root / 'scripts' / 'lib'))
from worker import runCases


@pytest.fixture
def study(yade):
	"""study(script, ...) runs one of scripts/ with the YADE under test and returns what it printed."""

	def run(script, *arguments, fails=False):
		environment = os.environ | yade.ownSettings() | {'YADE': shutil.which(yade.command)}
		ended = subprocess.run([root / 'scripts' / script, *map(str, arguments)], cwd=yade.folder, env=environment, capture_output=True, text=True, timeout=120)
		assert (ended.returncode != 0) == fails, ended.stdout + ended.stderr
		assert 'Traceback' not in ended.stderr, ended.stderr
		return ended.stderr if fails else ended.stdout

	return run


def rows(path):
	with open(path, newline='') as file:
		return list(csv.DictReader(file))


def test_extremes(study, tmp_path):
	arguments = 'contrast', 'turns', 'points', 'softening', 'camClay', 'hardeningPower', 'power', 'viscosity', 'softeningGrid', 'contactPenalty', 'contactClamped', '--quick', '--out', tmp_path / 'out'
	assert '31 cases to run' in study('extremes', *arguments)
	results = {(row['axis'], row['ghost']): row for row in rows(tmp_path / 'out/results/atlas.csv')}
	for ghost in 'none', 'mesh-independent', 'paper':
		assert all(float(results[law, ghost]['error']) < .05 for law in ('softening', 'camClay', 'hardeningPower', 'power', 'viscosity'))
		assert float(results['contrast', ghost]['error']) < .05 # soft layers are not locked by the stabilisation of stiff ones
	assert float(results['turns', 'mesh-independent']['error']) < 1e-6 and int(results['turns', 'mesh-independent']['maxIterations']) <= 6
	assert results['turns', 'none']['failure'] == results['points', 'none']['failure'] == 'singular'
	assert .3 < float(results['softeningGrid', 'mesh-independent']['measured']) < .95 # part of the load before it softened
	assert float(results['contactPenalty', 'none']['error']) < .01 and float(results['contactClamped', 'mesh-independent']['error']) < .01
	page = (tmp_path / 'out/README.md').read_text()
	assert '| the same on all grids |' in page
	assert '| contrast |' in page and '**singular**' in page
	assert (tmp_path / 'out/outcomes-grid.png').stat().st_size > 10000
	assert '0 cases to run' in study('extremes', *arguments)


def test_what_cannot_be_run_is_refused_in_a_sentence(study, tmp_path):
	(tmp_path / 'file').touch()
	(tmp_path / 'own.py').touch()
	own, vary = ('trade', 'own.py', '--quantity', 'x', '--reference', 'h=4'), ('--vary', 'h=1,2')
	(tmp_path / 'other/results').mkdir(parents=True)
	(tmp_path / 'other/results/own.csv').write_text('n,wall\n1,2\n')
	for arguments, said in {
	        ('extremes', 'slopeFactor', '--quick'): 'axis slopeFactor has no quick values',
	        ('extremes', 'points', '--quick', '--out', 'file'): 'nothing can be written to the folder file/results (--out): Not a directory',
	        ('extremes', 'points', '--time-limit', 'inf'): 'inf is not a time > 0',
	        ('ground', '--seeds', '3:x'): '3:x is not admitted: give numbers >= 0, as FROM:TO or 3,17,45',
	        (*own[:2], *vary): '--quantity or --error',
	        own: 'name what is to be varied',
	        (*own, *vary, *vary): 'given twice',
	        (*own, '--vary', 'h=1,,2'): 'is not NAME=VALUE,VALUE',
	        (*own, *vary, '--out', 'file'): 'nothing can be written',
	        (*own, *vary, '--out', 'other'): 'own.csv is a table of other runs: its columns are n, wall, and not h, wall,',
	        ('trade', 'none.py', *vary): 'no such script: none.py',
	        ('trade', 'slope', *vary): 'for a script of your own',
	        ('bench', 'nonsense'): 'no part nonsense; there are kernels',
	        ('bench', 'start', '--out', 'file'): 'nothing can be written',
	        ('bench', '--compare', 'nonsense'): 'nonsense',
	        ('reproduce', 'fig2', '--out', 'file'): 'nothing can be written'
	}.items():
		assert said in study(*arguments, fails=True), arguments


def test_cases_that_end_their_process(tmp_path):
	worker = tmp_path / 'worker.py'
	worker.write_text('''
import json, os, sys, time
for i, case in enumerate(json.load(open(sys.argv[1]))):
	print(json.dumps(dict(begins=i)), flush=True)
	if case == 'crash': os.abort()
	if case == 'hang': time.sleep(60)
	print('{ no JSON')
	print(json.dumps(dict(ends=i, result=[case])), flush=True)
''')
	cases = ['a', 'crash', 'hang', 'crash', 'b']
	assert list(runCases([sys.executable, worker], cases, timeLimit=1)) == [('a', ['a']), ('crash', 'crash'), ('hang', 'timeout'), ('crash', 'crash'), ('b', ['b'])]
	worker.write_text('raise SystemExit(3)')
	with pytest.raises(RuntimeError, match='exit code 3'):
		list(runCases([sys.executable, worker], cases, timeLimit=1))


def test_trade_of_a_scene_of_ones_own(study, tmp_path):
	script = tmp_path / 'own.py'
	script.write_text('''
import sys
sys.path.insert(0, {scenes!r})
readParamsFromTable(noTableOk=True, cells=4, steps=5)
from yade.params import table
from scenes import column, columnError
engine = column(table.cells)
O.dt = 1 / table.steps
O.run(table.steps, wait=True)
if table.cells == 8 and table.steps == 2: raise RuntimeError('on purpose')
stress, exactly = columnError() + 1, columnError()
'''.format(scenes=str(root / 'tests' / 'scene')))
	arguments = 'trade', script, '--vary', 'cells=4,8', '--vary', 'steps=2,10', '--quantity', 'stress', '--reference', 'cells=16,steps=10', '--out', tmp_path / 'out'
	assert 'own, 1 threads: 5 cases to run' in study(*arguments)
	results = {(row['cells'], row['steps']): row for row in rows(tmp_path / 'out/results/own.csv')}
	assert 'on purpose' in results['8', '2']['failure']
	assert float(results['16', '10']['stress']) < float(results['8', '10']['stress']) < float(results['4', '10']['stress'])
	assert float(results['4', '2']['cpu']) > 0
	page = (tmp_path / 'out/README.md').read_text()
	ended = [row for row in results.values() if not row['failure'] and row['cells'] != '16'] # all of them within 5 % of the reference
	cheapest = min(ended, key=lambda row: float(row['cpu'])) # whichever it is: they take milliseconds
	assert f"| cells {cheapest['cells']}, steps {cheapest['steps']}: {float(cheapest['cpu']):.2f} s" in page and (tmp_path / 'out/own.png').stat().st_size > 10000
	assert 'own, 1 threads: 0 cases to run' in study(*arguments)


def test_trade_where_nothing_can_be_compared(study, tmp_path):
	(tmp_path / 'own.py').write_text('error = .5')
	study('trade', 'own.py', '--vary', 'threads=1', '--error', 'error') # a table of parameters without columns
	assert '| own | 50.00 % |' in (tmp_path / 'out/trade/README.md').read_text()
	for reference, said in ('0,', 'gives x = 0'), ('nan,on purpose', 'has not come to its end: on purpose'):
		(tmp_path / 'out/trade/results/own.csv').write_text('h,wall,cpu,memory,solves,x,failure\n1,1,1,1,1,1,\n4,1,1,1,1,' + reference + '\n')
		study('trade', 'own.py', '--vary', 'h=1', '--quantity', 'x', '--reference', 'h=4')
		assert said in (tmp_path / 'out/trade/README.md').read_text()


def test_trade_of_a_built_in_scene(study, tmp_path):
	study('trade', 'cantilever', '--quick', '--out', tmp_path / 'out')
	assert '| cantilever | tipX, tipY |' in (tmp_path / 'out/README.md').read_text()


def test_trade_of_a_scene_that_locks(study, tmp_path):
	study('trade', 'beam', '--quick', '--out', tmp_path / 'out')
	errors = {row['fBar']: abs(float(row['error'])) for row in rows(tmp_path / 'out/results/beam.csv')}
	assert errors['1'] < 0.15 < 0.5 < errors['0']


noPictures = '.picture = lambda *a: None; '
writers = { # without the pictures, which take long
        'extremes': f'import overview; overview{noPictures}' + 'overview.write({0!r})',
        'discretisation': f'import page; page{noPictures}' + 'page.write({0!r})',
        'benchmarks': 'import page; page.writeKept({0!r}, {0!r})',
        'load_steps': f'import page; page{noPictures}' + 'page.write({0!r})',
        'trade': f'import overview; overview{noPictures}' + 'overview.write({0!r})'
}


@pytest.mark.parametrize('study', writers)
def test_kept_pages_are_made_from_the_kept_tables(study, tmp_path):
	kept = root / 'examples' / study
	shutil.copytree(kept / 'results', tmp_path / 'results')
	subprocess.run(['/usr/bin/python3', '-c', writers[study].format(str(tmp_path))], cwd=kept, check=True)
	pages = kept / 'README.md', root / f'plugin/docs/studies/{study}.md'
	for page in pages[:2 if study == 'benchmarks' else 1]:
		assert (tmp_path / page.name).read_text() == page.read_text()


@pytest.mark.parametrize('study, tables', {
        'extremes': 'import page; page.draw = lambda *a: []; tables = page.tables(page.read({0!r}), {1!r})',
        'trade': 'import page; page.picture = lambda *a: None; from plans import plans; tables = page.tables({0!r}, plans, {1!r})',
        **dict.fromkeys(['discretisation', 'load_steps'], 'import page; tables = page.tables({0!r})')
}.items())
def test_kept_tables_are_made_from_the_kept_runs(study, tables, tmp_path):
	kept, made = root / 'examples' / study, tmp_path / 'made'
	write = "; import studies; studies.keepAll({1!r}, [table for table in tables if table[2]], '')"
	subprocess.run(['/usr/bin/python3', '-c', f'import sys; sys.path.append({str(root / "scripts/lib")!r}); ' + (tables + write).format(str(kept), str(made))], cwd=kept, check=True)
	paths = sorted(path for path in (root / 'plugin/docs/studies' / study).glob('*.csv') if path.name != 'tables.csv')
	assert [path.name for path in paths] == sorted(path.name for path in made.glob('*.csv') if path.name != 'tables.csv') and len(paths) > 2
	for path in paths: assert (made / path.name).read_text() == path.read_text(), path


@pytest.mark.parametrize('study', ['trade', 'extremes'])
def test_a_page_fits_on_a_screen(study):
	"""Lines of 200 characters, and a picture of two thirds of its width; and it says something of all that is in it."""
	text = (root / 'examples' / study / 'README.md').read_text()
	assert sum(max(1, -(-len(line) // 200)) for line in text.splitlines()) <= 65 and text.count('![') == 1
	assert 'nan' not in text.split() and '**Three settings worth knowing**' in text and '**Never worth it**' in text
	for safe in 'overlap of the body', 'size of a cell', "Young's modulus", 'rotation of a bar': # no matter, the page of extremes says; the table has those that have a limit
		assert f'| {safe}' not in text


def test_advice(yade):
	run = yade('''
import json
from scenes import *
found = {}
for name, engine in ('slope', lambda: slope(1, 3)), ('column', lambda: column(8, dim=3)), ('weak', lambda: slope(1, 1, factor=0)):
	O.reset()
	solver = engine()
	before = mpm.arrays()
	advice = mpm.advise(solver)
	assert all((before[k] == v).all() for k, v in mpm.arrays().items()) and O.iter == 0
	if name != 'weak': O.step()
	found[name] = dict(advice, stepped=solver.dofs)
O.reset()
solver = slope()
O.engines += [MpmVtkRecorder(fileName='slope-', iterPeriod=2)]
for dt in 1 / 100, 1e-6, 1e-320, 0.1:
	O.dt = dt
	advice = mpm.advise()
	found[f'{dt:g}'] = [advice['steps'] if dt > 1e-300 else 'inf', ' '.join(sentence for sentence in advice['advice'] if any(word in sentence for word in ('steps', 'output')))]
O.dt, solver.iterPeriod = 1e-6, 1000
advice = mpm.advise()
found['by iterPeriod'] = [advice['steps'], ' '.join(advice['advice'])]
O.reset()
for wrong in 1, None:
	try: mpm.advise(wrong)
	except (TypeError, ValueError) as error: found[str(wrong)] = str(error)
print(json.dumps(found))
''')
	slope, column, weak = (run.result[name] for name in ('slope', 'column', 'weak'))
	for scene, points, steps in (slope, 2460, 40), (column, 64, 40):
		assert scene['dofs'] == scene['stepped'] > 0
		assert (scene['points'], scene['steps']) == (points, steps)
		assert 0 < scene['fastest'] < scene['secondsPerStep'] < scene['slowest'] and scene['memory'] > 1e6
	says = lambda scene, text: any(text in sentence for sentence in scene['advice'])
	assert says(slope, 'pointsPerCell=2') and says(column, 'dim=2') and says(column, 'tolerance') and says(weak, 'stabilisation: it is off') and says(slope, 'mpm.discretisationError(run, cellSize=1) of any result, for 5 to 8 times')
	assert not says(slope, 'dim=2') and not says(slope, 'stabilisation')
	assert 'unknowns: ' in run.stdout
	many = {name: run.result[name] for name in ('0.01', '1e-06', '9.99989e-321', '0.1', 'by iterPeriod')}
	assert [steps for steps, _ in many.values()] == [100, 1000000, 'inf', 10, 1000]
	assert '25 steps instead of 100' in many['0.01'][1] and '160 steps instead of 1000000' in many['1e-06'][1] and "instead" not in many["0.1"][1]
	assert 'iterPeriod 6.2 times as large: 160 steps instead of 1000' in many['by iterPeriod'][1]
	assert 'about 286 GiB' in many['1e-06'][1] and 'was O.dt forgotten?' in many['9.99989e-321'][1] and 'forgotten' not in many['1e-06'][1]
	assert 'must be an MpmImplicitEngine' in run.result['1'] and 'O.engines holds no' in run.result['None']


def test_bench(study, tmp_path):
	study('bench', 'sizes', 'bodies', '--quick', '--out', tmp_path / 'out')
	results = json.loads((tmp_path / 'out/results/bench.json').read_text())
	assert [(r['points'], r['steps']) for r in results['sizes']] == [(1095, 2), (4370, 2)]
	for r, loaded in zip(results['sizes'], (2 / 20, 2 / 40)):
		assert r['solves'] < r['passes'] and 0 < r['times']['assembly'] < r['run']
		assert r['displacement'] == pytest.approx(1.27 * loaded, rel=.02) # elastic so far
	assert results['bodies']['points']['bodies'] == results['bodies']['spheres']['bodies'] == 10000
	page = (tmp_path / 'out/README.md').read_text()
	assert '## Size' in page and '| 10000 spheres |' in page and '## A million' not in page
	printed = study('bench', '--large', '--quick', '--out', tmp_path / 'out')
	step = json.loads((tmp_path / 'out/results/bench.json').read_text())['large']
	assert f"{step['points']} points" in printed and 's per solve' in printed and 'bytes per point' in printed
	assert step['yielded'] > .9 and step['last']['residual'] <= 1e-6 and 0 < step['last']['run'] < step['run'] and step['last']['solves'] < step['solves']
	assert '## A million points in 3D' in (tmp_path / 'out/README.md').read_text()
