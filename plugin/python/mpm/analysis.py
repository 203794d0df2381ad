# SPDX-License-Identifier: GPL-2.0-or-later
"""The analysis that a function is about."""
from yade import wrapper


def solverOf(who, solver):
	"""The MpmImplicitEngine given, or the only one among O.engines; TypeError or ValueError in the name of the function *who*."""
	if solver is None:
		found = [engine for engine in wrapper.Omega().engines if isinstance(engine, wrapper.MpmImplicitEngine)]
		if len(found) == 1: return found[0]
		raise ValueError(
		        f'{who}: O.engines holds {len(found) or "no"} MpmImplicitEngine' +
		        (', so solver must say which one is meant' if found else '; put it there first, or give it as solver')
		)
	if not isinstance(solver, wrapper.MpmImplicitEngine): raise TypeError(f'{who}: solver = {solver!r} must be an MpmImplicitEngine')
	return solver
