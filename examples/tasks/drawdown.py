#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A long bank of a dam, from which the water has been drawn down while its pores are full: factor of safety. By hand: c / (gamma z sin cos) + (1 - gamma_w / gamma) tan phi / tan beta."""
import numpy as np
from yade import mpm
beta, phi, c, z, gamma, gammaW, cells = np.radians(20), np.radians(30), 12e3, 3, 2e4, 1e4, 8
D = z * np.cos(beta)  # across the slope; the axes lie along it
h = D / cells
O.materials.append(MpmMohrCoulombMat(young=1e8, poisson=0.3, density=gamma / 10, cohesion=c, frictionAngle=phi, dilationAngle=phi, label='soil'))
grid = MpmGrid(cellSize=h, period=(4 * h, 0, 0))
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4 * h, 0), (4 * h, D), (0, D)]), grid, 2, 'soil'))
water = MpmWater(pressure=lambda x: gammaW * np.cos(beta) * max(0, D - x[1]))  # flow along the slope
held = [MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(10 * np.sin(beta), -10 * np.cos(beta), 0), boundaries=held, water=[water])], 1 / 4
O.run(4, wait=True)
bracket = mpm.strengthReduction(tolerance=0.02)
found = (bracket['lower'] + bracket['upper']) / 2
hand = c / (gamma * z * np.sin(beta) * np.cos(beta)) + (1 - gammaW / gamma) * np.tan(phi) / np.tan(beta)
print(f'drawdown: F = {found:.3f}, by hand {hand:.3f} ({100 * (found / hand - 1):+.2f} %)')
