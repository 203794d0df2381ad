# SPDX-License-Identifier: GPL-2.0-or-later
"""Beyond the paper: both scalings of the ghost stabilisation on grids from millimetres to kilometres."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from common import *

options = commandLine(__doc__)
cells = 16
stabilisations = {'none': dict(factor=0), 'mesh-independent': dict(scaling='mesh-independent'), 'paper': dict(scaling='paper')}
worst = max([i / 100 for i in range(101)], key=lambda offset: block(offset).conditionNumber()) # worst offset for figure 2, whose other half mirrors this one

results = Results(options.out, 'scaling', ['cellSize', 'ghost'], ['offset', 'conditionNumber', 'error', 'failure'])
for cellSize in [10.**i for i in range(-3, 4)]:
	if all((cellSize, ghost) in results for ghost in stabilisations): continue
	rows = []
	for ghost, settings in stabilisations.items():
		conditionNumber = block(worst, cellSize=cellSize, **settings).conditionNumber()
		height = cells * cellSize
		column(cells, height=height, **settings)
		failure = runSteps(40)
		error = 'nan' if failure else columnError(height)
		rows.append(dict(zip(results.columns, (cellSize, ghost, worst, conditionNumber, error, failure))))
		print(*rows[-1].values(), flush=True)
	results.add(rows)
