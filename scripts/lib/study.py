# SPDX-License-Identifier: GPL-2.0-or-later
"""Common part of all studies: options of a command, cases in YADE processes, tables and page of a folder of results.

A study is a module of scripts/lib/commands: its docstring is the help, and `main(study, arguments)` adds options, runs cases and keeps tables. `study`, if it has one, is the
folder of plugin/docs/studies for its tables, and `keep(folder)` prepares results for that.
"""
import argparse
import ast
import collections
import importlib
import os
import queue
import shlex
import sys
import threading
import time

import studies
from results import Results, makeFolder, seconds
from worker import root, runCases, yadeCommand

library = os.path.join(root, 'scripts', 'lib')
names = sorted(name[:-3] for name in os.listdir(os.path.join(library, 'commands')) if name.endswith('.py') and name != '__init__.py')


def about(name):
	"""First sentence of the help of a study."""
	with open(os.path.join(library, 'commands', name + '.py')) as file:
		return ast.get_docstring(ast.parse(file.read())).split('\n')[0]


def run(name, arguments):
	"""Run a study by its name, or keep its results."""
	module = importlib.import_module('commands.' + name)
	if arguments[:1] == ['--keep']:
		if len(arguments) != 2: sys.exit(f'scripts/study: {name} --keep {shlex.join(arguments[1:])} is not admitted: give one folder of results.')
		folder = module.keep(arguments[1]) if hasattr(module, 'keep') else arguments[1]
		return studies.take(getattr(module, 'study', name), folder)
	study = Study(name, module.__doc__)
	failed = module.main(study, arguments)
	if study.summary: print(study.summary)
	return failed


class Study:
	"""Command of a study."""

	def __init__(self, name, text):
		self.name, self.title = name, text.split('\n')[0].rstrip('.')
		self.parser = argparse.ArgumentParser(prog=f'scripts/{name}', description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
		self.option, self.summary = self.parser.add_argument, ''

	def parse(self, arguments, timeLimit=None, limited='for one case [s]', processes=None, quick=None, hasFolder=True):
		"""Values of the options, those that studies have in common included.

		:param timeLimit: default of --time-limit [s], which *limited* explains; None: the study has no such option
		:param processes: default of --processes; None: no such option
		:param quick: help of --quick; None: no such option
		"""
		if quick: self.option('--quick', action='store_true', help=quick)
		if hasFolder: self.option('--out', help=f'folder of the results (default out/{self.name}' + (f', with --quick out/{self.name}-quick' if quick else '') + ')')
		if processes: self.option('--processes', type=int, default=processes, metavar='N', help='at a time (default %(default)s)')
		if timeLimit: self.option('--time-limit', type=seconds, default=timeLimit, metavar='S', help=limited + ' (default %(default)g)')
		self.option('--user', action='store_true', help='use build/overlay also as root (see scripts/setup --help)')
		self.options = self.parser.parse_args(arguments)
		shown = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
		shown.add_argument('--out')
		shown.add_argument('--user', action='store_true')
		self.command = shlex.join([f'scripts/{self.name}', *shown.parse_known_args(arguments)[1]])
		if hasFolder and not self.options.out: self.options.out = f'out/{self.name}' + ('-quick' if quick and self.options.quick else '')
		return self.options

	def fail(self, text):
		sys.exit(f'scripts/{self.name}: {text}')

	def chosen(self, given, known, what):
		"""Names that were given, or all that are known; ends with a message if one is not known."""
		for name in given:
			if name not in known: self.fail(f"there is no {what} {name}; there are {', '.join(known)}.")
		return list(given or known)

	@property
	def provenance(self):
		"""Day and revision of a run, where git is there to tell it."""
		revision = studies.revision()
		return time.strftime('%d %B %Y') + f', revision {revision}' * bool(revision)

	def table(self, keys, values, name=None):
		"""Results that an interrupted run continues."""
		makeFolder(self.options.out)
		return Results(self.options.out, name or self.name, keys, values)

	def run(self, cases, limit, threads=1, areAlone=False, folder=library):
		"""Yield (case, result) of all cases, in the order in which they end: the result of the function, or 'crash' or 'timeout'.

		:param cases: sequences of a key, the name of a function, as 'sand.wall.wall', and its arguments, a dict
		:param limit: [s] of the wall clock for a case, or a function of the case
		:param areAlone: each case has a process of its own
		:param folder: of modules, besides scripts/lib
		"""
		cases = list(cases)
		print(f'{len(cases)} cases to run', flush=True)
		os.environ.setdefault('OMP_WAIT_POLICY', 'passive')  # threads that wait shall not take the processor from other processes
		os.environ['PYTHONPATH'] = os.pathsep.join([folder, library, *os.environ.get('PYTHONPATH', '').split(os.pathsep)])
		command = [*yadeCommand(self.options.user, threads), os.path.join(library, 'caserun.py')]
		processes, ended = getattr(self.options, 'processes', 1), queue.Queue()
		parts = collections.deque([case] for case in cases) if areAlone else collections.deque(cases[k::processes] for k in range(processes))

		def work():
			try:
				while parts:
					part = parts.popleft()
					for pair in runCases(command, part, limit(part[0]) if callable(limit) else limit): ended.put(pair)
			except Exception as error:
				ended.put(error)

		for _ in range(processes): threading.Thread(target=work, daemon=True).start()
		for _ in cases:
			pair = ended.get()
			if isinstance(pair, Exception): raise pair
			yield pair

	def fill(self, table, cases, limit, shown, reason='why', missing='', **how):
		"""Run the cases that a table has no row of, by their keys, and add their rows.

		:param shown: columns that are printed as a case ends
		:param missing: text of a column that a case has no value of
		:param reason: column for 'crash', 'timeout' and the text of an exception
		"""
		for (key, *_), result in self.run([case for case in cases if case[0] not in table], limit, **how):
			if result is None: continue
			if isinstance(result, str): result = {reason: result}
			elif 'why' in result: result = {name: value for name, value in result.items() if name != 'why'} | {reason: result['why']}
			found = {name: '; '.join(map(str, value)) if isinstance(value, list) else value for name, value in result.items() if name in table.columns}
			table.add([dict.fromkeys(table.columns, missing) | {reason: ''} | found | dict(zip(table.keys, key))])
			print(', '.join(str(word) for word in key if word != ''), *(table.row(key)[name] for name in shown), flush=True)

	def write(self, tables, summary='', command=None):
		"""Keep tables in the folder of results, as studies.keepAll does, and write its page.

		:param summary: sentence about all of them
		:param command: command of the tables, if not that of this run
		"""
		studies.keepAll(self.options.out, tables, command or f'`{self.command}`, {self.provenance}')
		studies.report(self.options.out, self.title, f'Written by `scripts/{self.name}`; `scripts/{self.name} --help` explains it. {summary}')
		self.summary = f'{summary} Written: {self.options.out}/README.md'.strip()
