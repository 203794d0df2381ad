# SPDX-License-Identifier: GPL-2.0-or-later
"""Points of sand that fly alone cost hardly more than others, and are counted."""

sandAlone = '''
import json
from scenes import *

def fly(cells, steps=60):
	"""Sand, so many cells wide or a single point, slides along a rough base; most solves of a step, cuts, and plotData() at the end."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=8e6, poisson=.3, density=1600, cohesion=16, frictionAngle=.644, dilationAngle=0, label='sand'))
	grid = MpmGrid(cellSize=.1)
	size = cells * .1 or .05
	O.bodies.append(mpm.fill(pack.inAlignedBox((.2, .01 * (cells == 0), 0), (.2 + size, size, 1)), grid, 2, 'sand'))
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], verbosity=0)
	O.engines, O.dt = [solver], .0067
	mpm.assign(velocity=[(.4, 0, 0)] * len(O.bodies))
	most, cuts = 0, 0
	for _ in range(steps):
		O.step()
		most, cuts = max(most, solver.iterations), cuts + solver.cuts
	return dict(points=len(O.bodies), most=most, cuts=cuts, data=solver.plotData(), reported=solver.report()['loosePoints'])

'''


def test_a_point_alone_comes_to_rest(yade):
	found = yade(sandAlone + 'print(json.dumps(fly(0)))').result
	data = found['data']
	assert found['points'] == data['loosePoints'] == found['reported'] == 1
	assert found['cuts'] == 0 and found['most'] <= 12
	first = 1600 * .05**2 * .4**2 / 2  # kinetic energy [J]
	assert data['kineticEnergy'] < 1e-3 * first and abs(data['energyImbalance']) < .02 * first


def test_bodies_have_none(yade):
	found = yade(sandAlone + 'print(json.dumps(fly(3, 5)))').result
	assert found['data']['loosePoints'] == 0


def test_points_that_pass_each_other_gain_no_energy(yade):
	"""Above a rough base, at two heights in one cell: the field that they determine has a gradient without bound as one is above the other. It gave them twelve times the kinetic energy that they had."""
	found = yade(sandAlone + '''
def cross(ahead):
	"""Kinetic energy at first, and the most and the imbalance of 12 steps, over it."""
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=8e6, poisson=.3, density=1600, cohesion=16, frictionAngle=.644, dilationAngle=0, label='sand'))
	grid = MpmGrid(cellSize=.1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((.2, 0, 0), (.25, .1, 1)), grid, 2, 'sand'))
	for body, place in zip(O.bodies, ((.45, .03, 0), (.45 + ahead, .011, 0))): body.state.pos = place
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], verbosity=0)
	O.engines, O.dt = [solver], .0049
	mpm.assign(velocity=[(5, .3, 0), (4.45, .2, 0)])
	first, most, off = 1600 * .05**2 / 2 * (5**2 + .3**2 + 4.45**2 + .2**2), 0, 0
	for _ in range(12):
		O.step()
		data = solver.plotData()
		most, off = max(most, data['kineticEnergy'] / first), max(off, abs(data['energyImbalance']) / first)
	return len(O.bodies), first, most, off
print(json.dumps([cross(.005), cross(.02)]))
''').result
	for points, first, most, off in found:
		assert points == 2 and most < 1.01 and off < .01, found
