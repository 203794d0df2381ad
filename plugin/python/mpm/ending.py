# SPDX-License-Identifier: GPL-2.0-or-later
"""Words when the script ends before the simulation does, or before what it has begun."""
import ast
import atexit
import sys
import time

from yade import wrapper

from .base.recorders import Film


@atexit.register
def _sayIfRunning():
	scene = wrapper.Omega()
	if not scene.running: return
	sys.stderr.write(
	        f'\nyade.mpm: the script ends while the simulation runs, in iteration {scene.iter}: the rest is lost. O.run(n, wait=True) or O.wait() waits for it.\n'
	)
	# A thread that comes back to Python after its end would abort the process. The scene says at once that it does
	# not run any more, and ends its step.
	scene.pause()
	deadline = time.monotonic() + 2
	time.sleep(.1)  # for a step that has just begun
	while scene.subStep >= 0 and time.monotonic() < deadline:
		time.sleep(.01)


@atexit.register
def _sayWhatIsLeft():
	"""Films that are not written, and stages of construction that no step has followed."""
	for kind in Film.__subclasses__():
		for film in kind._kept.values():
			sys.stderr.write(f'\nyade.mpm: {film.fileName!r} is not written, and its {film.frames} pictures are lost: call finish() of {type(film).__name__} after the run.\n')
	engines = list(wrapper.Omega().engines)
	for i, engine in enumerate(engines):
		if engine.dead or not engine.label.startswith('stage_'): continue
		kind, _, first, steps, _ = ast.literal_eval('(' + engine.command.partition('.advance(')[2])
		solver = next((one for one in engines[i:] if isinstance(one, wrapper.MpmImplicitEngine)), None)
		if solver is None or solver.nDone > first: continue
		what = {'placed': 'place', 'excavated': 'excavate', 'replaced': 'replace'}[kind]
		sys.stderr.write(f'\nyade.mpm: mpm.stages.{what}(..., steps={steps}) was not followed by a step, so that nothing has come of it: call O.run({steps}, wait=True) after it.\n')
