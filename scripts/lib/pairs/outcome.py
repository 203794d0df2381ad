# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of conditions as the scene has them, and means that cells and steps of half the size hardly change."""
import numpy as np

from yade.wrapper import *


def resultantsOf(solver):
	"""Forces of the loads on surfaces [N]."""
	return [load.resultant for load in solver.loads if isinstance(load, MpmTraction)]


def structuresOf(solver, view):
	"""Results of beams, bars, bodies that touch and water that flows, by name: values and the name of the unit, or None where the largest value is it."""
	found = {}
	for number, load in enumerate(load for load in solver.loads if not isinstance(load, MpmTraction)):
		results = _ofBeam(load, view) if isinstance(load, MpmBeam) else _ofBar(load, view)
		found |= {f'{name} of {type(load).__name__} {number}': result for name, result in results.items()}
		for anchor in getattr(load, 'anchors', ()):
			found |= {f'{name} of the anchor': result for name, result in _ofBar(anchor, view).items()}
	for contact in solver.contacts:
		if isinstance(contact, MpmBodyContact): found |= _ofBodies(contact, view)
	if solver.flow: found |= _ofFlow(solver.flow, view)
	return found


def _ofBeam(beam, v):
	"""From head to foot as the scene has it: a line that is drawn backwards, or mirrored, has its left on the other side."""
	turned, isBackwards = np.linalg.det(v.turn), v.order is not None
	sign = turned * (-1 if isBackwards else 1)
	ordered = lambda values: np.array(values, float)[::-1 if isBackwards else 1]
	left, right = (beam.leftPressures, beam.rightPressures)[::1 if sign > 0 else -1]
	moment, force = v.S * v.L**2, v.S * v.L
	found = dict(moments=(sign * ordered(beam.moments) / moment, 'moment'), shearForces=(turned * ordered(beam.shearForces) / force, 'force'), axialForces=(ordered(beam.axialForces) / force, 'force'))
	found |= dict(leftPressures=(ordered(left) / v.S, 'stress'), rightPressures=(ordered(right) / v.S, 'stress'), rotations=(turned * ordered(beam.rotations), 'strain'))
	found |= dict(vertices=(v.back('pos', ordered(beam.vertices)), 'length'))
	if v.isRing: found |= dict(hoopForces=(ordered(beam.hoopForces) / force, 'force'), hoopMoments=(sign * ordered(beam.hoopMoments) / moment, 'moment'))
	return found


def _ofBar(bar, v):
	found = dict(axialForces=(np.array(bar.axialForces) / v.F, 'force'), bondForces=(np.array(bar.bondForces) / v.F, 'force'), slips=(np.array(bar.slips) / v.L, 'displacement'))
	return found | dict(vertices=(v.back('pos', bar.vertices), 'length'))


def _ofBodies(contact, v):
	force = np.array(contact.force)
	moment = np.array(contact.moment) - np.cross(v.point((0, 0, 0)), force)
	return {'force between bodies': (v.forces([force]), 'force'), 'moment between bodies': (v.torques([moment])[:, 2:] if v.dim == 2 else v.torques([moment]), 'moment'), 'touching': (np.array([float(contact.touching)]), None)}


def _ofFlow(flow, v):
	found = {name: (np.array([getattr(flow, name)]) / v.volume, 'volume') for name in ('waterIn', 'waterOut', 'waterStored')}
	return found | {f'discharge of drain {k}': (np.array([drain.discharge]) / v.volume * v.T, 'discharge') for k, drain in enumerate(flow.drains)}


def meansOf(run):
	"""Means of displacements, stresses and pressures over the volume, forces, moments and energies: numbers and the size below which their differences are none."""
	units, volume = run.scene.units(), run.points['volume'] / run.points['volume'].sum()
	root = lambda values: float(np.sqrt(volume @ (values.reshape(len(volume), -1)**2).sum(1)))
	small = dict(displacement='displacement', stress='stress', excessPressure='stress', velocity='velocity')
	found = {name: (root(run.points[name]), .05 * units.get(unit, 0)) for name, unit in small.items() if name in run.points and np.isfinite(run.points[name]).all()}
	for name, forces in run.forces.items():
		if len(forces) and not run.scene.isDynamic: found[name] = (float(np.linalg.norm(np.nansum(forces, axis=0))), .05 * units['force'])
	for name, (values, unit) in run.others.items():
		if name.startswith(('moments', 'axialForces', 'force', 'discharge', 'waterStored')) and len(values): found[name] = (float(np.nanmax(np.abs(values))), .05 * units[unit])
	energies = {name: float(run.energies[name][0]) for name in ('elasticEnergy', 'kineticEnergy', 'loadWork', 'plasticWork') if name in run.energies}
	found |= {name: (energy, max([.1 * units['energy'], *map(abs, energies.values())])) for name, energy in energies.items()}
	return found


def apart(run, other, name, admitted):
	"""Means that cells or steps of half the size change by more than is admitted, as sentences."""
	if other.error: return [f'{name}: {other.error}']
	found, finer = [], meansOf(other)
	for what, (value, small) in meansOf(run).items():
		off = abs(value - finer[what][0]) / max(abs(value), abs(finer[what][0]), small, 1e-300)
		if off > admitted: found.append(f'{name}: {what} {value:.4g} becomes {finer[what][0]:.4g}, {100 * off:.0f} % apart')
	return found
