# SPDX-License-Identifier: GPL-2.0-or-later
"""The data of all material points as NumPy arrays."""
import numpy as np

from .library import engine

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
	data = engine.columnsOfPoints()
	return {name: np.frombuffer(data[name], kind).reshape((-1, ) + shape) for name, (kind, shape) in _columns.items()}
