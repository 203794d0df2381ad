# SPDX-License-Identifier: GPL-2.0-or-later
"""Marks on top of pictures of the points: arrows, contour lines, and the position of a slice in the body."""
import numpy as np

from ..base.messages import brief, isNumber
from ..base.naming import didYouMean
from ..points.data import table

_ink = '#212529'


def vectorsOf(name, points):
	"""(N, 3) of a column of vectors, or as they are given; None: none."""
	if name is None: return None
	if not isinstance(name, str):
		values = np.asarray(name, float) if np.ndim(name) == 2 else np.empty(0)
		if values.shape == (len(points['id']), 3) and np.isfinite(values).all(): return values
		raise ValueError(f'plot: vectors = {brief(name)} must be the name of a vector, or an array ({len(points["id"])}, 3) of finite numbers')
	if name in points and points[name].ndim == 2: return points[name]
	known = [column for column, values in points.items() if values.ndim == 2]
	raise ValueError(f"plot: vectors = {brief(name)} is no vector of the points{didYouMean(name, known) or ';'} there are {', '.join(known)}")


def drawVectors(ax, vectors, places, shown, label):
	"""About twenty arrows across the picture, the longest a fifteenth of it, which is told below."""
	low, size = places.min(axis=0), np.ptp(places, axis=0).max() or 1.
	cells = np.unique(np.floor((places - low) / (size / 20)).astype(int), axis=0, return_index=True)[1]
	arrows = vectors[cells][:, shown]
	longest = np.linalg.norm(arrows, axis=1).max(initial=0)
	if longest == 0: return
	ax.quiver(*places[cells].T, *arrows.T, color=_ink, angles='xy', scale_units='xy', scale=longest / (size / 15), width=0.0025, zorder=6)
	ax.annotate(f'arrows: {label} {longest:.3g}', (0, 0), xycoords='axes fraction', xytext=(0, -48), textcoords='offset points', fontsize='small')


def labelOf(name):
	return f"{table[name]['label']} [{table[name]['unit']}], at most" if isinstance(name, str) else 'at most'


def levelsOf(contours):
	"""Levels as matplotlib takes them: their number or the levels; None: none."""
	if contours is None or contours is False: return None
	if isNumber(contours) and contours == int(contours) and contours >= 1: return int(contours)
	try:
		levels = [float(level) for level in contours]
	except (TypeError, ValueError):
		levels = []
	if levels and np.isfinite(levels).all() and (np.diff(levels) > 0).all(): return levels
	raise ValueError(f'plot: contours = {brief(contours)} must be a number of lines >= 1, or their values, increasing')


def drawContours(ax, places, values, levels, spacing):
	"""Lines through triangles between the middles of neighbouring points; those longer than two spacings are left out."""
	from matplotlib.tri import Triangulation
	if len(places) < 3 or np.ptp(values) == 0: return
	mesh = Triangulation(*places.T)
	corners = places[mesh.triangles]
	longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
	mesh.set_mask(longest > 2 * spacing)
	lines = ax.tricontour(mesh, values, levels, colors=_ink, linewidths=0.7, zorder=6)
	ax.clabel(lines, fontsize='x-small', fmt='%.4g')


def drawTrace(ax, normal, at, points):
	"""A small view along the picture's horizontal axis: the body, and the line of the slice."""
	from matplotlib.transforms import ScaledTranslation
	across = next(axis for axis in (1, 2, 0) if axis != normal)
	inches = ax.figure.dpi_scale_trans + ScaledTranslation(1.045, 1, ax.transAxes)  # from the upper right corner of the colour bar
	frame = ax.inset_axes([1.55, -1.1, 0.9, 0.9], transform=inches)
	x, y = points['pos'][:, normal], points['pos'][:, across]
	half = points['halfSize']
	low, high = (x - half[:, normal]).min(), (x + half[:, normal]).max()
	frame.plot(x, y, '.', color='#adb5bd', markersize=1, markeredgewidth=0)
	frame.axvline(at, color='#d9480f', linewidth=1.2)
	frame.set(xlim=(low - 0.1 * (high - low), high + 0.1 * (high - low)), xlabel=f'{"xyz"[normal]} [m]', ylabel=f'{"xyz"[across]} [m]', title='slice')
	frame.tick_params(labelsize='x-small')
	frame.locator_params(nbins=2)
	for text in (frame.xaxis.label, frame.yaxis.label, frame.title):
		text.set_size('x-small')
