# SPDX-License-Identifier: GPL-2.0-or-later
"""Output for a user while an analysis runs, and the numbers for YADE's plot."""
import os
import re

from conftest import Yade

line = re.compile(r'load factor (\S+), step (\d+)(?:/(\d+))?, \d+:\d\d elapsed, (?:\d+:\d\d left, )?(\d+) iterations, \d+ cuts, residual \S+, (\d+) points')

runs = '''
import sys
from scenes import *
for verbosity in 0, 1, 2:
	O.reset()
	solver = column(8)
	solver.verbosity = verbosity
	sys.stderr.write(f'verbosity {verbosity}\\n')
	sys.stderr.flush()
	O.run(10, wait=True)
solver.newton.maxIterations, solver.newton.minStep = 1, 1
try: O.run(10, wait=True)
except RuntimeError as error: sys.stderr.write(str(error))
'''


def test_inALog(yade):
	said = yade(runs).stderr.split('verbosity ')[1:]
	quiet, normal, all_ = (line.findall(text) for text in said)
	assert quiet == []
	assert [found[1:3] for found in normal] == [('10', '10')]  # at the end
	assert [int(found[1]) for found in all_] == list(range(1, 11))
	assert [float(found[0]) for found in all_] == [i / 40 for i in range(1, 11)]
	assert {(found[2], found[4]) for found in all_} == {('10', '32')}


def test_steps_in_time(yade):
	"""Time instead of a load factor, how many steps are made in a second, and no residual where nothing is solved; a failure is said once."""
	run = yade('''
import sys
from scenes import *
for scheme in 'newmark', 'explicit':
	O.reset()
	static = column(8)
	O.engines = [MpmDynamicEngine(grid=static.grid, gravity=static.gravity, boundaries=static.boundaries, scheme=scheme, verbosity=2)]
	O.dt = 1e-3
	O.run(50, wait=True)
sys.stderr.write('failure\\n')
O.dt = 10
O.run(5, wait=True)
''', fails=True)
	said, failed = run.stderr.split('failure\n')
	found = re.findall(r'^time (\S+) s, step (\d+)/50, \d+:\d\d elapsed, (?:\d+:\d\d left, )?(\S+) steps/s, (\d+ iterations, \d+ cuts, residual \S+, )?32 points$', said, re.MULTILINE)
	assert [int(step) for _, step, *_ in found] == 2 * [*range(1, 51)] and [bool(solved) for *_, solved in found] == 50 * [True] + 50 * [False]
	assert all(abs(float(time) - 1e-3 * int(step)) < 1e-9 and 0 < float(rate) < 1e6 for time, step, rate, _ in found)
	assert 'nan' not in said and failed.count('above the critical one') == 1, failed


def test_onATerminal(tmp_path):
	"""Redrawn in place, no longer than the terminal is wide, and ended before anything else is said."""
	terminal, side = os.openpty()
	yade = Yade(tmp_path)
	(tmp_path / 'script.py').write_text('from scenes import *\nsolver = slope(0.5, 4)\nO.run(40, wait=True)\nimport sys; sys.stderr.write("done\\n")')
	yade(tmp_path / 'script.py', stderr=side)
	os.close(side)
	shown = b''
	while chunk := _read(terminal):
		shown += chunk
	text = shown.decode()
	drawn = text.split('\r\x1b[K')[1:]
	assert len(drawn) >= 2, repr(text)
	assert not any('\n' in part for part in drawn[:-1])
	assert 'step 40/40' in drawn[-1] and drawn[-1].splitlines()[1] == 'done'


def _read(terminal):
	try:
		return os.read(terminal, 65536)
	except OSError:  # nobody writes any more
		return b''


def test_plotData(yade):
	"""Against the weight, against sums over the arrays, and Clapeyron's theorem: half the work of gravity is stored."""
	run = yade('''
import json
from scenes import *
from yade import plot
solver = column(8)
O.materials[0].young = 1e8  # so that all is linear
first = solver.plotData()
plot.plots = {'loadFactor': ('settlement', 'reaction_y'), 'step': ('iterations',)}
O.engines += [PyRunner(iterPeriod=1, initRun=True, command='plot.addData(**solver.plotData())')]
O.run(40, wait=True)
data, points = solver.plotData(), mpm.arrays()
area = solver.grid.cellSize
elastic = 0.5 * np.sum(points['volume'] * (points['stress'] * points['elasticStrain']).sum(axis=(1, 2)))
settled = -(points['pos'] - points['pos0'])[:, 1]
assert plot.data['step'] == list(range(1, 41)) and plot.data['reaction_y'][-1] == data['reaction_y']
plot.plot(noShow=True).savefig('plot.png')
O.reset()
yielding = slope()
O.run(12, wait=True)
share, plastic = yielding.plotData()['plasticShare'], mpm.arrays()['plasticStrain'] > 0
print(json.dumps([first, data, area * 50 * 800, elastic, settled.max(), share, plastic.mean()]))
''')
	first, data, weight, elastic, settlement, share, plastic = run.result
	assert first['step'] == 0 and first['settlement'] == 0 and first['reaction_y'] != first['reaction_y']  # NaN before the first step
	assert data['step'] == 40 and abs(data['loadFactor'] - 1) < 1e-12 and data['points'] == 32
	assert abs(data['reaction_y'] / weight - 1) < 1e-9 and data['reaction_y'] == data['reaction2_y']
	assert abs(data['reaction0_x'] + data['reaction1_x']) < 1e-6 * weight
	assert abs(data['settlement'] - settlement) < 1e-12 * settlement
	assert abs(data['elasticEnergy'] / elastic - 1) < 1e-9
	assert abs(data['elasticEnergy'] / (-0.5 * data['gravityPotential']) - 1) < 0.01
	assert 0 < share < 1 and abs(share - plastic) < 1e-9  # all points have the same volume
	assert (run.folder / 'plot.png').stat().st_size > 5000
