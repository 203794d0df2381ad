# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the studies, plugin/docs/studies: a conclusion written by hand, and below it the kept tables. scripts/study writes them.

A study NAME has a folder with conclusion.md, its pictures, tables (CSV), and tables.csv, which lists them in order: file, title, command (with day and revision) and note. NAME.md beside the folder is the page. Folders of results have the same
tables and list. Where a study keeps cases.csv and earlier.csv, rows of new cases replace those of the same case, which go to earlier.csv.
"""
import csv
import os
import re
import shutil
import subprocess
import time

import pages
import results

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
home = os.path.join(root, 'plugin', 'docs', 'studies')
mostWords = 600
listed = ['file', 'title', 'command', 'note']


def revision():
	"""That of git, with -dirty where files have changed; empty where there is no git, or no repository."""
	return subprocess.run(['git', '-C', root, 'describe', '--always', '--dirty'], capture_output=True, text=True).stdout.strip() if shutil.which('git') else ''


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


def indexOf(folder):
	"""Tables of a folder, in order, as dictionaries of file, title, command and note."""
	return results.read(os.path.join(folder, 'tables.csv'))


def keep(folder, file, title, command, rows, note=''):
	"""Keep a table, rows with their head first, and list it where that file is listed already, else last. A picture, which is in the folder, has no rows."""
	if rows: write(os.path.join(folder, file), rows)
	index = indexOf(folder)
	entry = dict(file=file, title=title, command=command, note=note)
	index = [entry if row['file'] == file else row for row in index] if any(row['file'] == file for row in index) else [*index, entry]
	results.write(os.path.join(folder, 'tables.csv'), listed, index)


def keepAll(folder, tables, command):
	"""Keep tables, each a file, a title, rows with their head first, None for a picture, and possibly a note."""
	for file, title, rows, *note in tables: keep(folder, file, title, command if rows else '', rows, *note)


def publish(study, tables, command):
	"""Keep the tables of a study, and write its page."""
	keepAll(os.path.join(home, study), tables, command)
	pages.replace(os.path.join(home, study + '.md'), page(study))


def renew(folder, rows):
	"""Put rows of cases, their head first, in the place of those of the same cases, which go to the end of the earlier ones."""
	paths = [os.path.join(folder, name) for name in ('cases.csv', 'earlier.csv')]
	(head, *old), earlier = map(rowsOf, paths)
	if rows[0] != head: raise ValueError(f'{folder}/cases.csv has the columns {head}, and not {rows[0]}: give rows of the same columns.')
	new = {row[0]: row for row in rows[1:]}
	write(paths[1], [*earlier, *(row for row in old if row[0] in new and row != new[row[0]])])
	write(paths[0], [head, *(new.pop(row[0], row) for row in old), *new.values()])


def take(study, made):
	"""Keep the tables that a folder of results lists, and its pictures, and write the page."""
	folder, index = os.path.join(home, study), indexOf(made)
	if not index: raise ValueError(f'{made} lists no tables: name a folder of results that has tables.csv.')
	for row in index:
		rows = rowsOf(os.path.join(made, row['file'])) if row['file'].endswith('.csv') else None
		if row['file'] == 'cases.csv' and os.path.exists(os.path.join(folder, 'earlier.csv')): renew(folder, rows)
		else: keep(folder, row['file'], row['title'], row['command'], rows, row['note'])
	for name in os.listdir(made):
		if name.endswith('.png'): shutil.copy(os.path.join(made, name), folder)
	pages.replace(folder + '.md', page(study))


def dayOf(path):
	"""Day of a file, as pages write it."""
	return time.strftime('%d %B %Y', time.localtime(os.path.getmtime(path)))


def markdown(rows):
	escaped = [[str(cell).replace('|', '\\|') for cell in row] for row in rows]
	return pages.table(escaped[0], escaped[1:])


def conclusionOf(study, values={}):
	"""Title and conclusion, with values for its {names}."""
	folder = os.path.join(home, study)
	with open(os.path.join(folder, 'conclusion.md')) as file:
		text = file.read().strip()
	if not text.startswith('# '): raise ValueError(f'{folder}/conclusion.md begins with {text[:20]!r}; a title, # and a space before it, is admitted. Write one in its first line.')
	if (count := len(text.split())) > mostWords: raise ValueError(f'{folder}/conclusion.md has {count} words; at most {mostWords} are admitted. Leave numbers to tables.')
	for name, value in values.items(): text = text.replace('{' + name + '}', str(value))
	return _moved(text, folder)


def _moved(text, folder):
	"""Text with its links, which are right in the folder of a study, as they are right on its page beside that folder."""
	moved = lambda link: link if not link or re.match(r'\w+:', link) else os.path.relpath(os.path.join(folder, link), home)
	return re.sub(r'(\]\()([^)#\s]*)', lambda link: link[1] + moved(link[2]), text)


def page(study):
	"""Text of a page; summary.csv, if there is one, has the values of its conclusion."""
	folder = os.path.join(home, study)
	summary = os.path.join(folder, 'summary.csv')
	values = dict(rowsOf(summary)[1:]) if os.path.exists(summary) else {}
	return '\n'.join([conclusionOf(study, values), '', *sections(folder, lambda text: _moved(text, folder))])


def report(folder, title, text):
	"""Write the page of a folder of results."""
	pages.write(folder, [f'# {title}\n', text, '', *sections(folder)])


def sections(folder, moved=str):
	"""Contents and all tables and pictures of a folder, each with its command and its note, whose links are moved."""
	index = indexOf(folder)
	parts = ['## Tables', '', *(f"- [{row['title']}](#{anchor(row['title'])})" for row in index), ''] if index else []
	for row in index:
		shown = moved(f"![{row['title']}]({row['file']})") if row['file'].endswith('.png') else markdown(rowsOf(os.path.join(folder, row['file'])))
		parts += [f"### {row['title']}", '', *(text for name in ('command', 'note') if row[name] for text in (moved(row[name]), '')), shown, '']
	return parts


def anchor(title):
	return re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-')


def replaceAll():
	"""Write all pages but that of the benchmarks, which has a writer of its own."""
	for study in names():
		if indexOf(os.path.join(home, study)): pages.replace(os.path.join(home, study + '.md'), page(study))

