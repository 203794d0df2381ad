#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A reservoir of 7 m before a slope of silt is drawn down at once, within months or years: factor of safety against time, beside slices after Bishop (1955). Run it with `scripts/run examples/rain/drawdown.py`."""
import os
import sys

from yade import mpm
import numpy as np
sys.path[:0] = os.path.dirname(sys.argv[0]), os.path.join(os.path.dirname(sys.argv[0]), '..')
from options import compared, readOptions
from slices import Slope
from style import plt
options = readOptions('A reservoir drawn down before a slope.', cellSize=(1., '[m]'), factors=(4, 'while the level falls'), steps=(6, 'between two factors'))
w, top, friction = 9810., [(6, 4), (22, 12)], np.radians(28)
bishop = Slope(lambda x: np.interp(x, *np.transpose(top)), 8e3, friction, 1950 * 9.81, 0.4, lambda p: (1 + np.maximum(-0.5 * p / w, 0)**2)**-0.5)
still, above = lambda level: lambda x, y: w * (level - y), lambda x: 11 - np.clip(bishop.surface(x), 4, 11)
cases = {'at once': (0.1, lambda x, y: w * (11 - y - above(x) * (y < 11)), 4), 'full': (100, still(11), 11), 'slowly': (10000, still(4), 4)}  # at once pores lose what stood above
figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4), layout='constrained', width_ratios=(1.6, 1))
for name, (days, *water) in cases.items():
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=5e7, poisson=0.3, density=1950, cohesion=8e3, frictionAngle=friction, conductivity=1e-6, porosity=0.4, retention=MpmVanGenuchten(alpha=0.5, n=2), label='silt'))
	grid, duration, begin, levels = MpmGrid(cellSize=options.cellSize), 86400 * days, 1e9, [(1e9, 11), (1e9 + 86400 * days, 4)]  # drained under its weight and the full reservoir at first
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (34, 0), (34, 12), *top[::-1], (0, 4)]), grid, 2, 'silt'))
	mpm.assign(excessPressure=[w * (11 - y) for y in mpm.arrays()['pos'][:, 1]])
	face, sides = MpmDrain(surface=[*top[::-1], (0, 4)], levels=levels), [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(34, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, flow=MpmFlow(total=True, drains=[face]), water=[MpmWater(levels=levels, where='outside')], loadCurve=[(0, 1), (1, 1)], fBar=True, verbosity=0)], begin
	O.step()
	O.dt = duration / options.factors / options.steps
	film = mpm.movie(os.path.join(options.out, f'drawdown-{days:g}.gif'), 'porePressure', every=2, range=(-6e4, 11e4), limits=((0, 34), (0, 13)))
	found = mpm.safetyInTime([begin + duration * part for part in np.linspace(0, 1.5, 1 + 3 * options.factors // 2)], tolerance=0.02)
	film.finish()
	right.plot((found['time'] - begin) / duration, found['factor'], 'o-', label=f'{days:g} days')
	if name == 'full': mpm.plot('porePressure', ax=left)
	F, limit = found['factor'][0 if name == 'full' else options.factors], bishop.least((0, 10), (16, 30), *water, 0)[0]
	print(f'drawn down in {days:g} days, {name}: F = {F:.3f}, slices {limit:.3f} ({100 * (F / limit - 1):+.1f} %)')
	compared(f'factor of safety of a slope with suction, reservoir {name}, {days:g} days', F, limit, 'slices after Bishop 1955')
	right.axhline(limit, color='k', ls=':', lw=1)
right.legend(loc='center right', bbox_to_anchor=(1, 0.33))
right.set(xlabel='time over that of the drawdown [-]', ylabel='factor of safety, dotted: slices')
figure.savefig(os.path.join(options.out, 'drawdown.png'), dpi=110)
