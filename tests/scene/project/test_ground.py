# SPDX-License-Identifier: GPL-2.0-or-later
"""Engineering scenes drawn at random: the command, its table, and that the first thirty end."""
import csv
import os
import subprocess

from conftest import Yade, root

from ground.tables import findings, kinds


def test_the_tables_have_what_stops_or_is_wrong():
	row = dict(seed='1', scene='cut 2D sand', how='ends', part='1', why='', wrong='', solves='20', cuts='0', seconds='.5')
	rows = [row, row | dict(seed='2', how='stops', part='.5', why='it | stops'), row | dict(seed='3', wrong='thrust 3')]
	assert kinds(rows)[1][:8] == ['cut', '3', '2', '0', '0', '0', '1', '1']
	assert findings(rows)[1:] == [['2', 'cut 2D sand', '0.50', 'it / stops'], ['3', 'cut 2D sand', '1.00', 'wrong: thrust 3']]


def test_scenes_of_the_ground_end(yade):
	out = yade.folder / 'out'
	command = [root / 'scripts/ground', '--seeds', '0:30', '--out', out]
	run = subprocess.run(command, env=os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}, capture_output=True, text=True, timeout=300)
	with open(out / 'results' / 'ground.csv', newline='') as file:
		rows = list(csv.DictReader(file))
	assert len(rows) == 30 and len({row['scene'].split(' ')[0] for row in rows}) > 5
	# Some cuts in sand that nothing can hold stand all the same, on grids as coarse and in steps as few: they are told as wrong.
	assert not [row for row in rows if row['how'] == 'stops' or row['wrong'] and not (row['scene'].startswith('cut') and row['wrong'].startswith('moved'))], run.stdout + run.stderr
	assert 'scripts/ground --seeds 0:30' in (out / 'README.md').read_text()
