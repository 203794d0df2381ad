# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit loads of sand that are known, with psi = phi."""
from math import exp, pi, radians, tan

# Results of the method of characteristics (Martin 2005, ABC), bounded by limit analysis (Hjiaj, Lyamin and Sloan 2005), by the angle of friction [degrees]:
# smooth, rough.
weights = {20: (1.579, 2.839), 30: (7.653, 14.75)}


def surchargeFactor(phi):
	"""N_q (Reissner 1924)."""
	return exp(pi * tan(radians(phi))) * tan(radians(45 + phi / 2))**2


def cohesionFactor(phi):
	"""N_c (Prandtl 1920)."""
	return (surchargeFactor(phi) - 1) / tan(radians(phi))


def weightFactor(phi, isRough):
	"""N_gamma."""
	return weights[phi][isRough]


def rankine(phi, isPassive):
	"""K of a smooth wall."""
	return tan(radians(45 + phi / 2 * (1 if isPassive else -1)))**2
