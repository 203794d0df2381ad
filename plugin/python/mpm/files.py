# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are whole or not there at all."""
import bz2
import contextlib
import gzip
import os
import shutil

from yade import wrapper

from .library import engine
from .messages import pathOf
from .processes import withFirst


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


@withFirst
def save(file):
	"""Save the scene as ``O.save`` does, but whole or not at all: a process that is killed meanwhile leaves the file as it was.

	For saving during a run: ``PyRunner(iterPeriod=10, command="mpm.save('slope.yade.gz')")`` behind the solver. While the scene runs
	in the background, the script may save, too: the file has the last converged state, and its run goes on from there.

	:param file: path with one of YADE's endings, ``.xml``, ``.xml.gz``, ``.xml.bz2``, ``.yade``, ``.yade.gz`` or ``.yade.bz2``; folders that
		are missing are made
	:raises TypeError: no path
	:raises ValueError: another ending
	:raises OSError: the file cannot be written; it is named, with the reason
	"""
	file = pathOf('save', 'file', file)
	endings = '.xml', '.xml.gz', '.xml.bz2', '.yade', '.yade.gz', '.yade.bz2'
	if not file.endswith(endings):
		raise ValueError(f"save: file = {file!r} does not end in one of {', '.join(endings)}, which choose the format")
	with replacing(file) as temporary:
		plain = temporary.removesuffix('.gz').removesuffix('.bz2')
		try:
			engine.betweenSteps(lambda: _savePlain(plain))
			if plain != temporary: _compress(plain, temporary)
		finally:
			if plain != temporary and os.path.exists(plain): os.remove(plain)


def _savePlain(path):
	"""As O.save, whose errors name neither the file nor the reason."""
	try:
		wrapper.Omega().save(path, quiet=True)
	except RuntimeError as error:
		with open(path, 'ab') as file:  # an OSError says why, if the file can still not be written
			file.write(bytes(2**16))
			os.fsync(file.fileno())
		raise OSError(f'YADE cannot save the scene ({error})') from None


def _compress(source, target):
	"""O.save would do it, but never ends when the disk is full."""
	with open(source, 'rb') as whole, (gzip.open(target, 'wb', 6) if target.endswith('.gz') else bz2.open(target, 'wb')) as compressed:
		shutil.copyfileobj(whole, compressed, 2**20)
