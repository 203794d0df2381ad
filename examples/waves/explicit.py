#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Explicit steps of MpmDynamicEngine beside implicit ones.

	bar      first period of a bar over 4 L / c, and what is left of its energy after a thousand steps and more
	impact   two blocks that meet through the grid, and a block that bounces off a Box: how exact momentum is, and how far energy rises above that of the beginning
	trade    a pulse in a plate runs to the free end and half way back: error of the velocities against seconds of the processor, explicit and implicit
	conditions  a soft column settles under its weight with F-bar, axisymmetric, under a load and on a wall off the grid: against Newmark's rule with short steps
	inertia  a block that is shaken a little, one solve a step: time of a processor with inertia over that without
	cost     70,000 points in the plane, an elastic block that falls: nanoseconds of one processor for a point and step, and the parts of the step as the clock saw them

Run it with `scripts/run examples/waves/explicit.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path[:0] = [os.path.join(os.path.dirname(sys.argv[0]), '..', *folder) for folder in ((), ('..', 'scripts', 'lib'))]
from options import compared, readOptions
from style import plt
from results import Results

options = readOptions('Explicit and implicit steps.', scene=('trade', "'bar', 'impact', 'trade', 'conditions', 'inertia' or 'cost'"), short=(0, '1: fewer and smaller cases, for a quick look'))

E, density = 1e6, 1000.
c = np.sqrt(E / density)
kinds = {
        'explicit, consistent': dict(scheme='explicit'),
        'explicit, lumped': dict(scheme='explicit', ghost=MpmGhost(factor=0)),
        'Newmark': dict(scheme='newmark'),
        'generalised-alpha 0.8': dict(scheme='generalised-alpha', rhoInfinity=0.8),
}


def make(blocks, kind, poisson=0., h=1., period=(0, 0, 0), **settings):
	"""Elastic blocks ((lower, upper), ...) [cells], and the engine."""
	O.reset()
	O.materials.append(MpmElasticMat(young=E, poisson=poisson, density=density, label='block'))
	grid = MpmGrid(cellSize=h, period=tuple(h * p for p in period))
	for lower, upper in blocks:
		O.bodies.append(mpm.fill(pack.inAlignedBox((*(h * np.array(lower)), 0), (*(h * np.array(upper)), 1)), grid, 2, 'block'))
	O.engines = [MpmDynamicEngine(grid=grid, newton=MpmNewton(tolerance=1e-9), verbosity=0, **kinds[kind], **settings)]
	return O.engines[0]


def energy(solver):
	data = solver.plotData()
	return data['kineticEnergy'] + data['elasticEnergy']


def makeBar(kind, cells):
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(min=(-inf, 1 / cells, -inf), fix='y')]
	solver = make([((0, 0), (cells, 1))], kind, h=1 / cells, boundaries=sides)
	mode = np.sin(np.pi / 2 * mpm.arrays()['pos'][:, 0])
	mpm.assign(velocity=np.outer(1e-6 * c * mode, (1, 0, 0)))
	return solver, mode


def period(kind, cells, courant):
	"""Relative error of the period, from the time at which the velocity has come back through zero."""
	solver, mode = makeBar(kind, cells)
	O.dt = courant / cells / c
	v = [1.]
	while len(v) < 3 or not v[-2] < 0 <= v[-1]:
		O.step()
		v.append(mpm.arrays()['velocity'][:, 0] @ mode / (mode @ mode) / (1e-6 * c))
	O.step()
	v.append(mpm.arrays()['velocity'][:, 0] @ mode / (mode @ mode) / (1e-6 * c))
	cubic = np.polynomial.Polynomial.fit((-1, 0, 1, 2), v[-4:], 3)
	root = [r.real for r in cubic.roots() if abs(r.imag) < 1e-9 and 0 <= r.real <= 1][0]
	return (len(v) - 3 + root) * O.dt / 0.75 / (4 / c) - 1


def bar():
	print('first period over 4 L / c - 1, 20 cells; steps over h / c')
	steps = (0.05, 0.2, 0.4)
	for kind in 'explicit, consistent', 'explicit, lumped':
		found = [period(kind, 20, courant) for courant in steps]
		order = np.log2((found[2] - found[0]) / (found[1] - found[0]) / (0.1575 / 0.0375) * 4)
		print(f'{kind}: ' + '  '.join(f'{courant:g}: {error:+.2e}' for courant, error in zip(steps, found)) + f'; order in time {order:.2f}')
		compared(f'first period of a bar, {kind}, dt c / h = {steps[-1]:g}', 1 + found[-1], 1, 'closed form', '4 L / c')
	inSpace = [period('explicit, consistent', cells, 0.1) for cells in (5, 10, 20)]
	print('5, 10, 20 cells, steps of h / c / 10: ' + '  '.join(f'{error:+.2e}' for error in inSpace) + f'; order in space {np.log2(inSpace[1] / inSpace[2]):.2f}')
	figure, ax = plt.subplots(figsize=(7, 4), layout='constrained')
	for kind in 'explicit, consistent', 'explicit, lumped':
		solver, _ = makeBar(kind, 20)
		O.dt = 0.9 * solver.criticalTimeStep()
		first, courses = energy(solver), []
		for _ in range(300 if options.short else 3000):
			O.step()
			courses.append(energy(solver) / first)
		print(f'{kind}: energy after {len(courses)} steps of 0.9 of the critical one {courses[-1]:.5f}, most {max(courses):.5f}, least {min(courses):.5f}')
		ax.plot(courses, linewidth=0.7, label=kind)
	ax.set(xlabel='steps', ylabel='energy over that of the beginning')
	ax.legend(frameon=False)
	return figure


def meet(kind, courant):
	solver = make([((0.3, 0), (8.3, 4)), ((10.1, 0.4), (16.1, 4.4))], kind)
	mpm.assign(velocity=[((0.01 if x < 9 else -0.01) * c, 0, 0) for x in mpm.arrays()['pos'][:, 0]])
	return follow(solver, courant / c, 180 / c, None)


def bounce(kind, courant):
	solver = make([((0, 0), (2, 16))], kind, contacts=[MpmContact(friction=0, stiffness=20)])
	O.materials.append(FrictMat(young=1e9, frictionAngle=0, label='steel'))
	O.bodies.append(utils.box((1, -1, 0), (4, 1, 1), fixed=True, material='steel'))
	mpm.assign(velocity=[(0, -0.002 * c, 0)] * len(mpm.arrays()['id']))
	return follow(solver, courant / c, 48 / c, solver.contacts[0])


def follow(solver, dt, end, contact):
	"""Error of momentum, which impulses of a contact change, and the highest energy, over those of the beginning."""
	before, first, most, impulse = solver.plotData(), energy(solver), 0, 0
	size = np.sqrt(2 * before['kineticEnergy'] * sum(b.state.mass for b in O.bodies if isinstance(b.shape, MpmPoint)))
	O.dt = dt
	while O.time < end:
		O.step()
		most = max(most, energy(solver))
		if contact: impulse += np.array(contact.forces[0])[1] * O.dt
	now = solver.plotData()
	return abs(now['momentum_x'] - before['momentum_x']) / size, abs(now['momentum_y'] - before['momentum_y'] + impulse) / size, most / first - 1, energy(solver) / first


def impact():
	print('steps over h / c; error of momentum along x, along y; highest energy above that of the beginning; energy at the end')
	found = {}
	for scene in meet, bounce:
		for kind in kinds:
			steps = ((0.4, 0.2, 0.1) if scene == meet else (0.1, 0.05, 0.025)) if 'explicit' in kind else (1, 0.5, 0.25)
			for courant in steps[:1 if options.short else None]:
				x, y, excess, left = scene(kind, courant)
				found.setdefault((scene.__name__, kind), []).append((courant, max(excess, 1e-9)))
				print(f'{scene.__name__}, {kind}, {courant:g}: {x:.1e}  {y:.1e}  {excess:+.1e}  {left:.4f}', flush=True)
	figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True, layout='constrained')
	for (scene, kind), rows in found.items():
		isWide = kind == 'Newmark'  # remains visible below the line of generalised alpha
		axes[int(scene == 'bounce')].loglog(*np.array(rows).T, 'o-', label=kind, linewidth=5 if isWide else 1.5, markersize=12 if isWide else 6)
	for ax, title in zip(axes, ('two blocks', 'off a Box')): ax.set(xlabel='time step dt c / h [-]', title=title + ' (1e-9: no rise)')
	axes[0].set_ylabel('energy above the first one [-]')
	axes[0].legend(frameon=False)
	return figure


def pulse(kind, courant, cells):
	"""Seconds, and error of the velocities, of a pulse four cells wide after it has run to the end and half way back."""
	width, across = 4., cells // 4
	solver = make([((0, 0), (cells, across))], kind, period=(0, across, 0))
	x = mpm.arrays()['pos'][:, 0]
	shape = lambda s: np.exp(-(s / width)**2)
	start, speed = cells / 2, 1e-5 * c
	stress = np.zeros((len(x), 3, 3))
	stress[:, 0, 0] = -density * c * speed * shape(x - start)
	mpm.assign(velocity=np.outer(speed * shape(x - start), (1, 0, 0)), stress=stress)
	steps = int(np.ceil(cells / courant))
	O.dt = cells / c / steps
	O.step()
	began = time.process_time()
	O.run(steps - 1, wait=True)
	seconds = (time.process_time() - began) * steps / (steps - 1)
	exact = shape(x - start)  # reflected at the end, at the middle again
	return seconds, np.linalg.norm(mpm.arrays()['velocity'][:, 0] / speed - exact) / np.linalg.norm(exact), len(x)


def trade():
	cells = 24 if options.short else 96
	figure, ax = plt.subplots(figsize=(7, 4.5), layout='constrained')
	kept = Results(options.out, 'trade', ['scheme', 'courant'], ['seconds', 'error'])
	for kind in kinds:
		rows = []
		limit = 0.5 if 'lumped' in kind else 0.4
		for courant in (limit, limit / 2, limit / 4) if 'explicit' in kind else (32, 16, 8, 4, 2, 1, 0.5, 0.25):
			if options.short and not 0.3 < courant < 16: continue  # a step more than one, and not many
			seconds, error, points = pulse(kind, courant, cells)
			rows.append((seconds, error))
			kept.add([dict(scheme=kind, courant=courant, seconds=f'{seconds:.4g}', error=f'{error:.4g}')])
			print(f'{kind}, dt = {courant:g} h / c: {seconds:.2f} s, error {error:.4f}, {1e9 * seconds / points / np.ceil(cells / courant):.0f} ns a point and step', flush=True)
		ax.loglog(*np.array(rows).T, 'o-', label=kind)
	ax.set(xlabel='processor time [s]', ylabel='error of the velocities [-]', title=f'pulse in a plate of {points} points')
	ax.set_yticks([0.2, 0.5, 1], ['0.2', '0.5', '1'])
	ax.minorticks_off()
	ax.legend(frameon=False)
	return figure


def settle(condition, kind, steps=0):
	"""Displacements (N, 3) after 0.4 s, energy that is not accounted for over the work, and steps."""
	O.reset()
	axisymmetric = condition == 'axisymmetric'
	O.materials.append(MpmElasticMat(young=E, poisson=0.45 if condition == 'F-bar' else 0.3, density=2 * density, label='soil'))
	grid, points = (MpmGrid(cellSize=0.5, origin=(0, y, 0), axisymmetric=axisymmetric) for y in (0, 0.1))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0.1, 0), (2, 4.1, 1)), points, 2, 'soil'))
	base = MpmBoundary(surface=[(4, 0.1), (-1, 0.1)], fix='n', penalty=20) if condition == 'wall' else MpmBoundary(max=(inf, 0.1, inf), fix='y')
	loads = [MpmTraction(surface=[(2, 4.1), (0, 4.1)], pressure=2e4)] if condition == 'load' else []
	O.engines = [MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), base], loads=loads, fBar=condition == 'F-bar',
	                              newton=MpmNewton(tolerance=1e-9), verbosity=0, **kinds[kind])]
	steps = steps or int(np.ceil(0.4 / (0.75 * O.engines[0].criticalTimeStep())))  # compressed soil becomes stiffer
	O.dt = 0.4 / steps
	O.run(steps, wait=True)
	points, data = mpm.arrays(), O.engines[0].plotData()
	return points['pos'] - points['pos0'], data['energyImbalance'] / data['loadWork'], steps


def conditions():
	figure, ax = plt.subplots(figsize=(7, 4), layout='constrained')
	for column, condition in enumerate(('plain', 'F-bar', 'axisymmetric', 'load', 'wall')):
		exact = settle(condition, 'Newmark', 50 if options.short else 400)[0]
		for side, kind in enumerate(list(kinds)[:2]):
			if side == 1 and condition in ('F-bar', 'wall'): continue  # they ask for ghost stabilisation
			found, imbalance, steps = settle(condition, kind)
			error = np.abs(found - exact).max() / np.abs(exact).max()
			print(f'{condition}, {kind}: {steps} steps, {100 * error:.2f} % of the largest displacement off; energy not accounted for {imbalance:+.1e} of the work', flush=True)
			ax.bar(column + 0.3 * side, 100 * error, 0.3, color=f'C{side}', label=kind if column == 0 else None)
	ax.set(xticks=range(5), xticklabels=('plain', 'F-bar', 'axisymmetric', 'load', 'wall'), ylabel='difference / largest displacement [%]')
	ax.legend(frameon=False)
	return figure


def cost():
	side, steps = (33, 5) if options.short else (132, 8)
	figure, ax = plt.subplots(figsize=(7, 4), layout='constrained')
	for row, kind in enumerate(list(kinds)[:3]):
		solver = make([((0.3, 0.3), (side + 0.3, side + 0.3))], kind, poisson=0.3, gravity=(0, -10, 0))
		solver.ompThreads = 1
		speed = mpm.arrays()['pos'][:, :2] - side / 2
		mpm.assign(velocity=np.c_[1e-3 * speed, np.zeros(len(speed))])
		O.dt = 0.4 / c / 1.2
		O.step()
		parts, began = {}, time.process_time()
		made = steps if 'explicit' in kind else 2
		for _ in range(made):
			O.step()
			for name, seconds in solver.report()['times'].items(): parts[name] = parts.get(name, 0) + seconds
		whole, unit = time.process_time() - began, 1e9 / made / len(speed)
		print(f'{kind}, {len(speed)} points: {whole * unit:.0f} ns a point and step; ' + ', '.join(f'{name} {seconds * unit:.0f}' for name, seconds in parts.items() if seconds * unit > 0.5)
		      + f'; conjugate gradients {solver.cgIterations}', flush=True)
		left = 0
		for number, (name, seconds) in enumerate(parts.items()):
			ax.barh(row, seconds * unit, left=left, color=f'C{number}', label=name if row == 0 else None)
			left += seconds * unit
	ax.set(xlabel='time of a step, by point [ns]', yticks=range(3), yticklabels=list(kinds)[:3])
	ax.legend(frameon=False)
	return figure


def step(engine, dim, cells):
	"""The shortest of some steps with one solve each [s], and their number of points. The block lies off the lines of the grid, so that no point crosses one."""
	O.reset()
	O.materials.append(MpmElasticMat(young=E, poisson=0.3, density=density, label='block'))
	grid = MpmGrid(cellSize=1, dim=dim)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -1, 0), (cells, cells, cells if dim == 3 else 1)), grid, 2, 'block'))
	for b in O.bodies:
		b.state.pos += Vector3(0.13, 0.13, 0.13 * (dim == 3))
	O.engines = [engine(grid=grid, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz'[:dim])], gravity=(0, -1e-3, 0), newton=MpmNewton(linearSolver='direct', reuseFactor=False), ompThreads=1, verbosity=0)]
	O.dt = 0.02 if engine is MpmImplicitEngine else 1 / c
	O.step()
	shortest = inf
	for _ in range(4 if options.short else 12):
		began = time.process_time()
		O.step()
		shortest = min(shortest, time.process_time() - began)
		assert O.engines[0].report()['iterations'] == 1
	return shortest, len(O.bodies)


def inertia():
	figure, ax = plt.subplots(figsize=(7, 3), layout='constrained')
	cases = ((2, 30), (3, 6)) if options.short else ((2, 50), (2, 100), (2, 150), (3, 8), (3, 12), (3, 16))
	for row, (dim, cells) in enumerate(cases):
		(still, points), (moving, _) = step(MpmImplicitEngine, dim, cells), step(MpmDynamicEngine, dim, cells)
		print(f'{dim}D, {points} points: {1e3 * still:.0f} ms without inertia, {1e3 * moving:.0f} ms with it, {100 * (moving / still - 1):+.0f} %', flush=True)
		ax.barh([row], [1e6 * moving / points], color='C1', label='with inertia' if row == 0 else None)
		ax.barh([row], [1e6 * still / points], color='C0', label='without' if row == 0 else None)
	ax.set(xlabel='time of a step with one solve, by point [µs]', yticks=range(len(cases)), yticklabels=[f'{dim}D, {cells} cells' for dim, cells in cases])
	ax.legend(frameon=False)
	return figure


name = os.path.join(options.out, f'explicit-{options.scene}.png')
dict(bar=bar, impact=impact, trade=trade, conditions=conditions, inertia=inertia, cost=cost)[options.scene]().savefig(name, dpi=110)
print(f'written: {name}')
