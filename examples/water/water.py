#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Water of given pressure in soil: under a level, in steady seepage, and as it is drawn down.

	wall     soil 4 m deep under a water table, between smooth walls: their reaction against effective stress K0 gamma' z and water by hand
	seepage  infinite slope, flow along it up to the surface, in a periodic grid turned with it: F = c / (gamma z sin cos) + (gamma' / gamma) tan(phi) / tan(beta)
	bank     2:1 slope, H = 10 m, gamma = 20 kN/m3, c = 10 kPa, phi = 20 degrees, psi = 0 (Griffiths and Lane 1999, example 1): factor of safety under water, against
	         that of soil of submerged density without water; with the water falling slowly, and at once while the pores keep their pressure

	o|_____________
	o|             \\     ~~~~~~~ levels            left: rollers, base held
	o|      bank     \\
	 //////////////////

Run it with `scripts/run examples/water/water.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Water in soil.',
        scene=('all', "'all', or one of 'wall', 'seepage' and 'bank'"),
        cells=(10, 'over the height of the slope'),
        pointsPerCell=(2, 'material points per cell and axis'),
        levels=(5, 'of the water, from the crest to the toe of the bank'),
        tolerance=(0.02, 'width of the bracket of the factor of safety'))
g, gammaW = 10., 1e4


def scene(region, grid, material, boundaries, water, **settings):
	O.reset()
	O.materials.append(material)
	O.bodies.append(mpm.fill(region, grid, options.pointsPerCell, material.label))
	engine = MpmImplicitEngine(**(dict(grid=grid, gravity=(0, -g, 0), boundaries=boundaries, water=water) | settings))
	O.engines = [engine]
	O.dt = 1 / 10
	return engine


def compare(what, found, exact, unit=''):
	print(f'{what}: {found:.4f}{unit}, by hand {exact:.4f}{unit} ({100 * (found / exact - 1):+.2f} %)')
	compared(what, found, exact, 'sum by hand', unit.strip())


def wall():
	D, level, K0 = 4., 3., 0.5
	soil = MpmElasticMat(young=5e7, poisson=K0 / (1 + K0), density=2000, label='soil')
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	solver = scene(mpm.polygon([(0, 0), (2, 0), (2, D), (0, D)]), MpmGrid(cellSize=0.5), soil, sides, [MpmWater(level=level, weight=gammaW)], gravityCurve=[(0, 1)])
	mpm.geostatic()
	O.step()
	onWall = gammaW * level**2 / 2
	compare('wall: water on it', solver.water[0].onBoundaries[0][0] / 1e3, onWall / 1e3, ' kN/m')
	compare('wall: water and soil', solver.reactions[0][0] / 1e3, (K0 * (2000 * g * D**2 / 2 - onWall) + onWall) / 1e3, ' kN/m')
	compare('wall: load on the base', solver.reactions[2][1] / 1e3, 2000 * g * D * 2 / 1e3, ' kN/m')


def seepage():
	beta, z, c, phi = np.radians(20), 3., 12e3, np.radians(30)
	D = z * np.cos(beta)
	soil = MpmMohrCoulombMat(young=1e8, poisson=0.3, density=2000, cohesion=c, frictionAngle=phi, dilationAngle=phi, label='soil')
	L = 4 * D / options.cells
	exact = c / (2000 * g * z * np.sin(beta) * np.cos(beta)) + (1 - gammaW / (2000 * g)) * np.tan(phi) / np.tan(beta)
	water = MpmWater(pressure=lambda x: gammaW * np.cos(beta) * max(0, D - x[1]))
	scene(mpm.polygon([(0, 0), (L, 0), (L, D), (0, D)]), MpmGrid(cellSize=D / options.cells, period=(L, 0, 0)), soil, [MpmBoundary(max=(inf, 0, inf), fix='xy')], [water],
	      gravity=(g * np.sin(beta), -g * np.cos(beta), 0))
	O.run(10, wait=True)
	found = mpm.strengthReduction(tolerance=options.tolerance)
	print(f"seepage: F between {found['lower']:.3f} and {found['upper']:.3f}, closed form {exact:.3f}")
	compared(f'factor of safety with seepage, {options.cells} cells over the depth', (found['lower'] + found['upper']) / 2, exact, 'infinite slope, closed form')
	print(f"seepage: F without water would be {c / (2000 * g * z * np.sin(beta) * np.cos(beta)) + np.tan(phi) / np.tan(beta):.3f}")
	return (found['lower'] + found['upper']) / 2 / exact - 1


H, run, crest = 10., 20., 12.
profile = [(0, 0), (crest + run, 0), (crest, H), (0, H)]


def bank(density, *water):
	"""Factor of safety of the bank after its weight and the water have grown together."""
	soil = MpmMohrCoulombMat(young=1e8, poisson=0.3, density=density, cohesion=10e3, frictionAngle=np.radians(20), label='soil')
	solver = scene(mpm.polygon(profile), MpmGrid(cellSize=H / options.cells), soil, [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')], water, fBar=True)
	O.run(10, wait=True)
	found = mpm.strengthReduction(tolerance=options.tolerance)
	return (found['lower'] + found['upper']) / 2


def banks():
	still = lambda level, where='everywhere': MpmWater(level=level, weight=gammaW, where=where)
	begin = time.time()
	submerged = bank(1000)
	compare('bank under water: F', bank(2000, still(H + 2)), submerged)
	levels = np.linspace(H, 0, options.levels)
	slow = [bank(2000, still(level)) for level in levels]
	low = H - np.array([0.5, 1., 1.5])  # the pores keep the pressure of the full reservoir
	rapid = [bank(2000, still(H, 'pores'), still(level, 'outside')) for level in low]
	for level, F in zip(levels, slow):
		print(f'bank, slow drawdown: level {level:.2f} m, F = {F:.3f}')
	for level, F in zip(low, rapid):
		print(f'bank, rapid drawdown: level {level:.2f} m, F = {F:.3f}')
	print(f'bank: {time.time() - begin:.1f} s')
	return submerged, levels, slow, low, rapid


def picture(submerged, levels, slow, low, rapid):
	figure, axes = plt.subplots(1, 2, figsize=(11, 4.8), gridspec_kw=dict(width_ratios=(1, 1.3)), layout='constrained')
	axes[0].plot(levels / H, slow, 'o-', label='slow drawdown')
	axes[0].plot(low / H, rapid, 's', label='at once')
	axes[0].axhline(submerged, color='grey', linestyle='--', label='submerged density, no water')
	axes[0].set(xlabel='water level over height of the bank [-]', ylabel='factor of safety [-]')
	axes[0].legend(loc='upper center', bbox_to_anchor=(0.5, -0.16), ncols=2, frameon=False)
	mpm.plot('porePressure', ax=axes[1])
	axes[1].set_title(f'pore pressure after a drawdown at once to {low[-1] / H:.2g} H')
	figure.savefig(os.path.join(options.out, 'water.png'), dpi=110)


if options.scene in ('all', 'wall'): wall()
if options.scene in ('all', 'seepage'): error = seepage()
if options.scene in ('all', 'bank'): picture(*banks())
