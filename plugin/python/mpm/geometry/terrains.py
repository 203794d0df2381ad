# SPDX-License-Identifier: GPL-2.0-or-later
"""Heights of ground over x and y, from files as GIS writes them, arrays and functions, and what is made of them: regions to fill, and facets of rock."""
import math

import numpy as np
from yade import pack, utils
from yade.minieigenHP import Vector3

from ..base.messages import brief, isNumber, numbersIn, pathOf, place
from .elevations import read


class terrain(pack.Predicate):
	"""Predicate of the ground below a surface, down to a bottom; z is the height. Between the points of the grid of heights it is bilinear.

	:param top: heights of the surface [m]: the path of an elevation grid (ESRI ASCII, .asc; any other format of GIS, as GeoTIFF, by GDAL, python3-gdal), a function of x and y, or an array with one row for each x, from *min* on
	:param bottom: height of the bottom [m], a number or as for *top*, as of the top of the rock
	:param min: lower corner (x, y) of the part that is wanted [m], in the coordinates of the file; by default all of the grid
	:param max: upper corner; both are needed for a function, and *min* for an array
	:param origin: (x, y) in the coordinates of the file [m] that becomes x = y = 0: national grids have seven digits before the point
	:param spacing: distance [m] > 0 of the heights in an array, or at which a function is asked
	:raises ImportError: a file of another format than ESRI ASCII, and GDAL is not installed.
	:raises OSError: a file cannot be read.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a file that is no elevation grid, or one in degrees; no height known in the part that is wanted; heights that are not finite; or a bottom above the surface; the place is named.
	"""

	def __init__(self, top, bottom, min=(-math.inf, -math.inf), max=(math.inf, math.inf), origin=(0, 0), spacing=None):
		super().__init__()
		origin, low, high = (_pair('terrain', name, value) for name, value in (('origin', origin), ('min', min), ('max', max)))
		if not np.isfinite(origin).all(): raise TypeError(f'terrain: origin = {place(origin)} must be finite')
		grids = [heightsOf('terrain', 'top', top, low, high, spacing)]
		if not isNumber(bottom): grids.append(heightsOf('terrain', 'bottom', bottom, low, high, spacing))
		elif not math.isfinite(bottom): raise ValueError(f'terrain: bottom = {brief(bottom)} must be finite, or the path of a grid')
		self.low, self.high = _part('terrain', grids, low, high)
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
		return self._bottom.at(places) if isinstance(self._bottom, Heights) else np.full(len(places), self._bottom)

	def heights(self, places):
		"""(N,) heights of the surface [m] at these positions (N, 2) of the scene, NaN beside the region."""
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


def facets(surface, spacing=None, min=(-math.inf, -math.inf), max=(math.inf, math.inf), origin=(0, 0), material=-1, mask=1, color=None):
	"""Facets of YADE that make up a surface over x and y: a bed of rock that does not yield, for :class:`MpmContact` and grains; two triangles for each cell of the grid, with their normals upwards::

		O.bodies.append(mpm.facets(lambda x, y: 0.5 * x, spacing=1, min=(0, 0), max=(20, 10), material='rock'))

	They are fixed, and felt from above and below. Grains need ``Bo1_Facet_Aabb`` and ``Ig2_Facet_Sphere_ScGeom`` besides.

	:param surface: heights [m]: the path of an elevation grid, as for :class:`terrain`, a terrain, of which its top is meant, a function of x and y, or an array with one row for each x, from *min* on
	:param spacing: width of the cells [m] > 0; by default that of the grid; needed for a function and an array, of which it is the distance of the heights
	:param min: lower corner (x, y) of the part that is wanted [m], in the coordinates of the file; by default all of it
	:param max: upper corner; both are needed for a function, and *min* for an array
	:param origin: (x, y) in the coordinates of the file [m] that becomes x = y = 0; of a terrain its own is taken
	:param material: label or number of a FrictMat in ``O.materials``, or one itself, as for ``yade.utils.facet``
	:param mask: groupMask of the bodies, by which MpmContact.mask finds them
	:param color: of the bodies, three numbers from 0 to 1; by default grey
	:return: list of bodies, for ``O.bodies.append``
	:raises ImportError: a file of another format than ESRI ASCII, and GDAL is not installed.
	:raises OSError: a file cannot be read.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a file that is no elevation grid, or one in degrees; a part in which heights are not known; a spacing that is missing or not > 0; a label that is not in ``O.materials``.
	"""
	origin, low, high = (_pair('facets', name, value) for name, value in (('origin', origin), ('min', min), ('max', max)))
	if not np.isfinite(origin).all(): raise TypeError(f'facets: origin = {place(origin)} must be finite')
	if isinstance(surface, terrain):
		if origin.any(): raise ValueError(f'facets: origin = {place(origin)}: the terrain has one, {place(surface.origin)}')
		origin, low, high, grid = surface.origin, np.maximum(low, surface.low), np.minimum(high, surface.high), surface._top
	else: grid = heightsOf('facets', 'surface', surface, low, high, spacing)
	low, high = _part('facets', [grid], low, high)
	grid.requireMetres([])
	grid.requireKnown(low, high)
	step = grid.step if spacing is None else _spacing('facets', spacing)
	axes = [np.linspace(low[a], high[a], 1 + int(np.ceil((high[a] - low[a]) / step - 1e-9))) for a in (0, 1)]
	places = np.stack(np.meshgrid(*axes, indexing='ij'), -1)
	corners = np.concatenate([places - origin, grid.at(places.reshape(-1, 2)).reshape(places.shape[:2] + (1, ))], axis=2)
	if isinstance(material, str): _requireLabel(material)
	made = []
	for i, j in np.ndindex(len(axes[0]) - 1, len(axes[1]) - 1):
		a, b, c, d = (Vector3(*corners[i + u, j + v]) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)))
		made += [utils.facet(three, fixed=True, wire=False, material=material, mask=mask, color=color or (0.6, 0.58, 0.55)) for three in ((a, b, c), (a, c, d))]
	return made


def _requireLabel(label):
	from yade import O
	from ..base.naming import didYouMean
	known = [m.label for m in O.materials if m.label]
	if label not in known: raise ValueError(f"facets: material = {brief(label)} is not in O.materials{didYouMean(label, known) or ';'} there are {', '.join(known) or 'none with a label'}")


def heightsOf(who, name, given, low, high, spacing):
	"""The grid of heights that is given by a path, a function or an array, for the function *who*."""
	if callable(given):
		step = _spacing(who, spacing, f'{name} is a function')
		if not (np.isfinite(low).all() and np.isfinite(high).all() and (low < high).all()):
			raise ValueError(f'{who}: {name} is a function, which needs min and max, the corners of the part that is wanted; given are min = {place(low)} and max = {place(high)}')
		cells = np.maximum(1, np.ceil((high - low) / step - 1e-9).astype(int))
		steps = (high - low) / cells
		return Heights(_asked(who, name, given, low, steps, cells + 1), low, steps, f'the function {name}', who)
	if isinstance(given, (np.ndarray, list, tuple)):
		step = _spacing(who, spacing, f'{name} is an array')
		values = numbersIn(given).copy()
		if values.ndim != 2 or np.min(values.shape) < 2: raise TypeError(f'{who}: {name} = {brief(given)} must be an array of heights, at least 2 by 2, with one row for each x')
		if not np.isfinite(low).all(): raise ValueError(f'{who}: {name} is an array, which needs min, the position (x, y) of its first height')
		return Heights(values, low, step, f'the array {name}', who)
	path = pathOf(who, name, given)
	return Heights(*read(path, who), repr(path), who)


def _asked(who, name, function, low, steps, number):
	x, y = (low[a] + steps[a] * np.arange(number[a]) for a in (0, 1))
	try:
		values = np.array([[float(function(float(a), float(b))) for b in y] for a in x])
	except TypeError as error:
		raise TypeError(f'{who}: {name} must be a function of x and y that returns a height [m]: {error}') from None
	wrong = np.argwhere(~np.isfinite(values))
	if len(wrong): raise ValueError(f'{who}: the function {name} returned {values[tuple(wrong[0])]} at {place((x[wrong[0][0]], y[wrong[0][1]]))}; heights must be finite')
	return values


def _spacing(who, value, why=None):
	if value is None: raise ValueError(f'{who}: {why}, which needs spacing, the distance of its heights [m]')
	if not isNumber(value): raise TypeError(f'{who}: spacing = {brief(value)} must be a number > 0 [m]')
	if not (math.isfinite(value) and value > 0): raise ValueError(f'{who}: spacing = {brief(value)} must be finite and > 0 [m]')
	return float(value)


def _part(who, grids, low, high):
	"""Corners of what is wanted of all grids."""
	first, last = np.max([low] + [g.low for g in grids], axis=0), np.min([high] + [g.high for g in grids], axis=0)
	if not (first < last).all():
		raise ValueError(f'{who}: nothing of {grids[0].name}, which reaches from {place(grids[0].low)} to {place(grids[0].high)}, is between min = {place(low)} and max = {place(high)}')
	return first, last


# Limits of the median slope, and of the thickness over the width, of a terrain in metres: beyond, coordinates are degrees.
_steepest, _thickest = 5, 50


class Heights:
	"""Heights on a lattice."""

	def __init__(self, values, low, step, name, who):
		self.values, self.low, self.name, self.who = values, np.array(low, float), name, who  # [x, y]
		self.steps = np.broadcast_to(np.array(step, float), 2)
		self.step = float(self.steps.max())
		self.high = self.low + self.steps * (np.array(values.shape) - 1)

	def requireMetres(self, bottom):
		"""ValueError if the grid is one in degrees of longitude and latitude: ground would be some hundred thousand times as steep as it is."""
		low, high = self.low - self.steps / 2, self.high + self.steps / 2
		if not ((-180 <= low[0]) & (high[0] <= 360) & (-90 <= low[1]) & (high[1] <= 90)): return
		known = self.values[np.isfinite(self.values)]
		slopes = [np.abs(np.diff(self.values, axis=axis)) / self.steps[axis] for axis in (0, 1)]
		slopes = np.concatenate([s[np.isfinite(s)] for s in slopes])
		steep = np.median(slopes) if slopes.size else 0
		thick = np.ptp(np.append(known, bottom)) / (high - low).max()
		if not (steep > _steepest or thick > _thickest): return
		longitude, latitude = (low + high) / 2
		metres = 111.2e3 * np.array([math.cos(math.radians(latitude)), 1])
		zone = int((longitude + 180) % 360 // 6) + 1
		raise ValueError(
		        f'{self.who}: {self.name} is {high[0] - low[0]:.3g} wide, {high[1] - low[1]:.3g} long and {np.ptp(known):.3g} m high, around ({longitude:.6g}, {latitude:.6g}): are these degrees of '
		        f'longitude and latitude? One degree is {metres[0] / 1e3:.4g} km along x and {metres[1] / 1e3:.4g} km along y there, so that its cells of {self.step:.3g} would be '
		        f'{self.step * metres[0]:.3g} m by {self.step * metres[1]:.3g} m. Have a GIS project it to metres, as by gdalwarp -t_srs EPSG:{(32600 if latitude >= 0 else 32700) + zone} (UTM zone {zone}), and '
		        'give mpm.' + self.who + ' an origin near it.'
		)

	def requireKnown(self, low, high):
		first = self._cells(low[None])[0]
		last = np.ceil((high - self.low) / self.steps - 1e-9).astype(int)
		part = self.values[first[0]:last[0] + 1, first[1]:last[1] + 1]
		unknown = np.argwhere(~np.isfinite(part))
		if len(unknown):
			x = self.low + self.steps * (unknown[0] + first)
			raise ValueError(
			        f'{self.who}: {self.name} has no height at {place(x)}, nor at {len(unknown) - 1} more of {part.size} points in the part that is wanted; '
			        'fill the holes, or choose a part without by min and max'
			)
		self.values = np.nan_to_num(self.values)  # elsewhere heights have no weight

	def placesIn(self, low, high):
		"""(N, 2) positions between which heights in a box are bilinear, its edges included."""
		axes = []
		for a in (0, 1):
			lattice = self.low[a] + self.steps[a] * np.arange(self.values.shape[a])
			axes.append(np.concatenate([[low[a]], lattice[(lattice > low[a]) & (lattice < high[a])], [high[a]]]))
		return np.stack(np.meshgrid(*axes, indexing='ij'), -1).reshape(-1, 2)

	def _cells(self, places):
		return np.clip(np.floor((places - self.low) / self.steps).astype(int), 0, np.array(self.values.shape) - 2)

	def at(self, places):
		"""(N,) heights at positions (N, 2) on the lattice."""
		i, j = self._cells(places).T
		u, v = ((places - self.low) / self.steps).T - (i, j)
		z = self.values
		return (1 - u) * ((1 - v) * z[i, j] + v * z[i, j + 1]) + u * ((1 - v) * z[i + 1, j] + v * z[i + 1, j + 1])


def _pair(who, name, value):
	numbers = numbersIn(value)
	if numbers.shape != (2, ) or np.isnan(numbers).any(): raise TypeError(f'{who}: {name} = {brief(value)} must be two numbers, x and y')
	return numbers
