# SPDX-License-Identifier: GPL-2.0-or-later
"""The manual is short enough to be read, and says nothing twice. Code blocks do not count."""
import itertools
import re

from conftest import root
from test_sentences import manual, paragraphs

mostWords, mostShared, run = 60000, 30, 9


def words(text):
	"""Number of words of a page, tables and headings included, blocks of code not."""
	text = re.sub(r'^ {0,3}(```|~~~).*?^ {0,3}\1[^\n]*$', '', text, flags=re.DOTALL | re.MULTILINE)
	count, isCode, isFree = 0, False, True
	for line in text.splitlines():
		if line.strip():
			isCode = line.startswith(('    ', '\t')) and (isCode or isFree)
			if not isCode: count += len(line.split())
		isFree = not line.strip()
	return count


def runsOf(text):
	"""Runs of nine words of the paragraphs of a page."""
	found = set()
	for paragraph in paragraphs(text):
		plain = re.findall(r"[\w'.-]+", paragraph.lower())
		found |= {tuple(plain[i:i + run]) for i in range(len(plain) - run + 1)}
	return found


def test_words_are_counted():
	assert words('# A heading\n\nOne two\n    three\n\n    code\n\n    more code\n\n| a | b |\n\n```python\nprint(1)\n```\n') == 11
	assert len(runsOf('one two three four five six seven eight nine ten\n\n| a table |\n')) == 2


def test_the_manual_is_short():
	counts = {page: words((root / page).read_text()) for page in manual()}
	assert len(counts) > 60 and sum(counts.values()) <= mostWords, sorted(counts.items(), key=lambda item: -item[1])[:10]


def test_pages_do_not_repeat_each_other():
	runs = {page: runsOf((root / page).read_text()) for page in manual()}
	shared = {pair: len(runs[pair[0]] & runs[pair[1]]) for pair in itertools.combinations(runs, 2)}
	assert not {pair: count for pair, count in shared.items() if count > mostShared}
