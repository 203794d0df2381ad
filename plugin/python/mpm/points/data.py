# SPDX-License-Identifier: GPL-2.0-or-later
"""The data of all material points as NumPy arrays, out and in."""
import operator
import sys
import threading

import numpy as np
from yade import wrapper
from yade.minieigenHP import Vector3

from ..base.divided import columnsOfPoints, idsOfPoints
from ..base.messages import brief, isNumber, place
from ..base.naming import didYouMean
from ..base.solver import solverOf
from ..geometry.regions import each
from ..library import engine

table = {column['name']: column for column in engine.pointColumns()}  # all columns that there are


def arrays():
	"""Copies of the data of all material points of the scene, as NumPy arrays in order of body id.

	The points are YADE bodies, each with memory of its own, so there is nothing that an array could share with them: writing to
	these arrays changes nothing in the scene. :func:`assign` is the way back.

	:return: dict of ``id`` (N,) body ids; ``pos``, ``pos0`` (N, 3) current and initial position [m]; ``halfSize``, ``halfSize0`` (N, 3)
		half the current and the initial size of the domain [m]; ``velocity`` [m/s] and ``acceleration`` [m/s2] (N, 3), of a ``MpmDynamicEngine``; ``force`` (N, 3) point load at load factor 1 [N]; ``stress`` (N, 3, 3) Cauchy stress [Pa]; ``defGrad`` (N, 3, 3) deformation gradient;
		``elasticStrain`` (N, 3, 3) logarithmic elastic strain; ``porePressure`` (N,) [Pa], where there is water (``stress`` is then effective stress); ``volume`` (N,) current volume [m3]; ``plasticStrain`` (N,)
		accumulated plastic strain; ``material`` (N,) index into ``O.materials`` (-1: not in there). Where the law of a point has other
		internal variables, (N,) of each by its name, NaN for points without. Of a strength or modulus that a point has of its own, by :func:`assign` or
		:func:`fill`, (N,) by its name, with the material's for points without. Where points have been split (``MpmImplicitEngine.maxSplits``), ``splits`` (N,), how often,
		and ``parent`` (N,), the id of the body that the point was split off from, -1: none. A scene without material points gives arrays of length 0.
	:raises ValueError: a body with an ``MpmPoint`` shape that is no complete material point.
	"""
	_sayIfRunning()
	return _asArrays(columnsOfPoints(0, False))


_hasSaid = False


def _sayIfRunning():
	"""Once: a script that goes on beside O.run(n) reads what is there by then. What the run itself calls comes at the right time."""
	global _hasSaid
	scene = wrapper.Omega()
	if _hasSaid or not scene.running or threading.current_thread() is not threading.main_thread(): return
	_hasSaid = True
	sys.stderr.write(f'\nyade.mpm: mpm.arrays() while the simulation runs, in iteration {scene.iter}: they are those of this moment. O.run(n, wait=True) or O.wait() waits for the end.\n')


def contactForces(solver=None):
	"""Contact of soil with rigid bodies at the end of the last converged step: positions and forces.

	:param solver: ``MpmImplicitEngine`` with the contacts; needed if there are several
	:return: contact points (N, 3) [m] on the bodies, a quarter of a cell apart, and forces (N, 3) on the soil [N], per metre of thickness in plane strain; of length 0
		if nothing touches
	:raises ValueError: no engine, or several of which none is named.
	"""
	places, force, _ = contactFaces(solverOf('contactForces', solver))
	touching = force.any(axis=1)
	return places[touching], force[touching]


def contactFaces(solver):
	"""Contact points on all bodies near the soil: centres (N, 3) [m], forces on the soil (N, 3) [N], and in the plane the ends of their parts of the face (N, 2, 3) [m], else None."""
	data = engine.gridCells('contacts', solver)
	places, force, corners = (np.frombuffer(data[name]).reshape(-1, 3) for name in ('middles', 'field', 'corners'))
	return places, force, corners.reshape(-1, 2, 3) if solver.grid.dim == 2 else None


def fields(mask=0):
	"""The same of the points that a mask means, and what follows from it: ``displacement`` (N, 3) [m], ``strain`` (N, 3, 3) logarithmic, ``meanStress`` and ``sqrt2J2`` (N,) [Pa], and where there is water ``totalStress`` (N, 3, 3) [Pa]."""
	return _asArrays(columnsOfPoints(mask, True))


def pointsOf(solver):
	"""Same as :func:`withMaterials`, for the points that an engine moves."""
	return withMaterials(solver.mask)


def withMaterials(mask=0):
	"""The arrays of the points, the list of the materials that their bodies have, and the place of each point's (N,) in it.

	``O.materials`` need not have those, so ``material`` of :func:`arrays` may be no index; where processes divide the points it does.
	"""
	data = columnsOfPoints(mask, False)
	points = _asArrays(data)
	if 'materials' in data: return points, data['materials'], np.frombuffer(data['materialNumber'], np.int64)
	numbers, number = np.unique(points['material'], return_inverse=True)
	if -1 in numbers: raise ValueError(f"body #{points['id'][number == 0][0]}: its material is not in O.materials, as points that processes divide need it")
	return points, [wrapper.Omega().materials[int(i)] for i in numbers], number


def _asArrays(data):
	return {name: np.frombuffer(data[name], np.int64 if column['isInteger'] else float).reshape((-1, ) + _shape(column)) for name, column in table.items() if name in data}


def _shape(column):
	"""Shape of a row."""
	return {1: (), 3: (3, ), 9: (3, 3)}[column['width']]


_assignable = [name for name, column in table.items() if column['isGiven']]


def assign(ids=None, **columns):
	"""Give material points values from arrays: initial states, point loads. All values are taken, or after an error none.

	Stress and elastic strain follow from each other through the law of each point's material. From ``defGrad`` follow the volume and
	``halfSize``: the diagonal of the stretch U = sqrt(F^T F) times ``halfSize0``, which the next step limits to half a cell, as every step does. ::

		points = mpm.arrays()
		stress = np.zeros((len(points['id']), 3, 3))
		stress[:, 1, 1] = -20e3
		mpm.assign(stress=stress)
		top = points['pos'][:, 1] > 4.9
		mpm.assign(ids=points['id'][top], force=[(0, -500, 0)] * top.sum())

	Strengths and moduli may differ from point to point within a material: clay whose strength grows with the depth, a random field from an array. They act
	from the next step on, in place of the material's, and are saved with the points. ::

		mpm.assign(undrainedStrength=lambda x: 5e3 + 1.5e3 * (10 - x[1]))

	:param ids: (N,) body ids of the points, in the order of the rows; all points in order of body id (that of :func:`arrays`) if
		not given
	:param columns: arrays of N rows, named and shaped as those of :func:`arrays`: ``pos``, ``pos0`` [m], ``defGrad``,
		``elasticStrain``, ``stress`` [Pa] (the Cauchy stress, instead of ``elasticStrain``), ``plasticStrain`` and other internal variables of the
		points' laws, ``force`` [N], ``velocity`` [m/s]; all finite. Also, by the name of the attribute, strengths and moduli that the points' materials have:
		``young``, ``shearModulus``, ``yieldStress``, ``hardening``, ``residualYieldStress``, ``undrainedStrength``, ``cohesion``, ``frictionAngle``,
		``dilationAngle``, ``tensileStrength``, ``criticalStateRatio``, of all ``conductivity``, ``verticalConductivity`` and ``porosity``, and of retention curves ``alpha``, ``n``, ``entry``, ``exponent``, ``residual``, ``saturated``: an array (N,), or a function of the current position that returns a number.
		``velocity`` [m/s] is that of a ``MpmDynamicEngine``, whose motion begins anew with it; static steps leave it alone.
	:raises TypeError: a name that is not in this list, or values that are no numbers.
	:raises ValueError: a wrong shape; a value that is not finite, or not admitted for that column (``MpmState`` says what is), or as that attribute of the
		point's material; a strength or modulus that the material of a point does not have; a stress
		that the material cannot carry without yielding; ids of no material points, or given twice.
	:raises RuntimeError: a load step is at work in the background; it would overwrite the values.

	Where several processes have divided the points all of them call this with the same, and each gives its points their values.

	A warning in YADE's log if nearly all of the stresses are tensile though an engine among O.engines has gravity: ground under its weight is in
	compression, and stress is positive in tension.
	"""
	rows = idsOfPoints() if ids is None else _ids(ids)
	values = {name: _column(name, _atPoints(name, column, rows), len(rows)) for name, column in columns.items()}
	if not values: raise TypeError(f"assign: no column is given; there are {', '.join(_assignable)}")
	if 'stress' in values and 'elasticStrain' in values:
		raise ValueError('assign: stress and elasticStrain follow from each other; give one of them')
	try:
		engine.assignColumns(rows, values)
	except ValueError as error:
		hint = '' if 'yields' not in str(error) else _signOf(values)
		raise ValueError(f'assign: {error}{hint and " " + hint}') from None
	if _gravityActs() and _signOf(values): engine.warn('assign: ' + _signOf(values))


def _signOf(values):
	"""A sentence on the sign of initial stresses, if nearly all of them are tensile; in a bent beam half of them are."""
	mean = np.trace(values.get('stress', values.get('elasticStrain', np.zeros((0, 3, 3)))), axis1=1, axis2=2)
	if np.count_nonzero(mean > 0) <= 0.9 * np.count_nonzero(mean): return ''
	return 'The points are given a mean tension: stress and strain are positive in tension, so ground under its weight, in compression, has a minus.'


def _gravityActs():
	return any(isinstance(e, wrapper.MpmImplicitEngine) and e.gravity.norm() > 0 for e in wrapper.Omega().engines)


def _ids(ids):
	isMask = isinstance(ids, (list, tuple, np.ndarray)) and len(ids) > 0 and all(isinstance(i, (bool, np.bool_)) for i in ids)
	try:
		rows = np.array([operator.index(i) for i in ids], dtype=np.int64) if not isMask else None
	except (TypeError, OverflowError):
		rows = None
	if rows is None:
		hint = "; those of a mask are mpm.arrays()['id'][mask]" if isMask else ''
		raise TypeError(f'assign: ids = {brief(ids)} must be a sequence of body ids{hint}')
	values, counts = np.unique(rows, return_counts=True)
	if (counts > 1).any(): raise ValueError(f'assign: ids has body #{values[counts > 1][0]} more than once')
	return rows


def _column(name, values, rows):
	if name not in _assignable:
		if name in ('vel', 'velocities'): hint = 'it is called velocity'
		elif name in table: hint = f'{name} is a result'
		else: hint = 'there is no such column'
		raise TypeError(f"assign: {name} cannot be assigned: {hint}{didYouMean(name, _assignable) or ';'} there are {', '.join(_assignable)}")
	array = _numbers(name, values)
	shape = (rows, ) + _shape(table[name])
	if isParameter(name) and np.ndim(values) == 0:
		raise ValueError(f'assign: {name} = {brief(values)} must be an array of {rows} numbers or a function of the position; one number for all is an attribute of the material')
	if array.shape != shape:
		raise ValueError(f'assign: {name} has the shape {array.shape}; expected is {shape}, one row for each of {rows} material points')
	if isParameter(name): return array  # looked at as the material's own, some of which may be infinite
	finite = np.isfinite(array).reshape(rows, -1).all(axis=1)
	if not finite.all(): raise ValueError(f'assign: {name}[{np.flatnonzero(~finite)[0]}] = {array[~finite][0].tolist()} must be finite')
	return array


def isParameter(name):
	"""True for a strength or modulus, of which points may have their own."""
	return name in table and table[name]['isParameter']


def parameter(name, material, points, rows):
	"""A strength or modulus of the points in these rows, which all have this material: a number, or an array where points have their own."""
	return points[name][rows] if name in points else getattr(material, name)


def ofPositions(who, name, value, positions):
	"""Column of a parameter: that of a function of the position, or what is given."""
	if not callable(value): return value
	column = [value(Vector3(*position)) for position in each(positions)]
	for number, position in zip(column, positions):
		if not isNumber(number): raise TypeError(f'{who}: the function {name} returned {brief(number)} at {place(position)}; it must return a number')
	return column


def _atPoints(name, column, rows):
	if not (isParameter(name) and callable(column)): return column
	points = arrays()
	rowOf = {id: row for row, id in enumerate(points['id'].tolist())}
	known = [rowOf[id] for id in rows.tolist() if id in rowOf]
	if len(known) < len(rows): raise ValueError(f'assign: ids: there is no material point with body id {next(id for id in rows.tolist() if id not in rowOf)}')
	return ofPositions('assign', name, column, points['pos'][known])


def _numbers(name, values):
	"""Array of float; values that NumPy would drop without a word are refused: imaginary parts, and masks of masked arrays."""
	try:
		array = np.asarray(values)
		if array.dtype.kind in 'biufO' and not np.ma.is_masked(values): return np.ascontiguousarray(array, dtype=float)
	except (TypeError, ValueError):
		pass
	raise TypeError(f'assign: {name} = {brief(values)} must be an array of numbers, real and none of them masked')
