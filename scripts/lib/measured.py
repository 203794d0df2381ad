# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a YADE script and measures it: `yade -n -x measured.py script.py results.json [name ...]`, for scripts/trade.

Writes wall and processor time [s], the memory that came on top of YADE's own [MiB], the sum of the script's list `solves` if it has one, and the
numbers that the script has left in variables of the given names.
"""
import sys


def measure(script, results, *names):
	import json, os, resource, time # here, where the script cannot give their names another meaning
	import yade.mpm # belongs to YADE's start, not to the script

	def peakMemory():
		return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024

	sys.argv = [script]
	sys.path.insert(0, os.path.dirname(os.path.abspath(script)))
	with open(script) as file:
		program = compile(file.read(), script, 'exec')
	wall, cpu, memory = time.time(), time.process_time(), peakMemory()
	exec(program, globals()) # commands of PyRunner look for the script's variables there
	measured = dict(wall=time.time() - wall, cpu=time.process_time() - cpu, memory=peakMemory() - memory)
	measured['solves'] = sum(globals().get('solves', []))
	with open(results, 'w') as file:
		json.dump(measured | {name: float(globals()[name]) for name in names}, file)


measure(*sys.argv[1:])
