# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes with known answers: the scripts of other examples, and which of their numbers is compared with what. For discretisation.py, and page.py, which needs no YADE."""
import math
from dataclasses import dataclass
from typing import Callable

unknown = math.nan  # the answer is that of runs with smaller cells


@dataclass
class Scene:
	"""A scene for several sizes of the cells.

	:param what: the quantity, in words
	:param against: where the answer is from; 'smaller cells' if it is from runs with those
	:param cells: numbers of cells over a length
	:param run: function of ``script(path, **options)`` and the number of cells; returns the quantity and its exact value
	"""
	what: str
	against: str
	cells: list
	run: Callable


def column(script, cells):
	found = script('column/column.py', cells=cells)
	return 50 - found['top'], 50 - found['height']


def overExact(path, **more):
	"""Value over the exact one, for scripts that leave the relative error."""
	return lambda script, cells: (1 + script(path, cells=cells, picture=0, **more)['error'], 1)


def overTheory(path, **more):
	"""The same where the theory leaves something out that the scene has."""
	return lambda script, cells: (1 + script(path, cells=cells, picture=0, **more)['error'], unknown)


def clay(script, cells):
	"""Load of a footing on clay over the exact one, with steps that go with the cells."""
	return 1 + script('penetration/penetration.py', scene='footing', cells=cells, depth=0.03, steps=4 * cells, picture=0)['error'], 1


def safety(**more):
	def run(script, cells):
		found = script('safety/safety.py', cells=cells, tolerance=0.002, **more)
		return (found['found']['lower'] + found['found']['upper']) / 2, sum(found['published']) / 2

	return run


def seepage(script, cells):
	return 1 + script('water/water.py', scene='seepage', cells=cells, tolerance=0.001)['error'], 1


def tube(script, cells):
	found = script('surface_loads/tube.py', cells=cells)
	return found['moved'].mean(), found['published']


def stripLoad(stress):
	def run(script, cells):
		found = script('surface_loads/surface_loads.py', cells=cells)
		if not stress: return found['settlement'][0] - found['settlement'][1], unknown
		column = found['column']
		return found['np'].interp(1, found['z'][column], -found['points']['stress'][column, 1, 1]) / found['q'], unknown

	return run


def ring(script, cells):
	"""Elastic, axisymmetric; the script makes it, and the footings."""
	found = script('axisymmetric/axisymmetric.py', scene='rough', cells=4, steps=1, settlement=1e-4, tubeCells=cells)
	found['elasticTube']()
	return found['O'].engines[0].loads[0].surface.vertices[0][0] - 1, 1e3 / 1e8 * 1.3 * (0.4 + 4) / 3


def circle(row):
	def run(script, cells):
		_, (_, load), published = script('axisymmetric/axisymmetric.py', cells=cells, settlement=0.003)['curves'][row]
		return load.max(), published

	return run


def cook(poisson, fBar):
	def run(script, cells):
		found = script('walls/cook.py', cells=cells, poisson=poisson, fBar=fBar)
		return found['lift'], found['exact']

	return run


def walls(load):
	def run(script, cells):
		found = script('walls/walls.py', cells=cells, load=load)
		if load == 'lid': return found['forces'][3][0] / (found['width'] * -found['exact'][0]), 1
		return found['along'].mean() / found['exact'].mean(), 1

	return run


def cantilever(script, cells):
	return script('cantilever/cantilever.py', cells=cells)['down'][-1], unknown


def bar(script, cells):
	found = script('waves/waves.py', scene=' ')
	return found['firstMode'](cells, 0.5) / (math.pi / 2 * found['c']), 1


def trade(quantity, length=1, **more):
	"""Value of a scene of examples/trade, with cells over a length [m]."""
	return lambda script, cells: (script('trade/scenes.py', cells=cells / length, **more)[quantity], unknown)


def sandStrip(phi, load='weight', points=1, isRough=False):
	"""Strip of scripts/sand, in soil so stiff that the ground hardly moves before it fails."""
	def run(script, cells):
		from sand.strip import strip # needs YADE
		found = strip(phi, isRough, load, cells=cells, points=points, settlement=2.5e-6, stiff=1e6, factor=1e-3, cohesion=1e-4, seconds=600)
		return found['whole'], found['exact']

	return run


def sandWall(phi, isPassive):
	def run(script, cells):
		from sand.wall import wall # needs YADE
		found = wall(phi, isPassive, cells=cells, factor=1e-3)
		return found['whole'], found['exact']

	return run


locking, penetration = 'locking/locking.py', 'penetration/penetration.py'
smaller = 'smaller cells'
scenes = {
        'column': Scene('settlement of the elastic column', 'closed form', [8, 16, 32, 64, 128], column),
        'askew': Scene('mean stress of the column askew', 'closed form', [4, 8, 16, 32, 64], walls('weight')),
        'lid': Scene('force on the lid of the column askew', 'closed form', [4, 8, 16, 32, 64], walls('lid')),
        'ring': Scene('widening of the thick tube, axisymmetric', 'Lame', [4, 8, 16, 32, 64], ring),
        'tube': Scene('widening of the thick tube, cut by the grid', 'Lame', [4, 8, 16, 32, 64], tube),
        'membrane': Scene("lift of Cook's membrane", 'finite elements of nine nodes', [6, 12, 24, 48, 96], cook(0.3, 0)),
        'rubber': Scene("lift of Cook's membrane, nearly incompressible, F-bar", 'finite elements of nine nodes', [6, 12, 24, 48, 96], cook(0.4999, 1)),
        'hertz': Scene('force on the sphere', 'Hertz', [1, 2, 4, 8], overExact(penetration, scene='sphere')),
        'bar': Scene('frequency of the swinging bar, steps of half a cell', 'closed form', [5, 10, 20, 40, 80], bar),
        'strip': Scene('limit load of the strip footing', 'Prandtl', [4, 8, 16, 32], overExact(locking, scene='strip', fBar=0)),
        'stripFBar': Scene('the same with F-bar', 'Prandtl', [4, 8, 16, 32], overExact(locking, scene='strip')),
        'smoothFBar': Scene('limit load of the smooth strip footing, F-bar', 'Prandtl', [4, 8, 16, 32], overExact(locking, scene='strip', rough=0)),
        'contact': Scene('limit load of the strip footing through contact, F-bar', 'Prandtl', [2, 4, 8, 16], clay),
        'circle': Scene('limit load of the smooth circular footing, F-bar', 'Shield 1955', [3, 6, 12, 24], circle(0)),
        'roughCircle': Scene('limit load of the rough circular footing, F-bar', 'Cox, Eason, Hopkins 1961', [3, 6, 12, 24], circle(1)),
        'cut': Scene('stability number of the cut', 'limit analysis', [10, 20, 40], overExact(locking, scene='cut', fBar=0)),
        'cutFBar': Scene('the same with F-bar', 'limit analysis', [5, 10, 20, 40], overExact(locking, scene='cut')),
        'safety': Scene('factor of safety of the cut, F-bar', 'limit analysis', [5, 10, 20, 40], safety(scene='cut')),
        'infinite': Scene('factor of safety of the infinite slope', 'closed form', [4, 8, 16, 32], safety(scene='infinite')),
        'seepage': Scene('factor of safety of the infinite slope with seepage', 'closed form', [5, 10, 20, 40], seepage),
        'sandSmooth20': Scene('smooth strip on sand, N_gamma, 20 degrees, one point a cell', 'characteristics', [4, 8, 16], sandStrip(20)),
        'sandRough20': Scene('the same, rough', 'characteristics', [4, 8, 16], sandStrip(20, isRough=True)),
        'sandSmooth30': Scene('the same, smooth, 30 degrees', 'characteristics', [4, 8, 16], sandStrip(30)),
        'sandRough30': Scene('the same, rough, 30 degrees', 'characteristics', [4, 8, 16], sandStrip(30, isRough=True)),
        'sandSmooth20x2': Scene('the same, smooth, 20 degrees, 2 x 2 points', 'characteristics', [4, 8, 16], sandStrip(20, points=2)),
        'sandSurcharge20': Scene('strip beside a surcharge, N_q, 20 degrees, one point a cell', 'Reissner', [4, 8, 16], sandStrip(20, 'surcharge')),
        'sandSurcharge20x2': Scene('the same, 2 x 2 points', 'Reissner', [4, 8, 16], sandStrip(20, 'surcharge', 2)),
        'sandCohesion20': Scene('strip, N_c with friction of 20 degrees, one point a cell', 'Prandtl', [4, 8, 16], sandStrip(20, 'cohesion')),
        'sandCohesion20x2': Scene('the same, 2 x 2 points', 'Prandtl', [4, 8, 16], sandStrip(20, 'cohesion', 2)),
        'sandPassive': Scene('thrust of a smooth wall into sand, 30 degrees', 'Rankine', [5, 10, 20], sandWall(30, True)),
        'sandActive': Scene('the same, away from it', 'Rankine', [5, 10, 20], sandWall(30, False)),
        'elastica': Scene('tip of the cantilever that bends down', smaller, [2, 4, 8, 16], cantilever),
        'beam': Scene('deflection of the beam', smaller, [2, 4, 8, 16, 32], overTheory(locking, scene='beam', fBar=0, poisson=0.3)),
        'stiffBeam': Scene('deflection of the nearly incompressible beam, F-bar', smaller, [2, 4, 8, 16, 32], overTheory(locking, scene='beam')),
        'lockedBeam': Scene('deflection of the nearly incompressible beam, which locks', smaller, [2, 4, 8, 16, 32, 64], overTheory(locking, scene='beam', fBar=0)),
        'stripLoad': Scene('settlement under the strip load', smaller, [1, 2, 4, 8, 16], stripLoad(False)),
        'stress': Scene('stress in a point under the strip load', smaller, [1, 2, 4, 8, 16], stripLoad(True)),
        'heavyBeam': Scene('tip of the cantilever under its weight', smaller, [1, 2, 4, 8, 16], trade('tipY', scene='cantilever', steps=80)),
        'collapse': Scene('mean settlement of the block that collapses', smaller, [1, 2, 4, 8, 16], trade('settlement', scene='collapse', steps=40)),
        'runout': Scene('mean run-out of the block that collapses', smaller, [1, 2, 4, 8, 16], trade('spread', scene='collapse', steps=40)),
        'crest': Scene('settlement of the crest of the slope with a weak layer; cells over 2 m', smaller, [1, 2, 4, 8, 16], trade('crest', length=2, scene='slope', steps=40)),
        'toe': Scene('run-out of its toe; cells over 2 m', smaller, [1, 2, 4, 8, 16], trade('toe', length=2, scene='slope', steps=40)),
}
