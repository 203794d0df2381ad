# SPDX-License-Identifier: GPL-2.0-or-later
"""Summary of the tables: every number of the text is computed from them."""
import json
import math
import os
import sys

import fronts
from pages import percent, span
from panels import here, rows, said
from plans import plans

sys.path.append(os.path.join(here, '..', '..', 'plugin', 'python', 'mpm', 'analysis'))
from refinement import errorOf

words = {1: 'one', 2: 'two', 3: 'three', 4: 'four', 5: 'five'}


class Kept:
	"""The runs of the kept tables of scripts/trade."""

	def __init__(self):
		self.runs = {name: fronts.read(here, name, plan)[0] for name, plan in plans.items()}

	def moves(self, name, knob):
		return fronts.moves(self.runs[name], knob, plans[name].together[knob])

	def factors(self, knob, *names, of=None):
		"""Spans of the factors on error and on time of the moves of a knob in scenes, those between the values *of* only, if given."""
		found = [(error, time) for name in names for a, b, _, error, time in self.moves(name, knob) if of is None or (a, b) == of]
		return tuple(map(span, zip(*found)))

	def halving(self, name):
		"""Means of the factors on error and time by halving the cells."""
		steps = [(pairs * math.log2(float(b) / float(a)), pairs * math.log(error), pairs * math.log(time)) for a, b, pairs, error, time in self.moves(name, 'cells')]
		halvings, error, time = map(sum, zip(*steps))
		return math.exp(error / halvings), math.exp(time / halvings)

	def buysMost(self, name):
		"""True if no other number of the scene takes more off the error for the time that it costs."""
		def worth(knob):
			moved = self.moves(name, knob)
			found = fronts.exponent(moved) if moved else 0
			return found if found is not None else math.inf if sum(pairs * math.log(error) for _, _, pairs, error, _ in moved) < 0 else 0 # a change that costs nothing

		return all(worth('cells') >= worth(knob) for knob in plans[name].together if knob != 'fBar')

	def alone(self, knob, value):
		"""Factors on error and time of one other value, by scene, and whether it fails."""
		return {name: row[3:] for name, plan in plans.items() for row in fronts.alternatives(self.runs[name], plan) if row[:2] == (knob, value)}

	def everywhere(self, name, knob, value):
		"""Spans of the factors on error and time of one other value of a scene."""
		rows = [row[3:5] for row in fronts.alternatives(self.runs[name], plans[name]) if row[:2] == (knob, value)]
		return tuple(map(span, zip(*rows)))

	def spans(self, knob, value):
		return tuple(map(span, zip(*((error, time) for error, time, failure in self.alone(knob, value).values() if not failure))))

	def run(self, name, **setting):
		return next(run for run in self.runs[name] if run.setting == plans[name].parameters | setting)


def stepRatios():
	"""Solves with stepTolerance over those of the cheapest equal steps with the same error, where bodies yield."""
	table = [row for row in rows('load_steps', 'results', 'runs.csv') if row['error'] == row['error'] and row['scene'] in ('slope', 'collapse', 'friction', 'footing')]
	found = []
	for row in table:
		fixed = [other['solves'] for other in table if other['scene'] == row['scene'] and not other['part'] and other['error'] <= row['error']]
		if row['part'] and fixed: found.append(row['solves'] / min(fixed))
	return found


def solving():
	"""Seconds of one solve of a slender body in 3D by method, to the smaller of the tolerances."""
	with open(os.path.join(here, '..', 'benchmarks', 'results', 'bench.json')) as file:
		_, runs = json.load(file)['solvers']['methods'][-1]
	return {run['method']: run['setUp'] + run['solve'] for run in runs}, runs[0]['unknowns']


class Sand:
	"""Strips on sand and walls in it, from examples/discretisation."""

	def __init__(self):
		self.ladders = {}
		for row in rows('discretisation', 'results', 'values.csv'):
			if row['scene'].startswith('sand'): self.ladders.setdefault(row['scene'], {})[row['cells']] = row['value'], row['exact']

	def errors(self, names):
		"""Over the cells that all of these scenes have the largest error of them, as text."""
		chosen = [self.ladders[name] for name in names.split()]
		return ', '.join(f'{100 * max(abs(value / exact - 1) for value, exact in (ladder[n] for ladder in chosen)):.2g}' for n in sorted(set.intersection(*map(set, chosen)))[:3]) + ' %'

	def estimates(self):
		"""Ratio of mpm.discretisationError to the true error, for strips with one point a cell and walls."""
		chosen = [ladder for name, ladder in self.ladders.items() if not name.endswith('x2')]
		return [errorOf(ladder[n / 2][0], value, ladder[2 * n][0])[0] / abs(value - exact)
		        for ladder in chosen for n, (value, exact) in ladder.items() if n / 2 in ladder and 2 * n in ladder]


def introduction():
	return f'''# What accuracy costs

Which settings buy accuracy, and which only cost time? The answers come from {sum(map(len, Kept().runs.values()))} runs by `scripts/trade` and the tables of other examples. [The study](../../plugin/docs/studies/trade.md) has all runs.

## Run it

    scripts/trade cantilever                                                              # one of the scenes; all: none named
    scripts/trade my.py --vary h=1,0.5 --quantity settlement --reference h=0.125          # a scene of yours
'''


def text(found):
	kept = Kept()
	halved = [kept.halving(name) for name in plans if name in found and not found[name].luck and name != 'beam'] # the beam is left out: its theory is no better
	section, quarter = kept.run('circle', cells='4'), kept.run('circle', cells='4', scene="'circle'")
	with9, without49 = kept.run('footing', cells='4', fBar='1'), kept.run('footing', cells='24', fBar='0')
	fBar, fine, mpm, stiff = kept.factors('fBar', 'footing', 'cut', 'beam'), kept.spans('tolerance', '1e-9'), kept.spans('basis', "'mpm'"), kept.spans('ghostFactor', '100')
	loose = span([error for error, *_ in kept.alone('tolerance', '1e-4').values()], 3)
	linear = [point.error for panel in found.values() if panel.beside[0] == 'linear basis' for point in panel.front() if point in panel.beside[1]]
	unstable = kept.alone('ghostFactor', '0')
	elastic, plastic = kept.factors('steps', 'column', 'column3d'), kept.factors('steps', 'slope', of=('10', '40'))
	points, contact = kept.factors('pointsPerCell', 'slope', 'collapse', 'clay', 'seepage', 'sphere'), kept.factors('stiffness', 'sphere', 'clay', of=('100', '1000'))
	equal, around = (next(row for row in rows('adaptive', 'results', 'footing.csv') if (row['dim'], row['cells'], row['reach']) == (2, 24, reach)) for reach in (0, 1))
	edges, until = (kept.everywhere('clay', *setting) for setting in (('halvings', '2'), ('scene', "'accurate'")))
	ratios = stepRatios()
	seconds, unknowns = solving()
	sand = Sand()
	split, coarse = found['runout'].points[0], found['runout'].beside[1][0]
	lumped = min((point for point in found['pulse'].points if 'explicit, lumped' in point.setting), key=lambda point: point.error)
	better = found['pulse'].cheapest(.2)
	return f'''**Three settings worth knowing**

1. **`MpmGrid(cellSize=...)`, with 2 x 2 points a cell.** Half the size multiplies the error by {span([e for e, _ in halved])} for {span([t for _, t in halved])} times the time (scenes without *). In {sum(map(kept.buysMost, plans))} of {len(plans)} scenes nothing buys as much.
2. **`MpmGrid(dim=2, axisymmetric=True)` where the body is round.** A circular footing takes {section.cpu:.2f} s as a section and {quarter.cpu:.1f} s as a quarter in 3D.
3. **`fBar=True` where matter keeps its volume** (clay, Poisson's ratio near 0.5): {fBar[0]} times the error for {fBar[1]} times the time. A strip footing with 9 cells over its width has an error of {percent(with9.error)} in {with9.cpu:.2f} s; without F-bar it has {percent(without49.error)} with 49 cells in {without49.cpu:.1f} s ([locking](../locking/README.md)).

**Worth it in some scenes only**
- *Load steps*: four times as many give the elastic columns {elastic[0]} times the error for {elastic[1]} times the time, the slope {plastic[0]} for {plastic[1]}. At a limit load steps decide; `newton.stepTolerance` finds how many, for {span(ratios)} times the solves of the best number ([load_steps](../load_steps/README.md)).
- *`maxSplits=2`*: run-outs; an error of {percent(split.error)} instead of {percent(coarse.error)}, for {split.cost / coarse.cost:.2f} times the solves ([splitting](../splitting/README.md)); finer cells change run-outs by as much ([runout](../runout/README.md)). *Explicit steps*: where less accuracy is needed; a pulse has an error of {percent(lumped.error)} in {lumped.cost:.1f} s ({said(lumped.setting)} cells a step) or {percent(better.error)} in {better.cost:.1f} s ({said(better.setting)}) ([waves](../waves/README.md)).
- *Cells halved* at the edge of a rigid body (`MpmAdaptation`), twice: {edges[0]} times the error for {edges[1]} times the time; `mpm.untilAccurate` finds how often, for {until[1]} times. In boxes (`MpmGrid.refinements`): a strip footing in a large block {equal['seconds']:.0f} s with equal cells, {around['seconds']:.1f} s with some halved twice, same load (within {percent(abs(around['load'] / equal['load'] - 1))}; [adaptive](../adaptive/README.md)).
- *`linearSolver`*: leave it at 'auto' ({seconds['auto']:.1f} s for one solve of a slender body of {unknowns:,} unknowns; direct {seconds['direct']:.1f}, conjugate gradients {seconds['iterative']:.1f}, multigrid {seconds['amg']:.1f}).
- *Sand that dilates*: one point a cell, stiff soil ([sand](../../plugin/docs/studies/sand.md)). With 9, 17, 33 cells over the width N_gamma is {sand.errors('sandSmooth20 sandRough20 sandSmooth30 sandRough30')} off (2 x 2 points, 20 degrees: {sand.errors('sandSmooth20x2')}), N_q {sand.errors('sandSurcharge20')}, N_c {sand.errors('sandCohesion20')}; 5, 10, 20 over a wall: K {sand.errors('sandPassive sandActive')}. `mpm.discretisationError` says {span(sand.estimates())} times that ([discretisation](../discretisation/README.md)).

**Never worth it**

- `basis='mpm'`: {mpm[0]} times the error for {mpm[1]} times the time (among the best in {words[len(linear)]} of five scenes, at {percent(linear[0])}). `ghost.factor`: 100 has {stiff[0]} times the error, 0 fails in {words[sum(bool(failure) for *_, failure in unstable.values())]} of {words[len(unstable)]}.
- `tolerance=1e-9`: {fine[0]} times the error of 1e-6 for {fine[1]} times the time; 1e-4: {loose} times. A contact's `stiffness` of 1000: {contact[0]} times the error of 100 for {contact[1]} times the time.
- 3 x 3 points a cell and more where soil yields or touches: {points[0]} times the error for {points[1]} times the time. (Thin bodies that bend gain by them, and bodies pressed or drawn far.)
'''
