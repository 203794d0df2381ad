# SPDX-License-Identifier: GPL-2.0-or-later
"""Histories of chosen points over time, and histories from files."""
import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3

from ..base.messages import brief, isNumber, pathOf, place
from ..base.naming import didYouMean
from ..base.processes import byFirst
from ..base.recorders import Recorder, solvers
from ..base.solver import noPoints, solverOf
from ..points.data import fields
from ..points.fields import components, labelled
from ..points.files import replacing
from .spectra import frequenciesOf, transform, warnOfMotionLeft


class histories(Recorder, name='histories'):
	"""Histories of chosen material points: values of every step, kept as arrays. Makes a PyRunner and puts it at the end of ``O.engines``; with any of the engines, with or without inertia.

	``h['velocity']`` is an array over the steps, the points and the components; ``h.time`` are the times [s] of the converged states, the first one that
	of the call. Points move: positions only choose them. ``O.save`` keeps what is recorded, and of what, not the values: save them to a file. A loaded scene goes on with
	``mpm.histories.loaded(label)``, from the state that was saved.

	:param at: list or array of ids of bodies, or positions [m] (N, 3), each of which stands for the nearest material point of the engine, at most the size of a cell away
	:param record: columns of :func:`arrays`, or ``displacement``, ``strain``, ``meanStress``, ``sqrt2J2``, ``totalStress``
	:param every: iterations from one value to the next, >= 1, beginning with the first
	:param label: name, by which a loaded scene finds it
	:param solver: the engine; may be left out when ``O.engines`` holds one
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: no such body or column, a body that is no material point of that engine, a label that is taken.
	"""

	def __init__(self, at, record=('displacement', 'velocity', 'acceleration', 'stress'), every=1, label='histories', solver=None):
		_requireArguments(record, every, label)
		self.solver, self.label, self.record = solverOf('histories', solver), label, tuple(record)
		if self._isTaken(_runner(label)):
			raise ValueError(f'histories: label = {brief(label)} is taken by other histories of the scene')
		if not self._isOfTheScene(): raise ValueError('histories: the solver is not in O.engines; put it there first')
		columns = fields(self.solver.mask)
		if not len(columns['id']): raise ValueError(noPoints('histories', self.solver))
		for name in self.record:
			if name not in columns: raise ValueError(f"histories: record has {brief(name)}, which is not known{didYouMean(name, columns) or ';'} there are {', '.join(columns)}")
		self.ids = _chosen(at, columns, self.solver.grid)
		self._begin(columns)
		self._start(f'add({label!r}, {self.ids.tolist()}, {self.record}, number={solvers().index(self.solver)})', _runner(label), every)

	def _begin(self, columns):
		self.time, self._values = [], {name: [] for name in self.record}
		self.places = columns['pos'][np.minimum(np.searchsorted(columns['id'], self.ids), len(columns['id']) - 1)]
		self._kept[self.label] = self
		self._add(columns)

	def _add(self, columns):
		time = self.solver.loadTime
		if self.time and time == self.time[-1]: return  # no step was made
		rows = np.searchsorted(columns['id'], self.ids)
		if not np.array_equal(columns['id'][np.minimum(rows, len(columns['id']) - 1)], self.ids):
			raise ValueError(f'histories: label = {brief(self.label)}: one of the bodies {brief(self.ids.tolist())} is no longer there')
		self.time.append(time)
		for name, values in self._values.items():
			values.append(columns[name][rows])

	@staticmethod
	def loaded(label='histories'):
		"""The histories of a scene that was loaded, from there on."""
		if label not in histories._kept: raise ValueError(f'histories: label = {brief(label)}: nothing has been recorded by that name; there are {list(histories._kept)}')
		return histories._kept[label]

	def __getitem__(self, name):
		"""Array (times, points, ...) of a column; of a scalar name such as ``stress_xy`` (times, points)."""
		if name in self._values: return np.array(self._values[name])
		base = str(name).partition('_')[0]
		found = _scalars(base, np.array(self._values[base])) if base in self._values else {}
		if name not in found: raise ValueError(f"histories: {brief(name)} is not recorded{didYouMean(name, found or self._values) or ';'} there are {', '.join(found or self._values)}")
		return found[name]

	@byFirst
	def save(self, fileName):
		"""Write a table, whole or not at all: time [s], then each scalar of each point, as in ``velocity_x_17`` for body 17; SI units.

		:raises OSError: the file cannot be written.
		"""
		columns = {'time': np.array(self.time)}
		for name in self.record:
			for scalar, values in _scalars(name, self[name]).items():
				columns |= {f'{scalar}_{body}': values[:, i] for i, body in enumerate(self.ids)}
		with replacing(pathOf('histories.save', 'fileName', fileName)) as temporary:
			np.savetxt(temporary, np.column_stack(list(columns.values())), fmt='%.17g', delimiter=',', header=','.join(columns), comments='')

	def spectrum(self, field='velocity_x', frequencies=None):
		"""Fourier's integral of a scalar over time, by the trapezoidal rule; steps may differ.

		:param field: scalar that is recorded, as ``velocity_x``
		:param frequencies: [Hz] > 0, an array; None: all that the times tell of
		:return: frequencies (M,) [Hz], and complex values (M, points) in the unit of the field times s
		:raises ValueError: no such scalar, or frequencies beyond what the steps resolve.
		"""
		values, time = self._scalar('spectrum', field), np.array(self.time)
		frequencies = frequenciesOf('histories.spectrum', frequencies, time)
		warnOfMotionLeft('histories.spectrum', time, values)
		return frequencies, transform(time, values, frequencies)

	def amplification(self, point, base, field='velocity_x', frequencies=None, floor=1e-3):
		"""Ratio of the motion of one point to that of another, over frequency.

		:param point: place in ``h.ids`` of the point, as in ``h['velocity'][:, 0]``
		:param base: place in ``h.ids`` of the point that it is compared with
		:param field: scalar that is recorded
		:param frequencies: [Hz] > 0, an array; None: all that the times tell of
		:param floor: where the base has less than this part of its largest value there is nothing to compare with: nan [-]
		:return: frequencies (M,) [Hz], and ratios (M,) [-], complex: their abs() is the amplification
		:raises ValueError: as spectrum(); a point that there is not; a base that does not move.
		"""
		for name, place in ('point', point), ('base', base):
			if not isinstance(place, (int, np.integer)) or isinstance(place, bool) or not 0 <= place < len(self.ids): raise ValueError(f'histories.amplification: {name} = {brief(place)} must be an index in h.ids, 0 to {len(self.ids) - 1}')
		frequencies, found = self.spectrum(field, frequencies)
		below = found[:, base]
		largest = np.abs(below).max()
		if largest == 0: raise ValueError(f'histories.amplification: {field} of the base, body {self.ids[base]}, is 0 at all times')
		return frequencies, found[:, point] / np.where(np.abs(below) >= floor * largest, below, np.nan)

	def permanent(self, last=1.):
		"""Displacements (points, 3) [m] that are left: the mean over the last seconds. ``displacement`` must be recorded.

		:param last: over how much time the mean is taken [s] > 0
		:raises ValueError: *last* is not admitted, or longer than what is recorded.
		"""
		time = np.array(self.time)
		if not isNumber(last) or not 0 < last <= time[-1] - time[0]: raise ValueError(f'histories.permanent: last = {brief(last)} is not admitted: expected more than 0 and at most the {time[-1] - time[0]:g} s that are recorded')
		chosen = time >= time[-1] - last * (1 + 1e-9)
		lengths, values = np.diff(time[chosen]), np.array(self['displacement'])[chosen]
		return np.tensordot(lengths, (values[1:] + values[:-1]) / 2, 1) / lengths.sum()

	def largest(self, name='acceleration'):
		"""Largest length over time of a vector, or magnitude of a scalar, of each point (points,). Histories of all points make a field of it::

			h = mpm.histories(mpm.arrays()['id'], record=['acceleration'])     # 24 bytes a point and step
			O.run(1000, wait=True)
			mpm.plot(h.largest('acceleration'))

		:param name: column or scalar that is recorded, no tensor
		:raises ValueError: it is not recorded, or a tensor.
		"""
		values = self[name]
		if values.ndim > 3: raise ValueError(f'histories.largest: name = {brief(name)}: one component must be chosen, as in {name}_xy')
		return (np.linalg.norm(values, axis=2) if values.ndim == 3 else np.abs(values)).max(axis=0)

	def overHeight(self, name='acceleration', axis=1):
		"""Amplification over a height: largest length or magnitude over time at each point, over that of the lowest point.

		:param name: vector or scalar that is recorded, no tensor
		:param axis: 0, 1 or 2: along which heights are taken
		:return: heights (points,) [m], of the points at the beginning, increasing, and the ratios (points,) [-]
		:raises ValueError: as largest(); the lowest point does not move.
		"""
		if axis not in (0, 1, 2): raise ValueError(f'histories.overHeight: axis = {brief(axis)} is not admitted: expected 0, 1 or 2')
		largest, order = self.largest(name), np.argsort(self.places[:, axis], kind='stable')
		if largest[order[0]] == 0: raise ValueError(f'histories.overHeight: {name} of the lowest point, body {self.ids[order[0]]}, is 0 at all times')
		return self.places[order, axis], largest[order] / largest[order[0]]

	def _scalar(self, who, field):
		values = self[field]
		if values.ndim != 2: raise ValueError(f"histories.{who}: field = {brief(field)}: one component must be chosen, as in {field}_x or {field}_xy")
		return values

	def plot(self, field='velocity_x', fileName=None, ax=None, live=False):
		"""Draw one scalar of all points over time; to a file, whole or not at all, if one is named. With *live* the window follows the run, twice a second. Returns the axes."""
		from .plotting import write
		values = self[field]
		if values.ndim != 2: raise ValueError(f"histories: field = {brief(field)}: one component must be chosen, as in {field}_x or {field}_xy")
		if ax is None:
			import matplotlib.pyplot as pyplot
			from matplotlib.figure import Figure
			ax = (pyplot.figure if fileName is None else Figure)(figsize=(8, 4)).add_subplot()
		size, text = labelled(field, values)
		for i, body in enumerate(self.ids):
			ax.plot(self.time, values[:, i] / size, label=f'body {body}')
		ax.set(xlabel='time [s]', ylabel=text)
		ax.legend()
		if fileName is not None: write('histories.plot', ax.figure, fileName)
		if live: self._follow(field, ax, size)
		return ax

	def _follow(self, field, ax, size):
		"""Draws by a timer of the window: a thread in the background must not draw."""

		def update():
			values = self[field]
			for line, column in zip(lines, values.T):
				line.set_data(self.time[:len(column)], column / size)
			ax.relim()
			ax.autoscale_view()
			ax.figure.canvas.draw_idle()

		lines = ax.lines[-len(self.ids):]
		ax.figure.follow = ax.figure.canvas.new_timer(interval=500)  # kept by the figure
		ax.figure.follow.add_callback(update)
		ax.figure.follow.start()


def add(label, ids, record, place=None, number=None):
	"""For the PyRunner: the values of now. In a scene that was loaded they are the first. *number*: of the solver among those in O.engines, before which stages put engines; *place*: in O.engines, of scenes saved earlier."""
	kept = histories._kept.get(label)
	if kept and kept._isOfTheScene(): kept._add(fields(kept.solver.mask))
	else:
		again = histories.__new__(histories)
		solver = wrapper.Omega().engines[place] if number is None else solvers()[number]
		again.solver, again.label, again.record, again.ids = solverOf('histories', solver), label, tuple(record), np.array(ids)
		again._begin(fields(again.solver.mask))


def _runner(label):
	return 'histories_' + label


def _scalars(name, values):
	"""Those of a column, by name: (times, points)."""
	shape = values.shape
	flat = components(name, values.reshape((shape[0] * shape[1], ) + shape[2:]))
	return {scalar: column.reshape(shape[:2]) for scalar, column in flat.items()}


def _requireArguments(record, every, label):
	if isinstance(record, str) or not all(isinstance(name, str) for name in record):
		raise TypeError(f'histories: record = {brief(record)} must be a sequence of names of columns, as in record=["velocity"]')
	if not isNumber(every) or every != int(every) or every < 1: raise ValueError(f'histories: every = {brief(every)} is not admitted: expected an integer >= 1')
	if not isinstance(label, str): raise TypeError(f'histories: label = {brief(label)} must be a string')
	if not label.isidentifier(): raise ValueError(f'histories: label = {brief(label)} is not admitted: expected letters, digits and _')


def _chosen(at, columns, grid):
	"""Ids of the points that are meant."""
	try:
		values = np.asarray(at, dtype=float)
	except (TypeError, ValueError):
		raise TypeError(f'histories: at = {brief(at)} must be ids of bodies, or positions with three numbers each') from None
	if not values.size or values.ndim > 2 or (values.ndim == 2 and values.shape[1] != 3) or not np.isfinite(values).all():
		raise ValueError(f'histories: at = {brief(at)} is not admitted: expected ids of bodies, or positions with three finite numbers each')
	isOne = isinstance(at, (tuple, Vector3)) or np.asarray(at).dtype.kind == 'f'
	if isOne and values.shape == (3, ):
		raise ValueError(f'histories: at = {brief(at)} may be a position or three ids: a position needs brackets, as in at=[{brief(at)}], and ids are a list of integers')
	if values.ndim == 2: return columns['id'][[_nearest(x, columns['pos'], grid) for x in values]]
	ids = np.atleast_1d(values).astype(int)
	missing = [x for x, i in zip(np.atleast_1d(values), ids) if x != i or i not in columns['id']]
	if missing: raise ValueError(f'histories: at has {missing[0]:g}, which is no id of a material point; a position needs brackets, as in at=[(0, 1, 0)]')
	return ids


def _nearest(x, positions, grid):
	"""Row of the material point nearest to a position; ValueError if there is none within a cell. In the plane z has no say."""
	distances = np.linalg.norm((positions - x)[:, :grid.dim], axis=1)
	row = int(distances.argmin())
	if distances[row] > grid.cellSize * grid.dim**0.5:
		raise ValueError(f'histories: at has {place(x)}, and the nearest material point, at {place(positions[row])}, is {distances[row]:.3g} m away, more than a cell (cellSize = {grid.cellSize:g} m): give a position in the soil')
	return row


def readHistory(fileName):
	"""A history from a text file: two columns, time [s] and value, separated by blanks, commas or semicolons; lines without numbers before them, as a heading, are left out.

	:param fileName: path of the file
	:return: list of (time, value), as MpmBaseMotion.history and the load curves take it
	:raises OSError: the file cannot be read.
	:raises ValueError: a line that is no pair of finite numbers, times that do not increase, or no numbers at all; the line is named.
	"""
	fileName, found = pathOf('readHistory', 'fileName', fileName), []
	with open(fileName, encoding='utf-8') as file:
		for number, line in enumerate(file, 1):
			words = line.partition('#')[0].replace(',', ' ').replace(';', ' ').split()
			if not words: continue
			try:
				time, value = map(float, words)
				isPair = bool(np.isfinite([time, value]).all())
			except ValueError:
				if not found: continue
				isPair = False
			if not isPair: raise ValueError(f'readHistory: {fileName!r}, line {number}: {brief(line.strip())} is no pair of finite numbers, time and value')
			if found and time <= found[-1][0]: raise ValueError(f'readHistory: {fileName!r}, line {number}: time {time:g} is not after the one before, {found[-1][0]:g}')
			found.append((time, value))
	if not found: raise ValueError(f'readHistory: {fileName!r} has no line with two numbers, time and value')
	return found
