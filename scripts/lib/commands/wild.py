# SPDX-License-Identifier: GPL-2.0-or-later
"""Tries public laws of soils, UMATs and those of MFront, and files of records and terrain, from checkouts of their repositories.

	scripts/wild FOLDER                        all laws; five minutes on one core
	scripts/wild FOLDER --laws Mohr-Coulomb    some laws
	scripts/wild FOLDER --files                public files of records and terrain, by format

FOLDER has checkouts of the repositories in scripts/lib/wild/laws.py and files.py, named as these without their owners; nothing is downloaded, and none of their code is in this project. A law whose
sources are not there is named, and left out. gfortran compiles them, mfront of TFEL those of MFront; what they refuse is told. The triaxial test is compared with a law of the plugin or a closed form; the tangent with differences,
where the law flows; column and strip, 4 m deep, bear 100 kPa in 20 steps after a geostatic stress. All cases are in results/wild.csv, and are not run again.
"""
import os
import shutil

from wild import files
from wild.laws import laws

study = 'wild'
values = ['found', 'theirs', 'tangent', 'settlement', 'iterations', 'steps', 'seconds', 'why']


def main(study, arguments):
	study.option('folder', metavar='FOLDER', help='of the checkouts')
	study.option('--laws', nargs='*', metavar='LAW', default=[], help=f"some of {', '.join(laws)}")
	study.option('--files', action='store_true', help='no laws, but the files of scripts/lib/wild/files.py')
	options = study.parse(arguments, timeLimit=600)
	if options.files: return tryFiles(study)
	chosen = study.chosen(options.laws, laws, 'law')
	if not shutil.which('gfortran'): study.fail('gfortran is not installed. Install the package gfortran of Debian.')
	missing = {name: laws[name].missing(options.folder) for name in chosen}
	for name in chosen:
		if missing[name]: print(f'{name}: {laws[name].at(options.folder)} lacks {missing[name][0]}; check out {laws[name].repository} at {laws[name].commit}.')
	chosen = [name for name in chosen if not missing[name]]
	if not chosen: study.fail(f'{options.folder} has none of the laws. Give a folder with checkouts of their repositories.')
	table = study.table(['law', 'case'], values)
	cases, refused = [], {}
	for name in chosen:
		library = os.path.abspath(os.path.join(options.out, 'results', laws[name].repository.split('/')[1] + f'-{list(laws).index(name)}', 'law.so'))
		os.makedirs(os.path.dirname(library), exist_ok=True)
		isMade, printed = laws[name].compile(options.folder, library)
		if not isMade: refused[name] = printed
		else: cases += [((name, case), f'wild.scenes.{case}', dict(name=name, library=library)) for case in ('element', 'column', 'strip')]
	for name, printed in refused.items(): print(f'{name} does not compile:\n{printed}')
	chosen = [name for name in chosen if name not in refused]
	study.fill(table, cases, options.time_limit, values, areAlone=True)
	study.write(tables(chosen, refused, {key: table.row(key) for key, *_ in cases}), command=f'`scripts/wild FOLDER`, {study.provenance}')


def said(row):
	"""First sentence of an exception, without its class."""
	if row['why'] == 'timeout': return 'no end within the time limit'
	return row['why'].split(': ', 1)[-1].split('. ')[0].rstrip('.')


def tables(chosen, refused, rows):
	listed = [['law', 'repository', 'commit'], *([name, laws[name].repository, laws[name].commit[:10]] for name in [*chosen, *refused])]
	yield 'laws.csv', 'Laws', listed
	elements = [['law', 'found', 'compared with', 'difference', 'by', 'error of the tangent']]
	for name in chosen:
		row = rows[name, 'element']
		if row['why']: elements.append([name, said(row), '', '', '', ''])
		else: elements.append([name, *(f'{float(row[key]):.5g}' for key in ('found', 'theirs')), f"{100 * (float(row['found']) / float(row['theirs']) - 1):+.2g} %", laws[name].exact, f"{float(row['tangent']):.1e}"])
	elements += [[name, 'does not compile by gfortran', '', '', '', ''] for name in refused]
	yield 'element.csv', 'Triaxial test', elements, 'Largest q [Pa]; of Cam clay q/p at a shortening of 0.5, of that of MFront the last q. At 100 kPa, NorSand at 500 kPa.'
	ground = [['law', 'scene', 'settlement [mm]', 'steps', 'iterations a step', 'seconds a step']]
	for name in chosen:
		for case in 'column', 'strip':
			row = rows[name, case]
			if row['why']: ground.append([name, case, said(row), '', '', ''])
			else: ground.append([name, case, f"{1e3 * float(row['settlement']):.3g}", row['steps'], f"{float(row['iterations']):.3g}", f"{float(row['seconds']):.2g}"])
	yield 'ground.csv', 'Column and strip', ground, '20 steps of load; more where steps were cut.'


def tryFiles(study):
	"""Reads the public files that are there, and compares the largest acceleration or height with what the file itself tells."""
	folder = study.options.folder
	states = {entry[2]: files.state(folder, entry) for entry in files.files}
	for entry in files.files:
		if states[entry[2]]: print(f'{files.pathOf(folder, entry)}: {states[entry[2]]}; check out {entry[1][0]} at {entry[1][1]}.')
	listed = [entry for entry in files.files if states[entry[2]] != 'missing']
	if not listed: study.fail(f'{folder} has none of the files. Give a folder with checkouts of their repositories.')
	table = study.table(['file'], ['holds', 'told', 'found', 'why'])
	for name, printed in refused.items(): print(f'{name} does not compile:\n{printed}')
	chosen = [name for name in chosen if name not in refused]
	study.fill(table, [((entry[2], ), 'wild.files.read', dict(path=os.path.abspath(files.pathOf(folder, entry)), format=entry[0], settings=entry[4])) for entry in listed], study.options.time_limit, ['holds', 'told', 'found', 'why'])
	rows = [['format', 'file', 'SHA-256', 'holds', 'largest value by the file', 'as read']]
	for format, (repository, commit, within), file, total, _ in listed:
		row = table.row((file, ))
		value = lambda name: f'{float(row[name]):.6g}' if row[name] else '-'
		rows.append([format, f'[{os.path.basename(file)}](https://github.com/{repository}/blob/{commit}/{within}{file})', f'{total}...', row['why'] or row['holds'], value('told'), value('found')])
	study.write([('files.csv', 'Files of records and terrain', rows, 'Largest acceleration [cm/s2], or height [m]; - where a header tells none.')], command=f'`scripts/wild FOLDER --files`, {study.provenance}')
