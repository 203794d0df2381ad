#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A slope of 30 m with a weathered skin, between free ground of two levels and over rock that lets waves go, is shaken by a record: slope.py [its seconds [size of the cells]]."""
import sys
import time
import numpy as np
from yade import mpm
seconds, cellSize = [*map(float, sys.argv[1:]), *(20, 2.5)[len(sys.argv) - 1:]]
t = np.arange(0, seconds, 0.01)
noise = np.fft.rfft(np.random.default_rng(4).standard_normal(t.size) * t / seconds * np.exp(-5 * t / seconds), 2 * t.size)
w = np.fft.rfftfreq(2 * t.size, 0.01) / 2  # through an oscillator of 2 Hz (K. Kanai, H. Tajimi)
a = np.fft.irfft(noise * (1 + 1.2j * w) / (1 - w**2 + 1.2j * w), 2 * t.size)[:t.size]
quake = mpm.record(list(zip(t, 6 * a / np.abs(a).max())), unit='m/s2', filter=(0.4, 6))  # motion of an outcrop of the rock; or a file
O.materials.append(MpmElasticMat(young=5e9, poisson=0.3, density=2300, label='rock'))
for name, cohesion, angle in ('firm', 300e3, 40), ('weathered', 8e3, 28):
	O.materials.append(MpmMohrCoulombMat(young=6e8 if name == 'firm' else 2e8, poisson=0.3, density=2000, cohesion=cohesion, frictionAngle=radians(angle), label=name))
grid = MpmGrid(cellSize=cellSize)
ground = mpm.polygon([(0, 0), (100, 0), (100, 20), (75, 20), (30, 50), (0, 50)])
O.bodies.append(mpm.fill(ground, grid, 2, lambda x: 'rock' if x[1] < 5 else 'weathered' if x[1] > 20 and x[0] + 1.5 * x[1] > 96 else 'firm'))
common = dict(grid=grid, gravity=(0, -9.81, 0), fBar=True, verbosity=0)
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(100, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
O.engines, O.dt = [MpmImplicitEngine(boundaries=held, **common)], 0.1
O.run(10, wait=True)  # weight
O.resetTime()
mpm.stages.resetDisplacements()
solver = MpmDynamicEngine(rayleigh=mpm.rayleigh(0.03, 3), scheme='generalised-alpha', **common)
O.engines, O.dt, end = [solver], 0.02, quake.time[-1] + 2
solver.loads = mpm.freeField(solver, until=end, motion=quake.incoming())
h = mpm.histories([(29, 49, 0), (76, 19, 0), (50, 1, 0)], record=['displacement', 'acceleration'])
peaks = mpm.peaks(['acceleration'])
begin = time.time()
O.run(int(end / O.dt), wait=True)
crest, toe, base = h.permanent()
moved = lambda edge: np.subtract(edge.surface.vertices, edge.surface.initialVertices)[:, :2]
drift = max(np.linalg.norm(moved(edge) - np.reshape(edge.displacements, (len(edge.times), -1, 2))[-1], axis=1).max() for edge in solver.loads)
print(f'slope: crest {np.linalg.norm(crest):.3f} m, toe {np.linalg.norm(toe):.3f} m, base {np.linalg.norm(base):.4f} m; edges from free ground {drift:.4f} m ({100 * drift / np.linalg.norm(crest):.2f} %)')
print(f'slope: largest acceleration {peaks["acceleration"].max():.2f} m/s2, of the base {h.largest()[2]:.2f} m/s2; {end:.1f} s in {time.time() - begin:.0f} s')
mpm.plot('displacement', fileName='out/earthquake/slope.png')
mpm.plot(peaks['acceleration']).set_title('Largest acceleration [m/s2]').figure.savefig('out/earthquake/peaks.png', bbox_inches='tight')
h.plot('displacement_x').legend(['crest', 'toe', 'base']).figure.savefig('out/earthquake/slope-histories.png', dpi=130, bbox_inches='tight')
