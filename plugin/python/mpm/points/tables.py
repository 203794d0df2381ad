# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of the material points for other programs."""
import os

import numpy as np
from yade import wrapper

from ..base.messages import brief, pathOf
from ..base.naming import didYouMean
from ..base.processes import byFirst
from .data import fields as columnsOfPoints, table
from .fields import components
from .files import replacing

_symmetric = 'stress', 'totalStress', 'strain', 'elasticStrain'


def export(fileName, fields=None):
	"""Write the data of all material points to a file, whole or not at all.

	A ``.csv`` has one line for each point and a first line with the names of the columns and their units, tensors by component (``stress_xy [Pa]``), and only those components that the dimension of the engines has: in the
	plane none along z but ``_zz``, and one of two that are equal. An ``.npz``, to be read by ``numpy.load``, has the arrays of :func:`arrays`, and ``units``, pairs of name and unit. Both have ``displacement`` [m],
	``strain`` [-], ``meanStress`` and ``sqrt2J2`` [Pa] besides, the ``.npz`` also O.time as ``time`` and O.iter as ``iter``. Units are SI. :func:`frame` is the same for pandas.

	:param fileName: path that ends in ``.csv`` or ``.npz``; folders that are missing are made
	:param fields: names of the columns, as ``['pos', 'stress_yy']``; by default all
	:raises TypeError: *fileName* is no path, or *fields* no sequence of names.
	:raises ValueError: another ending, a name that is not known, or a body that is no complete material point.
	:raises OSError: the file cannot be written.
	"""
	fileName = pathOf('export', 'fileName', fileName)
	ending = os.path.splitext(fileName)[1]
	if ending not in ('.csv', '.npz'): raise ValueError(f'export: fileName = {fileName!r} must end in .csv or .npz, which chooses the format')
	columns = columnsOfPoints()
	_write(fileName, _scalars('export', columns, fields) if ending == '.csv' else _chosen('export', columns, fields))


def frame(fields=None):
	"""The data of all material points as a table of pandas, with the columns of a ``.csv`` of :func:`export`, and their units as ``attrs['units']``.

	:param fields: names of the columns, as ``['pos', 'stress_yy']``; by default all
	:return: ``pandas.DataFrame``
	:raises ImportError: pandas is not installed.
	:raises TypeError: *fields* is no sequence of names.
	:raises ValueError: a name that is not known, or a body that is no complete material point.
	"""
	try:
		import pandas
	except ImportError:
		raise ImportError('frame: pandas is not installed: apt install python3-pandas; mpm.arrays() and mpm.export() do without') from None
	columns = _scalars('frame', columnsOfPoints(), fields)
	made = pandas.DataFrame(columns)
	made.attrs['units'] = {name: unitOf(name) for name in columns}
	return made


def unitOf(name):
	"""Unit of a column of points or one of its components."""
	return table[name.partition('_')[0]]['unit']


def _dimension():
	"""Dimension of the engines of the scene; 3 where there are several or none."""
	found = {engine.grid.dim for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine)}
	return 2 if found == {2} else 3


def _scalars(who, columns, fields):
	"""Columns (N,) by name, of those components that the dimension has."""
	dim, found = _dimension(), {}
	for name, column in columns.items():
		found |= {scalar: values for scalar, values in components(name, column).items() if _isThere(scalar, column.ndim, dim)}
	if fields is None: return found
	return {scalar: found[scalar] for name in _names(who, fields) for scalar in _meant(who, name, columns, found)}


def _isThere(scalar, order, dim):
	base, _, axes = scalar.rpartition('_')
	if order == 1: return True
	if dim == 2 and 'z' in axes and axes != 'zz': return False
	return order == 2 or base not in _symmetric or axes == ''.join(sorted(axes))


def _meant(who, name, columns, found):
	if name in found: return [name]
	whole = [scalar for scalar in found if name in columns and scalar.rpartition('_')[0] == name]
	if whole: return whole
	raise ValueError(f"{who}: fields has {brief(name)}, which is not known{didYouMean(name, [*columns, *found]) or ';'} there are {', '.join(columns)}, with components as in stress_xy")


def _names(who, fields):
	if isinstance(fields, (list, tuple)) and fields and all(isinstance(name, str) for name in fields): return fields
	raise TypeError(f"{who}: fields = {brief(fields)} must be a sequence of names, as in ['pos', 'stress_yy']")


def _chosen(who, columns, fields):
	"""The arrays of those columns, whole."""
	if fields is None: return columns
	for name in _names(who, fields):
		if name not in columns: raise ValueError(f"{who}: fields has {brief(name)}, which is no array{didYouMean(name, columns) or ';'} there are {', '.join(columns)}")
	return {name: columns[name] for name in fields}


@byFirst
def _write(fileName, columns):
	with replacing(fileName) as temporary, open(temporary, 'wb') as file:
		if fileName.endswith('.npz'):
			scene = wrapper.Omega()
			np.savez_compressed(file, time=scene.time, iter=scene.iter, units=np.array([(name, unitOf(name)) for name in columns]), **columns)
			return
		kinds = ['%d' if column.dtype == np.int64 else '%.17g' for column in columns.values()]
		heads = [name if unitOf(name) in ('', '-') and column.dtype == np.int64 else f'{name} [{unitOf(name)}]' for name, column in columns.items()]
		np.savetxt(file, np.rec.fromarrays(list(columns.values())), fmt=','.join(kinds), header=','.join(heads), comments='', encoding='utf-8')
