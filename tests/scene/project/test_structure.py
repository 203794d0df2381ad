# SPDX-License-Identifier: GPL-2.0-or-later
"""Dependencies point downwards: python -> engine -> core, engine -> yade_api, and within the core from folder to folder. Functions stay short."""
import ast
import re
import shutil
import subprocess
import warnings

import pytest
from conftest import root

plugin = root / 'plugin'

# includes of the core besides the standard library, whose headers have no folder and no suffix
coreIncludes = re.compile(r'<\w+>|<(unsupported/)?Eigen/\w+>|<(cholmod|umfpack|dmumps_c|omp|dlfcn)\.h>|"core/(terms/)?\w+/\w+\.hpp"')
# the interface to YADE may include anything but the classes and numerics that are built on it
interfaceIncludes = re.compile(r'<.*>|"yade_api/\w+\.hpp"')

# each folder of the core, and those below it
below = {
        'base': [],
        'parallel': ['base'],
        'grid': ['base', 'parallel'],
        'materials': ['base'],
        'fields': ['base', 'grid', 'parallel'],
        'solvers': ['base', 'fields', 'grid', 'materials', 'parallel'],
        'terms': ['base', 'fields', 'grid', 'materials', 'parallel', 'solvers'],
        'structures': ['base', 'fields', 'grid', 'materials', 'parallel', 'solvers', 'terms'],
        'stepping': ['base', 'fields', 'grid', 'materials', 'parallel', 'solvers', 'terms'],
}

# the folders of terms, which follow what all of them need: each may include those before it
foldersOfTerms = ['terms', 'points', 'contact', 'bodies', 'inertia', 'water']

# the folders of the engine: each may include those before it, and what it has itself
engineFolders = ['materials', 'points', 'grid', 'analysis', 'conditions', 'parallel', 'messages', 'output', 'engines']
# kinds of conditions: whatever else is in the engine knows none of them, but for the engines, which have lists of them,
# and what Python asks for by name
kindsOfConditions = {'bodies', 'boundary', 'contact', 'flow', 'shaking', 'structures', 'surface', 'traction', 'water'}
knowKinds = {'MpmImplicitEngine.cpp', 'MpmDynamicEngine.cpp', 'module.cpp'}

# the packages of Python: each may import from those before it
packages = ['base', 'geometry', 'points', 'output', 'earthquake', 'analysis', 'laboratory']


def sources(folder):
	found = [path for path in (plugin / folder).rglob('*') if path.suffix in ('.hpp', '.cpp')]
	assert found
	return found


def includes(folder):
	for path in sources(folder):
		for included in re.findall(r'^\s*#\s*include\s*(\S+)', path.read_text(), re.MULTILINE):
			yield path, included


@pytest.mark.parametrize('folder, admitted', [('core', coreIncludes), ('yade_api', interfaceIncludes)])
def test_includesPointDownwards(folder, admitted):
	wrong = [f'{path.relative_to(plugin)}: {included}' for path, included in includes(folder) if not admitted.fullmatch(included)]
	assert not wrong


def test_foldersOfTheCoreIncludeThoseBelow():
	assert {path.name for path in (plugin / 'core').iterdir() if path.is_dir()} == set(below)
	wrong = []
	for path, included in includes('core'):
		own, target = path.relative_to(plugin / 'core').parts[0], re.match(r'"core/(\w+)/', included)
		if target and target[1] != own and target[1] not in below[own]: wrong.append(f'{path.relative_to(plugin)}: {included}')
	assert not wrong


def test_foldersOfTermsIncludeThoseBefore():
	"""Code that all terms need stands in core/terms itself."""
	assert [path.name for path in (plugin / 'core' / 'terms').iterdir() if path.is_dir() and path.name not in foldersOfTerms] == []
	wrong = []
	for path, included in includes('core/terms'):
		own, target = path.parent.name, re.match(r'"core/terms/(?:(\w+)/)?', included)
		if target and foldersOfTerms.index(target[1] or 'terms') > foldersOfTerms.index(own): wrong.append(f'{path.relative_to(plugin)}: {included}')
	assert not wrong


def test_foldersOfTheEngineIncludeThoseBelow():
	assert {path.name for path in (plugin / 'engine').iterdir() if path.is_dir()} == set(engineFolders)
	wrong = []
	for path, included in includes('engine'):
		own, target = path.relative_to(plugin / 'engine').parts[0], re.match(r'"engine/(\w+)/', included)
		if own not in engineFolders or not target: continue
		if engineFolders.index(target[1]) > engineFolders.index(own): wrong.append(f'{path.relative_to(plugin)}: {included}')
	assert not wrong


def test_conditionsAreKnownByTheirInterface():
	assert {path.name for path in (plugin / 'engine' / 'conditions').iterdir() if path.is_dir()} == kindsOfConditions
	wrong = []
	for path, included in includes('engine'):
		isKind = re.match(rf'"engine/conditions/({"|".join(kindsOfConditions)})/', included)
		if isKind and 'conditions' not in path.parts and path.name not in knowKinds: wrong.append(f'{path.relative_to(plugin)}: {included}')
	assert not wrong


def test_onlyEnginesTakeAnEngine():
	"""Code below takes an Analysis: settings, conditions and results."""
	wrong = []
	for path in sources('engine'):
		if path.parent.name == 'engines' or path.name == 'module.cpp': continue
		if re.search(r'\bMpm(Implicit|Dynamic)Engine\s*(&|>)', code(path.read_text())): wrong.append(str(path.relative_to(plugin)))
	assert not wrong


def test_foldersOfTheEngineOfTermsAndOfPythonAreNotCrowded():
	folders = [folder for part in ('engine', 'core/terms', 'python') for folder in (plugin / part).rglob('*') if folder.is_dir()]
	assert not [folder.name for folder in folders if sum(path.is_file() for path in folder.iterdir()) > 30]


def importsOfPython():
	"""(module, imported module) within yade.mpm, each as the parts of its path."""
	top = plugin / 'python' / 'mpm'
	paths = {(*path.relative_to(top).parent.parts, path.stem): path for path in top.rglob('*.py')}
	for module, path in paths.items():
		for node in ast.walk(ast.parse(path.read_text())):
			if not isinstance(node, ast.ImportFrom) or not node.level: continue
			base = module[:len(module) - node.level] + tuple(node.module.split('.') if node.module else ())
			yield from ((module, target) for target in {base, *((*base, alias.name) for alias in node.names)} & paths.keys())


def test_packagesOfPythonImportFromThoseBefore():
	found = list(importsOfPython())
	assert len(found) > 150 and {path.name for path in (plugin / 'python' / 'mpm').iterdir() if path.is_dir() and path.name != '__pycache__'} == set(packages)
	arrows = {(one[0], other[0]) for one, other in found if len(one) == len(other) == 2 and one[0] != other[0]}
	assert not [(one, other) for one, other in arrows if packages.index(other) > packages.index(one)]
	assert len(list((plugin / 'python' / 'mpm').glob('*.py'))) <= 15


def test_modulesOfPythonHaveNoCycle():
	needs = {}
	for one, other in importsOfPython():
		needs.setdefault(one, set()).add(other)
	while needs:
		free = {module for module in needs if not needs[module] & needs.keys()}
		assert free, f'a cycle in {sorted(needs)}'
		needs = {module: others for module, others in needs.items() if module not in free}


def test_testsAreInTheFoldersOfWhatTheyTest():
	"""Those in YADE also in folders of what makes the plugin a plugin (yade_api) and the project one (project)."""
	core = {path.name for path in (plugin / 'core').iterdir()} | {'parallel'}
	scene = {'points', 'materials', 'grid', 'conditions', 'parallel', 'messages', 'engines', 'output', 'python', 'yade_api', 'project'}
	for name, ending, folders in ('core', 'cpp', core), ('scene', 'py', scene):
		found = {path.parent.relative_to(root / 'tests' / name).as_posix() for path in (root / 'tests' / name).rglob(f'test_*.{ending}')}
		assert found <= folders and len(found) > 5
	names = [path.name for path in (root / 'tests/scene').rglob('test_*.py')]
	assert len(names) == len(set(names)), 'pytest imports them by these names'


def test_topLevelHoldsWhatItIsMeantTo():
	"""Files of the repository, where this is one: trials leave files behind."""
	listed = shutil.which('git') and subprocess.run(['git', 'ls-files'], cwd=root, capture_output=True, text=True)
	if not listed or listed.returncode: pytest.skip('not a git repository')
	admitted = {'CMakeLists.txt', 'plugin', 'scripts', 'tests', 'examples', 'findings', 'README.md', 'LICENSE'}
	found = {name.split('/')[0] for name in listed.stdout.splitlines()}
	assert {name for name in found if not name.startswith('.')} == admitted


# Functions that list attributes, with their documentation.
tables = 'attributes', 'results'


def code(text):
	"""C++ text without comments, literals and lines of the preprocessor; line breaks stay, also those in a comment or a macro."""
	noise = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*'
	return re.sub(noise, lambda match: '\n' * match[0].count('\n'), re.sub(r'(?<=\d)\'(?=\d)', '', text), flags=re.DOTALL | re.MULTILINE)


def functions(text):
	"""(name, number of lines) of each function with a body, from its head to its closing brace; lambdas are parts of the function around them."""
	text, found, depth, begin = code(text), [], 0, 0
	outside = None # depth of the braces around the function that is being read
	for match in re.finditer('[;{}]', text):
		char, position = match[0], match.start()
		if outside is None: # the text before a brace says what it opens
			head, begin = text[begin:position], position + 1
			name = re.search(r'([\w~]+|operator\W+)\s*\(', re.sub(r'\bdecltype\s*\(', '', head))
			if char == '{' and name: outside, first = depth, position - len(head.lstrip())
		depth += {'{': 1, '}': -1, ';': 0}[char]
		if char != '}' or depth != outside: continue
		if re.match(r'\s*[,{]', text[position + 1:]): continue # member that a constructor initialises
		found.append((name[1], text.count('\n', first, position) + 1))
		outside, begin = None, position + 1
	return found


def tooLong(text):
	return [f'{name}() has {lines} lines' for name, lines in functions(text) if lines > 40 and name not in tables]


def test_functionsAreFound():
	"""Functions in a piece of C++ of every kind that is used."""
	body = '\n'.join(['\t{ int x = 1; } // }'] * 41)
	assert functions('struct A { A(int x) : a { x }, b(x)\n{\n}\nint a; A& operator=(A) { f(); }\nvoid f() const override { }\n};') == [('A', 3), ('operator=', 1), ('f', 1)]
	assert functions('template <class T, int N = 3> auto g(T x) -> decltype(x)\n{\n\treturn h([&] {\n\t\treturn x; });\n}\nint y[] = { 1, 2 };\n') == [('g', 5)]
	assert functions('namespace n {\nconst char* s = "}{"; char c = \'{\'; // {\n#define F { \\\n {\nvoid k() { }\n}') == [('k', 1)]
	assert tooLong(f'void f()\n{{\n{body}\n}}\nvoid g()\n{{\n}}\n') == ['f() has 44 lines']
	assert not tooLong(f'void attributes()\n{{\n{body}\n}}\n')


def test_functionsFitOnAScreen():
	wrong, found = [], 0
	for path in sources('core') + sources('engine'):
		text = path.read_text()
		found += len(functions(text))
		wrong += [f'{path.relative_to(plugin)}: {function}' for function in tooLong(text)]
	assert found > 500
	assert not wrong


def test_filesHoldOneConcept():
	"""A file holds one concept with all of its functions. Where it grows long it may hold two of them, which is for the reader to judge."""
	for path in sources('core') + sources('engine'):
		lines = path.read_text().count('\n')
		if lines > 450: warnings.warn(f'{path.relative_to(plugin)} has {lines} lines: does it hold one concept?')


def test_commentsAreAtMost120ColumnsWide():
	"""But for formulas, tables and code in them, which are indented or begin with a bar."""
	wrong = []
	for path in [path for folder in ('plugin', 'tests') for path in (root / folder).rglob('*.[ch]pp')]:
		for number, line in enumerate(path.read_text().splitlines(), 1):
			text = re.match(r'\s*//+[!<]? ?(.*)', line)
			if text and len(line.expandtabs(8)) > 120 and not text[1].startswith((' ', '\t', '|')): wrong.append(f'{path.relative_to(root)}:{number}')
	assert not wrong
