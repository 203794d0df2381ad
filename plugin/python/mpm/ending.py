# SPDX-License-Identifier: GPL-2.0-or-later
"""A word when the script ends before the simulation does."""
import atexit
import sys
import time

from yade import wrapper


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
