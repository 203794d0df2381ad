# SPDX-License-Identifier: GPL-2.0-or-later
"""The list in which mpm.examples looks, plugin/python/mpm/scripts.py, from the scripts of examples/; it goes wherever the plugin is installed. `/usr/bin/python3 scripts/lib/examplelist.py` writes it."""
import ast
import os
import re

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
target = os.path.join(root, 'plugin', 'python', 'mpm', 'scripts.py')


def isForUsers(path):
	"""Scripts that make a scene and say what they are: all that YADE runs by themselves."""
	with open(path) as file:
		return file.readline().startswith('#!/usr/bin/env yade')


def entry(path):
	"""Path, first sentence, and words: what the head of the script says, and the classes and functions that it uses."""
	with open(path) as file:
		text = file.read()
	said = ' '.join(ast.get_docstring(ast.parse(text)).split())
	sentence = re.match(r'.*?(?<!\b[A-Z])[.:](?= |$)', said)[0].rstrip('.:')
	used = sorted(set(re.findall(r'\bMpm\w+|\bmpm\.\w+(?:\.\w+)?', text)))
	head = set(re.findall(r"[a-z][a-z'-]+[a-z]", said.lower()))
	return os.path.relpath(path, root), sentence, ' '.join([*sorted(head), *used])


def listed():
	folder = os.path.join(root, 'examples')
	paths = [os.path.join(place, name) for place, _, files in os.walk(folder) for name in files if name.endswith('.py')]
	entries = sorted((entry(path) for path in paths if isForUsers(path)), key=lambda one: ('/tasks/' not in one[0], one[0]))
	lines = [f'        ({path!r}, {sentence!r},\n         {words!r}),' for path, sentence, words in entries]
	return '\n'.join([
	        '# SPDX-License-Identifier: GPL-2.0-or-later', '"""List of examples: path, what it is, words. Written by scripts/lib/examplelist.py, from the scripts."""', 'scripts = [', *lines, ']', ''
	])


if __name__ == '__main__':
	with open(target, 'w') as file:
		file.write(listed())
