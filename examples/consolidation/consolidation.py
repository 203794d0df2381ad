#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Water that is pressed out of soil, against what is known.

	terzaghi  column under a load that is put on at once, drained at its top, which cuts a cell: pressures and settlement by Terzaghi's series
	large     the same under a load of a fifth of its stiffness: it loses a seventh of its height, and its conductivity falls with its porosity (Kozeny and Carman)
	mandel    slab between smooth rigid plates, drained at its sides, which cut a cell: the pressure in its middle rises before it falls
	strip     a strip load on soft clay: at first the water bears it, and the clay moves at constant volume

Run it with `scripts/run examples/consolidation/consolidation.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Consolidation.',
        scene=('all', "'all', or one of 'terzaghi', 'large', 'mandel' and 'strip'"),
        cells=(20, 'over the height of the column, and half of them over half of the slab'),
        cut=(0.5, 'part of a cell that soil fills where its drained side cuts one'),
        steps=(40, 'of each scene'),
        stabilisation=(1., 'of the pressure, MpmFlow.stabilisation'),
        skin=(30., "conductance of the column's drain"))
E, k = 1e6, 1e-7  # Young's modulus [Pa], conductivity [m/s]
kappa = k / 9810
solves = []  # solves of all steps, for scripts/trade
odd = np.pi * (2 * np.arange(200) + 1) / 2


def scene(region, cellSize, boundaries, drains, loads=(), poisson=0., **soil):
	O.reset()
	O.materials.append(MpmElasticMat(**(dict(young=E, poisson=poisson, density=2000, conductivity=k, porosity=.6, label='soil') | soil)))
	grid = MpmGrid(cellSize=cellSize)
	O.bodies.append(mpm.fill(region, grid, 2, 'soil'))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=boundaries, loads=loads, loadCurve=[(0, 1), (1, 1)], flow=MpmFlow(drains=drains, stabilisation=options.stabilisation), verbosity=0)]
	return O.engines[0]


def run(times, look):
	"""Steps that end at these times [s]; look(time) after each."""
	begin, O.dt = 0, 1
	for end in times:
		O.dt = end - begin
		O.step()
		solves.append(O.engines[0].iterations)
		look(end)
		begin = end


def growing(end):
	"""Times that grow with the square of the number of the step."""
	return end * (np.arange(1, options.steps + 1) / options.steps)**2


def column(q, skin=options.skin, **soil):
	h = 1 / (options.cells + options.cut)
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(h, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	top = [(h, 1), (0, 1)]
	return scene(mpm.polygon([(0, 0), (h, 0), (h, 1), (0, 1)]), h, sides, [MpmDrain(surface=top, conductance=skin)], [MpmTraction(surface=top, traction=(0, -q, 0))], **soil)


def settlement(solver):
	return 1 - solver.flow.drains[0].surface.vertices[0][1]


def terzaghi():
	q = 1e-3 * E
	solver = column(q)
	degrees, profiles = [], {}

	def look(now):
		T = now * kappa * E
		degrees.append((T, settlement(solver) / (q / E), 1 - (2 / odd**2 * np.exp(-odd**2 * T)).sum()))
		points = mpm.arrays()
		profiles[T] = points['pos'][:, 1], points['excessPressure'] / q

	run(growing(1 / (kappa * E)), look)
	worst = max(abs(found - exact) for T, found, exact in degrees if T > 0.02)
	global error  # for scripts/trade
	error = max(abs(found / exact - 1) for T, found, exact in degrees if T > 0.02)
	print(f'terzaghi: degree of consolidation within {worst:.4f} of the series from T = 0.02 on')
	for time in .05, .2, .5:
		T, found, exact = min(degrees, key=lambda degree: abs(degree[0] - time))
		compared(f'degree of consolidation at T = {T:.3g}', found, exact, 'Terzaghi 1923')
	data = solver.plotData()
	print(f"terzaghi: {data['waterOut'] * 1e6:.6f} cm3 of water have left, the soil has lost {-data['waterStored'] * 1e6:.6f}")
	return profiles


def large():
	solver = column(0.2 * E, 100, conductivityLaw='kozeny-carman')
	curve = []
	run(growing(1 / (kappa * E)), lambda now: curve.append((now * kappa * E, settlement(solver))))
	T, found = np.array(curve).T
	known = {.05: .038627, .2: .077177, .5: .117142, 1.: .143536}  # results of a finer method for the equation in one dimension
	for time, exact in known.items():
		there = np.interp(time, T, found)
		print(f'large: settlement {there:.5f} of the height at T = {time}, {100 * (there / exact - 1):+.2f} %')
		compared(f'settlement over height at large strain, T = {time:g}', there, exact, 'finer method in one dimension')
	return T, found, known


def mandelRoots(nu):
	"""tan r = 2 (1 - nu) / (1 - 2 nu) r, which is Mandel's equation for water that keeps its volume."""
	f = lambda r: np.sin(r) * (.5 - nu) - r * np.cos(r) * (1 - nu)
	low = np.pi * np.arange(200) + np.where(np.arange(200) == 0, .1, 1e-6)
	high = np.pi * (np.arange(200) + .5) - 1e-9
	for _ in range(100):
		middle = (low + high) / 2
		isSame = f(low) * f(middle) > 0
		low, high = np.where(isSame, middle, low), np.where(isSame, high, middle)
	return low


def mandel():
	nu, F = .2, 1e-3 * E
	G = E / 2 / (1 + nu)
	cv = kappa * 2 * G * (1 - nu) / (1 - 2 * nu)
	r = mandelRoots(nu)
	h = 1 / (options.cells // 2 + options.cut)
	height = 3 * h
	part = lambda T, top: (top / (r - np.sin(r) * np.cos(r)) * np.exp(-r * r * T)).sum()
	plate = lambda T: -F * height * ((1 - nu) / (2 * G) - .5 / G * part(T, np.sin(r) * np.cos(r)))
	middle = lambda T: part(T, np.sin(r) * (1 - np.cos(r)))
	times = growing(.3 / cv)
	last = plate(times[-1] * cv)
	moved = MpmBoundary(min=(-inf, height, -inf), fix='y', displacement=(0, last, 0), curve=[(0, 0)] + [(t, plate(t * cv) / last) for t in times])
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y'), moved]
	solver = scene(mpm.polygon([(0, 0), (1, 0), (1, height), (0, height)]), h, sides, [MpmDrain(surface=[(1, 0), (1, height)])], poisson=nu)
	curve = []

	def look(now):
		points = mpm.arrays()
		inMiddle = points['excessPressure'][points['pos'][:, 0] < .6 * h].mean() / F
		curve.append((now * cv, inMiddle, middle(now * cv), -solver.reactions[2][1] / F))

	run(times, look)
	curve = np.array(curve)
	late = curve[:, 0] > .01
	print(f'mandel: pressure in the middle within {abs(curve[late, 1] - curve[late, 2]).max():.4f} F/a of the series, its peak {curve[:, 1].max():.4f}, series {curve[:, 2].max():.4f}')
	compared("peak of the pressure in the middle of Mandel's slab", curve[:, 1].max(), curve[:, 2].max(), 'Mandel 1953', 'F/a')
	print(f'mandel: force on the plate within {100 * abs(curve[late, 3] - 1).max():.2f} % of F')
	return curve


def strip():
	W, D, h = 8., 4., .25
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(W, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	q = 20e3
	load = MpmTraction(surface=[(1, D), (0, D)], traction=(0, -q, 0))
	solver = scene(mpm.polygon([(0, 0), (W, 0), (W, D), (0, D)]), h, sides, [MpmDrain(surface=[(W, D), (0, D)])], [load], poisson=.3)
	curve = []
	cv = kappa * E * .7 / (1.3 * .4)
	times = growing(10 / cv)
	first = {}

	def keep(now):
		curve.append((now * cv, D - load.surface.vertices[-1][1]))
		if len(curve) == 1: first['points'] = mpm.arrays()

	run(times, keep)
	points = first['points']
	print(f"strip: at first the pressure under the load is {points['excessPressure'].max() / q:.3f} q; the settlement grows from {curve[0][1] * 1e3:.1f} to {curve[-1][1] * 1e3:.1f} mm")
	return np.array(curve), points, q


def picture(profiles, largeCurve, mandelCurve, stripResult):
	figure, axes = plt.subplots(2, 2, figsize=(12, 8.4))
	y = np.linspace(0, 1, 201)
	for T in list(profiles)[options.steps // 8::options.steps // 8]:
		place, p = profiles[T]
		order = np.argsort(place)
		exact = sum(2 / m * np.sin(m * (1 - y)) * np.exp(-m * m * T) for m in odd)
		axes[0, 0].plot(exact, y, color='grey', linewidth=.8)
		axes[0, 0].plot(p[order], place[order], '.', markersize=4, label=f'T = {T:.2g}')
	axes[0, 0].set(xlabel='excess pressure / load [-]', ylabel='height / first height [-]', title='Terzaghi: points, and series')
	axes[0, 0].legend()
	T, found, known = largeCurve
	axes[0, 1].plot(T, found, label='MPM')
	axes[0, 1].plot(list(known), list(known.values()), 'o', label='finer method in one dimension')
	axes[0, 1].set(xlabel='time factor T [-]', ylabel='settlement / height [-]', title='Load of a fifth of the stiffness')
	axes[0, 1].legend()
	axes[1, 0].plot(mandelCurve[:, 0], mandelCurve[:, 1], 'o', markersize=4, label='centre of the slab')
	axes[1, 0].plot(mandelCurve[:, 0], mandelCurve[:, 2], color='grey', linewidth=.8, label='series')
	axes[1, 0].set(xlabel='time factor T [-]', ylabel='excess pressure / (F/a) [-]', title='Mandel')
	axes[1, 0].legend()
	curve, points, q = stripResult
	drawn = axes[1, 1].scatter(*points['pos'][:, :2].T, c=points['excessPressure'] / q, s=9, marker='s')
	figure.colorbar(drawn, ax=axes[1, 1], label='excess pressure / load [-]', shrink=.7)
	axes[1, 1].set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title='Strip load (0 to 1 m), after the first step')
	figure.tight_layout()
	figure.savefig(os.path.join(options.out, 'consolidation.png'), dpi=100)


begin = time.time()
scenes = dict(terzaghi=terzaghi, large=large, mandel=mandel, strip=strip)
results = {name: compute() for name, compute in scenes.items() if options.scene in ('all', name)}
if options.scene == 'all': picture(*results.values())
print(f'{time.time() - begin:.1f} s')
