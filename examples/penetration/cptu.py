#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A cone with a pore pressure filter (CPTu) in normally consolidated clay (modified Cam clay), from undrained to drained.

A smooth cone of 60 degrees and 35.7 mm of diameter D, wished in place, moves at a velocity v through clay without weight under an isotropic effective stress of 100 kPa. V = v D / c_v is the normalised
velocity, c_v = k (1 + e) p' / (gamma_w lambda) the coefficient of consolidation of the initial state; lambda is the slope of v over ln p'. Resistance q and excess pore pressure u behind the
shoulder are means over the last part of the way. Two runs give the ends: without flow (undrained), and without water (drained). Only the far side drains.

Run it with `scripts/run examples/penetration/cptu.py [options]`; runs that are in its folder are not made again.
"""
import os
import sys
import time

import numpy as np
from yade import mpm, utils
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A cone with pore pressures, by its velocity.',
        velocities=('1000 100 30 10 3 1 0.3 0.1 0.03 0.01', 'normalised, v D / c_v, between blanks'),
        ends=('undrained drained', 'runs without flow, and without water'),
        cells=(3, 'over the radius'),
        halvings=(1, 'most halvings of the cells at edges (MpmGrid.adaptation)'),
        pointsPerCell=(2, 'material points per cell and axis'),
        ghost=(0.01, 'factor of the stabilisation (MpmGhost)'),
        travel=(8., 'way in radii'),
        stepsPerCell=(8, 'load steps while the cone moves by a cell'))
R, p0, e0, k = 0.01785, 1e5, 1.2, 1e-9  # radius [m], effective stress [Pa], void ratio [-], conductivity [m/s]
soil = dict(density=1700, shearModulus=2.5e6, criticalStateRatio=0.9, compressionIndex=0.09, swellingIndex=0.02, preconsolidation=p0, referencePressure=1e3)
cv = k * p0 / (9810 * soil['compressionIndex'])  # compressionIndex is lambda / (1 + e)
cu = soil['criticalStateRatio'] / 2 * p0 * 0.5**(1 - soil['swellingIndex'] / soil['compressionIndex'])
h, tip, shoulder = R / options.cells, R / np.tan(np.radians(30)), -R
way = options.travel * R


def scene(kind, velocity):
	"""Clay to the right of the cone, with cells of the size h within three radii of the path. Solver, and the facets of the cone."""
	O.reset()
	water = dict(undrained=dict(undrained=True, waterModulus=1e9), drained={}).get(kind, dict(conductivity=k, porosity=e0 / (1 + e0)))
	O.materials.append([MpmCamClayMat(label='clay', **soil, **water), FrictMat(label='steel')])
	line = [(0, shoulder - tip), (R, shoulder), (R, way + 2 * R)]
	cone = [O.bodies[O.bodies.append(utils.facet([(*a, 0), (*b, 0), (*b, 3 * R)], material='steel', fixed=True))] for a, b in zip(line, line[1:])]
	size, low = 8 * h, line[0][1] - way
	width, depth = (np.ceil(x / size - 1e-9) * size for x in (32 * R, 17 * R - low))
	boxes = [MpmRefinement(min=(-inf, low - 3 * R * 2**i, -inf), max=(3 * R * 2**i, inf, inf), halvings=3 - i) for i in range(3)]
	boxes.append(MpmRefinement(min=(-inf, -h / 2, -inf), halvings=3))  # a pressure wants cells of one size along its surface
	grid = MpmGrid(cellSize=size, axisymmetric=True, refinements=boxes, adaptation=[MpmAdaptation(halvings=3 + options.halvings)] if options.halvings else [])
	points = O.bodies.append(mpm.fill(mpm.polygon([(0, -depth), (width, -depth), (width, 0), (R, 0), (R, shoulder), line[0]]), grid, options.pointsPerCell, 'clay'))
	mpm.assign(stress=np.repeat(-p0 * np.eye(3)[None], len(points), axis=0))
	sides = [MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, -depth, inf), fix='xy')]
	flow = MpmFlow(drains=[MpmDrain(surface=[(width, -depth), (width, 0)])]) if kind == 'flow' else None
	solver = MpmImplicitEngine(grid=grid, fBar=kind == 'undrained', boundaries=sides, loads=[MpmTraction(surface=[(width, 0), (R, 0)], pressure=p0)], loadCurve=[(0, 1)], flow=flow, contacts=[MpmContact(friction=0, stiffness=10)], ghost=MpmGhost(factor=options.ghost), newton=MpmNewton(minStep=1 / 64), verbosity=0)
	O.engines, O.dt = [solver], h / options.stepsPerCell / velocity
	return solver, cone


def behindShoulder(points, y):
	"""Mean excess pressure beside the shaft up to one radius above the shoulder, which is at a height y."""
	r, height = points['pos'][:, 0] / R, (points['pos'][:, 1] - y) / R
	near = (r < 1.5) & (height > 0) & (height < 1)
	return np.average(points['excessPressure'][near], weights=points['volume'][near])


def push(kind, velocity):
	"""Rows of way in radii, net resistance and excess pressure over c_u; and at the end the points. A step that fails ends the run."""
	began, iterations = time.time(), 0
	solver, cone = scene(kind, velocity)
	O.step()
	found, begin = [], cone[0].state.pos[1]
	for facet in cone: facet.state.vel = (0, -velocity, 0)
	for _ in range(round(way / h * options.stepsPerCell)):
		try: O.step()
		except RuntimeError as failure:
			print(failure)
			break  # the means are those of the way up to here
		iterations += solver.iterations
		places, force = mpm.contactForces()
		moved = begin - cone[0].state.pos[1]
		onTip = places[:, 1] < shoulder - moved + h / 16
		points = mpm.arrays()
		found.append([moved / R, (-force[onTip, 1].sum() / (np.pi * R**2) - p0) / cu, behindShoulder(points, shoulder - moved) / cu if kind == 'flow' else np.nan])
	print(f'{len(points["id"])} material points, {iterations} iterations in {len(found)} steps, {time.time() - began:.0f} s')
	return np.array(found), dict(position=np.column_stack([points['pos'][:, 0], points['pos'][:, 1] - shoulder + moved]) / R, pressure=points.get('excessPressure', np.zeros(len(points['id']))) / cu)


def result(name, kind, velocity):
	"""Means over the last quarter of the way of net resistance and pressure, from the file of a run if there is one."""
	path = os.path.join(options.out, name)
	if not os.path.exists(path + '.csv'):
		curve, field = push(kind, velocity)
		np.savez(path + '.npz', **field)
		np.savetxt(path + '.csv', curve, '%.6g', ',', header='way,q,u', comments='')
	curve = np.loadtxt(path + '.csv', delimiter=',', skiprows=1)
	q, u = curve[curve[:, 0] > 0.75 * curve[-1, 0], 1:].mean(axis=0)
	print(f'{name}: q = {q:.3f} c_u' + (f', u = {u:.3f} c_u' if kind == 'flow' else ''), flush=True)
	return q, u


def compare():
	"""Both ends beside the separate runs, and the velocity of half of the change."""
	near100 = min(velocities, key=lambda V: abs(np.log(V / 100)))
	rows = [(f'resistance at V = {near100:g}', flows[near100][0], ends['undrained'][0], 'the same undrained, without flow'), (f'resistance at V = {velocities[-1]:g}', flows[velocities[-1]][0], ends['drained'][0], 'the same drained, without water')]
	if velocities[0] > near100: rows.append((f'excess pressure at V = {near100:g}', flows[near100][1], flows[velocities[0]][1], f'the same at V = {velocities[0]:g}'))
	for what, ours, theirs, source in rows:
		print(f'{what}: {ours:.3f} c_u, {source} {theirs:.3f} ({100 * (ours / theirs - 1):+.1f} %)')
		compared(f'CPTu, {options.cells} cells over the radius: {what}', ours, theirs, source, 'c_u')
	half = 10**np.interp((ends['undrained'][0] + ends['drained'][0]) / 2, [flows[V][0] for V in velocities], np.log10(velocities))
	print(f'half of the change of the resistance at V = {half:.2f}')


def draw():
	figure, (curves, field) = plt.subplots(1, 2, figsize=(11, 5.5), layout='constrained', width_ratios=(1.5, 1))
	curves.semilogx(velocities, [flows[V][0] for V in velocities], 'o-', label='net resistance q')
	curves.semilogx(velocities, [flows[V][1] for V in velocities], 's-', label='excess pressure u behind the shoulder')
	for (name, (q, _)), dashes in zip(ends.items(), ('--', ':')): curves.axhline(q, color='C0', linestyle=dashes, linewidth=1, label=f'q, {name}')
	curves.set(xlabel='normalised velocity V = v D / $c_v$', ylabel='over $c_u$', ylim=(0, 1.35 * ends['drained'][0]))
	curves.legend(frameon=False, loc='upper right')
	shown = [min(velocities, key=lambda V: abs(np.log(V / wanted))) for wanted in (100, 1)]
	most = max(np.percentile(np.load(os.path.join(options.out, f'V-{V:g}.npz'))['pressure'], 99.8) for V in shown)
	for V, side in zip(shown, (-1, 1)):
		data = np.load(os.path.join(options.out, f'V-{V:g}.npz'))
		x, y = data['position'].T
		near = (x < 10) & (np.abs(y) < 12)
		drawn = field.tricontourf(side * x[near], y[near], data['pressure'][near], levels=np.arange(0, np.ceil(most) + 0.5, 0.5), extend='both')
	field.fill([-1, 0, 1, 1, -1], [0, -tip / R, 0, 9, 9], color='0.85', zorder=3)
	field.axvline(0, color='0.3', linewidth=0.8, zorder=4)
	field.set(aspect='equal', xlim=(-6, 6), ylim=(-7, 6), xlabel='r / R', ylabel='height over the shoulder / R', title=f'V = {shown[0]:g}                V = {shown[1]:g}')
	figure.colorbar(drawn, ax=field, label='excess pressure / $c_u$', shrink=0.8, ticks=np.arange(0, np.ceil(most) + 1))
	figure.savefig(os.path.join(options.out, 'cptu.png'), dpi=110)
	print(f'written: {options.out}/cptu.png')


velocities = sorted(map(float, options.velocities.split()), reverse=True)
ends = {name: result(name, name, cv / (2 * R)) for name in options.ends.split()}
flows = {V: result(f'V-{V:g}', 'flow', V * cv / (2 * R)) for V in velocities}
if len(ends) == 2 and len(flows) > 1:
	compare()
	draw()
