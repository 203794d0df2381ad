# SPDX-License-Identifier: GPL-2.0-or-later
"""Page of all errors and warnings by topic, collected from the sources. Run by scripts/docs: python3 scripts/lib/messages.py FILE

A message is the text of one statement: its string literals in their order, with an ellipsis for the values in between. Documentation of attributes and functions
is left out; what an attribute admits is told in the words of its refusal.
"""
import ast
import os
import re
import sys

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
value = '…'
fewest = 5  # words of a message
others = 'module.cpp', 'report.cpp', 'scripts.py'  # sources of documentation, and the list of examples

# Title, words in the path of a source, pages that explain; the first that fits counts.
topics = [
        ('Contact with rigid bodies', ('/contact', 'pushing'), ['MpmContact']),
        ('Contact between MPM bodies', ('/bodies', 'solids', 'sections'), ['MpmBodyContact']),
        ('Boundaries and walls', ('/boundary', 'wall'), ['MpmBoundary']),
        ('Beams and bars', ('structures', 'diagram'), ['MpmBeam', 'MpmReinforcement']),
        ('Loads on surfaces', ('traction', 'surface'), ['MpmTraction']),
        ('Water', ('water', 'flow', 'darcy', 'seepage'), ['MpmWater', 'MpmFlow', 'MpmDrain']),
        ('Waves and earthquakes', ('shaking', 'inertia', 'freefield', 'record', 'waves', 'spectr', 'MpmDynamic', 'moving'), ['MpmDynamicEngine', 'MpmFreeField', 'MpmAbsorbingBoundary', 'MpmBaseMotion']),
        ('Materials and laws', ('materials', 'laborator', 'calibrat'), ['MpmMaterial', 'MpmFrictionalMat', 'MpmUserMat']),
        ('Several processes', ('parallel', 'petsc', 'processes', 'distribut'), []),
        ('Grid and points', ('/grid', 'points', 'filling', 'splitting', 'columns', 'assign'), ['MpmGrid', 'MpmRefinement', 'MpmAdaptation', 'MpmState']),
        ('Files, pictures and tables', ('output', 'plot', 'view', 'movie', 'page', 'table', 'paraview', 'saving', 'histor', 'collect', 'note'), ['MpmVtkRecorder']),
        ('The YADE that it runs in', ('yade_api', 'loading'), []),
        ('Functions of yade.mpm', ('python',), []),
        ('Load steps, convergence and settings', ('',), ['MpmImplicitEngine', 'MpmNewton', 'MpmGhost']),
]


def topicOf(path):
	"""Topic of a source; a module of Python counts by its own name, not by that of its package."""
	if path.startswith('/python/'): path = '/python/' + os.path.basename(path)
	return next(title for title, words, _ in topics if any(word in path for word in words))


def sources(folder, endings):
	for base, folders, names in os.walk(os.path.join(root, 'plugin', folder)):
		folders.sort()
		yield from (os.path.join(base, name) for name in sorted(names) if name.endswith(endings))


tokens = re.compile(r'//[^\n]*|/\*.*?\*/|"((?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\\n])+\'|([;{}])|([()])', re.DOTALL)


def statements(text):
	"""(function or block around it, pieces) of each C++ statement with a literal; pieces are code and literals, these as tuples."""
	text = re.sub(r'^[ \t]*#(?:\\\n|[^\n])*', '', text, flags=re.MULTILINE)
	heads, pieces, code, depth, begin = [], [], '', 0, 0
	for match in tokens.finditer(text):
		code += text[begin:match.start()]
		begin = match.end()
		literal, end, bracket = match.groups()
		if literal is not None:
			pieces += [code, (literal, )]
			code = ''
		elif bracket:
			depth += 1 if bracket == '(' else -1
			code += bracket
		elif end and (end == ';' or depth <= 0):
			yield ' '.join(heads[-2:]), pieces + [code]
			if end == '{': heads.append(''.join(piece for piece in pieces + [code] if isinstance(piece, str)))
			if end == '}' and heads: heads.pop()
			pieces, code = [], ''
		elif end: code += end


def joined(pieces):
	"""Text of a statement: literals, and an ellipsis where something else than blanks stands between two of them."""
	text, between = '', ''
	for piece in pieces:
		if isinstance(piece, str):
			between += piece
			continue
		if text: text += '' if not between.strip() else value
		elif re.search(r'<<\s*[^<"]+<<\s*$|return [^"?(]+\+\s*$', between): text = value
		text, between = text + piece[0], ''
	text = re.sub(r'\\n', ' ', text)
	return re.sub(r'\s+', ' ', re.sub(r'\\(.)', r'\1', text)).strip()


def isMessage(text):
	if re.match(r'[a-z]\w*…\S|<|For mpm\.', text): return False  # a table of names, a tag, a function that Python calls
	words = [word for word in text.replace(value, ' ').split() if re.search(r"[a-z]", word)]
	return len(words) >= fewest


documentation = re.compile(r'\bdoc\(\)|\.def\(|\bresults\(|describe|docstring|static_assert|YADE_')


def admittedOf(pieces, path):
	"""Refusal of an attribute that has a condition of its own, from its line in attributes(); None without one. The class has the name of its file."""
	code = ''.join(piece if isinstance(piece, str) else '"' for piece in pieces)
	name = re.search(r'&\w+::(\w+)', code)
	condition = next((piece[0] for before, piece in zip(pieces, pieces[1:]) if isinstance(piece, tuple) and 'admitting(' in before), None)
	return f'{os.path.splitext(os.path.basename(path))[0]}.{name[1]} = {value} is not admitted: expected {condition}.' if name and condition else None


def ofCpp(path):
	with open(path) as file:
		text = file.read()
	for head, pieces in statements(text):
		code = ''.join(piece for piece in pieces if isinstance(piece, str))
		if re.search(r'\battributes\(', head) or re.match(r'\s*v\(', code):
			refusal = admittedOf(pieces, path)
			if refusal: yield refusal
		elif not documentation.search(head + code):
			said = joined(pieces)
			if isMessage(said): yield said


def textOf(node):
	"""Text of an expression of Python, with an ellipsis for what is worked out."""
	if isinstance(node, ast.Constant): return node.value if isinstance(node.value, str) else value
	if isinstance(node, ast.JoinedStr): return ''.join(map(textOf, node.values))
	if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add): return textOf(node.left) + textOf(node.right)
	return value


def ofPython(path):
	with open(path) as file:
		tree = ast.parse(file.read())
	docstrings = {id(node.body[0].value) for node in ast.walk(tree) if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node)}
	inside = set()
	for node in ast.walk(tree):
		if not isinstance(node, (ast.BinOp, ast.JoinedStr, ast.Constant)) or id(node) in docstrings | inside: continue
		inside |= {id(part) for part in ast.walk(node)}
		said = re.sub(r'\s+', ' ', textOf(node)).strip()
		if isMessage(said) and not re.search(r'[{}<>]|:param', said): yield said


def collect():
	"""Messages of each topic, sorted, each once."""
	found = {title: set() for title, _, _ in topics}
	for folder, endings, read in ('core', ('.hpp', '.cpp'), ofCpp), ('petsc', ('.hpp', '.cpp'), ofCpp), ('yade_api', ('.hpp', '.cpp'), ofCpp), ('engine', ('.hpp', '.cpp'), ofCpp), ('python/mpm', '.py', ofPython):
		for path in sources(folder, endings):
			if os.path.basename(path) in others: continue
			title = topicOf('/' + os.path.relpath(path, os.path.join(root, 'plugin')))
			found[title].update(read(path))
	return {title: sorted(said, key=lambda text: re.sub(r'\W', '', text).lower()) for title, said in found.items() if said}


def escaped(text):
	"""Text that Markdown shows as it is, with an ellipsis before one that goes on from a name."""
	if re.match(r'[^\w\'"*…(]|(is|has|needs|does|have|are|holds|lies|reaches|touches|takes)\b', text): text = value + ('' if re.match(r'\W', text) else ' ') + text
	return re.sub(r'([\\*_<>`\[\]#|$])', r'\\\1', text)


def page(toClasses='../../plugin/docs/classes'):
	lines = ['# Errors and warnings', '', f'All messages, by topic. Search for some words of yours; {value} stands for a value. A message says what is admitted and what to do; the pages named explain it.', '']
	for title, said in collect().items():
		names = next(pages for topic, _, pages in topics if topic == title)
		lines += [f'## {title}', '']
		if names: lines += ['Pages: ' + ', '.join(f'[{name}]({toClasses}/{name}.md)' for name in names) + '.', '']
		lines += [f'- {escaped(text)}' for text in said] + ['']
	return '\n'.join(lines)


if __name__ == '__main__':
	with open(sys.argv[1], 'w') as file:
		file.write(page())
