#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Water in soil that is not saturated, against what is known.

	front  a wetting front in a column of dry sand (Celia, Bouloutas and Zarba 1990): where it is after a day
	rain   a column above a water table, on which it begins to rain harder (Srivastava and Yeh 1991): heads by a closed form
	slope  an infinite slope with steady infiltration (Lu and Godt 2008): the factor of safety from the stresses of elastic soil

Run it with `scripts/run examples/rain/rain.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Rain and suction.',
        scene=('all', "'all', or one of 'front', 'rain' and 'slope'"),
        cells=(80, 'over the height of the columns and of the slope'),
        cut=(0.5, 'part of a cell that soil fills where the surface cuts one'),
        longest=(0.005, 'longest step, over the time of the scene'))
weight, stiff = 9810., 1e9  # of water [N/m3]; Young's modulus of soil that hardly moves [Pa]


def scene(height, gravity, pressure, drains, **soil):
	"""One cell wide, y along the normal of the ground. `pressure`: as it begins, a function of y."""
	O.reset()
	O.materials.append(MpmElasticMat(young=stiff, poisson=0.3, density=19e3 / 9.81, label='soil', **soil))
	h = height / (options.cells + options.cut)
	grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3 * h, 0), (3 * h, height), (0, height)]), grid, 2, 'soil'))
	mpm.assign(excessPressure=[pressure(y) for y in mpm.arrays()['pos'][:, 1]])
	top, base = [(3 * h, height), (0, height)], [(0, 0), (3 * h, 0)]
	flow = MpmFlow(total=True, drains=[MpmDrain(surface=surface, conductance=300, **given) for surface, given in zip((top, base), drains)])
	O.engines = [MpmImplicitEngine(grid=grid, gravity=gravity, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], flow=flow, newton=MpmNewton(tolerance=1e-9), loadCurve=[(0, 1), (1, 1)], verbosity=0)]
	return O.engines[0]


def advance(end, first, longest):
	"""Steps that grow by a fifth up to `longest`, until O.time is `end`; returns water in, less water out, less what is stored, over all that came in."""
	O.dt = first
	while O.time < end * (1 - 1e-9):
		O.dt = min(O.dt, end - O.time)
		O.step()
		O.dt = min(1.2 * O.dt, longest)
	flow = O.engines[0].flow
	return abs(flow.waterIn - flow.waterOut - flow.waterStored) / max(flow.waterIn, 1e-30)


def profile(name='excessPressure'):
	"""Heights, and the mean of the points there."""
	points = mpm.arrays()
	y, value = points['pos'][:, 1], points[name]
	heights = np.unique(y.round(9))
	return heights, np.array([value[abs(y - height) < 1e-6].mean(axis=0) for height in heights])


def below(axes):
	"""Legend under the axes, where it covers no curve."""
	axes.legend(loc='upper center', bbox_to_anchor=(0.5, -0.16), ncols=3, frameon=False)


def front(axes):
	sand = MpmVanGenuchten(alpha=3.35, n=2, residual=.102 / .368)
	scene(1, (0, -9.81, 0), lambda y: -10 * weight, (dict(pressure=-.75 * weight), dict(pressure=-10 * weight)), conductivity=9.22e-5, porosity=.368, retention=sand)
	for hours in 1, 6, 24:
		lost = advance(hours * 3600, 20, options.longest * 86400)
		z, p = profile()
		axes.plot(p / weight, z, label=f'{hours} h')
	depth = 1 - np.interp(-5, p / weight, z)
	print(f'front: {depth:.4f} m below the top after 24 h, {100 * (depth / .5651 - 1):+.2f} % of 800 finite volumes; water lost {lost:.1e}')
	compared('depth of the wetting front (psi = -5 m) after 24 h', depth, .5651, 'finite volumes, case of Celia and others 1990', 'm')
	axes.set(title='wetting front in dry sand', xlabel='head [m]', ylabel='height [m]')
	below(axes)


known = {  # heads [m] at the heights .2 .4 .6 .8 1 m, by hours of rain
        1: (-.1506, -.2150, -.22805, -.22602, -.07259), 5: (-.15058, -.21335, -.19544, -.10301, -.03066), 10: (-.1458, -.1692, -.1077, -.04973, -.01913),
        15: (-.12046, -.10939, -.06274, -.03028, -.01484), 30: (-.0420, -.03316, -.02102, -.01413, -.01129)}


def rain(axes):
	soil = dict(conductivity=.01 / 3600, porosity=.4, retention=MpmGardner(alpha=10, residual=.06 / .4))
	solver = scene(1, (0, -9.81, 0), lambda y: -weight * min(y, .2), (dict(rain=.001 / 3600), dict(pressure=0)), **soil)
	advance(1e8, 100, 1e8)
	begin, worst = O.time, 0
	solver.flow.drains[0].rain = .009 / 3600
	for hours, heads in known.items():
		advance(begin + hours * 3600, 20, options.longest * 30 * 3600)
		z, p = profile()
		found = np.interp((.2, .4, .6, .8, 1), z, p / weight)
		found[-1] = p[-1] / weight + (1 - z[-1]) * (p[-1] - p[-2]) / weight / (z[-1] - z[-2])
		worst = max(worst, abs(found - heads).max())
		compared(f'head 0.8 m above the water table after {hours} h of rain', found[3], heads[3], 'Srivastava and Yeh 1991', 'm')
		axes.plot(p / weight, z, label=f'{hours} h')
		axes.plot(heads, (.2, .4, .6, .8, 1), 'ko', ms=3)
	print(f'rain: heads within {worst * 1e3:.2f} mm of the closed form, {100 * worst / .22805:.2f} % of their range')
	axes.set(title='rain on a column, dots: closed form', xlabel='head [m]')
	below(axes)


def slope(axes):
	beta, phi, H = np.radians(45), np.radians(30), 5.
	soil = dict(conductivity=1e-6, porosity=.002, retention=MpmVanGenuchten(alpha=1e-5 * weight, n=2, permeability='gardner'))
	expected = {0.: (1.01973, 1.74742), 3e-8: (1.00575, 1.71013), 3e-7: (.88177, 1.37975)}
	for q, exact in expected.items():
		scene(H * np.cos(beta), (9.81 * np.sin(beta), -9.81 * np.cos(beta), 0), lambda y: -weight * np.cos(beta) * y, (dict(rain=q * np.cos(beta)), dict(pressure=0)), **soil)
		for _ in range(4):
			O.dt = 1e9
			O.step()
		y, stress = profile('stress')
		F = -np.tan(phi) * stress[:, 1, 1] / abs(stress[:, 0, 1])
		cells = slice(0, 2 * (len(F) // 2))  # both points of a cell have its stress: means over cells
		axes.plot(F[cells].reshape(-1, 2).mean(axis=1), y[cells].reshape(-1, 2).mean(axis=1) / np.cos(beta), label=f'{q:g} m/s')
		for z, theirs in zip((3, 4), exact):
			normal, shear = (np.interp(z * np.cos(beta), y, part) for part in (stress[:, 1, 1], stress[:, 0, 1]))
			ours = -np.tan(phi) * normal / abs(shear)
			print(f'slope: F = {ours:.5f} at {z} m with {q:g} m/s of rain, {100 * (ours / theirs - 1):+.2f} %')
			compared(f'factor of safety of an infinite slope {z} m above the water table, infiltration {q:g} m/s', ours, theirs, 'Lu and Godt 2008')
		axes.plot(exact, (3, 4), 'ko', ms=3)
	axes.set(title='infinite slope, dots: closed form', xlabel='factor of safety', ylabel='height above the water table [m]', xlim=(0.5, 3))
	below(axes)


begin = time.time()
scenes = dict(front=front, rain=rain, slope=slope)
chosen = scenes if options.scene == 'all' else [options.scene]
figure, axes = plt.subplots(1, len(chosen), figsize=(4.6 * len(chosen), 4.8), layout='constrained', squeeze=False)
for name, ax in zip(chosen, axes[0]):
	scenes[name](ax)
figure.savefig(os.path.join(options.out, 'rain.png'), dpi=110)
print(f'{time.time() - begin:.0f} s')
