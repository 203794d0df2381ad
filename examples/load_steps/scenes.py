# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes to run, and their numbers of load steps."""
from dataclasses import dataclass


@dataclass
class Scene:
	"""A script of another example.

	:param displacement: root mean square of the points' displacements at the end, roughly [m]
	:param fixed: numbers of steps
	:param reference: the number of steps with which the others are compared
	:param isElastic: no point yields
	"""
	what: str
	script: str
	arguments: dict
	displacement: float
	fixed: tuple
	reference: int
	isElastic: bool = False


few, usual, many = (1, 2, 3, 4, 5, 6, 8), (10, 12, 16, 20, 24, 32, 40), (64, 80, 160)
trade = lambda scene, cells, dim=2: ('trade/scenes.py', dict(scene=scene, dim=dim, cells=cells))
scenes = {
        'column': Scene('elastic column that is compressed to half', *trade('column', 16), 17, few + usual + many[:2], 640, True),
        'column3d': Scene('the same in 3D', *trade('column', 16, 3), 17, few + usual + many[:2], 320, True),
        'cantilever': Scene('elastic beam that bends by 70 degrees', *trade('cantilever', 2), 4.4, few + usual, 80, True),
        'slope': Scene('slope with a weak layer', *trade('slope', 1), 1.4, few + usual + many, 320),
        'collapse': Scene('block that collapses', *trade('collapse', 2), 1.2, few + usual + many, 640),
        'friction': Scene('slope in frictional soil', 'slope/friction.py', {}, 0.38, few + usual + many, 320),
        'footing': Scene('footing with contact', 'penetration/penetration.py', dict(scene='footing', cells=4, picture=0), 0.023, few + usual + many, 320),
}
