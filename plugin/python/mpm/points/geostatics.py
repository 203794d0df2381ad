# SPDX-License-Identifier: GPL-2.0-or-later
"""Initial stress of the ground."""
import math
import re

import numpy as np
from yade import wrapper

from ..base.messages import brief, isNumber, place
from ..base.solver import noPoints, solverOf
from ..library import engine as _library
from .data import assign, parameter, pointsOf, table
from .suction import Suction, requireTable
from .water import pressuresOfEach

_mostPressed = 6  # K0: the coefficient of passive earth pressure for a friction angle of 45 degrees
_isotropic = [getattr(wrapper, f'Mpm{name}Mat') for name in ('Elastic', 'VonMises', 'Tresca', 'MohrCoulomb', 'DruckerPrager', 'CamClay', 'HardeningSoil', 'NorSand')]
_grown = (wrapper.MpmHardeningSoilMat, wrapper.MpmNorSandMat)  # classes whose hardening follows from the stresses they have borne


def geostatic(K0=None, surface=None, solver=None, OCR=1, bodies=(), waterTable=None, infiltration=0):
	"""Give the material points of an engine the stress of level ground under its own weight, in equilibrium with gravity at load factor 1.

	The vertical stress is the weight of the soil above, of whatever density its horizontal layers have, and with ``MpmImplicitEngine.water`` that of the water on the
	ground less the pressure in the pores; the horizontal one is *K0* times that, in all directions. By default, *K0* is that of the material, with the overconsolidation ratio *OCR*:

	=============================  ======================================================================================
	elastic, von Mises, Tresca     nu / (1 - nu): loaded elastically without horizontal strain
	Mohr-Coulomb, Drucker-Prager   (1 - sin(phi)) OCR^sin(phi) (Jaky 1944; Mayne and Kulhawy 1982)
	Cam clay, NorSand              the same with sin(phi) = 3 M / (6 + M), the angle of friction in triaxial compression
	hardening soil                 K0nc OCR^sin(phi)
	=============================  ======================================================================================

	The preconsolidation pressure of the points of Cam clay becomes that of the state in which the vertical stress was *OCR* times the present one, with the ratio
	K0 / OCR^sin(phi) of the stresses; it is no less than that of the present state. The material's own ``preconsolidation`` is then without effect on them. Points of
	hardening soil and NorSand are first given the stress of that past, and remember the hardening that it needs.

	The first step then finds nothing to move, if the sides are constrained in their normal direction and gravity
	acts in full from the beginning. Point loads and prescribed displacements may grow meanwhile, with ``loadCurve``::

		solver.gravityCurve = [(0, 1)]
		mpm.geostatic()

	A wall, a pile or a culvert in the ground is of one of the materials *bodies*, of any modulus and density: its points are given the stress of the ground at their height, so that the ground
	around is at rest. What they are heavier by acts in the first step; ::

		heavier = mpm.geostatic(bodies=['concrete'])  # {'concrete': 58860.0}

	With ``MpmFlow(total=True)`` the ground weighs what water it has, and its effective stress has the suction (Bishop), by the *excessPressure* of the points; *waterTable* gives them one::

		mpm.geostatic(waterTable=2, infiltration=1e-8)

	To be called when ``O.engines`` and ``O.bodies`` are complete, before the first step. Other shapes than level ground have no such stress: let
	gravity grow first, and then the loads, by ``gravityCurve=[(0, 0), (1, 1)]`` and ``loadCurve=[(1, 0), (2, 1)]``.

	:param K0: ratio of horizontal to vertical stress [-], a number >= 0, or a dict of one for each label of the materials that the bodies have;
		by default that of the table above; to be given for materials of other classes
	:param surface: height of the ground's surface [m]: the coordinate against gravity's direction; by default the top of the highest
		points. Higher than that: the ground above is not modelled, its weight acts as a stress (of the density of the highest points),
		and the scene has to provide it as a load.
	:param solver: ``MpmImplicitEngine`` whose gravity and points are meant (those of its ``mask``); needed if there are several
	:param OCR: overconsolidation ratio [-], the largest vertical stress that has ever been over the present one: a number >= 1, a dict of one for each label of
		the materials, or a function of the depth below the surface [m], as ``lambda depth: 1 + 5 / depth`` of ground that has lost 5 m of the same
		weight. None: as 1, and Cam clay keeps the preconsolidation pressure that its material or :func:`assign` has given.
	:param bodies: labels of the materials of bodies in the ground; rows of points without any ground are layers of their own, or, above the ground, bear their weight by nothing
	:param waterTable: height [m] where the pressure of the water is that of the air, for ``MpmFlow(total=True)``: gives all points the pressure of water that is at rest above and below it, or flows down
	:param infiltration: steady flux through the ground [m/s], downwards; evaporates if < 0
	:return: for each of *bodies* the weight [N] (in plane strain per metre of thickness) that is not in balance with the stress: that of its points less that of ground in
		their place. It acts in the first step, so an analysis may begin with ``mpm.stages.replace`` in several steps instead where that is much.
	:raises TypeError: *K0*, *OCR* or *surface* is no number, *bodies* no list of labels.
	:raises ValueError: a value that is not admitted; gravity that is zero or not along an axis; a load factor other than 1 at O.time;
		points that have been deformed; ground that is not level, with layers of one density, one extent and one K0; or a stress that a
		material cannot carry without yielding, with the depth of the highest point where it is so.
	"""
	solver = solverOf('geostatic', solver)
	points, materials, number = pointsOf(solver)
	if not len(points['id']): raise ValueError(noPoints('geostatic', solver))
	axis, up = _upwards(solver)
	_requireFullGravity(solver)
	if np.abs(points['pos'] - points['pos0']).max() > 0 or np.abs(points['defGrad'] - np.eye(3)).max() > 0:
		raise ValueError('geostatic: the points have been deformed; an initial stress can be given only before the first step')
	height = up * points['pos'][:, axis]
	half = points['halfSize'][:, axis]
	density = np.array([material.density for material in materials])[number]
	areBodies = _areBodies(bodies, materials)
	isBody = areBodies[number]
	rows = _Rows(points, height, half, density, isBody)
	top = (height + half)[~rows.areAbove()].max()
	if surface is None: surface = top
	elif not isNumber(surface): raise TypeError(f'geostatic: surface = {brief(surface)} must be a height [m]')
	elif not (math.isfinite(surface) and surface >= top - 1e-9 * abs(top)):
		raise ValueError(f'geostatic: surface = {surface} is below the top of the highest points, at {top} m; at what height does the ground end?')
	pressure = rows.weightAbove(surface - top) * np.linalg.norm(solver.gravity)
	requireTable(solver, waterTable, infiltration)
	if solver.flow and solver.flow.total:
		suction = Suction(solver, axis, up, height, half, rows)
		if waterTable is not None: points['excessPressure'] = suction.pressures(points, materials, number, waterTable, infiltration)
		pressure = pressure - suction.lightened(points, materials, number)
	if solver.water: pressure = pressure + _ofWater(solver, points, rows, axis, up, surface - top)
	lifted = np.flatnonzero((pressure <= 0) & ~rows.areAbove())
	if lifted.size: raise ValueError(f'geostatic: at the height {height[lifted[0]]} m the water bears all of the ground: is its density that of saturated soil?')
	depth = surface - height
	horizontal, past, before = _history(K0, OCR, points, materials, number, pressure, depth, areBodies)
	rows.requireRest(pressure, horizontal)
	horizontal = np.where(isBody, rows.ofGround(horizontal), horizontal)
	past[isBody], before[isBody] = math.nan, math.nan
	_assign(points, _stress(pressure, horizontal, axis), past, _stress(*before.T, axis), depth, horizontal / np.where(pressure > 0, pressure, 1))
	if waterTable is not None: assign(ids=points['id'], excessPressure=points['excessPressure'])
	unbalanced = (density - rows.toPoints(rows.density)) * points['volume'] * np.linalg.norm(solver.gravity)
	return {material.label: float(unbalanced[isBody & (number == i)].sum()) for i, material in enumerate(materials) if material.label in bodies}


def _areBodies(bodies, materials):
	"""True for each material of bodies in the ground."""
	labels = [material.label for material in materials]
	if isinstance(bodies, str) or not all(isinstance(label, str) for label in bodies): raise TypeError(f"geostatic: bodies = {brief(bodies)} must be a list of labels of materials, as ['concrete']")
	missing = [label for label in bodies if label not in labels]
	if missing: raise ValueError(f'geostatic: bodies = {brief(bodies)}: no material of the points has the label {missing[0]!r}; they have {labels}')
	if len(set(bodies)) == len(set(labels)): raise ValueError(f'geostatic: bodies = {brief(bodies)} are all materials of the points: nothing is ground')
	return np.isin(labels, list(bodies))


def _stress(vertical, horizontal, axis):
	stress = np.zeros((len(vertical), 3, 3))
	for i in range(3):
		stress[:, i, i] = -(vertical if i == axis else horizontal)
	return stress


def _ofWater(solver, points, rows, axis, up, cover):
	"""Effective vertical pressure that water adds at the points, by the means over domains that a step takes: it lifts the soil in it by the gradient of its
	pressure; where it is in the pores or outside alone, its pressure acts, too."""
	ground = points['pos'].copy()
	top = rows.level[0] + rows.thickness[0] / 2
	ofCover = np.zeros((len(solver.water), len(ground)))
	for height, sign in ((top + cover, 1), (top, -1)) if cover > 0 else ():
		ground[:, axis] = up * height
		ofCover += sign * np.reshape(pressuresOfEach(solver, ground), ofCover.shape)
	result = np.zeros(len(ground))
	around = _library.waterAround(solver, np.ascontiguousarray(points['pos']), np.ascontiguousarray(points['halfSize']))
	ground[:, axis] = up * top
	onTop = pressuresOfEach(solver, ground)
	for water, above, top, (pressure, gradient) in zip(solver.water, ofCover, onTop, around):
		pressure, lift = np.frombuffer(pressure), -up * np.frombuffer(gradient).reshape(-1, 3)[:, axis]
		lifted = rows.above(lift) if rows.areAlike(lift) else pressure - top  # varies along a row: each column by itself
		if water.where == 'pores': result -= pressure
		else: result += above - lifted + (pressure if water.where == 'outside' else 0)
	return result


def _history(K0, OCR, points, materials, number, pressure, depth, areBodies):
	"""Horizontal pressure (N,) of the points, their preconsolidation pressure (N,), and vertical and horizontal pressure of the past (N, 2); NaN where that is not to be given."""
	horizontal, past, before = np.empty(len(depth)), np.full(len(depth), math.nan), np.full((len(depth), 2), math.nan)
	for i, material in enumerate(materials):
		rows = number == i
		history = _overconsolidation(1 if areBodies[i] else OCR, material, depth[rows])
		sine = _sineOfFriction(material, points, rows)
		ratio = _ratio(None if areBodies[i] and isinstance(K0, dict) and material.label not in K0 else K0, material, sine, history)
		horizontal[rows] = ratio * pressure[rows]
		if OCR is None: continue
		if hasattr(material, 'preconsolidation'): past[rows] = _preconsolidation(parameter('criticalStateRatio', material, points, rows), sine, pressure[rows], ratio, history)
		if isinstance(material, _grown): before[rows] = np.transpose([history * pressure[rows], ratio * history**(1 - sine) * pressure[rows]])
	return horizontal, past, before


def _assign(points, stress, past, before, depth, ratio):
	"""Stress to all points, after that of the past and with the preconsolidation pressure where there is one; to all of them, or after an error to none."""
	ids, order = points['id'], np.argsort(depth, kind='stable')  # the first point to be refused is the highest one
	ofClay, ofPast = np.isfinite(past[order]), np.isfinite(before[order, 0, 0])
	clay, others, grown = order[ofClay], order[~ofClay], order[ofPast]
	changed = []
	try:
		for rows, values in (grown, dict(stress=before[grown])), (others, dict(stress=stress[others])), (clay, dict(stress=stress[clay], preconsolidation=past[clay])):
			if rows.size: assign(ids=ids[rows], **values)
			changed.append(rows)
	except ValueError as error:
		for rows in reversed(changed):  # those of the past are among the others
			_restore(points, rows, rows is grown)
		body = np.flatnonzero(ids == int(re.search(r'Body #(\d+)', str(error))[1]))[0]
		raise ValueError(
		        f'geostatic: with K0 = {ratio[body]:.6g} the ground would not be at rest at a depth of {depth[body]:.6g} m. '
		        f'{str(error).removeprefix("assign: ")}'
		) from None


def _restore(points, rows, isGrown):
	"""The state that points had; only of those whose hardening follows from their stress is this more than the elastic strain."""
	ids, strain = points['id'], points['elasticStrain']
	if not isGrown:
		if rows.size: assign(ids=ids[rows], elasticStrain=strain[rows])
		return
	internals = {name: points[name] for name, column in table.items() if column['isInternal'] and name in points}
	known = np.array([np.isfinite(values[rows]) for values in internals.values()]).reshape(len(internals), rows.size).T
	for kind in np.unique(known, axis=0):
		own = rows[(known == kind).all(axis=1)]
		assign(ids=ids[own], elasticStrain=strain[own], **{name: values[own] for (name, values), has in zip(internals.items(), kind) if has})


def _upwards(solver):
	"""Axis of gravity, and the sign that makes its coordinate a height."""
	gravity = np.array(solver.gravity)
	axes = np.flatnonzero(gravity)
	if len(axes) != 1 or (solver.grid.dim == 2 and axes[0] == 2):
		raise ValueError(f'geostatic: gravity = {place(gravity)} of the MpmImplicitEngine must act along one of the axes of the grid')
	return axes[0], -np.sign(gravity[axes[0]])


def _requireFullGravity(solver):
	name = 'gravityCurve' if solver.gravityCurve else 'loadCurve'
	curve = np.array(getattr(solver, name))
	now = wrapper.Omega().time
	if np.interp(now, *curve.T) != 1 or (curve[curve[:, 0] > now, 1] != 1).any():
		raise ValueError(
		        f'geostatic: the factor of gravity is not 1 from now on (O.time = {now}, {name} = {getattr(solver, name)}), so gravity would not balance the '
		        'stress; set gravityCurve = [(0, 1)] of the MpmImplicitEngine'
		)


def _ofMaterial(name, given, material):
	"""Entry of a dict by label, or what is given for all."""
	if not isinstance(given, dict): return given
	if material.label in given: return given[material.label]
	raise ValueError(f'geostatic: {name} = {brief(given)} has no entry for material {material.label!r}' + ('' if material.label else ', which needs a label'))


def _overconsolidation(OCR, material, depth):
	"""Overconsolidation ratio at these depths."""
	value = _ofMaterial('OCR', 1 if OCR is None else OCR, material)
	values = [value(d) for d in depth.tolist()] if callable(value) else [value]
	for one in values:
		if not isNumber(one):
			raise TypeError(f'geostatic: OCR = {brief(one)} must be a number >= 1, a function of the depth [m] that returns one, or a dict of them')
		if not (math.isfinite(one) and one >= 1): raise ValueError(f'geostatic: OCR = {brief(one)} must be finite and >= 1')
	return np.broadcast_to(np.array(values, float), depth.shape)


def _sineOfFriction(material, points, rows):
	"""Sine of the angle of friction; for Cam clay that of triaxial compression. None without friction."""
	if hasattr(material, 'criticalStateRatio'):
		ratio = parameter('criticalStateRatio', material, points, rows)
		return 3 * ratio / (6 + ratio)
	return np.sin(parameter('frictionAngle', material, points, rows)) if hasattr(material, 'frictionAngle') else None


def _ratio(K0, material, sine, history):
	"""K0 of a material with these overconsolidation ratios."""
	value = _ofMaterial('K0', K0, material)
	if value is None:
		_requireKnownRatio(material)
		return np.full(len(history), material.poisson / (1 - material.poisson)) if sine is None else getattr(material, 'K0nc', 1 - sine) * history**sine
	if not isNumber(value): raise TypeError(f'geostatic: K0 = {brief(value)} must be a number, the ratio of horizontal to vertical stress, or a dict of them')
	if not (math.isfinite(value) and value >= 0): raise ValueError(f'geostatic: K0 = {brief(value)} must be finite and >= 0')
	if value > _mostPressed: _library.warn(f'geostatic: K0 = {brief(value)}: the horizontal stress would be that many times the vertical one, more than sand bears when it is pushed; is it in percent?')
	return np.full(len(history), float(value))


def _requireKnownRatio(material):
	"""Laws of other classes need not be isotropic, whatever these have of Young's modulus and Poisson's ratio."""
	if type(material) in _isotropic: return
	raise ValueError(
	        f"geostatic: K0 = None, but that of the material {material.label!r} is not known: {type(material).__name__} is no class of the table of K0, whose laws are isotropic; give "
	        f"its ratio of horizontal to vertical stress, as K0=0.5 or K0={{{material.label or 'soil'!r}: 0.5}}"
	)


def _preconsolidation(criticalStateRatio, sine, pressure, ratio, history):
	"""Preconsolidation pressure of Cam clay: the end of the yield surface Q^2 / M^2 + P (P - pc) = 0 through the past or the present state, whichever is larger."""

	def through(vertical, ratio):
		P, Q = (1 + 2 * ratio) / 3 * vertical, np.abs(1 - ratio) * vertical
		return P + (Q / criticalStateRatio)**2 / P

	return np.maximum(through(history * pressure, ratio / history**sine), through(pressure, ratio))


class _Rows:
	"""The horizontal rows of points, from the top; refuses ground that is not level. Bodies have no part in it: those that stand out of it weigh nothing here.

	Points of several sizes (MpmGrid.refinements, points that were split) are cut into horizontal slices of the smallest thickness, which are what rows are made of; a value of a point is
	that of its slices, or their mean.
	"""

	def __init__(self, points, height, half, density, isBody):
		number = np.maximum(np.rint(half / half.min()), 1).astype(int)  # number of slices, by point
		self.point = np.repeat(np.arange(len(half)), number)
		first = np.cumsum(number) - number
		offset = (2 * (np.arange(number.sum()) - first[self.point]) + 1) / number[self.point] - 1
		height, half = height[self.point] + offset * half[self.point], half[self.point] / number[self.point]
		density, isBody, volume = density[self.point], isBody[self.point], points['volume'][self.point] / number[self.point]
		self.order = np.argsort(-height, kind='stable')
		step = 2 * half.min()
		self.row = np.concatenate([[0], np.cumsum(-np.diff(height[self.order]) > 1e-6 * step)])  # row of each point, in this order
		self.isGround = ~isBody[self.order]
		first = np.flatnonzero(np.diff(self.row, prepend=-1))
		self.level, self.thickness = height[self.order][first], 2 * half[self.order][first]
		self.density = self._ofFirst(density[self.order], first)
		area = np.bincount(self.row, (volume / (2 * half))[self.order])
		hasGround = np.bincount(self.row, self.isGround) > 0
		self.isAbove = np.cumsum(hasGround | (np.abs(area / area.max() - 1) < 1e-9)) == 0
		self.density[self.isAbove] = 0
		self._requireEqual(density[self.order], half[self.order], area)
		gaps = np.flatnonzero(np.abs(self.level[:-1] - self.level[1:] - (self.thickness[:-1] + self.thickness[1:]) / 2) > 1e-6 * step)
		if gaps.size: raise ValueError(f'geostatic: the ground has a gap or an overlap between the heights {self.level[gaps[0] + 1]} and {self.level[gaps[0]]} m')

	def _requireEqual(self, density, half, area):
		level, row = self.level, self.row
		mixed = np.flatnonzero(np.abs(half * 2 / self.thickness[row] - 1) > 1e-9)
		if mixed.size: raise ValueError(f'geostatic: the points at the height {level[row[mixed[0]]]} m differ in size; only horizontal layers are at rest')
		heavier = np.flatnonzero((density != self.density[row]) & self.isGround)
		if heavier.size:
			raise ValueError(
			        f'geostatic: the points at the height {level[row[heavier[0]]]} m differ in density ({self.density[row[heavier[0]]]} and {density[heavier[0]]} kg/m3); only horizontal '
			        'layers are at rest. A wall or pile that is wished in place is of a material of its own, in bodies=["wall"]; or is poured afterwards, by mpm.stages.replace. Or let gravity grow first: gravityCurve = [(0, 0), (1, 1)], loadCurve = [(1, 0), (2, 1)]'
			)
		first = np.argmin(self.isAbove)
		unequal = np.flatnonzero((np.abs(area / area[first] - 1) > 1e-9) & ~self.isAbove)
		if unequal.size:
			raise ValueError(
			        f'geostatic: the ground is not level, or has a hole: the points at the height {level[first]} m cover {area[first]} m2, those at '
			        f'{level[unequal[0]]} m cover {area[unequal[0]]} m2 (in plane strain per metre of thickness). Fill level ground, call geostatic, and dig out '
			        'what is missing (mpm.stages.excavate), or place what is on top (mpm.stages.place). Or let gravity grow first, and then the loads: '
			        'gravityCurve = [(0, 0), (1, 1)], loadCurve = [(1, 0), (2, 1)]'
			)

	def _ofFirst(self, values, first):
		"""Values of the first point of ground in each row, or of the first point if there is no ground."""
		found = values[first].copy()
		rows, at = np.unique(self.row[self.isGround], return_index=True)
		found[rows] = values[self.isGround][at]
		return found

	def ofGround(self, values):
		"""Values (N,) of the points in the place of bodies: those of the ground in their row, or where there is none their own."""
		ordered = self.ofSlices(values)
		own = ordered.copy()
		ground = self._ofFirst(ordered, np.flatnonzero(np.diff(self.row, prepend=-1)))[self.row]
		hasGround = np.bincount(self.row, self.isGround)[self.row] > 0
		own[hasGround] = ground[hasGround]
		return self._means(own)

	def requireRest(self, vertical, horizontal):
		"""Refuses pressures (N,) that differ along a row of ground: what is pressed more moves towards what is pressed less. Points of other sizes have their middle elsewhere: of them
		the ratio is compared."""
		ratio = horizontal / np.where(vertical > 0, vertical, 1)
		size = self.ofSlices(np.bincount(self.point))
		for values, groups in (ratio, self.row), (horizontal, self.row * (size.max() + 1) + size):
			ordered, ground = self.ofSlices(values), groups[self.isGround]
			low, high = np.full(groups.max() + 1, math.inf), np.full(groups.max() + 1, -math.inf)
			np.minimum.at(low, ground, ordered[self.isGround])
			np.maximum.at(high, ground, ordered[self.isGround])
			differing = np.flatnonzero(high - low > 1e-6 * np.abs(values).max())
			if differing.size: self._refuseUnequalStress(np.flatnonzero(self.isGround & (groups == differing[0])), self.ofSlices(horizontal))

	def _refuseUnequalStress(self, slices, horizontal):
		raise ValueError(
		        f'geostatic: the horizontal stress of the points at the height {self.level[self.row[slices[0]]]} m differs, from {-horizontal[slices].max():.6g} to '
		        f'{-horizontal[slices].min():.6g} Pa, as K0 (by friction, OCR) or the pressure of water is not the same along the row; only horizontal layers are at rest. Give one K0 for '
		        'all, as in geostatic(K0=0.5), or let gravity grow first: gravityCurve = [(0, 0), (1, 1)], loadCurve = [(1, 0), (2, 1)]'
		)

	def areAbove(self):
		"""True for each point that stands out of the ground."""
		return self.toPoints(self.isAbove) > 0

	def areAlike(self, values):
		"""True if values (N,) of the points are the same all along each row."""
		ordered = self.ofSlices(values)
		first = ordered[np.flatnonzero(np.diff(self.row, prepend=-1))]
		return (np.abs(ordered - first[self.row]) <= 1e-9 * np.abs(values).max()).all()

	def above(self, values):
		"""Integral of values (N,) of the points over the height, from the top to the middle of each point; of each row their mean."""
		parts = np.bincount(self.row, self.ofSlices(values)) / np.bincount(self.row) * self.thickness
		return self.toPoints(np.cumsum(parts) - parts / 2)

	def weightAbove(self, cover):
		"""Mass per area above the middle of each point [kg/m2]; *cover*: height of soil above the highest points."""
		masses = self.density * self.thickness
		return self.toPoints(cover * self.density[0] + np.cumsum(masses) - masses / 2)

	def toPoints(self, ofRows):
		return self._means(ofRows[self.row])

	def ofSlices(self, values):
		"""Values (N,) of the points at their slices, in the order of these."""
		return values[self.point][self.order]

	def _means(self, ordered):
		"""Mean of the values of its slices for each point."""
		return np.bincount(self.point[self.order], ordered) / np.bincount(self.point)
