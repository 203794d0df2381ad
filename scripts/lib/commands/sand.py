# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures limit loads of sand with psi = phi: strips by their weight and by a surcharge, and walls.

	scripts/sand                      all groups; half an hour of one core
	scripts/sand factors steps        some of factors, early, rigid, limit, box, causes, parts, steps, walls, cuts
	scripts/sand factors --only 'N_q, 20' --grid B/9

A strip of width B sinks by a thousandth of B in 40 steps, in sand that weighs gamma, with c = gamma B / 1000, in the group limit a tenth of that. N_gamma is 2 q / (gamma B), less
what this cohesion adds and what the settlement does as a surcharge beside the strip (superposed). N_q: sand without weight and cohesion, under a surcharge beside the strip. Walls
go a tenth of a cell. The load is given after a quarter of the way, at its end, and as the mean of its last tenth. Cuts are condition numbers of a block of 3 cells along each axis
that reaches into others. F-bar and MpmGhost(where='aggregates', memory=1), if not said otherwise. All cases are in results/sand.csv, and are not run again.
"""
from sand.plan import groups
from sand.tables import tables

numbers = ['exact', 'quarter', 'whole', 'late', 'iterations', 'cuts', 'points', 'seconds', 'condition', 'why']


def main(study, arguments):
	study.option('group', nargs='*', metavar='GROUP', help=f"some of {', '.join(groups)}; all if none is given")
	study.option('--only', metavar='TEXT', default='', help='cases with this in their names')
	study.option('--grid', metavar='GRID', help='this one only, as B/9')
	options = study.parse(arguments, timeLimit=200, limited='processor time for one case [s]')
	chosen = study.chosen(options.group, groups, 'group')
	cases = [((group, *name), f'sand.{function}', dict(given, seconds=options.time_limit)) for group in chosen for function, name, given in groups[group]()]
	cases = [case for case in cases if options.only in case[0][1] and options.grid in (None, case[0][3])]
	if not cases: study.fail('there is no such case; give other values to --only and --grid.')
	table = study.table(['group', 'case', 'with', 'grid'], numbers)
	study.fill(table, cases, 4 * options.time_limit + 60, ['quarter', 'whole', 'condition', 'why'])
	study.write(tables([table.row(key) for key, *_ in cases if key in table]))
