# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of all validation: it is what the kept tables say, no comparison of an example is left out, and a run gives again what is kept."""
import os
import re
import shutil
import subprocess
import sys

import pytest
from conftest import root

sys.path.insert(0, str(root / 'scripts' / 'lib'))
import studies
import validation
from test_words import words

home = root / 'plugin/docs/studies/validation'

# Words by which a script says that it prints a number of others beside its own
compares = re.compile(r"\bprint\(.*(closed form|exact \S*\{|by hand|published|elastica|limit analysis|half space|Lame |Hertz|Prandtl|Timoshenko|theory|reference)")
# Studies that compare the scenes of other examples on many grids, in tables of their own, estimates of errors, and debris, whose force nothing is known of
others = {'discretisation', 'trade', 'extremes', 'load_steps', 'splitting', 'paper', 'benchmarks', 'debris'}


def test_the_page_is_what_the_tables_say():
	made = list(validation.tables(validation.everything()))
	assert [(row['file'], row['title']) for row in studies.indexOf(home)] == [(file, title) for file, title, *_ in made]
	for file, _, rows, _ in made: assert studies.rowsOf(home / file) == [[str(cell) for cell in row] for row in rows], file


def test_the_page_of_one_screen_is_what_the_tables_say():
	"""At most 800 words with its tables; each comparison is of one kind, and each row has a command."""
	made, kept = list(validation.summary(validation.everything())), root / 'plugin/docs/studies/how_right'
	assert [(row['file'], row['title']) for row in studies.indexOf(kept)] == [(file, title) for file, title, *_ in made]
	for file, _, rows, _ in made: assert studies.rowsOf(kept / file) == [[str(cell) for cell in row] for row in rows], file
	assert words((root / 'plugin/docs/studies/how_right.md').read_text()) <= 800
	(_, _, sources, _), (_, _, groups, _) = made
	assert sum(row[1] for row in sources[1:]) == sum(row[1] for row in groups[1:]) == sum(map(len, validation.everything().values()))
	assert all('`' in row[-1] for row in groups[1:] + sources[1:])
	kinds = dict(zip(['Terzaghi 1923', 'CalculiX 2.20, CPE4', 'Lube et al. 2005, experiments', 'Briaud and Gibbens 1994, field', 'its weight'], validation.kinds))
	assert {source: validation.kindOf(source) for source in kinds} == kinds


def test_each_run_has_rows_and_each_row_a_run():
	"""Tables of the same commands, in the same order; tables of what is run no more would stay otherwise."""
	for folder, commands in validation.runs.items():
		rows = validation.kept(folder)
		assert list(dict.fromkeys(row['command'] for row in rows)) == [validation.commandOf(folder, command) for command in commands], folder
		assert all(list(row) == validation.columns and row['source'] and float(row['theirs']) for row in rows), folder
	shown = {folder for folders in validation.groups.values() for folder in folders}
	assert shown == set(validation.everything()) and {path.parent.name for path in (root / 'examples').glob('*/compared.csv')} == set(validation.runs)


def test_no_comparison_of_an_example_is_left_out():
	"""A script that prints a number beside that of others keeps it, too, and is among the runs; so is each folder of examples that is no study."""
	for script in (root / 'examples').glob('*/*.py'):
		text, folder = script.read_text(), script.parent.name
		if folder in others or folder == 'tasks': continue
		if compares.search(text): assert 'compared(' in text, script
		if 'compared(' in text: assert any(command.split()[0] == script.name for command in validation.runs[folder]), script
	folders = {path.parent.name for path in (root / 'examples').glob('*/README.md')}
	assert folders - others == set(validation.runs) - {'tasks'}


def test_tests_that_name_what_they_are_held_against_are_listed():
	"""Each listed one is there; each that names a closed form or its author in its docstring or comments is listed."""
	tests, listed = list(validation.ofTests()), [row['test'] for row in validation.closedForms()]
	assert len(set(listed)) == len(listed) > 70 and not set(listed) - {name for _, name, _ in tests}
	assert not [name for _, name, said in tests if validation.words.search(said) and name not in listed]
	sample = 'def test_a(x):\n\t"""Load by Rankine. More."""\n\texact = 1\n\n\ndef test_b():\n\t"""Nothing."""\n'
	assert [name for name, said in validation._documented(sample) if validation.words.search(said)] == ['test_a']
	assert list(validation._commented('\t// by hand\n\tTEST(A, b)\n\t{\n\t}\n')) == [('A.b', 'by hand')]


def test_a_run_gives_again_what_is_kept(yade, tmp_path):
	environment = os.environ | yade.ownSettings() | {'YADE': shutil.which(yade.command)}
	command = [root / 'scripts/validate', '--run', 'column', '--out', tmp_path]
	subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True, timeout=120)
	again, kept = validation.kept('column', tmp_path), validation.kept('column')
	assert [row['quantity'] for row in again] == [row['quantity'] for row in kept]
	assert all(float(row['ours']) == pytest.approx(float(other['ours']), rel=1e-6) for row, other in zip(again, kept))
	assert (tmp_path / 'README.md').exists() and (tmp_path / 'validation.png').stat().st_size > 20000


def test_wrong_arguments_are_refused():
	for arguments, said in (['--run', 'none'], 'there is no folder none'), (['column'], 'named with --run'):
		ended = subprocess.run([root / 'scripts/validate', *arguments], capture_output=True, text=True)
		assert ended.returncode == 1 and said in ended.stderr
