# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure 2: condition number of the stiffness matrix of a block that moves through the grid."""
import os
import sys
sys.path.insert(0, os.path.dirname(sys.argv[0]))
from common import *

options = commandLine(__doc__)
methods = {'mpm': dict(basis='mpm', factor=0), 'gimp': dict(factor=0), 'ghost': dict(factor=1e-2)}


def conditionNumbers(offset):
	return {name: block(offset, **method).conditionNumber() for name, method in methods.items()}


beyond = Results(options.out, 'fig2-edges', ['edge', 'distance'], list(methods))
distances = [10.**-i for i in range(3, 13)]
beyond.add(dict(edge=edge, distance=d, **conditionNumbers(edge + d)) for edge in (0, 1, 2) for d in distances if (edge, d) not in beyond)

translation = Results(options.out, 'fig2', ['offset'], list(methods)) # the last of the two: where it is, the page finds both
offsets = [i / 100 for i in range(0, 201, 10 if options.quick else 1)]
translation.add(dict(offset=a, **conditionNumbers(a)) for a in offsets if (a, ) not in translation)
