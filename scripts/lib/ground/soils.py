# SPDX-License-Identifier: GPL-2.0-or-later
"""Soils that are drawn at random, and what limit analysis knows of them."""
from math import exp, pi, radians, sin, sqrt, tan

from yade.wrapper import MpmCamClayMat, MpmDruckerPragerMat, MpmElasticMat, MpmMohrCoulombMat, MpmTrescaMat, MpmVonMisesMat

gravity, density = 10., 2000.
weight = density * gravity


class Soil:
	"""A law with its parameters, for ground of some height [m]. Its strength is known as cohesion [Pa] and angle of friction; infinite where nothing flows."""

	def __init__(self, draw, height, laws):
		self.law = draw.choice(laws)
		self.young = draw.choice([5e6, 2e7, 1e8])
		self.poisson = draw.choice([.2, .3, .3, .4])
		self.phi = radians(draw.uniform(20, 45)) if self.law in ('mohrCoulomb', 'druckerPrager', 'camClay') else 0.
		self.psi = self.phi * draw.choice([0., 0., .3, 1., draw.random()])
		if self.law in ('vonMises', 'tresca'): self.cohesion = weight * height * draw.uniform(.15, .6)
		else: self.cohesion = weight * height * draw.choice([0., 0., 1e-3, .01, .05, .2])
		if self.law == 'camClay': self.cohesion = 0.

	def material(self, label='soil'):
		elastic = dict(young=self.young, poisson=self.poisson, density=density, label=label)
		frictional = dict(cohesion=self.cohesion, frictionAngle=self.phi, dilationAngle=self.psi)
		if self.law == 'elastic': return MpmElasticMat(**elastic)
		if self.law == 'vonMises': return MpmVonMisesMat(yieldStress=sqrt(2) * self.cohesion, **elastic)
		if self.law == 'tresca': return MpmTrescaMat(undrainedStrength=self.cohesion, **elastic)
		if self.law == 'mohrCoulomb': return MpmMohrCoulombMat(**frictional, **elastic)
		if self.law == 'druckerPrager': return MpmDruckerPragerMat(match='plane-strain', **frictional, **elastic)
		ratio = 6 * sin(self.phi) / (3 - sin(self.phi))
		return MpmCamClayMat(density=density, shearModulus=self.young / 3, criticalStateRatio=ratio, compressionIndex=.08, swellingIndex=.016, preconsolidation=2e5, referencePressure=1e3, label=label)

	@property
	def K0(self):
		"""Ratio of stresses of ground at rest; None: that of the material, which clay without friction and a cone that fits plane strain do not bear."""
		return dict(vonMises=1., tresca=1., druckerPrager=.8).get(self.law)

	@property
	def passive(self):
		return (1 + sin(self.phi)) / (1 - sin(self.phi))

	def isSurelyStable(self, height):
		"""True if ground of this height bears its weight with a vertical face: the stress field of Drucker and Prager (1952). True where nothing flows."""
		return self.law == 'elastic' or weight * height <= 2 * self.cohesion * sqrt(self.passive)

	def isSurelyUnstable(self, height):
		"""True if a plane slip brings a vertical face down (Coulomb 1776), by half of its weight more than needed; known for associated flow; soil with less dilation bears no more."""
		return self.law != 'elastic' and weight * height > 6 * self.cohesion * sqrt(self.passive)

	def bearing(self, width, cover=0.):
		"""An upper estimate of what a strip bears in the mean [Pa]: Prandtl and Reissner, and N_gamma of a rough one by Brinch Hansen (1970), times 1.5 as it lies above the exact one nowhere by more."""
		if self.phi == 0: return (2 + pi) * self.cohesion + cover
		Nq = exp(pi * tan(self.phi)) * self.passive
		return (Nq - 1) / tan(self.phi) * self.cohesion + Nq * cover + 1.5 * .75 * (Nq - 1) * tan(self.phi) * weight * width

	def depthOfBlum(self, length):
		"""To which a smooth and stiff cantilever wall of this length can be dug free in soil without cohesion."""
		return length * (1 - (1 / self.passive)**(2 / 3))

	def thrusts(self, height):
		"""Rankine's active and passive thrust of a smooth wall [N/m]."""
		K, w = self.passive, weight * height**2 / 2
		return max(0., w / K - 2 * self.cohesion * height / sqrt(K)), w * K + 2 * self.cohesion * height * sqrt(K)

	def __str__(self):
		text = f'{self.law} E {self.young:.0e} nu {self.poisson}'
		if self.law in ('mohrCoulomb', 'druckerPrager'): text += f' phi {self.phi * 180 / pi:.0f} psi {self.psi * 180 / pi:.0f}'
		return text if self.law in ('elastic', 'camClay') else text + f' c {self.cohesion:.3g}'
