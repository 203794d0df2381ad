# SPDX-License-Identifier: GPL-2.0-or-later
"""The code is formatted as .clang-format says, which has the command that does it."""
import re
import subprocess

import pytest
from conftest import root


def test_codeIsFormatted():
	version = subprocess.run(['clang-format', '--version'], stdout=subprocess.PIPE, text=True).stdout
	if ' version 14.' not in version: pytest.skip(f'Debian 12 has clang-format 14, and others format otherwise: {version.strip()}')
	sources = [path for folder in ('plugin', 'tests') for path in (root / folder).rglob('*.[ch]pp')]
	assert len(sources) > 100
	run = subprocess.run(['clang-format', '--dry-run', '--Werror', *sources], cwd=root, stderr=subprocess.PIPE, text=True)
	wrong = re.findall(r'^(?:.*/)?((?:plugin|tests)/.*:\d+):\d+: error', run.stderr, re.MULTILINE)
	assert run.returncode == 0, f'{len(wrong)} places differ, in files {sorted({place.split(":")[0] for place in wrong})}, first {wrong[:5]}'
