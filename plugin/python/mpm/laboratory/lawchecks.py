# SPDX-License-Identifier: GPL-2.0-or-later
"""Check of a law's tangent against its stress."""
import numpy as np

from ..base.messages import numberOf
from ..library import engine
from .tests import firstStress, internalsOf, materialFor, respond, stateUnder

_root = 2**0.5
_pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]  # in Mandel's order


def checkLaw(material, strain=1e-4, confiningPressure=0, initialStress=None, samples=20, duration=0, **internals):
	"""Compare the tangent of a law with differences of its stress: for user materials, before they go into a scene. ::

		print(mpm.checkLaw(MpmUserMat(library='./law.so', parameters=[1e7, 0.3], young=1e7, poisson=0.3, density=2000), confiningPressure=100e3))

	From the stress at first, the law is asked for increments of strain in random directions (always the same ones), of sizes from a hundredth of *strain* up to it, and of
	each with twelve others beside it.

	:param material: material of the plugin, or the label of one in O.materials
	:param strain: size of the largest increments > 0 [-]
	:param confiningPressure: pressure [Pa] >= 0 at first, equal in all directions
	:param initialStress: instead: Cauchy stress [Pa] along x, y and z at first, positive in tension
	:param samples: number of increments > 0
	:param duration: of each [s] >= 0, for laws that depend on it; where it is 0 a UMAT is told DTIME = 1
	:param internals: internal variables of the law at first by name, as in :func:`respond`
	:return: dict of ``tangentError``, the median of the differences between tangent and slope of the stress, relative to the slope [-]: below some 1e-6 of a tangent that is right, as
		round-off is in differences; ``worst``, the largest of them, where a corner of the law may lie between two answers; ``asymmetry`` of the tangent, the median [-]; and
		``stress``, whether at no increment the stress is that at first, relative to it or to a millionth of the stiffness [-]
	:raises TypeError, ValueError: as :func:`respond`
	"""
	who = 'checkLaw'
	material = materialFor(who, material)
	size = numberOf(who, 'strain', strain, 'a number > 0 [-]', lambda value: value > 0)
	count = int(numberOf(who, 'samples', samples, 'an integer > 0', lambda value: value >= 1 and value == int(value)))
	state = stateUnder(who, material, firstStress(who, confiningPressure, initialStress), internalsOf(who, internals))

	def stress(increment):
		strain = state.elasticStrain + increment
		try:
			if not state.hasTensors: answer = respond(material, strain, **state.internals)
			else: answer = engine.respondInSpace(material, list(strain.ravel()), list(increment.ravel()), state.internals, float(duration))
		except ValueError as error:
			raise ValueError(f"{who}: {str(error).removeprefix('respond: ')}") from None
		return np.array(answer['stress']), answer

	random = np.random.default_rng(1)
	errors, asymmetries = [], []
	for k in range(count):
		m = random.normal(size=(3, 3))
		increment = size * 10**(-2 * (1 - (k + 1) / count)) * (m + m.T) / np.linalg.norm(m + m.T)
		tangent = _mandelTangent(stress(increment)[1])
		h = 1e-4 * np.linalg.norm(increment)
		slope = np.transpose([_mandel(stress(increment + h * _unit(c))[0] - stress(increment - h * _unit(c))[0]) / (2 * h) for c in range(6)])
		errors.append(np.linalg.norm(tangent - slope) / max(np.linalg.norm(slope), 1e-300))
		asymmetries.append(np.linalg.norm(tangent - tangent.T) / max(np.linalg.norm(tangent), 1e-300))
	still, answer = stress(np.zeros((3, 3)))
	kept = np.linalg.norm(still - state.stress) / max(np.linalg.norm(state.stress), 1e-6 * np.linalg.norm(_mandelTangent(answer)))
	return dict(tangentError=float(np.median(errors)), worst=max(errors), asymmetry=float(np.median(asymmetries)), stress=float(kept))


def _unit(c):
	unit = np.zeros((3, 3))
	i, j = _pairs[c]
	unit[i, j] = unit[j, i] = 1 if i == j else 1 / _root
	return unit


def _mandel(tensor):
	return np.array([tensor[i, j] * (1 if i == j else _root) for i, j in _pairs])


def _mandelTangent(answer):
	"""Tangent of a law that answers in principal axes: with the rotation of the axes, by the secant shear moduli."""
	if 'axes' not in answer: return np.array(answer['tangent'])
	axes = answer['axes']
	along = lambda i, j: _mandel((np.outer(axes[:, i], axes[:, j]) + np.outer(axes[:, j], axes[:, i])) / 2)
	tangent = sum(answer['tangent'][i, j] * np.outer(along(i, i), along(j, j)) for i in range(3) for j in range(3))
	return tangent + sum(4 * answer['shear'][i] * np.outer(along(i, (i + 1) % 3), along(i, (i + 1) % 3)) for i in range(3))
