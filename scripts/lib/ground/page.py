# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of scripts/ground as a table."""
from collections import Counter

import studies


def isBad(row):
	return row['how'] == 'stops' or row['wrong']


def kinds(rows):
	"""Counts by kind of scene, head first."""
	found = [['kind', 'scenes', 'end', 'held', 'told', 'fail', 'stop', 'wrong', 'solves a scene', 'seconds']]
	kindOf = lambda row: row['scene'].split(' ')[0] or 'unknown'
	for kind in sorted({kindOf(row) for row in rows}):
		of = [row for row in rows if kindOf(row) == kind]
		count = Counter(row['how'] for row in of)
		mean = lambda name: sum(float(row[name] or 0) for row in of) / len(of)
		numbers = len(of), *(count[how] for how in ('ends', 'held', 'told', 'fails', 'stops')), sum(bool(row['wrong']) for row in of), f"{mean('solves'):.0f}", f"{mean('seconds'):.1f}"
		found.append([kind, *map(str, numbers)])
	return found


def findings(rows):
	"""Scenes that stop or are wrong, head first."""
	found = [['seed', 'scene', 'at', 'why']]
	for row in filter(isBad, rows):
		why = '; '.join(text for text in (str(row['why']), row['wrong'] and 'wrong: ' + row['wrong']) if text).replace('|', '/')
		found.append([str(row['seed']), row['scene'], f"{float(row['part'] or 0):.2f}", why])
	return found


def page(rows, command, revision, day):
	"""In Markdown: counts by kind, and the scenes that stop or are wrong."""
	lines = ['# Ground, drawn at random', '', 'Written by `scripts/ground`, whose `--help` says what the scenes are and what is asked of them.', '']
	lines += [f'`{command}`, {day}, revision {revision}: {len(rows) - sum(map(bool, map(isBad, rows)))} of {len(rows)} scenes end, or fail as they may, and nothing is wrong with them.', '']
	return '\n'.join([*lines, studies.markdown(kinds(rows)), '', studies.markdown(findings(rows)), ''])


def keep(rows, command, revision, day, folder):
	"""Keeps tables of the study of ground in a folder of results."""
	run = f'`{command}`, {day}, revision {revision}'
	studies.keep(folder, 'kinds.csv', 'Outcomes by kind of scene', run, kinds(rows))
	studies.keep(folder, 'findings.csv', 'Scenes that stop or are wrong', run, findings(rows))
