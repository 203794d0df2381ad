#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies deep in clay without weight (Tresca, c_u = 10 kPa, G = 200 c_u unless said otherwise, nu = 0.49, F-bar), by MpmContact.

	cone   of 60 degrees, around the axis, its shoulder one radius deep as it begins: resistance over c_u; Lu et al. (2004) 3.4 + 1.6 ln(G / c_u) + 1.3 rough
	pile   ten radii deep, around the axis, rough up to half of c_u: jacked down, let go, and jacked again. Its shaft bears half of c_u, its base 9 c_u (Skempton 1951), and what
	       is elastic goes by Randolph and Wroth (1978)
	tbar   a bar of diameter D in plane strain, six radii deep as it begins: resistance over D c_u; full flow has 9.14 (smooth) and 11.94 (rough; Randolph and Houlsby 1984)

All are wished in place. A uniform pressure on the surface, which the clay has as stress from the beginning, closes it above them; resistances are net of it. Cells are the smaller the nearer the
body is. Run it with `scripts/run examples/penetration/deep.py [options]`.
"""
import os
import sys
import time

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Rigid bodies deep in clay.',
        scene=('cone', "'cone', 'pile' or 'tbar'"),
        cells=(4, 'over the radius'),
        pointsPerCell=(3, 'material points per cell and axis'),
        depth=(0., 'way in radii; 0: 10 of the cone, 0.4 of the pile, 2 of the bar'),
        rough=(-1., 'adhesion over c_u; -1: 0.5 on the pile, none on cone and bar'),
        rigidity=(200., 'shear modulus over c_u'),
        halvings=(0, 'most halvings of the cells at edges (MpmGrid.adaptation)'),
        stiffness=(10., 'of the contact, over E / h'),
        stepsPerCell=(8, 'load steps while cone or bar move by a cell'),
        picture=(1, '1: draw one, and write files for ParaView, 0: only numbers'))
R, cu, nu = 1., 1e4, 0.49
G = options.rigidity * cu
h = R / options.cells
isCone, isPile, isBar = (options.scene == name for name in ('cone', 'pile', 'tbar'))
if not (isCone or isPile or isBar): sys.exit(f"deep.py: there is no scene '{options.scene}', but cone, pile and tbar")
depth = (options.depth or (10 if isCone else 0.4 if isPile else 2)) * R
rough = options.rough if options.rough >= 0 else 0.5 * isPile
pressure = (15 if isBar else 5) * cu
length = 10 * R  # length of the pile
began, solves = time.time(), []


def add(*bodies):
	"""Bodies that the script moves."""
	return [O.bodies[i] for i in O.bodies.append(list(bodies))]


def cone():
	"""Facets around the axis, each by its edge that lies in the plane: the face, and the shaft."""
	tip = R / np.tan(np.radians(30))
	line = [(0, -R - tip), (R, -R), (R, depth + 2 * R)]
	bodies = add(*(utils.facet([(*a, 0), (*b, 0), (*b, 3 * R)], material='rigid', fixed=True) for a, b in zip(line, line[1:])))
	return bodies, [(R, 0), (R, -R), (0, -R - tip)], -R - tip - depth, line + [(0, depth + 2 * R)]


def pile():
	bodies = add(utils.box((0, R - length / 2, 0), (R, R + length / 2, R), material='rigid', fixed=True))
	return bodies, [(R, 0), (R, -length), (0, -length)], -length - 2 * R, [(0, -length), (R, -length), (R, 2 * R), (0, 2 * R)]


def tbar():
	turns = np.linspace(0, np.pi, 16 * options.cells + 1)
	arc = [(R * np.sin(a), -6 * R + R * np.cos(a)) for a in turns[1:-1]]
	bodies = add(utils.sphere((0, -6 * R, 0), R, material='rigid', fixed=True))
	return bodies, [(0, 0), (0, -5 * R), *arc, (0, -7 * R)], -7 * R - depth, [(0, -5 * R), *arc, (0, -7 * R)]


def clay(line, low):
	"""To the right of a line from the surface to the axis. Cells of the size h are within three radii of the path down to y = *low*, or two where edges have smaller ones. Grid, boundaries and loads."""
	halvings = 2 if isBar else 3
	isHalved = options.halvings > 0 and not isBar
	near = (2 if isHalved else 3) * R
	size = h * 2**halvings
	width, deep = (np.ceil(x / size - 1e-9) * size for x in ((16 if isBar else 32) * R, -low + 17 * R))
	high = lambda k: -3.5 * R + 1.5 * k * R if isBar else inf
	boxes = [MpmRefinement(min=(-inf, low - near * 2**k, -inf), max=(near * 2**k, high(k), inf), halvings=halvings - k) for k in range(halvings)]
	if not isBar and not isHalved: boxes.append(MpmRefinement(min=(-inf, -h / 2, -inf), halvings=halvings))  # a pressure wants cells of one size along its surface
	adaptation = [MpmAdaptation(halvings=halvings + options.halvings)] if options.halvings else []
	grid = MpmGrid(cellSize=size, axisymmetric=not isBar, refinements=boxes, adaptation=adaptation)
	O.materials.append(MpmTrescaMat(young=2 * (1 + nu) * G, poisson=nu, density=1, undrainedStrength=cu, label='clay'))
	points = O.bodies.append(mpm.fill(mpm.polygon([(0, -deep), (width, -deep), (width, 0), *line]), grid, options.pointsPerCell, 'clay'))
	mpm.assign(stress=np.repeat(-pressure * np.eye(3)[None], len(points), axis=0))
	sides = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -deep, inf), fix='xy')]
	if isBar: sides.append(MpmBoundary(max=(0, inf, inf), fix='x'))
	if not isHalved: return grid, sides, [MpmTraction(surface=[(width, 0), line[0]], pressure=pressure)]
	return grid, sides, [MpmTraction(surface=[(near - h, 0), line[0]], pressure=pressure), MpmTraction(surface=[(width, 0), (near - h, 0)], traction=(0, -pressure, 0))]


def push(way, steps, until=lambda: False):
	"""Downwards; after each step way and forces on tip and shaft are written down. A step that fails ends the run."""
	for body in bodies:
		body.state.vel = (0, -way / steps, 0)
	for _ in range(steps):
		try: O.step()
		except RuntimeError as failure:
			print(failure)
			return False
		solves.append(solver.iterations)
		places, force = mpm.contactForces()
		s = start - bodies[0].state.pos[1]
		isShaft = places[:, 1] > outline[1][1] - s + h / 16
		found.append([s, -force[~isShaft | isBar, 1].sum(), -force[isShaft, 1].sum()])
		if until(): break
	return True


sources = {'Skempton': 'Skempton 1951', 'adhesion': 'what was set', 'Randolph and Wroth': 'Randolph and Wroth 1978', 'full flow': 'Randolph and Houlsby 1984', 'Lu et al.': 'Lu et al. 2004, finite elements'}


def compare(what, value, exact):
	print(f'{what} = {value:.3f}, {exact:.3f} ({100 * (value / exact - 1):+.1f} %)')
	which = (', rough' if rough == 1 else '') + (f', G = {options.rigidity:g} c_u' if options.rigidity != 200 else '') + (', cells halved at edges' if options.halvings else '')
	compared(f'{options.scene}{which}, {options.cells} cells over the radius: {what.rpartition(", ")[0]}', value, exact, sources[what.rpartition(', ')[2]])
	return value / exact - 1


def told(columns, rows):
	print(columns)
	for row in rows[np.unique(np.linspace(1, len(rows) - 1, 20).astype(int))]: print('  '.join(f'{x:7.3f}' for x in row))


def jack():
	"""Down, back until nothing bears it, and down again beyond. Error of the base, and curves over the way in radii."""
	steps = round(100 * depth / R)
	push(depth, steps) and push(-depth, 5 * steps, lambda: found[-1][1] + found[-1][2] < pressure * area) and push(depth / 2, steps)
	s, tip, shaft = np.array(found).T
	base, shaft = tip / (area * cu) - pressure / cu, shaft / (2 * np.pi * R * length * cu)
	load = base + 2 * length / R * shaft
	told('w / R    load    base    shaft, of the first two over c_u pi R^2', np.transpose([s / R, load, base, shaft]))
	error = compare('base over c_u, Skempton', base[steps], 9)
	compare('shaft over c_u, adhesion', shaft[steps], rough)
	half = steps + 1 + np.argmin(np.abs(load[steps + 1:] - load[steps] * 2 / 3)[:5 * steps])
	elastic = 4 / (1 - nu) + 2 * np.pi * length / R / np.log(2.5 * (1 - nu) * length / R)
	compare('let go by a third: load over G R w, Randolph and Wroth', (load[steps] - load[half]) * area * cu / (G * R * (s[steps] - s[half])), elastic)
	return error, s / R, dict(load=load, base=base), 9 + 2 * rough * length / R, 'adhesion of the shaft, and 9 $c_u$ of the base'


def penetrate():
	"""On and on. Error, and curve over the way in radii."""
	each = options.stepsPerCell
	push(depth, int(np.ceil(depth / h * each - 1e-9)))
	s, tip, _ = np.array(found).T / [[R], [area * cu], [1]]
	N = tip - (0 if isBar else pressure / cu)
	told('s / R    N', np.transpose([s, N]))
	exact = (11.94 if rough == 1 else 9.14) if isBar else 3.4 + 1.6 * np.log(G / cu) + 1.3 * rough
	late = s > (0.5 if isBar else 0.6) * s[-1]
	error = compare(f'from s = {s[late][0]:.2f} R to {s[-1]:.2f} R: mean N, {"full flow" if isBar else "Lu et al."}', N[late].mean(), exact)
	mean = np.convolve(N, np.ones(each + 1) / (each + 1), 'valid')
	middle = slice(each // 2, each // 2 + len(mean))
	off = np.abs(N[middle] / mean - 1)[s[middle] > 1]
	if len(off): print(f'beyond one radius single steps differ from the mean over a cell by {100 * off.mean():.1f} %, at most by {100 * off.max():.1f} %')
	return error, s, dict(resistance=N), exact, 'full flow' if isBar else 'Lu et al. (2004)'


def draw():
	"""The clay around the body, and the curves."""
	figure, (picture, curve) = plt.subplots(1, 2, figsize=(10, 6), layout='constrained')
	mpm.plot('plasticStrain', ax=picture, loads=False, range=(0, 0.5 if isPile else 2))
	picture.fill(*np.transpose(outline - np.array([0, found[-1][0]])), facecolor='0.8', edgecolor='0.3', zorder=3)
	if picture.get_legend():  # of strongly stretched points: below the body, where the clay is at rest
		handles, names = picture.get_legend_handles_labels()
		names = [name.replace('dots: ', '').replace(' strongly', '\nstrongly').replace(', more', ',\nmore') for name in names]
		picture.legend(handles, names, loc='lower right', fontsize='small', frameon=False, handletextpad=0.1, borderaxespad=0.1)
	picture.set(title=' ', xlim=(0, 5 * R), ylim=(low - 2 * R, max(y for _, y in line) + (-3.5 if isBar else 0.5) * R))
	for name, values in curves.items(): curve.plot(values, s, label=name)
	curve.axvline(exact, color='k', linewidth=0.8, label=source)
	curve.set(xlabel='resistance over $c_u$' + (' D' if isBar else r' $\pi R^2$'), ylabel='way / R', ylim=(1.02 * s.max(), 0))
	curve.legend(frameon=False, loc='lower left', bbox_to_anchor=(0, 1))
	figure.savefig(os.path.join(options.out, options.scene + '.png'), dpi=110)
	film.finish()
	print(f'written: {options.out}/{options.scene}.png, a film with the cells {options.out}/{options.scene}.gif, and for ParaView {options.out}/{options.scene}-points.pvd')


O.materials.append(FrictMat(label='rigid'))
bodies, line, low, outline = dict(cone=cone, pile=pile, tbar=tbar)[options.scene]()
grid, sides, loads = clay(line, low)
contact = MpmContact(stiffness=options.stiffness, friction=np.arctan(5) if rough else 0, adhesion=rough * cu if rough else inf)
O.engines = [MpmImplicitEngine(grid=grid, fBar=True, pressureRelaxation=isBar, boundaries=sides, loads=loads, loadCurve=[(0, 1)], contacts=[contact], newton=MpmNewton(minStep=1 / 64), label='solver')]
if options.picture:
	O.engines += [MpmVtkRecorder(fileName=os.path.join(options.out, options.scene + '-'), recorders=['points', 'loads'], iterPeriod=20)]
	film = mpm.movie(os.path.join(options.out, options.scene + '.gif'), 'plasticStrain', every=20, limits=((0, 5 * R), (low - R, 0)), size=(8, 7), grid=True, loads=False, range=(0, 2))
O.dt = 1
area = R if isBar else np.pi * R**2
start, found = bodies[0].state.pos[1], []
push(0, 1)
error, s, curves, exact, source = jack() if isPile else penetrate()
print(f'{len(O.bodies) - len(bodies)} material points, {sum(solves)} iterations in {len(solves)} steps, {time.time() - began:.0f} s')
if options.picture: draw()
