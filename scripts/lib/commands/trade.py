# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures what accuracy costs: runs a scene with many settings and finds those that no other beats in both time and error.

	scripts/trade                                   the scenes of examples/trade, all of them (some of them: their names)
	scripts/trade my.py --vary h=1,0.5,0.25 --vary n=2,3 --quantity settlement --reference h=0.125,n=3

A script of your own takes the parameters from YADE's parameter table (readParamsFromTable(h=1, n=2); from yade.params import table) and leaves the quantities of interest as numbers in
global variables. If it keeps a list `solves` of solver.iterations, the solves are counted too. Each combination of the --vary values is run in a YADE process of its own, and so is the
reference, with half the resolution too if --check says how. Runs are kept in results/*.csv, and are not run again. The parameter `threads` is that of YADE's option -j; 1 if it is not
varied.
"""
import argparse
import glob
import os
import shutil
import sys

import studies
from worker import root

examples = os.path.join(root, 'examples', 'trade')
sys.path.insert(0, examples)
from plans import ownPlan, plans, settings, shortened

own = 'vary', 'quantity', 'error', 'reference', 'check'


def isWord(text):
	"""True if it can stand in a parameter table."""
	return text.split() == [text]


def pairs(text):
	"""'h=1,n=2' as a dictionary of texts."""
	found = [pair.partition('=') for pair in text.split(',')]
	if not all(isWord(name) and isWord(value) for name, _, value in found): raise argparse.ArgumentTypeError(f'{text!r} is not NAME=VALUE,NAME=VALUE')
	return {name: value for name, _, value in found}


def values(text):
	"""'h=1,0.5' as a name and its values."""
	name, _, listed = text.partition('=')
	found = listed.split(',')
	if not all(map(isWord, [name, *found])): raise argparse.ArgumentTypeError(f'{text!r} is not NAME=VALUE,VALUE')
	return name, found


def main(study, arguments):
	study.option('scene', nargs='*', help=f"script of your own, or some of {', '.join(plans)}")
	study.option('--vary', action='append', default=[], type=values, metavar='NAME=V,V', help='values of a parameter of your script; may be repeated')
	study.option('--quantity', action='append', default=[], metavar='NAME', help='variable of your script that is compared with the reference run')
	study.option('--error', action='append', default=[], metavar='NAME', help='variable of your script that is an error [-] by itself')
	study.option('--reference', type=pairs, metavar='NAME=V,NAME=V', help='parameters of the run that quantities are compared with')
	study.option('--check', type=pairs, metavar='NAME=V,NAME=V', help='parameters of a coarser reference; the difference is the uncertainty')
	options = study.parse(arguments, timeLimit=600, limited='for one run [s]', quick='a few coarse runs of the scenes of examples/trade')
	chosen = ofOnesOwn(study, options) if len(options.scene) == 1 and options.scene[0].endswith('.py') else ofExamples(study, options)
	for name, plan in chosen.items(): measure(study, name, plan, settings(plan))
	import page
	study.write(page.tables(options.out, chosen, options.out))


def measure(study, name, plan, runs):
	"""Runs of a plan, each in a process of its own but for those that are in its table; the table."""
	names = plan.errors + plan.quantities
	table = study.table(list(plan.parameters), ['wall', 'cpu', 'memory', 'solves', *names, 'failure'], name)
	for threads in dict.fromkeys(setting.get('threads', '1') for setting in runs):
		these = [setting for setting in runs if setting.get('threads', '1') == threads]
		given = lambda setting: dict(script=plan.script, parameters={name: value for name, value in setting.items() if name != 'threads'}, names=names)
		cases = [(tuple(setting.values()), 'measured.measure', given(setting)) for setting in these]
		print(f'{name}, {threads} threads: ', end='')
		study.fill(table, cases, study.options.time_limit, ['cpu', 'failure'], reason='failure', missing='nan', threads=threads, areAlone=True)
	return table


def ofOnesOwn(study, options):
	"""Plan of a script of one's own, by its name."""
	script, names = options.scene[0], [name for name, _ in options.vary]
	if not os.path.exists(script): study.fail(f'no such script: {script}')
	if options.quick: study.fail('--quick is for the scenes of examples/trade')
	if not names: study.fail('name what is to be varied: --vary')
	if len(set(names)) < len(names): study.fail(f"--vary is given twice for the same parameter: {', '.join(names)}")
	if not options.quantity and not options.error: study.fail('name what is to be accurate: --quantity or --error')
	if options.quantity and not options.reference: study.fail('--quantity needs a --reference run to compare with')
	return {os.path.splitext(os.path.basename(script))[0]: ownPlan(options)}


def ofExamples(study, options):
	"""Plans of the scenes of examples/trade, by their names."""
	if any(getattr(options, name) for name in own): study.fail(f"{', '.join('--' + name for name in own)} are for a script of your own, which is named by itself and ends in .py")
	return {name: shortened(plans[name]) if options.quick else plans[name] for name in study.chosen(options.scene, plans, 'scene')}


def keep(results):
	"""Tables of a folder of results; the example takes the runs."""
	import page
	kept = os.path.join(examples, 'results')
	for path in glob.glob(os.path.join(results, 'results', '*.csv')): shutil.copy(path, kept)
	import overview
	overview.write(examples)
	studies.keepAll(results, page.tables(examples, plans, results), '`scripts/trade`, ' + studies.dayOf(max(glob.glob(os.path.join(results, 'results', '*.csv')), key=os.path.getmtime)))
	return results
