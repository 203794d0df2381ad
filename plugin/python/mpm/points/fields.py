# SPDX-License-Identifier: GPL-2.0-or-later
"""Scalar fields of the material points by name, as pictures and tables show them."""
import numpy as np

from ..base.messages import brief
from ..base.naming import didYouMean
from .data import table


def components(name, column):
	"""Names of the scalars that a column consists of, and their values: stress_xx, stress_xy, ..."""
	if column.ndim == 1: return {name: column}
	if column.ndim == 2: return {f'{name}_{"xyz"[i]}': column[:, i] for i in range(3)}
	return {f'{name}_{"xyz"[i]}{"xyz"[j]}': column[:, i, j] for i in range(3) for j in range(3)}


def scalar(who, name, columns):
	"""Values (N,) of a scalar field.

	:param who: function that asks, for messages
	:param name: one of the columns; of a vector or tensor with its component behind an underscore (stress_xy); displacement alone is its length
	:param columns: of the points, as ``data.fields()`` gives them
	:raises ValueError: there is no such field.
	"""
	if name == 'displacement': return np.linalg.norm(columns[name], axis=1)
	base = str(name).partition('_')[0]
	found = components(base, columns[base]) if base in columns else {}
	if name in found: return found[name]
	if found: raise ValueError(f"{who}: field = {brief(name)}: one component must be chosen, out of {', '.join(found)}")
	raise ValueError(f"{who}: field = {brief(name)} is not known{didYouMean(name, _scalars(columns)) or ';'} there are {', '.join(columns)}, with components as in stress_xy or displacement_y")


def _scalars(columns):
	return [scalar for name, column in columns.items() for scalar in components(name, column)]


def labelled(name, values):
	"""Size of a readable multiple of a field's unit, and the label that says so: ('stress_xx', [-2e4]) -> 1e3, 'stress ... [kPa]'; displacements below 10 cm are in mm."""
	base, _, component = name.partition('_')
	unit, label = table[base]['unit'], table[base]['label']
	if component: label = label[:-1] + f'_{{{component}}}$' if label.endswith('$') else f'{label} {component}'
	largest = np.abs(values).max(initial=0)
	for prefix, size in ('M', 1e6), ('k', 1e3):
		if unit in ('Pa', 'N') and largest >= 2 * size: return size, f'{label} [{prefix}{unit}]'
	if base == 'displacement' and 0 < largest < 0.1: return 1e-3, f'{label} [mm]'
	return 1., f'{label} [{unit}]'
