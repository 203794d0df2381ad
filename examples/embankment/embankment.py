#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""An embankment in seven layers on soft ground, drained; before it, layers on an elastic column against the sum by hand.

	o|_ _ _ _ _                    layers of 0.5 m, slope 1:2; half of it, by symmetry
	o|_ _ _ _ _ _ \\
	o|______________\\_____________o    0
	o|    crust                   o   -1    water table at the surface
	o|    clay (Cam clay, OCR 1.3)o
	 /////////////////////////////   -6

By hand: each layer adds its weight q to ground of height H, which settles by q H / M, with the modulus M of strain in one direction.

Run it with `scripts/run examples/embankment/embankment.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('An embankment on soft ground.',
        cellSize=(0.5, 'size of the cells [m], at most 1'),
        layers=(7, 'number of layers'),
        steps=(4, 'load steps of a layer'),
        width=(24., 'half width of the ground [m]'))
thickness, depth, crest, slope, g = 0.5, 6., 4., 2., 10.


def scene(width, ground):
	"""Ground at rest with sides that slide; returns engine and grid. *ground*: materials by the depth at which they begin."""
	O.reset()
	O.materials.append([material for _, material in ground])
	grid = MpmGrid(cellSize=options.cellSize)
	labelAt = lambda x: [material.label for begin, material in ground if begin <= -x[1]][-1]
	O.bodies.append(mpm.fill(mpm.polygon([(0, -depth), (width, -depth), (width, 0), (0, 0)]), grid, 2, labelAt))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	engine = MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=sides, label='solver')
	O.engines = [engine]
	O.dt = 1
	return engine, grid


def pointAt(x, y):
	points = mpm.arrays()
	return int(points['id'][((points['pos0'] - (x, y, 0))**2).sum(1).argmin()])


def moved(body):
	return O.bodies[body].state.pos - O.bodies[body].state.refPos


def column():
	"""Settlement of an elastic column, layer by layer, against the sum by hand."""
	M, density = 1e7, 2000
	width = 2 * options.cellSize
	solver, grid = scene(width, [(0, MpmElasticMat(young=M, poisson=0, density=1700, label='ground')), (99, MpmElasticMat(young=M, poisson=0, density=density, label='fill'))])
	mpm.geostatic()
	surface = pointAt(0, 0)
	height = depth + O.bodies[surface].state.pos[1]
	for n in range(1, options.layers + 1):
		y = thickness * (n - 1)
		mpm.stages.place(mpm.fill(mpm.polygon([(0, y), (width, y), (width, y + thickness), (0, y + thickness)]), grid, 2, 'fill'), steps=options.steps)
		O.run(options.steps, wait=True)
		found, hand = -moved(surface)[1], n * density * g * thickness * height / M
		print(f'column, {n} layers: settlement {1e3 * found:.2f} mm, by hand {1e3 * hand:.2f} mm ({100 * (found / hand - 1):+.2f} %)')
		compared(f'settlement of a column under {n} layers', 1e3 * found, 1e3 * hand, 'sum by hand, q H / M', 'mm')


def drawStage(ax, n):
	mpm.plot('displacement', ax=ax, range=(0, 0.5)).set_title(f'{n} layer{"s" if n > 1 else ""}')
	ax.set(xlim=(-0.5, options.width + 0.5), ylim=(-depth - 0.3, thickness * options.layers + 0.3))  # the same in all
	if n < options.layers - 1: ax.set_xlabel('')


def embankment():
	clay = MpmCamClayMat(density=1700, shearModulus=1.5e6, criticalStateRatio=1.0, compressionIndex=0.08, swellingIndex=0.012, preconsolidation=1e5, referencePressure=1e4, label='clay')
	crust = MpmMohrCoulombMat(young=8e6, poisson=0.3, density=1700, cohesion=15e3, frictionAngle=np.radians(28), label='crust')
	sand = MpmMohrCoulombMat(young=2e7, poisson=0.3, density=1900, cohesion=3e3, frictionAngle=np.radians(35), dilationAngle=np.radians(5), label='sand')
	solver, grid = scene(options.width, [(0, crust), (1, clay), (99, sand)])
	solver.water = [MpmWater(level=0, weight=1e4)]
	mpm.geostatic(OCR=1.3)
	toeAt = crest + slope * thickness * options.layers
	middle, toe = pointAt(0, 0), pointAt(toeAt, 0)
	history, states = [(0, 0., 0.)], []
	figure, axes = plt.subplots(4, 2, figsize=(12, 9), layout='constrained')
	begin = time.time()
	for n in range(1, options.layers + 1):
		low, high = thickness * (n - 1), thickness * n
		layer = mpm.polygon([(0, low), (toeAt - slope * low, low), (toeAt - slope * high, high), (0, high)])
		mpm.stages.place(mpm.fill(layer, grid, 2, 'sand'), steps=options.steps)
		O.run(options.steps, wait=True)
		history.append((n, -moved(middle)[1], moved(toe)[0]))
		print(f'embankment, {n} layers: settlement in the middle {1e3 * history[-1][1]:.0f} mm, toe outwards {1e3 * history[-1][2]:.1f} mm')
		if n <= 7: drawStage(axes.flat[n - 1], n)
	print(f'embankment: {len(mpm.arrays()["id"])} points, {time.time() - begin:.1f} s')
	weight = sum(b.state.mass for b in O.bodies) * g
	squeezed = sum(b.state.volume0 - b.state.volume for b in O.bodies if b.material.label != 'sand') * 1e4
	print(f'embankment: load on the base over the weight, less that of the water squeezed out: {solver.reactions[2][1] / (weight - squeezed):.5f}')
	compared('load on the base of the embankment over the weight', solver.reactions[2][1] / (weight - squeezed), 1, 'sum by hand')
	n, settlement, outwards = np.array(history).T
	last = axes.flat[7]
	last.plot(thickness * n, 1e3 * settlement, 'o-', label='settlement at the centre')
	last.plot(thickness * n, 1e3 * outwards, 's-', label='toe, outwards')
	last.set(xlabel='height [m]', ylabel='displacement [mm]', title='centre and toe')
	last.legend(loc='upper left')
	figure.savefig(os.path.join(options.out, 'embankment.png'), dpi=100)


column()
embankment()
