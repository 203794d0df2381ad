# SPDX-License-Identifier: GPL-2.0-or-later
"""States of ParaView, which open what MpmVtkRecorder has written."""
import html
import os
import re

import numpy as np
from yade import wrapper

from ..base.messages import brief, pathOf
from ..base.processes import byFirst
from ..base.solver import solverOf
from ..points.data import fields as columnsOfPoints, table
from ..points.fields import labelled, scalar
from ..points.files import replacing
from .colouring import coloursOf, hasSign, limits

_script = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'page', 'page.paraview.py')
_kinds = 'grid', 'ghostFaces', 'loads', 'walls', 'contacts'


def state(fileName, field='displacement', range=None, recorder=None):
	"""Write a state that ParaView opens (File, Load State; or ``paraview --state=...``): the points of an :class:`MpmVtkRecorder` coloured by a field, in its unit, with the colours of :func:`plot` and the time, over all states
	that there are; behind the points, hidden at first, what else has been recorded: grid, ghost faces, loads, walls, contacts.

	:param fileName: path that ends in .py; folders that are missing are made. The state finds the files from its own folder, and may be moved with them.
	:param field: name as for :func:`plot`
	:param range: (low, high) of the colours, in SI units; by default those of the present state, symmetric to zero for values of both signs
	:param recorder: the MpmVtkRecorder; may be left out when ``O.engines`` holds one
	:raises TypeError: *fileName* is no path, *recorder* none, or *range* no pair of numbers.
	:raises ValueError: another ending, a field that does not exist or is not recorded, or no recorder or several of which none is named.
	:raises OSError: nothing has been recorded yet, or the file cannot be written.
	"""
	fileName = pathOf('state', 'fileName', fileName)
	if not fileName.endswith('.py'): raise ValueError(f'state: fileName = {fileName!r} must end in .py, as states do that ParaView reads as scripts')
	recorder = _recorderOf(recorder)
	points = columnsOfPoints()
	if not len(points['id']): raise ValueError('state: the scene has no material points')
	values = scalar('state', field, points)
	bounds = limits('state', range, values)
	if range is None and values.min() < 0 < values.max() and hasSign(field, values): bounds = -np.abs(values).max(), np.abs(values).max()
	size, label = labelled(field, np.array(bounds))
	shades = np.linspace(0, 1, 33)
	colours = coloursOf('state', field, None, values, bounds)(shades)[:, :3]
	nodes = np.column_stack([(bounds[0] + shades * (bounds[1] - bounds[0])) / size, colours])
	folder = os.path.dirname(os.path.abspath(fileName))
	files = {kind: os.path.relpath(f'{recorder.fileName}{kind}.pvd', folder) for kind in ('points', *_kinds)}
	series = os.path.abspath(f'{recorder.fileName}points.pvd')
	if not os.path.exists(series): raise FileNotFoundError(2, 'state: nothing has been recorded yet, so there is no such file', series)
	_requireRecorded(series, field)
	solver = solverOf('state', next((engine for engine in wrapper.Omega().engines if recorder.solver and engine.label == recorder.solver), None))
	facts = dict(
	        folder=folder,
	        files={kind: file for kind, file in files.items() if os.path.exists(f'{recorder.fileName}{kind}.pvd')},
	        formula=formula(field, size),
	        title=label.replace('$', '').replace('\\', '').replace('{', '').replace('}', ''),
	        colours=[round(float(x), 6) for x in nodes.ravel()],
	        moment='time: {time:g} s' if isinstance(solver, wrapper.MpmDynamicEngine) else 'load time {time:g}',
	        up=int(np.argmax(np.abs(np.array(solver.gravity)))),
	        isFlat=solver.grid.dim == 2
	)
	_write(fileName, facts)


@byFirst
def _write(fileName, facts):
	with open(_script, encoding='utf-8') as file:
		text = file.read()
	lines = '\n'.join(f'{name} = {value!r}' for name, value in facts.items())
	with replacing(fileName) as temporary, open(temporary, 'w', encoding='utf-8') as file:
		file.write(text.replace('# FACTS', lines, 1))


def formula(field, size):
	"""Expression of ParaView's calculator for a field's name, in a unit of that size: ('stress_xy', 1e3) -> '"stress_1" / 1000'."""
	base, _, component = field.partition('_')
	if field == 'displacement': name = 'mag(displacement)'
	elif not component: name = base
	elif table[base]['width'] == 3: name = f'"{base}_{component.upper()}"'
	else: name = f'"{base}_{3 * "xyz".index(component[0]) + "xyz".index(component[1])}"'
	return name if size == 1 else f'{name} / {size:.10g}'


def _recorderOf(given):
	if given is None:
		found = [engine for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmVtkRecorder)]
		if len(found) == 1: return found[0]
		raise ValueError(f'state: O.engines holds {len(found) or "no"} MpmVtkRecorder' + (', so recorder must say which one is meant' if found else "; put one there before the run, as MpmVtkRecorder(fileName='out/slope-')"))
	if not isinstance(given, wrapper.MpmVtkRecorder): raise TypeError(f'state: recorder = {brief(given)} must be an MpmVtkRecorder')
	return given


def _requireRecorded(series, field):
	"""ValueError if the last file of the points does not have the field."""
	with open(series, encoding='utf-8') as file:
		last = html.unescape(re.findall(r'file="([^"]+)"', file.read())[-1])
	with open(os.path.join(os.path.dirname(series), last), 'rb') as file:
		head = file.read(2**16).decode('latin-1')
	names = re.findall(r'<DataArray[^>]* Name="([^"]+)"', head)
	base = field.partition('_')[0]
	if base not in names: raise ValueError(f"state: field = {brief(field)} is not in {last!r}, which has {', '.join(name for name in names if name.isidentifier())}; fields of the MpmVtkRecorder chooses what is recorded")
