# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs one scene by another program, and prints value, unknowns and seconds as JSON; its arguments are program, scene, size, and kind of the elements."""
import importlib
import json
import sys
import tempfile

module, scene, size, kind = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
	try:
		found = importlib.import_module('peers.' + module).run(scene, int(size), kind, folder)
	except Exception as error:
		found = dict(why=f'{type(error).__name__}: {error}'[:300])
print('\n' + json.dumps(found))
