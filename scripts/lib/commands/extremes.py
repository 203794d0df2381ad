# SPDX-License-Identifier: GPL-2.0-or-later
"""Drives parameters to extremes until the method breaks down, with and without ghost stabilisation, with both scalings, in 2D and 3D.

	scripts/extremes                   all parameters; ten minutes of one core
	scripts/extremes points turns      some of them

The tables say how far each parameter can go, and what the user sees beyond. All cases are in results/atlas.csv, and are not run again.
"""
import os
import shutil
import sys

import studies
from worker import root

examples = os.path.join(root, 'examples', 'extremes')
sys.path.insert(0, examples)
from axes import axes, cases

values = [
        'dofs', 'steps', 'completed', 'condition', 'worstCondition', 'pivot', 'solveError', 'meanIterations', 'maxIterations', 'cuts', 'luSolves', 'clamped', 'error', 'measured', 'failure',
        'seconds'
]


def main(study, arguments):
	study.option('axis', nargs='*', metavar='AXIS', help=f"which parameters; all if none is named: {', '.join(axes)}")
	options = study.parse(arguments, timeLimit=120, processes=1, quick='one or two values of each axis, in its first dimension')
	chosen = study.chosen(options.axis, axes, 'axis')
	for name in options.axis:
		if options.quick and not axes[name].quick: study.fail(f'axis {name} has no quick values; run it without --quick')
	table = study.table(['axis', 'dim', 'ghost', 'value'], values, 'atlas')
	given = [(case, 'runs.run', dict(zip(('axis', 'dim', 'ghost', 'value'), case))) for case in cases(chosen, options.quick)]
	study.fill(table, given, options.time_limit, ['completed', 'steps', 'failure'], reason='failure', missing='nan', folder=examples)
	import page
	study.write(page.tables(page.read(options.out), options.out))


def keep(results):
	"""Tables of a folder of results; the example takes the table of all cases."""
	import overview
	shutil.copy(os.path.join(results, 'results', 'atlas.csv'), os.path.join(examples, 'results'))
	overview.write(examples)
	if not studies.indexOf(results): studies.keepAll(results, overview.page.tables(overview.page.read(results), results), '`scripts/extremes`, ' + studies.dayOf(os.path.join(results, 'results', 'atlas.csv')))
	return results
