# SPDX-License-Identifier: GPL-2.0-or-later
"""Laws of soils in the stability atlas: ground that has its own weight for stress, and bears three times that, or a footing."""
from math import inf, nan, radians, sin

import numpy as np
from common import cellSize, fullNewton, stabilisation
from yade import mpm, pack
from yade.wrapper import (MpmBoundary, MpmCamClayMat, MpmDynamicEngine, MpmGrid, MpmHardeningSoilMat, MpmImplicitEngine, MpmMohrCoulombMat, MpmNewton, MpmNorSandMat, MpmVonMisesMat,
                          Omega)

O = Omega()


class Ground:
	"""Ground between walls, 6 x 6 [x 2] cells, with the stress that its weight and its past leave it, in 10 steps.

	:param footing: a rigid rough footing on a half of the surface goes down by half a cell; else the weight grows to three times itself, whose vertical
		stress is known
	:param dt: length of a step [s] of inertia, long enough that nothing swings; None: static steps
	"""

	def __init__(self, dim, ghost, material, OCR=1, footing=False, dt=None, **settings):
		self.steps, self.density, self.footing, h = 10, 2000., footing, cellSize
		self.dt = dt or 1 / self.steps
		material.density, material.label = self.density, 'soil'
		O.materials.append(material)
		grid, size = MpmGrid(cellSize=h, dim=dim), np.array([6, 6, 2]) * h
		O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -h if dim == 2 else 0), tuple(size)), grid, 2, 'soil'))
		sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(size[0], -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
		if dim == 3: sides += [MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, size[2]), fix='z')]
		if footing: sides.append(MpmBoundary(min=(-inf, size[1], -inf), max=(size[0] / 2, inf, inf), fix='xyz'[:dim], displacement=(0, -h / 2, 0)))
		if dt: settings.update(scheme='generalised-alpha', rhoInfinity=0)
		self.engine = (MpmDynamicEngine if dt else MpmImplicitEngine)(
		        grid=grid, gravity=(0, -10, 0), boundaries=sides, ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton), gravityCurve=[(0, 1)], **settings)
		O.engines, O.dt = [self.engine], self.dt
		mpm.geostatic(OCR=OCR)
		if not footing: self.engine.gravityCurve = [(0, 1), (self.steps * self.dt, 3)]
		self.height = size[1]

	def beforeStep(self, step):
		pass

	def error(self):
		if self.footing: return nan
		points, weight = mpm.arrays(), 3 * 10 * self.density
		return np.abs(points['stress'][:, 1, 1] + weight * (self.height - points['pos0'][:, 1])).mean() / (weight * self.height)


def clay():
	return MpmCamClayMat(shearModulus=5e5, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, referencePressure=1e3, preconsolidation=1e4)


def hardeningSoil(phi=35., unloading=3., **more):
	"""A soft one, as the pressures of this ground are small; phi in degrees, unloading modulus over E50."""
	soil = dict(E50ref=2e6, Eoedref=2e6, Eurref=unloading * 2e6, power=.5, cohesion=0, frictionAngle=radians(phi), dilationAngle=radians(min(5., phi)), K0nc=1 - sin(radians(phi)))
	return MpmHardeningSoilMat(**{**soil, **more})


def norSand(state=-.05, hardening=70.):
	"""NorSand with a state parameter at a pressure of 10 kPa."""
	line = dict(criticalStateRatio=1.27, compressionIndex=.02, criticalVolume=1.9, criticalPressure=1e3)
	return MpmNorSandMat(shearModulus=2e6, swellingIndex=.005, referencePressure=1e3, hardening=hardening, specificVolume=1.9 - .02 * np.log(10) + state, **line)


def sand(**more):
	return MpmMohrCoulombMat(**{**dict(young=2e6, poisson=.2, cohesion=100., frictionAngle=radians(35), dilationAngle=0), **more})


def mud(**more):
	"""It yields from twice its weight on."""
	return MpmVonMisesMat(young=2e6, poisson=.3, yieldStress=1e4, **more)


def lawScene(axis, dim, ghost, value):
	"""The scene of a case, None if it is none of these."""
	ground = lambda material, **more: Ground(dim, ghost, material, **more)
	if axis == 'camClay': return ground(clay(), OCR=value)
	if axis == 'camClayFooting': return ground(clay(), OCR=value, footing=True)
	if axis == 'hardeningPower': return ground(hardeningSoil(power=value))
	if axis == 'hardeningUnloading': return ground(hardeningSoil(unloading=value))
	if axis == 'hardeningFriction': return ground(hardeningSoil(phi=value, Eoedref=2e5), footing=True)
	if axis == 'smallStrain': return ground(hardeningSoil(G0ref=1e7, gamma07=value), footing=True)
	if axis == 'norSandState': return ground(norSand(state=value), footing=True)
	if axis == 'norSandHardening': return ground(norSand(hardening=value), footing=True)
	if axis == 'softeningStrain': return ground(sand(residualCohesion=10., softeningStrain=value), footing=True, nonlocalLength=2 * cellSize)
	if axis == 'power': return ground(sand(power=value))
	if axis == 'powerFooting': return ground(sand(power=value), footing=True)
	if axis == 'viscosity': return ground(mud(viscosity=value * 2e6 * 100), dt=100.)
	if axis == 'relaxationTime': return ground(mud(relaxationTime=value * 100), dt=100.)
	return None
