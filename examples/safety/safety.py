#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Factors of safety by strength reduction, against published ones.

	slope     2:1 slope without foundation, H = 10 m, gamma = 20 kN/m3, c = 10 kPa, phi = 20 degrees, psi = 0, E = 100 MPa, nu = 0.3: F between 1.35 and 1.40
	          D.V. Griffiths, P.A. Lane (1999): Slope stability analysis by finite elements. Geotechnique 49, example 1; charts give 1.380
	cut       vertical cut of examples/collapse, H = 5 m, gamma H / c_u = 3 (Tresca): limit analysis 3.776 / 3 = 1.2587
	gradient  the same cut in clay whose strength grows from c_u / 2 at the top to 3/2 c_u at the base: a field of strengths, beside the same in layers
	infinite  infinite slope of 30 degrees, 3 m of soil on rock, gamma = 20 kN/m3, psi = phi: c / (gamma z sin cos) + tan(phi) / tan(30 degrees), 1.0001 for c = 5 kPa and
	          phi = 25 degrees; here c and tan(phi) are 1.25 times as large, so that gravity is carried
	long      60 m of it between ends that are held, which add to that

Run it with `scripts/run examples/safety/safety.py [options]`, or by yade-batch with meshes.table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Factors of safety.',
        scene=('slope', "'slope', 'cut', 'gradient', 'long' or 'infinite'"),
        cells=(20, 'over the height'),
        pointsPerCell=(2, 'material points per cell and axis'),
        fBar=(1, '1: with F-bar, 0: without'),
        ghostFactor=(1e-2, 'ghost stabilisation'),
        psi=(0., 'angle of dilation [degrees]'),
        tolerance=(0.01, 'width of the bracket'),
        layers=(0, '1: the gradient in layers of materials instead of a field'))


def scene(profile, height, material, sides, period=0, **fields):
	"""Gravity in ten steps; returns the engine."""
	O.materials.append(material)
	grid = MpmGrid(cellSize=height / options.cells, period=(period, 0, 0))
	O.bodies.append(mpm.fill(profile, grid, pointsPerCell=options.pointsPerCell, material=material.label, **fields))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), ghost=MpmGhost(factor=options.ghostFactor), fBar=bool(options.fBar), boundaries=sides, label='solver')]
	O.dt = 1 / 10


def slope():
	H, run = 10., 20.
	soil = MpmMohrCoulombMat(young=1e8, poisson=0.3, density=2000, cohesion=10e3, frictionAngle=np.radians(20), dilationAngle=np.radians(options.psi), label='soil')
	profile = [(0, 0), (1.2 * H + run, 0), (1.2 * H, H), (0, H)]
	scene(mpm.polygon(profile), H, soil, [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')])
	return profile, (1.35, 1.40)


def cut(strength=lambda y: 1.):
	H, L, cu, density = 5., 10., 25e3, 3 * 25e3 / (5 * 10)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	profile = [(0, 0), (L, 0), (L, H), (0, H)]
	clay = lambda y, label: MpmTrescaMat(young=500 * cu, poisson=0.3, density=density, undrainedStrength=cu * strength(y), label=label)
	if options.scene == 'cut': scene(mpm.polygon(profile), H, clay(0, 'clay'), sides)
	elif not options.layers: scene(mpm.polygon(profile), H, clay(0, 'clay'), sides, undrainedStrength=lambda x: cu * strength(x[1]))
	else:
		scene(mpm.polygon(profile), H, clay(0, 'clay'), sides)
		for b in O.bodies:
			label = f'{b.state.pos[1]:.6f}'
			if label not in [m.label for m in O.materials]: O.materials.append(clay(b.state.pos[1], label))
			b.material = O.materials[label]
	return profile, (3.7752 / 3, 3.7776 / 3) if options.scene == 'cut' else None


def inclined(long):
	beta, margin = np.radians(30), 1.25
	depth = 3 * np.cos(beta)  # across the slope
	L = 60. if long else 4 * depth / options.cells
	phi = np.arctan(margin * np.tan(np.radians(25)))
	soil = MpmMohrCoulombMat(young=1e8, poisson=0.3, density=2000, cohesion=margin * 5e3, frictionAngle=phi, dilationAngle=phi, label='soil')
	profile = [(0, 0), (L, 0), (L, depth), (0, depth)]
	ends = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(L, -inf, -inf), fix='x')] if long else []
	scene(mpm.polygon(profile), depth, soil, [*ends, MpmBoundary(max=(inf, 0, inf), fix='xy')], period=0 if long else L)
	solver.gravity = (10 * np.sin(beta), -10 * np.cos(beta), 0)  # the axes lie along the slope
	return profile, (1.0001 * margin, 1.0001 * margin)


begin = time.time()
profile, published = {'slope': slope, 'cut': cut, 'gradient': lambda: cut(lambda y: 1.5 - y / 5), 'long': lambda: inclined(True), 'infinite': lambda: inclined(False)}[options.scene]()
O.run(10, wait=True)
found = mpm.strengthReduction(tolerance=options.tolerance)
print(f'{options.scene}, {options.cells} cells over the height, F-bar {options.fBar}, psi = {options.psi:g}: {len(O.bodies)} points; F = {found["lower"]:.4f} to {found["upper"]:.4f}', end='')
if published: print(f', published {published[0]:.4g} to {published[1]:.4g} ({100 * (found["lower"] / published[1] - 1):+.1f} % to {100 * (found["upper"] / published[0] - 1):+.1f} %)', end='')
if published:
	source = dict(slope='Griffiths and Lane 1999', cut='Kammoun et al. 2010, limit analysis').get(options.scene, 'infinite slope, closed form')
	compared(f'factor of safety, {options.scene}, {options.cells} cells over the height', (found['lower'] + found['upper']) / 2, sum(published) / 2, source)
print(f'; {len(found["trials"])} trials, {sum(trial["iterations"] for trial in found["trials"])} iterations, {time.time() - begin:.1f} s')
for trial in sorted(found['trials'], key=lambda trial: trial['F']):
	print(f"  F = {trial['F']:.4f}: {'carries' if trial['carries'] else 'fails'}, moves by {1000 * trial['displacement']:.2f} mm, {trial['parts']} parts, {trial['iterations']} iterations; {trial['cause'][:90]}")

figure, (curve, shape) = plt.subplots(1, 2, figsize=(12.5, 4), width_ratios=[1, 2], layout='constrained')
for carries, colour in (True, 'C0'), (False, 'C3'):
	trials = sorted((t['F'], 1000 * t['displacement']) for t in found['trials'] if t['carries'] == carries)
	curve.plot(*np.transpose(trials), 'o', color=colour, label='carries' if carries else 'fails ')
if published: curve.axvspan(*published, color='0.85', label='published') if published[0] < published[1] else curve.axvline(published[0], color='0.6', label='infinite slope')
curve.set(xlabel='trial factor F [-]', ylabel='largest displacement [mm]', yscale='log')
curve.legend(frameon=False)
slip = found['plasticStrain']
mpm.plot(slip / slip.max(), ax=shape, range=(0, 0.6), colormap='YlOrRd')
shape.child_axes[0].set_ylabel('plastic strain / largest [-]')
shape.set_title(f'Plastic strain at failure; F = {found["lower"]:.3f} to {found["upper"]:.3f}, h = {found["cellSize"]:g} m', fontsize='medium')
figure.savefig(os.path.join(options.out, 'safety.png'), dpi=130)
print(f'written: {options.out}/safety.png')
