# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points that several processes have divided among them (MpmImplicitEngine.distributed): what is asked of all of them is put together."""
import numpy as np

from .library import engine
from .processes import count, gathered

_ofEachScene = 'materials', 'materialNumber'


def isDivided():
	"""Whether this process has only its own points of the scene."""
	return count > 1 and engine.isDivided()


def refuse(who):
	"""ValueError for what needs all points, or their bodies, in one process."""
	if isDivided(): raise ValueError(f'{who}: not with MpmImplicitEngine.distributed = True once a step has been made, by which no process has all points; before the first step each has all')


def columnsOfPoints(mask, withDerived):
	"""As that of the library, of the points of all processes in order of body id; all of them call it."""
	own = engine.columnsOfPoints(mask, withDerived, ())
	if not isDivided(): return own
	names = sorted(set().union(*gathered(list(own))))
	if len(names) > len(own): own = engine.columnsOfPoints(mask, withDerived, tuple(names))
	columns = {name: b''.join(gathered(bytes(own[name]))) for name in names if name not in _ofEachScene}
	ids = np.frombuffer(columns['id'], np.int64)
	order = np.argsort(ids, kind='stable')
	return {name: np.frombuffer(values).reshape(len(ids), -1)[order].tobytes() for name, values in columns.items()} if len(ids) else columns
