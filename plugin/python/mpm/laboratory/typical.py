# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of soil that nobody has tested, from what is known of many."""
import math

from ..base.messages import brief, isNumber, numberOf
from ..library import engine


def typicalSand(relativeDensity, pressure, poisson, saturated=False):
	"""Typical values for sand of a relative density: to begin with, where there are no tests; :func:`calibrate` takes those that there are. ::

		sand = MpmMohrCoulombMat(label='sand', **mpm.typicalSand(0.6, pressure=50e3, poisson=0.3))

	Formulas of R. B. J. Brinkgreve, E. Engin and H. K. Engin, Validation of empirical formulas to derive model parameters for sands, Numerical methods in geotechnical
	engineering, 2010, pages 137 to 142, made for quartz sands, with scatter (R is the relative density):

	- ``young`` = 60 MPa x R (pressure / 100 kPa)^(0.7 - R / 3.2), their secant modulus E50 at half of the triaxial strength. It is that of first loading; of
	  unloading they have three times as much, which a law with one modulus does not know;
	- ``frictionAngle`` = 28 + 12.5 R and ``dilationAngle`` = -2 + 12.5 R degrees; below R = 0.16, where the latter is negative, it is 0, with a warning;
	- ``density`` of a unit weight of 15 + 4 R kN/m3 above water, 19 + 1.6 R of saturated sand, at 9.81 m/s2; ``cohesion`` = 0.

	:param relativeDensity: (e_max - e) / (e_max - e_min) of the void ratio e, from 0.1 to 1 [-]
	:param pressure: smallest principal effective pressure > 0 where the sand is, for the modulus [Pa]
	:param poisson: Poisson's ratio, of which the formulas say nothing, from 0 to 0.5, 0.5 excluded [-]
	:param saturated: whether *density* is that of saturated sand
	:return: dict of attributes of an MpmMohrCoulombMat or MpmDruckerPragerMat by name, angles in radians
	:raises TypeError: a value is no number, or *saturated* no bool.
	:raises ValueError: a value that is not admitted.
	"""
	who = 'typicalSand'
	percent = '; it is a fraction, 0.6 for 60 %' if isNumber(relativeDensity) and 1 < relativeDensity <= 100 else ''
	R = numberOf(who, 'relativeDensity', relativeDensity, f'a number from 0.1 to 1 [-]{percent}', lambda value: 0.1 <= value <= 1)
	pressure = numberOf(who, 'pressure', pressure, 'a number > 0 [Pa], positive in compression', lambda value: value > 0)
	poisson = numberOf(who, 'poisson', poisson, 'a number from 0 to 0.5, 0.5 excluded [-]', lambda value: 0 <= value < 0.5)
	if not isinstance(saturated, bool): raise TypeError(f'{who}: saturated = {brief(saturated)} must be True or False')
	dilation = 12.5 * R - 2
	if dilation < 0: engine.warn(f'typicalSand: the formulas give sand of relativeDensity = {R:g} a dilation of {dilation:.3g} degrees; the laws here admit none below 0, which is taken.')
	weight = 19e3 + 1.6e3 * R if saturated else 15e3 + 4e3 * R
	return dict(
	        young=60e6 * R * (pressure / 100e3)**(0.7 - R / 3.2),
	        poisson=poisson,
	        density=weight / 9.81,
	        cohesion=0.,
	        frictionAngle=math.radians(28 + 12.5 * R),
	        dilationAngle=math.radians(max(0., dilation))
	)
