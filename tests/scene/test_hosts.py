# SPDX-License-Identifier: GPL-2.0-or-later
"""What scripts/hosts needs is there; it takes too long to be run here."""
import subprocess

from conftest import root


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
	"""Where apt gets packages is what the roots are made from."""
	text = (root / 'scripts/hosts').read_text()
	mirror = text[text.index('mirror() {'):text.index('# Whether apt refuses')]
	assert said('bash', '-c', mirror + 'mirror').startswith('http')
