#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of dry sand, from broad to slender, are let go at once, run out over a rough base and come to rest; the same in grains on demand.

	o|______          half of a column in plane strain, by symmetry, or all of one at a wall: width L = 1 m, height a L
	o| sand |         Mohr-Coulomb, friction 31 degrees, no dilation; cohesion 1e-3 density g L, for loose points at the surface
	o|      | a L
	 ///////////////////////////      nodes held

Experiments in channels give the run-out (x - L) / L and the height at rest over L as powers of a: G. Lube, H. E. Huppert, R. S. J. Sparks, A. Freundt (2005): Collapses
of two-dimensional granular columns. Phys. Rev. E 72. Contact dynamics of disks: L. Staron, E. J. Hinch (2005). J. Fluid Mech. 545.

Run it with `scripts/run examples/runout/runout.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from columns import L, density, frames, g, outline, run, runSand
from deposits import profile
from options import compared, readOptions
from style import plt

options = readOptions('Run-out of columns of sand.',
        aspects=('0.5 1 1.5 2 3', 'height over width of the columns, between blanks'),
        cells=(10, 'over the width L, or the height if that is less; 0: no continuum'),
        pointsPerCell=(2, 'material points per cell and axis'),
        repose=(31., 'angle of repose [degrees]'),
        courant=(0.3, 'how far what falls down the height goes in a step, in cells'),
        end=(6., 'latest time, over sqrt(height / g)'),
        grains=(0, 'grains over L, of the same columns in grains; 0: none'),
        rolling=(0.1, 'resistance of grains against rolling, over the friction of a grain on a radius'),
        maxSplits=(0, 'how often a point that outgrows half a cell is split in two'),
        film=(2., 'aspect ratio of the pictures of the motion, one of aspects'))


def makeGrains(height):
	"""A layer of spheres that move in its plane, poured between walls and at rest; the second wall is taken away. Returns the ids of those that move."""
	O.reset()
	O.materials.append(CohFrictMat(young=4e6, poisson=0.3, density=2 * density, frictionAngle=radians(options.repose), isCohesive=False, momentRotationLaw=True,
	                               alphaKr=1, alphaKtw=0, etaRoll=options.rolling, label='grain'))
	O.materials.append(FrictMat(young=4e6, poisson=0.3, frictionAngle=0, label='glass'))
	size, random = L / options.grains, np.random.default_rng(1)
	rough = [utils.sphere((x, -size / 2, 0), size / 2, material='grain', fixed=True) for x in np.arange(-size, 5 * L + 6 * height, 0.8 * size)]
	number = int(0.84 * 1.02 * L * height / (np.pi / 4 * size**2 * 1.01))  # number of disks in a loose packing
	columns = int(L / (1.3 * size))
	ids = []
	for i in range(number):
		x, y = (i % columns + 0.5) * L / columns, (i // columns + 0.6) * 1.3 * size
		grain = utils.sphere((x + random.uniform(-0.03, 0.03) * size, y, 0), size / 2 * random.uniform(0.8, 1.2), material='grain')
		grain.state.blockedDOFs = 'zXY'
		ids.append(O.bodies.append(grain))
	O.bodies.append(rough)
	walls = [O.bodies.append(utils.wall(x, axis=0, sense=sense, material='glass')) for x, sense in ((0, 1), (L, -1))]
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * size),
	        InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(), Ig2_Wall_Sphere_ScGeom()], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(), Ip2_FrictMat_FrictMat_FrictPhys()],
	                        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(), Law2_ScGeom_FrictPhys_CundallStrack()]),
	        NewtonIntegrator(gravity=(0, -g, 0), damping=0.5),
	]
	O.dt = 0.4 * utils.PWaveTimeStep()
	while O.iter < 2000 or max(O.bodies[i].state.vel.norm() for i in ids) > 0.02 * np.sqrt(g * size):
		for _ in range(500): O.step()
	O.bodies.erase(walls[1])
	O.engines[3].damping, O.engines[3].dampGravity = 0.05, False
	return ids


def runGrains(height):
	"""See run; and the height that the grains have at rest before."""
	ids = makeGrains(height)
	pos = np.array([O.bodies[i].state.pos for i in ids])
	tops = [pos[(pos[:, 0] // 0.1) == strip, 1].max() for strip in range(int(L / 0.1))]
	height = np.mean(tops)
	mass = np.array([O.bodies[i].state.mass for i in ids])
	bulk = density * L * height / mass.sum()  # energies as of the sand
	potential = mass @ pos[:, 1]

	def advance():
		for _ in range(200): O.step()

	def state():
		pos, vel = (np.array([getattr(O.bodies[i].state, name) for i in ids]) for name in ('pos', 'vel'))
		return pos[:, :2], np.linalg.norm(vel, axis=1), np.full(len(ids), L * height / len(ids)), bulk * utils.kineticEnergy(), bulk * g * (potential - mass @ pos[:, 1])

	return *run(height, advance, state, options.end), height


def published(a):
	"""Run-out and height at rest over L of Lube et al.; between their two branches the run-out is that of both, interpolated."""
	x = np.interp(a, (1.8, 2.8), (0, 1))
	return (1 - x) * 1.2 * a + x * 1.9 * a**(2 / 3), np.where(a < 1.15, a, 1.1 * a**0.4)


def exponent(a, values):
	return np.polyfit(np.log(a), np.log(values), 1)[0] if len(a) > 1 else np.nan


def drawFilm(name, film, size, aspect):
	far = np.quantile(film[-1][1][:, 0], 0.999) + 0.1
	figure, axes = plt.subplots(3, 2, figsize=(12, 1 + 3 * (0.3 + 5 * aspect / far)), sharex=True, sharey=True, layout='constrained')
	figure.supxlabel('x / L [-]', fontsize=12), figure.supylabel('y / L [-]', fontsize=12)
	for ax, (t, pos, speed, _) in zip(axes.flat, film):
		dots = ax.scatter(pos[:, 0], pos[:, 1], s=size, c=speed / np.sqrt(g * aspect * L), cmap='viridis', vmin=0, vmax=1, linewidths=0)
		ax.set(aspect='equal', ylim=(0, 1.03 * aspect), xlim=(0, far))
		ax.set_title(f't = {t:.2f} sqrt(H / g)')
	figure.colorbar(dots, ax=axes, label='speed / sqrt(g H) [-]')
	figure.savefig(os.path.join(options.out, name), dpi=110)
	plt.close(figure)


def drawResults(found, energies):
	figure, ((far, high), (shapes, history)) = plt.subplots(2, 2, figsize=(12.5, 8), layout='constrained')
	a = np.geomspace(0.4, 8)
	for ax, law in zip((far, high), published(a)): ax.loglog(a, law, 'k--', linewidth=0.9, label='channel experiments, Lube et al.')
	for kind, rows in found.items():
		if not rows: continue
		table = np.array([row[:3] for row in rows])
		for ax, column in (far, 1), (high, 2): ax.plot(table[:, 0], table[:, column], {'sand': 'o', 'grains': 's'}[kind], label=kind)
		for aspect, _, _, x, depth in rows:
			shapes.plot(x / L, depth / L, '-' if kind == 'sand' else ':', color=plt.cm.viridis(np.log2(aspect / 0.5) / 4), label=f'{kind}, a = {aspect:.2g}')
	for kind, h in energies.items():
		for column, name, colour in (2, 'kinetic', 'C0'), (3, 'work of gravity', 'k'), (4, 'plastic flow', 'C3'), (6, 'ghost', 'C2'), (7, 'blows of held nodes', 'C1'), (8, 'new grids', 'C4'):
			if column < h.shape[1]: history.plot(h[:, 0], h[:, column], '-' if kind == 'sand' else ':', color=colour, label=f'{kind}: {name}')
	far.set(xlabel='a = H / L', ylabel='run-out (x - L) / L')
	high.set(xlabel='a = H / L', ylabel='height at rest / L')
	shapes.set(xlabel='x / L', ylabel='depth at rest / L')
	history.set(xlabel='t / sqrt(H / g)', ylabel='energy / first potential energy', title=f'a = {options.film:g}')
	for ax in far, high, shapes, history: ax.legend(frameon=False)
	figure.savefig(os.path.join(options.out, 'runout.png'), dpi=110)


found, energies = dict(sand=[], grains=[]), {}
print('        a  run-out  published           height  published           rest at t / sqrt(H / g)')
for a in map(float, options.aspects.split()):
	for kind in ['sand'] * (options.cells > 0) + ['grains'] * (options.grains > 0):
		began = time.time()
		try: history, film, counts = runSand(a * L, options) if kind == 'sand' else runGrains(a * L)
		except RuntimeError as failure:
			print(f'{kind:7}{a:4.2f}  left out, at t = {O.time / np.sqrt(a * L / g):.2f} sqrt(H / g): {failure}', flush=True)
			continue
		if kind == 'grains': aspect, said = counts / L, f'{len(film[0][1])} grains'
		else: aspect, said = a, ', '.join(f'{number} {what}' for what, number in counts.items()) + f'; energy not accounted for {history[-1, 9] / history[-1, 3]:+.1e} of the work'
		_, rest, _, area = film[-1]
		x, depth = outline(rest, area, 0.1 * L)
		out, top = history[-1, 1] - 1, depth[0] / L
		law = published(np.array(aspect))
		found[kind].append((aspect, out, top, *profile(rest[:, 0], area, min(L, a * L))))
		print(f'{kind:7}{aspect:4.2f}  {out:.3f}  {law[0]:.3f} ({100 * (out / law[0] - 1):+.1f} %)  {top:.3f}  {law[1]:.3f} ({100 * (top / law[1] - 1):+.1f} %)  {history[-1, 0]:.2f}, kinetic energy {history[-1, 2] / history[-1, 3]:.1e}; '
		      f'{said}; {time.time() - began:.0f} s', flush=True)
		compared(f'run-out of {kind}, a = {aspect:.3g}', out, law[0], 'Lube et al. 2005, experiments', 'L')
		compared(f'height at rest of {kind}, a = {aspect:.3g}', top, law[1], 'Lube et al. 2005, experiments', 'L')
		if a == options.film:
			energies[kind] = history
			drawFilm(f'{kind}.png', film, 2.5, aspect)
		np.savetxt(os.path.join(options.out, f'{kind}-{a:g}.csv'), np.transpose([x, depth]), '%.6g', ',', header='x,depth', comments='')
for kind, rows in found.items():
	table = np.array([row[:3] for row in rows]).reshape(-1, 3)
	for name, part, laws in ('a < 2', table[table[:, 0] < 2], (1, 1)), ('a > 2', table[table[:, 0] > 2], (2 / 3, 2 / 5)):
		if len(part) > 1: print(f'{kind}, {name}: run-out ~ a^{exponent(part[:, 0], part[:, 1]):.2f}, published {laws[0]:.2f}; height ~ a^{exponent(part[:, 0], part[:, 2]):.2f}')
drawResults(found, energies)
print(f'written: {options.out}/runout.png, films of a = {options.film:g}, profiles at rest')
