# SPDX-License-Identifier: GPL-2.0-or-later
"""The code is formatted as .clang-format says, which has the command that does it."""
import re
import subprocess

from conftest import root


def test_codeIsFormatted():
	sources = [path for folder in ('plugin', 'tests') for path in (root / folder).rglob('*.[ch]pp')]
	assert len(sources) > 100
	run = subprocess.run(['clang-format', '--dry-run', '--Werror', *sources], cwd=root, stderr=subprocess.PIPE, text=True)
	wrong = re.findall(r'^(?:.*/)?((?:plugin|tests)/.*:\d+):\d+: error', run.stderr, re.MULTILINE)
	assert run.returncode == 0, f'{len(wrong)} places differ, in files {sorted({place.split(":")[0] for place in wrong})}, first {wrong[:5]}'


def test_comments_of_the_core_begin_with_what_they_name():
	"""With a noun phrase or a verb, so that they are understood at first reading."""
	headless = re.compile(r'/[/*]+[!<]*\s*(Of|What|Who|Whoever|Whether|Where|How|As|By|Which|Whose|With|That)\b')
	found, comments = [], 0
	for path in sorted((root / 'plugin/core').rglob('*.[ch]pp')):
		before = ''
		for number, line in enumerate(path.read_text().splitlines(), 1):
			begin = re.search(r'(^|\s)//', line)
			if begin and not (line.lstrip().startswith('//') and before.lstrip().startswith('//')):
				comments += 1
				if headless.match(line[begin.start():].lstrip()): found.append(f'{path.relative_to(root)}:{number}')
			before = line
	assert comments > 3000
	assert not found
