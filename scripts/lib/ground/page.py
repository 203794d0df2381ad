# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of scripts/ground as a table."""
from collections import Counter


def page(rows, command, revision, day):
	"""In Markdown: counts by kind, and the scenes that stop or are wrong."""
	bad = [row for row in rows if row['how'] == 'stops' or row['wrong']]
	lines = ['# Ground, drawn at random', '', 'Written by `scripts/ground`, whose `--help` says what the scenes are and what is asked of them.', '']
	lines += [f'`{command}`, {day}, revision {revision}: {len(rows) - len(bad)} of {len(rows)} scenes end, or fail as they may, and nothing is wrong with them.', '']
	lines += ['| kind | scenes | end | held | told | fail | stop | wrong | solves a scene | seconds |', '|---|---|---|---|---|---|---|---|---|---|']
	kindOf = lambda row: row['scene'].split(' ')[0] or 'unknown'
	for kind in sorted({kindOf(row) for row in rows}):
		of = [row for row in rows if kindOf(row) == kind]
		count = Counter(row['how'] for row in of)
		mean = lambda name: sum(float(row[name] or 0) for row in of) / len(of)
		lines.append(f"| {kind} | {len(of)} | {count['ends']} | {count['held']} | {count['told']} | {count['fails']} | {count['stops']} | {sum(bool(row['wrong']) for row in of)} | {mean('solves'):.0f} | {mean('seconds'):.1f} |")
	lines += ['', '| seed | scene | at | why |', '|---|---|---|---|']
	for row in bad:
		why = '; '.join(text for text in (str(row['why']), row['wrong'] and 'wrong: ' + row['wrong']) if text).replace('|', '/')
		lines.append(f"| {row['seed']} | {row['scene']} | {float(row['part'] or 0):.2f} | {why} |")
	return '\n'.join(lines) + '\n'
