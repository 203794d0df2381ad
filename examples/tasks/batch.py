#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Settlement of a layer for the moduli of a table, with a curve and a picture each: yade-batch examples/tasks/batch.table examples/tasks/batch.py. By hand: gamma H^2 / 2 M. Then mpm.collect('out/tasks/batch') gathers them."""
import os
from yade import mpm, plot, utils
utils.readParamsFromTable(M=1e7, noTableOk=True)
from yade.params.table import M
H, gamma = 4, 2e4
O.materials.append(MpmElasticMat(young=M, poisson=0, density=gamma / 10, label='soil'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (1, 0), (1, H), (0, H)]), grid, 2, 'soil'))
sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(1, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=sides)
O.engines = [solver, PyRunner(iterPeriod=1, initRun=True, command='plot.addData(**solver.plotData())')]
O.dt = 1 / 4
O.run(4, wait=True)
name = f'out/tasks/batch-{M:g}'
mpm.plot('displacement_y', fileName=name + '.png')
plot.saveDataTxt(name + '.txt', vars=('loadFactor', 'settlement'))
found, hand = solver.plotData()['settlement'], gamma * H**2 / 2 / M
mpm.note('out/tasks/batch', **{'settlement [mm]': 1e3 * found, 'by hand [mm]': 1e3 * hand})
print(f'batch: M = {M / 1e6:g} MPa, settlement {1e3 * found:.2f} mm, by hand {1e3 * hand:.2f} mm ({100 * (found / hand - 1):+.2f} %)')
