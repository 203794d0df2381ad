# SPDX-License-Identifier: GPL-2.0-or-later
"""Markdown pages of results."""
import os


def number(text):
	"""The number that a text of a table stands for, or the text itself."""
	try:
		return float(text)
	except ValueError:
		return text


def percent(x):
	return f'{100 * x:.2g} %'


def span(values, digits=2):
	"""Least and largest of some numbers, as text."""
	low, high = (f'{x:.{digits}g}' for x in (min(values), max(values)))
	return low if low == high else f'{low} to {high}'


def table(heads, rows):
	return '\n'.join(f"| {' | '.join(map(str, row))} |" for row in [heads, ['---'] * len(heads), *rows])


def replace(path, text):
	"""Write a file at once and as a whole."""
	with open(path + '.new', 'w') as file:
		file.write(text)
	os.replace(path + '.new', path)


def write(folder, parts, name='README.md'):
	"""A page of a folder."""
	replace(os.path.join(folder, name), '\n'.join(parts))
