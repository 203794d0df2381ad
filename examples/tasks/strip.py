#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressure on a strip of an elastic block. By hand: stress below its middle, q (2 alpha + sin 2 alpha) / pi with tan alpha = half width / depth."""
import numpy as np
from yade import mpm
b, q, size, h = 1, 1e4, 12, 0.25
O.materials.append(MpmElasticMat(young=1e8, poisson=0.3, density=1, label='ground'))
grid = MpmGrid(cellSize=h)
ground = mpm.polygon([(0, -size), (size, -size), (size, 0), (0, 0)])
O.bodies.append(mpm.fill(ground, grid, 2, 'ground'))
strip = MpmTraction(surface=mpm.surface(ground, min=(0, 0), max=(b, 0)), pressure=q)
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(size, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -size, inf), fix='y')]
O.engines, O.dt = [MpmImplicitEngine(grid=grid, boundaries=sides, loads=[strip])], 1
O.run(1, wait=True)
points = mpm.arrays()
cell = (points['pos0'][:, 0] < h) & (abs(points['pos0'][:, 1] + b + h / 2) < h / 2)  # the cell in the middle, b deep
alpha = np.arctan(b / (b + h / 2))
found, hand = -points['stress'][cell, 1, 1].mean(), q * (2 * alpha + np.sin(2 * alpha)) / np.pi
print(f'strip: stress {found / 1e3:.3f} kPa, by hand {hand / 1e3:.3f} kPa ({100 * (found / hand - 1):+.2f} %)')
