# SPDX-License-Identifier: GPL-2.0-or-later
"""A saved scene, loaded in a new process, goes on as if nothing had happened: bit for bit."""
import numpy as np
import pytest


@pytest.mark.parametrize('file', ['half.xml.gz', 'half.yade.gz'])
def test_saved_scene_continues_with_the_same_bits(yade, file):
	yade(f'''
from scenes import *
slope()
O.run(20, wait=True)
O.save('{file}')
O.run(20, wait=True)
np.savez('uninterrupted.npz', **mpm.arrays(), iterations=solver.iterations)
''')
	yade(f'''
from scenes import *
O.load('{file}')
assert O.iter == 20 and solver.loadFactor > 0.49, (O.iter, solver.loadFactor)
O.run(20, wait=True)
np.savez('continued.npz', **mpm.arrays(), iterations=solver.iterations)
''')
	whole, parts = (np.load(yade.folder / f'{name}.npz') for name in ('uninterrupted', 'continued'))
	assert len(whole['pos']) == 1095
	for name in whole:
		assert np.array_equal(whole[name], parts[name]), name


def test_results_do_not_depend_on_the_number_of_threads(yade):
	"""Also the sums over points have a fixed order; only the threads of the linear solver's BLAS may differ in the last digits."""
	script = '''
from scenes import *
slope(cellSize=0.5)
O.run(10, wait=True)
np.save('%d.npy', mpm.arrays()['pos'])
'''
	yade(script % 1, threads=1)
	yade(script % 2, threads=2)
	one, two = (np.load(yade.folder / f'{n}.npy') for n in (1, 2))
	assert np.abs(one - two).max() < 1e-11
