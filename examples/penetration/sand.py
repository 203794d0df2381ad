#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A smooth cone of 60 degrees and 0.4 m of radius, pushed from the surface into sand (Mohr-Coulomb, phi = 32, psi = 2 degrees, c = 0.3 kPa, E = 5 MPa and 15 MPa more with each metre, its weight).

Around the axis to 4 m, with several sizes of the cells, and as a quarter in 3D to 1.2 m: resistance of the tip over its depth. The cases cone-sand and cone-sand-3d of scripts/contacts are the same scene.
Run it with `scripts/run examples/penetration/sand.py [options]`; runs that are in its folder are not made again.
"""
import os
import resource
import sys

import numpy as np
folder = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [os.path.join(folder, '..'), os.path.join(folder, '..', '..', 'scripts', 'lib')]
from contacts.course import smoothness
from contacts.penetration import pushedIntoSand, quarterPushedIntoSand
from options import readOptions
from style import plt

options = readOptions('A cone in sand.',
        cells=('2 3', 'over the radius, around the axis, between blanks'),
        quarter=('2 1+2', "the same in 3D, with '+2' halved twice at edges; nothing: none"),
        depth=(4., 'of the tip at the end [m], around the axis'),
        depth3d=(1.2, 'and in 3D'),
        seconds=(900., 'of processor time for each, after which it ends with what it has'))
R = .4


def pushed(name, cells, halvings, isSpace):
	"""Depth of the tip and its resistance [m, kPa] by step, also in a file."""
	if isSpace: course, way, q, inside = quarterPushedIntoSand(options.depth3d, R, cells=cells, halvings=halvings, seconds=options.seconds)
	else: course, way, q, inside = pushedIntoSand('cone', options.depth, R, cells=cells, seconds=options.seconds)
	mean, largest = smoothness(way, q, R / cells, R)
	said = course.told()
	print(f"{name}: {'all of' if not said['why'] else said['why'] + ' at'} {way[-1]:.2f} m; {said['steps']} steps, {said['iterations']} iterations, {said['cuts']} cuts, {said['seconds']:.0f} s, at most {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB so far; tip "
	      + ', '.join(f'{np.interp(s, way, q) / 1e3:.3f} MPa at {s:g} m' for s in (.4, 1.2, 2, 3, 4) if s <= way[-1] + 1e-9)
	      + f'; steps differ from the mean over a cell by {100 * mean:.1f} % on average, {100 * largest:.1f} % at most; deepest middle of a point inside: {inside:.3f} cells', flush=True)
	return way, q


figure, axes = plt.subplots(figsize=(5, 5.5), layout='constrained')
for isSpace, texts in (False, options.cells), (True, options.quarter):
	for text in texts.split():
		cells, halvings = (int(number) for number in (text + '+0').split('+')[:2])
		name = f"{'3D' if isSpace else 'axis'}, {cells} cells over R" + (f', halved {halvings} times at edges' if halvings else '')
		path = os.path.join(options.out, f"{name.replace(', ', '-').replace(' ', '-')}-to-{options.depth3d if isSpace else options.depth:g}m.csv")
		if not os.path.exists(path): np.savetxt(path, np.column_stack(pushed(name, cells, halvings, isSpace)), '%.6g', ',', header='depth,resistance', comments='')
		way, q = np.loadtxt(path, delimiter=',', skiprows=1).T
		axes.plot(q / 1e3, way, '--' if isSpace else '-', label=name)
axes.set(xlabel='resistance of the tip [MPa]', ylabel='depth of the tip [m]', xlim=(0, None), ylim=(1.02 * max(options.depth, options.depth3d), 0))
axes.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'sand.png'), dpi=110)
print(f'written: {options.out}/sand.png')
