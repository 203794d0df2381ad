#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of YADE pressed into soil through MpmContact, which moves them by their velocities.

	plate      a Box on a block of four cells a side without Poisson's ratio, pressed to 0.75 of its height: E ln 0.75 / 0.75
	footing    a Box on undrained clay in plane strain, half by symmetry: load over width and c_u, Prandtl 2 + pi as long as it is shallow
	accurate   the footing with cells halved at its edge until its estimated error is --accuracy
	sphere     a smooth Sphere on an elastic half-space, axisymmetric, in a box 15 contact radii wide and deep: force of Hertz
	free       the same in 3D, a quarter of it, and free: YADE lets the Sphere sink under its weight, which is the force of Hertz, until it rests
	cylinder   the Sphere in plane strain, where a Sphere is a cylinder: half width and pressure of the contact for the measured force

Run it with `scripts/run examples/penetration/penetration.py [options]`, or by yade-batch with penetration.table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('Rigid bodies pressed into soil.',
        scene=('footing', "'plate', 'footing', 'accurate', 'sphere', 'free' or 'cylinder'"),
        cells=(8, 'cells over half the width of the footing, or over the radius of the contact'),
        pointsPerCell=(2, 'material points per cell and axis'),
        depth=(0.1, 'of the footing at the end, as a part of its width B'),
        steps=(0, 'load steps; 0: 200 for a width, 10 for sphere and cylinder, 80 equilibria for the free sphere'),
        stiffness=(100., 'of the contact, over E / h'),
        every=(4, 'iterations of YADE from one equilibrium of the soil to the next, for the free Sphere'),
        halvings=(0, 'of the cells at the edge of the footing'),
        accuracy=(0.05, "estimated error at which 'accurate' ends"),
        rough=(0, '1: clay sticks to the footing up to c_u, 0: it slips freely'),
        picture=(1, '1: draw one, 0: only numbers'))
began = time.time()
solves = []


def run(steps, look):
	"""Steps of 1 / steps each; look() after each."""
	O.dt = 1 / steps
	for step in range(steps):
		try: O.step()
		except RuntimeError as failure:
			print(f'step {step + 1} of {steps} fails: {failure}')
			break
		solves.append(solver.iterations)
		look()


def plate():
	E, size = 1e6, 1.
	grid = MpmGrid(cellSize=size / 4)
	O.materials.append(MpmElasticMat(young=E, poisson=0, density=1, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (size, size, 1)), grid, options.pointsPerCell, 'soil'))
	box = O.bodies[O.bodies.append(utils.box((size / 2, 1.5 * size, 0), (2 * size, size / 2, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -0.25 * size, 0)
	contact = MpmContact(friction=0, stiffness=options.stiffness)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact], label='solver')]
	run(options.steps or 25, lambda: None)
	F, exact = contact.forces[0][1], -E * np.log(0.75) / 0.75 * size
	print(f'F = {F:.1f} N/m, exact {exact:.1f} N/m ({100 * (F / exact - 1):+.2f} %)')
	compared('force of a plate', F, exact, 'closed form, large strains', 'N/m')
	return F / exact - 1, 'stress_yy', lambda ax: None


def footing():
	O.reset()
	B, cu = 1., 1e4
	h = B / 2 / options.cells
	width, deep = 3 * B, 2.5 * B
	grid = MpmGrid(cellSize=h, adaptation=[MpmAdaptation(halvings=options.halvings)] if options.halvings else [])
	O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.49, density=1800, yieldStress=np.sqrt(2) * cu, label='clay'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -deep, -1), (width, 0, 1)), grid, options.pointsPerCell, 'clay'))
	box = O.bodies[O.bodies.append(utils.box((0, 2 * B, 0), (B / 2, 2 * B, 1), material='rigid', fixed=True))]
	box.state.vel = (0, -options.depth * B, 0)
	contact = MpmContact(friction=np.arctan(5) if options.rough else 0, adhesion=cu if options.rough else np.inf, stiffness=options.stiffness)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -deep, inf), fix='xy')]
	O.engines = [MpmImplicitEngine(grid=grid, fBar=True, boundaries=sides, contacts=[contact], newton=MpmNewton(minStep=1 / 64), label='solver')]
	found = []
	run(options.steps or int(np.ceil(200 * options.depth)), lambda: found.append([2 * B - box.state.pos[1], 2 * contact.forces[0][1] / (B * cu)]))
	s, N = np.array(found).T
	print('s/B    N = F / (B c_u)')
	for i in np.linspace(0, len(s) - 1, min(len(s), 10)).astype(int): print(f'{s[i] / B:.3f}  {N[i]:.3f}')
	inCell = int(round(h / (s[-1] - s[0]) * (len(s) - 1))) if len(s) > 1 else 0  # steps while the Box sinks by a cell
	if len(s) > 2 * inCell + 20:
		mean = np.convolve(N, np.ones(inCell) / inCell, 'same')
		off = np.abs(N / mean - 1)[inCell // 2:-(inCell // 2)][s[inCell // 2:-(inCell // 2)] > 0.1 * B]
		print(f'beyond 0.1 B: from its moving mean over a cell N differs by {100 * off.mean():.1f} % on average, in {100 * (off > 0.02).mean():.0f} % of the steps by more than 2 %, at most by {100 * off.max():.0f} %')
	shallow = np.interp(0.02 * B, s, N)
	print(f'at s = 0.02 B: N = {shallow:.3f}, Prandtl {2 + np.pi:.3f} ({100 * (shallow / (2 + np.pi) - 1):+.1f} %)')
	compared(f'footing by contact, N_c at .02 B, {2 * options.cells} cells over the width', shallow, 2 + np.pi, 'Prandtl 1921')
	return shallow / (2 + np.pi) - 1, 'plasticStrain', lambda ax: ax.set(xlim=(0, 1.5 * B), ylim=(-1.2 * B, 0.6 * B))


def accurate():
	def bearing(halvings):
		options.halvings = halvings
		drawn[:] = footing()
		return dict(N=(1 + drawn[0]) * (2 + np.pi))

	drawn = []
	found = mpm.untilAccurate(bearing, options.accuracy)
	print(f'estimated {100 * found["error"] / found["N"]:.1f} %')
	return drawn


E, nu, R = 1e6, 0.3, 1.  # constants of the half-space, and radius of the Sphere
stiffness = E / (1 - nu**2)
a = 0.1 * R


def sinking(F, size):
	"""Displacement of a half-space at the depth *size* below a force (Boussinesq): the base of the box does not move."""
	return F * (1 + nu) * (3 - 2 * nu) / (2 * np.pi * E * size)


def free():
	h = a / options.cells
	size = 6 * a
	grid = MpmGrid(cellSize=h, dim=3)
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -size), (size, size, 0)), grid, options.pointsPerCell, 'soil'))
	ball = O.bodies[O.bodies.append(utils.sphere((0, 0, R), R, material='rigid'))]
	weight = 4 / 3 * stiffness * a**3 / R
	ball.state.mass, ball.state.blockedDOFs = weight / 10 / 4, 'xyXYZ'  # a quarter of it, as there is of the soil
	contact = MpmContact(friction=0, stiffness=options.stiffness)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), MpmBoundary(max=(inf, inf, -size), fix='z')]
	sides += [MpmBoundary(min=(size, -inf, -inf), fix='x'), MpmBoundary(min=(-inf, size, -inf), fix='y')]
	soil = MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact], iterPeriod=options.every, verbosity=0, label='solver')
	O.engines = [ForceResetter(), soil, NewtonIntegrator(gravity=(0, 0, -10), damping=0.5)]
	O.dt = 0.04 * a / np.sqrt(15 * R)  # part of the period over 2 pi
	print('time [s]  sunk [m]  force over weight')
	for _ in range(options.steps or 80):
		O.run(options.every, wait=True)
		solves.append(solver.iterations)
		F = 4 * contact.forces[0][2]
		sunk = R - ball.state.pos[2]
		if len(solves) % 5 == 0: print(f'{O.time:.3f}  {sunk:.6f}  {F / weight:.4f}')
	hertz = (3 * F / (4 * stiffness * np.sqrt(R)))**(2 / 3) - sinking(F, size)
	print(f'force over weight {F / weight:.4f}, sunk by {sunk:.5f} m; Hertz for that force, less what a half-space gives way at the base, {hertz:.5f} m ({100 * (sunk / hertz - 1):+.1f} %)')
	compared(f'way of a free sphere, {options.cells} cells over the contact', 1e3 * sunk, 1e3 * hertz, 'Hertz 1882', 'mm')
	return sunk / hertz - 1, 'stress_zz', lambda ax: ax.set(xlim=(0, 3 * a), ylim=(-3 * a, 1.5 * a)), ('y', h / 4)


def halfSpace(axisymmetric):
	h = a / options.cells
	size = np.ceil(15 * a / h) * h
	grid = MpmGrid(cellSize=h, axisymmetric=axisymmetric)
	O.materials.append(MpmElasticMat(young=E, poisson=nu, density=1, label='soil'))
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, -size, -1), (size, 0, 1)), grid, options.pointsPerCell, 'soil'))
	ball = O.bodies[O.bodies.append(utils.sphere((0, R, 0), R, material='rigid', fixed=True))]
	ball.state.vel = (0, -(1 if axisymmetric else 1.7) * a**2 / R, 0)
	contact = MpmContact(friction=0, stiffness=options.stiffness)
	sides = [MpmBoundary(min=(size, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -size, inf), fix='y')]
	if not axisymmetric: sides.append(MpmBoundary(max=(0, inf, inf), fix='x'))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides, contacts=[contact], label='solver')]
	run(options.steps or 10, lambda: None)
	F = contact.forces[0][1] * (1 if axisymmetric else 2)
	if axisymmetric:
		sunk = R - ball.state.pos[1]
		base = sinking(F, size)
		hertz = 4 / 3 * stiffness * np.sqrt(R) * (sunk + base)**1.5
		error = F / hertz - 1
		print(f'sunk by {sunk:.5f} m, and by {base:.5f} m more on a half-space: F = {F:.1f} N, Hertz {hertz:.1f} N ({100 * error:+.1f} %)')
		compared(f'force on a sphere, {options.cells} cells over the contact', F, hertz, 'Hertz 1882', 'N')
	else: error = compareLine(F, R, stiffness, h)
	return error, 'stress_yy', lambda ax: ax.set(xlim=(0, 3 * a), ylim=(-3 * a, 1.5 * a))


def compareLine(F, R, stiffness, h):
	half = np.sqrt(4 * F * R / (np.pi * stiffness))
	largest = 2 * F / (np.pi * half)
	pos, force = mpm.contactForces()
	pos, force = (values[np.argsort(pos[:, 0])] for values in (pos, force))
	x, down = pos[:, 0], -force[:, 1]
	between = np.concatenate([[0], (x[1:] + x[:-1]) / 2, x[-1:] + h / 8])  # places on the body are as wide
	pressure = np.diff(np.interp(np.arange(0, x[-1] + h, h), between, np.concatenate([[0], np.cumsum(down)]))) / h
	width = np.sqrt(4 * (2 * down * x**2).sum() / F)  # width of the half ellipse with the same second moment
	print(f'F = {F:.0f} N/m: half width {width / h:.2f} h, Hertz {half / h:.2f} h ({100 * (width / half - 1):+.1f} %)')
	compared(f'half width of the contact of a cylinder, {options.cells} cells', width / h, half / h, 'Hertz 1882', 'h')
	print(f'largest mean pressure in a cell {pressure.max():.0f} Pa, Hertz {largest:.0f} Pa ({100 * (pressure.max() / largest - 1):+.1f} %)')
	compared(f'largest pressure below a cylinder, {options.cells} cells', pressure.max(), largest, 'Hertz 1882', 'Pa')
	return width / half - 1


error, *drawn = dict(plate=plate, footing=footing, accurate=accurate, sphere=lambda: halfSpace(True), free=free, cylinder=lambda: halfSpace(False))[options.scene]()
print(f'{len(mpm.arrays()["id"])} material points, {sum(solves)} iterations in {len(solves)} steps, {time.time() - began:.1f} s')
if options.picture:
	field, limit, *plane = drawn
	ax = mpm.plot(field, plane=plane[0] if plane else None)
	limit(ax)
	name = 'penetration' if options.scene == 'footing' else options.scene
	ax.figure.savefig(os.path.join(options.out, name + '.png'), dpi=110, bbox_inches='tight')
	print(f'written: {options.out}/{name}.png')
