# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions from files: closed surfaces of triangles, as CAD writes them."""
import math
import os
import re

import numpy as np
from yade import pack
from yade.minieigenHP import Vector3

from ..base.messages import brief, isNumber, numbersIn, pathOf, place
from ..library import engine


def solid(fileName, scale=1., shift=(0, 0, 0)):
	"""Region inside a closed surface that is read from a file, for :func:`fill`, :func:`surface` and wherever a predicate of ``yade.pack`` goes.

	:param fileName: path of an STL file (text or binary) or a GTS file; its ending, .stl or .gts, says which
	:param scale: what coordinates are multiplied by, a number > 0: 1e-3 of a drawing in millimetres
	:param shift: what is added to them then [m], three numbers
	:return: ``pack.inGtsSurface``
	:raises OSError: the file cannot be read.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a file of another kind, without triangles, or with a surface that is not closed: the message says where the hole is.
	"""
	fileName = pathOf('solid', 'fileName', fileName)
	if not isNumber(scale): raise TypeError(f'solid: scale = {brief(scale)} must be a number > 0')
	if not (math.isfinite(scale) and scale > 0): raise ValueError(f'solid: scale = {brief(scale)} must be finite and > 0')
	with open(fileName, 'rb'):
		pass  # YADE's readers do not say that there is no such file
	kind = os.path.splitext(fileName)[1].lower()
	if kind not in _readers: raise ValueError(f"solid: fileName = {fileName!r} must end in {' or '.join(_readers)}")
	corners = _readers[kind](fileName) * scale + _shift(shift)
	if not len(corners): raise ValueError(f'solid: {fileName!r} has no triangles')
	if not np.isfinite(corners).all(): raise ValueError(f'solid: {fileName!r} has a vertex that is not finite')
	return pack.inGtsSurface(_closedSurface(corners, fileName))


def _shift(value):
	numbers = numbersIn(value)
	if numbers.shape != (3, ) or not np.isfinite(numbers).all(): raise TypeError(f'solid: shift = {brief(value)} must be three finite numbers')
	return numbers


def _ofStl(fileName):
	"""(N, 3, 3) corners of the triangles."""
	with open(fileName, 'rb') as file:
		content = file.read()
	count = int.from_bytes(content[80:84], 'little')
	isText = content[:5].lower() == b'solid' and len(content) != 84 + 50 * count  # programs write 'solid' into binary files, too
	return _ofStlText(fileName, content.decode('utf-8', 'replace')) if isText else _ofStlBinary(fileName, content, count)


def _ofStlBinary(fileName, content, count):
	if len(content) < 84 + 50 * count or len(content) < 84:
		raise ValueError(f'solid: {fileName!r} is no STL file: it neither begins with "solid", nor has its {len(content)} bytes room for the {count} triangles that a binary file announces; is it cut off?')
	triangle = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])
	return np.frombuffer(content, triangle, count, 84)['corners'].astype(float)


def _ofStlText(fileName, text):
	"""Triangles of all solids in a text file, with all digits that it has."""
	facets = re.findall(r'\bfacet\s+normal\b(.*?)\bendfacet\b', text, re.IGNORECASE | re.DOTALL)
	announced = len(re.findall(r'^\s*facet\b', text, re.IGNORECASE | re.MULTILINE))
	if len(facets) != announced: raise ValueError(f'solid: {fileName!r} begins {announced} facets and ends {len(facets)}; is it cut off?')
	corners = [re.findall(r'\bvertex\s+(\S+)\s+(\S+)\s+(\S+)', facet, re.IGNORECASE) for facet in facets]
	wrong = next((i for i, three in enumerate(corners) if len(three) != 3), None)
	if wrong is not None: raise ValueError(f'solid: {fileName!r}: facet {wrong + 1} has {len(corners[wrong])} vertices, and a triangle has three')
	try:
		return np.array(corners, float).reshape(-1, 3, 3)
	except ValueError as error:
		raise ValueError(f'solid: {fileName!r} has a vertex that is no number: {error}') from None


def _ofGts(fileName):
	import gts
	with open(fileName) as file:
		try:
			surface = gts.read(file)  # its faces go with it
		except Exception as error:  # any kind that gts has
			raise ValueError(f'solid: {fileName!r} cannot be read as a GTS file: {error}') from None
	return np.array([[v.coords() for v in face.vertices()] for face in surface.faces()]).reshape(-1, 3, 3)


_readers = {'.stl': _ofStl, '.gts': _ofGts}


def _closedSurface(corners, fileName):
	"""gts.Surface of these triangles. Vertices closer than a millionth of its size are one: STL files keep seven digits."""
	import gts
	flat = corners.reshape(-1, 3)
	step = 1e-6 * np.ptp(flat, axis=0).max()
	vertex = _joined(flat, step)
	places = np.empty((vertex.max() + 1, 3))
	places[vertex] = flat
	numbers = vertex.reshape(-1, 3)
	numbers = numbers[(numbers != np.roll(numbers, 1, axis=1)).all(axis=1)]  # without those that have shrunk to a line
	_requireClosed(numbers, places, fileName)
	numbers = _facingOutwards(numbers, places, fileName)
	vertices = [gts.Vertex(*x) for x in places.tolist()]
	edges, surface = {}, gts.Surface()

	def edge(a, b):
		key = (a, b) if a < b else (b, a)
		if key not in edges: edges[key] = gts.Edge(vertices[key[0]], vertices[key[1]])
		return edges[key]

	for a, b, c in numbers.tolist():
		surface.add(gts.Face(edge(a, b), edge(b, c), edge(c, a)))
	return surface


def _facingOutwards(triangles, places, fileName):
	"""The same triangles, those of whole shells turned that face the wrong way: outwards is where an even number of other shells is around."""
	shell = _shells(triangles)
	count, corners = shell.max() + 1, places[triangles]
	turned = []
	for number in range(count):
		own = corners[shell == number]
		a, b, c = (own - own[0, 0]).transpose(1, 0, 2)
		volume = (np.cross(a, b) * c).sum()  # six times that of the tetrahedra between a point and the triangles
		around = sum(_isAround(corners[shell == other], own[0, 0]) for other in range(count) if other != number)
		if (volume > 0) != (around % 2 == 0): turned.append(number)
	if not turned: return triangles
	which = 'its triangles face' if count == 1 else f'the triangles of {len(turned)} of its {count} closed shells face'
	engine.warn(
	        f'solid: {fileName!r}: {which} the wrong way, to where the solid is; they are turned. The solid is what an odd number of closed shells is around, so that a shell within another one is '
	        'the wall of a cavity.'
	)
	return np.where(np.isin(shell, turned)[:, None], triangles[:, ::-1], triangles)


def _shells(triangles):
	"""Number of the shell of each triangle (N,): those that are joined by vertices have the same."""
	return _connected(np.concatenate([triangles[:, :2], triangles[:, 1:]]), triangles.max() + 1)[triangles[:, 0]]


def _connected(pairs, count):
	"""Number of the part (count,) that each of so many belongs to, which pairs (N, 2) connect."""
	from scipy.sparse import coo_matrix
	from scipy.sparse.csgraph import connected_components
	return connected_components(coo_matrix((np.ones(len(pairs)), tuple(np.transpose(pairs))), (count, count)), directed=False)[1]


def _isAround(triangles, point):
	"""True if a closed surface is around a point, whichever way its triangles (N, 3, 3) face: the solid angles that they fill add up to a full one (van Oosterom and Strackee 1983)."""
	a, b, c = (triangles - point).transpose(1, 0, 2)
	lengths = [np.linalg.norm(v, axis=1) for v in (a, b, c)]
	dot = lambda v, w: (v * w).sum(axis=1)
	above = dot(a, np.cross(b, c))
	below = lengths[0] * lengths[1] * lengths[2] + dot(a, b) * lengths[2] + dot(b, c) * lengths[0] + dot(c, a) * lengths[1]
	return abs(np.arctan2(above, below).sum()) > math.pi


def _joined(points, step):
	"""Number of the vertex of each point (N,), those that are closer than a step are one, and so are chains of them."""
	from scipy.spatial import cKDTree
	places, number = np.unique(points, axis=0, return_inverse=True)
	return _connected(cKDTree(places).query_pairs(step, output_type='ndarray'), len(places))[number.ravel()]


def _requireClosed(triangles, places, fileName):
	"""ValueError unless each edge belongs to two triangles, which go along it in opposite directions."""
	sides = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
	edges, index, count = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True)
	middle = lambda these: place(places[edges[these[0]]].mean(axis=0))
	open_ = np.flatnonzero(count == 1)
	if open_.size:
		hole = _hole(edges[open_])
		rim = places[np.unique(edges[open_][hole])]
		raise ValueError(
		        f'solid: the surface in {fileName!r} is not closed: it has a hole from {place(rim.min(axis=0))} to {place(rim.max(axis=0))}, with '
		        f'{hole.sum()} edges around it ({open_.size} edges in all have a triangle on one side only)'
		)
	many = np.flatnonzero(count > 2)
	if many.size: raise ValueError(f'solid: the surface in {fileName!r} meets itself at the edge around {middle(many)}, which belongs to {count[many[0]]} triangles')
	balance = np.bincount(index.ravel(), np.where(sides[:, 0] < sides[:, 1], 1, -1))
	turned = np.flatnonzero(balance != 0)
	if turned.size: raise ValueError(f'solid: of the two triangles at the edge around {middle(turned)} of the surface in {fileName!r} one is inside out')


def _hole(edges):
	"""Mask of the edges that belong to the same rim as the first one."""
	parts = _connected(edges, edges.max() + 1)[edges[:, 0]]
	return parts == parts[0]
