#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# YADE 2023.02a: 50 steps of an empty scene, each by O.step() or by O.run(1, wait=True).
# Expected: both take the time of the step, some microseconds.
# Seen: O.run(1, wait=True) takes 40 ms or more, as it looks for the end of the run every 40 ms; a loop with results after each step takes minutes instead of seconds.
. "$(dirname "$(realpath "$0")")/packages.inc"
take yade=2023.02a-1 libyade=2023.02a-1 python3-yade=2023.02a-1
cat > steps.py <<'SCRIPT'
import os
import time
O.dt, O.engines = 1e-5, [PyRunner(iterPeriod=1, command='pass')]
def each(function, number=50):
	begin = time.time()
	for _ in range(number): function()
	return (time.time() - begin) / number
step, run = each(O.step), each(lambda: O.run(1, wait=True))
print(f'O.step(): {1e3 * step:.3f} ms, O.run(1, wait=True): {1e3 * run:.3f} ms', flush=True)
os._exit(not (run > 0.03 and step < 0.01))
SCRIPT
YADE_PREFIX=$folder/root/usr yade-double -x -n -j1 steps.py > log 2>&1 || { tail -5 log; changed 'both take as long'; }
grep 'O.step' log
