# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: runs the cases of a JSON file, each a key, the name of a function and its arguments, and prints what they return, as worker.runCases reads it."""
import importlib
import json
import os
import sys
import traceback

import numpy as np
from yade import log

log.setLevel('Default', log.WARN)


def plain(value):
	"""Numbers and texts as JSON knows them: no NaN, none of NumPy's."""
	if isinstance(value, dict): return {name: plain(x) for name, x in value.items()}
	if isinstance(value, (list, tuple, np.ndarray)): return [plain(x) for x in value]
	if isinstance(value, (bool, np.bool_)): return bool(value)
	if isinstance(value, (int, np.integer)): return int(value)
	if isinstance(value, (float, np.floating)): return float(value) if np.isfinite(value) else str(float(value))
	return value


def run(function, arguments):
	module, _, name = function.rpartition('.')
	try:
		return plain(getattr(importlib.import_module(module), name)(**arguments))
	except Exception as error:
		traceback.print_exc()
		return dict(why=f'{type(error).__name__}: {error}'[:300])


def main():
	with open(sys.argv[-1]) as file:
		cases = json.load(file)
	for i, (_, function, arguments) in enumerate(cases):
		print('\n' + json.dumps({'begins': i}), flush=True)
		print('\n' + json.dumps({'ends': i, 'result': run(function, arguments)}), flush=True)
	os._exit(0)


if __name__ == '__main__':
	import caserun  # a module of its own, to whose names a script that is run gives no other meaning
	caserun.main()
