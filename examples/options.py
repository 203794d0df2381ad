# SPDX-License-Identifier: GPL-2.0-or-later
"""Options of the examples, and their comparisons with other results."""
import argparse
import csv
import os
import sys

from yade import utils


def readOptions(purpose, **options):
	"""Options from the command line; where it is silent, from the parameter table of yade-batch; otherwise the defaults.

	Every example has an option *out* besides, the folder of its results: out/<name of the script>, and in a batch
	out/<name of the script>-<description of the line in the table>, so that the jobs of a batch do not share a folder.

	:param purpose: one line for --help
	:param options: name=(default, help text); a number or text on the command line is converted to the type of the default
	:return: object with an attribute for each option
	"""
	name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
	utils.readParamsFromTable(noTableOk=True, out=None, **{option: default for option, (default, _) in options.items()})
	from yade.params import table  # module made by the line above
	inBatch = '-' + utils.O.tags['description'] if utils.runningInBatch() else ''
	parser = argparse.ArgumentParser(prog=name + '.py', description=purpose)
	for option, (default, text) in options.items():
		parser.add_argument('--' + option, type=type(default), default=getattr(table, option), help=text + ' (default %(default)s)')
	parser.add_argument('--out', default=table.out or f'out/{name}{inBatch}', help='folder of the results (default %(default)s)')
	chosen = parser.parse_args()
	os.makedirs(chosen.out, exist_ok=True)
	_startComparisons(os.path.join(chosen.out, 'compared.csv'))
	return chosen


_file = None


def _startComparisons(path):
	global _file
	_file = path
	with open(path, 'w', newline='') as file:
		csv.writer(file).writerow(['quantity', 'ours', 'theirs', 'unit', 'source'])


def compared(quantity, ours, theirs, source, unit=''):
	"""Keep a number of a run beside the one that it is held against, in compared.csv in the folder of the results; scripts/validate makes the page of all of them.

	:param quantity: what it is, and what of the options changes it, as 'limit load, 17 cells over the width'
	:param ours: found by the run
	:param theirs: closed form, measured or published
	:param source: whose it is, as 'Prandtl 1921'
	:param unit: of both
	"""
	if not _file or not os.path.isdir(os.path.dirname(_file)): return  # called by another script, which has run the scenes of this one
	with open(_file, 'a', newline='') as file:
		csv.writer(file).writerow([quantity, f'{float(ours):.6g}', f'{float(theirs):.6g}', unit, source])
