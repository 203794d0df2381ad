# SPDX-License-Identifier: GPL-2.0-or-later
"""A block of sand that reaches into cells at its corner by less and less."""
from math import inf, radians, sin

import numpy as np
from yade import mpm, pack
from yade.wrapper import MpmBoundary, MpmGhost, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, Omega

O = Omega()


def condition(cut, flows=False, dim=2, fBar=True, phi=20, seconds=None, **ghost):
	"""The condition number of the stiffness of 3 cells along each axis, moved along all of them by a part *cut* of a cell, between rollers.

	:param flows: all points yield: their stress is that of sand with more friction, which is then taken away
	:param phi: = psi [degrees]
	:param seconds: not limited
	"""
	O.reset()
	strong = radians(phi) + .1
	O.materials.append(MpmMohrCoulombMat(young=1e8, poisson=.3, density=2000, cohesion=0, frictionAngle=strong, dilationAngle=0, label='sand'))
	grid = MpmGrid(cellSize=1, dim=dim)
	bodies = mpm.fill(pack.inAlignedBox((0, 0, -1) if dim == 2 else (0, 0, 0), (3, 3, 1) if dim == 2 else (3, 3, 3)), grid, 2, 'sand')
	for body in bodies: body.state.pos += (cut, cut, cut * (dim == 3))
	O.bodies.append(bodies)
	rollers = [MpmBoundary(max=tuple(0 if a == axis else inf for a in range(3)), fix='xyz'[axis]) for axis in range(dim)]
	solver = MpmImplicitEngine(grid=grid, boundaries=rollers, fBar=fBar, ghost=MpmGhost(**ghost), verbosity=0)
	O.engines = [solver]
	if flows:
		upright = -1e5
		least = upright * ((1 - sin(radians(phi))) / (1 + sin(radians(phi))) - .02)
		mpm.assign(stress=np.repeat(np.diag([least, upright, (least + upright) / 2])[None], len(O.bodies), 0))
	O.materials[0].frictionAngle = O.materials[0].dilationAngle = radians(phi)
	return dict(condition=solver.conditionNumber())
