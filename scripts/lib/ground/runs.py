# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs scenes, and judges them: each gets to its end, or fails where a run in finer steps fails too and equilibrium is not known to exist; forces balance; and what limit analysis bounds is within its bounds."""
import time

import numpy as np
from contacts.course import Course, reason, reasons, said
from yade.wrapper import Omega

from .scenes import sceneOf
from .soils import weight

O = Omega()
same = .05  # part of the load at which two runs fail
told = .05  # part of the work of a step that the stabilisation takes up: more is warned of
exact = 1e-5  # part of the sizes of all forces that may be out of balance in statics


def balanceOf(scene, solver):
	"""Forces from outside that are left over in statics, over the sum of their sizes. Not known where water presses on the ground."""
	if scene.isDynamic or solver.water: return 0.
	mass = weight * sum(b.state.volume0 for b in O.bodies if b)
	factor = 1. if solver.gravityCurve else solver.loadFactor
	forces = [np.array(F) for F in solver.reactions] + [factor * mass * np.array([-(axis == scene.up) for axis in range(3)], float)]
	return float(np.abs(sum(forces)[:scene.dim]).max() / sum(np.linalg.norm(F) for F in forces))


class Outcome:
	"""part: of the way that was made; why: it went no farther, empty if it got to its end."""

	def __init__(self, scene, finer, seconds, *settings):
		solver = scene.add(finer, *settings)
		self.part, self.off, self.share, self.why, self.solves, self.cuts = 0., 0., 0., '', 0, 0
		steps, ends = scene.steps * finer, time.process_time() + seconds
		for step in range(steps):
			try:
				scene.before(step, solver)
				O.step()
			except (RuntimeError, ValueError) as failure:
				self.why = reason(failure)
				self.part = max(self.part, solver.loadTime / (O.dt * steps))
			if time.process_time() > ends and not self.why: self.why = 'time is up'
			self.solves, self.cuts = self.solves + solver.iterations, self.cuts + solver.cuts
			if self.why: break
			self.part = (step + 1) / steps
			self.off = max(self.off, balanceOf(scene, solver))
			if not scene.isDynamic: self.share = max(self.share, solver.ghostShare)
		self.numbers = scene.isRight(solver) if not self.why else {}


def judged(seed, seconds, divide=1, strict=False, ghost=None, friction=False):
	"""A row of the table: how a scene ended ('ends', 'held' if it is said that only the stabilisation holds it, 'told' if it is said that a face stands that its strength cannot hold, 'fails' as it may, or 'stops'), and what is wrong with it.

	:param ghost: attributes of MpmGhost
	:param friction: leave out (None) all but static scenes in the plane of soil with friction
	"""
	began, scene = time.process_time(), sceneOf(seed)
	if friction and (scene.isDynamic or scene.dim == 3 or scene.soil.law not in ('mohrCoulomb', 'druckerPrager')): return None
	settings = divide, strict, ghost
	with said() as it:
		found = Outcome(scene, 1, seconds, *settings)
		how = 'ends' if not found.why else 'stops'
		if found.why and found.why != 'time is up' and scene.mayFail():
			again = Outcome(scene, 2, 2 * seconds, *settings)
			one, other = scene.load(found.part), scene.load(again.part)
			if again.why and abs(other - one) <= same * max(other, one): how = 'fails'
			else: found.why += f' (at {found.part:.3f}, in finer steps at {again.part:.3f})'
		elif not found.why and found.share > told: how = 'held'
	if how == 'ends' and 'Coulomb 1776' in it.text: how = 'told'
	wrong = [f'{name} {value:.3g}' for name, (value, isRight) in found.numbers.items() if not isRight and not (how in ('held', 'told') and name == 'moved')]
	if found.off > exact: wrong.append(f'balance {found.off:.1e}')
	return dict(seed=seed, scene=str(scene), how=how, part=found.part, why=found.why, wrong=', '.join(wrong), share=round(found.share, 3), solves=found.solves, cuts=found.cuts, seconds=round(time.process_time() - began, 2))


def drawn(seeds, seconds=10):
	return [judged(seed, seconds) for seed in range(*seeds)]
