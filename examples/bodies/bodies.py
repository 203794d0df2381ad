#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A slide of sand runs down a channel into a dam: both are made of material points, and meet by a contact.

	   __________                            __
	  |   sand   |  ->                      |  |      dam, elastic, held at its base
	  |__________|__________________________|__|___   smooth channel, inclined

Axes go along and across the channel, so that gravity is oblique. What the slide does to the dam is told by the contact, what the dam bears by sections through its points; both
have to balance: at rest the shear force and the bending moment in the base of the dam are those of the contact and the weight above.

Run it with `scripts/run examples/bodies/bodies.py [options]`, or by yade-batch with the options as columns of a parameter table. Read examples/runout first.
"""
import os
import sys
import time

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

options = readOptions('A slide runs into a dam of points.',
        cells=(4, 'cells over the height of the slide, 1 m'),
        angle=(30., 'of the channel [degrees]'),
        friction=(20., 'between sand and dam [degrees]'),
        end=(3., 'of the run [s]'))

h, g, angle = 1 / options.cells, 9.81, radians(options.angle)
O.materials.append(MpmMohrCoulombMat(young=5e6, poisson=0.3, density=1800, cohesion=200, frictionAngle=radians(34), label='sand'))
O.materials.append(MpmElasticMat(young=2e8, poisson=0.2, density=2400, label='concrete'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (3, 0), (3, 1), (0, 1)]), grid, 2, 'sand', body='slide'))
O.bodies.append(mpm.fill(mpm.polygon([(5, 0), (5.75, 0), (5.75, 1.5), (5, 1.5)]), grid, 3, 'concrete', body='dam'))
contact = MpmBodyContact(between=('slide', 'dam'), friction=radians(options.friction))
O.engines = [
        MpmDynamicEngine(
                grid=grid, gravity=(g * sin(angle), -g * cos(angle), 0), gravityCurve=[(0, 1)],
                boundaries=[MpmBoundary(max=(4.5, 0, inf), fix='y'),  # the channel is smooth
                            MpmBoundary(min=(4.5, -inf, -inf), max=(inf, 0, inf), fix='xy')],
                contacts=[contact], scheme='generalised-alpha', rhoInfinity=0.5, label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'bodies-'), iterPeriod=50, recorders=['points', 'contacts']),
]
O.dt = 0.1 * h / 2


history, shots, begin = [], [], time.time()
while O.time < options.end:
	O.run(1, wait=True)
	base = mpm.sectionForces('dam', ((5, h / 2), (0, 1)))
	foot = base['centre']
	history.append([O.time, *contact.force[:2], contact.moment[2] - foot[0] * contact.force[1] + foot[1] * contact.force[0], base['N'], base['Q'], base['M']])
	if len(shots) < 3 and O.time >= (0.15, 0.45, 1)[len(shots)] * options.end - O.dt: shots.append((O.time, mpm.arrays()))
history = np.array(history)
np.savetxt(os.path.join(options.out, 'history.csv'), history, delimiter=',', header='t,slideX,slideY,moment,N,Q,M', comments='')
print(f'h = {h:g} m: {len(O.bodies)} material points, {len(history)} steps in {time.time() - begin:.0f} s')

# At the foot of the dam: what the slide does to it, and its weight along the channel above the section.
points = mpm.arrays()
dam = points['body'] == 1
above = 2400 * points['volume'][dam & (points['pos'][:, 1] > h / 2)].sum() * g * sin(angle)
late = history[:, 0] > 0.8 * options.end
t, x, y, moment, N, Q, M = history[late].mean(axis=0)
print(f'force of the slide on the dam along the channel: largest {-history[:, 1].min() / 1e3:.2f} kN/m, at rest {-x / 1e3:.2f} kN/m')
print(f'shear force in its foot at rest: {Q / 1e3:.2f} kN/m; slide and weight: {(-x + above) / 1e3:.2f} kN/m')
compared(f'shear force in the foot of a dam of points, {options.cells} cells', abs(Q) / 1e3, (-x + above) / 1e3, 'equilibrium with the contact', 'kN/m')

figure = plt.figure(figsize=(9, 7), constrained_layout=True)
rows = figure.subfigures(2, 1, height_ratios=(1.2, 1))
axes = rows[0].subplots(3, 1, sharex=True)
for ax, (at, data) in zip(axes, shots):
	slide = data['body'] == 0
	image = ax.scatter(*data['pos'][slide, :2].T, s=4, c=np.linalg.norm(data['velocity'][slide], axis=1), cmap='viridis', vmin=0, vmax=4)
	stress = ax.scatter(*data['pos'][~slide, :2].T, s=4, c=data['stress'][~slide, 1, 1] / 1e3, cmap='coolwarm', vmin=-60, vmax=60)
	for body in O.engines[0].grid.bodies if at == shots[-1][0] else ():
		corners = np.array(body.vertices)
		for piece in body.pieces: ax.plot(*corners[list(piece), :2].T, 'k', lw=0.5)
	ax.set(aspect='equal', ylabel='across [m]', xlim=(-0.2, 6.5), ylim=(-0.1, 2.2))
	ax.text(0.02, 0.85, f't = {at:.2f} s', transform=ax.transAxes)
axes[-1].set_xlabel('along the channel [m]')
rows[0].colorbar(image, ax=axes, label='speed of the sand [m/s]')
rows[0].colorbar(stress, ax=axes, label='stress in the dam, across [kPa]')
force, bending = rows[1].subplots(1, 2)
force.plot(history[:, 0], -history[:, 1] / 1e3, label='slide on dam')
force.plot(history[:, 0], np.abs(history[:, 5]) / 1e3, label='shear force in its foot')
bending.plot(history[:, 0], history[:, 3] / 1e3, label='moment of the slide about its foot')
bending.plot(history[:, 0], history[:, 6] / 1e3, label='bending moment in it')
for ax, unit in (force, 'kN/m'), (bending, 'kN m/m'):
	ax.set(xlabel='t [s]', ylabel=f'[{unit}]')
	ax.legend()
figure.savefig(os.path.join(options.out, 'bodies.png'), dpi=110)
