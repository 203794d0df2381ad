# SPDX-License-Identifier: GPL-2.0-or-later
"""Colours of the material points in YADE's 3D view."""
import numpy as np

from ..base.messages import brief
from ..library import engine
from ..points.data import fields
from ..points.fields import scalar


def colour(field, range=None, colormap=None):
	"""Colour the material points in YADE's 3D view by a scalar field.

	To keep the colours up to date behind the solver: ``PyRunner(iterPeriod=1, command="mpm.colour('plasticStrain')")``.

	:param field: name as in :func:`plot`, or an (N,) array in order of body id
	:param range: (low, high): values with the first and last colour, beyond which colours do not change; by default the smallest and
		largest value at this moment, a little beyond if they are equal
	:param colormap: name of a colour map of matplotlib; by default that of the quantity, as for :func:`plot`
	:return: the range used
	:raises TypeError: *range* is no pair of numbers.
	:raises ValueError: a field or colour map that does not exist, an array of another length or with values that are not finite, or a range that
		is not increasing.
	"""
	points = fields()
	values = scalarOrArray('colour', field, points)
	low, high = limits('colour', range, values)
	share = np.clip((values - low) / (high - low), 0, 1)
	rgb = np.ascontiguousarray(coloursOf('colour', field, colormap, values, (low, high))(share)[:, :3], dtype=float)
	engine.assignColumns(points['id'], {'color': rgb})
	return low, high


def colourMap(who, name):
	"""matplotlib's colour map of this name."""
	import matplotlib
	try:
		return matplotlib.colormaps[name]
	except (KeyError, TypeError):
		raise ValueError(f"{who}: colormap = {brief(name)} is not a colour map of matplotlib, such as 'viridis' or 'RdBu_r'") from None


def coloursOf(who, field, name, values, bounds):
	"""The colour map for a field from the low to the high one of its bounds: by name if one is given, else that of the quantity, of which those with a sign have zero at the same colour everywhere."""
	if name is not None: return colourMap(who, name)
	own = mapOf(field, values)
	if own not in ('RdBu_r', 'RdBu'): return colourMap(who, own)
	from matplotlib.colors import LinearSegmentedColormap
	ends = np.array(bounds) / max(abs(bounds[0]), abs(bounds[1]))
	if ends[0] * ends[1] > 0: ends[np.argmin(np.abs(ends))] = np.sign(ends[0]) * min(np.abs(ends).min(), 0.25)  # far from zero there would be one colour
	part = np.linspace(*ends, 256)
	return LinearSegmentedColormap.from_list(own, colourMap(who, own)((part + 1) / 2))


def mapOf(field, values=()):
	"""Name of the colour map of a quantity."""
	if not isinstance(field, str): return 'RdBu_r' if len(values) and values.min() < 0 < values.max() else 'viridis'
	base, _, component = field.partition('_')
	if base == 'porePressure': return 'RdBu'  # suction is as tension
	if base == 'plasticStrain': return 'YlOrRd'
	if base in ('meanStress', 'stress', 'totalStress', 'strain', 'elasticStrain') or component and base in ('displacement', 'velocity', 'acceleration', 'force'): return 'RdBu_r'
	return 'viridis'


def hasSign(field, values):
	"""True if its colours are about zero."""
	return mapOf(field, values) in ('RdBu_r', 'RdBu')


def scalarOrArray(who, field, points):
	"""Values (N,) of a field given by name or as they are."""
	if isinstance(field, str): return scalar(who, field, points)
	values = np.asarray(field)
	if values.shape != points['id'].shape or values.dtype.kind not in 'biuf':
		raise ValueError(f'{who}: field must be a name, or an array of one number for each of {len(points["id"])} material points; given is {brief(field)}')
	if not np.isfinite(values).all(): raise ValueError(f'{who}: field[{np.flatnonzero(~np.isfinite(values))[0]}] is not finite')
	return values.astype(float)


def limits(who, range, values):
	"""(low, high) as given, or of the values."""
	if range is None: return _ownLimits(values)
	try:
		low, high = map(float, range)
	except (TypeError, ValueError):
		raise TypeError(f'{who}: range = {brief(range)} must be a pair of numbers, (low, high)') from None
	if not (np.isfinite([low, high]).all() and low < high): raise ValueError(f'{who}: range = {brief(range)} must be finite and increasing')
	return low, high


def _ownLimits(values):
	if not len(values): return 0., 1.
	low, high = float(values.min()), float(values.max())
	size = max(abs(low), abs(high))
	if high - low > 1e-9 * size: return low, high
	return low - (0.01 * size or 1.), high + (0.01 * size or 1.)  # constant but for round-off, which is not to be coloured
