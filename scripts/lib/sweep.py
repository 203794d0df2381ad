# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs one YADE script with many settings of its parameter table, each in a process of its own, and measures them."""
import json
import os
import subprocess
import tempfile

from results import Results
from worker import root, yadeCommand

measured = ['wall', 'cpu', 'memory', 'solves']


class Sweep:
	"""The runs of one plan; what is in the table already is not run again.

	:param plan: see plans.Plan
	:param timeLimit: [s] for one run
	"""

	def __init__(self, name, plan, out, timeLimit, forUser):
		self.name, self.plan, self.timeLimit, self.forUser = name, plan, timeLimit, forUser
		self.table = Results(out, name, list(plan.parameters), measured + plan.errors + plan.quantities + ['failure'])

	def run(self, settings):
		missing = [s for s in settings if tuple(s.values()) not in self.table]
		print(f'{self.name}: {len(missing)} of {len(settings)} runs to do', flush=True)
		for setting in missing:
			result = self._measure(setting)
			self.table.add([setting | result])
			print(' ', *(f'{name}={value}' for name, value in setting.items()), f"cpu {result['cpu']}", result['failure'], flush=True)

	def _measure(self, setting):
		"""One run; its measurements as texts, NaN with the reason in 'failure' if it does not come to its end."""
		names = self.plan.errors + self.plan.quantities
		with tempfile.TemporaryDirectory() as folder:
			parameters, results = os.path.join(folder, 'parameters.table'), os.path.join(folder, 'results.json')
			inTable = {name: value for name, value in setting.items() if name != 'threads'}
			with open(parameters, 'w') as file:
				file.write(f"{' '.join(inTable)}\n{' '.join(inTable.values())}\n")
			batch = {'YADE_BATCH': f'{parameters}:2'} if inTable else {} # YADE reads no table without columns
			command = [*yadeCommand(self.forUser, setting.get('threads', 1)), os.path.join(root, 'scripts', 'lib', 'measured.py'), self.plan.script, results, *names]
			failure = self._process(command, os.environ | batch)
			result = dict.fromkeys(measured + names, float('nan'))
			if not failure:
				with open(results) as file:
					result |= json.load(file)
		return {name: f'{result[name]:.6g}' for name in measured + names} | {'failure': failure}

	def _process(self, command, environment):
		"""Reason of a failure, or an empty text."""
		try:
			ended = subprocess.run(
			        command, env=environment, timeout=self.timeLimit, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors='replace')
		except subprocess.TimeoutExpired:
			return 'timeout'
		if ended.returncode == 0: return ''
		lines = [line for line in ended.stdout.splitlines() if 'Error' in line] or ended.stdout.splitlines()[-1:] or [f'exit code {ended.returncode}']
		return ' '.join(lines[-1].split('. ')[0].split())[:240]
