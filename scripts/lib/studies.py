# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the studies, plugin/docs/studies: a conclusion written by hand, and below it the kept tables. Run by itself it writes all of them, for scripts/validate and scripts that keep tables; needs nothing of YADE.

A study NAME has a folder with conclusion.md, its pictures, tables (CSV), and tables.csv, which lists them in order: file, title, command (with day and revision) and note. NAME.md beside the folder is the page.
"""
import csv
import os
import re

import pages

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
home = os.path.join(root, 'plugin', 'docs', 'studies')
mostWords = 600
listed = ['file', 'title', 'command', 'note']


def names():
	return sorted(name for name in os.listdir(home) if os.path.exists(os.path.join(home, name, 'conclusion.md')))


def rowsOf(path):
	"""Rows of a CSV file, its head included, as lists of texts."""
	with open(path, newline='') as file:
		return list(csv.reader(file))


def write(path, rows):
	os.makedirs(os.path.dirname(path), exist_ok=True)
	with open(path, 'w', newline='') as file:
		csv.writer(file, lineterminator='\n').writerows(rows)


def indexOf(study, of=None):
	"""Tables of a study, in order, as dictionaries of file, title, command and note."""
	path = os.path.join(of or home, study, 'tables.csv')
	if not os.path.exists(path): return []
	with open(path, newline='') as file:
		return list(csv.DictReader(file))


def keep(study, file, title, command, rows, note='', of=None):
	"""Keep a table, rows with their head first, and list it where a table of that file is listed already, else last."""
	write(os.path.join(of or home, study, file), rows)
	index = indexOf(study, of)
	entry = dict(file=file, title=title, command=command, note=note)
	index = [entry if row['file'] == file else row for row in index] if any(row['file'] == file for row in index) else [*index, entry]
	write(os.path.join(of or home, study, 'tables.csv'), [listed, *([row[name] for name in listed] for row in index)])


def tablesOf(text):
	"""Tables of a page in Markdown as (heading, paragraphs between it and the table before, rows with their head first)."""
	found, heading, between, lines = [], '', [], []
	for line in [*text.splitlines(), '']:
		if line.startswith('|'):
			lines.append(line)
			continue
		if lines:
			found.append((heading, '\n'.join(between).strip(), [cells(row) for number, row in enumerate(lines) if number != 1]))
			lines, between = [], []
		if line.startswith('#'): heading, between = line.lstrip('# '), []
		else: between.append(line)
	return found


def cells(line):
	return [cell.strip().replace('\\|', '|') for cell in re.split(r'(?<!\\)\|', re.sub(r'^\||\|$', '', line.strip()))]


def markdown(rows):
	escaped = [[cell.replace('|', '\\|') for cell in row] for row in rows]
	return pages.table(escaped[0], escaped[1:])


def conclusionOf(study, values={}):
	"""Title and conclusion, with values for its {names}; its links are right beside it, and so need another folder on the page."""
	folder = os.path.join(home, study)
	with open(os.path.join(folder, 'conclusion.md')) as file:
		text = file.read().strip()
	if not text.startswith('# '): raise ValueError(f'{folder}/conclusion.md begins with {text[:20]!r}; a title, # and a space before it, is admitted. Write one in its first line.')
	if (count := len(text.split())) > mostWords: raise ValueError(f'{folder}/conclusion.md has {count} words; at most {mostWords} are admitted. Leave numbers to tables.')
	for name, value in values.items(): text = text.replace('{' + name + '}', str(value))
	moved = lambda link: os.path.relpath(os.path.join(folder, link[2]), home) if not re.match(r'\w+:|#', link[2]) else link[2]
	return re.sub(r'(\]\()([^)#\s]*)', lambda link: link[1] + (moved(link) if link[2] else ''), text)


def page(study, values={}, more=''):
	"""Text of a page; more: what its own writer adds below."""
	parts = [conclusionOf(study, values), '']
	if index := indexOf(study): parts += ['## Tables', '', *(f"- [{row['title']}](#{anchor(row['title'])})" for row in index), '']
	for row in index:
		parts += [f"### {row['title']}", '', *([row['command'], ''] if row['command'] else []), *([row['note'], ''] if row['note'] else []), markdown(rowsOf(os.path.join(home, study, row['file']))), '']
	return '\n'.join(parts) + more


def anchor(title):
	return re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-')


def replaceAll():
	"""Write all pages but those that have writers of their own."""
	for study in names():
		if indexOf(study): pages.replace(os.path.join(home, study + '.md'), page(study))


if __name__ == '__main__':
	replaceAll()
	print(f'written: {home}')
