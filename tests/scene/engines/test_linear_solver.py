# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmNewton.linearSolver: the same states whichever way the equations are solved, and a report of how."""
import pytest


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


def test_sand_in_space_that_keeps_its_volume_needs_no_factor(yade):
	"""A square footing, psi = 0, 19,775 unknowns: GMRES gets there without a factorisation by the direct solver."""
	solves, iterations, fallbacks, factors = yade('''
import json
from scenes import *
h = .5 / 6.5
width, depth = 20 * h, 16 * h
O.materials.append(MpmMohrCoulombMat(young=2e8, poisson=.3, density=2000, cohesion=20, frictionAngle=radians(20), dilationAngle=0, label='sand'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, -depth, 0), (width, 0, width)), grid, 2, 'sand'))
foot = MpmBoundary(min=(-inf, 0, -inf), max=(.5, 0, .5), fix='y', displacement=(0, -1e-4, 0))
sides = [MpmBoundary(**{side: corner}, fix=fix) for fix, side, corner in (('x', 'max', (0, inf, inf)), ('x', 'min', (width, -inf, -inf)), ('z', 'max', (inf, inf, 0)), ('z', 'min', (-inf, -inf, width)), ('xyz', 'max', (inf, -depth, inf)))]
solver = MpmImplicitEngine(grid=grid, boundaries=[foot, *sides], fBar=True, gravity=(0, -10, 0), gravityCurve=[(0, 1)], verbosity=0)
O.engines, O.dt = [solver], 1
mpm.geostatic()
O.step()
print(json.dumps([solver.iterations, solver.cgIterations, solver.cgFallbacks, solver.report()['luSolves']]))
''').result
	assert solves > 5 and iterations > 20 * solves
	assert (fallbacks, factors) == (0, 0)


beam = '''
import json
from scenes import *
from yade import mpm

def bentBeam(method):
	"""A cantilever in 3D that bends under its weight."""
	O.reset()
	O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=200, label='beam'))
	grid = MpmGrid(cellSize=1, dim=3)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, .3, .3), (12, 2.3, 2.3)), grid, 2, 'beam'))
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -1, 0), boundaries=[MpmBoundary(max=(0, inf, inf), fix='xyz')])
	solver.newton.linearSolver, solver.newton.tolerance = method, 1e-9
	O.engines = [solver]
	O.dt = 1 / 3
	return solver
'''


def test_multigrid_gives_the_states_of_the_direct_solver(yade):
	"""Bending by large angles, in three steps; it is kept within them, and made anew as the nodes change."""
	result = yade(
	        beam + '''
from yade.mpm.library import engine
absence = engine.multigridAbsence()
found = {}
for method in ['direct', 'iterative', 'amg'][:2 if absence else 3]:
	solver = bentBeam(method)
	done = []
	for step in range(3):
		O.step()
		done.append((solver.iterations, solver.cgIterations, solver.cgFallbacks, solver.amgSetups))
		assert solver.report()['cgFailure'] == '' and solver.report()['amgSetups'] == solver.amgSetups
	found[method] = [np.sum(done, axis=0).tolist(), mpm.arrays()['pos'].tolist()]
print(json.dumps([absence, found]))
'''
	).result
	absence, found = result
	if absence: pytest.skip('without PETSc: ' + absence)
	(_, direct), (byDiagonal, _), (byMultigrid, pos) = (found[method] for method in ('direct', 'iterative', 'amg'))
	assert max(abs(a - b) for p, q in zip(direct, pos) for a, b in zip(p, q)) < 1e-7
	solves, iterations, fallbacks, hierarchies = byMultigrid
	assert fallbacks == 0 and 1 <= hierarchies < solves and byDiagonal[3] == 0
	assert iterations / solves < 0.3 * byDiagonal[1] / byDiagonal[0]


def test_multigrid_that_is_absent_is_named(yadeWithoutPetsc):
	"""The plugin without mpm_petsc.so: 'amg' says what to do, and the scene stays as it is; 'auto' goes without."""
	said, steps, advice = yadeWithoutPetsc(
	        beam + '''
solver = bentBeam('amg')
try: O.step()
except ValueError as error: said = str(error)
steps = [O.iter]
solver = bentBeam('iterative')
mpm.analysis.advice._manyIterations = 1
advice = mpm.advise(solver)['advice']
solver.newton.linearSolver = 'auto'
O.step()
print(json.dumps([said, steps + [O.iter], [sentence for sentence in advice if 'linearSolver' in sentence]]))
'''
	).result
	assert "linearSolver = 'amg'" in said and 'mpm/mpm_petsc.so' in said and 'scripts/setup --with-petsc' in said
	assert steps == [0, 1]
	assert len(advice) == 1 and 'scripts/setup --with-petsc' in advice[0]
