# SPDX-License-Identifier: GPL-2.0-or-later
"""Features of a scene, combinations that are refused and in what words, and a list of scenes that has every pair often enough. Nothing here needs YADE."""
import itertools
import random

geometries = ['plane', 'axisymmetric', '3d']
laws = ['elastic', 'vonMises', 'tresca', 'mohrCoulomb', 'druckerPrager', 'camClay']
schemes = ['static', 'newmark', 'generalisedAlpha', 'midpoint', 'explicit']
shapes = ['box', 'sphere', 'facet', 'plate', 'clump']  # plate: YADE's Wall
motions = ['fixedBody', 'movedBody', 'freeBody']
walls = ['roughWall', 'smoothWall']  # kinds of an MpmBoundary that is a surface
waters = ['waterLevel', 'waterFunction']
others = ['fields', 'fBar', 'period', 'refinement', 'movingWall', 'friction', 'traction', 'pressure', 'pointLoad', 'place', 'excavate', 'splitting', 'pushed', 'absorbing', 'baseMotion', 'twoEngines']
groups = [geometries, laws, schemes, shapes, motions, walls, waters]  # a scene has one of each group at most
features = [feature for group in groups for feature in group] + others
dynamic = schemes[1:]

# Pairs that are refused, with words of the sentence that says so
refused = {('axisymmetric', 'period'): ['axisymmetric', 'period'], ('period', 'refinement'): ['period', 'refinements'], ('static', 'absorbing'): ['MpmImplicitEngine', 'absorbing', 'MpmDynamicEngine'], ('static', 'baseMotion'): ['motion', 'MpmDynamicEngine']}
refused |= {(shape, 'period'): ['periodic grid', 'Walls'] for shape in shapes if shape != 'plate'}
refused[('freeBody', 'period')] = ['periodic grid', 'Walls']
refused |= {(scheme, stage): ['inertia'] for scheme in dynamic for stage in ('place', 'excavate')}
refused |= {(stage, shaking): ['inertia'] for stage in ('place', 'excavate') for shaking in ('absorbing', 'baseMotion')}
refused |= {(geometry, 'freeBody'): ['free to move'] for geometry in ('plane', 'axisymmetric')}

# Pairs without a meaning: YADE never moves facets and walls by their forces, what moves the rigid base is the wave that
# comes through it, and the like
senseless = {
        ('facet', 'freeBody'), ('plate', 'freeBody'), ('period', 'clump'), ('place', 'excavate'),
        ('axisymmetric', 'clump'),  # it would have to lie on the axis, as one body of revolution
}
needs = {'friction': [shapes], 'movingWall': [walls], **{shape: [motions] for shape in shapes}, **{motion: [shapes] for motion in motions}}


def ordered(a, b):
	return (a, b) if features.index(a) < features.index(b) else (b, a)


def _pairs(chosen):
	return [ordered(a, b) for a, b in itertools.combinations(chosen, 2)]


refused = {ordered(*pair): words for pair, words in refused.items()}
senseless = {ordered(*pair) for pair in senseless} | {pair for group in groups for pair in _pairs(group)}
allPairs = [pair for pair in _pairs(features) if pair not in senseless]


def refusals(chosen):
	"""The pairs among the features that are refused."""
	return [pair for pair in _pairs(chosen) if pair in refused]


def placesOf(chosen):
	"""Part of the body on which each feature acts, by feature, or None where there is not room for all of them."""
	free = {'base', 'top left', 'top right'}
	if 'period' not in chosen: free |= {'left', 'right'} if 'axisymmetric' not in chosen else {'right'}
	if 'camClay' in chosen: free -= {'left', 'right'}  # sides that confine the clay
	wanted = {
	        'baseMotion': ['base'], 'absorbing': ['base'], 'roughWall': ['base', 'left'], 'smoothWall': ['base', 'left'], 'pushed': ['left', 'base'], 'movedBody': ['top left'], 'freeBody': ['top left'],
	        'fixedBody': ['right', 'top left'], 'place': ['top right'], 'excavate': ['top right', 'right'], 'traction': ['top right', 'right'], 'pressure': ['right', 'top right']
	}
	if 'axisymmetric' in chosen and 'facet' not in chosen: wanted['fixedBody'] = ['top left']
	found = {}
	for feature in wanted:
		if feature not in chosen: continue
		if feature == 'absorbing' and 'baseMotion' in chosen: place = 'base'  # the wave that comes through it
		else: place = next((p for p in wanted[feature] if p in free), None)
		if place is None: return None
		free.discard(place)
		found[feature] = place
	return found


def isComplete(chosen):
	return all(any(f in chosen for f in group) for feature in chosen for group in needs.get(feature, []))


def isMeant(chosen):
	"""True if a scene can have these features, be it refused."""
	places = placesOf(chosen)
	isBuried = 'place' in chosen and 'plate' in chosen and (places or {}).get('fixedBody') != 'right'  # a layer behind an infinite plate
	return not any(pair in senseless for pair in _pairs(chosen)) and isComplete(chosen) and places is not None and not isBuried


def _completed(chosen, choose, mayRefuse):
	"""Features with a geometry, a law, a scheme and what they need, or None."""
	chosen = list(chosen)
	for group in [geometries, laws, schemes] + [group for feature in chosen for group in needs.get(feature, [])]:
		if any(f in chosen for f in group): continue
		fitting = [f for f in group if not any(ordered(f, g) in senseless or (not mayRefuse and ordered(f, g) in refused) for g in chosen)]
		if not fitting: return None
		chosen.append(choose(fitting))
	if any(not any(f in chosen for f in group) for feature in chosen for group in needs.get(feature, [])): return _completed(chosen, choose, mayRefuse)
	return sorted(chosen, key=features.index) if isMeant(chosen) else None


class Plan:
	"""A list of scenes, each the features of one: the same list however long it is. The next one begins with the rarest pair; *counts* says how often each has been tried."""

	def __init__(self, seed=0):
		self.random, self.counts, self.scenes = random.Random(seed), dict.fromkeys(allPairs, 0), []

	def _rarity(self, feature, chosen):
		return sum(1 / (1 + self.counts.get(ordered(feature, other), 99)) for other in chosen) + 1e-3 * self.random.random()

	def _extended(self, pair):
		isRefused = pair in refused
		for attempt in range(400):
			chosen = _completed(pair, lambda fitting: max(fitting, key=lambda f: self._rarity(f, pair) * self.random.random()), isRefused and attempt > 50)
			if chosen and all(refused[p] == refused.get(pair) for p in refusals(chosen)): break
		else:
			raise RuntimeError(f'no scene has {pair}')
		for _ in range(0 if isRefused else self.random.choice([1, 2, 3])):
			more = [c for f in features if f not in chosen for c in [_completed([*chosen, f], self.random.choice, False)] if c and not refusals(c)]
			if more: chosen = max(more, key=lambda c: sum(self._rarity(f, chosen) for f in c if f not in chosen) * self.random.random())
		return chosen

	def next(self):
		least = min(self.counts.values())
		chosen = self._extended(self.random.choice([pair for pair in allPairs if self.counts[pair] == least]))
		pairs = refusals(chosen) or _pairs(chosen)  # refused pairs have the same words
		for pair in pairs:
			self.counts[pair] += 1
		self.scenes.append(chosen)
		return chosen

	def until(self, times):
		"""Scenes until each pair has been tried so often."""
		while min(self.counts.values()) < times:
			self.next()
		return self.scenes
