# SPDX-License-Identifier: GPL-2.0-or-later
"""Steady flow of water through soil that stands still, with a free surface."""
import math

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber, place
from ..base.solver import noPoints, solverOf
from ..points.data import pointsOf
from ..points.water import conductivities

_dry = 1e-3  # conductivity of dry soil over that of wet soil
_transition = 0.5  # depth of the zone between the two, half of it above the free surface [cells]
_skin = 1e3  # conductance of the faces, over conductivity and cell size
_mostSteps = 200
_corners = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])  # nodes of a cell


def seepage(levels, faces=(), solver=None, unitWeight=9810.):
	"""Steady flow of water through the body of an engine in the plane: the free surface, where water comes out, how much, and the pressures, which an ``MpmWater`` takes::

		flow = mpm.seepage([(upstream, 8), (downstream, 1)], faces=[toe])
		solver.water = [MpmWater(pressure=flow.pressure)]
		print(flow.discharge)

	Beams of the engine (``MpmBeam``) are walls for the water, tight or leaky by their *permittivity*, where they have been put in, down to the line of the grid that is nearest to their tip.

	Darcy's law with the *conductivity* of the materials, also along and across layers, or that of points' own, on the grid of the engine, whose cells the body may cut. Above the free surface the soil conducts a thousandth of
	that, with a transition of half a cell; pressures below zero are none. Nothing moves: consolidation is ``MpmImplicitEngine.flow``.

	:param levels: pairs of a surface of the body (``MpmSurface``, or points) and the height [m] up to which water stands before it; above that height water may come out
	:param faces: surfaces by which water may come out, and none gets in; elsewhere nothing passes
	:param solver: ``MpmImplicitEngine`` whose grid and points are meant; needed if there are several
	:param unitWeight: weight of water by volume [N/m³] > 0
	:return: object with *pressure* (function of the position [Pa]), *discharge* (of each of *levels* and then *faces*: what leaves, [m³/s] per metre of thickness),
		*surface* ((N, 2) points of the free surface), *nodes* (N, 2) and *pressures* (N,), negative above it
	:raises TypeError: *levels* are no pairs of a surface and a number.
	:raises ValueError: a value that is not admitted, a grid that is not in the plane, materials without conductivity, or a surface that is not on the body.
	:raises RuntimeError: the free surface is not found.
	"""
	solver = solverOf('seepage', solver)
	points, materials, number = pointsOf(solver)
	if not len(points['id']): raise ValueError(noPoints('seepage', solver))
	_requirePlane(solver, unitWeight)
	found = conductivities('seepage', points, materials, number)
	walls = [load for load in solver.loads if isinstance(load, wrapper.MpmBeam) and load.permittivity < math.inf]
	body = _Body(solver.grid, points, found / unitWeight, unitWeight, walls)
	outlets = [_Outlet(body, f'levels[{i}]', *_pair(i, pair)) for i, pair in enumerate(levels)]
	outlets += [_Outlet(body, f'faces[{i}]', _surface(f'faces[{i}]', face), -math.inf) for i, face in enumerate(faces)]
	if not levels: raise ValueError('seepage: levels = () has no surface where water stands: give pairs of a surface and a height')
	return SteadySeepage(body, outlets, _solve(body, outlets, max(level for _, level in levels)))


class SteadySeepage:
	"""Result of :func:`seepage`."""

	def __init__(self, body, outlets, p):
		self._body = body
		self._known = {tuple(node): max(0., value) for node, value in zip(body.nodes.tolist(), p)}
		self.nodes, self.pressures = body.origin + body.h * body.nodes[:, :2], p
		self.discharge = [float(outlet.passes(p).sum()) for outlet in outlets]
		self.surface = self._freeSurface(p)

	def pressure(self, x):
		"""At a position [Pa]; zero above the free surface and beside the body."""
		xi = (np.array([x[0], x[1]]) - self._body.origin) / self._body.h
		cell = np.floor(xi + 1e-9)
		part = np.clip(xi - cell, 0, 1)
		nodes = self._body.copies(np.array([xi]), (cell + _corners).astype(int)[None])[0].tolist()
		values = (self._known.get(tuple(node), self._known.get((*node[:2], 0), 0.)) for node in nodes)
		return sum(abs(1 - i - part[0]) * abs(1 - j - part[1]) * value for (i, j), value in zip(_corners.tolist(), values))

	def _freeSurface(self, p):
		"""On each vertical line of the grid, from the highest node under pressure upwards."""
		found, values = [], {tuple(node): value for node, value in zip(self._body.nodes.tolist(), p)}
		for (i, j, copy), value in sorted(values.items()):
			above = values.get((i, j + 1, copy), values.get((i, j + 1, 0)))
			if value > 0 and above is not None and above <= 0: found.append((i, j + value / (value - above)))
		return self._body.origin + self._body.h * np.array(found).reshape(-1, 2)


def _requirePlane(solver, unitWeight):
	if solver.grid.dim != 2 or solver.grid.axisymmetric or any(solver.grid.period) or solver.grid.refinements or solver.grid.adaptation:
		raise ValueError('seepage: the grid must be one of plane strain (dim=2), without a period, an axis of symmetry, refinements or adaptation')
	gravity = solver.gravity
	if gravity[0] != 0 or gravity[1] > 0: raise ValueError(f'seepage: gravity = {place(gravity)} must act downwards, against y')
	if not isNumber(unitWeight) or not 0 < unitWeight < math.inf: raise ValueError(f'seepage: unitWeight = {brief(unitWeight)} must be a number > 0 [N/m3]')


def _pair(i, pair):
	try:
		surface, level = pair
	except (TypeError, ValueError):
		surface, level = None, None
	if not isNumber(level) or not math.isfinite(level): raise TypeError(f'seepage: levels[{i}] = {brief(pair)} must be a pair of a surface and a height [m]')
	return _surface(f'levels[{i}]', surface), level


def _surface(name, given):
	"""(N, 2, 2) segments, which have the body on their left."""
	if isinstance(given, wrapper.MpmSurface): return np.array([[given.vertices[v][:2] for v in piece] for piece in given.pieces], float)
	try:
		points = np.array([[float(x) for x in point][:2] for point in given])
	except (TypeError, ValueError):
		points = np.empty((0, 2))
	if len(points) < 2 or points.shape[1] != 2 or not np.isfinite(points).all(): raise TypeError(f'seepage: the surface of {name} = {brief(given)} must be an MpmSurface or two or more points')
	return np.stack([points[:-1], points[1:]], axis=1)


def _pointsAlong(ends):
	"""(point, length that it stands for, direction to the left) of two points of Gauss in each cell along a straight line between two ends, all counted in cells."""
	start, way = ends[0], ends[1] - ends[0]
	length = np.linalg.norm(way)
	if not length > 0: return
	lines = [(line - start[a]) / way[a] for a in (0, 1) if abs(way[a]) > 1e-12 * length for line in range(math.floor(min(start[a], start[a] + way[a])), math.ceil(max(start[a], start[a] + way[a])) + 1)]
	cuts = np.unique(np.clip([0, 1, *lines], 0, 1))
	for first, last in zip(cuts, cuts[1:]):
		for part in 0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3):
			yield start + (first + part * (last - first)) * way, (last - first) * length / 2, np.array([-way[1], way[0]]) / length


def _functions(xi):
	"""Values (N, 4) and gradients (N, 4, 2) by cells of the functions of a cell, at points (N, 2) in it."""
	value = np.stack([1 - xi, xi], axis=1)  # (N, 2, 2): end, axis
	values = np.stack([value[:, i, 0] * value[:, j, 1] for i, j in _corners], axis=1)
	slopes = np.stack([np.stack([(2 * i - 1) * value[:, j, 1], (2 * j - 1) * value[:, i, 0]], axis=1) for i, j in _corners], axis=1)
	return values, slopes


class _Body:
	"""Domains of the points, cut at the lines of the grid: the middle of each part stands for it, which is exact for linear pressures at any cut."""

	def __init__(self, grid, points, kappa, weight, beams=()):
		self.h, self.origin, self.weight = grid.cellSize, np.array(grid.origin)[:2], weight
		low, high = ((points['pos'][:, :2] + sign * points['halfSize'][:, :2] - self.origin) / self.h for sign in (-1, 1))
		line = np.clip(np.round((low + high) / 2), low, high)
		parts = []
		for ends in _corners:
			first = np.where(ends, line, low)
			last = np.where(ends, high, line)
			isThere = ((last - first) > 1e-7 * (high - low)).all(axis=1)
			parts.append((((first + last) / 2)[isThere], (last - first).prod(axis=1)[isThere], kappa[isThere]))
		middle, volume, self.kappa = (np.concatenate(column) for column in zip(*parts))
		cell = np.floor(middle).astype(int)
		corners = cell[:, None, :] + _corners
		self.cells = dict(zip(map(tuple, cell.tolist()), self.kappa))  # horizontal and vertical
		self.walls = [_Wall(number, beam, self) for number, beam in enumerate(beams)]
		self.nodes, number = np.unique(self.copies(middle, corners).reshape(-1, 3), axis=0, return_inverse=True)
		self.node = number.reshape(-1, 4)
		self.values, slopes = _functions(middle - cell)
		self.slopes, self.volume = slopes / self.h, volume * self.h**2
		self.numbers = {tuple(node): i for i, node in enumerate(self.nodes.tolist())}
		self.leaks = [_Leak(self, wall) for wall in self.walls if wall.permittivity > 0]
		self.heights = self.origin[1] + self.h * self.nodes[:, 1]

	def copies(self, places, corners):
		"""(N, 4, 3): the nodes (N, 4, 2) of cells as seen from places (N, 2) in them, with the number of their copy behind a wall, 0 for the node itself."""
		copy = np.zeros(corners.shape[:2], int)
		for wall in self.walls: copy = np.maximum(copy, wall.copies(places, corners))
		return np.concatenate([corners, copy[:, :, None]], axis=2)

	def numbersOf(self, places, corners):
		"""Numbers (N, 4) of these nodes; None if there is a cell that has none."""
		four = self.copies(places, corners).reshape(-1, 3).tolist()
		found = [self.numbers.get(tuple(node), self.numbers.get((*node[:2], 0))) for node in four]
		return None if None in found else np.array(found).reshape(-1, 4)

	def cellBehind(self, place, inwards):
		"""The first cell with points from a place [cells] inwards, as points may fall short of a slope; None if there is none within a whole one."""
		ways = np.floor(place + np.outer((1e-4, .25, .5, .75, 1), inwards)).astype(int)
		return next((cell for cell in map(tuple, ways.tolist()) if cell in self.cells), None)

	def wetness(self, p):
		"""Conductivity of each part over that of wet soil."""
		return np.clip(.5 + (self.values * p[self.node]).sum(axis=1) / (self.weight * _transition * self.h), _dry, 1)


class _Wall:
	"""A beam that water does not pass, or leaks through: cells that it cuts have nodes on each side of it (Hansbo and Hansbo 2004). All is counted in cells."""

	def __init__(self, number, beam, body):
		self.number, self.permittivity = number, beam.permittivity
		self.line = (np.array([point[:2] for point in beam.line], float) - body.origin) / body.h
		self.shared = set()  # nodes at the tips, around which soil is one body
		if not (self.line[0] == self.line[-1]).all():
			for end, before in (0, 1), (-1, -2): self._end(body, end, before)

	def _end(self, body, end, before):
		"""A tip ends at the line of the grid that is nearest to it; another end goes on out of the cells around it."""
		last, way = self.line[end].copy(), self.line[end] - self.line[before]
		length = np.linalg.norm(way)
		way /= length
		if tuple(np.floor(last + .5 * way + 1e-9 * way[::-1]).astype(int).tolist()) not in body.cells and tuple(np.floor(last + .5 * way - 1e-9 * way[::-1]).astype(int).tolist()) not in body.cells:
			self.line[end] = last + 1.5 * way
			return
		cuts = [(line - last[a]) / way[a] for a in (0, 1) if abs(way[a]) > 1e-9 for line in (np.floor(last[a]), np.floor(last[a]) + 1, np.floor(last[a]) - 1)]
		tip = last + min((cut for cut in cuts if cut > -length), key=abs) * way
		self.line[end] = tip
		low, high = np.floor(tip + 1e-6).astype(int), np.ceil(tip - 1e-6).astype(int)
		self.shared |= {(i, j) for i in (low[0], high[0]) for j in (low[1], high[1])}

	def copies(self, places, corners):
		"""(N, 4): number of the copy of nodes that are behind the wall as seen from points; a node on the wall is to its right."""
		copy = np.zeros(corners.shape[:2], int)
		low, high = self.line.min(axis=0) - 2, self.line.max(axis=0) + 2
		near = np.flatnonzero(((places >= low) & (places <= high)).all(axis=1))
		for start, end in zip(self.line, self.line[1:]):
			way = end - start
			right = np.array([way[1], -way[0]]) / np.linalg.norm(way)
			at, node = places[near][:, None, :] - start, corners[near] + 1e-7 * right - start
			side, other = (way[0] * x[..., 1] - way[1] * x[..., 0] for x in (at, node))
			with np.errstate(divide='ignore', invalid='ignore'):
				cross = at + (side / (side - other))[..., None] * (node - at)
				part = cross @ way / (way @ way)
			isBehind = (side * other < 0) & (part >= 0) & (part <= 1)
			copy[near] = np.where(isBehind, 1 + 2 * self.number + (side < 0), copy[near])
		for n in np.argwhere(copy > 0) if self.shared else ():
			if tuple(corners[tuple(n)].tolist()) in self.shared: copy[tuple(n)] = 0
		return copy


class _Leak:
	"""Flow through a wall between soil on both of its sides: *permittivity* times the difference of heads."""

	def __init__(self, body, wall):
		nodes, values, self.conductance = [], [], []
		for x, length, left in (point for ends in zip(wall.line, wall.line[1:]) for point in _pointsAlong(ends)):
			sides = [x + sign * 1e-6 * left for sign in (1, -1)]
			cells = [np.floor(at).astype(int) for at in sides]
			if any(tuple(cell.tolist()) not in body.cells for cell in cells): continue
			found = [body.numbersOf(np.array([at]), (cell + _corners)[None]) for at, cell in zip(sides, cells)]
			if any(node is None for node in found): continue
			nodes.append(np.concatenate([node[0] for node in found]))
			values.append(np.concatenate([sign * _functions(np.array([at - cell]))[0][0] for sign, at, cell in zip((1, -1), sides, cells)]))
			self.conductance.append(wall.permittivity / body.weight * length * body.h)
		self.node, self.values, self.conductance = np.array(nodes, int).reshape(-1, 8), np.array(values).reshape(-1, 8), np.array(self.conductance)


class _Outlet:
	"""A face, at points that are exact for what is linear in the cells. Below *level* there is the pressure of the water before it, above water may come out."""

	def __init__(self, body, name, segments, level):
		found = [point for segment in segments for point in _pointsAlong((segment - body.origin) / body.h)]
		x, length, inwards = (np.array(column) for column in zip(*found))
		self.x, self.length = body.origin + body.h * x, body.h * length
		cells = [body.cellBehind(*at) for at in zip(x, inwards)]
		missing = [i for i, c in enumerate(cells) if c is None]
		if missing: raise ValueError(f'seepage: the surface of {name} is not on the body at {place(self.x[missing[0]])}, which must be on the left of its points')
		cell = np.array(cells)
		self.values = _functions(x - cell)[0]
		self.node = body.numbersOf(x + 1e-3 * inwards, cell[:, None, :] + _corners)
		self.given = body.weight * np.maximum(0, level - self.x[:, 1])
		self.mayEnter = self.x[:, 1] <= level + 1e-9 * body.h
		normal = (np.array([body.cells[tuple(c)] for c in cell.tolist()]) * inwards**2).sum(axis=1)
		self.skin = _skin / body.h * normal * self.length

	def pressure(self, p):
		return (self.values * p[self.node]).sum(axis=1)

	def conducts(self, p):
		return np.where(self.mayEnter | (self.pressure(p) > 0), self.skin, 0)

	def passes(self, p):
		return self.conducts(p) * (self.pressure(p) - self.given)


def _solve(body, outlets, highest):
	"""Pressures of the nodes: conductivities and open faces of the last iterate, until they stay."""
	p = body.weight * (highest - body.heights)
	wetness = np.ones(len(body.volume))
	size = body.weight * max(np.ptp(body.heights), body.h)
	for step in range(_mostSteps):
		new = _pressures(body, outlets, p, wetness)
		change = abs(new - p).max()
		p = new
		now = body.wetness(p)
		if step > 3 and change < 1e-6 * size and abs(now - wetness).max() < 1e-3: return p
		wetness += (0.5 if step < 60 else 0.2) * (now - wetness)
	raise RuntimeError(f'seepage: the free surface is not found in {_mostSteps} steps: pressures still change by {change:.3g} Pa. Are the cells too large for the body, or its materials too different?')


def _pressures(body, outlets, p, wetness):
	"""Solution of the equations of one iterate, by conjugate gradients from its pressures on. Their matrix is singular where a part of the soil has no outlet."""
	from scipy.sparse import coo_matrix
	flow, skins, count = (wetness * body.volume)[:, None] * body.kappa, [outlet.conducts(p) for outlet in outlets], len(p)
	ofValues = lambda weight, values: weight[:, None, None] * values[:, :, None] * values[:, None, :]
	terms = [(body.node, np.einsum('pi,pai,pbi->pab', flow, body.slopes, body.slopes))]
	terms += [(outlet.node, ofValues(skin, outlet.values)) for outlet, skin in zip(outlets, skins)] + [(leak.node, ofValues(leak.conductance, leak.values)) for leak in body.leaks]
	entries, rows, columns = (np.concatenate(parts) for parts in zip(*((x.ravel(), np.repeat(node, node.shape[1]), np.tile(node, node.shape[1]).ravel()) for node, x in terms)))
	matrix = coo_matrix((entries, (rows, columns)), (count, count)).tocsr()
	right = np.bincount(body.node.ravel(), (-body.weight * flow[:, 1:] * body.slopes[:, :, 1]).ravel(), count)
	for outlet, skin in zip(outlets, skins): right += np.bincount(outlet.node.ravel(), ((skin * outlet.given)[:, None] * outlet.values).ravel(), count)
	scale = 1 / matrix.diagonal()
	r = right - matrix @ p
	direction = scale * r
	size, enough = r @ direction, 1e-20 * (right @ (scale * right))
	for _ in range(20 * count):
		if size <= enough: break
		across = matrix @ direction
		length = size / (direction @ across)
		p, r = p + length * direction, r - length * across
		size, before = r @ (scale * r), size
		direction = scale * r + size / before * direction
	return p
