# SPDX-License-Identifier: GPL-2.0-or-later
"""Von Mises with hardening and softening, and its internal variable on the way from the material to every output."""
import numpy as np
import pytest
from conftest import Yade

laws = dict(hardening=dict(hardening=4e5), softening=dict(hardening=-2e5, residualYieldStress=6e3))

scene = '''
import json, os, sys
from scenes import *

def pressed(steps=10, to=0.2, **law):
	"""Confined compression of two cells between rollers, by a plate."""
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=.25, density=2000, yieldStress=15e3, label='clay', **law))
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (1, 2, 1)), grid, 2, 'clay'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(1, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=sides + [MpmBoundary(min=(-inf, 2, -inf), fix='y', displacement=(0, -to, 0))], verbosity=0)]
	O.dt = 1 / steps
	return O.engines[0]

laws = json.loads(LAWS)
'''.replace('LAWS', repr(__import__('json').dumps(laws)))

E, nu, yieldStress = 1e6, .25, 15e3
G, K = E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))


def closedForm(strain, hardening, residualYieldStress=0):
	"""Compressive strain -> equivalent plastic strain and sqrt(2 J2) of the Kirchhoff stress, in a compression that keeps its direction."""
	trial = 2 * G * (2 / 3)**.5 * strain
	flow = np.maximum(0, (trial - yieldStress) / (hardening + 2 * G * 1.5**.5))
	size = np.where(flow > 0, np.maximum(yieldStress + hardening * flow, residualYieldStress), trial)
	return (2 / 3)**.5 * (trial - size) / (2 * G), size


@pytest.fixture(scope='module')
def run(tmp_path_factory):
	return Yade(tmp_path_factory.mktemp('hardening'))(
	        scene + '''
for name, law in laws.items():
	pressed(**law)
	for step in range(10):
		O.step()
		np.savez(f'{name}{step}.npz', **mpm.arrays())

# saved in the middle of softening, and continued: the same bits
pressed(**laws['softening'])
O.engines += [MpmVtkRecorder(fileName='soft-', iterPeriod=10)]
O.run(5, wait=True)
O.save('middle.yade.gz')
O.run(5, wait=True)
straight = mpm.arrays()
mpm.export('soft.csv')
mpm.plot('plasticStrain', fileName='soft.png')
mpm.colour('plasticStrain')
O.load('middle.yade.gz')
material = O.materials[0]
assert (material.hardening, material.residualYieldStress) == (-2e5, 6e3)
O.run(5, wait=True)
assert all(values.tobytes() == straight[name].tobytes() for name, values in mpm.arrays().items())
np.savez('straight.npz', **straight)

# what a point can carry depends on its plastic strain
pressed(**laws['softening'])
n = len(O.bodies)
shear = [[[0, 9e3, 0], [9e3, 0, 0], [0, 0, 0]]] * n # sqrt(2 J2) = 12.7 kPa
mpm.assign(stress=shear)
mpm.assign(stress=shear, plasticStrain=np.full(n, .01)) # 13 kPa
try: mpm.assign(plasticStrain=np.full(n, .012)) # 12.6 kPa
except ValueError as error: assert 'yields' in str(error)
else: assert False
assert (mpm.arrays()['plasticStrain'] == .01).all() # as before the error

outcomes = []
for law in dict(hardening=-1e6), dict(hardening=-2.4494 * 4e5), dict(hardening=-2.4495 * 4e5), dict(residualYieldStress=16e3), dict(hardening=-1e5, residualYieldStress=15e3):
	try:
		pressed(**law)
		O.step()
		outcomes.append('')
	except ValueError as error: outcomes.append(str(error))
for internals in [('largestPressure', 1.)], [('plasticStrain', 0.)]:
	try: O.bodies[0].state.internals = internals
	except ValueError as error: outcomes.append(str(error))
print(json.dumps(outcomes))
'''
	)


@pytest.mark.parametrize('name', laws)
def test_curve(run, name):
	"""Each point against the closed form of its own strain: through yielding, and to the residual yield stress."""
	sizes = []
	for step in range(10):
		points = np.load(run.folder / f'{name}{step}.npz')
		J = points['defGrad'][:, 1, 1]
		assert np.abs(points['defGrad'][:, 0] - (1, 0, 0)).max() < 1e-12
		flow, size = closedForm(-np.log(J), **laws[name])
		kirchhoff = points['stress'] * J[:, None, None]
		assert points['plasticStrain'] == pytest.approx(flow, abs=1e-12)
		assert kirchhoff[:, 0, 0] == pytest.approx(K * np.log(J) + size / 6**.5, rel=1e-9)
		assert kirchhoff[:, 1, 1] == pytest.approx(K * np.log(J) - size * (2 / 3)**.5, rel=1e-9)
		sizes.append(size.max())
	assert sizes[0] < yieldStress
	if name == 'softening': assert sizes[-1] == 6e3 and any(6e3 < size < yieldStress for size in sizes[1:])
	else: assert sizes[-1] > 1.5 * yieldStress


def test_outputs(run):
	"""In arrays, table and files of ParaView, picture, colours: the same numbers."""
	from vtu import Vtu
	points = np.load(run.folder / 'straight.npz')
	assert points['plasticStrain'].min() > .05
	heads = (run.folder / 'soft.csv').read_text().partition('\n')[0].split(',')
	table = dict(zip(heads, np.genfromtxt(run.folder / 'soft.csv', delimiter=',', skip_header=1).T))
	assert (table['plasticStrain [-]'] == points['plasticStrain']).all()
	assert (Vtu(run.folder / 'soft-points.10.vtu').fields['plasticStrain'] == points['plasticStrain']).all()
	assert (run.folder / 'soft.png').stat().st_size > 10**4


def test_refused(run):
	steep, admitted, tooSteep, residual, equal, unknown, own = run.result
	assert 'hardening = -1e+06' in steep and '-sqrt(6) G' in steep
	assert admitted == '' and 'hardening' in tooSteep
	assert 'residualYieldStress = 16000' in residual and 'yieldStress = 15000' in residual
	assert equal == ''
	assert 'MpmState.internals' in unknown and 'largestPressure' in unknown
	assert 'plasticStrain' in own
