# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of points that may be in contact: their names and surfaces."""
import numpy as np
from yade.wrapper import MpmBody

from ..base.messages import brief
from ..geometry.surfaces import surface


def bodyNumber(caller, name, region, grid):
	"""The place among grid.bodies of the body of this name, which is given the surface of a region, too; -1 without a name."""
	if name is None: return -1
	if not isinstance(name, str) or not name: raise TypeError(f'{caller}: body = {brief(name)} must be a name that is not empty')
	bodies = list(grid.bodies)
	known = next((body for body in bodies if body.name == name), None)
	if known is None:
		bodies.append(MpmBody(name=name))
		known = bodies[-1]
	elif len(known.initialVertices):
		raise ValueError(f"{caller}: body = '{name}' has made steps already, and its surface has moved; give what is added another name")
	try:
		_addSurface(known, surface(region, dim=grid.dim), grid.dim)
	except ValueError as error:
		raise ValueError(f"{caller}: body = '{name}' needs the surface of its region, for contact with others: {str(error).removeprefix('surface: ')}") from None
	grid.bodies = bodies
	return bodies.index(known)


def _addSurface(body, added, dim):
	"""The surfaces of the body and of a region, without what they have in common, which is inside then."""
	old, new = ([np.array([part.vertices[v] for v in piece]) for piece in part.pieces] for part in (body, added))
	if dim == 2: old, new = _withoutCommon(old, new)
	else:
		old, new = _withoutCommonFaces(old, new)
	pieces = old + new
	extent = max((np.ptp(np.concatenate(pieces), axis=0).max(), 1e-300)) if pieces else 1
	numbers, vertices = {}, []
	def number(x):
		key = tuple(np.round(x / (1e-8 * extent)).astype(np.int64).tolist())
		if key not in numbers:
			numbers[key] = len(vertices)
			vertices.append(tuple(x.tolist()))
		return numbers[key]
	body.pieces = []
	named = [[number(x) for x in piece] for piece in pieces]
	body.vertices, body.pieces = vertices, [piece for piece in named if len(set(piece)) == len(piece)]


def _faces(pieces):
	"""Numbers of the triangles in each plane, by its normal and distance in whole parts of the extent; and a function that names vertices alike."""
	extent = np.ptp(np.concatenate(pieces), axis=0).max()
	rounded = lambda x: tuple(np.round(np.asarray(x) / (1e-7 * extent)).astype(np.int64).tolist())
	faces = {}
	for i, (a, b, c) in enumerate(pieces):
		normal = np.cross(b - a, c - a)
		normal = normal / np.linalg.norm(normal)
		faces.setdefault((tuple(np.round(normal, 6).tolist()), rounded([normal @ a])[0]), []).append(i)
	return faces, rounded


def _outline(pieces, rounded):
	"""The sides that only one of the triangles in a plane has, as sets of their ends."""
	sides = [frozenset((rounded(piece[i]), rounded(piece[i - 1]))) for piece in pieces for i in range(3)]
	return {side for side in sides if sides.count(side) == 1}


def _withoutCommonFaces(old, new):
	"""Triangles of two lists, less the plane faces that both have."""
	if not old: return old, new
	faces, rounded = _faces(old + new)
	gone = set()
	for (normal, distance), members in faces.items():
		first, second = [i for i in members if i < len(old)], [i for i in faces.get((tuple(-x + 0. for x in normal), -distance), []) if i >= len(old)]
		if not first or not second: continue
		all_ = old + new
		if _outline([all_[i] for i in first], rounded) == _outline([all_[i] for i in second], rounded): gone.update(first + second)
		else:
			low, high = (np.array([function(np.concatenate([all_[i] for i in face]), axis=0) for face in (first, second)]) for function in (np.min, np.max))
			if ((high.min(axis=0) - low.max(axis=0)) > 1e-6 * np.ptp(np.concatenate(all_), axis=0).max()).sum() >= 2:
				raise ValueError('surface: in space, regions that are filled with one name must have whole plane faces in common, or none')
	return [p for i, p in enumerate(old) if i not in gone], [p for i, p in enumerate(new, len(old)) if i not in gone]


def _withoutCommon(old, new):
	"""Segments of two lists, less the parts where one runs along the other, the opposite way."""
	kept = []
	for segments, others in ((old, new), (new, old)):
		kept.append([])
		for a, b in segments:
			length = np.linalg.norm((b - a)[:2])
			along = (b - a) / length
			gaps = []
			for c, d in others:
				across = [abs(along[0] * (x - a)[1] - along[1] * (x - a)[0]) for x in (c, d)]
				if max(across) > 1e-9 * length or np.dot(along, d - c) >= 0: continue
				first, last = np.dot(d - a, along), np.dot(c - a, along)
				if min(last, length) - max(first, 0) > 1e-9 * length: gaps.append((max(first, 0), min(last, length)))
			place = 0.
			for first, last in sorted(gaps) + [(length, length)]:
				if first - place > 1e-9 * length: kept[-1].append(np.array([a + place * along, a + first * along]))
				place = max(place, last)
	return kept
