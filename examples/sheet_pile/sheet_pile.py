#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A cantilever sheet pile wall in sand, dug out on one side until it is thrown over: its moment, and the depth at which it fails, by Blum (without his addition of a fifth)."""
import os
import sys
from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Sheet pile wall.', cellSize=(0.5, '[m]; its half is dug out at a time'), depth=(3.25, 'that is dug out in the end [m]'), seen=(3., 'depth of the picture [m]'))
h, L, phi, gamma = options.cellSize, 6, radians(30), 18e3
O.materials.append(MpmMohrCoulombMat(young=4e7, poisson=0.3, density=gamma / 10, cohesion=100, frictionAngle=phi, dilationAngle=phi, label='sand'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(mpm.polygon([(-12, -9), (14, -9), (14, 0), (-12, 0)]), grid, 2, 'sand'))
wall = MpmBeam(line=[(0, 0), (0, -L)], axialStiffness=1e10, bendingStiffness=1e9, adhesion=0, fixFoot='y')
held = [MpmBoundary(max=(-12, inf, inf), fix='x'), MpmBoundary(min=(14, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -9, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0, fBar=True)
O.engines, O.dt = [solver], 1
mpm.geostatic(K0=0.5)
solver.loads = [wall]  # wished in place: it takes over the stress of the sand on both of its sides
O.run(1, wait=True)
Ka = np.tan(np.pi / 4 - phi / 2)**2
blum = L * (1 - Ka**(2 / 3))
for level in np.arange(1.5, options.depth + 1e-9, h / 2):
	x, y = np.array(wall.vertices)[::-1, :2].T
	mpm.stages.excavate(lambda at, pad=0: at[1] > -level and at[0] > np.interp(at[1], y, x), steps=4)
	O.run(4, wait=True)
	below = level / (1 / Ka - 1)  # depth at which the shear force is zero
	byHand = gamma * (Ka * (level + below)**3 - below**3 / Ka) / 6
	print(f'dug out {level:.3f} m: head moves {1e3 * wall.vertices[0][0]:.1f} mm, moment {max(wall.moments) / 1e3:.1f} kN m, by Blum {byHand / 1e3:.1f} kN m')
	if abs(level - options.seen) < 1e-9:
		compared(f'largest moment, dug out {level:g} m, cells of {h:g} m', max(wall.moments) / 1e3, byHand / 1e3, 'Blum 1931', 'kN m')
		figure, axes = plt.subplots(1, 3, figsize=(14, 5.2), layout='constrained')
		for ax, (quantity, title) in zip(axes, dict(axialForce='normal force', shearForce='shear force', moment='bending moment').items()):
			mpm.diagram(wall, quantity, mpm.plot('displacement', ax=ax, loads=False), 1.5).set(xlim=(-6, 6), ylim=(-8, 0.5), title=title)
		figure.savefig(f'{options.out}/sheet_pile.png')
print(f'by Blum it fails at {blum:.3f} m')
