#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A plane silo of dry grains, by DEM with several packings and by MPM with the friction of the same grains: pressure on the walls at rest, and flow out of an opening.

	 |o o o o o o|    one layer of spheres with 30 degrees of friction, dense, out of a periodic sample (grains.py);
	 | o o o o o |    a continuum with the friction of that sample at large strain, half of it
	 |o o o o o o|
	 |___     ___|    the walls have a friction of their own, base and grains are equally rough
	     D

At rest: Janssen 1895, with the pressure on the walls K = 1 - sin(phi) times that on layers. Flow: Brown and Richards 1970, grains that fall freely below an arch over the opening, W = 2 rho g^(1/2) ((D - k d) / (2 sin(b)))^(3/2) int cos(t)^(1/2) dt from 0 to b = 45 degrees - phi / 2.

Run it with `scripts/run examples/mpm_vs_dem/silo.py [options]`.
"""
import os
import sys
import time
import numpy as np
here = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [here, os.path.join(here, '..')]
from yade import mpm, pack
import grains
from options import compared, readOptions
from style import plt
options = readOptions('Silo of dry grains beside a continuum.',
        grains=(24, 'over the width of the silo, 1 m'),
        height=(1.25, 'of the silo over its width'),
        openings=('0.25 0.41666667', 'over the width, between blanks'),
        sample=(14, 'grains over a side of the sample'),
        seeds=('1 2 3', 'of the packings, between blanks'),
        pressures=('5e3 20e3', 'of the biaxial tests [Pa], between blanks'),
        strain=(0.15, 'of the biaxial tests'),
        wall=(20., 'friction of the walls [degrees]'),
        cells=('24 48', 'of the continuum over the width, between blanks'),
        pointsPerCell=(2, 'material points per cell and axis'),
        dilation=(0., 'angle of dilation of the continuum [degrees]'),
        courant=(0.3, 'how far what falls down the opening goes in a step, in cells'),
        empty=(0.4, 'part of the mass that flows out'),
        lowered=(0.5, 'grains by which the base of the grains is lowered before the door opens, which makes the walls rub'),
        k=(1.4, 'grains by which the opening counts as narrower'))
W, g, rho, d = 1., 10., 1600., 1 / options.grains
H, friction, wallFriction = options.height * W, radians(30), radians(options.wall)
openings, seeds = ([kind(part) for part in text.split()] for kind, text in ((float, options.openings), (int, options.seeds)))
strips = np.linspace(0, H, 9)


def janssen(depth, K, mu):
	"""Pressure on the walls [Pa] at a depth [m], and load of the base over the weight of what is above it."""
	length = W / (2 * mu * K)
	vertical = rho * g * length * (1 - np.exp(-np.asarray(depth) / length))
	return K * vertical, vertical / (rho * g * depth)


def freeFall(D, phi):
	"""Mass out of an opening in a second [kg / (s m)]."""
	b = np.pi / 4 - phi / 2
	angles = (np.arange(1000) + 0.5) * b / 1000
	return 2 * rho * np.sqrt(g) * (D / 2 / np.sin(b))**1.5 * np.sqrt(np.cos(angles)).sum() * b / 1000


def rate(times, out):
	"""Slope of what has flown out, from a quarter of it on."""
	late = out > out[-1] / 4
	return np.polyfit(times[late], out[late], 1)[0]


def grainsAtRest(ids, walls, base, door, scale):
	"""Pressure on the walls by strips, means of both [Pa], and load of the base over the weight."""
	push, borne = np.zeros(len(strips) - 1), 0
	for contact in O.interactions:
		force = contact.phys.normalForce
		if contact.id1 in walls or contact.id2 in walls:
			at = np.searchsorted(strips, contact.geom.contactPoint[1]) - 1
			if 0 <= at < len(push): push[at] += abs(force[0])
		if {contact.id1, contact.id2} & {*base, door}: borne += abs(force[1])
	weight = g * sum(O.bodies[i].state.mass for i in ids)
	return scale * push / 2 / np.diff(strips), borne / weight


def flowOfGrains(layer, D):
	"""Pressures and load at rest, times and mass out [kg/m], grains."""
	ids, walls, base, door = grains.siloScene(layer, H, W, D, g, wallFriction, options.lowered * d)
	places, masses = (np.array(of) for of in zip(*((O.bodies[i].state.pos[1], O.bodies[i].state.mass) for i in ids)))
	scale = rho * W * 0.8 * H / masses[places < 0.8 * H].sum()  # the same density, and a metre of thickness
	rest = grainsAtRest(ids, walls, base, door, scale)
	grains.letGo(door)
	mass, number = {i: scale * O.bodies[i].state.mass for i in ids}, len(ids)
	begin, total, times, out = O.time, sum(mass.values()), [], []
	while O.time < begin + 2 * options.empty * total / freeFall(D - options.k * d, friction) and (not out or out[-1] < options.empty * total):
		O.run(500, wait=True)
		times.append(O.time - begin)
		out.append(total - sum(m for i, m in mass.items() if O.bodies[i] and O.bodies[i].state.pos[1] > 0))
		for i in mass:
			if O.bodies[i] and O.bodies[i].state.pos[1] < -D: O.bodies.erase(i)
	return rest, np.array(times), np.array(out), number


def fallen():
	"""Take away points that have fallen below the opening; mass above it [kg/m]."""
	points = mpm.arrays()
	for i in points['id'][points['pos'][:, 1] < -0.25 * W]: O.bodies.erase(int(i))
	volume = points['volume'] / np.linalg.det(points['defGrad'])
	return 2 * rho * volume[points['pos'][:, 1] > 0].sum()


def flowOfContinuum(phi, cells, D):
	"""The same of half of the continuum."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=500 * rho * g * W, poisson=(1 - np.sin(phi)) / (2 - np.sin(phi)), density=rho, cohesion=1e-3 * rho * g * W, frictionAngle=phi, dilationAngle=radians(options.dilation), label='sand'))
	O.materials.append(FrictMat(frictionAngle=wallFriction, label='side'))
	grid = MpmGrid(cellSize=W / cells)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (W / 2, H, 1)), grid, options.pointsPerCell, 'sand'))
	for point in O.bodies: point.groupMask = 2
	O.bodies.append(utils.wall(W / 2, axis=0, sense=-1, material='side', mask=1))
	kept = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(D / 2, -inf, -inf), max=(inf, 0, inf), fix='xy')]
	common = dict(grid=grid, gravity=(0, -g, 0), contacts=[MpmContact(mask=1, stiffness=20)], verbosity=0)
	solver = MpmImplicitEngine(boundaries=kept + [MpmBoundary(max=(inf, 0, inf), fix='xy')], newton=MpmNewton(minStep=1 / 64), **common)
	O.engines, O.dt = [solver], 1 / 20
	O.run(20, wait=True)
	places, forces = mpm.contactForces()
	push = np.histogram(places[:, 1], strips, weights=np.abs(forces[:, 0]))[0] / np.diff(strips)
	total, number = fallen(), len(mpm.arrays()['id'])
	rest = push, 2 * sum(reaction[1] for reaction in solver.reactions) / (total * g)
	solver = MpmDynamicEngine(boundaries=kept, loadTime=O.time, newton=MpmNewton(minStep=1 / 256), scheme='generalised-alpha', rhoInfinity=0.5, **common)
	O.engines, O.dt = [solver], options.courant * grid.cellSize / np.sqrt(2 * g * D)
	begin, times, out = O.time, [], []
	while O.time < begin + 2 * options.empty * total / freeFall(D, friction) and (not out or out[-1] < options.empty * total):
		O.step()
		times.append(O.time - begin)
		out.append(total - fallen())
	return rest, np.array(times), np.array(out), number


def spread(values):
	return np.std(values, axis=0, ddof=1) if len(values) > 1 else np.zeros(np.shape(values[0]))


_, last, *_ = grains.meanStrength(options, d, friction)
layers = {}
phi = np.radians(last)
K, mu, unit = 1 - np.sin(phi), np.tan(wallFriction), rho * g * W
figure, (wall, flow, law) = plt.subplots(1, 3, figsize=(13, 4.2), layout='constrained')
middle = (strips[1:] + strips[:-1]) / 2
for number, D in enumerate(openings):
	rates, loads, pushes = [], [], []
	for seed in seeds:
		began = time.process_time()
		if seed not in layers: layers[seed] = grains.Layer(1.05 * W, 1.03 * H, d, seed, friction)
		(push, load), times, out, count = flowOfGrains(layers[seed], D)
		rates.append(rate(times, out)), loads.append(load), pushes.append(push)
		flow.plot(times, out / (rho * W * H), f'C{number}', alpha=0.4, label=None if seed > seeds[0] else f'D = {D:.2g} W, grains, each seed')
	theirs = freeFall(D - options.k * d, phi)
	print(f'D = {D * options.grains:.3g} grains, DEM: {np.mean(rates):.0f} +- {spread(rates):.0f} kg/s/m ({100 * (np.mean(rates) / theirs - 1):+.0f} % of free fall from an arch); base bears {np.mean(loads):.3f} +- {spread(loads):.3f} of the weight; {count} grains, {time.process_time() - began:.0f} s each', flush=True)
	if number == 0: wall.errorbar(np.mean(pushes, axis=0) / unit, middle, xerr=spread(pushes) / unit, fmt='o', color='0.5', label='grains, with the scatter of the seeds')
	law.errorbar(D / d, np.mean(rates) / (rho * np.sqrt(g * d**3)), yerr=spread(rates) / (rho * np.sqrt(g * d**3)), fmt='o', color='0.5', label=None if number else 'grains')
	for cells, style in zip(map(int, options.cells.split()), ('--', '-', ':')):
		began = time.process_time()
		(push, load), times, out, count = flowOfContinuum(phi, cells, D)
		ours, known = rate(times, out), janssen(H, K, mu)[1]
		print(f'D = {D * options.grains:.3g} grains, MPM, {cells} cells: {ours:.0f} kg/s/m ({100 * (ours / np.mean(rates) - 1):+.0f} % of the grains, {100 * (ours / freeFall(D, phi) - 1):+.0f} % of free fall); base bears {load:.3f} of the weight, Janssen {known:.3f}; {count} points, {time.process_time() - began:.0f} s', flush=True)
		flow.plot(times, out / (rho * W * H), f'C{number}' + style, label=f'D = {D:.2g} W, {cells} cells')
		if number == 0: wall.plot(push / unit, middle, 'C3' + style, label=f'continuum, {cells} cells')
		law.plot(D / d, ours / (rho * np.sqrt(g * d**3)), 'C3s', mfc='C3' if style == '-' else 'none', label=None if number else f'continuum, {cells} cells')
	compared(f'flow out of a silo, opening of {D * options.grains:.3g} grains', ours, np.mean(rates), f'DEM, mean of {len(seeds)} seeds, the same silo in grains', 'kg/s/m')
	if number == 0: compared('load of the base of a silo over the weight', load, known, 'Janssen 1895')
	compared(f'flow out of a silo against free fall, opening of {D * options.grains:.3g} grains', ours, freeFall(D, phi), 'Brown and Richards 1970', 'kg/s/m')
heights = np.linspace(0, 0.999 * H, 50)
wall.plot(janssen(H - heights, K, mu)[0] / unit, heights, 'k', label='Janssen 1895')
wall.set(xlabel=r'pressure on the walls / $\rho g W$', ylabel='height / W', title='at rest', xlim=(0, None), ylim=(0, H))
flow.set(xlabel='time [s]', ylabel='part that has flown out', title='flow', xlim=(0, None), ylim=(0, None))
wide = np.linspace(0, 1.2 * max(openings), 100)
law.plot(wide / d, freeFall(np.maximum(0, wide - options.k * d), phi) / (rho * np.sqrt(g * d**3)), 'k', label='Brown and Richards 1970, grains')
law.plot(wide / d, freeFall(wide, phi) / (rho * np.sqrt(g * d**3)), 'k:', label='the same, k = 0')
law.set(xlabel='opening D / d', ylabel=r'flow / ($\rho g^{1/2} d^{3/2}$)', title='flow by the opening', xlim=(0, None), ylim=(0, None))
for ax in wall, flow, law: ax.legend(frameon=False, fontsize=8)
figure.savefig(os.path.join(options.out, 'silo.png'), dpi=100)
print(f'written: {options.out}/silo.png')
