#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A blade pushes a bed of dry grains, by DEM with several packings and by MPM with the friction of the same grains: draft by its travel, beside the passive wedge.

	####
	####  ->
	####o o o o o o o o o o o|    a smooth blade, as deep as z in a bed of 1.25 z
	#### o o o o o o o o o o |    one layer of spheres with 30 degrees of friction, dense (grains.py); Mohr-Coulomb
	    o o o o o o o o o o o|
	    //////////////////////

By hand: Rankine 1857, P = K_p rho g z^2 / 2 with the friction angle at the peak at first, and at large strain later. The wedge rises by s tan(45 degrees - phi / 2) in a travel s, and reaches so much higher on the blade. The continuum is in equilibrium.

Run it with `scripts/run examples/mpm_vs_dem/plough.py [options]`.
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
options = readOptions('A blade through dry grains beside a continuum.',
        grains=(12, 'over the depth of the blade, 1 m'),
        length=(5., 'of the bed over its depth'),
        sample=(14, 'grains over a side of the sample'),
        seeds=('1 2 3', 'of the packings, between blanks'),
        pressures=('5e3 20e3', 'of the biaxial tests [Pa], between blanks'),
        strain=(0.15, 'of the biaxial tests'),
        cells=(12, 'of the continuum over the depth'),
        pointsPerCell=(2, 'material points per cell and axis'),
        speed=(0.05, 'of the blade over sqrt(g z)'),
        travel=(0.3, 'of the blade over the depth'))
z, g, rho, d = 1., 10., 1600., 1 / options.grains
friction, speed, seeds = radians(30), options.speed * np.sqrt(g * z), [int(seed) for seed in options.seeds.split()]
unit, bed = rho * g * z**2 / 2, 1.25 * z
h = z / options.cells
ways = h / 4 * (np.arange(int(options.travel * z / h * 4)) + 1)


def passive(phi, travel=0.):
	"""Draft over rho g z^2 / 2."""
	return np.tan(np.pi / 4 + phi / 2)**2 * (1 + travel / z * np.tan(np.pi / 4 - phi / 2))**2


def addBlade(material):
	"""The blade behind x = 0, with its edge z below the surface of the bed, as it begins to move."""
	blade = O.bodies[O.bodies.append(utils.box((-z / 2, bed, 0), (z / 2, z, z), material=material, mask=1, fixed=True))]
	blade.state.vel = (speed, 0, 0)
	return blade


def ofGrains(seed):
	"""Draft over rho g z^2 / 2 by the travel, means between these, and the number of grains."""
	layer = grains.Layer((options.length + 0.1) * z, bed + 3 * d, d, seed, friction)
	ids, *_ = grains.betweenWalls(layer, bed, options.length * z, (options.length + 0.1) * z, g)
	places, masses = (np.array(of) for of in zip(*((O.bodies[i].state.pos[1], O.bodies[i].state.mass) for i in ids)))
	scale = rho * options.length * z * z / masses[places < z].sum()  # the same density, and a metre of thickness
	O.engines[-1].damping, O.engines[-1].dampGravity = 0.05, False
	blade, found = addBlade('wall'), []
	for way in ways:
		forces = []
		while blade.state.pos[0] + z / 2 < way:
			for _ in range(20): O.step()
			forces.append(scale * abs(sum(contact.phys.normalForce[0] for contact in blade.intrs() if contact.isReal)))
		found.append(np.mean(forces) / unit)
	return np.array(found), len(ids)


def ofContinuum(law):
	"""The same of the continuum, and the number of points."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=500 * rho * g * z, poisson=0.3, density=rho, cohesion=1e-3 * rho * g * z, label='sand', **law))
	O.materials.append(FrictMat(frictionAngle=0, label='blade'))
	grid = MpmGrid(cellSize=h)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (options.length * z, bed, 1)), grid, options.pointsPerCell, 'sand'))
	for point in O.bodies: point.groupMask = 2
	held = [MpmBoundary(max=(0, bed - z, inf), fix='x'), MpmBoundary(min=(options.length * z, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	contact = MpmContact(mask=1, stiffness=20)
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -g, 0), gravityCurve=[(0, 1)], boundaries=held, contacts=[contact], newton=MpmNewton(minStep=1 / 256), fBar=True, verbosity=0)
	O.engines, O.dt = [solver], h / 8 / speed
	mpm.geostatic()
	blade, found = addBlade('blade'), []
	for way in ways:
		forces = []
		while blade.state.pos[0] + z / 2 < way - 1e-9:
			O.step()
			forces.append(-contact.forces[0][0])
		found.append(np.mean(forces) / unit)
	return np.array(found), len(mpm.arrays()['id'])


peak, last, opens, fall = grains.meanStrength(options, d, friction)
began, drafts = time.process_time(), []
for seed in seeds:
	draft, number = ofGrains(seed)
	drafts.append(draft)
seconds = (time.process_time() - began) / len(seeds)
mean, scatter = np.mean(drafts, axis=0), np.std(drafts, axis=0, ddof=1) if len(seeds) > 1 else np.zeros(len(ways))
first, late = (ways > 0.05 * z) & (ways <= 0.1 * z), ways > 0.2 * z
known = passive(np.radians(peak), ways[first].mean()), passive(np.radians(last), ways[late].mean())
print(f'DEM: draft {mean[first].mean():.2f} +- {scatter[first].mean():.2f} from 0.05 to 0.1 z (wedge at the peak {known[0]:.2f}), {mean[late].mean():.2f} +- {scatter[late].mean():.2f} from 0.2 z on (wedge at large strain {known[1]:.2f}), over rho g z^2 / 2; {number} grains, {seconds:.0f} s each', flush=True)
figure, ax = plt.subplots(figsize=(8, 4), layout='constrained')
ax.fill_between(ways / z, mean - scatter, mean + scatter, color='0.85')
ax.plot(ways / z, mean, color='0.4', label='grains, mean and scatter of the seeds')
constant = dict(frictionAngle=np.radians(last), dilationAngle=0)
softer = dict(frictionAngle=np.radians(peak), dilationAngle=np.radians(opens), residualFrictionAngle=np.radians(last), residualDilationAngle=0, softeningStrain=2 * fall * 2 / np.sqrt(3))
for name, law, style in ('friction at large strain', constant, 'C0-'), ('friction that falls', softer, 'C0:'):
	began = time.process_time()
	ours, number = ofContinuum(law)
	print(f'MPM, {name}: draft {ours[first].mean():.2f} from 0.05 to 0.1 z ({100 * (ours[first].mean() / mean[first].mean() - 1):+.0f} % of the grains), {ours[late].mean():.2f} from 0.2 z on ({100 * (ours[late].mean() / mean[late].mean() - 1):+.0f} %); {number} points, {time.process_time() - began:.0f} s', flush=True)
	ax.plot(ways / z, ours, style, label=f'continuum, {name}')
	if law is constant: compared('draft of a blade in dry grains, friction at large strain, from 0.2 z on', ours[late].mean(), known[1], 'Rankine 1857, the wedge risen', 'rho g z^2 / 2')
	compared(f'draft of a blade in dry grains, {name}, from 0.2 z on', ours[late].mean(), mean[late].mean(), f'DEM, mean of {len(seeds)} seeds, the same bed in grains', 'rho g z^2 / 2')
for name, phi, style in ('the peak', peak, 'k--'), ('large strain', last, 'k-'): ax.plot(ways / z, passive(np.radians(phi), ways), style, lw=0.8, label=f'passive wedge, friction at {name}')
ax.set(xlabel='travel / z', ylabel=r'draft / ($\rho g z^2 / 2$)', xlim=(0, options.travel), ylim=(0, 10))
ax.legend(frameon=False, fontsize=8)
figure.savefig(os.path.join(options.out, 'plough.png'), dpi=100)
print(f'written: {options.out}/plough.png')
