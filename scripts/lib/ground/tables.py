# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of scripts/ground as a table."""
from collections import Counter


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
