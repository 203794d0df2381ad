# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of a law from the curves of laboratory tests, with how well they are known."""
import math
from types import SimpleNamespace

import numpy as np

from ..base.messages import brief, isNumber, pathOf
from ..base.naming import didYouMean
from ..output.plotting import write
from . import tests as laboratory
from .readings import stresses, testsOf

finest = 1e-4  # step of differences, over the width of the bounds
sameUse = 1 / math.sqrt(12)  # standard deviation, over the width of the bounds, of what is anywhere between them


def calibrate(material, tests, bounds, steps=50, samples=None, fileName=None):
	"""Parameters of a law by least squares from the curves of any number of laboratory tests. Needs SciPy (python3-scipy). ::

		sand = MpmMohrCoulombMat(poisson=0.3, density=2000, cohesion=0)
		tests = [dict(kind='triaxial', confiningPressure=p, axialStrain=strain, q=q, volumetricStrain=volume) for p, strain, q, volume in readings]
		fit = mpm.calibrate(sand, tests, dict(young=(5e6, 500e6), frictionAngle=(0.3, 0.8), dilationAngle=(0, 0.3)), fileName='fit.png')
		print(fit['report'])
		O.materials.append(fit['material'])

	A test is a dict of its ``kind`` and its state at first as in :func:`elementTest` (``confiningPressure`` or ``initialStress`` [Pa], ``internals``, a dict), and of
	readings, arrays of one length N: the strain that is driven, ``axialStrain`` or for simpleShear ``shearStrain`` [-], logarithmic and negative in compression,
	which may turn back; and any of ``q``, ``p``, ``stress_xx``, ``stress_yy``, ``stress_zz``, ``stress_xy`` [Pa] (Cauchy's, positive in tension) and
	``volumetricStrain`` [-] that the kind does not prescribe. Besides it may have a ``name`` and a ``weight`` > 0, or a dict of weights of its curves.
	A curve of a sample of grains is a test like others.

	The sum over all curves of (weight x misfit)^2 becomes least; the misfit of a curve is the root mean square of its differences, over its largest reading.
	The search begins at the best three of several points between the bounds, the material's own values among them where they lie there, and goes on with derivatives by
	differences. Values that the law or a test refuses are not gone to. Numbers are looked for by their logarithm where bounds are > 0 and apart by more than a factor of ten.

	Uncertainties come from the derivatives of all readings and from the scatter of each curve about the fit, as if readings erred independently. Where the law cannot follow a
	curve, the difference is no scatter: they are then too small, as the picture shows.

	:param material: material of the plugin, or the label of one in O.materials, which stays as it is; what is fitted need not be given
	:param tests: list of such dicts, not empty
	:param bounds: dict of (least, largest) admitted value by the name of each parameter that is looked for, in its unit
	:param steps: number of steps > 0 in which the laws go through the range of strain of a test, an integer; there are steps to each reading besides
	:param samples: number of points >= 0 at which the search may begin besides the material's own values, an integer; 8 for each parameter
	:param fileName: draw readings and the fit to this file, as :func:`plot` does
	:return: dict of ``material``, one of the same class with the values found; ``values``, and ``uncertainty``, the standard deviation, by name, in the unit of each, inf where
		it is not determined, and nan where a curve has no more readings than the fit needs of it; ``covariance`` (P, P) in the order of *bounds*, of what is determined; ``undetermined``, names of the parameters that the tests do not determine, by
		themselves or together with others, or no better than the bounds do; ``atBounds``, names of those at a bound, where a misfit beyond it may be less; ``beside``, what was refused next to the
		values found, or ''; ``misfit``, for each test a dict of the misfit [-] by curve; ``total``, their root mean square [-]; ``curves``, the computed curve of each test at its
		readings; ``evaluations``, how many times all tests were computed; and ``report``, all this in words.
	:raises TypeError: *material* is no material of the plugin, or a value is no number or has another type.
	:raises ValueError: no tests; a parameter or curve that there is not; a curve that the kind prescribes; readings that are not finite, or not as many as strains; bounds in the wrong
		order; fewer readings than parameters; values that are refused everywhere between the bounds.
	:raises RuntimeError: the search has not ended.
	:raises ImportError: SciPy is not installed.
	:raises OSError: the file cannot be written.
	"""
	who = 'calibrate'
	leastSquares = _leastSquares(who)
	if fileName is not None: pathOf(who, 'fileName', fileName)
	material = laboratory.materialFor(who, material)
	parameters = _parameters(who, material, bounds)
	steps = _count(who, 'steps', steps, 1)
	samples = 8 * len(parameters) if samples is None else _count(who, 'samples', samples, 0)
	problem = SimpleNamespace(who=who, material=material, parameters=parameters, tests=testsOf(who, tests, steps), evaluations=0, refusal='')
	readings = sum(len(curve.values) for test in problem.tests for curve in test.curves)
	if readings < len(parameters): raise ValueError(f'{who}: {readings} readings are fewer than the {len(parameters)} parameters of bounds')
	z = _search(problem, leastSquares, _starts(problem, samples), readings)
	fit = _result(problem, z)
	if fileName is not None: _draw(problem, fit, fileName)
	return fit


def _leastSquares(who):
	try:
		from scipy.optimize import least_squares
	except ImportError:
		raise ImportError(f'{who}: SciPy is not installed; it is the package python3-scipy (apt install python3-scipy)') from None
	return least_squares


def _count(who, name, value, least):
	if isinstance(value, bool) or not isinstance(value, (int, np.integer)): raise TypeError(f'{who}: {name} = {brief(value)} must be an integer')
	if value < least: raise ValueError(f'{who}: {name} = {value} must be >= {least}')
	return int(value)


def _parameters(who, material, bounds):
	"""Parameters to look for: names and bounds."""
	if not isinstance(bounds, dict): raise TypeError(f'{who}: bounds = {brief(bounds)} must be a dict, as dict(young=(1e6, 1e8))')
	if not bounds: raise ValueError(f'{who}: bounds = {{}} names no parameter to look for')
	known = [name for name, value in material.dict().items() if isinstance(value, float) and name != 'density']
	for name, pair in bounds.items():
		if name == 'density': raise ValueError(f'{who}: density has no effect on tests of one point; it must be measured')
		if name not in known: raise ValueError(f"{who}: {brief(name)} is no parameter of {type(material).__name__}{didYouMean(name, known) or ';'} there are {', '.join(known)}")
		if not (isinstance(pair, (tuple, list, np.ndarray)) and len(pair) == 2 and all(map(isNumber, pair))):
			raise TypeError(f'{who}: bounds[{name!r}] = {brief(pair)} must be two numbers, the least and the largest')
		if not all(map(math.isfinite, pair)): raise ValueError(f'{who}: bounds[{name!r}] = {brief(pair)} must be finite')
		if not pair[0] < pair[1]: raise ValueError(f'{who}: bounds[{name!r}] = {brief(pair)} must be the least value and then the largest')
	return [SimpleNamespace(name=name, low=float(low), high=float(high), byLogarithm=low > 0 and high > 10 * low) for name, (low, high) in bounds.items()]


def _valuesAt(problem, z):
	"""Values of the parameters, at numbers from 0 to 1."""
	return [p.low * (p.high / p.low)**at if p.byLogarithm else p.low + (p.high - p.low) * at for p, at in zip(problem.parameters, z)]


def _told(problem, z):
	return ', '.join(f'{p.name} = {value:.6g}' for p, value in zip(problem.parameters, _valuesAt(problem, z)))


def _materialAt(problem, z):
	given = {name: value for name, value in problem.material.dict().items() if name != 'id'}
	return type(problem.material)(**given | {p.name: float(value) for p, value in zip(problem.parameters, _valuesAt(problem, z))})


def _curvesAt(problem, z):
	"""The computed curve of each test at its readings."""
	problem.evaluations += 1
	material, curves = _materialAt(problem, z), []
	for test in problem.tests:
		curve = laboratory.curveAt(test.name, material, test.kind, test.path, internals=test.internals, patience=5, **test.first)
		components = {name: curve['stress'][:, 'xyz'.index(name[-2]), 'xyz'.index(name[-1])] for name in stresses}
		known = {'p': curve['p'], 'q': curve['q'], 'volumetricStrain': curve['volumetricStrain']} | components
		curves.append({test.driven: test.strains} | {one.name: known[one.name][test.at] for one in test.curves})
	return curves


def _residuals(problem, z):
	"""Differences of all readings, each curve with its weight; None where the law or a test refuses the values."""
	try:
		curves = _curvesAt(problem, z)
	except (ValueError, RuntimeError) as error:
		problem.refusal = f'{_told(problem, z)}: {error}'
		return None
	return np.concatenate([one.factor * (curve[one.name] - one.values) for test, curve in zip(problem.tests, curves) for one in test.curves])


def _finite(residuals, count):
	"""Residuals that the search takes as a step too far, instead of those that there are not."""
	return np.full(count, np.inf) if residuals is None else residuals


def _starts(problem, samples):
	"""The best three of the material's own values, and of points that fill the bounds evenly (Halton's sequence), which are refused nowhere."""
	from scipy.stats.qmc import Halton
	candidates = Halton(len(problem.parameters), scramble=False).random(samples + 1)[1:].tolist()
	own = [_placeOf(p, getattr(problem.material, p.name)) for p in problem.parameters]
	middle = [0.5 if at is None else at for at in own]
	found = []
	for z in [middle, *candidates]:
		residuals = _residuals(problem, z)
		if residuals is not None: found.append((residuals @ residuals, z))
	if not found: raise ValueError(f'{problem.who}: no values between the bounds are admitted, of {1 + samples} that were tried; the last: {problem.refusal}')
	return [np.array(z) for _, z in sorted(found)[:3]]


def _placeOf(p, value):
	"""From 0 to 1; None if the value is not between the bounds."""
	if not p.low < value < p.high: return None
	return math.log(value / p.low) / math.log(p.high / p.low) if p.byLogarithm else (value - p.low) / (p.high - p.low)


def _search(problem, leastSquares, starts, readings):
	"""From the best of some points to the least squares: by wide differences first, which see beyond the jumps of the gradient that each reading has where the soil begins to yield."""

	def solved(z, span, tolerance, most):
		return leastSquares(
		        lambda z: _finite(_residuals(problem, z), readings), z, jac=lambda z: _slopes(problem, z, span)[0], bounds=(0, 1), xtol=1e-8, ftol=tolerance, gtol=1e-13, max_nfev=most
		)

	found = min((solved(z, 3e-2, 1e-2, 15) for z in starts), key=lambda found: found.cost)
	for span, tolerance, most in (3e-3, 1e-3, 20), (finest, 1e-6, 100):
		found = solved(found.x, span, tolerance, most)
	if not found.success: raise RuntimeError(f'{problem.who}: the search has not ended after {most} steps, at {_told(problem, found.x)}; narrower bounds may help')
	return found.x


def _slopes(problem, z, span):
	"""Derivatives of the residuals by differences, to one side at a bound or beside refused values, and what was refused."""
	columns, refused = [], ''
	middle = _residuals(problem, z)
	for i, p in enumerate(problem.parameters):
		sides = []
		for to in min(z[i] + span, 1), max(z[i] - span, 0):
			moved = np.array(z, float)
			moved[i] = to
			residuals = _residuals(problem, moved) if to != z[i] else None
			if to != z[i] and residuals is None: refused = problem.refusal
			sides.append((z[i], middle) if residuals is None else (to, residuals))
		(up, above), (down, below) = sides
		if up == down: raise RuntimeError(f'{problem.who}: {p.name} can be neither more nor less: {problem.refusal}')
		columns.append((above - below) / (up - down))
	return np.transpose(columns), refused


def _result(problem, z):
	slopes, refused = _slopes(problem, z, finest)
	covariance, isOpen = _covariance(problem, slopes, _residuals(problem, z))
	values = _valuesAt(problem, z)
	rates = np.array([value * math.log(p.high / p.low) if p.byLogarithm else p.high - p.low for p, value in zip(problem.parameters, values)])
	spread = np.sqrt(np.diag(covariance))
	names = [p.name for p in problem.parameters]
	fit = dict(material=_materialAt(problem, z), values=dict(zip(names, map(float, values))))
	fit['uncertainty'] = {name: math.inf if o else float(s * rate) for name, o, s, rate in zip(names, isOpen, spread, rates)}
	fit['covariance'] = covariance * rates[:, None] * rates
	fit['undetermined'] = [name for name, o, s in zip(names, isOpen, spread) if o or s >= sameUse]
	fit['atBounds'] = [name for name, at in zip(names, z) if min(at, 1 - at) < 1e-3]
	fit['beside'] = refused
	fit['curves'] = _curvesAt(problem, z)
	fit['misfit'] = [{one.name: float(_rms(curve[one.name] - one.values) / one.scale) for one in test.curves} for test, curve in zip(problem.tests, fit['curves'])]
	fit['total'] = float(_rms([value for misfits in fit['misfit'] for value in misfits.values()]))
	fit['evaluations'] = problem.evaluations
	fit['report'] = _report(problem, fit)
	return fit


def _rms(values):
	return math.sqrt(np.mean(np.square(values)))


def _covariance(problem, slopes, residuals):
	"""Covariance of the numbers from 0 to 1, from the Jacobian and the scatter of each curve; and which parameters lie in directions in which nothing changes.

	Such directions are known to the round-off of the tests over the span of the differences.
	"""
	_, sizes, directions = np.linalg.svd(slopes, full_matrices=False)
	isNull = sizes <= 1e-5 * max(sizes[0], 1e-300)
	isOpen = (np.abs(directions[isNull]) > 1e-3).any(axis=0)
	inverse = (directions[~isNull].T / sizes[~isNull]**2) @ directions[~isNull]
	taken = np.einsum('ni,ij,nj->n', slopes, inverse, slopes)  # part of the freedom of each reading that the fit takes
	variances, row = np.zeros(len(residuals)), 0
	for one in [one for test in problem.tests for one in test.curves]:
		part = slice(row, row + len(one.values))
		freedom = len(one.values) - taken[part].sum()
		variances[part] = residuals[part] @ residuals[part] / freedom if freedom > 1e-6 else math.nan
		row = part.stop
	covariance = inverse @ ((slopes.T * variances) @ slopes) @ inverse
	covariance[isOpen] = covariance[:, isOpen] = 0
	covariance[isOpen, isOpen] = math.inf
	return covariance, isOpen


def _report(problem, fit):
	readings = sum(len(one.values) for test in problem.tests for one in test.curves)
	lines = [f"{type(problem.material).__name__} from {readings} readings of {len(problem.tests)} test{'s' * (len(problem.tests) > 1)}, {fit['evaluations']} evaluations"]
	for p in problem.parameters:
		value, spread = fit['values'][p.name], fit['uncertainty'][p.name]
		known = 'not determined' if math.isinf(spread) else f'+- {spread:.2g}'
		lines.append(f'  {p.name:20} {value:12.6g} {known:16} between {p.low:g} and {p.high:g}')
	for test, misfits in zip(problem.tests, fit['misfit']):
		lines.append(f'  misfit of {test.name}: ' + ', '.join(f'{name} {100 * value:.3g} %' for name, value in misfits.items()))
	if fit['undetermined']: lines.append('  not determined by these tests: ' + ', '.join(fit['undetermined']) + '; the rest holds for the value given')
	if fit['atBounds']: lines.append('  at a bound: ' + ', '.join(fit['atBounds']) + '; beyond it the misfit may be less')
	if fit['beside']: lines.append('  beside values that are refused: ' + fit['beside'])
	return '\n'.join(lines)


def _draw(problem, fit, fileName):
	"""For each curve of each kind of test a panel: readings as points, the fit as lines."""
	from matplotlib.figure import Figure  # needs no window
	panels = list(dict.fromkeys((test.kind, one.name) for test in problem.tests for one in test.curves))
	across = min(3, len(panels))
	down = -(-len(panels) // across)
	figure = Figure(figsize=(3 * across + 0.2, 2.9 * down), layout='constrained')
	axes = figure.subplots(down, across, squeeze=False).flat
	for (kind, name), panel in zip(panels, axes):
		isStrain, isShear, colours = name == 'volumetricStrain', kind == 'simpleShear', 0
		for test, curve in zip(problem.tests, fit['curves']):
			one = next((one for one in test.curves if test.kind == kind and one.name == name), None)
			if one is None: continue
			along, colour, factor = 100 * (test.strains if isShear else -test.strains), f'C{colours % 10}', 100 if isStrain else 1e-3
			panel.plot(along, factor * one.values, '.', color=colour, markersize=4)
			panel.plot(along, factor * curve[name], color=colour, label=f'{test.name}: {100 * _rms(curve[name] - one.values) / one.scale:.2g} %')
			colours += 1
		unit = '[%]' if isStrain else '[kPa]'
		panel.set(title=kind, xlabel='shear strain [%]' if isShear else 'axial compression [%]', ylabel=f'{name} {unit}')
		panel.legend(framealpha=0.8, edgecolor='none', fontsize='x-small')
	for panel in list(axes):
		panel.set_visible(False)
	write(problem.who, figure, fileName)
