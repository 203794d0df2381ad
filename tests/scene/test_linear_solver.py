# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmNewton.linearSolver: the same states whichever way the equations are solved, and a report of how."""


def test_conjugate_gradients_give_the_states_of_the_direct_solver(yade):
	"""A slope that yields, up to 90 % of its weight."""
	direct, iterative, automatic = yade('''
import json
from scenes import *

def run(method):
	O.reset()
	solver = slope()
	solver.newton.linearSolver = method
	done = []
	for step in range(36):
		O.step()
		done.append((solver.iterations, solver.cgIterations, solver.cgFallbacks))
	report = solver.report()
	assert (report['cgIterations'], report['cgFallbacks']) == (solver.cgIterations, solver.cgFallbacks)
	solves, iterations, fallbacks = np.sum(done, axis=0).tolist()
	points = mpm.arrays()
	return dict(solves=solves, iterations=iterations, fallbacks=fallbacks, pos=points['pos'].tolist(), plastic=float(points['plasticStrain'].max()))

print(json.dumps([run(method) for method in ('direct', 'iterative', 'auto')]))
''').result
	assert direct['plastic'] > 1e-3
	assert direct['iterations'] == direct['fallbacks'] == 0 == iterative['fallbacks']
	assert iterative['iterations'] > 10 * iterative['solves'] and iterative['solves'] <= 1.1 * direct['solves']
	assert automatic == direct, 'so small a scene is solved directly'
	difference = max(abs(a - b) for p, q in zip(direct['pos'], iterative['pos']) for a, b in zip(p, q))
	assert difference < 1e-4, difference
