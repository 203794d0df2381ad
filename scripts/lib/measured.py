# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: measures a script, as a case of caserun.py with a process of its own; for scripts/trade."""
import os
import resource
import sys
import tempfile
import time

import yade.mpm  # belongs to YADE's start, not to the script


def measure(script, parameters, names):
	"""Wall and processor time [s], the memory that came on top of YADE's own [MiB], the sum of the script's list `solves` if it has one, and the numbers of these names that it leaves.

	:param parameters: values of YADE's parameter table, texts by name
	"""
	space = vars(sys.modules['__main__'])  # commands of PyRunner look for the script's variables there
	sys.argv = [script]
	sys.path.insert(0, os.path.dirname(os.path.abspath(script)))
	with open(script) as file:
		program = compile(file.read(), script, 'exec')
	with tempfile.NamedTemporaryFile('w', suffix='.table') as table:
		print(*parameters, file=table)
		print(*parameters.values(), file=table, flush=True)
		if parameters: os.environ['YADE_BATCH'] = table.name + ':2'  # YADE reads no table without columns
		wall, cpu, memory = time.time(), time.process_time(), _peakMemory()
		try:
			exec(program, space)
		except Exception as error:  # a setting with which the script does not come to its end
			return dict(why=f"{type(error).__name__}: {' '.join(str(error).split('. ')[0].split())}"[:240])
	found = dict(wall=time.time() - wall, cpu=time.process_time() - cpu, memory=_peakMemory() - memory, solves=sum(space.get('solves', [])))
	return {name: float(f'{x:.6g}') for name, x in (found | {name: float(space[name]) for name in names}).items()}


def _peakMemory():
	return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
