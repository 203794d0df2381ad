# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs many cases in few YADE processes, whatever a case does to its process."""
import json
import os
import queue
import subprocess
import tempfile
import threading
import time

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def yadeCommand(forUser, threads=1):
	"""Start of a command line that runs a script in YADE: by scripts/run, or by the command that the environment variable YADE names, as in the tests."""
	if 'YADE' in os.environ: return [os.environ['YADE'], '-n', '-x', f'-j{threads}']
	return [os.path.join(root, 'scripts', 'run'), f'-j{threads}', *(['--user'] if forUser else [])]


def runCases(command, cases, timeLimit):
	"""Yield (case, result) for all cases: the result that the worker printed, or 'crash' or 'timeout' as a text.

	:param command: of the worker, which takes as last argument a JSON file with a list of cases, and for the case of index i prints the lines
		{"begins": i} and {"ends": i, "result": ...}; what else it prints is passed over. It is started again after a crash or a timeout.
	:param timeLimit: [s] for one case
	"""
	cases = list(cases)
	while cases:
		done = 0
		for result in _oneProcess(command, cases, timeLimit):
			yield cases[done], result
			done += 1
		cases = cases[done:]


def _oneProcess(command, cases, timeLimit):
	"""Results in order, until all cases are done or one has ended the process."""
	with tempfile.NamedTemporaryFile('w', suffix='.json') as file:
		json.dump(cases, file)
		file.flush()
		process = subprocess.Popen([*command, file.name], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, errors='replace')
		lines = queue.Queue()
		threading.Thread(target=_forward, args=(process.stdout, lines), daemon=True).start()
		try:
			begun, deadline = False, None
			while True:
				try:
					line = lines.get(timeout=max(0, deadline - time.monotonic()) if deadline else None)
				except queue.Empty:
					yield 'timeout'
					return
				if line is None: # the process has ended
					if not begun: raise RuntimeError(f'{" ".join(map(str, command))} ended with exit code {process.wait()} before it ran a case')
					if deadline: yield 'crash'
					return
				event = _event(line)
				if 'begins' in event: begun, deadline = True, time.monotonic() + timeLimit
				if 'ends' in event:
					deadline = None
					yield event['result']
		finally:
			process.kill()
			process.wait()


def _forward(stream, lines):
	for line in stream:
		lines.put(line)
	lines.put(None)


def _event(line):
	if line.startswith('{'):
		try:
			return json.loads(line)
		except ValueError:
			pass
	return {}
