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
