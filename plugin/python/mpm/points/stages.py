# SPDX-License-Identifier: GPL-2.0-or-later
"""Stages of construction: layers that are placed, soil that is dug out or becomes concrete, supports that are taken away.

Each function changes the scene between two load steps; what it begins goes on while ``O.run`` makes the next steps, by a PyRunner before the engine, which ``O.save`` keeps::

    solver.gravityCurve = solver.loadCurve = [(0, 1)]  # weight acts from the beginning, loads by curves of their own
    mpm.stages.place(mpm.fill(layer, grid, 2, 'sand'), steps=10)
    O.run(10, wait=True)
    mpm.stages.resetDisplacements()
    mpm.stages.excavate(pit, steps=10)
    O.run(10, wait=True)

A load that comes back is a ``curve`` of its MpmTraction, as ``[(0, 0), (1, 1), (2, 0), (3, 1)]``.
"""
import ast

import numpy as np
from yade import wrapper

from ..base.messages import brief
from ..base.naming import materialOf
from ..base.recorders import nameInScenes, runnerOf
from ..base.solver import noPoints, solverOf
from ..geometry.regions import inside
from ..library import engine as _library
from .data import arrays, assign, pointsOf, withMaterials
from .suction import pressureOnGrains

__all__ = ['place', 'excavate', 'replace', 'release', 'resetDisplacements']
nameInScenes('stages', __name__)
_softness = 0.05  # part of its stiffness that is left to soil that is dug out
_ofPores = 'conductivity', 'verticalConductivity', 'porosity', 'alpha', 'entry', 'n', 'exponent', 'residual', 'saturated'  # what it keeps of parameters of points


def place(bodies, steps=1, solver=None):
	"""Append material points, as :func:`fill` returns them, to the scene; their weight grows to its full value in the next *steps* load steps, in equal parts, and with it what water does to them and point loads on them.

	Points begin without stress, where they have been filled, and with *MpmFlow.total* have the water of the pressures that they are given (:func:`assign`). What has been there settles meanwhile: fill a layer up to its height at the end.

	:param bodies: material points that the scene does not have yet; or the range of ids of those that :func:`add` has just put there
	:param steps: load steps, an integer >= 1
	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:return: ids of the bodies
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: no bodies, *steps* < 1, ids of no material points or of another engine, or a material that cannot be found by its label.
	"""
	solver, steps = _static('place', solver), _number('place', steps)
	ids, materials = _added(bodies, solver) if isinstance(bodies, range) else _append(bodies, solver)
	_library.lookAtPlaced(solver, list(ids))
	if steps > 1: _begin('placed', solver, steps, {label: _twin(material, f'{label}/placed', ids, density=material.density / steps) for label, material in materials.items()})
	return ids


def _append(bodies, solver):
	"""Ids, and materials by label."""
	bodies = list(bodies) if isinstance(bodies, (list, tuple)) else []
	if not bodies or not all(isinstance(body, wrapper.Body) and isinstance(body.shape, wrapper.MpmPoint) for body in bodies):
		raise TypeError('place: bodies must be a list of material points, as mpm.fill(...) returns it')
	if any(body.id >= 0 for body in bodies): raise ValueError('place: the scene has these bodies already; place(mpm.fill(...)) appends them')
	if not all(_isOf(solver, body.groupMask) for body in bodies): raise ValueError(f'place: bodies have a groupMask that does not go with mask = {solver.mask} of the solver, whose steps the stage counts')
	materials = _byLabel('place', [body.material for body in bodies])
	return wrapper.Omega().bodies.append(bodies), materials


def _isOf(solver, groupMask):
	return solver.mask in (0, -1) or groupMask & solver.mask


def _added(ids, solver):
	"""The same of points that the scene has."""
	points, materials, number = pointsOf(solver)
	isNew = np.isin(points['id'], ids)
	if not len(ids) or isNew.sum() < len(ids): raise ValueError(f'place: bodies = {brief(ids)} must be ids of material points of the scene and of the solver, as mpm.add(...) returns them')
	return list(ids), _byLabel('place', [materials[i] for i in np.unique(number[isNew])])


def excavate(region, steps=1, solver=None):
	"""Take the material points of an engine out of a region. What they do to the others, by stress, weight, point loads and water, goes to zero in the next *steps* load steps, in equal parts.

	Until they are erased in the last one, they go along as elastic material with a twentieth of their stiffness, in which the excess pressure of the water is part of the stress. With *MpmImplicitEngine.flow* water passes it until then, and goes with it in the end.

	:param region: predicate of the current positions, as for :func:`fill`
	:param steps: load steps, an integer >= 1
	:param solver: the ``MpmImplicitEngine`` whose points are meant (those of its ``mask``); may be left out when ``O.engines`` holds one
	:return: number of the points
	:raises TypeError: an argument of the wrong kind.
	:raises ValueError: no point is in the region, all are, a load of the engine would be left in the air, *steps* < 1, or a material that cannot be found by its label.
	"""
	solver, steps = _static('excavate', solver), _number('excavate', steps)
	points, materials, number, inRegion = _pointsIn('excavate', region, solver)
	if inRegion.all(): raise ValueError(f'excavate: all material points are in the region {brief(region)}')
	_requireNoLoad(solver, points, inRegion)
	ids, stress = points['id'][inRegion].tolist(), _totalStress(points, solver, materials, number)[inRegion]
	materials = _byLabel('excavate', [materials[i] for i in np.unique(number[inRegion])])
	if steps == 1:
		_erase(ids)
		return len(ids)
	twins = {label: _soft(material, f'{label}/excavated', ids) for label, material in materials.items()}
	assign(ids=ids, stress=stress)
	_begin('excavated', solver, steps, twins)
	return len(ids)


def _pointsIn(who, region, solver):
	"""Points of the solver, their materials with the number of each point's, and which points are in the region."""
	if not callable(region): raise TypeError(f'{who}: region = {brief(region)} must be a predicate, as for mpm.fill')
	points, materials, number = pointsOf(solver)
	if not len(points['id']): raise ValueError(noPoints(who, solver))
	inRegion = inside(region, points['pos'])
	if not inRegion.any(): raise ValueError(f'{who}: no material point is in the region {brief(region)}')
	return points, materials, number, inRegion


def replace(region, material, steps=1, solver=None):
	"""Make the material points in a region points of another material: a slurry wall that is poured, ground that is grouted. Their total stress stays as it is, so that nothing moves at
	once: grains of drained material take what the water of undrained soil has borne; what they are heavier or lighter by comes in the next *steps* load steps, in equal parts.

	Of the new material they are as it is new: without plastic strain, strengths and moduli of their own; with ``MpmFlow(total=True)`` with the water of its retention curve. The density is that of their initial volume, as of all points.

	:param region: predicate of the current positions, as for :func:`fill`
	:param material: label of a material in ``O.materials``
	:param steps: load steps, an integer >= 1
	:param solver: the ``MpmImplicitEngine`` whose points are meant (those of its ``mask``); may be left out when ``O.engines`` holds one
	:return: number of the points
	:raises TypeError: an argument of the wrong kind, or a material that is none of points.
	:raises KeyError: no material has this label.
	:raises ValueError: no point is in the region, *steps* < 1, or a stress that the new material cannot carry without yielding; all points are then as before.
	"""
	solver, steps = _static('replace', solver), _number('replace', steps)
	points, materials, number, inRegion = _pointsIn('replace', region, solver)
	new = materialOf('replace', material)
	if not isinstance(new, wrapper.MpmMaterial): raise TypeError(f'replace: material = {brief(material)} is a {type(new).__name__}, which is no material of material points')
	ids = points['id'][inRegion].tolist()
	isDrained = np.array([m.undrained and not new.undrained for m in materials])[number[inRegion]]
	stress = np.where(isDrained[:, None, None], _totalStress(points, solver, materials, number)[inRegion], points['stress'][inRegion])
	columns = {'stress': stress}
	if solver.flow and solver.flow.total and 'excessPressure' in points:
		there = {name: points[name][inRegion] for name in ('excessPressure', 'defGrad')}
		push = pressureOnGrains(solver.flow, there, [new], np.zeros(len(ids), int))
		stress = _totalStress(points, solver, materials, number)[inRegion] + push[:, None, None] * np.eye(3)
		columns = {'stress': stress, 'excessPressure': points['excessPressure'][inRegion]}
	before = np.array([m.density for m in materials])[number[inRegion]]
	_renew(ids, new, columns)
	if steps == 1: return len(ids)
	twins = {}
	for density in np.unique(before[before != new.density]).tolist():
		own = np.array(ids)[before == density].tolist()
		twin = _twin(new, f'{material}/replaced', own, density=density + (new.density - density) / steps)
		twins[twin.label] = (material, (density, new.density))
	if twins: _run('replaced', solver, steps, twins)
	return len(ids)


def _totalStress(points, solver, materials, number):
	"""Stress of the grains less the excess pressure of the water, or less what suction is to them. The pressure of an MpmWater is not part of it: that goes on acting."""
	if 'excessPressure' not in points: return points['stress']
	pressure = pressureOnGrains(solver.flow, points, materials, number) if solver.flow and solver.flow.total else points['excessPressure']
	return points['stress'] - pressure[:, None, None] * np.eye(3)


def _renew(ids, material, columns):
	"""Make them points of a material, with the stress (and pressure) that they are given; or after an error leave all as they are."""
	here = _here(ids)
	names = 'internals', 'parameters', 'plasticStrain', 'elasticStrain', 'excessPressure'
	known = [(body.material, [getattr(body.state, name) for name in names]) for body in here]
	for body in here:
		if body.material.undrained and not material.undrained: body.state.excessPressure = 0
		body.material = material
		body.state.internals, body.state.parameters, body.state.plasticStrain = [], [], 0
	try:
		assign(ids=ids, **columns)
	except ValueError as error:
		for body, (own, values) in zip(here, known):
			body.material = own
			for name, value in zip(names, values):
				setattr(body.state, name, value)
		raise ValueError(f"replace: {material.label!r} cannot carry the stress that the points have: {str(error).removeprefix('assign: ')}") from None


def _requireNoLoad(solver, points, inRegion):
	"""Refuses loads on ground that goes away: they would act in the air."""
	reach = points['halfSize'][:, :solver.grid.dim] + solver.grid.cellSize * 3 / 8  # half sizes of the domains, as far as a step admits
	middle = points['pos'][:, :solver.grid.dim]
	for i, load in enumerate(solver.loads):
		for place in np.array(load._places()).reshape(-1, 3)[:, :solver.grid.dim]:
			isNear = (np.abs(middle - place) <= reach).all(axis=1)
			if isNear.any() and inRegion[isNear].all():
				raise ValueError(f'excavate: loads[{i}] acts on what is to be dug out, at {brief(tuple(place.tolist()))}; take it from the loads of the engine first, or end its surface where the ground will end')


def release(boundary, solver=None):
	"""Take away a support, one of the engine's *boundaries*, at once: what it bears acts on the body in the next step.

	:param boundary: the ``MpmBoundary``, or its number in *boundaries*
	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:raises ValueError: it is none of the engine's.
	"""
	solver = solverOf('release', solver)
	boundaries = list(solver.boundaries)
	kept = [b for i, b in enumerate(boundaries) if b != boundary and (isinstance(boundary, bool) or i != boundary)]
	if len(kept) == len(boundaries): raise ValueError(f'release: boundary = {brief(boundary)} is none of the {len(boundaries)} boundaries of the engine')
	solver.boundaries = kept


def resetDisplacements():
	"""Count displacements from here: the initial position of each point becomes its current one. Stress, deformation and volume stay.

	:raises ValueError: a body with an ``MpmPoint`` shape that is no complete material point.
	"""
	assign(pos0=arrays()['pos'])


def advance(kind, label, first, steps, twins):
	"""For the PyRunner: what the next load step begins with. Called twice for a step, it changes nothing more."""
	scene = wrapper.Omega()
	engines = list(scene.engines)
	at = next(i for i, engine in enumerate(engines) if engine.label == label)
	solver = next(engine for engine in engines[at:] if isinstance(engine, wrapper.MpmImplicitEngine))
	step = solver.nDone - first + 1
	if step > steps: return
	if kind == 'replaced': _weigh(scene, twins, step / steps)
	share = step / steps if kind == 'placed' else 1 - step / steps
	for own, (twin, density) in twins.items() if kind != 'replaced' else ():
		ids = _idsOf(twin)
		if step == steps and kind == 'placed':
			for body in _here(ids):
				body.material = scene.materials[own]
		elif step == steps: _erase(ids)
		else: _scale(scene.materials[twin], share, density, ids, kind)
	if step == steps: engines[at].dead = True


def _weigh(scene, twins, share):
	"""Densities of what has been replaced; at the end it is of the material itself."""
	for twin, (label, (before, after)) in twins.items():
		scene.materials[twin].density = before + share * (after - before)
		for body in _here(_idsOf(twin)) if share == 1 else ():
			body.material = scene.materials[label]


def now(solver):
	"""Name and progress of the solver's last stage, for titles; empty if there has been none."""
	found = [engine for engine in wrapper.Omega().engines if engine.label.startswith('stage_')]
	for engine in reversed(found):
		kind, label, first, steps, _ = ast.literal_eval('(' + engine.command.partition('.advance(')[2])
		if not _isBefore(engine, solver): continue
		done = min(solver.nDone - first, steps)
		what = {'placed': 'placing', 'excavated': 'excavating', 'replaced': 'replacing'}[kind]
		return f'{what}, step {done} of {steps}' + (f'; load time {solver.loadTime:.4g}' if solver.nDone - first > steps else '')
	return ''


def _isBefore(runner, solver):
	"""True if the runner is this solver's: the next one behind it."""
	engines = list(wrapper.Omega().engines)
	return next((engine for engine in engines[engines.index(runner):] if isinstance(engine, wrapper.MpmImplicitEngine)), None) == solver


def resume():
	"""For a scene that has been loaded in mid-stage: water and point loads act on its layers as in the step before, which files do not say."""
	scene = wrapper.Omega()
	for engine in scene.engines:
		if engine.dead or not engine.label.startswith('stage_'): continue
		kind, *_, twins = ast.literal_eval('(' + engine.command.partition('.advance(')[2])
		for twin, density in twins.values() if kind != 'replaced' else ():
			_library.actInPart(scene.materials[twin], scene.materials[twin].density / density, kind == 'excavated')


def _scale(material, share, ofAll, ids, kind):
	_library.actInPart(material, share, kind == 'excavated')
	density = share * ofAll
	if abs(material.density - density) <= 1e-12 * density: return
	if kind == 'excavated':  # in proportion to the density; the law of what is dug out is linear
		points = arrays()
		strain = points['elasticStrain'][np.isin(points['id'], ids)]
		assign(ids=ids, elasticStrain=strain * (density / material.density))
	material.density = density


def _begin(kind, solver, steps, twins):
	"""*twins*: by the label of a material, its twin that changes."""
	names = {own: (twin.label, wrapper.Omega().materials[own].density) for own, twin in twins.items()}
	for twin in twins.values(): _library.actInPart(twin, 1 / steps if kind == 'placed' else 1, kind == 'excavated')
	_run(kind, solver, steps, names)


def _run(kind, solver, steps, names):
	"""A PyRunner before the engine."""
	scene = wrapper.Omega()
	engines = [engine for engine in scene.engines if not (engine.dead and engine.label.startswith('stage_'))]
	label = next(name for name in (f'stage_{i}' for i in range(len(engines) + 1)) if all(engine.label != name for engine in engines))
	runner = runnerOf('stages', f'advance({kind!r}, {label!r}, {solver.nDone}, {steps}, {names!r})', label)
	at = engines.index(solver)
	scene.engines = engines[:at] + [runner] + engines[at:]


def _twin(material, label, ids, **changes):
	"""A copy of a material, which those of the bodies take that have it."""
	values = {name: value for name, value in material.dict().items() if name not in ('id', 'label')}
	return _give(type(material)(**(values | changes)), material, label, ids)


def _soft(material, label, ids):
	"""The same of an elastic one with a part of the stiffness, without memory; points keep what their pores have of their own."""
	young, poisson = _elastic(material)
	ofPores = {name: getattr(material, name) for name in ('conductivity', 'porosity', 'conductivityLaw', 'conductivityIndex', 'retention')}
	soft = wrapper.MpmElasticMat(young=_softness * young, poisson=poisson, density=material.density, **ofPores)
	for body in _here(ids):
		if body.material != material: continue
		body.state.internals, body.state.plasticStrain = [], 0
		body.state.parameters = [(name, value) for name, value in body.state.parameters if name in _ofPores]
		if material.undrained: body.state.excessPressure = 0
	return _give(soft, material, label, ids)


def _elastic(material):
	"""Young's modulus and Poisson's ratio of about the stiffness of a law: of hardening soil those of unloading, which digging is; of undrained soil those of total stress."""
	young, poisson = _ofGrains(material)
	if not material.undrained: return young, poisson
	shear, bulk = young / (2 + 2 * poisson), young / (3 - 6 * poisson) + material.waterModulus
	return 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)


def _ofGrains(material):
	if hasattr(material, 'Eurref'): return material.Eurref, material.poisson
	if hasattr(material, 'young'): return material.young, material.poisson
	return 3 * material.shearModulus, 0.3


def _give(twin, material, label, ids):
	scene = wrapper.Omega()
	known = {m.label for m in scene.materials}
	twin.label = next(name for name in [label] + [f'{label}{i}' for i in range(2, len(known) + 3)] if name not in known)
	scene.materials.append(twin)
	for body in _here(ids):
		if body.material == material: body.material = twin
	return twin


def _byLabel(who, materials):
	found = {}
	for material in materials:
		if material.label in found: continue
		if not material.label or all(known != material for known in wrapper.Omega().materials):
			raise ValueError(f'{who}: a material of the points (label {material.label!r}) is not in O.materials, by a label of its own')
		found[material.label] = materialOf(who, material.label)
	return found


def _idsOf(label):
	points = arrays()
	return points['id'][points['material'] == wrapper.Omega().materials[label].id].tolist()


def _here(ids):
	"""Bodies of these ids that this process has."""
	bodies = wrapper.Omega().bodies
	return [body for body in (bodies[i] for i in ids) if body]


def _erase(ids):
	for body in _here(ids):
		wrapper.Omega().bodies.erase(body.id)


def _static(who, solver):
	solver = solverOf(who, solver)
	if isinstance(solver, wrapper.MpmDynamicEngine): raise ValueError(f'{who}: with inertia, weight that grows would be mass that grows; make the stages with an MpmImplicitEngine')
	if solver not in wrapper.Omega().engines: raise ValueError(f'{who}: the solver is not in O.engines; put it there first')
	return solver


def _number(who, steps):
	if isinstance(steps, bool) or not isinstance(steps, (int, np.integer)): raise TypeError(f'{who}: steps = {brief(steps)} must be an integer >= 1')
	if steps < 1: raise ValueError(f'{who}: steps = {brief(steps)} must be at least 1')
	return int(steps)
