#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""An embankment on soft clay, built in stages with time between them in which the clay consolidates: settlement, pressures, and safety after each stage.

	o|_ _ _ _ _                    layers of 0.75 m, slope 1:2; half of it, by symmetry
	o|______________\\_____________o    0   drained: a blanket of sand, and the water table
	o|    crust                   o   -1
	o|    clay (Cam clay, OCR 1.3)o
	 /////////////////////////////   -6   impervious

Against the same built so slowly that everything is drained. Safety is that of total stress: the clay has the strength at constant volume that follows from its present volume.

Run it with `scripts/run examples/embankment/waiting.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('An embankment on soft clay, in stages.',
        cellSize=(0.5, 'size of the cells [m], at most 1'),
        layers=(4, 'number of layers'),
        waiting=(90., 'time between two layers [days]'),
        safety=(1, '1: look for the factor of safety after each layer, 0: do not'))
thickness, depth, width, crest, slope, g, day = 0.75, 6., 24., 4., 2., 10., 86400.
lam, kappa, M, p1 = 0.08, 0.012, 1.0, 1e4  # parameters of the clay: slopes in ln v - ln p, critical state ratio, reference pressure


def scene():
	O.reset()
	O.materials.append([
	        MpmMohrCoulombMat(young=8e6, poisson=0.3, density=1700, cohesion=15e3, frictionAngle=np.radians(28), conductivity=1e-8, porosity=.5, label='crust'),
	        MpmCamClayMat(density=1700, shearModulus=1.5e6, criticalStateRatio=M, compressionIndex=lam, swellingIndex=kappa, preconsolidation=1e5, referencePressure=p1, conductivity=4e-9, porosity=.6,
	                conductivityLaw='log', conductivityIndex=.5, label='clay'),
	        MpmMohrCoulombMat(young=2e7, poisson=0.3, density=1900, cohesion=3e3, frictionAngle=np.radians(35), dilationAngle=np.radians(5), conductivity=1e-5, porosity=.4, label='sand')
	])
	grid = MpmGrid(cellSize=options.cellSize)
	O.bodies.append(mpm.fill(mpm.polygon([(0, -depth), (width, -depth), (width, 0), (0, 0)]), grid, 2, lambda x: 'crust' if x[1] > -1 else 'clay'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	O.engines = [
	        MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=sides, water=[MpmWater(level=0, weight=1e4)], fBar=True, label='solver', verbosity=0)
	]
	O.dt = 1
	mpm.geostatic(OCR=1.3)
	return grid


def place(n, grid):
	low, high, toe = thickness * (n - 1), thickness * n, crest + slope * thickness * options.layers
	layer = mpm.polygon([(0, low), (toe - slope * low, low), (toe - slope * high, high), (0, high)])
	mpm.stages.place(mpm.fill(layer, grid, 2, 'sand'), steps=5)


def settlement(middle):
	return O.bodies[middle].state.refPos[1] - O.bodies[middle].state.pos[1]


def step(days):
	O.dt = days * day
	O.step()


def safety():
	"""Bracket of the factor in total stress; the scene is as before after it. At constant volume p ends at the critical state, where q = M p."""
	kept = os.path.join(options.out, 'stage.yade.gz')
	O.save(kept)
	points = mpm.arrays()
	clay = points['material'] == 1
	p0 = -np.trace(points['stress'][clay], axis1=1, axis2=2) / 3
	last = points['preconsolidation'][clay]
	strength = M / 2 * (last / 2)**(1 - kappa / lam) * p0**(kappa / lam)
	total = points['stress'] - points['porePressure'][:, None, None] * np.eye(3)
	solver.flow, solver.water = None, []
	O.materials.append(MpmTrescaMat(young=4e6, poisson=.49, density=1700, undrainedStrength=1e4, label='undrained clay'))
	for i in points['id'][clay]:
		O.bodies[int(i)].material = O.materials['undrained clay']
		O.bodies[int(i)].state.internals = []
	principal = np.linalg.eigvalsh(total[clay])
	strength = np.maximum(strength, 0.505 * (principal[:, 2] - principal[:, 0]))  # Cam clay carries some more off the axes of a triaxial test
	mpm.assign(ids=points['id'][clay], undrainedStrength=strength, stress=total[clay])
	found = mpm.strengthReduction(tolerance=.02)
	O.load(kept)
	return found['lower']


def drained():
	grid = scene()
	middle = max((b for b in O.bodies if b.state.pos[0] < options.cellSize / 2), key=lambda b: b.state.pos[1]).id
	for n in range(1, options.layers + 1):
		place(n, grid)
		O.run(5, wait=True)
	return settlement(middle)


def inStages():
	"""Time [days], settlement [m] and largest pressure [Pa] after each step; by stage the factors as the layer is there and after the time; pictures."""
	grid = scene()
	middle = max((b for b in O.bodies if b.state.pos[0] < options.cellSize / 2), key=lambda b: b.state.pos[1]).id
	solver.flow = MpmFlow(unitWeight=1e4, drains=[MpmDrain(surface=[(width, 0), (0, 0)])])
	begin, curve, factors = O.time, [(0., 0., 0.)], []
	figure, axes = plt.subplots((options.layers + 1) // 2 + 1, 2, figsize=(12, 2.4 * ((options.layers + 1) // 2) + 3.4), layout='constrained')

	def go(lengths):
		for days in lengths:
			step(days)
			curve.append(((O.time - begin) / day, settlement(middle), mpm.arrays()['excessPressure'].max()))

	for n in range(1, options.layers + 1):
		place(n, grid)
		go([1.] * 5)
		factors.append([safety()] if options.safety else [])
		section = mpm.plot('excessPressure', ax=axes.flat[n - 1], range=(0, 45e3))
		section.set_title(f'layer {n}, {curve[-1][0]:.0f} days: excess pore pressure')
		section.child_axes[0].set_ylabel('[kPa]')
		lengths = 1.6**np.arange(8)
		go(lengths * (options.waiting / lengths.sum()))
		if options.safety: factors[-1].append(safety())
		print(f'layer {n}: after {curve[-1][0]:.0f} days {1e3 * curve[-1][1]:.0f} mm, pressures up to {curve[-1][2] / 1e3:.1f} kPa, factor of safety ' + ', later '.join(f'{F:.2f}' for F in factors[-1]))
	go(np.geomspace(30, 3000, 12))
	print(f'in the end {1e3 * curve[-1][1]:.0f} mm, pressures up to {curve[-1][2] / 1e3:.2f} kPa')
	return np.array(curve), factors, figure, axes


begin = time.time()
slow = drained()
curve, factors, figure, axes = inStages()
print(f'{1e3 * slow:.0f} mm if all is drained, {1e3 * curve[-1, 1]:.0f} mm after {curve[-1, 0] / 365:.0f} years, {time.time() - begin:.0f} s')
left, right = axes[-1]
left.plot(curve[:, 0] + 1, 1e3 * curve[:, 1], 'o-', markersize=4, label='in stages')
left.axhline(1e3 * slow, color='k', linestyle='--', label='all drained')
left.set(xscale='log', xlabel='time + 1 [days]', ylabel='settlement at the centre [mm]')
left.legend(frameon=False)
left.invert_yaxis()
right.plot(curve[:, 0] + 1, curve[:, 2] / 1e3, 'o-', markersize=4)
right.margins(y=.2)
right.set(xscale='log', xlim=(0.1, None), xlabel='time + 1 [days]', ylabel='largest excess pressure [kPa]')
if options.safety:
	for n, (at, later) in enumerate(factors):
		right.annotate(f'F {at:.2f}, then {later:.2f}', (n * (5 + options.waiting) + 6, curve[5 + 13 * n, 2] / 1e3), fontsize=11, ha='right', xytext=(-4, 3), textcoords='offset points')
figure.savefig(os.path.join(options.out, 'waiting.png'), dpi=100)
