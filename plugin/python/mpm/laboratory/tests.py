# SPDX-License-Identifier: GPL-2.0-or-later
"""Response of a law by itself: one answer, and the curves of laboratory tests."""
import math
from types import SimpleNamespace

import numpy as np
from yade import wrapper

from ..base.messages import brief, numberOf as _number
from ..base.naming import didYouMean, materialOf
from ..library import engine
from ..output.plotting import write
from ..points.data import table


def respond(material, strain, duration=0, **internals):
	"""One call of a material's law, as for one material point in one iteration: what it answers to a trial elastic strain. ::

		clay = MpmTrescaMat(young=20e6, poisson=0.3, density=2000, undrainedStrength=20e3)
		print(mpm.respond(clay, (0, -5e-3, 0))['stress'])

	:param material: material of the plugin, or the label of one in O.materials
	:param strain: trial elastic logarithmic strain [-], positive in extension, finite: three principal values, or a symmetric tensor (3, 3)
	:param duration: of the step in the time of the loads >= 0, for laws that depend on it; where it is 0 a UMAT is told DTIME = 1
	:param internals: internal variables of the law at the start of the step by name, as ``plasticStrain`` [-] or ``preconsolidation``
		[Pa]; what is not given has the value of a point that nothing has happened to
	:return: dict of ``stress``, Kirchhoff stress [Pa] in the shape of *strain*, positive in tension; ``elasticStrain``, what the return leaves of *strain*, in its
		shape; ``tangent`` (3, 3), derivatives of the principal stresses by the principal trial strains [Pa]; ``shear`` (3,), secant shear moduli [Pa]
		of the pairs of principal axes (0, 1), (1, 2), (2, 0); ``axes`` (3, 3), the principal axes as columns, in the order that *tangent* and *shear* have; and
		the internal variables after the return by name. Of a law with tensors, which need not share the axes of the strain: *stress* and *elasticStrain*
		as tensors, and *tangent* (6, 6) by Mandel's numbers: xx, yy, zz, and sqrt(2) times xy, yz, zx; no *shear* and *axes*.
	:raises TypeError: *material* is no material of the plugin; *strain* or an internal variable is no number.
	:raises ValueError: a label that does not exist; values of the material that are not admitted; a wrong shape, or a tensor that is not symmetric;
		a strain that is not finite, or to which the law has no answer; an internal variable that the law does not have, or that is not admitted.
	"""
	who = 'respond'
	material = materialFor(who, material)
	strain = _strain(who, strain)
	internals = internalsOf(who, internals)
	duration = _number(who, 'duration', duration, 'a finite number >= 0', lambda value: value >= 0)
	if _named(who, engine.hasTensorLaw, material):
		answer = _named(who, engine.respondInSpace, material, _rows(np.diag(strain) if strain.ndim == 1 else strain), _rows(np.zeros((3, 3))), internals, duration)
		return {name: np.array(answer[name]) for name in ('stress', 'elasticStrain', 'tangent')} | answer['internals']
	values, axes = (strain, np.eye(3)) if strain.ndim == 1 else np.linalg.eigh(strain)
	answer = _named(who, engine.respond, material, _numbers(values), internals)
	inShape = (lambda v: np.array(v)) if strain.ndim == 1 else (lambda v: _assemble(v, axes))
	result = dict(stress=inShape(answer['stress']), elasticStrain=inShape(answer['elasticStrain']))
	result |= dict(tangent=np.array(answer['tangent']), shear=np.array(answer['shear']), axes=axes)
	return result | answer['internals']


def elementTest(material, kind, strain, steps=100, confiningPressure=0, initialStress=None, fileName=None, duration=0, **internals):
	"""The curve of a laboratory test on one material point, as a body of one homogeneous cell would give it. ::

		sand = MpmMohrCoulombMat(young=50e6, poisson=0.3, density=2000, cohesion=0, frictionAngle=radians(30))
		curve = mpm.elementTest(sand, 'triaxial', -0.02, confiningPressure=100e3, fileName='triaxial.png')
		print(curve['q'].max())

	=====================  ====================================================================================================
	``triaxial``           strain along y, the stresses along x and z are kept: drained compression or extension
	``biaxial``            strain along y, the stress along x is kept, no strain along z: plane strain
	``oedometer``          strain along y, none along x and z
	``undrainedTriaxial``  strain along y, as much along x as along z, and the volume stays: *stress* is the effective stress
	``simpleShear``        movement along x by *strain* times the height at first, the stress along y is kept, no strain along x and z
	=====================  ====================================================================================================

	Strains are finite; the stress that is kept and that of the result are Cauchy's, with the state at first as reference (F = 1). The laws have their strength in
	Kirchhoff stress, which is det F times Cauchy's. A step finds the strains across by Newton's method with the law's tangent, to 1e-10 of the stress, or to the round-off of strain times stiffness where that is more; where that fails, it is
	halved up to ten times.

	:param material: material of the plugin, or the label of one in O.materials
	:param kind: one of the above
	:param strain: at the end: logarithmic strain along y [-], negative in compression; of simpleShear the movement over the height at first [-].
		From -10 to 10, not 0.
	:param steps: number of equal steps > 0, an integer
	:param confiningPressure: pressure [Pa] >= 0 at first, equal in all directions; > 0 for Cam clay
	:param initialStress: instead of *confiningPressure*: Cauchy stress [Pa] along x, y and z at first, positive in tension
	:param fileName: draw the curve to this file, as :func:`plot` does
	:param duration: time [s] >= 0 that the test takes, at an even rate of strain, for laws that depend on it; where it is 0 a UMAT is told DTIME = 1 for each step
	:param internals: internal variables of the law at first by name, as in :func:`respond`
	:return: dict of arrays with the state at first and after each step, N = steps + 1: ``axialStrain`` (N,) logarithmic strain along y [-] or for simpleShear
		``shearStrain`` (N,) movement over the height at first [-]; ``volumetricStrain`` (N,) ln det F [-]; ``p`` (N,) pressure [Pa], the mean stress with a
		minus; ``q`` (N,) = sqrt(3 J2) [Pa], the difference of the principal stresses of a triaxial test; ``stress`` (N, 3, 3) Cauchy stress [Pa], positive in tension;
		``elasticStrain`` (N, 3, 3) logarithmic [-]; ``defGrad`` (N, 3, 3) [-]; and the internal variables (N,) by name.
	:raises TypeError: *material* is no material of the plugin, or a value is no number.
	:raises ValueError: a label or kind that does not exist; a value that is not admitted; a stress at first that the material cannot carry without yielding.
	:raises RuntimeError: a step has found no solution; the strain that was reached is named, with the reason. So ends a law with tensors whose stress
		gets other axes than those of a triaxial or biaxial test, which would shear the body.
	:raises OSError: the file cannot be written.
	"""
	who = 'elementTest'
	material = materialFor(who, material)
	drivenStrain(who, kind)
	end = _number(who, 'strain', strain, 'a number from -10 to 10, not 0', lambda value: 0 < abs(value) <= 10)
	if isinstance(steps, bool) or not isinstance(steps, (int, np.integer)): raise TypeError(f'{who}: steps = {brief(steps)} must be an integer')
	if steps < 1: raise ValueError(f'{who}: steps = {steps} must be > 0')
	duration = _number(who, 'duration', duration, 'a finite number >= 0 [s]', lambda value: value >= 0)
	curve = curveAt(who, material, kind, end * np.arange(1, steps + 1) / steps, confiningPressure, initialStress, internalsOf(who, internals), secondsPerStrain=duration / abs(end))
	if fileName is not None: _draw(kind, curve, fileName)
	return curve


def curveAt(who, material, kind, strains, confiningPressure=0, initialStress=None, internals={}, patience=math.inf, secondsPerStrain=0):
	"""The curve of a test in steps to each of these strains, which may turn back; it is given up after so many solves for one step in the mean."""
	test = _testOf(who, kind)
	test.solves, test.secondsPerStrain = patience * len(strains), secondsPerStrain
	state = stateUnder(who, material, firstStress(who, confiningPressure, initialStress), internals)
	kept = np.diag(state.stress).copy()
	if state.hasTensors or kept[0] != kept[2]: test.free = test.each
	states = [state]
	for at in strains:
		try:
			state = _advance(test, material, state, at, kept)
		except _NoSolution as reason:
			raise RuntimeError(f'{who}: {brief(kind)} has no solution beyond {test.strain} = {reason.reached:.6g} of {strains[-1]:g}: {reason}') from None
		states.append(state)
	return _curve(test, states)


def drivenStrain(who, kind):
	"""The name of the strain that a kind of test drives."""
	return _testOf(who, kind).strain


def materialFor(who, material):
	if isinstance(material, str):
		try:
			material = materialOf(who, material)
		except KeyError as error:
			raise ValueError(error.args[0]) from None
	if not isinstance(material, wrapper.MpmMaterial):
		raise TypeError(f'{who}: material = {brief(material)} must be a material of the plugin, as MpmMohrCoulombMat(...), or the label of one')
	return material


def _array(who, name, values, shapes, expected):
	try:
		array = np.asarray(values)
	except ValueError:  # rows that differ in length
		array = np.empty(0)
	if array.dtype.kind not in 'iuf' and array.size: raise TypeError(f'{who}: {name} = {brief(values)} must be {expected}')
	if array.shape not in shapes: raise ValueError(f'{who}: {name} = {brief(values)} must be {expected}')
	if not np.isfinite(array).all(): raise ValueError(f'{who}: {name} = {brief(values)} must be finite')
	return array.astype(float)


def _strain(who, strain):
	array = _array(who, 'strain', strain, [(3, ), (3, 3)], 'three principal strains or a tensor (3, 3) of numbers')
	if array.ndim == 2 and np.abs(array - array.T).max() > 1e-12 * np.abs(array).max(): raise ValueError(f'{who}: strain = {brief(strain)} must be symmetric')
	return array


def internalsOf(who, internals):
	known = [name for name, column in table.items() if column['isInternal']]
	for name in internals:
		if name not in known: raise ValueError(f"{who}: {name} is no internal variable of a law{didYouMean(name, known) or ';'} there are {', '.join(known)}")
	return {name: _number(who, name, value, 'a finite number') for name, value in internals.items()}


def _numbers(values):
	return tuple(map(float, values))


def _rows(tensor):
	return list(map(float, np.ravel(tensor)))


def _named(who, function, *arguments):
	"""Answer of a function of the library, with its errors in the name of the caller."""
	try:
		return function(*arguments)
	except ValueError as error:
		raise ValueError(f'{who}: {error}') from None


def _assemble(values, axes):
	"""The tensor with these principal values and axes."""
	return (axes * values) @ axes.T


def _testOf(who, kind):
	"""Free strains of a test, whether its sides are free of shear stress, and the increment of F of a strain that is driven from one value to another.

	A row of `free` is one unknown strain along the axes that it marks, by which the mean stress along them is kept. Where isotropic soil is pressed alike along x and z
	that is one strain: by two, a corner of a yield surface would leave their difference open. `each` has one for each axis.
	"""

	def stretch(lateral):
		return lambda state, to: np.diag(np.exp((to - state.strain) * np.array([lateral, 1, lateral])))

	def shear(state, to):
		increment = np.eye(3)
		increment[0, 1] = (to - state.strain) / state.defGrad[1, 1]
		return increment

	tests = {
	        'triaxial': ('axialStrain', [1, 0, 1], True, stretch(0)),
	        'biaxial': ('axialStrain', [1, 0, 0], True, stretch(0)),
	        'oedometer': ('axialStrain', [0, 0, 0], False, stretch(0)),
	        'undrainedTriaxial': ('axialStrain', [0, 0, 0], False, stretch(-0.5)),
	        'simpleShear': ('shearStrain', [0, 1, 0], False, shear),
	}
	if kind not in list(tests): raise ValueError(f"{who}: kind = {brief(kind)} must be one of {', '.join(map(repr, tests))}")
	strain, axes, isSmooth, increment = tests[kind]
	each = np.diag(axes)[np.flatnonzero(axes)].astype(float)
	return SimpleNamespace(strain=strain, free=each.sum(axis=0)[None, :] if any(axes) else each, each=each, isSmooth=isSmooth, increment=increment)


def firstStress(who, confiningPressure, initialStress):
	pressure = _number(who, 'confiningPressure', confiningPressure, 'a finite number >= 0 [Pa], positive in compression', lambda value: value >= 0)
	if initialStress is None: return np.full(3, -pressure)
	if pressure: raise ValueError(f'{who}: confiningPressure and initialStress are two ways to say the same; give one of them')
	return _array(who, 'initialStress', initialStress, [(3, )], 'three numbers, the stress [Pa] along x, y and z')


def stateUnder(who, material, stress, internals):
	"""State of a point with this stress, which it bears without yielding."""
	if hasattr(material, 'swellingIndex') and not stress.any():
		raise ValueError(f'{who}: confiningPressure = 0 is not admitted for an {type(material).__name__}, which has no stiffness without pressure')
	internals = _named(who, engine.bearing, material, _numbers(stress), internals)
	elasticStrain = np.array(_named(who, engine.elasticStrainOf, material, _numbers(stress), internals))
	hasTensors = _named(who, engine.hasTensorLaw, material)
	answer = _named(who, engine.respondInSpace, material, _rows(np.diag(elasticStrain)), _rows(np.zeros((3, 3))), internals, 0.) if hasTensors else _named(who, engine.respond, material, _numbers(elasticStrain), internals)
	first = answer['internals'] | internals if hasTensors else internals | answer['internals']  # the call at rest is no increment of a user material
	return SimpleNamespace(hasTensors=hasTensors, strain=0., defGrad=np.eye(3), elasticStrain=np.diag(elasticStrain), stress=np.diag(stress), internals=first)


def _advance(test, material, state, to, kept):
	"""The state at the strain *to*, by steps that are halved where Newton's method fails."""
	most, target, halvings = 10, to, 0
	while state.strain != to:
		test.solves -= 1
		try:
			if test.solves < 0: raise _NoSolution('too many steps had to be halved')
			state, target, halvings = _solve(test, material, state, target, kept), to, max(0, halvings - 1)
		except _NoSolution as reason:
			if halvings == most or test.solves < 0:
				reason.reached = state.strain
				raise
			halvings, target = halvings + 1, (state.strain + target) / 2
	return state


class _NoSolution(Exception):
	"""Stop of a test, with the reason, and the strain that was `reached`."""


def _solve(test, material, state, to, kept):
	"""Newton's method for the free strains u of the test, at which the means of the stresses along their axes are those kept."""
	increment = test.increment(state, to)
	free, most, tolerance = test.free, 50, 1e-10
	u, lowest = np.zeros(len(free)), math.inf
	for _ in range(most):
		trial = _trial(material, state, np.diag(np.exp(u @ free)) @ increment, to, test.secondsPerStrain * abs(to - state.strain))
		if not free.any(): return trial
		J, directions = np.linalg.det(trial.defGrad), free / free.sum(axis=1, keepdims=True)
		residual = directions @ (np.diag(trial.kirchhoff) - J * kept)
		missed, allowed = np.abs(residual).max(), max(tolerance * np.linalg.norm(trial.kirchhoff), _roundOff(trial))
		if missed <= allowed:
			_requireNoShear(test, trial, allowed)
			return trial
		slope = np.transpose([directions @ np.diag(_rate(trial, np.diag(axes))) - J * axes.sum() * (directions @ kept) for axes in free])
		try:
			u -= np.linalg.solve(slope, residual)
		except np.linalg.LinAlgError:
			raise _NoSolution('the stress across does not change with the strain across') from None
		if not np.abs(u).max() < 1: raise _NoSolution('the strain across grows without bounds')
		lowest = min(lowest, missed)
	raise _NoSolution(f"Newton's method misses the stress that is kept by {lowest:.3g} Pa or more after {most} iterations")


def _requireNoShear(test, trial, allowed):
	"""Sides that only press bear no shear stress: a body whose law answers with some would be sheared."""
	shear = np.abs(trial.kirchhoff - np.diag(np.diag(trial.kirchhoff))).max()
	if test.isSmooth and shear > max(allowed, 1e-6 * np.linalg.norm(trial.kirchhoff)):
		raise _NoSolution(f'the stress of the law has other axes than the test: a shear stress of {shear:.3g} Pa would shear the body, which no side of it bears')


def _roundOff(trial):
	"""Round-off of the stress [Pa]: strains are logarithms of numbers near one, whose round-off the stiffness multiplies, of nearly incompressible soil by its bulk modulus."""
	return 8 * np.finfo(float).eps * np.abs(trial.trial.answer['tangent']).sum(axis=1).max()


def _trial(material, state, increment, to, duration):
	"""The state after an increment F <- increment F: the elastic left Cauchy-Green tensor is pushed forward, then the law answers."""
	if state.hasTensors: return _tensorTrial(material, state, increment, to, duration)
	values, axes = np.linalg.eigh(state.elasticStrain)
	pushed = increment @ _assemble(np.exp(2 * values), axes) @ increment.T
	squares, axes = np.linalg.eigh(pushed)
	strain = np.log(squares) / 2
	try:
		answer = engine.respond(material, tuple(map(float, strain)), state.internals)
	except ValueError as error:
		raise _NoSolution(error) from None
	defGrad = increment @ state.defGrad
	kirchhoff = _assemble(answer['stress'], axes)
	return SimpleNamespace(
	        hasTensors=False,
	        strain=to,
	        defGrad=defGrad,
	        elasticStrain=_assemble(answer['elasticStrain'], axes),
	        stress=kirchhoff / np.linalg.det(defGrad),
	        internals=answer['internals'],
	        kirchhoff=kirchhoff,
	        trial=SimpleNamespace(strain=strain, axes=axes, answer=answer)
	)


def _tensorTrial(material, state, increment, to, duration):
	"""The same by a law with tensors, which turn with the material."""
	try:
		answer = engine.stepInSpace(material, _rows(state.elasticStrain), _rows(increment), state.internals, float(duration))
	except ValueError as error:
		raise _NoSolution(error) from None
	defGrad = increment @ state.defGrad
	kirchhoff, elasticStrain, rates = (np.array(answer[name]) for name in ('stress', 'elasticStrain', 'rates'))
	return SimpleNamespace(
	        hasTensors=True,
	        strain=to,
	        defGrad=defGrad,
	        elasticStrain=elasticStrain,
	        stress=kirchhoff / np.linalg.det(defGrad),
	        internals=answer['internals'],
	        kirchhoff=kirchhoff,
	        trial=SimpleNamespace(rates=rates, answer=dict(tangent=rates))
	)


def _rate(state, velocityGradient):
	"""Rate of the Kirchhoff stress: the tangent in principal axes, and the rotation of the axes, which the secant shear moduli stand for."""
	if state.hasTensors: return (state.trial.rates @ velocityGradient.ravel()).reshape(3, 3)
	strain, axes, answer = state.trial.strain, state.trial.axes, state.trial.answer
	l, squares = axes.T @ velocityGradient @ axes, np.exp(2 * strain)
	rate = np.diag(np.array(answer['tangent']) @ np.diag(l))
	for pair, (i, j) in enumerate([(0, 1), (1, 2), (2, 0)]):
		difference = strain[i] - strain[j]
		sheared = l[i, j] * squares[j] + l[j, i] * squares[i]
		perSquare = difference / (squares[i] - squares[j]) if abs(difference) > 1e-8 else 1 / (squares[i] + squares[j])
		rate[i, j] = rate[j, i] = 2 * answer['shear'][pair] * perSquare * sheared
	return axes @ rate @ axes.T


def _curve(test, states):
	stress = np.array([state.stress for state in states])
	mean = np.trace(stress, axis1=1, axis2=2) / 3
	deviator = stress - mean[:, None, None] * np.eye(3)
	defGrad = np.array([state.defGrad for state in states])
	curve = {test.strain: np.array([state.strain for state in states]), 'volumetricStrain': np.log(np.linalg.det(defGrad))}
	curve |= dict(p=-mean, q=np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2))), stress=stress)
	curve |= dict(elasticStrain=np.array([state.elasticStrain for state in states]), defGrad=defGrad)
	return curve | {name: np.array([state.internals[name] for state in states]) for name in states[-1].internals}


def _draw(kind, curve, fileName):
	"""Shear stress or q over the strain, volumetric strain or vertical pressure over it, and the path of the stress."""
	from matplotlib.figure import Figure  # needs no window
	figure = Figure(figsize=(11, 3.6), layout='constrained')
	left, middle, right = figure.subplots(1, 3)
	isShear = kind == 'simpleShear'
	along = 100 * curve['shearStrain' if isShear else 'axialStrain']
	along, label = (along, 'shear strain [%]') if isShear else (-along, 'axial compression [%], logarithmic')
	left.plot(along, (curve['stress'][:, 0, 1] if isShear else curve['q']) / 1e3)
	left.set(xlabel=label, ylabel=r'shear stress $\sigma_{xy}$ [kPa]' if isShear else 'q [kPa]', title=kind)
	middle.plot(along, 100 * curve['volumetricStrain'])
	middle.set(xlabel=label, ylabel='volumetric strain [%], logarithmic')
	right.plot(curve['p'] / 1e3, curve['q'] / 1e3)
	right.set(xlabel='p [kPa]', ylabel='q [kPa]', title='path of the stress')
	write('elementTest', figure, fileName)
