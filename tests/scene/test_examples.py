# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples run, in a short form where they are long, and leave something to look at."""
import os
import re
import shutil
import subprocess

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


def test_mpm_vs_dem(yade):
	"""So few grains say little of a continuum, but all parts run, and both carry the weight above before the cut fails."""
	run = yade(root / 'examples' / 'mpm_vs_dem' / 'mpm_vs_dem.py', '--grains', 8, '--sample', 10, '--cells', 8, '--duration', 4)
	E, nu = numbers(r'E = (\S+) MPa, nu = (\S+),', run)
	assert 3 < E < 8 and 0.15 < nu < 0.35
	for name in 'DEM', 'MPM':
		pressure, weight = numbers(name + r': mean vertical pressure over 0 < x < H: (\S+) kPa at N = 3 \(weight: (\S+)\)', run)
		assert abs(pressure / weight - 1) < 0.15
	assert (run.folder / 'out/mpm_vs_dem/mpm_vs_dem.png').stat().st_size > 50000
	parts = re.findall(r'timestep="(\S+)" part="(\d)" file="(\S+)"', (run.folder / 'out/mpm_vs_dem/both.pvd').read_text())
	assert all((run.folder / 'out/mpm_vs_dem' / file).exists() for _, _, file in parts)
	assert len({time for time, part, _ in parts if part == '0'} & {time for time, part, _ in parts if part == '1'}) == 21


def test_batch_of_an_example(yade):
	"""Lines of a table become runs with their own options and folders; the rest of the options keep their defaults."""
	(yade.folder / 'cells.table').write_text('description cells ghostFactor\ncoarse 8 0.01\nplain 16 0\n')
	command = ['/usr/bin/yade-batch', '--executable', shutil.which(yade.command), '--jobs', '1', '--log', str(yade.folder / '@.log'), 'cells.table', str(root / 'examples/column/column.py')]
	subprocess.run(command, cwd=yade.folder, env=os.environ | yade.ownSettings(), timeout=120, check=True, stdin=subprocess.DEVNULL, capture_output=True)
	for name, error in ('coarse', '1.12729015e-02'), ('plain', '3.65890602e-03'):
		log = (yade.folder / f'{name}.log').read_text()
		assert f'stress error (eq. 7): {error}' in log, log
		assert (yade.folder / f'out/column-{name}/column.png').exists()
