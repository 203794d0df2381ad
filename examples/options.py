# SPDX-License-Identifier: GPL-2.0-or-later
"""How the examples read their options."""
import argparse
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
	from yade.params import table  # what the line above has made
	inBatch = '-' + utils.O.tags['description'] if utils.runningInBatch() else ''
	parser = argparse.ArgumentParser(prog=name + '.py', description=purpose)
	for option, (default, text) in options.items():
		parser.add_argument('--' + option, type=type(default), default=getattr(table, option), help=text + ' (default %(default)s)')
	parser.add_argument('--out', default=table.out or f'out/{name}{inBatch}', help='folder of the results (default %(default)s)')
	chosen = parser.parse_args()
	os.makedirs(chosen.out, exist_ok=True)
	return chosen
