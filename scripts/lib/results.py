# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of results that survive an interruption."""
import csv
import os


class Results:
	"""A table in <out>/results/<name>.csv. Each row is written when it is known, so that an interrupted run can be continued.

	:param keys: names of the leading columns, which say what was run
	:param values: names of the other columns
	"""

	def __init__(self, out, name, keys, values):
		self.path = os.path.join(out, 'results', name + '.csv')
		self.keys, self.columns = keys, keys + values
		self.rows = {}
		if os.path.exists(self.path):
			with open(self.path, newline='') as file:
				self.rows = {self._key(row): row for row in csv.DictReader(file)}

	def __contains__(self, key):
		return tuple(map(str, key)) in self.rows

	def row(self, key):
		return self.rows[tuple(map(str, key))]

	def add(self, rows):
		"""Add dictionaries of numbers or texts; each replaces a row of the same key."""
		for row in rows:
			row = {name: str(row[name]) for name in self.columns}
			self.rows[self._key(row)] = row
		os.makedirs(os.path.dirname(self.path), exist_ok=True)
		with open(self.path + '.new', 'w', newline='') as file:
			table = csv.DictWriter(file, self.columns, lineterminator='\n')
			table.writeheader()
			table.writerows(self.rows.values())
		os.replace(self.path + '.new', self.path)

	def _key(self, row):
		return tuple(row[name] for name in self.keys)
