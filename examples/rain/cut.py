#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A cut of 8 m in silt stands by suction and fails within two days of rain: factor of safety against time, and where it goes then. Run it with `scripts/run examples/rain/cut.py`."""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import readOptions
from style import plt

options = readOptions('A cut in silt under rain.', cellSize=(0.5, '[m]'), rain=(2.8e-6, '[m/s]'), hours=(52., 'of rain'), every=(4, 'hours between factors of safety'))
silt = dict(young=5e7, poisson=0.3, density=1950, cohesion=2e3, frictionAngle=np.radians(34), dilationAngle=0)
O.materials.append(MpmMohrCoulombMat(conductivity=5e-6, porosity=0.42, retention=MpmVanGenuchten(alpha=1, n=1.8, residual=0.15), label='silt', **silt))
grid, hour = MpmGrid(cellSize=options.cellSize), 3600.
profile = mpm.polygon([(0, 0), (24, 0), (24, 12), (14, 12), (9, 4), (0, 4)])
O.bodies.append(mpm.fill(profile, grid, 2, 'silt'))
mpm.assign(excessPressure=[9810 * (2 - y) for y in mpm.arrays()['pos'][:, 1]])  # water table 2 m below the toe
ground, base = [(24, 12), (14, 12), (9, 4), (0, 4)], [(0, 0), (24, 0)]
drains = [MpmDrain(surface=ground, rain=options.rain, curve=[(5 * hour, 0), (5 * hour + 1, 1)]), MpmDrain(surface=base, pressure=9810 * 2)]
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(24, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, flow=MpmFlow(total=True, drains=drains), loadCurve=[(0, 1), (1, 1)], verbosity=0)]
O.dt = hour / 2
O.step()  # saturations are known from here on
film = mpm.movie(os.path.join(options.out, 'cut.gif'), 'saturation', every=4, range=(0.5, 1), limits=((0, 25), (0, 13)))
found = mpm.safetyInTime([(5 + hours) * hour for hours in np.arange(0, options.hours + 0.1, options.every)], tolerance=0.02)
film.finish()
moved = np.linalg.norm(mpm.arrays()['pos'] - mpm.arrays()['pos0'], axis=1).max()
print(f'after {O.time / hour - 5:.0f} h of rain the ground has moved by {moved:.2f} m; F was one after {found["failureTime"] / hour - 5:.0f} h')
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout='constrained', width_ratios=(2, 1))
mpm.plot('saturation', ax=left, range=(0.5, 1))
right.plot(found['time'] / hour - 5, found['factor'], 'o-')
right.set(xlabel='hours of rain', ylabel='factor of safety')
figure.savefig(os.path.join(options.out, 'cut.png'), dpi=110)
