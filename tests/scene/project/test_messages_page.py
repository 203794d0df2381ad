# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of all errors and warnings finds messages by their words, and that of failures has each of them."""
import re
import subprocess
import sys

import pytest
from conftest import root

sys.path.append(str(root / 'scripts/lib'))
import messages


@pytest.fixture(scope='module')
def page(tmp_path_factory):
	made = tmp_path_factory.mktemp('page') / 'messages.md'
	subprocess.run([sys.executable, root / 'scripts/lib/messages.py', made], check=True)
	return made.read_text()


@pytest.mark.parametrize(
        'topic, words', [
                ('Contact with rigid bodies', 'turns by … in one load step; admitted is 1 rad'),
                ('Contact with rigid bodies', 'MpmContact.friction = … is not admitted: expected an angle'),
                ('Materials and laws', 'undrained = True needs waterModulus'),
                ('Functions of yade.mpm', 'geostatic: the points have been deformed'),
                ('Load steps, convergence and settings', 'of the work at the edge of the body'),
                ('Load steps, convergence and settings', 'a material point was turned inside out'),
        ]
)
def test_words_of_a_message_find_it_below_its_topic(page, topic, words):
	section = page.partition(f'\n## {topic}\n')[2].partition('\n## ')[0]
	assert words in section


def test_the_page_has_many_messages_and_no_documentation(page):
	said = re.findall(r'^- (.*)$', page, re.MULTILINE)
	assert len(said) > 900 and len(set(said)) > 0.98 * len(said)
	assert not [text for text in said if ':param' in text or text.startswith('For mpm.')]
	names = re.findall(r'classes/(\w+)\.md', page)
	assert len(names) > 15 and all((root / f'plugin/docs/classes/{name}.md').exists() for name in names)


def test_statements_are_joined():
	"""Literals side by side are one text, a value between them an ellipsis; comments and attribute docs are no messages."""
	source = '// "not this at all, ever"\nvoid f()\n{\n\tthrow E("body #" + id + " is too light "\n\t  "for this O.dt."); // "nor this one here"\n}\n'
	told = [messages.joined(pieces) for head, pieces in messages.statements(source)]
	assert [text for text in told if text] == ['body #… is too light for this O.dt.']


def test_each_failure_has_a_row():
	source = (root / 'plugin/engine/messages/failures.cpp').read_text()
	names = set(re.findall(r'case Failure::\w+: return "(\w+)"', source)) - {'none'}
	rows = re.findall(r'^\| (\w+) \| [^|]+ \| [^|]+ \|$', (root / 'plugin/docs/failures.md').read_text(), re.MULTILINE)
	assert names == set(rows) - {'failure'} and len(names) > 15
