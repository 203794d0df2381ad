# SPDX-License-Identifier: GPL-2.0-or-later
"""A film of a run, by matplotlib's writers."""
import os
import tempfile

from ..base.messages import brief, isNumber, pathOf
from ..base.processes import isFirst
from ..base.recorders import Film
from ..base.solver import solverOf
from .plotting import plot

_writers = {'.gif': 'pillow', '.mp4': 'ffmpeg', '.mkv': 'ffmpeg', '.webm': 'ffmpeg'}


class movie(Film, name='movies'):
	"""Film of a run: a picture as of :func:`plot` after every so many iterations, from now on. Makes a PyRunner and puts it at the end of ``O.engines``::

		film = mpm.movie('slope.gif', 'plasticStrain', every=2, range=(0, 0.2), limits=((0, 30), (0, 13)))
		O.run(40, wait=True)
		film.finish()

	The file is there, whole, after ``finish``. A saved scene has no film: make one after loading.

	:param fileName: path that ends in .gif (by Pillow), or .mp4, .mkv or .webm (by ffmpeg, if it is installed)
	:param field: as for :func:`plot`; give *range* too, or each picture has its own colours
	:param every: iterations from one picture to the next, >= 1
	:param fps: pictures a second, > 0
	:param limits: ((left, right), (bottom, top)) of the pictures [m]; by default those of the first one, a tenth larger
	:param size: (width, height) of the pictures in inches, of 100 points each
	:param solver: the engine; may be left out when ``O.engines`` holds one
	:param options: further arguments of :func:`plot`, but fileName and ax
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: an ending that is not known or whose writer is not installed, or what :func:`plot` refuses.
	:raises OSError: the file cannot be written.
	"""

	def __init__(self, fileName, field='displacement', every=1, fps=10, limits=None, size=(8, 5), solver=None, **options):
		from matplotlib import animation
		from matplotlib.figure import Figure
		fileName = pathOf('movie', 'fileName', fileName)
		if not isNumber(every) or every != int(every) or every < 1: raise ValueError(f'movie: every = {brief(every)} is not admitted: expected an integer >= 1')
		if not isNumber(fps) or not 0 < fps < 1000: raise ValueError(f'movie: fps = {brief(fps)} is not admitted: expected a number > 0, of pictures a second')
		name = _writers.get(os.path.splitext(fileName)[1].lower())
		if name is None: raise ValueError(f"movie: fileName = {fileName!r} must end in one of {', '.join(_writers)}")
		if not animation.writers.is_available(name): raise ValueError(f"movie: fileName = {fileName!r} needs {name}, which is not installed; .gif does without")
		self.solver, self.fileName, self.frames = solverOf('movie', solver), fileName, 0
		self._field, self._limits, self._options = field, limits, options
		self._figure = Figure(figsize=size, dpi=100)
		os.makedirs(os.path.dirname(os.path.abspath(fileName)), exist_ok=True)
		self._folder = tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(fileName)), prefix='.movie-')
		self._path = os.path.join(self._folder.name, os.path.basename(fileName))
		self._writer = animation.writers[name](fps=fps)
		self._writer.setup(self._figure, self._path, dpi=100)
		self._time = None
		try:
			self.add()
		except BaseException:
			self._folder.cleanup()
			raise
		self._startFilm(every)

	def add(self):
		"""A picture of the present state, unless the last one has it."""
		if self.solver.loadTime == self._time or not isFirst: return
		self._time = self.solver.loadTime
		self._figure.clear()
		ax = self._figure.add_subplot()
		plot(self._field, ax=ax, solver=self.solver, **self._options)
		if self._limits is None: self._limits = [[low - 0.05 * (high - low), high + 0.05 * (high - low)] for low, high in (ax.get_xlim(), ax.get_ylim())]
		ax.set(xlim=self._limits[0], ylim=self._limits[1])
		self._writer.grab_frame()
		self.frames += 1

	def finish(self):
		"""Write the file, with the present state as its last picture; nothing more is added."""
		self._finish()

	def _write(self):
		if isFirst:
			self._writer.finish()
			os.replace(self._path, self.fileName)
		self._folder.cleanup()


def add(label):
	"""For the PyRunner; of a scene that was loaded there is no film."""
	film = movie._kept.get(label)
	if film and film._isOfTheScene(): film.add()
