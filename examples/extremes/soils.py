# SPDX-License-Identifier: GPL-2.0-or-later
"""Soils of the stability atlas: laws of columns, and scenes for what columns do not show; laws.py has ground with a stress of its own."""
from math import inf, nan, radians

import numpy as np
from common import cellSize, fullNewton, stabilisation, young
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmDruckerPragerMat, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmNewton, MpmTrescaMat, MpmVonMisesMat, Omega

O = Omega()


class SandSlope:
	"""A slope of 1 m in sand of 35 degrees that does not dilate, E = 500 times its weight over the height, in 10 steps.

	:param slope: its angle [degrees]
	:param cohesion: over weight times height
	"""

	def __init__(self, ghost, slope, cohesion):
		self.steps, density, run = 10, 2000., 1 / np.tan(radians(slope))
		sand = dict(young=1e7, poisson=.3, density=density, label='sand')
		O.materials.append(MpmMohrCoulombMat(frictionAngle=radians(35), dilationAngle=0, cohesion=cohesion * density * 10, **sand))
		end = 2 + cellSize * np.ceil(run / cellSize)
		grid = MpmGrid(cellSize=cellSize)
		profile = mpm.polygon([(0, 0), (end, 0), (end, .5), (1 + run, .5), (1, 1.5), (0, 1.5)])
		O.bodies.append(mpm.fill(profile, grid, 2, 'sand'))
		sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(end, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
		self.engine = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides, ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		return nan

	def measured(self):
		points = mpm.arrays()
		return np.linalg.norm(points['pos'] - points['pos0'], axis=1).max()


class Band:
	"""A block of clay in plane strain, 1 m wide and 2 m high between smooth plates, a weak spot at its foot, shortened by 0.5 % in 40 steps. It softens
	from c_u = E / 1000 sqrt(2) to three tenths of that. With F-bar.

	:param cells: over the width
	:param softening: 'none', 'same' on all grids, or 'scaled' with the size of cells: dissipated energy is then that of a band of one cell on the grid of 16
	"""

	def __init__(self, ghost, cells, softening):
		self.steps, self.strength, h = 40, 1e-3 * young, 1 / cells
		modulus = dict(none=0., same=-7e-3 * young, scaled=-7e-3 * young * 16 / cells)[softening]
		for label, part in ('clay', 1.), ('spot', .9):
			law = dict(yieldStress=part * self.strength, hardening=modulus, residualYieldStress=.3 * part * self.strength)
			O.materials.append(MpmVonMisesMat(young=young, poisson=.3, density=1, label=label, **law))
		grid = MpmGrid(cellSize=h)
		box = pack.inAlignedBox((0, 0, -h), (1, 2, h))
		O.bodies.append(mpm.fill(box, grid, 2, lambda x: 'spot' if max(x[0], x[1]) < 1 / 8 else 'clay'))
		plates = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 2, -inf), fix='y', displacement=(0, -.01, 0))]
		held = MpmBoundary(max=(0, 0, inf), fix='x')
		self.engine = MpmImplicitEngine(grid=grid, boundaries=[*plates, held], fBar=True, ghost=stabilisation(ghost), newton=MpmNewton(**fullNewton))

	def beforeStep(self, step):
		pass

	def error(self):
		return nan

	def measured(self):
		return -self.engine.reactions[1][1] / (np.sqrt(2) * self.strength)


def vonMises(strength, softening=0.):
	"""Law of a column that yields at this part of its modulus, and softens by that one down to a tenth of its strength."""
	return lambda E, values: MpmVonMisesMat(yieldStress=strength * E, hardening=-softening * E, residualYieldStress=strength * E / 10, **values)


def tresca(strength):
	return lambda E, values: MpmTrescaMat(undrainedStrength=strength * E, **values)


def friction(kind, phi, psi=0., cohesion=0.):
	"""Law of a frictional column; angles in degrees, cohesion over the modulus."""
	return lambda E, values: kind(frictionAngle=radians(phi), dilationAngle=radians(psi), cohesion=cohesion * E, **values)


frictional = { # nearly no lateral stress as long as it is elastic: it yields everywhere
        'friction': lambda phi: dict(kind=MpmMohrCoulombMat, phi=phi),
        'frictionCone': lambda phi: dict(kind=MpmDruckerPragerMat, phi=phi),
        'dilation': lambda psi: dict(kind=MpmMohrCoulombMat, phi=45, psi=psi),
        'cohesion': lambda c: dict(kind=MpmMohrCoulombMat, phi=30, cohesion=c),
}
