# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the script of an example within another script of YADE."""
import builtins
import os
import runpy
import sys
import tempfile


def runExample(path, names, **arguments):
	"""Globals of the script after it has run with options, or, if it is examples/trade/scenes.py, which reads YADE's parameter table, with the values of one.

	:param names: what it finds without importing it: the globals of a script that YADE runs, some of them replaced if need be
	"""
	own = sys.argv
	given = {name: value for name, value in names.items() if not name.startswith('__')} | dict(__builtins__=builtins)
	with tempfile.TemporaryDirectory() as out:
		sys.argv = [path]
		if path.endswith('trade/scenes.py'):
			with open(os.path.join(out, 'parameters.table'), 'w') as table:
				print(*arguments, file=table)
				print(*map(repr, arguments.values()), file=table)
			os.environ['YADE_BATCH'] = os.path.join(out, 'parameters.table') + ':2'
		else: sys.argv += [f'--{name}={value}' for name, value in arguments.items()] + ['--out', out]
		try: return runpy.run_path(path, given, '__main__')
		finally:
			sys.argv = own
			os.environ.pop('YADE_BATCH', None)
