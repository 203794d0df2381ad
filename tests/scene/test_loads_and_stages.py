# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads on ground that goes away; stages of one engine among several; histories beside stages; displacements counted anew around an axis."""
import pytest

setting = '''
import json
import numpy as np
from yade import mpm
h = .5
grid, base = MpmGrid(cellSize=h), MpmBoundary(max=(inf, 0, inf), fix='xy')
def part(x0, x1, low, high): return mpm.polygon([(x0, low), (x1, low), (x1, high), (x0, high)])
def begin(**kw):
	O.reset()
	O.materials.append(MpmElasticMat(**(dict(young=1e6, poisson=.3, density=2000, label='soil') | kw)))
	O.dt = 1
def engine(**kw): return MpmImplicitEngine(**(dict(grid=grid, gravity=(0, -10, 0), gravityCurve=[(0, 1)], loadCurve=[(0, 1)], boundaries=[base], verbosity=0) | kw))
def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'
'''


def test_histories_go_on_beside_stages_and_a_lonely_position_is_refused(yade):
	without, loaded, messages, ids = yade(setting + '''
begin(young=1e7)
O.bodies.append(mpm.fill(part(0, 2, 0, 2), grid, 2, 'soil'))
O.engines = [engine()]
h = mpm.histories([(1, 2, 0)], record=['displacement'], label='top')
mpm.stages.place(mpm.fill(part(0, 2, 2, 3), grid, 2, 'soil'), steps=4)
mpm.save('at-once.yade.gz')
O.run(2, wait=True)
mpm.save('half.yade.gz')
O.run(2, wait=True)
without, loaded = h['displacement_y'].ravel().tolist(), []
for name in 'half.yade.gz', 'at-once.yade.gz':
	mpm.load(name)
	O.run(2, wait=True)
	loaded.append(mpm.histories.loaded('top')['displacement_y'].ravel().tolist())
messages = [refused(mpm.histories, at, label='b') for at in ((1, 2, 0), Vector3(1, 2, 0), (1.5, 2, 0), [1., 2., 0.], np.array([1., 2., 0.]))]
print(json.dumps([without, loaded, messages, mpm.histories([1, 2, 0], label='c').ids.tolist()]))
''').result
	assert loaded[0][-2:] == without[-2:] and loaded[1][-2:] == without[1:3]
	assert all(text.startswith('ValueError') and 'brackets' in text and 'at=[' in text for text in messages)
	assert ids == [1, 2, 0]
