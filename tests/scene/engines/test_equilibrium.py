# SPDX-License-Identifier: GPL-2.0-or-later
"""A step has converged when every part of the scene has, and the report says how well and how safely."""

scene = '''
from scenes import *

def box(low, high, material):
	return mpm.fill(pack.inAlignedBox((*low, -1), (*high, 1)), MpmGrid(cellSize=1), 2, material)

def side(low, high, **more):
	return MpmBoundary(min=(low[0], low[1], -inf), max=(high[0], high[1], inf), **more)

def run(bodies, boundaries, tolerance):
	"""Load in one step; returns the engine and the positions."""
	O.reset()
	O.materials.append(MpmElasticMat(young=2e11, poisson=0, density=7800, label='steel'))
	O.materials.append(MpmElasticMat(young=1e4, poisson=0, density=80, label='soft'))
	O.bodies.append(bodies())
	solver = MpmImplicitEngine(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), boundaries=boundaries, newton=MpmNewton(tolerance=tolerance), verbosity=0)
	O.engines = [solver]
	O.dt = 1
	O.step()
	assert solver.converged and solver.report()['localResidual'] <= 3 * tolerance, solver.report()
	return solver, mpm.arrays()['pos']

def compare(bodies, boundaries, carrying):
	"""Default settings against a tolerance of 1e-9; returns the sum of what the boxes *carrying* carry."""
	solver, pos = run(bodies, boundaries, 1e-6)
	precise, exact = run(bodies, boundaries, 1e-9)
	print('positions differ by', abs(pos - exact).max(), 'm')
	assert abs(pos - exact).max() < 1e-4
	return [sum(s.reactions[b][1] for b in carrying) for s in (solver, precise)]
'''


def test_a_soft_body_beside_a_pressed_stiff_one_is_in_balance(yade):
	yade(
	        scene + '''
def bodies():
	return box((0, 0), (1, 16), 'soft') + box((5, 0), (9, 4), 'steel')
boundaries = [side((0, -inf), (0, inf), fix='x'), side((1, -inf), (1, inf), fix='x'), side((-inf, -inf), (3, 0), fix='y'), side((5, -inf), (5, inf), fix='x'),
              side((5, 4), (9, 4), fix='y', displacement=(0, -1e-2, 0)), side((4, -inf), (inf, 0), fix='y')]
weight = 16 * 80 * 10
for reaction in compare(bodies, boundaries, [2]):
	print('reaction', reaction, 'weight', weight)
	assert abs(reaction / weight - 1) < 1e-4
'''
	)


def test_a_soft_part_on_a_wedged_stiff_one_is_in_balance(yade):
	yade(
	        scene + '''
def bodies():
	return box((0, 0), (1, 4), 'steel') + box((0, 4), (1, 20), 'soft')
boundaries = [side((-inf, -inf), (0, inf), fix='x'), side((1, -inf), (inf, 3), fix='x', displacement=(-1e-2, 0, 0)), side((1, 4), (inf, inf), fix='x'),
              side((-inf, -inf), (inf, 0), fix='y')]
soft = 16 * 80 * 10
for reaction in compare(bodies, boundaries, range(4)):
	print('reactions', reaction, 'weight', soft + 4 * 7800 * 10)
	assert abs(reaction - soft - 4 * 7800 * 10) < 1e-4 * soft
'''
	)


def test_the_report_tells_of_the_stiffness_and_of_round_off(yade):
	yade(
	        scene + '''
solver, _ = run(lambda: box((0, 0), (1, 4), 'steel'), [side((-inf, -inf), (inf, 0), fix='xy')], 1e-6)
assert solver.report()['stiffness'] == 'positive definite', solver.report()
solver.newton.linearSolver = 'iterative'
solver.loadCurve = [(0, 0), (2, 2)]
O.step()
assert solver.report()['stiffness'] == 'not checked', solver.report()
try:
	run(lambda: box((0, 0), (1, 4), 'soft'), [side((-inf, -inf), (inf, 0), fix='xy')], 1e-20)
except RuntimeError as error:
	assert 'round-off' in str(error) and 'Set newton.tolerance' in str(error) and 'more than the body can carry' not in str(error), error
else:
	assert False, 'converged'
solver = O.engines[0]
assert solver.report()['failure'] == 'stalled' and solver.report()['cuts'] == 0, solver.report()
'''
	)
