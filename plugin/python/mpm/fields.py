# SPDX-License-Identifier: GPL-2.0-or-later
"""Scalar fields of the material points by name, as pictures and tables show them."""
import numpy as np

from .messages import brief

_units = {
        'pos': 'm',
        'pos0': 'm',
        'halfSize': 'm',
        'halfSize0': 'm',
        'displacement': 'm',
        'force': 'N',
        'stress': 'Pa',
        'meanStress': 'Pa',
        'sqrt2J2': 'Pa',
        'volume': 'm³',
        'elasticStrain': '-',
        'defGrad': '-',
        'plasticStrain': '-',
        'material': '-',
        'id': '-',
}

_labels = {
        'displacement': 'displacement',
        'stress': 'stress $\\sigma$',
        'meanStress': 'mean stress',
        'sqrt2J2': '$\\sqrt{2J_2}$',
        'elasticStrain': 'elastic strain $\\varepsilon$',
        'defGrad': 'deformation gradient $F$',
        'plasticStrain': 'plastic strain',
        'halfSize': 'half size',
        'halfSize0': 'initial half size',
        'pos': 'position',
        'pos0': 'initial position',
        'force': 'point load',
        'volume': 'volume',
}


def withDerived(points):
	"""The columns of ``mpm.arrays()`` and those that MpmVtkRecorder adds: displacement, meanStress, sqrt2J2."""
	deviator = points['stress'] - np.eye(3) * (np.trace(points['stress'], axis1=1, axis2=2) / 3)[:, None, None]
	return points | {
	        'displacement': points['pos'] - points['pos0'],
	        'meanStress': np.trace(points['stress'], axis1=1, axis2=2) / 3,
	        'sqrt2J2': np.sqrt((deviator**2).sum(axis=(1, 2))),
	}


def components(name, column):
	"""Names of the scalars that a column consists of, and their values: stress_xx, stress_xy, ..."""
	if column.ndim == 1: return {name: column}
	if column.ndim == 2: return {f'{name}_{"xyz"[i]}': column[:, i] for i in range(3)}
	return {f'{name}_{"xyz"[i]}{"xyz"[j]}': column[:, i, j] for i in range(3) for j in range(3)}


def scalar(who, name, points):
	"""Values (N,) of a scalar field.

	:param who: function that asks, for messages
	:param name: a column of ``mpm.arrays()``, displacement, meanStress or sqrt2J2; of a vector or tensor with its component behind an
		underscore (stress_xy); displacement alone is its length
	:raises ValueError: there is no such field.
	"""
	columns = withDerived(points)
	if name == 'displacement': return np.linalg.norm(columns[name], axis=1)
	base = str(name).partition('_')[0]
	found = components(base, columns[base]) if base in columns else {}
	if name in found: return found[name]
	if found: raise ValueError(f"{who}: field = {brief(name)}: one component must be chosen, out of {', '.join(found)}")
	raise ValueError(f"{who}: field = {brief(name)} is not known; there are {', '.join(columns)}, with components as in stress_xy or displacement_y")


def labelled(name, values):
	"""Size of a readable multiple of a field's unit, and the label that says so: ('stress_xx', [-2e4]) -> 1e3, 'stress ... [kPa]'."""
	base, _, component = name.partition('_')
	unit = _units[base]
	label = _labels.get(base, base)
	if component: label = label[:-1] + f'_{{{component}}}$' if label.endswith('$') else f'{label} {component}'
	largest = np.abs(values).max(initial=0)
	for prefix, size in ('M', 1e6), ('k', 1e3):
		if unit in ('Pa', 'N') and largest >= 2 * size: return size, f'{label} [{prefix}{unit}]'
	return 1., f'{label} [{unit}]'
