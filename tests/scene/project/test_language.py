# SPDX-License-Identifier: GPL-2.0-or-later
"""Comments and docstrings begin with what they name: a noun phrase or a verb."""
import ast
import io
import re
import tokenize

import pytest
from conftest import root

headless = re.compile(r'(Of|What|Who|Whoever|Whether|Where|How|As|By|Which|Whose|With|That)\b', re.IGNORECASE)

# comments of C++, and literals, in which no comment begins
lexemes = re.compile(r'//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|R"(\w*)\(.*?\)\3"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
# documentation of classes and attributes of YADE: text in the code of the engine
documentation = re.compile(r'(?:\bdoc\(\)\s*\{\s*return\s*|\bv\(\s*"\w+",[^"]*?)"((?:\\.|[^"\\\n])*)"')
licence = re.compile(r'\s*(SPDX|/(usr/)?bin/)')  # or the interpreter of a script


def firstOfEach(comments, lines):
	"""Trailing comments, and the first line of each block: (line, text) of (line, column, text). A line below in the same column goes on with a comment."""
	found, before = [], None
	for number, column, text in comments:
		indent = lines[number - 1][:column]
		goesOn = not indent.strip() and before == (number - 1, len(indent.expandtabs(8)))
		if not goesOn: found.append((number, text))
		before = (number, len(indent.expandtabs(8))) if re.search('[A-Za-z]{2}', text) and not licence.match(text) else None
	return found


def inCpp(text):
	single, found = [], []
	for match in lexemes.finditer(text):
		number, column = text.count('\n', 0, match.start()) + 1, match.start() - text.rfind('\n', 0, match.start()) - 1
		if match['line'] is not None: single.append((number, column, match['line'].lstrip('/!<')))
		if match['block'] is not None: found.append((number, match['block'].lstrip('*!<')))
	found += [(text.count('\n', 0, match.start(1)) + 1, match[1]) for match in documentation.finditer(text)]
	return found + firstOfEach(single, text.splitlines())


def inPython(text):
	tokens = tokenize.generate_tokens(io.StringIO(text).readline)
	found = firstOfEach([(*token.start, token.string.lstrip('#!')) for token in tokens if token.type == tokenize.COMMENT], text.splitlines())
	documented = [node for node in ast.walk(ast.parse(text)) if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node)]
	return found + [(node.body[0].lineno, ast.get_docstring(node)) for node in documented]


def inShell(text):
	lines = text.splitlines()
	return firstOfEach([(number, line.index('#'), line.strip().lstrip('#!')) for number, line in enumerate(lines, 1) if re.match(r'\s*#', line)], lines)


def commentsIn(name, text):
	"""(line, text) of each comment and docstring, in the order of lines, but for licences and lines without words."""
	if name.endswith(('.cpp', '.hpp')): found = inCpp(text)
	elif name.endswith('.py') or re.match(r'#!.*python', text): found = inPython(text)
	elif name.endswith('.sh') or re.match(r'#!.*sh\b', text): found = inShell(text)
	else: return []
	return sorted((number, text.strip()) for number, text in found if re.search('[A-Za-z]{2}', text) and not licence.match(text))


def commentsOf(folder):
	"""(place, text) of each comment in the files of a folder."""
	paths = [path for path in sorted((root / folder).rglob('*')) if path.is_file() and path.suffix in ('.cpp', '.hpp', '.py', '.sh', '')]
	return [(f'{path.relative_to(root)}:{number}', text) for path in paths for number, text in commentsIn(path.name, path.read_text())]


def test_comments_are_found():
	"""Comments of every kind that is used, in a piece of text of each language."""
	cpp = '// Of one\n// block\nint a; // as given\n       // by the caller\nchar c = \'"\'; /* What\n * is */ const char* s = "// no";\nv("a", &A::a, 0,\n  "How far.")'
	assert commentsIn('a.cpp', cpp) == [(1, 'Of one'), (3, 'as given'), (5, 'What\n * is'), (8, 'How far.')]
	python = '"""Of a module."""\n# First\n# second\na = "# no"  # whether\ndef f():\n\t"""What f does."""\n\treturn 1\n'
	assert commentsIn('a.py', python) == [(1, 'Of a module.'), (2, 'First'), (4, 'whether'), (6, 'What f does.')]
	assert commentsIn('run', '#!/bin/bash\n# SPDX\n#\n# Runs it\n# all.\nrun # as it is\n') == [(4, 'Runs it')]
	assert headless.match('as given') and headless.match('What') and not headless.match('Offset') and not headless.match('Normal force [N]')


@pytest.mark.parametrize('folder', ['plugin/core', 'plugin/engine', 'plugin/petsc', 'plugin/yade_api', 'plugin/python', 'scripts', 'tests', 'examples'])
def test_comments_begin_with_what_they_name(folder):
	"""At most 3 % of them with a word after which the reader has to look for the thing."""
	comments = commentsOf(folder)
	assert len(comments) > 15
	wrong = [f'{place}: {text.splitlines()[0]}' for place, text in comments if headless.match(text)]
	assert len(wrong) <= 0.03 * len(comments), f'{len(wrong)} of {len(comments)} comments:\n' + '\n'.join(wrong)
