# SPDX-License-Identifier: GPL-2.0-or-later
"""Common parts of the scenes of the stability atlas."""
from yade.wrapper import MpmGhost

cellSize = 0.1 # [m] where it is not the parameter: at 1 m the two scalings would be the same
young = 1e6
fullNewton = dict(predictor=False, reuseFactor=False) # steps start from zero: the number of iterations tells how hard one is


def stabilisation(ghost, factor=1e-2):
	return MpmGhost(factor=0) if ghost == 'none' else MpmGhost(factor=factor, scaling=ghost)
