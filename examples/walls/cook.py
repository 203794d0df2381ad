#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cook's membrane in plane strain (R. D. Cook 1974), clamped off the lines of the grid: the lift of its end against finite elements.

	           ____---- (48, 60)
	 (0, 44) |          | ^ shear, 16 m high
	 clamped |      ___-- (48, 44)
	         | __---
	 (0, 0)  |-            unit: m

The clamp is a segment a third of a cell off the grid that holds all directions; the shear is a traction on the right edge; the sloping edges cut cells anyhow. What is
compared is the lift of the middle of the right edge, (48, 52), under a load so small that the theory of small strains tells it: 21.945 F / E for Poisson's ratio 0.3 and
18.51 F / E for 0.4999, by elements of nine nodes (reference.py).

Run it with `scripts/run examples/walls/cook.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys

from yade import mpm
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions("Cook's membrane.",
        cells=(24, 'cells over the clamped edge'),
        poisson=(0.3, "Poisson's ratio: 0.3 or 0.4999"),
        fBar=(0, '1: with F-bar'),
        penalty=(0., 'of the clamp; 0: the default'),
        offset=(1 / 3, 'of the clamp from the line of the grid [cells]'))
reference = {0.3: 21.945, 0.4999: 18.51}  # lift of the middle over F / E

E, F = 1e6, 1e3  # [Pa], [N/m]: the end rises by 2 cm
h = 44 / options.cells
O.materials.append(MpmElasticMat(young=E, poisson=options.poisson, density=1, label='rubber'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (48, 44), (48, 60), (0, 44)]), grid, pointsPerCell=2, material='rubber'))
grid.origin = (-options.offset * h, 0, 0)  # points are where the clamp begins, nodes are not
clamp = MpmBoundary(surface=[(0, 44 + h), (0, -h)], fix='xy')
if options.penalty: clamp.penalty = options.penalty
shear = MpmTraction(surface=[(48, 44), (48, 52), (48, 60)], traction=(0, F / 16, 0))
O.engines = [
        MpmImplicitEngine(grid=grid, boundaries=[clamp], loads=[shear], fBar=bool(options.fBar), newton=MpmNewton(tolerance=1e-8), label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'cook-'), recorders=['points', 'loads', 'walls']),
]
O.dt = 1
O.run(1, wait=True)

middle = min(zip(shear.surface.initialVertices, shear.surface.vertices), key=lambda place: abs(place[0][1] - 52))
lift = (middle[1] - middle[0])[1] * E / F
exact = reference.get(options.poisson)
print(f'h = 44 m / {options.cells}: {len(O.bodies)} material points, {solver.dofs} unknowns, {solver.iterations} iterations, condition number about {solver.conditionEstimate():.2g}')
print(f'lift of the middle over F / E: {lift:.3f}' + (f', reference {exact} ({100 * (lift / exact - 1):+.2f} %)' if exact else ''))
if exact: compared(f"lift of Cook's membrane, Poisson's ratio {options.poisson:g}, {options.cells} cells", lift, exact, 'Cook 1974, by finite elements of nine nodes', 'F / E')
print(f'reaction of the clamp over load: {-solver.reactions[0][1] / F:.8f}')
figure, picture = plt.subplots(figsize=(6, 5.5), layout='constrained')
mpm.plot('meanStress', ax=picture, grid=True, range=(-300, 300))
picture.set_title(f"Poisson's ratio {options.poisson:g}", pad=36, fontsize='medium')
figure.savefig(os.path.join(options.out, 'cook.png'), dpi=130)
print(f'written: {options.out}/cook.png, and for ParaView {options.out}/cook-walls.pvd')
