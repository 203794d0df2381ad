#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Saturated sand, 8 m deep, is shaken until the pressure of its water bears all of its weight: liquefaction.py [seconds [depth]]."""
import os
import subprocess
import sys
import numpy as np
from yade import mpm, pack
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
from style import plt
seconds, depth = [*map(float, sys.argv[1:]), *(4, 8)[len(sys.argv) - 1:]]
out, here = 'out/earthquake', os.path.dirname(os.path.abspath(sys.argv[0]))
os.makedirs(out, exist_ok=True)
library = os.path.join(out, 'hypoplasticity.so')  # a law that pore pressures need: it gets denser in each cycle
subprocess.run(['g++', '-O2', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', library, os.path.join(here, '../laboratory/hypoplasticity.cpp')], check=True)
t = np.arange(0, seconds, 0.01)
shaking = np.sin(4 * np.pi * t) * np.minimum(t, 1) * (t <= 0.75 * seconds) / (4 * np.pi)  # 2 Hz, 1 m/s2

energies = 'boundaryWork', 'loadWork', 'waterWork', 'elasticEnergy', 'plasticWork', 'ghostWork', 'gridWork', 'kineticEnergy', 'energyImbalance'
histories = {}
for e in 0.85, 0.6:
	O.reset()
	porosity = e / (1 + e)
	O.materials.append(MpmUserMat(library=library, parameters=[radians(33), 1.5e9, 0.28, 0.55, 0.95, 1.05, 0.25, 1, 1e3], stateVariables=[e], reentrant=True, young=50e6, poisson=0.2,
	                              density=2650 * (1 - porosity) + 1000 * porosity, conductivity=1e-4, porosity=porosity, label='sand'))
	grid = MpmGrid(cellSize=1, period=(3, 0, 0))
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (3, depth, 1)), grid, 2, 'sand'))
	base = MpmBoundary(max=(inf, 0, inf), fix='xy', motion=MpmBaseMotion(history=list(zip(t, shaking)), direction=(1, 0, 0)))
	flow = MpmFlow(bulkModulus=2.2e9, drains=[MpmDrain(surface=[(3, depth), (0, depth)])])
	solver = MpmDynamicEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=[base], flow=flow, water=[MpmWater(level=depth)], scheme='generalised-alpha', verbosity=0)
	O.engines, O.dt = [solver], 0.01
	mpm.geostatic(K0=0.5)
	y, weight = mpm.arrays()['pos'][:, 1], -mpm.arrays()['stress'][:, 1, 1]
	rows = []
	for step in range(int(round(seconds / O.dt))):
		O.step()
		ratio, told = mpm.arrays()['excessPressure'] / weight, solver.plotData()
		rows.append([O.time, ratio[y < 1].mean(), ratio[abs(y - depth / 2) < 1].mean(), *(told[name] for name in energies)])
	histories[e] = np.array(rows)
	base, load, water, elastic, plastic, ghost, scheme, kinetic, imbalance = histories[e][-1, 3:] - histories[e][0, 3:]
	print(f'liquefaction: e = {e}: pressure of water over weight {rows[-1][1]:.3f} at the base, {rows[-1][2]:.3f} half way up')
	print(f'liquefaction: e = {e}: the base gave {base:.1f} J, weight {load - water:.1f} J, sand {-elastic:.1f} J of its elastic energy; lost in sand {plastic:.1f} J, in flow {-water:.1f} J, '
	      f'in the ghost {ghost:.1f} J, by the scheme {scheme:.1f} J; in motion {kinetic:.2f} J; balance {imbalance:.1f} J')

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5.2), layout='constrained')
for e, rows in histories.items():
	for column, style, where in (1, '-', 'base'), (2, '--', 'half way up'):
		left.plot(rows[:, 0], rows[:, column], style, color='C0' if e == 0.85 else 'C1', label=f'e = {e}, {where}')
rows = histories[0.85]
for name, column, sign in ('given by the base', 3, 1), ('elastic energy let go', 6, -1), ('lost in sand', 7, 1), ('lost in flow', 5, -1), ('lost in the ghost', 8, 1):
	right.plot(rows[:, 0], sign * (rows[:, column] - rows[0, column]), label=name)
left.set(xlabel='time [s]', ylabel='excess pressure over\nfirst effective stress [-]'), right.set(xlabel='time [s]', ylabel='energy [J], e = 0.85')
for axes in left, right: axes.legend(loc='upper center', bbox_to_anchor=(0.5, -0.15), ncols=2, frameon=False)
figure.savefig(f'{out}/liquefaction.png', dpi=110)
