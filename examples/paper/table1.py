# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 1: iterations of the slope on three grids, with 2 x 2, 3 x 3 and 4 x 4 points per cell, without and with ghost stabilisation."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from slope_run import *

options = commandLine(__doc__)
for cellSize in [1.] if options.quick else [1., 0.5, 0.25]:
	for pointsPerCell in 2, 3, 4:
		for factor in 0., 1e-2:
			runSlope(options.out, cellSize, pointsPerCell, factor)
for cellSize in [1.] if options.quick else [1., 0.5]:
	for pointsPerCell in 2, 3, 4:
		countByTolerance(options.out, cellSize, pointsPerCell)
