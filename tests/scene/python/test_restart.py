# SPDX-License-Identifier: GPL-2.0-or-later
"""A saved scene, loaded in a new process, goes on as if nothing had happened: bit for bit."""
import gzip
import os
import signal
import subprocess
import time

import numpy as np
import pytest
from conftest import Yade


@pytest.fixture(scope='module')
def saved(tmp_path_factory):
	"""Folder of scenes saved half way, in both formats, and of what became of them: without and with the predictor."""
	folder = tmp_path_factory.mktemp('saved')
	Yade(folder)('''
from scenes import *
for predictor in False, True:
	O.reset()
	solver = slope()
	solver.newton.predictor = predictor
	O.run(20, wait=True)
	O.save(f'half-{predictor}.xml.gz')
	O.save(f'half-{predictor}.yade.gz')
	O.run(20, wait=True)
	np.savez(f'uninterrupted-{predictor}.npz', **mpm.arrays(), iterations=solver.iterations)
''')
	return folder


@pytest.mark.parametrize('format, predictor', [('xml.gz', False), ('xml.gz', True), ('yade.gz', True)])
def test_saved_scene_continues_with_the_same_bits(yade, saved, format, predictor):
	yade(f'''
from scenes import *
O.load('{saved}/half-{predictor}.{format}')
assert O.iter == 20 and solver.loadFactor > 0.49, (O.iter, solver.loadFactor)
O.run(20, wait=True)
np.savez('continued.npz', **mpm.arrays(), iterations=solver.iterations)
''')
	whole, parts = np.load(saved / f'uninterrupted-{predictor}.npz'), np.load(yade.folder / 'continued.npz')
	assert len(whole['pos']) == 1095
	for name in whole:
		assert np.array_equal(whole[name], parts[name]), name


def test_a_scene_saved_in_memory_continues_with_the_same_bits(yade):
	"""O.saveTmp and O.loadTmp, also after other steps have been made, and with cut steps among them."""
	yade('''
from scenes import *
solver = slope(steps=8)
solver.newton.maxIterations = 5
O.run(5, wait=True)
O.saveTmp()
O.run(3, wait=True)
whole, outcome = mpm.arrays(), (solver.iterations, solver.cuts, solver.substeps, solver.loadFactor, solver.stepPart)
for attempt in range(2):
	O.loadTmp()
	solver = O.engines[0]
	assert O.iter == 5
	O.run(3, wait=True)
	points = mpm.arrays()
	assert all(np.array_equal(whole[name], points[name]) for name in whole)
	assert (solver.iterations, solver.cuts, solver.substeps, solver.loadFactor, solver.stepPart) == outcome
	solver.boundaries[0].fix = 'y' # of the loaded scene, not of the saved one
''')


def test_a_killed_run_continues_from_its_last_save_with_the_same_bits(yade):
	"""Saved by an engine in the middle of an iteration, and killed while it is at work."""
	script = yade.folder / 'script.py'
	script.write_text('''
from scenes import *
solver = slope(steps=400)
O.engines = O.engines + [PyRunner(iterPeriod=7, initRun=False, command="mpm.save('state.yade.gz')")]
O.run(400, wait=True)
''')
	state = yade.folder / 'state.yade.gz'
	process = subprocess.Popen([yade.command, '-n', '-x', '-j1', str(script)], cwd=yade.folder, env=os.environ | yade.ownSettings(),
	                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
	deadline = time.time() + 60
	while not state.exists() and time.time() < deadline:
		time.sleep(0.05)
	time.sleep(0.3)
	process.send_signal(signal.SIGKILL)
	process.wait()
	yade('''
import json
from scenes import *
from yade.wrapper import *
O.load('state.yade.gz')
saved = O.iter # of the iteration that had not ended
O.engines = O.engines[:1]
O.run(10, wait=True)
continued, factor = mpm.arrays(), solver.loadFactor
O.reset()
solver = slope(steps=400)
while solver.loadFactor < factor:
	O.step()
assert saved > 0 and solver.loadFactor == factor, (saved, solver.loadFactor, factor)
whole = mpm.arrays()
assert all(np.array_equal(whole[name], continued[name]) for name in whole)
''')


def test_saving_fails_with_a_reason(yade):
	yade('''
from scenes import *
slope()
import os, resource
open('plain', 'w').close()
os.mkdir('folder.xml')
def refused(file, error, words):
	try:
		mpm.save(file)
	except error as raised:
		assert words in str(raised) and f'.{os.getpid()}-' not in str(raised), raised
	else:
		assert False, file
for attempt in ('state.txt', ValueError, "'state.txt'"), ('.', ValueError, 'format'), (3, TypeError, 'save: file = 3 must be a path'), \
		('/proc/none/state.xml', OSError, "cannot be made: No such file or directory: '/proc/none/state.xml'"), \
		('plain/state.xml', OSError, "its folder cannot be made: File exists: 'plain/state.xml'"), ('folder.xml', OSError, "Is a directory: 'folder.xml'"):
	refused(*attempt)
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY)) # in the place of a full disk
for name in 'state.xml', 'state.yade.gz', 'state.xml.bz2':
	refused(name, OSError, f"File too large: '{name}'")
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
assert not [name for name in os.listdir('.') if 'state' in name], os.listdir('.')
''')


def test_missing_folders_are_made(yade):
	"""All functions that write files make them, without leaving anything else in them."""
	yade('''
import os
from scenes import *
solver = slope()
mpm.save('saved/deep/state.xml.gz')
mpm.export('exported/deep/points.csv')
mpm.plot(fileName='drawn/deep/slope.png')
O.engines += [MpmVtkRecorder(fileName='recorded/deep/slope-')]
O.engines[-1]()
assert os.listdir('saved/deep') == ['state.xml.gz'] and os.listdir('exported/deep') == ['points.csv'] and os.listdir('drawn/deep') == ['slope.png']
assert sorted(os.listdir('recorded/deep')) == ['slope-points.0.vtu', 'slope-points.pvd']
O.load('saved/deep/state.xml.gz')
assert len(O.bodies) == 1095
''')


@pytest.mark.parametrize('damage', ['truncated', 'foreign'])
def test_a_damaged_file_is_an_error_and_no_crash(yade, damage):
	run = yade(f'''
from scenes import *
slope()
mpm.save('state.xml.gz')
content = open('state.xml.gz', 'rb').read()
open('state.xml.gz', 'wb').write(content[:len(content) // 2] if '{damage}' == 'truncated' else b'not a scene')
O.load('state.xml.gz')
''', fails=True)
	assert run.exitCode == 1, str(run)


def test_results_do_not_depend_on_the_number_of_threads(yade):
	"""Also the sums over points have a fixed order; only the threads of the linear solver's BLAS may differ in the last digits."""
	script = '''
from scenes import *
slope(cellSize=0.5)
O.run(10, wait=True)
np.save('%d.npy', mpm.arrays()['pos'])
'''
	for threads in 1, 2, 8: # the last are more than many machines have cores
		yade(script % threads, threads=threads)
	one, *others = (np.load(yade.folder / f'{threads}.npy') for threads in (1, 2, 8))
	assert all(np.abs(one - other).max() < 1e-11 for other in others)


def changedFormat(path, changed):
	"""A saved scene in which a format is another one, by its kind: XML also without it, as before there were formats."""
	xml = gzip.open(path.with_name(path.name.replace('.yade.gz', '.xml.gz'))).read()
	grid = xml.index(b'<cellSize>')
	begin, end = xml.rindex(b'<format>', 0, grid), xml.rindex(b'</format>', 0, grid)
	number = int(xml[begin + len('<format>'):end])
	if path.name.endswith('.yade.gz'): content = gzip.open(path).read().replace(number.to_bytes(8, 'little'), (number ^ 1).to_bytes(8, 'little'))
	else: content = xml[:begin] + (b'' if changed == 'missing' else b'<format>1</format>') + xml[end + len('</format>'):]
	with gzip.open(path.with_name(f'{changed}-{path.name}'), 'wb') as file:
		file.write(content)
	return path.with_name(f'{changed}-{path.name}')


@pytest.mark.parametrize('kind, changed', [('xml.gz', 'other'), ('xml.gz', 'missing'), ('yade.gz', 'other')])
def test_a_scene_of_another_version_is_refused_by_name(yade, saved, kind, changed):
	path = changedFormat(saved / f'half-True.{kind}', changed)
	yade(f"""
from scenes import *
try:
	O.load('{path}')
except RuntimeError as error:
	assert str(error).startswith('MpmGrid was saved by another version of yade-mpm'), error
else:
	assert False, 'loaded'
O.load('{saved}/half-True.{kind}')
assert O.iter == 20
""")
