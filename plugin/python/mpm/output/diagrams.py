# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces and moments of bars and beams, drawn on them."""
import numpy as np
from yade import wrapper

from ..base.messages import brief

_quantities = dict(axialForce='axialForces', shearForce='shearForces', moment='moments', hoopForce='hoopForces', hoopMoment='hoopMoments')
_colours = dict(axialForce='tab:blue', shearForce='tab:green', moment='tab:red', hoopForce='tab:purple', hoopMoment='tab:orange')


def diagram(line, quantity='moment', axes=None, size=None):
	"""Draw a force or moment of a bar or beam in the plane across its deformed line, positive values to its left.

	:param line: an ``MpmBeam`` or ``MpmReinforcement`` that has made a step
	:param quantity: 'moment' [N m], 'shearForce' or 'axialForce' [N], and of a shell of revolution 'hoopForce' [N/m] and 'hoopMoment' [N m/m]; of a reinforcement there is 'axialForce' only
	:param axes: those of matplotlib to draw in, as ``mpm.plot(...)`` returns them; may be left out for the current ones
	:param size: length [m] of the largest value, > 0; may be left out: a sixth of the length of the line
	:return: the axes
	:raises TypeError: *line* is none of the two.
	:raises ValueError: it has made no step, it has no such *quantity*, or *size* <= 0.
	"""
	if not isinstance(line, (wrapper.MpmBeam, wrapper.MpmReinforcement)): raise TypeError(f'diagram: line = {brief(line)} must be an MpmBeam or an MpmReinforcement')
	known = [name for name, attribute in _quantities.items() if hasattr(line, attribute)]
	if quantity not in known: raise ValueError(f'diagram: quantity = {quantity!r} must be one of {known}')
	if not len(line.vertices): raise ValueError('diagram: the line has made no step yet; run the scene first')
	x, values = np.array(line.vertices)[:, :2], np.array(getattr(line, _quantities[quantity]))
	if not len(values): raise ValueError(f'diagram: quantity = {quantity!r} is that of a shell of revolution, and the line is in the plane')
	along = np.diff(x, axis=0)
	length = np.linalg.norm(along, axis=1)
	size = length.sum() / 6 if size is None else size
	if not size > 0: raise ValueError(f'diagram: size = {brief(size)} must be > 0 [m]')
	ends = np.c_[values, values] if len(values) == len(along) else np.c_[values[:-1], values[1:]]
	aside = np.c_[-along[:, 1], along[:, 0]] / length[:, None]
	offsets = ends * (size / (np.abs(values).max() or 1))
	import matplotlib.patheffects
	import matplotlib.pyplot as plt
	axes = axes or plt.gca()
	for (first, last), (a, b), normal in zip(zip(x, x[1:]), offsets, aside):
		axes.fill(*np.array([first, last, last + b * normal, first + a * normal]).T, color=_colours[quantity], alpha=0.5, linewidth=0, zorder=4)
	axes.plot(*x.T, color='black', linewidth=2, zorder=5)
	largest = np.abs(values).argmax()
	piece = min(largest, len(aside) - 1)
	isWhole = len(getattr(line, 'hoopForces', ())) and 'hoop' not in quantity  # force of a shell around the whole circle
	text = f'{values[largest] / 1e3:.3g} kN{" m" if "oment" in quantity else ""}{"" if isWhole else "/m"}'
	way = offsets[piece, 0] * aside[piece]
	side = 'left' if way[0] >= 0 else 'right'  # the text stands beyond the diagram, not across the line
	axes.annotate(
	        text, x[largest] + way, (4 if side == 'left' else -4, 0), textcoords='offset points', ha=side, color='black', zorder=6, clip_on=True,
	        path_effects=[matplotlib.patheffects.withStroke(linewidth=3, foreground='white')]
	)
	return axes
