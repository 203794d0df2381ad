# SPDX-License-Identifier: GPL-2.0-or-later
"""What users read: links lead somewhere, and everything public says what it is, in which unit."""
import json
import re
import struct

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
	index = (root / 'scripts/lib/docs/index.md').read_text()
	for page in (root / 'examples').glob('*/README.md'):
		assert f'../../../examples/{page.parent.name}/README\n' in index, page


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
		assert 'scripts/run ' in page and f'pvbatch scripts/paraview-picture.py out/{script.stem}/' in page, script


# Run in YADE: what is not documented, or at too great length for the prompt (the rest is on a page of the class), one line for each. A real
# number needs a unit, [-] if it has none.
check = '''
import inspect, re, sys
from yade import mpm, wrapper
sys.argv = ['reference.py', 'reference.rst']
exec(open(REFERENCE).read())

number = float, Vector3, Matrix3
found = units = 0
for name in classes():
	cls = getattr(wrapper, name)
	if len(cls.__doc__ or '') < 20: print('no description:', name)
	if len(cls.__doc__.split()) > 120: print('too long:', name, len(cls.__doc__.split()))
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
for name in mpm.__all__:
	value = getattr(mpm, name)
	text = inspect.getdoc(value) or ''
	found += 1
	for parameter in inspect.signature(value).parameters:
		if not re.search(rf':param {parameter}:', text): print('not described:', name, parameter)
	if not re.search(r':raises? ', text): print('errors not described:', name)
written = open('reference.rst').read()
for name in classes() + list(mpm.__all__):
	if f':: {name}(' not in written: print('not on the page:', name)
print('checked', found, units)
'''


def test_everything_public_is_described(yade):
	run = yade(f'REFERENCE = {str(root / "scripts/lib/docs/reference.py")!r}\n' + check)
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
