# SPDX-License-Identifier: GPL-2.0-or-later
"""Boundaries whose face, where the soil ends, is on no line of the grid are told; those on lines, beyond the soil or given as surfaces are not."""


def test_a_face_between_lines_is_told(yade):
	said = yade(
	        '''
import sys
from scenes import *
from yade.wrapper import MpmSurface

def column(base, **low):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=0, density=2000, label='s'))
	grid = MpmGrid(cellSize=.5)
	O.bodies.append(mpm.fill(mpm.polygon([(0, base), (2, base), (2, base + 2), (0, base + 2)]), grid, 4, 's'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(**low)]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, verbosity=0, gravity=(0, -10, 0), boundaries=held)], 1 / 2
	sys.stderr.write(f'== {base} {low}\\n')
	O.run(2, wait=True)

for base in .125, 0: column(base, max=(inf, base, inf), fix='y')
column(0, max=(inf, .125, inf), fix='y')
column(.125, surface=[(-1, .125), (3, .125)], fix='n')
'''
	).stderr.split('== ')[1:]
	assert said[0].count('boundaries[2].max[1] = 0.125 m, where the soil ends, is on no line of the grid') == 1 and '0.25 cells away' in said[0], said[0]
	assert not any('no line of the grid' in text for text in said[1:]), said


def test_a_face_far_from_lines_is_refused(yade):
	"""Half a cell from the line the soil would sink by a third too much; a line on the face is the remedy that is named."""
	half, right = yade(
	        '''
from scenes import *
def sinks(base, origin=0):
	O.reset()
	O.materials.append(MpmElasticMat(young=1e7, poisson=0, density=2000, label='s'))
	grid = MpmGrid(cellSize=.5, origin=(0, origin, 0))
	O.bodies.append(mpm.fill(mpm.polygon([(0, base), (2, base), (2, base + 4), (0, base + 4)]), grid, 4, 's'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(2, -inf, -inf), fix='x'), MpmBoundary(max=(inf, base, inf), fix='y')]
	O.engines, O.dt = [MpmImplicitEngine(grid=grid, verbosity=0, gravity=(0, -10, 0), boundaries=held)], 1 / 2
	try: O.run(2, wait=True)
	except RuntimeError as error: return str(error)
	a = mpm.arrays()
	return (a['pos0'] - a['pos'])[:, 1].max()
import json
print(json.dumps([sinks(.25), sinks(.25, origin=.25)]))
'''
	).result
	assert 'boundaries[2].max[1] = 0.25 m' in half and '0.5 cells away' in half and 'origin[1] = 0.25' in half, half
	assert abs(right / .016 - 1) < 0.02
