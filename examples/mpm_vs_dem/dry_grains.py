#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Dry grains and a continuum with their strength: biaxial tests and columns that are let go, by DEM with several seeds and by MPM.

	grains     one layer of spheres with 30 degrees of friction, dense, out of a periodic sample (grains.py)
	continuum  Mohr-Coulomb; friction of the grains at large strain without dilation, that at the peak, or from the peak with its dilation down to large strain

Run-out and height at rest are compared, with the scatter of the seeds and the time that each takes.
"""
import os
import sys
import time
import numpy as np
here = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [here, os.path.join(here, '..'), os.path.join(here, '..', 'runout')]
from yade import utils
import grains
from columns import L, g, outline, run, runSand
from options import compared, readOptions
from style import plt
options = readOptions('Dry grains beside a continuum.',
        grains=(16, 'over the width of the column, 1 m'),
        sample=(14, 'grains over a side of the sample'),
        seeds=('1 2 3', 'of the packings, between blanks'),
        pressures=('5e3 20e3', 'of the biaxial tests [Pa], between blanks'),
        strain=(0.15, 'of the biaxial tests'),
        aspects=('1 2', 'height over width of the columns, between blanks'),
        cells=(10, 'of the continuum over the shorter side'),
        pointsPerCell=(2, 'material points per cell and axis'),
        courant=(0.3, 'how far what falls down the height goes in a step, in cells'),
        maxSplits=(0, 'how often a point that outgrows half a cell is split in two'),
        end=(6., 'latest time, over sqrt(height / g)'))
friction = np.radians(30)


def tested(seed):
	"""Strength of a sample, as of grains.strength."""
	size = options.sample / options.grains
	return grains.strength(grains.Layer(size, size, L / options.grains, seed, friction), list(map(float, options.pressures.split())), options.strain)


def fallen(seed, aspect):
	"""Run-out and height at rest of a column of grains over its width, middles and depths of its profile, and their number."""
	height = aspect * L
	layer = grains.Layer(1.1 * L, height + 3 * L / options.grains, L / options.grains, seed, friction)
	ids = grains.columnScene(layer, height, L, 4 * L + 3 * height, g)
	areas, mass = (np.array(of) for of in zip(*((np.pi * O.bodies[i].shape.radius**2, O.bodies[i].state.mass) for i in ids)))
	places = lambda: np.array([O.bodies[i].state.pos for i in ids])
	areas *= L * places()[:, 1].max() / areas.sum()
	bulk, potential = areas.sum() * 1600 / mass.sum(), mass @ places()[:, 1]

	def state():
		speeds = np.array([O.bodies[i].state.vel.norm() for i in ids])
		now = places()
		return now[:, :2], speeds, areas, bulk * utils.kineticEnergy(), bulk * g * (potential - mass @ now[:, 1])

	history, film = run(height, lambda: O.run(200, wait=True), state, options.end)
	return (*measured(history, film), len(ids))


def measured(history, film):
	_, rest, _, area = film[-1]
	x, depth = outline(rest, area, 0.1 * L)
	return history[-1, 1] - 1, depth[0] / L, x, depth


def continuum(law, aspect):
	"""The same of the continuum."""
	options.law = law
	history, film, counts = runSand(aspect * L, options)
	return (*measured(history, film), counts['points'])


seeds = [int(seed) for seed in options.seeds.split()]
figure, (curves, *profiles) = plt.subplots(1, 1 + len(options.aspects.split()), figsize=(13, 4), layout='constrained')
began, angles = time.process_time(), []
for seed in seeds:
	found, along, mobilised = tested(seed)
	angles.append(found)
	curves.plot(100 * along, mobilised, label=f'seed {seed}')
peak, last, opens, fall = np.mean(angles, axis=0)
spread = np.std(angles, axis=0, ddof=1) if len(seeds) > 1 else np.full(4, np.nan)
print(f'grains: {peak:.1f} +- {spread[0]:.1f} degrees at the peak, {last:.1f} +- {spread[1]:.1f} at large strain, dilation {opens:.1f} +- {spread[2]:.1f}, half of the fall after a shortening of {fall:.3f}; {time.process_time() - began:.0f} s for {len(seeds)} samples', flush=True)
constant = dict(frictionAngle=np.radians(last), dilationAngle=0)
softer = dict(frictionAngle=np.radians(peak), dilationAngle=np.radians(opens), residualFrictionAngle=np.radians(last), residualDilationAngle=0, softeningStrain=2 * fall * 2 / np.sqrt(3))
laws = [('friction at large strain', constant, '-'), ('friction at the peak', constant | dict(frictionAngle=np.radians(peak)), '--'), ('friction that falls', softer, ':')]
for ax, aspect in zip(profiles, map(float, options.aspects.split())):
	rows = []
	for seed in seeds:
		began = time.process_time()
		out, top, x, depth, number = fallen(seed, aspect)
		rows.append((out, top, time.process_time() - began))
		ax.plot(x, depth, color='0.6', label=None if seed > seeds[0] else 'grains, each seed')
	(out, top, seconds), (scatter, higher, _) = np.mean(rows, axis=0), np.std(rows, axis=0, ddof=1) if len(rows) > 1 else (np.nan,) * 3
	print(f'a = {aspect:g}, DEM: run-out {out:.2f} +- {scatter:.2f} L, height {top:.2f} +- {higher:.2f} L; {number} grains, {seconds:.0f} s each', flush=True)
	for name, law, style in laws:
		began = time.process_time()
		ours, high, x, depth, number = continuum(law, aspect)
		print(f'a = {aspect:g}, MPM, {name}: run-out {ours:.2f} L ({100 * (ours / out - 1):+.0f} %), height {high:.2f} L ({100 * (high / top - 1):+.0f} %); {number} points, {time.process_time() - began:.0f} s', flush=True)
		ax.plot(x, depth, 'C0' + style, label=f'continuum, {name}')
		if law is softer: compared(f'run-out of a column of dry grains, a = {aspect:g}', ours, out, f'DEM, mean of {len(seeds)} seeds, the same column in grains', 'L')
	ax.set(xlabel='x / L', ylabel='depth at rest / L', title=f'a = {aspect:g}', ylim=(0, None), xlim=(0, None))
	ax.legend(frameon=False)
curves.set(xlabel='shortening [%]', ylabel='mobilised friction angle [degrees]', title=f'{float(options.pressures.split()[-1]) / 1e3:g} kPa', xlim=(0, None), ylim=(0, None))
curves.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'dry_grains.png'), dpi=100)
