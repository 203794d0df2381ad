# SPDX-License-Identifier: GPL-2.0-or-later
"""Reruns figures and tables of the paper, and writes a page with its results beside ours.

	scripts/reproduce all               everything; four minutes with one thread
	scripts/reproduce fig2 table1       some of it
	scripts/reproduce all --quick       a part that runs within a minute

Results and pictures of an earlier run in the same folder are kept and shown: an interrupted run continues. Remove the folder to start afresh.
"""
import os
import subprocess

from results import makeFolder
from worker import root

everything = ['fig2', 'fig4', 'scaling', 'table2', 'table1', 'fig6', 'fig7']  # the longest last; figures 6 and 7 show runs of table 1


def main(study, arguments):
	study.option('target', nargs='*', help=f"of {', '.join(everything)}, or all")
	study.option('-j', type=int, metavar='N', help='number of threads; all cores if not given')
	study.option('--quick', action='store_true', help='a part that runs within a minute')
	study.option('--out', help='folder of the results (default out/paper, with --quick out/paper-quick)')
	options = study.parse(arguments, hasFolder=False)
	if not options.target: study.fail("nothing to run: name figures or tables, or 'all' (see --help)")
	targets = study.chosen([name for target in options.target for name in (everything if target == 'all' else [target])], everything, 'figure or table')
	out = options.out or 'out/paper' + '-quick' * options.quick
	makeFolder(out)
	command = [os.path.join(root, 'scripts', 'run'), *([f'-j{options.j}'] if options.j else []), *(['--user'] if options.user else [])]
	for target in targets:
		print(f'== {target}', flush=True)
		subprocess.run([*command, os.path.join(root, 'examples', 'paper', target + '.py'), '--out', out, *(['--quick'] if options.quick else [])], check=True)
	subprocess.run(['/usr/bin/python3', os.path.join(root, 'examples', 'paper', 'page.py'), '--out', out], check=True)
