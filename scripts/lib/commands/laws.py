# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures what each law of soil costs: processor time of an iteration, of ground 24 m x 12 m that bears a strip load, with one thread.

	scripts/laws                 all laws; a minute
"""
study = 'measurements'


def main(study, arguments):
	options = study.parse(arguments, timeLimit=600, limited='for all laws [s]')
	for _, found in study.run([('laws', 'lawcost.costs', {})], options.time_limit):
		if not isinstance(found, list): study.fail(f'it ended by {found}')
		rows = [[one['law'], ', '.join(filter(None, [f"{one['microseconds']:.1f}", one['why']])), one['iterations']] for one in found]
		study.write([('laws.csv', 'Cost of laws', [['law', 'microseconds a point and iteration', 'iterations'], *rows])], command=f'`{study.command}`, {study.provenance}; ground of 24 m x 12 m, 4,608 points, one thread, 10 steps of a strip load')
