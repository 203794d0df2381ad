# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.view: what is in its files, read as the page reads it, and, where there is a browser, what that draws."""
import base64
import json
import re
import shutil
import subprocess
import zlib

import numpy as np
import pytest
from conftest import outcomesOf

refused = [
        ('mpm.view("x.htm5")', 'ValueError', ["'x.htm5'", '.html']),
        ('mpm.view(3)', 'TypeError', ['fileName = 3']),
        ('mpm.view("x.html", [])', 'TypeError', ['fields = []']),
        ('mpm.view("x.html", 3)', 'TypeError', ['fields = 3']),
        ('mpm.view("x.html", "sress_xy")', 'ValueError', ["'sress_xy'", 'stress']),
        ('mpm.view("x.html", every=-1)', 'ValueError', ['every = -1', '>= 0']),
        ('mpm.view("x.html", every=1.5)', 'ValueError', ['every = 1.5']),
        ('mpm.view("x.html", fps=0)', 'ValueError', ['fps = 0']),
        ('mpm.view("x.html", range=(0, 1))', 'TypeError', ['range = (0, 1)', 'dict']),
        ('mpm.view("x.html", range={"volume": (0, 1)})', 'ValueError', ["'volume'", 'displacement']),
        ('mpm.view("x.html", range={"displacement": (1, 0)})', 'ValueError', ['increasing']),
        ('O.bodies.clear(); mpm.view("x.html")', 'ValueError', ['no material points']),
        ('mpm.view("/proc/x/y.html")', 'FileNotFoundError', ['/proc/x']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('view'), 'from scenes import *\n', [statement for statement, _, _ in refused], before='O.reset(), column(8)')


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_isRefused(outcomes, statement, exception, words):
	kind, sentence = outcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence


def unpacked(page):
	"""Data of the page: data, and of each state columns (C, N) and arrays of bodies."""
	data = json.loads(re.search(r'<script id="data"[^>]*>(.*?)</script>', page, re.DOTALL)[1].replace('<\\/', '</'))
	array = lambda text, kind: np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)
	before, states = None, []
	for frame in data['frames']:
		values = array(frame['points'], np.uint16)
		if frame['sinceLast']: values = values + before  # they wrap around
		before = values
		bodies = {name: states[-1][1][name] if frame[name] is None else array(frame[name], np.float32) for name in ('spheres', 'boxes', 'triangles')}
		states.append((values.reshape(data['columns'], -1).astype(float) / 65535, bodies))
	return data, states


def test_a_run_in_the_plane(yade):
	"""States, titles, places, deformed boxes and fields are those of the run; nothing is fetched."""
	run = yade('''
import json
from scenes import *
slope()
film = mpm.view('out/slope.html', ['plasticStrain', 'stress_xy'], every=10, range={'plasticStrain': (0, .1)})
O.run(25, wait=True)
film.finish()
points = mpm.arrays()
print(json.dumps([film.frames, [e.label for e in O.engines], points['pos'].tolist(), (points['defGrad'] * points['halfSize0'][:, None, :]).tolist(), points['stress'][:, 0, 1].tolist()]))
''')
	frames, labels, pos, edges, stress = run.result
	page = (run.folder / 'out/slope.html').read_text()
	data, states = unpacked(page)
	assert frames == len(states) == 4 and labels == ['solver'] and not re.search(r'https?:|src=|@import|url\(', page)
	assert [frame['title'] for frame in data['frames']] == ['load factor 0', 'load factor 0.25', 'load factor 0.5', 'load factor 0.625']
	low, high, reach = (np.array(data[name]) for name in ('low', 'high', 'reach'))
	last = states[-1][0]
	assert np.abs(low[:2, None] + last[:2] * (high - low)[:2, None] - np.array(pos).T[:2]).max() < 1e-3
	assert np.abs(reach * (2 * last[2:6] - 1) - np.array(edges)[:, :2, :2].reshape(-1, 4).T).max() < 1e-3
	field = data['fields'][1]
	assert np.abs(field['stored'][0] + last[-1] * np.diff(field['stored']) - stress).max() < 2e-5 * np.abs(stress).max()
	assert [f['name'] for f in data['fields']] == ['plasticStrain', 'stress_xy'] and [data['fields'][0][end] for end in ('low', 'high')] == [0, 0.1]
	assert field['low'] == -field['high'] and (field['unit'], field['size'], field['label']) == ('kPa', 1000, 'stress σ_xy')
	assert data['fields'][0]['stored'][0] == 0 and all(frame['sinceLast'] for frame in data['frames'][1:]) and len(page) < 150e3


@pytest.fixture(scope='module')
def space(tmp_path_factory):
	"""A column of cubes with a ball that moves, a box, a facet, a wall, and a point that has been taken away; what the script tells, and the file."""
	from conftest import Yade
	run = Yade(tmp_path_factory.mktemp('space'))('''
import json
from scenes import *
from yade import utils
solver = column(4, dim=3, width=2)
O.run(1, wait=True)
O.materials.append(FrictMat())
ball = O.bodies[O.bodies.append(utils.sphere((12.5, 57, 12.5), 5, color=(1, 0, 0)))]
O.bodies.append([utils.box((30, 5, 12.5), (3, 5, 3), color=(0, 1, 0)), utils.facet([(30, 0, 0), (40, 0, 0), (30, 0, 25)], color=(0, 0, 1)), utils.wall(-2, axis=1)])
film = mpm.view('out/space.html', 'stress_yy', every=1)
O.step()
ball.state.pos += (0, 3, 0)
O.bodies.erase(int(mpm.arrays()['id'][-1]))
O.step()
film.finish()
print(json.dumps([mpm.arrays()['pos'].tolist(), len(mpm.arrays()['id'])]))
''')
	return run.result, run.folder / 'out/space.html'


def test_bodies_in_space(space):
	(pos, number), path = space
	data, states = unpacked(path.read_text())
	assert [columns.shape[1] for columns, _ in states] == [number + 1, number + 1, number] and [frame['sinceLast'] for frame in data['frames']] == [False, True, False]
	low, high = np.array(data['low']), np.array(data['high'])
	assert np.abs(low + states[-1][0][:3].T * (high - low) - pos).max() < 2e-3 and data['up'] == 1
	balls = [bodies['spheres'].tolist() for _, bodies in states]
	assert balls[0] == balls[1] == [12.5, 57, 12.5, 5, 1, 0, 0, 0] and balls[2][1] == 60 and data['frames'][1]['spheres'] is None
	boxes = states[0][1]['boxes'].reshape(-1, 16)
	assert boxes[0].tolist() == [30, 5, 12.5, 3, 0, 0, 0, 5, 0, 0, 0, 3, 0, 1, 0, 0] and len(boxes) == 2 and boxes[1, 1] == -2
	assert states[0][1]['triangles'].reshape(-1, 7)[:, :3].tolist() == [[30, 0, 0], [40, 0, 0], [30, 0, 25]]
	assert high[0] >= 40 and high[1] >= 65


browser = shutil.which('chromium') or shutil.which('chromium-browser') or shutil.which('google-chrome')


@pytest.mark.skipif(not browser, reason='there is no Chromium: apt install chromium')
def test_the_browser_draws_it(space, tmp_path):
	"""Pictures of a whole, a cut and a turned body: it draws something, less of it when cut, another face when turned, says what is in the middle, and plays."""
	(pos, number), path = space

	def shown(address):
		command = [browser, '--headless=new', '--no-sandbox', '--enable-unsafe-swiftshader', '--use-angle=swiftshader', f'--user-data-dir={tmp_path}', '--virtual-time-budget=4000', '--window-size=800,600']
		page = subprocess.run([*command, '--dump-dom', f'file://{path}{address}'], capture_output=True, text=True, timeout=60).stdout
		found = re.search(r'data-ready="([^"]*)"', page)
		assert found, page[-2000:]
		return json.loads(found[1].replace('&quot;', '"'))

	whole, cut, turned = shown(''), shown('#frame=0&cut=y:0.4'), shown('#turn=180:0&frame=0&play')
	assert turned['frame'] == whole['frame'] == 2 and cut['frame'] == 0 and turned['middle'] != whole['middle']
	assert whole['frames'] == 3 and whole['points'] == number and cut['points'] == number + 1
	assert 0.02 < cut['drawn'] < 0.9 * whole['drawn'] < 0.5
	x = pos[whole['middle']]
	assert whole['said'].startswith('point at ' + str(float(f'{x[0]:.4g}')).removesuffix('.0')) and 'stress σ_yy: ' in whole['said'] and 'kPa' in whole['said']
