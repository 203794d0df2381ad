# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the pages of all validation, plugin/docs/studies/validation.md and how_right.md with their picture, from the kept tables of comparisons.

	scripts/validate                        the pages, in a second
	scripts/validate --run                  runs the examples first, three quarters of an hour on one core
	scripts/validate --run column tasks     some of them
"""
import os
import shlex
import shutil
import subprocess
import tempfile

import studies
import validation
from pages import replace
from worker import yadeCommand

study = 'validation'


def main(study, arguments):
	study.option('folder', nargs='*', metavar='FOLDER', help=f"of examples, with --run; all if none is named: {', '.join(validation.runs)}")
	study.option('--run', action='store_true', help='make the tables anew')
	study.option('--out', help='folder of the tables and the page (default: those that are kept)')
	options = study.parse(arguments, hasFolder=False)
	folders = study.chosen(options.folder, validation.runs, 'folder')
	if options.folder and not options.run: study.fail('folders are named with --run; the page is of all of them')
	kept = options.out or validation.examples
	for folder in folders if options.run else ():
		rows = []
		for command in validation.runs[folder]:
			rows += comparisons(study, folder, command)
			validation.write(folder, rows, kept)  # keeps the results of an interrupted run
		print(f'{folder}: {len(rows)} comparisons', flush=True)
	found = validation.everything(kept)
	target = options.out or os.path.join(studies.home, 'validation')
	studies.keepAll(target, validation.tables(found), '')
	validation.picture(found, os.path.join(target, 'validation.png'))
	if options.out: studies.report(target, study.title, '![Differences by group](validation.png)')
	else:
		replace(target + '.md', studies.page('validation'))
		right = os.path.join(studies.home, 'how_right')
		shutil.copy(os.path.join(target, 'validation.png'), os.path.join(right, 'how_right.png'))
		studies.publish('how_right', validation.summary(found), '')
	study.summary = f'Written: {target}'


def comparisons(study, folder, command):
	"""Rows of one run."""
	script, *arguments = shlex.split(command)
	named = validation.commandOf(folder, command)
	with tempfile.TemporaryDirectory() as out:
		if folder != 'tasks': arguments += ['--out', out]
		ended = subprocess.run([*yadeCommand(study.options.user), os.path.join(validation.examples, folder, script), *arguments], cwd=out, capture_output=True, text=True)
		if ended.returncode: study.fail(f'{named}:\n{ended.stdout}{ended.stderr}')
		rows = [validation.ofTask(script, ended.stdout)] if folder == 'tasks' else validation.kept('.', out)
	if not rows: study.fail(f'{named} has compared nothing')
	return [dict(row, command=named) for row in rows]
