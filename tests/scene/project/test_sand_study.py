# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/sand in its shortest form: limit loads of strips and thrusts on walls on the coarsest grid, against what is exact."""
import csv
import os
import subprocess

import pytest
from conftest import Yade, root

from sand.tables import extrapolated, tables


def test_three_grids_are_extrapolated_by_the_order_that_they_show():
	assert extrapolated([1 + 1., 1 + .5, 1 + .25]) == pytest.approx(1)
	assert extrapolated([1 + 1., 1 + .25, 1 + .0625]) == pytest.approx(1)
	assert extrapolated([2., 1., 1.5]) == 2  # no order is shown: the first
	row = dict.fromkeys(['iterations', 'cuts', 'points', 'seconds', 'why'], '') | {'group': 'factors', 'case': 'N_q, 20', 'with': '1 x 1', 'exact': '2', 'quarter': '', 'whole': '2.2', 'late': ''}
	loads, limits = (rows[1] for _, _, rows in tables([row | dict(grid=grid, quarter=load) for grid, load in (('B/9', '4'), ('B/17', '3'), ('B/33', '2.5'))]))
	assert loads[:7] == ['N_q, 20', '1 x 1', 'B/9', '2', '4 (+100.0 %)', '2.2 (+10.0 %)', '-'] and limits == ['N_q, 20', '1 x 1', '+0.0 %', '+10.0 %']


def test_one_point_a_cell_is_right_on_coarse_grids_and_four_are_not(yade):
	"""Nine cells over the width. Each point asks for its own dilation, of which four in a cell that changes its volume as one get the largest: N_gamma is too large by a half."""
	out = yade.folder / 'out'
	environment = os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}
	for group, grid in (('factors', 'B/9'), ('early', 'B/9'), ('limit', 'B/9'), ('walls', 'H/5')):
		subprocess.run([root / 'scripts/sand', group, '--grid', grid, '--out', out], env=environment, check=True, capture_output=True, timeout=120)
	with open(out / 'results' / 'sand.csv', newline='') as file:
		off = {(row['case'], row['with']): float(row['whole']) / float(row['exact']) - 1 for row in csv.DictReader(file)}
	assert len(off) == 48
	for (case, points), error in off.items():
		if case.startswith('K'): assert abs(error) < .02, (case, points, error)
		elif points.startswith(('1 x 1', '10 steps', '40 steps')): assert abs(error) < .12, (case, points, error)
		elif case.startswith(('N_q', 'N_c')): assert 0 < error < .06, (case, points, error)
		else: assert .4 < error < .65, (case, points, error)


def test_conditions_do_not_depend_on_how_little_of_a_cell_is_filled(yade):
	"""Elastic and where all points yield, with the stabilisation that is advised for limit loads of sand."""
	out = yade.folder / 'out'
	environment = os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}
	for part in '0.1', '0.01', '1e-08':
		subprocess.run([root / 'scripts/sand', 'cuts', '--only', '2D', '--grid', part, '--out', out], env=environment, check=True, capture_output=True, timeout=120)
	with open(out / 'results' / 'sand.csv', newline='') as file:
		number = {(row['case'], row['with'], row['grid']): float(row['condition']) for row in csv.DictReader(file)}
	for state, most in ('elastic, 2D', 1e5), ('flowing, 2D', 2e5):
		advised = [number[state, 'aggregates, memory 1, factor 1e-3', part] for part in ('0.1', '0.01', '1e-08')]
		assert max(advised) < most and advised[2] < 1.3 * advised[1], advised
		assert number[state, 'no stabilisation', '1e-08'] > 1e30 * max(advised)
