#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Gain of splitting material points that outgrow half a cell: the same scenes with and without it, and with more points from the beginning.

	hang       an elastic bar is stretched by its own weight, to twice its length and more at the top; closed form
	press      an elastic block between smooth plates is pressed to 0.15 of its height and grows aside; closed form
	footing    a Box pressed into undrained clay by half its width: how much its load jumps from step to step (examples/penetration)
	collapse   a vertical cut in clay under growing gravity until it lies flat (examples/collapse)
	runout1    a column of sand, as high as wide, is let go (examples/runout); runout1.5, runout2, runout3: higher ones
	slope      the slope with a weak layer (Coombs 2023), where domains are clamped (examples/paper)

Run it with `scripts/run examples/splitting/splitting.py [options]`. Runs that are in the table already are not made again.
"""
import os
import sys
from functools import partial

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'scripts', 'lib'))
from deposits import front
from options import readOptions
from style import plt
from results import Results
from slopes import weakLayerSlope

options = readOptions('Points that are split where they outgrow half a cell.',
        scenes=('hang press footing collapse slope runout1 runout1.5 runout2 runout3', 'which, between blanks'),
        cases=('2/0 2/2 4/0', 'points per cell and axis / maxSplits, between blanks'),
        picture=(1, '1: draw the block and the bar, 0: only numbers'))


def engineFor(grid, maxSplits, **more):
	return MpmImplicitEngine(grid=grid, maxSplits=maxSplits, newton=MpmNewton(minStep=1 / 64), verbosity=0, **more)


def advance(steps, solver, look=lambda: None):
	"""Load steps; returns how many were made, linear solves, the largest number of clamped domains, and why it ended before."""
	solves = clamped = 0
	for step in range(steps):
		try: O.step()
		except RuntimeError as failure:
			return dict(completed=step / steps, solves=solves, clamped=clamped, failure=solver.report()['failure'])
		solves, clamped = solves + solver.iterations, max(clamped, solver.clampedDomains)
		look()
	return dict(completed=1, solves=solves, clamped=clamped, failure='')


def hang(points, maxSplits):
	"""E ln(l) / l = weight below: l = 2.5 at the top. Mean error of the stress over that at the top; points are weighed by volume."""
	E, height, cells, top = 1e6, 10., 20, 2.5
	weight = E * np.log(top) / top
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=weight / height / 10, label='rubber'))
	grid = MpmGrid(cellSize=height / cells)
	h = grid.cellSize
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -height, -1), (h, 0, 1)), grid, points, 'rubber'))
	O.engines = [engineFor(grid, maxSplits, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, 0, -inf), fix='y')])]
	O.dt = 1 / 50
	result = advance(50, O.engines[0])
	found = mpm.arrays()
	exact = weight * (1 + found['pos0'][:, 1] / height) * O.engines[0].loadFactor
	return dict(result, measured=np.average(abs(found['stress'][:, 1, 1] - exact), weights=found['volume']) / weight, exact=0.)


def press(points, maxSplits):
	"""Force on a plate at 0.4 of the height, over that of the closed form, E / (1 - nu^2) ln f / f; how far it comes is in *completed*."""
	E, nu, flat, look = 1e6, 0.45, 0.15, 0.4
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='rubber'))
	O.materials.append(FrictMat(label='rigid'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 1, 1)), grid, points, 'rubber'))
	box = O.bodies[O.bodies.append(utils.box((5, 1.5, 0), (10, 0.5, 1), material='rigid', fixed=True))]
	box.state.vel = (0, flat - 1, 0)
	contact = MpmContact(friction=0, stiffness=1e4)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [engineFor(grid, maxSplits, boundaries=sides, contacts=[contact])]
	O.dt = 1 / 100
	exact = lambda f: -E / (1 - nu**2) * np.log(f) / f
	curve = []

	def record():
		f = box.state.pos[1] - 0.5
		curve.append((f, contact.forces[0][1] / exact(f)))

	result = advance(100, O.engines[0], record)
	height, force = np.transpose(curve)
	return dict(result, measured=np.interp(-look, -height, force), exact=1., curve=curve)


def footing(points, maxSplits):
	"""Mean difference of the load from its moving mean over a cell, beyond a depth of 0.1 B; exact: none."""
	B, cu = 1., 1e4
	h, depth, steps = B / 12, 0.5, 100
	grid = MpmGrid(cellSize=h)
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.49, density=1800, yieldStress=np.sqrt(2) * cu, label='clay'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -1.5 * B, -1), (2 * B, 0, 1)), grid, points, 'clay'))
	box = O.bodies[O.bodies.append(utils.box((0, 2 * B, 0), (B / 2, 2 * B, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -depth * B, 0)
	contact = MpmContact(friction=0, stiffness=100)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2 * B, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -1.5 * B, inf), fix='xy')]
	O.engines = [engineFor(grid, maxSplits, fBar=True, boundaries=sides, contacts=[contact])]
	O.dt, N = 1 / steps, []
	result = advance(steps, O.engines[0], lambda: N.append(2 * contact.forces[0][1] / (B * cu)))
	inCell = int(round(h / depth * steps))
	mean = np.convolve(N, np.ones(inCell) / inCell, 'same')
	off = np.abs(N / mean - 1)[max(inCell // 2, int(0.1 / depth * steps)):-(inCell // 2)]
	return dict(result, measured=off.mean(), exact=0.)


def collapse(points, maxSplits):
	"""Displacement of the front of the cut at the stability number 6 [m]."""
	H, L, cu, density, end = 5., 10., 25e3, 2000, 6.
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.3, density=density, yieldStress=np.sqrt(2) * cu, label='clay'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, points, 'clay'))
	O.engines = [engineFor(grid, maxSplits, gravity=(0, -cu / (density * H), 0), loadCurve=[(0, 0), (end, end)], boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])]
	O.dt = end / 120
	result = advance(120, O.engines[0])
	found = mpm.arrays()
	return dict(result, measured=(found['pos'] + found['halfSize'])[:, 0].max() - L, exact=np.nan)


def runout(points, maxSplits, aspect):
	"""Run-out of the sand, from the face of the column, over its width; experiments: 1.2 a below a = 1.8, 1.9 a^(2/3) from 2.8 on, in between interpolated (G. Lube and others 2005)."""
	L, g, density = 1., 10., 1600.
	height = aspect * L
	O.materials.append(MpmMohrCoulombMat(young=500 * density * g * L, poisson=0.3, density=density, cohesion=1e-3 * density * g * L, frictionAngle=np.arcsin(np.tan(radians(31))), label='sand'))
	grid = MpmGrid(cellSize=0.1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (L, height, 1)), grid, points, 'sand'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -g, 0), boundaries=sides, newton=MpmNewton(minStep=1 / 256), verbosity=0, maxSplits=maxSplits)]
	O.dt = 0.3 * grid.cellSize / np.sqrt(2 * g * height)
	result = advance(int(4 * np.sqrt(height / g) / O.dt), O.engines[0])
	part = np.interp(aspect, (1.8, 2.8), (0, 1))
	found = mpm.arrays()
	area = found['volume'] / np.linalg.det(found['defGrad'])  # loose sand is counted as it was
	return dict(result, measured=front(found['pos'][:, 0], area, L, L) - L, exact=(1 - part) * 1.2 * aspect + part * 1.9 * aspect**(2 / 3))


def slope(points, maxSplits):
	"""Largest displacement [m], or where it failed."""
	grid, sides = weakLayerSlope(0.25, points)
	O.engines = [engineFor(grid, maxSplits, gravity=(0, -9.81, 0), boundaries=sides)]
	O.dt = 1 / 160
	result = advance(160, O.engines[0])
	found = mpm.arrays()
	return dict(result, measured=np.linalg.norm(found['pos'] - found['pos0'], axis=1).max(), exact=np.nan)


def draw():
	"""The block with one point a cell where its run ends, without splitting and with it, and the forces."""
	figure, (forces, *blocks) = plt.subplots(1, 3, figsize=(13, 4), width_ratios=[1.1, 1, 1], layout='constrained')
	for points, maxSplits, style in (1, 0, 'o-'), (1, 6, 's-'), (4, 0, 'k--'):
		text = f'{points} x {points} points, maxSplits={maxSplits}'
		O.reset()
		curve = press(points, maxSplits)['curve']
		forces.plot(*np.transpose(curve), style, markersize=3, label=text)
		if points > 1: continue
		at, ax = mpm.arrays(), blocks.pop(0)
		for x, half in zip(at['pos'], at['halfSize']): ax.add_patch(plt.Rectangle((x - half)[:2], *(2 * half[:2]), facecolor='C0', alpha=0.45, edgecolor='k', linewidth=0.6))
		ax.set(aspect='equal', xlim=(0, 2.5), ylim=(0, 0.8), xticks=np.arange(0, 2.6, 0.5), yticks=(0, 0.5), xlabel='x [m]', ylabel='y [m]', title=text.replace(', ', '\n') + f', at {curve[-1][0]:.2f} of the height')
		ax.grid(linewidth=0.5)
	forces.set(xlabel='height over the first height [-]', ylabel='force over the closed form [-]', xlim=(1, 0.15), ylim=(0, 1.2))
	forces.legend(frameon=False)
	figure.savefig(os.path.join(options.out, 'splitting.png'), dpi=110)


columns = ['pointsAtFirst', 'pointsAtEnd', 'completed', 'solves', 'clamped', 'leftClamped', 'measured', 'exact', 'failure']
table = Results(options.out, 'splitting', ['scene', 'points', 'maxSplits'], columns)
scenes = dict(hang=hang, press=press, footing=footing, collapse=collapse, slope=slope, **{f'runout{a:g}': partial(runout, aspect=a) for a in (1, 1.5, 2, 3)})
for name in options.scenes.split():
	if name not in scenes: sys.exit(f'splitting: there is no scene {name}')
	for case in options.cases.split():
		points, maxSplits = map(int, case.split('/'))
		if (name, points, maxSplits) in table: continue
		O.reset()
		result = scenes[name](points, maxSplits)
		at = mpm.arrays()
		result.update(pointsAtFirst=int((at['parent'] < 0).sum()) if 'parent' in at else len(at['id']), pointsAtEnd=len(at['id']), leftClamped=O.engines[0].clampedDomains)
		result.pop('curve', None)
		table.add([dict(scene=name, points=points, maxSplits=maxSplits, **result)])
		print(name, case, ', '.join(f'{key} {value:.5g}' if isinstance(value, (int, float)) else f'{key} {value}' for key, value in result.items()), flush=True)
if options.picture:
	draw()
	print(f'written: {options.out}/splitting.png, results/splitting.csv')
