# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points that several processes have divided among them (MpmImplicitEngine.distributed): what is asked of all of them is put together."""
import numpy as np

from ..library import engine
from .processes import gathered, isDivided, together

_ofEachScene = 'materials', 'materialNumber'


def idsOfPoints():
	"""Ids of the points of all processes (N,), rising; all of them call it."""
	if not isDivided(): return np.frombuffer(engine.idsOfPoints(), np.int64)
	own = together(engine.idsOfPoints)
	return np.unique(np.frombuffer(b''.join(gathered(bytes(own))), np.int64))


def columnsOfPoints(mask, withDerived):
	"""Columns as those of the library, for the points of all processes in order of body id; all of them call it. Points that all have, as they have been appended since the last step, are there once."""
	if not isDivided(): return engine.columnsOfPoints(mask, withDerived, ())
	own = together(lambda: engine.columnsOfPoints(mask, withDerived, ()))
	names = sorted(set().union(*gathered(list(own))))
	if len(names) > len(own): own = engine.columnsOfPoints(mask, withDerived, tuple(names))
	columns = {name: b''.join(gathered(bytes(own[name]))) for name in names if name not in _ofEachScene}
	ids, order = np.unique(np.frombuffer(columns['id'], np.int64), return_index=True)
	rows = len(columns['id']) // ids.itemsize
	return {name: np.frombuffer(values).reshape(rows, -1)[order].tobytes() for name, values in columns.items()} if len(ids) else columns
