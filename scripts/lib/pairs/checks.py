# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a scene in YADE as it is and as others would look at it, and compares; and looks at its balance."""
import os
import random
import tempfile

import numpy as np

import yade
from yade import log, mpm, pack, utils
from yade.wrapper import *

from .features import refusals, refused
from .kinds import kinds
from .outcome import apart, resultantsOf, structuresOf
from .scene import Scene, density, gravity
from .view import View, views

O = Omega()
log.setLevel('Default', log.ERROR)  # many scenes are warned of, for gravity that acts upwards in a view
# Operations that are exact in binary numbers, and sum nothing in another order, keep the bits: see
# differences
exact = {'again', 'two threads', 'saved and loaded', 'scaled'}
roundOff = 1e-14


class Run:
	"""Outcome of a scene: quantities by name, as the scene has them; forces, energies; or the refusal."""

	def __init__(self, scene, view):
		self.scene, self.view, self.error = scene, view, None
		self.text = scene.text(view)
		self.impulse, self.first = np.zeros(3), None
		try:
			self._make()
		except Exception as error:
			self.error = f'{type(error).__name__}: {error}'
			return
		self._collect()

	def _make(self):
		space = {name: getattr(yade.wrapper, name) for name in dir(yade.wrapper) if not name.startswith('_')}
		space |= dict(O=O, inf=np.inf, mpm=mpm, pack=pack, utils=utils, Vector3=yade.minieigenHP.Vector3)
		exec(compile(self.text, '<scene>', 'exec'), space)
		self.steps = []  # momentum [N s] and the forces from outside [N] of each step
		for step in range(space['steps']):
			solver = next(e for e in O.engines if e.label == 'solver')
			exec(space['actions'].get(step, ''), space | dict(solver=solver))
			if self.view.restart and step == 2:
				with tempfile.TemporaryDirectory() as folder:
					mpm.save(os.path.join(folder, 'half.yade.gz'))
					O.load(os.path.join(folder, 'half.yade.gz'))
			O.step()
			if self.isPlain: self.steps.append(self._balanceOfStep())
		self.solver = next(e for e in O.engines if e.label == 'solver')

	@property
	def isPlain(self):
		v = self.view
		return not v.restart and v.L == v.S == v.D == 1 and v.order is None and (v.turn == np.eye(3)).all()

	def _balanceOfStep(self):
		solver = next(e for e in O.engines if e.label == 'solver')
		curve = dict(solver.gravityCurve or solver.loadCurve)
		ofGravity, factor = (np.interp(solver.loadTime, *zip(*sorted(c.items()))) for c in (curve, dict(solver.loadCurve)))
		forces = [np.array(f) for f in (*solver.reactions, *resultantsOf(solver))] + [-np.array(f) for contact in solver.contacts if isinstance(contact, MpmContact) for f in contact.forces]
		momentum, points = np.zeros(3), [b for b in O.bodies if isinstance(b.shape, MpmPoint) and (solver.mask in (-1, 0) or b.groupMask & solver.mask)]
		for b in points:
			mass = b.material.density * b.state.volume0
			momentum += mass * np.array(b.state.vel)
			share = b.material.density / density  # part of the weight in stages: the twin of the material has it, and point loads go with the weight
			forces += [mass * ofGravity * np.array(solver.gravity), share * factor * np.array(b.state.force)]
		return momentum, sum(forces), sum(np.linalg.norm(f) for f in forces)

	def _collect(self):
		v, solver = self.view, self.solver
		points = _withTensors(mpm.arrays())
		where = v.back('pos0', points['pos0'])
		keys = np.round(where / (self.scene.cell * 1e-4)).astype(int)
		if self.scene.dim == 2: keys[:, 2] = 0
		order = np.lexsort((keys[:, 2], keys[:, 1], keys[:, 0]))
		self.keys = keys[order]
		skipped = ('id', 'material', 'parent', 'pos0', 'halfSize0', 'velocity0', 'body', 'colour', 'parameters')
		self.points = {name: v.back(name, values)[order] for name, values in points.items() if name not in skipped and np.asarray(values).dtype.kind in 'fi'}
		self.points['displacement'] = (self.points['pos'] - where[order])
		if self.scene.dim == 2: self.points['displacement'][:, 2] = 0
		self.forces = {'reactions': v.forces(solver.reactions), 'resultants': v.forces(resultantsOf(solver))}
		self.torques = {}
		for contact in solver.contacts:
			if isinstance(contact, MpmBodyContact): continue
			self.forces['contact'] = v.forces(contact.forces)
			about = np.array(v.point((0, 0, 0)))
			self.torques['contact'] = v.torques([np.array(t) + np.cross(np.array(O.bodies[i].state.pos) - about, f) for i, f, t in zip(contact.bodies, contact.forces, contact.torques)])
		data = solver.plotData()
		self.data = data
		names = ['elasticEnergy', 'kineticEnergy', 'loadWork', 'boundaryWork', 'contactWork', 'impactWork', 'ghostWork', 'gridWork', 'plasticWork', 'dampingWork', 'energyImbalance']
		self.energies = {name: np.array([data[name]]) / (v.F * v.L) for name in names if name in data}
		self.others = structuresOf(solver, v)
		self.iterations, self.cuts = solver.iterations, solver.cuts
		self.weight = sum(density * b.state.volume0 / v.volume for b in O.bodies if isinstance(b.shape, MpmPoint) and (solver.mask in (-1, 0) or b.groupMask & solver.mask))


def _withTensors(points):
	"""Columns of which six are a symmetric tensor as one column of matrices."""
	names = {name[:-2] for name in points if name.endswith('XX')}
	for name in names:
		xx, yy, zz, xy, yz, zx = (points.pop(name + end) for end in ('XX', 'YY', 'ZZ', 'XY', 'YZ', 'ZX'))
		points[name] = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)
	return points


def differences(run, other, name):
	"""Differences that are larger than they should be, as sentences."""
	if run.error or other.error: return [] if (run.error or '').split(' ')[:3] == (other.error or '').split(' ')[:3] else [f'{name}: {other.error or "no exception"}, unlike {run.error or "no exception"}']
	units = run.scene.units()
	if run.keys.shape != other.keys.shape or (run.keys != other.keys).any():
		if run.keys.shape != other.keys.shape: return [f'{name}: {len(other.keys)} points instead of {len(run.keys)}']
		return [f'{name}: initial positions differ']
	isRounded = name == 'scaled' and (not run.scene.isExact or run.scene.shape in ('facet', 'facets') and run.scene.dim == 2)  # YADE's place of a facet, from which it counts its corners; z stays in the plane
	limit = 0 if name in exact and not isRounded else run.scene.close
	found = []

	def compare(what, a, b, unit):
		with np.errstate(invalid='ignore'):
			if a.shape != b.shape: return found.append(f'{name}: {what} has another shape')
			if np.array_equal(a, b, equal_nan=True): return
			largest = max(np.nanmax(np.abs(a), initial=0), unit)
			off = np.abs(a - b)
			if (np.isnan(a) != np.isnan(b)).any(): return found.append(f'{name}: {what} is not a number in one of them only')
			if np.nanmax(off) > limit * largest: found.append(f'{name}: {what} differs by {np.nanmax(off) / largest:.1e} of {largest:.3g}')

	sizes = dict(stress=units['stress'], porePressure=units['stress'], excessPressure=units['stress'], elasticStrain=units['strain'], displacement=units['displacement'], pos=1e300 if limit else 0, defGrad=1, volume=0, halfSize=0, velocity=gravity * run.scene.dt, acceleration=gravity)
	for what, values in run.points.items():
		if what == 'pos' and limit: continue
		compare(what, values, other.points[what], sizes.get(what, 0))
	force = max([units['force']] + [np.nanmax(np.abs(f), initial=0) for f in run.forces.values()])
	for what, values in run.forces.items():
		compare(what, values, other.forces[what], force)
	for what, values in run.torques.items():
		if run.scene.dim == 2: values, other.torques[what] = values[:, 2:], other.torques[what][:, 2:]
		compare('torque', values, other.torques[what], force * units['length'])
	energy = max([units['energy']] + [np.nanmax(np.abs(e), initial=0) for e in run.energies.values()])
	for what, values in run.energies.items():
		compare(what, values, other.energies[what], energy)
	for what, (values, unit) in run.others.items():
		compare(what, values, other.others[what][0], max(np.nanmax(np.abs(values), initial=0) if unit is None else units[unit], 1e-300))
	if limit == 0 and (run.iterations, run.cuts) != (other.iterations, other.cuts): found.append(f'{name}: {other.iterations} iterations and {other.cuts} cuts instead of {run.iterations} and {run.cuts}')
	return found


def check(chosen, seed):
	"""One scene: outcome ('right', 'refused', 'failed' at a step, or 'wrong'), findings, and the error of the run if there was one."""
	scene = lambda: Scene(chosen, seed)
	dim, isRing = scene().dim, scene().isRing
	plain = View(dim, isRing)
	run = Run(scene(), plain)
	pairs = refusals(chosen)
	if pairs:
		words = refused[pairs[0]]
		isSo = run.error and all(word in run.error for word in words)
		return dict(outcome='refused' if isSo else 'wrong', findings=[] if isSo else [f'not refused by {words}: {run.error or "no exception"}'], error=run.error)
	if run.error: return dict(outcome='wrong', findings=[f'failed: {run.error}'], error=run.error)
	found = balance(run)
	for name, view in views(dim, chosen, random.Random(seed), scene().cell).items():
		found += differences(run, Run(scene(), view), name)
	return dict(outcome='wrong' if found else 'right', findings=found, error=None)


def checkKind(name, seed):
	"""One scene of a kind: outcome ('right', 'stops' with an exception in each copy alike, or 'wrong'), findings, and the error of the run if there was one."""
	scene = lambda **more: kinds[name](seed, **more)
	first = scene()
	run = Run(first, View(first.dim, first.isRing))
	found = [] if run.error else balanceOfKind(run)
	for copy, view in views(first.dim, ['axisymmetric'] if first.isRing else [], random.Random(seed), first.cell).items():
		if copy not in ('two threads', *first.without): found += differences(run, Run(scene(), view), copy)
	if found and not run.error: found += sensitivity(run, Run(scene(), View(first.dim, first.isRing, heavier=roundOff)))
	for copy, admitted in first.admitted.items():
		if copy not in first.without and not run.error: found += apart(run, Run(scene(**{copy: 2}), View(first.dim, first.isRing)), copy, admitted)
	return dict(outcome='wrong' if found else 'stops' if run.error else 'right', findings=found, error=run.error)


def sensitivity(run, heavier):
	"""Differences that round-off of gravity makes, as sentences: none where the position of the scene decides, as by a tie between two cells."""
	name = f'gravity times 1 + {roundOff:.0e}'
	return differences(run, heavier, name) or [f'{name}: no difference']


def balanceOfKind(run):
	"""Forces in statics are nothing in sum; in time no energy is lost without a name, or won."""
	scene, found = run.scene, []
	if scene.isBalanced and not scene.isDynamic: found += leftOver(run)
	if scene.isDynamic and scene.isEnergyKnown:
		energies = {name: values[0] for name, values in run.energies.items()}
		size = max([scene.units()['energy'] * 1e-2] + [abs(energies[name]) for name in ('kineticEnergy', 'elasticEnergy', 'loadWork', 'plasticWork')])
		if abs(energies['energyImbalance']) > scene.imbalance * size: found.append(f"energy: {energies['energyImbalance'] / size:.1e} of {size:.3g} J is not accounted for")
	return found


def leftOver(run):
	"""Forces from outside that are not nothing in sum, as sentences."""
	axes, found = [1] if run.scene.isRing else range(run.scene.dim), []
	for step, (_, force, sizes) in enumerate(run.steps):
		off = max(abs(force[a]) for a in axes) / max(sizes, run.scene.units()['force'])
		if off > 1e-8: found.append(f'balance: {off:.1e} of the forces are left over after step {step + 1}')
	return found


def balance(run):
	"""Forces from outside are nothing in sum, or what momentum changes by; a fixed smooth body gives no energy. What water does to the body from outside is told by nobody: not asked there."""
	scene, found = run.scene, []
	if not scene.isDynamic and not scene.water: found += leftOver(run)
	isLoaded = scene.has('traction', 'pressure', 'pointLoad')  # true if forces change, for which the other schemes take other means, as contact does in all
	if scene.isFreeAlongX and not scene.water and not scene.shape and (scene.scheme == 'newmark' or not isLoaded):
		for step in range(1, len(run.steps)):
			(before, force0, size0), (after, force1, size1) = run.steps[step - 1:step + 1]
			off = abs((after - before - scene.dt * (force0 + force1) / 2)[0]) / (scene.dt * max(size0, size1, scene.units()['force']))
			if off > 1e-8: found.append(f'momentum: {off:.1e} of the impulse is left over along x after step {step + 1}')
	if scene.isDynamic and scene.has('fixedBody') and not scene.has('friction'):
		given, energy = run.energies['contactWork'][0], max(scene.units()['energy'], run.energies['kineticEnergy'][0] + run.energies['elasticEnergy'][0])
		if given > 1e-6 * energy: found.append(f'energy: a fixed smooth body has given {given / energy:.1e} of {energy:.3g} J')
	return found
