# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of results that survive an interruption."""
import argparse
import csv
import os
import sys
import tempfile


def seconds(text):
	"""Type of an option on the command line: a time limit [s]."""
	try:
		limit = float(text)
	except ValueError:
		limit = 0
	if not 0 < limit <= 1e6: raise argparse.ArgumentTypeError(f'{text} is not a time > 0 and <= 1e6 s')
	return limit


def seeds(text):
	"""Type of an option on the command line: numbers of scenes that are drawn at random, as 0:100 or 3,17."""
	try:
		found = list(range(*map(int, text.split(':')))) if ':' in text else [int(number) for number in text.split(',')]
	except (TypeError, ValueError):
		found = []
	if not found or min(found) < 0: raise argparse.ArgumentTypeError(f'{text} is not admitted: give numbers >= 0, as FROM:TO or 3,17,45')
	return found


def makeFolder(out):
	"""Make the folder <out>/results before anything is run; the script ends with the reason if nothing can be written there."""
	folder = os.path.join(out, 'results')
	try:
		os.makedirs(folder, exist_ok=True)
		tempfile.TemporaryFile(dir=folder).close()
	except OSError as error:
		sys.exit(f'{os.path.basename(sys.argv[0])}: nothing can be written to the folder {folder} (--out): {error.strerror}')


def read(path, convert=str):
	"""Rows of a CSV file as dictionaries of texts, or of what *convert* makes of each; none if there is no such file."""
	if not os.path.exists(path): return []
	with open(path, newline='') as file:
		return [{name: convert(text) for name, text in row.items()} for row in csv.DictReader(file)]


def write(path, columns, rows):
	"""Write dictionaries to a CSV file, at once and as a whole."""
	os.makedirs(os.path.dirname(path), exist_ok=True)
	with open(path + '.new', 'w', newline='') as file:
		table = csv.DictWriter(file, columns, lineterminator='\n')
		table.writeheader()
		table.writerows(rows)
	os.replace(path + '.new', path)


class Results:
	"""A table in <out>/results/<name>.csv. Each row is written when it is known, so that an interrupted run can be continued.

	SystemExit is raised if the file there has other columns.

	:param keys: names of the leading columns, which say what was run
	:param values: names of the other columns
	"""

	def __init__(self, out, name, keys, values):
		self.path = os.path.join(out, 'results', name + '.csv')
		self.keys, self.columns = keys, keys + values
		self.rows = {}
		if os.path.exists(self.path):
			with open(self.path, newline='') as file:
				found = csv.DictReader(file)
				if found.fieldnames != self.columns:
					raise SystemExit(f"{self.path} is a table of other runs: its columns are {', '.join(found.fieldnames or ['none'])}, "
					                 f"and not {', '.join(self.columns)}; remove it, or write to another folder (--out)")
				self.rows = {self._key(row): row for row in found}

	def __contains__(self, key):
		return tuple(map(str, key)) in self.rows

	def row(self, key):
		return self.rows[tuple(map(str, key))]

	def add(self, rows):
		"""Add dictionaries of numbers or texts; each replaces a row of the same key."""
		for row in rows:
			row = {name: str(row[name]) for name in self.columns}
			self.rows[self._key(row)] = row
		write(self.path, self.columns, self.rows.values())

	def _key(self, row):
		return tuple(row[name] for name in self.keys)
