# SPDX-License-Identifier: GPL-2.0-or-later
"""Simple shear of layers that repeat themselves: closed forms, in the plane and in space, in any direction along the grid."""
import json

import numpy as np
import pytest
from conftest import root

scene = '''
import json, sys
from scenes import *

def layer(material, dim=2, along=0, across=1, cells=3, points=2, way=3., steps=20, curve=[(0, 0), (1, 1)], **settings):
	"""Layer of one metre whose upper side is moved along an axis by *way*; returns the engine."""
	O.reset()
	O.materials.append(material)
	period, low, high = np.ones(3), np.full(3, -inf), np.full(3, inf)
	period[across], high[across], low[across] = 0, 0, 1
	if dim == 2: period[2] = 0
	grid = MpmGrid(cellSize=1 / cells, dim=dim, period=period)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, 0 if dim == 3 else -1), (1, 1, 1)), grid, points, 's'))
	displacement = np.zeros(3)
	displacement[along] = way
	letters = 'xyz'[:dim]
	O.engines = [MpmImplicitEngine(grid=grid, verbosity=0, newton=MpmNewton(tolerance=1e-11, minStep=1 / 64), boundaries=[
		MpmBoundary(max=high, fix=letters), MpmBoundary(min=low, fix=letters, displacement=displacement, curve=curve)], **settings)]
	O.dt = 1 / steps
	return O.engines[0]

E, nu, c = 1e6, 0.3, 1e4
elastic = lambda: MpmElasticMat(young=E, poisson=nu, density=1, label='s')
clay = lambda: MpmTrescaMat(young=1e8, poisson=nu, density=1, undrainedStrength=c, label='s')
'''

G = 1e6 / 2.6


def hencky(g):
	"""Shear stress of Hencky's law in simple shear."""
	return 2 * G * np.arcsinh(g / 2) / np.sqrt(1 + g**2 / 4)



def answer(yade, text):
	return json.loads(yade(scene + text).stdout.splitlines()[-1])


def test_elasticLayersHaveTheClosedForm(yade):
	"""In all directions along the grid, and whatever cells, points and steps, to a shear of 3, where Hencky's law has its largest stress; beyond it round-off grows from step to step."""
	found = answer(yade, '''
cases = [dict(), dict(along=1, across=0), dict(cells=4, points=3), dict(steps=7, way=5.), dict(steps=60), dict(points=1), dict(way=1.7, cells=5)]
cases += [dict(dim=3, along=i, across=j, points=1 + (i + j) % 2, steps=10, way=2.) for i in range(3) for j in range(3) if i != j]
found = []
for case in cases:
	solver = layer(elastic(), **case)
	O.run(round(1 / O.dt), wait=True)
	points = mpm.arrays()
	i, j = case.get('along', 0), case.get('across', 1)
	found.append([case.get('way', 3.), solver.reactions[1][i], points['defGrad'][:, i, j].min(), points['defGrad'][:, i, j].max(), points['stress'][:, i, j].min(), points['stress'][:, i, j].max()])
print(json.dumps(found))
''')
	for way, force, least, most, low, high in found:
		exact = hencky(way)
		assert [force, low, high] == pytest.approx([exact] * 3, rel=1e-9)
		assert [least, most] == pytest.approx([way] * 2, rel=1e-9)


def test_clayBearsItsStrength(yade):
	found = answer(yade, '''
found = []
for case in dict(), dict(along=1, across=0), dict(points=3), dict(dim=3, along=2, across=0, way=1., steps=50), dict(fBar=True):
	solver = layer(clay(), **dict(steps=250, way=5.) | case)
	O.run(round(1 / O.dt), wait=True)
	found.append(solver.reactions[1][case.get('along', 0)])
print(json.dumps(found))
''')
	assert found == pytest.approx([1e4] * len(found), rel=1e-4)


def test_aClosedCycleLeavesNothing(yade):
	stress, moved = answer(yade, '''
layer(elastic(), way=1.5, steps=12, curve=[(0, 0), (0.25, 1), (0.75, -1), (1, 0)])
O.run(12, wait=True)
points = mpm.arrays()
print(json.dumps([abs(points['stress']).max(), abs(points['pos'] - points['pos0']).max()]))
''')
	assert stress < 1e-6 * G and moved < 1e-9


def test_theRuleOfThePaperIsKept(yade):
	"""Its boxes overlap: a layer of clay is weaker than its clay."""
	force, half, saved = answer(yade, '''
solver = layer(elastic(), way=1., domains='stretch')
O.run(20, wait=True)
half = mpm.arrays()['halfSize']
F = mpm.arrays()['defGrad'][:, :2, :2]
C = np.einsum('pki,pkj->pij', F, F)
J = np.linalg.det(F)
U = (np.stack([C[:, 0, 0], C[:, 1, 1]], axis=1) + J[:, None]) / np.sqrt(np.trace(C, axis1=1, axis2=2) + 2 * J)[:, None]
O.save('sheared.yade.gz')
O.load('sheared.yade.gz')
print(json.dumps([solver.reactions[1][0], abs(half[:, :2] - np.minimum(U / 12, 1 / 6)).max(), O.engines[0].domains]))
''')
	assert force < 0.95 * hencky(1.) and half < 1e-12 and saved == 'stretch'


def test_anUnknownRuleIsRefused(yade):
	assert "domains = 'boxes'" in yade(scene + "MpmImplicitEngine(domains='boxes')", fails=True).stderr


def test_aBandAcrossTheGridBearsTheStrengthOfItsClay(yade):
	"""At 10 degrees, to a shear of 0.75; walls of finite stiffness and free ends take a hundredth."""
	run = yade(root / 'examples/benchmarks/shear.py', '--degrees', 10, '--shear', 0.75, '--steps', 24)
	assert [float(line.split('= ')[1].split(',')[0]) for line in run.stdout.splitlines() if 'tau' in line][-4:] == pytest.approx([1] * 4, abs=0.015)
