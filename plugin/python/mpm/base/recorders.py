# SPDX-License-Identifier: GPL-2.0-or-later
"""PyRunners that yade.mpm puts into ``O.engines``, and the base of all that records a run by one."""
import sys

from yade import wrapper

_package = __name__.removesuffix('.base.recorders')


def nameInScenes(name, module):
	"""Name of a module in commands of PyRunners. Saved scenes keep it, so it does not change with the folder of the module."""
	sys.modules[f'{_package}.{name}'] = sys.modules[module]


def runnerOf(name, call, label, every=1):
	"""PyRunner that calls a function of the module with this name in scenes."""
	return wrapper.PyRunner(command=f"__import__('sys').modules['{_package}.{name}'].{call}", iterPeriod=int(every), initRun=True, label=label)


def solvers():
	return [engine for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine)]


class Recorder:
	"""Record of a run by a PyRunner at the end of ``O.engines``. A class has a name in scenes, and `_kept`: the records of this process, by label."""

	def __init_subclass__(cls, name=None):
		if name is None: return
		cls._kept, cls._name = {}, name
		nameInScenes(name, cls.__module__)

	def _start(self, call, label, every):
		scene = wrapper.Omega()
		scene.engines = list(scene.engines) + [runnerOf(self._name, call, label, every)]

	@staticmethod
	def _isTaken(label):
		return any(getattr(engine, 'label', '') == label for engine in wrapper.Omega().engines)

	def _isOfTheScene(self):
		return self.solver in wrapper.Omega().engines


class Film(Recorder):
	"""Recorder that takes pictures or states by `add`, and writes its one file at the end."""

	_label = None

	def _startFilm(self, every):
		kind = type(self).__name__
		self._label = next(label for label in (f'{kind}_{i}' for i in range(len(self._kept) + 1)) if label not in self._kept)
		self._kept[self._label] = self
		self._start(f'add({self._label!r})', self._label, every)

	def _finish(self):
		if self._label not in self._kept: return
		self.add()
		del self._kept[self._label]
		self._write()
		wrapper.Omega().engines = [engine for engine in wrapper.Omega().engines if engine.label != self._label]
