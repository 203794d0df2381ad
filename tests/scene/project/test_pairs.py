# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes of pairs of features do not depend on how they are looked at, and what does not go together is refused by name: the short form of scripts/pairs."""
import json
import os
import subprocess

import pytest

from conftest import Yade, root

from pairs.features import Plan, allPairs, features, ordered, refusals, refused
from pairs.kinds import kinds
from pairs.view import View
from worker import runCases

numberOf = dict(laws=5, flow=5, water=5, beams=5, bodies=4, contact=5, energy=5)
worker = root / 'scripts/lib/caserun.py'


def findings(folder, cases, monkeypatch, threads=2):
	"""All of them, each with its scene in front."""
	monkeypatch.setenv('PYTHONPATH', str(root / 'scripts/lib'))
	monkeypatch.setenv('OMP_WAIT_POLICY', 'passive')
	told = lambda chosen: chosen if isinstance(chosen, str) else ' '.join(chosen)
	found, number = [], 0
	functions = [('', 'pairs.checks.checkKind', dict(name=chosen, seed=seed)) if isinstance(chosen, str) else ('', 'pairs.checks.check', dict(chosen=chosen, seed=seed)) for chosen, seed in cases]
	for (chosen, seed), (_, result) in zip(cases, runCases([Yade(folder).command, '-n', '-x', f'-j{threads}', str(worker)], functions, 60)):
		number += 1
		if isinstance(result, str): found.append(f'{seed} {told(chosen)}: {result}')
		else: found += [f'{seed} {told(chosen)}: {line}' for line in result['findings']]
	assert number == len(cases)
	return found


def test_the_plan_has_every_pair_often_enough():
	"""Pairs of features that can be together; those that are refused stand alone, so that nothing else can be the reason."""
	counts = dict.fromkeys(allPairs, 0)
	for chosen in Plan().until(20):
		pairs = [ordered(a, b) for i, a in enumerate(chosen) for b in chosen[i + 1:]]
		assert len({tuple(refused[pair]) for pair in refusals(chosen)}) <= 1
		for pair in refusals(chosen) or pairs:
			counts[pair] += 1
	assert min(counts.values()) >= 20 and len(counts) > 800
	assert {feature for pair in counts for feature in pair} == set(features)


def test_scenes_of_pairs_do_not_depend_on_how_they_are_looked_at(tmp_path, monkeypatch):
	plan = Plan()
	plan.until(1)
	assert not findings(tmp_path, [(chosen, seed) for seed, chosen in enumerate(plan.scenes)][::2], monkeypatch)


def test_scenes_that_once_did(tmp_path, monkeypatch):
	"""Walls wider than the body, of which order of cells and round-off chose the cells they hang on; halves of points at a rigid body that they do not touch."""
	walls = [(['3d', 'elastic', 'static', wall], seed) for wall in ('roughWall', 'smoothWall') for seed in (0, 1)]
	halves = [('plane vonMises generalisedAlpha clump movedBody friction splitting pushed'.split(), 30)]
	halves += [('3d elastic newmark clump movedBody smoothWall fields movingWall splitting absorbing'.split(), 763)]
	assert not findings(tmp_path, walls + halves, monkeypatch)


def test_a_body_gives_no_energy_that_it_has_not(tmp_path, monkeypatch):
	"""To halves that meet where a round body has come between the corners of the whole; and a spring that has become stiffer with the soil is no edge that is passed too far."""
	halves = [('plane elastic generalisedAlpha sphere movedBody fields splitting pushed absorbing'.split(), 541), ('plane tresca midpoint clump movedBody pressure splitting'.split(), 1090)]
	stiffer = [('axisymmetric camClay newmark box movedBody waterLevel friction'.split(), 626), ('plane camClay midpoint clump movedBody fBar friction pressure'.split(), 337)]
	assert not findings(tmp_path, halves + stiffer, monkeypatch)


def test_point_loads_go_with_the_weight_of_a_stage(tmp_path, monkeypatch):
	assert not findings(tmp_path, [('plane vonMises static pressure pointLoad excavate'.split(), 1039)], monkeypatch)


def test_a_beam_that_nothing_holds_along_itself_stays(tmp_path, monkeypatch):
	"""Round-off of a pivot, and springs that all yield, once moved it by millimetres to metres."""
	assert not findings(tmp_path, [('beams', seed) for seed in (18, 65, 81)], monkeypatch, threads=1)


@pytest.mark.parametrize('kind', kinds)
def test_scenes_of_a_kind_do_not_depend_on_how_they_are_looked_at(tmp_path, monkeypatch, kind):
	"""Some of those that scripts/pairs --kind draws: with half the cell size and half the time step, too."""
	assert not findings(tmp_path, [(kind, seed) for seed in range(numberOf[kind])], monkeypatch, threads=1)


def test_a_kind_is_drawn_alike_in_all_copies():
	"""Numbers are drawn once, and neither cells and steps of half the size nor a view draw others."""
	for name, Kind in kinds.items():
		for seed in range(20):
			first, finer = Kind(seed), Kind(seed, finer=2)
			view = View(first.dim, first.isRing)
			assert Kind(seed).text(view) == first.text(view) == first.text(view), (name, seed)
			assert finer.cell == first.cell / 2 and finer.side == first.side and finer.end == pytest.approx(first.end), (name, seed)


def test_a_copy_that_differs_is_told(tmp_path, monkeypatch):
	"""Gravity, which does not turn with the soil in one of the copies."""
	own = tmp_path / 'own.py'
	own.write_text(
	        f'''
import json
import sys
sys.path.insert(0, {str(root / 'scripts/lib')!r})
from pairs.checks import checkKind
from pairs.kind import Text
write = Text.write
def wrong(text, **more):
	write(text, **more)
	if text.view.isMirrored: text.add('solver.gravity *= 1 + 1e-6')
print(json.dumps(checkKind('water', 1)))
Text.write = wrong
print(json.dumps(checkKind('water', 1)))
'''
	)
	right, wrong = (json.loads(line) for line in Yade(tmp_path)(own).stdout.splitlines() if line.startswith('{'))
	assert right['outcome'] == 'right' and right['error'] is None
	*found, sensitivity = wrong['findings']
	assert wrong['outcome'] == 'wrong' and all(line.startswith('mirrored: ') for line in found) and any('stress' in line for line in found), wrong
	assert sensitivity == 'gravity times 1 + 1e-14: no difference'


def test_a_scene_as_a_script_of_its_own(yade):
	"""It needs nothing of the generator, and gives what the worker has compared."""
	script = yade.folder / 'scene.py'
	subprocess.run([root / 'scripts/pairs', '--only', '0', '--times', '1', '--script', str(script)], check=True, env=os.environ)
	assert 'pairs' not in script.read_text()
	assert 'kineticEnergy' in yade(script).stdout or 'elasticEnergy' in yade(script).stdout
