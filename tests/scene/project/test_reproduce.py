# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/reproduce: a fast part of the paper's figures and tables, by the scripts of examples/paper."""
import csv
import math
import shutil
import subprocess

import pytest
from conftest import root

paper = root / 'examples' / 'paper'


def rows(path):
	with open(path, newline='') as file:
		return list(csv.DictReader(file))


def numbers(path, *columns):
	return [tuple(float(row[name]) for name in columns) for row in rows(path)]


def writePage(folder, *options):
	subprocess.run(['/usr/bin/python3', paper / 'page.py', '--out', folder, *options], check=True, stdout=subprocess.DEVNULL)
	return (folder / 'README.md').read_text()


@pytest.fixture
def quick(yade):
	"""quick(target) runs a script of examples/paper and returns the folder of its tables."""

	def run(*targets):
		for target in targets:
			yade(paper / f'{target}.py', '--quick', '--out', yade.folder / 'out')
		return yade.folder / 'out' / 'results'

	return run


def test_figure_2(quick):
	results = quick('fig2')
	reference = {a: expected for a, *expected in numbers(root / 'tests/data/fig2.csv', 'a', 'cond_mpm', 'cond_gimp', 'cond_gimp_ghost')}
	ours = numbers(results / 'fig2.csv', 'offset', 'mpm', 'gimp', 'ghost')
	assert len(ours) == 21
	for offset, *kappas in ours:
		assert kappas == pytest.approx(reference[offset], rel=1e-6), offset

	beyond = {(edge, distance): kappas for edge, distance, *kappas in numbers(results / 'fig2-edges.csv', 'edge', 'distance', 'mpm', 'gimp', 'ghost')}
	assert len(beyond) == 30
	for edge in 0, 1, 2:
		assert beyond[edge, 1e-5][1] / beyond[edge, 1e-3][1] == pytest.approx(1e4, rel=0.01) # distance to the power -2
		assert beyond[edge, 1e-9] == pytest.approx(reference[edge], rel=1e-6) # round-off populates no cell
		assert max(beyond[edge, 10.**-i][2] for i in range(3, 13)) < 2600 # in the limit, 2590 for this block


def test_figure_4(quick):
	errors = {(ghost, float(cells)): float(error) for _, cells, steps, ghost, error, _ in map(dict.values, rows(quick('fig4') / 'fig4.csv')) if steps == '40'}
	for ghost in 'none', 'mesh-independent', 'paper':
		for cells in 4, 8, 16:
			assert 1.5 < math.log2(errors[ghost, cells] / errors[ghost, 2 * cells]) < 2


def test_both_scalings(quick):
	table = rows(quick('scaling') / 'scaling.csv')
	for ghost, low, high in ('none', 1, 1 + 1e-6), ('mesh-independent', 1, 1 + 1e-6), ('paper', 1000, math.inf):
		ours = [row for row in table if row['ghost'] == ghost]
		assert len(ours) == 7
		kappas, errors = ([float(row[name]) for row in ours] for name in ('conditionNumber', 'error'))
		assert low <= max(kappas) / min(kappas) < high
		assert ghost == 'paper' or max(errors) / min(errors) < 1 + 1e-6


def test_tables_pictures_and_page(quick):
	results = quick('table1', 'table2', 'fig6', 'fig7')
	runs = {(float(row['pointsPerCell']), float(row['factor']), row['lineSearchTrials']): row for row in rows(results / 'slope.csv')}
	table1, table2 = ([(2, 0), (4, 0), (2, 1e-2), (4, 1e-2)], [(3, factor) for factor in (0, 1e-8, 1e-6, 1e-4, 1e-2)])
	assert sorted(runs) == sorted([(*key, '0') for key in table1 + table2] + [(*key, '5') for key in table2])
	for (pointsPerCell, factor, lineSearch), row in runs.items():
		assert (row['completed'] == row['steps'] == '40') == (row['failure'] == '')
		if factor >= 1e-4: assert row['completed'] == '40' and int(row['maxIterations']) <= 20

	page = writePage(results.parent)
	for section in 'Table 1', 'Table 2', 'Figures 6 and 7':
		assert f'## {section}' in page
	for row in runs.values():
		outcome = f"({int(row['maxIterations']) + 1}) |" if row['failure'] == '' else f"fails after step {row['completed']} |"
		assert outcome in page
	for picture in 'fig6.png', 'fig7.png', 'oscillation.png':
		assert f']({picture})' in page and (results.parent / picture).stat().st_size > 10000


def test_an_interrupted_run_continues(quick):
	table = quick('fig2') / 'fig2.csv'
	head, first, second, *others = table.read_text().splitlines()
	table.write_text('\n'.join([head, '0.0,1,2,3', *others]))
	quick('fig2')
	assert table.read_text().splitlines() == [head, '0.0,1,2,3', *others, second]


def test_the_page_of_an_interrupted_run(tmp_path):
	(tmp_path / 'results').mkdir()
	for name, count in ('fig4', 5), ('scaling', 3), ('table1-tolerance', 3):
		lines = (paper / 'results' / f'{name}.csv').read_text().splitlines()
		(tmp_path / 'results' / f'{name}.csv').write_text('\n'.join(lines[:1 + count]) + '\n')
	page = writePage(tmp_path)
	assert '## Figure 4' in page and '## Beyond the paper' in page


def test_the_kept_pages_are_made_from_the_kept_tables(tmp_path):
	"""The short page of the example, and that of the study with all tables."""
	shutil.copytree(paper / 'results', tmp_path / 'results')
	assert writePage(tmp_path, '--kept', tmp_path) == (paper / 'README.md').read_text()
	study = (tmp_path / 'paper.md').read_text()
	assert study == (root / 'plugin/docs/studies/paper.md').read_text() and all(f'## {section}' in study for section in ('Figure 2', 'Table 1', 'Table 2'))


def test_wrong_arguments_are_refused():
	for arguments, message in (['fig3'], 'there is no figure or table fig3'), ([], 'nothing to run'):
		ended = subprocess.run([root / 'scripts/reproduce', *arguments], capture_output=True, text=True)
		assert ended.returncode == 1 and message in ended.stderr
