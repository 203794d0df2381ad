# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the material points by matplotlib, which is imported when the first one is drawn."""
import os

import numpy as np

from yade import wrapper

from ..base.messages import brief, pathOf
from ..base.processes import byFirst, isDivided
from ..base.solver import solverOf
from ..geometry.rigid import outline, touchable
from ..geometry.sections import boxEdges, cut, inOrder, signs, triangleSides
from ..library import engine
from ..points import stages
from ..points.data import contactFaces, fields
from ..points.fields import labelled
from ..points.files import replacing
from . import stretched
from .colouring import coloursOf, hasSign, limits, scalarOrArray
from .markings import drawContours, drawTrace, drawVectors, labelOf, levelsOf, vectorsOf

_axes = 'xyz'
_around = [0, 1, 3, 2]  # those of its lower face, in order
_faceColour, _cellColour, _boundaryColour, _loadColour, _wallColour = '#d9480f', '#868e96', '#ffe8cc', '#0b7285', '#5f3dc4'
_rigidColour = '#212529'


def plot(field='displacement', deformed=True, grid=False, ghost=False, fileName=None, ax=None, range=None, colormap=None, plane=None, solver=None, loads=None, vectors=None, contours=None):
	"""Draw the material points, coloured by a scalar field.

	Each point is drawn as the box of matter that it stands for, deformed by its deformation gradient; one whose longest side has become more than five times the shortest one, as in run-outs, as a dot of as much matter,
	and the legend says how many these are. In 3D the picture is a slice; a small one beside it, unless *ax* is given, shows where. Its title is the time of a :class:`MpmDynamicEngine`, the load factor of other
	engines, and with ``stages`` the stage and its step; axes that have a title keep it.

	:param field: ``displacement`` (its length), ``strain_xy``, ``meanStress``, ``sqrt2J2``, ``totalStress_yy``, or a column of :func:`arrays`, of which a vector or tensor
		needs its component: ``displacement_y``, ``stress_xy``, ``plasticStrain``, ``elasticStrain_yy``, ``defGrad_xx``, ``material``, ...; or an
		(N,) array in order of body id. Displacements below 10 cm are shown in mm, stresses in kPa or MPa.
	:param deformed: draw the current configuration, otherwise the initial one
	:param grid: draw the cells with material, with a tint those at the boundary of the body; by default not
	:param ghost: draw the faces on which the ghost stabilisation acts; by default not
	:param fileName: write the picture to this file, whole or not at all; its ending chooses the format (png, pdf, svg, ...). Folders that
		are missing are made.
	:param ax: matplotlib axes to draw into; by default a new figure
	:param range: (low, high) of the colours, in the field's SI unit; by default the smallest and largest value drawn, or symmetric to zero
		if there are values of both signs. Where values are beyond, the colour bar ends in an arrow.
	:param colormap: name of a colour map of matplotlib; by default that of the quantity, the same in all pictures: plastic strain YlOrRd; stress, strain and components of vectors RdBu_r, of which
		zero is the white and compression blue; others viridis, also arrays, if their values have one sign
	:param plane: in 3D, axis and coordinate [m] of the slice, as in ``('z', 0.5)``; by default upright along gravity, through the point nearest to the middle, and along the longer side of the body
	:param solver: ``MpmImplicitEngine`` whose grid is drawn; needed if there are several
	:param loads: draw the loaded surfaces and the walls that are surfaces, with arrows in the direction of the force on the body, and the rigid bodies that may touch it, in the plane with lines as long as the traction of
		contact is large; by default if *deformed*
	:param vectors: arrows on top: name of a vector (``displacement``, ``velocity``, ``force``, ...), or an (N, 3) array in order of body id
	:param contours: lines of equal value of *field* on top: their number, or their values in the field's SI unit, increasing
	:return: the axes
	:raises TypeError: *range* is no pair of numbers, or *plane* no pair of an axis and a number.
	:raises ValueError: a field or colour map that does not exist, *grid* or *ghost* without *deformed* or where processes have divided the points, *plane* in plane strain or beside the
		body, *vectors* that are none or *contours* that are no levels, a scene without material points, or what the engine refuses about the scene.
	:raises OSError: the file cannot be written.
	"""
	if not deformed and (grid or ghost or loads):
		raise ValueError('plot: the grid and loads belong to the current configuration, so grid, ghost and loads need deformed=True')
	if (grid or ghost) and isDivided(): raise ValueError('plot: no process has all cells where processes have divided the points, so grid and ghost cannot be drawn')
	if loads is None: loads = deformed
	solver = solverOf('plot', solver)
	points = fields()
	if not len(points['id']): raise ValueError('plot: the scene has no material points')
	values, arrows, levels = scalarOrArray('plot', field, points), vectorsOf(vectors, points), levelsOf(contours)
	section = _Section(solver, points, plane)
	matter, kept, dots = section.matter(points, deformed)
	isOwn, ax = ax is None, ax or _newAxes(fileName, np.concatenate(matter), section.normal is not None)
	if grid: _drawGrid(ax, section, solver)
	_drawMatter(ax, matter, values[kept], field, range, colormap)
	if dots: ax.plot([], [], 'o', color=_cellColour, label=f'dots: {dots} points strongly stretched, more than {stretched.longest} : 1')
	if ghost: _drawFaces(ax, section, solver)
	places = points['pos' if deformed else 'pos0'][kept][:, section.shown]
	if levels is not None: drawContours(ax, places, values[kept], levels, 2 * points['halfSize0'].max() if solver.grid.dim == 3 else 2 * points['halfSize0'][:, :2].max())
	if arrows is not None: drawVectors(ax, arrows[kept], places, section.shown, labelOf(vectors))
	if section.normal is not None and isOwn: drawTrace(ax, section.normal, section.at, points)
	if loads and len(solver.loads): _drawSurfaces(ax, section, solver, 'loads', _loadColour)
	if loads and any(boundary.surface for boundary in solver.boundaries): _drawSurfaces(ax, section, solver, 'walls', _wallColour)
	if loads and len(solver.contacts): _drawRigid(ax, section, solver)
	if loads and len(solver.contacts) and section.normal is None: _drawPressure(ax, section, solver)
	_finish(ax, section, momentOf(solver) + ('' if deformed else ', at the initial positions'), isOwn)
	if fileName is not None: write('plot', ax.figure, fileName)
	return ax


class _Section:
	"""The plane of the picture: all there is in plane strain, a slice in 3D."""

	def __init__(self, solver, points, plane):
		self.normal, self.at = None, None
		if solver.grid.dim == 3: self.normal, self.at = _slicePlane(plane, points, solver.gravity)
		elif plane is not None: raise ValueError(f'plot: plane = {brief(plane)}: with dim=2 (plane strain) the picture is in the plane x-y')
		self.shown = [i for i in (0, 1, 2) if i != (2 if self.normal is None else self.normal)]

	def boxes(self, low, high):
		"""Lower and upper corners (M, 2) in the picture of the boxes that the section cuts, and their indices."""
		if self.normal is None: kept = np.arange(len(low))
		else: kept = np.flatnonzero((low[:, self.normal] <= self.at) & (self.at < high[:, self.normal]))
		return low[kept][:, self.shown], high[kept][:, self.shown], kept

	def matter(self, points, deformed):
		"""Outlines in the picture, each (K, 2), of what points stand for, the indices of those that the section cuts, and how many of them are dots."""
		dim = 2 if self.normal is None else 3
		middles, box = points['pos' if deformed else 'pos0'], signs * points['halfSize0'][:, None, :]
		radii = stretched.radiiOfStretched(points['defGrad'], points['halfSize0'], dim) if deformed else np.full(len(middles), np.nan)
		boxes = np.flatnonzero(np.isnan(radii))
		deformedBox = np.einsum('pij,pcj->pci', points['defGrad'][boxes], box[boxes]) if deformed else box
		outlines, kept = self.through(middles[boxes][:, None, :] + deformedBox)
		if self.normal is not None: radii = stretched.cutSpheres(middles, radii, self.normal, self.at)
		dots = np.flatnonzero(~np.isnan(radii))
		return [*outlines, *stretched.discs(middles[dots][:, self.shown], radii[dots])], np.concatenate([boxes[kept], dots]), len(dots)

	def through(self, corners):
		"""Outlines in the picture, each (K, 2), of the deformed boxes (N, 8, 3) that the section cuts, and their indices."""
		if self.normal is None: return corners[:, _around][:, :, self.shown], np.arange(len(corners))
		above = corners[..., self.normal] > self.at
		kept = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
		return [inOrder(cut(corners[i], above[i], boxEdges, self.normal, self.at)) for i in kept], kept

	def lines(self, corners):
		"""(M, 2, 2) ends in the picture of the segments or cut triangles (N, 2 or 3, 3) that the section cuts, and their indices."""
		if self.normal is None: return corners[:, :, self.shown], np.arange(len(corners))
		above = corners[..., self.normal] > self.at
		kept = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
		return np.array([cut(corners[i], above[i], triangleSides, self.normal, self.at) for i in kept]).reshape(-1, 2, 2), kept


def _slicePlane(plane, points, gravity):
	low, high = (points['pos'] - points['halfSize']).min(axis=0), (points['pos'] + points['halfSize']).max(axis=0)
	if plane is None:
		axis = _across(gravity, high - low)
		x = points['pos'][:, axis]
		return axis, x[np.argmin(np.abs(x - (low[axis] + high[axis]) / 2))]
	try:
		axis, at = _axes.index(plane[0]), float(plane[1])
	except (TypeError, ValueError, IndexError):
		raise TypeError(f"plot: plane = {brief(plane)} must be a pair of an axis and a coordinate, as in ('z', 0.5)") from None
	if not low[axis] <= at < high[axis]:
		raise ValueError(f'plot: plane = {brief(plane)} is beside the body, which reaches from {_axes[axis]} = {low[axis]} to {high[axis]} m')
	return axis, at + 1e-6 * points['halfSize'][:, axis].min()  # not where boxes touch, but for round-off


def _across(gravity, size):
	"""The axis that a slice is normal to: of those that gravity is not along the one along which the body is shorter, z if they are equal; z without gravity."""
	gravity = np.abs(np.array(gravity))
	if not gravity.any(): return 2
	level = [axis for axis in (2, 1, 0) if axis != np.argmax(gravity)]
	return level[int(size[level[1]] < (1 - 1e-6) * size[level[0]])]


def _newAxes(fileName, outlines, withTrace):
	width, height = np.ptp(outlines.reshape(-1, 2), axis=0)
	scale = min(8 / width, 7 / height)
	size = max(2.5, scale * width) + (4.2 if withTrace else 1.6), max(1.5, scale * height) + 0.9  # room for labels, colour bar and the small picture included
	if fileName is None:
		import matplotlib.pyplot as pyplot
		return pyplot.figure(figsize=size).add_subplot()
	from matplotlib.figure import Figure  # needs no window
	return Figure(figsize=size).add_subplot()


def _rectangles(low, high):
	"""(M, 4, 2) corners in order around each box."""
	return np.stack([low, np.stack([high[:, 0], low[:, 1]], 1), high, np.stack([low[:, 0], high[:, 1]], 1)], 1)


def _gridBoxes(kind, section, solver):
	"""Corners in the picture of cells or faces, and the value of their field."""
	data = engine.gridCells(kind, solver)
	field = np.frombuffer(data['field'])
	if not len(field): return np.empty((0, 2)), np.empty((0, 2)), field
	corners = np.frombuffer(data['corners']).reshape(len(field), -1, 3)
	low, high, kept = section.boxes(corners.min(axis=1), corners.max(axis=1))
	return low, high, field[kept]


def _drawGrid(ax, section, solver):
	from matplotlib.collections import PolyCollection
	low, high, boundary = _gridBoxes('grid', section, solver)
	cells = _rectangles(low, high)
	isBoundary = boundary == 1
	if isBoundary.any(): ax.add_collection(PolyCollection(cells[isBoundary], facecolors=_boundaryColour, edgecolors='none', zorder=0, label='boundary cells'))
	ax.add_collection(PolyCollection(cells, facecolors='none', edgecolors=_cellColour, linewidths=0.4, zorder=3))
	ax.update_datalim(cells.reshape(-1, 2))


def _drawFaces(ax, section, solver):
	from matplotlib.collections import LineCollection
	low, high, _ = _gridBoxes('ghostFaces', section, solver)
	if len(low): ax.add_collection(LineCollection(np.stack([low, high], 1), colors=_faceColour, linewidths=1.1, zorder=4, label='ghost faces'))


def _drawSurfaces(ax, section, solver, kind, colour):
	"""Draws loads or walls, with the first field of their picture, if that is a vector, as the forces that act on the body."""
	from matplotlib.collections import LineCollection
	data = engine.gridCells(kind, solver)
	count = data['count']
	if not count: return
	lines, kept = section.lines(np.frombuffer(data['corners']).reshape(count, -1, 3))
	if not len(kept): return
	ax.add_collection(LineCollection(lines, colors=colour, linewidths=1.8, zorder=5, label=kind))
	ax.update_datalim(lines.reshape(-1, 2))
	vectors = np.frombuffer(data['field']).reshape(count, -1)
	if vectors.shape[1] != 3: return
	shown = np.linspace(0, len(kept) - 1, min(len(kept), 25)).astype(int)
	tips, forces = lines[shown].mean(axis=1), np.nan_to_num(vectors[kept[shown]])[:, section.shown]
	length = 0.06 * np.ptp(ax.dataLim.get_points(), axis=0).max()
	largest = np.abs(forces).max()
	if largest == 0: return
	ax.quiver(*tips.T, *(forces / largest * length).T, color=colour, pivot='tip', angles='xy', scale_units='xy', scale=1, width=0.003, zorder=5)


def _drawRigid(ax, section, solver):
	"""Draws them so far as they are beside the body."""
	from matplotlib.collections import LineCollection
	normal, at = (2, 0) if section.normal is None else (section.normal, section.at)
	low, high = ax.dataLim.get_points()
	margin = 0.3 * (high - low).max()
	lines = [outline(body, normal, at, (low, high)) for body in touchable(solver)]
	ax.add_collection(LineCollection([line for line in lines if len(line)], colors=_rigidColour, linewidths=1.2, zorder=5, label='rigid bodies'), autolim=False)
	for line in lines:
		ax.update_datalim(line.clip(low - margin, high + margin))


def _drawPressure(ax, section, solver):
	"""Draws pressure and friction of bodies, per area: lines from their faces, against the force on the soil."""
	from matplotlib.collections import LineCollection
	places, force, ends = contactFaces(solver)
	touching = force.any(axis=1)
	if not touching.any(): return
	area = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) * (2 * np.pi * places[:, 0] if solver.grid.axisymmetric else 1)
	places, traction = places[touching][:, section.shown], (force[touching].T / area[touching]).T[:, section.shown]
	largest = np.linalg.norm(traction, axis=1).max()
	lengths = -0.1 * (ax.dataLim.get_points()[1] - ax.dataLim.get_points()[0]).max() / largest * traction
	size, label = labelled('meanStress', traction)
	unit = label[label.index('[') + 1:-1]
	lines = LineCollection(np.stack([places, places + lengths], 1), colors=_rigidColour, linewidths=0.6, zorder=5, label=f'contact, up to {largest / size:.4g} {unit}')
	ax.add_collection(lines, autolim=False)


def _drawMatter(ax, matter, values, field, range, colormap):
	from matplotlib.collections import PolyCollection
	bounds = limits('plot', range, values)
	if range is None and values.min() < 0 < values.max() and hasSign(field, values): bounds = -np.abs(values).max(), np.abs(values).max()
	unit, label = labelled(field, values if range is None else np.array(bounds)) if isinstance(field, str) else (1, None)
	drawn = PolyCollection(
	        matter,
	        array=values / unit,
	        cmap=coloursOf('plot', field, colormap, values, bounds),
	        clim=(bounds[0] / unit, bounds[1] / unit),
	        edgecolors='face',
	        linewidths=0.2,
	        zorder=2
	)
	ax.add_collection(drawn)
	ax.update_datalim(np.concatenate(matter))
	beyond = values.min() < bounds[0], values.max() > bounds[1]
	extend = {(False, False): 'neither', (True, False): 'min', (False, True): 'max', (True, True): 'both'}[beyond]
	ax.figure.colorbar(drawn, cax=ax.inset_axes([1.02, 0, 0.025, 1]), label=label, extend=extend)


def momentOf(solver):
	"""Title of a picture: the time, the load factor, or the stage that is or was the last one."""
	if isinstance(solver, wrapper.MpmDynamicEngine): return f'time {solver.loadTime:.4g} s'
	stage = stages.now(solver)
	if stage: return stage
	factor = f'load factor {solver.loadFactor:.4g}'
	if abs(solver.loadTime - solver.loadFactor) <= 1e-9 * max(1, abs(solver.loadTime)): return factor
	return f'load time {solver.loadTime:.4g}' + ('' if solver.loadFactor == 1 else ', ' + factor)


def _finish(ax, section, title, isOwn):
	ax.margins(0.02)
	ax.autoscale_view()
	place = '' if section.normal is None else f'  (at {_axes[section.normal]} = {section.at:.4g} m)'
	ax.set(aspect='equal', xlabel=f'{_axes[section.shown[0]]} [m]{place}', ylabel=f'{_axes[section.shown[1]]} [m]')
	handles, names = ax.get_legend_handles_labels()
	rows = 0 if not handles else (len(handles) + 1) // 2
	if isOwn: rows = _spread(ax, rows, len(handles))
	if handles: ax.legend(handles, names, loc='lower right', bbox_to_anchor=(1, 1), ncols=1 if rows == len(handles) else 2, frameon=False, fontsize='small', borderaxespad=0.2)
	if not ax.get_title(): ax.set_title(title, fontsize='medium', pad=8 + 14 * rows if handles else None)  # above the legend


def _spread(ax, rows, entries):
	"""Sets the number of ticks that fits into narrow axes; returns the rows of the legend, one for each entry there."""
	ax.apply_aspect()
	box, dpi = ax.get_window_extent(), ax.figure.dpi
	for axis, length, each in (ax.xaxis, box.width, 0.6), (ax.yaxis, box.height, 0.3):
		axis.get_major_locator().set_params(nbins=int(np.clip(length / dpi / each, 1, 9)), min_n_ticks=1)
	return entries if box.width < 4.5 * dpi else rows


@byFirst
def write(who, figure, fileName):
	"""A figure to a file, whole or not at all, for the function *who*."""
	fileName = pathOf(who, 'fileName', fileName)
	ending = os.path.splitext(fileName)[1][1:]
	known = figure.canvas.get_supported_filetypes()
	if ending not in known: raise ValueError(f"{who}: fileName = {fileName!r} must end in one of {', '.join('.' + kind for kind in known)}")
	with replacing(fileName) as temporary:
		figure.savefig(temporary, dpi=200, bbox_inches='tight', format=ending)
