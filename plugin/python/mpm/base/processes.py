# SPDX-License-Identifier: GPL-2.0-or-later
"""Several processes that mpirun has started (scripts/run -n): each runs the script, the first one writes the files, and none outlives a failure of another."""
import atexit
import functools
import os
import sys
import threading
import time

count = int(os.environ.get('OMPI_COMM_WORLD_SIZE', 1))
rank = int(os.environ.get('OMPI_COMM_WORLD_RANK', 0))
isFirst = rank == 0
_grace = 10  # [s] that processes which have failed wait for the others to do so, too
_endOfScript = 27183  # tag of a message, as in the library
_hasFailed = _hasEnded = False

if 'OMPI_COMM_WORLD_RANK' in os.environ: from mpi4py import MPI  # begins MPI before PETSc can, and so ends it, however the script ends
if count > 1:
	_speak = sys.stderr.write
	from yade import mpy, plot, wrapper
	sys.stderr.write = _speak  # yade.mpy has turned it to stdout, and only that of the first process may be shown
	sys.stderr.reconfigure(line_buffering=True)  # for what is said before all are ended
	_world = MPI.COMM_WORLD.Dup()  # steps in the background have one of their own

from ..library import engine  # after the begin of MPI


def isDivided():
	"""True if this process has only its own points of the scene."""
	return count > 1 and engine.isDivided()


def gathered(mine):
	"""Values of each process, in all of them; a list of one where there is one."""
	return _world.allgather(mine) if count > 1 else [mine]


def byFirst(write):
	"""Decorator of a function that writes a file: the first process calls it, and what it writes is the same in all of them."""

	@functools.wraps(write)
	def wrapped(*arguments, **options):
		return write(*arguments, **options) if isFirst else None

	return wrapped


def withFirst(write):
	"""The same; between two runs the others wait until the file is there, and an error is one of all. During a run each may be somewhere else."""
	if count == 1: return write
	alone = byFirst(write)

	@functools.wraps(write)
	def wrapped(*arguments, **options):
		if wrapper.Omega().running or threading.current_thread() is not threading.main_thread(): return alone(*arguments, **options)
		error = None
		if isFirst:
			try:
				write(*arguments, **options)
			except Exception as thrown:
				error = thrown
		error = _world.bcast(error)
		if error: raise error

	return wrapped


def together(act):
	"""Result of act() in each of them; an error is one of all."""
	error = result = None
	try:
		result = act()
	except Exception as thrown:
		if count == 1: raise
		error = thrown
	for thrown in gathered(error):
		if thrown: raise thrown
	return result


def _refuseDecomposition(*arguments, **options):
	raise RuntimeError(
	        'yade.mpy.mpirun knows nothing of material points: leave it out, and call O.run(n, wait=True) in all of the processes, which share each load step as they are'
	)


def _exit(status=None):
	"""Does the same as sys.exit, by which YADE ends after an error of the script, and which leaves the others waiting."""
	global _hasFailed
	_hasFailed = status not in (None, 0, False)
	raise SystemExit(status)


def _tellEnd():
	"""To the others, who may be in a step that this process does not make."""
	global _hasEnded
	for rank in set(range(count)) - {MPI.COMM_WORLD.rank} if not _hasEnded else ():
		MPI.COMM_WORLD.Isend(bytearray(), rank, _endOfScript)
	_hasEnded = True


def _endOthers():
	"""After an error: where the others go on without this one, all are ended."""
	if MPI.Is_finalized(): return
	if not _hasFailed: return _tellEnd()
	sys.stdout.flush()
	together, deadline = _world.Ibarrier(), time.monotonic() + _grace
	while not together.Test():
		if time.monotonic() > deadline:
			print(f'yade.mpm: process {_world.rank} of {count} has failed, and others go on without it: all are ended.', file=sys.stderr, flush=True)
			_world.Abort(1)
		time.sleep(.01)


def _saying(end):
	"""Function that YADE calls after the script."""

	@functools.wraps(end)
	def wrapped():
		_tellEnd()
		return end()

	return wrapped


def _saveByFirst(omega, *arguments, **options):
	"""O.save: a file of the first process, unless it has only its own points."""
	if isDivided(): raise RuntimeError('O.save: with MpmImplicitEngine.distributed = True each process has points of its own, which mpm.save(file) writes, and mpm.load(file) reads')
	if isFirst: saveScene(omega, *arguments, **options)


saveScene = wrapper.Omega.save if count > 1 else None  # method of this process

if count > 1:
	mpy.mpirun = _refuseDecomposition
	mpy.disconnect, mpy.spawnedProcessWaitCommand = _saying(mpy.disconnect), _saying(mpy.spawnedProcessWaitCommand)
	sys.exit = _exit
	atexit.register(_endOthers)
	wrapper.Omega.save = _saveByFirst
	if not isFirst:
		plot.saveDataTxt = plot.saveGnuplot = lambda *arguments, **options: None
