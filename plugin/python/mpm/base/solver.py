# SPDX-License-Identifier: GPL-2.0-or-later
"""The analysis that a function is about."""
from yade import wrapper

from .messages import brief


def solverOf(who, solver):
	"""The MpmImplicitEngine given, or the only one among O.engines; TypeError or ValueError in the name of the function *who*."""
	if solver is None:
		found = [engine for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine)]
		if len(found) == 1: return found[0]
		raise ValueError(
		        f'{who}: O.engines holds {len(found) or "no"} MpmImplicitEngine' +
		        (', so solver must say which one is meant' if found else '; put it there first, or give it as solver')
		)
	if not isinstance(solver, wrapper.MpmImplicitEngine): raise TypeError(f'{who}: solver = {brief(solver)} must be an MpmImplicitEngine')
	return solver


def noPoints(who, solver):
	"""Message about an engine that has no material points."""
	if any(isinstance(body.shape, wrapper.MpmPoint) for body in wrapper.Omega().bodies):
		return f'{who}: none of the material points has a groupMask that goes with mask = {solver.mask} of the MpmImplicitEngine'
	return f'{who}: the scene has no material points; add them with O.bodies.append(mpm.fill(...))'
