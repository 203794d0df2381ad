# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of a scene of which each process has written its own material points."""
import glob
import os
import re

from yade import wrapper

from ..base.processes import count, gathered, rank, together
from ..library import engine


def _stemAndEnding(file):
	stem, ending = re.fullmatch(r'(.*?)((?:\.xml|\.yade)?(?:\.gz|\.bz2)?)', file).groups()
	return stem, ending


def piecesOf(file):
	"""Their paths by number; empty where there are none.

	:raises ValueError: some are missing, or there is more than one set of them.
	"""
	stem, ending = _stemAndEnding(file)
	found = {}
	for path in glob.glob(f'{glob.escape(stem)}-*of*{glob.escape(ending)}'):
		name = re.fullmatch(re.escape(stem) + r'-(\d+)of(\d+)' + re.escape(ending), path)
		if name: found.setdefault(int(name[2]), {})[int(name[1])] = path
	if not found: return []
	if len(found) > 1 or os.path.exists(file):
		sets = ['a whole one'] * os.path.exists(file) + [f'pieces of {number} processes' for number in sorted(found)]
		raise ValueError(f"load: file = {file!r}: there are {' and '.join(sets)} by this name; leave one of them there")
	(number, paths), = found.items()
	missing = [k for k in range(number) if k not in paths]
	if missing: raise ValueError(f'load: file = {file!r}: of {number} pieces number {missing[0]} is missing')
	return [paths[k] for k in range(number)]


def savePieces(file, write):
	"""Each process calls write(path) with its own; all else by that name goes."""
	stem, ending = _stemAndEnding(file)
	together(lambda: write(f'{stem}-{rank}of{count}{ending}'))
	together(lambda: _removeOthers(file, stem, ending) if rank == 0 else None)


def _removeOthers(file, stem, ending):
	for path in glob.glob(f'{glob.escape(stem)}-*of*{glob.escape(ending)}') + [file]:
		isPiece = re.fullmatch(re.escape(stem) + r'-\d+of(\d+)' + re.escape(ending), path)
		if os.path.exists(path) and (path == file or isPiece and int(isPiece[1]) != count): os.remove(path)


def loadPieces(pieces):
	"""Each process takes those whose turn it is; the next load step balances what they have."""
	moments, points = [], []
	own = pieces[rank::count]
	for path in own[1:]:
		moments.append(_load(path))
		points += _points()
	moments.append(_load(own[0] if own else pieces[0]))
	if not own: _erase(_points())
	moments = sum(gathered(moments), [])
	if len(set(moments)) > 1: raise ValueError(f'load: the pieces, of which {pieces[0]!r} is the first, are of different moments (O.iter, O.time and bodies): {sorted(set(moments))}')
	_insert(points)
	engine.takePieces()


def _load(path):
	scene = wrapper.Omega()
	scene.load(path, quiet=True)
	return scene.iter, scene.time, len(scene.bodies)


def _points():
	return [body for body in wrapper.Omega().bodies if body and isinstance(body.shape, wrapper.MpmPoint)]


def _erase(bodies):
	for id in [body.id for body in bodies]:
		wrapper.Omega().bodies.erase(id)


def _insert(bodies):
	"""Appends bodies of other pieces, which have materials of their own with the same values."""
	scene = wrapper.Omega()
	for body in bodies:
		body.material = scene.materials[body.material.id]
		scene.bodies.insertAtId(body, body.id)
