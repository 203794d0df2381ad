#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Motion with known answers, by MpmDynamicEngine.

	bar        an elastic bar, held at one end, swings in its first mode: period with steps from half to a hundred times those in which sound crosses a cell, and in
	           cells of four sizes; and the speed of waves eight cells long. T = 4 L / c; Newmark's rule makes T / T_exact = (w dt / 2) / atan(w dt / 2)
	pulse      a pulse runs to a free end that cuts a cell, and back: what is left of its energy, for ten cuts and several ghost masses
	steps      a pulse from the base, with steps of one length and with such as timeTolerance chooses: error against solves
	mass       condition number of mass, with and without ghost mass, while a block moves through a cell
	block      an elastic block slides down an inclined Box: a = g (sin b - tan(friction) cos b)
	sphere     a free Sphere of YADE rolls down a stiff elastic block, gravity turned: 5/14 g t^2 sin b

Run it with `scripts/run examples/waves/waves.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import functools
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Waves, mass and sliding against closed forms.',
        scene=('bar', "'bar', 'pulse', 'steps', 'mass', 'block' or 'sphere', or several between blanks"),
        short=(0, '1: fewer cases, for a quick look'))

E, density = 1e6, 1000.
c = np.sqrt(E / density)


def makeBar(length, h, origin=0, points=0, period=0, boundaries=[], **settings):
	"""Without Poisson's effect between rollers at both sides, in cells of a size h [m]; both ends are free.

	:param origin: of the grid [cells]
	:param points: by how much they are shifted from their usual places, 2 x 2 in a cell from 0 on [cells]
	:param period: of the grid [m]
	"""
	O.reset()
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=density, label='bar'))
	grid = MpmGrid(cellSize=h, origin=(origin * h, 0, 0), period=(period, 0, 0))
	across = [MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, h, -inf), fix='y')]
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (length, h, 1)), MpmGrid(cellSize=h, origin=(points * h, 0, 0)), 2, 'bar'))
	O.engines = [MpmDynamicEngine(grid=grid, boundaries=list(boundaries) + across, newton=MpmNewton(tolerance=1e-9), verbosity=0, **settings)]
	return O.engines[0]


def swing(mode, courant, h, steps=60):
	"""Angular frequency [1/s] of motion that begins with velocities of points (N,): amplitudes of a harmonic motion have v- + v+ = 2 cos(w dt) v."""
	mpm.assign(velocity=np.outer(1e-6 * c * mode, (1, 0, 0)))
	O.dt = courant * h / c
	v = [1]
	for step in range(steps):
		O.step()
		v.append(mpm.arrays()['velocity'][:, 0] @ mode / (mode @ mode) / (1e-6 * c))
	v = np.array(v)
	return np.arccos(np.clip((v[:-2] + v[2:]) @ v[1:-1] / (2 * v[1:-1] @ v[1:-1]), -1, 1)) / O.dt


def withoutErrorInTime(w):
	return 2 / O.dt * np.tan(w * O.dt / 2)


def firstMode(cells, courant):
	makeBar(1, 1 / cells, boundaries=[MpmBoundary(max=(0, inf, inf), fix='x')])
	return swing(np.sin(np.pi / 2 * mpm.arrays()['pos'][:, 0]), courant, 1 / cells)


def speed(points):
	"""Speed of standing waves eight cells long, in a bar without ends, over c."""
	makeBar(16, 1., points=points, period=16)
	return withoutErrorInTime(swing(np.sin(np.pi / 4 * mpm.arrays()['pos'][:, 0]), 0.1, 1)) / (np.pi / 4 * c)


def bar():
	exact = np.pi / 2 * c
	print('20 cells; steps over h / c, first period over 4 L / c, closed form of the rule in time')
	inTime = []
	for courant in (0.5, 1, 4, 20) if options.short else (0.5, 1, 2, 4, 8, 16, 32, 100):
		w, half = firstMode(20, courant), exact * courant / 20 / c / 2
		inTime.append((courant, exact / w - 1, half / np.arctan(half) - 1))
		print(f'{courant:5g}  {exact / w:.5f}  {half / np.arctan(half):.5f}')
		compared(f'period of a bar, 20 cells, dt c / h = {courant:g}', exact / w, half / np.arctan(half), 'trapezoidal rule, closed form', '4 L / c')
	inSpace = []
	print('steps of h / c / 10; cells, first period over 4 L / c - 1')
	for cells in (5, 10, 20) if options.short else (5, 10, 20, 40):
		w = withoutErrorInTime(firstMode(cells, 0.1))
		inSpace.append((cells, abs(exact / w - 1)))
		print(f'{cells:5}  {exact / w - 1:+.2e}')
	inTime, inSpace = np.array(inTime), np.array(inSpace)
	early = inTime[:, 0] <= 8
	ofTime = inTime[early, 1] - np.interp(20, inSpace[:, 0], -inSpace[:, 1])  # less what is of the cells
	orders = np.polyfit(np.log(inTime[early, 0]), np.log(ofTime), 1)[0], -np.polyfit(np.log(inSpace[:, 0]), np.log(inSpace[:, 1]), 1)[0]
	print(f'order in time {orders[0]:.2f}, in space {orders[1]:.2f}')
	for points, closed in (0, 1.033), (0.125, 1.004):
		print(f'waves of eight cells, points shifted by {points} h: speed over c {speed(points):.4f}, of two points a cell {closed}')
		compared(f'speed of waves eight cells long, points shifted by {points} h', speed(points), closed, 'two points a cell, closed form', 'c')
	figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout='constrained')
	left.loglog(inTime[:, 0], inTime[:, 1], 'o', label='20 cells')
	left.loglog(inTime[:, 0], inTime[:, 2], 'k-', linewidth=0.8, label='closed form of the trapezoidal rule')
	left.set(xlabel='time step dt c / h [-]', ylabel='error of the first period [-]')
	right.loglog(*inSpace.T, 'o', label='dt = 0.1 h / c, without its error')
	right.loglog(inSpace[:, 0], inSpace[-1, 1] * (inSpace[-1, 0] / inSpace[:, 0])**2, 'k-', linewidth=0.8, label='second order')
	right.set(xlabel='cells over the length [-]', ylabel='error of the first period [-]')
	for ax in left, right: ax.legend(frameon=False)
	return figure


def reflect(cut, massFactor, width):
	"""Part of the energy of a pulse of a half width of so many cells that is left when it has come back from an end that reaches into a cell by a part of it."""
	cells = int(12 * width)
	solver = makeBar(cells, 1., origin=-cut, ghost=MpmGhost(massFactor=massFactor, factor=0.01))
	points = mpm.arrays()
	x = (points['pos'][:, 0] - 0.5 * cells) / width
	speed = 0.02 * c * np.sqrt(2 * np.e) * x * np.exp(-x**2)  # displacements are as exp(-x^2)
	stress = np.zeros((len(speed), 3, 3))
	stress[:, 0, 0] = -density * c * speed
	mpm.assign(velocity=np.outer(speed, (1, 0, 0)), stress=stress)
	O.dt = 0.5 / c
	O.step()
	data = solver.plotData()
	first = data['kineticEnergy'] + data['elasticEnergy']
	while O.time < cells / c: O.step()
	data = solver.plotData()
	return (data['kineticEnergy'] + data['elasticEnergy']) / first


def pulse():
	cuts = (1e-6, 0.6) if options.short else (1e-6, 1e-3, 0.03, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1)
	factors = (1e-3, 0.25) if options.short else (0, 1e-3, 1e-2, 0.25)
	figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True, layout='constrained')
	print('energy left: worst / median of the cuts', cuts)
	for ax, width in zip(axes, (3, 6)):
		for massFactor in factors[:1] if options.short and width == 6 else factors:
			left = []
			for cut in cuts:
				try: left.append(reflect(cut, massFactor, width))
				except RuntimeError as failure:
					left.append(np.nan)
					print(f'half width {width}, massFactor {massFactor:g}, cut {cut:g}: {failure}')
			print(f'half width {width} h, massFactor {massFactor:g}: {np.nanmin(left):.3f} / {np.nanmedian(left):.3f}', flush=True)
			ax.semilogx(cuts, left, 'o-', markersize=4, label=f'massFactor {massFactor:g}')
		ax.set(xlabel='filled part of the last cell [-]', title=f'half width {width} cells')
	axes[0].set_ylabel('energy left after reflection [-]')
	axes[0].legend(frameon=False)
	return figure


def shake(longest, tolerance):
	"""A bar on end that a pulse of its base has run through. Positions of its points [m], solves, and steps."""
	t = np.linspace(0.2, 0.8, 241)
	a = (np.pi * (t - 0.5) / 0.12)**2
	history = [(0, 0), *zip(t.tolist(), (0.2 * (1 - 2 * a) * np.exp(-a)).tolist()), (2, 0)]
	base = MpmBoundary(max=(0, inf, inf), fix='x', motion=MpmBaseMotion(history=history, direction=(1, 0, 0)))
	solver = makeBar(10, 0.5, boundaries=[base], timeTolerance=tolerance)
	solver.newton.minStep = 1 / 1024
	O.dt, solves, made = longest, 0, 0
	while O.time < 1.02:
		O.step()
		solves, made = solves + solver.iterations, made + solver.substeps
	return mpm.arrays()['pos'], solves, made


def steps():
	exact = shake(1e-3 if options.short else 2.5e-4, 0)[0]
	figure, ax = plt.subplots(figsize=(7, 4.5), layout='constrained')
	print('longest step, timeTolerance: largest error of positions, solves, steps')
	for cases in [(dt, 0) for dt in (0.016, 0.008, 0.004, 0.002, 0.001)[:3 if options.short else 5]], [(0.064, tol) for tol in (1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)[1:4 if options.short else 6]]:
		rows = []
		for longest, tolerance in cases:
			found, solves, made = shake(longest, tolerance)
			rows.append((solves, np.abs(found - exact).max()))
			print(f'{longest:g} s, {tolerance:g}: {rows[-1][1]:.2e} m, {solves} solves, {made} steps', flush=True)
		ax.loglog(*np.transpose(rows), 'o-', label='timeTolerance, O.dt = 64 ms' if tolerance else 'steps of one length')
	ax.set(xlabel='solves [-]', ylabel='largest error of positions [m]')
	ax.legend(frameon=False)
	return figure


def shapes(pos, half, h):
	"""Basis functions along one axis, hats averaged over boxes: nodes (M,), values (N, M)."""
	nodes = np.arange(np.floor((pos - half).min() / h + 1e-12), np.ceil((pos + half).max() / h - 1e-12) + 1)

	def integral(x):
		x = np.clip(x, -1, 1)
		return np.where(x < 0, (1 + x)**2 / 2, 1 - (1 - x)**2 / 2)

	return nodes, (integral((pos + half)[:, None] / h - nodes) - integral((pos - half)[:, None] / h - nodes)) * h / (2 * half[:, None])


def faceMatrix(cells):
	"""Sum over inner faces, at edges of the matter, of h^3 / 3 times the integral of [d_n N_a] [d_n N_b], for cells in a box of unit size, in any dimension."""
	nodes = np.arange(np.prod(np.add(cells, 1))).reshape(np.add(cells, 1))
	J, along, jump = np.zeros((nodes.size, ) * 2), np.array([[2, 1], [1, 2]]) / 6, np.outer((1, -2, 1), (1, -2, 1))
	for axis in range(len(cells)):
		last = np.subtract(cells, 1) - (np.arange(len(cells)) == axis)  # number of the first of the two cells at a face
		of = functools.reduce(np.kron, [jump if a == axis else along for a in range(len(cells))])
		for cell in np.ndindex(*(last + 1)):
			if not any(i in (0, end) for i, end in zip(cell, last)): continue
			ids = nodes[tuple(slice(i, i + (3 if a == axis else 2)) for a, i in enumerate(cell))].ravel()
			J[np.ix_(ids, ids)] += of / 3
	return J


def mass():
	size, perCell, factors = 4, 2, (0, 1e-3, 1e-2, 0.25)
	moved = np.concatenate([10.**np.arange(-10, -1), np.linspace(0.02, 0.98, 9 if options.short else 49), 1 - 10.**np.arange(-2, -11, -1.)])
	figure, axes = plt.subplots(1, 3, figsize=(13, 4), sharey=True, layout='constrained')
	print('condition number of M + M_g of a block of 4 cells along each axis, 2 points each: least, at a cut of 1e-10, worst')
	for dim, ax in enumerate(axes, 1):
		found = []
		for s in moved:
			x, half = s + (np.arange(size * perCell) + 0.5) / perCell, np.full(size * perCell, 0.5 / perCell)
			nodes, S = shapes(x, half, 1)
			M, J = functools.reduce(np.kron, [S.T @ S / perCell] * dim), faceMatrix([len(nodes) - 1] * dim)
			found.append([np.linalg.cond(M + factor * J) for factor in factors])
		for column, factor in zip(np.transpose(found), factors):
			ax.semilogy(moved, column, label=f'massFactor {factor:g}')
			print(f'{dim}D, massFactor {factor:5g}: {column.min():.3g}  {column[0]:.3g}  {column.max():.3g}')
		ax.set(xlabel='way of the block / h [-]', title=f'{dim}D', ylim=(5, 1e17))
	compareGhost()
	axes[0].set_ylabel('condition number of the mass matrix [-]')
	axes[0].legend(frameon=False)
	return figure


def compareGhost():
	"""The faces of faceMatrix are those of the engine: eigenvalues of its ghost stiffness, which is linear in the factor."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1, poisson=0, density=1, label='block'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0.25, 0.25, 0), (4.25, 4.25, 1)), MpmGrid(cellSize=1, origin=(0.25, 0.25, 0)), 2, 'block'))
	K = []
	for factor in 0, 1:
		solver = MpmImplicitEngine(grid=MpmGrid(cellSize=1), ghost=MpmGhost(factor=factor))
		O.engines = [solver]
		rows, columns, values, n = solver.stiffness()
		K.append(np.zeros((n, n)))
		K[-1][rows, columns] = values
	ours, engines = np.linalg.eigvalsh(faceMatrix((5, 5))), np.linalg.eigvalsh(K[1] - K[0])[::2]
	print(f'eigenvalues of the faces: differ from those of the ghost stiffness of the engine by {np.abs(ours - engines).max() / ours.max():.1e}')


def block():
	slope, friction, g, h = np.radians(30), np.radians(15), 10., 0.25
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=0.2, density=2000, label='block'))
	O.materials.append(FrictMat(young=1e9, frictionAngle=friction, label='rock'))
	down, up = np.array((np.cos(slope), -np.sin(slope))), np.array((np.sin(slope), np.cos(slope)))
	corners = [tuple(along * down + above * up) for along, above in ((0, 0), (2, 0), (2, 1), (0, 1))]
	O.bodies.append(mpm.fill(mpm.polygon(corners), MpmGrid(cellSize=h), 4, 'block'))
	middle = 5 * down - 0.5 * up
	O.bodies.append(utils.box((*middle, 0), (8, 0.5, 1), orientation=Quaternion((0, 0, 1), -slope), fixed=True, material='rock'))
	O.engines = [MpmDynamicEngine(grid=MpmGrid(cellSize=h), gravity=(0, -g, 0), contacts=[MpmContact(stiffness=50)], scheme='generalised-alpha', rhoInfinity=0.5, verbosity=0)]
	O.dt = 0.01
	start, times, way = mpm.arrays()['pos'][:, :2].mean(axis=0), [], []
	while O.time < (0.6 if options.short else 1.2):
		O.step()
		times.append(O.time)
		way.append((mpm.arrays()['pos'][:, :2].mean(axis=0) - start) @ down)
	times, way = np.array(times), np.array(way)
	late = times > 0.2
	found, exact = 2 * np.polyfit(times[late], way[late], 2)[0], g * (np.sin(slope) - np.tan(friction) * np.cos(slope))
	print(f'block, slope 30, friction 15 degrees: a = {found:.4f} m/s2, exact {exact:.4f} ({100 * (found / exact - 1):+.2f} %)')
	compared('acceleration of a block on a slope', found, exact, 'g (sin b - tan(phi) cos b)', 'm/s2')
	figure, ax = plt.subplots(figsize=(8, 6), layout='constrained')
	mpm.plot('velocity_x', ax=ax)
	return figure


def sphere():
	slope, g, R, h = np.radians(20), 10., 0.5, 0.125
	O.reset()
	O.materials.append(MpmElasticMat(young=5e7, poisson=0.2, density=2000, label='ground'))
	O.materials.append(FrictMat(young=1e9, density=2600, frictionAngle=np.radians(30), label='ball'))
	grid = MpmGrid(cellSize=h, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -2 * h), (12 * h, 4 * h, 0)), grid, 2, 'ground'))
	for body in O.bodies: body.groupMask = 2
	ball = O.bodies[O.bodies.append(utils.sphere((4 * h, 2 * h, R), R, material='ball'))]
	contact = MpmContact(mask=1, stiffness=100)
	O.engines = [
	        ForceResetter(),
	        MpmDynamicEngine(grid=grid, boundaries=[MpmBoundary(max=(inf, inf, -2 * h), fix='xyz')], contacts=[contact], scheme='generalised-alpha', rhoInfinity=0.5, verbosity=0),
	        NewtonIntegrator(gravity=(0, 0, -g * np.cos(slope)), damping=0.7, mask=1, label='newton'),
	]
	O.dt = 1e-3
	O.run(100, wait=True)  # it sinks in; then it is let go
	newton.gravity, newton.damping = (g * np.sin(slope), 0, -g * np.cos(slope)), 0
	ball.state.vel = (0, 0, 0)
	begins = O.time, ball.state.pos[0]
	times, way = [], []
	while O.time - begins[0] < (0.12 if options.short else 0.5):
		O.step()
		times.append(O.time - begins[0])
		way.append(ball.state.pos[0] - begins[1])
	times, way = np.array(times), np.array(way)
	found, exact = way[-1], 5 / 14 * g * times[-1]**2 * np.sin(slope)
	spin = ball.state.angVel[1] * R / ball.state.vel[0]
	print(f'sphere, slope 20 degrees: {found:.4f} m in {times[-1]:.2f} s, exact {exact:.4f} ({100 * (found / exact - 1):+.2f} %); rim over middle {spin:.3f}')
	compared('way of a sphere that rolls', found, exact, '5/14 g t^2 sin b', 'm')
	figure, ax = plt.subplots(figsize=(7, 4), layout='constrained')
	ax.plot(times, way, label='sphere')
	ax.plot(times, 5 / 14 * g * times**2 * np.sin(slope), 'k--', linewidth=0.8, label='5/14 g t^2 sin b')
	ax.set(xlabel='time [s]', ylabel='way [m]')
	ax.legend(frameon=False)
	return figure


for scene in options.scene.split():
	began = time.time()
	name = os.path.join(options.out, ('waves' if scene == 'bar' else scene) + '.png')
	dict(bar=bar, pulse=pulse, steps=steps, mass=mass, block=block, sphere=sphere)[scene]().savefig(name, dpi=110)
	print(f'written: {name}; {time.time() - began:.0f} s', flush=True)
