# SPDX-License-Identifier: GPL-2.0-or-later
"""report(): one table has its keys, and what its docstring and the reference say of them."""
import re

import pytest
from conftest import Yade, root


@pytest.fixture(scope='module')
def told(tmp_path_factory):
	return Yade(tmp_path_factory.mktemp('report'))(
	        '''
import json
from scenes import *
told = {}
static = slope(2.0)
for name, engine in ('static', static), ('moving', MpmDynamicEngine(grid=static.grid, boundaries=static.boundaries, gravity=static.gravity, verbosity=0)):
	O.engines, O.dt, engine.loadTime = [engine], .01, O.time
	assert engine.report() == {}
	O.run(1, wait=True)
	told[name] = dict(keys=sorted(engine.report()), times=sorted(engine.report()['times']), plot=sorted(engine.plotData()), text=engine.report.__doc__)
print(json.dumps(told))
'''
	).result


def documented(text):
	return re.findall(r'^ *- \*(\w+)\*: \S', text, re.MULTILINE)


def test_each_key_is_documented_once(told):
	found = documented(told['static']['text'])
	assert sorted(found) == told['static']['keys'] and len(found) > 25
	phases = re.search(r"^ *- \*times\*: .*$", told['static']['text'], re.MULTILINE)[0]
	assert all(f"'{phase}'" in phases for kind in told.values() for phase in kind['times'])


def test_in_time_it_also_has_what_plotData_tells_of_motion(told):
	more = set(told['moving']['keys']) - set(told['static']['keys'])
	assert {'kineticEnergy', 'energyImbalance', 'momentum_x'} <= more <= set(told['moving']['plot']) - set(told['static']['plot']) | {'elasticEnergy'}
	assert set(told['static']['keys']) <= set(told['moving']['keys'])


def test_the_reference_has_the_same(yade, told):
	yade(root / 'plugin/docs/reference.py', 'page.rst')
	page = (yade.folder / 'page.rst').read_text()
	section = page[page.index(' report() -> dict\n'):]
	assert documented(section[:section.index('.. py:')]) == documented(told['static']['text'])


def test_the_cause_of_a_cut_is_kept(yade):
	"""After the shorter steps have converged, and in the next run, which begins with a part of O.dt."""
	before, after, later = yade('''
import json
from yade import mpm
O.materials.append(MpmElasticMat(young=1e5, poisson=0.2, density=2000, label='soft'))
grid = MpmGrid(cellSize=1)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (2, 0), (2, 2), (0, 2)]), grid, 2, 'soft'))
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')], newton=MpmNewton(maxIterations=3, tolerance=1e-10), verbosity=0)
O.engines, O.dt = [solver], 1e-3
told = lambda: [solver.report()[key] for key in ('cuts', 'failure', 'cutFailure', 'cutCause')]
O.run(1, wait=True)
found = [told()]
O.dt = 1
O.run(1, wait=True)
found.append(told())
O.dt = 1e-3
O.run(1, wait=True)
print(json.dumps([*found, told()]))
''').result
	assert before == [0, 'none', 'none', '']
	assert after[0] > 0 and after[1:3] == ['none', 'tooManyIterations'] and 'iterations' in after[3]
	assert later[0] == 0 and later[1:] == after[1:]
