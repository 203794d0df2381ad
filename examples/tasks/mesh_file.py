#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A dam from an STL file: the region inside is filled, and stands on its base. By hand: the weight of a prism, 2400 kg/m3 times 10 m/s2 times 20 m3."""
import gts
from yade import mpm
a, b = ([gts.Vertex(x, y, z) for x, y in ((0, 0), (4, 0), (1, 4), (0, 4))] for z in (0, 2))
with open('dam.stl', 'w') as file:  # file as a CAD program would write it
	print('solid dam', file=file)
	quads = [(a[3], a[2], a[1], a[0]), tuple(b)] + [(a[i], a[(i + 1) % 4], b[(i + 1) % 4], b[i]) for i in range(4)]
	for p, q, r, s in quads:
		for corners in ((p, q, r), (p, r, s)):
			print('facet normal 0 0 0\nouter loop', *('vertex %r %r %r' % v.coords() for v in corners), 'endloop\nendfacet', sep='\n', file=file)
	print('endsolid dam', file=file)
O.materials.append(MpmElasticMat(young=1e9, poisson=0.2, density=2400, label='concrete'))
grid = MpmGrid(cellSize=0.5, dim=3)
O.bodies.append(mpm.fill(mpm.solid('dam.stl'), grid, 2, 'concrete'))
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xyz')])
O.engines, O.dt = [solver], 1
O.run(1, wait=True)
found, hand = solver.reactions[0][1], 2400 * 10 * (4 + 1) / 2 * 4 * 2
print(f'mesh file: {found / 1e3:.1f} kN on the base, by hand {hand / 1e3:.1f} kN ({100 * (found / hand - 1):+.2f} %)')
