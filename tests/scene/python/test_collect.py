# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.note and mpm.collect: a batch, gathered."""
import csv
import os
import shutil
import subprocess

import pytest
from conftest import outcomesOf, root

refused = [
        ('mpm.note("out")', 'ValueError', ['no results']),
        ('mpm.note(3, a=1)', 'TypeError', ['folder = 3']),
        ('mpm.note("out", a=[1])', 'TypeError', ['a = [1]']),
        ('mpm.collect("nothing")', 'ValueError', ["'nothing'", 'mpm.note']),
        ('mpm.note("some", a=1.5); mpm.collect("some", x="b")', 'ValueError', ["x = 'b'"]),
        ('mpm.note("some", a=1.5); mpm.collect("some", y=["aa"])', 'ValueError', ["y = 'aa'", 'a']),
        ('mpm.note("words", a="good"); mpm.collect("words")', 'ValueError', ['no result is a number']),
        ('mpm.note("some", a=1.5); mpm.collect("some", table="none.table")', 'FileNotFoundError', ['none.table']),
        ('os.makedirs("bad", exist_ok=True); open("bad/x.note.json", "w").write("{"); mpm.collect("bad")', 'ValueError', ['x.note.json']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('collect'), 'import os\nfrom yade import mpm\n', [statement for statement, _, _ in refused])


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_isRefused(outcomes, statement, exception, words):
	kind, sentence = outcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence


def test_a_batch(yade):
	"""Runs of yade-batch, one of which fails: rows in order of the parameters, with what each has noted, and the failed one without; a warning names it."""
	(yade.folder / 'run.py').write_text('''
from yade import mpm, utils
utils.readParamsFromTable(M=1., soil='clay', depth=3, noTableOk=True)
from yade.params.table import M, soil
if M == 4: raise SystemExit(1)
mpm.note('out/batch', **{'settlement [mm]': 8 / M * (2 if soil == 'peat' else 1), 'held': M > 1})
''')
	(yade.folder / 'batch.table').write_text("description M soil\nc 4 'clay'\na 2 'clay'\nb 1 'clay'\nd 2/2 'peat'\ne 2 'peat'\n")
	command = ['/usr/bin/yade-batch', '--executable', shutil.which(yade.command), '--jobs', '2', '--log', str(yade.folder / '@.log'), 'batch.table', 'run.py']
	subprocess.run(command, cwd=yade.folder, env=os.environ | yade.ownSettings(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
	run = yade('''
import json
from yade import mpm
found = mpm.collect('out/batch', table='batch.table')
print(json.dumps({name: column.tolist() for name, column in found.items()}))
''')
	found = run.result
	assert found['description'] == ['b', 'd', 'a', 'e', 'c'] and found['M'] == [1, 1, 2, 2, 4] and found['soil'] == ['clay', 'peat', 'clay', 'peat', 'clay']
	assert found['settlement [mm]'][:4] == [8, 16, 4, 8] and found['settlement [mm]'][4] != found['settlement [mm]'][4] and found['depth'][:4] == [3] * 4
	assert '1 of 5 runs' in run.stderr + run.stdout and ': c; their logs' in run.stderr + run.stdout
	rows = list(csv.DictReader(open(yade.folder / 'out/batch/collected.csv')))
	assert [row['description'] for row in rows] == found['description'] and float(rows[1]['settlement [mm]']) == 16
	assert (yade.folder / 'out/batch/collected.png').stat().st_size > 10000


def test_each_description_has_a_note_of_its_own(yade):
	"""Descriptions that differ only in signs that no file name has, and long ones that differ at their end."""
	assert yade('''
import json
from yade import mpm
descriptions = ['phi:30', 'phi_30', 'E=1e7*2', 'E=1e7_2', 'd=1', 'a' * 300 + '1', 'a' * 300 + '2']
for number, description in enumerate(descriptions):
	O.tags['description'] = description
	mpm.note('out', settlement=number)
	mpm.note('out', settlement=number)
found = mpm.collect('out')
print(json.dumps(sorted(found['description'].tolist()) == sorted(descriptions) and sorted(found['settlement'].tolist()) == list(range(7))))
''').result
