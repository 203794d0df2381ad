# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: soil that softens, a block that is shortened or a slope under a plate, pressed to twice the displacement of its peak."""
from math import inf

import numpy as np
from yade import mpm
from yade.wrapper import MpmBoundary, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, Omega

O = Omega()


class Block:
	"""A block, 1 m by 2 m, between smooth plates, with a weaker spot at one side."""
	steps, most, profile = 68, 6.8e-3, [(0, 0), (1, 0), (1, 2), (0, 2)]
	law = dict(young=40e6, poisson=0.3, density=2000, cohesion=20e3, frictionAngle=np.pi / 6, residualCohesion=5e3, softeningStrain=0.02)
	ground = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(max=(0, 0, inf), fix='x')]
	plate = dict(min=(-inf, 2, -inf))
	section = -inf, inf  # heights over which the width of the band is measured [m]
	length = 2 / np.sqrt(3)  # length of the band [m]

	def start(self):
		mpm.assign(cohesion=lambda x: 18e3 if x[0] < 0.2 and 0.8 < x[1] < 1 else 20e3)

	def load(self, solver, data):
		return -(data['stress'][:, 1, 1] * data['volume']).sum() / 2


class Slope:
	"""A slope of 45 degrees, 4 m high, on the whole crest of which, 4 m wide, a smooth plate sinks."""
	steps, most, profile = 100, 1 / 30, [(0, 0), (10, 0), (10, 1), (8, 1), (4, 5), (0, 5)]
	law = dict(young=120e6, poisson=0.3, density=2000, cohesion=20e3, frictionAngle=np.pi / 9, residualCohesion=4e3, softeningStrain=0.02 / 3)
	ground = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(10, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	plate = dict(min=(-inf, 5, -inf), max=(4, inf, inf))
	section, length = (3, 4), 1

	def start(self):
		pass

	def load(self, solver, data):
		return abs(solver.reactions[-1][1]) / 4


def press(body, length, cells, image):
	"""Peak load [Pa], its displacement [m], load at twice that [Pa] and width of the band [m].

	:param length: nonlocalLength [m]
	:param cells: in 1 m
	:param image: file for the plastic strain, a value every half cell
	"""
	scene = Block() if body == 'block' else Slope()
	O.reset()
	O.materials.append(MpmMohrCoulombMat(label='soil', **scene.law))
	grid = MpmGrid(cellSize=1 / cells)
	O.bodies.append(mpm.fill(mpm.polygon(scene.profile), grid, 2, 'soil'))
	scene.start()
	held = [*scene.ground, MpmBoundary(fix='y', displacement=(0, -scene.most, 0), **scene.plate)]
	solver = MpmImplicitEngine(grid=grid, boundaries=held, nonlocalLength=length, verbosity=0)
	O.engines, O.dt = [solver], 1 / scene.steps
	loads = []
	while len(loads) < scene.steps and (body == 'block' or len(loads) <= 2 * (int(np.argmax(loads or [0])) + 1)):
		O.step()
		data = mpm.arrays()
		loads.append(scene.load(solver, data))
	peak = int(np.argmax(loads))
	strain, volume, y = data['plasticStrain'], data['volume'], data['pos0'][:, 1]
	meant = (y > scene.section[0]) & (y < scene.section[1])
	width = (strain[meant] * volume[meant]).sum()**2 / (strain[meant]**2 * volume[meant]).sum() / scene.length
	extent = np.max(scene.profile, axis=0)
	values = np.full(np.round(extent * 2 * cells).astype(int), np.nan)
	values[tuple(np.floor(data['pos0'][:, :2] * 2 * cells).astype(int).T)] = strain
	np.savez(image, strain=values.T, box=extent)
	return dict(peak=loads[peak], at=scene.most / scene.steps * (peak + 1), late=np.interp(2 * (peak + 1), range(1, len(loads) + 1), loads), width=width)
