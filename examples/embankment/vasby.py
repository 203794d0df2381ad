#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The test fill of Vasby (Lilla Mellosa, Sweden, 1947) on soft clay without drains: settlement and excess pressure over 32 years, predicted from index properties.

	 _______  2.5   gravel, in five layers and 25 days
	|_______| 0     ground surface; water table at -0.8 m
	|crust  | -1    drained
	|clay   |       water content from 1.3 to 0.7 (Cam clay, finite strains)
	|_______| -14   drained

A column, since the fill is 30 m wide. Measured: Y. C. E. Chang (1981): Long-term consolidation beneath the test fills at Vasby, Sweden. SGI report 13; R. Larsson (1986):
Consolidation of soft soils. SGI report 29. Compressibility by water content: K. V. Helenelund (1951), C_c = 0.85 w^1.5. Conductivity index, half the void ratio: F. Tavenas
and others (1983). Preconsolidation by vane strength: G. Mesri (1975), 0.22 sigma_c.

Run it with `scripts/run examples/embankment/vasby.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('The test fill of Vasby.',
        cellSize=(0.5, 'size of the cells [m], at most 1'),
        steps=(60, 'time steps after the fill is there'),
        compression=(1., 'factor of the compression index'),
        OCR=(1.13, 'overconsolidation ratio'),
        conductivity=(1e-9, 'of the clay at first [m/s]'),
        index=(0.5, 'loss of void ratio for a tenfold loss of conductivity, over the void ratio'))
depth, table, height, layers, g, day, year = 14., -0.8, 2.5, 5, 9.81, 86400., 365.25 * 86400
grainDensity, friction = 2700., np.radians(30)
load, end = 40.6e3, 60.  # of the fill [Pa], of the run [years]
measured = {'settlement': {20.: 1.40, 32.: 1.65}, 'pressure': {20.: 30e3, 32.: 20e3}}  # by years [m, Pa]


def clay(z, label):
	"""The clay at a height, by its water content."""
	w = np.interp(z, [-depth, -3], [0.7, 1.3])
	e = w * grainDensity / 1000
	slope = options.compression * 0.85 * w**1.5 / (np.log(10) * (1 + e))
	return MpmCamClayMat(density=(grainDensity + 1000 * e) / (1 + e), shearModulus=1e6, criticalStateRatio=6 * np.sin(friction) / (3 - np.sin(friction)), compressionIndex=slope, swellingIndex=slope / 10,
	        preconsolidation=1e5, referencePressure=1e3, conductivity=options.conductivity, conductivityLaw='log', conductivityIndex=options.index * e, porosity=e / (1 + e), label=label)


def scene():
	h = options.cellSize
	O.materials.append([
	        MpmElasticMat(young=5e6, poisson=0.3, density=1500, conductivity=1e-6, porosity=0.6, label='crust'),
	        MpmElasticMat(young=2e7, poisson=0.3, density=load / (g * height), conductivity=1e-4, porosity=0.35, label='gravel'), *(clay(-n - 0.5, f'clay {n}') for n in range(1, int(depth)))
	])
	grid = MpmGrid(cellSize=h)
	column = mpm.polygon([(0, -depth), (h, -depth), (h, 0), (0, 0)])
	O.bodies.append(mpm.fill(column, grid, 2, lambda x: 'crust' if x[1] > -1 else f'clay {int(-x[1])}'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=sides, water=[MpmWater(level=table)], label='solver', verbosity=0)]
	O.dt = 1
	mpm.geostatic(OCR=options.OCR)
	solver.flow = MpmFlow(drains=[MpmDrain(surface=[(h, -1), (0, -1)]), MpmDrain(surface=[(0, -depth), (h, -depth)])])
	return grid


def history():
	"""Years, settlement of the ground surface [m] and largest excess pressure [Pa] after each step; heights and pressures at some times."""
	grid = scene()
	top = max(O.bodies, key=lambda b: b.state.pos[1])
	curve, profiles, begin = [(0., 0., 0.)], {}, O.time

	def go(seconds):
		O.dt = seconds
		O.step()
		points = mpm.arrays()
		curve.append(((O.time - begin) / year, top.state.refPos[1] - top.state.pos[1], points['excessPressure'].max()))

	for n in range(layers):
		low, high = height * n / layers, height * (n + 1) / layers
		mpm.stages.place(mpm.fill(mpm.polygon([(0, low), (options.cellSize, low), (options.cellSize, high), (0, high)]), grid, 2, 'gravel'), steps=1)
		for _ in range(2):
			go(2.5 * day)
	lengths = 1.08**np.arange(options.steps)
	for length in lengths / lengths.sum() * (end * year - (O.time - begin)):
		go(length)
		points = mpm.arrays()
		isClay = points['material'] > 1
		profiles[curve[-1][0]] = points['pos'][isClay, 1], points['excessPressure'][isClay]
	return np.array(curve), profiles


def at(curve, years, column):
	return np.interp(years, curve[:, 0], curve[:, column])


def picture(curve, profiles):
	figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.4), layout='constrained')
	left.plot(curve[:, 0], curve[:, 1], label='predicted')
	left.plot(*zip(*measured['settlement'].items()), 'ks', label='measured')
	left.set(xlabel='years', ylabel='settlement [m]', xlim=(0, None), ylim=(1.8, 0))
	left.legend(frameon=False)
	for years in (1, 20, 32):
		heights, pressures = profiles[min(profiles, key=lambda t: abs(t - years))]
		order = np.argsort(heights)
		line, = right.plot(pressures[order] / 1e3, heights[order], label=f'{years} year' + 's' * (years > 1))
		if years in measured['pressure']: right.axvline(measured['pressure'][years] / 1e3, color=line.get_color(), linestyle='--')
	right.set(xlabel='excess pore pressure [kPa], dashed: largest measured', ylabel='height [m]', xlim=(0, None))
	right.legend(frameon=False)
	figure.savefig(os.path.join(options.out, 'vasby.png'), dpi=100)


curve, profiles = history()
for years in measured['settlement']:
	s, u = at(curve, years, 1), at(curve, years, 2)
	print(f'{years:.0f} years: {s:.2f} m, measured {measured["settlement"][years]:.2f}; largest excess pressure {u / 1e3:.1f} kPa, measured {measured["pressure"][years] / 1e3:.0f}')
	compared(f'Vasby: settlement after {years:.0f} years', s, measured['settlement'][years], 'Chang 1981, field', 'm')
	compared(f'Vasby: largest excess pressure after {years:.0f} years', u / 1e3, measured['pressure'][years] / 1e3, 'Chang 1981, field', 'kPa')
print(f'{end:.0f} years: {curve[-1, 1]:.2f} m, {curve[-1, 2] / 1e3:.1f} kPa')
picture(curve, profiles)
