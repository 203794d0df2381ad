# SPDX-License-Identifier: GPL-2.0-or-later
"""The largest values of a run, as a field."""
import numpy as np

from ..base.messages import brief, isNumber
from ..base.naming import didYouMean
from ..base.recorders import Recorder, solvers
from ..base.solver import noPoints, solverOf
from ..points.data import fields
from ..points.fields import components


class peaks(Recorder, name='peaks'):
	"""Largest values over time at all material points, as fields, in the memory of one array each: peak acceleration of ground that is shaken. Makes a PyRunner and puts it at the end of ``O.engines``. ::

		largest = mpm.peaks(record=['acceleration_x', 'strain_xy'])
		O.run(2000, wait=True)
		mpm.plot(largest['acceleration_x'])

	``p[name]`` is an array over the points in order of body id; of a vector its length, of a scalar its magnitude. ``p.time[name]`` is when that was [s]. Points that have been added later count from then on.
	``O.save`` keeps what is recorded, not the values: a loaded scene goes on with ``mpm.peaks.loaded(label)``, from the state that was saved.

	:param record: vectors and scalars, as ``acceleration``, ``velocity_x``, ``displacement``, ``strain_xy``, ``sqrt2J2``
	:param every: iterations from one look to the next, >= 1; every step by default
	:param label: name, by which a loaded scene finds it
	:param solver: the engine; may be left out when ``O.engines`` holds one
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a name that is not known or is a tensor, a label that is taken.
	"""

	def __init__(self, record=('acceleration', ), every=1, label='peaks', solver=None):
		if isinstance(record, str) or not all(isinstance(name, str) for name in record): raise TypeError(f"peaks: record = {brief(record)} must be a sequence of names, as in record=['acceleration']")
		if not isNumber(every) or every != int(every) or every < 1: raise ValueError(f'peaks: every = {brief(every)} is not admitted: expected an integer >= 1')
		if not isinstance(label, str): raise TypeError(f'peaks: label = {brief(label)} must be a string')
		if not label.isidentifier(): raise ValueError(f'peaks: label = {brief(label)} is not admitted: expected letters, digits and _')
		if self._isTaken('peaks_' + label): raise ValueError(f'peaks: label = {brief(label)} is taken by other peaks of the scene')
		self.solver, self.label, self.record = solverOf('peaks', solver), label, tuple(record)
		if not self._isOfTheScene(): raise ValueError('peaks: the solver is not in O.engines; put it there first')
		self._begin()
		self._start(f'look({label!r}, {self.record}, {solvers().index(self.solver)})', 'peaks_' + label, every)

	def _begin(self):
		self.ids, self._values, self.time = np.zeros(0, int), {name: np.zeros(0) for name in self.record}, {name: np.zeros(0) for name in self.record}
		self._kept[self.label] = self
		self._look()

	def _look(self):
		columns = fields(self.solver.mask)
		if not len(columns['id']): raise ValueError(noPoints('peaks', self.solver))
		if not np.array_equal(columns['id'], self.ids): self._renew(columns['id'])
		for name in self.record:
			now = np.nan_to_num(self._sizes(name, columns))
			isLarger = now > self._values[name]
			self._values[name][isLarger], self.time[name][isLarger] = now[isLarger], self.solver.loadTime

	def _renew(self, ids):
		"""Values of points that are new are not known yet, and those of points that are gone are not kept."""
		there = np.searchsorted(self.ids, ids)
		isKnown = (there < len(self.ids)) & (np.append(self.ids, -1)[there] == ids)
		for values in self._values, self.time:
			for name, column in values.items():
				values[name] = np.zeros(len(ids))
				values[name][isKnown] = column[there[isKnown]]
		self.ids = ids.copy()

	@staticmethod
	def _sizes(name, columns):
		"""Lengths of a vector, magnitudes of a scalar (points,)."""
		if name in columns and columns[name].ndim == 2: return np.linalg.norm(columns[name], axis=1)
		base = name.partition('_')[0]
		scalars = components(base, columns[base]) if base in columns else {}
		if name in scalars: return np.abs(scalars[name])
		if name in columns: raise ValueError(f'peaks: record has {brief(name)}, a tensor: one component must be chosen, as in {name}_xy')
		raise ValueError(f"peaks: record has {brief(name)}, which is not known{didYouMean(name, scalars or columns) or ';'} there are {', '.join(scalars or columns)}")

	def __getitem__(self, name):
		"""Array (points,) in order of body id."""
		if name not in self._values: raise ValueError(f"peaks: {brief(name)} is not recorded{didYouMean(name, self._values) or ';'} there are {', '.join(self._values)}")
		return self._values[name].copy()

	@staticmethod
	def loaded(label='peaks'):
		"""The peaks of a scene that was loaded, from there on."""
		if label not in peaks._kept: raise ValueError(f'peaks: label = {brief(label)}: nothing has been recorded by that name; there are {list(peaks._kept)}')
		return peaks._kept[label]


def look(label, record, number):
	"""For the PyRunner: the values of now. In a scene that was loaded they are the first. *number*: of the solver among those in O.engines."""
	kept = peaks._kept.get(label)
	if kept and kept._isOfTheScene(): return kept._look()
	again = peaks.__new__(peaks)
	again.solver, again.label, again.record = solvers()[number], label, tuple(record)
	again._begin()
