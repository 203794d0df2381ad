#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Level ground is shaken from below by a shear wave. By hand: where nothing yields its surface moves with twice the velocity of the wave."""
import numpy as np
from yade import mpm
H, G, density, h, frequency, peak = 20, 8e7, 2000, 1, 2, 0.1
O.materials.append(MpmElasticMat(young=2.6 * G, poisson=0.3, density=density, label='ground'))
grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))  # sides of level ground are the same nodes
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3 * h, 0), (3 * h, H), (0, H)]), grid, 2, 'ground'))
time = np.linspace(0, 1 / frequency, 51)
quake = MpmBaseMotion(history=list(zip(time, peak / 2 * (1 - np.cos(2 * np.pi * frequency * time)))), direction=(1, 0, 0))  # or mpm.readHistory('velocity.txt')
base = MpmAbsorbingBoundary(max=(inf, 0, inf), motion=quake)  # lets through what comes back
O.engines = [MpmDynamicEngine(grid=grid, absorbing=[base], label='solver')]
surface = mpm.histories(at=[(h, H, 0)])
O.dt = 0.5 * h / solver.waveSpeed()
O.run(int(0.6 / O.dt), wait=True)
found, hand = surface['velocity'][:, 0, 0].max(), 2 * peak
print(f'earthquake: velocity of the surface = {found:.4f} m/s, by hand {hand:.4f} m/s ({100 * (found / hand - 1):+.2f} %)')
