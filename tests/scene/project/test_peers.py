# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/peers: its closed forms, its decks and what it reads, and its shortest form with those programs that are installed."""
import csv
import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import Yade, root

sys.path.insert(0, str(root / 'scripts' / 'lib'))
from peers import ample, by_ample, by_calculix, meshes
from peers.programs import lacking, programs, version
from peers.scenes import Beam, Cavity, Consolidation, Embankment, Footing, radial, surface


def test_a_layer_is_a_half_space_for_short_waves_and_a_spring_for_long_ones():
	E, nu = 1e7, 0.3
	G = E / 2 / (1 + nu)
	short, long = surface([50., 1e-4], 4, E, nu)
	normal, coupled = 4 * G * (1 - nu) / (3 - 4 * nu), 2 * G * (1 - 2 * nu) / (3 - 4 * nu)
	assert short / 50 == pytest.approx(np.array([[normal, -coupled], [-coupled, normal]]), rel=1e-9)
	modulus = E * (1 - nu) / (1 + nu) / (1 - 2 * nu)
	assert np.diag(long) * 4 == pytest.approx([G, modulus], rel=1e-6)


def test_a_cavity_that_stays_elastic_is_that_of_lame(monkeypatch):
	monkeypatch.setattr(Cavity, 'pressure', 0.5 * Cavity.strength)
	a, b, nu, E = Cavity.inner, Cavity.outer, Cavity.poisson, Cavity.young
	exact = (1 + nu) / E * Cavity.pressure / (b**2 / a**2 - 1) * ((1 - 2 * nu) + b**2 / a**2)
	assert radial(800) == pytest.approx(exact, rel=1e-5)


def test_values_that_all_are_compared_with():
	assert radial(200) * 1e3 == pytest.approx(Cavity.exact, rel=2e-4)
	assert Consolidation.exact == pytest.approx(np.sqrt(4 * Consolidation.end / np.pi), rel=0.01)  # drains as a half space at first
	assert 1.5 < Beam.exact < 1.7 and Footing.exact == pytest.approx(5.1416, rel=1e-5)


@pytest.mark.parametrize('order', [1, 2])
def test_meshes_cover_their_scenes(order):
	"""Areas by the corners of the elements; those of a lift have its height and mean width."""
	def area(mesh, block):
		corners = np.array([[mesh.nodes[n] for n in mesh.elements[e][:4]] for e in mesh.blocks[block]])
		x, y = corners[..., 0], corners[..., 1]
		return (x * np.roll(y, -1, 1) - y * np.roll(x, -1, 1)).sum() / 2

	s, mesh = Embankment(4), meshes.embankment(4, order)
	assert area(mesh, 'ground') == pytest.approx(Embankment.width * Embankment.depth)
	assert area(mesh, 'lift1') == pytest.approx(Embankment.lift * (s.toe(1) + s.toe(2)) / 2)
	assert len(mesh.nodes) == len({tuple(np.round(node, 6)) for node in mesh.nodes})
	wall = meshes.cavity(8, order).sides(lambda x, y: x * x + y * y < Cavity.inner**2 + 1e-9)
	assert len(wall) == Cavity(8).rows / order


def test_a_deck_of_calculix_and_what_it_prints():
	mesh, deck, result = by_calculix.beam(2, 'CPE8R')
	assert deck.count('*EQUATION') == 2 * 13 and 'TYPE=CPE8R' in deck and 'TYPE=B32' in deck and deck.rstrip().endswith('*END STEP')
	printed = by_calculix.read(' displacements (vx,vy,vz) for set ENDS and time  0.1E+01\n\n 94 0.0 -2.0E-03 0.0\n 106 0.0 -5.0E-04 0.0\n')
	assert list(printed) == ['displacements'] and result(printed) == pytest.approx(1.5)
	forces = by_calculix.read(' total force (fx,fy,fz) for set STRIP and time  0.5E+00\n\n 0.0 -1.0 0.0\n\n total force (fx,fy,fz) for set STRIP and time  0.1E+01\n\n 0.0 -2.5E+04 0.0\n')
	assert by_calculix.footing(4, 'CPE4')[2](forces) == pytest.approx(1)


def test_a_program_that_is_not_installed_is_named_with_its_package():
	environment = os.environ | dict(PATH='/nowhere')
	ended = subprocess.run(['/usr/bin/python3', root / 'scripts/study', 'peers', '--programs', 'GetFEM'], capture_output=True, text=True, env=environment)
	assert ended.returncode == 1 and 'GetFEM (package python3-getfem): not installed.' in ended.stderr
	assert 'footing: has no plasticity' in lacking('FEniCS') and lacking('CalculiX') == ''


def test_what_ample_lacks_is_named(tmp_path):
	ended = subprocess.run(['/usr/bin/python3', root / 'scripts/study', 'peers', '--ample', tmp_path, '--out', tmp_path / 'out'], capture_output=True, text=True)
	assert ended.returncode == 1 and 'setupGrid_beam.m' in ended.stderr and 'branch AMPLE-GS' in ended.stderr


def test_a_run_of_ample_has_its_tolerance_and_its_set_up(tmp_path):
	(tmp_path / 'ample.m').write_text('most = 10; tol = 1e-6;\n')
	by_ample.prepare(tmp_path, tmp_path / 'run', 'beam', 1e-9, 2)
	assert (tmp_path / 'run/ample.m').read_text() == 'most = 10; tol = 1e-09;\n' and 'rows = 2;' in (tmp_path / 'run/setupGrid.m').read_text()
	assert os.readlink(tmp_path / 'run/shipped.m') == str(tmp_path / 'setup/setupGrid_beam.m')
	(tmp_path / 'ample.m').write_text('')
	with pytest.raises(ValueError, match='sets tol 0 times'): by_ample.prepare(tmp_path, tmp_path / 'run', 'beam', 1e-9, 2)


def test_digits_that_agree():
	"""Of the largest difference over the largest movement, or stress; points in any order."""
	start = np.array([[0., 0], [1, 0]])
	theirs = np.array([start, start + (0, 2), start + (0, 4)]), np.array([[[0.], [0]], [[10], [5]], [[10], [5]]])
	mine = theirs[0] + [[[0, 0]], [[0, 2e-6]], [[0, 0]]], theirs[1] * 1.01
	swapped = tuple(values[:, ::-1] for values in mine)
	found = ample.digits(ample.sort(*swapped), ample.sort(*theirs))
	assert found[0] == pytest.approx([6, 16]) and found[1] == pytest.approx([2, 2])


@pytest.fixture(scope='module')
def results(tmp_path_factory):
	"""Rows of the coarsest grids by the plugin and the programs that are installed."""
	yade, out = Yade(tmp_path_factory.mktemp('yade')), tmp_path_factory.mktemp('peers')
	installed = [name for name in programs if version(name)]
	environment = os.environ | yade.ownSettings() | {'YADE': yade.command}
	arguments = ['--programs', *installed] if installed else ['--programs', 'none']
	subprocess.run([root / 'scripts/peers', '--quick', *arguments, '--out', out], env=environment, check=True, capture_output=True, timeout=300)
	with open(out / 'results/peers.csv', newline='') as file:
		return {(row['scene'], row['program'], row['elements']): row for row in csv.DictReader(file)}


def kept():
	found = {}
	for scene in 'footing', 'cavity', 'consolidation', 'beam', 'embankment':
		with open(root / f'plugin/docs/studies/peers/{scene}.csv', newline='') as file:
			for row in csv.DictReader(file): found.setdefault((scene, row['program'], row['elements']), float(row['value']))
	return found


@pytest.mark.parametrize('program', ['plugin', *programs])
def test_the_coarsest_grids_give_again_what_is_kept(results, program):
	if program != 'plugin' and not version(program): pytest.skip(f'{program} is not installed: package {programs[program].package}')
	of = {key: row for key, row in results.items() if key[1] == program}
	assert len(of) == {'plugin': 10, 'CalculiX': 10, 'GetFEM': 9, 'FEniCS': 3}[program]
	for key, row in of.items(): assert float(row['value']) == pytest.approx(kept()[key], rel=1e-3), (key, row['why'])
