# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 2: iterations of the slope with h = 1 m and 3 x 3 points per cell for five strengths of the ghost stabilisation."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from slope_run import *

options = commandLine(__doc__)
for factor in 0., 1e-8, 1e-6, 1e-4, 1e-2:
	for lineSearchTrials in 0, 5: # number in the paper, and the default of the plugin
		runSlope(options.out, 1., 3, factor, lineSearchTrials)
