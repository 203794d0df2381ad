# SPDX-License-Identifier: GPL-2.0-or-later
"""The cases of scripts/contacts are what their functions take, and are judged by their bounds."""
import ast
import json
import os
import subprocess

from conftest import Yade, root

from contacts.tables import misses, rows
from contacts.plan import Case, cases, derived

folder = root / 'scripts/lib/contacts'


def parametersOf(function):
	"""Names of what a function of the modules takes, and whether it takes others, too."""
	module, name = function.split('.')
	found = [node for node in ast.parse((folder / f'{module}.py').read_text()).body if isinstance(node, ast.FunctionDef) and node.name == name]
	assert len(found) == 1, function
	return {argument.arg for argument in found[0].args.args}, found[0].args.kwarg is not None


def test_the_cases_are_what_their_functions_take():
	assert len(cases) > 60
	for case in cases.values():
		names, takesOthers = parametersOf(case.function)
		assert takesOthers or set(case.arguments) | set(case.short) <= names, case.name
		assert 'seconds' in names and case.bounds and all(low < high for low, high in case.bounds.values()), case.name


def test_what_is_not_there_is_missed():
	case = Case('a', 'b.c', {}, {}, dict(N=(1, 2), part=(.9, 1)))
	assert misses(case, dict(N=1.5, part=1)) == [] and misses(case, dict(N=3., part=.5)) == ['N', 'part']
	assert misses(case, dict(N='nan', part=1)) == ['N'] and misses(case, dict(why='crash')) == ['N', 'part']
	assert rows(dict(a=case), dict(a=dict(N=3., part=1, why='it | stops'))) == [['a', 'N 3, part 1 — it / stops', 'N 1 ... 2; part 0.9 ... 1', '**N**']]


def test_the_limit_of_the_cone():
	"""Limit of N = 10 + 3 / cells, if three grids at least have got to the end, and as deep."""
	results = {f'cone-R{cells}': dict(part=1, reached=10, late=10 + 3 / cells) for cells in (2, 3, 4)}
	for more in {}, {'cone-R6': dict(part=1, reached=10, late=10.5)}, {'cone-R6': dict(part=1, reached=2, late=99)}:
		assert abs(derived['cone-limit'].function(results | more)['late'] - 10) < 1e-12
	assert derived['cone-limit'].function(results | {'cone-R3': dict(part=.5, reached=5, late=11)}) is None


def test_the_limit_of_the_vane():
	"""Limit of a torque of (1 + 1 / cells)^2, if all three grids have turned."""
	results = {f'vane-R{cells}': dict(turned=86, first=(1 + 1 / cells)**2, torque=(.9 + 2 / cells)**2) for cells in (4, 6, 10)}
	found = derived['vane-limit'].function(results)
	assert abs(found['first'] - 1) < 1e-12 and abs(found['torque'] - .81) < 1e-12
	assert derived['vane-limit'].function(results | {'vane-R6': dict(turned=10, first=1.2, torque=1.3)}) is None


def test_cases_that_are_right(yade):
	"""Cases by the command; its exit code tells what is not right."""
	out = yade.folder / 'out'
	right = ['edge-leaning', 'strip-3', 'plate', 'clumps', 'embracing', 'turn-plane-4-3', 'turn-normal', 'cylinder', 'ring-shear', 'energy-sticking']
	command = [root / 'scripts/contacts', *right, 'energy-random', '--short', '--seeds', '2:5', '--out', out]
	run = subprocess.run(command, env=os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}, capture_output=True, text=True, timeout=300)
	found = json.loads((out / 'contacts.json').read_text())
	assert set(found) == {*right, 'energy-random'}, run.stdout + run.stderr
	assert not [name for name in right if misses(cases[name], found[name])], run.stdout
	assert found['energy-random']['scenes'] == 3 and '| clumps |' in (out / 'README.md').read_text()
	assert run.returncode == int(any(misses(cases[name], result) for name, result in found.items()))


def test_bodies_of_points_that_meet_at_random(yade):
	"""The first eight of those that scripts/contacts draws."""
	out = yade.folder / 'out'
	command = [root / 'scripts/contacts', 'meeting', '--seeds', '0:8', '--out', out]
	run = subprocess.run(command, env=os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}, capture_output=True, text=True, timeout=300)
	found = json.loads((out / 'contacts.json').read_text())['meeting']
	assert found['scenes'] == found['touched'] == 8 and not misses(cases['meeting'], found), found
	assert run.returncode == 0


def test_random_scenes_end_in_balance(yade):
	"""The first thirty of those that scripts/contacts draws."""
	out = yade.folder / 'out'
	command = [root / 'scripts/contacts', 'random', '--seeds', '0:30', '--out', out]
	run = subprocess.run(command, env=os.environ | yade.ownSettings() | {'YADE': Yade(yade.folder).command}, capture_output=True, text=True, timeout=300)
	found = json.loads((out / 'contacts.json').read_text())['random']
	assert found['scenes'] == 30 and not misses(cases['random'], found), found
	assert run.returncode == 0
