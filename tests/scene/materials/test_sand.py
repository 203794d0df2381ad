# SPDX-License-Identifier: GPL-2.0-or-later
"""Sand almost without cohesion that yields below a footing: it takes few iterations and no cuts, whether it dilates or not."""
import re

import pytest
from conftest import root


def outcome(yade, *options):
	"""What examples/benchmarks/sand.py prints: numbers by name."""
	text = yade(root / 'examples/benchmarks/sand.py', *options).stdout
	found = re.search(r'complete; N_gamma (.*); (\d+) iterations \(at most (\d+)\), (\d+) cuts', text)
	assert found, text
	return [float(word) for word in found[1].split()], *map(int, found.groups()[1:])


@pytest.mark.parametrize('psi, most', [(20, 330), (0, 250)])
def test_a_footing_takes_few_iterations(yade, psi, most):
	"""It sinks by a sixth of a cell in 40 steps, in each of which much begins to yield and ceases to; judged by their residual, Newton steps took 1060 and 773 iterations
	with 13 and 19 cuts."""
	load, iterations, _, cuts = outcome(yade, '--psi', str(psi), '--settlement', '0.01')
	assert iterations <= most and cuts == 0
	assert 1.5 < load[0] < load[3] < 3.3


def test_a_stabilisation_for_sand_that_flows_depends_little_on_steps(yade):
	"""Faces that tie ill-filled cells, and kinks that go on for nothing: in 10 and 40 steps as without any stabilisation, 2.12, where the usual one takes 2.55 and 2.41."""
	few, many = (outcome(yade, '--where', 'aggregates', '--memory', '1', '--steps', str(steps)) for steps in (10, 40))
	usual = outcome(yade, '--steps', '40')
	assert abs(few[0][3] / many[0][3] - 1) < 0.02 and many[3] == few[3] == 0
	assert abs(many[0][3] / 2.12 - 1) < 0.01 and many[0][3] < 0.9 * usual[0][3]


def test_the_memory_of_the_stabilisation_is_kept_in_a_saved_scene_and_refused_with_inertia(yade):
	"""It is that of the last increment, which is saved: a run goes on with the same bits."""
	yade('''
import numpy as np
from yade import mpm
def sand(Engine=MpmImplicitEngine, predictor=True, **ghost):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=1e7, poisson=0.3, density=2000, cohesion=1e3, frictionAngle=radians(30), dilationAngle=0, label='sand'))
	grid = MpmGrid(cellSize=0.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (4, 0), (2.6, 1.7), (0, 1.7)]), grid, 2, 'sand'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	O.engines = [Engine(grid=grid, boundaries=sides, ghost=MpmGhost(**ghost), newton=MpmNewton(predictor=predictor), gravity=(0, -10, 0), verbosity=0, label='solver')]
	O.dt = 1 / 8
def stresses(): return mpm.arrays()['stress']
sand(memory=0.9, where='aggregates')
O.run(4, wait=True)
O.save('half.yade.gz')
O.run(4, wait=True)
whole = stresses()
O.load('half.yade.gz')
O.run(4, wait=True)
assert np.array_equal(stresses(), whole)
sand()
O.run(8, wait=True)
assert not np.array_equal(stresses(), whole)
for arguments, said in ((dict(memory=1.5), 'MpmGhost.memory'), (dict(threshold=0), 'MpmGhost.threshold'), (dict(where='edges'), "MpmGhost.where")):
	try: sand(**arguments)
	except (ValueError, TypeError) as error: assert said in str(error), error
	else: raise AssertionError(said)
for engine, predictor, said in ((MpmDynamicEngine, True, 'with MpmDynamicEngine 0 is'), (MpmImplicitEngine, False, 'with MpmNewton.predictor = False 0 is')):
	sand(engine, predictor, memory=0.5)
	try: O.run(1, wait=True)
	except (ValueError, RuntimeError) as error: assert 'MpmGhost.memory = 0.5' in str(error) and said in str(error), error
	else: raise AssertionError
''')
