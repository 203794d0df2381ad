#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Water in soil that is not saturated, against what is known.

	front  a wetting front in a column of dry sand (Celia, Bouloutas and Zarba 1990): where it is after a day
	rain   a column above a water table, on which it begins to rain harder (Srivastava and Yeh 1991): heads by a closed form
	layers two layers under the same rain, the upper one ten times as permeable: heads by a closed form
	slope  an infinite slope with steady infiltration (Lu and Godt 2008): the factor of safety from the stresses of elastic soil
	failure  an infinite slope on rock that fails after days of rain: factor of safety against time, and when, beside limit equilibrium with Richards' equation along the normal
	rest   hydrostatic suction, at several cuts of the cells: how far heads go from it
	dry    a front that goes into dry sand on cells of 0.1 m: how far saturation goes beyond its bounds

Run it with `scripts/run examples/rain/rain.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path[:0] = os.path.dirname(sys.argv[0]), os.path.join(os.path.dirname(sys.argv[0]), '..')
from options import compared, readOptions
from style import plt
from volumes import Section, Soil, vanGenuchten

options = readOptions('Rain and suction.',
        scene=('all', "'all', or one of 'front', 'rain', 'layers', 'slope', 'failure', 'rest' and 'dry'"),
        cells=(80, 'over the height of the columns and of the slope'),
        cut=(0.5, 'part of a cell that soil fills where the surface cuts one'),
        longest=(0.005, 'longest step, over the time of the scene'))
weight, stiff = 9810., 1e9  # of water [N/m3]; Young's modulus of soil that hardly moves [Pa]
solves = []  # solves of all steps, for scripts/trade


def scene(height, gravity, pressure, drains, upper=None, law=MpmElasticMat, **soil):
	"""One cell wide, y along the normal of the ground. `pressure`: as it begins, a function of y. `upper`: what is different of an upper layer of the same thickness."""
	O.reset()
	for label, own in ('soil', {}), ('upper', upper or {}):
		O.materials.append(law(young=stiff, poisson=0.3, density=19e3 / 9.81, label=label, **(soil | own)))
	h = height / ((2 if upper else 1) * options.cells + options.cut)
	grid = MpmGrid(cellSize=h, period=(3 * h, 0, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3 * h, 0), (3 * h, height), (0, height)]), grid, 2, lambda x: 'upper' if x[1] > height / 2 else 'soil'))
	mpm.assign(excessPressure=[pressure(y) for y in mpm.arrays()['pos'][:, 1]])
	top, base = [(3 * h, height), (0, height)], [(0, 0), (3 * h, 0)]
	flow = MpmFlow(total=True, drains=[MpmDrain(surface=surface, conductance=300, **given) for surface, given in zip((top, base), drains) if given])
	O.engines = [MpmImplicitEngine(grid=grid, gravity=gravity, boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], flow=flow, newton=MpmNewton(tolerance=1e-9), loadCurve=[(0, 1), (1, 1)], verbosity=0)]
	return O.engines[0]


def advance(end, first, longest):
	"""Steps that grow by a fifth up to `longest`, until O.time is `end`; returns water in, less water out, less what is stored, over all that came in."""
	O.dt = first
	while O.time < end * (1 - 1e-9):
		O.dt = min(O.dt, end - O.time)
		O.step()
		solves.append(O.engines[0].iterations)
		O.dt = min(1.2 * O.dt, longest)
	flow = O.engines[0].flow
	return abs(flow.waterIn - flow.waterOut - flow.waterStored) / max(flow.waterIn, 1e-30)


def profile(name='excessPressure'):
	"""Heights, and the mean of the points there."""
	points = mpm.arrays()
	y, value = points['pos'][:, 1], points[name]
	heights = np.unique(y.round(9))
	return heights, np.array([value[abs(y - height) < 1e-6].mean(axis=0) for height in heights])


def below(axes):
	"""Legend under the axes, where it covers no curve."""
	axes.legend(loc='upper center', bbox_to_anchor=(0.5, -0.16), ncols=3, frameon=False)


def front(axes):
	sand = MpmVanGenuchten(alpha=3.35, n=2, residual=.102 / .368)
	scene(1, (0, -9.81, 0), lambda y: -10 * weight, (dict(pressure=-.75 * weight), dict(pressure=-10 * weight)), conductivity=9.22e-5, porosity=.368, retention=sand)
	for hours in 1, 6, 24:
		lost = advance(hours * 3600, 20, options.longest * 86400)
		z, p = profile()
		axes.plot(p / weight, z, label=f'{hours} h')
	depth = 1 - np.interp(-5, p / weight, z)
	print(f'front: {depth:.4f} m below the top after 24 h, {100 * (depth / .5651 - 1):+.2f} % of 800 finite volumes; water lost {lost:.1e}')
	compared('depth of the wetting front (psi = -5 m) after 24 h', depth, .5651, 'finite volumes, case of Celia and others 1990', 'm')
	axes.set(title='wetting front in dry sand', xlabel='head [m]', ylabel='height [m]')
	below(axes)


def layered(z, time, alpha, conductivities, content, thickness, before, after):
	"""Heads [m] at heights z of two layers that are equally thick, of exponential soil, with a water table at the base. The flux through the top [m/s] changes from `before` to `after` at time zero.

	W = exp(alpha psi) has a linear equation (Srivastava and Yeh 1991), which is solved for its Laplace transform, and that is inverted along Talbot's contour (Abate and Valko 2004).
	"""
	lower = z < thickness

	def steady(flux):
		low, up = (flux / k for k in conductivities)
		between = low + (1 - low) * np.exp(-alpha * thickness)
		return np.where(lower, low + (1 - low) * np.exp(-alpha * z), up + (between - up) * np.exp(-alpha * (z - thickness)))

	def grown(s):
		"""Transform of what W grows: sinh in the lower layer; cosh and sinh in the upper one, by W and flux at the interface."""
		first, second = (np.sqrt(alpha**2 / 4 + alpha * content / k * s) for k in conductivities)
		sinh, cosh, fall = np.sinh(first * thickness), np.cosh(first * thickness), np.exp(-alpha * thickness / 2)
		a, x = fall * sinh, z - thickness
		b = (conductivities[0] / conductivities[1] * fall * (first * cosh / alpha + sinh / 2) - a / 2) * alpha / second
		sinh, cosh = np.sinh(second * thickness), np.cosh(second * thickness)
		top = conductivities[1] * fall * (second / alpha * (a * sinh + b * cosh) + (a * cosh + b * sinh) / 2)
		found = np.where(lower, np.exp(-alpha * z / 2) * np.sinh(first * z), np.exp(-alpha * x / 2) * (a * np.cosh(second * x) + b * np.sinh(second * x)))
		return (after - before) / s / top * found

	if time == 0: return np.log(steady(before)) / alpha
	terms = 24
	r, angles = 2 * terms / (5 * time), np.pi / terms * np.arange(1, terms)
	total = .5 * np.exp(r * time) * grown(r + 0j).real
	for angle in angles:
		s, slope = r * angle * (1 / np.tan(angle) + 1j), angle + (angle / np.tan(angle) - 1) / np.tan(angle)
		total += (np.exp(s * time) * (1 + 1j * slope) * grown(s)).real
	return np.log(steady(before) + r / terms * total) / alpha


def column(axes, name, height, K, upper=None):
	"""Rain on exponential soil above a water table, a tenth of the conductivity of the lower layer and then nine tenths: heads at six times against the closed form."""
	alpha, flux = 10, (.1 * K[0], .9 * K[0])
	form = lambda z, time: layered(z, time, alpha, K, .34, height / 2, *flux)
	soil = dict(conductivity=K[0], porosity=.4, retention=MpmGardner(alpha=alpha, residual=.06 / .4), upper=upper)
	solver = scene(height, (0, -9.81, 0), lambda y: weight * form(np.array([y]), 0)[0], (dict(rain=flux[0]), dict(pressure=0)), **soil)
	advance(1e9, 100, 1e9)
	begin, worst, at = O.time, 0, .8 * height
	span = np.ptp(form(profile()[0], 0))
	solver.flow.drains[0].rain = flux[1]
	for hours in 1, 2, 5, 10, 20, 50:
		advance(begin + hours * 3600, 20, 4 * options.longest * hours * 3600)
		z, p = profile()
		heads = form(z, hours * 3600.)
		worst = max(worst, abs(p / weight - heads).max())
		compared(f'head {at:g} m above the water table{" in layers" if upper else ""} after {hours} h of rain', np.interp(at, z, p / weight), np.interp(at, z, heads), 'Srivastava and Yeh 1991', 'm')
		axes.plot(p / weight, z, label=f'{hours} h')
		axes.plot(heads[::len(z) // 20], z[::len(z) // 20], 'ko', ms=2)
	global error  # for scripts/trade
	error = worst / span
	print(f'{name}: heads within {worst * 1e3:.2f} mm of the closed form, {100 * worst / span:.2f} % of their range')
	axes.set(title=f'{name}, dots: closed form', xlabel='head [m]')
	below(axes)


def rain(axes):
	column(axes, 'rain', 1, (.01 / 3600, .01 / 3600))


def layers(axes):
	column(axes, 'layers', 2, (.01 / 3600, .1 / 3600), upper=dict(conductivity=.1 / 3600))


def slope(axes):
	beta, phi, H = np.radians(45), np.radians(30), 5.
	soil = dict(conductivity=1e-6, porosity=.002, retention=MpmVanGenuchten(alpha=1e-5 * weight, n=2, permeability='gardner'))
	expected = {0.: (1.01973, 1.74742), 3e-8: (1.00575, 1.71013), 3e-7: (.88177, 1.37975)}
	for q, exact in expected.items():
		scene(H * np.cos(beta), (9.81 * np.sin(beta), -9.81 * np.cos(beta), 0), lambda y: -weight * np.cos(beta) * y, (dict(rain=q * np.cos(beta)), dict(pressure=0)), **soil)
		for _ in range(4):
			O.dt = 1e9
			O.step()
		y, stress = profile('stress')
		F = -np.tan(phi) * stress[:, 1, 1] / abs(stress[:, 0, 1])
		cells = slice(0, 2 * (len(F) // 2))  # both points of a cell have its stress: means over cells
		axes.plot(F[cells].reshape(-1, 2).mean(axis=1), y[cells].reshape(-1, 2).mean(axis=1) / np.cos(beta), label=f'{q:g} m/s')
		for z, theirs in zip((3, 4), exact):
			normal, shear = (np.interp(z * np.cos(beta), y, part) for part in (stress[:, 1, 1], stress[:, 0, 1]))
			ours = -np.tan(phi) * normal / abs(shear)
			print(f'slope: F = {ours:.5f} at {z} m with {q:g} m/s of rain, {100 * (ours / theirs - 1):+.2f} %')
			compared(f'factor of safety of an infinite slope {z} m above the water table, infiltration {q:g} m/s', ours, theirs, 'Lu and Godt 2008')
		axes.plot(exact, (3, 4), 'ko', ms=3)
	axes.set(title='infinite slope, dots: closed form', xlabel='factor of safety', ylabel='height above the water table [m]', xlim=(0.5, 3))
	below(axes)


def failure(axes):
	"""2 m along the normal, with a head of -1 m at the rock, which lets no water through. Limit equilibrium has the suction stress and the weight of the water that is there."""
	beta, phi, cohesion, H, K, porosity, q, head = np.radians(40), np.radians(35), 2e3, 2., 1e-6, .4, 5e-7, -1.
	saturation, permeability = vanGenuchten(1., 2.)
	section = Section((1, 200), (1, H), Soil(K, porosity, saturation, permeability), fall=np.cos(beta))
	section.rain[:] = q * np.cos(beta)

	steep = np.arcsin(np.tan(phi))  # without dilation soil bears tan(phi) = sin(steep) in simple shear (Davis 1968); with it water that is drawn in would delay the failure

	def factor(h):
		"""Of c' = cohesion / cos(steep) and tan(steep), which strength reduction divides."""
		S = saturation(h)[0]
		weights = (19e3 - porosity * (1 - S) * weight) * section.dz
		above = np.cumsum(weights[::-1])[::-1] - weights / 2
		normal, shear, low, high = np.cos(beta) * above - weight * np.where(h < 0, S, 1) * h, np.sin(beta) * above, 0.1, 10.
		while high - low > 1e-6:
			F = (low + high) / 2
			angle = np.arctan(np.tan(steep) / F)
			stands = (cohesion / np.cos(steep) / F * np.cos(angle) + normal * np.sin(angle) >= shear).all()
			low, high = (F, high) if stands else (low, F)
		return low

	hours = np.arange(0, 301, 2.)
	start = head - section.z[None] * np.cos(beta)
	factors = [factor(h[0]) for h in section.run(start, hours * 3600, 3600)]
	expected = np.interp(-1, -np.array(factors), hours)
	soil = dict(conductivity=K, porosity=porosity, retention=MpmVanGenuchten(alpha=1, n=2), cohesion=cohesion / np.cos(steep), frictionAngle=steep, dilationAngle=0)
	scene(H, (9.81 * np.sin(beta), -9.81 * np.cos(beta), 0), lambda y: weight * (head - y * np.cos(beta)), (dict(rain=q * np.cos(beta)), None), law=MpmMohrCoulombMat, **soil)
	O.engines[0].newton.tolerance = 1e-6
	O.dt = .02 * expected * 3600
	found = mpm.safetyInTime([part * expected * 3600 for part in (.02, .2, .4, .6, .8, .9)])
	off = 0
	for seconds, F in zip(found['time'], found['factor']):
		exact = np.interp(seconds / 3600, hours, factors)
		off = max(off, abs(F / exact - 1))
		compared(f'factor of safety of an infinite slope after {seconds / 3600:.0f} h of rain', F, exact, "limit equilibrium with Richards' equation by finite volumes")
	O.dt = .0025 * expected * 3600
	last = mpm.safetyInTime([1.5 * expected * 3600])
	failed = last['failureTime'] / 3600
	print(f'failure: F within {100 * off:.1f} % of limit equilibrium; after {failed:.1f} h of rain, by limit equilibrium {expected:.1f} h, {100 * (failed / expected - 1):+.2f} %')
	compared('time to failure of an infinite slope under rain', failed, expected, "limit equilibrium with Richards' equation by finite volumes", 'h')
	axes.plot(hours, factors, label='limit equilibrium')
	axes.plot(found['time'] / 3600, found['factor'], 'ko', ms=3, label='reduction')
	axes.axvline(failed, color='k', ls='--', lw=1, label='fails')
	axes.set(title='infinite slope under rain', xlabel='time [h]', ylabel='factor of safety', ylim=(0.9, 1.3))
	axes.legend(loc='lower left', frameon=False)


def rest():
	sand, found = MpmVanGenuchten(alpha=3.35, n=2, residual=.102 / .368), []
	for options.cut in .9, .5, 1e-3, 1e-6:
		scene(1, (0, -9.81, 0), lambda y: weight * (.3 - y), (None, dict(pressure=.3 * weight)), conductivity=1e-5, porosity=.4, retention=sand)
		O.engines[0].newton.tolerance = 1e-12
		O.dt = 1e9
		for step in range(3):
			O.step()
		points = mpm.arrays()
		found.append(abs(points['excessPressure'] / weight + points['pos'][:, 1] - .3).max())
	print(f'rest: heads within {max(found):.1e} m of hydrostatic ones, cuts from 0.9 to 1e-6 of a cell')


def dry():
	options.cells, options.cut = 20, .3
	scene(2.03, (0, -9.81, 0), lambda y: -10 * weight, (dict(pressure=0), None), conductivity=1e-4, porosity=.38, retention=MpmVanGenuchten(alpha=3.5, n=3, residual=.02 / .38))
	solver, least, most = O.engines[0], 1., 0.
	solver.newton.minStep = 1 / 4096
	O.dt = 1
	O.step()
	first = .02 / .38 + (1 - .02 / .38) * (1 + 35**3)**(-2 / 3)
	while O.time < 3600:
		O.dt = min(1.2 * O.dt, 30)
		O.step()
		S = mpm.arrays()['saturation']
		least, most = min(least, S.min()), max(most, S.max())
	print(f'dry: saturation no more than {max(first - least, 0):.1e} below that of the dry sand, and {max(most - 1, 0):.1e} above one, on cells of {solver.grid.cellSize:.1f} m')


begin = time.time()
checks = dict(rest=rest, dry=dry)  # without a picture
scenes = dict(front=front, rain=rain, layers=layers, slope=slope, failure=failure)
if options.scene not in ('all', *scenes, *checks): sys.exit(f"--scene {options.scene} is not admitted: give one of {', '.join(['all', *scenes, *checks])}.")
chosen = scenes if options.scene == 'all' else [options.scene] if options.scene in scenes else []
for name in checks if options.scene == 'all' else [options.scene] if options.scene in checks else []:
	whole = options.cells, options.cut
	checks[name]()
	options.cells, options.cut = whole
if not chosen: sys.exit()
rows = 2 if len(chosen) > 3 else 1
figure, axes = plt.subplots(rows, (len(chosen) + rows - 1) // rows, figsize=(4.6 * len(chosen) / rows, 4.6 * rows), layout='constrained', squeeze=False)
for ax in axes.flat[len(chosen):]: ax.remove()
for name, ax in zip(chosen, axes.flat):
	scenes[name](ax)
figure.savefig(os.path.join(options.out, 'rain.png'), dpi=110)
print(f'{time.time() - begin:.0f} s')
