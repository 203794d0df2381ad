# SPDX-License-Identifier: GPL-2.0-or-later
"""Sentences of the manual are short: the median at most 20 words, nine of ten at most 35. Code, tables, headings and formulas do not count."""
import re
import statistics

import pytest
from conftest import root

median, most = 20, 35


def manual():
	"""Pages of the manual by their paths; studies are no part of it."""
	paths = [path.relative_to(root) for path in root.rglob('*.md')]
	return sorted(str(path) for path in paths if path.parts[0] not in ('build', 'out') and path.parts[0][0] != '.' and not any(part.startswith('studies') for part in path.parts))


def paragraphs(text):
	"""Paragraphs and items of lists, each in one line."""
	text = re.sub(r'^```.*?^```|^\$\$.*?\$\$', '', text, flags=re.DOTALL | re.MULTILINE)
	found, isCode = [''], False
	for line in text.splitlines():
		isCode = line.startswith(('    ', '\t')) and (isCode or not found[-1])
		if isCode or not line.strip() or line.startswith(('#', '|', '<', '![')): found.append('')
		elif re.match(r'\s*([-*]|\d+\.) ', line): found.append(re.sub(r'^\s*([-*]|\d+\.) ', '', line))
		else: found[-1] += ' ' + line.strip()
	return [text.strip() for text in found if text.strip()]


def sentences(text):
	"""Numbers of words of the sentences of a page."""
	found = []
	for paragraph in paragraphs(text):
		plain = re.sub(r'`[^`]*`|\$[^$]*\$', 'x', re.sub(r'!?\[([^\]]*)\]\([^)]*\)', r'\1', paragraph))
		found += [len(re.findall(r'\S*\w\S*', sentence)) for sentence in re.split(r'(?<=[.!?])[*)]*\s+(?=[A-Z(*\'x])', plain)]
	return [length for length in found if length]


def isReadable(text):
	lengths = sorted(sentences(text))
	return len(lengths) < 2 or statistics.median(lengths) <= median and lengths[int(0.9 * (len(lengths) - 1))] <= most


def test_sentences_are_counted():
	text = '# A heading\n\nOne two `code with words` four. Five $a + b$ [link text](x.md).\nIt goes on\nhere\n\n    code in a block\n\n- an item\n- another one: with words\n\n| a | table |\n\n```python\nprint(1)\n```\n'
	assert sentences(text) == [4, 4, 4, 2, 4]
	assert isReadable(text) and not isReadable(2 * ('Word' + 35 * ' word' + '. '))


@pytest.mark.parametrize('page', manual())
def test_sentences_of_a_page_are_short(page):
	assert isReadable((root / page).read_text())
