# SPDX-License-Identifier: GPL-2.0-or-later
"""Filling regions with material points."""
import math
import operator

import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3

from ..base import processes
from ..base.messages import brief, place
from ..base.naming import didYouMean, materialOf
from ..base.processes import together
from ..geometry.regions import bounds, each, inside, requireRightWay, volumeInBoxes
from ..library import engine
from .bodies import bodyNumber
from .data import isParameter, ofPositions, table

_bytesOfBody = 1400  # bytes of a material point, its state and its shape


def fill(predicate, grid, pointsPerCell, material, body=None, **parameters):
	"""Fill a region with material points, equally spaced in the cells of a grid.

	Cells are counted from ``grid.origin``; the points are returned cell by cell, with ``grid.refinements`` first those of the largest cells. In two dimensions they lie in the plane
	z = ``grid.origin[2]`` and stand for 1 m of thickness, or with ``axisymmetric`` for a whole ring around the axis x = 0, of the volume 2 pi x times its section.

	Each point stands for a box of ``cellSize / pointsPerCell``, in cells that are halved for a smaller one. Where these boxes have another volume than the region, by more than 2 %, as in layers that
	are thin or oblique, a warning in YADE's log says so. (Of combined and round regions the volume is estimated.) Layers within the
	region, given by *material*, are not looked at.

	:param predicate: the region [m]: :class:`polygon` or any bounded predicate of ``yade.pack``, also a combination of them
	:param grid: the ``MpmGrid`` of the analysis
	:param pointsPerCell: points per cell and axis, at least 1; points whose centre is inside the region are kept
	:param material: label of a material in ``O.materials``; or a list of (predicate, label), of which the first that
		contains the point applies; or a function that takes the position and returns a label
	:param body: name of the body of points that they belong to, which may be in contact with others (``MpmBodyContact``), as 'slab'; None: one without a name. It is put into ``grid.bodies``, with the surface of the
		region; regions that are filled with the same name are one body, whose surface has no part where they have faces in common
	:param parameters: strengths and moduli of the materials that differ from point to point, by the names of their attributes, as
		``cohesion=lambda x: 2e3 + 500 * (10 - x[1])``: each a function of the position that returns a number, or an array (N,) in the order in which the points
		are returned; see :func:`assign`
	:return: list of bodies for ``O.bodies.append``. Each has an ``MpmPoint`` shape, the state that belongs to its material,
		mass and initial volume of its share of the cell, and is invisible to YADE's collider and integrator.
	:raises TypeError: an argument of the wrong kind, or a name that is no strength or modulus.
	:raises ValueError: a value that is not admitted, a parameter that the material of a point does not have, no point inside the region, or a point without material.
	:raises KeyError: a label that is not in ``O.materials``.

	A label that several materials have, an empty one, a closed surface of triangles that is inside out, and points that the grid cannot number are refused, too (ValueError).
	"""
	try:
		return engine.newBodies(grid, *_points(predicate, grid, pointsPerCell, material, parameters), bodyNumber('fill', body, predicate, grid))
	except ValueError as error:
		raise ValueError(f'fill: {str(error).removeprefix("fill: ")}') from None


def add(predicate, solver, pointsPerCell, material, body=None, **parameters):
	"""Fill a region with material points and put them into the scene, as ``O.bodies.append(fill(predicate, solver.grid, ...))`` does, without what that leaves behind in memory.

	Where several processes divide the points (``MpmImplicitEngine.distributed``) each makes its own only, under the ids that they have in one process; ``O.bodies`` has gaps for those of the others. So
	no process ever has all. The solver comes first, with what it says of the points::

		solver = MpmImplicitEngine(grid=grid, distributed=True, ...)
		O.engines = [solver]
		mpm.add(profile, solver, pointsPerCell=2, material='soil')

	Also between steps; points that have been appended before are divided, too.

	:param predicate: the region [m], as of :func:`fill`
	:param solver: the ``MpmImplicitEngine``, which is in ``O.engines``; the points are those of its *grid*
	:param pointsPerCell: as of :func:`fill`
	:param material: as of :func:`fill`
	:param body: as of :func:`fill`
	:param parameters: as of :func:`fill`
	:return: range of the ids of all new bodies, which :func:`assign` takes
	:raises TypeError, KeyError: as of :func:`fill`.
	:raises ValueError: as of :func:`fill`; the solver is not in ``O.engines``, or, where the points are to be divided, has what does not go with it.
	:raises RuntimeError: a load step is at work in the background, or the processes do not add the same.
	"""
	if not isinstance(solver, wrapper.MpmImplicitEngine): raise TypeError(f'add: solver = {brief(solver)} must be an MpmImplicitEngine')
	if solver not in wrapper.Omega().engines:
		raise ValueError('add: the solver is not in O.engines, which must tell who has which points from the first one on; put it there before: O.engines = [solver]')
	try:
		points = together(lambda: _points(predicate, solver.grid, pointsPerCell, material, parameters))
		first = engine.addPoints(solver, *points, bodyNumber('add', body, predicate, solver.grid))
	except (KeyError, TypeError, ValueError) as error:
		raise type(error)('add: ' + str(error.args[0]).removeprefix('fill: ')) from None
	return range(first, len(wrapper.Omega().bodies))


def _points(predicate, grid, pointsPerCell, material, parameters):
	"""Columns of the points as the library takes them: positions (N, 3), half sizes (N,), materials, the place of each point's among these (N,), and a dict of parameters (N,)."""
	if not isinstance(grid, wrapper.MpmGrid):
		raise TypeError(f'fill: grid = {brief(grid)} must be an MpmGrid')
	grid.updateAttrs(grid.dict())  # looks again at all values: cellSize may not have been given
	n = _pointsPerCell(pointsPerCell)
	positions, sizes = _latticePoints(predicate, grid, n)
	if grid.axisymmetric and positions[:, 0].min() < 0:
		raise ValueError(
		        f'fill: the region reaches to x = {positions[:, 0].min():g} m; with MpmGrid.axisymmetric x is the distance from the axis: fill one half of the section, '
		        'at x > 0'
		)
	_warnOfVolume(predicate, grid, n, sizes)
	labels, index = _materialOf(positions, material)
	materials = [_material(label) for label in labels]
	return positions, sizes / (2 * n), materials, index, {name: _parameter(name, value, positions) for name, value in parameters.items()}


def _parameter(name, value, positions):
	known = [column for column in table if isParameter(column)]
	if name not in known: raise TypeError(f"fill: {name} is no strength or modulus that differs from point to point{didYouMean(name, known) or ';'} there are {', '.join(known)}")
	try:
		column = np.ascontiguousarray(ofPositions('fill', name, value, positions), dtype=float)
	except ValueError:
		column = np.empty(())
	if column.shape == (len(positions), ): return column
	raise ValueError(f'fill: {name} = {brief(value)} must be a function of the position, or an array of {len(positions)} numbers, one for each point')


def _pointsPerCell(value):
	try:
		n = operator.index(value)
	except TypeError:
		raise TypeError(f'fill: pointsPerCell = {brief(value)} must be an integer') from None
	if isinstance(value, bool):
		raise TypeError(f'fill: pointsPerCell = {brief(value)} must be an integer')
	if n < 1:
		raise ValueError(f'fill: pointsPerCell = {brief(value)} must be at least 1 (points per cell and axis)')
	return n


def _latticePoints(predicate, grid, n):
	"""(N, 3) centres inside the predicate of the n^dim points in each cell, cell by cell, and (N,) sizes of the cells, from large to small."""
	cells = [np.arange(a, b) for a, b in zip(*_cellRange(predicate, grid, n))]
	candidates = math.prod(len(c) * n for c in cells)
	# in slabs across the last axis, which bounds the memory of the points that are rejected
	slabs = np.array_split(cells[-1], candidates // 2**20 + 1)
	kept, room = {}, _room()
	for slab in slabs:
		points = _cellPoints(cells[:-1] + [slab], grid, n)
		for size, own in _ofLeaves(points, grid, n):
			for part, within in _alongSurface(predicate, own, size, grid, n):
				kept.setdefault(part, []).append(within)
		_requireRoom(sum(len(own) for parts in kept.values() for own in parts), room, grid, n)
	bySize = {size: np.concatenate(kept[size]) for size in sorted(kept, reverse=True)}
	positions, sizes = np.concatenate(list(bySize.values())), np.repeat(list(bySize), [len(own) for own in bySize.values()])
	if not len(positions):
		plane = f' in the plane z = {grid.origin[2]}' if grid.dim == 2 else ''
		raise ValueError(f'fill: no point of the lattice with spacing {grid.cellSize / n} m{plane} is inside the predicate, whose box reaches '
		                 f'from {_text(predicate.aabb()[0])} to {_text(predicate.aabb()[1])}; is the region smaller than that, or does it miss the plane?')
	return positions, sizes


def _room():
	"""Memory that is free [bytes]; inf where the system does not tell."""
	try:
		with open('/proc/meminfo', encoding='ascii') as file:
			return 1024 * next(int(line.split()[1]) for line in file if line.startswith('MemAvailable'))
	except (OSError, StopIteration, ValueError):
		return math.inf


def _requireRoom(count, room, grid, n):
	"""Before bodies are made that memory has no room for."""
	if count * _bytesOfBody <= room * processes.count: return
	raise ValueError(
	        f'fill: cellSize = {grid.cellSize:g} m with pointsPerCell = {n} makes {count:.3g} or more material points, which need {count * _bytesOfBody / 2**30:.3g} GiB of memory before the first step, and '
	        f'{room / 2**30:.3g} GiB are free: take larger cells, or a smaller region'
	)


def _ofLeaves(points, grid, n):
	"""Points of cells of the grid, as pairs of the size of a cell and the points in cells of that size: where cells are halved there are more of them."""
	size = grid.cellSize
	if not grid.refinements:
		yield size, points
		return
	while len(points):
		cells = points.reshape(-1, n**grid.dim, 3)
		centres = cells.mean(axis=1)
		whole = np.frombuffer(engine.cellSizes(grid, np.ascontiguousarray(centres))) > 0.75 * size
		yield size, cells[whole].reshape(-1, 3)
		points, size = _halved(centres[~whole], size, grid, n), size / 2


def _alongSurface(predicate, points, size, grid, n):
	"""Points of cells of one size that are inside the predicate, as pairs of the size of a cell and the points. Where cells are going to be halved by the error or a function, those that the surface cuts have the points of smaller cells, so that it stays where it is."""
	count = n**grid.dim
	for _ in range(max((rule.halvings for rule in grid.adaptation if rule.where != 'contact'), default=0)):
		cells = points.reshape(-1, count, 3)
		halves = _halved(cells.mean(axis=1), size, grid, n).reshape(len(cells), count * 2**grid.dim, 3)
		within = inside(predicate, halves.reshape(-1, 3)).reshape(halves.shape[:2])
		whole = within.all(axis=1)
		yield size, cells[whole].reshape(-1, 3)
		points, size = halves[within.any(axis=1) & ~whole].reshape(-1, 3), size / 2
	yield size, points[inside(predicate, points)]


def _halved(centres, size, grid, n):
	"""(N, 3) points in the halves of cells of this size, given by their centres."""
	dim = grid.dim
	corners = np.stack(np.meshgrid(*[np.arange(2 * n)] * dim, indexing='ij'), axis=-1).reshape([2, n] * dim + [dim])
	order = [2 * a for a in range(dim)] + [2 * a + 1 for a in range(dim)] + [2 * dim]
	offsets = np.zeros((len(corners.reshape(-1, dim)), 3))
	offsets[:, :dim] = (corners.transpose(order).reshape(-1, dim)[:, ::-1] + 0.5) / (2 * n) - 0.5
	return (centres[:, None, :] + size * offsets).reshape(-1, 3)


def _warnOfVolume(predicate, grid, n, sizes):
	admitted = 0.02  # part of the region
	filled = len(sizes) if sizes[0] == sizes[-1] == grid.cellSize else ((sizes / grid.cellSize)**grid.dim).sum()
	volume = volumeInBoxes(predicate, grid, n, filled, admitted)
	if abs(volume - filled) <= admitted * volume: return
	engine.warn(
	        f'fill: the region has {volume / filled:.3g} times the volume for which the {len(sizes)} points in it stand. It is thin, or its edges cut through '
	        f'the boxes of {grid.cellSize / n:g} m that belong to the points. More points per cell help, smaller cells, and edges at multiples of '
	        'cellSize / pointsPerCell.'
	)


def _meant(predicate):
	"""Hint at an argument that could have been meant instead."""
	if isinstance(predicate, type): return '; this is a class, of which one is made as in pack.inAlignedBox(low, high)'
	first = predicate[0] if isinstance(predicate, (list, tuple)) and predicate else None
	if isinstance(first, wrapper.Body) or type(predicate).__module__ == 'gts':
		return '; for the inside of a closed surface that is pack.inGtsSurface(surface), with a gts.Surface as gts.read(open(file)) gives it'
	if isinstance(first, (list, tuple)) or isinstance(predicate, np.ndarray): return '; for these corners that is mpm.polygon([(x, y), ...])'
	return ', such as pack.inAlignedBox(low, high)'


def _text(corner):
	return f"({', '.join(f'{x:g}' for x in corner)})"


def _cellRange(predicate, grid, n):
	"""First cell and one past the last cell of each axis that may have points inside the predicate."""
	if isinstance(predicate, type) or not callable(predicate) or not callable(getattr(predicate, 'aabb', None)):
		raise TypeError(f'fill: predicate = {brief(predicate)} must be an mpm.polygon or a predicate of yade.pack{_meant(predicate)}')
	requireRightWay('fill', predicate)
	low, high = bounds(predicate, grid.dim)
	if not np.isfinite([low, high]).all():
		raise ValueError(f'fill: predicate = {brief(predicate)} has no bounds (its box reaches from {place(low)} to {place(high)}); '
		                 'intersect it with a bounded one, such as pack.inAlignedBox: predicate & pack.inAlignedBox(low, high)')
	origin = np.array([grid.origin[i] for i in range(grid.dim)])
	# one spare cell on each side: the predicate decides, not the round-off of its box
	first, last = np.floor((low - origin) / grid.cellSize) - 1, np.ceil((high - origin) / grid.cellSize) + 1
	candidates = np.prod((last - first) * n)
	if candidates > 2**31:
		raise ValueError(f'fill: {candidates:.3g} points would have to be tested, more than YADE can number: cellSize = {grid.cellSize} m or '
		                 f'pointsPerCell = {n} per axis do not suit a region from {place(low)} to {place(high)}')
	return first.astype(np.int64), last.astype(np.int64)


def _cellPoints(cells, grid, n):
	"""(N, 3) centres of the n^dim points in each cell of a block, given by its cell numbers per axis."""
	dim = grid.dim
	shape = [len(c) for c in reversed(cells)] + [n] * dim
	points = np.full(shape + [3], grid.origin[2])
	for axis, numbers in enumerate(cells):
		# h (2k + 1) / 2n with integer k: exactly odd about the origin, so a symmetric scene is symmetric to the
		# last bit
		odd = 2 * (n * numbers[:, None] + np.arange(n)) + 1
		along = [1] * (2 * dim)
		along[dim - 1 - axis], along[2 * dim - 1 - axis] = odd.shape
		points[..., axis] = (grid.origin[axis] + grid.cellSize * odd / (2 * n)).reshape(along)
	return points.reshape(-1, 3)


def _materialOf(positions, material):
	"""Labels in use, and for each point the index of its label."""
	if isinstance(material, str):
		return [material], np.zeros(len(positions), dtype=np.int64)
	if callable(material):
		return _labelsFromFunction(positions, material)
	if isinstance(material, (list, tuple)):
		return _labelsFromList(positions, material)
	hint = '; append it to O.materials and give its label' if isinstance(material, wrapper.Material) else ''
	raise TypeError(f'fill: material = {brief(material)} must be a label, a list of (predicate, label), or a function of the position{hint}')


def _labelsFromFunction(positions, function):
	numbers, index = {}, np.empty(len(positions), dtype=np.int64)
	for i, position in enumerate(each(positions)):
		label = function(Vector3(*position))
		if not isinstance(label, str):
			raise TypeError(f'fill: the material function returned {brief(label)} at {place(position)}; it must return the label of a material')
		index[i] = numbers.setdefault(label, len(numbers))
	return list(numbers), index


def _labelsFromList(positions, pairs):
	index = np.full(len(positions), -1, dtype=np.int64)
	labels = []
	for i, pair in enumerate(pairs):
		if not (isinstance(pair, (list, tuple)) and len(pair) == 2 and callable(pair[0]) and isinstance(pair[1], str)):
			hint = '; that is a body: the label of a material is meant, not what mpm.fill has returned' if isinstance(pair, wrapper.Body) else ''
			raise TypeError(f'fill: material[{i}] = {brief(pair)} must be a (predicate, label) pair{hint}')
		open_ = np.flatnonzero(index < 0)
		index[open_[inside(pair[0], positions[open_])]] = i
		labels.append(pair[1])
	left = np.flatnonzero(index < 0)
	if left.size:
		raise ValueError(f'fill: no predicate of the material list contains the point at {place(positions[left[0]])} '
		                 f'({left.size} of {len(positions)} points have no material); pack.inSpace() as the last one contains them all')
	return labels, index


def _material(label):
	found = materialOf('fill', label)
	if not isinstance(found, wrapper.MpmMaterial):
		raise TypeError(f'fill: material {brief(label)} is a {type(found).__name__}; material points need one of the Mpm materials')
	return found
