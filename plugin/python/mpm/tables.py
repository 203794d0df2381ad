# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of the material points for other programs."""
import os

import numpy as np
from yade import wrapper

from .data import fields
from .fields import components
from .files import replacing
from .messages import pathOf
from .processes import byFirst


def export(fileName):
	"""Write the data of all material points to a file, whole or not at all.

	A ``.csv`` has one line for each point and a first line with the names of the columns, tensors by component (``stress_xy``); an
	``.npz``, to be read by ``numpy.load``, has the arrays of :func:`arrays`. Both have ``displacement`` [m], ``meanStress`` and ``sqrt2J2``
	[Pa] besides, the ``.npz`` also O.time as ``time`` and O.iter as ``iter``. Units are SI.

	:param fileName: path that ends in ``.csv`` or ``.npz``; folders that are missing are made
	:raises ValueError: another ending, or a body that is no complete material point.
	:raises OSError: the file cannot be written.
	"""
	fileName = pathOf('export', 'fileName', fileName)
	ending = os.path.splitext(fileName)[1]
	if ending not in ('.csv', '.npz'): raise ValueError(f'export: fileName = {fileName!r} must end in .csv or .npz, which chooses the format')
	_write(fileName, ending, fields())


@byFirst
def _write(fileName, ending, columns):
	with replacing(fileName) as temporary, open(temporary, 'wb') as file:
		if ending == '.npz':
			scene = wrapper.Omega()
			np.savez_compressed(file, time=scene.time, iter=scene.iter, **columns)
		else: _writeCsv(file, columns)


def _writeCsv(file, columns):
	scalars = {}
	for name, column in columns.items():
		scalars |= components(name, column)
	kinds = ['%d' if column.dtype == np.int64 else '%.17g' for column in scalars.values()]
	np.savetxt(file, np.rec.fromarrays(list(scalars.values())), fmt=','.join(kinds), header=','.join(scalars), comments='')
