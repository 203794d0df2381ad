# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs small scenes of geotechnical engineering that are drawn at random, with default settings: which of them get to their end.

	scripts/ground                        a thousand; about an hour of one core
	scripts/ground --seeds 17:18          one of them

Footings, smooth walls, cuts, excavations that are held, sheet piles, slopes, water tables, fills, run-outs and impacts, in the plane and in space, in all laws, with friction of 20
to 45 degrees, dilation from none to that, cohesion from none. A scene *ends*. Or it is *held*: it ends and says that the stabilisation takes up more than 5 percent of the work of a
step. Or it is *told* that a face stands which limit analysis does not let stand. Or it *fails* as it may, at a load at which no equilibrium is known to exist and at which a run in
steps of half the length fails too, within 5 %. Or it *stops*. *wrong* are forces in statics that do not balance, an energy that is not found again, and loads beyond bounds of limit
analysis. All scenes are in results/ground.csv, and are not run again with the same settings. Ends with 1 if more than a hundredth stops or is wrong.
"""
from collections import Counter

from ground.tables import findings, isBad, kinds
from results import seeds

columns = ['scene', 'how', 'part', 'why', 'wrong', 'share', 'solves', 'cuts', 'seconds']


def main(study, arguments):
	study.option('--seeds', type=seeds, metavar='FROM:TO', default='0:1000', help='which scenes, also as a list 3,17,45 (default %(default)s)')
	study.option('--strict', action='store_true', help='F-bar in statics, and a ghost stabilisation for soil that yields, which carries at most 3 percent of the work (MpmGhost.workTolerance)')
	study.option('--friction', action='store_true', help='only static scenes in the plane of Mohr-Coulomb or Drucker-Prager soil')
	study.option('--where', choices=['boundary', 'aggregates'], help='MpmGhost.where in statics, if not its own')
	study.option('--memory', type=float, help='MpmGhost.memory, the same')
	study.option('--factor', type=float, help='MpmGhost.factor, the same')
	study.option('--divide', type=int, default=1, metavar='N', help='cells of 1/N of the size')
	options = study.parse(arguments, timeLimit=20, limited='processor time for one scene [s]')
	ghost = {name: getattr(options, name) for name in ('where', 'memory', 'factor') if getattr(options, name) is not None}
	flags = {'--strict': options.strict, '--friction': options.friction, f'--divide {options.divide}': options.divide > 1, f'--time-limit {options.time_limit:g}': options.time_limit != 20}
	settings = ' '.join([*(flag for flag, isGiven in flags.items() if isGiven), *(f'--{name} {value}' for name, value in ghost.items())])
	table = study.table(['settings', 'seed'], columns)
	given = dict(seconds=options.time_limit, divide=options.divide, strict=options.strict, ghost=ghost, friction=options.friction)
	study.fill(table, [((settings, seed), 'ground.runs.judged', dict(given, seed=seed)) for seed in options.seeds], 6 * options.time_limit + 60, ['how', 'wrong', 'why'])
	rows = [row | dict(how=row['how'] or 'stops') for row in table.rows.values() if row['settings'] == settings]
	bad = [row for row in rows if isBad(row)]
	counts = ', '.join(f'{number} {how}' for how, number in Counter(row['how'] for row in rows).items())
	summary = f"{len(rows)} scenes, {sum(int(float(row['solves'] or 0)) for row in rows)} solves: {counts}; {len(bad)} stop or are wrong."
	study.write([('kinds.csv', 'Outcomes by kind of scene', kinds(rows)), ('findings.csv', 'Scenes that stop or are wrong', findings(rows))], summary)
	return int(len(bad) > 0.01 * len(rows))
