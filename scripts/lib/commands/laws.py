# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures what each law of soil costs: processor time of an iteration, of ground 24 m x 12 m that bears a strip load, with one thread.

	scripts/laws                 all laws; a minute
"""
study = 'measurements'
names = ['Mohr-Coulomb', 'Drucker-Prager', 'Mohr-Coulomb, softens', 'Mohr-Coulomb, power', 'Drucker-Prager, power', 'Cam clay', 'hardening soil', 'hardening soil, small strain', 'NorSand', 'von Mises', "von Mises, by MFront's interface", 'hypoplastic, by UMAT']


def main(study, arguments):
	study.parse(arguments, timeLimit=300)
	rows = [['law', 'microseconds a point and iteration', 'iterations']]
	for (name, *_), result in study.run([(name, 'lawcost.cost', dict(law=name)) for name in names], study.options.time_limit):
		if isinstance(result, str): result = dict(why=result)
		time = f"{result['microseconds']:.1f}" if 'microseconds' in result else ''
		rows.append([name, ', '.join(filter(None, [time, result['why']])), result.get('iterations', '')])
		print(*rows[-1], sep=', ', flush=True)
	study.write([('laws.csv', 'Cost of laws', rows)], command=f'`{study.command}`, {study.provenance}; ground of 24 m x 12 m, 4,608 points, one thread, 10 steps of a strip load')
