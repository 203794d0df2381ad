#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Records, layered ground and a sliding block.

	record     an artificial record, made from noise with a fixed seed, is given an offset and corrected
	column     two layers over rock, sides that are the same nodes, shaken by the record: amplification against Thomson and Haskell's propagators, with the scheme in
	           time and Rayleigh's damping in the closed form; on a rigid base, and on a compliant one, over the motion of an outcrop of the rock
	block      a stiff block on a weak joint in an inclined plane that moves by records of several lengths, against N. M. Newmark's integration (1965)
	contact    the same of a block that rubs on a Box
	trade      the column with cells and steps of several sizes: error of its amplification in continuous time against seconds of the processor

Run it with `scripts/run examples/earthquake/earthquake.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm, utils
import numpy as np
here = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [os.path.join(here, '..'), os.path.join(here, '..', '..', 'scripts', 'lib')]
from options import compared, readOptions
from style import plt
from results import Results, makeFolder

options = readOptions('Earthquakes against closed forms.',
        scene=('record column block contact', "'record', 'column', 'block', 'contact' or 'trade', or several between blanks"),
        scheme=('newmark', "of the column: 'newmark' or 'generalised-alpha'"),
        cellSize=(1., 'of the column [m]'),
        step=(0.01, 'of the column [s]'),
        exactInTime=(0, '1: closed form of the column without the scheme in time: what its steps cost, too'),
        seconds=(8., 'of the record that shakes the column'),
        lengths=('5 10 20', 'of the records that shake the block [s]'),
        lowest=(0.5, 'frequency of the records that shake the block [Hz]'),
        blockStep=(0.005, 'of the block [s]'))

# thickness [m], speed of shear waves [m/s], density [kg/m3], from the surface downwards; the last one is of the rock below
layers = [(8., 150., 1800.), (12., 250., 1900.), (4., 800., 2200.)]
damping = mpm.rayleigh(0.05, 4)
frequencies = np.array([2.9, 5, 6.8])  # [Hz], about the first two resonances and the trough between


def artificial(seconds, peak, seed, frequency=2.5, step=0.01):
	"""Times [s] and accelerations [m/s2]: noise through an oscillator of a frequency [Hz] (K. Kanai, H. Tajimi), growing and dying away."""
	t = np.arange(0, seconds, step)
	noise = np.random.default_rng(seed).standard_normal(t.size) * t / seconds * np.exp(-6 * t / seconds)
	w = np.fft.rfftfreq(2 * t.size, step) / frequency
	a = np.fft.irfft(np.fft.rfft(noise, 2 * t.size) * (1 + 1.2j * w) / (1 - w**2 + 1.2j * w), 2 * t.size)[:t.size]
	return t, peak * a / np.abs(a).max()


def record():
	t, a = artificial(20, 2, seed=1)
	raw = list(zip(t, a + 0.03 + 0.002 * t))
	found = mpm.record(raw, unit='m/s2', filter=(0.1, 25))
	print(f'record: {np.abs(found.acceleration).max():.3f} m/s2, {np.abs(found.velocity).max():.3f} m/s, {np.abs(found.displacement).max():.3f} m, Arias {found.arias:.3f} m/s, at the end {found.velocity[-1]:.1e} m/s and {found.displacement[-1]:.1e} m, {found.before:.1f} s longer before')
	asIs = mpm.record(raw, unit='m/s2', baseline=None, isSure=True)
	print(f'record: without baseline and filter it would end at {asIs.displacement[-1]:.1f} m, with {asIs.velocity[-1]:.2f} m/s')
	try:
		mpm.record(raw, unit='m/s', quantity='velocity')
	except ValueError as error:
		print(f'record, handed in as a velocity: {error}')
	return found.plot()


def inTime(frequency, solver):
	"""Values for iw in a step of the scheme: velocity over displacement, and acceleration over displacement, in the balance of forces [1/s, 1/s2]."""
	if options.exactInTime: return 2j * np.pi * frequency, (2j * np.pi * frequency)**2
	beta, gamma, m, f = schemeOf(solver)
	z = np.exp(2j * np.pi * frequency * O.dt)
	way = O.dt**2 * (((1 - gamma) + gamma * z) / (z - 1)**2 + ((0.5 - beta) + beta * z) / (z - 1))  # displacement over acceleration
	rate = O.dt * ((1 - gamma) + gamma * z) / (z - 1) / way
	return rate, ((1 - m) * z + m) / ((1 - f) * z + f) / way


def schemeOf(solver):
	if solver.scheme == 'newmark': return solver.beta, solver.gamma, 0, 0
	r = solver.rhoInfinity
	m, f = (2 * r - 1) / (r + 1), r / (r + 1)
	return (1 - m + f)**2 / 4, 0.5 - m + f, m, f


def propagated(depth, frequency, solver):
	"""Displacement and shear stress at a depth [m], for a displacement of 1 at the free surface (W. T. Thomson 1950, N. A. Haskell 1953)."""
	rate, inertia = inTime(frequency, solver)
	alpha, beta = solver.rayleigh
	u, tau, above = 1 + 0j, 0j, 0
	for thickness, c, density in layers:
		d = min(thickness, depth - above)
		if d <= 0: break
		modulus = density * c**2 * (1 + beta * rate)
		k = np.sqrt(density * (inertia + alpha * rate) / modulus)
		u, tau = np.cosh(k * d) * u + np.sinh(k * d) / (modulus * k) * tau, modulus * k * np.sinh(k * d) * u + np.cosh(k * d) * tau
		above += thickness
	return u, tau


def shaken(quake, base, depth):
	"""The column above this depth [m], until it rests: histories of a point at the surface and one at the base, and their depths [m]."""
	O.reset()
	h, bottom = options.cellSize, -depth
	edges = np.cumsum([0] + [thickness for thickness, _, _ in layers])
	for i, (_, c, density) in enumerate(layers):
		O.materials.append(MpmElasticMat(young=2 * density * c**2, poisson=0, density=density, label=f'layer{i}'))
	grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
	layer = lambda x: f'layer{min(np.searchsorted(edges, -x[1], side="right") - 1, len(layers) - 1)}'
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, bottom, 0), (3 * h, 0, 1)), grid, 2, layer))
	solver = MpmDynamicEngine(grid=grid, rayleigh=damping, scheme=options.scheme, verbosity=0, newton=MpmNewton(tolerance=1e-8))
	place = dict(max=(inf, bottom, inf))
	if base == 'rigid': solver.boundaries = [MpmBoundary(fix='xy', motion=quake.motion(), **place)]
	else: solver.absorbing = [MpmAbsorbingBoundary(motion=quake.incoming(), **place)]
	O.engines = [solver]
	O.dt = options.step
	histories = mpm.histories([(h / 4, -h / 4, 0), (h / 4, bottom + h / 4, 0)], record=['velocity'])
	O.run(round((quake.time[-1] + 2) / O.dt), wait=True)
	return solver, histories, (h / 4, depth - h / 4)


def rigid(quake, f):
	"""Amplification of a point at the surface over one at the base: frequencies, found, closed form."""
	solver, histories, depths = shaken(quake, 'rigid', layers[0][0] + layers[1][0])
	f, found = histories.amplification(0, 1, 'velocity_x', f)
	over = np.array([np.divide(*(propagated(depth, one, solver)[0] for depth in depths)) for one in f])
	return f, np.abs(found), np.abs(over)


def compliant(quake, f):
	"""Amplification of a point at the surface over the motion of an outcrop."""
	depth = sum(thickness for thickness, _, _ in layers)
	solver, histories, depths = shaken(quake, 'compliant', depth)
	f, found = histories.spectrum('velocity_x', f)
	time = np.array(histories.time)
	outcrop = np.exp(-2j * np.pi * np.outer(f, time)) @ np.interp(time, quake.time, quake.velocity, 0, 0) * O.dt
	_, c, density = layers[-1]

	def exact(one):
		rate, _ = inTime(one, solver)
		u, tau = propagated(depth, one, solver)
		incoming = (tau + density * c * rate * u) / (2 * density * c)  # the dashpot bears density c (2 v_in - v)
		return rate * propagated(depths[0], one, solver)[0] / (2 * incoming)

	return f, np.abs(found[:, 0] / outcrop), np.abs([exact(one) for one in f])


def ofColumn():
	"""The record that shakes it."""
	return mpm.record(list(zip(*artificial(options.seconds, 0.5, seed=2))), unit='m/s2', filter=(0.5, 20))


def column():
	quake = ofColumn()
	figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout='constrained')
	for ax, run in zip(axes, (rigid, compliant)):
		f, found, exact = run(quake, np.concatenate([frequencies, np.linspace(0.5, 12, 116)]))
		three = len(frequencies)
		for one, ratio, closed in zip(f[:three], found, exact):
			print(f'column, {run.__name__}: {one:g} Hz  {ratio:.4f}  closed form {closed:.4f} ({100 * (ratio / closed - 1):+.2f} %)')
			compared(f'amplification at {one:g} Hz, {run.__name__} base', ratio, closed, 'Thomson 1950, Haskell 1953')
		below = f[three:] <= 8
		print(f'column, {run.__name__}: up to 8 Hz off by {100 * np.abs(found / exact - 1)[three:][below].max():.2f} % at most')
		ax.plot(f[three:], exact[three:], 'k-', linewidth=0.8, label='closed form')
		ax.plot(f[three:], found[three:], '.', color='#1864ab', label='found')
		ax.plot(f[:three], found[:three], 'o', fillstyle='none', color='#d9480f', label='found, as in the table')
		ax.set(xlabel='frequency [Hz]', ylabel='surface over ' + ('base' if run is rigid else 'outcrop of the rock'), title=f'{run.__name__} base')
		ax.legend(loc='upper right')
	scheme = mpm.schemeDamping(frequencies)
	print(f'column: {options.scheme}, steps of {O.dt:g} s: damping of its own {scheme["damping"]}, periods {scheme["period"]}')
	return figure


def trade():
	makeFolder(options.out)
	kept = Results(options.out, 'trade', ['scheme', 'cellSize', 'step'], ['seconds', 'error'])
	cases = [('newmark', h, dt) for h in (4., 2., 1., 0.5) for dt in (0.02, 0.01, 0.005)] + [('generalised-alpha', h, dt) for h in (2., 1.) for dt in (0.02, 0.01, 0.005)]
	options.exactInTime = 1
	for case in cases:
		if case in kept: continue
		options.scheme, options.cellSize, options.step = case
		begin, quake = time.process_time(), ofColumn()
		error = max(np.abs(found / exact - 1).max() for _, found, exact in (run(quake, frequencies) for run in (rigid, compliant)))
		kept.add([dict(zip(kept.keys, case), seconds=f'{time.process_time() - begin:.3f}', error=f'{error:.4g}')])
		print(f'trade, {case[0]}, cells of {case[1]:g} m, steps of {case[2]:g} s: {time.process_time() - begin:.1f} s, error {100 * error:.2f} %', flush=True)
	figure, ax = plt.subplots(figsize=(6, 4.5), layout='constrained')
	for scheme, style in ('newmark', 'o'), ('generalised-alpha', '^'):
		some = [kept.row(case) for case in cases if case[0] == scheme]
		ax.loglog([float(row['seconds']) for row in some], [100 * float(row['error']) for row in some], style, label=scheme)
	ax.set(xlabel='seconds', ylabel='largest error of the amplification at 2.9, 5 and 6.8 Hz [%]')
	ax.legend()
	return figure


def newmarks(acceleration, step, atYield):
	"""Way [m] of a block that slides downwards alone, where the plane accelerates upwards beyond that; steps are divided by 50."""
	fine = np.interp(np.arange((len(acceleration) - 1) * 50 + 1) / 50, np.arange(len(acceleration)), acceleration)
	speed, way = 0., [0.]
	for a in (fine[:-1] + fine[1:]) / 2:
		before, speed = speed, max(0., speed - (atYield + a) * step / 50)
		way.append(way[-1] + (before + speed) / 2 * step / 50)
	return np.array(way[::50])


def slid(quake, slope, g, atYield, rest=0.5, after=1.):
	"""Times [s] from the beginning of the record, how far the block is down the plane then, and what is left of it [m]."""
	O.reset()
	h, height, density = 0.5, 4, 2000
	mass = density * (height + h / 20)  # above the middle of the joint, for each square metre
	strength = mass * (atYield + g * np.sin(slope))
	O.materials.append(MpmElasticMat(young=2e10, poisson=0.25, density=density, label='block'))
	O.materials.append(MpmTrescaMat(young=4e9, poisson=0.49, density=density / 10, undrainedStrength=strength, label='joint'))
	grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (3 * h, h + height, 1)), grid, 2, lambda x: 'joint' if x[1] < h else 'block'))
	plane = MpmBoundary(max=(inf, 0, inf), fix='xy', motion=quake.motion(start=rest))
	O.engines = [MpmDynamicEngine(
	        grid=grid, boundaries=[plane], gravity=(g * np.sin(slope), -g * np.cos(slope), 0), gravityCurve=[(0, 0), (0.8 * rest, 1)],
	        scheme='generalised-alpha', rhoInfinity=0.5, verbosity=0)]
	O.dt = options.blockStep
	middle = h + height / 2
	h = mpm.histories([(0.1, middle, 0)], record=['displacement'])
	O.run(round((rest + quake.time[-1] + after) / O.dt), wait=True)
	time = np.array(h.time) - rest
	begin = np.interp(0, time, h['displacement_x'][:, 0])
	way = h['displacement_x'][:, 0] - begin - np.interp(time, quake.time, quake.displacement)
	return time, way, h.permanent(after / 2)[0, 0] - begin - quake.displacement[-1]


def slidOnBox(quake, slope, g, atYield, rest=0.5):
	"""The same of a stiff block on a Box with friction, which moves by the mean velocity of each step."""
	O.reset()
	h, friction = 0.25, np.arctan((atYield / g + np.sin(slope)) / np.cos(slope))
	O.materials.append(MpmElasticMat(young=1e9, poisson=0.2, density=2000, label='block'))
	O.materials.append(FrictMat(young=1e9, frictionAngle=friction, label='rock'))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0), (2, 0.5, 1)), MpmGrid(cellSize=h), 2, 'block'))
	plane = O.bodies[O.bodies.append(utils.box((1, -0.5, 0), (12, 0.5, 1), fixed=True, material='rock'))]
	O.engines = [MpmDynamicEngine(
	        grid=MpmGrid(cellSize=h), contacts=[MpmContact(stiffness=50)], gravity=(g * np.sin(slope), -g * np.cos(slope), 0),
	        gravityCurve=[(0, 0), (0.8 * rest, 1)], verbosity=0)]
	O.dt = options.blockStep
	O.run(round(rest / O.dt), wait=True)
	at = lambda: mpm.arrays()['pos'][:, 0].mean() - plane.state.pos[0]
	times, start, way = O.dt * np.arange(round(quake.time[-1] / O.dt) + 1), at(), [0.]
	fine = np.linspace(0, times[-1], 10 * (len(times) - 1) + 1)  # velocities are linear between samples, displacements are not
	moved = np.concatenate([[0.], np.cumsum(np.convolve(np.interp(fine, quake.time, quake.velocity), (0.5, 0.5), 'valid') * fine[1])])[::10]
	for after, before in zip(moved[1:], moved):
		plane.state.vel = ((after - before) / O.dt, 0, 0)
		O.step()
		way.append(at() - start)
	return times, np.array(way), way[-1]


def contact():
	return block(slidOnBox)


def block(slid=slid):
	slope, g, atYield = np.radians(15), 9.81, 2.
	figure, ax = plt.subplots(figsize=(8, 4.5), layout='constrained')
	for i, seconds in enumerate(map(float, options.lengths.split())):
		t, a = artificial(seconds, 5, seed=10 + i, frequency=1)
		quake = mpm.record(list(zip(t, a)), unit='m/s2', filter=(options.lowest, 5))
		times, way, left = slid(quake, slope, g, atYield)
		exact = newmarks(quake.acceleration, quake.step, atYield)
		print(f'{"block" if slid is not slidOnBox else "contact"}, {seconds:g} s: {left:.4f} m, Newmark {exact[-1]:.4f} m ({100 * (left / exact[-1] - 1):+.2f} %); the plane moves by up to {np.abs(quake.displacement).max():.2f} m')
		compared(f'way of a block {"on a joint of clay" if slid is not slidOnBox else "on a Box"}, record of {seconds:g} s', left, exact[-1], 'Newmark 1965', 'm')
		ax.plot(quake.time, exact, 'k-', linewidth=0.8, label=None if i else "Newmark's integration")
		ax.plot(times, way, '--', label=f'found, record of {seconds:g} s')
	ax.set(xlabel='time [s]', ylabel='way down the plane [m]', title=f'slips from {atYield:.2f} m/s2 on, records of 5 m/s2')
	ax.legend()
	return figure


for name in options.scene.split():
	if name not in ('record', 'column', 'block', 'contact', 'trade'): raise SystemExit(f"earthquake.py: --scene {name!r} is not known; there are 'record', 'column', 'block', 'contact' and 'trade'")
	figure = globals()[name]()
	picture = os.path.join(options.out, f"{'earthquake' if name == 'column' else name}.png")
	figure.savefig(picture, dpi=130)
	print('written:', picture)
