#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Recharge of a water table: a tank of sand, 3 x 2 m, gets water on half a metre of its top (Vauclin, Khanji and Vachaud 1979), against finite volumes and what was read then.

Run it with `scripts/run examples/rain/recharge.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
folder = os.path.dirname(sys.argv[0])
sys.path[:0] = folder, os.path.join(folder, '..')
from options import compared, readOptions
from style import plt
from volumes import Section, Soil, rational

options = readOptions('Recharge of a water table.',
        cellSize=(0.05, '[m]'),
        longest=(120., 'longest step [s]'),
        volumes=(60, 'finite volumes along the tank'))
weight, K, porosity = 9810., .35 / 3600, .3  # of water [N/m3]; conductivity [m/s]
saturation, permeability = rational(.01 * 40000**(1 / 2.9), 2.9), rational(.01 * 2.99e6**(1 / 5), 5)
length, height, table, wet, rain = 3, 2, .65, .5, .148 / 3600  # [m], [m/s]
read = {  # heights of the water table [m] by hours, at distances [m] from the middle of what gets water
        2: [(.01, .786), (.28, .785), (.49, .770), (.70, .751), (1.00, .720), (1.30, .681), (1.60, .664)],
        3: [(.03, 1.027), (.29, 1.004), (.49, .973), (.70, .938), (1.00, .859), (1.30, .799), (1.60, .762)],
        4: [(.03, 1.121), (.29, 1.102), (.49, 1.073), (.70, 1.038), (.99, .970), (1.30, .902), (1.60, .836)],
        8: [(.02, 1.211), (.11, 1.203), (.29, 1.196), (.36, 1.198), (.50, 1.175), (.70, 1.146), (.99, 1.097), (1.30, 1.029), (1.60, .958)]}


def tableAt(x, z, heads):
	"""Height of the water table in columns of heads, by distance; x and z are those of the columns and of what is in them."""
	last = [np.flatnonzero(column > 0)[-1] for column in heads]
	return np.array([z[k] + (z[k + 1] - z[k]) * column[k] / (column[k] - column[k + 1]) for k, column in zip(last, heads)])


def byVolumes():
	section = Section((options.volumes, options.volumes * height // length), (length, height), Soil(K, porosity, saturation, permeability))
	section.level, section.rain = table, np.where(section.x < wet, rain, 0)
	start = np.broadcast_to(table - section.z, section.cells)
	return [(section.x, tableAt(section.x, section.z, heads)) for heads in section.run(start, [3600 * hours for hours in read], 120)]


def byPoints():
	suctions = [0, *np.geomspace(.01, 3, 80)]
	curve = MpmRetentionTable(saturations=[(s, float(saturation(np.array(-s))[0])) for s in suctions], permeabilities=[(s, float(permeability(np.array(-s))[0])) for s in suctions])
	O.materials.append(MpmElasticMat(young=1e9, poisson=0.3, density=2000, conductivity=K, porosity=porosity, retention=curve, label='sand'))
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (length, 0), (length, height), (0, height)]), grid, 2, 'sand'))
	mpm.assign(excessPressure=[weight * (table - y) for y in mpm.arrays()['pos'][:, 1]])
	drains = [MpmDrain(surface=[(wet, height), (0, height)], rain=rain), MpmDrain(surface=[(length, 0), (length, height)], level=table, conductance=300)]
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(length, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=sides, flow=MpmFlow(total=True, drains=drains), loadCurve=[(0, 1), (1, 1)], verbosity=0)]
	O.dt = 10
	for hours in read:
		while O.time < hours * 3600 * (1 - 1e-9):
			O.dt = min(O.dt, hours * 3600 - O.time)
			O.step()
			O.dt = min(1.3 * O.dt, options.longest)
		points = mpm.arrays()
		x, z = (np.unique(points['pos0'][:, axis].round(9)) for axis in (0, 1))
		order = np.lexsort((points['pos0'][:, 1].round(9), points['pos0'][:, 0].round(9)))
		yield x, tableAt(x, z, (points['excessPressure'][order] / weight).reshape(len(x), len(z)))


begin = time.time()
figure, ax = plt.subplots(figsize=(7, 4.4), layout='constrained')
apart, off = 0, 0
for (hours, readings), (x, found), (xOfVolumes, ofVolumes) in zip(read.items(), byPoints(), byVolumes()):
	theirs = np.interp(x, xOfVolumes, ofVolumes)
	places, heights = np.transpose(readings)
	apart, off = max(apart, abs(found - theirs).max()), max(off, abs(np.interp(places, x, found) - heights).max())
	line, = ax.plot(x, found, label=f'{hours} h')
	ax.plot(xOfVolumes, ofVolumes, 'k--', lw=.7)
	ax.plot(places, heights, 'o', color=line.get_color(), ms=4)
	compared(f'height of the water table below the recharge after {hours} h', found[0], theirs[0], 'finite volumes, case of Vauclin and others 1979', 'm')
	compared(f'height of the water table 1 m from the middle after {hours} h', np.interp(1, x, found), np.interp(1, places, heights), 'Vauclin and others 1979, experiment', 'm')
print(f'recharge: the water table is within {100 * apart:.1f} cm of finite volumes and {100 * off:.1f} cm of readings')
ax.set(title='recharge of a water table; dashed: finite volumes, dots: readings', xlabel='x [m]', ylabel='height [m]')
ax.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'recharge.png'), dpi=110)
print(f'{time.time() - begin:.0f} s')
