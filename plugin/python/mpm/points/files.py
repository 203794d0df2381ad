# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are whole or not there at all."""
import bz2
import contextlib
import errno
import gzip
import os
import shutil

from yade import wrapper

from ..base import processes
from ..base.messages import pathOf
from ..base.processes import isDivided, withFirst
from ..library import engine
from . import stages
from .pieces import loadPieces, piecesOf, savePieces

_endings = '.xml', '.xml.gz', '.xml.bz2', '.yade', '.yade.gz', '.yade.bz2'


@contextlib.contextmanager
def replacing(file):
	"""Gives a path beside *file* to write to, which takes its place when all has been written; otherwise *file* stays as it was.

	Folders that are missing are made.

	:raises OSError: it cannot be written; the error names *file* and not the path beside it.
	"""
	folder, name = os.path.split(os.path.abspath(file))
	temporary = os.path.join(folder, f'.{os.getpid()}-{name}')
	try:
		with _naming(file, temporary, 'its folder cannot be made: '):
			os.makedirs(folder, exist_ok=True)
		with _naming(file, temporary):
			with open(temporary, 'wb'):
				pass  # so that a folder which cannot be written to is an OSError with its reason
			yield temporary
			with open(temporary, 'rb+') as written:
				os.fsync(written.fileno())
			os.replace(temporary, file)
	finally:
		if os.path.exists(temporary): os.remove(temporary)


@contextlib.contextmanager
def _naming(file, temporary, what=''):
	"""An OSError in the block that names no file, the temporary one or a folder above it names the file that was asked for."""
	try:
		yield
	except OSError as error:
		if error.filename and not temporary.startswith(str(error.filename)): raise
		if error.errno is None: raise OSError(f'{what}{error}: {file!r}') from None
		raise OSError(error.errno, what + error.strerror, file) from None


def save(file):
	"""Save the scene as ``O.save`` does, but whole or not at all: a process that is killed meanwhile leaves the file as it was.

	For saving during a run: ``PyRunner(iterPeriod=10, command="mpm.save('slope.yade.gz')")`` behind the solver. While the scene runs
	in the background, the script may save, too: the file has the last converged state, and its run goes on from there. Where several processes have divided the
	points (``MpmImplicitEngine.distributed``) each writes its own, ``slope-0of4.yade.gz``, which take the place of all that there was by that name; :func:`load` puts
	them together, in any number of processes.

	:param file: path with one of YADE's endings, ``.xml``, ``.xml.gz``, ``.xml.bz2``, ``.yade``, ``.yade.gz`` or ``.yade.bz2``; folders that
		are missing are made
	:raises TypeError: no path
	:raises ValueError: another ending
	:raises OSError: the file cannot be written; it is named, with the reason
	"""
	file = pathOf('save', 'file', file)
	if not file.endswith(_endings):
		raise ValueError(f"save: file = {file!r} does not end in one of {', '.join(_endings)}, which choose the format")
	savePieces(file, _write) if isDivided() else withFirst(_write)(file)


def load(file):
	"""Load what :func:`save` has written, by one process or by several of which each had its own points: the scene goes on from there, in any number of processes.

	:param file: the path that :func:`save` was given
	:raises TypeError: no path
	:raises OSError: there is no such file, nor pieces of it, or it cannot be read as a scene
	:raises ValueError: pieces are missing or of different moments, or there are both a file and pieces.
	"""
	file = pathOf('load', 'file', file)
	pieces = piecesOf(file)
	if pieces: return loadPieces(pieces)
	if not os.path.exists(file): raise FileNotFoundError(errno.ENOENT, 'load: there is no such file, nor pieces of it', file)
	engine.endBackgroundRun()  # YADE does not survive that its scene is replaced in a step, and O.pause() does not wait for its end
	try:
		wrapper.Omega().load(file, quiet=True)
	except RuntimeError as error:
		raise OSError(
		        f'load: {file!r}, of {os.path.getsize(file)} bytes, cannot be read as a scene ({error}): it is not whole, as after a full disk or a run that was killed '
		        'while it wrote, or another release of YADE or of the plugin has written it'
		) from None
	stages.resume()


def _write(file):
	with replacing(file) as temporary:
		plain = temporary.removesuffix('.gz').removesuffix('.bz2')
		try:
			engine.betweenSteps(lambda: _savePlain(plain))
			if plain != temporary: _compress(plain, temporary)
		finally:
			if plain != temporary and os.path.exists(plain): os.remove(plain)


def _savePlain(path):
	"""Does the same as O.save, whose errors name neither the file nor the reason."""
	try:
		(processes.saveScene or wrapper.Omega.save)(wrapper.Omega(), path, quiet=True)
	except RuntimeError as error:
		with open(path, 'ab') as file:  # an OSError says why, if the file can still not be written
			file.write(bytes(2**16))
			os.fsync(file.fileno())
		raise OSError(f'YADE cannot save the scene ({error})') from None


def _compress(source, target):
	"""O.save would do it, but never ends when the disk is full."""
	with open(source, 'rb') as whole, (gzip.open(target, 'wb', 6) if target.endswith('.gz') else bz2.open(target, 'wb')) as compressed:
		shutil.copyfileobj(whole, compressed, 2**20)
