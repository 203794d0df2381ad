# SPDX-License-Identifier: GPL-2.0-or-later
"""The grid with hanging nodes and the clay of examples/two_sizes, by what must be exact: a test that its savings are not those of a mistake."""
import subprocess

import pytest
from conftest import root


def python(text):
	"""Output of a Python of its own in the folder of the example: names of its modules are those of other examples, too."""
	ended = subprocess.run(['/usr/bin/python3', '-c', text], cwd=root / 'examples' / 'two_sizes', capture_output=True, text=True)
	assert ended.returncode == 0, ended.stderr
	return ended.stdout


grid = '''
import numpy as np
from quadtree import Quadtree
from clay import Clay
from scenes import footing, positions
tree = Quadtree((4, 3), 1., (0, 0))
tree.halve(np.linalg.norm(tree.centres() - (1.5, 1.5), axis=1) < 0.8)
tree.halve((np.linalg.norm(tree.centres() - (1.5, 1.5), axis=1) < 0.6) & (tree.width == 1))
tree.connect()
'''


def test_neighbours_differ_by_one_halving_and_cells_fill_the_box():
	python(grid + '''
size, at = tree.sizes(), tree.centres()
assert abs((size**2).sum() - 12) < 1e-12 and len(np.unique(size)) == 3
touch = (abs(at[:, None] - at).max(axis=-1) - (size[:, None] + size) / 2 < 1e-9) & (abs(at[:, None] - at).min(axis=-1) < (size[:, None] + size) / 2 - 1e-9)
assert (np.maximum(size[:, None], size) / np.minimum(size[:, None], size))[touch].max() == 2
assert tree.free.shape[0] > tree.free.shape[1] and np.allclose(tree.free.sum(axis=1), 1)
assert np.allclose(tree.free @ positions(tree), tree.nodes)
''')


@pytest.mark.parametrize('fBar', [False, True])
def test_even_strain_is_exact_across_sizes(fBar):
	"""The patch test, and the moduli."""
	python(grid + f'''
clay = Clay(tree, 1000, 0.3, {fBar})
exx, eyy, exy = 1e-4, -3e-4, 2e-4
d = positions(tree) @ np.array([[exx, exy], [exy, eyy]])
stress, force, K = clay.respond(d.ravel())
lame, shear = 1000 * 0.3 / 1.3 / 0.4, 1000 / 2.6
exact = lame * (exx + eyy) * np.array([1, 1, 1, 0]) + 2 * shear * np.array([exx, eyy, 0, exy])
assert np.allclose(stress, exact, atol=1e-12)
x, y = positions(tree).T
inside = (x > 1e-9) & (x < 4 - 1e-9) & (y > 1e-9) & (y < 3 - 1e-9)
assert abs(force.reshape(-1, 2)[inside]).max() < 1e-12 and abs(clay.weight().sum() + 12) < 1e-12
''')


def test_stiffness_is_the_derivative_of_the_force_where_clay_yields():
	python(grid + '''
clay = Clay(tree, 1000, 0.3, True)
generator = np.random.default_rng(1)
d, v = generator.normal(0, 3e-3, (2, 2 * tree.free.shape[1]))
_, _, K = clay.respond(d)
assert np.mean(clay.dissipated > 0) > 0.5
e = 1e-6
difference = (clay.respond(d + e * v)[1] - clay.respond(d - e * v)[1]) / 2 / e
assert np.linalg.norm(K @ v - difference) < 1e-5 * np.linalg.norm(difference)
''')


def test_halved_cells_are_no_worse_than_larger_ones():
	"""Refined within a width of its edge, the footing is between equal cells of both sizes, and near those of the smaller."""
	python(grid + '''
error = lambda scene: scene.analyse(scene.tree.connect())[0] / scene.exact - 1
scene = footing(4, 1)
scene.tree.halve(scene.near(scene.tree.centres()) < 2)
few, same, large = error(scene), error(footing(4, 0)), error(footing(2, 0))
assert abs(few - same) < 0.3 * abs(same) and abs(few) < 0.7 * abs(large), (few, same, large)
''')
