# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of a batch in one table and one picture."""
import csv
import glob
import json
import math
import os
import re
import sys
import zlib

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber, pathOf
from ..base.naming import didYouMean
from ..base.processes import byFirst
from ..points.files import replacing
from .plotting import write

_ending = '.note.json'
_longest = 150  # characters of a description in the name of a file


def note(folder, **results):
	"""Write down the results of this run for :func:`collect`: a file of its own in a folder that all runs of a batch share, with the parameters that ``utils.readParamsFromTable`` has read::

		utils.readParamsFromTable(M=1e7, noTableOk=True)
		...
		mpm.note('out/settlements', **{'settlement [mm]': 1e3 * solver.plotData()['settlement']})

	A run with the same description in the table replaces the file.

	:param folder: path; folders that are missing are made
	:param results: numbers or texts by name; a unit in brackets behind the name stands in the table and at the axes
	:raises TypeError: *folder* is no path, or a result neither a number nor a text.
	:raises ValueError: no results, or a result named as a parameter.
	:raises OSError: the file cannot be written.
	"""
	folder = pathOf('note', 'folder', folder)
	if not results: raise ValueError("note: there are no results; give them by name, as in mpm.note('out/batch', settlement=0.012)")
	for name, value in results.items():
		if not isinstance(value, str) and not isNumber(value) and not isinstance(value, (bool, np.bool_)): raise TypeError(f'note: {name} = {brief(value)} must be a number or a text')
	description, parameters = _ofBatch()
	both = sorted(set(parameters) & set(results))
	if both: raise ValueError(f'note: {both[0]} is a parameter of the batch; give the result another name')
	plain = {name: value if isinstance(value, str) else bool(value) if isinstance(value, (bool, np.bool_)) else float(value) for name, value in results.items()}
	_write(os.path.join(folder, _fileNameOf(description)), dict(description=description, parameters=parameters, results=plain))


def _fileNameOf(description):
	"""Name of the file of a run: its description, and a checksum of it where other descriptions would have the same name."""
	plain = re.sub(r'[^\w.,=+-]+', '_', description)
	mark = '' if plain == description and len(plain) <= _longest else f'-{zlib.crc32(description.encode()):08x}'
	return plain[:_longest] + mark + _ending


@byFirst
def _write(path, content):
	with replacing(path) as temporary, open(temporary, 'w', encoding='utf-8') as file:
		json.dump(content, file, indent=1)


def _ofBatch():
	"""Description and parameters of this run, as utils.readParamsFromTable has read them."""
	table, tags = sys.modules.get('yade.params.table'), wrapper.Omega().tags
	values = {name: value for name, value in vars(table).items() if not name.startswith('__') and value is not None} if table else {}
	description = tags['description'] if tags.has_key('description') else ''
	return description.rstrip('_') or 'run', {name: _plain(value) for name, value in values.items()}


def _plain(value):
	return float(value) if isNumber(value) else str(value)


def _evaluated(text):
	"""A value of a parameter table, as YADE reads it."""
	try:
		return _plain(eval(str(text), dict(vars(math))))
	except Exception:
		return str(text)


def collect(folder, x=None, y=None, table=None, fileName=None):
	"""Gather the runs of a batch, of which each has called :func:`note`, into one table, ``collected.csv`` in the folder, and one picture, ``collected.png``, of the results over a parameter.

	:param folder: path of the folder with the notes
	:param x: parameter on the horizontal axis; by default the first one that is a number and not the same in all runs. Runs that differ in other parameters become curves of their own.
	:param y: result on the vertical axis, or a sequence of results, each in a part of its own; by default all that are numbers
	:param table: path of the parameter table that ``yade-batch`` was given: its lines without a note are warned of, and stand in the table without results
	:param fileName: path of the picture; by default ``collected.png`` in the folder
	:return: dict of arrays (R,) by the names of the parameters and results, with ``description`` first; NaN or '' where a run has none. ``pandas.DataFrame`` takes it.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a folder without notes, or a name that is not known.
	:raises OSError: a file cannot be read or written.
	"""
	folder = pathOf('collect', 'folder', folder)
	runs = []
	for path in sorted(glob.glob(os.path.join(glob.escape(folder), '*' + _ending))):
		with open(path, encoding='utf-8') as file:
			try:
				runs.append(json.load(file))
			except ValueError as error:
				raise ValueError(f'collect: {path!r} is no note: {error}') from None
	if not runs: raise ValueError(f'collect: folder = {folder!r} has no notes; each run of the batch writes its own, by mpm.note({folder!r}, ...)')
	if table is not None: runs += _missing(pathOf('collect', 'table', table), runs)
	parameters, results = (list(dict.fromkeys(name for run in runs for name in run[kind])) for kind in ('parameters', 'results'))
	found = {'description': np.array([run['description'] for run in runs])}
	found |= {name: _column([run['parameters'].get(name) for run in runs]) for name in parameters} | {name: _column([run['results'].get(name) for run in runs]) for name in results}
	order = _order([found[name] for name in parameters], len(runs))
	found = {name: column[order] for name, column in found.items()}
	_writeTable(os.path.join(folder, 'collected.csv'), found)
	_draw(found, parameters, results, x, y, os.path.join(folder, 'collected.png') if fileName is None else pathOf('collect', 'fileName', fileName))
	return found


def _missing(path, runs):
	"""Runs that the table of parameters has and that have left no note, with a warning."""
	from yade.utils import TableParamReader
	from ..library import engine
	if not os.path.exists(path): raise FileNotFoundError(2, 'collect: there is no such table', path)
	known = {run['description'] for run in runs}
	lines = TableParamReader(path).paramDict().values()
	missing = [line for line in lines if str(line['description']).rstrip('_') not in known]
	if missing: engine.warn(f"collect: {len(missing)} of {len(lines)} runs of {path!r} have left no note: {', '.join(str(line['description']) for line in missing[:10])}; their logs say why")
	described = lambda line: {name: _evaluated(value) for name, value in line.items() if name != 'description' and not name.startswith('!')}
	return [dict(description=str(line['description']), parameters=described(line), results={}) for line in missing]


def _column(values):
	if all(value is None or isinstance(value, (int, float)) for value in values): return np.array([np.nan if value is None else float(value) for value in values])
	return np.array(['' if value is None else f'{value:g}' if isinstance(value, float) else str(value) for value in values])


def _order(columns, number):
	return np.lexsort(columns[::-1]) if columns else np.arange(number)


@byFirst
def _writeTable(path, found):
	with replacing(path) as temporary, open(temporary, 'w', encoding='utf-8', newline='') as file:
		writer = csv.writer(file)
		writer.writerow(found)
		writer.writerows(zip(*([f'{value:.17g}' if column.dtype.kind == 'f' else value for value in column] for column in found.values())))


def _named(kind, name, known):
	if name not in known: raise ValueError(f"collect: {kind} = {brief(name)} is not known{didYouMean(str(name), known) or ';'} there are {', '.join(known) or 'none'}")
	return name


def _draw(found, parameters, results, x, y, path):
	from matplotlib.figure import Figure
	isNumeric = lambda name: found[name].dtype.kind == 'f'
	varied = [name for name in parameters if len(set(found[name].tolist())) > 1]
	if x is not None: _named('x', x, parameters)
	else: x = next((name for name in varied if isNumeric(name)), None)
	wanted = [name for name in results if isNumeric(name)] if y is None else [_named('y', name, results) for name in ([y] if isinstance(y, str) else y)]
	if not wanted: raise ValueError('collect: no result is a number; the table is written, and there is nothing to draw')
	others = [name for name in varied if name != x]
	figure = Figure(figsize=(6, 0.6 + 2.6 * len(wanted)), layout='constrained')
	for ax, name in zip(figure.subplots(len(wanted), 1, squeeze=False, sharex=True)[:, 0], wanted):
		for curve in dict.fromkeys(zip(*(found[other].tolist() for other in others))) if others else [()]:
			rows = np.all([found[other] == value for other, value in zip(others, curve)], axis=0) if others else np.ones(len(found['description']), bool)
			label = ', '.join(f'{other} = {value:g}' if isinstance(value, float) else f'{other} = {value}' for other, value in zip(others, curve))
			ax.plot(found[x][rows] if x else found['description'][rows], found[name][rows], 'o-' if x else 'o', label=label or None)
		ax.set(ylabel=name, xlabel=(x or 'run') if name == wanted[-1] else '')
		if x and isNumeric(x) and (found[x] > 0).all() and found[x].max() > 20 * found[x].min(): ax.set_xscale('log')
	if others: figure.axes[0].legend(frameon=False, fontsize='small')
	write('collect', figure, path)
