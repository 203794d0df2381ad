# SPDX-License-Identifier: GPL-2.0-or-later
"""A view of a run for any browser: one file, with its data and what draws them."""
import base64
import json
import os
import zlib

import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3
from yade.wrapper import Box, Facet, MpmPoint, Sphere, Wall

from ..base.messages import brief, isNumber, pathOf
from ..base.processes import isFirst
from ..base.recorders import Film
from ..base.solver import solverOf
from ..geometry.rigid import cornersOf
from ..points.data import fields as columnsOfPoints
from ..points.fields import labelled, scalar
from ..points.files import replacing
from . import stretched
from .colouring import coloursOf, hasSign, limits
from .plotting import momentOf

_folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'page')


class view(Film, name='viewing'):
	"""View of the material points and YADE's bodies in one HTML file, which any browser with WebGL 2 shows without a network: it is turned, cut, coloured by several fields, and played::

		film = mpm.view('slope.html', ['plasticStrain', 'stress_xy'], every=2)
		O.run(40, wait=True)
		film.finish()

	Without *every* the file has the present state, and is there at once. Points are drawn as their deformed boxes, strongly stretched points as balls of as much matter, as by :func:`plot`; a click says what is where. Of YADE's bodies spheres, boxes, facets, walls and clumps of these are
	drawn in their colours; others are left out. ``slope.html#frame=3&field=stress_xy&cut=y:0.5`` opens a state, cut at half of its height; ``&turn=30:-10`` turns it by degrees, ``&play`` plays it. The file has 12 to 30 bytes a point and state; for large results
	there are :class:`MpmVtkRecorder` and :func:`state`.

	:param fileName: path that ends in .html; folders that are missing are made
	:param fields: name of a field, as for :func:`plot`, or a sequence of names, the first of which is shown at first
	:param every: steps of the engine from one state to the next, an integer >= 1, by a PyRunner at the end of ``O.engines``, beginning with the present one; 0: only the present one
	:param range: {name: (low, high)} of colours, in SI units; by default the smallest and largest values of all states, symmetric to zero for values of both signs
	:param fps: states a second as it is played, > 0
	:param solver: the engine; may be left out when ``O.engines`` holds one
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: another ending, a field that does not exist, or a scene without material points.
	:raises OSError: the file cannot be written.
	"""

	def __init__(self, fileName, fields=('displacement', ), every=0, range=None, fps=10, solver=None):
		self.fileName = pathOf('view', 'fileName', fileName)
		if not self.fileName.endswith(('.html', '.htm')): raise ValueError(f'view: fileName = {self.fileName!r} must end in .html')
		if not isNumber(every) or every != int(every) or every < 0: raise ValueError(f'view: every = {brief(every)} is not admitted: expected an integer >= 0')
		if not isNumber(fps) or not 0 < fps < 1000: raise ValueError(f'view: fps = {brief(fps)} is not admitted: expected a number > 0, of states a second')
		self.fields = (fields, ) if isinstance(fields, str) else tuple(fields) if isinstance(fields, (list, tuple)) else ()
		if not self.fields or not all(isinstance(name, str) for name in self.fields): raise TypeError(f'view: fields = {brief(fields)} must be names of fields, as in ["plasticStrain", "stress_xy"]')
		self.range = _ranges(range, self.fields)
		self.solver, self._fps, self._states, self._time = solverOf('view', solver), fps, [], None
		self.add()
		if every: self._begin(int(every))
		else: self._write()

	@property
	def frames(self):
		"""Number of the states so far."""
		return len(self._states)

	def _begin(self, every):
		self._first, self._every = self.solver.nDone, every
		self._startFilm(1)

	def add(self):
		"""Take the present state, unless the last one is it."""
		if self.solver.loadTime == self._time: return
		points = columnsOfPoints()
		if not len(points['id']): raise ValueError('view: the scene has no material points')
		self._time = self.solver.loadTime
		if isFirst: self._states.append(_State(points, self.fields, self.solver))
		else: [scalar('view', name, points) for name in self.fields]

	def finish(self):
		"""Write the file, with the present state as its last one; nothing more is added."""
		self._finish()

	def _write(self):
		if not isFirst: return
		page, script = (open(os.path.join(_folder, name), encoding='utf-8').read() for name in ('page.html', 'page.js'))
		name = os.path.splitext(os.path.basename(self.fileName))[0]
		data = json.dumps(self._data(), separators=(',', ':')).replace('</', '<\\/')
		for word, text in ('TITLE', name.replace('&', '&amp;').replace('<', '&lt;')), ('SCRIPT', script), ('DATA', data):
			page = page.replace(word, text, 1)
		with replacing(self.fileName) as temporary, open(temporary, 'w', encoding='utf-8') as file:
			file.write(page)

	def _data(self):
		"""Data for the page; coordinates and values in 16 bits of their range."""
		dim, states = self.solver.grid.dim, self._states
		low, high = (ends(*(getattr(state, name) for state in states)) for ends, name in ((_lowest, 'low'), (_highest, 'high')))
		reach = max(state.reach for state in states)
		described = [self._describe(i) for i in range(len(self.fields))]
		frames, before = [], None
		for state in states:
			points = state.packed(low, high, reach, [field['stored'] for field in described])
			since = before is not None and len(before[0]) == len(points) and np.array_equal(before[1].ids, state.ids)
			bodies = {name: None if before is not None and np.array_equal(values, before[1].bodies[name]) else _packed(values) for name, values in state.bodies.items()}
			frames.append(dict(title=state.title, sinceLast=since, points=_packed(points - before[0] if since else points), **bodies))
			before = points, state
		gravity = np.abs(np.array(self.solver.gravity))
		up = int(np.argmax(gravity)) if gravity.any() else 1 if dim == 2 else 2
		columns = dim + dim * dim + 1 + len(described)
		return dict(dim=dim, up=up, low=low.tolist(), high=high.tolist(), reach=reach, columns=columns, fps=self._fps, fields=described, frames=frames)

	def _describe(self, i):
		name, values = self.fields[i], np.concatenate([state.values[i] for state in self._states])
		bounds = limits('view', self.range.get(name), values)
		if name not in self.range and values.min() < 0 < values.max() and hasSign(name, values): bounds = -np.abs(values).max(), np.abs(values).max()
		size, label = labelled(name, np.array(bounds))
		text, _, unit = label.rpartition(' [')
		colours = coloursOf('view', name, None, values, bounds)(np.linspace(0, 1, 256))[:, :3]
		stored = values.min(), values.max()
		return dict(
		        name=name, label=_plain(text), unit=unit[:-1], size=size, low=float(bounds[0]), high=float(bounds[1]), stored=[float(end) for end in stored], colours=base64.b64encode((255 * colours).round().astype(np.uint8).tobytes()).decode()
		)


class _State:
	"""Data of a moment of the run."""

	def __init__(self, points, names, solver):
		dim = solver.grid.dim
		self.title, self.ids = momentOf(solver), points['id']
		self.values = [scalar('view', name, points).astype(np.float32) for name in names]
		self.middles = points['pos'][:, :dim].astype(np.float32)
		self.edges = (points['defGrad'] * points['halfSize0'][:, None, :])[:, :dim, :dim].astype(np.float32)
		self.radii = np.nan_to_num(stretched.radiiOfStretched(points['defGrad'], points['halfSize0'], dim)).astype(np.float32)
		extent = np.where(self.radii > 0, self.radii, np.abs(self.edges).sum(axis=2).max(axis=1))
		self.reach = float(max(np.abs(self.edges[self.radii == 0]).max(initial=0), self.radii.max(initial=0))) or 1.
		self.low, self.high = (self.middles - extent[:, None]).min(axis=0), (self.middles + extent[:, None]).max(axis=0)
		self.bodies = _bodies(dim, _inSpace(self.low), _inSpace(self.high))
		for corner, ends in ('low', np.minimum), ('high', np.maximum):
			near = _near(self.bodies, self.low, self.high, dim)
			if len(near): setattr(self, corner, ends(getattr(self, corner), (near.min if corner == 'low' else near.max)(axis=0)[:dim]))
		self.low, self.high = _inSpace(self.low), _inSpace(self.high)

	def packed(self, low, high, reach, ranges):
		"""Columns, one after the other, of 16 bits each: middle, half edges, radius (0: none), fields."""
		dim, isDot = self.middles.shape[1], self.radii > 0
		edges = np.where(isDot[:, None, None], 0, self.edges).reshape(-1, dim * dim)
		columns = [_share(self.middles[:, i], low[i], high[i]) for i in range(dim)] + [_share(edge, -reach, reach) for edge in edges.T]
		columns.append(np.where(isDot, np.maximum(1, _share(self.radii, 0, reach)), 0))
		columns += [_share(values, *ends) for values, ends in zip(self.values, ranges)]
		return np.concatenate(columns).astype(np.uint16)


def _share(values, low, high):
	return np.round(np.clip((values.astype(float) - low) / ((high - low) or 1), 0, 1) * 65535)


def _inSpace(corner):
	return np.append(corner, np.zeros(3 - len(corner))).astype(float)


def _lowest(*corners):
	return np.min(corners, axis=0)


def _highest(*corners):
	return np.max(corners, axis=0)


def _near(bodies, low, high, dim):
	"""Corners (N, 3) of bodies as far as they are not much larger than the soil."""
	size = np.linalg.norm(high - low)
	spheres, boxes, triangles = (bodies[name] for name in ('spheres', 'boxes', 'triangles'))
	corners = [spheres[:, :3] + sign * spheres[:, 3:4] for sign in (-1, 1)]
	corners += [boxes[:, :3] + sign * np.abs(boxes[:, 3:12].reshape(-1, 3, 3)).sum(axis=1) for sign in (-1, 1)] + [triangles[:, :3]]
	corners = np.concatenate(corners)
	return np.clip(corners, _inSpace(low) - size, _inSpace(high) + size)


def _bodies(dim, low, high):
	"""Spheres (centre, radius, colour), boxes (centre, half edges, colour) and corners of triangles (place, colour) of YADE's bodies, each row ending with 0; in the plane without extent along z."""
	found = dict(spheres=[], boxes=[], triangles=[])
	for body in wrapper.Omega().bodies:
		shape = body.shape if body else None
		if shape is None or isinstance(shape, MpmPoint): continue
		colour = [*shape.color, 0]
		if isinstance(shape, Sphere): found['spheres'].append([*body.state.pos, shape.radius, *colour])
		elif isinstance(shape, Box): found['boxes'].append([*body.state.pos, *(x for axis in np.eye(3) for x in body.state.ori * Vector3(*(axis * np.array(shape.extents)))), *colour])
		elif isinstance(shape, Wall): found['boxes'].append([*_wall(body, low, high), *colour])
		elif isinstance(shape, Facet): found['triangles'] += [[*corner, *colour] for corner in cornersOf(body)]
	widths = dict(spheres=8, boxes=16, triangles=7)
	arrays = {name: np.array(rows, np.float32).reshape(-1, widths[name]) for name, rows in found.items()}
	if dim == 2:
		for name, columns in (('spheres', [2]), ('boxes', [2, 5, 8, 11])):
			arrays[name][:, columns] = 0
	return arrays


def _wall(body, low, high):
	"""Draws a wall as a thin box beside the soil."""
	axis, size = body.shape.axis, np.linalg.norm(high - low)
	half = (high - low) / 2 + 0.05 * size
	half[axis] = 0.002 * size
	middle = (low + high) / 2
	middle[axis] = body.state.pos[axis]
	return [*middle, *np.diag(half).ravel()]


def _packed(values):
	return base64.b64encode(zlib.compress(np.ascontiguousarray(values).tobytes(), 9)).decode()


def _plain(label):
	"""Without the signs of formulas."""
	for sign, text in ('\\sigma', 'σ'), ('\\varepsilon', 'ε'), ('\\sqrt{2J_2}', '√(2 J2)'), ('$', ''), ('{', ''), ('}', ''):
		label = label.replace(sign, text)
	return label


def _ranges(given, fields):
	if given is None: return {}
	if not isinstance(given, dict): raise TypeError(f'view: range = {brief(given)} must be a dict of pairs by the name of the field, as in {{"plasticStrain": (0, 0.5)}}')
	for name in given:
		if name not in fields: raise ValueError(f'view: range is given for {brief(name)}, which is none of the fields {list(fields)}')
	return {name: limits('view', ends, np.zeros(0)) for name, ends in given.items()}


def add(label):
	"""For the PyRunner; of a scene that was loaded there is no view."""
	film = view._kept.get(label)
	if film and film._isOfTheScene() and (film.solver.nDone - film._first) % film._every == 0: film.add()
