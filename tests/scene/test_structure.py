# SPDX-License-Identifier: GPL-2.0-or-later
"""Dependencies point downwards: python -> engine -> core, engine -> yade_api, and within the core from folder to folder."""
import re

import pytest
from conftest import root

plugin = root / 'plugin'

# what the core may include besides the standard library, whose headers have no folder and no suffix
coreIncludes = re.compile(r'<\w+>|<(unsupported/)?Eigen/\w+>|<(cholmod|umfpack|omp)\.h>|"core/\w+/\w+\.hpp"')
# the interface to YADE may include anything but the classes and numerics that are built on it
interfaceIncludes = re.compile(r'<.*>|"yade_api/\w+\.hpp"')

# each folder of the core, and those below it
below = {
        'base': [],
        'grid': ['base'],
        'materials': ['base'],
        'solvers': ['base', 'grid', 'materials'],
        'terms': ['base', 'grid', 'materials', 'solvers'],
        'stepping': ['base', 'grid', 'materials', 'solvers', 'terms'],
}


def includes(folder):
	sources = [path for path in folder.rglob('*') if path.suffix in ('.hpp', '.cpp')]
	assert sources
	for path in sources:
		for included in re.findall(r'^\s*#\s*include\s*(\S+)', path.read_text(), re.MULTILINE):
			yield path, included


@pytest.mark.parametrize('folder, admitted', [('core', coreIncludes), ('yade_api', interfaceIncludes)])
def test_includesPointDownwards(folder, admitted):
	wrong = [f'{path.relative_to(plugin)}: {included}' for path, included in includes(plugin / folder) if not admitted.fullmatch(included)]
	assert not wrong


def test_foldersOfTheCoreIncludeThoseBelow():
	assert {path.name for path in (plugin / 'core').iterdir() if path.is_dir()} == set(below)
	wrong = []
	for path, included in includes(plugin / 'core'):
		target = re.match(r'"core/(\w+)/', included)
		if target and target[1] != path.parent.name and target[1] not in below[path.parent.name]: wrong.append(f'{path.relative_to(plugin)}: {included}')
	assert not wrong
