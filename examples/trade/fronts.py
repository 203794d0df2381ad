# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of the runs of a plan: errors, the front of time and error, and the worth of each knob."""
import math
import os
from dataclasses import dataclass

import results


@dataclass
class Run:
	setting: dict # texts
	cpu: float # [s], as all times
	wall: float
	memory: float # [MiB]
	solves: float
	error: float # the largest of the plan's errors
	errors: dict # errors by name
	failure: str


class NoReference(Exception):
	"""Why nothing can be compared with the reference run of a plan."""


def read(folder, name, plan):
	"""Runs of a plan's table, the reference left out, and the uncertainty of the reference (0 if errors are exact, NaN if unknown).

	NoReference is raised if it did not come to its end, or a quantity is zero there.
	"""
	rows = results.read(os.path.join(folder, 'results', name + '.csv'))
	find = lambda special: next((row for row in rows if special and all(row[k] == v for k, v in (plan.parameters | special).items())), None)
	reference, check = find(plan.reference), find(plan.check)
	if plan.quantities and reference:
		if reference['failure']: raise NoReference(f"The reference run has not come to its end: {reference['failure']}")
		for quantity in plan.quantities:
			if not float(reference[quantity]): raise NoReference(f'The reference run gives {quantity} = 0, so that no error can be relative to it')
	runs = [_run(row, plan, reference) for row in rows if row is not reference]
	if not plan.quantities: return runs, 0.
	return runs, _run(check, plan, reference).error if check and reference else math.nan


def _run(row, plan, reference):
	errors = {name: abs(float(row[name])) for name in plan.errors}
	for name in plan.quantities:
		errors[name] = abs(float(row[name]) / float(reference[name]) - 1) if reference else math.nan
	failed = row['failure'] != ''
	numbers = {name: float(row[name]) for name in ('cpu', 'wall', 'memory', 'solves')}
	return Run({name: row[name] for name in plan.parameters}, error=math.nan if failed else max(errors.values()), errors=errors, failure=row['failure'], **numbers)


def judged(row):
	"""Estimate and the run after it: told over measured time of a step, and whether that lay inside the range told."""
	fastest, usual, slowest, measured = (float(row[name]) for name in ('fastest', 'usual', 'slowest', 'measuredTime'))
	return usual / measured, fastest <= measured <= slowest


def comparable(runs):
	"""Those whose times can be compared: they ended, with one thread."""
	return [run for run in runs if not run.failure and run.setting.get('threads', '1') == '1' and not math.isnan(run.error)]


def front(runs):
	"""Runs that no other beats in both processor time and error, by time."""
	best, found = math.inf, []
	for run in sorted(comparable(runs), key=lambda run: (run.cpu, run.error)):
		if run.error < best:
			best = run.error
			found.append(run)
	return found


def cheapest(runs, error):
	return min((run for run in comparable(runs) if run.error <= error), key=lambda run: run.cpu, default=None)


def moves(runs, name, values):
	"""Effects of a move of one parameter from each value to the next, all else equal.

	:return: rows (from, to, pairs of runs, factor on the error, factor on the time), factors being geometric means
	"""
	found = []
	for a, b in zip(values, values[1:]):
		pairs = [(low, high) for low in comparable(runs) for high in comparable(runs)
		         if low.setting[name] == a and high.setting == low.setting | {name: b} and low.error > 0 and high.error > 0]
		if pairs: found.append((a, b, len(pairs), _mean([h.error / l.error for l, h in pairs]), _mean([h.cpu / l.cpu for l, h in pairs])))
	return found


def _mean(ratios):
	return math.exp(sum(map(math.log, ratios)) / len(ratios))


def exponent(moved):
	"""g in error ~ time^-g over all moves of a parameter; None if they cost nothing."""
	error = sum(pairs * math.log(e) for _, _, pairs, e, _ in moved)
	time = sum(pairs * math.log(t) for _, _, pairs, _, t in moved)
	return -error / time if time > .02 * sum(pairs for _, _, pairs, _, _ in moved) else None


def alternatives(runs, plan):
	"""Values of parameters that are moved alone, against the value that the plan has: rows (name, value, centre, factor on error, on time, failure)."""
	found = []
	for name, values in plan.alone.items():
		if name == 'threads': continue
		for centre in plan.around:
			usual = next((run for run in runs if run.setting == plan.parameters | centre), None)
			if usual is None or usual.failure: continue
			for value in values:
				run = next((run for run in runs if run.setting == plan.parameters | centre | {name: value}), None)
				if run is None or value == plan.parameters[name]: continue
				found.append((name, value, centre, run.error / usual.error, run.cpu / usual.cpu, run.failure))
	return found
