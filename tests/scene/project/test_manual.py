# SPDX-License-Identifier: GPL-2.0-or-later
"""The manual as HTML and as PDF: made without a warning, links, pictures and search work; pages do not grow and do not repeat each other."""
import csv
import html.parser
import itertools
import json
import os
import re
import shutil
import subprocess
import urllib.parse

import pytest
from conftest import root
from test_sentences import manual

htmlPages = root / 'build/docs/html'
hasLatex = shutil.which('latexmk') and shutil.which('xelatex')


@pytest.fixture(scope='module')
def made():
	"""Pages by Sphinx, which scripts/test installs, and the PDF where LaTeX is there. Made once, by the first test that asks."""
	return {}


def make(made, yade):
	if not shutil.which('sphinx-build'): pytest.skip('Sphinx is not installed: apt install python3-sphinx python3-myst-parser')
	if not made:
		options = ['--installed', '--pdf'] if hasLatex else ['--installed']
		run = subprocess.run([root / 'scripts/docs', *options], env=os.environ | yade.ownSettings() | {'YADE': yade.command}, capture_output=True, text=True, timeout=500)
		made.update(code=run.returncode, said=run.stdout + run.stderr)
	assert made['code'] == 0, made['said']


class Page(html.parser.HTMLParser):
	"""Anchors and links of one page."""

	def __init__(self, path):
		super().__init__()
		self.anchors, self.links = set(), []
		self.feed(path.read_text())

	def handle_starttag(self, tag, attrs):
		for name, value in attrs:
			if name in ('id', 'name'): self.anchors.add(value)
			if name in ('href', 'src', 'data') and not re.match(r'\w+:|//', value): self.links.append(urllib.parse.unquote(value))


def test_links_and_pictures_of_the_pages_are_there(made, yade):
	make(made, yade)
	pages = {path: Page(path) for path in htmlPages.rglob('*.html') if '_static' not in path.parts}
	broken, pictures = [], 0
	for path, page in pages.items():
		for link in page.links:
			file, _, anchor = link.partition('#')
			target = (path.parent / file.partition('?')[0]).resolve() if file else path
			pictures += target.suffix == '.png'
			if not target.exists() or anchor and target in pages and anchor not in pages[target].anchors: broken.append(f'{path.relative_to(htmlPages)}: {link}')
	assert not broken and len(pages) > 100 and pictures > 60
	for path in (htmlPages / 'plugin/docs/explanation').glob('*.html'):
		shown = path.read_text().split('<div class="math ')[1:]
		assert not [text[:80] for text in shown if r'\tag' in text.partition('</div>')[0] and r'\begin{equation*}' not in text.partition('</div>')[0]], path
	assert 'plugin/docs/index.html' in (htmlPages / 'index.html').read_text()
	assert {'MpmImplicitEngine', 'yade.mpm.fill', 'yade.mpm.stages.excavate'} <= pages[htmlPages / 'build/docs/reference.html'].anchors


def test_the_search_finds_the_page_of_questions(made, yade):
	"""The box is on each page, above the list of pages; words of a question are in the index of that page, but for those that the search leaves out."""
	make(made, yade)
	import snowballstemmer
	index = json.loads((htmlPages / 'searchindex.js').read_text().removeprefix('Search.setIndex(').removesuffix(')'))
	number = index['docnames'].index('plugin/docs/questions')
	language = (htmlPages / '_static/language_data.js').read_text()
	left = set(json.loads(re.search(r'stopwords = (?:new Set\()?(\[.*?\])', language, re.DOTALL)[1]))
	assert {'which', 'how', 'why', 'the'} <= left and 'plugin\\/docs\\/questions' in language
	found = lambda table, word: number in (entry if isinstance(entry := table.get(word, []), list) else [entry])
	questions = re.findall(r'^## (.*)$', (root / 'plugin/docs/questions.md').read_text(), re.MULTILINE)
	words = {word for question in questions for word in re.findall(r'\w{3,}', question.lower())} - left
	stems = [snowballstemmer.stemmer(name).stemWord for name in ('porter', 'english')] # of Sphinx to 7, and from 8 on
	assert len(questions) > 10 and len(words) > 30
	assert not [word for word in words if not any(found(index[table], stem(word)) for table in ('terms', 'titleterms') for stem in stems)]
	for page in 'README', 'plugin/docs/classes/MpmContact', 'build/docs/messages':
		text = (htmlPages / f'{page}.html').read_text()
		assert 0 < text.index('id="searchbox"') < text.index('Navigation'), page


def test_words_of_users_lead_to_sections_that_answer(made, yade):
	"""Each row of keywords.csv is an entry of the search, and its section is on the page; its words are found with others of that page."""
	make(made, yade)
	index = json.loads((htmlPages / 'searchindex.js').read_text().removeprefix('Search.setIndex(').removesuffix(')'))
	with open(root / 'plugin/docs/keywords.csv', newline='') as file:
		rows = list(csv.DictReader(file))
	assert len(rows) > 50 and len({row['words'] for row in rows}) == len(rows)
	for row in rows:
		number = index['docnames'].index(row['page'])
		assert [number, row['section']] in [[entry[0], entry[1]] for entry in index['indexentries'][row['words']]], row
		assert not row['section'] or row['section'] in Page(htmlPages / f"{row['page']}.html").anchors, row
	licence = index['terms']['licens']
	assert index['docnames'].index('README') in (licence if isinstance(licence, list) else [licence])


def test_whole_questions_find_their_section(made, yade):
	"""Questions as users ask them, with words that are on no page. Node runs the search of the pages."""
	if not shutil.which('node'): pytest.skip('Node is not installed: apt install nodejs')
	make(made, yade)
	questions = {
	        'why did the engine reduce the step': 'plugin/docs/questions#why-was-a-step-reduced',
	        'what does it cost to halve the error of a footing': 'plugin/docs/questions#what-does-half-the-error-of-a-footing-cost',
	        'how do I make an animation of my run': 'plugin/docs/results#draw-a-picture',
	        'geogrid slope': 'plugin/docs/classes/MpmReinforcement'
	}
	found = subprocess.run(['node', root / 'tests/scene/project/search.js', htmlPages, *questions], capture_output=True, text=True, check=True).stdout.split()
	assert found == list(questions.values())


def test_the_manual_in_one_file(made, yade):
	"""Its numbered equations, classes and tutorials are in it."""
	if not hasLatex: pytest.skip('LaTeX is not installed: scripts/docs --pdf installs it')
	make(made, yade)
	written = (root / 'build/docs/manual.pdf').read_bytes()
	source = (root / 'build/docs/latex/manual.tex').read_text()
	assert written.startswith(b'%PDF') and len(written) > 500_000
	assert all(title in source for title in (r'\chapter{MpmBeam}', r'\chapter{Stabilisation}', r'\chapter{1. Slope}', r'\tag{C1}', r'\tag{8.5}'))
	assert 'Missing character' not in (root / 'build/docs/latex/manual.log').read_text(errors='replace')


def test_help_names_what_is_made():
	said = subprocess.run([root / 'scripts/docs', '--help'], stdout=subprocess.PIPE, text=True, check=True).stdout
	assert all(word in said for word in ('--pdf', 'build/docs/manual.pdf', 'build/docs/html/index.html', 'yade-mpm(7)')) and (root / 'plugin/docs/yade-mpm.7').exists()


def withoutCode(page):
	"""Lines of a page outside of blocks of code, those that are indented included."""
	lines, isCode, isAfterEmpty = [], False, True
	for line in re.sub(r'^```.*?^```', '', (root / page).read_text(), flags=re.DOTALL | re.MULTILINE).splitlines():
		isCode = line.startswith(('    ', '\t')) and (isCode or isAfterEmpty)
		isAfterEmpty = not line.strip()
		if not isCode: lines.append(line)
	return lines


def test_the_manual_does_not_grow():
	"""All pages but those of examples and studies; a new page displaces old words."""
	words = [word for page in manual() if not page.startswith('examples/') for line in withoutCode(page) for word in line.split() if re.search(r'\w', word)]
	assert 20_000 < len(words) <= 33_000, len(words)


def test_pages_do_not_repeat_each_other():
	"""Runs of nine words outside tables that two pages share."""
	runs = {}
	for page in manual():
		text = ' '.join(re.sub(r'!?\[([^\]]*)\]\([^)]*\)', r'\1', line) for line in withoutCode(page) if not line.startswith('|'))
		words = re.findall(r'\w+', text.lower())
		runs[page] = {tuple(words[i:i + 9]) for i in range(len(words) - 8)}
	shared = {(a, b): len(runs[a] & runs[b]) for a, b in itertools.combinations(runs, 2) if not a.startswith('examples/') or not b.startswith('examples/')}
	assert not {pair: number for pair, number in shared.items() if number > 30}
