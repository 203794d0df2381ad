# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages for users: links lead somewhere, and everything public says what it is, in which unit."""
import json
import math
import re
import struct
import subprocess
import unicodedata

import pytest
from conftest import root

pages = [path for path in root.rglob('*.md') if not {'build', 'out'} & set(path.relative_to(root).parts)]


def anchorsOf(page):
	"""Anchors of the headings, as viewers of Markdown make them."""
	headings = re.findall(r'^#+ (.*)$', page.read_text(), re.MULTILINE)
	return {re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in headings}


def test_every_relative_link_leads_somewhere():
	assert len(pages) > 8
	links = [(page, link) for page in pages for link in re.findall(r'\]\(([^)\s]+)\)', page.read_text()) if not re.match(r'\w+:', link)]
	assert len(links) > 40
	broken = []
	for page, link in links:
		file, _, anchor = link.partition('#')
		target = (page.parent / file).resolve() if file else page
		if not target.exists() or anchor and anchor not in anchorsOf(target): broken.append(f'{page.relative_to(root)}: {link}')
	assert not broken


def test_every_page_of_an_example_is_in_the_index_of_the_documentation():
	index = (root / 'plugin/docs/index.md').read_text()
	for page in (root / 'examples').glob('*/README.md'):
		assert f'../../examples/{page.parent.name}/README\n' in index, page


def test_every_picture_is_on_a_page_and_can_be_seen_as_a_whole():
	shown = {(page.parent / link).resolve() for page in pages for link in re.findall(r'!\[[^\]]+\]\(([^)\s]+)\)', page.read_text())}
	pictures = [path for path in root.glob('examples/*/*.png')]
	assert len(pictures) > 20 and set(pictures) <= shown
	for picture in pictures:
		width, height = struct.unpack('>II', picture.read_bytes()[16:24])
		assert 400 < width < 1900 and 300 < height < 1300, picture


def test_every_command_of_the_pages_names_a_file_that_is_there():
	commands = [(page, line.strip()) for page in pages for line in page.read_text().splitlines() if re.match(r' {4}(scripts/|yade-batch |pvbatch )', line)]
	assert len(commands) > 15
	missing = []
	for page, line in commands:
		for word in line.partition('#')[0].split():
			if not re.match(r'(scripts|examples)/', word) or (root / word).exists(): continue
			missing.append(f'{page.relative_to(root)}: {line}')
		run = re.match(r'scripts/run (\w+)( |$)', line)
		if run and not (root / f'examples/{run[1]}/{run[1]}.py').exists(): missing.append(f'{page.relative_to(root)}: {line}')
	assert not missing


def test_every_example_has_a_page_in_the_course():
	course = (root / 'examples/README.md').read_text()
	for script in (root / 'examples').glob('*/*.py'):
		if script.stem != script.parent.name: continue
		assert f'{script.stem}/README.md' in course and f'{script.stem}.png' in course, script
		page = (script.parent / 'README.md').read_text()
		assert 'scripts/run ' in page, script
		assert 'MpmVtkRecorder' not in script.read_text() or f'pvbatch scripts/paraview-picture.py out/{script.stem}/' in page, script


@pytest.mark.parametrize('page', sorted((root / 'examples').glob('*/README.md')), ids=lambda page: page.parent.name)
def test_pages_of_examples_have_one_order(page):
	"""Contents of a page: what it shows, the command, a picture, numbers, and what to change, whose options the scripts of that folder have."""
	text = re.sub(r'```.*?```', '', page.read_text(), flags=re.DOTALL)
	assert re.findall(r'^#{1,2} (.*)$', text, re.MULTILINE)[1:] == ['Run it', 'Picture', 'Numbers', 'What to change']
	shows, run, picture, numbers, change = re.split(r'^#{1,2} .*$', text, flags=re.MULTILINE)[1:]
	assert len(shows.split()) > 10 and re.search(r'^ {4}scripts/', run, re.MULTILINE) and picture.strip().startswith('![')
	assert re.search(r'^\|.*\|$', numbers, re.MULTILINE) and len(change.split()) > 15
	scripts = ''.join(script.read_text() for folder in (page.parent, root / 'scripts') for script in folder.iterdir() if script.suffix in ('', '.py') and script.is_file())
	missing = [name for name in re.findall(r'`--(\w+)', change) if not re.search(rf'\b{name}=\(|--{name}\b', scripts)]
	assert not missing


def test_the_first_page_is_short_and_leads_on():
	"""At most 1,200 words; each task of its table has a script or a page, says how sure its numbers are and how long it runs, or that it is not there yet."""
	readme = (root / 'README.md').read_text()
	assert len(readme.split()) <= 1200
	rows = [line.strip('|').split('|') for line in re.findall(r'^\|.*\|$', sectionOf(readme, 'Can it do my problem?'), re.MULTILINE)[2:]]
	assert len(rows) >= 14
	for task, first, more, sure, runsFor in rows:
		assert 'not there yet' in sure or '](examples/' in first + more and runsFor.strip(), task
	tasks = {path.stem for path in (root / 'examples/tasks').glob('*.py')}
	course = sectionOf((root / 'examples/README.md').read_text(), 'Tasks')
	assert set(re.findall(r'\(tasks/(\w+)\.py\)', course)) == tasks and set(re.findall(r'\(examples/tasks/(\w+)\.py\)', readme)) == tasks


def test_the_course_is_numbered_through():
	course = (root / 'examples/README.md').read_text()
	numbered = [int(number) for number in re.findall(r'^\| (\d+)(?:\.|) ', course.partition('\n[Recipes]')[0], re.MULTILINE)]
	folders = {path.parent.name for path in (root / 'examples').glob('*/README.md')}
	assert numbered == [*range(1, len(numbered) + 1)] and len(numbered) == len(folders) + len(list((root / 'examples/tasks').glob('*.py')))


explanation = root / 'plugin/docs/explanation'
citation = re.compile(r'((?:de |van )?[A-Z]\w+(?: \w+)?(?: and [A-Z][\w-]+| et al\.)?)\)? ((?:1[789]|20)\d\d)')


@pytest.mark.parametrize('chapter', [page for page in sorted(explanation.glob('*.md')) if page.stem not in ('nomenclature', 'references')], ids=lambda page: page.stem)
def test_a_chapter_lists_the_sources_that_it_cites(chapter):
	text = ' '.join(chapter.read_text().split())
	body, _, listed = text.partition('**References** ([list](references.md)): ')
	keys = listed.rstrip('.').split('; ')
	assert keys == sorted(keys, key=str.lower) and all(key in body for key in keys)
	assert {f'{names} {year}' for names, year in citation.findall(re.sub(r'\((?:figure|section) \d+ of |\bafter |\bof |\bsmall-strain ', '', body))} == set(keys)


def test_equations_are_numbered_and_pages_lead_to_theory_and_back():
	"""Equations of a chapter have its number and follow each other, or that of the paper; a page of a class shows none, but leads to the chapter, which names the class."""
	chapters = [page for page in sorted(explanation.glob('*.md')) if page.stem not in ('nomenclature', 'references')]
	firsts = set()
	for page in chapters:
		text = page.read_text()
		tags = re.findall(r'\\tag\{(.*?)\}', text)
		own = [tag for tag in tags if not re.fullmatch(r'C[1-9]', tag)]
		assert tags and len(tags) == len(re.findall(r'^\$\$', text, re.MULTILINE)) and '\n**Notation.** ' in text, page
		assert own == [f'{own[0][0]}.{number + 1}' for number in range(len(own))], page
		firsts.add(own[0])
	assert firsts == {f'{chapter}.1' for chapter in range(1, 9)}
	for page in sorted((root / 'plugin/docs/classes').glob('*.md')):
		text = page.read_text()
		assert '$$' not in text, page
		if page.stem == 'MpmVtkRecorder': continue
		chapter = re.search(r'\]\(\.\./explanation/([\w-]+)\.md', text.rsplit('\nMore: ', 1)[-1])
		assert chapter and f'](../classes/{page.name})' in (explanation / f'{chapter[1]}.md').read_text(), page


def test_every_source_is_listed_and_every_listed_source_is_cited():
	entries = re.findall(r'^- \*\*(.+?)\*\*: ', (explanation / 'references.md').read_text(), re.MULTILINE)
	assert len(entries) > 40 and len(set(entries)) == len(entries)
	chapters = ' '.join(page.read_text().partition('**References**')[2] for page in explanation.glob('*.md'))
	assert not {key for line in re.findall(r'references\.md\)\): (.*)\.$', chapters, re.MULTILINE) for key in line.split('; ')} - set(entries)
	sources = [path for path in root.rglob('*') if path.suffix in ('.md', '.hpp', '.cpp', '.py') and path != explanation / 'references.md' and not {'build', 'out'} & set(path.relative_to(root).parts)]
	text = ' '.join(re.sub(r'\s+(?://+ ?)?', ' ', path.read_text()) for path in sources)
	missing = []
	for key in entries:
		name, year = re.match(r'((?:de |van )?[\w-]+)', key)[1], key[-4:]
		if not re.search(rf'\b{name}\b[^|;]{{0,60}}\b{year}\b', text): missing.append(key)
	assert not missing


def test_every_source_that_the_plugin_cites_is_listed():
	"""Any author before a year, in pages and code, stands in an entry of that year. The list of examples cites what their pages cite."""
	plain = lambda text: unicodedata.normalize('NFKD', text).encode('ascii', 'ignore').decode()
	entries = re.findall(r'^- \*\*(.+?)\*\*: (.*)$', plain((explanation / 'references.md').read_text()), re.MULTILINE)
	assert [key.lower() for key, _ in entries] == sorted(key.lower() for key, _ in entries)
	left = {explanation / 'references.md', root / 'plugin/python/mpm/scripts.py'}
	sources = [path for path in (root / 'README.md', *(root / 'plugin').rglob('*')) if path.suffix in ('.md', '.hpp', '.cpp', '.py') and 'studies' not in path.parts and path not in left]
	missing = []
	for path in sources:
		text = re.sub(r'\s+(?://+ ?)?', ' ', re.sub(r'"\s*\n\s*"', '', plain(path.read_text())))
		for name, year in re.findall(r'\b([A-Z][\w-]+)(?: et al\.| and others)?,? \(?((?:1[789]|20)\d\d)\b(?![-.]\d)', text):
			if name == 'November' or any(key.endswith(year) and re.search(rf'\b{name}\b', f'{key} {entry}') for key, entry in entries): continue
			missing.append(f'{path.relative_to(root)}: {name} {year}')
	assert len(sources) > 200 and not missing


def test_the_citation_names_the_newest_release():
	"""The version that CMake reads from the page of changes, with its date."""
	version, date = re.search(r'^## ([\d.]+) \((\d{4}-\d\d-\d\d)\)$', (root / 'plugin/docs/changes.md').read_text(), re.MULTILINE).groups()
	fields = dict(re.findall(r'^([\w-]+): (.+)$', (root / 'plugin/docs/CITATION.cff').read_text(), re.MULTILINE))
	assert (fields['version'], fields['date-released']) == (version, date) and fields['license'] == 'GPL-2.0-or-later'


def sectionOf(page, title):
	return page.partition(f'\n## {title}\n')[2].partition('\n## ')[0]


developersPage = (root / 'plugin/docs/development.md').read_text()


def test_what_the_developers_page_names_is_there():
	named = re.findall(r'`([^`\n]+)`', re.sub(r'```.*?```', '', developersPage, flags=re.DOTALL))
	paths = {word for name in named for word in name.split() if '/' in word and not word.startswith('build/')}
	words = {word for name in named for word in re.findall(r'\w+', name) if '/' not in name}
	assert len(paths) > 20 and len(words) > 40
	sources = [path for folder in ('plugin', 'tests', 'scripts') for path in (root / folder).rglob('*') if path.suffix in ('.hpp', '.cpp', '.py', '')]
	known = {word for path in sources for word in re.findall(r'\w+', path.read_text() if path.is_file() else path.name)}
	assert not words - known
	assert not [path for path in paths if not (root / path).exists() and not (root / 'plugin' / path).exists()]


def test_the_glossary_leads_from_standard_words_to_files():
	text = (root / 'plugin/docs/glossary.md').read_text()
	rows = [[cell.strip() for cell in line.strip('|').split('|')] for line in text.splitlines() if line.startswith('|') and '---' not in line]
	terms = [row for row in rows if row[0] != 'term']
	assert len(terms) > 60 and all(len(row) == 4 for row in terms)
	assert not [row[0] for row in terms if len(row[2].split()) > 15]
	assert len({row[0] for row in terms}) == len(terms)
	paths = {path for row in terms for path in re.findall('`([^`]+)`', row[3])}
	assert not [path for path in paths if not (root / 'plugin' / path).exists() and not (root / 'plugin/core' / path).exists()]
	words = ' '.join(f'{row[0]}, {row[1]}' for row in terms)
	for word in ('Jacobian', 'quadrature', 'integration point', 'Dirichlet', 'constraint', 'return mapping'):
		assert word in words, word


def test_the_examples_of_the_developers_page_are_in_the_files_that_it_lists():
	"""No other file needs a line for them."""
	listed = set(re.findall(r'`(\w+/\w+/\w+\.[ch]pp)`', sectionOf(developersPage, 'Add a law')))
	listed -= {'core/materials/required_members.hpp', 'core/materials/response.hpp', 'engine/materials/parameters.cpp'}
	law = {str(path.relative_to(root / 'plugin')) for path in (root / 'plugin').rglob('*.[ch]pp') if re.search(r'VonMises|von_mises', path.read_text())}
	assert law == listed and len(law) == 4
	assert not [path for path in (root / 'plugin').rglob('*.[ch]pp') if re.search('KinematicHardening|MpmKinematic', path.read_text())]  # the example of a tensor law
	term = [path.relative_to(root) for folder in ('plugin', 'tests') for path in (root / folder).rglob('*.[ch]pp') if 'SpringForce' in path.read_text()]
	assert [f'`{path}`' in sectionOf(developersPage, 'Add a term') for path in term] == [True]


def test_the_program_of_the_developers_page(tmp_path):
	"""It is compiled by the command beside it and agrees with the exact settlement, and both have the numbers that the page gives."""
	section = sectionOf(developersPage, 'The core without YADE')
	program = re.search(r'```cpp\n(.*?)```', section, re.DOTALL)[1]
	command = re.search(r'^ {4}(g\+\+ .*)$', section, re.MULTILINE)[1]
	assert program.count('\n') <= 35 and '-o column' in command
	(tmp_path / 'column.cpp').write_text(program)
	for folder in 'plugin', 'build':
		(tmp_path / folder).symlink_to(root / folder)
	subprocess.run(command.split(), cwd=tmp_path, check=True)
	printed = subprocess.run([tmp_path / 'column'], stdout=subprocess.PIPE, text=True, check=True).stdout
	settlement = float(re.fullmatch(r'settlement (\d\.\d{6}) m\n', printed)[1])
	# Stretch W(x)/x at the load x = s (1 - Y), with x = W exp(W); over the height it makes (W + W^2/2)/s, with W =
	# W(s).
	height, s, W = 10, 2000 * 10 * 10 / 1e6, 0.2
	for _ in range(20):
		W -= (W * math.exp(W) - s) / ((W + 1) * math.exp(W))
	exact = height * (1 - (W + W**2 / 2) / s)
	assert abs(settlement / exact - 1) < 2e-4
	assert f'prints {settlement:.6f} m' in section and f'is {exact:.6f} m' in section and f'{s * height / 2:g} m.' in section


# Run in YADE: what is not documented, or at too great length for the prompt (the rest is on a page of the class), one
# line for each. A real number needs a unit, [-] if it has none.
check = '''
import inspect, os, re, sys
from yade import mpm, wrapper
sys.argv = ['reference.py', 'reference.rst']
exec(open(REFERENCE).read())

number = float, Vector3, Matrix3
found = units = 0
for name in classes():
	cls = getattr(wrapper, name)
	if len(cls.__doc__ or '') < 20: print('no description:', name)
	if len(cls.__doc__.split()) > 120: print('too long:', name, len(cls.__doc__.split()))
	page = re.search(r'Page: (plugin/docs/\\S+\\.md)\\.', cls.__doc__)
	if not page or not os.path.exists(os.path.join(os.path.dirname(REFERENCE), '..', '..', page[1])): print('no page:', name)
	values = cls().dict()
	for entry, value in entries(cls):
		found += 1
		text = docOf(value)
		if len(text) < 10: print('no description:', name, entry)
		if isinstance(value, property) and len(text.split()) > 30: print('too long:', name, entry, len(text.split()))
		if isinstance(value, property) and isinstance(values.get(entry), number):
			units += 1
			if not re.search(r'\\[[^\\]]+\\]', text): print('no unit:', name, entry, text)
		if not isinstance(value, property) and not re.match(entry + r'\\(.*\\)( -> |$)', text): print('no signature:', name, entry, text)
for module, name in [(mpm, name) for name in mpm.__all__] + [(mpm.stages, name) for name in mpm.stages.__all__]:
	value = getattr(module, name)
	text = inspect.getdoc(value) or ''
	found += 1
	for parameter in inspect.signature(value).parameters:
		if not re.search(rf':param {parameter}:', text): print('not described:', name, parameter)
	if not re.search(r':raises? ', text): print('errors not described:', name)
written = open('reference.rst').read()
for name in classes() + list(mpm.__all__) + mpm.stages.__all__:
	if f':: {name}(' not in written: print('not on the page:', name)
print('checked', found, units)
'''


def test_everything_public_is_described(yade):
	run = yade(f'REFERENCE = {str(root / "plugin/docs/reference.py")!r}\n' + check)
	lines = [line for line in run.stdout.splitlines() if re.match(r'no |not |too |errors |checked', line)]
	assert len(lines) == 1, lines
	found, units = map(int, lines[0].split()[1:])
	assert found > 60 and units > 20 # the check has looked at something


def test_recipes(yade):
	"""Each of them on a scene of its own: it runs, and so does the next step."""
	block = re.search(r'```python\n(.*?)```', (root / 'examples/README.md').read_text().partition('## Recipes')[2], re.DOTALL)[1]
	recipes = [recipe.strip() for recipe in re.split(r'\n\n', block)]
	assert len(recipes) > 10 and all(recipe.startswith('# ') for recipe in recipes)
	(yade.folder / 'recipes.json').write_text(json.dumps(recipes))
	run = yade('''
import json
from yade import mpm, timing
for recipe in json.load(open('recipes.json')):
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=5e4, label='soil'))
	grid = MpmGrid(cellSize=0.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4, 0), (4, 3), (0, 3)]), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides, label='solver', verbosity=0)]
	O.dt = 1 / 10
	exec(recipe, globals())
	O.run(2, wait=True)
	print('ran:', recipe.splitlines()[0])
''')
	assert run.stdout.count('ran: ') == len(recipes), run
	assert (run.folder / 'plastic.png').exists() and (run.folder / 'points.csv').exists() and '"solver"' in run.stdout  # the table of times


def test_answers_run_and_a_run_that_is_resumed_has_the_same_bits(yade):
	"""Blocks of the page of questions: seepage under a dam, a restart in a new process, a record at the base, and a state for ParaView."""
	page = (root / 'plugin/docs/questions.md').read_text()
	blocks = [re.sub('^    ', '', block, flags=re.MULTILINE) for block in re.findall(r'(?:^    .*\n)+', page, re.MULTILINE)]
	seepage, restart, record, paraview = blocks
	save, load = restart.split('\n', 1)
	scene = """
from yade import mpm
O.materials.append(MpmMohrCoulombMat(young=1e8, poisson=0.3, density=2000, cohesion=2e4, frictionAngle=0.6, conductivity=1e-5, label='soil'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (16, 0), (16, 3), (12, 3), (12, 9), (0, 9)]), grid, 2, 'soil'))
base = MpmBoundary(max=(inf, 0, inf), fix='xy')
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[base], label='solver', verbosity=0)
O.engines, O.dt = [solver], 1 / 10
"""
	(yade.folder / 'RSN.AT2').write_text('PEER\nQuake\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 2000, DT= .0100 SEC,\n' + '\n'.join(f'{0.1 * math.sin(0.1 * i) * math.exp(-0.002 * i):.6e}' for i in range(2000)))
	first = yade(scene + seepage.replace('mpm.strengthReduction()', "print(mpm.strengthReduction(tolerance=0.2)['lower'] > 1)"))
	assert 'True' in first.stdout, first.stdout
	again = scene + 'O.run(2, wait=True)\n' + save + '\nO.run(4, wait=True)\nimport zlib\n'
	state = "print('state', zlib.crc32(mpm.arrays()['pos'].tobytes()), zlib.crc32(mpm.arrays()['stress'].tobytes()))\n"
	whole = yade(again + state)
	resumed = yade('from yade import mpm\nimport zlib\n' + load + state)
	of = lambda run: re.search(r'^state .*$', run.stdout, re.MULTILINE)[0]
	assert of(whole) == of(resumed)
	yade(scene + record + 'assert base.motion.history\n')
	yade(scene + paraview)
	assert (yade.folder / 'out/slope.py').exists()


tutorials = sorted((root / 'plugin/docs/tutorials').glob('*.md'))


def test_tutorials_are_numbered_short_and_lead_on():
	"""Eight, each of at most 700 words besides its script, with a picture and the same last sections; each names the next."""
	assert [page.name[0] for page in tutorials] == list('12345678')
	for page, following in zip(tutorials, [*tutorials[1:], None]):
		text = re.sub(r'```.*?```', '', page.read_text(), flags=re.DOTALL)
		assert len(text.split()) <= 700 and re.match(rf'# {page.name[0]}\. ', text) and '\n![' in text, page
		assert re.findall(r'^## (.*)$', text, re.MULTILINE)[-2:] == ['What to expect', 'How accurate is this, and what would better cost?'], page
		assert not following or 'Next: [' in text and f']({following.name})' in text, page


@pytest.mark.parametrize('page', tutorials, ids=lambda page: page.stem)
def test_the_script_of_a_tutorial_prints_what_its_page_says(yade, page):
	"""Its blocks are one script. Numbers are those of the page within 2 %."""
	text = page.read_text()
	run = yade('\n'.join(re.findall(r'```python\n(.*?)```', text, re.DOTALL)))
	prose = re.sub(r'```.*?```', '', text, flags=re.DOTALL).partition('## What to expect')[2].partition('\n## ')[0]
	number = r'-?\d+(?:\.\d+)?'
	said = re.findall(r'[Pp]rints? `([^`]+)`', prose) + re.findall(r'^ {4}(\S.*)$', prose, re.MULTILINE)
	assert said, page
	for line in said:
		values = [float(value) for value in re.findall(number, line)]
		found = re.findall('^' + f'{number}'.join(map(re.escape, re.split(number, line))) + '$', run.stdout, re.MULTILINE)
		assert any([float(value) for value in re.findall(number, one)] == pytest.approx(values, rel=0.02) for one in found), (line, run.stdout)


@pytest.mark.parametrize('page', ['mpm-with-dem', 'implicit-mpm-in-python'])
def test_scripts_of_the_pages_for_those_who_come_from_elsewhere(yade, page):
	run = yade(re.search(r'```python\n(.*?)```', (root / f'plugin/docs/{page}.md').read_text(), re.DOTALL)[1] + 'print(O.iter)')
	assert int(run.stdout.splitlines()[-1]) in (10, 5000)


def test_readme(yade):
	"""Its script runs, also with the two lines that it suggests, and what it says of grains is so."""
	readme = (root / 'README.md').read_text()
	script = re.search(r'```python\n(.*?)```', readme, re.DOTALL)[1]
	plot, advise = (re.search(rf'`({call}\(.*?\))`', readme)[1] for call in ('mpm.plot', 'mpm.advise'))
	assert 'O.run(40, wait=True)\n' in script
	run = yade(script.replace('O.run(', advise + '\nO.run(') + plot + '''
assert O.iter == 40 and O.engines[0].report()['converged']
O.materials.append(FrictMat(label='grain'))
grain = O.bodies[O.bodies.append(sphere((12, 14, 0), 0.5, material='grain'))]
O.engines[0].iterPeriod = 100
O.engines[1].dead = True
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
	[Law2_ScGeom_FrictPhys_CundallStrack()]), NewtonIntegrator(gravity=(0, -9.81, 0)), *O.engines]
O.dt = 0.01
O.run(200, wait=True)
print(grain.state.pos[1])
''')
	assert (run.folder / 'slope.png').stat().st_size > 30000 and (run.folder / 'out/my-slope-points.pvd').exists()
	assert float(run.stdout.splitlines()[-1]) < 0 and 'a sphere falls through the soil' in ' '.join(readme.split())
