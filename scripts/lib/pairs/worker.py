# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: checks the scenes of a JSON file, each a list of features or the name of a kind, and a seed, and prints what became of them, as worker.runCases wants it. PYTHONPATH has scripts/lib."""
import json
import os
import sys

from pairs.checks import check, checkKind
from yade import log

log.setLevel('Default', log.ERROR)  # many scenes are warned of, for gravity that acts upwards where one looks at it so

with open(sys.argv[-1]) as file:
	cases = json.load(file)
for i, (chosen, seed) in enumerate(cases):
	print('\n' + json.dumps({'begins': i}), flush=True)
	print('\n' + json.dumps({'ends': i, 'result': (checkKind if isinstance(chosen, str) else check)(chosen, seed)}), flush=True)
os._exit(0)
