# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures contact with rigid bodies case by case, and judges each by closed forms and by what must not depend on the grid.

	scripts/contacts                       all cases; about an hour of one core
	scripts/contacts --short               less deep, fewer contact points and scenes; about ten minutes
	scripts/contacts 'cone*' tbar          some of them
	scripts/contacts energy-random --seeds 17:18      some scenes of those that are drawn at random
	scripts/contacts --list                names of all cases, and their bounds

Each case is a function of the modules in scripts/lib/contacts, with the arguments in plan.py there. Of what is pushed: *reached* and *part* of the way asked for [radii, -],
resistance *N* over area and c_u as a mean beyond one radius, *late* in the last two fifths (T-bar and ball: the second half) of the way, *scatter* and *largest*: deviation of
single steps from the mean over a cell's travel around them, on average and at most, beyond one radius; *inside*: how deep the centre of a material point was in the body, in cells.
Results are written to the folder as each case ends: cases.csv is the table, contacts.json has all digits. Ends with 1 if a case is not within its bounds.
"""
import fnmatch
import json
import os

from contacts.plan import cases, derived
from contacts.tables import bound, heads, misses, rows
from pages import replace
from results import seconds, seeds


def main(study, arguments):
	study.option('case', nargs='*', metavar='CASE', help='name or pattern; all if none is given')
	study.option('--short', action='store_true', help='the short form of each')
	study.option('--list', action='store_true', help='say what there is, and run nothing')
	study.option('--seeds', type=seeds, metavar='FROM:TO', help='of cases with scenes drawn at random: these instead of their own')
	study.option('--time-limit', type=seconds, metavar='S', help='processor time for one case [s] instead of its own; it ends with what it has')
	options = study.parse(arguments, processes=1)
	for pattern in options.case:
		if not fnmatch.filter(cases, pattern): study.fail(f'no case goes with {pattern}; --list names them')
	chosen = [name for name in cases if any(fnmatch.fnmatchcase(name, pattern) for pattern in options.case or '*')]
	if options.list: return print(*(f"{name:20} {'; '.join(f'{n} {bound(*limits)}' for n, limits in cases[name].bounds.items())}" for name in chosen), sep='\n')
	results, run = {}, study.provenance
	os.makedirs(options.out, exist_ok=True)
	planned = [(name, 'contacts.' + cases[name].function, argumentsOf(cases[name], options)) for name in chosen]
	for (name, *_), result in study.run(planned, lambda case: 3 * case[2].get('seconds', 300) + 120, areAlone=True):  # limit of the wall clock, for a step that does not end
		results[name] = dict(why=result) if isinstance(result, str) else result
		ordered = {name: results[name] for name in chosen if name in results}
		ordered |= {name: result for name, case in derived.items() if (result := case.function(results))}
		replace(os.path.join(options.out, 'contacts.json'), json.dumps(ordered, indent='\t'))
		missed = misses(cases[name], results[name])
		print(f"{name}: {'missed: ' + ', '.join(missed) if missed else 'right'}\n   ", ', '.join(f'{n} {value:.4g}' if isinstance(value, float) else f'{n} {value}' for n, value in results[name].items() if value != ''))
		table = [[*heads, 'run'], *([*row, run] for row in rows(cases | derived, ordered))]
		right = sum(not misses((cases | derived)[name], result) for name, result in ordered.items())
		summary = f'{right} of {len(ordered)} cases are within their bounds.'
		study.write([('cases.csv', 'All cases', table)], summary, '`scripts/contacts`, by case; `scripts/contacts --help` says what the numbers are. The run of each row is in its last column.')
	return int(any(misses(cases[name], results[name]) for name in chosen))


def argumentsOf(case, options):
	arguments = case.arguments | (case.short if options.short else {})
	if options.seeds and 'seeds' in arguments: arguments['seeds'] = [options.seeds[0], options.seeds[-1] + 1]
	return arguments | (dict(seconds=options.time_limit) if options.time_limit else {})
