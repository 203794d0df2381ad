# SPDX-License-Identifier: GPL-2.0-or-later
"""Needs of scripts/hosts, which takes too long to be run here. YADE's build settings are read from its files."""
import json
import subprocess

import pytest
from conftest import compiled, root, systemYade


def said(*command, fails=False):
	ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
	assert (ended.returncode != 0) == fails, ended.stdout
	return ended.stdout


def test_help():
	assert 'sid' in said(root / 'scripts/hosts', '--help')
	assert 'unknown argument 11' in said(root / 'scripts/hosts', '11', fails=True)


def test_packagesThatMakeRoots():
	for package in 'mmdebstrap', 'debian-archive-keyring':
		assert 'Version: ' in said('apt-cache', 'show', package)


def test_mirror():
	"""Source of apt's packages, from which the roots are made."""
	text = (root / 'scripts/hosts').read_text()
	mirror = text[text.index('mirror() {'):text.index('# Option of apt')]
	assert said('bash', '-c', mirror + 'mirror').startswith('http')


def test_scenesForTheOthers(yade):
	"""Saved scenes for the other releases are loaded here, and a difference is noticed."""
	yade(root / 'scripts/lib/saved.py', yade.folder, 'here', 'save')
	run = yade(root / 'scripts/lib/saved.py', yade.folder, 'here', 'load')
	assert run.stdout.count('goes on and ends as where it was saved') == 2, str(run)
	end = json.loads((yade.folder / 'here.json').read_text())
	end['shear'][3] += 1
	(yade.folder / 'here.json').write_text(json.dumps(end))
	assert 'shear differs by 1,' in yade(root / 'scripts/lib/saved.py', yade.folder, 'here', 'load', fails=True).stderr


@pytest.fixture(scope='module')
def configured(tmp_path_factory):
	"""Output of CMake for a YADE whose config.py has been changed."""
	tmp_path = tmp_path_factory.mktemp('host')
	(tmp_path / 'CMakeLists.txt').write_text(f'cmake_minimum_required(VERSION 3.25)\nproject(host LANGUAGES CXX)\ninclude({root}/plugin/yade_api/host.cmake)\n')
	folder = tmp_path / 'yade'
	(folder / 'py/yade').mkdir(parents=True)
	(folder / 'libpkg_common.so').symlink_to(systemYade / 'libpkg_common.so')

	def configure(old, new, library='', fails=True):
		config = (systemYade / 'py/yade/config.py').read_text()
		assert old in config
		(folder / 'py/yade/config.py').write_text(config.replace(old, new))
		(folder / 'libyade.so').unlink(missing_ok=True)
		if library: compiled(library, folder / 'libyade.so')
		else: (folder / 'libyade.so').symlink_to(systemYade / 'libyade.so')
		return ' '.join(said('cmake', '-G', 'Ninja', '-S', tmp_path, '-B', tmp_path / 'build', f'-DYADE_DIR={folder}', '-DCMAKE_CXX_COMPILER_WORKS=1', fails=fails).split())

	return configure


@pytest.mark.parametrize(
        'old, new, reason', [
                (' OPENMP', '', 'is built without OPENMP, which the plugin needs'),
                (' LOGGER', '', 'is built without LOGGER, which the plugin needs'),
                (' LOGGER', ' LOGGER VECTORIZE', 'is built with VECTORIZE, which aligns its vectors otherwise'),
                (' LOGGER', ' LOGGER MASK_ARBITRARY', 'does not tell the size of its masks'),
                ('highPrecisionBits         =64', 'highPrecisionBits         =128', 'computes with numbers of 128 bits'),
        ]
)
def test_refusedYade(configured, old, new, reason):
	assert reason in configured(old, new)


def test_featuresThatChangeTheLayout(configured):
	mask = 'namespace std { template <unsigned long> class bitset; } namespace yade { struct Body { bool maskOk(const std::bitset<100>&) const; }; }\n' \
	       'bool yade::Body::maskOk(const std::bitset<100>&) const { return true; }'
	text = configured(' LOGGER', ' LOGGER SPH LIQMIGRATION DEFORM MASK_ARBITRARY', library=mask, fails=False)
	for macro in 'SPH', 'LIQMIGRATION', 'DEFORM', 'MASK_BITS=100':
		assert f'YADE_API_{macro}' in text, text
