# SPDX-License-Identifier: GPL-2.0-or-later
"""Panels of error against cost from the tables of examples/trade and of other examples: one for each scene, plain Python."""
import os
from dataclasses import dataclass, field

import fronts
from pages import number
from plans import plans
from results import read

here = os.path.dirname(os.path.abspath(__file__))
letters = dict(cells='n', pointsPerCell='p', steps='s', stiffness='k', tolerance='b', fBar='') # settings that speak for themselves have no letter


@dataclass
class Point:
	cost: float # in the unit of its panel
	error: float
	setting: dict = field(default_factory=dict) # letter or word: value


@dataclass
class Panel:
	"""One scene.

	:param measure: of what the error is, and against what
	:param cells: what n counts
	:param beside: name of a choice that is shown apart, and its points
	:param uncertainty: errors below it are not known
	:param luck: whether some errors pass through zero, so that single ones mislead
	"""
	title: str
	measure: str
	points: list
	cells: str = ''
	beside: tuple = ('', [])
	unit: str = 's'
	uncertainty: float = 0
	luck: bool = False

	def front(self):
		"""Points that no other surpasses in both cost and error, by cost."""
		best, found = float('inf'), []
		for point in sorted(self.points + self.beside[1], key=lambda point: (point.cost, point.error)):
			if point.error < best: found.append(point)
			best = min(best, point.error)
		return found

	def worthwhile(self):
		"""First point of the front, those that take a quarter and more off the error, and none beyond what is known."""
		found = []
		for point in self.front():
			if not found or point.error < .72 * found[-1].error and found[-1].error > self.uncertainty: found.append(point)
		return found

	def cheapest(self, error):
		"""The cheapest point with at most this error, or None."""
		return next((point for point in self.front() if point.error <= error), None)


def said(setting):
	"""Text of a setting, as 'n8 s20'."""
	return ' '.join(f'{name}{value}' if len(name) < 2 else f'{name} {value}' for name, value in setting.items())


def cost(panel, point):
	"""A cost as text; times of a hundredth of a second and less are no better known."""
	if panel.unit != 's': return f'{point.cost:,.0f} {panel.unit}'
	if point.cost < .01: return '<0.01 s'
	return f'{point.cost:.{2 if point.cost < 1 else 1 if point.cost < 10 else 0}f} s'


def rows(*path):
	"""Rows of a table of another example, numbers converted."""
	return read(os.path.join(here, '..', *path), number)


titles = { # scene of plans.py: title, measure, what n counts, choice that is shown apart
        'column': ('column, elastic, large strains', 'stress, exact', 'over the height', ('linear basis', dict(basis="'mpm'"))),
        'column3d': ('the same in 3D', 'stress, exact', 'over the height', ('linear basis', dict(basis="'mpm'"))),
        'cantilever': ('cantilever, elastic, bends by 70°', 'tip, smaller cells', 'in the thickness', ('linear basis', dict(basis="'mpm'"))),
        'slope': ('slope with a weak layer, von Mises', 'crest and toe, smaller cells', 'in a metre', ('linear basis', dict(basis="'mpm'"))),
        'collapse': ('block that collapses, von Mises', 'spread, smaller cells', 'in a metre', ('linear basis', dict(basis="'mpm'"))),
        'footing': ('strip footing, von Mises', 'limit load, exact', 'in half the width', ('without F-bar', dict(fBar='0'))),
        'cut': ('vertical cut, von Mises', 'stability number, limit analysis', 'over the height', ('without F-bar', dict(fBar='0'))),
        'beam': ('beam, nearly incompressible', 'deflection, beam theory', 'over the height', ('without F-bar', dict(fBar='0'))),
        'circle': ('circular footing, Tresca, axisymmetric', 'limit load, published', 'over the radius', ('3D', dict(scene="'circle'"))),
        'sphere': ('sphere, contact, axisymmetric', 'force, Hertz', 'over the contact', ('3 x 3 points', dict(pointsPerCell='3'))),
        'clay': ('footing, contact, von Mises', 'limit load, exact', 'in half the width', ('edge halved twice', dict(halvings='2'))),
        'tbar': ('T-bar, contact, Tresca', 'resistance, exact', 'over the radius', ('3 x 3 points', dict(pointsPerCell='3'))),
        'meeting': ('two cylinders, bodies that meet', 'half width and pressure, Hertz', 'over half the contact', ('3 x 3 points', dict(pointsPerCell='3'))),
        'seepage': ('slope, water, Mohr-Coulomb', 'factor of safety, exact', 'over the height', ('3 x 3 points', dict(pointsPerCell='3'))),
}


def ofPlan(name):
	"""The panel of a scene of plans.py: what its numbers give, combined with each other, and one other choice."""
	plan, (title, measure, cells, (beside, apart)) = plans[name], titles[name]
	runs, uncertainty = fronts.read(here, name, plan)
	usual = {key: value for key, value in plan.parameters.items() if key not in plan.together}
	points, others = [], []
	for run in fronts.comparable(runs):
		isApart = all(run.setting[key] == value for key, value in apart.items())
		if not isApart and any(run.setting[key] != value for key, value in usual.items()): continue
		shown = {letter: {'0': 'no F-bar', '1': 'F-bar'}[run.setting[key]] if key == 'fBar' else run.setting[key] for key, letter in letters.items() if key in plan.together}
		(others if isApart else points).append(Point(run.cpu, run.error, shown))
	return Panel(title, measure, points, cells, (beside, others), uncertainty=max(uncertainty, *(remaining(name, *ladder) for ladder in ladders.get(name, [])), 0), luck=name in lucky)


lucky = 'cantilever', 'circle', 'sphere', 'seepage'
ladders = { # quantities that errors are of, and what examples/discretisation calls them
        'slope': [('crest', 'crest'), ('toe', 'toe')], 'collapse': [('settlement', 'collapse'), ('spread', 'runout')], 'cantilever': [('tipY', 'heavyBeam')], 'beam': [('', 'stiffBeam')]
}


def remaining(name, quantity, ladder):
	"""Distance of the reference of errors (one, or the reference run) from the value on smaller cells, taken on by its last change."""
	values = {row['cells']: row['value'] for row in rows('discretisation', 'results', 'values.csv') if row['scene'] == ladder}
	most = max(values)
	reference = plans[name].reference
	against = next(row for row in rows('trade', 'results', name + '.csv') if all(f'{row[key]:g}' == value for key, value in reference.items()))[quantity] if quantity else 1
	return abs(against / (2 * values[most] - values[most / 2]) - 1)


def waves():
	"""A pulse by explicit and implicit steps; an error of one is that of a plate in which nothing moves."""
	points = {True: [], False: []}
	for row in rows('waves', 'results', 'trade.csv'):
		if row['error'] < .9: points['consistent' in row['scheme']].append(Point(row['seconds'], row['error'], {row['scheme'].replace('alpha .8', 'alpha'): f"{row['courant']:g}"}))
	return Panel('pulse, dynamic: scheme, dt c / h', 'velocities, exact', points[False], '', ('explicit, consistent mass', points[True]))


def shaken():
	"""Layered ground that is shaken, on a rigid and a compliant base; n counts cells in a wave of 6.8 Hz in the upper layer, 22 m."""
	points = {scheme: [] for scheme in ('newmark', 'generalised-alpha')}
	for row in rows('earthquake', 'results', 'trade.csv'):
		points[row['scheme']].append(Point(row['seconds'], row['error'], {'n': f"{22 / row['cellSize']:g}", 'dt': f"{row['step']:g}"}))
	return Panel('layers that are shaken: cells, dt [s]', 'amplification, exact', points['newmark'], 'in a wave', ('generalised-alpha', points['generalised-alpha']), luck=True)


def loadSteps():
	"""The slope in frictional soil at its limit: load steps of one length, and by stepTolerance."""
	found = {chosen: [Point(row['solves'], row['error'], {} if chosen else dict(s=f"{row['steps']:.0f}")) for row in rows('load_steps', 'results', 'runs.csv')
	                  if row['scene'] == 'friction' and bool(row['part']) == chosen] for chosen in (False, True)}
	return Panel('slope at its limit, Mohr-Coulomb', 'displacement, finer steps', found[False], '', ('stepTolerance', found[True]), 'solves')


def runouts():
	"""Mean over those columns of sand that were run with all three choices."""
	of = {(row['scene'], row['points'], row['maxSplits']): row for row in rows('splitting', 'results', 'splitting.csv') if str(row['scene']).startswith('runout') and not row['failure']}
	choices = {(2, 2): dict(p='2', maxSplits='2'), (2, 0): dict(p='2'), (4, 0): dict(p='4')}
	scenes = [scene for scene in dict.fromkeys(key[0] for key in of) if all((scene, *choice) in of for choice in choices)]
	points = []
	for choice, setting in choices.items():
		some = [of[scene, *choice] for scene in scenes]
		points.append(Point(sum(row['solves'] for row in some), sum(abs(row['measured'] / row['exact'] - 1) for row in some) / len(some), setting))
	return Panel(f'{len(scenes)} run-outs, dynamic, Mohr-Coulomb', 'run-out, experiments', points[:1], '', ('without splitting', points[1:]), 'solves')


def panels():
	return {name: ofPlan(name) for name in titles} | dict(friction=loadSteps(), runout=runouts(), pulse=waves(), shaken=shaken())
