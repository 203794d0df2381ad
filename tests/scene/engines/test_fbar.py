# SPDX-License-Identifier: GPL-2.0-or-later
"""fBar through the classes of YADE: what is refused, saved, advised, and that it acts."""


def test_is_refused_without_stabilisation(yade):
	said = yade('''
import json
from scenes import *
solver = column(8, factor=0)
solver.fBar = True
try: O.step()
except Exception as error: print(json.dumps(f'{type(error).__name__}: {error}'))
''').result
	assert said.startswith('ValueError') and 'fBar' in said and 'MpmGhost()' in said


def test_acts_and_continues_from_a_file_with_the_same_bits(yade):
	loads, same = yade('''
import json
from scenes import *

def footing(fBar):
	O.reset()
	O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=1, yieldStress=1e3, label='clay'))
	grid = MpmGrid(cellSize=0.25)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3, 0), (3, 2), (0, 2)]), grid, pointsPerCell=2, material='clay'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(3, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	foot = MpmBoundary(min=(-inf, 2, -inf), max=(1, 2, inf), fix='xy', displacement=(0, -0.05, 0))
	O.engines = [MpmImplicitEngine(grid=grid, boundaries=[*sides, foot], fBar=fBar, label='solver')]
	O.dt = 1 / 8
	return O.engines[0]

loads = []
for fBar in False, True:
	solver = footing(fBar)
	O.run(4, wait=True)
	O.save(f'half-{fBar}.yade.gz')
	O.run(4, wait=True)
	loads.append(-solver.reactions[3][1])
	whole = mpm.arrays()
O.load('half-True.yade.gz')
assert O.engines[0].fBar
O.run(4, wait=True)
print(json.dumps([loads, all((whole[name] == values).all() for name, values in mpm.arrays().items())]))
''').result
	assert 0.7 * loads[0] < loads[1] < 0.95 * loads[0]
	assert same


def test_is_advised_to_materials_that_keep_their_volume(yade):
	found = yade('''
import json
from scenes import *
found = []
for fBar in False, True:
	O.reset()
	solver = slope(steps=10)
	solver.fBar = fBar
	found.append(mpm.advise(solver)['advice'])
O.reset()
found.append(mpm.advise(column(8))['advice'])
def sand(dilation, **own):
	O.reset()
	O.materials.append(MpmMohrCoulombMat(young=1e6, poisson=0.3, density=2000, cohesion=1e3, frictionAngle=0.6, dilationAngle=dilation, label='sand'))
	grid = MpmGrid(cellSize=1)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (2, 0), (2, 2), (0, 2)]), grid, 2, 'sand', **own))
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')])], 1 / 8
	found.append(mpm.advise()['advice'])
for dilation in 0, 0.05, 0.3, 0.5, 0.6: sand(dilation)
sand(0.6, dilationAngle=lambda x: 0.05 if x[1] < 1 else 0.6) # in a part
print(json.dumps([sum(text.startswith('fBar') for text in advice) for advice in found]))
''').result
	assert found == [1, 0, 0] + [1, 1, 1, 0, 0] + [1]
