# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples run, in a short form where they are long, and leave something to look at."""
import re

from conftest import root


def test_slope(yade):
	run = yade(root / 'examples' / 'slope' / 'slope.py')
	assert 'load steps completed: 40 of 40' in run.stdout
	assert re.search(r'iterations per step, mean \(max\): 5\.45 \(6\), paper: 5\.50', run.stdout), run.stdout
	assert 'largest displacement: 2.612404 m' in run.stdout
	assert (run.folder / 'out/slope/slope.png').stat().st_size > 20000
	assert (run.folder / 'out/slope/slope-points.pvd').read_text().count('<DataSet') == 11 # initial state and 10 more


def test_column(yade):
	run = yade(root / 'examples' / 'column' / 'column.py')
	error, reference = map(float, re.search(r'stress error \(eq\. 7\): (\S+), reference: (\S+)', run.stdout).groups())
	assert abs(error / reference - 1) < 1e-6
	height, exact = map(float, re.search(r'height: (\S+) m, exact: (\S+) m', run.stdout).groups())
	assert abs(height - exact) < 0.06 and exact == 24.0596
	assert (run.folder / 'out/column/column.png').stat().st_size > 5000


def test_column_of_cubes(yade):
	run = yade(root / 'examples' / 'column' / 'column.py', '--dim', 3, '--cells', 8)
	assert 'stress error (eq. 7): 1.12729015e-02' in run.stdout


def numbers(pattern, run):
	return list(map(float, re.search(pattern, run.stdout).groups()))


def test_cantilever(yade):
	run = yade(root / 'examples' / 'cantilever' / 'cantilever.py', '--cells', 2)
	down, elastica = numbers(r'= 10: tip down (\S+) L, elastica (\S+) L', run)
	assert abs(down / elastica - 1) < 0.005 and elastica == 0.81061
	assert (run.folder / 'out/cantilever/cantilever.png').stat().st_size > 20000


def test_collapse(yade):
	"""A coarse grid is too strong, by the figure that its page gives."""
	run = yade(root / 'examples' / 'collapse' / 'collapse.py', '--cellSize', 0.5, '--stepSize', 0.1, '--end', 5)
	failed, limit = numbers(r'fails at N = (\S+), limit analysis: \S+ to (\S+)', run)
	assert abs(failed - 4.345) < 0.01 and limit == 3.7776
	assert (run.folder / 'out/collapse/collapse.png').stat().st_size > 20000


def test_footing3d(yade):
	run = yade(root / 'examples' / 'footing3d' / 'footing3d.py', '--cells', 2, '--steps', 8)
	ratio, published = numbers(r'square over strip (\S+), published (\S+)', run)
	assert abs(ratio / published - 1) < 0.03
	assert (run.folder / 'out/footing3d/footing3d.png').stat().st_size > 20000
