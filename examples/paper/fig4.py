# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure 4: stress error of a column under its own weight against the number of cells."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from common import *

options = commandLine(__doc__)
stabilisations = {'none': dict(factor=0), 'mesh-independent': dict(scaling='mesh-independent'), 'paper': dict(scaling='paper')}
results = Results(options.out, 'fig4', ['pointsPerCell', 'cells', 'steps', 'ghost'], ['error', 'failure'])


def run(pointsPerCell, cells, steps, ghost):
	key = pointsPerCell, cells, steps, ghost
	if key in results: return
	column(cells, pointsPerCell, steps, **stabilisations[ghost])
	failure = runSteps(steps)
	results.add([dict(zip(results.columns, (*key, 'nan' if failure else columnError(), failure)))])
	print(*results.row(key).values(), flush=True)


cellNumbers = [2**i for i in range(2, 6 if options.quick else 10)]
for pointsPerCell in [2] if options.quick else [2, 3, 4]:
	for cells in cellNumbers:
		for ghost in stabilisations:
			run(pointsPerCell, cells, 40, ghost)
for cells in cellNumbers:
	for ghost in stabilisations:
		run(2, cells, 5 * cells, ghost) # load steps refined with the grid; 8 cells: the 40 steps above
	run(2, cells, 10, 'mesh-independent') # points leap over cells in every step
