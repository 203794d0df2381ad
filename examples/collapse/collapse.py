#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Collapse of a vertical cut in undrained clay, as in a geotechnical centrifuge: gravity grows until the cut fails, and on.

	o|_________________           height H = 5 m, length 2 H
	o|                 |          undrained shear strength c_u = 25 kPa, E = 500 c_u
	o|     clay        | H        left: rollers, base: held, also in front of the cut
	o|                 |          load factor = stability number N = gamma H / c_u
	 ///////////////////////////

Limit analysis of the rigid-plastic cut: it fails at N between 3.7752 and 3.7776 (bounds quoted in Z. Kammoun, F. Pastor,
H. Smaoui, J. Pastor (2010): Large static problem in numerical limit analysis. Int. J. Numer. Anal. Meth. Geomech. 34); the best
circular slip surface gives 3.83 (Taylor 1937).

Run it with `scripts/run examples/collapse/collapse.py [options]`, or by yade-batch with the options as columns of a parameter
table. Read examples/slope first.
"""
import os
import sys
import time

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Vertical cut in undrained clay under growing gravity.',
        cellSize=(0.25, 'h [m], a part of 5 m'),
        pointsPerCell=(2, 'material points per cell and axis'),
        stepSize=(0.05, 'of the stability number in a load step'),
        end=(6., 'stability number at the end'))

H, L, cu, density = 5., 10., 25e3, 2000
lower, upper = 3.7752, 3.7776
steps = round(options.end / options.stepSize)

## the clay: sqrt(2 J2) = sqrt(2) c_u at yield in plane strain
O.materials.append(MpmVonMisesMat(young=500 * cu, poisson=0.3, density=density, yieldStress=np.sqrt(2) * cu, label='clay'))
grid = MpmGrid(cellSize=options.cellSize)
cut = mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)])
O.bodies.append(mpm.fill(cut, grid, pointsPerCell=options.pointsPerCell, material='clay'))

## O.time is N: gravity times density is gamma = c_u / H at load factor 1
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, -cu / (density * H), 0),
                loadCurve=[(0, 0), (options.end, options.end)],
                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')],
                label='solver',
        ),
        PyRunner(iterPeriod=1, initRun=True, command='record()'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'collapse-'), iterPeriod=max(1, steps // 12)),
]
O.dt = options.end / steps
history = [(0, 0, 0, 0)]
crest = np.argmax(mpm.arrays()['pos0'] @ (1, 1, 0))


def record():
	"""Stability number, how far the crest has sunk and the toe has moved [m], and iterations of this step."""
	points = mpm.arrays()
	front = (points['pos'] + points['halfSize'])[:, 0].max() - L
	history.append((solver.loadFactor, (points['pos0'] - points['pos'])[crest, 1], front, solver.iterations))


film = mpm.view(os.path.join(options.out, 'collapse.html'), 'plasticStrain', every=max(1, steps // 12), range={'plasticStrain': (0, 1)})
begin = time.time()
try:
	O.run(steps, wait=True)
except RuntimeError as error: # the quasi-static path may end: say where, and show what there is
	print(error)
seconds = time.time() - begin
film.finish()
factor, settlement, front, iterations = np.array(history).T
np.savetxt(os.path.join(options.out, 'collapse.csv'), np.transpose([factor, settlement, front]), '%.8g', ',', header='N,settlement,front', comments='')

## the cut has failed when its face has moved by 1 % of the height: elastically it moves by a tenth of that
failed = np.interp(0.01 * H, front, factor) if front.max() > 0.01 * H else np.nan
points = mpm.arrays()
print(f'h = {options.cellSize:g} m, {options.pointsPerCell} x {options.pointsPerCell} points per cell: {len(points["pos"])} material points, {solver.dofs} unknowns')
print(f'load steps completed: {O.iter} of {steps} in {seconds:.1f} s, iterations per step: {iterations[1:].mean():.1f}')
print(f'the cut fails at N = {failed:.3f}, limit analysis: {lower} to {upper} (difference {100 * (failed / upper - 1):+.1f} %)')
compared(f'stability number of the vertical cut, {5 / options.cellSize:g} cells over the height', failed, (lower + upper) / 2, 'Kammoun et al. 2010, limit analysis')
print(f'at N = {factor[-1]:.2f}: crest settles by {settlement[-1]:.4f} m, front moves by {front[-1]:.4f} m')

figure, (curve, shape) = plt.subplots(1, 2, figsize=(12.5, 5), width_ratios=[1, 1.9], layout='constrained')
curve.plot(front, factor, label='front, forwards')
curve.plot(settlement, factor, label='crest, downwards')
curve.axhline(upper, color='k', linestyle='--', linewidth=0.8, label='limit analysis, 3.78')
curve.plot(0.01 * H, failed, 'o', color='C0', markersize=5, label=f'front at H / 100: N = {failed:.2f}')
curve.set(xlabel='movement [m]', ylabel='stability number $N = \\gamma H / c_u$', ylim=(0, None), xlim=(0, None))
curve.legend(frameon=False, loc='lower right')
mpm.plot('plasticStrain', ax=shape, range=(0, 1))
shape.plot([0, L, L], [H, H, 0], 'k--', linewidth=0.8, label='initial outline')
curve.set_title('How far the cut has moved', fontsize='medium')
shape.set(xlim=(-0.2, L + 2.8), ylim=(-0.2, H + 1.5))
shape.set_title(f'Plastic strain at load factor N = {factor[-1]:.2f}', fontsize='medium')
shape.legend(frameon=False, loc='upper right')
figure.savefig(os.path.join(options.out, 'collapse.png'), dpi=130)
print(f'written: {options.out}/collapse.png, collapse.csv, for the browser collapse.html, and for ParaView {options.out}/collapse-points.pvd')
