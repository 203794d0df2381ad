# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads of a scene: those that act from the beginning beside those that grow, and reactions that balance them."""
import pytest

ground = '''
import json
from scenes import *

def ground(**curves):
	"""Level ground, 4 m wide and 2 m deep, that a plate on its left half is pushed into: boundaries[3]."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=4e4, label='soil'))
	grid = MpmGrid(cellSize=0.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4, 0), (4, 2), (0, 2)]), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(4, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	plate = MpmBoundary(min=(-inf, 2, -inf), max=(1.25, 2, inf), fix='y', displacement=(0, -0.04, 0))
	O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides + [plate], verbosity=0, **curves)]
	O.dt = 1 / 8
	return O.engines[0]

weight = 10 * 2000 * 8
settled = lambda: float((mpm.arrays()['pos0'] - mpm.arrays()['pos'])[:, 1].max())
'''


def test_gravity_acts_from_the_beginning_while_a_footing_is_pushed_down(yade):
	"""Ground that carries its weight does not notice the first step; what the plate then needs is the same as on weightless ground, elastically."""
	rest, plate, sums, energy, weightless, advised = yade(ground + '''
solver = ground(gravityCurve=[(0, 1)], loadCurve=[(0, 0), (1, 0), (2, 1)])
mpm.geostatic(K0=0.5)
advised = mpm.advise(solver)['steps']
O.step()
rest = [settled(), solver.residuals[0], solver.reactions[2][1] / weight, solver.reactions[3][1] / weight]
O.run(7, wait=True)
before = solver.reactions[3][1]
O.run(8, wait=True)
assert abs(solver.loadFactor - 1) < 1e-12
plate = [settled(), before - solver.reactions[3][1]]
data = solver.plotData()
sums = [data['reaction_x'] / weight, data['reaction_y'] / weight]
down = mpm.arrays()['pos0'] - mpm.arrays()['pos']
energy = data['gravityPotential'] / -(down[:, 1] @ [b.state.mass for b in O.bodies] * 10)
solver = ground(loadCurve=[(0, 0), (1, 1)])
solver.gravity = (0, 0, 0)
O.run(8, wait=True)
print(json.dumps([rest, plate, sums, energy, -solver.reactions[3][1], advised]))
''').result
	moved, residual, base, idle = rest
	assert moved < 1e-9 and residual < 1e-3 and abs(base - 1) < 1e-9 and abs(idle) < 1e-9
	assert plate[0] == pytest.approx(0.04, rel=0.3) and plate[1] == pytest.approx(weightless, rel=0.05) and weightless > 1e4
	assert abs(sums[0]) < 1e-5 and abs(sums[1] - 1) < 1e-5
	assert abs(energy - 1) < 1e-12 and advised == 16


def test_first_the_weight_and_then_the_loads(yade):
	"""Slopes have no stress that would be known beforehand. The curves make the same of it as one load curve for each stage, also saved and loaded."""
	staged, byHand, predicted, message = yade(ground + '''
curves = dict(gravityCurve=[(0, 0), (1, 1)], loadCurve=[(1, 0), (2, 1)])
solver = ground(**curves)
solves = []
O.engines = O.engines + [PyRunner(iterPeriod=1, initRun=True, command='solves.append(solver.iterations)')]
O.run(12, wait=True)
O.save('half.yade.gz')
O.load('half.yade.gz')
solver = O.engines[0]
O.run(4, wait=True)
staged = mpm.arrays()['pos'].tolist()

solver = ground()
solver.boundaries[3].displacement = Vector3.Zero
O.run(8, wait=True)
solver.gravityCurve, solver.loadCurve = [(0, 1)], [(1, 0), (2, 1)]
solver.boundaries[3].displacement = (0, -0.04, 0)
O.run(8, wait=True)
byHand = mpm.arrays()['pos'].tolist()

solver = ground(**curves)
solver.boundaries = [MpmBoundary(max=(inf, 0, inf), fix='xy')]
solver.gravity, solver.newton.minStep = (0, -1e4, 0), 1
try: O.run(8, wait=True)
except RuntimeError as error: message = str(error)
print(json.dumps([staged, byHand, solves, message]))
''').result
	assert staged == byHand
	assert min(predicted[1:8]) < predicted[0]  # a step of the first stage starts from the one before it, too
	assert 'of gravity from 0 to 0.125' in message


def test_reactions_balance_the_loads_behind_walls(yade):
	"""When the slope has failed, its domains reach 8 cm behind the base; reactions carry the whole weight all the same."""
	overlap, sums, friction, data = yade('''
import json
from scenes import *
solver = slope()
O.run(40, wait=True)
weight = 9.81 * sum(b.state.mass for b in O.bodies)
total = sum(map(np.array, solver.reactions))
data = solver.plotData()
print(json.dumps([solver.wallOverlap, (total / weight).tolist(), solver.reactions[0][1] / weight, [data['reaction_x'] / weight, data['reaction_y'] / weight]]))
''').result
	assert overlap > 0.05
	assert abs(sums[0]) < 1e-5 and abs(sums[1] - 1) < 1e-5 and sums[:2] == data
	assert 0 < abs(friction) < 1e-6  # rollers, behind which the domains are constrained, too


def test_a_plate_goes_and_comes_back_by_a_curve_of_its_own(yade):
	"""Same result as one that goes with the loads, as far as that goes; afterwards elastic ground is where it was."""
	with_loads, by_curve, back, conflict, idle = yade(ground + '''
def push(**settings):
	solver = ground(gravityCurve=[(0, 1)], **settings)
	mpm.geostatic(K0=0.5)
	return solver
solver = push(loadCurve=[(0, 0), (0.5, 1)])
O.run(4, wait=True)
with_loads = [settled(), solver.reactions[3][1]]
solver = push()
solver.boundaries[3].curve = [(0, 0), (0.5, 1), (2, 0)]
O.run(4, wait=True)
by_curve = [settled(), solver.reactions[3][1]]
O.run(12, wait=True)
back = [settled(), solver.reactions[3][1]]
solver.boundaries += (MpmBoundary(min=(0.5, 2, -inf), max=(3, 2, inf), fix='y', displacement=(0, -0.04, 0)), )
def refused(act):
	try: act()
	except ValueError as error: return str(error)
conflict = refused(lambda: (push(), setattr(O.engines[0], 'boundaries', solver.boundaries), O.step()))
solver = push()
solver.boundaries[3].displacement, solver.boundaries[3].curve = (0, 0, 0), [(0, 1)]
idle = refused(O.step)
print(json.dumps([with_loads, by_curve, back, conflict, idle]))
''').result
	assert by_curve == pytest.approx(with_loads, rel=1e-9) and by_curve[0] > 0.03 and by_curve[1] < -1e4
	assert abs(back[0]) < 2e-4 and abs(back[1]) < 0.01 * abs(by_curve[1])
	assert 'boundaries[3] and boundaries[4] prescribe different displacements along y' in conflict and 'curve' in conflict
	assert 'MpmBoundary.curve multiplies displacement, which is zero' in idle
