#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The raft of the Transcona grain elevator, which failed on clay in 1913: pressure at failure in 3D, a quarter of it, by the mean unconfined strength of later borings.

Measured: 6,150 lb/ft2 (M. Bozozuk (1954): A study of the foundation failure of the Transcona grain elevator. MSc thesis, University of Manitoba). Strength: R. B. Peck
and F. G. Bryant (1953): The bearing-capacity failure of the Transcona elevator. Geotechnique 3(5).
"""
import os
import sys
from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt
options = readOptions('Raft of the Transcona grain elevator.',
        cells=(4, 'cells over half the width, without the half cell at its edge'),
        steps=(16, 'load steps'),
        strength=(44.5e3, 'undrained shear strength, half the unconfined one [Pa]'),
        clay=(10., 'thickness of the clay below the raft [m]'))
B, L, embedment, weight = 23.5, 59.5, 3.7, 17e3  # raft and depth of its base [m], unit weight of the clay [N/m3]
measured = 6150 * 4.4482216 / 0.3048**2
h = B / (2 * options.cells + 1)  # the raft ends in the middle between two nodes
rows = [(np.floor(side / 2 / h) + 0.5) * h for side in (B, L)]
wide, deep, long = rows[0] + np.ceil(20 / h) * h + h / 2, max(1, round(options.clay / h)) * h, rows[1] + np.ceil(20 / h) * h + h / 2
O.materials.append(MpmTrescaMat(young=1000 * options.strength, poisson=0.49, density=1700, undrainedStrength=options.strength, label='clay'))
grid = MpmGrid(cellSize=h, dim=3)
O.bodies.append(mpm.fill(pack.inAlignedBox((0, -deep, 0), (wide, 0, long)), grid, 2, 'clay'))
raft = MpmBoundary(min=(-inf, 0, -inf), max=(rows[0], 0, rows[1]), fix='xyz', displacement=(0, -0.02 * B, 0))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(wide, -inf, -inf), fix='x'), MpmBoundary(max=(inf, inf, 0), fix='z'), MpmBoundary(min=(-inf, -inf, long), fix='z')]
base = MpmBoundary(max=(inf, -deep, inf), fix='xyz')
O.engines = [MpmImplicitEngine(grid=grid, fBar=True, boundaries=[*sides, base, raft], verbosity=0, label='solver')]
O.dt = 1 / options.steps
curve = [(0, weight * embedment)]
for _ in range(options.steps):
	O.step()
	curve.append((0.02 * B * solver.loadFactor, weight * embedment - solver.reactions[5][1] / (rows[0] * rows[1])))
settlement, pressure = np.array(curve).T
found = pressure.max()
print(f'raft: fails at {found / 1e3:.0f} kPa, measured {measured / 1e3:.0f} kPa ({100 * (found / measured - 1):+.1f} %); N_c = {(found - weight * embedment) / options.strength:.2f}')
compared(f'pressure below the Transcona elevator at failure, {2 * options.cells + 1} cells over the width', found / 1e3, measured / 1e3, 'Bozozuk 1954, field', 'kPa')
figure, (line, section) = plt.subplots(1, 2, figsize=(12, 4.2), layout='constrained')
line.plot(1e3 * settlement, pressure / 1e3, label='computed')
line.axhline(measured / 1e3, color='k', linestyle='--', label='measured at failure')
line.set(xlabel='settlement [mm]', ylabel='pressure below the raft [kPa]', xlim=(0, None), ylim=(0, None))
line.legend(frameon=False)
mpm.plot('displacement', ax=section, plane=('z', h / 4))
figure.savefig(os.path.join(options.out, 'transcona.png'), dpi=100)
