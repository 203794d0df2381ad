# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions from files: closed surfaces of triangles, as CAD writes them, and grids of heights, as GIS does."""
import math
import os

import numpy as np
from yade import pack, ymport
from yade.minieigenHP import Vector3

from .library import engine
from .messages import brief, isNumber, pathOf, place


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
	try:
		numbers = np.array([float(x) for x in value])
	except (TypeError, ValueError):
		numbers = np.empty(0)
	if numbers.shape != (3, ) or not np.isfinite(numbers).all(): raise TypeError(f'solid: shift = {brief(value)} must be three finite numbers')
	return numbers


def _ofStl(fileName):
	"""(N, 3, 3) corners of the triangles."""
	return np.array([[body.state.pos + v for v in body.shape.vertices] for body in ymport.stl(fileName)]).reshape(-1, 3, 3)


def _ofGts(fileName):
	import gts
	with open(fileName) as file:
		try:
			surface = gts.read(file)  # its faces go with it
		except Exception as error:  # of whatever kind gts has
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
	label = np.arange(triangles.max() + 1)
	while True:
		least = label[triangles].min(axis=1)
		grown = label.copy()
		np.minimum.at(grown, triangles, least[:, None])
		grown = grown[grown]
		if (grown == label).all(): return np.unique(label[triangles[:, 0]], return_inverse=True)[1].ravel()
		label = grown


def _isAround(triangles, point):
	"""Whether a closed surface is around a point, whichever way its triangles (N, 3, 3) face: the solid angles that they fill add up to a full one (van Oosterom and Strackee 1983)."""
	a, b, c = (triangles - point).transpose(1, 0, 2)
	lengths = [np.linalg.norm(v, axis=1) for v in (a, b, c)]
	dot = lambda v, w: (v * w).sum(axis=1)
	above = dot(a, np.cross(b, c))
	below = lengths[0] * lengths[1] * lengths[2] + dot(a, b) * lengths[2] + dot(b, c) * lengths[0] + dot(c, a) * lengths[1]
	return abs(np.arctan2(above, below).sum()) > math.pi


def _joined(points, step):
	"""Number of the vertex of each point (N,). Neighbours on both sides of a rounding limit are one, too."""
	groups = [np.unique(np.round(points / step + offset), axis=0, return_inverse=True)[1].ravel() for offset in (0, 0.5)]
	label, before = np.arange(len(points)), None
	while before is None or (label != before).any():
		before = label
		for group in groups:
			first = np.full(group.max() + 1, len(points))
			np.minimum.at(first, group, label)
			label = first[group]
	return np.unique(label, return_inverse=True)[1]


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
	reached = set(edges[0].tolist())
	while True:
		mask = np.isin(edges, list(reached)).any(axis=1)
		grown = set(edges[mask].ravel().tolist())
		if grown == reached: return mask
		reached = grown


class terrain(pack.Predicate):
	"""Predicate of the ground below a surface that is read from an elevation grid (ESRI ASCII, .asc), down to a bottom; z is the height. Between the points of the grid heights are bilinear.

	:param top: path of the grid of the surface's heights [m]
	:param bottom: height of the bottom [m], a number or the path of another grid, as of the top of the rock
	:param min: lower corner (x, y) of the part that is wanted [m], in the coordinates of the file; by default all of the grid
	:param max: upper corner
	:param origin: (x, y) in the coordinates of the file [m] that becomes x = y = 0: national grids have seven digits before the point
	:raises OSError: a file cannot be read.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a file that is no elevation grid, no height known in the part that is wanted, or a bottom above the surface; the place is named.
	"""

	def __init__(self, top, bottom, min=(-math.inf, -math.inf), max=(math.inf, math.inf), origin=(0, 0)):
		super().__init__()
		origin, low, high = (_pair(name, value) for name, value in (('origin', origin), ('min', min), ('max', max)))
		if not np.isfinite(origin).all(): raise TypeError(f'terrain: origin = {place(origin)} must be finite')
		grids = [_Heights(pathOf('terrain', 'top', top))]
		if not isNumber(bottom): grids.append(_Heights(pathOf('terrain', 'bottom', bottom)))
		elif not math.isfinite(bottom): raise ValueError(f'terrain: bottom = {brief(bottom)} must be finite, or the path of a grid')
		self.low, self.high = np.max([low] + [g.low for g in grids], axis=0), np.min([high] + [g.high for g in grids], axis=0)
		if not (self.low < self.high).all():
			raise ValueError(f'terrain: nothing of {top!r}, which reaches from {place(grids[0].low)} to {place(grids[0].high)}, is between min = {place(low)} and max = {place(high)}')
		for grid in grids:
			grid.requireMetres(bottom if isNumber(bottom) else [])
			grid.requireKnown(self.low, self.high)
		self.origin, self._top, self._bottom = origin, grids[0], grids[1] if len(grids) > 1 else float(bottom)
		self._requireThickness()

	def _requireThickness(self):
		places = self._top.placesIn(self.low, self.high)
		thin = np.flatnonzero(self._top.at(places) <= self._bottomAt(places))
		if not thin.size: return
		x = places[thin[0]]
		raise ValueError(f'terrain: the bottom, at {self._bottomAt(places)[thin[0]]:g} m, is not below the surface, at {self._top.at(places)[thin[0]]:g} m, at {place(x)}')

	def _bottomAt(self, places):
		return self._bottom.at(places) if isinstance(self._bottom, _Heights) else np.full(len(places), self._bottom)

	def heights(self, places):
		"""(N,) heights of the surface [m] at these places (N, 2) of the scene, NaN beside the region."""
		places = np.asarray(places, float).reshape(-1, 2) + self.origin
		inside = ((places >= self.low) & (places <= self.high)).all(axis=1)
		return np.where(inside, self._top.at(np.clip(places, self.low, self.high)), np.nan)

	def contains(self, points):
		"""(N,) mask of the points (N, 3) [m] inside."""
		places = points[:, :2] + self.origin
		inside = ((places >= self.low) & (places <= self.high)).all(axis=1)
		near = np.clip(places, self.low, self.high)
		return inside & (points[:, 2] <= self._top.at(near)) & (points[:, 2] >= self._bottomAt(near))

	def __call__(self, pt, pad=0.):
		"""True if the point is inside; *pad* is not looked at."""
		return bool(self.contains(np.array([tuple(pt)]))[0])

	def aabb(self):
		"""Lower and upper corner of the box around it."""
		places = self._top.placesIn(self.low, self.high)
		return Vector3(*(self.low - self.origin), self._bottomAt(places).min()), Vector3(*(self.high - self.origin), self._top.at(places).max())


# Where ground cannot be that steep in metres, half of it; nor a model of it as thick, over its width.
_steepest, _thickest = 5, 50


class _Heights:
	"""Heights on a lattice, from a file."""

	def __init__(self, fileName):
		self.fileName = fileName
		header, rows = self._read()
		self.step = header['cellsize']
		half = [0 if f'{axis}llcenter' in header else self.step / 2 for axis in 'xy']
		corner = [header.get(f'{axis}llcenter', header.get(f'{axis}llcorner')) for axis in 'xy']
		self.values = np.where(rows == header.get('nodata_value', -9999), np.nan, rows)[::-1].T  # [x, y]; the first row is the northern one
		self.low = np.array(corner) + half
		self.high = self.low + self.step * (np.array(self.values.shape) - 1)

	def _read(self):
		refuse = lambda what: ValueError(f'terrain: {self.fileName!r} is no elevation grid (ESRI ASCII): {what}')
		header, lines = {}, []
		with open(self.fileName, encoding='utf-8', errors='replace') as file:
			for line in file:
				words = line.split()
				if words and not lines and words[0][0].isalpha() and words[0].lower() != 'nan':
					try:
						header[words[0].lower()] = float(words[1])
					except (IndexError, ValueError):
						raise refuse(f'its header has the line {brief(line.strip())}') from None
				elif words: lines.append(line)
		missing = [name for name in ('ncols', 'nrows', 'cellsize') if name not in header] + [axis + 'llcorner' for axis in 'xy' if not {axis + 'llcorner', axis + 'llcenter'} & set(header)]
		if missing: raise refuse(f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} not in its header")
		try:
			values = np.array(' '.join(lines).split(), float)
		except ValueError as error:
			raise refuse(error) from None
		for name in 'nrows', 'ncols':
			if header[name] != int(header[name]): raise refuse(f'{name} = {header[name]:g} is no whole number')
		shape = int(header['nrows']), int(header['ncols'])
		if values.size != shape[0] * shape[1] or min(shape) < 2: raise refuse(f'{shape[0]} rows of {shape[1]} heights are announced, at least 2 of each, and {values.size} are there')
		if not header['cellsize'] > 0: raise refuse('cellsize must be > 0')
		ends = np.cumsum([len(line.split()) for line in lines])
		cut = np.setdiff1d(shape[1] * np.arange(1, shape[0] + 1), ends)
		if cut.size:
			row, line = cut[0] // shape[1], np.searchsorted(ends, cut[0])
			raise refuse(
			        f'each of its {shape[0]} rows has {shape[1]} heights (ncols), but row {row} does not end with a line: line {line + 1} of the heights has {len(lines[line].split())}; is ncols '
			        'right, or has a height been lost or doubled?'
			)
		return header, values.reshape(shape)

	def requireMetres(self, bottom):
		"""ValueError if the grid is one in degrees of longitude and latitude: ground would be some hundred thousand times as steep as it is."""
		low, high = self.low - self.step / 2, self.high + self.step / 2
		if not ((-180 <= low[0]) & (high[0] <= 360) & (-90 <= low[1]) & (high[1] <= 90)): return
		known = self.values[np.isfinite(self.values)]
		slopes = [np.abs(np.diff(self.values, axis=axis)) / self.step for axis in (0, 1)]
		slopes = np.concatenate([s[np.isfinite(s)] for s in slopes])
		steep = np.median(slopes) if slopes.size else 0
		thick = np.ptp(np.append(known, bottom)) / (high - low).max()
		if not (steep > _steepest or thick > _thickest): return
		longitude, latitude = (low + high) / 2
		metres = 111.2e3 * np.array([math.cos(math.radians(latitude)), 1])
		zone = int((longitude + 180) % 360 // 6) + 1
		raise ValueError(
		        f'terrain: {self.fileName!r} is {high[0] - low[0]:.3g} wide, {high[1] - low[1]:.3g} long and {np.ptp(known):.3g} m high, around ({longitude:.6g}, {latitude:.6g}): are these degrees of '
		        f'longitude and latitude? One degree is {metres[0] / 1e3:.4g} km along x and {metres[1] / 1e3:.4g} km along y there, so that its cells of {self.step:.3g} would be '
		        f'{self.step * metres[0]:.3g} m by {self.step * metres[1]:.3g} m. Have a GIS project it to metres, as by gdalwarp -t_srs EPSG:{(32600 if latitude >= 0 else 32700) + zone} (UTM zone {zone}) and '
		        'gdal_translate -of AAIGrid, and give mpm.terrain an origin near it.'
		)

	def requireKnown(self, low, high):
		first = self._cells(low[None])[0]
		last = np.ceil((high - self.low) / self.step - 1e-9).astype(int)
		part = self.values[first[0]:last[0] + 1, first[1]:last[1] + 1]
		unknown = np.argwhere(~np.isfinite(part))
		if len(unknown):
			x = self.low + self.step * (unknown[0] + first)
			raise ValueError(
			        f'terrain: {self.fileName!r} has no height at {place(x)}, nor at {len(unknown) - 1} more of {part.size} places in the part that is wanted; '
			        'fill the holes, or choose a part without by min and max'
			)
		self.values = np.nan_to_num(self.values)  # elsewhere heights have no weight

	def placesIn(self, low, high):
		"""(N, 2) places between which heights in a box are bilinear, its edges included."""
		axes = []
		for a in (0, 1):
			lattice = self.low[a] + self.step * np.arange(self.values.shape[a])
			axes.append(np.concatenate([[low[a]], lattice[(lattice > low[a]) & (lattice < high[a])], [high[a]]]))
		return np.stack(np.meshgrid(*axes, indexing='ij'), -1).reshape(-1, 2)

	def _cells(self, places):
		return np.clip(np.floor((places - self.low) / self.step).astype(int), 0, np.array(self.values.shape) - 2)

	def at(self, places):
		"""(N,) heights at places (N, 2) on the lattice."""
		i, j = self._cells(places).T
		u, v = ((places - self.low) / self.step).T - (i, j)
		z = self.values
		return (1 - u) * ((1 - v) * z[i, j] + v * z[i, j + 1]) + u * ((1 - v) * z[i + 1, j] + v * z[i + 1, j + 1])


def _pair(name, value):
	try:
		numbers = np.array([float(x) for x in value])
	except (TypeError, ValueError):
		numbers = np.empty(0)
	if numbers.shape != (2, ) or np.isnan(numbers).any(): raise TypeError(f'terrain: {name} = {brief(value)} must be two numbers, x and y')
	return numbers
