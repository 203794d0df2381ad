# SPDX-License-Identifier: GPL-2.0-or-later
"""Scene building and data access for the implicit, ghost-stabilised material point method.

The classes (``MpmImplicitEngine``, ``MpmGrid``, ``MpmVonMisesMat``, ...) live beside YADE's own; this module adds what
is written more easily in Python. A slope under its own weight, with a weak layer::

    from yade import mpm

    O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
    O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=7.5e3, label='weak'))
    grid = MpmGrid(cellSize=0.5, dim=2)  # unbounded; dim=2 is plane strain in x-y

    profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
    O.bodies.append(mpm.fill(profile, grid, pointsPerCell=3, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))

    O.engines = [
        MpmImplicitEngine(
            grid=grid, gravity=(0, -9.81, 0), ghost=MpmGhost(factor=1e-2), newton=MpmNewton(tolerance=1e-6, maxIterations=20),
            boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'),  # rollers left and right, the base is held
                        MpmBoundary(min=(30, -inf, -inf), fix='x'),
                        MpmBoundary(max=(inf, 0, inf), fix='xy')])]
    O.dt = 1 / 80  # quasi-static: O.time is the load factor, one O.iter is one load step
    O.run(80, wait=True)
    print(mpm.arrays()['pos'].min(axis=0))

Units are SI; stress is positive in tension; strains are logarithmic; plane strain is per metre of thickness.
"""
import importlib.machinery
import importlib.util
import math
import operator
import os

import numpy as np
from yade import config, pack, wrapper
from yade.minieigenHP import Vector3

__all__ = ['polygon', 'fill', 'arrays', 'save']


def _loadEngine():
	"""The plugin's library, which is a Python module too; ImportError if YADE has not accepted it or does not fit it."""
	if not hasattr(wrapper, 'MpmPoint'):
		raise ImportError('yade.mpm: YADE has not loaded the plugin; what it printed at the start says why, or libpkg_mpm.so is not in ' + config.libDir)
	name = 'mpm_engine'
	loader = importlib.machinery.ExtensionFileLoader(name, os.path.join(config.libDir, 'mpm', name + '.so'))
	module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
	loader.exec_module(module)
	module.verify()
	return module


_engine = _loadEngine()


class polygon(pack.Predicate):
	"""Predicate of a simple polygon in the x-y plane, at any z.

	Works wherever a predicate of ``yade.pack`` does, boolean combinations included: ``mpm.polygon(...) - pack.inSphere(...)``.
	In three dimensions cut it to length: ``mpm.polygon(...) & pack.inAlignedBox(low, high)``.

	:param vertices: sequence of at least three (x, y) in m, in order around the polygon, either way round; the last one
		is joined to the first by itself. Concave outlines are welcome.
	:raises TypeError: vertices are not pairs of numbers.
	:raises ValueError: fewer than three vertices, a coordinate that is not finite, or an outline that crosses or touches itself.

	Points on the edge are inside, with a tolerance of 1e-9 of the polygon's larger extent.
	"""

	def __init__(self, vertices):
		super().__init__()  # YADE's boolean operators need the C++ part of the object
		self.vertices = _outline(vertices)
		self.low, self.high = self.vertices.min(axis=0), self.vertices.max(axis=0)
		self.tolerance = 1e-9 * (self.high - self.low).max()
		_refuseSelfContact(self.vertices, self.tolerance)

	def __call__(self, pt, pad=0.):
		"""True if the point is inside, no closer than *pad* [m] to the edge (a negative *pad* widens the polygon)."""
		return bool(self.contains([(pt[0], pt[1])], pad)[0])

	def aabb(self):
		"""Lower and upper corner of the bounding box; unbounded in z."""
		return Vector3(*self.low, -math.inf), Vector3(*self.high, math.inf)

	def contains(self, points, pad=0.):
		"""Test many points at once.

		:param points: (N, 2) coordinates [m]
		:param pad: as in ``__call__``
		:return: (N,) array of bool
		"""
		points = np.asarray(points, dtype=float).reshape(-1, 2)
		inside = np.empty(len(points), dtype=bool)
		block = 1 + 2**15 // len(self.vertices)  # keeps points x edges in cache
		for start in range(0, len(points), block):
			inside[start:start + block] = self._signedDistance(points[start:start + block]) >= pad - self.tolerance
		return inside

	def _signedDistance(self, points):
		"""(N,) distances from the edge [m], positive inside."""
		x, y = points.T[:, :, None]  # one row for each point, one column for each edge
		(ax, ay), (bx, by) = self.vertices.T, np.roll(self.vertices, -1, axis=0).T
		# a ray towards +x crosses the edge: half-open in y, so that one through a vertex counts it once
		spans = (ay > y) != (by > y)
		crossings = spans & (x < ax + (y - ay) * np.divide(bx - ax, by - ay, out=np.zeros(len(ax)), where=by != ay))
		inside = crossings.sum(axis=1) % 2 == 1
		return np.where(inside, 1, -1) * np.sqrt(_squaredDistance(x, y, ax, ay, bx, by).min(axis=1))


def _outline(vertices):
	"""Vertices as an (n, 2) array of finite numbers, n >= 3."""
	try:
		points = np.array([tuple(v) for v in vertices], dtype=float)
	except (TypeError, ValueError):
		raise TypeError(f'polygon: vertices = {vertices!r} must be a sequence of (x, y) pairs of numbers') from None
	if len(points) < 3:
		raise ValueError(f'polygon: vertices = {vertices!r}: at least 3 are needed to enclose an area, {len(points)} given')
	if points.ndim != 2 or points.shape[1] != 2:
		raise TypeError(f'polygon: vertices[0] = {tuple(points[0])!r} must be an (x, y) pair; the profile lies in the x-y plane')
	for i, point in enumerate(points):
		if not np.isfinite(point).all():
			raise ValueError(f'polygon: vertices[{i}] = {tuple(point)} must be finite')
	return points


def _refuseSelfContact(vertices, tolerance):
	"""Raise ValueError unless edges meet only where one follows the other: inside and outside would be ambiguous."""
	n = len(vertices)
	following = np.roll(vertices, -1, axis=0)
	for i in np.flatnonzero(np.hypot(*(following - vertices).T) <= tolerance):
		hint = '; the last vertex is joined to the first by itself: do not repeat it' if i == n - 1 else ''
		raise ValueError(f'polygon: vertices[{i}] and vertices[{(i + 1) % n}] coincide at {tuple(vertices[i])}{hint}')
	for i, (a, b) in enumerate(zip(vertices, following)):
		others = np.delete(np.arange(n), [i, (i + 1) % n])
		near = others[_squaredDistance(*vertices[others].T, *a, *b) <= tolerance**2]
		if near.size:
			raise ValueError(f'polygon: vertices[{near[0]}] = {tuple(vertices[near[0]])} lies on the edge from {tuple(a)} to {tuple(b)}; '
			                 'the outline must not touch itself or enclose no area')
		separates = _side(vertices, a, b) * _side(following, a, b) < 0
		separated = _side(a, vertices, following) * _side(b, vertices, following) < 0
		crossing = np.flatnonzero(separates & separated)
		if crossing.size:
			j = crossing[0]
			raise ValueError(f'polygon: the edge from {tuple(a)} to {tuple(b)} crosses the one from {tuple(vertices[j])} to '
			                 f'{tuple(following[j])}; are the vertices in order around the outline?')


def _side(p, a, b):
	"""Sign of the side of the line a-b on which p lies (any of the three may be an array of points)."""
	(px, py), (ax, ay), (bx, by) = np.transpose(p), np.transpose(a), np.transpose(b)
	return np.sign((bx - ax) * (py - ay) - (by - ay) * (px - ax))


def _squaredDistance(x, y, ax, ay, bx, by):
	"""Squared distance of the points (x, y) from the segment a-b."""
	dx, dy = bx - ax, by - ay
	t = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0, 1)
	return (x - ax - t * dx)**2 + (y - ay - t * dy)**2


def fill(predicate, grid, pointsPerCell, material):
	"""Fill a region with material points, equally spaced in the cells of a grid.

	Cells are counted from ``grid.origin``; the points are returned cell by cell. In two dimensions they lie in the plane
	z = ``grid.origin[2]`` and stand for 1 m of thickness.

	:param predicate: the region [m]: :class:`polygon` or any bounded predicate of ``yade.pack``, also a combination of them
	:param grid: the ``MpmGrid`` of the analysis
	:param pointsPerCell: points per cell and axis, at least 1; points whose centre is inside the region are kept
	:param material: label of a material in ``O.materials``; or a list of (predicate, label), of which the first that
		contains the point applies; or a function that takes the position and returns a label
	:return: list of bodies for ``O.bodies.append``. Each has an ``MpmPoint`` shape, the state that belongs to its material,
		mass and initial volume of its share of the cell, and is invisible to YADE's collider and integrator.
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a value that is not admitted, no point inside the region, or a point without material.
	:raises KeyError: a label that is not in ``O.materials``.
	"""
	if not isinstance(grid, wrapper.MpmGrid):
		raise TypeError(f'fill: grid = {grid!r} must be an MpmGrid')
	grid.updateAttrs(grid.dict())  # looks again at all values: cellSize may not have been given
	n = _pointsPerCell(pointsPerCell)
	positions = _latticePoints(predicate, grid, n)
	labels, index = _materialOf(positions, material)
	materials = [_material(label) for label in labels]
	half = grid.cellSize / (2 * n)
	halfSize = Vector3(half, half, half if grid.dim == 3 else 0.5)
	return _engine.newBodies(positions, halfSize, materials, index)


def _pointsPerCell(value):
	try:
		n = operator.index(value)
	except TypeError:
		raise TypeError(f'fill: pointsPerCell = {value!r} must be an integer') from None
	if isinstance(value, bool):
		raise TypeError(f'fill: pointsPerCell = {value!r} must be an integer')
	if n < 1:
		raise ValueError(f'fill: pointsPerCell = {value!r} must be at least 1 (points per cell and axis)')
	return n


def _latticePoints(predicate, grid, n):
	"""(N, 3) centres inside the predicate of the n^dim points in each cell, cell by cell."""
	cells = [np.arange(a, b) for a, b in zip(*_cellRange(predicate, grid, n))]
	candidates = math.prod(len(c) * n for c in cells)
	# in slabs across the last axis, which bounds the memory of the points that are rejected
	slabs = np.array_split(cells[-1], candidates // 2**20 + 1)
	kept = []
	for slab in slabs:
		points = _cellPoints(cells[:-1] + [slab], grid, n)
		kept.append(points[_inside(predicate, points)])
	positions = np.concatenate(kept)
	if not len(positions):
		plane = f' in the plane z = {grid.origin[2]}' if grid.dim == 2 else ''
		raise ValueError(f'fill: no point of the lattice with spacing {grid.cellSize / n} m{plane} is inside the predicate {predicate!r}; '
		                 f'is the region smaller than that, or somewhere else?')
	return positions


def _cellRange(predicate, grid, n):
	"""First cell and one past the last cell of each axis that may have points inside the predicate."""
	if not callable(predicate) or not callable(getattr(predicate, 'aabb', None)):
		raise TypeError(f'fill: predicate = {predicate!r} must be an mpm.polygon or a predicate of yade.pack')
	low, high = (np.array([corner[i] for i in range(grid.dim)], dtype=float) for corner in predicate.aabb())
	if not np.isfinite([low, high]).all():
		raise ValueError(f'fill: predicate = {predicate!r} has no bounds (its box reaches from {tuple(low)} to {tuple(high)}); '
		                 'intersect it with a bounded one, such as pack.inAlignedBox: predicate & pack.inAlignedBox(low, high)')
	origin = np.array([grid.origin[i] for i in range(grid.dim)])
	# one spare cell on each side: the predicate decides, not the round-off of its box
	first, last = np.floor((low - origin) / grid.cellSize) - 1, np.ceil((high - origin) / grid.cellSize) + 1
	candidates = np.prod((last - first) * n)
	if candidates > 2**31:
		raise ValueError(f'fill: {candidates:.3g} points would have to be tested, more than YADE can number: cellSize = {grid.cellSize} m or '
		                 f'pointsPerCell = {n} per axis do not suit a region from {tuple(low)} to {tuple(high)}')
	return first.astype(np.int64), last.astype(np.int64)


def _cellPoints(cells, grid, n):
	"""(N, 3) centres of the n^dim points in each cell of a block, given by its cell numbers per axis."""
	dim = grid.dim
	shape = [len(c) for c in reversed(cells)] + [n] * dim
	points = np.full(shape + [3], grid.origin[2])
	for axis, numbers in enumerate(cells):
		# h (2k + 1) / 2n with integer k: exactly odd about the origin, so a symmetric scene is symmetric to the last bit
		odd = 2 * (n * numbers[:, None] + np.arange(n)) + 1
		along = [1] * (2 * dim)
		along[dim - 1 - axis], along[2 * dim - 1 - axis] = odd.shape
		points[..., axis] = (grid.origin[axis] + grid.cellSize * odd / (2 * n)).reshape(along)
	return points.reshape(-1, 3)


def _inside(predicate, points):
	"""Mask of the points inside; combinations are taken apart, so that the polygons in them are tested in bulk."""
	if isinstance(predicate, polygon):
		return predicate.contains(points[:, :2])
	for kind, combine in _combinations.items():
		if isinstance(predicate, kind):
			return combine(_inside(predicate.A, points), _inside(predicate.B, points))
	return np.fromiter((predicate(Vector3(*p), 0.) for p in points.tolist()), bool, len(points))


_combinations = {
        pack.PredicateUnion: np.logical_or,
        pack.PredicateIntersection: np.logical_and,
        pack.PredicateDifference: np.greater,  # in the first and not in the second
        pack.PredicateSymmetricDifference: np.logical_xor,
}


def _materialOf(positions, material):
	"""Labels in use, and for each point the index of its label."""
	if isinstance(material, str):
		return [material], np.zeros(len(positions), dtype=np.int64)
	if callable(material):
		return _labelsFromFunction(positions, material)
	if isinstance(material, (list, tuple)):
		return _labelsFromList(positions, material)
	hint = '; append it to O.materials and give its label' if isinstance(material, wrapper.Material) else ''
	raise TypeError(f'fill: material = {material!r} must be a label, a list of (predicate, label), or a function of the position{hint}')


def _labelsFromFunction(positions, function):
	numbers, index = {}, np.empty(len(positions), dtype=np.int64)
	for i, position in enumerate(positions.tolist()):
		label = function(Vector3(*position))
		if not isinstance(label, str):
			raise TypeError(f'fill: the material function returned {label!r} at {tuple(position)}; it must return the label of a material')
		index[i] = numbers.setdefault(label, len(numbers))
	return list(numbers), index


def _labelsFromList(positions, pairs):
	index = np.full(len(positions), -1, dtype=np.int64)
	labels = []
	for i, pair in enumerate(pairs):
		if not (isinstance(pair, (list, tuple)) and len(pair) == 2 and callable(pair[0]) and isinstance(pair[1], str)):
			raise TypeError(f'fill: material[{i}] = {pair!r} must be a (predicate, label) pair')
		open_ = np.flatnonzero(index < 0)
		index[open_[_inside(pair[0], positions[open_])]] = i
		labels.append(pair[1])
	left = np.flatnonzero(index < 0)
	if left.size:
		raise ValueError(f'fill: no predicate of the material list contains the point at {tuple(positions[left[0]])} '
		                 f'({left.size} of {len(positions)} points have no material); pack.inSpace() as the last one contains them all')
	return labels, index


def _material(label):
	try:
		found = wrapper.Omega().materials[label]
	except KeyError:
		known = [m.label for m in wrapper.Omega().materials if m.label]
		raise KeyError(f'fill: material {label!r} is not in O.materials, which has {known}') from None
	if not isinstance(found, wrapper.MpmMaterial):
		raise TypeError(f'fill: material {label!r} is a {type(found).__name__}; material points need one of the Mpm materials')
	return found


_columns = {  # kind of a number and shape of a row
        'id': (np.int64, ()),
        'pos': (float, (3, )),
        'pos0': (float, (3, )),
        'halfSize': (float, (3, )),
        'stress': (float, (3, 3)),
        'defGrad': (float, (3, 3)),
        'elasticStrain': (float, (3, 3)),
        'volume': (float, ()),
        'plasticStrain': (float, ()),
        'material': (np.int64, ()),
}


def arrays():
	"""Copies of the data of all material points of the scene, as NumPy arrays in order of body id.

	:return: dict of ``id`` (N,) body ids; ``pos``, ``pos0`` (N, 3) current and initial position [m]; ``halfSize`` (N, 3) half the
		current size of the domain [m]; ``stress`` (N, 3, 3) Cauchy stress [Pa]; ``defGrad`` (N, 3, 3) deformation gradient;
		``elasticStrain`` (N, 3, 3) logarithmic elastic strain; ``volume`` (N,) current volume [m3]; ``plasticStrain`` (N,)
		accumulated plastic strain; ``material`` (N,) index into ``O.materials`` (-1: not in there). A scene without material
		points gives arrays of length 0.
	:raises ValueError: a body with an ``MpmPoint`` shape that is no complete material point.
	"""
	data = _engine.columnsOfPoints()
	return {name: np.frombuffer(data[name], kind).reshape((-1, ) + shape) for name, (kind, shape) in _columns.items()}


def save(file):
	"""Save the scene as ``O.save`` does, but whole or not at all: a process that is killed meanwhile leaves the file as it was.

	For saving during a run: ``PyRunner(iterPeriod=10, command="mpm.save('slope.yade.gz')")`` behind the solver.

	:param file: path with one of YADE's endings, ``.xml``, ``.xml.gz``, ``.xml.bz2``, ``.yade``, ``.yade.gz`` or ``.yade.bz2``
	:raise ValueError: another ending
	:raise OSError: the file cannot be written
	"""
	file = os.fspath(file)
	endings = '.xml', '.xml.gz', '.xml.bz2', '.yade', '.yade.gz', '.yade.bz2'
	if not file.endswith(endings):
		raise ValueError(f"save: file = {file!r} does not end in one of {', '.join(endings)}, which choose the format")
	folder, name = os.path.split(os.path.abspath(file))
	temporary = os.path.join(folder, f'.{os.getpid()}-{name}')
	try:
		with open(temporary, 'wb'):
			pass  # so that a folder which cannot be written to is an OSError with its reason
		wrapper.Omega().save(temporary, quiet=True)
		with open(temporary, 'rb+') as written:
			os.fsync(written.fileno())
		os.replace(temporary, file)
	finally:
		if os.path.exists(temporary): os.remove(temporary)
