# SPDX-License-Identifier: GPL-2.0-or-later
"""An engine keeps the columns of its points from step to step, and reads the bodies anew where somebody else may have changed something."""
import pytest

scene = '''
from math import inf
import json
import numpy as np
from yade import mpm
from yade.mpm.library import engine as library
from scenes import slope

def made():
	O.reset()
	solver = slope(cellSize=2, pointsPerCell=2)
	solver.boundaries = list(solver.boundaries) + [MpmBoundary(min=(2, 12, -inf), max=(8, 12, inf), fix='y', displacement=(0, -.01, 0))] * {pushed}
	O.materials.append(MpmMohrCoulombMat(young=1e6, poisson=0.3, density=2400, cohesion=1e4, frictionAngle=.3, label='other'))
	O.step(), O.step()
	return solver

def step():
	"""What a step makes of the scene, and how often it has read the bodies."""
	before = library.timesBodiesWereRead()
	O.step()
	points = mpm.arrays()
	return {{name: points[name] for name in ('id', 'pos', 'stress', 'halfSize', 'defGrad')}}, library.timesBodiesWereRead() - before

def change(solver):
	one = O.bodies[7]
	{change}

solver = made()
change(solver)
kept, times = step()
made()
O.saveTmp()
O.loadTmp()  # nothing is kept
change(O.engines[0])
fresh, timesAnew = step()
assert all(np.array_equal(kept[name], fresh[name]) for name in fresh)
print(json.dumps([times, timesAnew]))
'''


def test_nobody_has_changed_anything(yade):
	for pushed in 0, 1:
		assert yade(scene.format(change='pass', pushed=pushed)).result == [0, 1]


@pytest.mark.parametrize(
        'change', [
                'one.state.force = (0, -1e4, 0)',
                'one.state.force[1] = -1e4',
                'one.state.defGrad[0, 0] *= 1.01',
                'one.state.pos = one.state.pos + Vector3(.01, 0, 0)',
                'one.state.elasticStrain = 1.5 * one.state.elasticStrain',
                'one.state.updateAttrs(dict(plasticStrain=.1))',
                'one.shape.halfSize = .9 * one.shape.halfSize',
                'mpm.assign(elasticStrain=.5 * mpm.arrays()["elasticStrain"])',
                'one.material = O.materials["other"]',
                'O.bodies.erase(7)',
                'O.bodies.append(mpm.fill(pack.inAlignedBox((0, 12, 0), (2, 14, 1)), solver.grid, 2, "other"))',
        ]
)
def test_change_is_seen(yade, change):
	assert yade(scene.format(change=change, pushed=0)).result == [1, 1]


def test_initial_position_counts_where_a_boundary_moves(yade):
	"""It is the displacement from there that a boundary prescribes."""
	assert yade(scene.format(change='one.state.refPos = one.state.refPos + Vector3(0, .5, 0)', pushed=1)).result == [1, 1]


@pytest.mark.parametrize('change', ['O.materials["soil"].young *= 2', 'solver.gravity = (1, -9, 0)', 'solver.grid.cellSize = 3', 'solver.basis = "mpm"'])
def test_settings_need_no_reading(yade, change):
	assert yade(scene.format(change=change, pushed=0)).result == [0, 1]


def test_another_engine_changes_points(yade):
	"""Two engines with points of their own leave each other's alone, and take no chances."""
	yade(
	        '''
from yade import mpm
from yade.mpm.library import engine as library
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=1000, label='soil'))
grid = MpmGrid(cellSize=1)
for x, mask in (0, 1), (5, 2):
	for id in O.bodies.append(mpm.fill(pack.inAlignedBox((x, 0, 0), (x + 2, 2, 1)), grid, 2, 'soil')): O.bodies[id].groupMask = mask
floor = MpmBoundary(max=(100, 0, 100), fix='xy')
O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[floor], mask=mask, verbosity=0) for mask in (1, 2)]
O.dt = .25
for times in 2, 4, 6:
	O.step()
	assert library.timesBodiesWereRead() == times
'''
	)


def test_step_that_fails_is_forgotten(yade):
	"""The next one begins with what the bodies have."""
	yade(
	        '''
from yade import mpm
from yade.mpm.library import engine as library
from scenes import slope
import numpy as np
solver = slope(cellSize=2, pointsPerCell=2)
O.step()
before, solver.newton.maxIterations, solver.newton.minStep = mpm.arrays()['pos'], 1, 1
try: O.step()
except RuntimeError: pass
else: raise SystemExit('one iteration was enough')
assert np.array_equal(mpm.arrays()['pos'], before)
solver.newton.maxIterations, times = 30, library.timesBodiesWereRead()
O.step()
assert library.timesBodiesWereRead() == times + 1
'''
	)
