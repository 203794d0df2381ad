#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A long slope of sand with a little cohesion: its factor of safety. By hand: tan(phi) / tan(beta) + c / (gamma z sin(beta) cos(beta))."""
import numpy as np
from yade import mpm
beta, phi, c, z, g, cells = np.radians(25), np.radians(35), 1e3, 2, 10, 8
D = z * np.cos(beta)  # across the slope; the axes lie along it
h = D / cells
O.materials.append(MpmMohrCoulombMat(young=5e7, poisson=0.3, density=1800, cohesion=c, frictionAngle=phi, dilationAngle=phi, label='sand'))
grid = MpmGrid(cellSize=h, period=(4 * h, 0, 0))
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4 * h, 0), (4 * h, D), (0, D)]), grid, 2, 'sand'))
O.engines = [MpmImplicitEngine(grid=grid, gravity=(g * np.sin(beta), -g * np.cos(beta), 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])]
O.dt = 1 / 4
O.run(4, wait=True)
bracket = mpm.strengthReduction(tolerance=0.02)
found, hand = (bracket['lower'] + bracket['upper']) / 2, np.tan(phi) / np.tan(beta) + c / (1800 * g * z * np.sin(beta) * np.cos(beta))
print(f'sand slope: F = {found:.3f}, by hand {hand:.3f} ({100 * (found / hand - 1):+.2f} %)')
