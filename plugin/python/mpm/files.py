# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are whole or not there at all."""
import contextlib
import os

from yade import wrapper

from .library import engine


@contextlib.contextmanager
def replacing(file):
	"""Gives a path beside *file* to write to, which takes its place when all has been written; otherwise *file* stays as it was.

	:raises OSError: the folder cannot be written to
	"""
	folder, name = os.path.split(os.path.abspath(file))
	temporary = os.path.join(folder, f'.{os.getpid()}-{name}')
	try:
		with open(temporary, 'wb'):
			pass  # so that a folder which cannot be written to is an OSError with its reason
		yield temporary
		with open(temporary, 'rb+') as written:
			os.fsync(written.fileno())
		os.replace(temporary, file)
	finally:
		if os.path.exists(temporary): os.remove(temporary)


def save(file):
	"""Save the scene as ``O.save`` does, but whole or not at all: a process that is killed meanwhile leaves the file as it was.

	For saving during a run: ``PyRunner(iterPeriod=10, command="mpm.save('slope.yade.gz')")`` behind the solver. While the scene runs
	in the background, the script may save, too: the file has the last converged state, and its run goes on from there.

	:param file: path with one of YADE's endings, ``.xml``, ``.xml.gz``, ``.xml.bz2``, ``.yade``, ``.yade.gz`` or ``.yade.bz2``
	:raise ValueError: another ending
	:raise OSError: the file cannot be written
	"""
	file = os.fspath(file)
	endings = '.xml', '.xml.gz', '.xml.bz2', '.yade', '.yade.gz', '.yade.bz2'
	if not file.endswith(endings):
		raise ValueError(f"save: file = {file!r} does not end in one of {', '.join(endings)}, which choose the format")
	with replacing(file) as temporary:
		engine.betweenSteps(lambda: wrapper.Omega().save(temporary, quiet=True))
