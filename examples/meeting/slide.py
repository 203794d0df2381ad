#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A slide on a slope runs into a dam: ground, slide and dam are bodies of points.

	          slide                 dam
	        ________                 __
	       |________| -->           |  |
	 ===============================|  |=====
	 ground                                     the slope is along x: gravity is turned by its angle

The slide rubs on the ground and on the dam; the dam has no contact with the ground, so that it stands in it as one piece. Until it arrives the slide goes as a block would,
g (sin b - tan d cos b) t^2 / 2. What the dam bears is the force of the contact, and its moment in a section above the foot; in the end ground and dam bear the slide's weight.

Run it with `scripts/run examples/meeting/slide.py [options]`, or by yade-batch with the options as columns of a parameter table.
"""
import os
import sys
from math import cos, inf, radians, sin, sqrt, tan

import numpy as np
from yade import mpm
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A slide that runs into a dam.',
        cellSize=(0.25, 'of the grid [m]'),
        slope=(30., 'of the ground [degrees]'),
        friction=(15., 'of the slide on ground and dam [degrees]'),
        stepSize=(0.01, 'of time [s]'),
        end=(3., 'of the run [s]'))
h, slope, friction, way = options.cellSize, radians(options.slope), radians(options.friction), 4.
box = lambda low, high: mpm.polygon([low, (high[0], low[1]), high, (low[0], high[1])])
O.materials.append(MpmElasticMat(young=2e8, poisson=0.2, density=2400, label='rock'))
O.materials.append(MpmMohrCoulombMat(young=5e6, poisson=0.3, cohesion=1e4, frictionAngle=radians(30), dilationAngle=0, density=1800, label='soil'))
grid = MpmGrid(cellSize=h)
O.bodies.append(mpm.fill(box((0, 0), (11, 0.5)), grid, 2, 'rock', body='ground'))
O.bodies.append(mpm.fill(box((1, 0.5), (4, 1.5)), grid, 2, 'soil', body='slide'))
O.bodies.append(mpm.fill(box((4 + way, 0.5), (4.75 + way, 2.5)), grid, 2, 'rock', body='dam'))
onGround, onDam = (MpmBodyContact(between=('slide', other), friction=friction) for other in ('ground', 'dam'))
O.engines = [
        MpmDynamicEngine(grid=grid, scheme='generalised-alpha', rhoInfinity=0.5, gravity=(9.81 * sin(slope), -9.81 * cos(slope), 0), gravityCurve=[(0, 1)], boundaries=[MpmBoundary(max=(inf, 0, inf), fix='xy')],
                contacts=[onGround, onDam], newton=MpmNewton(tolerance=1e-6), verbosity=0, label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'slide-'), recorders=['points', 'contacts'], iterPeriod=20),
]
O.dt = options.stepSize
acceleration = 9.81 * (sin(slope) - tan(friction) * cos(slope))
arrival = sqrt(2 * way / acceleration)
cut = (4.375 + way, 0.75)  # position of the cut through the dam, a cell above its foot
times, forces, moments = [], [], []
figure, pictures = plt.subplots(4, 1, figsize=(8, 9), height_ratios=[1, 1, 1, 1.2], layout='constrained')
when = [0.6 * arrival, arrival + 0.2, options.end - O.dt]
while O.time < options.end - O.dt / 2:
	O.step()
	times.append(O.time)
	forces.append(-onDam.force[0])  # on the dam
	moments.append(-mpm.sectionForces('dam', (cut, (0, 1)))['M'])
	if when and O.time >= when[0]:
		picture = pictures[3 - len(when)]
		mpm.plot('velocity_x', ax=picture, range=(0, 5), loads=False, colormap='viridis_r')
		picture.set_title(f'{when.pop(0):.2f} s', fontsize='medium')
times, forces, moments = np.array(times), np.array(forces), np.array(moments)
touched = times[forces != 0][0] if forces.any() else np.nan
borne, weight = -np.array(onGround.force) - np.array(onDam.force), 1800 * 9.81 * 3
print(f'{len(O.bodies)} points; the slide touches the dam after {touched:.3f} s, a block {arrival:.3f} s')
print(f'force on the dam: largest {forces.max() / 1e3:.1f} kN/m, at the end {forces[-1] / 1e3:.1f} kN/m; moment a cell above its foot: {np.abs(moments).max() / 1e3:.1f} and {abs(moments[-1]) / 1e3:.1f} kN m/m')
print(f'ground and dam bear ({borne[0] / 1e3:.2f}, {borne[1] / 1e3:.2f}) kN/m in the end, the weight of the slide is ({weight * sin(slope) / 1e3:.2f}, {-weight * cos(slope) / 1e3:.2f})')
compared('a slide meets a dam', touched, arrival, 'a block on an incline', 's')
compared('what bears a slide in the end, along the slope', borne[0], weight * sin(slope), 'its weight', 'N/m')
pictures[3].plot(times, forces / 1e3, label='force on the dam')
pictures[3].plot(times, np.abs(moments) / 1e3, label='moment a cell above its foot')
pictures[3].axvline(arrival, color='k', lw=0.8, ls='--', label='arrival of a block')
pictures[3].set(xlabel='time [s]', ylabel='[kN/m], [kN m/m]')
pictures[3].legend()
figure.savefig(os.path.join(options.out, 'slide.png'), dpi=110)
print(f'written: {options.out}/slide.png, and for ParaView {options.out}/slide-points.pvd')
