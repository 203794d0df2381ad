# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure 6: shear stress in the deformed slope without ghost stabilisation, h = 0.25 m and 4 x 4 points per cell (--quick: h = 1 m)."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from slope_run import *

options = commandLine(__doc__)
runSlope(options.out, 1. if options.quick else 0.25, 4, 0.)
