# SPDX-License-Identifier: GPL-2.0-or-later
"""Free ground beside a body that is shaken: columns of level ground, run by themselves, and edges through which they act on the body."""
import math

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber
from ..base.processes import count as _processes
from ..base.solver import noPoints
from ..library import engine as _engine
from ..points.data import arrays, assign, table, withMaterials
from .damping import stepOf

_width = 3  # width of a column [cells], the least that a grid may repeat itself after
_pieces = 4  # pieces of an edge in a cell
_settling = 4  # steps at rest, in which a column comes into equilibrium by itself


def freeField(solver, until, motion=None, sides='both', distance=None):
	"""Edges of a body beyond which the ground goes on as free, level ground: a list of MpmFreeField, for ``solver.loads``. ::

		solver = MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), rayleigh=mpm.rayleigh(0.05, 2))     # no boundaries at the sides and the base
		O.engines, O.dt = [solver], 0.01
		solver.loads = mpm.freeField(solver, until=quake.time[-1] + 2, motion=quake.incoming())

	Of the material points beside each side, as they are now, a column of level ground is made, with the engine's settings and what constrains or moves its whole base. It is run by itself in steps
	of O.dt, in another scene of YADE that must be empty, before the body is. Dashpots, and springs if there is a *distance*, resist what the edges do otherwise than their column, and what its stress grows by acts
	on the sides. Edges move with the soil. Forces that constrained them until now go on acting: a static stage hands its reactions over.

	:param solver: the ``MpmDynamicEngine``, ``scheme`` 'newmark' or 'generalised-alpha', in plane strain; it is at rest. Boundaries may constrain the whole base, not the sides
	:param until: O.time [s] until which the ground beyond is known; steps after it are refused
	:param motion: wave that comes up through the base (``MpmBaseMotion``), as ``record.incoming()``: the base is then an edge, too, a compliant one. None: the base is what the engine's
		boundaries and absorbing edges say, as a rigid one that a ``MpmBoundary`` moves
	:param sides: ``'both'``, ``'left'`` or ``'right'``; upright, on lines of the grid, and without holes
	:param distance: from the edges to the middle of what moves [m] > 0, for springs of the shear modulus over it along the normal, of half of that across; None: half of the body's width; inf: no springs
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: a value that is not admitted, sides that are not as above, or something of the scene that columns of level ground cannot have; the message names it.
	:raises RuntimeError: a step of a column does not converge, for which the message tells why.
	"""
	_requireArguments(solver, until, motion, sides, distance)
	body = _Body(solver, motion)
	distance = body.width / 2 if distance is None else distance
	columns = {side: _Column(body, side) for side in (('left', 'right') if sides == 'both' else (sides, ))}
	edges = [wrapper.MpmFreeField(surface=column.line, distance=distance, **column.run(until)) for column in columns.values()]
	if motion is not None: edges.append(_base(body, [columns[min(columns)], columns[max(columns)]], distance))
	return edges


def _base(body, columns, distance):
	"""The edge through which the wave comes. Springs tie it to the bases of the columns at both sides, and between them to what lies between."""
	line = body.base(body.left, body.right)
	if math.isinf(distance): return wrapper.MpmFreeField(surface=line, motion=body.motion)
	times = columns[0].times
	share = (np.array(line)[:, 0] - body.left) / body.width
	displacements = (1 - share)[:, None] * columns[0].ofBase[:, None] + share[:, None] * columns[1].ofBase[:, None]
	speed = np.interp(times, *np.transpose(body.motion.history), left=0, right=0)
	velocities = np.broadcast_to(2 * speed[:, None, None] * np.array(body.motion.direction)[:2], displacements.shape)
	return wrapper.MpmFreeField(surface=line, distance=distance, times=times.tolist(), velocities=velocities.ravel().tolist(), displacements=displacements.ravel().tolist(), forces=[0.] * displacements.size)


def _requireArguments(solver, until, motion, sides, distance):
	if not isinstance(solver, wrapper.MpmDynamicEngine): raise TypeError(f'freeField: solver = {brief(solver)} must be an MpmDynamicEngine')
	if solver.scheme not in ('newmark', 'generalised-alpha'): raise ValueError(f"freeField: MpmDynamicEngine.scheme = {solver.scheme!r} is not admitted: expected 'newmark' or 'generalised-alpha'")
	if _processes > 1: raise ValueError('freeField: edges of free ground cannot go with several processes yet: start the script with one')
	if not isNumber(until): raise TypeError(f'freeField: until = {brief(until)} must be a time [s]')
	if not (math.isfinite(until) and until > solver.loadTime): raise ValueError(f'freeField: until = {until:g} must be a finite time after now, {solver.loadTime:g} s')
	if motion is not None and not isinstance(motion, wrapper.MpmBaseMotion): raise TypeError(f'freeField: motion = {brief(motion)} must be an MpmBaseMotion, as record.incoming() makes it')
	if sides not in ('both', 'left', 'right'): raise ValueError(f"freeField: sides = {brief(sides)} is not admitted: expected 'both', 'left' or 'right'")
	if distance is not None and not (isNumber(distance) and distance > 0): raise ValueError(f'freeField: distance = {brief(distance)} must be a number > 0 [m], inf, or None')
	grid = solver.grid
	if grid.dim != 2 or grid.axisymmetric: raise ValueError('freeField: columns of free ground are there in plane strain only: MpmGrid(dim=2), without an axis of symmetry')
	if grid.period.norm() > 0: raise ValueError('freeField: the sides of a periodic grid are the same nodes (MpmGrid.period), so that nothing is beyond them')
	if solver.flow is not None: raise ValueError('freeField: water that flows (MpmDynamicEngine.flow) cannot go with columns of free ground yet')


class _Body:
	"""Ground that is computed, with its sides and its base."""

	def __init__(self, solver, motion):
		self.solver, self.motion, self.grid, self.h, self.dt = solver, motion, solver.grid, solver.grid.cellSize, stepOf(solver)
		self.points, self.materials, self.material = withMaterials(solver.mask)
		if not len(self.points['id']): raise ValueError(noPoints('freeField', solver))
		if 'velocity' in self.points and np.abs(self.points['velocity']).max() > 0: raise ValueError('freeField: the body moves already; columns of free ground begin at rest, so make them before the first time step')
		pos, half = self.points['pos'], self.points['halfSize']
		self.left, self.right = self._line('left', (pos - half)[:, 0].min(), 0), self._line('right', (pos + half)[:, 0].max(), 0)
		self.bottom = self._line('lower', (pos - half)[:, 1].min(), 1)
		self.width, self.z = self.right - self.left, self.grid.origin[2]
		self.boundaries, self.absorbing, self.water = ([one for i, one in enumerate(getattr(solver, kind)) if self._isAcross(f'{kind}[{i}]', one)] for kind in ('boundaries', 'absorbing', 'water'))

	def base(self, first, last):
		"""Vertices of the base."""
		return [(x, self.bottom, self.z) for x in np.linspace(first, last, _pieces * round((last - first) / self.h) + 1)]

	def _line(self, name, at, axis):
		"""The line of the grid at an edge of the body, which static steps may have moved by a little."""
		line = self.grid.origin[axis] + round((at - self.grid.origin[axis]) / self.h) * self.h
		if abs(at - line) < 0.05 * self.h: return line
		raise ValueError(f"freeField: the {name} edge of the body, at {'xy'[axis]} = {at:g} m, is not on a line of the grid, of which the nearest is at {line:g} m: move it there, or MpmGrid.origin")

	def _isAcross(self, name, one):
		"""True if a condition is the same from side to side, so that columns have it, too; ValueError if it constrains a side."""
		if not hasattr(one, 'min'): return True  # water
		if getattr(one, 'surface', None) is not None: return False
		if one.min[0] <= self.left and one.max[0] >= self.right:
			if self.motion is not None and one.max[1] >= self.bottom and 'x' in getattr(one, 'fix', 'x'):
				raise ValueError(f'freeField: {name} constrains or absorbs at the base, and so would the edge of motion: leave one of them out')
			return True
		for side in self.left, self.right:
			if one.min[0] <= side <= one.max[0] and one.max[1] > self.bottom and 'x' in getattr(one, 'fix', 'x'):
				raise ValueError(f'freeField: {name} constrains or absorbs the side at x = {side:g} m: leave it out, the edges that are returned take its place')
		return False


class _Column:
	"""Level ground as beside a side of the body: its points, and the line along its side from which the body looks at it."""

	def __init__(self, body, side):
		self.body, self.side = body, side
		isLeft = side == 'left'
		self.x = body.left if isLeft else body.right
		away = (body.points['pos'][:, 0] - self.x) * (1 if isLeft else -1)
		self.rows = np.flatnonzero(away < body.h * (1 - 1e-9))
		self.first = self.x if isLeft else self.x - _width * body.h
		self.ways = np.arange(_width) * (body.h if isLeft else -body.h)
		self._makeLine(self.rows[away[self.rows] < away.min() + 1e-3 * body.h], isLeft)

	def _makeLine(self, outermost, isLeft):
		"""Vertices, and of each piece between two of them the row of points beside it."""
		pos, half = self.body.points['pos'][outermost, 1], self.body.points['halfSize'][outermost, 1]
		order = np.argsort(pos)
		pos, half = pos[order], half[order]
		gaps = (pos - half)[1:] - (pos + half)[:-1]
		if len(pos) < 2 or np.abs(gaps).max() > 0.1 * half.max() or abs(pos[0] - half[0] - self.body.bottom) > 0.05 * self.body.h:
			raise ValueError(f'freeField: the {self.side} side of the body, at x = {self.x:g} m, is not filled from its top to the base by one row of points above the other: it must be upright, without holes')
		ends = np.concatenate([[self.body.bottom], (pos + half)[:-1] + gaps / 2, [pos[-1] + half[-1]]])
		parts = [max(1, math.ceil(_pieces * size / self.body.h - 1e-6)) for size in np.diff(ends)]
		heights = np.concatenate([np.linspace(low, high, n + 1)[:-1] for low, high, n in zip(ends[:-1], ends[1:], parts)] + [ends[-1:]])
		self.rowOfPiece, self.heights = np.repeat(np.arange(len(pos)), parts), pos
		if isLeft: heights, self.rowOfPiece = heights[::-1], self.rowOfPiece[::-1]  # the body is on the left of the line
		self.line = [(self.x, y, self.body.z) for y in heights]

	def run(self, until):
		"""Motion until then, as attributes of MpmFreeField."""
		start, dt, scene = self.body.solver.loadTime, self.body.dt, wrapper.Omega()
		scene.switchScene()
		try:
			if len(scene.bodies) or len(scene.engines): raise ValueError("freeField: YADE's other scene (O.switchScene) is in use, which the columns need")
			self._fill()
			self._settle(start)
			return self._shake(start, max(1, math.ceil((until - start) / dt - 1e-6)), dt)
		except RuntimeError as error:
			raise RuntimeError(f'freeField: the column of free ground at the {self.side} side: {error}') from None
		finally:
			scene.resetThisScene()
			scene.switchScene()

	def _fill(self):
		body, scene = self.body, wrapper.Omega()
		twins = [type(m)(**{name: value for name, value in m.dict().items() if name != 'id'}) for m in body.materials]
		scene.materials.append(twins)
		self.grid = wrapper.MpmGrid(cellSize=body.h, origin=(self.first, body.grid.origin[1], body.z), period=(_width * body.h, 0, 0))
		rows = np.tile(self.rows, _width)
		pos = body.points['pos'][rows]
		pos[:, 0] += np.repeat(self.ways, len(self.rows))
		scene.bodies.append(_engine.newBodies(self.grid, pos, np.ascontiguousarray(body.points['halfSize0'][rows, 0]), twins, np.ascontiguousarray(body.material[rows], np.int64), {}))
		for number in np.unique(body.material[rows]): self._giveState(rows, body.material[rows] == number)

	def _giveState(self, rows, chosen):
		"""Assigns the columns of the points of one material, whose law and strengths the values are about."""
		columns = {name: self.body.points[name][rows[chosen]] for name, column in table.items() if column['isGiven'] and name in self.body.points and name not in ('pos', 'pos0', 'stress', 'velocity', 'force')}
		assign(ids=np.flatnonzero(chosen), **{name: values for name, values in columns.items() if np.isfinite(values).all()})

	def _settings(self):
		solver = self.body.solver
		return dict(grid=self.grid, gravity=solver.gravity, basis=solver.basis, domains=solver.domains, fBar=solver.fBar, ghost=solver.ghost, newton=solver.newton, water=[_copy(one) for one in self.body.water], verbosity=0)

	def _settle(self, start):
		"""Into equilibrium under its weight, in which its bottom is at rest. O.time is then that at which the motion begins."""
		solver, scene = self.body.solver, wrapper.Omega()
		if solver.gravity.norm() == 0 and not self.body.water: return
		held = wrapper.MpmBoundary(max=(math.inf, self.body.bottom, math.inf), fix='xy')
		factor = lambda curve: [(0, float(np.interp(start, *np.transpose(curve))))]
		static = wrapper.MpmImplicitEngine(boundaries=[held], loadCurve=factor(solver.loadCurve), gravityCurve=factor(solver.gravityCurve or solver.loadCurve), **self._settings())
		scene.engines, scene.dt = [static], (start or 1) / _settling
		for _ in range(_settling): scene.step()
		if start == 0: scene.resetTime()

	def _shake(self, start, steps, dt):
		body, solver, scene = self.body, self.body.solver, wrapper.Omega()
		probe = wrapper.MpmFreeField(surface=self.line, acts=False)
		edges = [probe]
		if body.motion is not None:
			edges.append(wrapper.MpmFreeField(surface=body.base(self.first, self.first + _width * body.h), motion=body.motion))
		settings = {name: getattr(solver, name) for name in ('scheme', 'beta', 'gamma', 'rhoInfinity', 'rayleigh', 'loadCurve', 'gravityCurve', 'timeTolerance')}
		engine = wrapper.MpmDynamicEngine(
		        loads=edges, boundaries=[_copy(one) for one in body.boundaries], absorbing=[_copy(one) for one in body.absorbing], loadTime=scene.time, **settings, **self._settings())
		scene.engines, scene.dt = [engine], dt
		told = [(np.zeros((len(self.line), 3)), np.array(self.line), self._stresses())]
		for _ in range(steps):
			scene.step()
			told.append((np.array(probe.velocity), np.array(probe.surface.vertices), self._stresses()))
		velocities, places, stresses = (np.array(values) for values in zip(*told))
		forces = self._forces(places, stresses)
		flat = lambda values: values[..., :2].ravel().tolist()
		self.times, self.ofBase = start + dt * np.arange(steps + 1), (places - places[0])[:, 0 if self.side == 'right' else -1, :2]
		return dict(times=self.times.tolist(), velocities=flat(velocities), displacements=flat(places - places[0]), forces=flat(forces - forces[0]))

	def _stresses(self):
		"""Total stress (rows, 2, 2) [Pa] of the points beside the line, mean of each row."""
		points = arrays()
		if not hasattr(self, '_rowOfPoint'):
			self._rowOfPoint = np.abs(points['pos'][:, 1, None] - self.heights[None]).argmin(axis=1)
			self._count = np.bincount(self._rowOfPoint, minlength=len(self.heights))
		stress = points['stress'][:, :2, :2].copy()
		if 'porePressure' in points: stress -= np.nan_to_num(points['porePressure'])[:, None, None] * np.eye(2)
		return np.array([np.bincount(self._rowOfPoint, weights=component, minlength=len(self.heights)) / self._count for component in stress.reshape(-1, 4).T]).T.reshape(-1, 2, 2)

	def _forces(self, places, stresses):
		"""On the body at the vertices (times, vertices, 3) [N]: half of what acts on the pieces beside each."""
		along = np.diff(places, axis=1)
		normal = np.stack([along[..., 1], -along[..., 0]], axis=-1)
		ofPieces = np.einsum('tpij,tpj->tpi', stresses[:, self.rowOfPiece], normal) / 2
		forces = np.zeros_like(places)
		forces[:, :-1, :2] += ofPieces
		forces[:, 1:, :2] += ofPieces
		return forces


def _copy(condition):
	"""Copy of a condition with its settings, without its results."""
	values = {name: value for name, value in condition.dict().items() if getattr(type(condition), name).fset is not None}
	return type(condition)(**values)
